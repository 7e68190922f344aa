"""External formulations, compiled in the way an external author would compile them, for the tests of `--element`."""
import os
import subprocess

from harness.tools.kit.program import ROOT, ProgramTest

EXAMPLES = ROOT / "elements" / "examples"
WARNINGS = ("-Wall", "-Wextra", "-Werror")


def compile_shared(source, made, *options):
    """Compiles this file to a shared object with only the public headers."""
    subprocess.run([os.environ.get("CC", "cc"), "-O1", *options, "-shared", "-fPIC", "-I", ROOT,
                    source, "-lm", "-o", made],
                   check=True)
    return made


class PluginTest(ProgramTest):

    def compiled(self, text, name="mine.so"):
        """Returns the path of a shared object compiled from this text."""
        source = self.folder / f"{name}.c"
        source.write_text(text, encoding="utf-8")
        return compile_shared(source, self.folder / name)

    def altered(self, example, *changes):
        """Returns an example with parts of its text replaced. Each part must occur."""
        text = (EXAMPLES / example).read_text(encoding="utf-8")
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after, 1)
        return self.compiled(text)
