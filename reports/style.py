"""One colour and marker per formulation, everywhere the same; distinguishable without colour vision (Okabe and Ito; the last two Tol)."""
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.markers import MarkerStyle  # noqa: E402

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C6D31",
           "#882255", "#44AA99")
MARKERS = "osD^vP*X<>"

# Text stays text: it can be searched, and the figures stay small.
plt.rcParams.update({
    "font.size": 9, "axes.grid": True, "grid.alpha": 0.25, "grid.linewidth": 0.5,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
    "svg.hashsalt": "beamwork", "svg.fonttype": "none", "font.family": "sans-serif",
    "lines.markersize": 4.5, "lines.linewidth": 1.2
})


class Styles:
    """keys: all formulation keys of a result file. Options of a formulation share its colour; the line tells them apart."""

    def __init__(self, keys):
        self.order = {key: i for i, key in enumerate(sorted(set(keys)))}
        self.names = {name: i for i, name in enumerate(sorted({key.split(":")[0] for key in keys}))}

    def of(self, key):
        name, _, options = key.partition(":")
        i = self.names[name]
        same = sorted(k for k in self.order if k.startswith(f"{name}:"))
        line = ("--", ":", "-.", (0, (6, 1)), (0, (1, 2)))[same.index(key) % 5] if options else "-"
        return {
            "color": COLOURS[i % len(COLOURS)], "marker": MARKERS[i % len(MARKERS)],
            "linestyle": line
        }

    def shape(self, key):
        """The marker as the path of an SVG picture of 12 by 12, its centre at the origin."""
        path = MarkerStyle(self.of(key)["marker"])
        corners = path.get_path().transformed(path.get_transform()).to_polygons(closed_only=True)
        size = 5.4 / max(np.abs(c).max() for c in corners)
        return " ".join(
            "M" + "L".join(f"{size * x:.1f},{-size * y:.1f}" for x, y in c) + "Z" for c in corners)
