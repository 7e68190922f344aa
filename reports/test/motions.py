"""Made-up records of integrators, as `beamwork motion --json` writes them."""
import json

CONSTANTS = {"alpha": (2, 30), "conserving": (2, 20), "radau": (5, 300)}  # order, error at step 1
COSTS = {"alpha": 1e-3, "conserving": 4e-3, "radau": 6e-3}  # [s] of a unit of time with step 1


def run(integrator, step, stiffening=1, worse=1.0, **more):
    """A run whose error is what its order makes of its step."""
    order, error = CONSTANTS[integrator]
    return {"integrator": integrator, "rho": 0.9, "step": step, "tolerance": 0,
            "stiffening": stiffening, "error": worse * error * step**order, "order": order,
            "cost": worse * COSTS[integrator] / step, "seconds": COSTS[integrator] / step,
            "iterations_per_step": 3.0, "rejected": 0,
            "energy_drift": 1e-14 if integrator == "conserving" else 1e-4,
            "momentum_drift": 1e-13, "status": "ok", "reason": "", **more}


def cell(integrator, step, stiffening, outcome):
    return {"integrator": integrator, "rho": 0.9, "step": step, "stiffening": stiffening,
            "outcome": outcome, "iterations_per_step": 3.5, "energy_drift": 0.1,
            "reason": "step 40 does not converge" if outcome == "stops" else ""}


def outcome(integrator, step, stiffening):
    """Exact for `conserving`; the trapezoidal rule grows, and stops where both are large."""
    if integrator == "conserving":
        return "exact"
    if integrator == "alpha":
        return "bounded"
    return "bounded" if stiffening == 1 else "stops" if step > 0.1 else "grows"


def record(cases=("pendulum", "free_flight_space"), formulations=("geometrically_exact",
                                                                  "collocation")):
    """Two cases with two formulations each; one run failed."""
    steps = [0.1 / 2**i for i in range(6)]
    out = []
    for case in cases:
        for k, formulation in enumerate(formulations):
            runs = [run(s, h, worse=1 + 0.3 * k) for s in CONSTANTS for h in steps]
            runs += [run("alpha", 0.05, stiffening=x) for x in (1e3, 1e6)]
            runs += [run("radau", 0.2, error=None, order=None, status="not_converged",
                         reason="step 3 does not converge")]
            out.append({"case": case, "formulation": formulation, "elements": 8, "runs": runs,
                        "stability": [cell(s, h, x, outcome(s, h, x))
                                      for s in ("alpha", "trapezoidal", "conserving")
                                      for h in (0.05, 0.1, 0.2, 0.4) for x in (1, 1e3, 1e6)]})
    return {"cases": out}


def write(path, found):
    with open(path, "w", encoding="utf-8") as out:
        json.dump(found, out)
