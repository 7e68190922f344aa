"""Determines the shear theory in stability to which a reference value of a case belongs.

In Engesser's theory, the axial force does work on the slope of the centroidal axis. In Haringx's theory, it does work
on the rotation of the section, as in the geometrically exact beam. column.py states both energies. Without shear
deformation, or without stress, both theories agree."""
from reference.derive import defaults

LARGE_DISPLACEMENT = (
    "bend_45",
    "cross_flexure",
    "geradin_cardona",
    "hexapod",
    "shear_elastica",
    "spherical_joint",
)  # cases that are always flexible in shear


def of(case, parameters, quantity):
    """Returns 'engesser', 'haringx', or '' if the value does not depend on the theory. `parameters` are those that differ
    from the defaults, in the form `name=value;...`.
    """
    given = dict(item.split("=", 1) for item in parameters.split(";") if "=" in item)
    at = {**defaults.texts(case), **given}
    if float(at.get("shear", "1")) == 0:
        return ""
    if case in LARGE_DISPLACEMENT:
        return "" if quantity == "support_stiffness_undeformed" else "haringx"
    if case == "coupled_beam":
        return "haringx" if quantity.startswith("buckling") else ""
    if case == "c_cantilever":
        return "haringx"
    if case in ("sheet_cantilever", "sheet_wagner"):
        bent = {float(at["tip_deflection"]), float(at.get("tip_phi_z", "0"))}
        return "haringx" if bent != {0.0} else ""
    loaded = quantity.startswith("buckling") or float(at.get("axial_load", "0")) != 0
    if case in ("c_column", "moment_buckling", "shear_column", "unsymmetric_column") and loaded:
        return at["shear_stability"]
    return ""
