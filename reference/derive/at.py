"""Computes the exact values of a case at a new parameter point, with the program that derives its rows.

usage: at.py CASE ["name=value;..."]     Prints quantity, value, unit, uncertainty and convention, separated by tabs,
in one line per value. The exit status is 0, or 3 if no program derives this case or these parameters. With status 3, a
line gives the reason.
"""
import importlib
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import defaults  # noqa: E402

SIZES = ("height", "width", "web_thickness", "flange_thickness")


class NotDerivable(Exception):
    """Raised if no program derives the values. The text is the reason."""


def numbers(given):
    return {k: defaults.value(v) for k, v in given.items()}


def channel_section(case, given):
    from reference.derive import column
    if given.get("section_data") == "printed" and any(name in given for name in SIZES):
        raise NotDerivable("printed section data belong to the default sizes")
    return column.channel_data(**given), defaults.decimals(case, given)


def c_column(given):
    from reference.derive import column
    s, at = channel_section("c_column", given)
    yield "buckling_load", column.buckling_load(s, at["length"], at["shear"],
                                                at["shear_stability"] == "haringx"), "N"
    for i, value in enumerate(
            column.frequencies(s, at["length"], at["shear"], at["rotary_inertia"], 13)):
        yield f"frequency_{i + 1}", value, "Hz"


def moment_buckling(given):
    from reference.derive import column
    s, at = channel_section("moment_buckling", given)
    low, high = column.buckling_moments(s, at["length"], at["shear"],
                                        at["shear_stability"] == "haringx", at["wagner_moments"])
    yield "buckling_moment_negative", low, "N m"
    yield "buckling_moment_positive", high, "N m"


def unsymmetric_column(given):
    from reference.derive import column
    yield from column.loaded(column.branched(), defaults.decimals("unsymmetric_column", given))


def shear_column(given):
    from reference.derive import linear_buckling
    yield "buckling_load", linear_buckling.column_load(given), "N"


def warping_torsion(given):
    from reference.derive import torsion
    at = defaults.decimals("warping_torsion", given)
    yield "twist_ratio", torsion.twist_ratio(at["kL"], at["ends"]), "1"


def tip_body(given):
    from reference.derive import tip_body as program
    at = {n: float(v) for n, v in defaults.decimals("tip_body", given).items()}
    for quantity, value, relative in program.values(at["omega_star"], at["body"], at["overhang"],
                                                    at["gyration"]):
        yield quantity, value, "1", relative or 5e-13


def sprung_beam(given):
    from reference.derive import sprung_beam as program
    yield from program.values(given)


def tapered_cantilever(given):
    from reference.derive import tapered_cantilever as program
    yield from program.values(given)


def coupled_beam(given):
    from reference.derive import coupled_beam as program
    yield from program.values(given)


def free_ring(given):
    from reference.derive import free_ring as program
    at = defaults.decimals("free_ring", given)
    yield from program.values(at["torsion"], at["rotary_inertia"])


def sheet_case(case, function):

    def solve(given):
        from reference.derive import sheets
        for row in getattr(sheets, function)(**numbers(given)):
            if row[0] == case:
                yield row[2:]

    return solve


def cantilever(family, *names):
    """Returns a solver that calls `family`, a function of cantilevers.py, with a tuple of one value for each
    parameter in `names`."""

    def solve(given):
        from reference.derive import cantilevers
        at = {**defaults.values(family), **numbers(given)}
        for row in getattr(cantilevers, family)(*((at[name], ) for name in names)):
            yield row[2:]

    return solve


def spherical_joint(given):
    from reference.derive import joint
    undeformed, curve = joint.stiffness_curve(**numbers(given))
    for name, value in (("max", max(curve)), ("min", min(curve)), ("undeformed", undeformed)):
        yield f"support_stiffness_{name}", value, "N/m", joint.RELATIVE


def hexapod(given):
    from reference.derive import hexapod as legs
    curve = legs.stiffness_curve(**numbers(given))
    for i, (stiffness, _) in enumerate(curve):
        yield f"support_stiffness_{i + 1}", stiffness, "N/m", legs.RELATIVE
    yield "crank_angle", curve[-1][1], "rad", legs.RELATIVE


def cross_flexure(given):
    from reference.derive import cross_flexure as hinge
    yield from hinge.quantities(numbers(given))


def rotating_cantilever(given):
    from reference.derive import rotating
    for row in rotating.across(**numbers(given)):
        yield row[2:]


def loaded_cantilever(given):
    from reference.derive import loaded_cantilever as beam
    yield from beam.rows_at(given)


def weighted_column(given):
    from reference.derive import weighted_column as column
    yield "load_factor", column.load_factor(given), "1"


SHEET = ("length", "width", "thickness", "young", "poisson", "tip_deflection", "tip_warping",
         "warping", "shear", "trapeze", "wagner", "shear_factor", "moment_convention")
CHANNEL = ("length", "height", "width", "web_thickness", "flange_thickness", "young", "shear_modulus",
           "density", "section_data", "shear", "shear_stability")
HEXAPOD = ("length", "width", "thickness", "young", "poisson", "fold_angle", "radius",
           "fold_warping", "wagner", "base_radius", "crank_length", "crank_azimuth",
           "platform_radius", "platform_azimuth", "height", "stroke", "steps")
SOLVERS = {
    "c_column": (CHANNEL + ("rotary_inertia", ), c_column, "column"),
    "moment_buckling": (CHANNEL + ("wagner_moments", ), moment_buckling, "column"),
    "unsymmetric_column": (("length", "shear", "shear_stability", "rotary_inertia", "axial_load"),
                           unsymmetric_column, "column"),
    "shear_column": (("length", "side", "young", "shear_modulus", "shear_stability"), shear_column,
                     "linear_buckling"),
    "warping_torsion": (("kL", "ends"), warping_torsion, "torsion"),
    "tip_body": (("omega_star", "body", "overhang", "gyration"), tip_body, "tip_body"),
    "sprung_beam": (("load", "spring", "moment"), sprung_beam, "sprung_beam"),
    "tapered_cantilever": (("section", "ratio", "asked", "shear"), tapered_cantilever,
                           "tapered_cantilever"),
    "coupled_beam": (("asked", "coupling", "turn"), coupled_beam, "coupled_beam"),
    "free_ring": (("torsion", "rotary_inertia"), free_ring, "free_ring"),
    "sheet_cantilever": (SHEET, sheet_case("sheet_cantilever", "cantilever"), "sheets"),
    "sheet_wagner": (SHEET + ("tip_phi_z", "tip_phi_x"), sheet_case("sheet_wagner",
                                                                    "twisted"), "sheets"),
    "spherical_joint": (("length", "width", "thickness", "young", "poisson", "fold_angle", "radius",
                         "azimuth", "tilt", "steps", "fold_warping", "wagner"), spherical_joint,
                        "joint"),
    "hexapod": (HEXAPOD, hexapod, "hexapod"),
    "cross_flexure": (("length", "width", "thickness", "pitch", "half_angle", "young", "poisson",
                       "angle", "rotation", "moment_convention"), cross_flexure, "cross_flexure"),
    "elastica": (("load", ), cantilever("elastica", "load"), "cantilevers"),
    "loaded_cantilever": (("load", "size", "arm", "axial"), loaded_cantilever, "loaded_cantilever"),
    "weighted_column": (("grows", "staying"), weighted_column, "weighted_column"),
    "shear_elastica": (("GA", ), cantilever("shear_elastica", "GA"), "cantilevers"),
    "geradin_cardona": (("load", ), cantilever("geradin_cardona", "load"), "cantilevers"),
    "bend_45": (("force", "torsion"), cantilever("bend_45", "torsion", "force"), "cantilevers"),
    "roll_up": (("turns", ), cantilever("roll_up", "turns"), "cantilevers"),
    "wagner_torsion": (("angle", ), cantilever("wagner_torsion", "angle"), "cantilevers"),
    "rotating_cantilever": (("omega_star", "slenderness", "hub_radius"), rotating_cantilever,
                            "rotating"),
}


def solve(case, text):
    given = dict(item.split("=", 1) for item in text.split(";") if item)
    if case not in SOLVERS:
        raise NotDerivable(
            f"case {case}: no program derives it at new points; its stored truths are all there is")
    names, function, _ = SOLVERS[case]
    strange = [name for name in given if name not in names]
    if strange:
        raise NotDerivable(
            f"case {case}: no program derives it where {strange[0]} differs from its default; it may differ in {', '.join(names)}"
        )
    default = importlib.import_module("reference.derive.rederive").DIGITS
    for row in function(given):
        yield row[0], row[1], row[2], row[3] if len(row) > 3 else 10.0 ** (
            1 - default) / 2, row[4] if len(row) > 4 else ""


def main(arguments):
    try:
        for quantity, value, unit, relative, convention in solve(
                arguments[0], arguments[1] if len(arguments) > 1 else ""):
            uncertainty = abs(float(value)) * relative if float(value) != 0 else relative
            print(
                f"{quantity}\t{float(value):.17g}\t{unit}\t{uncertainty:.1e}\t{convention}\treference/derive/{SOLVERS[arguments[0]][2]}.py",
                flush=True)
    except NotDerivable as why:
        print(why, file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
