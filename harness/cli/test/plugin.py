"""External formulations for the tests of `--element`, compiled as an external author would compile them."""
import os
import subprocess

from harness.tools.kit.program import ROOT, ProgramTest

EXAMPLES = ROOT / "elements" / "examples"
WARNINGS = ("-Wall", "-Wextra", "-Werror")


def compile_shared(source, made, *options):
    subprocess.run([os.environ.get("CC", "cc"), "-O1", *options, "-shared", "-fPIC", "-I", ROOT,
                    source, "-lm", "-o", made],
                   check=True)
    return made


class PluginTest(ProgramTest):

    def compiled(self, text, name="mine.so"):
        source = self.folder / f"{name}.c"
        source.write_text(text, encoding="utf-8")
        return compile_shared(source, self.folder / name)

    def altered(self, example, *changes):
        """Compiles an example in which texts are replaced. Each text must occur in the example."""
        text = (EXAMPLES / example).read_text(encoding="utf-8")
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after, 1)
        return self.compiled(text)
