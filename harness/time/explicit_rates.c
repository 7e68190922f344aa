#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/drive.h"
#include "harness/time/explicit_impl.h"
#include "harness/time/increment.h"
#include "harness/time/inertia.h"
#include "harness/time/turning.h"

/* inc' = v, but for rotations in the frame's axes. */
static void turn_rates(const explicit_scheme *s, const double inc[], const double v[],
                       double rate[])
{
    const model *m = s->of.c->model;
    memcpy(rate, v, (size_t)s->free * sizeof *rate);
    for (int x = 0; x < model_first_release(m); x++) {
        const mesh_vertex *frame = model_vertex(m, x);
        const int *at = frame->coordinate + SCENE_RX;
        double t[3], W[3], inverse[9], turned[3];
        if (frame->body != x || forms_of(m, x) != FORM_BODY || at[0] >= s->free)
            continue;
        for (int k = 0; k < 3; k++) {
            t[k] = inc[at[k]];
            W[k] = v[at[k]];
        }
        turning_inverse(t, inverse);
        mat3_mul_vec(inverse, W, turned);
        for (int k = 0; k < 3; k++)
            rate[at[k]] = turned[k];
    }
}

/* The unknowns of an element's own, where its strains are given: by Newton, whose steps it knows.
 */
static status settle_rates(const explicit_scheme *s, int i, fault *f)
{
    enum { MOST = 30 };
    const double none = 1e-15;
    const model *m = s->of.c->model;
    const element_data *data = model_kind_of(m, i)->data;
    const double *e = s->at->state->e + (size_t)i * (size_t)model_strains(m);
    double *inner = s->at->state->inner + (size_t)i * (size_t)model_inner(m), before = INFINITY;
    for (int k = 0; k < MOST; k++) {
        model_type(m)->stress(data, e, inner, &(stress_output){.memory = s->memory});
        const double change = model_type(m)->update(data, s->still, s->memory, inner);
        if (change < none || (k > 3 && change < 1e-9 && change >= before))
            return STATUS_OK;
        before = change;
    }
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "element %d: its own equations are not solved in %d steps", i, MOST);
}

static status accelerations(explicit_scheme *s, double time, fault *f)
{
    const model *m = s->of.c->model;
    model_linearisation lin = {.path = time, .residual = s->residual};
    for (int i = 0; i < model_elements(m) && model_inner(m) > 0; i++) {
        node_state x[ELEMENT_MAX_NODES];
        kinematics_gather(m, s->at->state, model_element(m, i), x);
        model_type(m)->strain(
            model_kind_of(m, i)->data, x,
            &(strain_output){.e = s->at->state->e + (size_t)i * (size_t)model_strains(m)});
        TRY(settle_rates(s, i, f));
    }
    TRY(linearise_make_compatible(&s->of.c->eq, s->at->state, f));
    TRY(linearise_state(&s->of.c->eq, &s->of.c->run->memory, s->at->state, &lin, f));
    memset(s->at->a, 0, (size_t)s->free * sizeof *s->at->a);
    inertia_subtract(m, s->of.masses, s->at->state, s->at->v, s->at->a, s->residual);
    return explicit_accelerate(m, s->of.masses, s->at->state, s->at->v, s->residual, s->at->a, f);
}

static int is_finite(int n, const double y[])
{
    for (int i = 0; i < n; i++)
        if (!isfinite(y[i]))
            return 0;
    return 1;
}

int explicit_rates(double t, const double y[], double dydt[], void *context)
{
    explicit_scheme *s = context;
    const model *m = s->of.c->model;
    const double time = t > s->from->time ? fmin(t, s->end) : t;
    if (!is_finite(2 * s->free + 1, y)) {
        s->outcome = fault_set(&s->why, STATUS_NOT_CONVERGED,
                               "at %g s motions grow without bound: the step does not resolve the "
                               "fastest mode of the mesh",
                               t);
        return GSL_EFAILED;
    }
    memcpy(s->inc, y, (size_t)s->free * sizeof *s->inc);
    memcpy(s->at->v, y + s->free, (size_t)s->free * sizeof *s->at->v);
    drive_at(&s->of.c->eq, s->from->state, time, s->inc, s->at->v, s->at->a);
    increment_apply(m, s->from->state, s->inc, time, s->at->state);
    s->outcome = accelerations(s, time, &s->why);
    if (s->outcome != STATUS_OK)
        return GSL_EFAILED;
    turn_rates(s, s->inc, s->at->v, dydt);
    memcpy(dydt + s->free, s->at->a, (size_t)s->free * sizeof *dydt);
    dydt[2 * s->free] = work_power(s->of.work, s->at->state, s->at->v, s->at->a, time, s->at->v);
    return GSL_SUCCESS;
}
