"""Integrators: which one, with which step, is soonest within an error of time, and can it be
believed?  (motion.json beside the results)"""
import functools

from reports.integrators import answers, figures, map as stability, stored, words

NAVIGATION = [("integrators.html", "integrators")]


def present(site):
    return stored.beside(site.results) is not None


def noise_of(site):
    """Costs whose ratio is below it tie."""
    return float(site.about.get("cost_noise", 1.25))


def rows_of(problems, noise):
    """[(problem, {level: Answer})] of the table who is cheapest."""
    return [(p, {level: answers.answer(p, level, noise) for level in answers.LEVELS})
            for p in problems if p.runs]


def orders_of(problems):
    """[(problem, [(scheme, order shown, nominal order)])]"""
    found = [(p, [(s, answers.order(answers.series(p, s)), stored.nominal(s))
                  for s in p.schemes()]) for p in problems]
    return [(p, [o for o in own if o[1] == o[1]]) for p, own in found
            if any(o[1] == o[1] for o in own)]


def failures_of(problems):
    """[(problem, run)] of what has no error, and why."""
    return [(p, r) for p in problems for r in p.runs if r.status != "ok"]


def write(site):
    problems, noise = stored.beside(site.results), noise_of(site)
    cases = {}
    for problem in problems:
        cases.setdefault(problem.case, []).append(problem)
    diagrams = ((case, figures.work_precision(site, case, found)) for case, found in cases.items())
    profiles = ((level, figures.profile(site, problems, level)) for level in answers.LEVELS)
    counted, stiffenings = answers.iterations(problems)
    mapped = [p for p in problems if p.cells]
    site.write("integrators.html",
               "integrators.html",
               first=words.first(problems, noise),
               tolerances=answers.LEVELS,
               rows=rows_of(problems, noise),
               noise=noise,
               diagrams=[(case, image) for case, image in diagrams if image],
               maps=[(p, stability.draw(p, p is mapped[0]), words.stability(p.cells))
                     for p in mapped],
               profiles=[(level, image) for level, image in profiles if image],
               iterations=counted, stiffenings=[(s, stability.short(s)) for s in stiffenings],
               orders=orders_of(problems),
               failures=failures_of(problems))


def tasks(site):
    return [functools.partial(write, site)]
