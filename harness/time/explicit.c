#include "harness/time/explicit.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/time/explicit_impl.h"
#include "harness/time/kinks.h"

static double error_of(const explicit_scheme *s)
{
    double square = 0;
    for (int i = 0; i < s->free; i++)
        square += s->weight[i] * s->error[i] * s->error[i];
    return sqrt(square);
}

static int advance(explicit_scheme *s, const instant *from, double h)
{
    const gsl_odeiv2_system of_motion = {
        .function = explicit_rates, .dimension = 2 * (size_t)s->free + 1, .params = s};
    memset(s->y, 0, (size_t)s->free * sizeof *s->y);
    memcpy(s->y + s->free, from->v, (size_t)s->free * sizeof *s->y);
    s->y[2 * s->free] = from->work;
    return gsl_odeiv2_step_apply(s->stepper, from->time, h, s->y, s->error, NULL, s->dydt,
                                 &of_motion);
}

static status step(motion_scheme *base, const instant *from, double h, instant *to, double *error,
                   step_record *record, fault *f)
{
    explicit_scheme *s = (explicit_scheme *)base;
    const model *m = s->of.c->model;
    s->from = from;
    s->at = to;
    s->end = kinks_before(m, record->path);
    s->outcome = STATUS_OK;
    kinematics_state_copy(m, from->state, to->state);
    if (advance(s, from, h) != GSL_SUCCESS)
        return fault_set(f, s->outcome == STATUS_OK ? STATUS_NOT_CONVERGED : s->outcome, "%s",
                         s->why.text);
    memcpy(to->algorithm, to->a, (size_t)s->all * sizeof *to->a);
    to->time = record->path;
    to->work = s->y[2 * s->free];
    to->dissipated = from->dissipated;
    *error = error_of(s);
    record->remaining = 0;
    return STATUS_OK;
}

static void release(motion_scheme *base)
{
    explicit_scheme *s = (explicit_scheme *)base;
    if (s->stepper != NULL)
        gsl_odeiv2_step_free(s->stepper);
    free(s->y);
    free(s);
}

static status allocate(explicit_scheme *s, fault *f)
{
    const model *m = s->of.c->model;
    const size_t n = (size_t)s->free + 1, all = (size_t)s->all + 1;
    s->y = calloc(6 * n + 3 * all + (size_t)model_memory(m) + ELEMENT_MAX_STRAINS, sizeof *s->y);
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    s->stepper = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2 * (size_t)s->free + 1);
    gsl_set_error_handler(before);
    if (s->y == NULL || s->stepper == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    s->error = s->y + 2 * n;
    s->dydt = s->error + 2 * n;
    s->inc = s->dydt + 2 * n;
    s->residual = s->inc + all;
    s->weight = s->residual + all;
    s->memory = s->weight + all;
    s->still = s->memory + model_memory(m);
    metric_of(m, s->weight);
    return STATUS_OK;
}

status explicit_alloc(const scheme_request *request, motion_scheme **out, fault *f)
{
    const model_size size = model_sizes(request->c->model);
    explicit_scheme *s = calloc(1, sizeof *s);
    *out = NULL;
    if (s == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    *out = &s->base;
    s->base = (motion_scheme){.order = 8, .degree = BETWEEN_QUINTIC, .step = step, .free = release};
    s->of = *request;
    s->free = size.free;
    s->all = size.free + size.driven;
    TRY(explicit_check(request->c->model, request->masses, f));
    return allocate(s, f);
}
