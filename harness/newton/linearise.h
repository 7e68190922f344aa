/* Newton's equations of a state. */
#ifndef BEAMWORK_MODEL_LINEARISE_H
#define BEAMWORK_MODEL_LINEARISE_H

#include "harness/model/model.h"
#include "harness/newton/loads.h"
#include "harness/newton/run_state.h"

/* Internal less external force of every coordinate is what equilibrium makes zero on the free ones.
 * Mixed linearisation (simultaneous in coordinates, strains and stresses; N section 4), condensed
 * per element:
 *   K dx = f(path) - J^T [P'(e) + P''(e) (D(x) - e)],  K = J^T P'' J + sum sigma_i H_i
 * The driven part of dx is known: its share is taken to the right-hand side here. */
typedef struct model_linearisation {
    double path;
    int displacement;    /* 1: displacement-only Newton: e and sigma are taken from D(x) first */
    const double *drive; /* [free + driven] increments; only the driven part is read; NULL: none */
    int conditions;      /* columns of K wanted for the unknowns of conditions ... */
    const model_condition *condition;
    double *column; /* ... [conditions x (free + driven)] */
    sparse *K;      /* on a pattern of assemble_pattern; NULL: not wanted */
    double
        *residual; /* [free + driven] right-hand side; of driven coordinates: less their reaction */
    double incompatibility; /* out: max |D(x) - e|/l over elements */
} model_linearisation;
/* One element's part of a linear_memory between linearise_state and advance_state. */
typedef struct model_slot {
    double *J, *C, *sigma, *incompatibility, *along, /* SLOT_* */
        *memory; /* sigma = P'(e) + C incompatibility, incompatibility = D(x) - e */
} model_slot;
static inline model_slot linearise_slot(const model *m, const linear_memory *memory, int element)
{
    model_slot w;
    const int n = model_strains(m);
    w.J = memory->slot + (size_t)element * (size_t)model_work_size(m);
    w.C = w.J + n * model_own_coordinates(m);
    w.sigma = w.C + n * n;
    w.incompatibility = w.sigma + n;
    w.memory = w.incompatibility + n;
    w.along = w.memory + model_memory(m);
    return w;
}

/* Into the memory goes what advance_state takes up. */
status linearise_state(const equations *, const linear_memory *, const model_state *,
                       model_linearisation *, fault *);
/* Forgets the independent strains and stresses: e = D(x), sigma = P'(e). */
status linearise_make_compatible(const equations *, model_state *, fault *);
/* Force and spatial moment that act from outside on a node's frame (loads and reactions) in the
 * state: F[6] [N, N m]. sigma: as internal.h has it. */
void linearise_node_force(const equations *, const model_state *, const double sigma[], int node,
                          double F[6]);
/* out[free + driven] += forces that the stresses of these elements take, and all springs. */
void linearise_add_internal(const equations *, const model_state *, int elements,
                            const int element[], double out[]);

#endif
