#include <limits.h>
#include <stdio.h>
#include <unistd.h>

#include "harness/algebra/clock.h"
#include "harness/cli/cli.h"
#include "harness/command/own_tables.h"
#include "harness/command/scenes.h"
#include "harness/imports/import_store.h"
#include "harness/judge/families.h"
#include "harness/judge/proposal.h"
#include "harness/judge/sentence.h"
#include "harness/record/json.h"
#include "harness/record/junit.h"
#include "harness/record/markdown.h"
#include "harness/record/output.h"
#include "harness/record/store.h"
#include "harness/spread/verification_work.h"
#include "harness/tables/table_overview.h"
#include "harness/tables/table_run.h"
#include "harness/tables/table_unexpected.h"
#include "harness/tables/table_verdicts.h"

enum { PICTURED_STATES = 5 };

static status write_json(const char *path, const sweep *s, const judgement *j, const environment *e,
                         fault *f)
{
    output file;
    TRY(output_open(path, &file, f));
    return output_finish(&file, json_write_verdicts(file.stream, s, j, e, f), f);
}

static status write_junit(const char *path, const sweep *s, const judgement *j, fault *f)
{
    output file;
    TRY(output_open(path, &file, f));
    junit_write(file.stream, s, j);
    return output_close(&file, f);
}

static status write_markdown(const char *path, const sweep *s, const judgement *j,
                             const overview *o, const environment *e, fault *f)
{
    output file;
    TRY(output_open(path, &file, f));
    markdown_write(file.stream, s, j, o, e);
    return output_close(&file, f);
}

static status write_proposal(const char *path, const sweep *s, const judgement *j, fault *f)
{
    output file;
    TRY(output_open(path, &file, f));
    proposal_write(file.stream, s, j);
    return output_close(&file, f);
}

/* Where each file goes: of an interrupted run, under names that say so. */
typedef struct places {
    char output[PATH_MAX], json[PATH_MAX], junit[PATH_MAX], markdown[PATH_MAX], propose[PATH_MAX];
} places;

static status place_one(const char *path, int partial, char out[PATH_MAX], fault *f)
{
    out[0] = '\0';
    if (path == NULL)
        return STATUS_OK;
    if (partial)
        return output_partial(path, out, f);
    snprintf(out, PATH_MAX, "%s", path);
    return STATUS_OK;
}

static status place_all(const command_request *r, int partial, places *out, fault *f)
{
    TRY(place_one(r->output, partial, out->output, f));
    TRY(place_one(r->json, partial, out->json, f));
    TRY(place_one(r->junit, partial, out->junit, f));
    TRY(place_one(r->markdown, partial, out->markdown, f));
    return place_one(r->propose, partial, out->propose, f);
}

static status write_all(const command_request *r, const sweep *s, const judgement *j,
                        const overview *o, fault *f)
{
    const environment e = environment_now(r->jobs);
    places to;
    TRY(place_all(r, s->unfinished > 0, &to, f));
    if (to.output[0] != '\0')
        TRY(store_write(to.output, s, j, &e, f));
    if (to.json[0] != '\0')
        TRY(write_json(to.json, s, j, &e, f));
    if (to.junit[0] != '\0')
        TRY(write_junit(to.junit, s, j, f));
    if (to.markdown[0] != '\0')
        TRY(write_markdown(to.markdown, s, j, o, &e, f));
    if (to.propose[0] != '\0')
        TRY(write_proposal(to.propose, s, j, f));
    return STATUS_OK;
}

/* Is every limit shown? Where it was asked for, or somebody looks at something in particular. */
static int shows_limits(const command_request *r, const overview *o)
{
    return r->verbose || r->select != NULL || o->rows == 1;
}

/* On standard output, a screen: the matrix, the counts, what is unexpected, and how it ended. */
static void show(const command_request *r, const sweep *s, const judgement *j, const truths *t,
                 const overview *o, double seconds)
{
    const screen look = screen_of(stdout);
    char sentence[SENTENCE_OF_RUN];
    if (!r->quiet && shows_limits(r, o)) {
        table_verdicts(stdout, s, j);
        table_run_details(stdout, s, j);
        fputc('\n', stdout);
    }
    if (!r->quiet) {
        table_overview(stdout, look, o);
        fputc('\n', stdout);
        table_run(stdout, s, j, seconds);
    }
    table_unexpected(stdout, look, s, j, t);
    sentence_of_run(s, j, sentence, sizeof sentence);
    table_run_end(stdout, look, sentence);
}

static status show_and_write(const command_request *r, const sweep *s, const judgement *j,
                             const truths *t, const overview *o, double begun, fault *f)
{
    show(r, s, j, t, o, clock_wall_seconds() - begun);
    TRY(output_flush(f));
    return write_all(r, s, j, o, f);
}

static status judge_and_write(const command_request *r, const sweep *s, truths *t, judgement *j,
                              double begun, fault *f)
{
    const int whole = r->select == NULL && r->formulations == 0 && s->unfinished == 0 &&
                      (r->built_in || r->scene_count == 0);
    overview o = {0};
    if (r->scene_count > 0)
        TRY(families_add_truths(s, 1, t, f));
    TRY(judgement_make(s, t, whole, j, f));
    status outcome = overview_make(s, j, &o, f);
    if (outcome == STATUS_OK)
        outcome = show_and_write(r, s, j, t, &o, begun, f);
    overview_free(&o);
    return outcome;
}

/* The first file that is written, or NULL. */
static const char *first_file(const command_request *r)
{
    const char *const all[] = {r->output, r->json, r->junit, r->markdown, r->propose};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i] != NULL)
            return all[i];
    return NULL;
}

/* What the exit code does not say by itself. */
static int tell(const command_request *r, const sweep *s, const judgement *j, const spread_end *e)
{
    const char *file = first_file(r);
    char partial[PATH_MAX];
    if (e->ended)
        return e->code;
    if (s->unfinished > 0) {
        fprintf(stderr, "beamwork: %s: %d cells were not done; what was judged is ",
                r->partial ? "incomplete" : "interrupted", s->unfinished);
        if (file != NULL && output_partial(file, partial, NULL) == STATUS_OK)
            fprintf(stderr, "in %s\n", partial);
        else
            fprintf(stderr, "above\n");
        return EXIT_INTERRUPTED;
    }
    const int code = judgement_exit(j);
    if (code == EXIT_NOTHING)
        fprintf(stderr, "beamwork: nothing was checked: no verdict against a truth; see %s\n",
                r->scene_count > 0 ? "'truths' in 'beamwork scene --keys'"
                                   : "'beamwork list' and -k");
    return code;
}

/* Other programs as contestants; those of no point of this run are told. */
static status add_beside(const char *path, int gates, sweep *s, fault *f)
{
    import_left left;
    TRY(import_store_read(path, gates, s, &left, f));
    if (left.series == left.all)
        fprintf(stderr,
                "beamwork: %s: nothing of it was run: it is of %s; select that with -k, or give "
                "its --scene\n",
                path, left.first);
    else if (left.series > 0)
        fprintf(stderr,
                "beamwork: %s: %d of %d series are of cases or parameters that were not run, the "
                "first %s\n",
                path, left.series, left.all, left.first);
    return STATUS_OK;
}

/* With what verify_scenes frees. */
static status run(const command_request *r, const scenes *own, sweep *s, truths *t, judgement *j,
                  spread_end *end, fault *f)
{
    const int states = r->shapes < PICTURED_STATES ? r->shapes : PICTURED_STATES;
    const double begun = clock_wall_seconds();
    const sweep_request request = {.cases = own->type,
                                   .select = r->select,
                                   .jobs = r->jobs,
                                   .share = 1,
                                   .time_limit = r->time_limit,
                                   .interruptible = 1,
                                   .doublings = r->doublings,
                                   .formulations = r->formulations,
                                   .formulation = r->formulation,
                                   .shapes = states,
                                   .progress = isatty(STDERR_FILENO) && !r->quiet ? stderr : NULL};
    TRY(files_check(r, 1, case_input_truths_path(r), f));
    for (int i = 0; i < own->count; i++)
        TRY(files_check_input(r, own->path[i], f));
    for (int i = 0; i < r->beside_count; i++)
        TRY(files_check_input(r, r->beside[i], f));
    TRY(own_tables_check(r, f));
    TRY(scenes_truths(own, r, t, f));
    TRY(verification_work_run(r, &request, t, s, end, f));
    if (end->ended)
        return STATUS_OK;
    for (int i = 0; i < r->beside_count; i++)
        TRY(add_beside(r->beside[i], r->gate, s, f));
    return judge_and_write(r, s, t, j, begun, f);
}

static int verify_scenes(const command_request *r, const scenes *own)
{
    sweep s = {0};
    truths t = {0};
    judgement j = {0};
    spread_end end = {.ended = 0};
    fault f = {""};
    const status outcome = run(r, own, &s, &t, &j, &end, &f);
    const int code = outcome != STATUS_OK ? message_fail(outcome, f.text) : tell(r, &s, &j, &end);
    spread_free(&end);
    judgement_free(&j);
    sweep_free(&s);
    truths_free(&t);
    return code;
}

static int verify_request(command_request *r)
{
    scenes own;
    if (r->case_name != NULL)
        return message_fail(STATUS_REFUSED, "verify takes no case; select with -k");
    if (r->verbose && r->quiet)
        return message_fail(STATUS_REFUSED, "--verbose and --quiet: give one of them");
    int code = scenes_read(r, &own);
    if (code == EXIT_AS_EXPECTED)
        code = verify_scenes(r, &own);
    scenes_free(&own);
    return code;
}

int cli_verify(int count, char **arguments)
{
    return command_run(
        "verify", "",
        "Judges every formulation on every case and parameter point that has a truth. Exit "
        "status: 0 every verdict as expected, 1 one differs, 2 refused, 3 nothing was "
        "checked, 4 file, disk or memory, 5 interrupted (Ctrl-C, SIGTERM): what was judged "
        "until then is in files named .partial. With --shard K/N --into FOLDER: computes a part, "
        "0 when all of it is there, 5 when some is missing (start it again); 'beamwork merge' "
        "judges"
        "\vbeamwork verify -k \"c_column and collocation\"\n"
        "beamwork verify --shard 1/4 --into parts\n"
        "beamwork verify -o build/results.h5",
        "fokjJUMLPTYBGINvqpW.ZiCbw", count, arguments, verify_request);
}
