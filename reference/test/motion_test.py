"""Derived motions must agree with other solutions of the equations."""
import unittest

import numpy as np
from mpmath import cosh, cos, mp, mpf
from scipy.integrate import solve_ivp

from reference.derive import (impulse, plane_motion, rederive, release, rigid_body, space_motion,
                              spin_up)


class RigidBody(unittest.TestCase):

    def test_elliptic_functions_solve_the_equations_of_motion(self):
        J = np.array([1.0, 2.0, 3.0])

        def rate(_, y):
            w, R = y[:3], y[3:].reshape(3, 3)
            spin = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
            return np.concatenate([np.cross(J * w, w) / J, (R @ spin).ravel()])

        times = (1.0, 5.0)
        found = solve_ivp(rate, (0, 5), [0.5, 0.2, 2.0, *np.eye(3).ravel()], "DOP853",
                          t_eval=times, rtol=1e-13, atol=1e-14).y.T
        for t, y in zip(times, found):
            exact = [*map(float, rigid_body.rates(mpf(t))),
                     *map(float, rigid_body.orientation(mpf(t)))]
            self.assertLess(np.max(np.abs(y - exact)), 1e-10)

    def test_rows_at_rest_are_the_start(self):
        rows = {row[2]: row[3] for row in rigid_body.rows() if row[1].startswith("time=0;")}
        self.assertEqual((float(rows["w_x"]), float(rows["R_xy"])), (0.5, 0.0))


class Release(unittest.TestCase):

    def test_shares_of_bernoulli_add_up(self):
        modes = release.bernoulli_modes(60)
        self.assertLess(max(abs(1 + cos(x) * cosh(x)) / cosh(x) for x in modes), mpf(10)**-25)
        self.assertLess(abs(release.bernoulli(0, modes) - 1), 1e-6)

    def test_slender_timoshenko_is_bernoulli(self):
        thick = release.timoshenko_modes(3)[0]
        thin = np.array([float(x**2) for x in release.bernoulli_modes(3)]) * np.sqrt(
            release.EI / (release.DENSITY * release.AREA))
        lower = 1 - thick / thin
        self.assertTrue(0.005 < lower[0] < 0.02 and lower[0] < lower[1] < lower[2], lower)

    def test_shares_of_timoshenko_add_up(self):
        _, shares = release.timoshenko_modes(40)
        self.assertTrue(0 < 1 - np.sum(shares) < 1e-4)


class Plane(unittest.TestCase):

    def test_pendulum_is_that_of_two_other_programs(self):
        found, apart = plane_motion.swing(("0.125", ))
        self.assertLess(np.max(np.abs(found[0, 2:] - [0.9916559559, -0.0702880662])), 1e-6)
        self.assertLess(np.max(apart), 1e-7)

    def test_angular_momentum_behind_the_step(self):
        energy, momentum = plane_motion.behind_step(4, 8)
        self.assertLess(abs(momentum + 229.5182), 0.05)
        self.assertLess(abs(energy - 379.7), 2)

    def test_momentum_of_the_thrown_rod(self):
        rod = plane_motion.THROWN
        mesh = plane_motion.Mesh(rod, 4, 6)
        rng = np.random.default_rng(1)
        q = rng.standard_normal((3, len(mesh.S)))
        force = plane_motion.forces(rod, mesh, q)
        self.assertLess(np.max(np.abs(force[:2].sum(axis=1))), 1e-9 * np.max(np.abs(force)))


class Space(unittest.TestCase):

    def check(self, case, names, found):
        stored, at = rederive.read_stored(), f"time=1;{space_motion.ANY}"
        for name, value in zip(names, found):
            asked = {"case": case, "parameters": at, "quantity": name, "at": "",
                     "formulation": "", "kind": space_motion.KIND}
            row = stored[rederive.key_of("tables", asked)]
            self.assertLess(abs(value - float(row["value"])), max(1e-8, float(row["uncertainty"])),
                            name)

    def test_thrown_rod_is_that_of_two_other_programs(self):
        self.check("free_flight_space", ("A_x", "A_y", "A_z", "B_x", "B_y", "B_z"),
                   space_motion.flight(8, 8, ("1", ))[0])

    def test_elbow_is_that_of_two_other_programs(self):
        self.check("elbow", ("elbow_x", "elbow_y", "elbow_z", "tip_x", "tip_y", "tip_z"),
                   space_motion.elbow(3, 8, ("1", ))[0])

    def test_free_of_load_the_energy_stays(self):
        mesh = space_motion.Mesh(space_motion.THROWN, 3, 5)
        rng = np.random.default_rng(1)
        U, S = rng.standard_normal((6, mesh.nodes)), rng.standard_normal((6, mesh.points))
        step = 1e-3
        dU, dS = (step * d for d in mesh.rates(U, S, 0))
        change = mesh.energy(U + dU, S + dS) - mesh.energy(U - dU, S - dS)
        parts = mesh.energy(U + dU, S) - mesh.energy(U - dU, S)
        self.assertGreater(abs(parts), 1e-3)
        self.assertLess(abs(change), 1e-10 * abs(parts))

    def test_another_integrator(self):
        mesh = space_motion.Mesh(space_motion.THROWN, 2, 4)
        explicit, implicit = (space_motion.move(mesh, [0.5], method)[0]
                              for method in ("DOP853", "Radau"))
        for one, other in zip(explicit, implicit):
            self.assertLess(np.max(np.abs(one - other)), 1e-7)


class Closed(unittest.TestCase):

    def test_stretch_and_impulse(self):
        first = mpf("1.2") * 36 * 1000 / (3 * mpf("2.8e7"))
        self.assertLess(abs(spin_up.stretch(6, mpf(10), "1.2", "2.8e7") / first - 1), 1e-4)
        self.assertEqual((impulse.plane(), impulse.space()), (20, 50))
        self.assertGreaterEqual(mp.dps, 15)


if __name__ == "__main__":
    unittest.main()
