"""Artificial records of integrators in the form that `beamwork motion` writes to a results file."""
import json

from harness.records.test.stored import put_experiment

CONSTANTS = {"alpha": (2, 30), "conserving": (2, 20), "radau": (5, 300)}  # order, and error at step 1
COSTS = {"alpha": 1e-3, "conserving": 4e-3, "radau": 6e-3}  # cost per unit of time with step 1 [s]
STEPS = [0.1 / 2**i for i in range(6)]
LEVELS = (1e-2, 1e-4, 1e-6)
FATE_STEPS, STIFFENINGS = (0.05, 0.1, 0.2, 0.4), (1, 1e3, 1e6)


def run(integrator, step, worse=1.0, **more):
    order, error = CONSTANTS.get(integrator, (2, 30))
    cost = worse * COSTS.get(integrator, 1e-3) / step
    return {"integrator": integrator, "step": step, "tolerance": 0, "status": "ok", "reason": "",
            "stopped": None, "error": worse * error * step**order, "order": order, "cost": cost,
            "seconds": cost, "steps": 10, "rejected": 0, "iterations_per_step": 3.0,
            "energy_drift": 1e-14 if integrator == "conserving" else 1e-4, "momentum_drift": 1e-13,
            "largest_energy": 1, "last_energy": 1, "outcome": "", "parameters": "",
            "has_reference": True, **more}


def fate(integrator, step, stiffening):
    if integrator == "conserving":
        return "exact"
    if integrator == "alpha":
        return "bounded"
    return "bounded" if stiffening == 1 else "stops" if step > 0.1 else "grows"


def large_step(integrator, step, stiffening):
    what = fate(integrator, step, stiffening)
    stops = what == "stops"
    return run(integrator, step, error=None, order=None, outcome=what, has_reference=False,
               status="not_converged" if stops else "ok",
               parameters=f"stiffening={stiffening:g}" if stiffening != 1 else "",
               reason="step 40 does not converge" if stops else "")


def reached(runs):
    out = []
    for level in LEVELS:
        for scheme in CONSTANTS:
            within = [r for r in runs if r["integrator"] == scheme and r["error"] is not None
                      and r["error"] <= level]
            if within:
                best = min(within, key=lambda r: r["cost"])
                out.append({"error": level, "integrator": scheme, "cost": best["cost"],
                            "parameters": "", "step": best["step"], "tolerance": best["tolerance"]})
    return out


def group(case, formulation, runs):
    orders = [{"integrator": s, "nominal": order, "order": order, "order_before": order,
               "floor": 1e-11, "verdict": "pass", "parameters": ""}
              for s, (order, _) in CONSTANTS.items()]
    reference = {"integrator": "radau", "tolerance": 1e-10, "steps": 99, "status": "ok",
                 "reason": "", "uncertainty": 1e-12, "end": 10.0, "alone_from": 5.0,
                 "parameters": ""}
    tables = {"references": [reference], "runs": runs, "orders": orders, "reached": reached(runs)}
    place = {"case": case, "formulation": formulation, "elements": 8}
    return {name: [{**place, **row} for row in rows] for name, rows in tables.items()}


def together(groups):
    return {name: [row for one in groups for row in one[name]] for name in groups[0]}


VERDICT = {"judged": "fate", "case": "pendulum", "parameters": "", "formulation": "collocation",
           "elements": 8, "integrator": "trapezoidal", "steps": "0.2", "verdict": "stops",
           "expected": "stops", "as_expected": True, "why": "energy grows in high modes"}


def record(cases=("pendulum", "free_flight_space"),
           formulations=("geometrically_exact", "collocation")):
    """Returns the record of these cases and formulations. In each combination, the run of radau with the step 0.2 s
    failed."""
    out = []
    for case in cases:
        for k, formulation in enumerate(formulations):
            runs = [run(s, h, worse=1 + 0.3 * k) for s in CONSTANTS for h in STEPS]
            runs += [run("radau", 0.2, error=None, order=None, status="not_converged",
                         reason="step 3 does not converge")]
            large = [large_step(s, h, x) for x in STIFFENINGS for h in FATE_STEPS
                     for s in ("alpha", "trapezoidal", "conserving")]
            out.append(group(case, formulation, runs + large))
    return {**together(out), "verdicts": [VERDICT, {**VERDICT, "steps": "0.1"}], "unexpected": 0,
            "program_version": "0.1.0", "commit": "made up", "clock": "2026-01-01T00:00:00Z"}


def integrator_runs():
    check = {"case": "elbow", "parameters": "time=3", "formulation": "collocation", "elements": 8,
             "distances": [3e-9, 4e-10], "uncertainty": 1e-10, "steps": 50, "reason": ""}
    refused = {**check, "case": "release", "distances": [None, None], "reason": "no inertia"}
    found = record(("elbow", "release", "spin_up"))
    return {**{name: found[name] for name in ("references", "runs", "orders", "reached")},
            "checks": [check, refused],
            "left_out": [{"case": "elbow", "parameters": "", "formulation": "beamw_vlasov",
                          "reason": "does not support shear"}]}


def leave(path, found):
    put_experiment(path, "motion", found)


def write(path, found):
    with open(path, "w", encoding="utf-8") as out:
        json.dump(found, out)
