#include "harness/experiments/integrators.h"

#include <string.h>

#include "harness/experiments/axis.h"
#include "harness/experiments/pace_judge.h"
#include "harness/experiments/pace_plan.h"
#include "harness/experiments/pace_record.h"
#include "harness/experiments/pace_table.h"

/* All formulations that are asked for at one point. */
static status plan_point(const motion_request *r, motions *m, pace_plan_request *q, fault *f)
{
    TRY(pace_plan_usual(q, f));
    for (int i = 0; i < r->formulations; i++) {
        q->formulation = r->formulation[i];
        TRY(pace_plan_add(&m->pace, q, f));
    }
    return STATUS_OK;
}

static status plan_axis(const motion_request *r, motions *m, const pace_plan_request *q,
                        const sweep_axis *a, fault *f)
{
    double value[CASE_MAX_PARAMETERS];
    if (a->count == 0)
        return fault_set(f, STATUS_REFUSED,
                         "motion takes one --vary, as NAME=A..B/N or NAME=A,B,C");
    memcpy(value, r->parameter, sizeof value);
    for (int i = 0; i < a->count; i++) {
        pace_plan_request one = *q;
        one.parameter = value;
        value[a->index] = axis_value(a, i);
        TRY(plan_point(r, m, &one, f));
    }
    return STATUS_OK;
}

/* All values of the parameter that varies; without one the point itself. */
static status plan_points(const motion_request *r, motions *m, pace_plan_request *q, fault *f)
{
    sweep_axis a;
    if (r->vary == NULL)
        return plan_point(r, m, q, f);
    TRY(axis_read(r->type, r->vary, &a, f));
    const status outcome = plan_axis(r, m, q, &a, f);
    axis_free(&a);
    return outcome;
}

static status plan_motions(const motion_request *r, motions *m, fault *f)
{
    pace_plan_request q = {.type = r->type,
                           .parameter = r->parameter,
                           .elements = r->elements,
                           .method = m->method,
                           .errors = !r->no_errors,
                           .whole = r->no_errors};
    TRY(pace_method_read_list(r->integrators != NULL ? r->integrators : pace_method_all,
                              PACE_LIST_MOST, m->method, &m->methods, f));
    q.methods = m->methods;
    if (r->steps != NULL)
        TRY(pace_list_read("step", r->steps, 2, &q.steps, f));
    if (r->tolerances != NULL)
        TRY(pace_list_read("tolerance", r->tolerances, 100, &q.tolerances, f));
    return plan_points(r, m, &q, f);
}

static status plan(const void *asked, void *found, fault *f)
{
    const motion_request *r = asked;
    motions *m = found;
    m->each = r->each;
    return r->expected != NULL ? pace_verdict_plan(r->expected, &m->pace, &m->verdicts, f)
                               : plan_motions(r, m, f);
}

static status run(const void *asked, void *found, fault *f)
{
    const motion_request *r = asked;
    motions *m = found;
    return pace_judge(&m->pace, &r->cells, f);
}

static status judge(const void *asked, void *found, fault *f)
{
    motions *m = found;
    (void)asked;
    (void)f;
    pace_verdict_reach(&m->pace, &m->verdicts);
    return STATUS_OK;
}

static void print(FILE *to, const void *found)
{
    const motions *m = found;
    pace_table(to, &m->pace, &m->verdicts, m->each);
}

void motions_free(motions *m)
{
    pace_verdict_free(&m->verdicts);
    pace_free(&m->pace);
}

const experiment_type experiment_motion = {.name = "motion",
                                           .plan = plan,
                                           .run = run,
                                           .judge = judge,
                                           .records = pace_records,
                                           .about = &record_pace_all,
                                           .rows = &record_pace_run,
                                           .gather = pace_gather,
                                           .print = print};
