"""Exact values of a case at a new parameter point, by the program that derives its rows.

usage: at.py CASE ["name=value;..."]     Prints one line per value: quantity, value, unit, uncertainty and convention, separated by tabs.
Exit status: 0; 3 no program derives this case or these parameters, with one line that says so.
"""
import importlib
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))


class NotDerivable(Exception):
    """The line for the user."""


def number(given, name, default):
    return float(given.get(name, default))


def columns(given):
    from mpmath import mpf
    from reference.derive import column
    sizes = {k: given[k] for k in ("height", "width", "web_thickness") if k in given}
    printed = given.get("section_data") == "printed"
    if printed and sizes:
        raise NotDerivable("printed section data belong to the default sizes")
    s = column.channel_data(printed, **sizes)
    s.E, s.G, s.RHO = mpf(given.get("young", s.E)), mpf(given.get("shear_modulus", s.G)), mpf(given.get("density", s.RHO))
    return column, s, mpf(given.get("length", "6")), given.get("shear_stability") == "haringx"


def c_column(given):
    column, s, length, haringx = columns(given)
    shear = given.get("shear", "1") == "1"
    yield "buckling_load", column.buckling_load(s, length, shear, haringx), "N"
    for i, value in enumerate(column.frequencies(s, length, shear, given.get("rotary_inertia", "1") == "1", 13)):
        yield f"frequency_{i + 1}", value, "Hz"


def moment_buckling(given):
    column, s, length, haringx = columns(given)
    low, high = column.buckling_moments(s, length, given.get("shear", "0") == "1", haringx, given.get("wagner_moments", "1") == "1")
    yield "buckling_moment_negative", low, "N m"
    yield "buckling_moment_positive", high, "N m"


def unsymmetric_column(given):
    from mpmath import mpf
    from reference.derive import column
    s, length, shear, haringx = column.branched(), mpf(given.get("length", "3")), given.get("shear", "1") == "1", given.get("shear_stability") == "haringx"
    yield "buckling_load", column.buckling_load(s, length, shear, haringx), "N"
    for i, value in enumerate(column.frequencies(s, length, shear, given.get("rotary_inertia", "1") == "1", 6, mpf(given.get("axial_load", "5000")), haringx)):
        yield f"frequency_{i + 1}", value, "Hz"


def shear_column(given):
    from mpmath import mpf
    from reference.derive import linear_buckling
    load = linear_buckling.haringx if given.get("shear_stability") == "haringx" else linear_buckling.engesser
    yield "buckling_load", load(mpf(given.get("length", "1")), mpf(given.get("shear_modulus", "27e9")), mpf(given.get("young", "70e9")), mpf(given.get("side", "0.02"))), "N"


def warping_torsion(given):
    from mpmath import mpf, tanh
    x = mpf(given.get("kL", "1"))
    if given.get("ends") == "fixed":
        x = x / 2
    yield "twist_ratio", 1 - tanh(x) / x, "1"


def sheet_case(case, function):
    def solve(given):
        from reference.derive import sheets
        values = {k: v if k == "moment_convention" else float(v) for k, v in given.items()}
        for row in getattr(sheets, function)(**values):
            if row[0] == case:
                yield row[2:]
    return solve


def cantilever(family, *arguments):
    """Families of cantilevers.py: one tuple of values for each argument, (parameter, default)."""
    def solve(given):
        from reference.derive import cantilevers
        values = [(given.get(name, default) if isinstance(default, str) else number(given, name, default),) for name, default in arguments]
        for row in getattr(cantilevers, family)(*values):
            yield row[2:]
    return solve


def spherical_joint(given):
    from reference.derive import joint
    values = {k: v if k == "fold_warping" else int(v) if k == "steps" else float(v) for k, v in given.items()}
    undeformed, curve = joint.stiffness_curve(**values)
    for name, value in (("max", max(curve)), ("min", min(curve)), ("undeformed", undeformed)):
        yield f"support_stiffness_{name}", value, "N/m", joint.RELATIVE


def hexapod(given):
    from reference.derive import hexapod as legs
    curve = legs.stiffness_curve(**{k: v if k == "fold_warping" else int(v) if k == "steps" else float(v) for k, v in given.items()})
    for i, (stiffness, _) in enumerate(curve):
        yield f"support_stiffness_{i + 1}", stiffness, "N/m", legs.RELATIVE
    yield "crank_angle", curve[-1][1], "rad", legs.RELATIVE


def cross_flexure(given):
    from reference.derive import cross_flexure as hinge
    yield from hinge.quantities(given)


def rotating_cantilever(given):
    from reference.derive import rotating
    for row in rotating.across(number(given, "omega_star", 6), number(given, "slenderness", 1000), "", number(given, "hub_radius", 0)):
        yield row[2:]


SHEET = ("length", "width", "thickness", "young", "poisson", "tip_deflection", "tip_warping", "warping", "shear", "trapeze", "wagner", "shear_factor", "moment_convention")
CHANNEL = ("length", "height", "width", "web_thickness", "young", "shear_modulus", "density", "section_data", "shear", "shear_stability")
HEXAPOD = ("length", "width", "thickness", "young", "poisson", "fold_angle", "radius", "fold_warping", "wagner", "base_radius", "crank_length", "crank_azimuth", "platform_radius",
           "platform_azimuth", "height", "stroke", "steps")
# Per case: the parameters that may differ from the defaults, what solves, the program it uses.
SOLVERS = {
    "c_column": (CHANNEL + ("rotary_inertia",), c_column, "column"),
    "moment_buckling": (CHANNEL + ("wagner_moments",), moment_buckling, "column"),
    "unsymmetric_column": (("length", "shear", "shear_stability", "rotary_inertia", "axial_load"), unsymmetric_column, "column"),
    "shear_column": (("length", "side", "young", "shear_modulus", "shear_stability"), shear_column, "linear_buckling"),
    "warping_torsion": (("kL", "ends"), warping_torsion, "torsion"),
    "sheet_cantilever": (SHEET, sheet_case("sheet_cantilever", "cantilever"), "sheets"),
    "sheet_wagner": (SHEET + ("tip_phi_z", "tip_phi_x"), sheet_case("sheet_wagner", "twisted"), "sheets"),
    "spherical_joint": (("length", "width", "thickness", "young", "poisson", "fold_angle", "radius", "azimuth", "tilt", "steps", "fold_warping", "wagner"), spherical_joint, "joint"),
    "hexapod": (HEXAPOD, hexapod, "hexapod"),
    "cross_flexure": (("length", "width", "thickness", "pitch", "half_angle", "young", "poisson", "angle", "rotation", "moment_convention"), cross_flexure, "cross_flexure"),
    "elastica": (("load",), cantilever("elastica", ("load", 1)), "cantilevers"),
    "shear_elastica": (("GA",), cantilever("shear_elastica", ("GA", 500)), "cantilevers"),
    "geradin_cardona": (("load",), cantilever("geradin_cardona", ("load", 600e3)), "cantilevers"),
    "bend_45": (("force", "torsion"), cantilever("bend_45", ("torsion", "exact"), ("force", 600)), "cantilevers"),
    "roll_up": (("turns",), cantilever("roll_up", ("turns", 1)), "cantilevers"),
    "wagner_torsion": (("angle",), cantilever("wagner_torsion", ("angle", 1)), "cantilevers"),
    "rotating_cantilever": (("omega_star", "slenderness", "hub_radius"), rotating_cantilever, "rotating"),
}


def solve(case, text):
    """Yields (quantity, value, unit, relative uncertainty, convention)."""
    given = dict(item.split("=", 1) for item in text.split(";") if item)
    if case not in SOLVERS:
        raise NotDerivable(f"case {case}: no program derives it at new points; its stored truths are all there is")
    names, function, _ = SOLVERS[case]
    strange = [name for name in given if name not in names]
    if strange:
        raise NotDerivable(f"case {case}: no program derives it where {strange[0]} differs from its default; it may differ in {', '.join(names)}")
    default = importlib.import_module("reference.derive.rederive").DIGITS
    for row in function(given):
        yield row[0], row[1], row[2], row[3] if len(row) > 3 else 10.0 ** (1 - default) / 2, row[4] if len(row) > 4 else ""


def main(arguments):
    try:
        for quantity, value, unit, relative, convention in solve(arguments[0], arguments[1] if len(arguments) > 1 else ""):
            uncertainty = abs(float(value)) * relative if float(value) != 0 else relative
            print(f"{quantity}\t{float(value):.17g}\t{unit}\t{uncertainty:.1e}\t{convention}\treference/derive/{SOLVERS[arguments[0]][2]}.py", flush=True)
    except NotDerivable as why:
        print(why, file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
