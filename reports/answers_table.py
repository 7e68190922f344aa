"""The answers as a table to take away: CSV, JSON, or text for a terminal.

    python -m reports.answers_table RESULTS [--error 0.3%] [--format text|csv|json] [-k WORDS] [-o FILE]

A row for each formulation that is within the tolerance, in the order of its counted work; rank 0:
its verdict is not a pass, or its costs rank nothing (`unranked` says why), so that it has no place
in that order.
"""
import argparse
import csv
import io
import json
import math
import sys

from reports import answers, data

COLUMNS = ("case", "parameters", "quantity", "tolerance", "formulation", "n", "cost", "seconds",
           "error", "rank", "tie", "defect", "priced", "unranked")
UNITS = {"cost": "s", "seconds": "s", "tolerance": "1", "error": "1"}
LEVELS = tuple(data.REACH)
ASKED = 4  # columns that say what is asked; the others are of each answer


def asked(point):
    """What is asked of a point: all quantities together, where there are several, and each."""
    names = answers.judged(point)
    return ([answers.ALL] if len(names) > 1 else []) + names


def short(value):
    """A number with the digits that are worth keeping; None where there is none."""
    return float(f"{value:.3g}") if math.isfinite(value) else None


def rows(cases, levels=LEVELS, everywhere=False):
    """[{column: value}]; everywhere: at all parameter points, else at the defaults."""
    out = []
    for case in cases:
        for point in case.points if everywhere else case.points[:1]:
            for quantity in asked(point):
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
    """One object: what was run, names and units of the columns, and a line for each question:
    case, parameters, quantity, tolerance, then its answers as lists, each beginning with the
    index of its formulation."""
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
    """An answer in words: the cheapest, who ties with it, who is wrong there."""
    def told(ways):
        return ", ".join(f"{w.key} n = {w.n}" for w in ways)

    out = told(answer.best) or ("" if answer.unranked else "not reached by one that passes")
    if len(answer.best) > 1:
        out += ": within noise of each other"
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
        out += f"; more expensive by its counts, measured faster in every round: {told(answer.faster)}"
    return out


def as_text(cases, levels, everywhere=False):
    out = []
    for case in cases:
        for point in case.points if everywhere else case.points[:1]:
            for quantity in asked(point):
                for level in levels:
                    place = " ".join(part for part in (case.name, point.parameters, quantity)
                                     if part)
                    found = answers.answer(point, quantity, level)
                    out.append(f"{place}, {100 * level:g} %: {sentence(found)}\n")
    return "".join(out)


def tolerance(text):
    """0.3% or 0.003, as a part of the value."""
    value = float(text[:-1]) / 100 if text.endswith("%") else float(text)
    if not 0 < value < 1:
        raise argparse.ArgumentTypeError(f"'{text}': give an error such as 0.3% or 0.003")
    return float(f"{value:.15g}")


def main():
    arguments = argparse.ArgumentParser(
        prog="python -m reports.answers_table",
        description="Which formulation, with how many elements, is within an error at least cost.")
    arguments.add_argument("results", help="as verify writes it")
    arguments.add_argument("--error", type=tolerance, action="append",
                           help="0.3%% or 0.003; may be repeated (10, 1, 0.1, 0.01%%)")
    arguments.add_argument("--format", choices=("text", "csv", "json"), default="text")
    arguments.add_argument("--all-points", action="store_true", help="not only the defaults")
    arguments.add_argument("-k", "--case", action="append", help="this case only; may be repeated")
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
