"""The pages of the report. A page is a module of this package with

    NAVIGATION = [("newton.html", "iterations")]    # files and titles for the bar at the top of every page
    def tasks(site): return [functools.partial(write, site)]    # functions that write its files in parallel

A page that adds a section to the pages of cases has def section(site, case), which returns [(heading, markup)].

A page whose files depend on the results has def navigation(site), which returns the additional files.

A page whose data may be missing from the results has def present(site). If the data are missing, the page is omitted
from the site, from the bar (navigation.py) and from links (has_page in templates).
"""
import importlib
import multiprocessing
import os
import pathlib
import tempfile

from reports.site import Site

PAGES = (
    "index",
    "sweep_page",
    "answers_table",
    "profiles",
    "claims",
    "papers",
    "peers",
    "deviations",
    "case",
    "explorer",
    "formulation",
    "pictures",
    "mechanisms",
    "paths",
    "campbell",
    "certificates",
    "newton",
    "predictions",
    "stability",
    "integrators_page",
    "motion_page",
    "checks",
    "glossary",
)

ALONE = ("sweep_page", "glossary")  # pages that can be written for a sweep without other results
_tasks = [
]  # tasks of the current run; processes of the pool inherit them, so that records are not copied


def _run(index):
    _tasks[index]()


def present(site):
    names = ALONE if site.alone else PAGES
    modules = [importlib.import_module(f"reports.{name}") for name in names]
    return [m for m in modules if not hasattr(m, "present") or m.present(site)]


def build(results, truths, folder, bench=None, others=(), sweeps=(), figures=None, peers=()):
    """Writes the whole site, or nothing after an error. `figures` contains keyword arguments of
    paper.Paper, which writes figures for papers (None: no figures). Returns the number of tasks."""
    folder = pathlib.Path(folder).absolute()
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix=f".{folder.name}-") as part:
        count = _write(Site(results, truths, part, bench, others, sweeps, figures, peers))
        for file in (f for f in pathlib.Path(part).rglob("*") if f.is_file()):
            to = folder / file.relative_to(part)
            to.parent.mkdir(exist_ok=True)
            os.replace(file, to)
    return count


def _write(site):
    modules = present(site)
    for module in modules:
        site.navigation += module.NAVIGATION
        site.navigation += module.navigation(site) if hasattr(module, "navigation") else []
        site.sections += [module.section] if hasattr(module, "section") else []
    _tasks[:] = [task for module in modules for task in module.tasks(site)]
    with multiprocessing.get_context("fork").Pool() as pool:
        for _ in pool.imap_unordered(_run, range(len(_tasks))):
            pass
    return len(_tasks)
