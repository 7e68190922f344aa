#include "harness/cli/cli_impl.h"

#include <limits.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

typedef struct verify_request {
    chosen_formulations chosen;
    scenes_options scenes;
    report_options reports;
    shard_options shards;
    const char *select, *output;
    text_list imported;
    int imported_must_pass; /* 1: verdicts on these programs affect the exit status */
    int exit_zero;
    double tolerance; /* relative tolerance that replaces those of the cases */
    const char *former;
    int refine; /* number of additional meshes, each with twice as many elements */
    int shapes; /* number of states of a path whose shapes are stored; 0: none */
    /* verbose 1: every limit is printed; shards.quiet 1: only unexpected results are printed */
    int verbose;
} verify_request;

enum { PICTURED_STATES = 5 };

static int report(const verify_request *r, const sweep *s, const evaluation *j, const spread_end *e)
{
    int first = 0;
    const given_option *file = given_next(r->shards.line, OPTION_OUTPUT, &first);
    char partial[PATH_MAX];
    if (e->ended)
        return e->code;
    if (s->unfinished > 0) {
        fprintf(stderr, "beamwork: %s: %d %s not computed; the existing verdicts are ",
                r->shards.partial ? "incomplete" : "interrupted", s->unfinished,
                s->unfinished == 1 ? "run was" : "runs were");
        if (file != NULL && output_partial(file->value, partial, NULL) == STATUS_OK)
            fprintf(stderr, "in %s\n", partial);
        else
            fprintf(stderr, "above\n");
        return EXIT_INTERRUPTED;
    }
    const int code = evaluation_exit(j);
    if (code == EXIT_NOTHING)
        fprintf(stderr, "beamwork: no verdict, because there is no reference value; see %s\n",
                r->scenes.scene.count > 0 ? "'truths' in 'beamwork scene --keys'"
                                          : "'beamwork list' and -k");
    return r->exit_zero ? EXIT_AS_EXPECTED : code;
}

static void report_units(const scenes *own, const sweep *s)
{
    for (int k = 0; k < own->count; k++)
        for (int i = 0; i < s->seriess; i++) {
            const sweep_point *p = &s->point[s->series[i].point];
            if (p->type != scene_file_case(own->file[k]) || s->series[i].missing[0] != '\0')
                continue;
            case_input_report_units(own->file[k], p->parameter);
            break;
        }
}

static status compute(const verify_request *r, const scenes *own, verification_request *requested,
                      verification *v, spread_end *end, fault *f)
{
    TRY(shards_requested(&r->shards, &requested->taken, f));
    TRY(experiment_plan(&experiment_verify, requested, v, f));
    report_units(own, &v->sweep);
    if (requested->taken)
        TRY(verification_work_run(&r->shards, &requested->cells, &v->truths, &v->sweep, end, f));
    return end->ended
               ? STATUS_OK
               : experiment_run(&experiment_verify, requested, &(experiment_output){0}, v, f);
}

static status run(const verify_request *r, const scenes *own, verification *v, spread_end *end,
                  fault *f)
{
    verification_request requested = {
        .cells = {.cases = own->type,
                  .select = r->select,
                  .jobs = r->shards.jobs,
                  .share = 1,
                  .time_limit = r->chosen.time_limit,
                  .interruptible = 1,
                  .doublings = r->refine,
                  .formulations = r->chosen.formulations,
                  .formulation = r->chosen.formulation,
                  .named = named_alone(&r->chosen),
                  .tolerance = r->tolerance,
                  .shapes = r->shapes < PICTURED_STATES ? r->shapes : PICTURED_STATES,
                  .progress = isatty(STDERR_FILENO) && !r->shards.quiet ? stderr : NULL},
        .whole = r->select == NULL && r->chosen.formulations == 0 &&
                 (r->scenes.built_in || r->scenes.scene.count == 0),
        .imported = r->imported.text,
        .importeds = r->imported.count,
        .imported_must_pass = r->imported_must_pass,
        .former = r->former,
        .processor = end->processor,
        .exit_zero = r->exit_zero,
        .verbose = r->verbose,
        .quiet = r->shards.quiet};
    TRY(files_check_results(r->shards.line, 1, user_tables_packed(&r->scenes.truths), f));
    if (r->former != NULL)
        TRY(results_read(r->former, &v->former, f));
    TRY(scenes_truths(own, &r->scenes, &v->truths, f));
    return compute(r, own, &requested, v, end, f);
}

static int verify_scenes(const verify_request *r, const scenes *own)
{
    verification_files files = {.output = r->output,
                                .json = r->reports.json,
                                .junit = r->reports.junit,
                                .markdown = r->reports.markdown,
                                .propose = r->reports.propose};
    verification v = {.files = &files, .begun = clock_wall_seconds()};
    spread_end end = {0};
    fault f = {""};
    const status outcome = run(r, own, &v, &end, &f);
    const int code = outcome != STATUS_OK ? message_fail(outcome, f.text)
                                          : report(r, &v.sweep, &v.evaluation, &end);
    verification_free(&v);
    spread_free(&end);
    return code;
}

static int answer(const command_line *l, void *request)
{
    verify_request *r = request;
    scenes own;
    if (l->arguments > 0)
        return message_fail(
            STATUS_REFUSED,
            "verify accepts no case as an argument; select cases with -k, such as -k elastica");
    if (r->imported_must_pass && r->imported.count == 0)
        return message_fail(
            STATUS_REFUSED,
            "--imported-must-pass requires imported results; add --imported theirs.h5, a file "
            "written by 'beamwork import theirs.csv -o theirs.h5'");
    if (r->verbose && r->shards.quiet)
        return message_fail(STATUS_REFUSED,
                            "--verbose and --quiet are both given; give only one of them");
    int code = scenes_read(l, &r->scenes, &own);
    if (code == EXIT_AS_EXPECTED)
        code = verify_scenes(r, &own);
    scenes_free(&own);
    return code;
}

#define IN(at) .member = offsetof(verify_request, at)
static const verb_option own[] = {
    {"output", 'o', "FILE", "results as HDF5", IN(output), .traits = OPTION_OUTPUT},
    {"scene", 0, "FILE",
     "your scene file (YAML) instead of a case, or a folder of them; may be repeated",
     IN(scenes.scene), .traits = OPTION_REPEATS | OPTION_INPUT},
    {"built-in", 0, NULL, "also run the built-in cases, in addition to the scenes of --scene",
     IN(scenes.built_in)},
    {"deviations", 0, "FILE.csv",
     "table of your known deviations, in addition to the built-in ones; may be repeated",
     IN(scenes.deviations), .traits = OPTION_REPEATS | OPTION_INPUT | OPTION_VERDICT},
    {"imported", 0, "FILE",
     "results of other programs, stored by 'beamwork import'; they are shown but do not affect the "
     "exit status; may be repeated",
     IN(imported), .traits = OPTION_REPEATS | OPTION_INPUT | OPTION_VERDICT},
    {"imported-must-pass", 0, NULL,
     "verdicts on the values of --imported also affect the exit status", IN(imported_must_pass)},
    {"shapes", 0, "[STATES]",
     "store centre lines, sections and resultants of at most STATES states of a path (default: 5), "
     "and 60 frames of a motion, evenly distributed over time",
     IN(shapes), .least = 1, .most = SHAPES_ALL},
    {"refine", 0, "N",
     "add N meshes to each series, each with twice as many elements, to see whether the verdicts "
     "change",
     IN(refine), .least = 1, .most = 10},
    {"tolerance", 0, "R",
     "every limit within R (1% or 0.01) of the reference value is as expected, even if the verdict "
     "is 'biased' or 'low order'; replaces the tolerances of the cases",
     IN(tolerance), .traits = OPTION_VERDICT, .read = option_error},
    {"not-worse-than", 0, "FILE",
     "results of a previous 'verify -o', or their short table from 'compare FILE -o'. The run "
     "fails if the error of a mesh has grown by more than 2 %, if a value is missing, if a limit "
     "has changed by more than 0.001 % (unless an exact value checks the limit as accurately), or "
     "if an imported program is not in this run",
     IN(former), .traits = OPTION_INPUT | OPTION_VERDICT},
    {"exit-zero", 0, NULL, "exit status 0 for any verdicts; the output files contain the verdicts",
     IN(exit_zero), .traits = OPTION_ASIDE},
    {"verbose", 'v', NULL, "print every limit, not only the overview", IN(verbose),
     .traits = OPTION_ASIDE},
    {"quiet", 'q', NULL, "print only unexpected verdicts and the final PASS or FAIL sentence",
     IN(shards.quiet), .traits = OPTION_ASIDE},
    {0}};
static const verb_group shared[] = {
    SHARED(formulations, chosen),       SHARED(select, select),     SHARED(time_limit, chosen),
    SHARED(user_truths, scenes.truths), SHARED(json, reports.json), SHARED(reports, reports),
    SHARED(jobs, shards.jobs),          SHARED(shards, shards),     {NULL, 0}};
const verb verb_verify = {
    "verify",
    "",
    "runs every formulation on every case; verdicts from stored reference values",
    "Computes every formulation on every case and parameter point that has a reference value, and "
    "assigns verdicts. A formulation that is named with -f or loaded with --element affects the "
    "exit status: its own known deviations apply (--deviations; none by default), and the "
    "interface requirements are checked first (element-test). A built-in formulation that is not "
    "accepted yet affects the exit status only if it is named. Exit status: 0 every verdict as "
    "expected; 1 a verdict differs, or an interface requirement is violated ('undecided' counts as "
    "different unless a known deviation expects it; more meshes, --refine, or a larger --tolerance "
    "may decide it); 2 invalid input; 3 no verdict; 4 file, disk or memory; 5 interrupted (Ctrl-C, "
    "SIGTERM): finished verdicts are in files named .partial. With --exit-zero, the status is 0 "
    "instead of 1 and 3. --shard K/N --into FOLDER computes a part and returns 0 if the part is "
    "complete, 5 if batches are missing (start the shard again); 'beamwork merge' assigns the "
    "verdicts",
    "beamwork verify -k \"c_column and collocation\"\n"
    "beamwork verify --shard 1/4 --into parts\n"
    "beamwork verify -o build/results.h5",
    shared,
    own,
    sizeof(verify_request),
    .place = VERB_EVALUATE + 10,
    .answer = answer};
