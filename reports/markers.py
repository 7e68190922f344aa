"""Markers of charts, and what the curves of a page share: said once in the page."""
import re

MARKERS = {}  # identifier of a marker of charts: its definition
CURVE = re.compile(r'stroke="([^"]*)"((?: [\w-]+="[^"]*")*) '
                   r'style="(marker(?:-mid)?):url\(#(\w+)\)"')


def used(markup):
    """Identifiers of the markers of charts in it."""
    return sorted(set(re.findall(r"marker(?:-mid)?:url\(#(\w+)\)", markup)) & set(MARKERS))


def by_name(markup):
    """Colours of formulations by their names only, which a page has from its style sheet."""
    return re.sub(r"var\((--f\d+),#[0-9a-f]{6}\)", r"var(\1)", markup)


def with_classes(page):
    """The page with colour and marker of each kind of curve said once, in a class."""
    looks = {}

    def named(found):
        stroke, others, where, marker = found.groups()
        name = looks.setdefault((stroke, where, marker), f"q{len(looks)}")
        return f'class="{name}"{others}'

    short = CURVE.sub(named, page)
    rules = "".join(f".{name}{{stroke:{stroke};{where}:url(#{marker})}}"
                    for (stroke, where, marker), name in looks.items())
    return short.replace("</head>", f"<style>{rules}</style>\n</head>", 1) if looks else page


def with_markers(page):
    """The page with the definitions of the markers that its charts use, once."""
    names = used(page)
    if not names:
        return page
    defined = by_name("".join(MARKERS[name] for name in names))
    hidden = '<svg width="0" height="0" style="position:absolute" aria-hidden="true"><defs>'
    page = with_classes(page)
    return page.replace("</main>", f"{hidden}{defined}</defs></svg>\n</main>", 1)
