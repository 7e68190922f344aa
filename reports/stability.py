"""Stability: every formulation at every extreme, as a map, as curves of error against what is driven, and in numbers (build/stress.json)."""
import functools
import json
import math
import os

from reports.style import plt

NAVIGATION = [("stability.html", "stability")]

# From good to bad: colours that differ in brightness too, and a mark that needs no colour.
LOOK = {
    "value": ("#009E73", ""), "coarse": ("#8FD3F4", "·"), "named": ("#E69F00", "△"),
    "wrong": ("#000000", "×"), "fault": ("#CC79A7", "!")
}
MEANING = {
    "value": "a value within the extreme's tolerance",
    "coarse": "outside it, falls with more elements", "named": "a named refusal or failure",
    "wrong": "a wrong number, known and explained below", "fault": "crashed"
}
NAMED = ("not converged", "singular", "refused", "no value")


def read(path):
    """The record that `beamwork stress --json` wrote, or None."""
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def kind(outcome):
    return "named" if outcome["outcome"] in NAMED else outcome["outcome"]


class Cell:
    """One formulation at one value of one extreme: as bad as its worst quantity."""

    def __init__(self, outcomes):
        order = list(LOOK)
        worst = max(outcomes, key=lambda o: (order.index(kind(o)), abs(o["error"] or 0.0)))
        self.kind, self.outcome = kind(worst), worst["outcome"]
        self.error = max((abs(o["error"]) for o in outcomes if o["error"] is not None),
                         default=math.nan)
        self.condition, self.iterations, self.reason = worst["condition"] or math.nan, worst[
            "iterations"], worst["reason"]
        self.expected = all(o["as_expected"] for o in outcomes)
        self.mark = LOOK[self.kind][1]

    @property
    def text(self):
        return self.outcome if self.kind in (
            "named", "fault"
        ) else f"{self.error:.1e}{' ~' if self.kind == 'coarse' else ' ×' if self.kind == 'wrong' else ''}"


def cells(record):
    """{(extreme, formulation): {x: Cell}} of what was tried: some values of x only, where the others need what is not offered."""
    groups = {}
    for o in record["outcomes"]:
        if o["outcome"] != "skip":
            groups.setdefault((o["extreme"], o["formulation"], o["x"]), []).append(o)
    out = {}
    for (extreme, key, x), outcomes in groups.items():
        out.setdefault((extreme, key), {})[x] = Cell(outcomes)
    return out


def largest(found, name):
    """Of an extreme's cells, as text."""
    values = [getattr(c, name) for c in found.values() if math.isfinite(getattr(c, name))]
    return f"{max(values):.2g}" if values and max(values) > 0 else "–"


def draw_map(site, record, all_cells):
    """Rows: formulations; columns: extremes, each a strip of the values it was driven to, from left to right as in the tables."""
    extremes, keys = record["extremes"], [f["formulation"] for f in record["formulations"]]
    figure, ax = plt.subplots(figsize=(0.47 * len(extremes) + 2.6, 0.34 * len(keys) + 2.2))
    for column, extreme in enumerate(extremes):
        width = 0.9 / len(extreme["values"])
        for row, key in enumerate(keys):
            found = all_cells.get((extreme["name"], key))
            if found is None:
                ax.text(column + 0.45,
                        row + 0.45,
                        "–",
                        ha="center",
                        va="center",
                        color="#9aa3ad",
                        fontsize=8)
                continue
            for i, x in enumerate(extreme["values"]):
                cell = found.get(x)
                if cell is None:
                    ax.text(column + (i + 0.5) * width,
                            row + 0.45,
                            "–",
                            ha="center",
                            va="center",
                            color="#9aa3ad",
                            fontsize=6)
                    continue
                ax.add_patch(
                    plt.Rectangle((column + i * width, row + 0.05),
                                  width,
                                  0.8,
                                  facecolor=LOOK[cell.kind][0],
                                  edgecolor="white",
                                  linewidth=0.4))
                ax.text(column + (i + 0.5) * width,
                        row + 0.45,
                        cell.mark,
                        ha="center",
                        va="center",
                        fontsize=6,
                        color="white" if cell.kind == "wrong" else "black")
    ax.set_xlim(-0.1, len(extremes))
    ax.set_ylim(len(keys), -0.1)
    ax.set_xticks([i + 0.45 for i in range(len(extremes))], [e["name"] for e in extremes],
                  rotation=60,
                  ha="right",
                  rotation_mode="anchor",
                  fontsize=7)
    ax.set_yticks([i + 0.45 for i in range(len(keys))], keys, fontsize=8)
    ax.tick_params(length=0)
    ax.grid(False)
    for side in ax.spines.values():
        side.set_visible(False)
    present = [
        k for k in LOOK if any(c.kind == k for found in all_cells.values() for c in found.values())
    ]
    handles = [plt.Rectangle((0, 0), 1, 1, facecolor=LOOK[k][0]) for k in present]
    ax.legend(handles, [f"{k} {LOOK[k][1]}  {MEANING[k]}" for k in present],
              loc="lower center",
              bbox_to_anchor=(0.5, 1.0),
              ncols=2,
              fontsize=7.5)
    return site.image(figure, "stability_map")


def draw_curve(site, extreme, keys, all_cells):
    """Error against what is driven; a failure is a triangle on the upper edge."""
    figure, ax = plt.subplots(figsize=(6.2, 2.7))
    floor = 1e-16
    for key in keys:
        found = all_cells.get((extreme["name"], key))
        if found is None:
            continue
        points = [(x, max(found[x].error, floor)) for x in extreme["values"]
                  if x in found and math.isfinite(found[x].error)]
        style = site.styles.of(key) if key in site.styles.order else {
            "color": "#5b6675", "marker": "."
        }
        ax.plot([x for x, _ in points], [e for _, e in points], label=key, alpha=0.85, **style)
        failed = [
            x for x in extreme["values"] if x in found and found[x].kind in ("named", "fault")
        ]
        ax.plot(failed, [1] * len(failed),
                "^",
                color=style["color"],
                markersize=8,
                markerfacecolor="none",
                clip_on=False)
    ax.axhline(extreme["tolerance"], color="#5b6675", linewidth=0.8, linestyle=":")
    ax.set_yscale("log")
    ax.set_ylim(floor / 2, 1)
    if min(extreme["values"]) > 0 and max(extreme["values"]) / min(extreme["values"]) >= 20:
        ax.set_xscale("log")
    ax.set_xlabel(
        f"{extreme['x_name']}{'' if extreme['x_unit'] == '1' else ' [' + extreme['x_unit'] + ']'}")
    ax.set_ylabel("relative error")
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=7)
    figure.tight_layout()
    return site.image(figure, f"stability_{extreme['name']}")


def findings(record):
    """[(extreme, formulation, outcome, values, proof)] of what is neither a value nor coarse, values of x together."""
    rows = {}
    for o in record["outcomes"]:
        if kind(o) in ("named", "wrong", "fault"):
            rows.setdefault((o["extreme"], o["formulation"], o["outcome"], o["proof"] or
                             "not expected: " + o["reason"]), set()).add(o["x"])
    return [(*key[:3], ", ".join(f"{x:g}" for x in sorted(found)), key[3])
            for key, found in rows.items()]


def stored(site):
    """The record beside the results, or None."""
    return read(os.path.join(os.path.dirname(os.path.abspath(site.results)), "stress.json"))


def present(site):
    return stored(site) is not None


def write(site):
    record = stored(site)
    all_cells = cells(record)
    record["extremes"] = [
        e for e in record["extremes"] if any(name == e["name"] for name, _ in all_cells)
    ]
    keys = [f["formulation"] for f in record["formulations"]]
    total = {
        name: sum(f[name] for f in record["formulations"])
        for name in ("tried", "survived", "coarse", "named_failures", "wrong", "faults")
    }
    site.write("stability.html",
               "stability.html",
               record=record,
               total=total,
               image=draw_map(site, record, all_cells),
               cells=all_cells,
               keys=keys,
               findings=findings(record),
               curves={e["name"]: draw_curve(site, e, keys, all_cells)
                       for e in record["extremes"]},
               largest=largest)


def tasks(site):
    return [functools.partial(write, site)]
