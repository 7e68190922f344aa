"""The bar at the top of every page: groups of pages, and the pages of the open group."""
from dataclasses import dataclass

# Titles of the groups, each with its pages in order. A group without pages is not shown. Pages in no group are listed
# in the last group.
GROUPS = (
    ("beamwork", ("index.html",)),
    ("Answers", ("answers.html", "explorer.html")),
    ("Sweeps", ()),
    ("Cases", ("cases.html", "pictures.html", "paths.html", "rotation.html", "mechanisms.html")),
    ("Formulations", ("formulations.html", "certificates.html", "newton.html")),
    ("Profiles", ("profiles.html", "peers.html")),
    ("Stability", ("stability.html",)),
    ("Motion", ("motions.html", "integrators.html")),
    ("Papers & errata", ("claims.html", "papers.html", "errata.html")),
    ("Deviations", ("deviations.html", "causes.html")),
    ("Glossary", ("glossary.html",)),
    ("About", ("environment.html", "checks.html", "convergence.html")),
)
SWEEP = "sweep_"  # prefix of the files of sweep pages


@dataclass(frozen=True)
class Group:
    """A group of pages. `file` is that of its first page, and `pages` is [(file, title)]."""

    title: str
    file: str
    pages: tuple

    def holds(self, name):
        return any(name == file for file, _ in self.pages)


def groups(pages):
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
    """The page of one case, formulation or motion belongs to the group that contains the page of all of them."""
    if name.startswith("formulation_"):
        name = "formulations.html"
    elif name.startswith("motion_"):
        name = "motions.html"
    elif name.removesuffix(".html") in cases:
        name = "cases.html"
    return next((g for g in found if g.holds(name)), None)
