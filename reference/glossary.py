"""The glossary: terms of the program and the report with their explanations."""
import re

from reference.table import Refused, read_csv

GLOSSARY_COLUMNS = "term,also,group,meaning,see".split(",")


def looked_up(word):
    return " ".join(re.split(r"[ _-]+", word.lower()))


def read_glossary(path):
    """Returns the entries. Raises Refused if a field is missing, if a name is explained twice, or
    if `see` does not name another term."""
    rows, names = [], {}
    for number, row in read_csv(path, GLOSSARY_COLUMNS):
        where = f"{path.name}:{number}"
        for column in ("term", "group", "meaning"):
            if not row[column]:
                raise Refused(f"{where}: an entry needs {column}")
        for name in [row["term"], *filter(None, row["also"].split("|"))]:
            if looked_up(name) in names:
                raise Refused(f"{where}: '{name}' is explained at {names[looked_up(name)]}")
            names[looked_up(name)] = where
        rows.append(row)
    terms = {row["term"] for row in rows}
    for row in rows:
        for word in filter(None, row["see"].split("|")):
            if word not in terms or word == row["term"]:
                raise Refused(f"{path.name}: '{row['term']}' sends to '{word}', which is not another term")
    return rows
