"""HTML pages from records and figures."""
import concurrent.futures
import math
import os
import pathlib

import jinja2

from reports import claims, data, plots
from reports.style import Styles

LEVELS = (0.1, 0.01, 0.001, 0.0001)
MOST_FIGURES, MOST_POINTS = 64, 3


def number(value, digits=6):
    return f"{value:.{digits}g}" if math.isfinite(value) else "–"


def percent(value):
    if not math.isfinite(value):
        return "–"
    return f"{100 * value:+.4f} %" if abs(value) >= 1e-5 else f"{100 * value:+.1e} %"


def seconds(value):
    return f"{1e3 * value:.3g} ms" if value < 1 else f"{value:.3g} s"


def environment(folder):
    env = jinja2.Environment(loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent / "templates"), autoescape=True, trim_blocks=True, lstrip_blocks=True,
                             undefined=jinja2.StrictUndefined)
    env.filters.update(number=number, percent=percent, seconds=seconds)
    env.globals["levels"] = LEVELS
    env.globals["folder"] = folder
    return env


def write(env, template, folder, name, **context):
    page = env.get_template(template).render(**context)
    path = os.path.join(folder, name)
    with open(f"{path}.part", "w", encoding="utf-8") as out:
        out.write(page)
    os.replace(f"{path}.part", path)


def judged(point):
    """Quantities of a point with a truth, in the order of the case."""
    names = []
    for series in point.series:
        for v in series.verdicts:
            if math.isfinite(v.truth) and v.quantity not in names:
                names.append(v.quantity)
    return names


def figures_of(case, styles, folder):
    """[(point, [(quantity, convergence svg)], [(quantity, curve svg)])]; every quantity of the defaults, the first of other points."""
    out = []
    for i, point in enumerate(case.points):
        quantities = judged(point)[:MOST_FIGURES if i == 0 else 1 if i < MOST_POINTS else 0]
        drawn = [(q, plots.convergence(point, q, styles, folder, f"{case.name}_{point.name}_{q}")) for q in quantities]
        names = sorted({name for s in point.series for m in s.meshes for name in m.curves}) if i == 0 else []
        curves = [(q, plots.curves(point, q, styles, folder, f"{case.name}_{point.name}_{q}_curve")) for q in names]
        out.append((point, [d for d in drawn if d[1]], [c for c in curves if c[1]]))
    return out


def winners(case):
    """For the index: the first judged quantity of the defaults and the cheapest way to each level."""
    point = case.points[0]
    names = judged(point)
    return (names[0], data.cheapest(point, names[0], LEVELS)) if names else (None, {})


def count_verdicts(cases):
    counts = {}
    for case in cases:
        for point in case.points:
            for series in point.series:
                for v in series.verdicts:
                    counts[v.verdict] = counts.get(v.verdict, 0) + 1
    return counts


def formulation_rows(cases):
    """{key: {case: {verdict: count}}} over all points."""
    rows = {}
    for case in cases:
        for point in case.points:
            for series in point.series:
                cell = rows.setdefault(series.key, {}).setdefault(case.name, {})
                for v in series.verdicts:
                    cell[v.verdict] = cell.get(v.verdict, 0) + 1
    return rows


def write_case(case, styles, folder):
    """One case with its figures; cases are drawn side by side in processes of their own."""
    write(environment(folder), "case.html", folder, f"{case.name}.html", case=case, figures=figures_of(case, styles, folder), cheapest=data.cheapest, judged=judged)


def build(results, truths, folder):
    """Writes the whole site; returns the number of pages."""
    about, cases = data.read_results(results)
    kinds = data.read_truth_counts(truths)
    os.makedirs(folder, exist_ok=True)
    styles = Styles([s.key for c in cases for p in c.points for s in p.series])
    env = environment(folder)
    with concurrent.futures.ProcessPoolExecutor() as pool:
        for done in [pool.submit(write_case, case, styles, folder) for case in cases]:
            done.result()
    rows = formulation_rows(cases)
    for key in rows:
        series = [(c, p, s) for c in cases for p in c.points for s in p.series if s.key == key and not s.missing]
        write(env, "formulation.html", folder, f"formulation_{key.replace(':', '_')}.html", key=key, series=series,
              skipped=sorted({(c.name, s.missing) for c in cases for p in c.points for s in p.series if s.key == key and s.missing}))
    column = next((c for c in cases if c.name == "c_column"), None)
    write(env, "index.html", folder, "index.html", cases=cases, about=about, kinds=kinds, counts=count_verdicts(cases), rows=rows, winners={c.name: winners(c) for c in cases},
          column=plots.column_figure(column, styles, folder) if column else None)
    errata = pathlib.Path(__file__).resolve().parents[1] / "reference" / "ERRATA.md"
    import markdown
    write(env, "errata.html", folder, "errata.html", body=markdown.markdown(errata.read_text(encoding="utf-8"), extensions=["tables"]))
    write(env, "claims.html", folder, "claims.html", claims=claims.claims(cases), peers=claims.peers(cases))
    return len(cases) + len(rows) + 3
