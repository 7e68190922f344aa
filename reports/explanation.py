"""elements/NAME.md: what a formulation is, in words and equations, for its page."""
import re

import markdown

from reports import mathml
from reports.site import ROOT

DISPLAY = re.compile(r"\$\$(.+?)\$\$", re.S)
INLINE = re.compile(r"\$([^$\n]+?)\$")


def rendered(text):
    """Markdown with equations between dollars ($ in a line, $$ on lines of their own) as HTML."""
    equations = []

    def keep(found, display):
        equations.append(mathml.convert(found.group(1), display))
        return f"EQUATION{len(equations) - 1}E"

    text = DISPLAY.sub(lambda found: keep(found, True), text)
    text = INLINE.sub(lambda found: keep(found, False), text)
    page = markdown.markdown(text, extensions=["tables"])
    # What follows an equation without a space stays on its line.
    page = re.sub(r"(EQUATION\d+E)([.,;:)]+)(?!<)", r'<span class="whole">\1\2</span>', page)
    return re.sub(r"EQUATION(\d+)E", lambda found: equations[int(found.group(1))], page)


def sections(text):
    """[(heading, text)] of the parts that begin with a heading of the second level."""
    parts = re.split(r"^## (.+)$", text, flags=re.M)[1:]
    return [(h.strip(), body.strip()) for h, body in zip(parts[::2], parts[1::2])]


def linked(page, pages):
    """The same with names of cases and formulations as links. pages: {name: file}."""

    def link(found):
        name = found.group(1)
        return f'<a href="{pages[name]}">{name}</a>' if name in pages else found.group(0)

    return re.sub(r"<code>(\w+)</code>", link, page)


def of(name, pages):
    """[(heading, HTML)] of a formulation; [] where nothing explains it."""
    path = ROOT / "elements" / f"{name}.md"
    if not path.is_file():
        return []
    return [(h, linked(rendered(body), pages))
            for h, body in sections(path.read_text(encoding="utf-8"))]
