"""python -m reports.film RESULTS.h5 [-k CASE] -o FILM.html writes a motion as a single file that any browser plays
from disk: the 3-D viewer (assets/viewer.js, assets/player.js) with the frames in it. The film plays repeatedly; it
can be paused (Space), rotated and viewed frame by frame. If the browser requests reduced motion, it starts paused."""
import argparse
import os
import sys

import h5py
from markupsafe import Markup, escape

from reports import data, pictures, shapes
from reports.site import ASSETS

MOST = 40_000  # largest number of points of all frames together, about 0.9 MB
SCRIPTS = ("player.js", "viewer.js")
LOOK = """body { max-width: 76rem; } h1 { margin: 0; } div.viewer { max-width: none; }
canvas.space { height: max(16rem, calc(100vh - 14rem)); }
@media (max-width: 40rem) { canvas.space { height: 58vh; } }
p { margin: .2rem 0 .5rem; }"""
PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<link rel="icon" href="data:,">
<style>
{style}
{look}
</style>
</head>
<body>
<main>
<h1>{title}</h1>
<p>{words}</p>
<div class="viewer" data-play data-shape="{name}" data-alt="{title} in space">{still}</div>
<p class="small">{caption}</p>
</main>
<script type="application/json" id="shape_{name}">{shape}</script>
{scripts}
</body>
</html>
"""


class NoFilm(Exception):
    """Raised if there is no film, with the reason."""


def films(path):
    """Returns {case: (summary, point)} of the cases with several frames. The point is the first one that has them; the
    default parameters come first."""
    out = {}
    with h5py.File(path) as file:
        for name, group in file["cases"].items():
            for point in sorted(group.get("shapes", {}), key=lambda name: name != "default"):
                if shapes.frames_in(group["shapes"][point]) > 1:
                    out.setdefault(name, (data.text(group.attrs["summary"]), point))
    return out


def chosen(path, wanted):
    """Returns (case, summary, point) of the requested case, or of the only case with frames. Raises NoFilm if there is no
    such case or if a choice is needed."""
    found = films(path)
    name = next(iter(found)) if wanted is None and len(found) == 1 else wanted
    if name in found:
        return name, *found[name]
    if not found:
        raise NoFilm(f"{path}: contains no frames of a motion; 'beamwork solve CASE --shapes -o FILE' "
                     "writes them")
    asked = f"no frames of '{wanted}'" if wanted else "several motions"
    raise NoFilm(f"{path}: {asked}; choose one with -k: {', '.join(sorted(found))}")


def words_of(summary, s):
    times = s.value[shapes.frames_of(s)]
    what = f"{summary[:1].upper()}{summary[1:]}. " if summary else ""
    return (f"{what}{times[0]:.4g} to {times[-1]:.4g} s, computed with {s.formulation}, n = {s.n}, "
            "at true scale.")


def page(path, wanted=None):
    name, summary, point = chosen(path, wanted)
    s = shapes.read_file(path, name, point)
    first = shapes.frames_of(s)[0]
    view = pictures.best_view(s, shapes.frames_of(s))
    shape = shapes.shape(s, pictures.title_of, pictures.supports(s), pictures.hinges(s), first,
                         view.angles, MOST)
    scripts = "\n".join(f"<script>\n{(ASSETS / n).read_text(encoding='utf-8')}</script>"
                        for n in SCRIPTS)
    held = ("Drag it, or use the arrow keys, to rotate the view; + and - zoom; Space plays and "
            "pauses; comma and full stop show the previous and the next frame; &lt; and &gt; change "
            "the speed. Pale: undeformed.")
    return PAGE.format(title=escape(name), name=escape(name), words=escape(words_of(summary, s)),
                       style=(ASSETS / "style.css").read_text(encoding="utf-8"), look=LOOK,
                       still=Markup(pictures.still(s, first)), caption=held,
                       shape=shapes.as_json(shape).replace("<", "\\u003c"), scripts=scripts)


def write(text, path):
    """Writes the file completely, or leaves it unchanged after an error."""
    part = f"{path}.part"
    try:
        with open(part, "w", encoding="utf-8") as out:
            out.write(text)
        os.replace(part, path)
    except OSError:
        if os.path.exists(part):
            os.remove(part)
        raise


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="reports.film", description=__doc__)
    parser.add_argument("results", help="results of 'beamwork solve --shapes -o' or 'verify --shapes -o'")
    parser.add_argument("-k", dest="case", help="name of the case, if the file contains several motions")
    parser.add_argument("-o", dest="film", required=True, help="HTML file to write")
    given = parser.parse_args(arguments)
    try:
        data.read_about(given.results)
        if os.path.exists(given.film) and os.path.samefile(given.results, given.film):
            raise NoFilm(f"{given.film}: the film would overwrite the results; give another name")
        write(page(given.results, given.case), given.film)
    except NoFilm as why:
        print(f"film: {why}", file=sys.stderr)
        return 2
    except (data.Unreadable, OSError) as why:
        print(f"film: {why}", file=sys.stderr)
        return 4
    print(f"{os.path.getsize(given.film) / 1e6:.2f} MB: {given.film}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
