#!/usr/bin/python3
"""Counts the instructions of the parts of a solution with callgrind, independent of the load of the machine, and compares
them with the smallest conceivable number.

usage: instructions.py PROGRAM [-o FILE] [--only WORD]     a table; FILE: the same as JSON
       instructions.py PROGRAM --callgrind FILE            parts of an existing profile

A part consists of the functions of the harness with these names, and all that they call. The smallest number consists
of operations on doubles (+ - * / sqrt) without loads, stores and loops. For strains, stresses and updates these are the
operations of their equations as written, counted in the program. For J^T C J with a symmetric result it is
m n (2 m + n + 1) (m strains, n coordinates). For a factorisation it is the counted number of operations. For a
solution, which sweeps twice over the factors, it is 4 per entry. For elimination and assembly it is one per entry of a
symmetric matrix. With four numbers in a register, a quarter of these instructions would be enough.
"""
import argparse
import collections
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

CELLS = (("spherical_joint", "sheet_third", 1), ("hexapod", "sheet_third", 1),
         ("sheet_cantilever", "sheet_third", 2), ("sheet_cantilever", "collocation", 1),
         ("c_cantilever", "geometrically_exact", 8), ("c_column", "beamw", 64))
# name, file of the called function, the function, the count by which the instructions are divided
PARTS = (
    # strains, stresses and J^T C J of several elements together
    ("all in lanes", "elements/", r"_equations", "strain_evaluations"),
    ("strain", "elements/", r"strain", "strain_evaluations"),
    ("stress", "elements/", r"stress", "stress_evaluations"),
    ("update", "elements/", r"update", "strain_evaluations"),
    ("other of elements", "elements/(?!math/|shared/)", r"", "elements_total"),
    ("J^T C J", "elements/math/", r"congruence", "strain_evaluations"),
    ("elimination", "(harness/model|elements/math)/", r"^(eliminate|offset)_", "strain_evaluations"),
    ("assembly", "harness/model/", r"^assemble_|_assemble$", "strain_evaluations"),
    ("factorisation", "harness/", r"^(context_factor|factor_numeric|factor_alloc)$",
     "factorisations"),
    ("solution", "harness/", r"^factor_(solve|solve_many|solve_transposed)$", "solutions"),
    ("eigenvalues", "harness/numerics/", r"^(eigen|lanczos|gyroscopic)_", None),
    ("places of nodes", "harness/model/", r"^kinematics_gather$", "strain_evaluations"),
    ("products", "elements/math/", r"^dense_", "strain_evaluations"),
    ("guesses", "harness/newton/", r"^predictor_", "load_steps"),
    ("set-up", "harness/model/", r"^model_alloc$", None),
)
OPERATION = re.compile(r"\s*([0-9a-f]+):\s+v?(?:add|sub|mul|div|sqrt|addsub|hadd)(sd|pd)\b")
ADDRESS = re.compile(r"(0x[0-9a-f]+|[+-]\d+|\*) \S+ (\d+)$")
LINE = re.compile(r"(c?f[nile]|c?ob|fe)=(?:\((\d+)\))?(?: ?(.*))?$")
COST = re.compile(r"[+\-*\d][^=]* (\d+)$")


class Profile:
    """A callgrind profile. own: {(file, function): instructions}. calls: {(caller, callee): instructions of the callee,
    including its calls}."""

    def __init__(self, path):
        self.own, self.calls = collections.Counter(), collections.Counter()
        self.names = {}
        with open(path, encoding="utf-8", errors="replace") as lines:
            self.read(lines)

    def name(self, kind, number, text):
        """Returns a name. The file contains a name only once, with a number that replaces it afterwards."""
        if number is None:
            return text
        if text:
            self.names[kind, number] = text
        return self.names[kind, number]

    def read(self, lines):
        here = there = own_file = called_file = None
        called = False
        for line in lines:
            named = LINE.match(line.rstrip("\n"))
            if named:
                word, number, text = named.groups()
                kind = "n" if word.endswith("fn") else "o" if word.endswith("ob") else "f"
                name = self.name(kind, number, text)
                if word == "fl":
                    own_file = name
                elif word == "fn":
                    here = (own_file, name)
                    called_file = own_file
                elif word in ("cfi", "cfl"):
                    called_file = name
                elif word == "cfn":
                    there = (called_file, name)
                    called_file = own_file
            elif line.startswith("calls="):
                called = True
            elif (cost := COST.match(line.rstrip("\n"))) and here:
                if called:
                    self.calls[here, there] += int(cost[1])
                else:
                    self.own[here] += int(cost[1])
                called = False


def place(function):
    """Returns the path of the file of a function relative to the project."""
    found = re.search(r"(?:^|/)((?:harness|elements|cases)/.*)", function[0] or "")
    return found[1] if found else ""


def part_of(function):
    for name, file, pattern, _ in PARTS:
        if re.match(file, place(function)) and re.search(pattern, function[1]):
            return name
    return None


def frames(profile):
    """Returns the functions that are reached without passing through a part. Only calls of parts from these functions
    are counted, so no instruction is counted twice."""
    callees = collections.defaultdict(set)
    for caller, callee in profile.calls:
        callees[caller].add(callee)
    called = set().union(*callees.values()) if callees else set()
    waiting = [function for function in callees if function not in called]
    reached = set(waiting)
    while waiting:
        for callee in callees[waiting.pop()]:
            if callee not in reached and part_of(callee) is None:
                reached.add(callee)
                waiting.append(callee)
    return reached


def parts_of(profile):
    """Returns {part: instructions}. Their sum is that of the profile."""
    out, outside = collections.Counter(), frames(profile)
    for (caller, callee), cost in profile.calls.items():
        part = part_of(callee)
        if part and caller in outside and place(caller).startswith("harness/"):
            out[part] += cost
    out["rest"] = sum(profile.own.values()) - sum(out.values())
    return out


def run(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True,
                          check=False)
    if done.returncode:
        sys.exit(f"instructions: {' '.join(map(str, arguments))}: {done.stderr or done.stdout}")
    return done.stdout


def profiled(program, cell, inside, read=Profile, *more):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "profile")
        run("valgrind", "-q", "--tool=callgrind", f"--callgrind-out-file={path}", *more,
            *[f"--toggle-collect={name}" for name in inside], os.path.abspath(program), "solve",
            cell[0], "-f", cell[1], "-n", cell[2])
        return read(path)


def arithmetic(program):
    """Returns {address: number of doubles that an instruction of the program adds, multiplies or divides}."""
    out = {}
    for line in run("objdump", "-d", "--no-show-raw-insn", program).splitlines():
        found = OPERATION.match(line)
        if found:
            packed = found[2] == "pd"
            out[int(found[1], 16)] = (4 if "%ymm" in line else 2) if packed else 1
    return out


def operations(path, program, numbers):
    """Returns the number of operations on doubles in the program, without libraries, from a profile with addresses."""
    total = at = 0
    called = inside = False
    objects = {}
    with open(path, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            if named := re.match(r"c?ob=\((\d+)\)(?: (.*))?", line):
                objects[named[1]] = named[2] or objects[named[1]]
                if line.startswith("ob"):
                    inside = objects[named[1]] == program
            elif line.startswith("calls="):
                called = True
            elif found := ADDRESS.match(line):
                word = found[1]
                at = int(word, 16) if word[0] == "0" else at if word == "*" else at + int(word)
                total += numbers.get(at, 0) * int(found[2]) if inside and not called else 0
                called = False
    return total


def as_they_stand(program, cell, profile, numbers):
    """Returns {part: operations} of the equations of elements."""
    out = {}
    for part in ("all in lanes", "strain", "stress", "update"):
        entries = {callee[1] for caller, callee in profile.calls
                   if part_of(callee) == part and place(caller).startswith("harness/")}
        if entries:
            out[part] = profiled(program, cell, entries, lambda path: operations(
                path, os.path.abspath(program), numbers), "--dump-instr=yes")
    return out


def least(counts, form):
    """Returns {part: smallest number of operations in the whole run} of the parts that all formulations have in
    common."""
    m, n = form["strains"], 7 * form["nodes"]
    triangle = n * (n + 1) // 2
    return {"J^T C J": counts["strain_evaluations"] * m * n * (2 * m + n + 1),
            "elimination": counts["strain_evaluations"] * triangle,
            "assembly": counts["strain_evaluations"] * triangle,
            "factorisation": counts["factor_flops"],
            "solution": 4 * counts["solved_entries"]}


def measured(program, cell, numbers):
    counts = json.loads(run(program, "solve", cell[0], "-f", cell[1], "-n", cell[2], "--format",
                            "json"))["cell"]
    form = json.loads(run(program, "list", cell[1], "--format", "json"))
    profile = profiled(program, cell, ["cell_run"])
    parts = parts_of(profile)
    inside = profiled(program, cell, ["compliance_analysis"])
    below = least(counts, form) | as_they_stand(program, cell, profile, numbers)
    divided = {name: by for name, _, _, by in PARTS}
    rows = [{"part": name, "instructions": parts[name], "least": below.get(name),
             "times": counts[divided[name]] if divided.get(name) else None}
            for name in [*divided, "rest"] if parts[name]]
    return {"case": cell[0], "formulation": cell[1], "elements": cell[2],
            "elements_total": counts["elements_total"], "iterations": counts["iterations"],
            "evaluations": counts["strain_evaluations"],
            "instructions": sum(parts.values()), "compliance": sum(inside.own.values()),
            "compliance_parts": dict(parts_of(inside)), "parts": rows}


def shown(one):
    total = one["instructions"]
    print(f"{one['case']} {one['formulation']} n = {one['elements']}: {total / 1e6:.2f} M "
          f"instructions, {one['elements_total']} elements, {one['iterations']} iterations, "
          f"{one['evaluations']} evaluations of an element; {per(total, one)}")
    print(f"  {'part':18s}{'M':>9s}{'share':>8s}{'each time':>12s}{'least':>9s}{'times it':>10s}"
          f"{'of it in compliance':>21s}")
    for row in one["parts"]:
        each, low = row["instructions"], row["least"]
        text = f"  {row['part']:18s}{each / 1e6:9.2f}{100 * each / total:7.1f} %"
        text += f"{each / row['times']:12.0f}" if row["times"] else f"{'':12s}"
        if low and row["times"]:
            text += f"{low / row['times']:9.0f}{each / low:10.1f}"
        else:
            text += f"{'':19s}"
        print(f"{text}{one['compliance_parts'].get(row['part'], 0) / 1e6:21.2f}")
    print(f"  {'all':18s}{total / 1e6:9.2f}{'':48s}{one['compliance'] / 1e6:12.2f}")


def per(total, one):
    if not one["iterations"]:
        return f"{total / max(one['elements_total'], 1):.0f} for each element"
    return f"{total / one['iterations'] / one['elements_total']:.0f} for each element and iteration"


def main(arguments):
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("-o")
    parser.add_argument("--only", default="")
    parser.add_argument("--callgrind")
    given = parser.parse_args(arguments)
    if given.callgrind:
        for name, cost in parts_of(Profile(given.callgrind)).most_common():
            print(f"{name:18s}{cost:15d}")
        return 0
    if shutil.which("valgrind") is None:
        print("skipped: instructions are counted by valgrind; run: sudo apt-get install valgrind")
        return 0
    all_cells, numbers = [], arithmetic(given.program)
    for cell in CELLS:
        if given.only in " ".join(map(str, cell)):
            all_cells.append(measured(given.program, cell, numbers))
            shown(all_cells[-1])
    if given.o:
        with open(given.o, "w", encoding="utf-8") as file:
            json.dump(all_cells, file, indent=1)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
