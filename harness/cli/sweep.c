#include "harness/cli/cli_impl.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "elements/shared/choice.h"

typedef struct sweep_options {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    truths_options truths;
    shard_options shards;
    const char *select, *output, *format;
    double error;
    text_list vary;     /* varied parameters: NAME=A..B/N, or another form */
    const char *design; /* design of the points; NULL: a grid */
    int points, seed;   /* number of points and seed, for designs other than a grid */
    int derive;         /* 1: reference values that are not stored are computed */
    int verbose;
} sweep_options;

typedef struct sweeping {
    range_sweep_request requested;
    range_sweep sweep;
    char script[PATH_MAX]; /* script of --compute-references */
    identity_texts texts;
    const shard_options *shards;
    int spread; /* 1: the sweep is computed as a shard, or read from batches */
    spread_end end;
} sweeping;

static status read_design(const sweep_options *r, ranges_request *q, fault *f)
{
    const int kind = r->design != NULL ? choice_index(DESIGN_CHOICES, r->design) : DESIGN_GRID;
    if (kind < 0)
        return fault_set(f, STATUS_REFUSED,
                         "--design '%.40s' is unknown; give one of " DESIGN_CHOICES, r->design);
    q->design = (design_kind)kind;
    q->points = r->points;
    const int seeded = given_value(r->of.line, "seed") != NULL;
    q->seed = seeded ? (unsigned long)r->seed : 1;
    if (kind == DESIGN_GRID && r->points > 0)
        return fault_set(f, STATUS_REFUSED,
                         "--points requires --design sobol, halton or random; add one of these, or "
                         "remove --points and give a grid such as --vary NAME=1..2/4");
    if (kind != DESIGN_RANDOM && seeded)
        return fault_set(f, STATUS_REFUSED,
                         "--seed requires --design random; add it, or remove --seed");
    return STATUS_OK;
}

static status check_set(const sweep_options *r, const parameter_ranges *s, fault *f)
{
    for (int i = 0; i < r->of.set.count; i++)
        for (int k = 0; k < s->design.axes; k++) {
            const char *name = s->axis[k].of->name;
            if (strncmp(r->of.set.text[i], name, strlen(name)) == 0 &&
                r->of.set.text[i][strlen(name)] == '=')
                return fault_set(f, STATUS_REFUSED,
                                 "%s is given by both --set and --vary; remove one of them", name);
        }
    return STATUS_OK;
}

static status identify(const sweep_options *r, sweeping *s, fault *f)
{
    digest plan;
    TRY(identity_make(r->of.line, &s->texts, &plan, f));
    ranges_identity_add(&s->sweep.ranges, &plan);
    identity_set(&s->texts, &plan, &s->sweep.all);
    return STATUS_OK;
}

static status take_given(void *context, const shard_work *w, fault *f)
{
    sweeping *s = context;
    TRY(spread_work(s->shards, w, &s->end, f));
    return s->end.ended ? STATUS_NO_VALUE : STATUS_OK;
}

static status prepare(sweep_options *r, const case_type *type, sweeping *s, fault *f)
{
    ranges_request *q = &s->requested.of;
    *q = (ranges_request){.type = type,
                          .file = r->of.scene,
                          .base = r->of.parameter,
                          .varies = r->vary.count,
                          .vary = r->vary.text,
                          .formulations = r->chosen.formulations,
                          .formulation = r->chosen.formulation,
                          .meshes = r->meshes.count,
                          .mesh = r->meshes.elements,
                          .select = r->select,
                          .tolerance = r->error > 0 ? r->error : 0.01,
                          .time_limit = r->chosen.time_limit};
    TRY(read_design(r, q, f));
    TRY(files_check_results(r->of.line, 1, user_tables_packed(&r->truths), f));
    if (r->of.scene == NULL) {
        TRY(case_input_truths(&r->of, &r->truths, &s->sweep.truths, f));
        q->truths = &s->sweep.truths;
    }
    if (r->derive) {
        TRY(derive_script(r->of.scene != NULL ? "of_scene.py" : "at.py", s->script, f));
        q->derive = s->script;
    }
    TRY(experiment_plan(&experiment_sweep, &s->requested, &s->sweep, f));
    TRY(check_set(r, &s->sweep.ranges, f));
    return identify(r, s, f);
}

static status run(sweep_options *r, const case_type *type, sweeping *s, fault *f)
{
    const experiment_output to = {.format = r->format};
    const int csv = strcmp(r->format, "csv") == 0, quiet = r->shards.quiet;
    TRY(shards_requested(&r->shards, &s->spread, f));
    s->shards = &r->shards;
    s->requested =
        (range_sweep_request){.output = r->output,
                              .partial = r->shards.partial,
                              .jobs = r->shards.jobs,
                              .verbose = r->verbose,
                              .quiet = quiet,
                              .progress = isatty(STDERR_FILENO) && !quiet ? stderr : NULL,
                              .csv = csv ? stdout : NULL,
                              .take = r->shards.from.count > 0 ? take_given : NULL,
                              .context = s};
    TRY(prepare(r, type, s, f));
    if (!csv && !quiet)
        ranges_table_head(stdout, &s->sweep.ranges);
    if (r->output == NULL)
        TRY(output_flush(f));
    if (s->spread && s->requested.take == NULL)
        return spread_work(&r->shards, &s->sweep.all, &s->end, f);
    return experiment_run(&experiment_sweep, &s->requested, &to, &s->sweep, f);
}

static int report(const sweep_options *r, const sweeping *s)
{
    if (s->spread)
        return s->end.code;
    if (s->sweep.lost == 0)
        return EXIT_AS_EXPECTED;
    fprintf(stderr, "beamwork: %d of %d batches are missing; ", s->sweep.lost,
            s->sweep.ranges.batches);
    if (r->output != NULL)
        fprintf(
            stderr,
            "the others are in %s; run the same command again to compute only the missing ones\n",
            s->sweep.batches);
    else
        fprintf(stderr, "run the command again (with -o FILE, finished batches are kept)\n");
    return EXIT_INTERRUPTED;
}

static int answer(const command_line *l, void *request)
{
    sweep_options *r = request;
    (void)l;
    sweeping s = {.spread = 0};
    fault f = {""};
    const case_type *type = case_input_find(&r->of);
    if (type == NULL)
        return r->of.refusal;
    const status outcome = run(r, type, &s, &f);
    const int code = outcome == STATUS_OK ? report(r, &s) : message_fail(outcome, f.text);
    spread_free(&s.end);
    identity_free(&s.texts);
    range_sweep_free(&s.sweep);
    return code;
}

#define IN(at) .member = offsetof(sweep_options, at)
static const verb_option own[] = {
    {"vary", 0, "NAME=A..B/N|A,B,C",
     "parameter of the sweep: NAME=A..B/N for N equal parts (N + 1 values), NAME=A..B/N:log for "
     "equal ratios, or a list of values or words; may be repeated for other parameters",
     IN(vary), .traits = OPTION_REPEATS, .most = CASE_MAX_PARAMETERS},
    {"design", 0, "grid|sobol|halton|random",
     "points of the sweep: all points of the grid (default), or N points (--points N) that fill "
     "the box of --vary NAME=A..B",
     IN(design)},
    {"points", 0, "N", "number of points of a design that is not a grid", IN(points), .least = 1,
     .most = 1000000000},
    {"seed", 0, "S", "seed of --design random (default 1)", IN(seed), .least = 0, .most = INT_MAX},
    {"compute-references", 0, NULL,
     "compute a reference value at points where none is stored; this takes about half a second per "
     "point (4 s for a scene)",
     IN(derive)},
    {"error", 0, "R", "required error (default 1%)", IN(error), .read = option_error},
    {"verbose", 'v', NULL, "also print the smallest number of elements for each quantity",
     IN(verbose), .traits = OPTION_ASIDE},
    {"quiet", 'q', NULL, "no tables", IN(shards.quiet), .traits = OPTION_ASIDE},
    {0}};
static const verb_group shared[] = {SHARED(case, of),
                                    SHARED(formulations, chosen),
                                    SHARED(meshes, meshes),
                                    SHARED(select, select),
                                    SHARED(time_limit, chosen),
                                    SHARED(truths, truths),
                                    SHARED(output, output),
                                    SHARED(table, format),
                                    SHARED(jobs, shards.jobs),
                                    SHARED(shards, shards),
                                    {NULL, 0}};
const verb verb_sweep = {
    "sweep",
    "CASE",
    "shows where in ranges of parameters an error target is met",
    "Solves a case, or your own scene (--scene FILE), at many points of its parameter space. Shows "
    "where formulations achieve a target error (--error, default 1 %): the share of points for "
    "each mesh, the sufficient number of elements over the parameters, and the worst points. "
    "--vary NAME=A..B/N gives N equal parts, including both ends; A..B/N:log gives equal ratios; "
    "A,B,C gives these values or words. Several --vary options make a grid, in which the last "
    "parameter varies fastest. --design sobol, halton or random with --points N gives N points in "
    "the box of --vary NAME=A..B (or A..B:log). Errors are relative to the reference value stored "
    "for the point or, with --compute-references, to a value computed for it; otherwise to the "
    "limit of the meshes of all formulations with the same physics. Points whose limit has an "
    "uncertainty above half of the target error are reported, as are points without a scene and "
    "failed runs. -o FILE writes all values, and the worst points as scenes to FILE.worst. "
    "Finished batches are stored in FILE.batches until all are complete; the same command resumes "
    "from them. Exit status: 0 done, 2 invalid input, 4 file, disk or memory, 5 incomplete.",
    "beamwork sweep elastica --vary load=0.5..8/15 -f beamw -f sheet_third -n 1,2,4,8\n"
    "beamwork sweep c_column --vary length=2..12/10 -k buckling_load --compute-references -o "
    "column.h5\n"
    "beamwork sweep snap_through --vary angle=0.1..0.6 --design sobol --points 200",
    shared,
    own,
    sizeof(sweep_options),
    .place = VERB_COMPUTE + 30,
    .answer = answer};

static void begin(void *group, command_line *l)
{
    ((shard_options *)group)->line = l;
}

status shards_requested(const shard_options *r, int *requested, fault *f)
{
    char folder[2 * FAULT_TEXT];
    int index, count, first = 0;
    const int writes = given_next(r->line, OPTION_OUTPUT, &first) != NULL;
    *requested = r->into != NULL || r->shard != NULL || r->from.count > 0;
    if (r->from.count > 0 && (r->into != NULL || r->shard != NULL))
        return fault_set(
            f, STATUS_REFUSED,
            "--from reads batches and --into computes them; give only one of these options");
    if (r->shard != NULL && r->into == NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "--shard %.40s requires a folder for its batches; add, for example, --into batches",
            r->shard);
    if (r->partial && r->from.count == 0)
        return fault_set(f, STATUS_REFUSED,
                         "--partial requires existing batches; give their folder with --from, or "
                         "use 'beamwork merge FOLDER --partial'");
    if (r->into == NULL || !writes)
        return r->shard != NULL ? shard_parse(r->shard, &index, &count, f) : STATUS_OK;
    words_quoted(r->into, folder, sizeof folder);
    return fault_set(f, STATUS_REFUSED,
                     "--into writes only batches; remove other outputs, and write the results with "
                     "'beamwork merge %.100s -o FILE' when the batches are complete",
                     folder);
}

static int report_shard(const shard_options *r, const shard_request *q, const shard_outcome *o)
{
    const int left = o->mine - o->before - o->done;
    if (left > 0) {
        fprintf(stderr,
                "beamwork: %s: %d of %d batches of shard %d/%d are missing; start the shard again "
                "with the same command\n",
                o->interrupted ? "interrupted" : "incomplete", left, o->mine, q->index + 1,
                q->count);
        return EXIT_INTERRUPTED;
    }
    if (!r->quiet)
        printf("shard %d/%d: %d %s in %s, %d computed now (%.3g s)\n", q->index + 1, q->count,
               o->mine, o->mine == 1 ? "batch" : "batches", r->into, o->done, o->seconds);
    return EXIT_AS_EXPECTED;
}

static status compute(const shard_options *r, const shard_work *w, spread_end *out, fault *f)
{
    shard_request q = {.count = 1,
                       .into = r->into,
                       .jobs = r->jobs,
                       .progress = isatty(STDERR_FILENO) && !r->quiet ? stderr : NULL,
                       .messages = stderr};
    shard_outcome done;
    if (r->shard != NULL)
        TRY(shard_parse(r->shard, &q.index, &q.count, f));
    out->ended = 1;
    TRY(shard_run(w, &q, &done, f));
    out->code = report_shard(r, &q, &done);
    return output_flush(f);
}

static void name_processors(const batch_store *s, spread_end *out)
{
    size_t at = 0;
    for (int i = 0; i < s->kinds && at < sizeof out->processor; i++)
        at += (size_t)snprintf(out->processor + at, sizeof out->processor - at, "%s%s (%s)",
                               i > 0 ? "; " : "", s->kind[i].node.processor, s->kind[i].node.host);
}

static status take(const shard_options *r, const shard_work *w, const batch_store *s,
                   spread_end *out, fault *f)
{
    char missing[600];
    batch_store_missing(s, w, missing, sizeof missing);
    if (s->there < s->batches) {
        fprintf(stderr, "beamwork: incomplete: %s%s\n", missing,
                r->partial ? ""
                           : "; run the missing shards again with the same options, or add "
                             "--partial to use the existing batches");
        out->code = EXIT_INTERRUPTED;
        out->ended = !r->partial;
        if (out->ended)
            return STATUS_OK;
    }
    batch_store_print_kinds(s, stderr);
    name_processors(s, out);
    for (int i = 0; i < s->batches; i++)
        out->taken[i] = s->where[i] >= 0;
    return merge_read(w, s, f);
}

static status merge(const shard_options *r, const shard_work *w, spread_end *out, fault *f)
{
    batch_store s = {0};
    out->batches = w->batches;
    out->taken = calloc((size_t)w->batches + 1, 1);
    if (out->taken == NULL)
        return fault_memory(f, "batches");
    status outcome = batch_store_read(w, r->from.text, r->from.count, NULL, stderr, &s, f);
    if (outcome == STATUS_OK)
        outcome = take(r, w, &s, out, f);
    batch_store_free(&s);
    return outcome;
}

status spread_work(const shard_options *r, const shard_work *w, spread_end *out, fault *f)
{
    return r->from.count > 0 ? merge(r, w, out, f) : compute(r, w, out, f);
}

void spread_free(spread_end *out)
{
    free(out->taken);
    out->taken = NULL;
}

static const verb_option shards[] = {
    {"shard", 0, "K/N",
     "compute only shard K of N, and write each of its batches to a file in the folder of --into; "
     "a restart computes only missing batches",
     .member = offsetof(shard_options, shard), .traits = OPTION_ASIDE},
    {"into", 0, "FOLDER",
     "folder for the batches of --shard, or for all batches without --shard; the folder is created",
     .member = offsetof(shard_options, into), .traits = OPTION_ASIDE},
    {"from", 0, "FOLDER",
     "use existing batches instead of computing, as 'beamwork merge' does; may be repeated",
     .member = offsetof(shard_options, from), .traits = OPTION_REPEATS | OPTION_ASIDE},
    {"partial", 0, NULL, "continue without missing batches",
     .member = offsetof(shard_options, partial), .traits = OPTION_ASIDE},
    {0}};
const option_group options_shards = {shards, begin, NULL, NULL};
