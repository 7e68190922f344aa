"""Collects the pages of docs/ and writes those that are generated from the tables of the program.

usage: generate.py PROGRAM FOLDER [RESULTS.h5]     FOLDER is then the source of sphinx-build
"""
import inspect
import json
import pathlib
import re
import shutil
import subprocess
import sys
import types

DOCS = pathlib.Path(__file__).resolve().parent
ROOT = DOCS.parent
sys.path.insert(0, str(ROOT))
from docs import results  # noqa: E402  pylint: disable=wrong-import-position
from reports.structure_drawing import describe, draw, scene  # noqa: E402  pylint: disable=wrong-import-position

# Files that pages include from other places in the repository.
INCLUDED = ("CHANGELOG.md", "cases/format/scenes.md", "harness/import_export/import.md",
            "harness/experiments/sweep.md", "harness/formulations/protocol.md",
            "harness/tools/cluster/README.md", "reference/ERRATA.md")
LINK = re.compile(r"\[([^\]]+)\]\((?!https?:)[^)]*\)")
VERB = re.compile(r"^  ([a-z-]+) {2,}\S", re.M)


class Site:
    """The program that is run, and the output folder."""

    def __init__(self, program, folder, stored):
        self.program, self.folder, self.results = program, folder, stored

    def ask(self, *words):
        """Returns the output of the program."""
        return subprocess.run([self.program, *words], check=True, text=True,
                              stdout=subprocess.PIPE).stdout

    def write(self, name, text):
        """Writes a page that is generated from the program and has no source to edit."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.rstrip() + "\n", encoding="utf-8")


def literal(text):
    """Returns text exactly as the program prints it."""
    return f"```text\n{text.strip(chr(10))}\n```"


def table(head, rows):
    """Returns rows of words as a Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(c).replace("|", r"\|") for c in line) + " |"
                     for line in lines)


def toctree(names):
    """Returns a MyST toctree directive that lists the pages `names`."""
    return "```{toctree}\n:maxdepth: 1\n\n" + "\n".join(names) + "\n```"


def write_commands(site):
    """Writes the reference of the command line: the help of every verb."""
    overview = site.ask("help")
    verbs = VERB.findall(overview.partition("\nlook")[2].partition("to begin with")[0])
    parts = [f"# Command line\n\n{literal(overview)}"]
    parts += [f"## {verb}\n\n{literal(site.ask('help', verb))}" for verb in verbs]
    site.write("reference/commands.md", "\n\n".join(parts))


def write_sections(site, name, title, text, heading):
    """Writes a page with text printed by the program, with a section for each line that matches `heading`."""
    starts = [m.start() for m in heading.finditer(text)]
    parts = [f"# {title}\n\n{literal(text[:starts[0]])}"]
    for start, end in zip(starts, starts[1:] + [len(text)]):
        parts.append(f"## {heading.match(text, start).group(1)}\n\n{literal(text[start:end])}")
    site.write(name, "\n\n".join(parts))


HEADERS = {"c_interface": ("C interface of the library", "harness/library/beamwork.h"),
           "element_interface": ("C interface of an element", "elements/element.h")}


def write_interfaces(site):
    """Writes the pages of the headers that users include and of the Python module."""
    for page, (title, header) in HEADERS.items():
        text = (ROOT / header).read_text("utf-8").strip()
        site.write(f"reference/{page}.md", f"# {title}\n\n`{header}`, whole:\n\n```c\n{text}\n```")
    sys.path.insert(0, str(ROOT / "harness" / "library" / "python"))
    import beamwork  # pylint: disable=import-outside-toplevel,import-error
    parts = [f"# Python module\n\n{literal(inspect.getdoc(beamwork))}"]
    for name in beamwork.__all__:
        value = getattr(beamwork, name)
        if not callable(value):
            continue
        members = [(f"{name}{arguments(value)}", value)] + [
            (f"{name}.{key}{arguments(member)}", member) for key, member in vars(value).items()
            if inspect.isclass(value) and not key.startswith("_") and
            isinstance(member, (types.FunctionType, classmethod, staticmethod, property))]
        parts.append(f"## {name}")
        parts += [f"`{head}`\n\n{literal(inspect.getdoc(member) or '')}" for head, member in members]
    site.write("reference/python_module.md", "\n\n".join(parts))


def arguments(value):
    """Returns the arguments of a callable as in a call, or '' for any other object."""
    member = value.__func__ if isinstance(value, (classmethod, staticmethod)) else value
    if not callable(member) or inspect.isclass(member) and issubclass(member, Exception):
        return ""
    kept = [p.replace(annotation=p.empty) for p in inspect.signature(member).parameters.values()
            if p.name not in ("self", "cls")]
    return str(inspect.Signature(kept))


def write_terms(site):
    """Writes the page of verdicts and terms, with the output of `explain` for each term."""
    groups = re.findall(r"^(\w[^\n]*)\n((?:  [^\n]*\n)+)", site.ask("explain").partition("\n")[2], re.M)
    parts = ["# Verdicts and terms\n\n`beamwork explain TERM` prints these texts."]
    for group, terms in groups:
        parts.append(f"## {group.capitalize()}")
        for term in " ".join(terms.split()).split("; "):
            told = site.ask("explain", term).partition("\n")[2]
            told = re.sub(r"\n  (?=(?:also called|see also):)", "\n\n  ", told.strip())
            parts.append(f"**{term}**\n: {told}")
    site.write("reference/terms.md", "\n\n".join(parts))


def write_formulations(site, formulations):
    """Writes a page for each formulation, with its declarations and its theory."""
    for one in formulations:
        name = one["formulation"]
        theory = "" if not (ROOT / "elements" / f"{name}.md").exists() else \
            f"```{{include}} /sources/elements/{name}.md\n:start-line: 1\n```\n"
        site.write(f"theory/formulations/{name}.md", f"# {name}\n\n{one['summary']}\n\n{theory}\n"
                   f"## Declarations\n\n{literal(site.ask('list', name))}")
    site.write("theory/formulations/index.md", "# Formulations\n\nJ and N are the [two papers](../../project/papers.md).\n\n" + table(
        ["name", "description", "source"], [[f"[{f['formulation']}]({f['formulation']}.md)", f["summary"], f["source"]] for f in formulations])
        + "\n\n" + toctree(f["formulation"] for f in formulations))


def numbers(value):
    """Returns a value as text for readers."""
    return value if isinstance(value, str) else f"{value:.10g}"


def problem(site, case):
    """Returns the description of the problem of a case, from the tables of the program."""
    told = json.loads(site.ask("list", case, "--format", "json"))
    structure = scene.read(site.ask("scene", case))
    results.save(draw.draw(structure), site.folder / "verification" / f"{case}_structure.svg")
    parts = [f"# {case}\n\n{told['summary']}\n\nSource: {told['source']}",
             f"```{{image}} {case}_structure.svg\n:alt: the structure, its supports and loads\n```",
             "## Structure\n\n" + "\n".join(f"* {heading}: {'; '.join(lines)}" for heading, lines in describe.describe(structure)),
             "## Parameters", table(
        ["name", "default", "unit", "meaning"],
        [[p["name"], numbers(p["default"]), p["unit"], p["summary"]] for p in told["parameters"]])]
    parts += ["## Quantities", table(
        ["name", "unit", "meaning"],
        [[q["name"], q["unit"], q["meaning"] + (", a curve" if q["is_curve"] else "")] for q in told["quantities"]])]
    return parts


def verdicts(site, case):
    """Returns the verdicts at the default parameters and a figure, if there are results."""
    point = results.read(site.results, case).points[0]
    rows = [[s.key, v.quantity, f"{v.limit:.9g}", results.percent(v), v.verdict]
            for s in point.series for v in s.verdicts if v.verdict not in ("skip", "no truth")]
    figure = results.draw(point, site.folder / "verification" / f"{case}.svg")
    drawn = [f"```{{image}} {case}.svg\n:alt: error against run time\n```"] if figure else []
    return ["## Results at the default parameters", *drawn, table(
        ["formulation", "quantity", "limit", "error of the limit", "verdict"], rows)] if rows else []


def write_verification(site, cases):
    """Writes the verification manual, with a page for each case."""
    tested = set()
    if site.results:
            tested = set(results.cases(site.results))
    for one in cases:
        case = one["case"]
        known = subprocess.run([site.program, "truth", case], text=True, check=False,
                               capture_output=True).stdout
        parts = problem(site, case) + ["## Reference values at the default parameters",
                                       literal(known) if known else "No reference value is stored."]
        if case in tested:
            parts += verdicts(site, case)
        else:
            parts.append(f"Verdicts: `beamwork verify --select ={case}`.")
        site.write(f"verification/{case}.md", "\n\n".join(parts))
    site.write("verification/cases.md", "# Cases\n\n" + table(
        ["case", "description"], [[f"[{c['case']}]({c['case']}.md)", c["summary"]] for c in cases])
        + "\n\n" + toctree(c["case"] for c in cases))


def collect(folder):
    """Copies the pages that are written by hand, and the files that these pages include."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(DOCS, folder, ignore=shutil.ignore_patterns("test", "static", "*.py", "__pycache__"))
    for name in (*INCLUDED, *(p.relative_to(ROOT) for p in (ROOT / "elements").glob("*.md"))):
        target = folder / "sources" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        # links in these files are relative to their location, so only the link texts are kept
        target.write_text(LINK.sub(r"\1", (ROOT / name).read_text("utf-8")), encoding="utf-8")


def main(program, folder, stored=None):
    """Writes the source files of the site."""
    site = Site(program, pathlib.Path(folder), stored)
    collect(site.folder)
    known = json.loads(site.ask("list", "--format", "json"))
    write_commands(site)
    write_sections(site, "reference/scene_keys.md", "Scene keys", site.ask("scene", "--keys"),
                   re.compile(r"^([a-z]\w*)(?= )[^\n]*", re.M))
    write_sections(site, "reference/result_schema.md", "Result schema", site.ask("schema"),
                   re.compile(r"^(/[\w/]+):[^\n]*", re.M))
    write_terms(site)
    write_interfaces(site)
    write_formulations(site, known["formulations"])
    write_verification(site, known["cases"])


if __name__ == "__main__":
    main(*sys.argv[1:])
