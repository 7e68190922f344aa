"""The four engines as the trials use them: what each needs, and its script started once."""
import os
import pathlib
import shlex
import shutil
import subprocess

from harness.tools.cluster import one_machine

HERE = pathlib.Path(__file__).resolve().parent
PATHS = os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin", "/sbin"])  # of daemons
SECONDS = 600  # of one run: more is a fault of the engine


class Engine:
    """A script N FOLDER OUTPUT VERB ARGUMENT..., which ends with the status of the merge."""

    def __init__(self, name, script, commands, packages, **variables):
        self.name, self.script, self.variables = name, HERE / script, variables
        self.commands, self.packages = commands, packages

    def missing(self):
        """Commands that are not installed."""
        return [c for c in self.commands if shutil.which(c, path=PATHS) is None]

    def begin(self, folder, environment):
        """What runs before the first job; returns the environment of jobs."""
        return {**environment, **self.variables, "PATH": PATHS}

    def command(self, shards, folder, output, arguments):
        """The line that a user types."""
        return [self.script, str(shards), folder, output, *arguments]

    def start(self, shards, folder, output, arguments, environment, log):
        """A process; its words go to log. The folder of the output is the present one."""
        return subprocess.Popen(self.command(shards, folder, output, arguments), text=True,
                                env=environment, cwd=pathlib.Path(output).parent,
                                stdin=subprocess.DEVNULL, stdout=log, stderr=log)

    @staticmethod
    def status(code):
        """Of the merge; None: the engine does not hand it on."""
        return code


class Slurm(Engine):
    """With a controller and a node of its own."""

    def begin(self, folder, environment):
        return one_machine.begin(folder / "slurm", super().begin(folder, environment))


class Snakemake(Engine):
    """Its script is a list of rules; its status is 1 whatever a rule's was."""

    def command(self, shards, folder, output, arguments):
        run = " ".join(map(shlex.quote, arguments))
        return ["snakemake", "-s", self.script, "-j", "2", "--keep-going", "--config",
                f"shards={shards}", f"folder={folder}", f"output={output}", f"run={run}"]

    @staticmethod
    def status(code):
        return 0 if code == 0 else None


# As root mpirun wants to be told that this is meant; on one machine there are more shards than
# processors.
ENGINES = [
    Slurm("slurm", "slurm.sh", ["slurmctld", "slurmd", "sbatch", "munged"],
          "slurmctld slurmd slurm-client munge"),
    Engine("mpirun", "mpirun.sh", ["mpirun"], "openmpi-bin", OMPI_ALLOW_RUN_AS_ROOT="1",
           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1"),
    Engine("parallel", "parallel.sh", ["parallel"], "parallel"),
    Snakemake("snakemake", "Snakefile", ["snakemake"], "snakemake"),
]
