"""Features of peers, measured on small scenes: tests the closed forms, the words for the outcomes, and the page
with the results."""
import importlib
import json
import unittest
import unittest.mock

from harness.library.python.test.module import ModuleTest, bw
from harness.tools.kit.program import ROOT

features = None if bw is None else importlib.import_module("beamwork.peers._features")
rounds = None if bw is None else importlib.import_module("beamwork.peers._rounds")


class Features(ModuleTest):

    def test_closed_forms(self):
        """geometrically_exact with 32 elements must reproduce the closed form of every scene to 1e-5."""
        for name, _, make, exact in features.CASES:
            with self.subTest(name):
                self.assertAlmostEqual(make().solve("geometrically_exact", 32)["q"] / exact, 1, delta=1e-4 if name == "taper" else 1e-5)

    def outcome(self, *runs, missing=""):
        return features.outcome(rounds.Series("p", "e", "p, e", missing=missing, runs=list(runs)), 2.0)

    def test_words(self):
        def value(q):
            return {"elements": 1, "values": {"q": q}}
        self.assertEqual(self.outcome(value(2.1), value(2.001)), "works (0.05 %)")
        self.assertEqual(self.outcome(value(2.2), value(2.1)), "converges slowly (+5 %)")
        self.assertEqual(self.outcome(value(2.1), value(2.1)), "wrong by +5 %")
        self.assertEqual(self.outcome({"elements": 1, "refusal": "shear: none"}), "refused: shear: none")
        self.assertEqual(self.outcome({"elements": 1, "failure": "ended"}), "failed: ended")
        self.assertEqual(self.outcome({"elements": 1, "values": {}, "refused": {"q": "no"}}), "refused: no")
        self.assertEqual(self.outcome(missing="x is not installed"), "not installed")

    def test_tried(self):
        """With Exudyn, the motion of a rod that is rigid in shear must work."""
        peers = importlib.import_module("beamwork.peers")
        chosen = [("exudyn", "exact_3d", peers.load("exudyn").ELEMENTS["exact_3d"])]
        with unittest.mock.patch.object(features, "CASES", [case for case in features.CASES if case[0] == "motion"]):
            found = features.measure(chosen, peers.solve, 60, lambda text: None)
        outcome = found["rows"][0]["outcomes"]["motion"]
        if outcome == "not installed":
            self.skipTest(outcome)
        self.assertRegex(outcome, "^works")

    @unittest.skipUnless((ROOT / "reference" / "peers" / "features.json").is_file(), "no features are recorded")
    def test_page(self):
        """The page of the documentation must be that of the recorded features."""
        found = json.loads((ROOT / "reference" / "peers" / "features.json").read_text(encoding="utf-8"))
        page = (ROOT / "docs" / "reference" / "peer_features.md").read_text(encoding="utf-8")
        self.assertEqual(page, features.markdown(found))
        self.assertEqual(features.as_json(found), (ROOT / "reference" / "peers" / "features.json").read_text(encoding="utf-8"))
        self.assertEqual([f["name"] for f in found["features"]], [name for name, *_ in features.CASES])
