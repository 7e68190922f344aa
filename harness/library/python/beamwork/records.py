"""Tables of results: lists of records, as arrays and as pandas data frames."""
from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy

from . import display, plots

if TYPE_CHECKING:
    import pandas


class Records(list[dict[str, Any]]):
    """A list of records (dicts with the same keys), with columns as arrays and a data frame."""

    def column(self, key: str) -> numpy.ndarray[Any, Any]:
        """Returns the array [records] of a key. The array contains floats if all values are numbers (NaN for None),
        otherwise objects."""
        values = [record.get(key) for record in self]
        if not any(key in record for record in self):
            known = ", ".join(self[0]) if self else "there are no records"
            raise KeyError(f"no column {key!r}: {known}")
        if all(v is None or isinstance(v, (int, float)) for v in values):
            return numpy.array([numpy.nan if v is None else v for v in values], dtype=float)
        return numpy.array(values, dtype=object)

    def where(self, **wanted: Any) -> Records:
        """Returns the records whose keys have these values, for example where(formulation="beamw", elements=2)."""
        return Records(r for r in self if all(r.get(k) == v for k, v in wanted.items()))

    def frame(self) -> pandas.DataFrame:
        """Returns the records as a pandas.DataFrame. Raises ImportError if pandas is not installed."""
        try:
            import pandas  # pylint: disable=import-outside-toplevel
        except ImportError:
            raise ImportError("beamwork: frame() requires pandas; without it, use the "
                              "records, a list of dicts") from None
        found: pandas.DataFrame = pandas.DataFrame.from_records(list(self))
        return found

    def plot(self, x: str, y: str, by: str | Sequence[str] = (), log: bool = False) -> Any:
        """Returns a matplotlib Figure of column y over column x, with a line for each value of `by`, for example
        plot("load", "error", by=["formulation", "elements"], log=True). log: sizes on a logarithmic scale."""
        return plots.records(self, x, y, by, log)

    def _repr_html_(self) -> str:
        keys = list(dict.fromkeys(k for record in self for k in record))
        return display.table(keys, ([display.plain(r.get(k)) for k in keys] for r in self))


class Document(dict[str, Any]):
    """Data that a verb writes as JSON: a dict in which lists of records are Records, its tables.

    tables: {name: Records}.  status: exit status of the program.  passed: True if the status is 0, so all results are
    as expected."""

    def __init__(self, document: dict[str, Any], status: int = 0) -> None:
        super().__init__({key: Records(value) if isinstance(value, list) and all(
            isinstance(one, dict) for one in value) else value for key, value in document.items()})
        self.status, self.passed = status, status == 0

    @property
    def tables(self) -> dict[str, Records]:
        return {key: value for key, value in self.items() if isinstance(value, Records)}

    def frame(self, table: str | None = None) -> pandas.DataFrame:
        """Returns a table as a pandas.DataFrame. table None: the longest table."""
        tables = self.tables
        if table is None:
            table = max(tables, key=lambda name: len(tables[name]))
        if table not in tables:
            raise KeyError(f"no table {table!r}: {', '.join(tables)}")
        return tables[table].frame()

    def plot(self, table: str, x: str, y: str, by: str | Sequence[str] = (), log: bool = False) -> Any:
        """Returns a matplotlib Figure of a table; see Records.plot."""
        return self.tables[table].plot(x, y, by, log)

    def _repr_html_(self) -> str:
        return "".join(display.folded(f"{name}: {len(table)} records", table._repr_html_())
                       for name, table in self.tables.items())


class Convergence(Records):
    """Runs of all formulations and meshes: a record for each quantity of each run.

    Keys: formulation, elements, quantity, unit, status, value, truth, error (relative, NaN: no reference value), cost
    (of counted work, s), seconds_solve and everything else that the program writes about a run.

    limits: Records of formulation, quantity, limit, limit_uncertainty, order, verdict, message.
    answers: Records of formulation, elements, cost, rank: sorted by cost at the error `level`.
    sentence: the conclusion.  document: all data, in the form of `beamwork converge --format json`."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__()
        self.document = document
        self.limits = Records()
        for series in document.get("series", []):
            label = {"case": series["case"], "formulation": series["formulation"]}
            for quantity in series["quantities"]:
                own = {key: value for key, value in quantity.items() if key != "meshes"}
                self.limits.append({**label, **own})
                self.extend({**label, **mesh} for mesh in quantity["meshes"])
        self.answers = Records(document.get("answers", []))
        self.level = document.get("level")
        self.sentence = document.get("sentence", "")

    def __repr__(self) -> str:
        return f"<Convergence, {len(self)} records: {self.sentence}>"

    def plot(self, *quantities: str) -> Any:  # type: ignore[override]
        """Returns a matplotlib Figure of the errors over the number of elements; without names, of all quantities."""
        return plots.convergence(self, quantities)

    def _repr_html_(self) -> str:
        return display.convergence(self)


class Verdicts(Records):
    """Verdicts of formulations on cases: a record for each quantity of each series.

    Keys: case, parameters, formulation, quantity, verdict, expected, as_expected, message, limit, limit_uncertainty,
    truth, error (relative) and everything else that `verify --json` writes.

    outcome: "pass", "fail" or "nothing was judged".
    passed: True if the outcome is "pass": there is a verdict, and no verdict that affects the exit status is
    unexpected.
    broken_contracts: formulations that violate the requirements of the interface, with the violated requirements.
    unexpected: records that differ from the expected ones.  counts: {verdict: number}.
    document: all data, in the form of `beamwork verify --json`."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document.get("verdicts", []))
        self.document = document
        self.counts = document.get("counts", {})
        self.unexpected = Records(r for r in self if not r.get("as_expected", True))
        self.outcome = document["outcome"]
        self.passed = self.outcome == "pass"
        self.broken_contracts = document["broken_contracts"]

    def __repr__(self) -> str:
        return f"<Verdicts, {display.outcome(self)}>"

    def plot(self) -> Any:  # type: ignore[override]
        """Returns a matplotlib Figure of the number of each verdict for each formulation."""
        return plots.verdicts(self)

    def _repr_html_(self) -> str:
        return display.verdicts(self)
