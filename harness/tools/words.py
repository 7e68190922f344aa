"""Checks texts for private words. Prints FILE:LINE: WORD (CONTEXT): REPLACEMENT.

usage: words.py [--counts] [FILE ...]

Without a file: every file that git tracks, test folders excepted. Texts are strings of C and
Python, templates, scene files and help lines of the Makefile ("shown"), Markdown ("docs") and
comments; names in `backticks` are code. A line with `words: ok (REASON)` is not checked. The exit
status is 1 if there is a hit. --counts prints the number of hits of each pattern instead.
"""
import csv
import io
import pathlib
import re
import subprocess
import sys
import tokenize

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINDS = ("shown", "docs", "comments")
# Patterns, each with its replacement.
WORDS = (
    (r"\bsoonest\b", "at the lowest cost; fastest"),
    (r"\b(told|tells?)\b", "reports, prints; told apart: distinguished"),
    (r"\bleft out\b", "default; eliminated; omitted; not shown"),
    (r"\bleave (it|them|one|some) out\b", "remove it"),
    (r"\blimits? of (its|their) own\b|\bown limits?\b", "different limit, biased limit"),
    (r"\b(ours|one's own)\b", "your; user-defined; name the variant"),
    (r"\b(the|its|at|since the|of the) begin\b", "start; t = 0"),
    (r"\bmend(s|ed|ing)?\b", "fix, correct"),
    (r"\bin vain\b", "rejected"),
    (r"\bsurely\b", "significantly"),
    (r"\bbelieve[ds]?\b", "verified; checked"),
    (r"\bdoubt(s|ed)?\b", "uncertainty; not known to"),
    (r"\b(nobody|somebody)\b", "by default; the user; no program"),
    (r"\b(he|his|him)\b", "it, its"),
    (r"\bwho (is|are|can|has|was)\b", "which formulation"),
    (r"\b(is|are|what is) no (number|pass|case|name|grid)\b", "NaN or Inf; did not pass; unknown"),
    (r"\bledger\b(?!\\\")", "list of known deviations"),
    (r"\brooms? (above|below)\b|\b(a|this|every) room\b|^Rooms\b", "folder"),
    (r"\b(the|this) house\b", "the source code"),
    (r"(?<!beamwork-)\bseal(ed|s)?\b", "checksum"),
    (r"(?<![=/])\b(prices?|priced|unpriced)\b(?!\.csv)", "cost coefficients"),
    (r"\bagain for another\b", "may be repeated"),
    (r"\bcontest(s|ants?)?\b", "compared program or formulation; comparison"),
    (r"(?<!-)\bplant(s|ed|ing)?\b(?!\.c)", "inject, injected"),
    (r"\bcontradicts? (itself|themselves|it|what)\b", "inconsistent"),
    (r"\bspeaks? of\b", "applies to, refers to"),
    (r"\bwithout end\b", "as n tends to infinity"),
    (r"\b(dealt|deals? (out|them|to))\b", "assigned"),
    (r"(?<!-)\bgates?\b|\bgated\b|\bgating\b", "counts towards the exit status"),
    (r"\bwhat (is|are|was|were) (driven|held|asked|wanted|left|missing|released)\b",
     "prescribed, fixed, requested, missing"),
    (r"\bdear(er|est)?\b", "more expensive"),
    (r"\bgo(es)? on\b", "continues, resumes"),
    (r"\bas cheap\b", "tie"),
    (r"\bknown to no better than\b", "uncertainty"),
    (r"\bless the\b", "minus the"),
    (r"\btak(es?|en) (?!by\b|as\b|from\b)(?:\w+ ){0,4}away\b", "removes"),
    (r"\bis there already\b|\balready there\b", "already exists"),
    (r"\b(is|are) no (column|folder|file|day)\b", "not a valid column; is not a folder"),
    (r"\bturn(s|ed|ing)? steadily\b", "rotates steadily"),
    (r"\bthe inside of\b", "internal to; inside"),
    (r"\b(is|are) (another one|other ones)\b", "differs; name it again"),
    (r"\bfilled whole\b", "filled completely"),
    (r"\berrors? of time\b", "time error"),
    (r"\bfiles? of results\b", "results file"),
    (r"\bfrom which on\b", "at and above which"),
    (r"\bnot written (as|with) solids\b", "cannot be written as solids"),
    (r"\b(rejected|refused) are\b", "the following are rejected; ... is rejected"),
    (r"\b(errors?|messages?|refusals?|reasons?|exceptions?) of one line\b", "one-line error"),
)
ANY = re.compile("|".join(pattern for pattern, _ in WORDS), re.I)
NAME = re.compile(r"`[^`]*`")
EXEMPT = "words: ok ("
# Files that are not checked: tests, this file, and the table of faults.
SKIPPED = re.compile(r"(^|/)(test|tests)/|^harness/tools/(words\.py|faults\.csv)$")
C_TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)


def c_texts(text):
    """Yields (kind, [(line, text)]) of strings and comments in C. Adjacent strings are joined, and so are adjacent line
    comments."""
    parts, end = [], 0
    for match in C_TOKEN.finditer(text):
        token = match.group()
        line = text.count("\n", 0, match.start()) + 1
        if token[0] == "'":
            continue
        kind = "comments" if token[0] == "/" else "shown"
        content = token[1:-1] if kind == "shown" else token.strip("/* ").replace("\n", " \n") + " "
        joins = parts and parts[-1][1] == kind and not text[end:match.start()].strip()
        if kind == "shown" and text[text.rfind("\n", 0, match.start()) + 1:match.start()].lstrip().startswith("#include"):
            continue
        if joins:
            parts[-1][2].append((line, content))
        else:
            parts.append((line, kind, [(line, content)]))
        end = match.end()
    for _, kind, pieces in parts:
        yield kind, pieces


def python_texts(text):
    """Like c_texts, for Python. A string that is a statement is a comment."""
    previous = tokenize.NEWLINE
    pieces, kind = [], "shown"
    starts = (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENCODING, tokenize.NL)
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.STRING or tokenize.tok_name[token.type] == "FSTRING_MIDDLE":
            if not pieces:
                kind = "comments" if previous in starts else "shown"
            text = re.sub(r"\{[^{}\n]*\}", "{}", token.string) if "f" in token.string[:2] else token.string
            for offset, row in enumerate(text.split("\n")):
                pieces.append((token.start[0] + offset, row.strip("\"'") + " " * (offset > 0)))
        elif token.type == tokenize.COMMENT:
            yield "comments", [(token.start[0], token.string.lstrip("# "))]
        elif token.type != tokenize.NL and pieces:
            yield kind, pieces
            pieces = []
        if token.type != tokenize.COMMENT:
            previous = token.type


def hash_texts(kind):
    """Returns a reader for lines of scripts. By default it yields only comments. If `kind` is "shown", as for scene
    files, it also yields the rest of each line."""
    def texts(text):
        for number, line in enumerate(text.split("\n"), 1):
            found = re.search(r"(^|\s)#+\s?(.*)", line)
            if found:
                helps = found.group().strip().startswith("##")
                yield "shown" if helps else "comments", [(number, found.group(2))]
            if kind == "shown":
                yield kind, [(number, line[:found.start()] if found else line)]
    return texts


def line_texts(kind):
    """Returns a reader for all lines, without code and file names. From code in templates, only the strings are read."""
    code = re.compile(r'`[^`]*`|^ *also called:.*|<code>.*?</code>|\b(href|id|class|name)="[^"]*"')
    strings = re.compile(r'"[^"]*\s[^"]*"')

    def texts(text):
        for number, line in enumerate(text.split("\n"), 1):
            line = re.sub(r"\{[{%].*?[%}]\}", lambda m: "{" + " ".join(strings.findall(m.group())) + "}", line)
            yield kind, [(number, code.sub("` `", line))]
    return texts


def table_texts(text):
    for number, line in enumerate(text.split("\n"), 1):
        for field in next(csv.reader([line]), ()):
            if "|" not in field:
                yield "shown", [(number, field)]


READERS = {".c": c_texts, ".h": c_texts, ".py": python_texts, ".md": line_texts("docs"),
           ".html": line_texts("shown"), ".yaml": hash_texts("shown"), ".csv": table_texts,
           ".sh": hash_texts("comments"), ".mk": hash_texts("comments"), "": hash_texts("comments")}


def hits(name, text):
    """Yields (kind, pattern, line, word, context, remedy) of every hit in a text. name: name of its file."""
    reader = READERS.get(pathlib.PurePath(name).suffix)
    if reader is None:
        return
    lines = text.split("\n")
    for kind, pieces in reader(text):
        if kind == "comments":
            pieces = [(line, NAME.sub(lambda name: " " * len(name.group()), piece)) for line, piece in pieces]
        whole = "".join(piece for _, piece in pieces)
        if not ANY.search(whole):
            continue
        if kind == "shown" and not re.search(r"\s", whole.strip()):
            continue  # names of options, keys and files
        for pattern, remedy in WORDS:
            for match in re.finditer(pattern, whole, re.I):
                line, length = pieces[0][0], 0
                for line, piece in pieces:
                    length += len(piece)
                    if match.start() < length:
                        break
                line += whole[length - len(piece):match.start()].count("\n")
                if EXEMPT not in lines[line - 1]:
                    context = whole[max(0, match.start() - 40):match.end() + 40]
                    yield kind, pattern, line, match.group(), " ".join(context.split()), remedy


def tracked():
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files"], check=True, capture_output=True,
                            text=True).stdout.splitlines()
    return [name for name in listed if not SKIPPED.search(name) and (ROOT / name).exists()]


def main(arguments):
    counts = "--counts" in arguments
    chosen = [name for name in arguments if name != "--counts"]
    found = {}
    for name in chosen or tracked():
        path = pathlib.Path(name) if chosen else ROOT / name
        for kind, pattern, *rest in hits(name, path.read_text(encoding="utf-8")):
            found.setdefault((pattern, kind), []).append((name, *rest))
    if counts:
        for pattern, _ in WORDS:
            print(*(f"{len(found.get((pattern, kind), ())):5}" for kind in KINDS), pattern)
        print(*(f"{sum(len(v) for k, v in found.items() if k[1] == kind):5}" for kind in KINDS), "all")
        return 0
    for places in found.values():
        for name, line, word, context, remedy in places:
            print(f"{name}:{line}: {word} ({context}): write {remedy}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
