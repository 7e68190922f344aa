"""reference/ERRATA.md as a page."""
import functools

import markdown

from reports.site import ROOT

NAVIGATION = [("errata.html", "errata")]


def write(site):
    text = (ROOT / "reference" / "ERRATA.md").read_text(encoding="utf-8")
    site.write("errata.html",
               "errata.html",
               body=markdown.markdown(text, extensions=["tables", "toc"]))


def tasks(site):
    return [functools.partial(write, site)]
