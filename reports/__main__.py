"""python -m reports RESULTS.h5 TRUTHS.h5 [--bench BENCH.h5] [--imported THEIRS.h5]
[--sweep SWEEP.h5] -o FOLDER writes the report as a self-contained folder of HTML and SVG files. A sweep may replace
the results. With --film FILM.html instead of -o FOLDER, it writes a motion as a single file that any browser plays
from disk."""
import argparse
import sys

from reports import data


def main():
    parser = argparse.ArgumentParser(prog="reports", description=__doc__)
    parser.add_argument("results", help="of 'beamwork verify -o', or a sweep")
    parser.add_argument("truths")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("-o", dest="folder")
    what.add_argument("--film", help="an HTML file: a motion that plays in any browser")
    parser.add_argument("-k", dest="case", help="case of the film, if the results contain several")
    parser.add_argument("--bench",
                        help="times of 'beamwork bench -o'; without it those of single runs")
    parser.add_argument("--imported",
                        action="append",
                        default=[],
                        help="results of other programs, stored by 'beamwork import'")
    parser.add_argument("--beside", action="append", dest="imported", help=argparse.SUPPRESS)
    parser.add_argument("--sweep", action="append", default=[],
                        help="results of 'beamwork sweep -o', in addition to those of verify")
    given = parser.parse_args()
    if given.film:
        from reports import film
        return film.main([given.results, "-o", given.film, *(["-k", given.case] if given.case else
                                                              [])])
    try:
        from reports import pages
        count = pages.build(given.results, given.truths, given.folder, given.bench, given.imported,
                            given.sweep)
    except (data.Unreadable, OSError) as why:
        print(f"report: {why}", file=sys.stderr)
        return 4
    print(f"{count} parts: {given.folder}/index.html")
    return 0


if __name__ == "__main__":
    sys.exit(main())
