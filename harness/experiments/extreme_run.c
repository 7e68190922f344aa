#include "harness/experiments/extreme_run.h"

#include <math.h>
#include <string.h>

#include "harness/experiments/extreme_expect.h"
#include "harness/experiments/extreme_judge.h"
#include "harness/experiments/extreme_record.h"
#include "harness/experiments/extreme_table.h"
#include "harness/study/study.h"

enum { enough_elements = 16 }; /* from here on the neighbours are coarser meshes, else finer ones */

/* A series of neighbouring meshes for the cell of an outcome, once. */
static status refine(extreme_sweep *s, extreme_outcome *o, fault *f)
{
    const series *one = &s->first.series[o->series];
    const sweep_point *p = &s->first.point[o->point];
    if (o->neighbours >= 0)
        return STATUS_OK;
    const int n = one->mesh[0], coarser = n >= enough_elements;
    const int mesh[OUTCOME_NEIGHBOURS] = {coarser ? n / 4 : 2 * n, coarser ? n / 2 : 4 * n};
    s->neighbours.whole_only = 1;
    TRY(plan_add(&s->neighbours, p->type, p->parameter, &p->edit, mesh, OUTCOME_NEIGHBOURS, f));
    sweep_point *same = &s->neighbours.point[s->neighbours.points - 1];
    same->steps = p->steps;
    same->whole_steps = p->whole_steps;
    TRY(plan_extend(&s->neighbours, &one->formulation, 1, f));
    for (int i = 0; i < s->outcomes; i++)
        if (s->outcome[i].series == o->series)
            s->outcome[i].neighbours = s->neighbours.seriess - 1;
    return STATUS_OK;
}

/* A number that may be coarse. */
static int is_open(const extreme_outcome *o)
{
    return o->kind == OUTCOME_WRONG && isfinite(o->error);
}

static status run_cells(const extreme_request *request, sweep *s, fault *f)
{
    const sweep_request run = {.jobs = request->jobs, .progress = request->progress};
    return run_sweep(&run, s, f);
}

static status look_closer(const extreme_request *request, extreme_sweep *s, const truths *t,
                          fault *f)
{
    for (int i = 0; i < s->outcomes; i++) {
        extreme_outcome *o = &s->outcome[i];
        if (!is_open(o))
            continue;
        TRY(refine(s, o, f));
        extreme_outcome *base = extreme_sweep_base(s, o);
        if (extremes[o->extreme].judge == EXTREME_SAME && base != NULL)
            TRY(refine(s, base, f));
    }
    if (s->neighbours.seriess > 0)
        TRY(run_cells(request, &s->neighbours, f));
    for (int i = 0; i < s->outcomes; i++)
        if (is_open(&s->outcome[i]))
            extreme_judge_neighbours(s, t, &s->outcome[i]);
    return STATUS_OK;
}

static status read_all(const char *path, truths *t, extreme_sweep *out, fault *f)
{
    TRY(truths_read(path, t, f));
    TRY(truths_read_extremes(path, t, f));
    return extreme_expect_read(path, out, f);
}

static status plan(const void *asked, void *found, fault *f)
{
    const extreme_request *request = asked;
    extreme_sweep *s = found;
    TRY(read_all(request->truths, &s->truths, s, f));
    return extreme_plan(request, s, f);
}

static status run(const void *asked, void *found, fault *f)
{
    extreme_sweep *s = found;
    return s->outcomes > 0 ? run_cells(asked, &s->first, f) : STATUS_OK;
}

/* What may be coarse is run on other meshes, too. */
static status judge(const void *asked, void *found, fault *f)
{
    const extreme_request *request = asked;
    extreme_sweep *s = found;
    for (int i = 0; i < s->outcomes; i++)
        TRY(extreme_judge_first(s, &s->truths, &s->outcome[i], f));
    TRY(look_closer(request, s, &s->truths, f));
    extreme_expect(s, request->select == NULL && request->formulations == 0);
    return STATUS_OK;
}

const experiment_type experiment_stress = {.name = "stress",
                                           .plan = plan,
                                           .run = run,
                                           .judge = judge,
                                           .records = extreme_records,
                                           .about = &record_extremes_all,
                                           .rows = &record_outcome,
                                           .gather = extreme_gather,
                                           .print = extreme_table};
