"""The installed files, and the documentation pages of the interfaces."""
import importlib
import importlib.util
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
import unittest

from harness.tools.kit.program import PROGRAM, ProgramTest, ROOT, run
from harness.tools.shown_commands import reader_file


HERE = pathlib.Path(__file__).parent
BUILD = pathlib.Path(PROGRAM).parent
SECONDS = re.compile(r'"seconds_\w+": [^,\n]+')


def variables():
    given = shlex.split(os.environ.get("MAKEFLAGS", "").partition(" -- ")[2])
    return [f"BUILD={os.path.relpath(BUILD, ROOT)}", *(word for word in given if "=" in word)]


def clean():
    """Returns the environment without the variables of make, so that its job slots are not used, and without those of
    beamwork."""
    return {name: value for name, value in os.environ.items()
            if not name.startswith(("MAKE", "BEAMWORK"))}


def make(*arguments):
    return subprocess.run(["make", "--no-print-directory", *variables(), *arguments],
                          cwd=ROOT, env=clean(), text=True, check=False, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)


def is_sanitized():
    return b"__asan_" in (BUILD / "libbeamwork.so.0").read_bytes()


@unittest.skipIf(is_sanitized(), "programs of others are built without sanitizers")
class Installed(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.place = cls.class_folder() / "a place"
        done = make("install", f"DESTDIR={cls.place}", "PREFIX=/usr/local")
        assert done.returncode == 0, done.stdout
        cls.root = cls.place / "usr" / "local"
        cls.data = cls.root / "share" / "beamwork"
        cls.program = str(cls.root / "bin" / "beamwork")
        cls.clean = clean()

    def installed(self, *arguments, program=None, code=0, **changes):
        done = run(*arguments, program=program or self.program, cwd=self.folder,
                   env={**self.clean, **changes})
        self.assertEqual(done.returncode, code, (arguments, done.stdout[-400:], done.stderr))
        return done.stdout

    def flags(self, *options):
        text = self.installed("--define-variable=prefix=" + str(self.root).replace(" ", r"\ "),
                              *options, "beamwork", program="pkg-config",
                              PKG_CONFIG_PATH=str(self.root / "lib" / "pkgconfig"))
        return shlex.split(text)

    def compiled(self, *command):
        source = self.folder / "consumer.c"
        shutil.copy(HERE / "consumer" / "consumer.c", source)
        self.installed("-Wall", "-Wextra", "-Werror", *command[1:], "-o", "consumer",
                       program=command[0])

    def check(self, program="./consumer", **changes):
        text = self.installed(program=str(self.folder / program), **changes)
        version, *_ = text.splitlines()
        self.assertIn(version.split()[1], self.installed("--version"))
        self.assertIn("did you mean 'c_column'", text.splitlines()[-1])
        leaf = (HERE / "consumer" / "consumer.c").read_text(encoding="utf-8")
        lines = re.findall(r'^    "(.*)\\n"', leaf, re.M)
        (self.folder / "leaf.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
        for arguments in (["c_column", "-f", "beamw_consistent", "-n", "4"],
                          ["--scene", "leaf.yaml"]):
            theirs = self.installed("solve", *arguments, "--format", "json")
            self.assertIn(SECONDS.sub("", theirs), SECONDS.sub("", text))
            for one in json.loads(theirs)["quantities"]:
                self.assertIn(f"\n{one['quantity']} ", text)
                found = re.search(rf"\n{one['quantity']} (\S+) ", text).group(1)
                self.assertEqual(float(found), one["value"])

    def test_shared_library(self):
        library = str(self.root / "lib")
        self.compiled("cc", "-std=c99", "consumer.c", *self.flags("--cflags", "--libs"))
        self.check(LD_LIBRARY_PATH=library)
        self.assertIn("libbeamwork.so.0", self.installed("-d", "consumer", program="readelf"))

    @unittest.skipIf(shutil.which("c++") is None, "needs c++")
    def test_shared_library_from_cplusplus(self):
        self.compiled("c++", "-x", "c++", "consumer.c", "-x", "none",
                      *self.flags("--cflags", "--libs"))
        self.check(LD_LIBRARY_PATH=str(self.root / "lib"))

    def test_static_library(self):
        libraries = [flag.replace("-lbeamwork", "-l:libbeamwork.a")
                     for flag in self.flags("--static", "--libs")]
        self.compiled("cc", "-std=c99", "consumer.c", *self.flags("--cflags"), *libraries)
        self.assertNotIn("libbeamwork", self.installed("-d", "consumer", program="readelf"))
        self.check(BEAMWORK_TRUTHS=str(self.data / "truths.h5"))

    def test_page(self):
        text = (ROOT / "docs" / "howto" / "c_and_python.md").read_text(encoding="utf-8")
        self.assertIn("cc column.c $(pkg-config --cflags --libs beamwork) -o column", text)
        (self.folder / "column.c").write_text(reader_file("howto/c_and_python.md", "column.c"),
                                              encoding="utf-8")
        self.installed("-Wall", "-Wextra", "-Werror", "column.c",
                       *self.flags("--cflags", "--libs"), "-o", "column", program="cc")
        said = self.installed(program="./column", LD_LIBRARY_PATH=str(self.root / "lib"))
        self.assertRegex(said, r"^\d\S+ N, error \S+\n$")
        solved = json.loads(self.installed("solve", "c_column", "--set", "length=3", "-f",
                                           "beamw_consistent", "-n", "16", "--format", "json"))
        value, = (one["value"] for one in solved["quantities"]
                  if one["quantity"] == "buckling_load")
        self.assertEqual(said.split()[0], f"{value:.10g}")

    def test_cmake(self):
        if shutil.which("cmake") is None:
            self.skipTest("needs cmake")
        prefix = f"-DCMAKE_PREFIX_PATH={self.root}"
        self.installed("-S", HERE / "consumer", "-B", "build", prefix, program="cmake")
        self.installed("--build", "build", program="cmake")
        self.check("build/consumer")
        self.check("build/consumer_static", BEAMWORK_TRUTHS=str(self.data / "truths.h5"))

    def test_symbols(self):
        header = (self.root / "include" / "beamwork" / "beamwork.h").read_text(encoding="utf-8")
        declared = set(re.findall(r"\b(bw_\w+)\(", header))
        for path, options in (("libbeamwork.so.0", ["-D"]), ("libbeamwork.a", ["-g"])):
            text = self.installed(*options, "--defined-only", self.root / "lib" / path,
                                  program="nm")
            seen = {line.split()[2].partition("@")[0] for line in text.splitlines()
                    if len(line.split()) == 3}
            self.assertEqual(seen - {"BEAMWORK_0"}, declared)

    def test_program_finds_its_data(self):
        for arguments in (["solve", "c_column"], ["truth", "elastica"], ["explain", "wrong limit"],
                          ["truth", "elastica", "--set", "load=2.5"]):
            self.assertNotIn("no reference values are used", self.installed(*arguments))
        scene = self.data / "examples" / "scenes" / "leaf_spring_guide.yaml"
        self.assertIn("kind: exact", self.installed("truth", "--scene", scene))
        self.assertIn("PASS", self.installed("verify", "-k", "elastica/default and collocation"))

    def test_elements_compile(self):
        for source in sorted((self.data / "examples" / "elements").iterdir()):
            shutil.copy(source, self.folder)
        sources = [path for path in sorted(self.folder.iterdir()) if path.suffix in (".c", ".cpp", ".f90")]
        for source in sources:
            commands = re.findall(r"^(?: \*|!)   ((?:cc|c\+\+|gfortran) .*)$",
                                  source.read_text(encoding="utf-8"), re.M)
            if source.name == "uel_beam.f90":
                continue
            self.assertEqual("FOLDER_OF_BEAMWORK" in commands[-1], source.suffix != ".f90")
            if any(shutil.which(line.split()[0]) is None for line in commands):
                continue
            for line in commands:
                flags = shlex.join(self.flags("--cflags"))
                program, *words = shlex.split(line.replace("-I FOLDER_OF_BEAMWORK", flags))
                self.installed(*words, program=program)
            made = commands[-1].split()[-1]
            text = self.installed("solve", "elastica", "--element", f"./{made}", "-f",
                                  made.removesuffix(".so"), "-n", "4")
            self.assertIn("w_over_L", text)

    def test_python(self):
        module, = self.root.glob("lib/python3*/dist-packages")
        text = self.installed("-B", "-c", "import beamwork as bw; print(bw.Scene.case('c_column')"
                              ".solve('beamw', 4).errors['buckling_load'])",
                              program="/usr/bin/python3", PYTHONPATH=str(module))
        self.assertGreater(abs(float(text)), 0)

    def test_formulation_in_python(self):
        shutil.copy(self.data / "examples" / "elements" / "timoshenko.py", self.folder / "mine.py")
        text = self.installed("solve", "elastica", "-f", "timoshenko_py", "-n", "2", "--element",
                              "exec:/usr/bin/python3 mine.py")
        self.assertIn("w_over_L", text)
        self.assertEqual(list(self.place.rglob("*.pyc")), [])
        page = (self.root / "share" / "man" / "man7" / "beamwork-element.7").read_text("utf-8")
        for name in re.findall(r"\.Pa (share/\S+)", page):
            self.assertTrue((self.root / name).exists(), name)
        self.assertIn("doc/beamwork/harness/formulations/protocol.md", page)
        self.assertTrue((self.root / "share" / "doc" / "beamwork" / "CONTRIBUTING.md").exists())

    def test_report(self):
        program = str(self.root / "bin" / "beamwork-report")
        self.installed("verify", "-k", "elastica/default and collocation", "-o", "r.h5")
        self.installed("r.h5", "-o", "site", program=program)
        self.assertTrue((self.folder / "site" / "index.html").exists())
        self.assertIn("usage", self.installed(program=program, code=2))
        done = run("nothing.h5", "-o", "site", program=program, cwd=self.folder, env=self.clean)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (4, 1), done.stderr)

    def test_without_data(self):
        if pathlib.Path("/usr/local/share/beamwork").exists():
            self.skipTest("a copy is installed in /usr/local, which has its data")
        alone = self.folder / "beamwork"
        os.link(self.program, alone)
        for arguments, code in ((["truth", "elastica"], 4), (["verify"], 4),
                                (["truth", "--scene", self.data / "examples" / "scenes" /
                                  "leaf_spring_guide.yaml"], 4)):
            done = run(*arguments, program=str(alone), cwd=self.folder, env=self.clean)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (code, 1), done)

    def test_uninstall(self):
        place = self.folder / "gone"
        make("install", f"DESTDIR={place}", "PREFIX=/usr/local")
        self.assertEqual(make("uninstall", f"DESTDIR={place}", "PREFIX=/usr/local").returncode, 0)
        self.assertEqual([path for path in place.rglob("*") if not path.is_dir()], [])
        again = make("uninstall", f"DESTDIR={place}", "PREFIX=/usr/local")
        self.assertNotEqual(again.returncode, 0)
        self.assertFalse((place / "usr" / "local" / "share" / "beamwork").exists())
        self.assertIn("nothing is installed", again.stdout)

    def test_nothing_is_written_at_work(self):
        self.test_report()
        self.assertEqual(list(self.place.rglob("*.pyc")), [])


sys.path.insert(0, str(HERE.parent))
backend = importlib.import_module("build_backend")


@unittest.skipIf(is_sanitized(), "Python is not built with sanitizers")
@unittest.skipIf(importlib.util.find_spec("pip") is None, "needs pip")
class Wheel(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.place = cls.class_folder() / "a place"
        built = {**clean(), **dict(word.split("=", 1) for word in variables())}
        done = run("-m", "pip", "install", "--no-index", "--no-deps", "--target", cls.place, ROOT,
                   program=sys.executable, env={**built, "HOME": str(cls.place)})
        assert done.returncode == 0, done.stdout + done.stderr
        cls.settings = {**clean(), "PYTHONPATH": str(cls.place), "PYTHONDONTWRITEBYTECODE": "1"}

    def test_module_and_program(self):
        theirs = self.record("solve", "c_column", "-f", "beamw", "-n", "2")["quantities"]
        code = ("import beamwork as bw, json; r = bw.Scene.case('c_column').solve('beamw', 2);"
                "print(json.dumps([bw.__version__, bw.path.parent.name, r.document['quantities']]))")
        done = run("-c", code, program=sys.executable, env=self.settings, cwd=self.folder)
        self.assertEqual(json.loads(done.stdout), [backend.VERSION, "lib", theirs], done.stderr)
        done = self.answered("solve", "c_column", "-f", "beamw", "-n", "2", "--format", "json",
                             program=self.place / "bin" / "beamwork", env=self.settings)
        self.assertEqual(json.loads(done.stdout)["quantities"], theirs)
        self.answered("solve", "c_column", "-f", "none", code=2,
                      program=self.place / "bin" / "beamwork", env=self.settings)

    def test_report(self):
        program = self.place / "bin" / "beamwork-report"
        results = self.folder / "r.h5"
        self.answered("verify", "-k", "elastica/default and collocation", "-o", results)
        self.answered(results, "-o", self.folder / "site", program=program, env=self.settings)
        self.assertTrue((self.folder / "site" / "index.html").exists())
        self.assertIn("usage", self.answered(program=program, env=self.settings, code=2).stdout)

    def test_files(self):
        lines = (next(self.place.glob("*.dist-info")) / "RECORD").read_text("utf-8").splitlines()
        names = {line.rsplit(",", 2)[0] for line in lines}
        for name in ("beamwork/__init__.py", "beamwork/bin/beamwork", "beamwork/lib/libbeamwork.so.0",
                     "beamwork/include/beamwork/elements/element.h", "beamwork_element.py",
                     "beamwork/share/beamwork/truths.h5"):
            self.assertIn(name, names)
        self.assertFalse([name for name in names if name.endswith((".a", ".pc", ".o"))])

    def test_source_distribution(self):
        name = backend.build_sdist(self.folder)
        with tarfile.open(self.folder / name) as archive:
            archive.extractall(self.folder)
        unpacked = self.folder / backend.NAME
        packed = {str(path.relative_to(unpacked)) for path in unpacked.rglob("*") if path.is_file()}
        self.assertEqual(packed, {*backend.sources(), "PKG-INFO"})
        self.assertIn("Makefile", packed)
        done = run("-B", "-c", "import build_backend as b; print(*b.sources(), sep='\\n')", program=sys.executable,
                   cwd=unpacked / "harness" / "library" / "packaging")
        self.assertEqual(set(done.stdout.splitlines()), packed - {"PKG-INFO"}, done.stderr)


API_HERE = ROOT / "harness" / "library" / "packaging" / "api"
LIBRARY = ROOT / "harness" / "library" / "beamwork.h"


@unittest.skipUnless(shutil.which("doxygen"), "needs doxygen")
class Pages(ProgramTest):

    def drawn(self):
        return run("0.1.0", self.folder / "api", program=API_HERE / "pages.sh")

    def test_everything_is_documented(self):
        done = self.drawn()
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        page = (self.folder / "api" / "beamwork_8h.html").read_text(encoding="utf-8")
        for name in re.findall(r"\b(bw_\w+)\(", LIBRARY.read_text(encoding="utf-8")):
            self.assertTrue(f">{name}</a>" in page or f"<b>{name}</b>" in page, name)
        for words in ("<code>beamwork list --format json</code>", "in the form of the option --element: "):
            self.assertTrue(words in page, words)

    def test_members_stand_in_their_groups(self):
        self.drawn()
        page = (self.folder / "api" / "structelement__type.html").read_text(encoding="utf-8")
        self.assertTrue("Either the next two functions or" in page)
        self.assertLess(page.index("Either the next two"), page.index("Optional: properties for"))
        bits = (self.folder / "api" / "feature_8h.html").read_text(encoding="utf-8")
        self.assertTrue("initial curvature: initial curvature and strain" in bits)


class Example(ProgramTest):

    def test_compiles(self):
        text = (API_HERE / "index.md").read_text(encoding="utf-8")
        path = self.folder / "mine.c"
        path.write_text(re.search(r"```c\n(.*?)```", text, re.DOTALL)[1], encoding="utf-8")
        done = run("-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I",
                   LIBRARY.parent, path, program="cc")
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Filter(ProgramTest):

    def filtered(self, text):
        path = self.folder / "one.h"
        path.write_text(text, encoding="utf-8")
        return run(path, program=API_HERE / "filter.py").stdout

    def test_comments(self):
        self.assertEqual(self.filtered("/* A <file>. */\n/* x */\nint a; /* of --set */\n"),
                         "/** @file\n * A \\<file\\>. */\n/** x */\nint a; /**< of \\--set */\n")

    def test_members_together(self):
        self.assertIn("double a /**< x */, b; /**< x */",
                      self.filtered("/* f */\nstruct s {\n    double a, b; /* x */\n};\n"))


if __name__ == "__main__":
    unittest.main()
