"""Runs the commands shown on pages as a reader would, in order, from the root of a clone.

Commands are in `console` blocks. A line that begins with `$ ` is a command, and lines that begin with `> ` continue
the command. Its output follows. Blocks with files of the reader have the file name in `:caption:` or in the first line
`# NAME`. In expected outputs, `...` matches any text of a line; a line `...` matches any lines.

usage: shown_commands.py PAGE... prints pages whose output differs, and replaces the outputs on the pages
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
BLOCK = re.compile(r"^```(?:\{code-block\} *)?(\w+)\n((?:.*\n)*?)```$", re.M)
# Text with solution times and corrections of iterations, which is replaced by `...` when a page is written.
VARYING = re.compile(r"^(?:ok; (?:.*\n)*?.*solution|step +path(?:.*\n)*?.*(?=\Z|\n\S))$", re.M)
CAPTION = re.compile(r"\A(?::caption:|#) (\S+\.\w+)\n+")


def pages():
    """Returns all pages that may show commands."""
    return sorted([*ROOT.glob("README*.md"), *DOCS.rglob("*.md")])


def commands(body):
    """Returns [(command, expected lines)] of a console block."""
    found = []
    for line in body.splitlines():
        if line.startswith("$ "):
            found.append((line[2:], []))
        elif line.startswith("> ") and found and not found[-1][1]:
            found[-1] = (found[-1][0] + "\n" + line[2:], [])
        else:
            found[-1][1].append(line)
    return found


def fits(line, printed):
    return re.fullmatch(".*".join(map(re.escape, line.rstrip().split("..."))), printed.rstrip()) is not None


def match(expected, printed):
    if not expected:
        return not printed
    if expected[0].strip() == "...":
        return any(match(expected[1:], printed[i:]) for i in range(len(printed) + 1))
    return bool(printed) and fits(expected[0], printed[0]) and match(expected[1:], printed[1:])


def reader_file(page, name):
    bodies = [body for _, body in BLOCK.findall((DOCS / page).read_text(encoding="utf-8"))]
    body, = (b for b in bodies if CAPTION.match(b) and CAPTION.match(b).group(1) == name)
    return body[CAPTION.match(body).end():]


class Folder:
    """A temporary folder with the content of the root of a clone."""

    def __init__(self, path, program):
        self.path = pathlib.Path(path)
        for entry in ROOT.iterdir():
            if entry.name != "build" and not entry.name.startswith("."):
                (self.path / entry.name).symlink_to(entry)
        (self.path / "build").symlink_to(pathlib.Path(program).parent)
        library = ROOT / "harness" / "library" / "python"
        self.environment = {
            **os.environ, "LC_ALL": "C.UTF-8", "COLUMNS": "100",
            "PATH": f"{pathlib.Path(program).parent}:{os.environ['PATH']}",
            "PYTHONPATH": str(library), "PYTHONDONTWRITEBYTECODE": "1"
        }

    def run(self, command):
        """Returns the lines that a command prints, including errors."""
        done = subprocess.run(["bash", "-c", command], cwd=self.path, env=self.environment, text=True,
                              check=False, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        return [line.rstrip() for line in done.stdout.splitlines()]


def differences(text, program):
    """Returns [(command, expected lines, printed lines)] of the commands on a page whose output differs."""
    with tempfile.TemporaryDirectory() as path:
        return differences_in(Folder(path, program), text)


def differences_in(folder, text):
    wrong = []
    for kind, body in BLOCK.findall(text):
        caption = CAPTION.match(body)
        if caption:
            (folder.path / caption.group(1)).write_text(body[caption.end():], encoding="utf-8")
        for command, expected in commands(body) if kind == "console" else ():
            printed = folder.run(command)
            if not match(expected, printed):
                wrong.append((command, expected, printed))
    return wrong


def shown(command, lines):
    return "\n".join(["$ " + command.replace("\n", "\n> "), *lines]) + "\n"


def main(names):
    """Writes the outputs of commands to pages. Lines that already match the printed lines do not change."""
    program = os.path.abspath(os.environ.get("BEAMWORK", "build/beamwork"))
    for name in map(pathlib.Path, names):
        text = name.read_text(encoding="utf-8")
        for command, expected, printed in differences(text, program):
            printed = VARYING.sub("...", "\n".join(printed)).split("\n")
            kept = [next((e for e in expected if "..." in e.strip(". ") and fits(e, p)), p)
                    for p in printed]
            text = text.replace(shown(command, expected), shown(command, kept))
            print(f"{name}: {command}")
        name.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
