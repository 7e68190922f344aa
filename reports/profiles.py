"""Performance profiles and data profiles: the share of problems that a formulation solves at no more than a factor times
the unit of cost (problems.to_the_best, problems.to_the_smallest)."""
import csv
import functools
import math
import os
from dataclasses import dataclass

from reports import answers, problems
from reports.figures import style
from reports.answers import LEVELS
from reports.figures.chart import Axis, Chart
from reports.problems import Question, any_defect, defect, no_defect, to_the_best, to_the_smallest
from reports.figures.style import plt

ROUND = (1, 1.2, 1.4, 1.7, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8)  # factors in each decade at which shares are read
FARTHEST = {to_the_best: 100, to_the_smallest: 1000}  # end of the axis for each unit
SLACK = 1e-9  # relative tolerance of a factor, so that equal costs remain equal in floating-point arithmetic


@dataclass(frozen=True)
class Picture:
    """A kind of profile, which is drawn for each level. If `offered` is True, the profile of a formulation counts only
    the problems that it supports."""

    name: str
    count: str
    unit: object = to_the_best
    offered: bool = False

    @property
    def file(self):
        return f"profile_{self.name}"

    def question(self, level):
        return Question(level, self.count, self.unit)


PICTURES = (
    Picture("cost", "cost"),
    Picture("cost_offered", "cost", offered=True),
    Picture("unknowns", "unknowns"),
    Picture("data_cost", "cost", to_the_smallest),
    Picture("data_unknowns", "unknowns", to_the_smallest),
)


def places(farthest):
    """Returns the factors at which shares are read: round numbers from 1 to a power of ten."""
    tens = [10**i for i in range(round(math.log10(farthest)))]
    return [round(ten * x, 1) for ten in tens for x in ROUND] + [farthest]


def shares(pairs, at):
    """Returns the share of the weight of problems solved within each factor, followed by the share solved at any factor.

    `pairs` is [(factor, weight)] of one formulation, where the factor is infinite if the problem is not solved. `at`
    contains ascending factors."""
    ordered = sorted(pairs)
    whole, reached, i, out = sum(w for _, w in ordered), 0.0, 0, []
    for place in [*at, math.inf]:
        limit = min(place * (1 + SLACK), 1e300)
        while i < len(ordered) and ordered[i][0] <= limit:
            reached += ordered[i][1]
            i += 1
        out.append(reached / whole if whole else math.nan)
    return out


def weight_of(found, key=None):
    return {id(problem): weight for problem, weight in problems.weights(found, key)}


def profile(found, keys, question, offered=False):
    """Returns {formulation: shares at `places`, followed by the share that the formulation solves at any factor}."""
    at, everything = places(FARTHEST[question.unit]), weight_of(found)
    out = {}
    for key, pairs in problems.factors(found, keys, question).items():
        weight = weight_of(found, key) if offered else everything
        out[key] = shares([(f, weight[id(p)]) for p, f in pairs if id(p) in weight], at)
    return out


def read_at(curves, at, factor):
    """Returns [(share within the factor, formulation)], the largest share first. `at` must contain the factor."""
    i = at.index(factor)
    return sorted(((values[i], key) for key, values in curves.items()), reverse=True)


class Compared:
    def __init__(self, cases):
        self.keys = problems.contestants(cases)
        self.problems = problems.problems(cases, self.keys)
        self.cases = len({p.case for p in self.problems})
        self._profiles = {}
        extra = style.extra(self.keys)
        self.curves = [key for key in self.keys if key not in extra] if self.any else []

    @property
    def any(self):
        return bool(self.problems) and len(self.keys) > 1

    def profile(self, question, offered=False):
        if (question, offered) not in self._profiles:
            found = profile(self.problems, self.keys, question, offered)
            self._profiles[question, offered] = found
        return self._profiles[question, offered]


XLABELS = {
    ("cost", True): "cost relative to the lowest cost",
    ("unknowns", True): "unknowns relative to the fewest unknowns",
    ("cost", False): "cost, by the cheapest run",
    ("unknowns", False): "unknowns, by the smallest model",
}


def xlabel(picture):
    return XLABELS[picture.count, picture.unit is to_the_best]


def marks_of(site, key, at, shares, marked):
    rows = [(f"{x:g}", f"{100 * share:.1f} %", f"{100 * shares[-1]:.1f} %")
            for x, share in list(zip(at, shares))[marked]]
    return site.points(key, ("factor", "solved", "at any cost"), rows)


def legend_of(site, keys, name="profile_legend"):
    columns = min(2, len(keys))
    figure, axes = plt.subplots(figsize=(1.95 * columns, 0.22 * -(-len(keys) // columns) + 0.06))
    lines = [axes.plot([], [], label=key, **site.styles.of(key))[0] for key in keys]
    axes.set_axis_off()
    figure.subplots_adjust(left=0, right=1, top=1, bottom=0)
    figure.legend(lines, keys, loc="center left", ncol=columns, borderaxespad=0, fontsize=9)
    return site.image(figure, name, tight=False)


class Fixed(Axis):
    """An axis with prescribed limits and ticks. `ticks` is [(value, label)]."""

    def __init__(self, log, limits, ticks):
        super().__init__(log)
        self.low, self.high = limits
        self.given = ticks

    def take(self, values):
        pass

    def settle(self):
        pass

    def ticks(self):
        return self.given


def factors(farthest):
    ticks = [s * 10**i for i in range(4) for s in ((1, 2, 5) if farthest <= 100 else (1,))]
    return Fixed(True, (1, farthest), [(x, f"{x:g}") for x in ticks if x <= farthest])


def stairs(at, shares):
    """Returns the corners of the step curve, in which each share applies from its factor on."""
    xs, ys = [at[0]], [shares[0]]
    for x, y in zip(at[1:], shares[1:]):
        if y != ys[-1]:
            xs += [x, x]
            ys += [ys[-1], y]
    return xs + [at[-1]], ys + [ys[-1]]


def figure_of(site, picture, curves, keys, name, size=(250, 175)):
    """Draws a profile. `curves` is {formulation: shares at `places`}. `size` is the size of the axes in pixels."""
    at = places(FARTHEST[picture.unit])
    chart = Chart(1, size)
    panel = chart.panel(xlabel=xlabel(picture), ylabel="share of problems")
    panel.x = factors(at[-1])
    panel.y = Fixed(False, (0, 1), [(i / 5, f"{20 * i} %") for i in range(6)])
    for i, key in enumerate(keys):
        marked = slice(i, None, len(keys))
        look = marks_of(site, key, at, curves[key], marked)
        panel.plot(*stairs(at, curves[key][:-1]), **{**look, "marker": None, "gid": f"f|{key}"})
        panel.plot(at[marked], curves[key][:-1][marked], **{**look, "linestyle": "none"})
    return chart.image(site, name)


def write_table(site, compared, name="profiles.csv"):
    """Writes every curve, drawn or not, in CSV. Rows with the factor "any" contain the share solved at any cost."""
    path = os.path.join(site.folder, name)
    with open(f"{path}.part", "w", encoding="utf-8", newline="") as out:
        table = csv.writer(out)
        table.writerow(["picture", "level", "factor", *compared.keys])
        for picture in PICTURES:
            at = [f"{x:g}" for x in places(FARTHEST[picture.unit])] + ["any"]
            for level in LEVELS:
                curves = compared.profile(picture.question(level), picture.offered)
                for i, x in enumerate(at):
                    found = (f"{curves[key][i]:.5g}" for key in compared.keys)
                    table.writerow([picture.name, level, x, *found])
    os.replace(f"{path}.part", path)
    return name


NAVIGATION = [("profiles.html", "profiles")]
NEAR = {to_the_best: 2, to_the_smallest: 10}  # factors for which texts give the leading share
READINGS = (defect, no_defect, any_defect)


def panel(site, compared, picture, level, name=None, size=(250, 175)):
    """Returns the figure of a level, with the share of the leading curve at the factor NEAR."""
    curves = compared.profile(picture.question(level), picture.offered)
    at = places(FARTHEST[picture.unit])
    factor = NEAR[picture.unit]
    drawn = {key: curves[key] for key in compared.curves}
    share, ahead = read_at(drawn, at, factor)[0]
    name = name or f"{picture.file}_{100 * level:g}"
    return {
        "level": level,
        "image": figure_of(site, picture, curves, compared.curves, name, size),
        "ahead": ahead,
        "factor": factor,
        "share": share,
        "any": curves[ahead][-1],
    }


def readings(compared):
    """Returns [(formulation, [(level, shares solved in each of READINGS)])]."""
    shares = {
        (level, forbids): compared.profile(Question(level, forbids=forbids))
        for level in LEVELS
        for forbids in READINGS
    }
    return [(key, [(level, [shares[level, forbids][key][-1] for forbids in READINGS])
                   for level in LEVELS]) for key in compared.keys]


def write(site):
    compared = Compared(site.cases)
    figures, table, legend = {}, None, None
    if compared.any:
        figures = {
            picture.name: [panel(site, compared, picture, level) for level in LEVELS]
            for picture in PICTURES
        }
        legend = legend_of(site, compared.curves)
        table = write_table(site, compared)
    site.write("profiles.html", "profiles.html", compared=compared, figures=figures, table=table,
               legend=legend, noise=site.cases[0].points[0].noise if site.cases else 1,
               readings=readings(compared) if compared.any else [],
               lines=answers.lines_of_cases(site.cases),
               rows=problems.trust_table(site.cases, compared.problems,
                                         problems.judged(site.cases)))


def tasks(site):
    return [functools.partial(write, site)]
