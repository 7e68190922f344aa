"""Draws the rigid connections of members and nodes: arms of offset ends, and constraints."""
import numpy as np

from reports import shapes
from reports.structure_drawing.canvas import ROD, SOFT, number

LINKED = 1.1  # line width of constraints [pt]


def put_offsets(canvas, view, scene):
    for name, member in scene.members.items():
        for end, (node, offset) in enumerate(zip(member.ends, member.offset)):
            if offset.any():
                at = scene.nodes[node].position
                canvas.line(view(np.array([at, at + offset])), ROD, 3.5, mark=f"offset_{name}_{end}")


def words_of(one):
    if one.kind == "diaphragm":
        return f"{one.name}: rigid in its plane"
    if one.kind == "equal":
        return f"{one.name}: {', '.join(one.components)} equal"
    (node, other), component = one.nodes, one.components[0]
    return f"{one.name}: {component} of {node} = {number(float(one.ratio))} {component} of {other}"


def put_constraint(canvas, view, scene, one):
    points = np.array([scene.nodes[name].position for name in one.nodes])
    seen = view(points)
    path = [p for other in seen[1:] for p in (seen[0], other, seen[0])]
    canvas.line(path, ROD, LINKED, (0, (4, 2)), f"constraint_{one.name}")
    if one.kind == "diaphragm":
        for face in shapes.hull(points):
            canvas.line(view(np.vstack([face, face[:1]])), ROD, LINKED, above=False, clear=False)
    canvas.label(seen.mean(axis=0), words_of(one), SOFT, 8, near=8)


def put_constraints(canvas, view, scene):
    for one in scene.constraints:
        put_constraint(canvas, view, scene, one)
