"""Series of VTK files must contain the states of /VTKHDF."""
import base64
import contextlib
import io
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from unittest import mock

import h5py
import numpy as np

from harness.tools.kit.program import ProgramTest, run
from reports import __main__ as command

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    vtk = None


def written(results, target):
    told = io.StringIO()
    with contextlib.redirect_stdout(told), contextlib.redirect_stderr(told), mock.patch.object(
            sys, "argv", ["reports", str(results), "unused", "--vtk", str(target)]):
        return command.main(), told.getvalue()


def arrays(path):
    """Returns {name: values} of the arrays of a .vtu file, decoded without VTK."""
    out = {}
    for found in ElementTree.parse(path).iter("DataArray"):
        raw = base64.b64decode(found.text)
        kind = {"Float64": "<f8", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}[found.get("type")]
        values = np.frombuffer(raw[8:], kind)
        assert np.frombuffer(raw[:8], "<u8")[0] == values.nbytes
        size = int(found.get("NumberOfComponents"))
        out[found.get("Name")] = values.reshape(-1, size) if size > 1 else values
    return out


class Series(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.folder = cls.class_folder()
        cls.results = {}
        for name, case in (("moving", "pendulum"), ("path", "spherical_joint"), ("single", "sheet_cantilever")):
            cls.results[name] = cls.folder / f"{name}.h5"
            run("solve", case, "-f", "sheet_third", "-n", 2, "--shapes", "-o", cls.results[name])

    def test_states(self):
        for name, results in self.results.items():
            target = self.folder / f"{name}.pvd"
            status, words = written(results, target)
            listed = [(float(e.get("timestep")), self.folder / e.get("file"))
                      for e in ElementTree.parse(target).iter("DataSet")]
            self.assertEqual((status, words), (0, f"{len(listed)} states: {target}\n"))
            with h5py.File(results) as file:
                group = file["VTKHDF"]
                steps = group.get("Steps")
                times = steps["Values"][:] if steps else [0]
                firsts = steps["PointOffsets"][:] if steps else [0]
                self.assertEqual([t for t, _ in listed], list(times))
                self.assertEqual(len(listed) > 1, name != "single" or steps is not None)
                for (_, path), first in zip(listed, firsts):
                    rows = slice(first, first + int(group["NumberOfPoints"][0]))
                    found = arrays(path)
                    expected = {"Points": group["Points"][rows], "connectivity": group["Connectivity"][:],
                                "offsets": group["Offsets"][1:], "types": group["Types"][:],
                                **{k: v[rows] for k, v in group["PointData"].items()},
                                **{k: v[:] for k, v in group["CellData"].items()}}
                    self.assertEqual(set(found), set(expected))
                    for key, values in expected.items():
                        np.testing.assert_array_equal(found[key], values)
                    self.read_by_vtk(path, expected)

    def read_by_vtk(self, path, expected):
        if vtk is None:
            return
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), expected["Points"])
        self.assertEqual(grid.GetNumberOfCells(), len(expected["types"]))
        force = vtk_to_numpy(grid.GetPointData().GetArray("force (N, Qy, Qz)"))
        np.testing.assert_array_equal(force, expected["force (N, Qy, Qz)"])

    def test_replaces_an_earlier_series(self):
        target = self.folder / "again.pvd"
        written(self.results["moving"], target)
        before = len(list((self.folder / "again").iterdir()))
        written(self.results["path"], target)
        after = len(list((self.folder / "again").iterdir()))
        self.assertNotEqual(before, after)
        self.assertEqual(after, len(list(ElementTree.parse(target).iter("DataSet"))))

    def test_errors(self):
        plain, other = self.folder / "plain.h5", self.folder / "kept"
        with h5py.File(self.results["moving"]) as source, h5py.File(plain, "w") as file:
            for key in source:
                if key != "VTKHDF":
                    source.copy(key, file)
            file.attrs.update(source.attrs)
        other.mkdir()
        (other / "notes.txt").write_text("mine", encoding="ascii")
        for results, target, status, words in (
                (plain, "a.pvd", 2, "contains no shapes for VTK; 'beamwork solve CASE --shapes -o FILE'"),
                (self.results["moving"], "a.vtu", 2, "ends in .pvd"),
                (self.results["moving"], "kept.pvd", 2, "contains files other than .vtu"),
                (self.results["moving"], "nowhere/a.pvd", 4, "nowhere"),
                (self.folder / "absent.h5", "a.pvd", 4, "absent.h5")):
            found = written(results, self.folder / target)
            self.assertEqual(found[0], status, found)
            self.assertIn(words, found[1])
            self.assertEqual(found[1].count("\n"), 1)
            self.assertFalse((self.folder / target).exists())
        self.assertEqual((other / "notes.txt").read_text(encoding="ascii"), "mine")
        self.assertEqual([f.name for f in self.folder.iterdir() if f.name.startswith(".")], [])


if __name__ == "__main__":
    unittest.main()
