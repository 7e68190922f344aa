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

size_t motion_state_ends(const model *m)
{
    return 6 * (size_t)model_releases(m);
}

status motion_state_alloc(const model *m, motion_state *out, fault *f)
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
            return fault_memory(f, "damping");
        out->strain2 = out->strain + strains_of(m);
    }
    if (motion_state_ends(m) > 0)
        out->ends = calloc(motion_state_ends(m), sizeof *out->ends);
    if (out->v == NULL || out->a == NULL || out->algorithm == NULL ||
        (motion_state_ends(m) > 0 && out->ends == NULL))
        return fault_memory(f, "a state of a motion");
    return kinematics_state_alloc(m, &out->state, f);
}

void motion_state_free(motion_state *i)
{
    free(i->v);
    free(i->a);
    free(i->algorithm);
    free(i->ends);
    free(i->strain);
    kinematics_state_free(i->state);
}

void motion_state_copy(const model *m, const motion_state *from, motion_state *to)
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
        memcpy(to->ends, from->ends, motion_state_ends(m) * sizeof *to->ends);
    if (from->strain != NULL)
        memcpy(to->strain, from->strain, 2 * strains_of(m) * sizeof *to->strain);
    kinematics_state_copy(m, from->state, to->state);
}

void motion_state_recall(const motion_state *from, newton_convergence *a)
{
    a->stress = from->stress;
    a->contraction = from->contraction;
}

void motion_state_store(const newton_convergence *a, motion_state *to)
{
    to->stress = a->stress;
    to->contraction = a->contraction;
}
