"""Element reports. For each formulation, an element report contains the results of `beamwork element-test`: interface
requirements, uniform and linear states, locking and orders of convergence."""
import functools
import math

from reports import experiments
from reports.figures.chart import Chart

NAVIGATION = [("certificates.html", "certificates")]
STATES, LOCKING, ORDERS = "states", "locking", "orders"
LINES = ("-", "--", ":", "-.")
FLOOR = 1e-16  # smallest drawn value
EXACT = 1e-9  # errors below this bound are shown as exact, as in the program
MARKS = {"holds": "✔", "broken": "✘", "not claimed": "–"}


def part_of(record, formulation, family, points):
    """Returns the row `family` of a group of checks with the requirements (claims) and the measurements of one
    formulation. Each measurement contains its points, `at` and `error`."""
    def own(table):
        return [row for row in record[table]
                if (row["formulation"], row["family"]) == (formulation, family["family"])]

    measured = [{**one, **points_of(points, one)} for one in own("measured")]
    return {**family, "claims": own("claims"), "measured": measured}


def points_of(points, measure):
    found = points.get((measure["formulation"], measure["family"], measure["name"]), [])
    return {"at": [row["at"] for row in found], "error": [row["error"] for row in found]}


def read(path):
    record = experiments.read(path, "element-test")
    if record is None:
        return None
    points = experiments.grouped(record["measured_points"], "formulation", "family", "name")
    for one in record["formulations"]:
        one["parts"] = [part_of(record, one["formulation"], family, points)
                        for family in record["parts"]]
    return record


def stored(site):
    return read(site.results)


def shown(site):
    record = stored(site)
    if record is None:
        return []
    known = {key.partition(":")[0] for key in site.styles.order}
    return [c for c in record["formulations"] if c["formulation"] in known]


def present(site):
    return bool(shown(site))


def names(site):
    return {c["formulation"] for c in shown(site)}


def percent(error):
    if error is None:
        return "–"
    size = 100 * abs(error)
    if abs(error) < EXACT:
        return "exact"
    return f"{size:.0e} %" if size < 1e-2 or size >= 999 else f"{size:.2g} %"


def standing(part):
    """Returns the worst outcome of the requirements in a group, and the number of checked requirements."""
    made = [c["outcome"] for c in part["claims"] if c["outcome"] != "not claimed"]
    return "broken" if "broken" in made else made[0] if made else "not claimed", len(made)


class Certificate:
    """Element report of one formulation. `parts` are all groups of checks, `families` those without measurements, and
    `measured` the others by name. `claims` is the number of checked requirements."""

    def __init__(self, record):
        self.key, self.summary, self.source = (record[k]
                                               for k in ("formulation", "summary", "source"))
        self.leaves, self.kept, self.compared = (record[k]
                                                 for k in ("leaves", "kept", "compared"))
        self.families = [p for p in record["parts"] if not p["measured"]]
        self.measured = {p["family"]: p for p in record["parts"] if p["measured"]}
        self.parts = record["parts"]
        self.claims = sum(standing(p)[1] for p in self.parts)

    def group(self, name):
        return self.measured[name]["measured"] if name in self.measured else []


def curve(site, panel, certificate, one, line, columns):
    points = [(x, abs(e)) for x, e in zip(one["at"], one["error"]) if e is not None]
    if not points:
        return
    look = site.points(certificate.key, columns, points, one["name"])
    panel.plot([x for x, _ in points], [max(e, FLOOR) for _, e in points],
               **{**look, "linestyle": line}, label=one["name"])


def draw(site, certificate):
    chart = Chart(2, (330, 200), apart=True)
    thin = chart.panel("locking", "thickness / length", "relative error")
    fine = chart.panel("convergence", "elements", "", whole=True, like=thin)
    thin.y.take([FLOOR / 2, 1])
    for one, line in zip(certificate.group(LOCKING), LINES):
        curve(site, thin, certificate, one, line, ("thickness / length", "error"))
    for one, line in zip(certificate.group(ORDERS), LINES):
        curve(site, fine, certificate, one, line, ("elements", "error"))
    return chart.image(site, f"certificate_{certificate.key}")


def order(one):
    """Returns the order and the declared range in text form, such as "2.0, declared 2 to 4"."""
    declared = f"declared {one['least']} to {one['highest']}"
    if one["order"] is None or not math.isfinite(one["order"]):
        exact = one["error"] and one["error"][-1] is not None and abs(one["error"][-1]) < EXACT
        return f"{'exact' if exact else 'none seen'}, {declared}"
    return f"{one['order']:.1f}, {declared}"


def write(site):
    record = stored(site)
    found = [Certificate(c) for c in shown(site)]
    site.write("certificates.html", "certificates.html", record=record, about=site.about, found=found,
               families=[p["family"] for p in found[0].families],
               what=[p for p in found[0].parts], standing=standing, marks=MARKS, percent_of=percent,
               order_of=order, images={c.key: draw(site, c) for c in found},
               groups=(STATES, LOCKING, ORDERS))


def tasks(site):
    return [functools.partial(write, site)]
