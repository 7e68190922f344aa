"""A page on which the reader chooses case, quantity and axes; assets/explorer.js draws.

The numbers of each case are a file of their own, data_CASE.js, loaded when the case is chosen:
lists are texts of numbers between blanks, `-` where there is none."""
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


def series_of(series, names):
    """One formulation at one parameter point: columns of its meshes, then value, error and verdict
    of each quantity (None where it has none)."""
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
        verdict = answers.verdict_of(series, name)
        errors = [abs(m.errors.get(name, math.nan)) for m in series.meshes]
        known = any(math.isfinite(e) for e in errors)
        out["q"].append([listed(found, 7), listed(errors, 2) if known else "",
                         verdict.verdict if verdict else ""])
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
    return {"points": points}


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
