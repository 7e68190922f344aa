#include "harness/experiments/experiments_impl.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/import_export/import_export.h"
#include "harness/numerics/numerics.h"
#include "harness/terminal/terminal.h"

typedef struct evaluation_run {
    truths *truths;
    evaluation *evaluation;
    const verification_reader *reader; /* observer; NULL: none */
    int evaluated;                     /* number of evaluated series */
} evaluation_run;

static int needs_scatter(void *context, const sweep *s, int series_index)
{
    const evaluation_run *v = context;
    return evaluation_needs_scatter(s, v->truths, series_index);
}

static const case_type *case_of(const sweep *s, int series_index)
{
    return s->point[s->series[series_index].point].type;
}

static void store_results(evaluation_run *v, const sweep *s, int series_index)
{
    const case_type *type = case_of(s, series_index);
    if (v->reader == NULL)
        return;
    for (int i = series_index + 1; i < s->seriess; i++)
        if (case_of(s, i) == type)
            return;
    v->reader->evaluated(v->reader->context, type);
}

static status evaluate_to(evaluation_run *v, const sweep *s, int end, fault *f)
{
    int of = -1;
    for (int i = v->evaluated; i < end; i++) {
        if (s->series[i].point != of)
            TRY(families_add_point(s, s->series[i].point, 1, v->truths, f));
        of = s->series[i].point;
        TRY(evaluation_add(s, v->truths, i, v->evaluation, f));
    }
    v->evaluated = end;
    return STATUS_OK;
}

static status whole(void *context, const sweep *s, int series_index, fault *f)
{
    evaluation_run *v = context;
    const int here = s->series[series_index].point;
    if (v->evaluated < series_index && s->series[v->evaluated].point != here)
        TRY(evaluate_to(v, s, series_index, f));
    if (series_index + 1 < s->seriess && s->series[series_index + 1].point == here)
        return STATUS_OK;
    TRY(evaluate_to(v, s, series_index + 1, f));
    store_results(v, s, series_index);
    return STATUS_OK;
}

enum { MOST_OWN = 64 };

static int find_own(const sweep *s, formulation out[MOST_OWN])
{
    int count = 0;
    for (int i = 0; i < s->seriess; i++) {
        const formulation *one = &s->series[i].formulation;
        int known = s->series[i].imported != NULL ||
                    !(s->named || formulations_is_loaded(one->type)) || count == MOST_OWN;
        for (int k = 0; k < count; k++)
            known |= strcmp(out[k].key, one->key) == 0;
        if (!known)
            out[count++] = *one;
    }
    return count;
}

static status add_breach(const certificate *c, evaluation *out, fault *f)
{
    const check_result *broken = certificate_broken(c);
    breach one;
    if (broken == NULL)
        return STATUS_OK;
    snprintf(one.formulation, sizeof one.formulation, "%s", c->chosen.key);
    snprintf(one.why, sizeof one.why, "%s: %.240s", broken->name, broken->sentence);
    return memory_append(&out->breach, &out->breaches, &one, sizeof one, "broken contracts", f);
}

static status hold_contracts(const sweep *s, int jobs, int time_limit, evaluation *out, fault *f)
{
    formulation own[MOST_OWN];
    certificate *found = NULL;
    const certificate_request what = {.chosen = own,
                                      .count = find_own(s, own),
                                      .jobs = jobs,
                                      .time_limit = time_limit,
                                      .checks_only = 1};
    if (what.count == 0)
        return STATUS_OK;
    status outcome = certificate_find(&what, &found, f);
    for (int i = 0; i < what.count && outcome == STATUS_OK; i++)
        outcome = add_breach(&found[i], out, f);
    certificate_free(found, what.count);
    return outcome;
}

static status begin(evaluation_run *v, const sweep *s, int jobs, int time_limit, fault *f)
{
    memset(v->evaluation, 0, sizeof *v->evaluation);
    TRY(families_reserve(s, 1, v->truths, f));
    TRY(evaluation_begin(s, v->truths, v->evaluation, f));
    return hold_contracts(s, jobs, time_limit, v->evaluation, f);
}

static status end(evaluation_run *v, const sweep *s, int everything, fault *f)
{
    TRY(evaluate_to(v, s, s->seriess, f));
    evaluation_end(s, v->truths, everything && s->unfinished == 0, v->evaluation);
    return STATUS_OK;
}

status verification_run(const sweep_request *request, int everything,
                        const verification_reader *reader, truths *t, sweep *s, evaluation *out,
                        fault *f)
{
    evaluation_run v = {.truths = t, .evaluation = out, .reader = reader};
    const sweep_follower follower = {.context = &v, .needs_scatter = needs_scatter, .whole = whole};
    sweep_request followed = *request;
    followed.follower = &follower;
    TRY(begin(&v, s, request->jobs, request->time_limit, f));
    TRY(run_sweep(&followed, s, f));
    return end(&v, s, everything, f);
}

status verification_cells(const sweep_request *request, truths *t, sweep *s, fault *f)
{
    evaluation_run v = {.truths = t};
    const sweep_follower follower = {.context = &v, .needs_scatter = needs_scatter};
    sweep_request followed = *request;
    followed.follower = &follower;
    return run_sweep(&followed, s, f);
}

static status evaluate_all(const sweep_request *request, int everything, truths *t, const sweep *s,
                           evaluation *out, fault *f)
{
    evaluation_run v = {.truths = t, .evaluation = out};
    TRY(begin(&v, s, request->jobs, request->time_limit, f));
    return end(&v, s, everything, f);
}

static status files_open(verification_files *to, const sweep *s, const evaluation *j, fault *f)
{
    to->sweep = s;
    to->evaluated = j;
    if (to->output != NULL)
        TRY(store_open(NULL, s, j, &to->store, f));
    to->part = (json_part){.verdicts = 0};
    if (to->json != NULL)
        json_part_begin(&to->part);
    to->open = 1;
    return STATUS_OK;
}

static void files_case(void *files, const case_type *type)
{
    verification_files *to = files;
    if (to->output != NULL)
        store_case(&to->store, type);
    if (to->json != NULL)
        json_part_add(&to->part, to->sweep, to->evaluated);
}

/* Determines the path of an output file. If the run was interrupted, the file name shows this. */
static status name_place(const verification_files *files, const char *path, char out[PATH_MAX],
                         fault *f)
{
    if (files->sweep->unfinished > 0)
        return output_partial(path, out, f);
    snprintf(out, PATH_MAX, "%s", path);
    return STATUS_OK;
}

static status open_text(const verification_files *files, const char *path, output *out, fault *f)
{
    char where[PATH_MAX];
    TRY(name_place(files, path, where, f));
    return output_open(where, out, f);
}

static status write_json(verification_files *to, const environment *e, fault *f)
{
    output file;
    TRY(open_text(to, to->json, &file, f));
    return output_finish(
        &file, json_write_verdicts(file.stream, to->sweep, to->evaluated, e, &to->part, f), f);
}

static status write_junit(const verification_files *to, fault *f)
{
    output file;
    TRY(open_text(to, to->junit, &file, f));
    junit_write(file.stream, to->sweep, to->evaluated);
    return output_close(&file, f);
}

static status write_markdown(const verification_files *to, const overview *o, const environment *e,
                             fault *f)
{
    output file;
    TRY(open_text(to, to->markdown, &file, f));
    markdown_write(file.stream, to->sweep, to->evaluated, o, e);
    return output_close(&file, f);
}

static status write_proposal(const verification_files *to, fault *f)
{
    output file;
    TRY(open_text(to, to->propose, &file, f));
    proposal_write(file.stream, to->sweep, to->evaluated);
    return output_close(&file, f);
}

static status write_texts(verification_files *to, const overview *o, const environment *e, fault *f)
{
    if (to->json != NULL)
        TRY(write_json(to, e, f));
    if (to->junit != NULL)
        TRY(write_junit(to, f));
    if (to->markdown != NULL)
        TRY(write_markdown(to, o, e, f));
    return to->propose != NULL ? write_proposal(to, f) : STATUS_OK;
}

static status write_store(verification_files *to, const environment *e, fault *f)
{
    char where[PATH_MAX];
    if (to->output == NULL)
        return STATUS_OK;
    const status outcome = name_place(to, to->output, where, f),
                 written = store_close(&to->store, outcome == STATUS_OK ? where : NULL, e,
                                       outcome == STATUS_OK ? f : NULL);
    return outcome != STATUS_OK ? outcome : written;
}

static status files_close(verification_files *to, const overview *o, const environment *e, fault *f)
{
    status outcome = write_store(to, e, f);
    if (outcome == STATUS_OK)
        outcome = write_texts(to, o, e, f);
    json_part_free(&to->part);
    to->open = 0;
    return outcome;
}

static void files_drop(verification_files *to)
{
    if (!to->open)
        return;
    if (to->output != NULL)
        store_close(&to->store, NULL, NULL, NULL);
    json_part_free(&to->part);
    to->open = 0;
}

static status add_imported(const char *path, int must_pass, sweep *s, fault *f)
{
    import_left left;
    TRY(import_store_read(path, must_pass, s, &left, f));
    if (left.series == left.all && must_pass)
        return fault_set(f, STATUS_REFUSED,
                         "--imported-must-pass: no quantity of %.150s was run, because the file "
                         "belongs to %s; select that case with -k, or give its --scene",
                         path, left.first);
    if (left.series == left.all)
        fprintf(stderr,
                "beamwork: %s: no quantity of this file was run, because the file belongs to %s; "
                "select that case with -k, or give its --scene\n",
                path, left.first);
    else if (left.series > 0)
        fprintf(stderr,
                "beamwork: %s: %d of %d series belong to cases or parameters that were not run; "
                "the first is %s\n",
                path, left.series, left.all, left.first);
    return STATUS_OK;
}

static int imported_was_evaluated(const sweep *s, const evaluation *j)
{
    for (int i = 0; i < j->verdicts; i++) {
        const imported *from = s->series[j->verdict[i].series].imported;
        if (from != NULL && from->gates && j->verdict[i].truth != NULL &&
            j->verdict[i].kind != VERDICT_SKIP && j->verdict[i].kind != VERDICT_OTHER_MODEL)
            return 1;
    }
    return 0;
}

static status plan(const void *requested, void *found, fault *f)
{
    verification *v = found;
    v->requested = requested;
    return plan_sweep(&v->requested->cells, &v->truths, &v->sweep, f);
}

static status run(const void *requested, void *found, fault *f)
{
    const verification_request *r = requested;
    verification *v = found;
    const verification_reader reader = {v->files, files_case};
    for (int i = 0; i < r->importeds; i++)
        TRY(add_imported(r->imported[i], r->imported_must_pass, &v->sweep, f));
    TRY(files_open(v->files, &v->sweep, &v->evaluation, f));
    return r->taken ? STATUS_OK
                    : verification_run(&r->cells, r->whole, &reader, &v->truths, &v->sweep,
                                       &v->evaluation, f);
}

static status evaluate(const void *requested, void *found, fault *f)
{
    const verification_request *r = requested;
    verification *v = found;
    if (r->taken)
        TRY(evaluate_all(&r->cells, r->whole, &v->truths, &v->sweep, &v->evaluation, f));
    if (r->imported_must_pass && !imported_was_evaluated(&v->sweep, &v->evaluation))
        return fault_set(f, STATUS_REFUSED,
                         "--imported-must-pass: no imported value has a verdict; make -k select "
                         "the program and a quantity with a reference value, and if the program "
                         "computes beams, write '# model: beam' in the file of 'beamwork import'");
    if (r->former != NULL && v->sweep.unfinished == 0)
        TRY(regressions_find(&v->former, r->former, &v->sweep, &v->evaluation, f));
    return overview_make(&v->sweep, &v->evaluation, &v->overview, f);
}

static int shows_limits(const verification *v)
{
    return v->requested->verbose || v->requested->cells.select != NULL || v->overview.rows == 1;
}

static void print(FILE *to, const verification *v)
{
    const screen look = screen_of(to);
    const sweep *s = &v->sweep;
    const evaluation *j = &v->evaluation;
    char sentence[SENTENCE_OF_RUN];
    if (v->requested->exit_zero)
        fputs("exploration: the exit status is 0 whatever the verdicts (--exit-zero)\n\n", to);
    table_breaches(to, look, j);
    if (!v->requested->quiet && shows_limits(v)) {
        table_verdicts(to, s, j);
        table_run_details(to, s, j);
        fputc('\n', to);
    }
    if (!v->requested->quiet) {
        table_overview(to, look, &v->overview);
        fputc('\n', to);
        table_run(to, s, j, clock_wall_seconds() - v->begun);
    }
    table_unexpected(to, look, s, j, &v->truths);
    sentence_of_run(s, j, sentence, sizeof sentence);
    table_run_end(to, look, sentence);
}

static status write_form(FILE *to, const char *format, const void *found, fault *f)
{
    const verification *v = found;
    environment made = environment_now(v->requested->cells.jobs);
    (void)format;
    if (v->requested->processor[0] != '\0')
        snprintf(made.processor, sizeof made.processor, "%s", v->requested->processor);
    print(to, v);
    return files_close(v->files, &v->overview, &made, f);
}

void verification_free(verification *v)
{
    files_drop(v->files);
    overview_free(&v->overview);
    evaluation_free(&v->evaluation);
    results_free(&v->former);
    sweep_free(&v->sweep);
    truths_free(&v->truths);
}

const experiment_type experiment_verify = {
    .name = "verify", .plan = plan, .run = run, .evaluate = evaluate, .write = write_form};
