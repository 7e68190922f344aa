"""Constants of a solid section from its outline, computed with the finite elements of sectionproperties (PyPI)."""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from .errors import Error

# Points and weights that integrate polynomials of fourth degree over a triangle (Dunavant 1985).
_RULE = [(0.445948490915965, 0.223381589678011), (0.091576213509771, 0.109951743655322)]


def _integral(mesh: Any, f: Callable[[Any, Any], Any]) -> float:
    """Returns the integral of f(y, z) over the straight triangles of a mesh."""
    corner = mesh["vertices"][mesh["triangles"][:, :3]]  # [triangles, 3, 2]
    a, b = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    area = abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    total = 0.0
    for part, weight in _RULE:
        for k in range(3):
            share: list[float] = [part, part, part]
            share[k] = 1 - 2 * part
            y, z = sum(s * corner[:, i] for i, s in enumerate(share)).T
            total += weight * (area * f(y, z)).sum()
    return float(total)


def _meshed(shape: Any, parts: int) -> Any:
    from sectionproperties.analysis import Section  # pylint: disable=import-outside-toplevel
    from sectionproperties.pre import Geometry  # pylint: disable=import-outside-toplevel
    geometry = Geometry(shape)
    geometry.create_mesh([shape.area / parts])
    section = Section(geometry)
    section.calculate_geometric_properties()
    return section


def outline(points: Sequence[Sequence[float]], holes: Sequence[Sequence[Sequence[float]]] = (), parts: int = 2000,
            **material: float) -> tuple[dict[str, Any], float]:
    """Returns a section of a scene, and the angle [rad] from the y axis of the points to its principal y axis, by which
    the member's `y` must be rotated.

    points: [[y, z], ...] of a polygon [m]; holes: polygons in it; parts: minimum number of triangles.
    material: young and shear_modulus [Pa], density [kg/m^3].

    The section has `constants`: A, Iy, Iz, It, Iw, the shear centre, F (shear along y and z, without Poisson's effect),
    and the Wagner constants (the integrals described under `wagner_y`, `wagner_z`, `wagner_torque` in the scene's
    keys). The torsion and shear functions are those of sectionproperties, whose error decreases as `parts` increases.
    Raises Error if sectionproperties is not installed, and ValueError for an outline that crosses itself or has no
    area."""
    try:
        import shapely  # pylint: disable=import-outside-toplevel
        import sectionproperties  # noqa: F401 pylint: disable=import-outside-toplevel,unused-import
    except ImportError as missing:
        raise Error(f"outline needs {missing.name}; pip install sectionproperties, or give the "
                    "section's constants") from None
    shape = shapely.Polygon(points, holes)
    if not shape.is_valid or not shape.area > 0:
        raise ValueError(f"the outline does not enclose an area: {shapely.is_valid_reason(shape)}")
    size = math.sqrt(shape.area)  # unit of the meshes, which makes them independent of the size
    shape = shapely.affinity.scale(shape, 1 / size, 1 / size, origin=(0, 0))
    first = _meshed(shape, parts).section_props
    across = first.iyy_c - first.ixx_c
    angle = math.atan2(2 * first.ixy_c, across) / 2
    if abs(first.ixy_c) <= 1e-12 * (first.ixx_c + first.iyy_c):
        angle = 0.0
    elif across < 0:  # the nearer axis is y
        angle = math.atan2(-2 * first.ixy_c, -across) / 2
    turned = shapely.affinity.rotate(
        shapely.affinity.translate(shape, -first.cx, -first.cy), -angle, (0, 0), use_radians=True)
    section = _meshed(turned, parts)
    section.calculate_warping_properties()
    p, mesh = section.section_props, section.mesh
    wagner = [_integral(mesh, lambda y, z: y * (y * y + z * z)), _integral(mesh, lambda y, z: z * (y * y + z * z))]
    mean = (p.ixx_c + p.iyy_c) / p.area
    torque = _integral(
        mesh, lambda y, z: (y * y + z * z - mean - wagner[0] / p.iyy_c * y - wagner[1] / p.ixx_c * z
                            )**2) / 8
    coupled = 0 if math.isinf(p.a_sxy) else 1 / p.a_sxy
    shear = [1 / p.a_sx, coupled, 0, coupled, 1 / p.a_sy, 0, 0, 0, 0]
    constants = {"A": (p.area, 2), "Iy": (p.ixx_c, 4), "Iz": (p.iyy_c, 4), "It": (p.j, 4),
                 "Iw": (p.gamma, 6), "ys": (p.x_se - p.cx, 1), "zs": (p.y_se - p.cy, 1),
                 "wagner_y": (wagner[0], 5), "wagner_z": (wagner[1], 5),
                 "wagner_torque": (torque, 6)}
    scaled: dict[str, Any] = {name: float(value) * size**power for name, (value, power) in constants.items()}
    scaled["F"] = [float(value) / size**2 for value in shear]
    return {"constants": scaled, **material}, angle
