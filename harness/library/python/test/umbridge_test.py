"""beamwork as a model of UM-Bridge: values must equal those of the module, and errors must have the types of protocol
1.0."""
import importlib
import json
import threading
import unittest
import urllib.error
import urllib.request

from harness.library.python.test.module import ModuleTest, bw

try:
    import umbridge as client
except ImportError:
    client = None

umbridge = None if bw is None else importlib.import_module("beamwork.umbridge")
VALUES = {"length": 3.0, "young": 2.0e11}


class Served(ModuleTest):

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = bw.Scene.case("c_column")
        model = umbridge.Model(cls.scene, list(VALUES), ["buckling_load", "frequency_1"], "sheet_second", 2)
        cls.server = umbridge.server(model, port=0)
        cls.url = f"http://localhost:{cls.server.server_port}"
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.addClassCleanup(cls.server.server_close)
        cls.addClassCleanup(cls.server.shutdown)

    def ask(self, path, **content):
        request = urllib.request.Request(f"{self.url}/{path}", json.dumps(content).encode() if content else None)
        try:
            with urllib.request.urlopen(request, timeout=60) as found:
                return found.status, json.load(found)
        except urllib.error.HTTPError as why:
            return why.code, json.load(why)

    def evaluate(self, values, **config):
        return self.ask("Evaluate", name="forward", input=values, config=config)

    def test_description(self):
        self.assertEqual(self.ask("Info"), (200, {"protocolVersion": 1.0, "models": ["forward"]}))
        self.assertEqual(self.ask("InputSizes", name="forward")[1], {"inputSizes": [2]})
        self.assertEqual(self.ask("OutputSizes", name="forward")[1], {"outputSizes": [2]})
        self.assertEqual(self.ask("ModelInfo", name="forward")[1]["support"],
                         {"Evaluate": True, "Gradient": False, "ApplyJacobian": False, "ApplyHessian": False})

    def test_values(self):
        for config in ({}, {"elements": 4}, {"formulation": "beamw", "shear": 0}, {}):
            others = {k: v for k, v in config.items() if k == "shear"}
            scene = self.scene.copy().set(**VALUES, **others)
            result = scene.solve(config.get("formulation", "sheet_second"), config.get("elements", 2))
            self.assertEqual(self.evaluate([list(VALUES.values())], **config),
                             (200, {"output": [[result["buckling_load"], result["frequency_1"]]]}))

    def test_errors(self):
        good = [list(VALUES.values())]
        for found, status, kind, words in (
                (self.ask("Evaluate", name="inverse", input=good), 400, "ModelNotFound", "'forward'"),
                (self.ask("Gradient", name="forward"), 400, "UnsupportedFeature", "Gradient"),
                (self.evaluate([[1.0]]), 400, "InvalidInput", "length, young"),
                (self.evaluate(3), 400, "InvalidInput", "2 numbers"),
                (self.evaluate([["a", 1]]), 400, "InvalidInput", "a number"),
                (self.evaluate([[-1.0, 2e11]]), 400, "InvalidInput", "parameter length of c_column: -1 m"),
                (self.evaluate(good, formulation="none"), 400, "InvalidInput", "unknown formulation 'none'"),
                (self.evaluate(good, elements="x"), 400, "InvalidInput", "elements"),
                (self.evaluate(good, colour=1), 400, "InvalidInput", "colour")):
            self.assertEqual((found[0], found[1]["error"]["type"]), (status, kind), found)
            self.assertIn(words, found[1]["error"]["message"])

    def test_no_value(self):
        model = umbridge.Model(self.scene, ["length"], ["frequency_13"], "sheet_second", 2)
        with self.assertRaises(umbridge.Invalid) as caught:
            model.evaluate([[1.0]], {"width": 1.0, "height": 1.0})
        self.assertEqual((caught.exception.kind, caught.exception.status), ("InvalidOutput", 500))

    def test_unknown_names(self):
        with self.assertRaisesRegex(ValueError, "quantity 'weight' does not exist; the scene has: buckling_load"):
            umbridge.Model(self.scene, outputs=["weight"])

    @unittest.skipIf(client is None, "needs umbridge (pip install umbridge)")
    def test_their_client(self):
        model = client.HTTPModel(self.url, "forward")
        result = self.scene.copy().set(**VALUES).solve("sheet_second", 4)
        self.assertEqual(model.get_input_sizes(), [2])
        self.assertEqual(model([list(VALUES.values())], {"elements": 4}), [[result["buckling_load"], result["frequency_1"]]])


if __name__ == "__main__":
    unittest.main()
