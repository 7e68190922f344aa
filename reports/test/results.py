"""Artificial results for tests of pages: cases with one mesh for each series."""
from reports import data


class Site:
    def __init__(self, results="", truths="", cases=()):
        self.results, self.truths, self.cases = results, truths, list(cases)
        self.kinds, self.pages = {}, {}

    def write(self, template, name, **context):
        self.pages[name] = context


def series(key, verdicts, values=None):
    clock = data.Clock(0, 1e-3, 1e-3, 1e-3, 1)
    mesh = data.Mesh(1, "ok", "", clock, 8, 4, "", {}, values=values or {})
    return data.Series(key, "", "", "", [mesh], verdicts)


def case(name, *found):
    return data.Case(name, "", "", [data.Point("default", "", list(found), {})])


def verdict(quantity, kind, **more):
    return data.Verdict(quantity, kind, **more)
