"""First page: on one screen what was found, whom to believe, and the answer for every case."""
import functools

from reports import agreed, answers, heat, kinds, profiles, sentences, tally, trust
from reports.profile_page import panel

NAVIGATION = [("index.html", "beamwork")]
LEVEL = 0.01  # of the answers
MOST_ROWS = 10  # of the table of trust on the first screen
PLACES = (  # where to go next, as far as this site has it
    ("answers.html", "your tolerance"),
    ("profiles.html", "profiles"),
    ("profiles.html#winners", "winners at each tolerance"),
    ("profiles.html#trust", "trust in full"),
    ("formulations.html", "formulations"),
    ("stability.html", "stability"),
    ("motions.html", "motions in time"),
    ("integrators.html", "integrators"),
    ("errata.html", "errata"),
    ("ledger.html", "causes"),
    ("glossary.html", "glossary"),
)
FIGURE = (300, 165)  # axes, pixels


def formulation_rows(cases):
    """{key: {case: {verdict: count}}} over all points, without second names."""
    rows = {}
    for row in tally.rows(cases):
        cell = rows.setdefault(row.formulation, {}).setdefault(row.case, {})
        if row.standing != tally.ALIAS:
            cell[row.verdict.verdict] = cell.get(row.verdict.verdict, 0) + 1
    return rows


def table_of(case):
    """[(what is asked, answers.Answer)] at the defaults: the first judged quantity, all together."""
    point = case.points[0]
    names = answers.judged(point)
    asked = [(names[0], names[0])] if names else []
    asked += [(f"all {len(names)} quantities", answers.ALL)] if len(names) > 1 else []
    return [(words, answers.answer(point, quantity, LEVEL)) for words, quantity in asked]


def write(site):
    compared = profiles.Compared(site.cases)
    rows = trust.table(site.cases, compared.problems, compared.keys)
    lines = {found.case.name: found for found in heat.lines(site.cases)}
    written = {file for file, _ in site.navigation}
    site.write("index.html", "index.html", about=site.about, cases=site.cases, lines=lines, level=LEVEL,
               agreed=agreed.rows([c for c in site.cases if c.name not in lines], LEVEL),
               places=[place for place in PLACES if place[0].partition("#")[0] in written],
               groups=kinds.grouped(site.cases, site.results),
               speed=sentences.of_speed(compared, rows),
               trust=sentences.of_trust(site.cases, rows), truths=sentences.of_truths(site.cases),
               profile=panel(site, compared, profiles.PICTURES[0], LEVEL, "profile", FIGURE)
               if compared.any else None, rows=rows[:MOST_ROWS], compared=compared,
               counts=tally.count_verdicts(site.cases),
               glances=site.glances, tables={c.name: table_of(c) for c in site.cases},
               verdicts=formulation_rows(site.cases))


def tasks(site):
    return [functools.partial(write, site)]
