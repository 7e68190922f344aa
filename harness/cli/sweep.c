/* A case over ranges of its parameters. */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "elements/shared/choice.h"
#include "harness/cli/cli.h"
#include "harness/cli/errors.h"
#include "harness/cli/identity.h"
#include "harness/cli/spread.h"
#include "harness/experiments/merge.h"
#include "harness/experiments/ranges_collect.h"
#include "harness/experiments/ranges_identity.h"
#include "harness/experiments/ranges_table.h"
#include "harness/experiments/shard.h"
#include "harness/study/derive.h"

/* A sweep and what it needs while it runs. */
typedef struct sweeping {
    ranges ranges;
    ranges_work work;
    truths truths;
    ranges_output output;
    char batches[PATH_MAX]; /* folder */
    char script[PATH_MAX];  /* of --derive */
    char partial[PATH_MAX]; /* output of --partial */
    identity_texts texts;
    work all;
    int asked;      /* 1: as a shard, or from batches */
    spread_end end; /* how that was */
    int lost;       /* batches that are not there: exit status 5 */
} sweeping;

static status read_design(const command_request *r, ranges_request *q, fault *f)
{
    const int kind = r->design != NULL ? choice_index(DESIGN_CHOICES, r->design) : DESIGN_GRID;
    if (kind < 0)
        return fault_set(f, STATUS_REFUSED, "--design '%.40s': give one of " DESIGN_CHOICES,
                         r->design);
    q->design = (design_kind)kind;
    q->points = r->points;
    q->seed = (unsigned long)(r->seed >= 0 ? r->seed : 1);
    if (kind == DESIGN_GRID && r->points > 0)
        return fault_set(f, STATUS_REFUSED,
                         "--points belongs to --design sobol, halton or random; a grid has those "
                         "of --vary");
    if (kind != DESIGN_RANDOM && r->seed >= 0)
        return fault_set(f, STATUS_REFUSED, "--seed belongs to --design random");
    return STATUS_OK;
}

/* Nothing that varies is set. */
static status check_set(const command_request *r, const ranges *s, fault *f)
{
    for (int i = 0; i < r->assignments; i++)
        for (int k = 0; k < s->design.axes; k++) {
            const char *name = s->axis[k].of->name;
            if (strncmp(r->assignment[i], name, strlen(name)) == 0 &&
                r->assignment[i][strlen(name)] == '=')
                return fault_set(f, STATUS_REFUSED, "%s is set and varies; give --set or --vary",
                                 name);
        }
    return STATUS_OK;
}

static status identify(const command_request *r, sweeping *s, fault *f)
{
    digest plan;
    s->all = ranges_work_of(&s->work);
    TRY(identity_make("sweep", r, &s->texts, &plan, f));
    ranges_identity_add(&s->ranges, &plan);
    identity_set(&s->texts, &plan, &s->all);
    s->output.plan = s->texts.plan;
    return STATUS_OK;
}

static status prepare(command_request *r, const case_type *type, sweeping *s, fault *f)
{
    ranges_request q = {.type = type,
                        .file = r->scene,
                        .base = r->parameter,
                        .varies = r->varies,
                        .vary = r->vary,
                        .formulations = r->formulations,
                        .formulation = r->formulation,
                        .meshes = r->meshes,
                        .mesh = r->mesh,
                        .select = r->select,
                        .tolerance = 0.01,
                        .time_limit = r->time_limit};
    int levels;
    if (strcmp(r->format, "json") == 0)
        return fault_set(f, STATUS_REFUSED, "sweep writes text, csv, and HDF5 with -o FILE");
    TRY(read_design(r, &q, f));
    if (r->error != NULL)
        TRY(errors_parse(r->error, 1, &q.tolerance, &levels, f));
    TRY(files_check(r, 1, case_input_truths_path(r), f));
    if (r->scene == NULL) {
        TRY(case_input_truths(r, &s->truths, f));
        q.truths = &s->truths;
    }
    if (r->derive) {
        TRY(derive_script(r->scene != NULL ? "of_scene.py" : "at.py", s->script, f));
        q.derive = s->script;
    }
    TRY(ranges_make(&q, &s->ranges, f));
    TRY(check_set(r, &s->ranges, f));
    TRY(ranges_work_make(&s->ranges, &s->work, f));
    return identify(r, s, f);
}

/* Where results go. */
static status place_output(const command_request *r, sweeping *s, fault *f)
{
    if (r->output == NULL)
        return STATUS_OK;
    s->output.path = r->output;
    if (r->partial) {
        TRY(output_partial(r->output, s->partial, f));
        s->output.path = s->partial;
    }
    TRY(ranges_collect_beside(s->output.path, ".worst", s->output.folder, f));
    return ranges_collect_check(&s->output, f);
}

/* The folder is that of this process until it ends: of two runs with one output one ends here. */
static status hold_batches(const char *folder, fault *f)
{
    struct stat there = {.st_nlink = 0};
    while (there.st_nlink == 0) { /* whoever held it has removed it meanwhile */
        const int made = mkdir(folder, 0777),
                  held = made == 0 || errno == EEXIST
                             ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC)
                             : -1;
        if (held < 0)
            return fault_set(f, STATUS_FAULT, "%.200s: cannot be made (%s)", folder,
                             strerror(errno));
        if (flock(held, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(held);
            return fault_set(f, STATUS_REFUSED,
                             "%.200s: another 'beamwork sweep' works there; wait until it ends, or "
                             "give -o another name",
                             folder);
        }
        if (fstat(held, &there) != 0)
            there.st_nlink = 1;
    }
    return STATUS_OK;
}

/* Where batches are kept until all are there: beside the output, or where nobody looks. */
static status place_batches(const command_request *r, sweeping *s, fault *f)
{
    if (r->output != NULL) {
        TRY(ranges_collect_beside(r->output, ".batches", s->batches, f));
        return hold_batches(s->batches, f);
    }
    const char *temporary = getenv("TMPDIR");
    snprintf(s->batches, sizeof s->batches, "%s/beamwork-sweep-XXXXXX",
             temporary != NULL ? temporary : "/tmp");
    return mkdtemp(s->batches) != NULL ? STATUS_OK
                                       : fault_set(f, STATUS_FAULT, "%.200s: cannot be made (%s)",
                                                   s->batches, strerror(errno));
}

/* Batches of the stock, or those that --from names; where some of these are missing, nothing. */
static status take_all(const command_request *r, sweeping *s, const stock *there, fault *f)
{
    ranges_collect c;
    status outcome = ranges_collect_begin(&s->work, &s->output, &c, f);
    if (outcome == STATUS_OK)
        outcome =
            there != NULL ? merge_take(&s->all, there, f) : spread_work(r, &s->all, 0, &s->end, f);
    const int ended = outcome == STATUS_OK && s->end.ended;
    outcome = ranges_collect_end(&c, ended ? STATUS_NO_VALUE : outcome, f);
    if (outcome == STATUS_OK && s->work.csv == NULL && !r->quiet)
        ranges_table(stdout, &c.tally, r->verbose, s->output.folder, f);
    tally_free(&c.tally);
    return ended ? STATUS_OK : outcome;
}

static status collect(const command_request *r, sweeping *s, fault *f)
{
    const char *const folder[] = {s->batches};
    stock there = {.batches = 0};
    status outcome = stock_take(&s->all, folder, 1, NULL, stderr, &there, f);
    s->lost = there.batches - there.there;
    if (outcome == STATUS_OK && s->lost == 0)
        outcome = take_all(r, s, &there, f);
    if (outcome == STATUS_OK && (s->lost == 0 || r->output == NULL))
        outcome = ranges_collect_remove(&there, s->batches, f);
    stock_free(&there);
    return outcome;
}

/* All batches here and now. */
static status run_here(const command_request *r, sweeping *s, fault *f)
{
    shard_outcome done = {0};
    TRY(place_batches(r, s, f));
    const shard_request request = {.count = 1,
                                   .into = s->batches,
                                   .jobs = r->jobs,
                                   .progress = isatty(STDERR_FILENO) && !r->quiet ? stderr : NULL,
                                   .tell = stderr};
    TRY(shard_run(&s->all, &request, &done, f));
    return collect(r, s, f);
}

static status run(command_request *r, const case_type *type, sweeping *s, fault *f)
{
    TRY(spread_asked(r, &s->asked, f));
    TRY(prepare(r, type, s, f));
    TRY(place_output(r, s, f));
    if (strcmp(r->format, "csv") == 0)
        s->work.csv = stdout;
    else if (!r->quiet)
        ranges_table_head(stdout, &s->ranges);
    if (r->output == NULL) /* else what goes there matters more */
        TRY(output_flush(f));
    if (!s->asked)
        return run_here(r, s, f);
    return r->from_count > 0 ? take_all(r, s, NULL, f) : spread_work(r, &s->all, 0, &s->end, f);
}

/* What is not there is computed when the same command is given again. */
static int tell(const command_request *r, const sweeping *s)
{
    if (s->asked)
        return s->end.code;
    if (s->lost == 0)
        return EXIT_AS_EXPECTED;
    fprintf(stderr, "beamwork: %d of %d batches are missing; ", s->lost, s->ranges.batches);
    if (r->output != NULL)
        fprintf(stderr, "the others are in %s: give the same command again\n", s->batches);
    else
        fprintf(stderr, "with -o FILE the others would be kept\n");
    return EXIT_INTERRUPTED;
}

static int sweep_request_of(command_request *r)
{
    sweeping s = {.lost = 0};
    fault f = {""};
    const case_type *type = case_input_find(r);
    if (type == NULL)
        return r->refusal;
    const status outcome = run(r, type, &s, &f);
    const int code = outcome == STATUS_OK ? tell(r, &s) : message_fail(outcome, f.text);
    spread_free(&s.end);
    identity_free(&s.texts);
    ranges_work_free(&s.work);
    ranges_free(&s.ranges);
    truths_free(&s.truths);
    return code;
}

int cli_sweep(int count, char **arguments)
{
    return command_run(
        "sweep", "CASE",
        "Solves a case, or a structure of your own (--scene FILE), at many points of its "
        "parameters "
        "and shows where formulations are within an error (--error, default 1 %): the share of "
        "points with each mesh, the least number of elements over the parameters, the worst "
        "points. "
        "--vary NAME=A..B/N: N equal parts, ends included; A..B/N:log: equal ratios; A,B,C: these "
        "values, or words of a choice. Several make a grid, the last one changing first. --design "
        "sobol, halton or random --points N: so many points in the box of --vary NAME=A..B (or "
        "A..B:log). Errors are against a truth stored for the very point, with --derive against "
        "one "
        "that is solved for there, else against the limit that the meshes of all formulations of "
        "the same physics go to; points where that is not known to half of the error are told. A "
        "point that has no scene, a cell that fails, is a result. -o FILE: all values as HDF5, and "
        "the worst points as scenes in FILE.worst; batches that are done are kept in FILE.batches "
        "until all are: the same command goes on from there. Exit status: 0 done, 2 refused, 4 "
        "file, disk or memory, 5 incomplete."
        "\vbeamwork sweep elastica --vary load=0.5..8/15 -f beamw -f sheet_third -n 1,2,4,8\n"
        "beamwork sweep c_column --vary length=2..12/10 -k buckling_load --derive -o column.h5\n"
        "beamwork sweep snap_through --vary angle=0.1..0.6 --design sobol --points 200",
        "yfnskedzrgojLTYFvqZiCbw", count, arguments, sweep_request_of);
}
