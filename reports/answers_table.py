"""Writes the answers as a table: CSV, JSON, or text for a terminal.

    python -m reports.answers_table RESULTS [--error 0.3%] [--format text|csv|json] [-k WORDS] [-o FILE]

CSV and JSON contain an entry for each formulation within the tolerance. Formulations with a rank come first, sorted by
the cost of counted work. Rank 0 means that the formulation does not pass or has no rank. In the latter case, `unranked`
gives the reason.
"""
import argparse
import csv
import functools
import io
import json
import math
import os
import sys

from reports import answers, data
from reports.answers import LEVELS
from reports.answers import LEVELS

COLUMNS = ("case", "parameters", "quantity", "tolerance", "formulation", "n", "cost", "seconds",
           "error", "rank", "tie", "defect", "priced", "unranked")
UNITS = {"cost": "s", "seconds": "s", "tolerance": "1", "error": "1"}
ASKED = 4  # number of leading columns that describe the request; the other columns describe an answer


def asked_of(point):
    names = answers.judged(point)
    return ([answers.ALL] if len(names) > 1 else []) + names


def short(value):
    return float(f"{value:.3g}") if math.isfinite(value) else None


def rows(cases, levels=LEVELS, everywhere=False):
    """Returns the rows [{column: value}] at the defaults or, if `everywhere` is True, at all parameter points."""
    out = []
    for case in cases:
        for point in case.points if everywhere else case.points[:1]:
            for quantity in asked_of(point):
                for level in levels:
                    for w, rank, tie in answers.answer(point, quantity, level).ways:
                        defect = w.worst.verdict if w.defects else ""
                        out.append(dict(zip(COLUMNS, (
                            case.name, point.parameters, quantity, level, w.key, w.n, short(w.cost),
                            short(w.seconds), short(w.error), rank, int(tie), defect,
                            int(w.priced), w.unranked))))
    return out


def as_csv(found):
    out = io.StringIO()
    table = csv.DictWriter(out, COLUMNS, lineterminator="\n")
    table.writeheader()
    table.writerows(found)
    return out.getvalue()


def as_json(found, about):
    """Returns one JSON object: the run, the names and units of the columns, and an entry for each request. An entry
    contains the case, the parameters, the quantity, the tolerance and the answers. Each answer is a list that begins
    with the index of its formulation."""
    keys = sorted({row["formulation"] for row in found})
    head = {"commit": about.get("commit", ""), "clock": about.get("clock", ""),
            "asked": COLUMNS[:ASKED], "columns": COLUMNS[ASKED:], "units": UNITS,
            "formulations": keys}
    index, lines = {key: i for i, key in enumerate(keys)}, {}
    for row in found:
        question, answer = list(row.values())[:ASKED], list(row.values())[ASKED:]
        lines.setdefault(tuple(question), []).append([index[answer[0]], *answer[1:]])
    text = ",\n".join(json.dumps([*asked_of, ways], separators=(",", ":"))
                      for asked_of, ways in lines.items())
    return f'{json.dumps(head)[:-1]}, "answers": [\n{text}\n]}}\n'


def sentence(answer):
    def told(ways):
        return ", ".join(f"{w.key} n = {w.n}" for w in ways)

    out = told(answer.best) or ("" if answer.unranked else "not reached by a formulation that passes")
    if len(answer.best) > 1:
        out += ": costs tie"
    for words in sorted({w.unranked for w in answer.unranked}):
        ways = [w for w in answer.unranked if w.unranked == words]
        out += ("; also " if out else "") + (f"within {100 * answer.level:g} %, no rank ({words}): "
                                             f"{told(ways)}")
    by_words = {}
    for w in answer.defective:
        by_words.setdefault(answers.defect_words(w), []).append(w)
    for words, ways in by_words.items():
        out += f"; also within {100 * answer.level:g} %, {words}: {told(ways)}"
    if answer.faster:
        out += f"; higher counted cost, but faster in every round: {told(answer.faster)}"
    return out


def as_text(cases, levels, everywhere=False):
    out = []
    for case in cases:
        for point in case.points if everywhere else case.points[:1]:
            for quantity in asked_of(point):
                for level in levels:
                    place = " ".join(part for part in (case.name, point.parameters, quantity)
                                     if part)
                    found = answers.answer(point, quantity, level)
                    out.append(f"{place}, {100 * level:g} %: {sentence(found)}\n")
    return "".join(out)


def tolerance(text):
    value = float(text[:-1]) / 100 if text.endswith("%") else float(text)
    if not 0 < value < 1:
        raise argparse.ArgumentTypeError(f"'{text}': give an error such as 0.3% or 0.003")
    return float(f"{value:.15g}")


def main():
    arguments = argparse.ArgumentParser(
        prog="python -m reports.answers_table",
        description="Prints the formulation with the lowest cost within an error, and its number of elements.")
    arguments.add_argument("results", help="results of verify")
    arguments.add_argument("--error", type=tolerance, action="append",
                           help="0.3%% or 0.003; may be repeated (10, 1, 0.1, 0.01%%)")
    arguments.add_argument("--format", choices=("text", "csv", "json"), default="text")
    arguments.add_argument("--all-points", action="store_true", help="all parameter points, not only the defaults")
    arguments.add_argument("-k", "--case", action="append", help="only this case; may be repeated")
    arguments.add_argument("-o", "--output", type=argparse.FileType("w"), default=sys.stdout)
    r = arguments.parse_args()
    try:
        about, cases = data.read_results(r.results)
    except data.Unreadable as why:
        sys.exit(str(why))
    cases = [c for c in cases if not r.case or c.name in r.case]
    levels = r.error or LEVELS
    if r.format == "text":
        r.output.write(as_text(cases, levels, r.all_points))
    else:
        found = rows(cases, levels, r.all_points)
        r.output.write(as_csv(found) if r.format == "csv" else as_json(found, about))


if __name__ == "__main__":
    main()


NAVIGATION = [("answers.html", "answers")]


def outward(value):
    """Returns an error rounded up to six digits, so that no mesh appears more accurate than it is. Returns None for an
    error that is not finite."""
    if not math.isfinite(value):
        return None
    near = float(f"{value:.6g}")
    if near >= value:
        return near
    return float(f"{near + 10**(math.floor(math.log10(value)) - 5):.6g}")


def staying(series, quantities):
    out, worst = [], 0.0
    for mesh in reversed(series.meshes):
        worst = max([worst, *(abs(mesh.errors.get(q, math.nan)) for q in quantities)],
                    key=lambda e: math.inf if math.isnan(e) else e)
        worst = math.inf if math.isnan(worst) else worst
        out.append(outward(worst))
    return out[::-1]


def points_of(case, keys):
    """Returns the data of a case at its default parameters for the script of the page. `meshes` contains the meshes of
    each formulation, with cost and time. For each requested quantity and formulation, `asked` contains the worst
    verdict and, for each mesh, the largest error of this mesh and of all finer meshes."""
    point, meshes, asked = case.points[0], {}, []
    for series in point.series:
        if series.meshes:
            meshes[keys.index(series.key)] = [[m.n for m in series.meshes],
                                              [short(m.cost) for m in series.meshes],
                                              [short_seconds(m.clock.least) for m in series.meshes],
                                              [short_seconds(m.clock.most) if m.clock.repeats > 1
                                               else None for m in series.meshes]]
    for quantity in asked_of(point):
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
    bad = [v for v in verdicts if v.verdict not in answers.SOUND]
    return answers.words_of(answers.words.worst(bad)) if bad else ""


def write(site):
    cases = [c for c in site.cases if answers.judged(c.points[0])]
    keys = sorted({s.key for c in cases for s in c.points[0].series})
    table = [(c.name, quantity, [sentence(answers.answer(c.points[0], quantity, level))
                                 for level in LEVELS])
             for c in cases for quantity in asked_of(c.points[0])[:1]]
    unpriced = sorted({s.key for c in cases for s in c.points[0].series
                       for m in s.meshes if not m.priced and not s.unranked})
    site.write("answers.html", "answers.html", table=table, unpriced=unpriced, timed=site.bench is not None)
    points = json.dumps({"keys": keys, "cases": [points_of(c, keys) for c in cases]}, separators=(",", ":"),
                        allow_nan=False)
    found = rows(site.cases)
    first = {c.name: asked_of(c.points[0])[:1] for c in cases}
    together = [row for row in found if row["quantity"] in first[row["case"]]]
    for name, text in (("answers.csv", as_csv(together)),
                       ("answers.json", as_json(found, site.about)),
                       ("answers_points.js", f"window.answersPoints = {points};\n")):
        with open(os.path.join(site.folder, name), "w", encoding="utf-8") as out:
            out.write(text)


def tasks(site):
    return [functools.partial(write, site)]
