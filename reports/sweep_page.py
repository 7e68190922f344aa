"""The page of a sweep: over which range each formulation is within a tolerance."""
import functools
import math
import pathlib
import shlex

from reports.sweep import answers, cells, figures, gather, stored, words

NAVIGATION = []  # its files have the names of the sweeps
MOST_WORST, MOST_CURVES = 20, 12  # points that are named, quantities with curves of their own


def navigation(site):
    """[(file, title)] of the bar."""
    return [(site.page_of(sweep), f"sweep of {pathlib.PurePath(sweep.name).stem}")
            for sweep in site.sweeps]


def present(site):
    return bool(site.sweeps)


def axis_words(part):
    """What was tried along an axis."""
    axis, count = part.axis, len(part.levels) or part.axis.count
    if axis.words:
        return f"{axis.name}: {', '.join(axis.words)}"
    unit = f" {axis.unit}" if axis.unit not in ("", "1") else ""
    how = {"log": f"{words.many(count, 'value')} by equal factors", "sobol": "Sobol points",
           "halton": "Halton points", "random": "random points"}.get(
               axis.kind, words.many(count, "value"))
    return f"{axis.name}: {part.low[0]:.4g} to {part.high[-1]:.4g}{unit}, {how}"


def solving(sweep, row):
    """The command that solves a point that was kept."""
    scene = shlex.quote(sweep.scene_of(row))
    return f"beamwork solve --scene {scene} -f {row.formulation} -n {row.elements}"


def worst_rows(sweep):
    """[(Worst, place in words, command or empty)], those without a solution first."""
    rows = sorted(sweep.worst, key=lambda r: -abs(r.error) if r.quantity else -math.inf)
    rows = rows[:MOST_WORST]
    wanted = {row.point for row in rows}
    at, first = {}, 0
    for values in sweep.points_only() if wanted else ():
        for point in [p for p in wanted if first <= p < first + len(values)]:
            at[point] = values[point - first]
        first += len(values)
    return [(row, sweep.place(at[row.point]) if row.point in at else "",
             solving(sweep, row) if row.scene else "") for row in rows]


def curves_of(site, sweep, found):
    """[(quantity or empty for all of them, Image)] over the axis of a sweep that has only one."""
    if len(found.parts) > 1:
        return []
    single = sweep.quantities[:MOST_CURVES] if len(sweep.quantities) > 1 else []
    return [("", figures.curves(site, sweep, found)),
            *((q.name, figures.curves(site, sweep, found, i)) for i, q in enumerate(single))]


def glance(site, sweep):
    """What is said first, here and on the first page: the context of its sentences."""
    found = gather.of_sweep(sweep)
    made = answers.of_sweep(sweep, found)
    return {"sweep": sweep, "found": found, "answers": made, "groups": answers.together(made),
            "axes": [axis_words(p) for p in found.parts], "page": site.page_of(sweep),
            "words": words}


def write(site, said):
    sweep, found = said["sweep"], said["found"]
    order = [a.key for a in said["answers"] if any(r.known for r in a.of)]
    validity = figures.Validity(sweep, found, order)
    data = f"cells_{site.name_of(sweep)}.js"
    cells.write(site, data, sweep, found, order)
    references = answers.references(sweep, found)
    site.write("sweep.html", said["page"], **said, validity=validity, data=data,
               winners=figures.Winners(sweep, found, validity.axes),
               curves=curves_of(site, sweep, found),
               worst=worst_rows(sweep), references=references,
               proven=answers.proven(references), limits=any(
                   kind.startswith("limit") for _, kinds, *_ in references for kind in kinds),
               outcomes=answers.outcomes(sweep, found),
               crowded=bool((found.points > 1).any()) and validity.dots is None)


def tasks(site):
    site.glances = [glance(site, sweep) for sweep in site.sweeps]
    return [functools.partial(write, site, said) for said in site.glances]
