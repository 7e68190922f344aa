"""Limits that printed formulations must have under refinement and that differ from the exact values.

usage: predicted.py [--write] [CASE...]     derives reference/predicted/CASE.csv and compares or writes it

The beam to which a formulation converges (predicted_beam.py) replaces the exact beam in the programs that derive exact
values. predicted_column.py supplies the half-waves. A value that agrees with the exact value is not listed as a
prediction. shear_stability=* states that these formulations have one second-order form, whatever theory a case
requests.
"""
import pathlib
import sys

from mpmath import mpf, pi

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from reference.derive import angle_column, cantilevers, channel_cantilever  # noqa: E402
from reference.derive import channel_rotating, column, cross_flexure, defaults  # noqa: E402
from reference.derive import equilibrium, hexapod, joint, rederive, sheets  # noqa: E402
from reference.derive.predicted_beam import Printed  # noqa: E402
from reference.derive.predicted_column import (  # noqa: E402
    compression, critical, moment, pinned_square)
from reference.derive.predicted_rows import (  # noqa: E402
    differences, exact_values, row_of, write)

# Relative uncertainties of values from beams and from closed forms. For sheets, the uncertainty is that of the exact
# value. predicted_test.py verifies all uncertainties.
RELATIVE, CLOSED = 1e-9, 1e-12
# A value within this number of uncertainties of the exact value is not a prediction. The number is one if the stated
# uncertainty is hundreds of times the change due to other intervals and nodes, otherwise ten.
SAME = {True: 1, False: 10}
JONKER = ("beamw", "beamw_first")
SHEETS = ("sheet_second", "sheet_third", "sheet_second_consistent")
ALIASES = {"sheet_third": ("sheet_third_printed",)}  # the sign of u_y in N Eq. 49 has only an effect of higher order


def as_printed(name):
    return lambda beam: Printed(beam, name)


def shear_elastica():
    """GA = 10 is omitted for the beams of J, whose path ends before the full load, and for sheet_second_consistent,
    whose value right_angle() yields."""
    for name in JONKER + SHEETS:
        stiffnesses = (500, 50, 10) if name in ("sheet_second", "sheet_third") else (500, 50)
        for row in cantilevers.shear_elastica(stiffnesses, form=as_printed(name)):
            yield name, *row[:5], RELATIVE


def right_angle():
    """Yields predictions for shear_elastica with GA = F = 10, where all sections shear to z = pi/2 and none rotates.

    z = z sin z + (1 + z^2/2) cos z (ERRATA). The load then has no lever arm, so no bending moment occurs.
    """
    name, at, stretch = "sheet_second_consistent", "GA=10", mpf(10) / 10 ** 9  # F/EA
    yield name, "shear_elastica", at, "u", mpf(-1), "m", CLOSED
    yield name, "shear_elastica", at, "v", 1 + pi ** 2 / 8 + stretch, "m", CLOSED


def geradin_cardona():
    for name in JONKER + SHEETS:
        for row in cantilevers.geradin_cardona(form=as_printed(name)):
            yield name, *row[:5], RELATIVE


def bend_45():
    for name in SHEETS:
        for row in cantilevers.bend_45(form=as_printed(name)):
            yield name, *row[:5], RELATIVE


BENT = ({}, {"tip_deflection": 0.05}, {"tip_deflection": 0.001}, {"shear": 0}, {"width": 0.02},
        {"warping": 0, "trapeze": 0, "shear_factor": 0.8333333333333334}, {"thickness": 0.0005},
        {"thickness": 0.0001, "tip_deflection": 0.05}, {"length": 0.05, "tip_deflection": 0.0075},
        {"length": 0.5, "tip_deflection": 0.25}, {"length": 2, "tip_deflection": 0.3},
        {"tip_deflection": 0.005}, {"tip_deflection": 0.01}, {"tip_warping": 1},
        {"tip_deflection": 0.05, "tip_warping": 1}, {"tip_deflection": 0.005, "tip_warping": 1},
        {"tip_deflection": 0.01, "tip_warping": 1},
        {"length": 0.05, "tip_deflection": 0.025, "tip_warping": 1},
        {"moment_convention": "semitangential"}, {"moment_convention": "symmetrised"})
VIBRATING = ({}, {"tip_deflection": 0.05}, {"tip_warping": 1})
WITHOUT_TORQUE = ({"wagner": 0}, {"wagner": 0, "tip_warping": 1}, {"wagner": 0, "tip_phi_x": 0.05},
                  {"wagner": 0, "tip_phi_x": 0.1})
WITH_TORQUE = ({}, {"tip_warping": 1}, {"tip_phi_x": 0.05}, {"tip_phi_x": 0.1},
               {"moment_convention": "semitangential"}, {"moment_convention": "symmetrised"},
               {"tip_warping": 1, "moment_convention": "symmetrised"})


def bent_sheets():
    for name in JONKER + SHEETS:
        for given in BENT:
            for row in sheets.cantilever(form=as_printed(name), **given):
                yield name, *row


def vibrating_sheets():
    """The elements of J have consistent mass by default, which changes the limit (option `interpolated` of
    equilibrium.py). In the sheet elements, the amplitude a determines the inertia of warping."""
    for name in JONKER + SHEETS:
        for given in VIBRATING:
            at = sheets.parameters({"modes": 3, **given})
            values = equilibrium.sheet_frequencies(3, given, as_printed(name), name in JONKER)
            for i, value in enumerate(values):
                yield name, "sheet_cantilever", at, f"frequency_{i + 1}", value, "Hz", RELATIVE


def twisted_sheets():
    """The elements of J do not include the Wagner torque."""
    for name in JONKER + SHEETS:
        for given in WITHOUT_TORQUE + (WITH_TORQUE if name in SHEETS else ()):
            for row in sheets.twisted(form=as_printed(name), **given):
                yield name, *row


def hinges():
    for name in JONKER + SHEETS:
        for given in cross_flexure.POINTS:
            for row in cross_flexure.quantities(given, form=as_printed(name)):
                yield name, "cross_flexure", sheets.parameters(given), *row


FREE_FOLDS = {"fold_warping": "free", "wagner": 0, "tilt": 0.1, "steps": 10}
JOINTS = (({}, SHEETS), ({"wagner": 0}, ("beamw", "beamw_first", "sheet_third")),
          (FREE_FOLDS, ("beamw", *SHEETS)))


def joints():
    for given, names in JOINTS:
        at = sheets.parameters(given)
        for name in names:
            undeformed, curve = joint.stiffness_curve(form=as_printed(name), **given)
            for state, value in (("max", max(curve)), ("min", min(curve)),
                                 ("undeformed", undeformed)):
                quantity = f"support_stiffness_{state}"
                yield name, "spherical_joint", at, quantity, value, "N/m", RELATIVE


HEXAPODS = (({}, SHEETS), ({"wagner": 0}, ("beamw", *SHEETS)))


def hexapods():
    for given, names in HEXAPODS:
        at = sheets.parameters(given)
        for name in names:
            curve = hexapod.stiffness_curve(form=as_printed(name), **given)
            for k, (stiffness, _) in enumerate(curve):
                yield name, "hexapod", at, f"support_stiffness_{k + 1}", stiffness, "N/m", RELATIVE
            yield name, "hexapod", at, "crank_angle", curve[-1][1], "rad", RELATIVE


def channel_rows(name, given, deflections, points, relative):
    """Without shear, beamw_vlasov and beamw have the same limit."""
    rigid = {**defaults.values("c_cantilever"), **given}["shear"] == 0
    names = (name, "beamw_vlasov") if name == "beamw" and rigid else (name,)
    for w, values in zip(deflections, points):
        at = defaults.differing("c_cantilever", **given, w=w)
        for one in names:
            for quantity, value, unit in zip(("load_at_w", "lateral"), values, ("N", "m")):
                yield one, "c_cantilever", at, quantity, value, unit, relative


def channels():
    for name in JONKER:
        for given, w in channel_cantilever.POINTS:
            if {**defaults.values("c_cantilever"), **given}["wagner_moments"] == 0:
                points = channel_cantilever.path(w, form=as_printed(name), **given)
                yield from channel_rows(name, given, w, points, channel_cantilever.RELATIVE)


def turning_channels():
    w = (0.25, 0.5, 1.0)
    for name in JONKER:
        for omega, rotary in ((10, 0), (20, 0), (40, 0), (20, 1), (40, 1)):
            given = {"omega": omega, "rotary_inertia": rotary}
            points = channel_rotating.path(w, omega, rotary, form=as_printed(name))
            yield from channel_rows(name, given, w, points, channel_rotating.RELATIVE)


CHANNEL_COLUMNS = ({}, {"length": 3}, {"length": 12}, {"section_data": "printed"},
                   {"web_thickness": "0.01"}, {"length": 4, "height": "0.9", "width": "0.3"})
WITHOUT_SHEAR = {"shear": 0, "rotary_inertia": 0}
UNSYMMETRIC_COLUMNS = ({}, {"axial_load": 0}, {"length": "0.6", "axial_load": 100000},
                       {"length": 1, "axial_load": -50000}, {**WITHOUT_SHEAR, "axial_load": 0})
SQUARE = ("length", "side", "young", "shear_modulus")
SQUARE_COLUMNS = ({}, {"shear_modulus": 27 * 10 ** 8}, {"shear_modulus": 7 * 10 ** 7},
                  {"length": "0.1"}, {"length": "0.1", "shear_modulus": 27 * 10 ** 8},
                  {"length": "0.1", "shear_modulus": 7 * 10 ** 7},
                  {"length": "0.7", "side": "0.09", "young": 12 * 10 ** 9,
                   "shear_modulus": 5 * 10 ** 8})


def at_any_theory(given, shear=True):
    return sheets.parameters({**given, "shear_stability": "*"} if shear else given)


def channel_columns():
    rigid = [{**at, "shear": 0} for at in CHANNEL_COLUMNS]
    for given in [*CHANNEL_COLUMNS, *rigid, WITHOUT_SHEAR]:
        s, value = column.channel_data(**given), defaults.decimals("c_column", given)
        length, shear = value["length"], value["shear"]
        for name in JONKER:
            load = critical(s, length, shear, compression, name == "beamw")[1]
            yield name, "c_column", at_any_theory(given, shear), "buckling_load", load, "N", CLOSED


def channels_under_moments():
    at = at_any_theory({"shear": 1, "wagner_moments": 0})
    length = defaults.decimals("moment_buckling", {})["length"]
    for name in JONKER:
        found = critical(column.channel_data(), length, 1, moment, name == "beamw")
        for side, value in zip(("negative", "positive"), found):
            yield name, "moment_buckling", at, f"buckling_moment_{side}", value, "N m", CLOSED


def unsymmetric_columns():
    s = column.branched()
    for name in JONKER:
        for given in UNSYMMETRIC_COLUMNS:
            value, eq66 = defaults.decimals("unsymmetric_column", given), name == "beamw"
            length, load = value["length"], value["axial_load"]
            shear, rotary = value["shear"], value["rotary_inertia"]
            at = at_any_theory(given, shear)
            value = critical(s, length, shear, compression, eq66)[1]
            yield name, "unsymmetric_column", at, "buckling_load", value, "N", CLOSED
            found = column.frequencies(s, length, shear, rotary, 6, load, eq66, compression)
            for i, value in enumerate(found):
                yield name, "unsymmetric_column", at, f"frequency_{i + 1}", value, "Hz", CLOSED


def angle_columns():
    """In beamw_first, twist causes no shortening, but the moment of the load on a leg is coupled correctly."""
    for load in ("centroid", "leg"):
        force, y, z, _ = angle_column.stress_of(load)
        for given in ({}, {"warping": 0}):
            at = defaults.differing("angle_column", load=load, **given)
            stress = force, y, z, mpf(0)
            for i, value in enumerate(angle_column.least_factors(not given, stress)):
                quantity = f"critical_load_{i + 1}"
                yield "beamw_first", "angle_column", at, quantity, value, "N", CLOSED


def square_columns():
    for given in SQUARE_COLUMNS:
        for name in ("beamw", "sheet_second", "sheet_third", "beamw_first"):
            value = defaults.decimals("shear_column", given)
            value = pinned_square(*(value[k] for k in SQUARE), eq66=name != "beamw_first")
            yield name, "shear_column", at_any_theory(given), "buckling_load", value, "N", CLOSED


CLOSED_FORMS = {"c_column": (channel_columns,), "moment_buckling": (channels_under_moments,),
                "unsymmetric_column": (unsymmetric_columns,), "shear_column": (square_columns,),
                "angle_column": (angle_columns,)}
BEAMS = {"shear_elastica": (shear_elastica, right_angle), "geradin_cardona": (geradin_cardona,),
         "bend_45": (bend_45,),
         "sheet_cantilever": (bent_sheets, vibrating_sheets), "sheet_wagner": (twisted_sheets,),
         "spherical_joint": (joints,), "cross_flexure": (hinges,), "hexapod": (hexapods,),
         "c_cantilever": (channels, turning_channels)}
CASES = {**CLOSED_FORMS, **BEAMS}


def predictions(cases=CASES):
    """Yields (formulation, case, parameters, quantity, value, unit, uncertainty/value[, convention])."""
    for family in (one for case in cases for one in CASES[case]):
        for name, *rest in family():
            for one in (name, *ALIASES.get(name, ())):
                yield (one, *rest)


def derived_rows(cases=CASES):
    """Yields the rows of the predictions for which exact values are known and that differ from all of these values."""
    exact = exact_values()
    for given in predictions(cases):
        point = rederive.canonical(given[2].replace("shear_stability=*", ""))
        known = exact.get((given[1], point, given[3]), [])
        apart = SAME[given[6] <= sheets.RELATIVE] * given[6]
        if known and all(abs(float(given[4]) - value) > apart * abs(value) for value in known):
            yield row_of(given)


def main(arguments):
    cases = [a for a in arguments if a != "--write"] or list(CASES)
    unknown = [case for case in cases if case not in CASES]
    if unknown:
        raise SystemExit(f"predicted.py: nothing for '{unknown[0]}', only for {', '.join(CASES)}")
    derived = list(derived_rows(cases))
    if "--write" in arguments:
        write(derived)
        return 0
    lines = list(differences(derived, cases))
    for line in lines:
        print(line)
    print(f"{len(derived)} predicted rows, {len(lines)} differ")
    return 1 if lines or not derived else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
