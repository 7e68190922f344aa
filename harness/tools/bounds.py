#!/usr/bin/python3
"""For each known deviation: the allowed error, the observed error, and the agreement with derived limits.

usage: bounds.py VERIFY_JSON FINDINGS_CSV [--loose]

The largest_error of an entry is the smallest of 1, 2 and 5 times a power of ten that no error of its verdicts exceeds.
Errors are distances from the derived limit if there is one, otherwise from the reference value, relative to the
reference value. largest_error is empty if no verdict has an error. If a verdict has no derived limit, largest_error is
the smallest of 1, 1.5, 2, 3, 4, 5 and 7 times a power of ten.  The exit status is 1 if the list of known deviations
contains another value. A bound is loose if it is more than ten times the errors with a derived limit, or more than 1.5
times those without one; --loose prints only this.  The digits are those of the limit that is
farthest from its prediction, on the meshes of the verdict.
"""
import argparse
import csv
import json
import math

PREDICTED = "wrong limit, as predicted"
SURELY, KNOWN = 3, 1e-9  # uncertainties of a limit (study/verdict.c); relative uncertainty of a prediction
STEPS, FINE_STEPS = (1, 2, 5, 10), (1, 1.5, 2, 3, 4, 5, 7, 10)
LOOSE, FINE_LOOSE = 10, 1.5  # multiples of the observed error


def bound_of(seen, steps=STEPS):
    """Returns the smallest product of a step and a power of ten that is not below the value, as text for the list of
    known deviations."""
    if seen is None:
        return ""
    power = math.floor(math.log10(seen))
    text = next(f"{step}e{power}" for step in steps if float(f"{step}e{power}") >= seen)
    return "%g" % float(text)


def apart(verdict):
    return abs(verdict["limit"] / verdict["predicted"] - 1)


def departure(verdict):
    """Returns the distance of a limit from the derived limit or, if there is none, from the reference value. The
    distance is relative to the reference value. Returns None if there is no limit."""
    if verdict["predicted"] is None or not verdict["error"]:
        return verdict["error"] and abs(verdict["error"])
    size = (verdict["limit"] - verdict["truth"]) / verdict["error"]
    return abs((verdict["limit"] - verdict["predicted"]) / size)


def digits(verdicts):
    """Returns the smallest number of digits to which a confirmed prediction agrees with its limit, or None if no
    prediction is confirmed."""
    met = [apart(v) for v in verdicts if v["verdict"] == PREDICTED and v["predicted"]]
    return -math.log10(max(max(met), 1e-16)) if met else None


def line(rule, verdicts):
    derived, others = (
        max((departure(v) for v in verdicts if v["error"] is not None and (v["predicted"] is None) == free),
            default=None) for free in (False, True)
    )  # yapf: disable
    seen = max((one for one in (derived, others) if one is not None), default=None)
    allowed, bound = rule["largest_error"], bound_of(seen, STEPS if others is None else FINE_STEPS)
    stands = (allowed and float(allowed)) == (bound and float(bound))
    loose, apart = (
        size != "" and any(one is not None and float(size) > times * one
                           for one, times in ((derived, LOOSE), (others, FINE_LOOSE)))
        for size in (allowed, bound)
    )  # yapf: disable
    return {
        "rule": rule["rule"], "verdicts": len(verdicts), "seen": seen, "allowed": allowed,
        "bound": bound, "stands": stands and not loose, "loose": loose, "apart": apart,
        "least": min((one for one in (derived, others) if one is not None), default=None),
        "digits": digits(verdicts), "met": sum(
            v["verdict"] == PREDICTED for v in verdicts)
    }


def lines(rules, verdicts):
    of_rule = {rule["rule"]: [] for rule in rules}
    for v in verdicts:
        if v["finding"]:
            of_rule[v["finding"]].append(v)
    return [line(rule, of_rule[rule["rule"]]) for rule in rules]


def covered(verdicts):
    """Returns (number of limits whose distance from their prediction is at most three times the uncertainty of the
    limit plus that of the prediction, number of limits with a prediction) for all verdicts."""
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
    if one["apart"]:
        remark = "  some of its verdicts show at most %.2g and need a separate entry" % one["least"]
    return "%-26s %5d verdicts  seen %-9s allowed %-8s %s%s" % (one["rule"], one["verdicts"], seen,
                                                                one["allowed"], met, remark)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("verdicts")
    parser.add_argument("ledger")
    parser.add_argument("--loose", action="store_true")
    given = parser.parse_args()
    with open(given.verdicts, encoding="utf-8") as file:
        verdicts = json.load(file)["verdicts"]
    with open(given.ledger, newline="", encoding="utf-8") as file:
        found = lines(list(csv.DictReader(file)), verdicts)
    if given.loose:
        loose = [one for one in found if one["loose"]]
        for one in loose:
            print(f"bound of a finding is loose: {text_of(one)}")
        return 1 if loose else 0
    for one in found:
        print(text_of(one).rstrip())
    print("%d of %d limits lie within 3 U of their prediction" % covered(verdicts))
    return 0 if all(one["stands"] for one in found) else 1


if __name__ == "__main__":
    raise SystemExit(main())
