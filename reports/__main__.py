"""python -m reports RESULTS.h5 TRUTHS.h5 [--bench BENCH.h5] [--imported THEIRS.h5]
[--sweep SWEEP.h5] -o FOLDER writes the report as a self-contained folder of HTML and SVG files. RESULTS.h5 may also be
a sweep. With --figures FORMAT, it also writes the charts into FOLDER/figures, for papers. With --film FILM.html instead
of -o FOLDER, it writes a motion as a single file that any browser plays from disk; with --vtk FILE.pvd, shapes as a
series of VTK files."""
import argparse
import sys

from reports import data
from reports.figures import paper


def written(results, target):
    """Writes the shapes of the results as a series of VTK files. Returns the exit status: 0, 2 if the series is not
    possible, or 4 if a file cannot be read or written."""
    from reports import vtk_series
    try:
        count = vtk_series.write(results, target)
    except vtk_series.NoSeries as why:
        print(f"report: {why}", file=sys.stderr)
        return 2
    except (data.Unreadable, OSError) as why:
        print(f"report: {why}", file=sys.stderr)
        return 4
    print(f"{count} states: {target}")
    return 0


def main():
    parser = argparse.ArgumentParser(prog="reports", description=__doc__)
    parser.add_argument("results", help="results of 'beamwork verify -o', or a sweep")
    parser.add_argument("truths")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("-o", dest="folder")
    what.add_argument("--film", help="write the motion of a case to this HTML file, which plays in any browser")
    what.add_argument("--vtk", metavar="FILE.pvd",
                      help="the shapes of 'beamwork solve --shapes -o' as a series of .vtu files, for any version "
                      "of ParaView and VTK")
    parser.add_argument("-k", dest="case", help="case of the film, if the results contain several; "
                        "with --figures, the case whose figures are written (default: all)")
    parser.add_argument("--figures", action="append", choices=paper.FORMATS, default=[], metavar="FORMAT",
                        help="also write the charts of the report into FOLDER/figures: pdf, pgf (for LaTeX), "
                        "png or svg; may be repeated")
    parser.add_argument("--style", metavar="FILE",
                        help="matplotlib style file for the figures: size, fonts, lines, grid")
    parser.add_argument("--bench",
                        help="times of 'beamwork bench -o'; default: the times of single runs")
    parser.add_argument("--imported",
                        action="append",
                        default=[],
                        help="results of other programs, stored by 'beamwork import'")
    parser.add_argument("--beside", action="append", dest="imported", help=argparse.SUPPRESS)
    parser.add_argument("--peers", action="append", default=[], metavar="FILE.json",
                        help="record of `python3 -m beamwork.peers CASE -o FILE.json`, which replaces the recorded one of the case")
    parser.add_argument("--sweep", action="append", default=[],
                        help="results of 'beamwork sweep -o', in addition to those of verify")
    given = parser.parse_args()
    if given.style and not given.figures:
        parser.error("--style requires --figures")
    if given.case and not (given.film or given.figures):
        parser.error("-k requires --film or --figures")
    if given.film:
        from reports import film
        return film.main([given.results, "-o", given.film, *(["-k", given.case] if given.case else
                                                              [])])
    if given.vtk:
        return written(given.results, given.vtk)
    try:
        from reports import pages
        count = pages.build(given.results, given.truths, given.folder, given.bench, given.imported,
                            given.sweep, {"formats": given.figures, "style": given.style,
                                          "only": given.case}, given.peers)
    except (data.Unreadable, paper.Impossible, OSError) as why:
        print(f"report: {why}", file=sys.stderr)
        return 4
    print(f"{count} parts: {given.folder}/index.html")
    return 0


if __name__ == "__main__":
    sys.exit(main())
