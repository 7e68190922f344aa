"""Experiments on the causes of the ledger, which `make lab L=causes` leaves beside the results."""
import functools

from reports import data
from reports.checks import stored

NAVIGATION = [("causes.html", "causes")]


def verdict_of(study):
    """What the experiments on one verdict show, in words for the head of its table."""
    gone = [e for e in study["experiments"] if e["gone"]]
    if any(e["kind"] == "finer" for e in gone):
        return "the meshes of the verdict are too coarse"
    names = [
        f"without {e['what']}" if e["kind"] == "without" else f"with {e['formulation']}"
        for e in gone
    ]
    return "gone " + ", ".join(names) if names else "none of these takes it away"


def by_rule(record):
    """{rule: [(study, what it shows)]} in the order of the rules' names."""
    found = {}
    for study in record["studies"]:
        found.setdefault(study["finding"], []).append((study, verdict_of(study)))
    return dict(sorted(found.items()))


def present(site):
    return stored(site, "causes.json") is not None


def write(site):
    record = stored(site, "causes.json")
    known = {rule["rule"] for rule in data.read_rules(site.truths)}
    solved = sum(any(e["gone"] for e in s["experiments"]) for s in record["studies"])
    site.write("causes.html", "causes.html", record=record, rules=by_rule(record), known=known,
               solved=solved)


def tasks(site):
    return [functools.partial(write, site)]
