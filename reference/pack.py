"""Packs the reference values, the known deviations, the accepted formulations and the glossary into one HDF5 file.

usage: pack.py -o FILE     reference/README.md describes the layout. The file is written completely or not at all.
"""
import argparse
import csv
import fnmatch
import math
import os
import pathlib
import sys
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from reference.accepted import ACCEPTED_COLUMNS, read_accepted  # noqa: E402
from reference.glossary import GLOSSARY_COLUMNS, read_glossary  # noqa: E402
from reference.table import Refused, read_csv  # noqa: E402

VERSION = 4  # version of the packed file, equal to TRUTHS_VERSION of harness/study/study.h
HERE = pathlib.Path(__file__).resolve().parent
COLUMNS = "case,parameters,formulation,theory,elements,quantity,at,value,unit,uncertainty,kind,model,convention,source".split(",")
FINDING_COLUMNS = "rule,formulations,cases,condition,quantities,verdicts,largest_error,predicted,cause,proof".split(",")
EXTREME_COLUMNS = "extreme,from,to,formulation,quantity,outcome,proof".split(",")
OUTCOMES = ("value", "coarse", "wrong", "not converged", "singular", "refused", "no value", "fault")
KINDS = ("exact", "predicted", "independent", "consensus", "agreement", "published", "reconstructed", "experiment", "unrepeatable")
MODELS = ("same", "other")
THEORIES = ("", "engesser", "haringx")
MOMENTS, ROTATIONS = ("", "spatial", "semitangential", "symmetrised"), ("", "vector", "RyRzRx")
CONVENTIONS = tuple(f"{moment} {rotation}".strip() for moment in MOMENTS for rotation in ROTATIONS)
TRUTH_FOLDERS = ("tables", "predicted")
VERDICTS = ("biased", "biased, as predicted", "wrong limit", "wrong limit, as predicted", "undecided", "low order", "diverged", "refused")


def fnv1a(text):
    value = 14695981039346656037
    for byte in text.encode():
        value = (value ^ byte) * 1099511628211 % 2 ** 64
    return value


def read_defaults(path):
    cases = {}
    for number, row in read_csv(path, ["case", "parameter", "value", "choices"]):
        table = cases.setdefault(row["case"], [])
        if row["parameter"] in [name for name, _, _ in table]:
            raise Refused(f"{path.name}:{number}: parameter '{row['parameter']}' is given twice")
        table.append((row["parameter"], finite(row["value"], f"{path.name}:{number}: value"), row["choices"].split("|") if row["choices"] else []))
    return cases


def parameter_hash(table, parameters, where):
    """Returns the FNV-1a hash of "name=%.17g;" over all parameters, with the indices of choices and with "name=*;" for
    any value."""
    given = {}
    everything = parameters == "*"
    for item in ([] if everything else filter(None, parameters.split(";"))):
        name, equals, value = item.partition("=")
        if not equals or name in given:
            raise Refused(f"{where}: '{item}' is not name=value, or is given twice")
        given[name] = value
    text = ""
    for name, default, choices in table:
        value = given.pop(name, None)
        if everything or value == "*":
            text += f"{name}=*;"
            continue
        if value is None:
            number = default
        elif choices:
            if value not in choices:
                raise Refused(f"{where}: {name}={value} is none of {'|'.join(choices)}")
            number = choices.index(value)
        else:
            number = finite(value, f"{where}: {name}")
        text += f"{name}={number:.17g};"
    if given:
        raise Refused(f"{where}: unknown parameter '{next(iter(given))}'")
    return fnv1a(text)


def finite(text, where):
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise Refused(f"{where}: '{text}' is not a finite number")
    return value


def count(text, where):
    if text and (not text.isdecimal() or int(text) == 0):
        raise Refused(f"{where}: elements '{text}' is not a number above zero; leave it empty for the continuum")
    return int(text or 0)


def check_truth(row, where, defaults):
    if row["case"] not in defaults:
        raise Refused(f"{where}: unknown case '{row['case']}'")
    if row["kind"] not in KINDS or row["model"] not in MODELS:
        raise Refused(f"{where}: kind '{row['kind']}' or model '{row['model']}' is not known")
    if not row["unit"] or not row["quantity"] or not row["source"]:
        raise Refused(f"{where}: unit, quantity and source must be given")
    row["value"] = finite(row["value"], f"{where}: value")
    row["uncertainty"] = finite(row["uncertainty"], f"{where}: uncertainty")
    if row["uncertainty"] < 0:
        raise Refused(f"{where}: negative uncertainty")
    row["at"] = finite(row["at"], f"{where}: at") if row["at"] else math.nan
    row["elements"] = count(row["elements"], where)
    if row["kind"] == "predicted" and (not row["formulation"] or row["elements"]):
        raise Refused(f"{where}: a predicted limit needs a formulation and no elements")
    if row["kind"] != "predicted" and bool(row["formulation"]) != (row["elements"] > 0):
        raise Refused(f"{where}: a discrete value needs formulation and elements, a value of the continuum neither")
    row["hash"] = parameter_hash(defaults[row["case"]], row["parameters"], where)
    check_words(row, where, [name for name, _, _ in defaults[row["case"]]])


def check_words(row, where, names):
    """Checks that theory and convention are among the allowed words, and that they are consistent with the parameters
    of the row."""
    given = dict(item.split("=", 1) for item in row["parameters"].split(";") if "=" in item)
    if row["theory"] not in THEORIES:
        raise Refused(f"{where}: theory '{row['theory']}' is none of {'|'.join(THEORIES[1:])}")
    stability = given.get("shear_stability", "engesser") if "shear_stability" in names else row["theory"]
    if row["theory"] and row["theory"] != stability:
        raise Refused(f"{where}: theory '{row['theory']}', but shear_stability={stability}")
    if row["convention"] not in CONVENTIONS:
        raise Refused(f"{where}: convention '{row['convention']}' is none of {'|'.join(CONVENTIONS[1:])}")
    moments = row["convention"].split(" ")[0] if row["convention"].split(" ")[0] in MOMENTS else ""
    asked = given.get("moment_convention", "spatial") if "moment_convention" in names and row["quantity"].startswith("C_") else moments
    if moments != asked:
        raise Refused(f"{where}: convention '{row['convention']}', but moment_convention={asked}")


def truth_key(row):
    """Returns the key that distinguishes a reference value from all others. The key of an exact value does not
    contain its source, because two programs must not derive the same exact value."""
    return tuple("" if name == "source" and row["kind"] == "exact" else repr(row[name]) if name == "at" else row[name]
                 for name in ("case", "hash", "formulation", "theory", "elements", "quantity", "at", "kind", "model", "convention", "source"))


def read_truths(folders, defaults):
    """Returns {case: rows} from the tables in the folders. Raises Refused if a row is invalid or
    given twice, or if the units of a quantity of a case differ."""
    cases, seen, units = {}, {}, {}
    for path in [path for folder in folders for path in sorted(folder.glob("*.csv"))]:
        for number, row in read_csv(path, COLUMNS):
            where = f"{path.parent.name}/{path.name}:{number}"
            check_truth(row, where, defaults)
            key = truth_key(row)
            if key in seen:
                raise Refused(f"{where}: the same row as {seen[key]}")
            seen[key] = where
            unit, first = units.setdefault((row["case"], row["quantity"]), (row["unit"], where))
            if unit != row["unit"]:
                raise Refused(f"{where}: {row['quantity']} in {row['unit']}, but in {unit} at {first}")
            cases.setdefault(row["case"], []).append(row)
    return cases


def scene_names():
    return [path.stem for path in (pathlib.Path(__file__).resolve().parents[1] / "cases/examples").glob("*.yaml")]


def read_findings(path, defaults):
    rows, seen = [], {}
    for number, row in read_csv(path, FINDING_COLUMNS):
        where = f"{path.name}:{number}"
        if not row["rule"] or " " in row["rule"]:
            raise Refused(f"{where}: rule '{row['rule']}' must be one word")
        if row["rule"] in seen:
            raise Refused(f"{where}: the same rule as {seen[row['rule']]}")
        seen[row["rule"]] = where
        for name in ("formulations", "cases", "quantities", "verdicts", "cause", "proof"):
            if not row[name]:
                raise Refused(f"{where}: a finding needs {name}")
        for case in row["cases"].split():
            if not fnmatch.filter([*defaults, *scene_names()], case):
                raise Refused(f"{where}: unknown case '{case}'")
        for verdict in row["verdicts"].split("|"):
            if verdict not in VERDICTS:
                raise Refused(f"{where}: verdict '{verdict}' is none of {', '.join(VERDICTS)}")
        for word in row["predicted"].split():
            if word.partition("/")[0] not in defaults or not word.partition("/")[2]:
                raise Refused(f"{where}: prediction '{word}' is not case/quantity")
        text = row["largest_error"]
        row["largest_error"] = finite(text, f"{where}: largest_error") if text else math.nan
        rows.append(row)
    return rows


def read_extreme_findings(path):
    rows = []
    for number, row in read_csv(path, EXTREME_COLUMNS):
        where = f"{path.name}:{number}"
        row["from"], row["to"] = finite(row["from"], f"{where}: from"), finite(row["to"], f"{where}: to")
        if row["from"] > row["to"]:
            raise Refused(f"{where}: from {row['from']:g} to {row['to']:g} is an empty range")
        if row["outcome"] not in OUTCOMES:
            raise Refused(f"{where}: unknown outcome '{row['outcome']}'")
        if not row["proof"]:
            raise Refused(f"{where}: a finding needs its proof")
        rows.append(row)
    return rows


# [bytes] larger tables are compressed; in smaller ones, decompression takes more time than it saves.
COMPRESSED = 16384


def column_of(name, values):
    import numpy
    if values and not isinstance(values[0], str) or name in ("largest_error", "from", "to"):
        return numpy.array(values, dtype={"elements": "i4", "hash": "u8"}.get(name, "f8"))
    encoded = [v.encode() for v in values]
    return numpy.array(encoded, dtype=f"S{max([1] + [len(v) for v in encoded])}")


def write_table(group, table, rows, names):
    """Writes a data set of a compound type: one row is stored after the other, and one chunk contains all of them."""
    import numpy
    columns = [column_of(name, [row[name] for row in rows]) for name in names]
    data = numpy.rec.fromarrays(columns, names=names).view(numpy.ndarray)
    large = data.nbytes > COMPRESSED
    group.create_dataset(table, data=data, compression="gzip" if large else None, chunks=data.shape if large else None)


def seal(path):
    """Appends the line by which the program detects a truncated, damaged or altered file. The line contains the length
    and the CRC-32 of the preceding contents."""
    with open(path, "rb+") as file:
        data = file.read()
        file.write(b"beamwork-seal %016x %08x\n" % (len(data), zlib.crc32(data)))


def pack(folder, out):
    import h5py
    import numpy
    defaults = read_defaults(folder / "defaults.csv")
    truths = read_truths([folder / name for name in TRUTH_FOLDERS], defaults)
    findings = read_findings(folder / "findings.csv", defaults)
    glossary = read_glossary(folder / "glossary.csv")
    accepted = read_accepted(folder / "accepted.csv")
    extremes = read_truths([folder / "extremes"], defaults)
    extreme_findings = read_extreme_findings(folder / "extreme_findings.csv")
    temporary = f"{out}.part{os.getpid()}"
    try:
        with h5py.File(temporary, "w") as file:
            file.attrs["schema"] = numpy.bytes_("beamwork-truths")
            file.attrs["version"] = VERSION
            group = file.create_group("truths")
            for case, rows in sorted(truths.items()):
                write_table(group, case, rows, COLUMNS[1:] + ["hash"])
            write_table(file, "findings", findings, FINDING_COLUMNS)
            write_table(file, "glossary", glossary, GLOSSARY_COLUMNS)
            write_table(file, "accepted", accepted, ACCEPTED_COLUMNS)
            group = file.create_group("extremes")
            for case, rows in sorted(extremes.items()):
                write_table(group, case, rows, COLUMNS[1:] + ["hash"])
            write_table(file, "extreme_findings", extreme_findings, EXTREME_COLUMNS)
        seal(temporary)
        os.replace(temporary, out)
    finally:
        if os.path.exists(temporary):
            os.unlink(temporary)
    return sum(len(rows) for rows in truths.values()), len(findings)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", dest="out", required=True, help="HDF5 file to write")
    parser.add_argument("--folder", type=pathlib.Path, default=HERE, help=argparse.SUPPRESS)
    given = parser.parse_args(arguments)
    try:
        truths, findings = pack(given.folder, given.out)
    except (Refused, OSError, UnicodeDecodeError, csv.Error) as why:
        print(f"pack.py: {why}", file=sys.stderr)
        return 1
    print(f"  packed {truths} truths and {findings} findings")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
