"""The two papers, item by item: every printed number with the number computed here, their difference, the status and the
proof, and the equations with the functions and tests that contain them."""
import csv
import functools
import math
from dataclasses import dataclass
from decimal import Decimal

from reports import answers, data
from reports.claims import Lookup, canonical
from reports.site import ROOT, number

NAVIGATION = [("papers.html", "papers")]
REFERENCE = ROOT / "reference"
STATUSES = ("reproduced", "partly", "not reproducible", "contradicted", "open")
NAMES = {
    "J": "J: thin-walled beam element with shear (Jonker)",
    "N": "N: third-order sheet element (Nijenhuis, Meijaard, Naves, Aarts)",
}
FACTORS = {"MN": 1e6, "1e5 N/m": 1e5, "%": 0.01}  # size of the printed unit in the unit of the results
MEASURES = {  # what is compared
    "value": "run", "exact": "exact value", "error": "error of the run", "plate": "run against plate or solid",
    "time": "time of the run", "derived": "", "none": "",
}


def read(name="papers.csv"):
    with open(REFERENCE / name, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


@dataclass(frozen=True)
class Number:
    """A printed number and the computed one, as text in the printed unit. `by` is the proof: a run, a file or a test."""

    name: str
    printed: str
    unit: str
    ours: str
    difference: str
    by: str


def exact(look, row):
    point = look.points.get((row["case"], canonical(row["parameters"])))
    return next((v.truth for s in (point.series if point else ()) if s.key == row["formulation"] for v in s.verdicts
                 if v.quantity == row["quantity"] and math.isfinite(v.truth)), math.nan)


def relative_time(look, cell):
    """Returns the time, or cost, of a run relative to one element of third order."""
    first = look.mesh(cell[0], "", "sheet_third", 1), look.points.get((cell[0], ""))
    mesh = look.mesh(*cell[:4])
    if mesh is None or first[0] is None:
        return math.nan
    of = answers.measure_of(first[1]).of
    return of(mesh) / of(first[0])


def computed(look, truths, row):
    """Returns the computed value of a row in the unit of the results, or NaN."""
    if not row["case"]:
        return math.nan
    cell = row["case"], row["parameters"], row["formulation"], int(row["elements"]), row["quantity"]
    if row["measure"] == "exact":
        return exact(look, row)
    if row["measure"] == "time":
        return relative_time(look, cell)
    if row["measure"] == "error":
        return look.error(*cell)
    value = look.value(*cell)
    if row["measure"] == "plate":
        return value / data.read_other_model(truths, row["case"], row["parameters"], row["quantity"]) - 1
    return value


def compared(row, value):
    """Returns Number. Percentages differ by points; other numbers by a share of the printed one."""
    of_percent = row["unit"] == "%"
    given = row["measure"] in ("derived", "none")
    own = float(row["ours"]) if row["ours"] else math.nan if given else value / FACTORS.get(row["unit"], 1)
    own = abs(own) if of_percent else own
    printed = float(row["printed"]) if row["printed"] else math.nan
    ours = row["ours"] if given else f"{own:.3g}" if of_percent else number(own, 6) if math.isfinite(own) else ""
    known = math.isfinite(own) and math.isfinite(printed) and row["ours"] != row["printed"]
    rounds = known and abs(own - printed) <= 0.5000001 * 10.0**Decimal(row["printed"]).as_tuple().exponent
    difference = "" if not known else "rounds to it" if rounds and not of_percent else f"{own - printed:+.2g} points" if of_percent else f"{100 * (own / printed - 1):+.2g} %"
    key = "" if row["measure"] == "exact" else f"{row['formulation']}, n = {row['elements']}"
    run = "; ".join(filter(None, (row["case"], row["parameters"], key, row["quantity"])))
    by = row["proof"] or f"{MEASURES[row['measure']]}: {run}"
    return Number(row["number"], row["printed"], row["unit"], ours if ours != "nan" else "", difference, by)


def measured(look, truths, row):
    """Returns Number of a statement that names a run but prints no number, or None."""
    if not row["elements"]:
        return None
    value, error = (of(row["case"], row["parameters"], row["formulation"], int(row["elements"]), row["quantity"])
                    for of in (look.value, look.error))
    point = look.points.get((row["case"], canonical(row["parameters"])))
    if not math.isfinite(value) or point is None:
        return None
    unit = point.units.get(row["quantity"], "")
    told = f"{100 * error:+.2g} % from the exact beam" if math.isfinite(error) else ""
    run = "; ".join(filter(None, (row["case"], row["parameters"], row["formulation"])))
    return Number(row["quantity"], "", "" if unit == "1" else unit, number(value), told, f"run: {run}, n = {row['elements']}")


def items(look, truths, paper):
    """Returns [(row of papers.csv, [Number])] of a paper."""
    printed = {}
    for row in read("papers_numbers.csv"):
        one = compared(row, computed(look, truths, row))
        printed.setdefault((row["paper"], row["item"], row["claim"]), []).append(one)
    out = []
    for row in (r for r in read() if r["paper"] == paper):
        own = printed.get((row["paper"], row["item"], row["claim"])) or [measured(look, truths, row)]
        out.append((row, [one for one in own if one]))
    return out


def counts(rows):
    return [(status, sum(r["status"] == status for r in rows)) for status in STATUSES]


def write(site):
    look, cases = Lookup(site.cases), {c.name for c in site.cases}
    sets = read("equations.csv")
    papers = []
    for letter, title in NAMES.items():
        found = items(look, site.truths, letter)
        papers.append((title, counts([row for row, _ in found]), found, [r for r in sets if r["paper"] == letter]))
    total = [(status, n) for status, n in counts([row for _, _, found, _ in papers for row, _ in found]) if n]
    site.write("papers.html", "papers.html", papers=papers, total=total, cases=cases,
               printed=sum(bool(n.printed) for _, _, found, _ in papers for _, own in found for n in own))


def tasks(site):
    return [functools.partial(write, site)]
