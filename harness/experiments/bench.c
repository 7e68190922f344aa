#include "harness/experiments/bench.h"

#include "harness/experiments/timing.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

enum { MOST = 64 };                        /* formulations */
static const double floor_seconds = 0.002; /* of each round for each cell */

static int all_formulations(formulation out[MOST])
{
    int count = 0;
    while (formulations_at(count) != NULL && count < MOST) {
        formulation_default(formulations_at(count), &out[count]);
        count++;
    }
    return count;
}

/* At the parameters given, with the formulations and meshes given (or all, and the case's). */
static status plan_case(const bench_request *r, const case_type *type, sweep *s, fault *f)
{
    double parameter[CASE_MAX_PARAMETERS];
    formulation all[MOST];
    const int some = r->cells.formulations, count = some > 0 ? some : all_formulations(all);
    parameters_default(type, parameter);
    for (int k = 0; k < r->assignments; k++)
        TRY(parameters_set(type, r->assignment[k], parameter, f));
    TRY(plan_add(s, type, parameter, NULL, r->mesh, r->meshes, f));
    const sweep_point *here = &s->point[s->points - 1];
    if (here->status != STATUS_OK)
        return fault_set(f, here->status, "%s", here->reason);
    return plan_extend(s, some > 0 ? r->cells.formulation : all, count, f);
}

static status plan_named(const bench_request *r, sweep *s, fault *f)
{
    if (r->scene != NULL)
        return plan_case(r, r->scene, s, f);
    for (int i = 0; i < r->count; i++) {
        const case_type *type = case_find(r->cases[i], f);
        TRY(type != NULL ? plan_case(r, type, s, f) : STATUS_REFUSED);
    }
    return STATUS_OK;
}

static status plan(const void *asked, void *found, fault *f)
{
    const bench_request *r = asked;
    bench *b = found;
    b->named = r->count > 0 || r->scene != NULL;
    b->sweep.whole_only = 1; /* times rank, and another model does not */
    TRY(b->named ? plan_named(r, &b->sweep, f) : plan_sweep(&r->cells, &b->truths, &b->sweep, f));
    b->sweep.threads = r->threads;
    b->made = environment_now(r->threads > 1 ? r->threads : 1);
    return STATUS_OK;
}

static status run(const void *asked, void *found, fault *f)
{
    const bench_request *r = asked;
    bench *b = found;
    return run_sweep(&r->cells, &b->sweep, f);
}

/* Times are taken where the verdicts are known. */
static status judge(const void *asked, void *found, fault *f)
{
    const bench_request *r = asked;
    bench *b = found;
    TRY(judgement_make(&b->sweep, &b->truths, 0, &b->judgement, f));
    if (r->threads <= 1)
        rounds_pin();
    return timing_run(&b->sweep, floor_seconds, r->dense, r->cells.progress, f);
}

static experiment_cells cells(const void *found)
{
    const bench *b = found;
    return (experiment_cells){&b->sweep, &b->judgement, &b->made};
}

static status write_form(FILE *to, const char *format, const void *found, fault *f)
{
    const bench *b = found;
    (void)f;
    if (format[0] == 'c')
        csv_timing(to, &b->sweep, &b->judgement);
    else
        table_timing(to, &b->sweep, &b->judgement, b->named);
    return STATUS_OK;
}

void bench_free(bench *b)
{
    judgement_free(&b->judgement);
    sweep_free(&b->sweep);
    truths_free(&b->truths);
}

const experiment_type experiment_bench = {
    .name = "bench", .plan = plan, .run = run, .judge = judge, .cells = cells, .write = write_form};
