"""The papers figure by figure (reference/papers.csv), beside what is measured here, and equation by equation (reference/equations.csv)."""
import csv
import functools
import math

from reports import data
from reports.claims import Lookup, canonical
from reports.site import ROOT, number, percent

NAVIGATION = [("papers.html", "papers")]
TABLE = ROOT / "reference" / "papers.csv"
EQUATIONS = ROOT / "reference" / "equations.csv"
STATUSES = ("reproduced", "partly", "not reproducible", "contradicted", "open")
NAMES = {
    "J": "J: thin-walled beam element with shear (Jonker)",
    "N": "N: third-order sheet element (Nijenhuis, Meijaard, Naves, Aarts)",
}


def read(path=TABLE):
    """Rows of a table, in its order."""
    with open(path, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def measured(look, truths, row):
    """What the results hold of a row, in words; '' if it names no cell or the cell was not run."""
    if not row["elements"]:
        return ""
    cell = row["case"], row["parameters"], row["formulation"], int(row["elements"]), row["quantity"]
    value, error, other = (
        look.value(*cell),
        look.error(*cell),
        data.read_other_model(truths, row["case"], row["parameters"], row["quantity"]),
    )
    if not math.isfinite(value):
        return ""
    unit = look.points[row["case"], canonical(row["parameters"])].units.get(row["quantity"], "")
    words = [f"{number(value)} {'' if unit == '1' else unit}".strip()] + (
        [f"{percent(error)} from the exact beam"] if math.isfinite(error) else []
    )
    return ", ".join(
        words
        + ([f"{percent(value / other - 1)} from plate or solid"] if math.isfinite(other) else [])
    )


def counts(rows):
    """[(status, number of rows)] of one paper."""
    return [(status, sum(r["status"] == status for r in rows)) for status in STATUSES]


def write(site):
    look, cases = Lookup(site.cases), {c.name for c in site.cases}
    rows = [
        {**row, "measured": measured(look, site.truths, row), "linked": row["case"] in cases}
        for row in read()
    ]
    sets = read(EQUATIONS)
    papers = [(title, [r for r in rows if r["paper"] == letter],
               [r for r in sets if r["paper"] == letter]) for letter, title in NAMES.items()]
    site.write(
        "papers.html", "papers.html",
        papers=[(title, counts(of), of, equations) for title, of, equations in papers],
        total=[(status, n) for status, n in counts(rows) if n]
    )


def tasks(site):
    return [functools.partial(write, site)]
