"""Writes a page for each formulation: its theory, supported physics, failures and speed."""
import functools
import math
import re
from dataclasses import dataclass

import markdown

from reports import answers, certificates, data, deviations, mathml, verdicts
from reports.answers import LEVELS
from reports.case import page_of
from reports.figures.chart import Chart
from reports.site import ROOT, file_of
from reports.verdicts import SEVERITY, UNJUDGED, worst

DISPLAY = re.compile(r"\$\$(.+?)\$\$", re.S)
INLINE = re.compile(r"\$([^$\n]+?)\$")


def rendered(text):
    equations = []

    def keep(found, display):
        equations.append(mathml.convert(found.group(1), display))
        return f"EQUATION{len(equations) - 1}E"

    text = DISPLAY.sub(lambda found: keep(found, True), text)
    text = INLINE.sub(lambda found: keep(found, False), text)
    page = markdown.markdown(text, extensions=["tables"])
    # punctuation that follows an equation without a space stays on the line of the equation
    page = re.sub(r"(EQUATION\d+E)([.,;:)]+)(?!<)", r'<span class="whole">\1\2</span>', page)
    return re.sub(r"EQUATION(\d+)E", lambda found: equations[int(found.group(1))], page)


def sections(text):
    parts = re.split(r"^## (.+)$", text, flags=re.M)[1:]
    return [(h.strip(), body.strip()) for h, body in zip(parts[::2], parts[1::2])]


def linked(page, pages):
    """Returns the page with names of cases and formulations replaced by links. `pages` is {name: file}."""

    def link(found):
        name = found.group(1)
        return f'<a href="{pages[name]}">{name}</a>' if name in pages else found.group(0)

    return re.sub(r"<code>(\w+)</code>", link, page)


def explanation_of(name, pages):
    """Returns [(heading, HTML)] of the description of a formulation, or [] if there is none."""
    path = ROOT / "elements" / f"{name}.md"
    if not path.is_file():
        return []
    return [(h, linked(rendered(body), pages))
            for h, body in sections(path.read_text(encoding="utf-8"))]


FLOOR = 1e-12  # errors below this value are drawn at this value
TITLES = ("least", "largest")
WRONG_LIMITS = ("wrong limit", "wrong limit, as predicted")
GREY = {"back": True, "color": "currentColor", "alpha": 0.25, "linewidth": 1}


def curve(series, quantity):
    """Returns [(elements, magnitude of the error, at least FLOOR)] of the meshes with an error."""
    return [(m.n, max(abs(m.errors[quantity]), FLOOR)) for m in series.meshes
            if math.isfinite(m.errors.get(quantity, math.nan))]


def candidates(found):
    """Returns [(error of the finest mesh, case, quantity, (case, point, series))] in ascending order. The quantities of
    a case are the first one with a reference value and those with a wrong limit. Series with fewer than three errors
    are omitted."""
    out = []
    for case, point, series in found:
        names = answers.judged(point)[:1]
        names += [v.quantity for v in series.verdicts if v.verdict in WRONG_LIMITS]
        for name in dict.fromkeys(names) if not series.missing and not series.other else ():
            points = curve(series, name)
            if len(points) >= 3:
                out.append((points[-1][1], case.name, name, (case, point, series)))
    return sorted(out, key=lambda item: item[:3])


def extremes(found):
    known = candidates(found)
    chosen = {known[i][:3]: (*known[i][3], known[i][2]) for i in (0, -1)} if known else {}
    return list(chosen.values())


def draw_extremes(site, key, items, name):
    """Draws the error curve of each item in a panel. Curves of other formulations are grey."""
    chart = Chart(2, (380, 230))
    for (case, point, series, quantity), title in zip(items, TITLES):
        one = chart.panel(f"{title}: {case.name}, {quantity}", "elements per member",
                          "relative error", whole=True)
        for other in point.series:
            skipped = other.missing or other.other or other.key == key
            points = [] if skipped else curve(other, quantity)
            if points and ":" not in other.key:
                one.plot(*zip(*points), **GREY)
        own = curve(series, quantity)
        errors = {m.n: m.errors[quantity] for m in series.meshes if quantity in m.errors}
        look = site.points(key, ("n", "error"), [(n, errors[n]) for n, _ in own], case.name)
        one.plot(*zip(*own), **{**look, "linewidth": 2})
    return chart.image(site, name)


NAVIGATION = [("cases.html", "all cases"), ("formulations.html", "all formulations")]
CHOICE = "When to choose it"
ANALYSES = ("statics", "vibration", "buckling")
WRONG = ("wrong limit, as predicted", "wrong limit", "refused", "diverged")


def split(key):
    name, _, options = key.partition(":")
    return name, options


def options_of(declared):
    """Returns [(name, choices, default, summary)] from a row of /declarations."""
    return [tuple(line.split("\t")) for line in declared["options"].split("\n") if line]


def example(name, choices):
    for option, values, default, _ in choices:
        other = next((v for v in values.split("|") if v != default), None)
        if other and "|" in values:
            return f"{name}:{option}={other}"
    return name


def standing(series):
    """Returns the worst verdict of a series, or None if there is no verdict."""
    judged = [v for v in series.verdicts if v.verdict not in UNJUDGED]
    return worst(judged) if judged and not series.missing else None


def defaults(cases, key):
    return [(c, c.points[0], s) for c in cases for s in c.points[0].series if s.key == key]


def rules(rows, known, titles):
    found = {}
    for row in rows:
        if row.verdict.finding:
            found.setdefault(row.verdict.finding, []).append(row)
    out = []
    for rule in known:
        own = found.get(rule["rule"])
        if own:
            counted = [verdicts.TallyRow(r.case, r.parameters, r.formulation, r.verdict,
                                         verdicts.OWN) for r in own]
            out.append({**deviations.line(rule, counted, titles),
                        "where": sorted({r.case for r in own})})
    return out


def lacking(found, attribute):
    """Returns [(unsupported physics, cases)]. `attribute` is `missing` if the formulation is not run on these cases,
    or `other` if it solves another model on them."""
    lacks = {}
    for case, _, series in found:
        if getattr(series, attribute):
            lacks.setdefault(getattr(series, attribute), []).append(case.name)
    return sorted(lacks.items(), key=lambda item: (-len(item[1]), item[0]))


def median(values):
    ordered = sorted(values)
    return ordered[len(ordered) // 2] if ordered else None


def all_ways(cases):
    return {(c.name, level): answers.answer(c.points[0], answers.ALL, level)
            for c in cases for level in LEVELS}


def speed(found, key, known):
    """Returns [(level, posed, ranked, doubtful, first, rank, factor)]. `posed` is the number of cases that this
    formulation supports and in which a formulation that passes reaches the level. `ranked` and `doubtful` are the
    numbers of these cases in which this formulation reaches the level and passes, and reaches it but does not pass.
    `first` is [(case, elements)] of the cases in which it is the cheapest or ties. `rank` and `factor` are the medians
    of its rank and of its cost relative to the cheapest."""
    out = []
    for level in LEVELS:
        posed, doubtful, first, factors, ranks = 0, 0, [], [], []
        for case, _, series in found:
            answer = known[case.name, level]
            if series.missing or not answer.best:
                continue
            posed += 1
            doubtful += any(w.key == key for w in answer.defective)
            for own, rank, _ in answer.ways:
                if own.key == key and rank:
                    ranks.append(1 if own in answer.best else rank)
                    factors.append(own.cost / answer.best[0].cost)
                    first += [(case.name, own.n)] if own in answer.best else []
        out.append((level, posed, len(ranks), doubtful, first, median(ranks), median(factors)))
    return out


def table(found):
    """Returns [(case, number of points with verdicts, [(verdict, number)], worst verdict, its page, its point)] of the
    cases with verdicts. The last three entries are None if all verdicts are passes."""
    cases = {}
    for case, point, series in found:
        shown = [] if series.missing else [v for v in series.verdicts if v.verdict not in UNJUDGED]
        if shown:
            cases.setdefault(case.name, (case, []))[1].append((point, shown))
    out = []
    for case, points in cases.values():
        seen, of = {}, {}
        for point, shown in points:
            for v in shown:
                seen[v.verdict] = seen.get(v.verdict, 0) + 1
                of[id(v)] = point
        v = worst([v for _, shown in points for v in shown])
        point = of[id(v)]
        where = (v, page_of(case, case.points.index(point)), point)
        counts = sorted(seen.items(), key=lambda item: -SEVERITY[item[0]])
        out.append((case, len(points), counts, *(where if v.verdict != "pass" else (None,) * 3)))
    return out


@dataclass(frozen=True)
class Known:
    rows: list  # verdicts.TallyRow for every verdict
    rules: list  # entries of the list of known deviations
    declared: dict  # formulation -> row of /declarations
    ways: dict  # result of all_ways()
    titles: list  # titles of the sections of the errata
    certified: set  # names of the formulations with an element report


def gather(site):
    return Known(list(verdicts.rows(site.cases)), data.read_rules(site.truths),
                 data.read_declarations(site.results), all_ways(site.cases), deviations.headings(),
                 certificates.names(site))


def pages_of(site):
    pages = {c.name: f"{c.name}.html" for c in site.cases}
    return {**pages, **{key: f"{file_of(key)}.html" for key in site.styles.order}}


def contents(site, key, known):
    name, options = split(key)
    everywhere = [(c, p, s) for c in site.cases for p in c.points for s in p.series
                  if s.key == key]
    found = defaults(site.cases, key)
    own = [r for r in known.rows if r.formulation == key and r.standing != verdicts.ALIAS
           and r.verdict.verdict not in UNJUDGED]
    counts = {}
    for r in own:
        counts[r.verdict.verdict] = counts.get(r.verdict.verdict, 0) + 1
    series = everywhere[0][2]
    choices = options_of(known.declared[key]) if key in known.declared else []
    failing = [(c.name, standing(s)) for c, _, s in found]
    return {
        "key": key,
        "type": name,
        "options": options,
        "summary": series.summary,
        "source": series.source,
        "variants": [k for k in site.styles.order if k != key and split(k)[0] == name],
        "explanation": explanation_of(name, pages_of(site)),
        "declared": known.declared.get(key),
        "choices": choices,
        "example": example(name, choices),
        "analyses": ANALYSES,
        "choice": CHOICE,
        "certified": name in known.certified,
        "counts": sorted(counts.items(), key=lambda item: SEVERITY[item[0]]),
        "rules": rules(own, known.rules, known.titles),
        "wrong": [(c, v) for c, v in failing if v is not None and v.verdict in WRONG],
        "missing": lacking(found, "missing"),
        "others": lacking(found, "other"),
        "speed": (fast := speed(found, key, known.ways)),
        "posed": any(row[1] for row in fast),
        "table": table(everywhere),
    }


def write(site, key, known):
    context = contents(site, key, known)
    drawn = [] if context["options"] else extremes(defaults(site.cases, key))
    image = draw_extremes(site, key, drawn, f"{file_of(key)}_errors") if drawn else None
    site.write("formulation.html", f"{file_of(key)}.html", image=image,
               drawn=[(c.name, q) for c, _, _, q in drawn], **context)


def tasks(site):
    known, rows = gather(site), list(verdicts.rows(site.cases))
    return [functools.partial(write_cases, site, rows),
            functools.partial(write_formulations, site, rows),
            *(functools.partial(write, site, key, known) for key in site.styles.order)]



def counts(rows):
    """Returns [(verdict, number)] of the rows with a verdict, from bad to good. Aliases of quantities are not counted."""
    found = {}
    for row in rows:
        if row.standing != verdicts.ALIAS and row.verdict.verdict not in UNJUDGED:
            found[row.verdict.verdict] = found.get(row.verdict.verdict, 0) + 1
    return sorted(found.items(), key=lambda item: -SEVERITY[item[0]])


def grouped(rows, name):
    found = {}
    for row in rows:
        found.setdefault(getattr(row, name), []).append(row)
    return found


def wrong_in(cases, key):
    found = [(c.name, standing(s)) for c in cases for s in c.points[0].series if s.key == key]
    return [name for name, v in found if v is not None and v.verdict in WRONG]


def write_cases(site, rows):
    of_case = grouped(rows, "case")
    site.write("cases.html", "cases.html",
               cases=[(c, len(c.points), len({s.key for p in c.points for s in p.series
                                              if not s.missing}),
                       counts(of_case.get(c.name, []))) for c in site.cases])


def write_formulations(site, rows):
    of_key = grouped(rows, "formulation")
    summary = {s.key: s.summary for c in site.cases for p in c.points for s in p.series}
    found = [(key, summary[key], counts(of_key.get(key, [])), wrong_in(site.cases, key))
             for key in site.styles.order]
    site.write("formulations.html", "formulations.html",
               plain=[row for row in found if ":" not in row[0]],
               variants=[row for row in found if ":" in row[0]], file_of=file_of)
