"""Defaults of the parameters of cases, from reference/defaults.csv, so that no program repeats them."""
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
    """Returns {parameter: number or word as written}, or {} if there is no such case."""
    return dict(_table().get(case, {}))


def value(text):
    try:
        return float(text) if not text.lstrip("-").isdigit() else int(text)
    except ValueError:
        return text


def values(case, *names):
    """Returns {parameter: number (whole numbers as int) or word} for the named parameters, or for all parameters."""
    return {k: value(v) for k, v in _table()[case].items() if not names or k in names}


def decimals(case, given):
    """Returns {parameter: mpmath number made from the decimal text, or word}. `given` contains values that differ
    from the defaults, as text or numbers."""
    from mpmath import mpf
    at = {**texts(case), **given}
    return {k: v if isinstance(value(str(v)), str) else mpf(v) for k, v in at.items()}


def differing(case, **given):
    """Returns `name=value;...` of the values that differ from the defaults."""
    default = values(case)
    return ";".join(f"{k}={v}" for k, v in given.items() if value(str(v)) != default[k])
