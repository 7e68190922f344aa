"""Certificates: what a paper should print of its element. For each formulation the contract of the
interface, claim by claim, uniform and linear states, locking and orders of convergence, as
`beamwork element-test --json` wrote them (build/elements.json)."""
import functools
import json
import math
import os

from reports.chart import Chart

NAVIGATION = [("certificates.html", "certificates")]
STATES, LOCKING, ORDERS = "states", "locking", "orders"
LINES = ("-", "--", ":", "-.")
FLOOR = 1e-16  # of what is drawn
EXACT = 1e-9  # as the text of the program says it
MARKS = {"holds": "✔", "broken": "✘", "not claimed": "–"}


def read(path):
    """What `beamwork element-test --json` wrote, or None."""
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def stored(site):
    """The record beside the results, or None."""
    return read(os.path.join(os.path.dirname(os.path.abspath(site.results)), "elements.json"))


def shown(site):
    """Certificates of the formulations that the results are of."""
    record = stored(site)
    if record is None:
        return []
    known = {key.partition(":")[0] for key in site.styles.order}
    return [c for c in record["certificates"] if c["formulation"] in known]


def present(site):
    return bool(shown(site))


def names(site):
    """Those that have a certificate, for the pages of formulations."""
    return {c["formulation"] for c in shown(site)}


def percent(error):
    """As the text of the program says it."""
    if error is None:
        return "–"
    size = 100 * abs(error)
    if abs(error) < EXACT:
        return "exact"
    return f"{size:.0e} %" if size < 1e-2 or size >= 999 else f"{size:.2g} %"


def standing(part):
    """(worst outcome of its claims, how many it has that hold or are broken)."""
    made = [c["outcome"] for c in part["claims"] if c["outcome"] != "not claimed"]
    return "broken" if "broken" in made else made[0] if made else "not claimed", len(made)


class Certificate:
    """One formulation's: its families of claims and its measured groups by name."""

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
    """Errors of one measure in a panel."""
    points = [(x, abs(e)) for x, e in zip(one["at"], one["error"]) if e is not None]
    if not points:
        return
    look = site.points(certificate.key, columns, points, one["name"])
    panel.plot([x for x, _ in points], [max(e, FLOOR) for _, e in points],
               **{**look, "linestyle": line}, label=one["name"])


def draw(site, certificate):
    """Locking over thickness, and errors over elements."""
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
    """"2.0, declared 2 to 4"."""
    declared = f"declared {one['least']} to {one['highest']}"
    if one["order"] is None or not math.isfinite(one["order"]):
        exact = one["error"] and one["error"][-1] is not None and abs(one["error"][-1]) < EXACT
        return f"{'exact' if exact else 'none seen'}, {declared}"
    return f"{one['order']:.1f}, {declared}"


def write(site):
    record = stored(site)
    found = [Certificate(c) for c in shown(site)]
    site.write("certificates.html", "certificates.html", record=record, found=found,
               families=[p["family"] for p in found[0].families],
               what=[p for p in found[0].parts], standing=standing, marks=MARKS, percent_of=percent,
               order_of=order, images={c.key: draw(site, c) for c in found},
               groups=(STATES, LOCKING, ORDERS))


def tasks(site):
    return [functools.partial(write, site)]
