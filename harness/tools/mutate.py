"""Lists faults for mutants.sh to inject, either generated from C sources or physical.

usage: mutate.py [A..B] [--count N]      generated faults; A..B: only on lines that these commits wrote and that still exist
       mutate.py --physics [FILE]        physical faults, from faults.csv

A generated fault is one edit: it swaps an operator (+ -, * /, < <=, > >=, == !=, && ||), drops a sign, changes a
constant or an index, negates a condition, omits a TRY or another call whose value is not used, or reports another
status. There is at most one per line. The selection depends only on the text of the file, the line and the edit: the
same sources give the same faults, and changes nearby have no influence. Comments, strings, the preprocessor, types,
sizes of arrays and of memory, and assertions are not edited. Edits without an effect are listed in
mutants_equivalent.csv, each with its reason, and are not generated.
"""

import argparse
import csv
import hashlib
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
EQUIVALENT = "harness/tools/mutants_equivalent.csv"
PHYSICS = "harness/tools/faults.csv"
PAIRS = ("+", "-"), ("*", "/"), ("+=", "-="), ("*=", "/="), ("<", "<="), (">", ">="), \
    ("==", "!="), ("&&", "||")
SWAPS = dict(PAIRS) | {b: a for a, b in PAIRS}
TOKEN = re.compile(
    r"""(?P<skip>\s+|/\*.*?\*/|//[^\n]*)
    |(?P<text>"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')
    |(?P<number>(?:0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[uUlLfF]*)
    |(?P<word>[A-Za-z_]\w*)
    |(?P<sign>->|\+\+|--|<<=|>>=|<<|>>|[-+*/%&|^<>=!]=|&&|\|\||.)""", re.S | re.X)
PREPROCESSOR = re.compile(r"^[ \t]*#(?:\\\n|[^\n])*", re.M)
STATUSES = {"STATUS_REFUSED": "STATUS_FAULT", "STATUS_FAULT": "STATUS_REFUSED",
            "STATUS_NOT_CONVERGED": "STATUS_SINGULAR", "STATUS_SINGULAR": "STATUS_NOT_CONVERGED"}
NO_TYPES = {"return", "else", "case", "goto", "sizeof", "do"}
NO_CALLS = NO_TYPES | {"if", "for", "while", "switch"}
# Calls with a memory size, and assertions.
UNSEEN = re.compile(r"(\w*alloc|sizeof|assert|_Static_assert|memset|memcpy|memmove)$")
# Calls that release memory or give hints. Only sanitizers detect that such a call is missing.
RELEASED = re.compile(r"(\w*(free|alloc|close|end)|assert|_Static_assert)$")


def tokens(source):
    """Yields (kind, text, line from 1, column from 0) of the tokens that are code."""
    source = PREPROCESSOR.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), source)
    at, line, begin = 0, 1, 0
    while at < len(source):
        found = TOKEN.match(source, at)
        if found.lastgroup != "skip":
            yield found.lastgroup, found[0], line, at - begin
        if "\n" in found[0]:
            line += found[0].count("\n")
            begin = at + found[0].rfind("\n") + 1
        at = found.end()


def constant(text, index):
    value = re.sub(r"[uUlLfF]+$", "", text)
    if value.isdigit():
        other = int(value) - 1 if index and int(value) > 0 else int(value) + 1
        return text.replace(value, str(other))
    if value.lower().startswith("0x"):
        return None
    return "1.0" if float(value) == 0 else f"(2 * {text})"


class Reader:
    def __init__(self, source):
        self.lines = source.split("\n")
        self.tokens = list(tokens(source))
        self.edits = []
        self.open = []  # enclosing brackets, each with a flag: edits inside the bracket are listed
        self.statement = 0  # first token of the statement
        self.begin = 0  # number of open brackets at the start of the statement
        self.name = ""
        for at, (kind, text, _, _) in enumerate(self.tokens):
            if not self.open and text in ("(", "[", "=") and self.tokens[at - 1][0] == "word":
                self.name = self.word(at - 1)
            if kind == "sign" and text in ("(", "[", "{"):
                self.open.append((text, self.inside(at)))
            elif kind == "sign" and text in (")", "]", "}") and self.open:
                self.open.pop()
            elif self.open and self.open[-1][1]:
                self.token(at)
            if text in (";", "{", "}") and self.ends(at):
                self.statement, self.begin = at + 1, len(self.open)

    def word(self, at):
        return self.tokens[at][1] if 0 <= at < len(self.tokens) else ""

    def ends(self, at):
        text = self.word(at)
        if not self.open or text == ";":
            return not (self.open and self.open[-1][0] == "(")
        if text == "{":
            return self.word(at - 1) not in ("=", ",", "{", "(")
        return self.word(at + 1) not in (",", ";", "}", ")")

    def declares(self):
        first = self.statement
        while self.word(first) in ("static", "const", "struct", "unsigned"):
            first += 1
        after = first + 1
        while self.word(after) in ("*", "const", "long", "int"):
            after += 1
        return after < len(self.tokens) and self.word(first) not in NO_TYPES and \
            self.tokens[first][0] == self.tokens[after][0] == "word"

    def is_size(self, at):
        """Returns True if a bracket contains the size of a declared array."""
        if len(self.open) != self.begin or not self.declares():
            return False
        depth = 0
        for k in range(at - 1, self.statement - 1, -1):
            text = self.word(k)
            depth += text in (")", "]", "}")
            depth -= text in ("(", "[", "{")
            if depth == 0 and text == ",":
                break
            if text == "=":
                return False
        return True

    def inside(self, at):
        """Returns True if edits inside the bracket at a token are listed."""
        text, before = self.word(at), self.word(at - 1)
        if not self.open:  # bodies of functions, values of tables
            return text == "{" and before in (")", "=")
        if not self.open[-1][1] or UNSEEN.match(before):
            return False
        if text == "{" and self.word(self.statement) in ("enum", "struct", "union", "typedef"):
            return "=" in (self.word(k) for k in range(self.statement, at))
        return not (text == "[" and self.is_size(at))

    def operand(self, at):
        kind, text = self.tokens[at][:2]
        return kind in ("number", "text") or (kind == "word" and text not in NO_TYPES) or \
            text in (")", "]")

    def condition(self, at):
        depth, close = 0, at + 1
        while close < len(self.tokens) and self.tokens[close][2] == self.tokens[at][2]:
            depth += (self.word(close) == "(") - (self.word(close) == ")")
            if depth == 0:
                return self.tokens[close][3]
            close += 1
        return None

    def call(self, at):
        """Returns a statement that is only a call and ends on the same line, or None."""
        _, name, line, column = self.tokens[at]
        if at != self.statement or self.word(at + 1) != "(" or name in NO_CALLS or \
                RELEASED.match(name):
            return None
        depth, close = 1, at + 2
        while close < len(self.tokens) and depth > 0:
            depth += (self.word(close) == "(") - (self.word(close) == ")")
            close += 1
        if self.word(close) != ";" or self.tokens[close][2] != line:
            return None
        return self.lines[line - 1][column:self.tokens[close][3]]

    def add(self, at, new, old=None):
        _, text, line, column = self.tokens[at]
        self.edits.append((self.name, line, column, old or text, new))

    def token(self, at):
        kind, text, line, column = self.tokens[at]
        index = self.open[-1][0] == "["
        alone = index and self.word(at - 1) == "[" and self.word(at + 1) == "]"
        # In the layout of the sources, blanks surround the star of a product, but no blank follows the star of a
        # pointer.
        spaced = self.lines[line - 1][column + len(text):][:1] in (" ", "")
        if kind == "number" and (alone or not index):
            if new := constant(text, index):
                self.add(at, new)
        elif kind == "word" and alone and text.islower():
            self.add(at, "0")
        elif text in STATUSES and "memory" not in self.lines[line - 1]:
            self.add(at, STATUSES[text])
        elif kind == "word" and (call := self.call(at)):
            self.add(at, "", call)
        elif kind == "word" and text == "if" and (close := self.condition(at)) is not None:
            self.add(at, self.lines[line - 1][column + 3:close].join(("if (!", "))")))
        elif text in SWAPS and self.operand(at - 1) and (text != "*" or spaced):
            self.add(at, SWAPS[text])
        elif text == "-" and not self.operand(at - 1):
            self.add(at, "")


def faults(source):
    """Returns all faults of a source: (line, function or table, its text, edit, edited line)."""
    found, seen = [], {}
    reader = Reader(source)
    for name, line, column, old, new in reader.edits:
        text = reader.lines[line - 1]
        seen[line, old] = seen.get((line, old), 0) + 1
        length = len(old) if old != "if" else len(new) - 3
        words = "if not" if old == "if" else new or "none"
        called = re.match(r"(\w+)\(", old)
        told = called[1] if called else old
        found.append((line, name, text.strip(), f"{told} to {words} ({seen[line, old]})",
                      text[:column] + new + text[column + length:]))
    return found


def listed(*arguments):
    return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True,
                          check=True).stdout.splitlines()


def sources():
    every = listed("ls-files", "elements/*.c", "cases/*.c", "harness/*.c")
    return [file for file in every if not re.search("/(test|tools|examples|fuzz)/", file)]


def touched(commits, file):
    """Returns the lines of a file that commits wrote and that still exist."""
    blamed = listed("blame", "-l", "-s", "--root", file)
    return {k for k, line in enumerate(blamed, 1) if line[:40] in commits}


def equivalent():
    """Returns the reason for each fault without an effect, by file, function, line and edit."""
    with open(ROOT / EQUIVALENT, encoding="utf-8", newline="") as file:
        return {(row["file"], row["function"], row["line"], row["edit"]): row["reason"]
                for row in csv.DictReader(file)}


def chosen(count, span=None):
    """Returns the sorted list of (file, line, function, text, edit, edited line), and the number of omitted equivalent
    edits."""
    files, commits = sources(), set()
    if span:
        commits = set(listed("rev-list", span))
        files = sorted(set(files) & set(listed("log", "--format=", "--name-only", span)))
    best = {}
    for file in files:
        lines = touched(commits, file) if span else None
        for line, name, text, edit, changed in faults((ROOT / file).read_text(encoding="utf-8")):
            if lines is None or line in lines:
                rank = hashlib.sha256(f"{file}\n{text}\n{edit}".encode()).hexdigest()
                one = rank, file, line, name, text, edit, changed
                best[file, line] = min(best.get((file, line), one), one)
    taken = sorted(one[1:] for one in sorted(best.values())[:count])
    known = equivalent()
    left = [one for one in taken if (one[0], *one[2:5]) not in known]
    return left, len(taken) - len(left)


# Python tests in other folders that test the behaviour of a folder.
BESIDE = {
    "harness/(cli|formulations|experiments|study|library|model|records)/|cases/format/":
        "harness/cli/(cli|outputs|asked|choice|list|converge|options|screen|defaults|help|examples"
        "|printed|had|gate)",  # words: ok (name of a test)
    "harness/(records|terminal|study|experiments|cli)/":
        "harness/records/(compare|schema)|harness/study/(follow|digits|modes)"
        "|harness/analysis/shapes",
    "harness/(experiments|formulations)/":
        "harness/cli/(element_test_test|certificate|sweep|spread)",
    "harness/(study|cli)/": "harness/study/bench|harness/cli/beside",
    "harness/(experiments|time)/":
        "harness/experiments/motion|harness/cli/(restart|own_motion|motion_error)",
    "harness/study/": "harness/cli/new_formulation|harness/study/own_tables",
    "harness/(numerics|analysis|newton|section_forces|model)/":
        "harness/analysis/(shapes|flutter|rotor|about|along|turns|sym|divided)",
    "cases/(scene|format)/|harness/(model|study|records)/":
        "cases/format/(keys|scene|loads|units|parts|contents|stability|warping)"
        "|harness/cli/(plane|physics)",
    "cases/extremes/|harness/experiments/": "harness/experiments/(extremes|stress)",
    "cases/format/test/textbook/": "cases/format/closed",
    "harness/cli/": "harness/study/bench|harness/experiments/|harness/import_export/",
}
# Related C tests: those of the folder and some of other folders.
NEAR = {
    "elements": "elements/test/|harness/experiments/test/contract_|harness/analysis/test/(frequency"
                "|critical|along_eq)|harness/time/test/consistent_test",
    "cases": "cases/test/",
    "cases/format": "cases/format/test/",
}
CALLERS = 8
# Tests that take half a minute or more. They run after all others.
SLOW = tuple(f"{name}_test.c" for name in ("invariants", "consistent_mesh", "inputs",
                                           "condensation"))
JUDGED = "verify:" + " or ".join(f"{case}/default" for case in (
    "elastica", "c_column", "unsymmetric_column", "warping_torsion", "wagner_torsion",
    "lateral_buckling", "hexapod")) + " and collocation"
UNJUDGED = tuple(f"harness/{name}" for name in (
    "cli/manual", "cli/roff", "cli/completion", "cli/offer", "cli/names", "study/timing",
    "experiments/ranges"))


def tests():
    files = set(listed("ls-files", "*/test/*_test.c", "cases/*_test.py", "harness/*_test.py"))
    return {file: (ROOT / file).read_text(encoding="utf-8") for file in sorted(files)}


def checks(file, texts):
    """Returns the checks that should detect a fault in a file: tests of its folder, tests of other folders that call
    its functions, runs with verdicts, and Python tests that use the file."""
    room = file.split("/")
    near = re.compile(NEAR.get("/".join(room[:2])) or NEAR.get(room[0]) or
                      f"{room[0]}/{room[1]}/test/")
    defined = re.findall(r"^(?!static|typedef)\w[\w ]*[ *](\w+)\(",
                         (ROOT / file).read_text(encoding="utf-8"), re.M)
    names = re.compile(r"\b(" + "|".join([*defined, re.escape(file[:-2] + ".h")]) + r")\b")
    told = {test: len(set(names.findall(text))) for test, text in texts.items()}
    ranked = sorted(texts, key=lambda test: (test.endswith(SLOW), -told[test], test))
    ours = [test for test in ranked if near.match(test)]
    in_c = [test[:-2] for test in ours if test.endswith(".c")]
    callers = [test[:-2] for test in ranked
               if told[test] and not near.match(test) and test.endswith(".c")][:CALLERS]
    shown = "|".join(those for rooms, those in BESIDE.items() if re.match(rooms, file))
    python = [test for test in ranked if test.endswith(".py") and (near.match(test) or (
        shown and re.match(shown, test.replace("/test/", "/"))))]
    python.sort(key=lambda test: (room[-1][:-2] not in test, not near.match(test)))
    judged = [] if file.startswith(UNJUDGED) else [JUDGED]
    return [*in_c, *callers, *judged, *(test[:-3].replace("/", ".") for test in python)]


def physics(path):
    """Returns the rows of a table of physical faults: name, file, search pattern and replacement for sed, and the
    check."""
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            change = f"s|{row['pattern']}|{row['replacement']}|"
            print("plant", shlex.quote(row["name"]), row["file"], shlex.quote(change), 1,
                  row["check"])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("span", nargs="?", metavar="A..B")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--physics", nargs="?", const=ROOT / PHYSICS, metavar="FILE")
    asked = parser.parse_args()
    if asked.physics:
        physics(asked.physics)
        return
    left, known = chosen(asked.count, asked.span)
    texts = tests()
    print(f"# {len(left)} faults; {known} more are equivalent: {EQUIVALENT}")
    for file, line, _, text, edit, changed in left:
        name = re.sub(r"[\"\\]", "", f"{file}:{line} {edit} in {text}")
        change = re.sub(r"([\\&|])", r"\\\1", changed)
        print("plant", shlex.quote(name), file, shlex.quote(f"{line}s|.*|{change}|"),
              "noticed any", *(shlex.quote(one) for one in checks(file, texts)))


if __name__ == "__main__":
    sys.exit(main())
