"""The commands `beamwork` and `beamwork-report` of a wheel."""
import importlib.util
import os
import pathlib
import runpy
import sys

FOLDER = pathlib.Path(importlib.util.find_spec("beamwork").origin).parent


def main():
    """Replaces this process by the program of the wheel, with the same arguments."""
    os.execv(FOLDER / "bin" / "beamwork", ["beamwork", *sys.argv[1:]])


def report():
    """Draws the report of a results file. The packages of the extra `report` must be installed in this Python."""
    data = FOLDER / "share" / "beamwork"
    if len(sys.argv) < 2 or sys.argv[1] in ("-h", "--help"):
        print("usage: beamwork-report RESULTS.h5 -o FOLDER [--bench BENCH.h5] [--imported THEIRS.h5] "
              "[--sweep SWEEP.h5]\n"
              "       beamwork-report RESULTS.h5 --film FILM.html [-k CASE]\n"
              "'beamwork verify --shapes -o RESULTS.h5' writes results; FOLDER/index.html is the report.")
        sys.exit(2 if len(sys.argv) < 2 else 0)
    wanted = ("h5py", "jinja2", "markdown", "matplotlib", "numpy", "scipy", "yaml")
    missing = [name for name in wanted if importlib.util.find_spec(name) is None]
    if missing:
        print(f"beamwork-report: missing {', '.join(missing)}. Run: {sys.executable} -m pip install 'beamwork[report]'",
              file=sys.stderr)
        sys.exit(4)
    truths = os.environ.get("BEAMWORK_TRUTHS", str(data / "truths.h5"))
    sys.argv[2:2] = [truths]
    sys.path.insert(0, str(data))
    sys.dont_write_bytecode = True
    runpy.run_module("reports", run_name="__main__", alter_sys=True)
