"""Integrators: which one, with which step, is soonest within an error of time, and can it be
believed?  (of `beamwork motion`, and paces.json where there is one)"""
import functools

from reports import experiments
from reports.integrators import answers, figures, map as stability, stored, words

NAVIGATION = [("integrators.html", "integrators")]


def present(site):
    return experiments.holds(site.results, "motion")


def noise_of(site):
    """Costs whose ratio is below it tie."""
    return float(site.about.get("cost_noise", 1.25))


def rows_of(problems, noise):
    """[(problem, {level: Answer})] of a table who is cheapest."""
    return [(p, {level: answers.answer(p, level, noise) for level in answers.LEVELS})
            for p in problems]


def cases_of(problems, noise):
    """[(case, parameters, {level: Summary}, rows)]: all formulations of a case together, and each."""
    return [(case, parameters,
             {level: answers.summary(own, level, noise) for level in answers.LEVELS},
             rows_of(own, noise)) for (case, parameters), own in answers.by_case(problems).items()]


def maps_of(problems):
    """[(name, Image, sentence)]: a map for each structure of which large steps were run, the
    largest first, letters explained below it."""
    found = [own for own in answers.structures(problems).values() if stability.fates(own) and
             any(p.reference == stored.NONE_WANTED for p in own)]
    found.sort(key=lambda own: -len(stability.fates(own)))
    return [(min(own, key=lambda p: p.stiffening).name, stability.draw(own, own is found[0]),
             words.stability(own)) for own in found]


def unmeasured(problems):
    """Those of which errors were wanted and cannot be told."""
    return [p for p in problems if p.reference and p.reference != stored.NONE_WANTED]


def failures_of(problems):
    """[(case, parameters, scheme, runs that failed, formulations, one of them)] of what has no
    error; large steps that are to stop stand in the maps."""
    found = {}
    for p in problems:
        for r in p.runs:
            if r.status != "ok" and not r.large:
                found.setdefault((p.case, p.parameters, r.scheme), []).append((p.formulation, r))
    return [(*key, len(own), len({f for f, _ in own}), own[0][1]) for key, own in found.items()]


def diagrams_of(site, problems):
    """[(case, parameters, Image)]"""
    found = [(case, parameters, figures.work_precision(site, f"{case}_{i}", own))
             for i, ((case, parameters), own) in enumerate(answers.by_case(problems).items())]
    return [one for one in found if one[2]]


def write(site):
    record, noise = stored.read(site.results), noise_of(site)
    told = answers.judged(record.compared)
    profiles = ((level, figures.profile(site, told, level)) for level in answers.LEVELS)
    counted, stiffenings = answers.iterations(record.every)
    site.write("integrators.html",
               "integrators.html",
               record=record.about, about=site.about,
               first=words.first(record.compared, noise),
               words=words, doubt=answers.doubt,
               tolerances=answers.LEVELS,
               cases=cases_of(told, noise),
               problems=len(told),
               noise=noise,
               diagrams=diagrams_of(site, told),
               maps=maps_of(record.problems),
               profiles=[(level, image) for level, image in profiles if image],
               within={level: answers.counted(told, level) for level in answers.LEVELS},
               checks=record.checks,
               left_out=record.left_out,
               iterations=counted, counted=words.iterations(counted),
               stiffenings=[(s, stability.short(s)) for s in stiffenings],
               orders=answers.orders(told),
               ladders=[(p, one) for p in told for one in p.ladders
                        if one.verdict == "low order"],
               verdicts=record.verdicts, judged=words.verdicts(record.verdicts),
               unmeasured=unmeasured(record.every),
               failures=failures_of(answers.judged(record.every)))


def tasks(site):
    return [functools.partial(write, site)]
