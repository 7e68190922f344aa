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
            for p in answers.judged(problems)]


def maps_of(problems):
    """[(name, Image, sentence)]: a map for each structure, letters explained below the first."""
    found = [own for own in answers.structures(problems).values() if stability.fates(own)]
    return [(min(own, key=lambda p: p.stiffening).name, stability.draw(own, own is found[0]),
             words.stability(own)) for own in found]


def unmeasured(problems):
    """Those of which errors were wanted and cannot be told."""
    return [p for p in problems if p.reference and p.reference != stored.NONE_WANTED]


def failures_of(problems):
    """[(problem, run)] of what has no error, and why; large steps that are to stop stand in the
    maps."""
    return [(p, r) for p in answers.judged(problems) for r in p.runs
            if r.status != "ok" and not r.fate]


def write(site):
    record, noise = stored.beside(site.results), noise_of(site)
    problems = record.problems
    cases = {}
    for problem in problems:
        cases.setdefault(problem.case, []).append(problem)
    diagrams = ((case, figures.work_precision(site, case, found)) for case, found in cases.items())
    profiles = ((level, figures.profile(site, answers.judged(problems), level))
                for level in answers.LEVELS)
    counted, stiffenings = answers.iterations(problems)
    site.write("integrators.html",
               "integrators.html",
               first=words.first(problems, noise),
               tolerances=answers.LEVELS,
               rows=rows_of(problems, noise),
               noise=noise,
               diagrams=[(case, image) for case, image in diagrams if image],
               maps=maps_of(problems),
               profiles=[(level, image) for level, image in profiles if image],
               iterations=counted, counted=words.iterations(counted),
               stiffenings=[(s, stability.short(s)) for s in stiffenings],
               ladders=[(p, one) for p in answers.judged(problems) for one in p.ladders],
               verdicts=record.verdicts, judged=words.verdicts(record.verdicts),
               unmeasured=unmeasured(problems),
               failures=failures_of(problems))


def tasks(site):
    return [functools.partial(write, site)]
