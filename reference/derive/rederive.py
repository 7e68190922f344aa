"""Derives every exact row and the rows from solids again, and compares them with reference/tables, reference/extremes and
cases/examples.

usage: rederive.py [--write] [--all] [PROGRAM...]     --write replaces the rows of the programs; review the diff. Rows
of scene files are printed. --all computes every point of the solids (half an hour), not only the first points. Without
CalculiX, the solids are skipped and listed.
"""
import csv
import importlib
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from reference.derive import scenes, theory  # noqa: E402
from reference.derive.solids import deck  # noqa: E402
from reference.pack import COLUMNS, read_defaults  # noqa: E402

FOLDERS = ("tables", "extremes")
DIGITS = 13


def canonical(parameters):
    return ";".join(sorted(p for p in parameters.split(";") if p))


def read_table(path):
    with open(path, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def programs(names):
    """Returns the names of the modules in this folder that have a function rows(): those in `names`, or all if `names` is
    empty. Modules of solids, which need another program, have names solids.NAME."""
    here = ROOT / "reference" / "derive"
    found = sorted(".".join(p.relative_to(here).with_suffix("").parts) for p in here.rglob("*.py")
                   if "\ndef rows(" in p.read_text(encoding="utf-8"))
    unknown = [n for n in names if n not in found]
    if unknown:
        raise SystemExit(f"rederive.py: no program '{unknown[0]}'; there are {', '.join(found)}")
    return [n for n in found if not names or n in names]


def folder_of(name):
    """Returns the folder of the rows of a program: its TABLES, or tables."""
    return getattr(importlib.import_module(f"reference.derive.{name}"), "TABLES", FOLDERS[0])


def as_text(value, relative):
    """Returns the value as text, with the digits that its relative uncertainty justifies."""
    from mpmath import mpf, nstr
    digits = DIGITS
    while digits > 4 and 10.0 ** (1 - digits) < relative / 5:
        digits -= 1
    return nstr(mpf(value), digits, min_fixed=-4, max_fixed=14, strip_zeros=False)


def is_solid(name):
    return name.startswith("solids.")


def kind_of(name):
    """Returns the kind of the rows of a program: its KIND or, by default, `independent` for solids and `exact` for
    other programs."""
    module = importlib.import_module(f"reference.derive.{name}")
    return getattr(module, "KIND", "independent" if is_solid(name) else "exact")


def confirms(name):
    """Returns True if the stored rows have another source, so that the program only confirms their digits."""
    return kind_of(name) == "consensus"


def derived_rows(name, everything):
    """Yields (row of the table, value) for a program, which yields (case, parameters, quantity, value, unit[, relative
    uncertainty[, convention[, at[, formulation]]]]). If a formulation is given, the value is the limit that this
    formulation must have."""
    module = importlib.import_module(f"reference.derive.{name}")
    kind, model = kind_of(name), "other" if is_solid(name) else "same"
    for given in module.rows(everything) if is_solid(name) else module.rows():
        case, parameters, quantity, value, unit = given[:5]
        relative = given[5] if len(given) > 5 else 10.0 ** (1 - DIGITS) / 2
        uncertainty = abs(float(value)) * relative if float(value) != 0 else relative
        formulation = given[8] if len(given) > 8 else ""
        row = {
            **dict.fromkeys(COLUMNS, ""), "case": case, "parameters": parameters,
            "quantity": quantity, "unit": unit, "kind": "predicted" if formulation else kind,
            "model": model, "formulation": formulation,
            "theory": "" if is_solid(name) else theory.of(case, parameters, quantity),
            "at": given[7] if len(given) > 7 else "", "value": as_text(value, relative),
            "uncertainty": "%.1e" % uncertainty, "convention": given[6] if len(given) > 6 else "",
            "source": f"reference/derive/{name.replace('.', '/')}.py"
        }
        yield row, float(value)


def key_of(folder, row):
    return folder, row["case"], canonical(
        row["parameters"]), row["quantity"], row["at"], row["kind"], row["formulation"]


def write(names):
    derived, cases = {}, read_defaults(ROOT / "reference" / "defaults.csv")
    for name in names:
        if confirms(name):
            print(f"{name}: confirms rows of another source, which stay as they are")
            continue
        for row, _ in derived_rows(name, everything=True):
            if folder_of(name) == scenes.FOLDER:
                print(scenes.line_of(row))
                continue
            if row["case"] not in cases:
                raise SystemExit(
                    f"rederive.py: {name} knows case {row['case']}, reference/defaults.csv does not; add its parameters there first"
                )
            derived.setdefault((folder_of(name), row["case"]), []).append(row)
    for (folder, case), rows in derived.items():
        path = ROOT / "reference" / folder / f"{case}.csv"
        replaced = {row["source"] for row in rows}
        kept = [
            row for row in (read_table(path) if path.exists() else [])
            if row["source"] not in replaced
        ]
        with open(path, "w", newline="", encoding="utf-8") as table:
            writer = csv.DictWriter(table, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows + kept)
        print(f"{path.name}: {len(rows)} derived rows, {len(kept)} others")


def differences(name, stored, seen, cases, everything):
    """Returns (number of rows that agree, lines that describe differences, number of rows of cases that do not exist yet,
    largest difference divided by the uncertainty) for one program."""
    agree, lines, waiting, largest = 0, [], 0, 0.0
    for row, value in derived_rows(name, everything):
        folder = folder_of(name)
        if row["case"] not in (scenes.names() if folder == scenes.FOLDER else cases):
            waiting += 1
            continue
        key = key_of(folder, row)
        seen.add(key)
        known = stored.get(key)
        off = abs(value - float(known["value"])) if known else 0.0
        if known and confirms(name):
            largest = max(largest, off / float(known["uncertainty"]))
        if known is None:
            lines.append(f"{key}: derived {value:.15g} {row['unit']}, not in the table")
        elif known.get("unit",
                       row["unit"]) != row["unit"] or off > float(known["uncertainty"]):
            lines.append(
                f"{key}: derived {value:.15g} {row['unit']}, stored {known['value']} +- {known['uncertainty']} {known.get('unit', '')}"
            )
        elif any(known[name] != row[name] for name in ("theory", "convention")):
            lines.append(
                f"{key}: stored as {known['theory']}, {known['convention']}; derived as {row['theory']}, {row['convention']}"
            )
        else:
            agree += 1
    return agree, lines, waiting, largest


def read_stored():
    stored = {}
    for path in sorted(
            p for folder in FOLDERS for p in (ROOT / "reference" / folder).glob("*.csv")):
        stored.update({
            key_of(path.parent.name, row): row
            for row in read_table(path) if row["source"].startswith("reference/derive/")
            or row["kind"] == "consensus"
        })
    return {**stored, **{key_of(scenes.FOLDER, row): row for row in scenes.stored()}}


def compare(names, whole, everything):
    """Returns the exit status. If `whole` is True, all programs are run, and stored rows that no program derives are
    reported."""
    stored, seen, agree, differ, cases = read_stored(), set(), 0, 0, read_defaults(
        ROOT / "reference" / "defaults.csv")
    for name in names:
        if is_solid(name) and not deck.available():
            print(
                f"{name:<24} skipped: {deck.PROGRAM} is not installed (Debian package calculix-ccx)"
            )
            continue
        good, lines, waiting, largest = differences(name, stored, seen, cases, everything)
        agree, differ = agree + good, differ + len(lines)
        later = f" {waiting:5d} wait for their case" if waiting else ""
        if confirms(name):
            later += f"; off by {largest:.2g} of the uncertainty at most"
        print(f"{name:<24} {good:5d} rows agree {len(lines):5d} differ{later}", flush=True)
        for line in lines:
            print(f"  {line}")
    for key in [
            k for k, row in stored.items()
            if whole and k not in seen and row["kind"] != "consensus" and
            (everything or row["kind"] == "exact")
    ]:
        differ += 1
        print(f"  {key}: {stored[key]['kind']}, but no program derives it")
    print(f"{agree} rows agree, {differ} differ")
    return 1 if differ or agree == 0 else 0


def main(arguments):
    names = [a for a in arguments if a not in ("--write", "--all")]
    if "--write" in arguments:
        write(programs(names))
        return 0
    return compare(programs(names), not names, "--all" in arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
