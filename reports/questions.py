"""Questions about a case, such as its buckling load or its first frequencies. Formulations are ranked by the quantities
of one question. High frequencies and higher buckling loads belong to no question."""
from dataclasses import dataclass

import yaml

from reports import agreed, answers
from reports.structure_drawing.scene import Loader

BUCKLING, FREQUENCIES, STIFFNESS, LOADED, MOTION = (
    "buckling load", "first frequencies", "stiffness and compliance", "displacements and forces", "motion")
QUESTIONS = (BUCKLING, FREQUENCIES, STIFFNESS, MOTION, LOADED)
KINDS = {  # kind of a quantity in the scene file -> question; other kinds: see question_of
    "critical_factor": BUCKLING, "critical_point": BUCKLING, "frequency": FREQUENCIES,
    "damping_ratio": FREQUENCIES, "growth": FREQUENCIES, "growth_rate": FREQUENCIES,
    "stiffness": STIFFNESS, "compliance": STIFFNESS,
}
MOTIONS = ("motion", "dynamics", "response")  # kinds of analyses
FIRST = {BUCKLING: 1, FREQUENCIES: 3}  # number of modes, counted from the lowest, that belong to the question


@dataclass
class Line:
    """A question of a case at its default parameters."""

    question: str
    case: object  # data.Case
    quantities: list
    found: dict  # level -> answers.Answer


def kind_of(entry):
    """Returns (kind, attributes) of an entry `{kind: {...}, unit: ...}` of a scene file."""
    if not isinstance(entry, dict) or not entry:
        return "", {}
    kind = next(iter(entry))
    return kind, entry[kind] if isinstance(entry[kind], dict) else {}


def question_of(kind, attributes, analyses):
    """Returns the question to which a quantity belongs. `analyses` is {name: kind} of the scene."""
    return KINDS.get(kind) or (MOTION if analyses.get(attributes.get("analysis")) in MOTIONS else LOADED)


def first_of(question, described):
    """Returns the names of [(quantity, kind, attributes)], limited to the first modes (FIRST) of each analysis and
    family."""
    modes, kept = {}, []
    for name, kind, attributes in sorted(described, key=lambda one: int(one[2].get("which", 0))):
        of = kind, attributes.get("analysis"), attributes.get("family"), attributes.get("value")
        modes[of] = modes.get(of, 0) + 1
        if modes[of] <= FIRST.get(question, len(described)):
            kept.append(name)
    return [name for name, _, _ in described if name in kept]


def questions_of(point):
    """Returns {question: judged quantities} of a point in the order of QUESTIONS. Quantities that the scene does not
    describe belong to LOADED."""
    scene = yaml.load(point.scene, Loader) if point.scene else {}
    scene = scene if isinstance(scene, dict) else {}
    analyses = {name: kind_of(entry)[0] for name, entry in (scene.get("analyses") or {}).items()}
    described = scene.get("quantities") or {}
    found = {question: [] for question in QUESTIONS}
    for name in answers.judged(point):
        kind, attributes = kind_of(described.get(name))
        found[question_of(kind, attributes, analyses)].append((name, kind, attributes))
    return {question: first_of(question, own) for question, own in found.items() if own}


def lines_of(case):
    point = agreed.ranked(case.points[0])
    return [Line(question, case, names, {level: answers.answer(point, names, level) for level in answers.LEVELS})
            for question, names in questions_of(point).items()]


def grouped(cases):
    """Returns [(question, [Line])] in the order of QUESTIONS, with the cases of each question by name."""
    lines = [line for case in sorted(cases, key=lambda c: c.name) for line in lines_of(case)]
    groups = [(question, [line for line in lines if line.question == question]) for question in QUESTIONS]
    return [(question, own) for question, own in groups if own]
