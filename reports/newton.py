"""Compares Newton's method in coordinates, strains and stresses (mixed form) with Newton's method in displacements: the
largest possible step, and its cost."""
import functools
import json
import os

from reports.figures.style import plt

NAVIGATION = [("newton.html", "Newton")]
FORMS = ("mixed", "displacement")


def read(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None


def largest(values, iterations):
    """Returns (largest value up to which all values converged in one step, iterations at this value), or (None, None)."""
    best = (None, None)
    for value, count in zip(values, iterations):
        if count is None:
            break
        best = (value, count)
    return best


def singles(data):
    """Returns the largest steps of each case and formulation, [(case, [(formulation, unit, {form: result of
    largest()}, largest tried value)])]."""
    cases = {}
    for s in data["singles"]:
        row = (f"{s['formulation']}, n = {s['elements']}", s["unit"], {
            form: largest(s["values"], s[form])
            for form in FORMS
        }, s["values"][-1])
        cases.setdefault(f"{s['case']}: {s['parameter']} in one step", []).append(row)
    return list(cases.items())


def farther(data):
    """Returns the number of comparisons, and the numbers of those in which the mixed form converges for larger and
    only for smaller steps than the displacement form."""
    best = [[largest(s["values"], s[form])[0] or 0 for form in FORMS] for s in data["singles"]]
    return len(best), sum(m > d for m, d in best), sum(m < d for m, d in best)


def contests(data):
    """Returns the comparisons of cost, [(case, [(formulation, numbers of first steps, {form: results})])]."""
    cases = {}
    for c in data["contests"]:
        row = (f"{c['formulation']}, n = {c['elements']}", c["first_steps"], {
            form: c[form]
            for form in FORMS
        })
        cases.setdefault(f"{c['case']} ({c['parameters']})", []).append(row)
    return list(cases.items())


def figure_of(case, histories):
    """Quadratic convergence has the slope two."""
    figure, axes = plt.subplots(figsize=(5.2, 4.2))
    for marker, form in zip("o+", FORMS):
        for h in (h for h in histories if h["form"] == form):
            pairs = [(a, b) for s in h["steps"]
                     for a, b in zip(s["corrections"], s["corrections"][1:])
                     if a and b and b > 1e-15]
            if pairs:
                axes.loglog(*zip(*pairs),
                            marker,
                            label=f"{h['formulation']}, {form}",
                            fillstyle="none",
                            linestyle="none")
    axes.loglog([1e-7, 1], [1e-14, 1], "k--", linewidth=0.8, label="square")
    axes.set_xlabel("correction")
    axes.set_ylabel("the next one")
    axes.set_title(case)
    axes.legend(fontsize=7)
    axes.grid(True, linewidth=0.3)
    return figure


def stored(site):
    return read(os.path.join(os.path.dirname(site.results), "newton.json"))


def present(site):
    return stored(site) is not None


def write(site):
    data = stored(site)
    cases = {}
    for h in data["histories"]:
        cases.setdefault(h["case"], []).append(h)
    drawn = [(case, site.image(figure_of(case, rows), f"newton_{case}"), rows)
             for case, rows in cases.items()]
    site.write("newton.html",
               "newton.html",
               farther=farther(data),
               singles=singles(data),
               contests=contests(data),
               histories=drawn)


def tasks(site):
    return [functools.partial(write, site)]
