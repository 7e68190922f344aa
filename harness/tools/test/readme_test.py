"""What READMEs say of files and folders is true, and what only one file may name, no other does."""
import re
import unittest

from harness.tools.kit.program import ROOT

# Names to be filled in, and a table inside results.h5.
PATTERNS = ("NAME", "my_beam", "*", "cases/elastica/quantities")
PATH = re.compile(r"(?<![\w./-])(?:cases|docs|elements|harness|reference|reports)/[\w./*-]+\w")
WALK = re.compile(r"^(\w+| \|) +((?:cases|elements|harness|reports)/\S+)", re.MULTILINE)


TREES = ("cases", "docs", "elements", "harness", "reference", "reports")


def files(*endings):
    """Of the house: what is built or of the reader's own does not count."""
    top = [path for path in ROOT.iterdir() if path.is_file()]
    below = [path for tree in TREES for path in (ROOT / tree).rglob("*")]
    return [path for path in top + below if path.suffix in endings]


class Readme(unittest.TestCase):
    def test_paths_exist(self):
        found = 0
        for readme in files(".md"):
            if readme.match("docs/index.md"):  # pages that are generated; Sphinx looks at them
                continue
            text = readme.read_text(encoding="utf-8")
            if readme.name == "CHANGELOG.md":  # what is released names the folders of its time
                text = "## ".join(text.split("\n## ")[:2])
            for name in PATH.findall(text):
                if any(part in name for part in PATTERNS):
                    continue
                found += 1
                with self.subTest(readme=readme.name, path=name):
                    self.assertTrue((ROOT / name).exists() or (readme.parent / name).exists())
        self.assertGreater(found, 50)

    def test_walk_goes_down(self):
        """Each file of the walk includes nothing of a room that stands below it."""
        text = (ROOT / "docs" / "project" / "source.md").read_text(encoding="utf-8")
        walked = [name for _, name in WALK.findall(text)]
        self.assertGreater(len(walked), 8)
        rooms = [name.rpartition("/")[0] for name in walked]
        for i, name in enumerate(walked):
            included = re.findall(r'#include "([^"]+)/[^/"]+"', (ROOT / name).read_text("utf-8"))
            below = set(rooms[i + 1:]) - set(rooms[:i + 1])
            with self.subTest(file=name):
                self.assertFalse(below & set(included))


# A file of `quantities` is of one kind; the builder looks at the kind first.
THEIRS = (ROOT / "cases" / "scene", ROOT / "cases" / "quantities",
          ROOT / "cases" / "format" / "builder_members.c")


class Unions(unittest.TestCase):
    def test_only_their_files_name_them(self):
        """The unions of a scene are read through functions that know the kind."""
        for path in files(".c"):
            if path.parent.name == "test" or path.parent in THEIRS or path in THEIRS:
                continue
            with self.subTest(file=path.name):
                self.assertIsNone(re.search(r"(->|\.)of\.(walk|compliance|continuation|component"
                                            r"|entry|load|mode|point|driver)\b",
                                            path.read_text(encoding="utf-8")))


if __name__ == "__main__":
    unittest.main()
