"""The page of profiles, winners and trust."""
import functools

from reports import heat, profile_figures, profiles, trust
from reports.problems import (Question, any_defect, defect, no_defect, to_the_best,
                              to_the_smallest)
from reports.site import LEVELS

NAVIGATION = [("profiles.html", "profiles")]
NEAR = {to_the_best: 2, to_the_smallest: 10}  # factor of the reading example
READINGS = (defect, no_defect, any_defect)


def panel(site, compared, picture, level, name=None, size=(250, 175)):
    """A figure with what is read from it as an example: the curve that is ahead at NEAR."""
    curves = compared.profile(picture.question(level), picture.offered)
    at = profiles.places(profiles.FARTHEST[picture.unit])
    factor = NEAR[picture.unit]
    drawn = {key: curves[key] for key in compared.curves}
    share, ahead = profiles.read_at(drawn, at, factor)[0]
    name = name or f"{picture.file}_{100 * level:g}"
    return {
        "level": level,
        "image": profile_figures.figure_of(site, picture, curves, compared.curves, name, size),
        "ahead": ahead,
        "factor": factor,
        "share": share,
        "any": curves[ahead][-1],
    }


def readings(compared):
    """[(formulation, [(level, shares solved by each of READINGS)])]"""
    shares = {
        (level, forbids): compared.profile(Question(level, forbids=forbids))
        for level in LEVELS
        for forbids in READINGS
    }
    return [(key, [(level, [shares[level, forbids][key][-1] for forbids in READINGS])
                   for level in LEVELS]) for key in compared.keys]


def write(site):
    compared = profiles.Compared(site.cases)
    figures, table, legend = {}, None, None
    if compared.any:
        figures = {
            picture.name: [panel(site, compared, picture, level) for level in LEVELS]
            for picture in profiles.PICTURES
        }
        legend = profile_figures.legend_of(site, compared.curves)
        table = profile_figures.write_table(site, compared)
    site.write("profiles.html", "profiles.html", compared=compared, figures=figures, table=table,
               legend=legend, noise=site.cases[0].points[0].noise if site.cases else 1,
               readings=readings(compared) if compared.any else [],
               lines=heat.lines(site.cases),
               rows=trust.table(site.cases, compared.problems, trust.judged(site.cases)))


def tasks(site):
    return [functools.partial(write, site)]
