"""Defaults of a case's parameters, as reference/defaults.csv has them: no program repeats them."""
import functools
import pathlib

from reference.pack import read_csv

PATH = pathlib.Path(__file__).resolve().parents[1] / "defaults.csv"


@functools.cache
def _table():
    cases = {}
    for _, row in read_csv(PATH, ["case", "parameter", "value", "choices"]):
        text = row["choices"].split("|")[int(row["value"])] if row["choices"] else row["value"]
        cases.setdefault(row["case"], {})[row["parameter"]] = text
    return cases


def texts(case):
    """{parameter: text}: a number as it is written, or the word of a choice; {}: no such case."""
    return dict(_table().get(case, {}))


def _value(text):
    try:
        return float(text) if not text.lstrip("-").isdigit() else int(text)
    except ValueError:
        return text


def values(case, *names):
    """{parameter: number, whole ones as int, or word}, of the named ones or of all."""
    return {k: _value(v) for k, v in _table()[case].items() if not names or k in names}
