"""Derives every exact row again and compares it with reference/tables.

usage: rederive.py [--print] [PROGRAM...]   --print writes the rows in the tables' format instead.
"""
import csv
import importlib
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
COLUMNS = "case,parameters,formulation,elements,quantity,value,unit,uncertainty,kind,model,convention,source".split(",")
DIGITS = 13


def canonical(parameters):
    return ";".join(sorted(p for p in parameters.split(";") if p))


def stored_rows():
    for path in sorted((ROOT / "reference" / "tables").glob("*.csv")):
        with open(path, newline="") as table:
            for row in csv.DictReader(table):
                if row["kind"] == "exact":
                    yield (row["case"], canonical(row["parameters"]), row["quantity"]), row


def programs(names):
    found = sorted(p.stem for p in (ROOT / "reference" / "derive").glob("*.py") if hasattr_rows(p))
    return [n for n in found if not names or n in names]


def hasattr_rows(path):
    return "\ndef rows(" in path.read_text()


def normalised(derived, name):
    """(case, parameters, quantity, value, unit[, relative uncertainty[, convention]])."""
    for row in derived:
        case, parameters, quantity, value, unit = row[:5]
        relative = row[5] if len(row) > 5 else 10.0 ** (1 - DIGITS) / 2
        convention = row[6] if len(row) > 6 else ""
        yield case, parameters, quantity, value, unit, relative, convention, f"reference/derive/{name}.py"


def as_text(value, relative):
    from mpmath import mpf, nstr
    digits = DIGITS
    while digits > 4 and 10.0 ** (1 - digits) < relative / 5:
        digits -= 1
    return nstr(mpf(value), digits, min_fixed=-4, max_fixed=14, strip_zeros=False)


def print_rows(names):
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(COLUMNS)
    for name in programs(names):
        module = importlib.import_module(f"reference.derive.{name}")
        for case, parameters, quantity, value, unit, relative, convention, source in normalised(module.rows(), name):
            uncertainty = max(abs(float(value)) * relative, 1e-300) if float(value) != 0 else relative
            writer.writerow([case, parameters, "", "", quantity, as_text(value, relative), unit, "%.1e" % uncertainty, "exact", "same", convention, source])


def compare(names):
    stored = dict(stored_rows())
    seen, agree, differ = set(), 0, 0
    for name in programs(names):
        module = importlib.import_module(f"reference.derive.{name}")
        here = 0
        for case, parameters, quantity, value, unit, _, _, _ in normalised(module.rows(), name):
            key = (case, canonical(parameters), quantity)
            row = stored.get(key)
            seen.add(key)
            if row is None:
                continue
            good = row["unit"] == unit and abs(float(value) - float(row["value"])) <= 2 * float(row["uncertainty"])
            agree, differ, here = agree + good, differ + (not good), here + 1
            if not good:
                print(f"  {key}: derived {float(value):.15g} {unit}, stored {row['value']} {row['unit']}")
        print(f"{name}: {here} rows")
    if not names:
        for key in stored:
            if key not in seen:
                differ += 1
                print(f"  {key}: exact, but no program derives it")
    print(f"{agree} rows agree, {differ} differ")
    return 1 if differ else 0


def main(arguments):
    names = [a for a in arguments if not a.startswith("-")]
    if "--print" in arguments:
        print_rows(names)
        return 0
    return compare(names)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
