"""The program as its tests call it."""
import os
import subprocess

PROGRAM = os.path.abspath(os.environ.get("BEAMWORK", "build/beamwork"))
TRUTHS = os.path.abspath(os.environ.get("BEAMWORK_TRUTHS", "build/truths.h5"))
VERBS = ("list", "solve", "converge", "bench", "stress", "verify", "truth", "compare")
# Small work for every verb, and the options that name its files: those that take text, those that
# take HDF5.
WORK = {
    "verify": ("-k", "warping_torsion/default and beamw_vlasov"),
    "solve": ("warping_torsion", "-f", "beamw", "-n", "2"),
    "converge": ("warping_torsion", "-f", "beamw", "-n", "2,4,8"),
    "bench": ("warping_torsion", "-f", "beamw", "-n", "2"),
    "stress": ("-k", "decay_free and collocation"),
}
TEXT = {"verify": ("--json", "--junit", "--markdown"), "solve": ("-o",), "converge": ("-o",),
        "stress": ("-o", "--json"), "bench": ()}
WHOLE = {"verify": ("-o",), "bench": ("-o",), "solve": ("--shapes=1", "-o"), "converge": (),
         "stress": ()}


def run(*arguments, program=PROGRAM, **options):
    return subprocess.run([program, *map(str, arguments)], text=True, check=False,
                          **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options})
