"""Explanations of the terms of the report and of the program, from /glossary in truths.h5."""
import functools
import re

from markupsafe import Markup, escape

from reports import data

NAVIGATION = [("glossary.html", "glossary")]
PAGE = "glossary.html"
# groups in the order in which readers need them, followed by all other groups
GROUPS = ("verdicts", "convergence", "truths", "time and work", "outcomes of a solution",
          "stability", "physics", "elements", "solution", "analyses", "structure",
          "extremes", "program")


def present(site):
    return bool(terms(site.truths))


@functools.lru_cache(maxsize=4)
def terms(truths):
    return data.read_glossary(truths)


def anchor(term):
    return re.sub(r"[^a-z0-9]+", "-", term.lower()).strip("-") or "term"


def split(text):
    return [word for word in text.split("|") if word]


def places(rows):
    found = {}
    for row in rows:
        for name in (row["term"], *split(row["also"])):
            found.setdefault(name.lower(), anchor(row["term"]))
    return found


def linker(truths):
    """Returns the template filter `term`, which converts a term to a link if the glossary contains the term."""
    known = places(terms(truths))

    def term(words, name=None):
        place = known.get((name or words).lower())
        if place is None:
            return escape(words)
        return Markup('<a class="term" href="{}#{}">{}</a>').format(PAGE, place, words)

    return term


def grouped(rows):
    names = [*GROUPS, *dict.fromkeys(r["group"] for r in rows if r["group"] not in GROUPS)]
    return [(name, [r for r in rows if r["group"] == name]) for name in names
            if any(r["group"] == name for r in rows)]


def write(site):
    rows = [{**r, "also": split(r["also"]), "see": split(r["see"])} for r in terms(site.truths)]
    site.write("glossary.html", PAGE, groups=grouped(rows), anchor=anchor)


def tasks(site):
    return [functools.partial(write, site)]
