"""Measures the times that docs/howto/speed.md states, and the machine that they belong to.

usage: times.py PROGRAM [--only WORD] [--write] -o FILE
Every command of the table "How long commands take" that starts with a verb of the program, or with `make` and a target, is
run once on an otherwise idle machine. Elapsed and processor time and the stated time are printed, and written as JSON with
the model of the processor. --write replaces the stated times and the name of the machine in the page.
"""
import argparse
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/howto/speed.md"
HEADING = "## How long commands take"
ROW = re.compile(r"^\| `([^`]+)`([^|]*)\| ([^|]+) \|$", re.MULTILINE)
MACHINE = re.compile(r"^Elapsed times on .*:$", re.MULTILINE)


def section(text):
    return text[text.index(HEADING):]


def rows(text):
    """Returns (command, words after it, stated time) of every row of the table."""
    return [(found[1], found[2].strip(), found[3].strip()) for found in ROW.finditer(section(text))]


def machine():
    """Returns the number and the model of the processors."""
    found = re.search(r"^model name\s*:\s*(.+)$", pathlib.Path("/proc/cpuinfo").read_text("utf-8"), re.MULTILINE)
    return f"{os.cpu_count()} processors ({found[1] if found else 'unknown model'})"


def words(seconds):
    if seconds >= 90:
        return f"{seconds / 60:.2g} minutes"
    return f"{float(f'{seconds:.1g}'):g} s" if seconds < 10 else f"{seconds:.0f} s"


def measured(program, command):
    shutil.rmtree(ROOT / "build/lab/all", ignore_errors=True)
    free = {name: text for name, text in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL")}
    line = command if command.startswith("make ") else f"{program} {command}"
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run(line, shell=True, cwd=ROOT, env=free | {"CCACHE_DISABLE": "1"},
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 1):
        sys.exit(f"times: {line}: {done.stderr.strip()}")
    return {"command": command, "seconds": time.monotonic() - start,
            "processor_seconds": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime}


def replaced(text, results):
    """Returns the page with the measured times and the machine."""
    now = {one["command"]: words(one["seconds"]) for one in results}

    def row(found):
        return f"| `{found[1]}`{found[2]}| {now.get(found[1], found[3])} |"

    at = text.index(HEADING)
    return text[:at] + MACHINE.sub(f"Elapsed times on {machine()}:", ROW.sub(row, text[at:]))


def main(arguments):
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("--only", default="")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("-o", required=True)
    given = parser.parse_args(arguments)
    text, results = PAGE.read_text("utf-8"), []
    for command, _, stated in rows(text):
        if given.only not in command:
            continue
        one = measured(os.path.abspath(given.program), command) | {"stated": stated}
        results.append(one)
        print(f"{one['seconds']:10.2f} s {one['processor_seconds']:10.2f} s of processor; stated {stated:12s} {command}", flush=True)
    pathlib.Path(given.o).write_text(json.dumps({"machine": machine(), "times": results}, indent=1) + "\n", "utf-8")
    if given.write:
        PAGE.write_text(replaced(text, results), "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
