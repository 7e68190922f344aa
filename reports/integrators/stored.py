"""What `beamwork motion --json` wrote, as plain records: runs of integrators, and what became of
long motions with large steps."""
import json
import math
import os
from dataclasses import dataclass, field

FILE = "motion.json"
NOMINAL = {"alpha": 2, "hht": 2, "trapezoidal": 2, "conserving": 2, "radau": 5, "explicit": 8}
USUAL_RHO = 0.9


@dataclass(frozen=True)
class Run:
    """One motion by one integrator. error: of time alone, relative; cost [s] of counted work;
    energy, momentum: largest relative change that nothing explains."""

    scheme: str
    step: float
    tolerance: float
    stiffening: float
    error: float
    order: float
    cost: float
    seconds: float
    iterations: float
    rejected: int
    energy: float
    momentum: float
    status: str
    reason: str

    @property
    def setting(self):
        """What was chosen: the tolerance where steps follow it, else the step."""
        return f"tolerance {self.tolerance:.2g}" if self.tolerance else f"step {self.step:.3g} s"

    @property
    def known(self):
        return self.status == "ok" and math.isfinite(self.error)


@dataclass(frozen=True)
class Cell:
    """What became of a long motion. outcome: exact, bounded, grows or stops."""

    scheme: str
    step: float
    stiffening: float
    outcome: str
    iterations: float
    energy: float
    reason: str


@dataclass
class Problem:
    """A formulation on a mesh of a case."""

    case: str
    formulation: str
    elements: int
    runs: list
    cells: list = field(default_factory=list)

    @property
    def name(self):
        return f"{self.case}, {self.formulation}, n = {self.elements}"

    def schemes(self):
        """In the order of NOMINAL, those with options behind."""
        return ordered({r.scheme for r in self.runs} | {c.scheme for c in self.cells})


def ordered(schemes):
    known = list(NOMINAL)

    def place(scheme):
        name = scheme.partition(":")[0]
        return known.index(name) if name in known else len(known), scheme

    return sorted(schemes, key=place)


def nominal(scheme):
    """The order that a scheme should have, or NaN."""
    return NOMINAL.get(scheme.partition(":")[0], math.nan)


def number(row, name, other=math.nan):
    value = row.get(name)
    return other if value is None else float(value)


def scheme_of(row):
    """Its name, with the radius where it is not the usual one."""
    rho = number(row, "rho", USUAL_RHO)
    plain = row["integrator"] != "alpha" or rho == USUAL_RHO
    return row["integrator"] + ("" if plain else f":rho={rho:g}")


def run_of(row):
    return Run(scheme_of(row), number(row, "step"), number(row, "tolerance", 0),
               number(row, "stiffening", 1), number(row, "error"), number(row, "order"),
               number(row, "cost"), number(row, "seconds"), number(row, "iterations_per_step"),
               int(number(row, "rejected", 0)), number(row, "energy_drift"),
               number(row, "momentum_drift"), row.get("status", "ok"), row.get("reason", ""))


def cell_of(row):
    return Cell(scheme_of(row), number(row, "step"), number(row, "stiffening", 1), row["outcome"],
                number(row, "iterations_per_step"), number(row, "energy_drift"),
                row.get("reason", ""))


def problem_of(row):
    return Problem(row["case"], row["formulation"], int(row["elements"]),
                   [run_of(r) for r in row["runs"]], [cell_of(c) for c in row.get("stability", ())])


def read(path):
    """[Problem], or None where there is no such file."""
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return [problem_of(row) for row in json.load(file)["cases"]]


def beside(results):
    """The same of the file beside the results."""
    return read(os.path.join(os.path.dirname(os.path.abspath(results)), FILE))
