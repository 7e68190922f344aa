"""Converts a figure to a short SVG that is embedded in the page. The output of matplotlib is parsed and rewritten:
coordinates are rounded to a tenth of a point, identifiers are made unique in the page, and common attributes of
children are moved to their parent. Black and grey become the colour of the text, so that figures change with dark
mode. Colours of formulations become variables.

Groups with the gid `f|KEY` (style.py) belong to the formulation KEY and have the attribute data-f="KEY". Entries of
legends have data-l="KEY". data-off lists formulations that are initially hidden. The gid `f|KEY|INDEX` also contains
the index of the markers that were passed to site.points(). Elements with the gid `fixed` keep their colours."""
import dataclasses
import io
import json
import math
import re
import zlib
from xml.etree import ElementTree

from markupsafe import Markup, escape

from reports.figures import style

MARKERS = {}  # definitions of the markers of charts by identifier
CURVE = re.compile(r'stroke="([^"]*)"((?: [\w-]+="[^"]*")*) '
                   r'style="(marker(?:-mid)?):url\(#(\w+)\)"')


def markers_in(markup):
    return sorted(set(re.findall(r"marker(?:-mid)?:url\(#(\w+)\)", markup)) & set(MARKERS))


def markers_by_name(markup):
    """Returns the markup without the fallback values of the colour variables, which the style sheet of the page
    defines."""
    return re.sub(r"var\((--f\d+),#[0-9a-f]{6}\)", r"var(\1)", markup)


def with_classes(page):
    """Returns the page with classes that define the colour and marker of each kind of curve once."""
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
    """Returns the page with one definition of each marker that its charts use."""
    names = markers_in(page)
    if not names:
        return page
    defined = markers_by_name("".join(MARKERS[name] for name in names))
    hidden = '<svg width="0" height="0" style="position:absolute" aria-hidden="true"><defs>'
    page = with_classes(page)
    return page.replace("</main>", f"{hidden}{defined}</defs></svg>\n</main>", 1)


SVG, LINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}href"
INHERITED = ("fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-linejoin",
             "stroke-linecap", "stroke-dasharray", "font-size", "text-anchor", "clip-path")
USUAL = {"stroke-linejoin": "round", "stroke-linecap": "butt", "stroke-dashoffset": "0",
         "stroke-opacity": "1", "fill-opacity": "1", "opacity": "1", "text-anchor": "start"}
SHORT = {"separators": (",", ":"), "ensure_ascii": False}  # options for short JSON
FONT = "'DejaVu Sans',Verdana,sans-serif"
NUMBER = re.compile(r"-?\d*\.?\d+(?:e-?\d+)?")


@dataclasses.dataclass(frozen=True)
class Image:
    """A figure of the site. `name` is the name of its file. `markup` is the SVG for the page, without a title. `points`
    contains the tooltip texts of its markers as JSON."""
    name: str
    markup: str
    points: str = ""

    def __str__(self):
        return self.name

    def inline(self, alt):
        """Returns the SVG with the alternative text `alt`, followed by `points` in a script element."""
        data = f'<script type="application/json">{self.points}</script>' if self.points else ""
        name = escape(self.name.removesuffix(".svg"))
        width = re.search(r' width="(\d+)"', self.markup)
        own = (f'<svg id="{name}" role="img" aria-label="{escape(alt)}" '
               f'style="--width:{width[1] if width else 700}px"')
        return Markup(markers_by_name(self.markup).replace("<svg", own, 1) + data)


def plain(value, digits):
    """Returns a number rounded to `digits` significant digits, or None if it is not finite. Strings, integers and None
    are returned unchanged."""
    if isinstance(value, (str, int)) or value is None:
        return value
    if not math.isfinite(value):
        return None
    short = float(f"{value:.{digits}g}")
    return int(short) if short == int(short) and abs(short) < 1e6 else short


def said_of(told):
    """Returns the tooltip texts of the markers as JSON for script.js. Headings (h) and columns (v) are stored once.
    Values that are equal in all rows of a curve (k) are omitted from the columns. Each curve lists its columns (r)."""
    if not told:
        return ""
    heads, curves, columns = [], [], {}
    for one in told:
        head, rows = one["c"], one["r"]
        heads += [] if head in heads else [head]
        same = {k: rows[0][k] for k in range(len(head)) if rows and
                all(row[k] == rows[0][k] for row in rows)}
        own = [json.dumps([row[k] for row in rows], **SHORT) for k in range(len(head))
               if k not in same]
        curves.append({"f": one["f"], "t": one["t"], "h": heads.index(head), "k": same,
                       "n": len(rows),
                       "r": [columns.setdefault(column, len(columns)) for column in own]})
    text = (f'{{"h":{json.dumps(heads, **SHORT)},"v":[{",".join(columns)}],'
            f'"s":{json.dumps(curves, **SHORT)}}}')
    return text.replace("<", "\\u003c")


def number(text, digits=1):
    short = f"{float(text):.{digits}f}".rstrip("0").rstrip(".")
    return "0" if short in ("-0", "") else short


def path(text, digits):
    rounded = NUMBER.sub(lambda found: number(found.group(), digits), text)
    return re.sub(r"\s*([MLCQzZ])\s*", r"\1", " ".join(rounded.split())).replace(" -", "-")


def properties(text):
    return dict(item.strip().split(": ", 1) for item in text.split(";") if ": " in item)


def ink(own, name):
    """Replaces the colour in own[name]: black and grey by the colour of the text with an opacity, white by the colour of
    the paper, and colours in style.VARIABLES by their variables."""
    colour = own.get(name, "none")
    if not re.fullmatch("#[0-9a-f]{6}", colour):
        return
    red, green, blue = (int(colour[i:i + 2], 16) for i in (1, 3, 5))
    if red == green == blue == 255:
        own[name] = "var(--paper,#fff)"
    elif red == green == blue:
        own[name] = "currentColor"
        opacity = float(own.get(f"{name}-opacity", 1)) * (1 - red / 255)
        own[f"{name}-opacity"] = number(opacity, 2)
    else:
        own[name] = style.VARIABLES.get(colour, colour)


def dressed(element, fixed):
    """Returns the attributes of an SVG element, including its style, in the shortest form."""
    own = properties(element.get("style", ""))
    own.update({name: element.get(name) for name in ("clip-path",) if element.get(name)})
    if not fixed:
        ink(own, "fill")
        ink(own, "stroke")
    font = re.match(r"(.*?)([\d.]+)px", own.pop("font", ""))
    if font:
        own["font-size"] = number(font.group(2))
        own.update({"font-style": "italic"} if "italic" in font.group(1) else {})
        own.update({"font-weight": "bold"} if re.search("bold|700", font.group(1)) else {})
    if own.get("stroke", "none") == "none" and element.tag not in (f"{SVG}use", f"{SVG}g"):
        own = {name: value for name, value in own.items() if not name.startswith("stroke")}
    return {name: value for name, value in own.items() if USUAL.get(name) != value}


class Writer:
    """Rewrites an SVG of matplotlib. `prefix` is the start of its identifiers, which must be unique in the page."""

    def __init__(self, root, prefix):
        text = ElementTree.tostring(root, encoding="unicode")
        used = dict.fromkeys(re.findall(r'href="#([^"]+)"|url\(#([^)]+)\)', text))
        self.names = {a or b: f"{prefix}{i:x}" for i, (a, b) in enumerate(used)}
        self.points, self.keys = {}, {}

    def attributes(self, element, tag, fixed):
        own = dressed(element, fixed)
        if "clip-path" in own:
            own["clip-path"] = f"url(#{self.names[own['clip-path'][5:-1]]})"
        name = element.get("id", "")
        if name in self.names:
            own["id"] = self.names[name]
        if name.startswith("l|"):
            own["data-l"] = name[2:]
        if name.startswith("f|"):
            _, own["data-f"], *points = name.split("|")
            self.keys[own["data-f"]] = None
            if points:
                own["data-p"] = str(self.points.setdefault(points[0], len(self.points)))
        if element.get(LINK):
            link = element.get(LINK)
            own["href"] = f"#{self.names[link[1:]]}" if link.startswith("#") else link
        if "d" in element.attrib:
            own["d"] = path(element.get("d"), 2 if name else 1)
        for name in ("x", "y", "width", "height", "cx", "cy", "r"):
            if name in element.attrib:
                own[name] = number(element.get(name).split()[0])
        if "transform" in element.attrib:
            moved = path(element.get("transform"), 2)
            own.update({} if moved.startswith("rotate(0 ") else {"transform": moved})
        return own

    def read(self, element, fixed=False):
        """Returns (tag, attributes, children, text), or None if nothing is drawn."""
        tag = element.tag.removeprefix(SVG)
        fixed = fixed or element.get("id") == "fixed"
        own = self.attributes(element, tag, fixed)
        if tag in ("metadata", "style") or (tag in ("path", "rect") and own.get("fill") == "none"
                                            and "stroke" not in own):
            return None
        children = [c for c in (self.read(child, fixed) for child in element) if c]
        if tag in ("g", "defs") and not children:
            return None
        children = self.joined(children)
        if tag == "g":
            self.share(own, children)
            if len(children) == 1 and children[0][0] == "g" and not set(own) & set(children[0][1]):
                own.update(children[0][1])
                children = children[0][2]
        return tag, own, children, (element.text or "").strip() if tag in ("text", "tspan") else ""

    @staticmethod
    def joined(children):
        out = []
        for child in children:
            tag, own, _, _ = child
            look = {name: value for name, value in own.items() if name != "d"}
            last = out[-1] if out else None
            if tag == "path" and own.get("fill") == "none" and "id" not in own and last and (
                    last[0] == "path" and {**last[1], "d": ""} == {**look, "d": ""}):
                last[1]["d"] += own["d"]
            else:
                out.append(child)
        return out

    @staticmethod
    def share(own, children):
        drawn = [c for c in children if c[0] != "defs"]
        for name in INHERITED:
            values = {c[1].get(name) for c in drawn}
            if len(values) == 1 and len(drawn) > 1 and None not in values and name not in own:
                if name == "clip-path" and "transform" in own:
                    continue
                own[name] = values.pop()
                for c in drawn:
                    del c[1][name]

    def write(self, node):
        tag, own, children, text = node
        inside = str(escape(text)) + "".join(self.write(child) for child in children)
        if tag in ("g", ) and not own:
            return inside
        words = "".join(f' {name}="{escape(value)}"' for name, value in own.items())
        return f"<{tag}{words}>{inside}</{tag}>" if inside else f"<{tag}{words}/>"


def short(svg, name):
    """Returns (SVG for a page, indices of its markers in the arguments of site.points()) from the output of
    matplotlib."""
    root = ElementTree.fromstring(svg)
    writer = Writer(root, f"{zlib.crc32(name.encode()):08x}"[:5].translate(
        str.maketrans("0123456789", "ghijklmnop")))
    _, _, width, height = (float(x) for x in root.get("viewBox").split())
    nodes = writer.joined([node for node in map(writer.read, root) if node])
    inside = "".join(map(writer.write, nodes))
    size = f'width="{width / 0.75:.0f}" height="{height / 0.75:.0f}"'
    off = escape(" ".join(style.extra(writer.keys)))
    return (f'<svg viewBox="0 0 {width:g} {height:g}" {size} fill="currentColor" '
            f'data-off="{off}" stroke-linejoin="round" font-family="{FONT}">{inside}</svg>',
            writer.points)


def alone(markup):
    names = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    used = [MARKERS[m] for m in markers_in(markup)]
    markup = markup.replace("</svg>", f"<defs>{''.join(used)}</defs></svg>") if used else markup
    return '<?xml version="1.0" encoding="utf-8"?>\n' + markup.replace(
        "<svg", f"<svg {names}", 1).replace(' href="', ' xlink:href="')


def handles_of(legend):
    return legend.legend_handles if hasattr(legend, "legend_handles") else legend.legendHandles


def tag_legends(figure):
    owners = {}
    for axes in figure.axes:
        for artist in axes.get_children():
            if (artist.get_gid() or "").startswith("f|"):
                key = artist.get_gid().split("|")[1]
                owners[artist.get_label()] = owners[key] = f"l|{key}"
    legends = list(figure.legends) + [axes.get_legend() for axes in figure.axes]
    for legend in filter(None, legends):
        for words, handle in zip(legend.get_texts(), handles_of(legend)):
            if words.get_text() in owners:
                words.set_gid(owners[words.get_text()])
                handle.set_gid(owners[words.get_text()])


def image_of(figure, name, said, tight=True):
    """Returns the Image of a figure. `said` contains the arguments of site.points(). If `tight` is True, the figure is
    cropped to its contents and is therefore drawn twice."""
    tag_legends(figure)
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None},
                   bbox_inches="tight" if tight else None)
    markup, points = short(out.getvalue(), name)
    told = [said[int(index)] for index in points]
    return Image(f"{name}.svg", markup, said_of(told))
