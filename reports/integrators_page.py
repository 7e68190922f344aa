"""Page of integrators: the integrator and the step with the lowest cost within a time-integration error, and the evidence
for it (from `beamwork motion`, and from integrators.json if it exists)."""
import functools
import math

from markupsafe import escape

from reports import experiments, integrators
from reports.figures.chart import Chart
from reports.figures.svg import FONT, Image
from reports.integrators import ordered
from reports.motion_page import between
from reports.profiles import Fixed, factors, stairs

# Text about integrators.


def joined(words):
    words = list(words)
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


def level_words(level):
    return f"{100 * level:g} %"


def soonest(problems, level, noise):
    """Returns text such as `within 1 % alpha in 2 of 3`. It omits integrators that have the lowest cost in less than
    half as many problems as the first. For a single problem, it includes the step."""
    count, reached = integrators.wins(problems, level, noise)
    if not reached:
        return f"within {level_words(level)} none"
    if len(problems) == 1:
        found = integrators.answer(problems[0], level, noise)
        tied = f" (as soon: {joined(found.ties)})" if found.ties else ""
        best = found.best
        return f"within {level_words(level)} {best.scheme} with {best.run.setting}{tied}"
    most = sorted(count.items(), key=lambda item: -item[1])
    most = [(scheme, n) for scheme, n in most if 2 * n >= most[0][1]]
    told = joined(f"{scheme} in {n}" for scheme, n in most)
    tied = " (ties count for each)" if sum(count.values()) > reached else ""
    return f"within {level_words(level)} {told} of {reached}{tied}"


def trust(problems, noise):
    best = [(p, found.best) for p in problems
            for found in (integrators.answer(p, level, noise) for level in integrators.LEVELS)
            if found.best]
    if not best:
        return "No run meets these tolerances."
    doubted = [(p, way, integrators.doubt(p, way)) for p, way in best]
    doubted = [row for row in doubted if row[2]]
    if doubted:
        p, way, words = doubted[0]
        return (f"{len(doubted)} of these {len(best)} answers are uncertain; each states "
                f"the reason, for example {way.scheme} in {p.name}: {words}.")
    found = [p.ladder(way.scheme) for p, way in best]
    passed = sum(one is not None and one.verdict == "pass" for one in found)
    unread = len(best) - passed
    told = (f"; the order of the scheme is confirmed for {passed} and undetermined for {unread}"
            if unread else ", and the order of the scheme is confirmed")
    return (f"These {len(best)} answers are verified: errors are measured on the same mesh "
            f"against a more accurate reference{told}.")


def first(problems, noise):
    told = integrators.judged(problems)
    if not told:
        return "No run of these results has a time error."
    where = (f"{told[0].name}: lowest cost" if len(told) == 1 else
             f"Of {len(told)} problems (a case with a formulation) the lowest cost has")
    levels = "; ".join(soonest(told, level, noise) for level in integrators.LEVELS)
    return f"{where} {levels}. {trust(told, noise)}"


def chosen(ways):
    """Returns text such as `tolerance 1e-05` or `step 0.01 to 0.02 s`, the setting that most of the ways use."""
    by_tolerance = [w.run.tolerance for w in ways if w.run.tolerance]
    if 2 * len(by_tolerance) >= len(ways):
        return f"tolerance {between(by_tolerance, '{:.2g}')}"
    return f"step {between([w.run.step for w in ways if not w.run.tolerance], '{:.3g}')} s"


def keeping(found):
    """Returns text on the integrators that reach the error and conserve energy, with their costs relative to the
    lowest."""
    if not found.keeping:
        return "none of the integrators within this error conserves energy to round-off"
    names = joined(dict.fromkeys(scheme for scheme, _ in found.keeping))
    ratios = between([ratio for _, ratio in found.keeping], "{:.2g}")
    return f"conserves energy to round-off: {names}, at {ratios} times the cost"


def drift(ways):
    known = [w.run.energy for w in ways if w.run.energy == w.run.energy]
    return f"energy drifts by {between(known, '{:.0e}')}" if known else ""


def stability(problems):
    """Returns one sentence on a map: the schemes whose energy is bounded everywhere and, for each other scheme, the
    smallest step with growing energy or failure."""
    bad, every = {}, {}
    for problem in problems:
        for run in problem.runs:
            if run.fate and not run.tolerance:
                every[run.scheme] = True
            if run.fate in ("grows", "stops") and not run.tolerance:
                bad.setdefault(run.scheme, set()).add(run.step)
    good = [s for s in every if s not in bad]
    told = [f"with {s}, the energy grows or the motion stops at steps of {min(steps):.3g} s or more" for s, steps in bad.items()]
    if good:
        told = [f"the energy stays bounded everywhere with {joined(good)}"] + told
    text = "; ".join(told)
    return text[:1].upper() + text[1:] + "."


def iterations(rows):
    change = [found[max(found)] - found[min(found)] for found in rows.values()]
    if not change:
        return ""
    return ("From the lowest to the highest stiffness, the number of iterations per step increases by at most "
            f"{max(0, max(change)):.1f}.")


def verdicts(rows):
    off = sum(not row["as_expected"] for row in rows)
    if not rows:
        return ""
    told = f"{len(rows)} verdicts on orders, conservation and large steps: "
    return told + (f"{off} not as expected." if off else "all as expected.")


SIZE, ONE, PROFILE = (250, 190), (420, 250), (250, 165)
COLUMNS = 3
FLOOR = 1e-14  # smallest drawn error
SLOPES = (2, 5)  # orders with a reference line


def slope_lines(panel, runs):
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
    for own in integrators.series(problem, scheme):
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
    told = [p for p in integrators.judged(problems) if any(r.known and r.cost > 0 for r in p.runs)]
    if not told:
        return None
    columns = min(COLUMNS, len(told))
    chart = Chart(columns, SIZE if columns > 1 else ONE)
    for i, problem in enumerate(told):
        stiff = f", EA × {problem.stiffening:g}" if problem.stiffening != 1 else ""
        panel = chart.panel(f"{problem.formulation}, n = {problem.elements}{stiff}",
                            "cost [s]" if i + columns >= len(told) else "",
                            "" if i % columns else "time error")
        slope_lines(panel, [r for r in problem.runs if r.known and r.cost > 0])
        for scheme in problem.schemes():
            draw_scheme(site, panel, problem, scheme)
    return chart.image(site, f"integrators_{case}")


def profile(site, problems, level):
    curves = integrators.profile(problems, level)
    if not any(math.isfinite(c[-1]) and c[-1] > 0 for c in curves.values()):
        return None
    at = integrators.FACTORS
    chart = Chart(1, PROFILE)
    panel = chart.panel(xlabel="cost relative to the lowest cost", ylabel="share of problems")
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


# Stability maps, with the step on the horizontal axis, the stiffness on the vertical axis, and a panel for each
# integrator. Each outcome has a colour and a letter, so the map can be read without colours.

# fate: letter, colour, colour of the letter, and meaning
LOOK = {
    "exact": ("E", "#009e73", "#111418", "energy and momenta conserved to round-off"),
    "bounded": ("B", "#8fd3f4", "#111418", "its energy does not grow"),
    "grows": ("G", "#e69f00", "#111418", "its energy grows by more than 1 %"),
    "stops": ("S", "currentColor", "var(--paper,#fff)", "a step finds no solution"),
}
WIDE, TALL, LEFT, TOP, BELOW, GAP = 46, 26, 84, 26, 46, 22
MOST = 4  # largest number of panels in a row


def map_text(x, y, words, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}"{more and " "}{more}>{escape(words)}</text>'


def short(value):
    return (f"{value:g}" if value < 1e4 else f"{value:.0e}").replace("e+0", "e").replace("e+", "e")


def field(x, y, fate, words):
    letter, fill, ink, _ = LOOK[fate]
    return (f'<g><title>{escape(words)}</title><path fill="{fill}" stroke="var(--paper,#fff)" '
            f'd="M{x:.1f} {y:.1f}h{WIDE}v{TALL}h-{WIDE}z"/>' +
            map_text(x + WIDE / 2, y + TALL / 2 + 5, letter, f'fill="{ink}"') + "</g>")


def map_panel(scheme, found, steps, stiffenings, left, top):
    out = map_text(left + WIDE * len(steps) / 2, top - 9, scheme, 'font-size="12"')
    for j, stiffening in enumerate(stiffenings):
        for i, step in enumerate(steps):
            x, y = left + WIDE * i, top + TALL * j
            run = found.get((scheme, step, stiffening))
            if run is None:
                out += map_text(x + WIDE / 2, y + TALL / 2 + 4, "–", 'fill-opacity=".5"')
                continue
            words = f"{scheme}, step {step:g} s, EA × {short(stiffening)}: {run.fate}"
            out += field(x, y, run.fate, words + (f", {run.reason}" if run.reason else ""))
    bottom = top + TALL * len(stiffenings)
    out += "".join(map_text(left + WIDE * (i + 0.5), bottom + 15, f"{step:.3g}")
                   for i, step in enumerate(steps))
    return out + map_text(left + WIDE * len(steps) / 2, bottom + 31, "step [s]", 'font-size="11.5"')


def fates(problems):
    """Returns {(scheme, step, stiffening): run} of runs with equal steps and a known outcome."""
    return {(r.scheme, r.step, p.stiffening): r for p in problems for r in p.runs
            if r.fate and not r.tolerance}


def draw_map(problems, legend=True):
    """Returns the Image of the map of a structure. `problems` are those of the structure with different stiffenings. If
    `legend` is True, the letters are explained below the map."""
    found = fates(problems)
    schemes = ordered({s for s, _, _ in found})
    steps, stiffenings = sorted({h for _, h, _ in found}), sorted({x for _, _, x in found})
    columns = max(1, min(MOST, len(schemes), 900 // (WIDE * len(steps) + GAP)))
    step = (WIDE * len(steps) + GAP, TALL * len(stiffenings) + TOP + BELOW)
    rows = -(-len(schemes) // columns)
    out = ""
    for k, scheme in enumerate(schemes):
        left, top = LEFT + step[0] * (k % columns), TOP + step[1] * (k // columns)
        out += map_panel(scheme, found, steps, stiffenings, left, top)
        if k % columns == 0:
            out += "".join(map_text(left - 8, top + TALL * (j + 0.5) + 4, f"EA × {short(s)}",
                                    'text-anchor="end"') for j, s in enumerate(stiffenings))
    height = step[1] * rows + 6
    there = list(LOOK) if legend else []
    for k, fate in enumerate(there):
        letter, fill, ink, meaning = LOOK[fate]
        y = height + 20 * k
        out += (f'<path fill="{fill}" d="M{LEFT} {y}h18v15h-18z"/>' +
                map_text(LEFT + 9, y + 12, letter, f'fill="{ink}"') +
                map_text(LEFT + 26, y + 12, f"{fate}: {meaning}", 'text-anchor="start"'))
    height += 20 * len(there) + 4
    width = LEFT + max(step[0] * columns, 320 if there else 0)
    name = "".join(c if c.isalnum() else "_" for c in f"map_{problems[0].name}")
    return Image(f"{name}.svg",
                 f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
                 f'fill="currentColor" font-size="11" text-anchor="middle" '
                 f'font-family="{FONT}">{out}</svg>')


NAVIGATION = [("integrators.html", "integrators")]


def present(site):
    return experiments.holds(site.results, "motion")


def noise_of(site):
    return float(site.about.get("cost_noise", 1.25))


def rows_of(problems, noise):
    return [(p, {level: integrators.answer(p, level, noise) for level in integrators.LEVELS})
            for p in problems]


def cases_of(problems, noise):
    """Returns [(case, parameters, {level: Summary}, rows)]. A Summary is for all formulations of a case together, and
    `rows` contains the answers for each formulation."""
    return [(case, parameters,
             {level: integrators.summary(own, level, noise) for level in integrators.LEVELS},
             rows_of(own, noise)) for (case, parameters), own in integrators.by_case(problems).items()]


def maps_of(problems):
    """Returns [(name, Image, sentence)] with a map for each structure that was run with large steps. The largest map
    comes first and explains the letters."""
    found = [own for own in integrators.structures(problems).values() if fates(own) and
             any(p.reference == integrators.NONE_WANTED for p in own)]
    found.sort(key=lambda own: -len(fates(own)))
    return [(min(own, key=lambda p: p.stiffening).name, draw_map(own, own is found[0]),
             stability(own)) for own in found]


def unmeasured(problems):
    return [p for p in problems if p.reference and p.reference != integrators.NONE_WANTED]


def failures_of(problems):
    """Returns [(case, parameters, scheme, number of failed runs, number of formulations, one of these runs)]. Failures
    with large steps are in the maps instead."""
    found = {}
    for p in problems:
        for r in p.runs:
            if r.status != "ok" and not r.large:
                found.setdefault((p.case, p.parameters, r.scheme), []).append((p.formulation, r))
    return [(*key, len(own), len({f for f, _ in own}), own[0][1]) for key, own in found.items()]


def diagrams_of(site, problems):
    found = [(case, parameters, work_precision(site, f"{case}_{i}", own))
             for i, ((case, parameters), own) in enumerate(integrators.by_case(problems).items())]
    return [one for one in found if one[2]]


def write(site):
    record, noise = integrators.read(site.results), noise_of(site)
    told = integrators.judged(record.compared)
    profiles = ((level, profile(site, told, level)) for level in integrators.LEVELS)
    counted, stiffenings = integrators.iterations(record.every)
    site.write("integrators.html",
               "integrators.html",
               record=record.about, about=site.about,
               first=first(record.compared, noise),
               words={"chosen": chosen, "drift": drift, "keeping": keeping},
               doubt=integrators.doubt,
               tolerances=integrators.LEVELS,
               cases=cases_of(told, noise),
               problems=len(told),
               noise=noise,
               diagrams=diagrams_of(site, told),
               maps=maps_of(record.problems),
               profiles=[(level, image) for level, image in profiles if image],
               within={level: integrators.counted(told, level) for level in integrators.LEVELS},
               checks=record.checks,
               left_out=record.left_out,
               iterations=counted, counted=iterations(counted),
               stiffenings=[(s, short(s)) for s in stiffenings],
               orders=integrators.orders(told),
               ladders=[(p, one) for p in told for one in p.ladders
                        if one.verdict == "low order"],
               verdicts=record.verdicts, judged=verdicts(record.verdicts),
               unmeasured=unmeasured(record.every),
               failures=failures_of(integrators.judged(record.every)))


def tasks(site):
    return [functools.partial(write, site)]
