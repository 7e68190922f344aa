"""A page for each formulation: all its verdicts, and the cases it is not on."""
import functools

from reports.site import file_of

NAVIGATION = []


def write(site, key):
    found = [(c, p, s) for c in site.cases for p in c.points for s in p.series if s.key == key]
    site.write("formulation.html",
               f"{file_of(key)}.html",
               key=key,
               series=[row for row in found if not row[2].missing],
               skipped=sorted({(c.name, s.missing)
                               for c, _, s in found if s.missing}))


def tasks(site):
    return [functools.partial(write, site, key) for key in site.styles.order]
