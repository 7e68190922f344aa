"""Exact values at the extremes of cases (cases/extremes), from closed forms and boundary-value problems of the other
programs.

The values are stored separately (reference/extremes), because a verification does not run the extremes.
"""
import math

from mpmath import mp, mpf, sqrt, tanh

from reference.derive import cantilevers, column, defaults, linear_buckling, release, rigid_body, sheets
from reference.derive.beam import Beam

TABLES = "extremes"
mp.dps = 40
EQUAL_WIDTH = mpf("0.223203587801597"
                  )  # width of the channel column at which its lowest bending and torsion frequencies are equal


def decimal(value):
    """Returns the value as text, rounded to 15 digits like the parameters of the program."""
    return "%.15g" % float(value)


def thin_sheet():
    for ratio in ("1e-1", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6"):
        thickness = decimal(mpf(ratio) / 10)
        for row in sheets.cantilever(shear=0, thickness=float(thickness)):
            if row[2] in ("C_xx", "C_zz", "F_y", "M_z"):
                yield (row[0], f"shear=0;thickness={thickness}") + row[2:]


def inextensible():
    for axial in (1e2, 1e4, 1e6, 1e10, 1e12, 1e14):
        beam = Beam(1.0, EA=axial, EIy=1.0, EIz=1.0, GJ=1.0)
        r, R = cantilevers.dead_load(beam, (0, 5, 0), 10)
        at = f"load=5;axial={decimal(axial)}"
        for name, value, unit in (("w_over_L", r[1], "1"), ("u_over_L", 1 - r[0], "1"),
                                  ("theta", cantilevers.planar_angle(R), "rad")):
            yield "elastica", at, name, value, unit, cantilevers.RELATIVE


def channel(**given):
    s, value, at = column.channel_data(**given), defaults.decimals("c_column",
                                                                   given), sheets.parameters(given)
    load = column.buckling_load(s, value["length"], value["shear"], False)
    frequency = column.frequencies(s, value["length"], value["shear"], value["rotary_inertia"],
                                   1)[0]
    yield "c_column", at, "buckling_load", load, "N"
    yield "c_column", at, "frequency_1", frequency, "Hz"


def channels():
    default = defaults.decimals("c_column", {})
    for ratio in ("0.1", "1", "1e2", "1e3", "1e4", "1e5"):
        length = decimal(default["height"] * mpf(ratio))
        yield from channel(length=length)
        yield from channel(length=length, shear=0, rotary_inertia=0)
    for ratio in ("2.6", "10", "1e2", "1e3", "1e4"):
        yield from channel(shear_modulus=decimal(default["young"] / mpf(ratio)))
    for ratio in ("1e-2", "1e-4", "1e-6"):
        yield from channel(flange_thickness=decimal(default["flange_thickness"] * mpf(ratio)))
    for ratio in ("0.3", "0.03", "0.01"):
        yield from channel(length=decimal(default["height"] * mpf(ratio)))
    for distance in ("1e-1", "1e-3", "1e-6", "1e-9", "1e-12"):
        width = decimal(EQUAL_WIDTH * (1 + mpf(distance)))
        s = column.channel_data(width=width)
        for i, value in enumerate(column.frequencies(s, default["length"], True, True, 2)):
            yield "c_column", f"width={width}", f"frequency_{i + 1}", value, "Hz"
    for ratio in ("1e-1", "1e-2", "1e-3", "1e-4"):
        yield from channel(width=decimal(default["width"] * mpf(ratio)))


def squares():
    default = defaults.decimals("shear_column", {})
    lengths = [
        decimal(default["side"] * mpf(ratio)) for ratio in ("1", "10", "1e2", "1e3", "1e4", "1e5")
    ]
    moduli = [decimal(default["young"] / mpf(ratio)) for ratio in ("2.6", "10", "1e2", "1e4")]
    for given in [{"length": one} for one in lengths] + [{"shear_modulus": one} for one in moduli]:
        yield linear_buckling.column_row({**given, "shear_stability": "haringx"})


def torsion():
    for kl in ("1e-3", "1e-2", "1e-1", "1e2", "1e3", "1e4"):
        x = mpf(kl)
        yield "warping_torsion", f"kL={decimal(x)}", "twist_ratio", 1 - tanh(x) / x, "1"
        yield "warping_torsion", f"kL={decimal(x)};ends=fixed", "twist_ratio", 1 - tanh(
            x / 2) / (x / 2), "1"


def lateral():
    """Yields the lateral buckling loads. The initial guess is gamma^2 = c K at small K (only warping: phi'''' = c x^2
    phi) and gamma = 4.0126 (1 + a/sqrt K) at large K."""
    guess = linear_buckling.lateral_load("tip", 1, "15.7")
    for K in ("1e-2", "1e-4", "1e-6"):
        guess *= 10
        guess = linear_buckling.lateral_load("tip", K, guess)
        yield "lateral_buckling", f"K={decimal(K)}", "load_factor", guess, "1"
    guess = mpf("6.81")
    digits = mp.dps
    for K, extra, terms in (("16", 0, 160), ("1e2", 20, 300), ("1e3", 40, 500), ("1e4", 100, 1000),
                            ("1e5", 300, 2500), ("1e6", 900, 6000)):
        mp.dps = digits + extra
        limit = mpf("4.012599")
        guess = linear_buckling.lateral_load("tip", K, guess, terms)
        if K in ("1e2", "1e4", "1e6"):
            yield "lateral_buckling", f"K={decimal(K)}", "load_factor", guess, "1"
        guess = limit + (guess - limit) / sqrt(
            mpf(10)) if K != "16" else limit + (guess - limit) * mpf("0.4")
        mp.dps = digits


def twisted():
    """Yields the torque of the sheet with restrained warping and no axial force, (GJ phi/L)/(1 - tanh(kL/2)/(kL/2))
    with k^2 = GJ/EIw."""
    beam = sheets.sheet(**{**defaults.values("sheet_wagner"), "wagner": 0})
    half = math.sqrt(beam.GJ / beam.EIw) * beam.length / 2
    for angle in (0.1, 0.5, 1, 1.3, 1.4, 1.5):
        at = f"wagner=0;tip_deflection=0;tip_phi_z=0;tip_phi_x={decimal(angle)}"
        yield "sheet_wagner", at, "M_x", beam.GJ * angle / beam.length / (
            1 - math.tanh(half) / half), "N m", 5e-13, "RyRzRx"
    for angle in (0.1, 1.4, 1.6, 3):
        yield from cantilevers.wagner_strip(angle)


def turns():
    for part in (0.5, 0.75, 1.5):
        angle = 2 * math.pi * part
        yield "roll_up", f"turns={part}", "tip_gap", float(mp.sinpi(
            2 * mpf(part))) / angle, "1", 1e-13


def released():
    tip = release.bernoulli("0.25", release.bernoulli_modes())
    for axial in ("1e9", "1e12", "1200", "120000", "12000000"):
        at = f"axial={decimal(mpf(axial))};time=0.25;{release.ANY}"
        yield "release", at, "tip", tip, "1", release.ROUNDED
    for body in ("1", "1e2", "1e4", "1e6", "1e9", "1e12"):
        time, modes = decimal(mpf("1.5") * sqrt(mpf(body))), release.with_body_modes(mpf(body), 40)
        at = f"body={decimal(mpf(body))};time={time};{release.ANY}"
        yield "release", at, "tip", release.with_body(time, modes), "1", release.ROUNDED
    yield "release", f"body=1000000;time=*;{release.ANY}", "energy", mpf(1), "1", release.STATIC


def steady():
    """Yields the rows of a body that rotates steadily at 2 rad/s about a principal axis with a moment of inertia of 3
    kg m^2."""
    at = f"spin=steady;time={{}};{rigid_body.ANY}"
    yield "rigid_body", at.format("*"), "w_z", mpf(2), "rad/s"
    yield "rigid_body", at.format("*"), "energy", mpf(6), "J"
    yield "rigid_body", at.format("30"), "R_xx", mp.cos(60), "1"


def rows():
    for family in (thin_sheet, inextensible, channels, squares, torsion, lateral, twisted, turns, released,
                   steady):
        yield from family()
