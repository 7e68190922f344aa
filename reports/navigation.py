"""The bar on top of every page: groups of pages, and the pages of the group that is open."""
from dataclasses import dataclass

# Title, and its pages in order; a group without pages is not shown. Pages that stand in no group
# come with those of the last one.
GROUPS = (
    ("beamwork", ("index.html",)),
    ("Answers", ("answers.html", "explorer.html")),
    ("Sweeps", ()),
    ("Cases", ("cases.html", "pictures.html", "paths.html", "rotation.html", "mechanisms.html")),
    ("Formulations", ("formulations.html", "certificates.html", "newton.html")),
    ("Profiles", ("profiles.html",)),
    ("Stability", ("stability.html",)),
    ("Motion", ("motions.html", "integrators.html")),
    ("Papers & errata", ("claims.html", "papers.html", "errata.html")),
    ("Deviations", ("deviations.html", "causes.html")),
    ("Glossary", ("glossary.html",)),
    ("About", ("environment.html", "checks.html", "convergence.html")),
)
SWEEP = "sweep_"  # how the files of sweeps begin


@dataclass(frozen=True)
class Group:
    """file: of its first page; pages: [(file, title)]."""

    title: str
    file: str
    pages: tuple

    def holds(self, name):
        return any(name == file for file, _ in self.pages)


def groups(pages):
    """[Group] of the pages that there are, [(file, title)]."""
    titles, placed = dict(pages), {file for _, files in GROUPS for file in files}
    found = []
    for title, files in GROUPS:
        own = [(file, titles[file]) for file in files if file in titles]
        if title == "Sweeps":
            own += [(file, name) for file, name in pages if file.startswith(SWEEP)]
            placed |= {file for file, _ in own}
        if title == GROUPS[-1][0]:
            own += [(file, name) for file, name in pages if file not in placed]
        if own:
            found.append(Group(title, own[0][0], tuple(own)))
    return found


def group_of(name, found, cases):
    """The group that a page belongs to, or None: pages of cases and formulations are in theirs."""
    if name.startswith("formulation_"):
        name = "formulations.html"
    elif name.startswith("motion_"):
        name = "motions.html"
    elif name.removesuffix(".html") in cases:
        name = "cases.html"
    return next((g for g in found if g.holds(name)), None)
