/* What a run changes besides its states; the model stays. Nothing of it outlives a solution. */
#ifndef BEAMWORK_RUN_STATE_H
#define BEAMWORK_RUN_STATE_H

#include "harness/model/model.h"
#include "harness/numerics/phases.h"

/* Work done so far. */
typedef struct counters {
    long strain_evaluations, stress_evaluations, inertia_evaluations;
    long geometric_evaluations; /* of the stiffness of a prestress */
    long iterations, steps, rejected_steps, factorisations, solutions;
    long factor_entries;
    double factor_flops;
    double dense_operations; /* n^3 of every eigenvalue problem solved densely */
    long negative_pivots;    /* most of a symmetric tangent at a state that was reached */
    double condition; /* largest estimate of the solved systems (factor_condition), where it was
                         asked for; else 0 */
} counters;

typedef struct run_state {
    model *m;
    counters counters;
    phases phases;
} run_state;

/* Of a model, nothing done yet. */
run_state run_state_of(model *);

#endif
