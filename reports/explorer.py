"""A page on which the reader selects the case, the quantity and the axes; assets/explorer.js draws the figure.

The numbers of each case are in a separate file, data_CASE.js, which is loaded when the case is selected. Lists are
strings of numbers separated by blanks, with `-` for missing numbers. Strings that occur more than once are in the list
`w` and are replaced by their indices. Values are not stored if reference value x (1 + error) gives them; the errors then
have as many digits as seven correct digits of the values require."""
import collections
import functools
import json
import math
import os

from reports import answers
from reports.figures import chart, style

NAVIGATION = [("explorer.html", "explorer")]
COLUMNS = "fnscui"  # columns of a series: the formulation, then the columns in AXES
AXES = (("elements per member", "n"), ("time [s]", "s"), ("cost of counted work [s]", "c"),
        ("unknowns", "u"), ("iterations", "i"))


def listed(values, digits):
    text = " ".join(f"{v:.{digits}g}" if v is not None and math.isfinite(v) else "-"
                    for v in values)
    return text.replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def error_text(error):
    """Returns the error with as many digits as reference x (1 + error) needs for seven correct digits."""
    if error is None or not math.isfinite(error):
        return "-"
    part = abs(error) / max(abs(1 + error), 1e-9)
    digits = max(2, 7 + math.ceil(math.log10(part))) if part > 0 else 2
    return listed([error], min(digits, 15))


def follow(values, errors, truth):
    """Returns True if all finite values equal truth x (1 + error) within 1e-9 and the reference value is not zero."""
    return truth != 0 and all(
        not math.isfinite(v) and not math.isfinite(e) or abs(truth * (1 + e) - v) <= 1e-9 * abs(v)
        for v, e in zip(values, errors))


def columns_of(values, errors, verdict):
    """Returns [errors, verdict, reference value, values] of a quantity. Missing entries are empty strings. Values that
    follow from the errors are omitted from the list."""
    said = verdict.verdict if verdict else ""
    truth = verdict.truth if verdict else math.nan
    if math.isfinite(truth) and follow(values, errors, truth):
        return [" ".join(map(error_text, errors)), said, f"{truth:.12g}"]
    known = any(math.isfinite(e) for e in errors)
    return [listed(errors, 2) if known else "", said, "", listed(values, 7)]


def series_of(series, names):
    """Returns the data of a formulation at a parameter point: the formulation, the columns of its meshes in the order of
    COLUMNS, then a list of columns for each quantity (0 if there are no values)."""
    meshes, out = series.meshes, []
    for name in names:
        found = [m.values.get(name, math.nan) for m in meshes]
        errors = [m.errors.get(name, math.nan) for m in meshes]
        known = any(math.isfinite(v) for v in found)
        out.append(columns_of(found, errors, answers.verdict_of(series, name)) if known else 0)
    return [series.key, listed([m.n for m in meshes], 6), listed([m.seconds for m in meshes], 3),
            listed([m.cost for m in meshes], 3), listed([m.free for m in meshes], 9),
            listed([m.iterations for m in meshes], 9), out]


def data_of(case):
    points = []
    for point in case.points:
        names = list(point.units)
        points.append({
            "t": point.parameters or "defaults", "q": [[q, point.units[q]] for q in names],
            "s": [series_of(s, names) for s in point.series if s.meshes]
        })
    return shared(points)


def shared(points):
    """Replaces strings of several characters that occur more than once by indices. Returns {"w": these strings,
    "points": the points}."""
    every = [s for p in points for s in p["s"]]
    count = collections.Counter()
    for *columns, quantities in every:
        count.update(columns)
        count.update(text for found in quantities if found for text in found)
    often = [text for text, times in count.most_common() if times > 1 and len(text) > 1]
    index = {text: i for i, text in enumerate(often)}
    for s in every:
        s[:-1] = [index.get(text, text) for text in s[:-1]]
        s[-1] = [found and [index.get(text, text) for text in found] for found in s[-1]]
    return {"w": often, "points": points}


def write_case(site, case):
    text = json.dumps(data_of(case), separators=(",", ":"))
    with open(os.path.join(site.folder, f"data_{case.name}.js"), "w", encoding="utf-8") as out:
        out.write(f"beamwork_data({json.dumps(case.name)}, {text});\n")


def looks(site):
    out = {}
    for key in site.styles.order:
        look = site.styles.of(key)
        out[key] = [style.Styles.fill(key), chart.form(look["marker"], 6),
                    chart.dashes(look["linestyle"])]
    return out


def write(site):
    chosen = {"cases": [c.name for c in site.cases], "looks": looks(site), "axes": AXES,
              "columns": COLUMNS, "extra": style.extra(site.styles.order), "marks": site.marks}
    site.write("explorer.html", "explorer.html", cases=site.cases,
               chosen=json.dumps(chosen, separators=(",", ":")).replace("<", "\\u003c"))


def tasks(site):
    return [functools.partial(write, site)
            ] + [functools.partial(write_case, site, case) for case in site.cases]
