"""Claims of the papers compared with computed values and measured times."""
import functools
import math
import pathlib

from reports import answers, data
from reports.figures import plots
from reports.answers import LEVELS
from reports.figures.style import plt
from reports.verdicts import OWN_LIMITS


# Figure on the page of the column. The error of the printed form (beamw) levels off at that of its predicted limit.

COLUMN_CASE, COLUMN_POINT, COLUMN_QUANTITY = "c_column", "section_data=printed", "buckling_load"
COLUMN_ALT = ("Error of the buckling load against elements: beamw levels off, "
              "beamw_consistent goes down")
COLUMN_PAIR = ("beamw", "beamw_consistent")


def column_words(verdict):
    own = verdict.verdict in OWN_LIMITS
    return f"{verdict.verdict} ({100 * verdict.error:+.3g} %)" if own else verdict.verdict


def draw_column(axes, series, style):
    """Draws the errors of one formulation with its verdict next to the last mesh. The error of its predicted limit, if
    known, is a dashed line."""
    pairs = plots.finite(series, COLUMN_QUANTITY)
    verdict = answers.verdict_of(series, COLUMN_QUANTITY)
    axes.plot([m.n for m, _ in pairs], [e for _, e in pairs], label=series.key, **style)
    own, colour = verdict.verdict in OWN_LIMITS, style["color"]
    axes.annotate(column_words(verdict), (pairs[-1][0].n, pairs[-1][1]), textcoords="offset points",
                  xytext=(-4, 6) if own else (-10, -6), ha="right", fontsize=8.5, color=colour)
    if math.isfinite(verdict.predicted):
        axes.axhline(abs(verdict.predicted / verdict.truth - 1), color=colour, linewidth=0.9,
                     linestyle=(0, (4, 3)), zorder=0)


def column_figure(site, point):
    found = {s.key: s for s in point.series}
    if not all(key in found and plots.finite(found[key], COLUMN_QUANTITY) for key in COLUMN_PAIR):
        return None
    figure, axes = plt.subplots(figsize=(6.4, 3.8))
    for key in COLUMN_PAIR:
        draw_column(axes, found[key], site.styles.of(key))
    axes.set_xlim(1.8, 260)
    plots.log_axes(axes, "elements over the column", "relative error of the buckling load", True)
    axes.legend(loc="lower left")
    return site.image(figure, "column")


def column_section(site, case):
    point = next((p for p in case.points if p.parameters == COLUMN_POINT), None)
    image = column_figure(site, point) if case.name == COLUMN_CASE and point else None
    if not image:
        return []
    return [("Convergence to a wrong limit, as predicted",
             f'<figure><div class="figure" tabindex="0">{image.inline(COLUMN_ALT)}</div>'
             '<figcaption>J Table 2, printed constants: '
             'the printed second-order modes exclude shear deformation. The limit that follows from the '
             'printed formulas was derived independently (dashed). The program converges to it, not to '
             'the exact load, to which the consistent modes converge.</figcaption></figure>')]


NAVIGATION = [("claims.html", "claims")]
SECTIONS = ("printed constants", "section_data=printed"), (
    "shear flow", "")  # neither set of section constants reproduces all four entries of J Table 2


class Lookup:
    """Finds meshes, errors and values of runs by the names of case, parameters, formulation and quantity."""

    def __init__(self, cases):
        self.points = {(c.name, canonical(p.parameters)): p for c in cases for p in c.points}

    def mesh(self, case, parameters, key, n):
        point = self.points.get((case, canonical(parameters)))
        series = next((s for s in point.series if s.key == key), None) if point else None
        return next((m for m in series.meshes if m.n == n), None) if series else None

    def error(self, case, parameters, key, n, quantity):
        mesh = self.mesh(case, parameters, key, n)
        return mesh.errors.get(quantity, math.nan) if mesh else math.nan

    def value(self, case, parameters, key, n, quantity):
        mesh = self.mesh(case, parameters, key, n)
        return mesh.values.get(quantity, math.nan) if mesh else math.nan


def canonical(parameters):
    return ";".join(sorted(p for p in parameters.split(";") if p))


def percent_of(value):
    return "–" if not math.isfinite(value) else f"{100 * value:+.2f} %"


def sheets(look, truths):
    free, far = "tip_warping=1", "tip_deflection=0.05;tip_warping=1"
    yield ("N 4.1: one third-order element within 0.8 % at 0.15 L (tip free to warp)", "0.8 %",
           ", ".join(f"{q} {percent_of(look.error('sheet_cantilever', free, 'sheet_third', 1, q))}"
                     for q in ("C_xx", "C_zz")))
    yield ("N 4.1: within 2.4 % of du_z/dF_z at 0.5 L (tip free to warp)", "2.4 %",
           f"C_zz {percent_of(look.error('sheet_cantilever', far, 'sheet_third', 1, 'C_zz'))}")
    yield ("N 4.1: the second-order element requires more than three elements", "> 3", ", ".join(
        f"n = {n}: {percent_of(look.error('sheet_cantilever', free, 'sheet_second', n, 'C_zz'))}"
        for n in (1, 2, 3, 4)))
    for wagner, quantity, claim in (("", "C_ux_My", "2.4 %"), (";wagner=0", "C_ux_My", "38 %"),
                                    ("", "C_uz_Fz", "all components: 6.4 %")):
        value, plate = look.value("sheet_wagner", free + wagner,
                                  "sheet_third", 3, quantity), data.read_other_model(
                                      truths, "sheet_wagner", free + wagner, quantity)
        yield (
            f"N 4.1: three elements {'without' if wagner else 'with'} the Wagner torque, {quantity} against a plate (tip free to warp)",
            claim, percent_of(value / plate - 1))


def joint(look, truths):
    published = (("sheet_third", "", 1, 9.77, 1.0), ("sheet_third", "", 2, 9.61, 3.3),
                 ("sheet_second", "wagner=0", 1, 10.95, 0.9), ("sheet_second", "wagner=0", 2, 9.68,
                                                               3.1), ("sheet_second", "wagner=0", 4,
                                                                      9.63, 9.6))
    first = look.mesh("spherical_joint", "", "sheet_third", 1)
    for key, parameters, n, maximum, time in published:
        mesh = look.mesh("spherical_joint", parameters, key, n)
        value = look.value("spherical_joint", parameters, key, n, "support_stiffness_max")
        ratio = mesh.seconds / first.seconds if mesh and first else math.nan
        yield (f"N 4.2: joint, {key}, {n} per sheet: maximum, relative time",
               f"{maximum} x 1e5 N/m, {time}", f"{value / 1e5:.3f} x 1e5 N/m, {ratio:.2f}")
    one, four = (look.value("spherical_joint", parameters, key, n, "support_stiffness_max")
                 for key, parameters, n, *_ in (published[0], published[4]))
    yield ("N 4.2: one third-order element compared with four second-order elements", "1.5 %",
           percent_of(one / four - 1))


def column(look, truths):
    for key, shear, loads in (("beamw", "", (12.86, 11.90)), ("beamw_vlasov", "shear=0", (18.34,
                                                                                          16.67))):
        for n, load in zip((2, 4), loads):
            sets = ((name, look.value("c_column", f"{parameters};{shear}", key, n, "buckling_load"))
                    for name, parameters in SECTIONS)
            yield f"J Table 2: {key}, {n} elements", f"{load:.2f} MN", ", ".join(
                f"{value / 1e6:.3f} MN ({name})" for name, value in sets)
    for i, (ours, published) in enumerate(
        ((1, 33.23), (2, 67.17), (3, 99.03), (4, 102.79), (5, 169.05), (6, 178.01))):
        value, error = (f("c_column", "", "beamw_consistent", 64, f"frequency_{ours}")
                        for f in (look.value, look.error))
        yield f"J Table 3 (a): frequency {i + 1}", f"{published} Hz", f"{value / (1 + error):.3f} Hz exact, {value:.2f} Hz with 64 elements (beamw_consistent)"


def claims(cases, truths):
    """Returns [(claim, published, measured)] for the claims that the results contain."""
    look = Lookup(cases)
    rows = [row for family in (sheets, joint, column) for row in family(look, truths)]
    return [row for row in rows if "nan" not in row[2] and not row[2].endswith("–")]


def interval(slow, fast):
    """Returns the ratio of two data.Clock times, slow / fast, as text. For several rounds, the text includes the smallest
    and the largest ratio of rounds."""
    middle = slow.least / fast.least
    return f"{middle:.2f}" if slow.repeats == 1 else f"{middle:.2f} ({slow.least / fast.most:.2f} to {slow.most / fast.least:.2f})"


def baseline(site):
    """Returns [data.Case] of the joint and the hexapod with times of the dense algorithm, if 'make lab
    L=bench-mechanisms' wrote them next to the results."""
    files = {"spherical_joint": "mechanisms_joint.h5", "hexapod": "mechanisms_hexapod.h5"}
    here = pathlib.Path(site.results).parent
    return [
        data.read_case(here / name, case, root=data.root_of_bench) for case, name in files.items()
        if (here / name).is_file()
    ]


def row_of(look, claim, fast, slow):
    """Returns {column: value} of the comparison of two formulations, or None if a mesh or a time is missing. `fast` and
    `slow` are (formulation, elements per sheet)."""
    name, quantity, paper, published = claim
    third, second = look.mesh(name, "", *fast), look.mesh(name, "", *slow)
    if third is None or second is None or not math.isfinite(second.seconds):
        return None
    return {
        "case": name, "paper": paper, "published": published,
        "fast": fast[0], "slow": slow[0], "how": "condensed, sparse", "factor": interval(
            second.clock, third.clock), "decided": answers.differ(
                second.clock, third.clock), "less": 1 - third.seconds / second.seconds,
        "errors": [m.errors.get(quantity, math.nan) for m in (third, second)]
    }


def row_dense(look, claim, fast, slow):
    """Returns the row of row_of() for the published algorithm, which is dense and without condensation, or None."""
    row = row_of(look, claim, fast, slow)
    times = [look.mesh(claim[0], "", *cell).dense for cell in (slow, fast)] if row else [None]
    if None in times:
        return None
    factor = times[0].seconds / times[1].seconds
    return {
        **row, "how": "uncondensed, dense", "factor": f"{factor:.2f}", "decided": True,
        "less": 1 - 1 / factor
    }


CLAIMS = (("spherical_joint", "support_stiffness_max", "N 4.2: 68 % less time", 1 / (1 - 0.68)),
          ("hexapod", "support_stiffness_1", "N 4.3: a factor of 6.32", 6.32))


def headlines(site):
    look, dense = Lookup(site.cases), Lookup(baseline(site))
    rows, soonest = [], []
    for claim in CLAIMS:
        rows += [
            row_of(look, claim, ("sheet_third", 1), (key, 2))
            for key in ("sheet_second", "sheet_second_consistent")
        ]
        rows.append(row_dense(dense, claim, ("sheet_third", 1), ("sheet_second", 2)))
        point = look.points.get((claim[0], ""))
        for level in LEVELS if point else ():
            found = answers.answer(point, answers.ALL, level)
            soonest += [(claim[0], level, found)] if found.ways else []
    return [r for r in rows if r], soonest


def write(site):
    compared, soonest = headlines(site)
    site.write("claims.html",
               "claims.html",
               claims=claims(site.cases, site.truths),
               headlines=compared,
               soonest=soonest,
               timed=site.bench is not None)


def section(site, case):
    return column_section(site, case)


def tasks(site):
    return [functools.partial(write, site)]
