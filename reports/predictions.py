"""Compares analytic estimates with the coarsest meshes, on the pages of the cases that have estimates."""
import math

from markupsafe import Markup

from reports.site import number, percent

NAVIGATION = []
MOST_POINTS = 6


def tasks(site):
    return []


def truths_of(point):
    return {v.quantity: v.truth for s in point.series for v in s.verdicts if math.isfinite(v.truth)}


def of_point(point):
    """Returns [(quantity, estimate, its relative error, [(formulation, elements of its coarsest mesh, error)])]."""
    known = truths_of(point)
    coarsest = [(s.key, s.meshes[0]) for s in point.series if s.meshes]
    predictions = {name: value for _, mesh in coarsest for name, value in mesh.predictions.items()}
    return [(name, value, value / known[name] - 1 if known.get(name) else math.nan,
             [(key, mesh.n, mesh.errors.get(name, math.nan)) for key, mesh in coarsest])
            for name, value in predictions.items()]


def table(point):
    rows = of_point(point)
    keys = [(key, n) for key, n, _ in rows[0][3]]
    head = Markup("").join(
        Markup("<th class='n'>{}, n = {}</th>").format(key, n) for key, n in keys)
    body = Markup("").join(
        Markup("<tr><td>{}</td><td class='n'>{}</td><td class='n'><strong>{}</strong></td>").format(
            name, number(value, 8), percent(error)) +
        Markup("").join(Markup("<td class='n'>{}</td>").format(percent(e))
                        for _, _, e in errors) + Markup("</tr>")
        for name, value, error, errors in rows)
    return (Markup("<h3>{}</h3>").format(point.parameters or "defaults") + Markup(
        "<div class='scroll'><table><tr><th></th><th class='n'>prediction</th><th class='n'>its error</th>{}</tr>{}</table></div>"
    ).format(head, body))


def section(site, case):
    points = [
        p for p in case.points
        if any(m.predictions for s in p.series for m in s.meshes) and truths_of(p)
    ][:MOST_POINTS]
    if not points:
        return []
    about = Markup(
        "<p>The closed-form solution is the potential of one element, solved by hand. It has its own error and is not used for verdicts. "
        "Its errors against the exact beam are shown next to those of the coarsest mesh of each formulation.</p>")
    return [("Analytic prediction", about + Markup("").join(table(p) for p in points))]
