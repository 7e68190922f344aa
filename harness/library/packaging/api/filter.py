#!/usr/bin/python3
"""Rewrites a header so that doxygen uses the comments before and after a declaration as its documentation.

usage: filter.py HEADER
"""
import pathlib
import re
import sys

COMMENT = re.compile(r"/\*(.*?)\*/", re.DOTALL)
FEATURE = re.compile(r'\{(FEATURE_\w+),\s*"([^"]+)",\s*"([^"]+)"\}')


def escaped(text):
    parts = text.split("`")
    parts[::2] = [re.sub(r"([\\<>@#&]|--)", r"\\\1", part) for part in parts[::2]]
    return "`".join(parts)


def is_behind(source, start):
    """Returns True if code precedes the comment on its line, or if the comment continues such a comment."""
    return bool(source[source.rfind("\n", 0, start) + 1:start].strip())


def comments(source):
    """Makes each comment document the following declaration or, if a declaration precedes the comment on its line, this
    declaration."""
    seen = []

    def one(found):
        text = escaped(found[1])
        seen.append(found)
        if len(seen) == 1:
            return "/** @file\n *" + text + "*/"
        return ("/**<" if is_behind(source, found.start()) else "/**") + text + "*/"
    return COMMENT.sub(one, source)


def features(source):
    """Returns the source, in which a comment with the name and the summary of the physics follows each FEATURE_*
    bit."""
    for bit, name, summary in FEATURE.findall(source):
        source = re.sub(rf"^( +{bit} = [^,\n]+,)$", lambda line, text=f"{name}: {summary}":
                        f"{line[1]} /* {text} */", source, count=1, flags=re.MULTILINE)
    return source


def is_alone(code):
    """Returns True if no separate comment belongs to the following declaration."""
    declaration = code[:code.find(";") + 1]
    behind = code[len(declaration):].split("\n", 1)[0]
    return "/*" not in declaration + behind


def groups(source):
    """Groups members after "Required: ..." or "Optional: ..." under these words, which also document the first member
    if it has no other comment."""
    start = source.find("typedef struct element_type {")
    end = source.find("} element_type;")
    if start < 0:
        return source
    body, opened = source[start:end], []

    def one(found):
        text = re.sub(r"\n\s*\*", "", found[1])
        name = text.rstrip(" .")
        if "\n" in found[1]:
            name = re.split(r"[.;]|(?<!Optional)(?<!Required):", text, maxsplit=1)[0]
        opened.append(name)
        close = "/**@}*/\n    " if len(opened) > 1 else ""
        said = f"\n    /*{found[1]}*/" if is_alone(body[found.end():]) else ""
        title = escaped(name.strip()).replace("`", "")
        return f"    {close}/**@name {title} */\n    /**@{{*/{said}"
    body = re.sub(r"^    /\*(\s*(?:Required|Optional)\b.*?)\*/", one, body,
                  flags=re.MULTILINE | re.DOTALL)
    return source[:start] + body + ("    /**@}*/\n" if opened else "") + source[end:]


def apart(source):
    """Separates members that are declared together, so that the comment after them applies to each member."""
    return re.sub(r"^( +[\w ]+?)((?: \w+(?:\[\w*\])?,)+)( \w+(?:\[\w*\])?; +)(/\*.*?\*/)",
                  lambda found: found[1] + found[2].replace(",", f" {found[4]},") + found[3]
                  + found[4], source, flags=re.MULTILINE | re.DOTALL)


def main(path):
    source = apart(features(pathlib.Path(path).read_text(encoding="utf-8")))
    marked = groups(source)
    # output of groups() is already documentation
    parts = re.split(r"(/\*\*@.*?\*/)", marked, flags=re.DOTALL)
    kept = parts[1::2]
    text = comments("\0".join(parts[::2]))
    for one in kept:
        text = text.replace("\0", one, 1)
    sys.stdout.write(text)


if __name__ == "__main__":
    main(sys.argv[1])
