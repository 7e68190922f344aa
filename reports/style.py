"""One colour and marker per formulation, everywhere the same; distinguishable without colour vision (Okabe and Ito)."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C6D31")
MARKERS = "osD^vP*X<>"

plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.25, "grid.linewidth": 0.5, "axes.spines.top": False, "axes.spines.right": False,
                     "legend.frameon": False, "svg.hashsalt": "beamwork", "lines.markersize": 4.5, "lines.linewidth": 1.2})


class Styles:
    """keys: all formulation keys of a result file."""

    def __init__(self, keys):
        self.order = {key: i for i, key in enumerate(sorted(set(keys)))}

    def of(self, key):
        i = self.order[key]
        return {"color": COLOURS[i % len(COLOURS)], "marker": MARKERS[i % len(MARKERS)], "linestyle": ("-", "--", ":")[i // len(COLOURS) % 3]}
