"""The answers at the reader's own tolerance, and the tables to take away."""
import functools
import json
import math
import os

from markupsafe import Markup

from reports import answers, answers_table
from reports.site import LEVELS

NAVIGATION = [("answers.html", "answers")]


def outward(value):
    """Six digits, none of them less than the value: a mesh is not within what it is not."""
    if not math.isfinite(value):
        return None
    near = float(f"{value:.6g}")
    if near >= value:
        return near
    return float(f"{near + 10**(math.floor(math.log10(value)) - 5):.6g}")


def staying(series, quantities):
    """For each mesh the largest error of it and all finer ones; None where one has no value."""
    out, worst = [], 0.0
    for mesh in reversed(series.meshes):
        worst = max([worst, *(abs(mesh.errors.get(q, math.nan)) for q in quantities)],
                    key=lambda e: math.inf if math.isnan(e) else e)
        worst = math.inf if math.isnan(worst) else worst
        out.append(outward(worst))
    return out[::-1]


def points_of(case, keys):
    """What the script of the page needs of a case at its defaults: for each formulation its meshes
    with cost and time, for each quantity asked the error that each stays within."""
    point, meshes, asked = case.points[0], {}, []
    for series in point.series:
        if series.meshes:
            meshes[keys.index(series.key)] = [[m.n for m in series.meshes],
                                              [answers_table.short(m.cost) for m in series.meshes],
                                              [short_seconds(m.clock.least) for m in series.meshes],
                                              [short_seconds(m.clock.most) if m.clock.repeats > 1
                                               else None for m in series.meshes]]
    for quantity in answers_table.asked(point):
        names = answers.judged(point) if quantity == answers.ALL else [quantity]
        found = []
        for series in point.series:
            verdicts = answers.verdicts_on(series, names)
            if verdicts and series.meshes and not answers.repeats(point, series, names):
                found.append([keys.index(series.key), defect_of(verdicts),
                              staying(series, names)])
        asked.append([quantity, found])
    words = {keys.index(s.key): s.unranked or answers.NO_COSTS for s in point.series
             if s.unranked or not any(math.isfinite(m.cost) for m in s.meshes)}
    return {"case": case.name, "meshes": meshes, "asked": asked, "noise": point.noise,
            "unranked": words}


def short_seconds(value):
    return float(f"{value:.4g}") if math.isfinite(value) else None


def defect_of(verdicts):
    """In words; empty where all pass."""
    bad = [v for v in verdicts if v.verdict not in answers.SOUND]
    return answers.words_of(answers.words.worst(bad)) if bad else ""


def embedded(value):
    """JSON that may stand in a page: no end of a script, no comment."""
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    return Markup(text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e"))


def write(site):
    cases = [c for c in site.cases if answers.judged(c.points[0])]
    keys = sorted({s.key for c in cases for s in c.points[0].series})
    table = [(c.name, quantity, [answers_table.sentence(answers.answer(c.points[0], quantity, level))
                                 for level in LEVELS])
             for c in cases for quantity in answers_table.asked(c.points[0])[:1]]
    unpriced = sorted({s.key for c in cases for s in c.points[0].series
                       for m in s.meshes if not m.priced and not s.unranked})
    site.write("answers.html", "answers.html", table=table, unpriced=unpriced, timed=site.bench is not None,
               points=embedded({"keys": keys, "cases": [points_of(c, keys) for c in cases]}))
    found = answers_table.rows(site.cases)
    first = {c.name: answers_table.asked(c.points[0])[:1] for c in cases}
    together = [row for row in found if row["quantity"] in first[row["case"]]]
    for name, text in (("answers.csv", answers_table.as_csv(together)),
                       ("answers.json", answers_table.as_json(found, site.about))):
        with open(os.path.join(site.folder, name), "w", encoding="utf-8") as out:
            out.write(text)


def tasks(site):
    return [functools.partial(write, site)]
