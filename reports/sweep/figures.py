"""The figures of a sweep's page: maps of the elements that are needed, maps of who is the cheapest,
curves of the error over one axis."""
import numpy as np

from reports.chart import Chart
from reports.sweep import gather, maps, words

MOST_DOTS = 400  # scattered points that are drawn one by one
SLICES, WORDS = 4, 6  # maps side by side over a third axis of numbers, of words
NARROW = 170  # width of a map that stands beside others, pixels
TOLD = 0.01  # share of the points for which the cheapest one is told first
FLOOR = 1e-12  # of errors that are drawn


def projected(found, table, axes):
    """A table [C, ...] summed over all axes but some, which it has in the order of axes."""
    count = len(found.parts)
    whole = table.reshape(found.shape + table.shape[1:])
    whole = whole.sum(axis=tuple(a for a in range(count) if a not in axes))
    return np.moveaxis(whole, [sorted(axes).index(a) for a in axes], range(len(axes)))


def by_influence(found):
    """Axes, those first along which what is within changes most; those of words last."""
    within = found.reach[:, :, -1, :-2].sum(axis=(1, 2))
    score = []
    for a, part in enumerate(found.parts):
        known = projected(found, found.known[:, -1], [a]).astype(float)
        share = projected(found, within, [a]) / np.maximum(known, 1)
        score.append(float(np.std(share[known > 0])) if (known > 0).any() else 0.0)
    return sorted(range(len(score)), key=lambda a: (bool(found.parts[a].axis.words), -score[a], a))


def slices_of(part):
    """[(words, parts)] of a third axis: its parts, few of them together."""
    most = WORDS if part.axis.words else SLICES
    groups = np.array_split(np.arange(len(part)), min(most, len(part)))
    return [(words.condition(part, list(g)) if len(g) < len(part) else part.axis.name, list(g))
            for g in groups]


def counted(state, look):
    """What a map says, for those who do not see it."""
    drawn = state[state != maps.EMPTY]
    said = [f"{look.words[k]}: {words.percent((drawn == k).sum() / drawn.size)}"
            for k in [*(k for k in look.words if k >= 0), maps.UNKNOWN] if (drawn == k).any()]
    return "; ".join(said) + " of the fields" if said else "no points"


class Validity:
    """Maps of least elements. order: of formulations, by key; axes: across, up, side by side.
    rows: [(formulation or empty, [(Image, alt)])]; used: states that are drawn."""

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
        """(points, their states [points, F]) where they are few and of two axes; else None."""
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
        """One axis: a row for each formulation, the first on top."""
        found, upward = self.found, order[::-1]
        rows = [self.sweep.keys.index(key) for key in upward]
        state = maps.states(found.reach[:, rows, self.q], found.points[:, None], self.look)
        drawn = maps.Map(found.parts[0], upward, 2 * maps.WIDE)
        return self.draw(drawn, state, "sweep_map", "",
                         f"elements needed over {found.parts[0].axis.name}")

    def of(self, f, key):
        """Maps of a formulation: of two axes, or side by side over the third one."""
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
    """Who is the cheapest within the tolerance. images: [(Image, alt)]; shares: [(letter,
    formulation, points won, mean cost there, s)], most first; ahead: those of them that are told
    first; none: points where nobody is, of so many known; unranked: formulations without costs of
    counted work."""

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
    """Of one axis: the largest error in each of its parts, a panel for each mesh. q: quantity."""
    part = found.parts[0]
    x = np.where(part.low == part.high, part.low, (part.low + part.high) / 2)
    columns = 2 if len(sweep.meshes) > 1 else 1
    chart = Chart(columns, (250, 170), gap=(70, 60))
    for m, n in enumerate(sweep.meshes):
        panel = chart.panel(words.elements(n), maps.title_of(part), "relative error",
                            xlog=part.log)
        panel.level(sweep.tolerance, words.tolerance(sweep))
        for f, key in enumerate(sweep.keys):
            error = found.worst[:, f, q, m]
            keep = np.isfinite(error) & (error >= 0)
            if not keep.any():
                continue
            rows = [(float(v), float(e)) for v, e in zip(x[keep], error[keep])]
            look = site.points(key, (maps.title_of(part), "error"), rows)
            panel.plot([v for v, _ in rows], [max(e, FLOOR) for _, e in rows], label=key, **look)
    return chart.image(site, f"sweep_errors{q if q >= 0 else ''}")
