#include "harness/time/stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/complement.h"
#include "harness/time/increment.h"
#include "harness/time/kinks.h"

status stage_alloc(analysis_context *c, const carried_masses *masses, motion_stage *s, fault *f)
{
    const model_size size = model_sizes(c->model);
    const sparse *pattern;
    const size_t all = (size_t)(size.free + size.driven) + 1;
    memset(s, 0, sizeof *s);
    s->c = c;
    s->masses = masses;
    s->free = size.free;
    s->all = size.free + size.driven;
    arrival_start(c->options->criterion, model_leaves(c->model) != 0, size.elements, &s->arrival);
    s->residual = calloc(all, sizeof *s->residual);
    s->dx = calloc(all, sizeof *s->dx);
    if (s->residual == NULL || s->dx == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    if (c->options->newton != NEWTON_DISPLACEMENT)
        TRY(complement_alloc(&c->eq, &s->complement, f));
    TRY(assemble_pattern_in_time(c->model, c->run->patterns, &pattern, f));
    TRY(sparse_alloc_like(pattern, &s->S, f));
    return factor_alloc(pattern, &s->factor, f);
}

void stage_free(motion_stage *s)
{
    free(s->residual);
    free(s->dx);
    complement_free(s->complement);
    sparse_free_values(&s->S);
    factor_free(s->factor);
}

int stage_stands(const arrival *a)
{
    const double near = 1e-4, slow = 0.1;
    return a->correction <= near && a->stress_change <= near && a->correction <= slow * a->before;
}

static void rates_of(const motion_stage *s, stage_rates *r)
{
    for (int i = 0; i < s->free; i++) {
        r->v[i] = r->v0[i] + r->g * r->inc[i];
        r->a[i] = r->a0[i] + r->b * r->inc[i];
    }
}

status stage_direction(motion_stage *s, int fresh, fault *f)
{
    if (fresh)
        TRY(context_factor(s->c, s->factor, &s->S, f));
    memcpy(s->dx, s->residual, (size_t)s->free * sizeof *s->dx);
    memset(s->dx + s->free, 0, (size_t)(s->all - s->free) * sizeof *s->dx);
    factor_solve(s->factor, s->dx);
    context_count_solution(s->c, s->factor, fresh, &s->counted);
    return STATUS_OK;
}

/* dx, from the equations of the present state. fresh 0: with the factors of the iteration before.
 */
static status direction(motion_stage *s, int fresh, double time, const stage_rates *r,
                        model_state *now, step_record *record, fault *f)
{
    const model *m = s->c->model;
    model_linearisation lin = {.path = s->begins ? time : kinks_before(m, time),
                               .K = fresh ? &s->S : NULL,
                               .residual = s->residual};
    const inertia_relation with = {r->b, r->g, r->inc};
    if (s->c->options->newton == NEWTON_DISPLACEMENT)
        TRY(linearise_make_compatible(&s->c->eq, now, f));
    TRY(linearise_state(&s->c->eq, &s->c->run->memory, now, &lin, f));
    inertia_subtract(m, s->masses, now, r->v, r->a, s->residual);
    s->c->run->counters.inertia_evaluations +=
        s->masses->spread ? model_sizes(m).elements * (1 + fresh) : 0;
    if (fresh)
        inertia_add_tangent(&s->c->eq, s->masses, now, r->v, r->a, &with, &s->S);
    record->incompatibility = lin.incompatibility;
    return stage_direction(s, fresh, f);
}

/* What an iteration of a stage works on. */
typedef struct stage_solution {
    motion_stage *s;
    const model_state *from;
    double time;
    stage_rates *r;
    model_state *now;
} stage_solution;

static status correct(void *of, int iteration, newton_correction *out, step_record *record,
                      fault *f)
{
    const stage_solution *one = of;
    motion_stage *s = one->s;
    const model *m = s->c->model;
    const int fresh = iteration == 1 || !stage_stands(&s->arrival);
    TRY(direction(s, fresh, one->time, one->r, one->now, record, f));
    increment_add(m, one->now, s->dx, one->r->inc);
    complement_keep(s->complement, one->now);
    out->at = one->time;
    out->size =
        advance_state(&s->c->eq, &s->c->run->memory, one->now, s->dx, one->time, &out->stress);
    rates_of(s, one->r);
    return STATUS_OK;
}

static void prepare(void *of, int iteration, double correction)
{
    const stage_solution *one = of;
    complement_strains(one->s->complement, one->now, iteration, correction);
}

status stage_solve(motion_stage *s, const model_state *from, double time, stage_rates *r,
                   model_state *now, step_record *record, fault *f)
{
    stage_solution one = {s, from, time, r, now};
    const newton_use use = newton_in_time(s->c, &one, correct, prepare);
    increment_apply(s->c->model, from, r->inc, time, now);
    rates_of(s, r);
    return newton_iterate(s->c, &use, &s->arrival, record, f);
}
