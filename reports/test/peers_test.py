"""Diagrams, profiles and parts of pages must agree with artificial comparisons of programs. The recorded files must be
valid."""
import json
import math
import pathlib
import tempfile
import types
import unittest
import unittest.mock

from reports import data, peers, peers_data


def run(n, error, time, **more):
    return {"elements": n, "unknowns": 6 * n, "systems": 5, "setup": 1.0, "times": {"bent": time, "": 2 * time}, "errors": {"u": error},
            "values": {"u": 1 + error}, **more}


def series(name, runs, ours=False, **more):
    return {"name": name, "ours": ours, "version": "1", "missing": "", "settings": "", "other_model": "", "refused": {}, "verdicts": {},
            "runs": runs, **more}


def record(case="c", *all_series, parameters="", unit="a"):
    return {"beamwork_peers": 1, "case": case, "parameters": parameters, "beamwork": "0", "date": "2026-01-01", "rounds": 3,
            "unit": {"name": unit, "ours": True, "elements": 1}, "series": list(all_series),
            "quantities": [{"name": "u", "unit": "m", "analysis": "bent", "truth": 1.0, "kind": "exact", "meaning": ""}]}


def two():
    """Returns two comparisons. In the first, a formulation is twice as fast as the other program. In the second, the
    formulation is half as fast."""
    slow = series("P, x", [run(1, 1e-3, 2.0), run(2, 1e-5, 4.0)])
    fast = series("P, x", [run(1, 1e-3, 0.5), run(2, 1e-5, 1.0)])
    ours = series("a", [run(1, 1e-3, 1.0), run(2, 1e-5, 2.0)], True)
    return [record("first", ours, slow), record("second", ours, fast)]


class Beside(unittest.TestCase):
    """Tests other programs in the figure of error against run time."""

    def setUp(self):
        mesh = data.Mesh(1, "ok", "", data.Clock(0, 1, 1, 1, 1), 8, 4, "", {}, cost=3e-3)
        self.point = data.Point("default", "", [data.Series("a", "", "", "", [mesh], [])], {})
        self.site = types.SimpleNamespace(peers=(), styles=None)

    def of(self, *records, name="u", case="first"):
        with unittest.mock.patch.object(peers, "found", lambda site: list(records)):
            return peers.beside(self.site, types.SimpleNamespace(name=case), self.point, name)

    def test_times_are_converted(self):
        """The run that is the unit of time takes 1 in the record and costs 3 ms in the results."""
        one, = self.of(*two())
        self.assertEqual((one.name, [(t, e, row[0]) for t, e, row in one.points]), ("P, x", [(6e-3, 1e-3, 1), (12e-3, 1e-5, 2)]))

    def test_nothing_to_compare(self):
        self.assertEqual(self.of(*two(), name="v"), [])
        self.assertEqual(self.of(*two(), case="third"), [])
        self.assertEqual(self.of({**two()[0], "parameters": "x=1"}), [])
        self.assertEqual(self.of({**two()[0], "unit": {"name": "b", "ours": True, "elements": 1}}), [])


class Data(unittest.TestCase):

    def test_diagram(self):
        found = peers_data.diagram(two()[0], two()[0]["quantities"][0])
        self.assertEqual(found["curves"], {"a": [(1.0, 1e-3, 1), (2.0, 1e-5, 2)], "P, x": [(2.0, 1e-3, 1), (4.0, 1e-5, 2)]})
        self.assertEqual(found["front"], [(1.0, 1e-3, "a"), (2.0, 1e-5, "a")])

    def test_profile(self):
        """A program that is twice as slow as the fastest in a case must have the factor 2 there, and otherwise 1."""
        found = peers_data.factors(two(), 1e-2)
        self.assertEqual(found["beamwork"], [(1.0, 1.0), (2.0, 1.0)])
        self.assertEqual(found["P"], [(2.0, 1.0), (1.0, 1.0)])
        self.assertEqual(found["a"], found["beamwork"])

    def test_not_solved(self):
        refused = series("Q, y", [{"elements": 1, "refusal": "no"}])
        found = peers_data.factors([record("c", *two()[0]["series"], refused)], 1e-2)
        self.assertEqual(found["Q"], [(math.inf, 1.0)])
        self.assertEqual([why for s, why in peers_data.outcomes(record("c", refused))], ["no"])

    def test_without_times(self):
        """A program without times must not be in profiles."""
        old = series("Q, y", [{**run(1, 1e-5, 1.0), "times": {}}])
        self.assertNotIn("Q", peers_data.factors([record("c", *two()[0]["series"], old)], 1e-2))

    def test_ahead(self):
        found = peers_data.ahead(two())
        self.assertEqual({(r["case"], level) for r, _, level, _ in found}, {("second", level) for level in peers_data.LEVELS})

    def test_recorded_and_live(self):
        """Recorded files must give the same diagrams as the live comparison, which also contains absolute times."""
        live = two()[0]
        live["unit"]["seconds"] = 1e-4
        with tempfile.TemporaryDirectory() as folder:
            stored = json.loads(json.dumps(live))
            del stored["unit"]["seconds"]
            pathlib.Path(folder, "first.json").write_text(json.dumps(stored), encoding="utf-8")
            read, = peers_data.records(folder=folder)
        q = live["quantities"][0]
        self.assertEqual(peers_data.diagram(read, q), peers_data.diagram(live, q))
        self.assertEqual(peers_data.factors([read], 1e-2), peers_data.factors([live], 1e-2))

    def test_merged(self):
        """Times of a second record of a case must be converted by a run of beamwork that both records contain. The
        times must be omitted if there is no such run."""
        first, second = two()[0], record("first", series("a", [run(2, 1e-5, 1.0)], True), series("Q, y", [run(1, 1e-4, 3.0)]))
        second["unit"] = {"name": "a", "ours": True, "elements": 2}
        both = peers_data.ranking.merged(first, second)
        self.assertEqual([s["name"] for s in both["series"]], ["a", "P, x", "Q, y"])
        self.assertEqual(both["series"][-1]["runs"][0]["times"]["bent"], 3.0 * first["series"][0]["runs"][1]["times"][""])
        second["unit"]["elements"] = 7
        self.assertEqual(peers_data.ranking.merged(first, second)["series"][-1]["runs"][0]["times"], {})


class Recorded(unittest.TestCase):
    """Recorded comparisons (reference/peers) must contain no absolute times, and their tables must be sorted."""

    def test_files(self):
        found = peers_data.records()
        self.assertTrue(found)
        for one in found:
            with self.subTest(one["case"]):
                self.assertNotIn("seconds", json.dumps(one["unit"]))
                self.assertTrue(any(s["ours"] for s in one["series"]) and not all(s["ours"] for s in one["series"]))
                for q in peers_data.known(one):
                    self.assertTrue(peers_data.diagram(one, q)["curves"], q["name"])
                    for level, ranked, shown in peers.rows_of(one, q):
                        self.assertTrue(all(r["error"] is not None and abs(r["error"]) <= level for _, r in shown))
                        self.assertEqual([p for p, _ in shown], sorted(p for p, _ in shown))
