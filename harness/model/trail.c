#include "harness/model/trail.h"

#include "harness/model/extrapolate.h"
#include "harness/model/kinematics.h"

enum { SMOOTH_ITERATIONS = 4 };

status trail_alloc(const model *m, trail *t, fault *f)
{
    *t = (trail){0};
    for (int i = 0; i < MODEL_EXTRAPOLATED; i++)
        TRY(model_state_alloc(m, &t->at[i], f));
    t->count = 1; /* the undeformed state */
    return STATUS_OK;
}

void trail_free(trail *t)
{
    for (int i = 0; i < MODEL_EXTRAPOLATED; i++)
        model_state_free(t->at[i]);
}

void trail_forget(trail *t)
{
    t->count = 0;
}

void trail_add(const model *m, const model_state *s, int iterations, trail *t)
{
    t->iterations = iterations;
    if (t->count == MODEL_EXTRAPOLATED) {
        model_state *oldest = t->at[0];
        for (int i = 1; i < MODEL_EXTRAPOLATED; i++)
            t->at[i - 1] = t->at[i];
        t->at[--t->count] = oldest;
    }
    model_state_copy(m, s, t->at[t->count++]);
}

/* With as many states as go on smoothly; behind a bend the older ones are forgotten. */
void trail_guess(const model *m, trail *t, double path, model_state *s)
{
    if (t->iterations > SMOOTH_ITERATIONS)
        return;
    for (int first = 0; first + 1 < t->count; first++)
        if (model_state_extrapolate(m, t->count - first, (const model_state *const *)t->at + first,
                                    path, s))
            return;
    if (t->count > 1) {
        model_state_copy(m, t->at[t->count - 1], t->at[0]);
        t->count = 1;
    }
}
