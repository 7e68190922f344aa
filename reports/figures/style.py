"""Colours and markers of formulations.

The colours are distinguishable without colour vision (Okabe and Ito, Tol). In dark mode, each colour is replaced by a
lighter colour of the same hue: svg.py writes a variable, which the style sheet defines (sheet()).
"""
import zlib

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.markers import MarkerStyle  # noqa: E402

# name: colour, colour on a dark page, and marker
TABLE = {
    "beamw": ("#0072b2", "#4a9fe0", "o"),
    "beamw_consistent": ("#d55e00", "#ff8c42", "s"),
    "beamw_first": ("#009e73", "#2bc495", "D"),
    "beamw_vlasov": ("#cc79a7", "#eba6cb", "^"),
    "collocation": ("#e69f00", "#f5b942", "v"),
    "geometrically_exact": ("#56b4e9", "#8fd2fa", "P"),
    "sheet_second": ("#000000", "#f4f6f9", "*"),
    "sheet_second_consistent": ("#8c6d31", "#c9a55c", "X"),
    "sheet_third": ("#882255", "#d8639b", "<"),
    "sheet_third_printed": ("#44aa99", "#7fdccd", ">"),
}
# Colours and markers of integrators of motions.
SCHEMES = {
    "alpha": ("#0072b2", "#4a9fe0", "o"), "conserving": ("#d55e00", "#ff8c42", "s"),
    "radau": ("#009e73", "#2bc495", "D"), "explicit": ("#882255", "#d8639b", "^"),
    "hht": ("#56b4e9", "#8fd2fa", "v"), "trapezoidal": ("#000000", "#f4f6f9", "X"),
}
# Formulations that are not in the table have one of these colours, selected by their names.
RESERVE = (("#6a51a3", "#a793dc"), ("#a6761d", "#dfb060"), ("#c51b7d", "#f06cb4"),
           ("#1b7837", "#5fc07c"), ("#5b6675", "#aab4c2"))
RESERVE_MARKERS = "hpd8H"
MOST = 8  # number of curves of a figure that are initially shown
LAST = ("sheet_third_printed", "beamw_vlasov", "beamw_first")  # shown only if there is room
# Line style of an option.
LINES = {"mass=lumped": "--", "mass=averaged": ":", "torsion=hyperbolic": "-."}
RESERVE_LINES = ((0, (6, 1)), (0, (1, 2)), (0, (4, 1, 1, 1)), (0, (8, 3)), (0, (2, 1)))

COLOURS = [(light, dark) for light, dark, _ in TABLE.values()] + list(RESERVE)
# Colours of drawings of scenes: loads, motions, springs (structure_drawing/canvas.py).
MEANINGS = {"#b03a00": "var(--bad,#b03a00)", "#005a94": "var(--accent,#005a94)",
            "#6a5a00": "var(--fair,#6a5a00)"}
VARIABLES = MEANINGS | {light: f"var(--f{i},{light})" for i, (light, _) in enumerate(COLOURS)}

plt.rcParams.update({
    "font.size": 9, "axes.grid": True, "grid.alpha": 0.25, "grid.linewidth": 0.5,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
    "svg.hashsalt": "beamwork", "svg.fonttype": "none", "font.family": "sans-serif",
    "lines.markersize": 4.5, "lines.linewidth": 1.2,
    "figure.facecolor": "none", "axes.facecolor": "none"
})


def extra(keys):
    """Returns the keys that a figure initially hides so that at most MOST curves are shown. Options are hidden first,
    then the formulations in LAST."""
    keys = list(keys)
    last = [k for k in keys if ":" in k] + [k for k in LAST if k in keys]
    rest = [k for k in keys if k not in last]
    return (rest + last[::-1])[MOST:]


def look(key):
    """Returns (colour, colour on a dark page, marker) of a formulation with or without options."""
    name = key.partition(":")[0]
    number = zlib.crc32(name.encode())
    return TABLE.get(name) or SCHEMES.get(name) or (*RESERVE[number % len(RESERVE)],
                               RESERVE_MARKERS[number // 7 % len(RESERVE_MARKERS)])


def class_of(key):
    colour, _, marker = look(key)
    number = [light for light, _ in COLOURS].index(colour)
    return f"m{number}" + ("" if key.partition(":")[0] in TABLE else marker)


def corners(marker):
    form = MarkerStyle(marker)
    outline = form.get_path().transformed(form.get_transform()).to_polygons(closed_only=True)[0]
    half = 2.2 * np.abs(outline).max()
    return ",".join(f"{50 + 100 * x / half:.0f}% {50 - 100 * y / half:.0f}%" for x, y in outline)


def marks():
    known = [(f"m{i}", i, marker) for i, (_, _, marker) in enumerate(TABLE.values())]
    reserve = [(f"m{i}{marker}", i, marker) for i in range(len(TABLE), len(COLOURS))
               for marker in RESERVE_MARKERS]
    return "".join(f".{name}::before {{ background: var(--f{i}); "
                   f"clip-path: polygon({corners(marker)}); }}\n"
                   for name, i, marker in known + reserve)


def sheet():
    light, dark = (":root { " + " ".join(f"--f{i}: {p[k]};" for i, p in enumerate(COLOURS)) + " }"
                   for k in (0, 1))
    return f"{light}\n@media screen and (prefers-color-scheme: dark) {{ {dark} }}\n{marks()}"


def line_of(options):
    return LINES.get(options) or RESERVE_LINES[zlib.crc32(options.encode()) % len(RESERVE_LINES)]


class Styles:
    """Colours, markers and lines of formulations. `keys` are the formulation keys of a results file, in any order and
    possibly repeated."""

    def __init__(self, keys):
        self.order = sorted(set(keys))

    @staticmethod
    def of(key):
        """Returns the arguments of plot() for the curve of a formulation. The gid contains the formulation (svg.py)."""
        colour, _, marker = look(key)
        options = key.partition(":")[2]
        return {
            "color": colour, "marker": marker, "linestyle": line_of(options) if options else "-",
            "gid": f"f|{key}"
        }

    @staticmethod
    def shape(key):
        """Returns the marker as the path of an SVG picture of 12 by 12, with its centre at the origin."""
        path = MarkerStyle(look(key)[2])
        corners = path.get_path().transformed(path.get_transform()).to_polygons(closed_only=True)
        size = 5.4 / max(np.abs(c).max() for c in corners)
        return " ".join(
            "M" + "L".join(f"{size * x:.1f},{-size * y:.1f}" for x, y in c) + "Z" for c in corners)

    @staticmethod
    def fill(key):
        """Returns the colour of a formulation for a page, as a variable that changes in dark mode."""
        return VARIABLES[look(key)[0]]
