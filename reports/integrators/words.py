"""Sentences about integrators."""
from reports.integrators import answers


def joined(words):
    words = list(words)
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


def level_words(level):
    return f"{100 * level:g} %"


def soonest(problems, level, noise):
    """`alpha (2 of 3)` for each scheme that wins somewhere."""
    count, reached = answers.wins(problems, level, noise)
    if not reached:
        return f"within {level_words(level)} none"
    most = sorted(count.items(), key=lambda item: -item[1])
    if len(problems) == 1:
        best = answers.answer(problems[0], level, noise).best
        return f"within {level_words(level)} {best.scheme} with {best.setting}"
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
    doubted = [(p, run, words) for p, run in best for words in answers.doubts(p, run)]
    if doubted:
        p, run, words = doubted[0]
        return (f"{len(doubted)} of these {len(best)} answers should not be relied on yet: "
                f"{run.scheme} in {p.name}: {words}.")
    measured = {run.scheme: answers.order(answers.series(p, run.scheme)) for p, run in best}
    orders = [f"{s} {order:.1f}" for s, order in measured.items() if order == order]
    told = f" (orders: {', '.join(orders)})" if orders else ""
    return ("They can be believed: the errors are measured on the same mesh against radau with a "
            "tolerance of 1e-10, and where an order can be read they fall with the one that the "
            f"scheme should have{told}.")


def first(problems, noise):
    """The first sentences of the page."""
    every = [p for p in problems if p.runs]
    if not every:
        return "No run of these results tells an error of time."
    where = (f"{every[0].name}: the soonest is" if len(every) == 1 else
             f"Of {len(every)} problems (a case with a formulation) the soonest is")
    told = "; ".join(soonest(every, level, noise) for level in answers.LEVELS)
    return f"{where} {told}. {trust(every, noise)}"


def stability(cells):
    """One sentence on a map: which schemes grow or stop anywhere."""
    bad = {}
    for cell in cells:
        if cell.outcome in ("grows", "stops"):
            bad.setdefault(cell.scheme, set()).add(cell.step)
    every = dict.fromkeys(c.scheme for c in cells)
    good = [s for s in every if s not in bad]
    told = [f"{s} grows or stops from a step of {min(steps):.3g} s on" for s, steps in bad.items()]
    if good:
        told = [f"{joined(good)} stay{'s' if len(good) == 1 else ''} bounded everywhere"] + told
    text = "; ".join(told)
    return text[:1].upper() + text[1:] + "."
