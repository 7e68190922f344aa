"""Figures of integrators: work-precision diagrams and performance profiles."""
import math

from reports.chart import Chart
from reports.integrators import answers
from reports.profile_figures import factors, stairs, Fixed

SIZE, ONE, PROFILE = (250, 190), (420, 250), (250, 165)
COLUMNS = 3
FLOOR = 1e-14  # of what is drawn
SLOPES = (2, 5)  # orders with a line of their own


def slope_lines(panel, runs):
    """Dotted lines whose slopes are orders, from the upper left run."""
    costs = [r.cost for r in runs]
    low, high = min(costs), max(costs)
    errors = [max(abs(r.error), FLOOR) for r in runs]
    top, bottom = max(errors), min(errors)
    for order in SLOPES:
        if high <= low or top <= bottom:
            return
        factor = min(high / low, (top / bottom)**(1 / order))
        ends = ([low, low * factor], [top, top * factor**-order])
        panel.plot(*ends, back=True, color="currentColor", linestyle=":", linewidth=1, alpha=0.6)
        panel.note(ends[0][1], ends[1][1], f"order {order}")


def draw_scheme(site, panel, problem, scheme):
    """Its curve, equal steps and steps by a tolerance apart."""
    for own in answers.series(problem, scheme):
        known = [r for r in own if r.known and r.cost > 0]
        if not known:
            continue
        rows = [(r.setting, abs(r.error), r.cost, r.iterations, r.energy, r.momentum)
                for r in known]
        key = scheme + (f"{',' if ':' in scheme else ':'}tolerance" if known[0].tolerance else "")
        look = site.points(key, ("chosen", "error", "time [s]", "iterations a step",
                                 "drift of energy", "drift of momenta"), rows)
        panel.plot([r.cost for r in known], [max(abs(r.error), FLOOR) for r in known], label=key,
                   **look)


def work_precision(site, case, problems):
    """The Image of a case: a panel for each formulation."""
    told = [p for p in answers.judged(problems) if any(r.known and r.cost > 0 for r in p.runs)]
    if not told:
        return None
    columns = min(COLUMNS, len(told))
    chart = Chart(columns, SIZE if columns > 1 else ONE)
    for i, problem in enumerate(told):
        stiff = f", EA × {problem.stiffening:g}" if problem.stiffening != 1 else ""
        panel = chart.panel(f"{problem.formulation}, n = {problem.elements}{stiff}",
                            "cost [s]" if i + columns >= len(told) else "",
                            "" if i % columns else "error of time")
        slope_lines(panel, [r for r in problem.runs if r.known and r.cost > 0])
        for scheme in problem.schemes():
            draw_scheme(site, panel, problem, scheme)
    return chart.image(site, f"integrators_{case}")


def profile(site, problems, level):
    """The Image of a performance profile, or None when nothing comes within the level."""
    curves = answers.profile(problems, level)
    if not any(math.isfinite(c[-1]) and c[-1] > 0 for c in curves.values()):
        return None
    at = answers.FACTORS
    chart = Chart(1, PROFILE)
    panel = chart.panel(xlabel="factor to the least cost of all", ylabel="share of problems")
    panel.x = factors(at[-1])
    panel.y = Fixed(False, (0, 1), [(i / 5, f"{20 * i} %") for i in range(6)])
    for i, (scheme, shares) in enumerate(curves.items()):
        marked = slice(2 * i, None, 8)
        rows = [(f"{x:.3g}", f"{100 * share:.0f} %") for x, share in
                list(zip(at, shares))[marked]]
        look = site.points(scheme, ("factor", "within the error"), rows)
        panel.plot(*stairs(at, shares), label=scheme,
                   **{**look, "marker": None, "gid": f"f|{scheme}"})
        panel.plot(at[marked], shares[marked], **{**look, "linestyle": "none"})
    return chart.image(site, f"integrators_profile_{level:g}".replace(".", "_"))


