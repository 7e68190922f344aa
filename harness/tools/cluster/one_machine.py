"""A Slurm of one machine: controller, node and munge in a folder of their own, with a key and ports
of their own, as the user who starts them. Needs neither systemd nor cgroups."""
import getpass
import os
import secrets
import socket
import subprocess
import time

CONFIGURATION = """\
ClusterName=here
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
MailProg=/bin/true
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors}
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    """Ports that nobody listens at just now."""
    held = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [one.getsockname()[1] for one in held]
    for one in held:
        one.close()
    return ports


def configure(folder):
    """Writes key and configuration; returns the place of the latter."""
    for name in ("state", "spool"):
        (folder / name).mkdir(parents=True)
    key = folder / "munge.key"
    key.touch(mode=0o600)
    key.write_bytes(secrets.token_bytes(1024))
    controller, node = free_ports(2)
    place = folder / "slurm.conf"
    place.write_text(CONFIGURATION.format(
        host=socket.gethostname().partition(".")[0], user=getpass.getuser(), controller=controller,
        node=node, folder=folder, processors=len(os.sched_getaffinity(0))), encoding="utf-8")
    return place


def begin(folder, environment):
    """Starts the three; returns the environment in which sbatch speaks to them. RuntimeError: they
    do not answer within a minute; whoever called ends them (keeper.py)."""
    place = configure(folder)
    environment = {**environment, "SLURM_CONF": str(place)}
    munge = [f"--socket={folder}/munge.socket", f"--key-file={folder}/munge.key",
             f"--pid-file={folder}/munge.pid", f"--log-file={folder}/munge.log",
             f"--seed-file={folder}/munge.seed"]
    with open(folder / "daemons.log", "w", encoding="utf-8") as log:
        for command in (["munged", "--foreground", "--force", *munge],
                        ["slurmctld", "-D", "-f", place], ["slurmd", "-D", "-f", place]):
            subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=log,
                             stderr=log, start_new_session=True)
            time.sleep(1)  # munge before those that ask it
    for _ in range(60):
        asked = subprocess.run(["sinfo", "--noheader", "--format=%T"], env=environment, text=True,
                               capture_output=True, check=False)
        if asked.stdout.strip() == "idle":
            return environment
        time.sleep(1)
    raise RuntimeError("Slurm does not answer: " + (folder / "daemons.log").read_text()[-300:])
