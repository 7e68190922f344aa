"""What was found, in three sentences: of speed, of trust, of the truths. The template has words."""
import math

from reports import tally, trust

NAMED = 3  # cases that a sentence names


def ahead(values):
    """The formulations with the largest value, to a percent, and that value."""
    most = max(values.values())
    return sorted(k for k, v in values.items() if round(100 * v) == round(100 * most)), most


def of_speed(compared, rows):
    """Who is near the best most often, who solves most; None where nothing is compared."""
    if not compared.any:
        return None
    known = [r for r in rows if math.isfinite(r.solved)]
    near, near_share = ahead({r.key: r.near for r in known})
    most, most_share = ahead({r.key: r.solved for r in known})
    return {
        "problems": len(compared.problems),
        "cases": compared.cases,
        "near": near,
        "near_share": near_share,
        "most": most,
        "most_share": most_share,
        "most_factor": max(r.factor for r in known if r.key in most),
    }


def of_trust(cases, rows):
    """Who never tends to a wrong limit, who does most often and where, how much was derived."""
    if not rows:
        return None
    worst = max(rows, key=lambda r: (r.wrong, r.key))
    unexpected = sum(not row.verdict.as_expected for row in tally.rows(cases))
    return {
        "never": [r.key for r in rows if not r.wrong and not r.counts["failed"]],
        "wrong": sum(r.wrong for r in rows),
        "derived": sum(r.counts["predicted"] for r in rows),
        "worst": worst.key,
        "times": worst.wrong,
        "judged": worst.judged,
        "where": list(trust.wrong_cases(cases, worst.key))[:NAMED],
        "unexpected": unexpected,
    }


def of_truths(cases):
    """How many truths were judged by, of which kinds, how well they are known; None without any."""
    known = {}
    for row in tally.rows(cases):
        v = row.verdict
        if math.isfinite(v.truth) and row.standing != tally.ALIAS:
            known[row.case, row.parameters, v.quantity, v.theory] = v
    if not known:
        return None
    kinds = {}
    for v in known.values():
        kinds[v.truth_kind] = kinds.get(v.truth_kind, 0) + 1
    digits = sorted(v.truth_uncertainty / abs(v.truth) for v in known.values() if v.truth)
    return {
        "number": len(known),
        "kinds": dict(sorted(kinds.items(), key=lambda item: -item[1])),
        "half": digits[(len(digits) - 1) // 2] if digits else math.nan,
        "all": digits[-1] if digits else math.nan,
    }
