"""Motions in time: what integrated them, energies, momenta, steps, quantities over time; a page for
each case that has one (table `motion` of the results)."""
import functools

from markupsafe import Markup, escape

from reports import pictures, shapes
from reports.motion import figures, stored, words

NAVIGATION = [("motions.html", "motions")]


def present(site):
    return not site.alone and stored.has_motions(site.results)


def file_of(case):
    return f"motion_{case.name}.html"


def leader(motions):
    """Whose energies and momenta are drawn."""
    return figures.leading(motions)[0]


def parts_of(site, case, motions):
    """What the page of a case shows."""
    first, name = leader(motions), f"motion_{case.name}"
    drawn = [(q, figures.quantity(site, case, q, f"{name}_{q}"))
             for q in dict.fromkeys([*case.points[0].meanings, *case.points[0].units])]
    s = shapes.read(site, case)
    return {
        "case": case, "first": first,
        "sentence": words.sentence(first, stored.how(case.points[0])),
        "spread": words.spread(motions), "whenever": words.whenever,
        "space": pictures.markup(case, s) if s is not None and shapes.FRAME in s.kind else None,
        "quantities": [(q, image) for q, image in drawn if image],
        "energies": figures.energies(site, first, f"{name}_energies"),
        "drifts": figures.drifts(site, motions, f"{name}_drifts"),
        "momenta": figures.momenta(site, first, f"{name}_momenta"),
        "steps": figures.steps(site, motions, f"{name}_steps"),
    }


def found_in(site):
    """[(case, [Motion])]"""
    found = ((case, stored.motions_of(site.results, case.name)) for case in site.cases)
    return [(case, motions) for case, motions in found if motions]


def section(site, case):
    """What the page of a case says of its motion."""
    motions = stored.motions_of(site.results, case.name)
    if not motions:
        return []
    told = escape(words.sentence(leader(motions), stored.how(case.points[0])))
    link = f'<a href="{file_of(case)}">Energies, momenta, steps and quantities over time</a>'
    return [("In time", Markup(f"<p>{told} {link}.</p>"))]


def write(site):
    rows = [(case, file_of(case), words.sentence(leader(motions), stored.how(case.points[0])),
             leader(motions)) for case, motions in found_in(site)]
    site.write("motions.html", "motions.html", rows=rows)


def write_case(site, case):
    motions = stored.motions_of(site.results, case.name)
    if motions:
        site.write("motion.html", file_of(case), **parts_of(site, case, motions))


def tasks(site):
    return [functools.partial(write, site)] + [
        functools.partial(write_case, site, case) for case in site.cases]
