"""reference/ERRATA.md as a page."""
import functools

import markdown

from reports.site import ROOT

NAVIGATION = [("errata.html", "errata")]


def write(site):
    text = (ROOT / "reference" / "ERRATA.md").read_text(encoding="utf-8")
    parser = markdown.Markdown(extensions=["tables", "toc"])
    body = parser.convert(text)
    parts = [(t["id"], t["name"]) for top in parser.toc_tokens for t in top["children"]]
    site.write("errata.html", "errata.html", body=body, parts=parts)


def tasks(site):
    return [functools.partial(write, site)]
