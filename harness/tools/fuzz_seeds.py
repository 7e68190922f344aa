"""Writes the seeds of the fuzzing programs to a subfolder of FOLDER for each: scenes, calls of the library, imported
results, parameters, words, formulas, commands, the committed table, reference values and a stored run.

usage: fuzz_seeds.py PROGRAM FOLDER"""
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from harness.tools.kit.scenes import bad_scenes  # noqa: E402  pylint: disable=wrong-import-position

IMPORTS = ROOT / "harness" / "import_export"
WORDS = ("\0beamw:mass=lumped,newton=displacement", "\0collocation:stages=5",
         "\0geometrically_exact:nodes=3", "\1c_column and not beamw or default", "\1not not a b",
         "\2error=0.01,floor=1e-8,work=0.02", "\2work=1")
FORMULAS = ("0.4*(t^2/2 + (7.5/pi)^2*(cos(2*pi*t/15) - 1))", "t^2\n2*t - 1",
            "sqrt(exp(-t))*asin(1)/tan(30*deg)", "tanh(t)^(t - 3)\nlog(1 + t)/(1 - t)")
COMMANDS = ("c_column\n-f\nbeamw:mass=lumped\n-n\n2,4,8\n--set\nlength=3\n--format\njson",
            "-k\nx and y\n-j\n2\n-o\nfile\n--json\na\n--junit\nb",
            "hexapod\n-fall\n-n8\n-sheight=0.1\n--keep-all\n--steps=4",
            "a.h5\nb.h5\n--threshold\nwork=0.1\n--truths=t.h5")


def save(folder, seeds):
    folder.mkdir(parents=True, exist_ok=True)
    for i, seed in enumerate(seeds):
        (folder / f"seed{i:03d}").write_bytes(seed if isinstance(seed, bytes) else seed.encode())


def parameters():
    """Yields every parameter point of the tables, preceded by the number of its case."""
    for index, path in enumerate(sorted((ROOT / "cases" / "benchmarks").glob("*.[cy]*"), key=lambda p: p.stem)):
        table = ROOT / "reference" / "tables" / f"{path.stem}.csv"
        with open(table if table.exists() else "/dev/null", newline="", encoding="utf-8") as rows:
            for text in sorted({row["parameters"] for row in csv.DictReader(rows)}):
                yield bytes([index]) + text.encode()


def truths(scratch):
    (scratch / "tables").mkdir()
    for name in ("defaults.csv", "glossary.csv", "accepted.csv", "tables/wagner_torsion.csv",
                 "tables/roll_up.csv"):
        shutil.copy(ROOT / "reference" / name, scratch / name)
    for name in ("findings.csv", "extreme_findings.csv"):
        lines = (ROOT / "reference" / name).read_text(encoding="utf-8").splitlines()
        (scratch / name).write_text("\n".join(lines[:3]) + "\n", encoding="utf-8")
    subprocess.run([
        sys.executable, ROOT / "reference" / "pack.py", "-o", scratch / "t.h5", "--folder", scratch
    ],
                   check=True,
                   stdout=subprocess.DEVNULL)
    yield (scratch / "t.h5").read_bytes()


def runs(program, scratch):
    subprocess.run([
        program, "verify", "-k", "warping_torsion/default and beamw_vlasov", "-o", scratch / "r.h5"
    ],
                   check=True,
                   stdout=subprocess.DEVNULL)
    yield (scratch / "r.h5").read_bytes()


def scenes():
    for path in sorted((ROOT / "cases/examples").glob("*.yaml")):
        yield path.read_bytes()
    for _, text in bad_scenes():
        yield text.encode()


def library():
    """Yields the number of each call, followed by its texts."""
    for seed in ("\0cases", "\0beamw:mass=lumped", "\1long=0.2", "\2beamw:newton=dense\n",
                 '\2collocation:stages=5\n{"all_dofs": true, "threads": 2, "shapes": 3}',
                 '\3{"steps": 4, "keep_all": false}', "\4beamw collocation\n1,2,4",
                 '\4all\n{"jobs": 1}'):
        yield seed
    for scene in scenes():
        yield b"\5" + scene


def imports():
    head = ("# beamwork-import: 1\n# program: other 1.0\n# case: sheet_cantilever; warping=0\n"
            "# axes: x=-y y=x z=z\n# convention: spatial\n")
    rows = ("quantity, unit, elements, unknowns, seconds, x, value, uncertainty\n"
            "C_ux_Fx, mm/N, 2, 24, 2.1e-3, , 3.9e-4, 1e-9\nC_uz_Fz, m/kN, 4,,,, 3,\n")
    curve = "# axes: x=x y=y z=z\nC_xx_curve, um/mN, 4,,, 0.01, 29,\nC_xx_curve, m/N, 4,,, 0, 14,\n"
    yield b"\0" + (head + rows + "# program: another\n" + curve).encode()
    yield b"\1" + (IMPORTS / "mbdyn.yaml").read_bytes()
    yield (
        b"\2 displacements (vx,vy,vz) for set NTIP and time  0.1E+01\n\n 4 -1.3D+00 1.5E+01 0.0\n"
        b"\n total force (fx,fy,fz) for set NTIP and time 0.1E+01\n\n -1.0D-10 3.6E+03 0.0\n")


def main(program, folder):
    save(folder / "scene", scenes())
    save(folder / "library", library())
    save(folder / "import", imports())
    save(folder / "parameters", parameters())
    save(folder / "words", WORDS)
    save(folder / "formula", FORMULAS)
    save(folder / "command", COMMANDS)
    table = (ROOT / "harness" / "baseline.csv").read_text(encoding="utf-8").splitlines(True)
    save(folder / "table", ["".join(table[:n]) for n in (1, 2, 9)])
    with tempfile.TemporaryDirectory() as scratch:
        save(folder / "truths", truths(pathlib.Path(scratch)))
        save(folder / "results", runs(program, pathlib.Path(scratch)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2])))
