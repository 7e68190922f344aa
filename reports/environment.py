"""What the results were made with, how times were taken, and whether planted work was found."""
import functools
import json
import pathlib

NAVIGATION = [("environment.html", "environment")]


def planted(site):
    """Rows of make bench-check beside the results, or []."""
    path = pathlib.Path(site.results).parent / "bench_check.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else []


def noise(site):
    """{case: (cells timed, median and greatest spread between rounds)}."""
    out = {}
    for case in site.cases:
        spread = sorted(m.clock.most / m.clock.least - 1 for p in case.points for s in p.series
                        for m in s.meshes if m.clock.repeats > 1)
        if spread:
            out[case.name] = (len(spread), spread[len(spread) // 2], spread[-1])
    return out


def write(site):
    names = [n for n in site.about if n in (site.bench or site.about)]
    site.write("environment.html",
               "environment.html",
               names=names,
               about=site.about,
               bench=site.bench,
               noise=noise(site),
               planted=planted(site))


def tasks(site):
    return [functools.partial(write, site)]
