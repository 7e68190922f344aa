"""Converts the output of CalculiX for a deck of `beamwork export` to a file that `beamwork import` reads.

    python3 harness/import_export/read_back.py DECK.inp... [-o VALUES.csv]

DECK.dat is next to each deck. Decks of one scene with different meshes form one series, whose limit is that of the
solid. The lines `**Q` of a deck are explained in import_export_impl.h. The uncertainty of a value is that of its 7
printed digits.
"""
import argparse
import csv
import io
import pathlib
import sys

HEAD = "# beamwork-import: 1\n# program: {}\n# case: {}\n# model: solid\n"
COLUMNS = ("quantity", "unit", "elements", "unknowns", "seconds", "x", "value", "uncertainty")
PROGRAM = "CalculiX C3D20R"
DIGITS = 5e-7  # relative error of a printed number, due to its 7 digits


class Incomplete(Exception):
    """Raised if the deck was not solved to its end, was not written by beamwork, or does not belong to the series
    of the other decks, or if the reciprocal of a displacement of zero is needed."""


def printed(path):
    """Returns {what: [{node: vector [3]} of every step]}; what: 'displacements' or 'forces'."""
    blocks = {"displacements": [], "forces": []}
    current = None
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words and not words[0].isdigit():
            current = None
            if words[0] in blocks:
                current = {}
                blocks[words[0]].append(current)
        elif words and current is not None:
            current[int(words[0])] = [float(w) for w in words[1:4]]
    return blocks


def value_of(answer, blocks):
    what, step, node, direction, reciprocal, factor, offset = answer[2:9]
    steps = blocks[what]
    if int(step) > len(steps):
        raise Incomplete(f"step {step} was not solved ({answer[0]}); number of solved steps: {len(steps)}")
    found = steps[int(step) - 1][int(node)][int(direction) - 1]
    if reciprocal == "1":
        if found == 0:
            raise Incomplete(f"{answer[0]}: the displacement under the load is zero, so its reciprocal is not defined")
        found = 1 / found
    scaled = float(factor) * found
    return scaled + float(offset), abs(scaled) * DIGITS


def unknowns(lines):
    first = next(i for i, line in enumerate(lines) if line.startswith("*NODE,"))
    last = next(i for i in range(first + 1, len(lines)) if lines[i].startswith("*"))
    return 3 * (last - first - 1)


def said(lines, card):
    for line in lines:
        if line.startswith(card):
            return line[len(card):].strip()
    raise Incomplete(f"the deck has no line '{card}': was it written by beamwork export?")


def head_of(lines):
    head = HEAD.format(PROGRAM, said(lines, "**CASE "))
    if any(line.startswith("**CONVENTION ") for line in lines):
        head += f"# convention: {said(lines, '**CONVENTION ')}\n"
    return head


def rows(deck):
    lines = deck.read_text(encoding="utf-8").splitlines()
    head = head_of(lines)
    elements, count = said(lines, "**ELEMENTS "), unknowns(lines)
    blocks = printed(deck.with_suffix(".dat"))
    out = []
    for line in lines:
        if line.startswith("**Q "):
            answer = line[len("**Q "):].split("|")
            value, uncertainty = value_of(answer, blocks)
            out.append((answer[0], answer[1], elements, count, "", answer[9], repr(float(value)),
                        f"{uncertainty:.3g}"))
    return head, out


def series(decks):
    heads, out, meshes = set(), [], set()
    for deck in decks:
        head, found = rows(deck)
        heads.add(head)
        meshes.add(found[0][2] if found else None)
        out += found
    if len(heads) > 1:
        raise Incomplete("the decks belong to several scenes or parameters; read each separately")
    if len(meshes) < len(decks):
        raise Incomplete("two decks have the same number of elements; give each mesh once")
    return heads.pop(), out


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("deck", type=pathlib.Path, nargs="+")
    words.add_argument("-o", "--output", type=pathlib.Path)
    given = words.parse_args()
    try:
        head, found = series(given.deck)
    except (OSError, Incomplete) as problem:
        print(f"{' '.join(map(str, given.deck))}: {problem}", file=sys.stderr)
        return 2
    text = io.StringIO()
    text.write(head)
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    table.writerows(found)
    if given.output is None:
        sys.stdout.write(text.getvalue())
    else:
        given.output.write_text(text.getvalue(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
