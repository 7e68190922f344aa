"""Motion pages: integrators, energies, momenta, steps, and quantities over time. Each case with a motion has a page
(table `motion` of the results)."""
import functools
import math
import re
from dataclasses import dataclass

import h5py
import numpy as np
import yaml
from markupsafe import Markup, escape

from reports import pictures, shapes, verdicts
from reports.figures.chart import Chart
from reports.data import holds, text
from reports.figures.style import COLOURS

TABLE = "motion"
MOMENTA = {"P": ("px", "py", "pz"), "L": ("lx", "ly", "lz")}


@dataclass
class Motion:
    """One motion. `columns` is {name: values}. The first value belongs to the start."""

    formulation: str
    elements: int
    columns: dict

    @property
    def time(self):
        return self.columns["time"]

    @property
    def steps(self):
        return self.columns["step"][1:]

    @property
    def energy(self):
        return self.columns["kinetic"] + self.columns["strain"]

    @property
    def scale(self):
        return float(max(np.abs(self.energy).max(), np.abs(self.columns["work"]).max()))

    @property
    def drift(self):
        return self.columns["drift"] / (self.scale or 1)

    def momentum(self, which):
        return np.stack([self.columns[name] for name in MOMENTA[which]], axis=1)

    def stays(self, which):
        """Returns the largest relative change of a momentum, or NaN if the momentum is zero."""
        found = self.momentum(which)
        size = np.linalg.norm(found, axis=1).max()
        change = np.linalg.norm(found - found[0], axis=1).max()
        return float(change / size) if size > 0 else float("nan")


def motions_of(path, case, point="default"):
    with h5py.File(path) as file:
        group = file[f"cases/{case}"]
        if TABLE not in group or not len(group[TABLE]):
            return []
        table = group[TABLE][()]
    table = table[table["point"] == point.encode()]
    out = []
    for key in np.unique(table["formulation"]):
        own = table[table["formulation"] == key]
        own = own[own["elements"] == own["elements"].max()]
        if "analysis" in own.dtype.names:
            own = own[own["analysis"] == own["analysis"].max()]
        columns = {name: own[name].astype(float) for name in own.dtype.names
                   if own[name].dtype.kind in "fiu"}
        if len(own) > 1:
            out.append(Motion(key.decode(), int(own["elements"][0]), columns))
    return out


def has_motions(path):
    with h5py.File(path) as file:
        return any(TABLE in group and len(group[TABLE]) for group in file["cases"].values())


def how(point):
    """Returns the settings of the last motion of the scene, or {}."""
    analyses = (yaml.safe_load(point.scene) or {}).get("analyses", {}) if point.scene else {}
    found = [a["motion"] for a in analyses.values() if "motion" in a]
    return found[-1] if found else {}


@dataclass(frozen=True)
class Truth:
    time: float
    value: float


def truths_of(path, case, quantity, end):
    """Returns [Truth] of a quantity at the default parameters except `time`, which may have any value. `end` is the
    default of `time`."""
    with h5py.File(path, driver="core", backing_store=False) as file:
        table = file["truths"].get(case)
        names = ("parameters", "quantity", "model", "formulation")
        rows = zip(*([text(v) for v in table[n]] for n in names), table["value"]) if table else ()
        found = {}
        for at, of, model, formulation, value in rows:
            said = dict(item.split("=", 1) for item in at.split(";") if item)
            time = said.pop("time", str(end))
            rest = ";".join(f"{name}={what}" for name, what in said.items())
            if of == quantity and model != "other" and not formulation and holds(rest, ""):
                found[end if time == "*" else float(time)] = float(value)
    return [Truth(*item) for item in sorted(found.items())]


ROUND_OFF = 1e-6  # relative change below which a momentum is treated as conserved


def scheme(how):
    name = how.get("integrator", "alpha")
    if name != "alpha":
        return name
    if how.get("trapezoidal"):
        return "the trapezoidal rule"
    if "hht" in how:
        return f"HHT ({float(how['hht']):g})"
    if "parameters" not in how:
        return f"alpha (rho {float(how.get('rho', 0.9)):g})"
    alpha_m, alpha_f = map(float, how["parameters"])
    if not alpha_m:
        return f"HHT ({alpha_f:g})" if alpha_f else "the trapezoidal rule"
    rho = alpha_f / (1 - alpha_f) if alpha_f != 1 else math.inf
    if abs((2 * rho - 1) / (rho + 1) - alpha_m) < 1e-9:
        return f"alpha (rho {rho:.3g})"
    return f"alpha ({alpha_m:.3g}, {alpha_f:.3g})"


def words_of_steps(motion):
    lengths = motion.steps
    if np.ptp(lengths) <= 1e-6 * lengths.max():
        return f"{len(lengths)} steps of {lengths[0]:.3g} s"
    return f"{len(lengths)} steps of {lengths.min():.2g} to {lengths.max():.2g} s"


def words_of_momenta(motion):
    changes = [c for c in (motion.stays("P"), motion.stays("L")) if math.isfinite(c)]
    if changes and max(changes) < ROUND_OFF:
        return f", momentum and angular momentum by {max(changes):.0e}"
    return ""


def sentence(motion, how):
    rejected = int(motion.columns["rejected"].sum())
    tries = (f" ({rejected} longer {'one' if rejected == 1 else 'ones'} rejected)"
             if rejected else "")
    drift = float(np.abs(motion.drift).max())
    name = scheme(how)
    tolerance = float(how.get("tolerance", 0))  # YAML reads 1e-05 as a string
    by = f" with a tolerance of {tolerance:g} per step" if tolerance else ""
    return (f"{name[0].upper()}{name[1:]}{by} takes {words_of_steps(motion)}{tries} to "
            f"{motion.time[-1]:.4g} s, {motion.columns['iterations'][1:].mean():.1f} iterations "
            f"each; energy drifts by at most {drift:.0e} of its largest "
            f"value{words_of_momenta(motion)}.")


def between(values, form):
    least, most = form.format(min(values)), form.format(max(values))
    return least if least == most else f"{least} to {most}"


def whenever(meaning):
    return re.sub(r", \S+ s after the start of the motion", "", meaning)


def spread(motions):
    """Describes the ranges of the energy-balance error and of the iterations over all formulations. Returns an empty
    string if there is only one motion."""
    if len(motions) < 2:
        return ""
    drifts = [float(np.abs(m.drift).max()) for m in motions]
    counts = [float(m.columns["iterations"][1:].mean()) for m in motions]
    return (f"In all {len(motions)} formulations energy drifts by "
            f"{between(drifts, '{:.0e}')}, and a step takes {between(counts, '{:.1f}')} iterations.")


PREFIXES = ((1e-6, "µ"), (1e-3, "m"), (1.0, ""), (1e3, "k"))
POWERS = {1e-6: "10⁻⁶ ", 1e-3: "10⁻³ ", 1e3: "10³ "}
PLAIN = ("m", "rad", "J", "N", "N m", "s")  # units to which a prefix can be added


def fitting(values, unit):
    """Returns (size in terms of `unit`, name) of a unit that suits the largest of these values."""
    largest = float(np.abs(np.asarray(values, float)).max(initial=0))
    size, prefix = 1.0, ""
    for one, name in PREFIXES:
        if largest >= 0.2 * one and largest > 0:
            size, prefix = one, name
    if 0.01 <= largest <= 9999 or size == 1:
        return 1.0, unit
    if unit in PLAIN and not (unit in ("m", "rad") and size > 1):
        return size, prefix + unit
    return size, POWERS[size] + unit if unit not in ("", "1") else POWERS[size].strip()


WIDE, HALF = (640, 200), (300, 170)
MOST_POINTS = 150  # largest number of points of a curve
MOST_CURVES = 7  # largest number of curves of formulations; together with the reference value, style.MOST
FLOOR = 1e-17  # smallest drawn energy-balance error
# column: name, colour and line
ENERGIES = {"kinetic": ("kinetic", 0, "-"), "strain": ("strain", 1, "-"),
            "work": ("work", 2, "--"), "dissipated": ("dissipated", 3, "-."),
            "energy": ("kinetic and strain", 6, ":")}
AXES = {"x": (0, "-"), "y": (1, "--"), "z": (2, ":")}


def thinned(values, most=MOST_POINTS):
    return np.unique(np.linspace(0, len(values) - 1, min(len(values), most)).round().astype(int))


def largest(x, y, most=MOST_POINTS):
    """Returns (x, y) of the largest y in each of `most` intervals, so that no peak is lost."""
    parts = np.array_split(np.arange(len(y)), min(len(y), most))
    at = [int(part[np.nanargmax(y[part])]) for part in parts]
    return x[at], y[at]


def line(site, panel, name, look, x, y, unit, size):
    """Draws a curve that belongs to no formulation. `unit` is the unit of y, and `size` is the size of the unit of the
    axis in terms of `unit`."""
    index, dash = look
    marks = thinned(x, 9)
    told = site.points(name, ("time", f"value [{unit}]"),
                       [(f"{x[i]:.4g} s", float(y[i])) for i in marks])
    panel.plot(x, y / size, label=name, marks=marks,
               **{**told, "color": COLOURS[index][0], "marker": "osDv^PX"[index % 7],
                  "linestyle": dash, "markersize": 3})


def draw_energies(site, motion, name):
    chart = Chart(1, WIDE)
    values = {**motion.columns, "energy": motion.energy}
    size, unit = fitting(motion.scale, "J")
    panel = chart.panel("", "time [s]", f"energy [{unit}]", xlog=False, ylog=False)
    at = thinned(motion.time)
    for column, (words, index, dash) in ENERGIES.items():
        y = values[column]
        if column in ("kinetic", "strain", "energy") or np.abs(y).max() > 1e-12 * motion.scale:
            line(site, panel, words, (index, dash), motion.time[at], y[at], "J",
                 size)
    return chart.image(site, name)


def draw_momenta(site, motion, name):
    chart = Chart(2, HALF, gap=(76, 52))
    at = thinned(motion.time)
    for which, words, unit in (("P", "momentum", "kg m/s"), ("L", "angular momentum", "kg m²/s")):
        found = motion.momentum(which)
        size, shown = fitting(found, unit)
        panel = chart.panel(f"{words} [{shown}]", "time [s]", "", xlog=False, ylog=False)
        for i, (axis, look) in enumerate(AXES.items()):
            line(site, panel, axis, look, motion.time[at], found[at, i], unit, size)
    return chart.image(site, name)


def leading(motions):
    """Returns the motions that are drawn, at most MOST_CURVES. Options and uncorrected misprints are omitted first."""
    rank = sorted(motions, key=lambda m: (verdicts.corrected(m.formulation) is not None,
                                          ":" in m.formulation))
    return rank[:MOST_CURVES]


def compared(site, panel, motion, x, y, what):
    marks = thinned(x, 9)
    look = site.points(motion.formulation, ("time", what),
                       [(f"{x[i]:.4g} s", float(f"{y[i]:.3g}")) for i in marks],
                       f"n = {motion.elements}")
    panel.plot(x, y, label=motion.formulation, marks=marks, **{**look, "markersize": 3})


def draw_drifts(site, motions, name):
    chart = Chart(1, WIDE)
    panel = chart.panel("", "time [s]", "drift of energy", xlog=False)
    for motion in leading(motions):
        x, y = largest(motion.time[1:], np.abs(motion.drift[1:]))
        compared(site, panel, motion, x, np.maximum(y, FLOOR), "drift")
    return chart.image(site, name)


def draw_steps(site, motions, name):
    """Draws step lengths and iterations, or only iterations if all steps are equal."""
    told = leading(motions)
    equal = all(np.ptp(m.steps) <= 1e-6 * m.steps.max() for m in told)
    chart = Chart(1 if equal else 2, WIDE if equal else HALF, gap=(76, 52))
    if not equal:
        panel = chart.panel("step [s]", "time [s]", "", xlog=False)
        for motion in told:
            at = thinned(motion.steps)
            compared(site, panel, motion, motion.time[1:][at], motion.steps[at], "step [s]")
    panel = chart.panel("" if equal else "iterations", "time [s]",
                        "iterations of a step" if equal else "", xlog=False, ylog=False)
    panel.y.take([0])
    for motion in told:
        x, y = largest(motion.time[1:], motion.columns["iterations"][1:])
        compared(site, panel, motion, x, y, "iterations")
    return chart.image(site, name)


def over_time(case, quantity):
    """Returns {formulation: (times, values, elements, whole)} of the finest meshes. The values are the curve of the
    quantity if `whole` is True, otherwise values at points that differ only in `time`."""
    out, end = {}, end_of(case)
    for series in case.points[0].series:
        curves = [m for m in series.meshes if quantity in m.curves and
                  m.curves[quantity][3] == "s" and len(m.curves[quantity][0])]
        if curves:
            x, y = curves[-1].curves[quantity][:2]
            out[series.key] = (np.array(x, float), np.array(y, float), curves[-1].n, True)
    if out or end is None:
        return out
    for point in case.points:
        said = dict(item.split("=", 1) for item in point.parameters.split(";") if item)
        time = float(said.pop("time", end))
        for series in point.series if not said else ():
            done = [m for m in series.meshes if math.isfinite(m.values.get(quantity, math.nan))]
            if done:
                out.setdefault(series.key, []).append((time, done[-1].values[quantity],
                                                       done[-1].n))
    return {key: (*map(np.array, zip(*[row[:2] for row in sorted(rows)])), rows[0][2], False)
            for key, rows in out.items()}


def end_of(case):
    found = [p for p in case.parameters if p["parameter"] == "time"]
    return float(found[0]["default"]) if found else None


def draw_quantity(site, case, name, image):
    """Draws a quantity over the computed time, with its reference values. Returns None if the quantity is known at only
    one time."""
    found, end = over_time(case, name), end_of(case)
    instants = {t for x, *_ in found.values() for t in x}
    if len(instants) < 2:
        return None
    truths = truths_of(site.truths, case.name, name, end) if end is not None else []
    truths = [t for t in truths if t.time <= max(instants) * (1 + 1e-9)]
    unit = case.points[0].units.get(name, "")
    chart = Chart(1, WIDE)
    size, shown = fitting(np.concatenate([y for _, y, _, _ in found.values()]), unit)
    panel = chart.panel("", "time [s]", f"{name} [{shown}]", xlog=False, ylog=False)
    keys = sorted(found, key=lambda k: (verdicts.corrected(k) is not None, ":" in k))[:MOST_CURVES]
    for key in keys:
        x, y, n, whole = found[key]
        at = thinned(x)
        marks = thinned(x[at], 12)
        look = site.points(key, ("time", f"{name} [{unit}]"),
                           [(f"{x[at][i]:.4g} s", float(y[at][i])) for i in marks], f"n = {n}")
        look = {**look, "markersize": 3, **({} if whole else {"linestyle": "none"})}
        panel.plot(x[at], y[at] / size, label=f"{key}, n = {n}", marks=marks, **look)
    if truths:
        look = site.points("truth", ("time", f"{name} [{unit}]"),
                           [(f"{t.time:g} s", t.value) for t in truths])
        panel.plot([t.time for t in truths], [t.value / size for t in truths], label="truth",
                   **{**look, "color": COLOURS[6][0], "marker": "x", "markersize": 8,
                      "linestyle": "none"})
    return chart.image(site, image)


NAVIGATION = [("motions.html", "motions")]


def present(site):
    return not site.alone and has_motions(site.results)


def file_of(case):
    return f"motion_{case.name}.html"


def leader(motions):
    return leading(motions)[0]


def parts_of(site, case, motions):
    first, name = leader(motions), f"motion_{case.name}"
    drawn = [(q, draw_quantity(site, case, q, f"{name}_{q}"))
             for q in dict.fromkeys([*case.points[0].meanings, *case.points[0].units])]
    s = shapes.read(site, case)
    return {
        "case": case, "first": first,
        "sentence": sentence(first, how(case.points[0])),
        "spread": spread(motions), "whenever": whenever,
        "space": pictures.markup(case, s) if s is not None and shapes.FRAME in s.kind else None,
        "quantities": [(q, image) for q, image in drawn if image],
        "energies": draw_energies(site, first, f"{name}_energies"),
        "drifts": draw_drifts(site, motions, f"{name}_drifts"),
        "momenta": draw_momenta(site, first, f"{name}_momenta"),
        "steps": draw_steps(site, motions, f"{name}_steps"),
    }


def found_in(site):
    found = ((case, motions_of(site.results, case.name)) for case in site.cases)
    return [(case, motions) for case, motions in found if motions]


def section(site, case):
    motions = motions_of(site.results, case.name)
    if not motions:
        return []
    told = escape(sentence(leader(motions), how(case.points[0])))
    link = f'<a href="{file_of(case)}">Energies, momenta, steps and quantities over time</a>'
    return [("In time", Markup(f"<p>{told} {link}.</p>"))]


def write(site):
    rows = [(case, file_of(case), sentence(leader(motions), how(case.points[0])),
             leader(motions)) for case, motions in found_in(site)]
    site.write("motions.html", "motions.html", rows=rows)


def write_case(site, case):
    motions = motions_of(site.results, case.name)
    if motions:
        site.write("motion.html", file_of(case), **parts_of(site, case, motions))


def tasks(site):
    return [functools.partial(write, site)] + [
        functools.partial(write_case, site, case) for case in site.cases]
