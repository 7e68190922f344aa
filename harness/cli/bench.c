/* Error against run time: every formulation and mesh of cases, timed in rounds on one processor. */
#include <stdio.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/cli/contest.h"
#include "harness/experiments/timing.h"
#include "harness/formulations/case_find.h"
#include "harness/formulations/formulations.h"
#include "harness/records/csv.h"
#include "harness/records/output.h"
#include "harness/records/store.h"
#include "harness/study/plan.h"
#include "harness/study/run.h"
#include "harness/terminal/table_timing.h"

static const double floor_seconds = 0.002; /* of each round for each cell */

static int all_formulations(formulation out[COMMAND_MAX_FORMULATIONS])
{
    int count = 0;
    while (formulations_at(count) != NULL && count < COMMAND_MAX_FORMULATIONS) {
        formulation_default(formulations_at(count), &out[count]);
        count++;
    }
    return count;
}

/* The named cases at the parameters given, with the formulations and meshes given (or all, and the
 * case's). */
static status plan_named(bench_request *r, sweep *s, fault *f)
{
    formulation all[COMMAND_MAX_FORMULATIONS];
    const int some = r->chosen.formulations > 0,
              count = some ? r->chosen.formulations : all_formulations(all);
    const int named = r->of.scene == NULL ? r->of.line->arguments : 1;
    for (int i = 0; i < named; i++) {
        const case_type *type = r->of.scene == NULL ? case_find(r->of.line->argument[i], f)
                                                    : scene_file_case(r->of.scene);
        if (type == NULL)
            return STATUS_REFUSED;
        parameters_default(type, r->of.parameter);
        for (int k = 0; k < r->of.set.count; k++)
            TRY(parameters_set(type, r->of.set.text[k], r->of.parameter, f));
        TRY(plan_add(s, type, r->of.parameter, NULL, r->meshes.elements, r->meshes.count, f));
        const point *here = &s->point[s->points - 1];
        if (here->status != STATUS_OK)
            return fault_set(f, here->status, "%s", here->reason);
        TRY(plan_extend(s, some ? r->chosen.formulation : all, count, f));
    }
    return STATUS_OK;
}

static int is_named(const bench_request *r)
{
    return r->of.line->arguments > 0 || r->of.scene != NULL;
}

static status write_out(const bench_request *r, const sweep *s, const judgement *j, fault *f)
{
    const environment e = environment_now(s->threads > 1 ? s->threads : 1);
    if (r->format[0] == 'c')
        csv_timing(stdout, s, j);
    else
        table_timing(stdout, s, j, is_named(r));
    TRY(r->output != NULL ? store_write(r->output, s, j, &e, f) : STATUS_OK);
    return output_flush(f); /* of the table, which may have no reader */
}

/* With what answer frees. */
static status measure(bench_request *r, truths *t, sweep *s, judgement *j, fault *f)
{
    FILE *progress = isatty(STDERR_FILENO) ? stderr : NULL;
    const sweep_request request = {.select = r->select,
                                   .jobs = r->jobs,
                                   .whole_only = 1,
                                   .formulations = r->chosen.formulations,
                                   .formulation = r->chosen.formulation,
                                   .progress = progress};
    TRY(files_check(r->of.line, 1, own_tables_packed(&r->truths), f));
    TRY(case_input_truths(&r->of, &r->truths, t, f));
    s->whole_only = 1; /* times rank, and another model does not */
    TRY(is_named(r) ? plan_named(r, s, f) : plan_sweep(&request, t, s, f));
    s->threads = r->solver.threads;
    TRY(run_sweep(&request, s, f));
    TRY(judgement_make(s, t, 0, j, f));
    if (s->threads <= 1)
        rounds_pin();
    TRY(timing_run(s, floor_seconds, r->dense, progress, f));
    return write_out(r, s, j, f);
}

static int answer(const command_line *l, void *request)
{
    bench_request *r = request;
    (void)l;
    truths t = {0};
    sweep s = {0};
    judgement j = {0};
    fault f = {""};
    if (r->against != NULL)
        return contest_run(r);
    if (r->of.scene_path != NULL && case_input_find(&r->of) == NULL)
        return r->of.refusal;
    if (r->error != NULL || r->solver.keep_all)
        return message_fail(STATUS_REFUSED, "--error and --keep-all are of --against");
    if (!is_named(r) && (r->of.set.count > 0 || r->meshes.count > 0))
        return message_fail(STATUS_REFUSED, "--set and -n are of a case: name it");
    const status outcome = measure(r, &t, &s, &j, &f);
    judgement_free(&j);
    sweep_free(&s);
    truths_free(&t);
    return message_exit(outcome, &f);
}

/* In a process whose libraries have one thread: main passes what follows the program's name. */
static void before(char **arguments)
{
    rounds_single_thread(arguments - 1);
}

#define IN(at) .member = offsetof(bench_request, at)
static const verb_option own[] = {
    {"output", 'o', "FILE", "results as HDF5", IN(output), .traits = OPTION_OUTPUT},
    {"dense", 0, NULL, "time the published algorithm (newton=dense) beside every cell", IN(dense)},
    {"against", 0, "OTHER",
     "compare in alternation with another formulation (without -n: at equal error), or with "
     "another program (a path with a '/': at equal n)",
     IN(against), .traits = OPTION_INPUT},
    {"error", 0, "R[,R...]",
     "with --against: errors at which to compare, such as 1%,0.1% (default: those of 10, 1, 0.1 "
     "and 0.01 % that both reach)",
     IN(error)},
    {"plant", 0, "PERCENT",
     "make the other slower by that much, to see whether the comparison finds it", IN(plant),
     .least = 0, .most = 1000},
    {0}};
static const verb_group shared[] = {
    SHARED(case, of),       SHARED(formulations, chosen), SHARED(meshes, meshes),
    SHARED(select, select), SHARED(solver, solver),       SHARED(own_truths, truths),
    SHARED(format, format), SHARED(jobs, jobs),           {NULL, 0}};
const verb verb_bench = {
    "bench",
    "[CASE...]",
    "error against run time: the cheapest way to an error",
    "Times every formulation and mesh of the cases named (or, without one, of all cases at all "
    "parameter points that have a truth, selected with -k): the least of enough repetitions in "
    "five alternating rounds on one processor, set-up and solution apart, with the error. Times "
    "whose rounds overlap are undecided. With --against FORMULATION: both at equal error, each "
    "with the least elements from which on the error of every quantity (-k: of those selected) is "
    "within it, in alternation until the noise allows an answer; with -n: at these meshes. With "
    "--against PROGRAM: the same cell of another build.",
    "beamwork bench spherical_joint -f sheet_third -f collocation -n 1,2\n"
    "beamwork bench c_column -f collocation --against beamw_consistent --error 1%,0.1%\n"
    "beamwork bench --scene leaf.yaml --against ../before/beamwork",
    shared,
    own,
    sizeof(bench_request),
    .answer = answer,
    .before = before};
