"""Files of deformed shapes: equilibrium along the lines, agreement with the quantities, and equal data after VTK has
read them."""
import unittest

import h5py
import numpy

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    vtk = None

from harness.tools.kit.program import ProgramTest, run


def turned(q, v):
    w, u = q[..., :1], q[..., 1:]
    return v + 2 * numpy.cross(u, numpy.cross(u, v) + w * v)


class Solution(ProgramTest):

    def setUp(self):
        super().setUp()
        self.path = self.folder / "s.h5"

    def solve(self, case, formulation, n, *more):
        self.answered("solve", case, "-f", formulation, "-n", n, "-o", self.path, *more)
        file = h5py.File(self.path)
        self.addCleanup(file.close)
        tables = file[f"cases/{case}"]
        return file, next(iter(tables["shapes"].values())), tables

    def test_path(self):
        for formulation, n in (("sheet_third", 1), ("collocation", 3),
                               ("geometrically_exact:nodes=3", 2)):
            _, shapes, tables = self.solve("sheet_cantilever", formulation, n, "--shapes")
            value = {row["quantity"].decode(): row["value"] for row in tables["quantities"][()]}
            position, force = shapes["position"][()], shapes["force"][()]
            orientation = shapes["orientation"][()]
            self.assertEqual(list(shapes["kind"].asstr()[:2]), ["undeformed", "path"])
            self.assertEqual(len(position), 16)
            moved = position[-1, -1] - position[0, -1]
            self.assertAlmostEqual(moved[1], tables["points"]["tip_deflection"][0], delta=1e-12)
            if formulation == "sheet_third":
                self.assertAlmostEqual(moved[0], value["u_x"], delta=1e-12)
            fixed = turned(orientation[-1], force[-1])
            self.assertAlmostEqual(fixed[-1, 1], value["F_y"], delta=1e-8 * value["F_y"])
            moment = turned(orientation[-1], shapes["moment"][-1])
            self.assertAlmostEqual(moment[-1, 2], value["M_z"], delta=1e-8 * abs(value["M_z"]))
            arm = position[-1, -1] - position[-1]
            balance = moment[-1] + numpy.cross(arm, fixed[-1]) - moment
            scale = numpy.abs(moment).max()
            self.assertLess(numpy.abs(fixed - fixed[-1]).max(), 1e-9 * numpy.abs(fixed).max())
            self.assertLess(numpy.abs(balance).max(), 1e-9 * scale, formulation)

    def test_structure(self):
        _, shapes, _ = self.solve("spherical_joint", "sheet_third", 2, "--shapes=3")
        self.assertEqual(list(shapes["value"][()]), [0, 1, 25, 50])
        members, first = shapes["members"][()], shapes["first_point"][()]
        self.assertEqual((len(members), len(first)), (12, 13))
        numpy.testing.assert_allclose(numpy.sort(numpy.abs(shapes["sections/0"][0]), axis=0)[0],
                                      [0.000838 / 2, 0.0282 / 2], rtol=1e-15)
        position, nodes = shapes["position"][()], shapes["nodes"][()]
        for i, (p, q, _) in enumerate(members):
            numpy.testing.assert_allclose(position[:, first[i]], nodes[:, p], atol=1e-15)
            numpy.testing.assert_allclose(position[:, first[i + 1] - 1], nodes[:, q], atol=1e-15)
        bodies = shapes["bodies"][:, 0]
        self.assertEqual(sorted(numpy.unique(bodies, return_counts=True)[1]), [3, 3, 6, 9])
        attached = numpy.flatnonzero(bodies >= 0)
        distance = numpy.linalg.norm(nodes[:, attached] - nodes[:, bodies[attached]], axis=2)
        numpy.testing.assert_allclose(distance, numpy.broadcast_to(distance[0], distance.shape),
                                      rtol=1e-12)

    def test_modes(self):
        _, shapes, _ = self.solve("c_column", "beamw_consistent", 16, "--shapes")
        kinds = list(shapes["kind"].asstr()[()])
        self.assertIn("buckling", kinds)
        self.assertIn("mode", kinds)
        state = kinds.index("buckling")
        position, q = shapes["position"][()], shapes["orientation"][()]
        length = numpy.ptp(position[0], axis=0).max()
        moved = numpy.linalg.norm(position[state] - position[0], axis=1).max() / length
        turn = 2 * numpy.arccos(numpy.abs((q[state] * q[0]).sum(axis=1))).max()
        self.assertAlmostEqual(max(moved / 0.1, turn / 0.5), 1, delta=2e-2)

    def test_lines(self):
        for formulation in ("sheet_third", "collocation"):
            _, shapes, tables = self.solve("sheet_cantilever", formulation, 1, "--shapes")
            position, length = shapes["position"][-1], tables["points"]["length"][0]
            t = numpy.linspace(0, 1, len(position))
            cubic = numpy.polynomial.polynomial.polyfit(t, position, 3)
            passed = numpy.polynomial.polynomial.polyval(t, cubic).T
            slope = numpy.polynomial.polynomial.polyval(
                t, numpy.polynomial.polynomial.polyder(cubic)).T
            axis = turned(shapes["orientation"][-1], numpy.array([1.0, 0, 0]))
            self.assertLess(numpy.abs(passed - position).max(), 1e-14)
            self.assertGreater(numpy.linalg.norm(axis[6] - axis[0]), 0.05)
            self.assertLess(numpy.abs(slope[[0, -1]] - length * axis[[0, -1]]).max(), 1e-12)
            across = numpy.cross(slope, axis) / numpy.linalg.norm(slope, axis=1)[:, None]
            self.assertLess(numpy.abs(across).max(), 1e-12, formulation)

    def test_bimoments_of_elements(self):
        """Bimoments must be linear within an element and continuous at nodes, and zero at an end that is free to
        warp, within 1e-8."""
        _, shapes, _ = self.solve("warping_torsion", "collocation", 4, "--shapes")
        bimoment = shapes["bimoment"][-1].ravel()
        size = numpy.abs(bimoment).max()
        self.assertEqual(len(bimoment), 13)
        for node in (3, 6, 9, 12):
            before = 2 * bimoment[node - 1] - bimoment[node - 2]
            self.assertLess(abs(before - bimoment[node]), 1e-8 * size)
        self.assertLess(abs(bimoment[-1]), 1e-8 * size)
        self.assertEqual(size, abs(bimoment[0]))

    def test_supports_and_bimoments(self):
        _, shapes, _ = self.solve("elastica", "collocation", 2, "--shapes")
        self.assertEqual(sorted(shapes["bodies"][:, 1]), [0, 0b111111])
        _, shapes, _ = self.solve("warping_torsion", "collocation", 4, "--shapes")
        state = list(shapes["kind"].asstr()[()]).index("linear")
        bimoment, moment = shapes["bimoment"][state].ravel(), shapes["moment"][state]
        self.assertGreater(numpy.abs(bimoment).max(), 0.05 * numpy.abs(moment[:, 0]).max())
        self.assertGreater(numpy.ptp(bimoment), 0.5 * numpy.abs(bimoment).max())
        self.assertLess(numpy.abs(moment[:, 1:]).max(), 1e-6 * numpy.abs(moment[:, 0]).max())

    def test_values_of_modes(self):
        _, shapes, tables = self.solve("c_column", "beamw_consistent", 16, "--shapes")
        value = {row["quantity"].decode(): row["value"] for row in tables["quantities"][()]}
        kinds, drawn = shapes["kind"].asstr()[()], shapes["value"][()]
        for kind, prefix in (("mode", "frequency_"), ("buckling", "buckling_load")):
            found = [known for name, known in value.items() if name.startswith(prefix)]
            self.assertTrue(found, prefix)
            for known in found[:4]:
                self.assertLess(numpy.abs(drawn[kinds == kind] / known - 1).min(), 1e-12,
                                (kind, known, drawn[kinds == kind]))

    def test_not_asked(self):
        self.answered("solve", "elastica", "-f", "collocation", "-n", "2", "--shapes", code=2)
        run("verify", "-k", "elastica/default", "-o", self.path)
        with h5py.File(self.path) as file:
            self.assertNotIn("shapes", file["cases/elastica"])

    def read(self):
        reader = vtk.vtkHDFReader()
        self.assertTrue(reader.CanReadFile(self.path))
        reader.SetFileName(self.path)
        reader.Update()
        return reader.GetOutput()

    @unittest.skipIf(vtk is None, "needs python3-vtk9")
    def test_vtk(self):
        file, shapes, _ = self.solve("spherical_joint", "sheet_third", 1, "--shapes=1")
        self.assertEqual(list(file["VTKHDF"].attrs["Version"]), [1, 0])
        grid = self.read()
        points = shapes["position"].shape[1]
        self.assertEqual(grid.GetNumberOfPoints(), 3 * points)
        self.assertEqual(grid.GetNumberOfCells(), points)
        self.assertEqual(sorted({grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}),
                         [vtk.VTK_POLY_LINE, vtk.VTK_QUAD])
        along = []
        for i in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(i)
            if cell.GetCellType() == vtk.VTK_POLY_LINE:
                along += [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
        place = vtk_to_numpy(grid.GetPoints().GetData())
        numpy.testing.assert_array_equal(place[along], shapes["position"][-1])
        force = vtk_to_numpy(grid.GetPointData().GetArray("force (N, Qy, Qz)"))
        numpy.testing.assert_array_equal(force[along], shapes["force"][-1])
        area = vtk.vtkCellSizeFilter()
        area.SetInputData(grid)
        area.Update()
        covered = vtk_to_numpy(area.GetOutput().GetCellData().GetArray("Area")).sum()
        self.assertAlmostEqual(covered / (12 * 0.0681 * 0.0282), 1, delta=2e-3)

    def test_vtk_steps(self):
        file, shapes, _ = self.solve("sheet_cantilever", "sheet_third", 2, "--shapes")
        root = file["VTKHDF"]
        self.assertEqual(list(root.attrs["Version"]), [2, 0])
        steps, per_state = root["Steps"], int(root["NumberOfPoints"][0])
        count = int(steps.attrs["NSteps"])
        self.assertEqual(count, len(shapes["value"]))
        numpy.testing.assert_array_equal(steps["Values"], shapes["value"])
        self.assertTrue((numpy.diff(steps["Values"]) > 0).all())
        numpy.testing.assert_array_equal(steps["PointOffsets"], per_state * numpy.arange(count))
        for name in ("CellOffsets", "ConnectivityIdOffsets"):
            self.assertEqual(steps[name].shape, (count, 1))
            self.assertFalse(steps[name][()].any())
        self.assertEqual(set(steps["PointDataOffsets"]), set(root["PointData"]))
        self.assertEqual(set(steps["CellDataOffsets"]), set(root["CellData"]))
        self.assertEqual(len(root["Points"]), count * per_state)
        self.assertEqual(len(root["Offsets"]), root["NumberOfCells"][0] + 1)
        self.assertEqual(root["Offsets"][-1], root["NumberOfConnectivityIds"][0])
        centre = root["Connectivity"][:shapes["position"].shape[1]]
        for i in range(count):
            numpy.testing.assert_array_equal(root["Points"][()][i * per_state:][centre],
                                             shapes["position"][i])


if __name__ == "__main__":
    unittest.main()
