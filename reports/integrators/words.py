"""Sentences about integrators."""
from reports.integrators import answers
from reports.motion.words import between


def joined(words):
    words = list(words)
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


def level_words(level):
    return f"{100 * level:g} %"


def soonest(problems, level, noise):
    """`within 1 % alpha in 2 of 3`, without those that are soonest half as often as the first; of
    one problem with its step."""
    count, reached = answers.wins(problems, level, noise)
    if not reached:
        return f"within {level_words(level)} none"
    if len(problems) == 1:
        found = answers.answer(problems[0], level, noise)
        tied = f" (as soon: {joined(found.ties)})" if found.ties else ""
        best = found.best
        return f"within {level_words(level)} {best.scheme} with {best.run.setting}{tied}"
    most = sorted(count.items(), key=lambda item: -item[1])
    most = [(scheme, n) for scheme, n in most if 2 * n >= most[0][1]]
    told = joined(f"{scheme} in {n}" for scheme, n in most)
    tied = " (ties count for each)" if sum(count.values()) > reached else ""
    return f"within {level_words(level)} {told} of {reached}{tied}"


def trust(problems, noise):
    """Can the answers be believed?  Of the runs that are soonest."""
    best = [(p, found.best) for p in problems
            for found in (answers.answer(p, level, noise) for level in answers.LEVELS)
            if found.best]
    if not best:
        return "No run comes within these errors."
    doubted = [(p, way, answers.doubt(p, way)) for p, way in best]
    doubted = [row for row in doubted if row[2]]
    if doubted:
        p, way, words = doubted[0]
        return (f"{len(doubted)} of these {len(best)} answers are to be taken with care, as stands "
                f"with them: {way.scheme} in {p.name}: {words}.")
    found = [p.ladder(way.scheme) for p, way in best]
    passed = sum(one is not None and one.verdict == "pass" for one in found)
    unread = len(best) - passed
    told = (f"; of {passed} the order of the scheme is confirmed, of {unread} it cannot be read"
            if unread else ", and the order of the scheme is confirmed")
    return (f"These {len(best)} answers are verified: errors are measured on the same mesh "
            f"against a reference that is closer than they are{told}.")


def first(problems, noise):
    """The first sentences of the page."""
    told = answers.judged(problems)
    if not told:
        return "No run of these results has an error of time."
    where = (f"{told[0].name}: lowest cost" if len(told) == 1 else
             f"Of {len(told)} problems (a case with a formulation) soonest is")
    levels = "; ".join(soonest(told, level, noise) for level in answers.LEVELS)
    return f"{where} {levels}. {trust(told, noise)}"


def chosen(ways):
    """`tolerance 1e-05`, `step 0.01 to 0.02 s`: of most of the ways."""
    by_tolerance = [w.run.tolerance for w in ways if w.run.tolerance]
    if 2 * len(by_tolerance) >= len(ways):
        return f"tolerance {between(by_tolerance, '{:.2g}')}"
    return f"step {between([w.run.step for w in ways if not w.run.tolerance], '{:.3g}')} s"


def keeping(found):
    """Who comes within the error and keeps energy, at how many times the least cost."""
    if not found.keeping:
        return "none of those within it keeps energy to round-off"
    names = joined(dict.fromkeys(scheme for scheme, _ in found.keeping))
    ratios = between([ratio for _, ratio in found.keeping], "{:.2g}")
    return f"keeps energy to round-off: {names}, at {ratios} times the cost"


def drift(ways):
    """Of energy, of runs that are soonest."""
    known = [w.run.energy for w in ways if w.run.energy == w.run.energy]
    return f"energy drifts by {between(known, '{:.0e}')}" if known else ""


def stability(problems):
    """One sentence on a map: which schemes grow or stop anywhere."""
    bad, every = {}, {}
    for problem in problems:
        for run in problem.runs:
            if run.fate and not run.tolerance:
                every[run.scheme] = True
            if run.fate in ("grows", "stops") and not run.tolerance:
                bad.setdefault(run.scheme, set()).add(run.step)
    good = [s for s in every if s not in bad]
    told = [f"{s} grows or stops from a step of {min(steps):.3g} s on" for s, steps in bad.items()]
    if good:
        told = [f"{joined(good)} stay{'s' if len(good) == 1 else ''} bounded everywhere"] + told
    text = "; ".join(told)
    return text[:1].upper() + text[1:] + "."


def iterations(rows):
    """One sentence on how iterations change between the least and the largest stiffness."""
    change = [found[max(found)] - found[min(found)] for found in rows.values()]
    if not change:
        return ""
    return (f"From the softest to the stiffest a step takes at most {max(0, max(change)):.1f} "
            f"iterations more, of {len(change)} that were run with both.")


def verdicts(rows):
    """One sentence on what is judged."""
    off = sum(not row["as_expected"] for row in rows)
    if not rows:
        return ""
    told = f"{len(rows)} verdicts on orders, conservation and large steps: "
    return told + (f"{off} differ from what is expected." if off else "all as expected.")
