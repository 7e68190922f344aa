"""What is in the cells of a sweep, for maps over the axes of the reader's choice: a script of its
own beside the page, which assets/sweep.js loads when something is chosen.

Cells are letters, each with how often it follows itself. The last axis changes first."""
import itertools
import json
import os

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_hex

from reports.sweep import figures, maps

# Upper ends of the classes of errors, percent, beside the tolerance; then come larger errors, and
# none at all.
LEVELS = [m * 10.0**e for e in range(-3, 2) for m in (1, 2, 5)] + [100.0]
SPECIAL = {maps.EMPTY: "_", maps.UNKNOWN: "?"}


def written(states):
    """States of cells as one text."""
    out = []
    for state, same in itertools.groupby(states.ravel().tolist()):
        times = len(list(same))
        out.append(SPECIAL.get(state) or chr(ord("a") + state))
        out.append(str(times) if times > 1 else "")
    return "".join(out)


def levels_of(tolerance):
    """LEVELS, and the tolerance."""
    own = float(f"{100 * tolerance:.6g}")
    return sorted({*LEVELS, own})


def classes(worst, points, levels):
    """Classes of the largest errors in cells [C]."""
    found = np.searchsorted(levels, 100 * worst.astype(float) * (1 - 1e-6))  # single precision
    found = np.where(np.isinf(worst), len(levels) + 1, found)
    return np.where(points == 0, maps.EMPTY, np.where(worst < 0, maps.UNKNOWN, found))


def looks_of_errors(tolerance):
    """{class: fill, ink, sign, words}: light while it is within the tolerance, the boundary between
    the two halves of the colours at it."""
    out, levels = {}, levels_of(tolerance)
    inside = [x for x in levels if x <= 100 * tolerance * (1 + 1e-5)]
    for k, x in enumerate([*levels, np.inf]):
        if k < len(inside):
            at = 0.97 - 0.42 * k / max(1, len(inside) - 1)
        else:
            at = 0.3 - 0.3 * (k - len(inside)) / max(1, len(levels) - len(inside))
        fill = to_hex(colormaps["viridis"](at))
        sign = f"{x:g}" if np.isfinite(x) else ">"
        words = f"{x:g} %" if np.isfinite(x) else f"more than {levels[-1]:g} %"
        out[k] = look(fill, sign, ("up to " if np.isfinite(x) else "") + words)
    out[len(levels) + 1] = look("#45342c", "!", "no solution")
    out[maps.UNKNOWN] = look("none", "?", "nothing to measure by")
    return out


def look(fill, sign, words):
    return {"fill": fill, "ink": maps.ink(fill), "sign": sign, "words": words}


def axis_of(part):
    """What a map needs of an axis: names of its parts, the cuts between them, and where ticks may
    stand, in parts."""
    low, high = part.low[0], part.high[-1]
    return {"name": part.axis.name, "range": [float(f"{low:.6g}"), float(f"{high:.6g}")],
            "cuts": part.cuts.tolist(), "words": bool(part.axis.words), "title": maps.title_of(part), "names": [part.name(i) for i in range(len(part))],
            "slices": [[words, [int(group[0]), int(group[-1])]]
                       for words, group in figures.slices_of(part)],
            "ticks": [[round(float(at), 3), words] for at, words in maps.marks(part)]}


def of_sweep(sweep, found, order):
    """The data. order: of formulations, by key."""
    elements = maps.Look(sweep.meshes)
    asked = range(len(sweep.quantities) + 1)
    keys, levels = range(len(sweep.keys)), levels_of(sweep.tolerance)
    return {
        "axes": [axis_of(p) for p in found.parts], "keys": sweep.keys, "meshes": sweep.meshes,
        "order": [sweep.keys.index(key) for key in order],
        "none": elements.none, "some": elements.some, "failed": elements.failed,
        "sizes": {"left": maps.LEFT, "top": maps.TOP, "below": maps.BELOW, "right": maps.RIGHT,
                  "letter": maps.LETTER, "wide": maps.WIDE, "narrow": figures.NARROW},
        "elements": {k: look(elements.fill[k], elements.sign[k], elements.words[k])
                     for k in elements.fill},
        "errors": looks_of_errors(sweep.tolerance),
        "least": [[written(maps.states(found.reach[:, f, q], found.points, elements))
                   for f in keys] for q in asked],
        "worst": [[[written(classes(found.worst[:, f, q, m], found.points, levels))
                    for f in keys]
                   for m in range(len(sweep.meshes))] for q in asked]}


def write(site, name, sweep, found, order):
    """The file of that name beside the pages."""
    text = json.dumps(of_sweep(sweep, found, order), separators=(",", ":"), ensure_ascii=False)
    path = os.path.join(site.folder, name)
    with open(f"{path}.part", "w", encoding="utf-8") as out:
        out.write(f"beamwork_sweep({text});\n")
    os.replace(f"{path}.part", path)
