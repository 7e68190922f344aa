"""Steady rotation: frequencies against angular velocity (Campbell diagrams), and a rotating cantilever with a channel
section."""
import functools
import math

import numpy as np

from reports.claims import Lookup, canonical
from reports.figures.style import plt

NAVIGATION = [("rotation.html", "rotation")]

CASE, CHANNEL = "rotating_cantilever", "c_cantilever"
KEY = "beamw_consistent"
ACROSS = "omega_star=12;stations=13"  # rotation axis normal to the beam
ALONG = "axis=1.5707963267948966;omega_star=10;stations=41;stiffness_ratio=4"
EXACT_AT = {0: "omega_star=0", 2: "omega_star=2", 6: "", 12: "omega_star=12"}
SPEEDS = (0, 10, 20, 40)  # rad/s
ELEMENTS = 10
PROTOTYPE = "beamw:mass=lumped"


def finest(look, case, parameters, key):
    point = look.points.get((case, canonical(parameters)))
    series = next((s for s in point.series if s.key == key and s.meshes), None) if point else None
    return series.meshes[-1] if series else None


def truth(look, case, parameters, quantity):
    point = look.points.get((case, canonical(parameters)))
    return next((v.truth for s in (point.series if point else [])
                 for v in s.verdicts if v.quantity == quantity and v.truth_kind == "exact"),
                math.nan)


def draw_across(site, look):
    mesh = finest(look, CASE, ACROSS, KEY)
    if mesh is None or "flap_1_curve" not in mesh.curves:
        return None
    figure, ax = plt.subplots(figsize=(7.2, 5.0))
    colour = site.styles.of(KEY)["color"]
    for name, line in (("flap", "-"), ("lag", "--")):
        for i in (1, 2, 3):
            x, value = mesh.curves[f"{name}_{i}_curve"][:2]
            ax.plot(x,
                    value,
                    line,
                    color=colour,
                    label=f"{name} ({KEY}, n = {mesh.n})" if i == 1 else None)
            ax.annotate(f"{name} {i}", (x[-1], value[-1]),
                        textcoords="offset points",
                        xytext=(4, 4 if name == "flap" else -10),
                        fontsize=8)
    dots = [(at, truth(look, CASE, parameters, f"{name}_{i}"))
            for at, parameters in EXACT_AT.items() for name in ("flap", "lag") for i in (1, 2, 3)]
    ax.plot(*zip(*dots), "ko", markersize=4, label="exact")
    for k in (1, 2, 4):
        ax.plot([0, 12], [0, 12 * k], color="0.75", linewidth=0.8, zorder=0)
        ax.annotate(f"{k} Ω", (11, 11 * k), fontsize=7, color="0.5")
    ax.set_xlim(0, 13.5)
    ax.set_ylim(0, None)
    ax.set_xlabel("angular velocity Ω [√(EI/(ρA L⁴))]")
    ax.set_ylabel("frequency ω [√(EI/(ρA L⁴))]")
    ax.legend(fontsize=8, loc="center left", bbox_to_anchor=(0, 0.55))
    return site.image(figure, "campbell_across")


def draw_along(site, look):
    """The unstable range between the critical speeds is shaded."""
    mesh = finest(look, CASE, ALONG, KEY)
    if mesh is None or "whirl_1_curve" not in mesh.curves:
        return None
    figure, (top, bottom) = plt.subplots(2,
                                         1,
                                         figsize=(7.2, 5.6),
                                         sharex=True,
                                         height_ratios=(3, 1))
    colour = site.styles.of(KEY)["color"]
    for i in (1, 2, 3, 4):
        x, value = mesh.curves[f"whirl_{i}_curve"][:2]
        top.plot(x,
                 value,
                 ".",
                 color=colour,
                 markersize=5,
                 label=f"{KEY}, n = {mesh.n}" if i == 1 else None)
    x, value = mesh.curves["growth_curve"][:2]
    bottom.plot(x, value, ".-", color=colour)
    first = truth(look, CASE, EXACT_AT[0], "flap_1")
    for ax in (top, bottom):
        ax.axvspan(first, 2 * first, color="0.9", zorder=0)
    top.plot([10] * 4, [truth(look, CASE, ALONG, f"whirl_{i}") for i in (1, 2, 3, 4)],
             "ko",
             markersize=4,
             label="exact")
    top.annotate("unstable", (1.5 * first, 0.83 * top.get_ylim()[1]),
                 ha="center",
                 fontsize=8,
                 color="0.4")
    top.set_ylim(0, None)
    top.set_ylabel("frequency in the rotating frame")
    bottom.set_ylabel("growth")
    bottom.set_xlabel("angular velocity Ω [√(EI/(ρA L⁴))]")
    top.legend(fontsize=8, loc="upper left")
    return site.image(figure, "campbell_along")


def channel_at(speed, w=1.0):
    words = ([f"omega={speed}"] if speed else []) + ([f"w={w:g}"] if w != 0.5 else [])
    return ";".join(words)


def draw_channel(site, look):
    figure, ax = plt.subplots(figsize=(7.2, 4.8))
    drawn = False
    for speed, shade in zip(SPEEDS, np.linspace(0.75, 0, len(SPEEDS))):
        mesh = look.mesh(CHANNEL, channel_at(speed), KEY, ELEMENTS)
        if mesh is None or "curve" not in mesh.curves:
            continue
        x, value = mesh.curves["curve"][:2]
        ax.plot(x, 1e-3 * value, color=str(shade))
        ax.annotate(f"{speed} rad/s", (x[-1], 1e-3 * value[-1]),
                    textcoords="offset points",
                    xytext=(4, -3),
                    fontsize=8)
        exact = [(w, 1e-3 * truth(look, CHANNEL, channel_at(speed, w), "load_at_w"))
                 for w in (0.25, 0.5, 1.0)]
        ax.plot(*zip(*exact), "o", color=str(shade), markersize=4, label=None if drawn else "exact")
        drawn = True
    if not drawn:
        plt.close(figure)
        return None
    ax.set_xlim(0, 1.15)
    ax.set_ylim(0, None)
    ax.set_xlabel("deflection w of the loaded point [m]")
    ax.set_ylabel("load F [kN]")
    ax.legend(fontsize=8)
    return site.image(figure, "campbell_channel")


def channel_rows(look):
    """Yields (angular velocity [rad/s], deflection w [m], load [N] of PROTOTYPE and of KEY, relative error of KEY,
    exact load [N])."""
    for speed in SPEEDS[1:]:
        for w in (0.25, 0.5, 1.0):
            at = channel_at(speed, w)
            exact = truth(look, CHANNEL, at, "load_at_w")
            if math.isfinite(exact):
                yield (speed, w, look.value(CHANNEL, at, PROTOTYPE, ELEMENTS, "load_at_w"),
                       look.value(CHANNEL, at, KEY, ELEMENTS,
                                  "load_at_w"), look.error(CHANNEL, at, KEY, ELEMENTS,
                                                           "load_at_w"), exact)


def orders(look, parameters, quantities):
    """Yields (formulation, [(error of the finest mesh, order) for each quantity]) at one point."""
    point = look.points.get((CASE, canonical(parameters)))
    for series in point.series if point else []:
        found = [next((v for v in series.verdicts if v.quantity == q), None) for q in quantities]
        if series.meshes and all(found):
            yield series.key, [(series.meshes[-1].errors.get(q, math.nan), v.order)
                               for q, v in zip(quantities, found)]


def present(site):
    look = Lookup(site.cases)
    curves = [finest(look, CASE, at, KEY) for at in (ACROSS, ALONG)]
    return any(m is not None and m.curves for m in curves) or any(channel_rows(look))


def write(site):
    look = Lookup(site.cases)
    quantities = ("flap_1", "flap_3", "lag_1", "stretch")
    site.write("campbell.html",
               "rotation.html",
               across=draw_across(site, look),
               along=draw_along(site, look),
               channel=draw_channel(site, look),
               rows=list(channel_rows(look)),
               elements=ELEMENTS,
               quantities=quantities,
               orders=list(orders(look, EXACT_AT[12], quantities)))


def tasks(site):
    return [functools.partial(write, site)]
