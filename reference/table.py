"""Reads tables of reference values from CSV files: rows with declared columns. Invalid rows are rejected."""
import csv


class Refused(Exception):
    """Raised for an invalid row. The text contains the file and the line."""


def read_csv(path, columns):
    with open(path, newline="", encoding="utf-8") as table:
        reader = csv.DictReader(table)
        if reader.fieldnames != columns:
            raise Refused(f"{path.name}: columns must be {','.join(columns)}")
        for number, row in enumerate(reader, 2):
            if None in row or None in row.values():
                raise Refused(f"{path.name}:{number}: wrong number of fields")
            yield number, row
