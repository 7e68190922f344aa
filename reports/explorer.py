"""A page on which the reader chooses case, quantity and axes; assets/explorer.js draws.

The numbers of each case are a file of their own, data_CASE.js, loaded when the case is chosen:
lists are texts of numbers between blanks, `-` where there is none. A text that is needed more than
once stands in the list `w`, and its index where it is needed. Where a truth is known the values are
left out: truth x (1 + error) gives them to seven digits."""
import collections
import functools
import json
import math
import os

from reports import answers, chart, style

NAVIGATION = [("explorer.html", "explorer")]
AXES = (("elements per member", "n"), ("time [s]", "s"), ("cost of counted work [s]", "c"),
        ("unknowns", "u"), ("iterations", "i"))


def listed(values, digits):
    """Numbers as one text."""
    text = " ".join(f"{v:.{digits}g}" if v is not None and math.isfinite(v) else "-"
                    for v in values)
    return text.replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def error_text(error):
    """With as many digits as truth x (1 + error) needs to be known to seven."""
    if error is None or not math.isfinite(error):
        return "-"
    part = abs(error) / max(abs(1 + error), 1e-9)
    digits = max(2, 7 + math.ceil(math.log10(part))) if part > 0 else 2
    return listed([error], min(digits, 15))


def follow(values, errors, truth):
    """Are all values truth x (1 + error), as far as they are told?"""
    return truth != 0 and all(
        not math.isfinite(v) and not math.isfinite(e) or abs(truth * (1 + e) - v) <= 1e-9 * abs(v)
        for v, e in zip(values, errors))


def columns_of(values, errors, verdict):
    """[values, errors, verdict, truth] of a quantity; empty where there are none, or where values
    follow from the others."""
    said = verdict.verdict if verdict else ""
    truth = verdict.truth if verdict else math.nan
    if math.isfinite(truth) and follow(values, errors, truth):
        return ["", " ".join(map(error_text, errors)), said, f"{truth:.12g}"]
    known = any(math.isfinite(e) for e in errors)
    return [listed(values, 7), listed(errors, 2) if known else "", said]


def series_of(series, names):
    """One formulation at one parameter point: columns of its meshes, then those of each quantity
    (None where it has none)."""
    out = {
        "f": series.key, "n": listed([m.n for m in series.meshes], 6),
        "s": listed([m.seconds for m in series.meshes], 3),
        "c": listed([m.cost for m in series.meshes], 3),
        "u": listed([m.free for m in series.meshes], 9),
        "i": listed([m.iterations for m in series.meshes], 9), "q": []
    }
    for name in names:
        found = [m.values.get(name, math.nan) for m in series.meshes]
        if not any(math.isfinite(v) for v in found):
            out["q"].append(None)
            continue
        errors = [m.errors.get(name, math.nan) for m in series.meshes]
        out["q"].append(columns_of(found, errors, answers.verdict_of(series, name)))
    return out


def data_of(case):
    """What the file of a case holds."""
    points = []
    for point in case.points:
        names = list(point.units)
        points.append({
            "t": point.parameters or "defaults", "q": [[q, point.units[q]] for q in names],
            "s": [series_of(s, names) for s in point.series if s.meshes]
        })
    return shared(points)


COLUMNS = "nscui"


def shared(points):
    """{"w": texts that are needed more than once, "points": with their index instead}."""
    every = [s for p in points for s in p["s"]]
    count = collections.Counter(
        text for s in every for text in [*(s[k] for k in COLUMNS), *(t for q in s["q"] if q for t in q)])
    often = [text for text, times in count.most_common() if times > 1 and len(text) > 1]
    index = {text: i for i, text in enumerate(often)}
    for s in every:
        s.update({k: index.get(s[k], s[k]) for k in COLUMNS})
        s["q"] = [q and [index.get(text, text) for text in q] for q in s["q"]]
    return {"w": often, "points": points}


def write_case(site, case):
    text = json.dumps(data_of(case), separators=(",", ":"))
    with open(os.path.join(site.folder, f"data_{case.name}.js"), "w", encoding="utf-8") as out:
        out.write(f"beamwork_data({json.dumps(case.name)}, {text});\n")


def looks(site):
    """{formulation: [colour, element of its marker, dashes]}"""
    out = {}
    for key in site.styles.order:
        look = site.styles.of(key)
        out[key] = [style.Styles.fill(key), chart.form(look["marker"], 6),
                    chart.dashes(look["linestyle"])]
    return out


def write(site):
    chosen = {"cases": [c.name for c in site.cases], "looks": looks(site), "axes": AXES,
              "extra": style.extra(site.styles.order)}
    site.write("explorer.html", "explorer.html", cases=site.cases,
               chosen=json.dumps(chosen, separators=(",", ":")).replace("<", "\\u003c"))


def tasks(site):
    return [functools.partial(write, site)
            ] + [functools.partial(write_case, site, case) for case in site.cases]
