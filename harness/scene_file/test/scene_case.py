"""What tests of scene files share."""
from harness.test.program import ROOT, ProgramTest

EXAMPLES = ROOT / "cases/examples"


def values(record):
    """Quantity -> value as it was written, every bit of it."""
    return {q["quantity"]: q["value"] for q in record["quantities"]}


class SceneCase(ProgramTest):
    """A test that writes scenes."""

    def scene(self, text, name="scene.yaml"):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path
