"""Formulations that the project has accepted: their verdicts affect the exit status."""
import datetime
import re

from reference.table import Refused, read_csv

ACCEPTED_COLUMNS = "formulation,since,version".split(",")


def read_accepted(path):
    rows, seen = [], {}
    for number, row in read_csv(path, ACCEPTED_COLUMNS):
        where = f"{path.name}:{number}"
        name = row["formulation"]
        if not re.fullmatch(r"[a-z0-9_]+", name):
            raise Refused(f"{where}: formulation '{name}' must be a name without options")
        if name in seen:
            raise Refused(f"{where}: '{name}' is accepted at {seen[name]}")
        seen[name] = where
        try:
            datetime.date.fromisoformat(row["since"])
        except ValueError as why:
            raise Refused(f"{where}: since '{row['since']}' is not a date such as 2026-11-21") from why
        if not re.fullmatch(r"\d+\.\d+\.\d+", row["version"]):
            raise Refused(f"{where}: version '{row['version']}' is not a version such as 0.1.0")
        rows.append(row)
    return rows
