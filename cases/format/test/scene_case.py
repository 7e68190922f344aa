"""Functions shared by tests of scene files."""
from harness.tools.kit.program import ROOT, ProgramTest, values

EXAMPLES = ROOT / "cases/examples"


class SceneCase(ProgramTest):
    def scene(self, text, name="scene.yaml"):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def same_again(self, path, *where):
        again = self.scene(self.answered("scene", "--scene", path).stdout, f"{path.stem}_again.yaml")
        got, twice = (values(self.record("solve", "--scene", p, *where)) for p in (path, again))
        self.assertEqual(got, twice)
        return got
