"""Prints reference values of scenes in cases/examples that a program in this folder derives, in the syntax of scene
files."""
import pathlib
import re

FOLDER = "examples"
PATH = pathlib.Path(__file__).resolve().parents[2] / "cases" / FOLDER
FIELDS = ("quantity", "value", "uncertainty", "kind", "formulation", "source", "parameters")
ROW = re.compile(
    r'^ *- \{quantity: (\w+), value: (\S+), uncertainty: (\S+), kind: (\w+)(?:, formulation: ([\w*]+))?, source: "([^"]*)"(?:, parameters: \{(.*)\})?\}$'
)


def names():
    return [path.stem for path in PATH.glob("*.yaml")]


def line_of(row):
    given = row["parameters"].replace("=", ": ").replace(";", ", ")
    text = ", ".join(f"{name}: {row[name]}" for name in FIELDS[:4])
    of = f', formulation: {row["formulation"]}' if row["formulation"] else ""
    return "  - {" + text + of + f', source: "{row["source"]}"' + (f", parameters: {{{given}}}"
                                                                   if given else "") + "}"


def stored():
    for path in sorted(PATH.glob("*.yaml")):
        for line in path.read_text(encoding="utf-8").splitlines():
            found = ROW.match(line)
            if found and found[6].startswith("reference/derive/"):
                row = dict(zip(FIELDS, found.groups("")))
                yield {
                    **row, "case": path.stem,
                    "parameters": row["parameters"].replace(": ", "=").replace(", ", ";"),
                    **dict.fromkeys(("at", "theory", "convention"), "")
                }
