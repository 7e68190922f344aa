#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"

static size_t strains_of(const model *m)
{
    return damping_acts(m) ? (size_t)model_stresses(m) : 0;
}

static size_t coordinates_of(const model *m)
{
    const model_size size = model_sizes(m);
    return (size_t)size.free + (size_t)size.driven;
}

size_t instant_ends(const model *m)
{
    return 6 * (size_t)model_releases(m);
}

status instant_alloc(const model *m, instant *out, fault *f)
{
    const size_t n = coordinates_of(m) + 1;
    memset(out, 0, sizeof *out);
    out->contraction = NAN;
    out->v = calloc(n, sizeof *out->v);
    out->a = calloc(n, sizeof *out->a);
    out->algorithm = calloc(n, sizeof *out->algorithm);
    if (strains_of(m) > 0) {
        out->strain = calloc(2 * strains_of(m), sizeof *out->strain);
        if (out->strain == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for damping");
        out->strain2 = out->strain + strains_of(m);
    }
    if (instant_ends(m) > 0)
        out->ends = calloc(instant_ends(m), sizeof *out->ends);
    if (out->v == NULL || out->a == NULL || out->algorithm == NULL ||
        (instant_ends(m) > 0 && out->ends == NULL))
        return fault_set(f, STATUS_FAULT, "out of memory for a state of a motion");
    return kinematics_state_alloc(m, &out->state, f);
}

void instant_free(instant *i)
{
    free(i->v);
    free(i->a);
    free(i->algorithm);
    free(i->ends);
    free(i->strain);
    kinematics_state_free(i->state);
}

void instant_copy(const model *m, const instant *from, instant *to)
{
    const size_t bytes = coordinates_of(m) * sizeof *from->v;
    to->time = from->time;
    to->work = from->work;
    to->dissipated = from->dissipated;
    to->stress = from->stress;
    to->contraction = from->contraction;
    memcpy(to->v, from->v, bytes);
    memcpy(to->a, from->a, bytes);
    memcpy(to->algorithm, from->algorithm, bytes);
    to->ends_known = from->ends_known;
    if (from->ends_known)
        memcpy(to->ends, from->ends, instant_ends(m) * sizeof *to->ends);
    if (from->strain != NULL)
        memcpy(to->strain, from->strain, 2 * strains_of(m) * sizeof *to->strain);
    kinematics_state_copy(m, from->state, to->state);
}

void instant_recall(const instant *from, arrival *a)
{
    a->stress = from->stress;
    a->contraction = from->contraction;
}

void instant_remember(const arrival *a, instant *to)
{
    to->stress = a->stress;
    to->contraction = a->contraction;
}
