"""Rows of reference/predicted: the derived rows (predicted.py), the stored rows, and their differences."""
import csv
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from reference.derive import rederive  # noqa: E402
from reference.pack import COLUMNS  # noqa: E402

WORDS = [name for name in COLUMNS if name not in ("value", "uncertainty")]
FOLDER = ROOT / "reference" / "predicted"
SOURCE = "reference/derive/predicted.py"


def exact_values():
    """Returns {(case, parameters, quantity): values}, with one value for each shear theory."""
    found = {}
    for path in (ROOT / "reference" / "tables").glob("*.csv"):
        for row in rederive.read_table(path):
            if row["kind"] == "exact" and not row.get("at"):
                key = row["case"], rederive.canonical(row["parameters"]), row["quantity"]
                found.setdefault(key, []).append(float(row["value"]))
    return found


def row_of(given):
    name, case, parameters, quantity, value, unit, relative = given[:7]
    filled = {
        "case": case, "parameters": parameters, "formulation": name, "quantity": quantity,
        "value": rederive.as_text(value, relative), "unit": unit, "kind": "predicted",
        "uncertainty": "%.1e" % (abs(float(value)) * relative), "model": "same",
        "convention": given[7] if len(given) > 7 else "", "source": SOURCE
    }
    return {**dict.fromkeys(COLUMNS, ""), **filled}


def key_of(row):
    return row["case"], rederive.canonical(row["parameters"]), row["formulation"], row["quantity"]


def stored_rows(cases):
    paths = [FOLDER / f"{case}.csv" for case in cases]
    tables = [rederive.read_table(path) for path in paths if path.exists()]
    return {key_of(row): row for table in tables for row in table}


def write(derived):
    FOLDER.mkdir(exist_ok=True)
    for case in sorted({row["case"] for row in derived}):
        with open(FOLDER / f"{case}.csv", "w", newline="", encoding="utf-8") as table:
            writer = csv.DictWriter(table, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(row for row in derived if row["case"] == case)


def difference(row, known):
    if known is None:
        return f"derived {row['value']} {row['unit']}, not stored"
    gap = abs(float(row["value"]) - float(known["value"]))
    if gap <= float(known["uncertainty"]) and all(known[name] == row[name] for name in WORDS):
        return None
    values = [f"{one['value']} +- {one['uncertainty']} {one['unit']}" for one in (row, known)]
    return f"derived {values[0]}, stored {values[1]}, or another word differs"


def differences(derived, cases):
    stored = stored_rows(cases)
    for row in derived:
        line = difference(row, stored.pop(key_of(row), None))
        if line:
            yield f"{key_of(row)}: {line}"
    yield from (f"{key}: stored, but not derived" for key in stored)
