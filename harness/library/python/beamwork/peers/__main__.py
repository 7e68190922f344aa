"""`python3 -m beamwork.peers CASE --peers NAME[:ELEMENT],... -f FORMULATION -o FILE`"""
from __future__ import annotations

import argparse
import json
import pathlib
import sys
import tempfile
from collections.abc import Mapping, Sequence
from typing import Any

from ..errors import Error, Refused
from ..program import run
from . import _features, _ratios, chosen, load, names, solve, solve_all, table
from ._ours import text_of
from ._record import formulations_of, make, read, written
from ._rounds import Series
from ._tables import WRITERS


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python3 -m beamwork.peers", description="Solves a case with other programs and with formulations of beamwork, "
                                     "and ranks them by the time in which they reach an error.")
    parser.add_argument("case", nargs="?", help="a built-in case")
    parser.add_argument("--scene", help="your scene file")
    parser.add_argument("--data", help="a scene written by `beamwork scene --format json`")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="value of a parameter")
    parser.add_argument("--omit", metavar="PHYSICS", help="physics that the scene omits as well, separated by commas, such as warping,trapeze; "
                        "errors are then relative to the limit on which formulations agree")
    parser.add_argument("--peers", default=",".join(names()), help="NAME or NAME:ELEMENT, separated by commas")
    parser.add_argument("-f", "--formulation", action="append", metavar="NAME", help="formulation of beamwork; may be repeated; "
                        "default: all that support the case, but none if results are only written to import files; 'none': none")
    parser.add_argument("--elements", help="meshes; default: those of the case")
    parser.add_argument("--rounds", type=int, default=3, help="times are the least of this number of rounds")
    parser.add_argument("--limit", type=float, default=60, help="longest time of one mesh [s]")
    parser.add_argument("--list", action="store_true", help="list the peers, their licences, elements, physics and analyses")
    parser.add_argument("--requirements", action="store_true", help="print the Python packages of the peers for pip")
    parser.add_argument("--format", choices=WRITERS, default="text", help="format of the ranking on standard output")
    parser.add_argument("--recorded", metavar="FILE.json", help="print the ranking of a recorded comparison; nothing is run")
    parser.add_argument("--features", action="store_true", help="try the features of the peers on small scenes with closed forms; "
                        "print the tables, and write them to -o FILE.json; with --recorded: only print those of the file")
    parser.add_argument("--ratios", metavar="FOLDER", help="print the run times of the programs relative to beamwork, as recorded in the files of "
                        "a folder such as reference/peers")
    parser.add_argument("-o", "--output", action="append", default=[], metavar="FILE", help="may be repeated; .json: record of the "
                        "comparison (reference/peers); results of the peers as an import file (.csv) or stored (.h5)")
    return parser.parse_args()


def _list() -> None:
    for peer in (load(name) for name in names()):
        print(f"{peer.NAME}: {peer.PROGRAM} ({peer.LICENCE}), {peer.HOMEPAGE}")
        for name, element in peer.ELEMENTS.items():
            print(f"  {name}: {element.summary}; {', '.join(sorted(element.analyses))}; "
                  f"physics: {', '.join(sorted(element.offers)) or 'none'}")


def _resolved(case: Sequence[str], options: Mapping[str, Any]) -> dict[str, Any]:
    text, _ = run("scene", *case, format="json", **options)
    scene: dict[str, Any] = json.loads(text)
    return scene


def _with_less(scene: Mapping[str, Any], words: str, place: pathlib.Path) -> dict[str, Any]:
    """Writes the scene without some physics to a file. Returns it as data; whole: its name in records."""
    omit = [*scene["scene"].get("omit", ()), *words.split(",")]
    place.write_text(text_of({**scene["scene"], "omit": list(dict.fromkeys(omit))}), encoding="utf-8")
    separator = "; " if "; " not in scene["of"] else ";"
    return {**_resolved([], {"scene": place}), "whole": f"{scene['of']}{separator}omit={words}"}


def _scene(given: argparse.Namespace, folder: pathlib.Path) -> tuple[dict[str, Any], list[str], dict[str, Any]]:
    """Returns the scene as data, and the words and options that select it. folder: for a temporary scene file."""
    case = [given.case] if given.case else []
    options: dict[str, Any] = {"scene": given.scene} if given.scene else {}
    options |= {"set": dict(word.split("=", 1) for word in given.set)} if given.set else {}
    scene = json.loads(pathlib.Path(given.data).read_text(encoding="utf-8")) if given.data else _resolved(case, options)
    if "beamwork_scene" not in scene:
        raise Refused(f"{given.data}: no scene; write one with `beamwork scene --format json`")
    if not given.omit:
        return scene, case, options
    place = folder / f"{scene['scene']['name']}.yaml"
    return _with_less(scene, given.omit, place), [], {"scene": place}


def _store(given: argparse.Namespace, imports: str, record: dict[str, Any] | None) -> None:
    for name in given.output:
        place = pathlib.Path(name)
        if place.suffix == ".json":
            place.write_text(written(record) if record else "", encoding="utf-8")
        elif place.suffix == ".h5":
            with tempfile.TemporaryDirectory() as folder:
                text = pathlib.Path(folder, "peers.csv")
                text.write_text(imports, encoding="utf-8")
                run("import", text, output=name)
        else:
            place.write_text(imports, encoding="utf-8")


def _reasons(found: list[Series]) -> None:
    for one in found:
        told = {one.missing} | {run.get("refusal", run.get("failure", "")) for run in one.runs}
        for why in sorted(told - {""}):
            print(f"{one.program}: {why}", file=sys.stderr)


def _progress(text: str) -> None:
    if sys.stderr.isatty():
        print(f"\r\033[K{text[:78]}", end="", file=sys.stderr, flush=True)


def _compare(given: argparse.Namespace, folder: pathlib.Path) -> int:
    scene, case, options = _scene(given, folder)
    only_imports = bool(given.output) and not any(name.endswith(".json") for name in given.output) and not given.formulation
    ranked = not given.data and not only_imports
    if given.data and (given.formulation or any(name.endswith(".json") for name in given.output)):
        raise Refused("--data: formulations are not run on such a scene; give CASE or --scene")
    ours = [] if not ranked else given.formulation or formulations_of(case, options)
    meshes = [int(n) for n in (given.elements.split(",") if given.elements else scene["scene"]["meshes"])]
    peers = chosen(given.peers.split(",")) if given.peers else []
    found = solve_all(scene, peers, [name for name in ours if name != "none"], meshes, given.rounds, given.limit, _progress)
    _progress("")
    if not ranked:
        _reasons(found)
    imports = table(scene, [one for one in found if one.peer])
    if not any("values" in run for one in found for run in one.runs if one.peer or ranked):
        print("beamwork.peers: no program solved the case", file=sys.stderr)
        return 3
    record = make(scene, found, imports, case, options, given.rounds) if ranked else None
    _store(given, imports, record)
    if record:
        print(WRITERS[given.format](record), end="")
    elif not given.output:
        print(imports, end="")
    return 0


def _try_features(given: argparse.Namespace) -> int:
    if given.recorded:
        found = json.loads(pathlib.Path(given.recorded).read_text(encoding="utf-8"))
    else:
        found = _features.measure([(peer, element, load(peer).ELEMENTS[element]) for peer, element in chosen(given.peers.split(","))], solve, given.limit, _progress)
        _progress("")
    for name in given.output:
        pathlib.Path(name).write_text(_features.as_json(found), encoding="utf-8")
    print(_features.markdown(found), end="")
    return 0


def main() -> int:
    given = _arguments()
    if given.list:
        _list()
        return 0
    if given.requirements:
        wanted = dict.fromkeys(word.partition(":")[0] for word in given.peers.split(","))
        print("numpy", *(package for name in wanted for package in load(name).REQUIRES), sep="\n")
        return 0
    try:
        if given.features:
            return _try_features(given)
        if given.ratios:
            print(_ratios.markdown(_ratios.recorded(pathlib.Path(given.ratios))), end="")
            return 0
        if given.recorded:
            print(WRITERS[given.format](read(pathlib.Path(given.recorded))), end="")
            return 0
        with tempfile.TemporaryDirectory() as folder:
            return _compare(given, pathlib.Path(folder))
    except Error as error:
        print(f"beamwork.peers: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
