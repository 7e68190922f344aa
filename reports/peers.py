"""Formulations and other programs on the same cases: diagrams on the pages of the cases, and a page over all cases."""
import functools
import math

from markupsafe import Markup, escape

from reports import answers, peers_data, profiles
from reports.figures import plots, style
from reports.figures.chart import Chart
from reports.peers_data import LEVELS, ranking

NAVIGATION = [("peers.html", "other programs")]
PALETTE = ("#7a5195", "#c2571a", "#2f7d6d", "#b5487d", "#5f7f1f", "#a0522d", "#4666b0", "#8a6d00", "#6b6b6b")
MARKERS = "sDv^<>phH"
DRAWN, SHOWN, FARTHEST = 4, 6, 100  # quantities with a diagram; rows of a table; largest factor of profiles
COARSE, FINE = 0.1, 1e-8  # largest error for which a curve counts as fastest; smallest error drawn


def found(site):
    """Returns the recorded comparisons, which are read once."""
    if not hasattr(site, "peer_records"):
        site.peer_records = peers_data.records(getattr(site, "peers", ()))
    return site.peer_records


def present(site):
    return bool(found(site))


def look_of(site, series, programs):
    """Returns the style of a curve: that of the formulation, or the colour of the program with a hollow marker."""
    if series["ours"]:
        return site.styles.of(series["name"])
    program = peers_data.program_of(series)
    own = [name for name in programs if name.startswith(program + ", ")]
    every = list(dict.fromkeys(name.split(", ")[0] for name in programs))
    return {"color": PALETTE[every.index(program) % len(PALETTE)], "marker": MARKERS[own.index(series["name"]) % len(MARKERS)],
            "hollow": True, "linestyle": (0, (3, 2)), "linewidth": 1, "markersize": 6, "gid": f"f|{series['name']}"}


def on_front(curves):
    """Returns the names of the curves with points on their common front, those with most points first."""
    named = [name for _, _, name in peers_data.front([(s, [p for p in points if p[1] <= COARSE]) for s, points in curves])]
    return sorted(dict.fromkeys(named), key=lambda name: -named.count(name))


def telling(curves):
    """Returns the curves to be drawn, at most style.MOST: the fastest element of each program, and as many of the fastest
    formulations as there is room for."""
    ours = on_front([c for c in curves if c[0]["ours"]])
    programs = dict.fromkeys(peers_data.program_of(s) for s, _ in curves if not s["ours"])
    best = [on_front(own)[:1] or [own[0][0]["name"]] for own in
            ([c for c in curves if peers_data.program_of(c[0]) == program] for program in programs)]
    fastest = {s["name"]: min(t for t, _, _ in points) for s, points in curves}
    theirs = sorted((one[0] for one in best), key=fastest.get)[:style.MOST - min(2, len(ours))]
    drawn = {*theirs, *ours[:style.MOST - len(theirs)]}
    return [c for c in curves if c[0]["name"] in drawn]


def figure_of(site, record, quantity, name):
    """Draws errors against times of formulations and peers, with the Pareto front of all of them."""
    all_ = peers_data.curves(record, quantity)
    programs = [s["name"] for s in record["series"] if not s["ours"]]
    chart = Chart(1, (560, 330))
    panel = chart.panel("", f"time of the solution, relative to {record['unit']['name']}, n = {record['unit']['elements']}",
                        f"relative error of {quantity['name']}")
    best = peers_data.front(all_)
    if len(best) > 1:
        xs, ys = [best[0][0]], [best[0][1]]
        for t, e, _ in best[1:]:
            xs += [t, t]
            ys += [ys[-1], e]
        panel.plot(xs, [max(y, FINE) for y in ys], back=True, color="currentColor", linewidth=6, alpha=0.16)
    for series, points in telling(all_):
        rows = [(run["elements"], run["unknowns"], ranking.systems_of(run, quantity["analysis"]), e, t) for t, e, run in points]
        told = site.points(series["name"], ("n", "unknowns", "systems", "error", "relative time"), rows, quantity["name"])
        look = {**look_of(site, series, programs), "gid": told["gid"]}
        panel.plot([t for t, _, _ in points], [max(e, FINE) for _, e, _ in points], label=series["name"], **look)
    for level in LEVELS:
        panel.level(level)
    return chart.image(site, name)


MOST_BESIDE = 5  # number of programs in the figure of error against run time


def scale_of(point, record, quantity):
    """Returns the factor from times of a record to those, or costs, of a point: both contain the run of beamwork that is
    the unit of the record. Returns NaN if the point does not contain this run."""
    unit, measure = record["unit"], answers.measure_of(point).of
    runs = [run for s in record["series"] if s["ours"] and s["name"] == unit["name"] for run in s["runs"]
            if run["elements"] == unit["elements"]]
    own = [measure(m) for s in point.series if s.key == unit["name"] for m in s.meshes if m.n == unit["elements"]]
    return own[0] / ranking.time_of(runs[0], quantity["analysis"]) if runs and own else math.nan


def beside(site, case, point, name):
    """Returns [plots.Beside]: the fastest element of each recorded program for a quantity of a point, at most MOST_BESIDE."""
    record = next((r for r in found(site) if (r["case"], r["parameters"]) == (case.name, point.parameters)), None)
    quantity = next((q for q in peers_data.known(record) if q["name"] == name), None) if record else None
    scale = scale_of(point, record, quantity) if quantity else math.nan
    if not math.isfinite(scale):
        return []
    theirs = [c for c in telling(peers_data.curves(record, quantity)) if not c[0]["ours"]][:MOST_BESIDE]
    programs = [s["name"] for s in record["series"] if not s["ours"]]
    words = "time [s]" if answers.measure_of(point).name == "time" else "cost [s]"
    return [plots.Beside(series["name"], [(t * scale, e, (run["elements"], e, float(f"{t * scale:.3g}"), run["unknowns"],
                                                          "recorded, converted to this axis")) for t, e, run in points],
                         ("n", "error", words, "unknowns", "time"), look_of(site, series, programs))
            for series, points in theirs]


def rows_of(record, quantity):
    """Returns [(level, ranking, rows shown)]: the fastest rows, the best row of beamwork and that of each program."""
    out = []
    for level in LEVELS:
        ranked, firsts, shown = ranking.rank(record, quantity, level), set(), []
        for i, row in enumerate(ranked["rows"]):
            program = peers_data.program_of(row)
            if i < SHOWN or program not in firsts:
                shown.append((i + 1, row))
            firsts.add(program)
        out.append((level, ranked, shown))
    return out


def parts_of(site, case, record, index):
    """Returns one part for each drawn quantity, with its figure and its ranking."""
    quantities = peers_data.known(record)[:DRAWN]
    return [{"quantity": q, "image": figure_of(site, record, q, f"{case.name}_peers_{index}_{q['name']}"),
             "rows": rows_of(record, q)} for q in quantities]


def section(site, case):
    """Returns the sections on the page of a case: one for each recorded comparison."""
    own = [r for r in found(site) if r["case"] == case.name]
    template = site.templates.get_template("peers_case.html") if own else None
    out = []
    for index, record in enumerate(own):
        markup = template.render(self_name=f"{case.name}.html", record=record, parts=parts_of(site, case, record, index),
                                 outcomes=[o for o in peers_data.outcomes(record) if o[1]],
                                 more=len(peers_data.known(record)) - DRAWN)
        out.append(("Other programs" + (f" ({record['parameters']})" if record["parameters"] else ""), Markup(markup)))
    return out


def profile_of(site, records, level):
    """Draws the share of the problems that each program solves within a factor of the fastest. Returns (Image, {name: share
    solved at any time})."""
    at, every = profiles.places(FARTHEST), peers_data.factors(records, level)
    chart = Chart(1, (300, 210))
    panel = chart.panel("", "time relative to the fastest", "share of problems")
    panel.x = profiles.factors(FARTHEST)
    panel.y = profiles.Fixed(False, (0, 1), [(i / 5, f"{20 * i} %") for i in range(6)])
    solved = {}
    names = [name for name in every if not any(s["ours"] and s["name"] == name for r in records for s in r["series"])]
    for i, name in enumerate(names):
        shares = profiles.shares(every[name], at)
        solved[name] = shares[-1]
        ours = name == "beamwork"
        look = {"color": "currentColor" if ours else PALETTE[i % len(PALETTE)], "linewidth": 2.4 if ours else 1.3,
                "gid": f"f|{name}"}
        if shares[-2] > 0:  # solves a problem within the largest factor; the table contains all programs
            panel.plot(*profiles.stairs(at, shares[:-1]), label=name, **look)
    return chart.image(site, f"peers_profile_{100 * level:g}"), solved


def winners(record):
    """Returns [(quantity, [(level, first row or None, other row or None)])]. The other row is the best one of the other
    programs if the first is a formulation, and the best formulation otherwise."""
    out = []
    for q in peers_data.known(record)[:DRAWN]:
        cells = []
        for level in LEVELS:
            rows = [r for r in ranking.rank(record, q, level)["rows"] if math.isfinite(r["time"]) and not r["unranked"]]
            first = rows[0] if rows else None
            other = next((r for r in rows if r["ours"] != first["ours"]), None) if first else None
            cells.append((level, first, other))
        out.append((q, cells))
    return out


def write(site):
    records = found(site)
    figures = [(level, *profile_of(site, records, level)) for level in LEVELS]
    everyone = sorted({s["name"] for r in records for s in r["series"] if not s["ours"]})
    versions = {s["name"]: s["version"] for r in records for s in r["series"] if not s["ours"] and s["version"]}
    outcome = {(r["case"], r["parameters"], s["name"]): why for r in records for s, why in peers_data.outcomes(r)}
    site.write("peers.html", "peers.html", records=records, figures=figures, ahead=peers_data.ahead(records), winners=winners,
               everyone=everyone, versions=versions, outcome=outcome, features=peers_data.features(), escape=escape,
               pages={c.name for c in site.cases}, known=peers_data.known, drawn=DRAWN)


def tasks(site):
    return [functools.partial(write, site)]
