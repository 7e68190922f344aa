"""The element interface in other languages: the headers must compile in C and C++ without warnings, the Fortran
module must have their layout and constants, and the example in Rust must give the results of that in C."""
import os
import re
import shutil
import subprocess
import unittest

from harness.cli.test.plugin import compile_shared
from harness.tools.kit.program import ROOT, ProgramTest

STRICT = ("-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror")
MODULE = ROOT / "elements" / "examples" / "timoshenko.f90"
STANDARD = "#include <cmath>\n#include <complex>\n#include <string>\n#include <vector>\n"
EXPORTED = """#include "elements/element.h"
static int of(void)
{
    return ELEMENT_ABI;
}
const element_type beamwork_element = {(unsigned)of()};
"""


def public_headers():
    out = subprocess.run(["cc", "-I.", "-M", "-xc", "-"], cwd=ROOT, check=True, text=True,
                         input='#include "elements/element.h"\n', stdout=subprocess.PIPE).stdout
    return [word for word in out.split() if word.startswith("elements/")]


class Headers(ProgramTest):
    def compiles(self, compiler, standard, ending):
        if shutil.which(compiler) is None:
            self.skipTest(f"needs {compiler}")
        headers = public_headers()
        self.assertGreater(len(headers), 5)
        for header in headers:
            self.compile(compiler, standard, ending, f'#include "{header}"\n' * 2)

    def compiles_beside(self, compiler):
        line = '#include "elements/element.h"\n'
        self.compile(compiler, "-std=c++20", "cpp", line + STANDARD)
        self.compile(compiler, "-std=c++17", "cpp", STANDARD + "using namespace std;\n" + line)

    def compile(self, compiler, standard, ending, text, *options):
        source = self.folder / f"one.{ending}"
        source.write_text(text, encoding="utf-8")
        done = subprocess.run([compiler, standard, *STRICT, *(options or ["-fsyntax-only"]), "-I",
                               ROOT, source], check=False, text=True, stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, done.stderr), (0, ""), text)

    def test_gcc(self):
        self.compiles("gcc", "-std=c11", "c")

    def test_clang(self):
        self.compiles("clang-19", "-std=c11", "c")

    def test_gcc_of_cplusplus(self):
        self.compiles("g++", "-std=c++17", "cpp")
        self.compiles_beside("g++")

    def test_clang_of_cplusplus(self):
        self.compiles("clang++-19", "-std=c++17", "cpp")
        self.compiles_beside("clang++-19")

    def test_exports(self):
        for compiler in ("g++", "clang++-19"):
            if shutil.which(compiler) is None:
                self.skipTest(f"needs {compiler}")
            made = self.folder / "one.so"
            self.compile(compiler, "-std=c++17", "cpp", EXPORTED, "-fvisibility=hidden", "-shared",
                         "-fPIC", "-Wno-missing-field-initializers", "-o", made)
            out = subprocess.run(["nm", "-D", "--defined-only", made], check=True, text=True,
                                 stdout=subprocess.PIPE).stdout
            self.assertEqual([line.split()[-1] for line in out.splitlines()], ["beamwork_element"])


@unittest.skipIf(shutil.which("gfortran") is None, "needs gfortran")
class Fortran(ProgramTest):
    @classmethod
    def setUpClass(cls):
        text = MODULE.read_text(encoding="utf-8")
        cls.module = text[text.index("\nmodule beamwork\n"):text.index("end module")]
        code = re.sub(r"!.*", "", cls.module).replace("&\n", "")
        cls.constants = [pair for block in re.findall(r"enum, bind.*?end enum", code, re.S)
                         for pair in re.findall(r"(\w+) = (\d+)", block)]
        cls.types = {name: cls.members(block) for name, block in
                     re.findall(r"type, bind\(c\) :: (\w+)(.*?)end type", code, re.S)}

    @staticmethod
    def members(block):
        found = []
        for line in block.splitlines():
            if "::" in line:
                names = re.sub(r"\([^()]*\)", "", line.partition("::")[2])
                found += [name.partition("=")[0].strip() for name in names.split(",")]
        return found

    def printed(self, compiler, source, text):
        (self.folder / source).write_text(text, encoding="utf-8")
        subprocess.run([compiler, "-I", ROOT, source, "-o", "one"], cwd=self.folder, check=True)
        out = subprocess.run([self.folder / "one"], check=True, text=True,
                             stdout=subprocess.PIPE).stdout
        return [int(line) for line in out.split()]

    def test_layout(self):
        self.assertEqual(len(self.types), 10)
        self.assertGreater(sum(map(len, self.types.values())), 80)
        variables = "".join(f"type({name}), target :: v_{name}\n" for name in self.types)
        theirs = "".join(
            f"print *, c_sizeof(v_{name})\n" + "".join(
                f"print *, at(c_loc(v_{name}%{member})) - at(c_loc(v_{name}))\n" for member in all_)
            for name, all_ in self.types.items())
        ours = "".join(
            f"    put(sizeof({name}));\n" + "".join(
                f"    put(offsetof({name}, {member.rstrip('_')}));\n" for member in all_)
            for name, all_ in self.types.items())
        self.assertEqual(
            self.printed("gfortran", "one.f90", self.module + "end module\nprogram one\n"
                         "use beamwork\n" + variables + theirs +
                         "contains\ninteger(c_intptr_t) function at(p)\ntype(c_ptr) :: p\n"
                         "at = transfer(p, at)\nend function\nend program\n"),
            self.printed("cc", "one.c", '#include <stdio.h>\n#include "elements/element.h"\n'
                         "static void put(size_t n)\n{\n    printf(\"%zu\\n\", n);\n}\n"
                         "int main(void)\n{\n" + ours + "}\n"))

    def test_constants(self):
        self.assertGreater(len(self.constants), 20)
        lines = "".join(f"    printf(\"%d\\n\", (int){name.upper()});\n" for name, _ in self.constants)
        self.assertEqual(self.printed("cc", "one.c", '#include <stdio.h>\n#include "elements/element.h"\n'
                                      "int main(void)\n{\n" + lines + "}\n"),
                         [int(value) for _, value in self.constants])
        self.assertIn("status_ok, status_not_converged, status_singular, status_refused",
                      self.module)
        abi = re.search(r"ELEMENT_ABI = (\d+)", (ROOT / "elements" / "element.h").read_text("utf-8"))
        self.assertIn(f"abi = {abi[1]}\n", self.module)


@unittest.skipIf(shutil.which("rustc") is None, "needs rustc")
class Rust(ProgramTest):

    def test_example(self):
        made = self.folder / "timoshenko_rs.so"
        done = subprocess.run(["rustc", "-O", "--crate-type", "cdylib", MODULE.with_suffix(".rs"), "-o", made], cwd=self.folder,
                              env={k: v for k, v in os.environ.items() if "MAKE" not in k and k != "MFLAGS"},
                              check=False, text=True, stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.answered("element-test", "--element", made)
        there = compile_shared(MODULE.with_suffix(".c"), self.folder / "timoshenko.so")
        found, expected = (
            {q["quantity"]: q["value"]
             for q in self.record("solve", "bend_45", "-f", name, "-n", 4, "--element", element)["quantities"]}
            for name, element in (("timoshenko_rs", made), ("timoshenko", there)))
        self.assertGreater(len(expected), 2)
        for name, value in expected.items():
            self.assertAlmostEqual(found[name] / value, 1, delta=1e-9, msg=name)
