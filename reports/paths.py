"""Equilibrium paths: load against deflection of the cantilever with a channel section compared with 3-D solids, the
conclusions of J section 5.2, and paths with limit points."""
import dataclasses
import functools
import math

import h5py
import numpy as np

from reports.claims import Lookup, canonical
from reports.data import of_mesh, rows, text
from reports.figures.style import plt

NAVIGATION = [("paths.html", "paths")]

CASE = "c_cantilever"
EDGES = {"D": "load_height=edge;w=2.6",
         "E": "load_point=E;load_height=edge;w=1.2"}  # load point: parameters for which solid models were computed
FORMS = (("beamw_first", "first-order modes"), ("beamw_vlasov", "J Eq. 66"),
         ("beamw_consistent", "consistent second order"))
EXACT, COARSE = "collocation", 10
WAGNER = "wagner_moments=1"  # includes the part of the Wagner moments that J omits
SHEAR = ((1.0, ""), (2.5, ""), (1.0, "load_point=E;"))
SNAPS = ("lee_frame", "snap_through")
EVENTS = ("limit point", "bifurcation", "branch jump")


@dataclasses.dataclass
class Solid:
    """Points on a curve of another model, such as 3-D solids: `value` at the deflections `w` [m]."""
    w: np.ndarray
    value: np.ndarray
    source: str


@dataclasses.dataclass
class Event:
    kind: str
    before: int
    after: int
    factor: float
    control: float
    other: float


def solid(truths, parameters, quantity):
    with h5py.File(truths) as file:
        if CASE not in file["truths"]:
            return None
        table = file["truths"][CASE]
        columns = {
            name: [text(v) for v in table[name]]
            for name in ("parameters", "quantity", "source", "model")
        }
        value, at = table["value"], table["at"]
    rows = [
        i for i, q in enumerate(columns["quantity"])
        if q == quantity and columns["model"][i] == "other" and
        canonical(columns["parameters"][i].replace("wagner_moments=*", "")) == canonical(parameters)
    ]
    if not rows:
        return None
    w = at[rows]
    order = np.argsort(w)
    return Solid(w[order], value[rows][order], columns["source"][rows[0]])


def events(site, case, point, key, n):
    with h5py.File(site.results) as file:
        found = rows(file["cases"][case], "events")
    return [
        Event(e["event"], e["negative_before"], e["negative_after"], e["factor"], e["control"],
              e["other_factor"]) for e in found if of_mesh(e) == (point, key, n)
    ]


def draw_curve(ax, mesh, quantity, scale, label, style):
    if mesh and quantity in mesh.curves:
        x, value = mesh.curves[quantity][:2]
        ax.plot(x, scale * value, label=label, **style())


def draw_cantilever(site, look):
    """Draws load and lateral displacement against w for the load points D and E, together with the solid models."""
    figure, axes = plt.subplots(2, 2, figsize=(11, 7.4), sharex="col")
    for column, (letter, parameters) in enumerate(EDGES.items()):
        for row, (quantity, scale, label) in enumerate(
            (("curve", 1e-3, "load [kN]"), ("lateral_curve", 1.0, "lateral displacement [m]"))):
            ax = axes[row][column]
            for key, name in (*FORMS, (EXACT, "exact beam")):
                mesh = look.mesh(CASE, parameters, key, COARSE)
                draw_curve(ax,
                           mesh,
                           quantity,
                           scale,
                           label=f"{name} ({key}, n = {COARSE})",
                           style=lambda key=key: {**site.styles.of(key), "marker": ""})
            draw_curve(ax,
                       look.mesh(CASE, f"{parameters};{WAGNER}", EXACT, COARSE),
                       quantity,
                       scale,
                       label="exact beam, with int y (y² + z²) dA",
                       style=lambda: {"color": "0.3", "linestyle": "--"})
            other = solid(site.truths, parameters, quantity)
            if other:
                ax.plot(other.w, scale * other.value, "k.", markersize=4, label="3-D solids")
            ax.set_ylabel(label)
            ax.set_title(f"force at {letter}" if row == 0 else "")
            if row == 1:
                ax.set_xlabel("deflection w of the loaded point [m]")
    axes[0][0].legend(fontsize=8)
    figure.tight_layout()
    return site.image(figure, "paths_cantilever")


def draw_convergence(site, look, parameters):
    figure, ax = plt.subplots(figsize=(6.4, 3.8))
    for key, name in (*FORMS, ("geometrically_exact", "geometrically exact")):
        point = look.points.get((CASE, canonical(parameters)))
        series = next((s for s in point.series if s.key == key), None) if point else None
        pairs = [(m.n, abs(m.errors["load_at_w"])) for m in (series.meshes if series else [])
                 if math.isfinite(m.errors.get("load_at_w", math.nan))]
        if pairs:
            ax.plot(*zip(*pairs), label=f"{name} ({key})", **site.styles.of(key))
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xticks([5, 10, 20, 40, 80], ["5", "10", "20", "40", "80"])
    ax.minorticks_off()
    ax.set_xlabel("elements")
    ax.set_ylabel("relative error of the load at w = 1 m")
    ax.legend(fontsize=8)
    return site.image(figure, "paths_convergence")


def draw_snap(site, look, case):
    """Draws the path of beamw_consistent on its finest mesh. Returns (Image, critical points [Event]), or None
    without a path."""
    point = look.points.get((case, ""))
    series = next((s for s in point.series if s.key == "beamw_consistent"), None) if point else None
    if series is None or "curve" not in series.meshes[-1].curves:
        return None
    mesh = series.meshes[-1]
    x, value, x_name, x_unit, unit = mesh.curves["curve"]
    figure, ax = plt.subplots(figsize=(5.2, 3.6))
    ax.plot(x,
            value,
            **{**site.styles.of(series.key), "marker": "."},
            label=f"{series.key}, n = {mesh.n}")
    found = events(site, case, point.name, series.key, mesh.n)
    for kind, marker in zip(EVENTS, "^sx"):
        at = [e for e in found if e.kind == kind]
        if at:
            ax.plot([-e.control for e in at], [e.factor for e in at],
                    marker,
                    color="k",
                    markersize=7,
                    label=kind,
                    linestyle="none")
    ax.set_xlabel(f"{x_name} [{x_unit}]")
    ax.set_ylabel(f"load [{unit}]")
    ax.legend(fontsize=8)
    return site.image(figure, f"paths_{case}"), found


def percent(value):
    return f"{100 * value:+.2f} %" if math.isfinite(value) else "–"


def conclusions(site, look):
    def load(parameters, key, n):
        return look.value(CASE, parameters, key, n, "load_at_w")

    shear = [(f"{point}w={w:g}",
              load(f"{point}shear=1;w={w:g}", EXACT, 80) / load(f"{point}w={w:g}", EXACT, 80) - 1)
             for w, point in SHEAR]
    yield "The Vlasov model suffices here", "shear changes the load by " + ", ".join(
        f"{percent(v)} ({p})" for p, v in shear)
    differences = [
        load(f"w={w:g}" if w != 0.5 else "", "beamw_vlasov", COARSE) /
        load(f"w={w:g}" if w != 0.5 else "", "beamw_first", COARSE) - 1
        for w in (0.125, 0.5, 1, 2.5)
    ]
    yield (
        "The effect of the second-order terms is negligibly small",
        f"Eq. 66 changes the load by {', '.join(percent(d) for d in differences)} at w = 0.125, 0.5, 1, 2.5 m with {COARSE} elements"
    )
    errors = [
        f"{key}: " + ", ".join(f"{percent(look.error(CASE, 'w=1', key, n, 'load_at_w'))}"
                               for n in (5, 10, 20, 40)) for key, _ in FORMS
    ]
    yield "Second-order terms do not reduce the number of elements", "errors with 5, 10, 20, 40 elements at w = 1 m. " + "; ".join(
        errors)
    for letter, parameters in EDGES.items():
        for more, words in (("", "as J"), (WAGNER,
                                           "with int y (y² + z²) dA in the Wagner moments")):
            gaps = [(w, look.value(CASE, f"{at};{more}", EXACT, 80, "load_at_w") / load_there - 1)
                    for w, at, load_there in model_points(site, parameters)]
            yield f"Good agreement with a model of the walls (force at {letter})", f"exact beam {words} against 3-D solids: " + ", ".join(
                f"{percent(g)} (w = {w:g} m)" for w, g in gaps)


def model_points(site, parameters):
    """Yields (deflection w [m], parameters of the point at which the load is compared, load of the solid model [N])."""
    other = solid(site.truths, parameters, "curve")
    base = parameters.rsplit(";", 1)[0]
    for w in (0.1, 0.2, 0.494, 0.5, 1.04, 1.2, 2.6):
        at = canonical(base if w == 0.5 else f"{base};w={w:g}")
        near = [v for x, v in zip(other.w, other.value) if abs(x - w) < 1e-9] if other else []
        if near and any(p.parameters and canonical(p.parameters) == at
                        for p in site.case(CASE).points):
            yield w, at, near[0]


def continued(site, case):
    found = site.case(case)
    return found is not None and any("curve" in m.curves for s in found.points[0].series
                                     if s.key == "beamw_consistent" for m in s.meshes[-1:])


def present(site):
    return site.case(CASE) is not None or any(continued(site, case) for case in SNAPS)


def write(site):
    look = Lookup(site.cases)
    cantilever = site.case(CASE) is not None
    snaps = [(case, drawn) for case in SNAPS if (drawn := draw_snap(site, look, case))]
    other = solid(site.truths, EDGES["D"], "curve") if cantilever else None
    site.write("paths.html",
               "paths.html",
               cantilever=draw_cantilever(site, look) if cantilever else None,
               convergence=draw_convergence(site, look, "w=1") if cantilever else None,
               conclusions=list(conclusions(site, look)) if cantilever else [],
               snaps=snaps,
               source=other.source if other else "")


def tasks(site):
    return [functools.partial(write, site)]
