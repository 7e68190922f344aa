"""A page for each formulation: theory, what it offers, where it fails and why, how fast it is."""
import functools
from dataclasses import dataclass

from reports import answers, certificates, data, explanation, formulation_figures, ledger, tally
from reports.case import page_of
from reports.site import LEVELS, file_of
from reports.verdicts import SEVERITY, UNJUDGED, worst

NAVIGATION = []
CHOICE = "When to choose it"  # heading of a text, to which what is measured is added
ANALYSES = ("statics", "vibration", "buckling")
# Verdicts that say that more elements do not give the answer.
WRONG = ("wrong limit, as predicted", "wrong limit", "refused", "diverged")


def split(key):
    """(name, options) of a formulation's key."""
    name, _, options = key.partition(":")
    return name, options


def options_of(declared):
    """[(name, choices, default, summary)] from a row of /declarations."""
    return [tuple(line.split("\t")) for line in declared["options"].split("\n") if line]


def example(name, choices):
    """How one of the options is set to another than its default."""
    for option, values, default, _ in choices:
        other = next((v for v in values.split("|") if v != default), None)
        if other and "|" in values:
            return f"{name}:{option}={other}"
    return name


def standing(series):
    """The worst verdict of a series that is judged, or None."""
    judged = [v for v in series.verdicts if v.verdict not in UNJUDGED]
    return worst(judged) if judged and not series.missing else None


def defaults(cases, key):
    """[(case, point, series)] at the default parameters of every case that knows it."""
    return [(c, c.points[0], s) for c in cases for s in c.points[0].series if s.key == key]


def rules(rows, known, titles):
    """The rules of the ledger that were shown: their verdicts, worst one and cases."""
    found = {}
    for row in rows:
        if row.verdict.finding:
            found.setdefault(row.verdict.finding, []).append(row)
    out = []
    for rule in known:
        own = found.get(rule["rule"])
        if own:
            # What a kept misprint repeats counts here, on its own page.
            counted = [tally.Row(r.case, r.parameters, r.formulation, r.verdict, tally.OWN)
                       for r in own]
            out.append({**ledger.line(rule, counted, titles),
                        "where": sorted({r.case for r in own})})
    return out


def lacking(found, attribute):
    """[(what it lacks, cases)]: missing: it is not run on them; other: it solves another model."""
    lacks = {}
    for case, _, series in found:
        if getattr(series, attribute):
            lacks.setdefault(getattr(series, attribute), []).append(case.name)
    return sorted(lacks.items(), key=lambda item: (-len(item[1]), item[0]))


def median(values):
    ordered = sorted(values)
    return ordered[len(ordered) // 2] if ordered else None


def all_ways(cases):
    """{(case, level): answers.Answer for all judged quantities at the default parameters}."""
    return {(c.name, level): answers.answer(c.points[0], answers.ALL, level)
            for c in cases for level in LEVELS}


def speed(found, key, known):
    """For each level: cases that one reaches, that it reaches, those of them that it does not pass,
    where it is first, rank and cost by the first's in the median."""
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
    """[(case, judged parameter points, [(verdict, number)], worst verdict, its page, its point)]
    of what was judged; the three last are None where all is a pass."""
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
    """What all pages take from, found once."""

    rows: list  # tally.Row of every verdict
    rules: list  # of the ledger
    declared: dict  # formulation -> row of /declarations
    ways: dict  # all_ways
    titles: list  # of the errata
    certified: set  # names of those that have a certificate


def gather(site):
    return Known(list(tally.rows(site.cases)), data.read_rules(site.truths),
                 data.read_declarations(site.results), all_ways(site.cases), ledger.headings(),
                 certificates.names(site))


def pages_of(site):
    """{name: page} of cases and formulations, for words of the explanation that name one."""
    pages = {c.name: f"{c.name}.html" for c in site.cases}
    return {**pages, **{key: f"{file_of(key)}.html" for key in site.styles.order}}


def contents(site, key, known):
    """The context of a page."""
    name, options = split(key)
    everywhere = [(c, p, s) for c in site.cases for p in c.points for s in p.series
                  if s.key == key]
    found = defaults(site.cases, key)
    own = [r for r in known.rows if r.formulation == key and r.standing != tally.ALIAS
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
        "explanation": explanation.of(name, pages_of(site)),
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
    drawn = [] if context["options"] else formulation_figures.extremes(defaults(site.cases, key))
    image = formulation_figures.draw(site, key, drawn, f"{file_of(key)}_errors") if drawn else None
    site.write("formulation.html", f"{file_of(key)}.html", image=image,
               drawn=[(c.name, q) for c, _, _, q in drawn], **context)


def tasks(site):
    known = gather(site)
    return [functools.partial(write, site, key, known) for key in site.styles.order]
