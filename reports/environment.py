"""What the results were made with, how times were taken, and whether planted work was found."""
import functools
import json
import pathlib

from reports import experiments

NAVIGATION = [("environment.html", "environment")]
OUTCOME = ("outcome", "sentence")  # of the run, which the first page says
# (command of make, files that it leaves beside the results, what they add)
ADDS = (
    ("lab L=bench-check", ("bench_check.json", ), "injected work that the times must show"),
    ("lab L=bench-mechanisms", ("mechanisms_joint.h5", "mechanisms_hexapod.h5"),
     "times of the joint and the hexapod beside the published ones"),
    ("lab L=causes", ("causes.json", ), "experiments on the causes of known deviations"),
    ("lab L=newton", ("newton.json", ), "Newton with stresses as unknowns beside displacements only"),
    ("lab L=paces", ("paces.json", ), "integrators on all cases of motion: profiles, error against cost"),
    ("lab L=faults", ("faults.json", ), "injected faults"),
    ("lab L=fuzz", ("fuzz.json", ), "any bytes as input"),
)
# (command of make, experiment whose group it leaves in the results, what it adds)
GROUPS = (
    ("bench", "bench", "times with their noise"),
    ("lab L=certificates", "element-test", "what each formulation keeps of its interface, and can do"),
    ("stress", "stress", "every formulation at its extremes"),
    ("motion", "motion", "integrators of motions: orders, what they conserve, large steps"),
)


def planted(site):
    """Rows of make lab L=bench-check beside the results, or []."""
    path = pathlib.Path(site.results).parent / "bench_check.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else []


def more(site):
    """[(command, what it adds)] of commands that have left nothing in the results or beside them."""
    here = pathlib.Path(site.results).parent
    groups = [(command, what) for command, name, what in GROUPS
              if not experiments.holds(site.results, name)]
    return groups + [(command, what) for command, files, what in ADDS
                     if not any((here / name).is_file() for name in files)]


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
    names = [n for n in site.about if n in (site.bench or site.about) and n not in OUTCOME]
    site.write("environment.html",
               "environment.html",
               names=names,
               about=site.about,
               bench=site.bench,
               noise=noise(site),
               planted=planted(site),
               made=experiments.made(site.results),
               more=more(site))


def tasks(site):
    return [functools.partial(write, site)]
