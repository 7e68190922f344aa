#include "harness/formulations/forces.h"
#include "harness/formulations/adapted.h"

#include <string.h>

/* An answer. */
enum { OUTCOME, ENERGY, FORCES };

status forces_of(const element_data *d, gather *together, const node_state x[], force_output *out)
{
    static const double none[FORCES + ELEMENT_MAX_COORDINATES * (ELEMENT_MAX_COORDINATES + 1)];
    const size_t n = (size_t)NODE_COORDINATES * (size_t)d->nodes;
    if (together == NULL)
        return d->given->force(adapted_own(d), x, out);
    const double *answer = gather_next(together, adapted_own(d), x);
    if (answer == NULL)
        answer = none;
    if (out->energy != NULL)
        *out->energy = answer[ENERGY];
    if (out->F != NULL)
        memcpy(out->F, answer + FORCES, n * sizeof *answer);
    if (out->K != NULL)
        memcpy(out->K, answer + FORCES + n, n * n * sizeof *answer);
    return (status)answer[OUTCOME];
}

size_t forces_size(const element_data *d)
{
    const int n = NODE_COORDINATES * d->nodes;
    if (d->given->leaves & LEAVES_FORCE)
        return FORCES;
    return (size_t)(d->given->leaves & LEAVES_TANGENT ? FORCES + n : FORCES + n + n * n);
}

void forces_evaluate(const element_type *given, gather *g, int first, int count)
{
    force_output out[GATHER_TOGETHER];
    status outcome[GATHER_TOGETHER];
    for (int i = 0; i < count; i++) {
        double *answer = g->answer + (size_t)(first + i) * g->size;
        out[i] = (force_output){.energy = answer + ENERGY};
        if (!(given->leaves & LEAVES_FORCE))
            out[i].F = answer + FORCES;
        if (!(given->leaves & (LEAVES_FORCE | LEAVES_TANGENT)))
            out[i].K = answer + FORCES + NODE_COORDINATES * g->nodes;
    }
    given->force_many(count, g->data + first, g->x + (size_t)first * (size_t)g->nodes, out,
                      outcome);
    for (int i = 0; i < count; i++)
        g->answer[(size_t)(first + i) * g->size + OUTCOME] = outcome[i];
}
