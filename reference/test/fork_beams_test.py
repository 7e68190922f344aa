"""Fork-ended beams in their bent state against linear prestress and against the exact beam of network.py."""
import unittest

import numpy as np

from reference.derive import fork_beams, linear_buckling
from reference.derive.beam import Beam
from reference.derive.equilibrium import singular_load
from reference.derive.network import Network


def fork(place, along):
    """Held at a place (free along x: no force), web R ez across the guides' normal ey, no moment but that of the guides."""

    def conditions(level, x, R, force, moment, numbers):
        held = [force[0] if along else x[0] - place[0], x[1] - place[1], x[2] - place[2]]
        return np.array(held + [R[1, 2], moment[1], moment @ R[:, 2]])

    return conditions


def network_load(bracket, ratio, K):
    """Two members, and a dead force on the body between them."""
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
        """Linear prestress is the limit of large EIy/EIz; the difference is of order EIz/EIy."""
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
