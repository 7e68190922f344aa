"""What a case is about, by the analyses of its scene: a word to find it under."""
import re

import h5py

from reports.data import text

# A case is of the first kind one of whose analyses it has.
KINDS = (
    ("stiffness and compliance", ("compliance",)),
    ("past a limit point", ("continuation",)),
    ("turning steadily", ("rotation",)),
    ("buckling", ("buckling",)),
    ("vibration", ("modal",)),
    ("large displacements", ("static",)),
    ("linear statics", ("linear",)),
)
OTHER = "others"
ENTRY = re.compile(r"^  [^\s:]+: \{(\w+)[:}]", re.M)


def analyses_in(scene):
    """Names of the kinds of analysis in a scene file as the program writes it."""
    block = re.search(r"^analyses:\n((?:  .*\n)*)", scene, re.M)
    return ENTRY.findall(block.group(1)) if block else []


def kind_of(analyses):
    return next((kind for kind, names in KINDS if set(names) & set(analyses)), OTHER)


def scenes(path):
    """{case: scene file of its defaults, or of its first point; "" where the results have none}"""
    found = {}
    with h5py.File(path) as file:
        for name, group in file["cases"].items():
            rows = group["scenes"][()] if "scenes" in group else ()
            written = {text(row["point"]): text(row["scene"]) for row in rows}
            found[name] = written.get("default", next(iter(written.values()), ""))
    return found


def grouped(cases, path):
    """[(kind, [data.Case])] of a file of results, in the order of KINDS."""
    written, groups = scenes(path), {}
    for case in cases:
        found = kind_of(analyses_in(written.get(case.name, "")))
        groups.setdefault(found, []).append(case)
    order = [kind for kind, _ in KINDS] + [OTHER]
    return sorted(groups.items(), key=lambda item: order.index(item[0]))
