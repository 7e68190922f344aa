"""The notebooks must run in Jupyter and as scripts, and reproduce their statements."""
import importlib.util
import os
import subprocess
import sys
import time
import unittest
from unittest import mock

from harness.library.python.test.module import FOLDER, SETTINGS, ModuleTest
from harness.tools.kit.program import environment, read_json

NOTEBOOK = FOLDER / "sheet_flexures.ipynb"
SAID = {NOTEBOOK: "for 1 % in every quantity", FOLDER / "own_mechanism.ipynb": "resonance 11.2",
        FOLDER / "thin_walled_tables.ipynb": "beamw_consistent with 64 elements: +0.00 %"}
NEEDS = [name for name in ("nbclient", "nbformat", "ipykernel", "matplotlib")
         if importlib.util.find_spec(name) is None]


def words_of(cell):
    shown = []
    for output in cell["outputs"]:
        shown.append(output.get("text", ""))
        shown += [str(text) for kind, text in output.get("data", {}).items() if "image" not in kind]
    return "\n".join(shown)


class Notebook(ModuleTest):

    def test_stored_without_outputs(self):
        self.assertEqual(set(FOLDER.glob("*.ipynb")), set(SAID))
        for path in SAID:
            code = [cell for cell in read_json(path)["cells"] if cell["cell_type"] == "code"]
            self.assertGreaterEqual(len(code), 5)
            self.assertEqual([cell["outputs"] for cell in code], [[]] * len(code))

    @unittest.skipIf(NEEDS, f"needs {', '.join(NEEDS)}")
    def test_in_jupyter(self):
        import nbclient  # pylint: disable=import-outside-toplevel
        import nbformat  # pylint: disable=import-outside-toplevel
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        with mock.patch.dict(os.environ, self.settings()):
            nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3",
                                    resources={"metadata": {"path": str(FOLDER)}}).execute()
        code = [cell for cell in notebook.cells if cell.cell_type == "code"]
        images = [output for cell in code for output in cell.outputs
                  if "image/png" in output.get("data", {})]
        self.assertEqual(len(images), 3)
        told = [words_of(cell) for cell in code]
        claims = next(text for text in told if "N says" in text)
        self.assertEqual((claims.count("<td>reproduced</td>"), claims.count("<td>not reproduced</td>")),
                         (7, 1))
        limits = next(text for text in told if "derived from the equations" in text)
        for word in ("+0.25812 %", "+0.12193 %", "-0.03620 %"):
            self.assertIn(word, limits)
        self.assertTrue(any("for 1 % in every quantity" in text and "sheet_third n = 1 (" in text
                            for text in told))

    @unittest.skipIf(NEEDS, f"needs {', '.join(NEEDS)}")
    def test_interrupted(self):
        from jupyter_client.manager import run_kernel  # pylint: disable=import-outside-toplevel
        with mock.patch.dict(os.environ, self.settings()), run_kernel() as client:
            self.assertEqual(self.asked(client, "import beamwork as bw, numpy, os\n"
                                        "numpy.linalg.inv(numpy.eye(400) + 1)\n"
                                        "s = bw.Scene.case('elastica')\n"
                                        "assert s.verify('collocation', jobs=2).passed"), "ok")
            long = client.execute("print('go'); bw.verify(refine=3)")
            while client.get_iopub_msg(timeout=60)["msg_type"] != "stream":
                pass
            time.sleep(0.5)
            client.parent.interrupt_kernel()
            self.assertEqual(self.reply(client, long), "KeyboardInterrupt")
            time.sleep(0.5)
            self.assertEqual(self.asked(client, "assert s.solve('beamw', 1)['w_over_L'] > 0"), "ok")
            self.assertEqual(self.asked(client, "os.waitpid(-1, os.WNOHANG)"), "ChildProcessError")

    def settings(self):
        return {**SETTINGS, "MPLCONFIGDIR": str(self.folder), "IPYTHONDIR": str(self.folder),
                "PYDEVD_DISABLE_FILE_VALIDATION": "1"}

    @staticmethod
    def reply(client, request):
        while True:
            message = client.get_shell_msg(timeout=100)
            if message["parent_header"].get("msg_id") == request:
                return message["content"].get("ename", message["content"]["status"])

    def asked(self, client, code):
        return self.reply(client, client.execute(code))

    @unittest.skipIf("matplotlib" in NEEDS, "needs matplotlib")
    def test_as_a_script(self):
        for notebook, words in SAID.items():
            path = self.folder / "script.py"
            path.write_text("\n".join("".join(cell["source"]) for cell in read_json(notebook)["cells"]
                                      if cell["cell_type"] == "code"), encoding="utf-8")
            done = subprocess.run([sys.executable, path], text=True, check=False, cwd=self.folder,
                                  env=environment(**SETTINGS, MPLBACKEND="Agg", MPLCONFIGDIR=str(self.folder)),
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(words, done.stdout)


if __name__ == "__main__":
    unittest.main()
