"""Common parts of all pages: records, styles, templates, and the output folder."""
import math
import os
import pathlib

import jinja2
from markupsafe import Markup, escape

from reports import answers, data, experiments, glossary, navigation, verdicts
from reports.figures import paper, style, svg
from reports.figures.style import Styles, plt
from reports.sweep import stored

ASSETS = pathlib.Path(__file__).parent / "assets"
ROOT = pathlib.Path(__file__).resolve().parents[1]


def number(value, digits=6):
    return f"{value:.{digits}g}" if math.isfinite(value) else "–"


def percent(value):
    if not math.isfinite(value):
        return "–"
    return f"{100 * value:+.4f} %" if abs(value) >= 1e-5 else f"{100 * value:+.1e} %"


def limit(v):
    if not math.isfinite(v.limit):
        return "–"
    if not math.isfinite(v.limit_uncertainty):
        return f"{v.limit:.7g}, uncertainty unknown"
    known = math.log10(abs(v.limit) /
                       v.limit_uncertainty) if v.limit and v.limit_uncertainty > 0 else 10
    return f"{v.limit:.{max(2, min(12, math.ceil(known) + 2))}g} ± {v.limit_uncertainty:.1g}"


def breakable(key):
    """Returns the name of a formulation with possible line breaks before its options."""
    return escape(key).replace(":", Markup(":<wbr>")).replace(",", Markup(",<wbr>"))


def seconds(value):
    if not math.isfinite(value):
        return "–"
    return f"{1e3 * value:.3g} ms" if value < 1 else f"{value:.3g} s"


def file_of(key):
    """Returns a file name, without suffix, for the key of a formulation."""
    return "formulation_" + key.replace(":", "_").replace("=", "_").replace(",", "_")


def file_name(path):
    return "".join(c if c.isalnum() or c in "-_" else "_" for c in pathlib.Path(path).stem)


class Site:
    """A report. `cases` are data.Case records. `about` and `bench` are the environments of the results and of the times
    (None: no benchmark). `paper` writes figures for papers. `kinds` are the numbers of reference values by kind.
    `sweeps` are stored.Sweep records. If `results` is a sweep, there are no cases."""

    def __init__(self, results, truths, folder, bench=None, others=(), sweeps=(), figures=None, peers=()):
        self.alone = stored.is_alone(results)
        own = [results] if stored.is_there(results) else []
        self.sweeps = [stored.read(p) for p in own + list(sweeps)]
        if bench is None and not self.alone and experiments.holds(results, "bench"):
            bench = results
        self.about, self.cases = ({}, []) if self.alone else data.read_results(results, bench)
        for path in others:
            data.read_about(path)
            data.add_beside(self.cases, path)
        self.bench = data.read_about(bench, data.root_of_bench) if bench else None
        self.kinds = data.read_truth_counts(truths)
        self.results, self.truths, self.folder, self.peers = results, truths, folder, peers
        self.styles = Styles([s.key for c in self.cases for p in c.points for s in p.series])
        self.marks = {s.key: s.marks for c in self.cases for p in c.points for s in p.series
                      if s.marks}
        self.navigation, self.sections, self.said, self.glances = [], [], [], []
        self.paper = paper.Paper(folder, [c.name for c in self.cases], **figures or {})
        os.makedirs(folder, exist_ok=True)
        self.write_assets()
        loader = jinja2.FileSystemLoader(pathlib.Path(__file__).parent / "templates")
        self.templates = jinja2.Environment(loader=loader,
                                            autoescape=True,
                                            trim_blocks=True,
                                            lstrip_blocks=True,
                                            undefined=jinja2.StrictUndefined)
        self.templates.filters.update(number=number,
                                      percent=percent,
                                      seconds=seconds,
                                      limit=limit,
                                      breakable=breakable,
                                      file_of=file_of,
                                      term=glossary.linker(truths))
        self.templates.globals.update(levels=answers.LEVELS,
                                      nan=math.nan,
                                      kinds_of_verdicts=verdicts.BY_NAME,
                                      remarks=verdicts.remarks,
                                      defect_words=answers.defect_words,
                                      bar=self.bar,
                                      has_page=self.has_page,
                                      page_of=self.page_of,
                                      linked=frozenset(self.styles.order),
                                      marks=self.marks,
                                      colour=self.styles.fill,
                                      shape=self.styles.shape,
                                      look_of=style.class_of)

    def write_assets(self):
        for asset in ASSETS.iterdir():
            own = style.sheet() if asset.name == "style.css" else ""
            with open(os.path.join(self.folder, asset.name), "w", encoding="utf-8") as out:
                out.write(asset.read_text(encoding="utf-8") + own)

    def has_page(self, name):
        return any(file == name for file, _ in self.navigation)

    def bar(self, name):
        found = navigation.groups(self.navigation)
        return found, navigation.group_of(name, found, {c.name for c in self.cases})

    def name_of(self, sweep):
        """Returns the name of the page of a sweep, which is the name of its file, with a number if another sweep has
        this name."""
        name = file_name(sweep.path)
        before = self.sweeps[:self.sweeps.index(sweep)]
        same = sum(file_name(s.path) == name for s in before)
        return f"{name}_{same + 1}" if same else name

    def page_of(self, sweep):
        """Returns the file of the page of a sweep. Without other results, the first sweep is the first page."""
        alone = self.alone and sweep is self.sweeps[0]
        return "index.html" if alone else f"sweep_{self.name_of(sweep)}.html"

    def case(self, name):
        return next((c for c in self.cases if c.name == name), None)

    def write(self, template, name, **context):
        path = os.path.join(self.folder, name)
        text = self.templates.get_template(template).render(self_name=name, **context)
        with open(path, "w", encoding="utf-8") as out:
            out.write(svg.with_markers(text))

    def points(self, key, columns, rows, title=""):
        """Returns the arguments of plot() for a curve whose markers carry data. If the pointer is on a marker, or the
        marker is selected by keyboard, a tooltip shows the title, the formulation and the row of the marker.

        `key` is the formulation. `columns` are the names of the entries of a row; `error` is shown in percent and
        `time [s]` and `cost [s]` in a suitable unit. `rows` contains a row of numbers, strings or None for each drawn marker, in the
        order of the markers."""
        digits = [{"error": 3, "time [s]": 4, "cost [s]": 4}.get(name, 8) for name in columns]
        self.said.append({"f": key, "t": title, "c": list(columns),
                          "r": [[svg.plain(v, d) for v, d in zip(row, digits)]
                                for row in rows]})
        look = self.styles.of(key)
        return {**look, "gid": f"{look['gid']}|{len(self.said) - 1}"}

    def image(self, figure, name, tight=True):
        """Returns the Image of a figure of matplotlib, and closes the figure. If `tight` is True, the figure is cropped
        to its contents and is therefore drawn twice."""
        self.paper.figure(figure, name)
        image = svg.image_of(figure, name, self.said, tight)
        plt.close(figure)
        self.said.clear()
        return image

    def keep(self, image):
        """Writes an Image to a file. Returns the name of the file."""
        with open(os.path.join(self.folder, image.name), "w", encoding="utf-8") as out:
            out.write(svg.alone(image.markup))
        return image.name
