"""`python3 -m beamwork.peers CASE --peers NAME[:ELEMENT],... -o FILE.csv`"""
from __future__ import annotations

import argparse
import json
import pathlib
import sys
import tempfile

from ..errors import Error, Refused
from ..program import run
from . import chosen, load, names, solve, table


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python3 -m beamwork.peers", description="Solves a case with other programs.")
    parser.add_argument("case", nargs="?", help="a built-in case")
    parser.add_argument("--scene", help="your scene file")
    parser.add_argument("--data", help="a scene written by `beamwork scene --format json`")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="value of a parameter")
    parser.add_argument("--peers", default=",".join(names()), help="NAME or NAME:ELEMENT, separated by commas")
    parser.add_argument("--elements", help="meshes; default: those of the case")
    parser.add_argument("--rounds", type=int, default=3, help="times are the least of this number of rounds")
    parser.add_argument("--limit", type=float, default=60, help="longest time of one mesh [s]")
    parser.add_argument("--list", action="store_true", help="list the peers, their licences, elements, physics and analyses")
    parser.add_argument("--requirements", action="store_true", help="print the Python packages of the peers for pip")
    parser.add_argument("-o", "--output", help="import file (.csv), or the stored import (.h5); default: standard output")
    return parser.parse_args()


def main() -> int:
    given = _arguments()
    if given.list:
        for peer in (load(name) for name in names()):
            print(f"{peer.NAME}: {peer.PROGRAM} ({peer.LICENCE}), {peer.HOMEPAGE}")
            for name, element in peer.ELEMENTS.items():
                print(f"  {name}: {element.summary}; {', '.join(sorted(element.analyses))}; "
                      f"physics: {', '.join(sorted(element.offers)) or 'none'}")
        return 0
    if given.requirements:
        wanted = dict.fromkeys(word.partition(":")[0] for word in given.peers.split(","))
        print("numpy", *(package for name in wanted for package in load(name).REQUIRES), sep="\n")
        return 0
    try:
        if given.data:
            text = pathlib.Path(given.data).read_text(encoding="utf-8")
        else:
            options = {"scene": given.scene} if given.scene else {}
            text, _ = run("scene", *([given.case] if given.case else []), format="json", **options,
                          set=dict(word.split("=", 1) for word in given.set))
        scene = json.loads(text)
        if "beamwork_scene" not in scene:
            raise Refused(f"{given.data}: no scene; write one with `beamwork scene --format json`")
        meshes = [int(n) for n in given.elements.split(",")] if given.elements else scene["scene"]["meshes"]
        found = [solve(scene, peer, element, [int(n) for n in meshes], given.rounds, given.limit)
                 for peer, element in chosen(given.peers.split(","))]
    except Error as error:
        print(f"beamwork.peers: {error}", file=sys.stderr)
        return 2
    for one in found:
        told = {one.missing} | {run.get("refusal", run.get("failure", "")) for run in one.runs}
        for why in sorted(told - {""}):
            print(f"{one.program}: {why}", file=sys.stderr)
    written = table(scene, found)
    if not any("values" in run for one in found for run in one.runs):
        print("beamwork.peers: no program solved the case", file=sys.stderr)
        return 3
    if given.output and given.output.endswith(".h5"):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder, "peers.csv")
            place.write_text(written, encoding="utf-8")
            run("import", place, output=given.output)
    elif given.output:
        pathlib.Path(given.output).write_text(written, encoding="utf-8")
    else:
        print(written, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
