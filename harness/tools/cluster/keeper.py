"""Processes that carry a mark in their environment: found, and ended whatever happens.

A keeper is a process of its own that waits at a pipe: when whoever started it ends, also by
SIGKILL, the pipe closes, and the keeper ends everything that carries the mark and takes away the
folder. What a marked process starts carries the mark too.
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

MARK = "BEAMWORK_ENGINES"


def carries(process, folder):
    """Has it the mark, or is it what Slurm puts before a job: that one writes its title over its
    environment, and is known by the files of the folder that it has open."""
    if f"{MARK}={folder}".encode() in (process / "environ").read_bytes().split(b"\0"):
        return True
    if "slurmstepd" not in os.path.basename(os.readlink(process / "exe")):
        return False
    return any(os.readlink(one).startswith(f"{folder}/") for one in (process / "fd").iterdir())


def marked(folder):
    """Identifiers of all processes that belong to the folder."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if carries(process, folder):
                found.append(int(process.name))
        except OSError:  # it has ended, or is somebody else's
            continue
    return found


def program_of(process):
    """The file that a process runs; None: it has ended."""
    try:
        return os.readlink(f"/proc/{process}/exe")
    except OSError:
        return None


def end_all(folder):
    """Ends what carries the mark: first asked, then killed. Returns how many were left over."""
    for wanted in (signal.SIGTERM, *[signal.SIGKILL] * 20):
        those = marked(folder)
        for process in those:
            try:
                os.kill(process, wanted)
            except ProcessLookupError:
                continue
        if not those:
            return 0
        time.sleep(0.3)
    return len(marked(folder))


def unmount_below(folder):
    """Takes away what was mounted there."""
    mounts = [line.split()[1] for line in pathlib.Path("/proc/mounts").read_text().splitlines()]
    for place in mounts:
        if place.startswith(f"{folder}/"):
            subprocess.run(["umount", "--lazy", place], check=False)


def keeper(folder):
    """Starts one for a folder; its standard input is the pipe to close, or to die with."""
    clean = {name: value for name, value in os.environ.items() if name != MARK}
    return subprocess.Popen([sys.executable, "-B", __file__, str(folder)], env=clean,
                            stdin=subprocess.PIPE, start_new_session=True)


if __name__ == "__main__":
    for ignored in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(ignored, signal.SIG_IGN)
    sys.stdin.buffer.read()
    left = end_all(sys.argv[1])
    unmount_below(sys.argv[1])
    shutil.rmtree(sys.argv[1], ignore_errors=True)
    if left:
        print(f"{left} processes with {MARK}={sys.argv[1]} cannot be ended", file=sys.stderr)
    sys.exit(left != 0)
