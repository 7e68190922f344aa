"""Configuration of the site of `make docs`: Sphinx, MyST, and equations in MathML, which needs no network access."""
import pathlib
import re
import sys

from docutils import nodes

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
from reports import mathml  # noqa: E402  pylint: disable=wrong-import-position

project = "beamwork"
release = version = re.search(r"^version: *(\S+)", (ROOT / "CITATION.cff").read_text("utf-8"),
                              re.M).group(1)
copyright = "The beamwork developers, GPL-3.0-or-later"  # pylint: disable=redefined-builtin
extensions = ["myst_parser"]
myst_enable_extensions = ["deflist", "dollarmath"]
myst_heading_anchors = 3
exclude_patterns = ["sources"]  # files that other pages include
highlight_language = "none"
html_theme = "furo"
html_title = f"beamwork {version}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_search_summary = False  # the summary would be fetched, which browsers forbid for local files
html_math_renderer = "mathml"
suppress_warnings = ["myst.header"]  # descriptions of formulations begin below the title of their page


def inline_equation(translator, node):
    """Renders an equation within a line."""
    translator.body.append(mathml.convert(node.astext()))
    raise nodes.SkipNode


def displayed_equation(translator, node):
    """Renders an equation on a separate line."""
    translator.body.append(f'<div class="math">{mathml.convert(node.astext(), True)}</div>')
    raise nodes.SkipNode


def setup(app):
    """Registers the rendering of equations. Sphinx calls this function."""
    app.add_html_math_renderer("mathml", (inline_equation, None), (displayed_equation, None))
