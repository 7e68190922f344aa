#include <stdio.h>
#include <unistd.h>

#include "harness/cli/cli_impl.h"
#include "harness/experiments/experiments.h"

static int is_named(const bench_options *r)
{
    return r->of.line->arguments > 0 || r->of.scene != NULL;
}

static status measure(bench_options *r, bench *b, fault *f)
{
    const bench_request requested = {.cases = r->of.line->argument,
                                     .scene =
                                         r->of.scene != NULL ? scene_file_case(r->of.scene) : NULL,
                                     .count = r->of.line->arguments,
                                     .assignment = r->of.set.text,
                                     .assignments = r->of.set.count,
                                     .mesh = r->meshes.elements,
                                     .meshes = r->meshes.count,
                                     .cells = {.select = r->select,
                                               .jobs = r->jobs,
                                               .whole_only = 1,
                                               .formulations = r->chosen.formulations,
                                               .formulation = r->chosen.formulation,
                                               .progress = isatty(STDERR_FILENO) ? stderr : NULL},
                                     .threads = r->solver.threads,
                                     .dense = r->dense};
    const experiment_output to = {.results = r->output, .format = r->format};
    TRY(files_check_results(r->of.line, 1, user_tables_packed(&r->truths), f));
    TRY(case_input_truths(&r->of, &r->truths, &b->truths, f));
    return experiment_do(&experiment_bench, &requested, &to, b, f);
}

static int answer(const command_line *l, void *request)
{
    bench_options *r = request;
    (void)l;
    bench b = {.named = 0};
    fault f = {""};
    if (r->against != NULL)
        return bench_against_run(r);
    if (r->of.scene_path != NULL && case_input_find(&r->of) == NULL)
        return r->of.refusal;
    if (r->error != NULL || r->solver.keep_all)
        return message_fail(STATUS_REFUSED,
                            "--error and --all-dofs apply only to a comparison; add, for example, "
                            "--against collocation, or remove these options");
    if (!is_named(r) && (r->of.set.count > 0 || r->meshes.count > 0))
        return message_fail(
            STATUS_REFUSED,
            "--set and -n require a case; name one, such as 'beamwork bench elastica -n 1,2'");
    const status outcome = measure(r, &b, &f);
    bench_free(&b);
    return message_exit(outcome, &f);
}

/* Restarts the program with single-threaded libraries. arguments: the words of the command line
 * after the name of the program. */
static void before(char **arguments)
{
    rounds_single_thread(arguments - 1);
}

#define IN(at) .member = offsetof(bench_options, at)
static const verb_option own[] = {
    {"output", 'o', "FILE",
     "write to this results file (HDF5), next to the results of other experiments", IN(output),
     .traits = OPTION_OUTPUT},
    {"dense", 0, NULL, "also time the published algorithm (newton=dense) on every mesh", IN(dense)},
    {"against", 0, "OTHER",
     "compare with another formulation in alternating runs, at equal error or, with -n, on these "
     "meshes; or with another build of beamwork (a path that contains a '/'), on the same mesh",
     IN(against), .traits = OPTION_INPUT},
    {"error", 0, "R[,R...]",
     "with --against: errors at which to compare, such as 1%,0.1% (default: the errors among 10, "
     "1, 0.1 and 0.01 % that both formulations achieve)",
     IN(error)},
    {"inject-slowdown", 0, "PERCENT",
     "add this percentage to the time of OTHER, to check that the comparison detects the slowdown",
     IN(slowdown), .least = 0, .most = 1000},
    {0}};
static const verb_group shared[] = {
    SHARED(case, of),       SHARED(formulations, chosen), SHARED(meshes, meshes),
    SHARED(select, select), SHARED(solver, solver),       SHARED(user_truths, truths),
    SHARED(format, format), SHARED(jobs, jobs),           {NULL, 0}};
const verb verb_bench = {
    "bench",
    "[CASE...]",
    "measures error against run time, and the lowest cost for a given error",
    "Times every formulation and mesh of the named cases; without a case, of all cases at all "
    "parameter points that have a reference value (select with -k). Each time is the shortest of "
    "many repetitions in five alternating rounds on one processor, separately for set-up and "
    "solution. If the rounds of two times overlap, their comparison is undecided. --against "
    "FORMULATION runs two formulations alternately until the difference of their times is "
    "significant or the comparison stays undecided. For each error, a formulation uses the "
    "coarsest mesh of the case that is within the error, together with all finer meshes, in all "
    "quantities (-k selects); -n gives the meshes instead. --against PROGRAM times the same run "
    "with another "
    "build of beamwork.",
    "beamwork bench spherical_joint -f sheet_third -f collocation -n 1,2\n"
    "beamwork bench c_column -f collocation --against beamw_consistent --error 1%,0.1%\n"
    "beamwork bench --scene leaf.yaml --against ../before/beamwork",
    shared,
    own,
    sizeof(bench_options),
    .place = VERB_EVALUATE + 20,
    .answer = answer,
    .before = before};
