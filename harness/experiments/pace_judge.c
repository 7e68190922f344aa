#include "harness/experiments/pace_judge.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness/experiments/pace_distance.h"
#include "harness/experiments/pace_drift.h"
#include "harness/experiments/pace_order.h"
#include "harness/study/study.h"

static double distance_of_check(const pace *p, const pace_group *g, int check)
{
    return pace_distance(pace_cell_of(p, g->reference + check), pace_cell_of(p, g->reference),
                         g->analysis);
}

/* By how its error falls with the number of its steps, between its checks. */
static double order_of_reference(const pace *p, const pace_group *g, double near, double far)
{
    const double steps = (double)pace_cell_of(p, g->reference + 1)->solve.steps /
                         (double)pace_cell_of(p, g->reference + 2)->solve.steps;
    return steps > 1 && near > 0 ? log(far / near) / log(steps) : NAN;
}

/* The reference, and what it may be off: errors of its checks fall by a ratio from one to the next,
 * and so does its own, three times as much for safety; where they do not fall, the distance of the
 * nearer one. */
static void judge_reference(const pace *p, pace_group *g)
{
    static const double safety = 3;
    if (g->reference < 0) {
        snprintf(g->reason, sizeof g->reason, "none was asked for");
        return;
    }
    const cell_result *reference = pace_cell_of(p, g->reference);
    const double near = distance_of_check(p, g, 1), far = distance_of_check(p, g, 2);
    g->uncertainty = near * fmin(1, safety * near / far);
    g->order = order_of_reference(p, g, near, far);
    if (reference->solve.status != STATUS_OK)
        snprintf(g->reason, sizeof g->reason, "%s", reference->solve.reason);
    else if (isnan(g->uncertainty))
        snprintf(g->reason, sizeof g->reason, "its check: %.200s",
                 pace_cell_of(p, g->reference + 1 + isfinite(near))->solve.reason);
}

static status errors_of(const pace *p, const pace_group *g, pace_run *r, fault *f)
{
    const scene *s = &pace_point_of(p, r)->scene;
    const cell_result *cell = pace_cell_of(p, r->series),
                      *reference = pace_cell_of(p, g->reference);
    const int own = s->quantities,
              known = cell->solve.quantities == own && reference->solve.quantities >= own;
    r->values = malloc((size_t)(own + 1) * sizeof *r->values);
    if (r->values == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for errors");
    for (int i = 0; i < own; i++)
        r->values[i] = known ? pace_distance_of(&s->quantity[i], &cell->solve.quantity[i],
                                                &reference->solve.quantity[i])
                             : NAN;
    r->error = pace_distance(cell, reference, g->analysis);
    return STATUS_OK;
}

/* [s] of the last step that was kept. */
static double last_instant(const solve_result *r)
{
    return r->steps > 0 ? r->step[r->steps - 1].path : 0;
}

static status judge_run(const pace *p, pace_run *r, fault *f)
{
    const series *s = &p->sweep.series[r->series];
    const pace_group *g = &p->group[r->group];
    const cell_result *cell = &s->cell[0];
    r->status = s->missing[0] == '\0' ? cell->solve.status : STATUS_REFUSED;
    r->reason = s->missing[0] == '\0' ? cell->solve.reason : s->missing;
    r->cost = price_cost(&s->formulation, cell);
    r->seconds = cell->solve.seconds_solve;
    r->steps = cell->solve.steps;
    r->rejected = cell->counters.rejected_steps;
    r->iterations = r->steps > 0 ? (double)cell->solve.iterations / (double)r->steps : NAN;
    r->stopped = r->status != STATUS_OK ? last_instant(&cell->solve) : NAN;
    r->error = NAN;
    pace_drift(p, r);
    return g->reference >= 0 ? errors_of(p, g, r, f) : STATUS_OK;
}

status pace_judge(pace *p, const sweep_request *request, fault *f)
{
    TRY(run_sweep(request, &p->sweep, f));
    for (int i = 0; i < p->groups; i++)
        judge_reference(p, &p->group[i]);
    for (int i = 0; i < p->runs; i++)
        TRY(judge_run(p, &p->run[i], f));
    pace_order_fill(p);
    return STATUS_OK;
}
