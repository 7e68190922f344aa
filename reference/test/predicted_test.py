"""Predicted limits of printed elements must equal the stored rows and, within 1e-6, closed forms.
With exact strains, they must equal exact values within 1e-10."""
import copy
import pathlib
import sys
import unittest
from unittest import mock

import numpy as np
from mpmath import diff, mpf, pi, sin

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import (  # noqa: E402
    cantilevers, channel_cantilever, column, equilibrium, predicted, predicted_beam, predicted_rows,
    rederive, sheets)
from reference.derive.beam import Beam  # noqa: E402
from reference.derive.network import Network, clamped  # noqa: E402
from reference.derive.predicted_beam import Printed  # noqa: E402
from reference.derive.predicted_column import compression, critical, pinned_square  # noqa: E402


def planar(name, GA):
    """Returns the network of shear_elastica, whose level is the load factor."""
    beam = Printed(Beam(1.0, EA=1e9, EIy=10.0, EIz=10.0, GJ=10.0, fy=1 / GA, fz=1 / GA), name)
    net = Network(1.0, 10.0, intervals=6)
    root = net.body((0, 0, 0), clamped((0.0, 0.0, 0.0)))
    tip = net.body((1, 0, 0), lambda level, x, R, force, moment, numbers: np.concatenate(
        [force - level * np.array([0, 1.0, 0]), moment]))
    net.member(beam, root, tip, (0, 0, 0), np.eye(3))
    return net


class Machinery(unittest.TestCase):

    def test_exact_strains_give_the_exact_beam(self):
        form = lambda beam: Printed(beam, predicted_beam.simo_reissner)  # noqa: E731
        exact = predicted_rows.exact_values()
        rows = [
            *sheets.cantilever(form=form), *sheets.twisted(form=form, tip_warping=1),
            *cantilevers.shear_elastica((50, ), form=form)
        ]
        for case, parameters, quantity, value, *_ in rows:
            known = exact[case, rederive.canonical(parameters), quantity][0]
            self.assertLess(abs(value / known - 1), 1e-10, (case, parameters, quantity))
        self.assertGreater(len(rows), 60)

    def test_other_intervals_and_nodes(self):
        def finer(*arguments, intervals=4, **options):
            return Network(*arguments, **{**options, "intervals": intervals + 3, "nodes": 17})

        def both(form):
            bent = sheets.cantilever(form=form, tip_deflection=0.05)
            return [*bent, *sheets.twisted(form=form, wagner=0)]

        for name in ("beamw", "sheet_second"):
            coarse = both(predicted.as_printed(name))
            with mock.patch("reference.derive.sheets.Network", finer):
                fine = both(predicted.as_printed(name))
            for one, two in zip(coarse, fine):
                self.assertLess(abs(one[3] / two[3] - 1), one[5], one[:3])

    def test_amplitude_between_the_nodes(self):
        for name, least, most in (("beamw_first", 0, 1e-10), ("beamw", 2e-7, 3e-7)):
            form = predicted.as_printed(name)
            nodes, between = (equilibrium.sheet_frequencies(3, {}, form, one)[2] for one in (0, 1))
            self.assertTrue(least <= abs(between / nodes - 1) < most, (name, nodes, between))

    def test_stored_rows(self):
        stored = predicted_rows.stored_rows(predicted.CASES)
        self.assertEqual({row["kind"] for row in stored.values()}, {"predicted"})
        (force, lateral), = channel_cantilever.path((0.25, ), form=predicted.as_printed("beamw"))
        given = [("beamw_vlasov", "c_cantilever", "w=0.25", "load_at_w", force, "N", 1e-9),
                 ("beamw", "c_cantilever", "w=0.25", "lateral", lateral, "m", 1e-9)]
        for name, points in (("sheet_second", sheets.cantilever), ("sheet_third", sheets.twisted)):
            rows = points(form=predicted.as_printed(name))
            given += [(name, *row) for row in rows]
        derived = [
            *predicted.derived_rows(predicted.CLOSED_FORMS), *map(predicted_rows.row_of, given)
        ]
        met = [row for row in derived if predicted_rows.key_of(row) in stored]
        self.assertGreater(len(met), 100)
        for row in met:
            self.assertIsNone(predicted_rows.difference(row, stored[predicted_rows.key_of(row)]),
                              row)

    def test_end_of_the_path(self):
        for name, end in (("beamw", 0.45130), ("beamw_first", 0.41987)):
            net, at, step = planar(name, 10), 0.0, 0.1
            while step > 8e-6:
                before = copy.deepcopy(net)
                try:
                    net.solve((at + step, ), tolerance=1e-9)
                    at += step
                except ArithmeticError:
                    net, step = before, step / 2
            self.assertAlmostEqual(at, end, delta=2e-5)


def cantilever_column(beam, level):
    """Returns the critical dead compression [N], near `level`, of a cantilever, which is half of a column on fork
    supports."""
    net = Network(beam.length, beam.EIz / beam.length ** 2, intervals=4, nodes=12)
    root = net.body((0, 0, 0), clamped((0.0, 0.0, 0.0)))
    tip = net.body((beam.length, 0, 0), lambda level, x, R, force, moment, numbers: np.concatenate(
        [force + level * np.array([1.0, 0, 0]), moment]))
    net.member(beam, root, tip, (0, 0, 0), np.eye(3), ("fixed", "free"))
    bracket = 0.96 * level / net.force, 1.03 * level / net.force
    return equilibrium.singular_load(net, *bracket) * net.force


class ClosedForms(unittest.TestCase):
    def test_c_column(self):
        s = column.channel_data(section_data="printed")
        names = "A Iy Iz It Iw ys Ip E G".split()
        A, Iy, Iz, It, Iw, ys, Ip, E, G = (float(getattr(s, name)) for name in names)
        shear = np.array((s.F / s.G).tolist(), dtype=float)
        beam = Beam(3.0,
                    EA=1e7 * E * A,
                    EIy=E * Iy,
                    EIz=E * Iz,
                    GJ=G * It,
                    EIw=E * Iw,
                    t=Ip / A + ys ** 2,
                    centre=(ys, 0.0),
                    shear=shear)
        for name in predicted.JONKER:
            closed = float(critical(s, mpf(6), 1, compression, name == "beamw")[1])
            load = cantilever_column(Printed(beam, name), closed)
            self.assertLess(abs(load / closed - 1), 1e-6, name)

    def test_right_angle(self):
        """Uniform shear z = pi/2 without rotation: the potential of N Eq. 7 with Phi must be stationary at GA = F."""
        EA, GA, F = mpf(10) ** 9, mpf(10), mpf(10)

        def potential(stretch, z):
            eps = stretch - 1 - z ** 2 / 2
            return EA * eps ** 2 / 2 + GA * z ** 2 / 2 - F * stretch * sin(z)

        rows = [row for row in predicted.right_angle() if row[3] == "v"]
        stretch, z = rows[0][4], pi / 2
        for order in ((1, 0), (0, 1)):
            self.assertLess(abs(diff(potential, (stretch, z), order)), 1e-12)
        self.assertGreater(abs(diff(potential, (stretch, z - mpf("1e-3")), (0, 1))), 1e-4)

    def test_pinned_square(self):
        young, shear, side = 12e9, 0.5e9, 0.09
        EI, GA = young * side ** 4 / 12, 5 / 6 * shear * side ** 2
        EA = 1e7 * young * side ** 2
        beam = Beam(0.35, EA=EA, EIy=EI, EIz=1.5 * EI, GJ=1.0, fy=1 / GA, fz=1 / GA)
        for name in ("beamw", "sheet_second", "beamw_first"):
            closed = float(pinned_square(0.7, side, young, shear, name != "beamw_first"))
            load = cantilever_column(Printed(beam, name), closed)
            self.assertLess(abs(load / closed - 1), 1e-6, name)


if __name__ == "__main__":
    unittest.main()
