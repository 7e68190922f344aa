"""python -m reports.publish REPORT DOCS RESULTS.h5 -o FOLDER joins the report, the documentation and a gallery to one static
folder that any web server publishes. Addresses that do not change: case/NAME/ and formulation/NAME/. The folder is replaced
as a whole, or not at all after an error."""
import argparse
import json
import os
import pathlib
import shutil
import sys
import tempfile

import h5py
import jinja2

from reports import data
from reports.site import file_of

TEMPLATES = pathlib.Path(__file__).parent / "templates"


def contents_of(results, report):
    """Returns the version, commit and date of the results, and the cases and formulations that have a page: {case: summary}
    and {formulation: name in its address}."""
    about = data.read_about(results)
    with h5py.File(results) as file:
        cases = {name: data.text(group.attrs["summary"]) for name, group in file["cases"].items()}
    pages = {path.name for path in pathlib.Path(report).glob("*.html")}
    keys = data.read_declarations(results)
    return {
        "version": about["program_version"], "commit": about["commit"], "date": about["clock"],
        "cases": {name: words for name, words in sorted(cases.items()) if f"{name}.html" in pages},
        "formulations": {key: file_of(key).removeprefix("formulation_") for key in sorted(keys)
                         if f"{file_of(key)}.html" in pages},
    }


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def build(report, docs, results, into):
    """Writes the site into an empty folder. Returns its contents."""
    found = contents_of(results, report)
    templates = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True,
                                   lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    shutil.copytree(report, into / "report")
    shutil.copytree(docs, into / "docs", ignore=shutil.ignore_patterns(".buildinfo", ".doctrees"))
    pictures = {name: (into / "report" / f"picture_{name}.svg").is_file() for name in found["cases"]}
    for name, file in (("published.html", "index.html"), ("gallery.html", "gallery/index.html")):
        write(into / file, templates.get_template(name).render(**found, pictures=pictures))
    address = templates.get_template("address.html")
    for name in found["cases"]:
        write(into / "case" / name / "index.html", address.render(name=name, target=f"../../report/{name}.html"))
    for key, name in found["formulations"].items():
        write(into / "formulation" / name / "index.html", address.render(name=key, target=f"../../report/{file_of(key)}.html"))
    write(into / "site.json", json.dumps(found, indent=1) + "\n")
    write(into / ".nojekyll", "")  # hosts that run Jekyll omit folders whose names begin with an underscore
    return found


def replace(folder, new):
    """Replaces a folder by a new one in the same parent folder."""
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix=f".{folder.name}-old-") as old:
        if folder.exists():
            os.rename(folder, pathlib.Path(old) / folder.name)
        os.rename(new, folder)


def main():
    parser = argparse.ArgumentParser(prog="reports.publish", description=__doc__)
    parser.add_argument("report")
    parser.add_argument("docs")
    parser.add_argument("results")
    parser.add_argument("-o", dest="folder", required=True)
    given = parser.parse_args()
    folder = pathlib.Path(given.folder).absolute()
    folder.parent.mkdir(parents=True, exist_ok=True)
    for part in (given.report, given.docs):
        if not (pathlib.Path(part) / "index.html").is_file():
            print(f"site: {part} has no index.html; 'make site' writes it", file=sys.stderr)
            return 4
    try:
        with tempfile.TemporaryDirectory(dir=folder.parent, prefix=f".{folder.name}-") as part:
            new = pathlib.Path(part) / "site"
            new.mkdir()
            found = build(given.report, given.docs, given.results, new)
            replace(folder, new)
    except (data.Unreadable, OSError) as why:
        print(f"site: {why}", file=sys.stderr)
        return 4
    print(f"beamwork {found['version']}, commit {found['commit']}, {found['date']}: {folder}/index.html")
    return 0


if __name__ == "__main__":
    sys.exit(main())
