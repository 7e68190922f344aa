"""Plain records of a run: cases, their points, series, meshes and verdicts."""
import math
from dataclasses import dataclass, field


@dataclass
class Clock:
    """Times of a run [s]. `least` and `most` are the times of the fastest and the slowest round. For a single run, both
    are setup + solve."""
    setup: float
    solve: float
    least: float
    most: float
    repeats: int
    rounds: tuple = ()


@dataclass
class Kept:
    clock: Clock
    free: int


@dataclass
class Dense:
    """A run with the published algorithm (newton=dense). If `whole` is True, the whole run was timed. Otherwise the time
    is that of one iteration multiplied by the number of iterations."""
    seconds: float
    unknowns: int
    whole: bool


@dataclass
class Mesh:
    n: int
    status: str
    reason: str
    clock: Clock
    free: int
    iterations: int
    left_out: str
    work: dict  # counter -> number
    values: dict = field(default_factory=dict)  # quantity -> value
    errors: dict = field(default_factory=dict)  # quantity -> relative discretisation error
    model_errors: dict = field(default_factory=dict)
    reasons: dict = field(default_factory=dict)  # quantity -> reason why it has no value
    curves: dict = field(default_factory=dict)  # quantity -> (x, value, x name, x unit, unit)
    kept: Kept = None
    parts: dict = field(default_factory=dict)  # part of Newton's iterations -> seconds
    dense: Dense = None
    predictions: dict = field(default_factory=dict)  # quantity -> analytic estimate
    cost: float = math.nan  # cost of counted work, with the cost coefficients of the reference machine [s]
    priced: bool = True  # True if the formulation has separate cost coefficients, False for general ones
    features: str = ""  # physics of the model
    warping: str = ""  # where warping is held or free

    @property
    def seconds(self):
        return self.clock.least


@dataclass
class Verdict:
    """One verdict: columns of the table `verdicts` in SI units. Errors are relative."""

    quantity: str
    verdict: str
    expected: str = "pass"
    as_expected: int = 1
    message: str = ""
    reason: str = ""
    finding: str = ""
    cause: str = ""
    proof: str = ""
    value: float = math.nan
    limit: float = math.nan
    limit_uncertainty: float = math.nan
    order: float = math.nan
    order_uncertainty: float = math.nan
    limit_kind: str = "none"
    noise: float = math.nan
    noise_measured: int = 0
    truth: float = math.nan
    truth_uncertainty: float = math.nan
    truth_kind: str = ""
    theory: str = ""
    source: str = ""
    below_digits: int = 0
    predicted: float = math.nan
    contradicted: float = math.nan
    error: float = math.nan
    tolerance: float = math.nan
    model_truth: float = math.nan
    model_truth_kind: str = ""
    model_theory: str = ""
    model_error: float = math.nan
    reach: dict = field(
        default_factory=dict
    )  # level -> number of elements of the coarsest mesh from which all meshes are within the level


@dataclass
class Series:
    key: str
    summary: str
    source: str
    missing: str
    meshes: list
    verdicts: list
    imported: str = ""  # file of the other program from which the series was read
    model: str = "beam"
    unranked: str = ""  # reason why the series has no rank: derivatives by differences, a misprint, or another process
    is_new: bool = False  # True if not accepted yet, so that verdicts do not affect the exit status
    other: str = ""  # relevant physics that the formulation omits, so that it solves another model
    without: str = ""  # physics that the formulation omits, and the effect of the omission

    @property
    def marks(self):
        return "; ".join(filter(None, (self.unranked, "new, without effect on the exit status" if self.is_new else "")))

    @property
    def label(self):
        other = f"without {self.other}" if self.other else ""
        marks = "; ".join(filter(None, (self.marks, other)))
        return f"{self.key} ({marks})" if marks else self.key


@dataclass
class Point:
    name: str
    parameters: str
    series: list
    units: dict
    others: list = field(default_factory=list)  # series of other programs (reports/data.py)
    noise: float = 1.25  # ratio of costs below which costs tie
    scene: str = ""  # text of the scene file
    meanings: dict = field(default_factory=dict)
    omitted: str = ""  # description of the physics that the scene omits
    assumed: list = field(default_factory=list)  # (kind, assumption about a section)


@dataclass
class Case:
    name: str
    summary: str
    source: str
    points: list
    coverages: list = field(default_factory=list)  # rows with formulation, left_out, series and covered
    parameters: list = field(default_factory=list)  # rows with parameter, unit, default, min, max, choices and summary
