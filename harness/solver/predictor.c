#include "harness/solver/predictor.h"

#include "harness/equations/extrapolate.h"
#include "harness/model/kinematics.h"

enum { SMOOTH_ITERATIONS = 4 };

status predictor_alloc(const model *m, predictor *t, fault *f)
{
    *t = (predictor){0};
    for (int i = 0; i < MODEL_EXTRAPOLATED; i++)
        TRY(kinematics_state_alloc(m, &t->at[i], f));
    t->count = 1; /* the undeformed state */
    return STATUS_OK;
}

void predictor_free(predictor *t)
{
    for (int i = 0; i < MODEL_EXTRAPOLATED; i++)
        kinematics_state_free(t->at[i]);
}

void predictor_forget(predictor *t)
{
    t->count = 0;
}

void predictor_add(const model *m, const model_state *s, int iterations, predictor *t)
{
    t->iterations = iterations;
    if (t->count == MODEL_EXTRAPOLATED) {
        model_state *oldest = t->at[0];
        for (int i = 1; i < MODEL_EXTRAPOLATED; i++)
            t->at[i - 1] = t->at[i];
        t->at[--t->count] = oldest;
    }
    kinematics_state_copy(m, s, t->at[t->count++]);
}

/* With as many states as go on smoothly; behind a bend the older ones are forgotten. */
void predictor_guess(const model *m, predictor *t, double path, model_state *s)
{
    if (t->iterations > SMOOTH_ITERATIONS)
        return;
    for (int first = 0; first + 1 < t->count; first++)
        if (extrapolate_state(m, t->count - first, (const model_state *const *)t->at + first, path,
                              s))
            return;
    if (t->count > 1) {
        kinematics_state_copy(m, t->at[t->count - 1], t->at[0]);
        t->count = 1;
    }
}
