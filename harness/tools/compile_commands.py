"""Writes compile_commands.json from the commands that make would run. usage: make -Bnk V=1 all tests |
compile_commands.py"""
import json
import os
import re
import sys

COMPILED = re.compile(r"\s-c (?P<file>\S+\.c) -o (?P<output>\S+)(\s|$)")


def commands(lines, folder):
    return [{"directory": folder, "command": line.strip(), **found.groupdict()}
            for line in lines if (found := COMPILED.search(line))]


if __name__ == "__main__":
    json.dump(commands(sys.stdin, os.getcwd()), sys.stdout, indent=1)
    print()
