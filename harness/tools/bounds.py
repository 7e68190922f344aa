#!/usr/bin/python3
"""What each rule of the ledger allows, beside what was seen, and how its predicted limits were met.

usage: bounds.py VERIFY_JSON FINDINGS_CSV

A rule's largest_error is the least of 1, 2 and 5 times a power of ten that no limit of its verdicts
exceeds: in its distance from the derived limit where there is one, else from the truth, relative to
the truth; empty where none of them has an error.  Status 1 where the ledger says anything else.  The
digits are those of the limit that is farthest from its prediction, on the meshes of the verdict.
"""
import argparse
import csv
import json
import math

PREDICTED = "wrong limit, as predicted"
SURELY, KNOWN = 3, 1e-9  # uncertainties of a limit (judge/verdict.c); relative one of a prediction
STEPS = (1, 2, 5, 10)


def bound_of(seen):
    """The least of 1, 2, 5 times a power of ten that is not below; as the ledger writes it."""
    if seen is None:
        return ""
    power = math.floor(math.log10(seen))
    text = next(f"{step}e{power}" for step in STEPS if float(f"{step}e{power}") >= seen)
    return "%g" % float(text)


def apart(verdict):
    """Of a limit from its prediction, relative."""
    return abs(verdict["limit"] / verdict["predicted"] - 1)


def departure(verdict):
    """Of a limit from the derived one, else from the truth, in parts of the truth; None: no limit."""
    if verdict["predicted"] is None or not verdict["error"]:
        return verdict["error"] and abs(verdict["error"])
    size = (verdict["limit"] - verdict["truth"]) / verdict["error"]
    return abs((verdict["limit"] - verdict["predicted"]) / size)


def digits(verdicts):
    """Digits that the worst of the met predictions has in common with its limit; None: no such."""
    met = [apart(v) for v in verdicts if v["verdict"] == PREDICTED and v["predicted"]]
    return -math.log10(max(max(met), 1e-16)) if met else None


def line(rule, verdicts):
    """What is said of a rule: its verdicts, errors and predictions, and whether its bound stands."""
    seen = max((departure(v) for v in verdicts if v["error"] is not None), default=None)
    allowed = rule["largest_error"]
    stands = (allowed and float(allowed)) == (bound_of(seen) and float(bound_of(seen)))
    return {
        "rule": rule["rule"], "verdicts": len(verdicts), "seen": seen, "allowed": allowed,
        "bound": bound_of(seen), "stands": stands, "digits": digits(verdicts), "met": sum(
            v["verdict"] == PREDICTED for v in verdicts)
    }


def lines(rules, verdicts):
    of_rule = {rule["rule"]: [] for rule in rules}
    for v in verdicts:
        if v["finding"]:
            of_rule[v["finding"]].append(v)
    return [line(rule, of_rule[rule["rule"]]) for rule in rules]


def covered(verdicts):
    """(limits that lie within what they and their predictions are known to, all with a prediction),
    whatever the verdict: what calling a limit predicted by its uncertainty alone rests on."""
    told = [v for v in verdicts if v["predicted"] is not None and v["limit"] is not None]
    near = [
        abs(v["limit"] - v["predicted"]) <= SURELY *
        (v["limit_uncertainty"] or 0) + KNOWN * abs(v["predicted"]) for v in told
    ]
    return sum(near), len(told)


def text_of(one):
    seen = "" if one["seen"] is None else "%.3g" % one["seen"]
    met = "" if one["digits"] is None else "%d met, %.1f digits" % (one["met"], one["digits"])
    remark = "" if one["stands"] else f"  should allow {one['bound'] or 'nothing'}"
    return "%-26s %5d verdicts  seen %-9s allowed %-8s %s%s" % (one["rule"], one["verdicts"], seen,
                                                                one["allowed"], met, remark)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("verdicts")
    parser.add_argument("ledger")
    given = parser.parse_args()
    with open(given.verdicts, encoding="utf-8") as file:
        verdicts = json.load(file)["verdicts"]
    with open(given.ledger, newline="", encoding="utf-8") as file:
        found = lines(list(csv.DictReader(file)), verdicts)
    for one in found:
        print(text_of(one).rstrip())
    print("%d of %d limits lie within 3 U of their prediction" % covered(verdicts))
    return 0 if all(one["stands"] for one in found) else 1


if __name__ == "__main__":
    raise SystemExit(main())
