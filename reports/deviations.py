"""Pages of known deviations (reference/findings.csv, with the verdicts that each entry explains), of their causes, and
of the errata."""
import functools
import math
import re

import markdown

from reports import data, verdicts
from reports.checks import stored
from reports.site import ROOT
from reports.verdicts import AS_PREDICTED, OWN_LIMITS, SEVERITY, UNJUDGED, met

NAVIGATION = [("deviations.html", "deviations"), ("errata.html", "errata")]


def slug(title):
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", title).strip().lower())


def headings():
    text = (ROOT / "reference" / "ERRATA.md").read_text(encoding="utf-8")
    return [line[3:].strip() for line in text.splitlines() if line.startswith("## ")]


def link_of(proof, titles):
    if "ERRATA" not in proof:
        return ""
    named = next((t for t in titles if t.lower() in proof.lower()), None)
    return "errata.html" + (f"#{slug(named)}" if named else "")


def predictions(rows):
    """Compares the observed limits with the predicted limits. Returns None if no limit was predicted. Otherwise,
    `met`, `missed` and `open` are the numbers of predictions that agree, that disagree, and that the uncertainty of
    the observed limit leaves open. `least` and `largest` are the smallest and largest relative distances of the
    limits that agree or, if there are none, of those that disagree. `farthest` is the row with the largest distance."""
    told = [r for r in rows if math.isfinite(met(r.verdict))]
    if not told:
        return None
    hit = [r for r in told if r.verdict.verdict in AS_PREDICTED]
    missed = [r for r in told if r.verdict.verdict in OWN_LIMITS and r not in hit]
    farthest = max(hit or missed, key=lambda r: met(r.verdict), default=None)
    size = met(farthest.verdict) if farthest else math.nan
    return {
        "met": len(hit),
        "missed": len(missed),
        "open": len(told) - len(hit) - len(missed),
        "largest": size,
        "digits": -math.log10(size) if size else math.inf,
        "least": min((met(r.verdict) for r in hit or missed), default=math.nan),
        "farthest": farthest,
    }


def left(v):
    """Returns the unexplained deviation of a limit from the predicted limit or, if there is none, from the reference
    value. The deviation is relative to the reference value, as are all errors."""
    if not math.isfinite(v.predicted) or not v.error:
        return abs(v.error)
    return abs((v.limit - v.predicted) * v.error / (v.limit - v.truth))


def line(rule, rows, titles):
    """Returns the table line of the known deviation `rule`. `rows` are its verdicts, including those of aliases and
    misprints, which are not counted."""
    own = [r for r in rows if r.standing == verdicts.OWN]
    seen, left_out = verdicts.counts(rows)
    known = [r for r in own if math.isfinite(r.verdict.error)]
    return {
        **rule,
        "seen": sorted(seen.items(), key=lambda item: -SEVERITY[item[0]]),
        "number": len(own),
        "aliases": left_out.get(verdicts.ALIAS, 0),
        "misprints": left_out.get(verdicts.MISPRINT, 0),
        "worst": max(known, key=lambda r: abs(r.verdict.error), default=None),
        "left": max((left(r.verdict) for r in known), default=math.nan),
        "met": predictions(own),
        "link": link_of(rule["proof"], titles),
    }


def unexplained(rows):
    found = {}
    for r in rows:
        if not r.verdict.as_expected and r.standing == verdicts.OWN:
            key = r.formulation, r.verdict.verdict
            found[key] = found.get(key, 0) + 1
    return sorted(found.items())


def contents(cases, rules):
    rows, titles = list(verdicts.rows(cases)), headings()
    of_rule = {rule["rule"]: [] for rule in rules}
    for row in rows:
        of_rule.get(row.verdict.finding, []).append(row)
    judged = [r for r in rows if r.verdict.verdict not in UNJUDGED]
    seen, left_out = verdicts.counts(judged)
    lines = [line(rule, of_rule[rule["rule"]], titles) for rule in rules]
    own = [r for r in judged if r.standing == verdicts.OWN and r.verdict.verdict != "pass"]
    return {
        "lines": lines,
        "explained": {
            "not_pass": len(own),
            "all": sum(r.verdict.finding in of_rule for r in own),
            "met": sum(r.verdict.verdict in AS_PREDICTED for r in own),
        },
        "seen": sorted(seen.items(), key=lambda item: SEVERITY[item[0]]),
        "aliases": left_out.get(verdicts.ALIAS, 0),
        "misprints": left_out.get(verdicts.MISPRINT, 0),
        "names": verdicts.ALIASES,
        "kept_misprints": verdicts.MISPRINTS,
        "unexplained": unexplained(judged),
    }


def write(site):
    studied = {s["finding"] for s in (stored(site, "causes.json") or {"studies": []})["studies"]}
    context = contents(site.cases, data.read_rules(site.truths))
    site.write("deviations.html", "deviations.html", studied=studied, **context)


def navigation(site):
    return [("causes.html", "causes")] if has_causes(site) else []


def tasks(site):
    pages = (write, write_errata) + ((write_causes,) if has_causes(site) else ())
    return [functools.partial(page, site) for page in pages]



def verdict_of(study):
    gone = [e for e in study["experiments"] if e["gone"]]
    if any(e["kind"] == "finer" for e in gone):
        return "the meshes of the verdict are too coarse"
    names = [
        f"without {e['what']}" if e["kind"] == "without" else f"with {e['formulation']}"
        for e in gone
    ]
    return "gone " + ", ".join(names) if names else "none of these removes it"


def by_rule(record):
    """Returns {entry: [(study, conclusion)]}, sorted by the names of the entries."""
    found = {}
    for study in record["studies"]:
        found.setdefault(study["finding"], []).append((study, verdict_of(study)))
    return dict(sorted(found.items()))


def has_causes(site):
    return stored(site, "causes.json") is not None


def write_causes(site):
    record = stored(site, "causes.json")
    known = {rule["rule"] for rule in data.read_rules(site.truths)}
    solved = sum(any(e["gone"] for e in s["experiments"]) for s in record["studies"])
    site.write("causes.html", "causes.html", record=record, rules=by_rule(record), known=known,
               solved=solved)


def write_errata(site):
    text = (ROOT / "reference" / "ERRATA.md").read_text(encoding="utf-8")
    parser = markdown.Markdown(extensions=["tables", "toc"])
    body = parser.convert(text)
    parts = [(t["id"], t["name"]) for top in parser.toc_tokens for t in top["children"]]
    site.write("errata.html", "errata.html", body=body, parts=parts)
