"""The page of a sweep: the range over which each formulation is within a tolerance."""
import functools
import itertools
import json
import math
import os
import pathlib
import shlex

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_hex

from reports.figures.chart import Chart
from reports.sweep import answers, gather, maps

MOST_DOTS = 400  # largest number of scattered points that are drawn individually
SLICES, WORDS = 4, 6  # largest number of maps side by side over a third axis: with numbers, and with words
NARROW = 170  # width of one of several maps side by side, in pixels
TOLD = 0.01  # smallest share of points that a formulation in the first list must win
FLOOR = 1e-12  # smallest drawn error


def projected(found, table, axes):
    count = len(found.parts)
    whole = table.reshape(found.shape + table.shape[1:])
    whole = whole.sum(axis=tuple(a for a in range(count) if a not in axes))
    return np.moveaxis(whole, [sorted(axes).index(a) for a in axes], range(len(axes)))


def by_influence(found):
    """Returns the indices of the axes. The axes along which the share of results within the tolerance varies most come
    first, and axes with words come last."""
    within = found.reach[:, :, -1, :-2].sum(axis=(1, 2))
    score = []
    for a, part in enumerate(found.parts):
        known = projected(found, found.known[:, -1], [a]).astype(float)
        share = projected(found, within, [a]) / np.maximum(known, 1)
        score.append(float(np.std(share[known > 0])) if (known > 0).any() else 0.0)
    return sorted(range(len(score)), key=lambda a: (bool(found.parts[a].axis.words), -score[a], a))


def slices_of(part):
    """Returns [(label, parts)], the groups of parts of a third axis for which maps are drawn."""
    most = WORDS if part.axis.words else SLICES
    groups = np.array_split(np.arange(len(part)), min(most, len(part)))
    return [(answers.condition(part, list(g)) if len(g) < len(part) else part.axis.name, list(g))
            for g in groups]


def counted(state, look):
    drawn = state[state != maps.EMPTY]
    said = [f"{look.words[k]}: {answers.percent((drawn == k).sum() / drawn.size)}"
            for k in [*(k for k in look.words if k >= 0), maps.UNKNOWN] if (drawn == k).any()]
    return "; ".join(said) + " of the fields" if said else "no points"


class Validity:
    """Maps of the smallest number of elements. `axes` are the horizontal axis, the vertical axis and the axis of maps
    side by side. `rows` is [(formulation or empty, [(Image, alt)])]. `used` are the states that are drawn."""

    def __init__(self, sweep, found, order, q=-1):
        self.sweep, self.found, self.q = sweep, found, q
        self.look, self.used, self.axes = maps.Look(sweep.meshes), set(), by_influence(found)
        self.dots = self.scattered()
        count = len(found.parts)
        self.rows = [("", [self.strips(order)])] if count == 1 and order else [
            (key, self.of(sweep.keys.index(key), key)) for key in order]

    @property
    def legend(self):
        return self.look.legend(self.used)

    def scattered(self):
        """Returns (points, their states [points, formulations]) if there are at most MOST_DOTS scattered points on two
        axes, otherwise None."""
        sweep = self.sweep
        if len(sweep.axes) != 2 or sweep.points > MOST_DOTS or not any(
                a.scattered for a in sweep.axes):
            return None
        at, state = [], []
        for piece in sweep.pieces():
            asked = gather.asked_in(sweep, piece)
            reached = gather.reached_in(sweep, piece, asked)[:, :, self.q]
            reached = np.where(reached == self.look.none + 1, self.look.failed, reached)
            state.append(np.where(asked[:, :, self.q], reached, maps.UNKNOWN))
            at.append(piece.at)
        return np.concatenate(at), np.concatenate(state)

    def draw(self, drawn, state, name, title, what):
        self.used |= set(np.unique(state).tolist())
        return drawn.image(name, drawn.fields(state, self.look.fill, self.look.sign), title), (
            f"{what}: {counted(state, self.look)}")

    def strips(self, order):
        found, upward = self.found, order[::-1]
        rows = [self.sweep.keys.index(key) for key in upward]
        state = maps.states(found.reach[:, rows, self.q], found.points[:, None], self.look)
        drawn = maps.Map(found.parts[0], upward, 2 * maps.WIDE)
        return self.draw(drawn, state, "sweep_map", "",
                         f"elements needed over {found.parts[0].axis.name}")

    def of(self, f, key):
        found, (a, b, *more) = self.found, self.axes
        x, y = found.parts[a], found.parts[b]
        what = f"elements needed by {key} over {x.axis.name} and {y.axis.name}"
        if self.dots:
            at, state = self.dots
            drawn = maps.Map(x, y)
            self.used |= set(np.unique(state[:, f]).tolist())
            image = drawn.image(f"sweep_map_{f}", drawn.dots(at[:, [a, b]], state[:, f],
                                                             self.look.fill, self.look.sign), key)
            return [(image, f"{what}: {counted(state[:, f], self.look)}".replace("fields",
                                                                                  "points"))]
        table = projected(found, found.reach[:, f, self.q], self.axes[:3])
        points = projected(found, found.points, self.axes[:3])
        if not more:
            return [self.draw(maps.Map(x, y), maps.states(table, points, self.look),
                              f"sweep_map_{f}", key, what)]
        out = []
        for k, (said, group) in enumerate(slices_of(found.parts[more[0]])):
            state = maps.states(table[:, :, group].sum(axis=2), points[:, :, group].sum(axis=2),
                                self.look)
            out.append(self.draw(maps.Map(x, y, NARROW), state, f"sweep_map_{f}_{k}", said,
                                 f"{what}, {said}"))
        return out


class Winners:
    """The formulations of lowest cost within the tolerance.

      images    [(Image, alt)]
      shares    [(letter, formulation, points won, mean cost at these points [s])], most points first
      ahead     the formulations that are listed first
      none      number of points with a reference value but without a winner
      known     number of points with a reference value
      unranked  formulations without counted costs"""

    def __init__(self, sweep, found, axes):
        self.sweep, self.found = sweep, found
        won, known = found.wins.sum(axis=0), found.judged
        self.none, self.known = found.unwon, known
        spent = found.winner_cost.sum(axis=0)
        self.unranked = [key for key, a in zip(sweep.keys, found.ranked) if not a]
        self.order = [int(f) for f in np.argsort(-won, kind="stable") if won[f]]
        self.shares = [(maps.LETTERS[k % 26], sweep.keys[f], int(won[f]), float(spent[f] / won[f]))
                       for k, f in enumerate(self.order)]
        self.ahead = [row for row in self.shares if row[2] >= TOLD * known][:3]
        self.images = []
        if self.shares:
            self.images = self.strip() if len(found.parts) == 1 else self.drawn(axes)

    def strip(self):
        x = self.found.parts[0]
        return [self.image(maps.Map(x, ["cheapest"], 2 * maps.WIDE),
                           self.found.wins[:, None], self.found.known[:, -1:], "sweep_winners", "")]

    def drawn(self, axes):
        found = self.found
        wins = projected(found, found.wins, axes[:3])
        known = projected(found, found.known[:, -1], axes[:3])
        x, y = found.parts[axes[0]], found.parts[axes[1]]
        if len(axes) == 2:
            return [self.image(maps.Map(x, y), wins, known, "sweep_winners", "")]
        return [self.image(maps.Map(x, y, NARROW), wins[:, :, group].sum(axis=2),
                           known[:, :, group].sum(axis=2), f"sweep_winners_{k}", said)
                for k, (said, group) in enumerate(slices_of(found.parts[axes[2]]))]

    def image(self, drawn, wins, known, name, title):
        keys = [key for _, key, *_ in self.shares]
        state, fill, sign = maps.winners(wins[..., self.order], known, keys)
        shares = [(key, (state // 2 == k).sum()) for k, key in enumerate(keys)]
        said = ", ".join(f"{key} in {n} fields" for key, n in shares if n)
        return drawn.image(name, drawn.fields(state, fill, sign), title), (
            f"cheapest formulation{', ' + title if title else ''}: {said or 'none'}")


def curves(site, sweep, found, q=-1):
    """Draws curves of the largest error in each part of one axis, with a panel for each mesh. `q` is the index of the
    quantity."""
    part = found.parts[0]
    x = np.where(part.low == part.high, part.low, (part.low + part.high) / 2)
    columns = 2 if len(sweep.meshes) > 1 else 1
    chart = Chart(columns, (250, 170), gap=(70, 60))
    for m, n in enumerate(sweep.meshes):
        panel = chart.panel(answers.elements(n), maps.title_of(part), "relative error",
                            xlog=part.log)
        panel.level(sweep.tolerance, answers.tolerance(sweep))
        for f, key in enumerate(sweep.keys):
            error = found.worst[:, f, q, m]
            keep = np.isfinite(error) & (error >= 0)
            if not keep.any():
                continue
            rows = [(float(v), float(e)) for v, e in zip(x[keep], error[keep])]
            look = site.points(key, (maps.title_of(part), "error"), rows)
            panel.plot([v for v, _ in rows], [max(e, FLOOR) for _, e in rows], label=key, **look)
    return chart.image(site, f"sweep_errors{q if q >= 0 else ''}")


# Data for maps over axes that the reader selects. They are in a separate script, which assets/sweep.js loads when the
# reader makes a selection.
#
# The states of cells are letters or signs (SPECIAL), each followed by its number of repetitions if there are several. The
# last axis varies fastest.

# Upper ends of the classes of errors in percent, in addition to the tolerance. Two further classes are larger errors
# and cells with a run without a solution.
LEVELS = [m * 10.0**e for e in range(-3, 2) for m in (1, 2, 5)] + [100.0]
SPECIAL = {maps.EMPTY: "_", maps.UNKNOWN: "?"}


def written(states):
    out = []
    for state, same in itertools.groupby(states.ravel().tolist()):
        times = len(list(same))
        out.append(SPECIAL.get(state) or chr(ord("a") + state))
        out.append(str(times) if times > 1 else "")
    return "".join(out)


def levels_of(tolerance):
    """Returns LEVELS together with the tolerance, in percent and in ascending order."""
    own = float(f"{100 * tolerance:.6g}")
    return sorted({*LEVELS, own})


def classes(worst, points, levels):
    """Returns the class of the largest error in each cell. `levels` are the upper ends of the classes in percent."""
    found = np.searchsorted(levels, 100 * worst.astype(float) * (1 - 1e-6))  # errors are stored in single precision
    found = np.where(np.isinf(worst), len(levels) + 1, found)
    return np.where(points == 0, maps.EMPTY, np.where(worst < 0, maps.UNKNOWN, found))


def looks_of_errors(tolerance):
    """Returns {class: fill, ink, sign, label}, with light colours within the tolerance and dark colours beyond it."""
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
    out[maps.UNKNOWN] = look("none", "?", "no reference for the error")
    return out


def look(fill, sign, words):
    return {"fill": fill, "ink": maps.ink(fill), "sign": sign, "words": words}


def axis_of(part):
    low, high = part.low[0], part.high[-1]
    return {"name": part.axis.name, "range": [float(f"{low:.6g}"), float(f"{high:.6g}")],
            "cuts": part.cuts.tolist(), "words": bool(part.axis.words), "title": maps.title_of(part), "names":
            [part.name(i) for i in range(len(part))],
            "slices": [[words, [int(group[0]), int(group[-1])]]
                       for words, group in slices_of(part)],
            "ticks": [[round(float(at), 3), words] for at, words in maps.marks(part)]}


def cells_of(sweep, found, order):
    elements = maps.Look(sweep.meshes)
    asked = range(len(sweep.quantities) + 1)
    keys, levels = range(len(sweep.keys)), levels_of(sweep.tolerance)
    return {
        "axes": [axis_of(p) for p in found.parts], "keys": sweep.keys, "meshes": sweep.meshes,
        "order": [sweep.keys.index(key) for key in order],
        "none": elements.none, "some": elements.some, "failed": elements.failed,
        "sizes": {"left": maps.LEFT, "top": maps.TOP, "below": maps.BELOW, "right": maps.RIGHT,
                  "letter": maps.LETTER, "wide": maps.WIDE, "narrow": NARROW},
        "elements": {k: look(elements.fill[k], elements.sign[k], elements.words[k])
                     for k in elements.fill},
        "errors": looks_of_errors(sweep.tolerance),
        "least": [[written(maps.states(found.reach[:, f, q], found.points, elements))
                   for f in keys] for q in asked],
        "worst": [[[written(classes(found.worst[:, f, q, m], found.points, levels))
                    for f in keys]
                   for m in range(len(sweep.meshes))] for q in asked]}


def write_cells(site, name, sweep, found, order):
    text = json.dumps(cells_of(sweep, found, order), separators=(",", ":"), ensure_ascii=False)
    path = os.path.join(site.folder, name)
    with open(f"{path}.part", "w", encoding="utf-8") as out:
        out.write(f"beamwork_sweep({text});\n")
    os.replace(f"{path}.part", path)


NAVIGATION = []  # empty, because the files are named after the sweeps
MOST_WORST, MOST_CURVES = 20, 12  # largest numbers of listed points and of quantities with separate curves


def navigation(site):
    return [(site.page_of(sweep), f"sweep of {pathlib.PurePath(sweep.name).stem}")
            for sweep in site.sweeps]


def present(site):
    return bool(site.sweeps)


def axis_words(part):
    axis, count = part.axis, len(part.levels) or part.axis.count
    if axis.words:
        return f"{axis.name}: {', '.join(axis.words)}"
    unit = f" {axis.unit}" if axis.unit not in ("", "1") else ""
    how = {"log": f"{answers.many(count, 'value')} by equal factors", "sobol": "Sobol points",
           "halton": "Halton points", "random": "random points"}.get(
               axis.kind, answers.many(count, "value"))
    return f"{axis.name}: {part.low[0]:.4g} to {part.high[-1]:.4g}{unit}, {how}"


def solving(sweep, row):
    """Returns the command that solves a stored point."""
    scene = shlex.quote(sweep.scene_of(row))
    return f"beamwork solve --scene {scene} -f {row.formulation} -n {row.elements}"


def worst_rows(sweep):
    rows = sorted(sweep.worst, key=lambda r: -abs(r.error) if r.quantity else -math.inf)
    rows = rows[:MOST_WORST]
    wanted = {row.point for row in rows}
    at, first = {}, 0
    for values in sweep.points_only() if wanted else ():
        for point in [p for p in wanted if first <= p < first + len(values)]:
            at[point] = values[point - first]
        first += len(values)
    return [(row, sweep.place(at[row.point]) if row.point in at else "",
             solving(sweep, row) if row.scene else "") for row in rows]


def curves_of(site, sweep, found):
    """Returns [(quantity, or an empty string for all quantities, Image)] for a sweep with a single axis."""
    if len(found.parts) > 1:
        return []
    single = sweep.quantities[:MOST_CURVES] if len(sweep.quantities) > 1 else []
    return [("", curves(site, sweep, found)),
            *((q.name, curves(site, sweep, found, i)) for i, q in enumerate(single))]


def glance(site, sweep):
    """Returns the variables of the first sentences about the sweep, which this page and the first page contain."""
    found = gather.of_sweep(sweep)
    made = answers.of_sweep(sweep, found)
    return {"sweep": sweep, "found": found, "answers": made, "groups": answers.together(made),
            "axes": [axis_words(p) for p in found.parts], "page": site.page_of(sweep),
            "words": answers}


def write(site, said):
    sweep, found = said["sweep"], said["found"]
    order = [a.key for a in said["answers"] if any(r.known for r in a.of)]
    validity = Validity(sweep, found, order)
    data = f"cells_{site.name_of(sweep)}.js"
    write_cells(site, data, sweep, found, order)
    references = answers.references(sweep, found)
    site.write("sweep.html", said["page"], **said, validity=validity, data=data,
               winners=Winners(sweep, found, validity.axes),
               curves=curves_of(site, sweep, found),
               worst=worst_rows(sweep), references=references,
               proven=answers.proven(references), limits=any(
                   kind.startswith("limit") for _, kinds, *_ in references for kind in kinds),
               outcomes=answers.outcomes(sweep, found),
               crowded=bool((found.points > 1).any()) and validity.dots is None)


def tasks(site):
    site.glances = [glance(site, sweep) for sweep in site.sweeps]
    return [functools.partial(write, site, said) for said in site.glances]
