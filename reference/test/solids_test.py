"""Compares beams with solids, and tests beams on fork supports."""
import contextlib
import csv
import io
import pathlib
import tempfile
import unittest

import numpy as np

from reference.derive import fork_beams, linear_buckling, rederive
from reference.derive.beam import Beam
from reference.derive.equilibrium import singular_load
from reference.derive.network import Network
from reference.derive.solids import channel, deck, sheet
from reference.derive.solids.deck import BRICK, graded, spin, turned


TABLES = pathlib.Path(__file__).resolve().parents[1] / "tables"
needs_ccx = unittest.skipUnless(deck.available(), f"{deck.PROGRAM} is not installed")


def volume(grid):
    low, high = (
        grid.nodes[grid.elements[:, BRICK.index(corner)]] for corner in ((0, 0, 0), (2, 2, 2))
    )
    return np.prod(high - low, axis=1).sum()


class Meshes(unittest.TestCase):

    def test_a_channel_has_its_area(self):
        area = (
            2 * channel.WIDTH * channel.FLANGE + (channel.HEIGHT - 2 * channel.FLANGE) * channel.WEB
        )
        for mesh in channel.MESHES:
            self.assertAlmostEqual(volume(channel.channel(*mesh)), area * channel.LENGTH, places=12)

    def test_nodes_are_shared(self):
        grid = channel.channel(2, 1, 1)
        self.assertEqual(len({tuple(np.round(p, 9)) for p in grid.nodes}), len(grid.nodes))

    def test_grading(self):
        self.assertTrue(np.all(np.diff(graded(7)) > 0) and graded(7)[0] == 0 and graded(7)[-1] == 1)

    def test_spin(self):
        phi, change = np.array([0.3, -0.2, 0.5]), np.array([1e-6, 2e-6, -1e-6])
        turn = (turned(phi + change) - turned(phi - change)) / 2 @ turned(phi).T
        np.testing.assert_allclose(
            [turn[2, 1], turn[0, 2], turn[1, 0]], spin(phi) @ change, rtol=1e-8
        )


class Rows(unittest.TestCase):

    def test_every_row_of_a_solid_has_its_program(self):
        found = 0
        for path in TABLES.glob("*.csv"):
            with open(path, newline="", encoding="utf-8") as table:
                for row in csv.DictReader(table):
                    solid = row["source"].startswith("reference/derive/solids/")
                    self.assertEqual(solid, row["kind"] == "independent", row)
                    found += solid
        self.assertGreater(found, 400)

    def test_without_the_program_solids_are_skipped_by_name(self):
        kept, deck.PROGRAM, said = deck.PROGRAM, "no-such-program", io.StringIO()
        try:
            with contextlib.redirect_stdout(said):
                self.assertEqual(rederive.compare(["solids.sheet", "torsion"], False, False), 0)
        finally:
            deck.PROGRAM = kept
        self.assertRegex(said.getvalue(), r"solids\.sheet +skipped")
        self.assertIn("14 rows agree, 0 differ", said.getvalue())


@needs_ccx
class Sheet(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.sheet = sheet.Sheet(4, 1, self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def test_the_tangent_is_that_of_the_resultant(self):
        motion, T = np.array([-1.3e-3, 0.015, 1e-4, 0.1, 0.01, 0.15]), np.eye(6)
        T[3:, 3:] = spin(motion[3:])
        K = self.sheet.state(motion)[2] @ T
        scale = np.sqrt(np.abs(np.diag(K)))
        for i, step in ((0, 2e-6), (2, 5e-6), (3, 1e-3), (5, 1e-3)):
            force, moment, _ = self.sheet.state(motion + step * np.eye(6)[i])
            back, back_moment, _ = self.sheet.state(motion - step * np.eye(6)[i])
            slope = (np.concatenate([force, moment]) - np.concatenate([back, back_moment])) / (
                2 * step
            )
            self.assertLess(np.max(np.abs(slope - K[:, i]) / (scale * scale[i])), 1e-3, i)

    def test_at_rest(self):
        force, moment, K = self.sheet.state(np.zeros(6))
        self.assertLess(np.max(np.abs(np.concatenate([force, moment]))), 1e-6)
        np.testing.assert_allclose(K, K.T, atol=1e-6 * np.max(np.abs(K)))
        ratio = K[0, 0] * sheet.LENGTH / (sheet.YOUNG * sheet.WIDTH * sheet.THICKNESS)
        self.assertTrue(1 < ratio < 1 / (1 - sheet.POISSON**2), ratio)

    def test_anticlastic_stiffening(self):
        """Beam and plate must differ by 7.8 % in three stiffnesses of the straight sheet, as in N section 4.1."""
        for deviation in sheet.anticlastic():
            self.assertAlmostEqual(deviation, 0.078, delta=0.007)


def fork(place, along):
    """Returns the conditions of a fork at a fixed position (if free along x, without a force). The web R ez is normal to
    ey, the normal of the guides, and the only moment is that of the guides."""

    def conditions(level, x, R, force, moment, numbers):
        held = [force[0] if along else x[0] - place[0], x[1] - place[1], x[2] - place[2]]
        return np.array(held + [R[1, 2], moment[1], moment @ R[:, 2]])

    return conditions


def network_load(bracket, ratio, K):
    """Returns the critical dead force in the middle of a beam on two fork supports."""
    beam = Beam(0.5, EA=fork_beams.EA, EIy=ratio, EIz=1.0, GJ=1.0, EIw=1 / K if K else 0.0)
    net = Network(1.0, 1.0, intervals=3, nodes=14)
    first = net.body((0, 0, 0), fork((0, 0, 0), False))
    middle = net.body((0.5, 0, 0), lambda level, x, R, force, moment, numbers: np.concatenate(
        [force - level * np.array([0, 0, -1.0]), moment]))
    last = net.body((1, 0, 0), fork((1, 0, 0), True))
    net.member(beam, first, middle, (0, 0, 0), np.eye(3), ("free", "shared"))
    net.member(beam, middle, last, (0.5, 0, 0), np.eye(3), ("shared", "free"))
    return singular_load(net, *bracket)


class Forks(unittest.TestCase):

    def test_a_stiff_beam_stays_straight(self):
        for distributed, K, load, guess in ((False, 0, "mid", "16.9"), (True, 0, "mid_distributed",
                                                                        "28.3"),
                                            (True, 4, "mid_distributed", "52.7")):
            exact = float(linear_buckling.lateral_load(load, K, guess))
            value = fork_beams.critical_load(distributed, 1e6, K, (0.99 * exact, 1.01 * exact))
            self.assertLess(abs(value / exact - 1), 5e-6)
            self.assertGreater(abs(value / exact - 1), 1e-7)

    def test_the_exact_beam_between_forks(self):
        for load, ratio, K, bracket in fork_beams.CRITICAL:
            if load == "mid" and ratio == 10:
                self.assertLess(
                    abs(
                        network_load(bracket, ratio, K) / fork_beams.row(load, ratio, K, bracket) -
                        1), 1e-9)


if __name__ == "__main__":
    unittest.main()
