#include "harness/newton/predictor.h"

#include <math.h>

#include "harness/model/model.h"
#include "harness/newton/extrapolate.h"

/* Of many elements fewer states are kept, which are as good: iterations of sheet_cantilever,
 * spherical_joint and hexapod are the same with eight as with twelve. */
enum { MANY_ELEMENTS = 1000, OF_MANY = 8 };
/* Of the first step, so that a line may go on from it. */
enum { EASY_ITERATIONS = 4 };
/* Largest error of a guess, relative to that of no guess, with which it spares iterations. */
static const double worthwhile = 0.3;

/* The last k of the first `count` states. */
static const model_state *const *last(const predictor *t, int count, int k)
{
    return (const model_state *const *)t->at + count - k;
}

status predictor_alloc(const model *m, predictor *t, fault *f)
{
    const int many = model_sizes(m).elements >= MANY_ELEMENTS;
    *t = (predictor){.most = many ? OF_MANY : MODEL_EXTRAPOLATED};
    t->count = 1; /* the undeformed state */
    return kinematics_state_alloc(m, &t->at[0], f);
}

void predictor_free(predictor *t)
{
    for (int i = 0; i <= MODEL_EXTRAPOLATED; i++)
        kinematics_state_free(t->at[i]);
}

void predictor_forget(predictor *t)
{
    t->count = 0;
}

status predictor_add(const equations *eq, const model_state *s, int iterations, predictor *t,
                     fault *f)
{
    const model *m = eq->m;
    t->iterations = iterations;
    if (t->count == t->most + 1) {
        model_state *oldest = t->at[0];
        for (int i = 1; i <= t->most; i++)
            t->at[i - 1] = t->at[i];
        t->at[--t->count] = oldest;
    }
    if (t->at[t->count] == NULL)
        TRY(kinematics_state_alloc(m, &t->at[t->count], f));
    kinematics_state_copy(m, s, t->at[t->count]);
    for (int k = 1; k <= MODEL_EXTRAPOLATED; k++)
        t->error[k] = INFINITY;
    extrapolate_errors(eq, t->count, last(t, t->count, t->count), t->error);
    t->count++;
    return STATUS_OK;
}

/* From as many states as would have guessed the last one best; from one more where the error still
 * went down with their number. 0: better from none. */
static int states_of_least_error(const predictor *t)
{
    int best = 2;
    for (int k = 3; k < t->count && k <= t->most; k++)
        if (t->error[k] < t->error[best])
            best = k;
    if (isinf(t->error[best])) /* nothing is known of guesses */
        return t->iterations <= EASY_ITERATIONS ? 2 : 0;
    if (!(t->error[best] < worthwhile * t->error[1]))
        return 0;
    return best + 1 == t->count && best < t->most ? best + 1 : best;
}

void predictor_guess(const equations *eq, const predictor *t, double path, model_state *s)
{
    for (int k = t->count >= 2 ? states_of_least_error(t) : 0; k >= 2; k--)
        if (extrapolate_state(eq, k, last(t, t->count, k), path, s))
            return;
}
