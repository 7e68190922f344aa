"""python -m reports RESULTS.h5 TRUTHS --vtk FILE.pvd writes the states of the group /VTKHDF of a results file in a
series of VTK files. FILE.pvd lists the times or load factors, and the folder FILE contains one .vtu file for each
state. All versions of VTK and ParaView read these files."""
import base64
import os
import pathlib
import shutil
import tempfile
from xml.sax.saxutils import quoteattr

import h5py
import numpy as np

from reports import data

TYPES = {"f8": "Float64", "i8": "Int64", "i4": "Int32", "u1": "UInt8"}


class NoSeries(Exception):
    """Raised if there is nothing to write, with the reason."""


def array(name, values):
    """Returns a DataArray element, encoded as base64."""
    values = np.ascontiguousarray(values)
    size = values.shape[1] if values.ndim == 2 else 1
    raw = np.uint64(values.nbytes).tobytes() + values.tobytes()
    return (f'<DataArray type="{TYPES[values.dtype.str[1:]]}" Name={quoteattr(name)} '
            f'NumberOfComponents="{size}" format="binary">{base64.b64encode(raw).decode()}</DataArray>')


def state(group, first, points):
    rows = slice(first, first + points)
    offsets = group["Offsets"][1:]
    at_points = "".join(array(name, values[rows]) for name, values in group["PointData"].items())
    at_cells = "".join(array(name, values[:]) for name, values in group["CellData"].items())
    cells = (array("connectivity", group["Connectivity"][:]) + array("offsets", offsets) +
             array("types", group["Types"][:]))
    return ('<?xml version="1.0"?>\n'
            '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">'
            f'<UnstructuredGrid><Piece NumberOfPoints="{points}" NumberOfCells="{len(offsets)}">\n'
            f'<PointData>{at_points}</PointData>\n<CellData>{at_cells}</CellData>\n'
            f'<Points>{array("Points", group["Points"][rows])}</Points>\n<Cells>{cells}</Cells>\n'
            '</Piece></UnstructuredGrid></VTKFile>\n')


def states(group):
    """Returns [(time or load factor, index of the first point)] of the states."""
    if "Steps" not in group:
        return [(0.0, 0)]
    steps = group["Steps"]
    return list(zip(steps["Values"][:].tolist(), steps["PointOffsets"][:].tolist()))


def write(results, target):
    """Writes all states, or nothing after an error. Returns their number."""
    data.read_about(results)
    target = pathlib.Path(target)
    if target.suffix != ".pvd":
        raise NoSeries(f"{target}: the name of a series of VTK files ends in .pvd")
    folder = target.with_suffix("")
    with h5py.File(results) as file, tempfile.TemporaryDirectory(dir=target.absolute().parent,
                                                                 prefix=f".{folder.name}-") as part:
        if "VTKHDF" not in file:
            raise NoSeries(f"{results}: contains no shapes for VTK; 'beamwork solve CASE --shapes -o FILE' writes them")
        group = file["VTKHDF"]
        found = states(group)
        entries = ""
        for number, (value, first) in enumerate(found):
            name = f"{folder.name}_{number:05d}.vtu"
            pathlib.Path(part, name).write_text(state(group, first, int(group["NumberOfPoints"][0])), encoding="ascii")
            entries += f'<DataSet timestep="{value!r}" file={quoteattr(f"{folder.name}/{name}")}/>\n'
        collection = ('<?xml version="1.0"?>\n<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">'
                      f"<Collection>\n{entries}</Collection></VTKFile>\n")
        listed = pathlib.Path(part, target.name)
        listed.write_text(collection, encoding="utf-8")
        replace(pathlib.Path(part), folder, listed, target)
    return len(found)


def replace(part, folder, listed, target):
    """Moves the states and their list from `part` to their final names. Removes states of an earlier series."""
    if folder.exists() and any(f.suffix != ".vtu" for f in folder.iterdir()):
        raise NoSeries(f"{folder}: contains files other than .vtu; choose another name")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for file in part.glob("*.vtu"):
        os.replace(file, folder / file.name)
    os.replace(listed, target)
