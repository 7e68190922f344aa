#include "harness/experiments/experiments_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

typedef struct verification {
    truths *truths;
    judgement *judgement;
    const verification_reader *reader; /* NULL: none */
    int judged;                        /* series that are */
} verification;

static int doubts(void *context, const sweep *s, int series_index)
{
    const verification *v = context;
    return judgement_doubts(s, v->truths, series_index);
}

static const case_type *case_of(const sweep *s, int series_index)
{
    return s->point[s->series[series_index].point].type;
}

/* Passes on the case of a series if this is its last one. */
static void hand_over(verification *v, const sweep *s, int series_index)
{
    const case_type *type = case_of(s, series_index);
    if (v->reader == NULL)
        return;
    for (int i = series_index + 1; i < s->seriess; i++)
        if (case_of(s, i) == type)
            return;
    v->reader->judged(v->reader->context, type);
}

/* Evaluates the series up to that one, whose points are all complete. */
static status judge_to(verification *v, const sweep *s, int end, fault *f)
{
    int of = -1;
    for (int i = v->judged; i < end; i++) {
        if (s->series[i].point != of)
            TRY(families_add_point(s, s->series[i].point, 1, v->truths, f));
        of = s->series[i].point;
        TRY(judgement_add(s, v->truths, i, v->judgement, f));
    }
    v->judged = end;
    return STATUS_OK;
}

/* Evaluates the series of a point together, since the agreement of formulations depends on all of
 * them. */
static status whole(void *context, const sweep *s, int series_index, fault *f)
{
    verification *v = context;
    const int here = s->series[series_index].point;
    if (v->judged < series_index && s->series[v->judged].point != here)
        TRY(judge_to(v, s, series_index, f)); /* the rest of that point was not run */
    if (series_index + 1 < s->seriess && s->series[series_index + 1].point == here)
        return STATUS_OK;
    TRY(judge_to(v, s, series_index + 1, f));
    hand_over(v, s, series_index);
    return STATUS_OK;
}

enum { MOST_OWN = 64 };

/* Formulations that were named or loaded, each once. */
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

static status add_breach(const certificate *c, judgement *out, fault *f)
{
    const claim *broken = certificate_broken(c);
    breach one;
    if (broken == NULL)
        return STATUS_OK;
    snprintf(one.formulation, sizeof one.formulation, "%s", c->chosen.key);
    snprintf(one.why, sizeof one.why, "%s: %.240s", broken->name, broken->sentence);
    return memory_append(&out->breach, &out->breaches, &one, sizeof one, "broken contracts", f);
}

/* Checks them against the interface before anything is run, because their results are meaningless
 * if they violate it. */
static status hold_contracts(const sweep *s, int jobs, int time_limit, judgement *out, fault *f)
{
    formulation own[MOST_OWN];
    certificate *found = NULL;
    const certificate_request what = {.chosen = own,
                                      .count = find_own(s, own),
                                      .jobs = jobs,
                                      .time_limit = time_limit,
                                      .contract_only = 1};
    if (what.count == 0)
        return STATUS_OK;
    status outcome = certificate_find(&what, &found, f);
    for (int i = 0; i < what.count && outcome == STATUS_OK; i++)
        outcome = add_breach(&found[i], out, f);
    certificate_free(found, what.count);
    return outcome;
}

static status begin(verification *v, const sweep *s, int jobs, int time_limit, fault *f)
{
    memset(v->judgement, 0, sizeof *v->judgement);
    TRY(families_reserve(s, 1, v->truths, f));
    TRY(judgement_begin(s, v->truths, v->judgement, f));
    return hold_contracts(s, jobs, time_limit, v->judgement, f);
}

/* Evaluates the remaining series: those of a point that an interrupted run did not finish. */
static status end(verification *v, const sweep *s, int everything, fault *f)
{
    TRY(judge_to(v, s, s->seriess, f));
    judgement_end(s, v->truths, everything && s->unfinished == 0, v->judgement);
    return STATUS_OK;
}

status verification_run(const sweep_request *request, int everything,
                        const verification_reader *reader, truths *t, sweep *s, judgement *out,
                        fault *f)
{
    verification v = {.truths = t, .judgement = out, .reader = reader};
    const sweep_follower follower = {.context = &v, .doubts = doubts, .whole = whole};
    sweep_request followed = *request;
    followed.follower = &follower;
    TRY(begin(&v, s, request->jobs, request->time_limit, f));
    TRY(run_sweep(&followed, s, f));
    return end(&v, s, everything, f);
}

status verification_cells(const sweep_request *request, truths *t, sweep *s, fault *f)
{
    verification v = {.truths = t};
    const sweep_follower follower = {.context = &v, .doubts = doubts};
    sweep_request followed = *request;
    followed.follower = &follower;
    return run_sweep(&followed, s, f);
}

status verification_judge(const sweep_request *request, int everything, truths *t, const sweep *s,
                          judgement *out, fault *f)
{
    verification v = {.truths = t, .judgement = out};
    TRY(begin(&v, s, request->jobs, request->time_limit, f));
    return end(&v, s, everything, f);
}

status verification_files_open(verification_files *to, const sweep *s, const judgement *j, fault *f)
{
    to->sweep = s;
    to->judged = j;
    if (to->output != NULL)
        TRY(store_open(NULL, s, j, &to->store, f));
    to->part = (json_part){.verdicts = 0};
    if (to->json != NULL)
        json_part_begin(&to->part);
    to->open = 1;
    return STATUS_OK;
}

void verification_files_case(void *files, const case_type *type)
{
    verification_files *to = files;
    if (to->output != NULL)
        store_case(&to->store, type);
    if (to->json != NULL)
        json_part_add(&to->part, to->sweep, to->judged);
}

/* Returns the destination of a file; for an interrupted run its name says so. */
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
        &file, json_write_verdicts(file.stream, to->sweep, to->judged, e, &to->part, f), f);
}

static status write_junit(const verification_files *to, fault *f)
{
    output file;
    TRY(open_text(to, to->junit, &file, f));
    junit_write(file.stream, to->sweep, to->judged);
    return output_close(&file, f);
}

static status write_markdown(const verification_files *to, const overview *o, const environment *e,
                             fault *f)
{
    output file;
    TRY(open_text(to, to->markdown, &file, f));
    markdown_write(file.stream, to->sweep, to->judged, o, e);
    return output_close(&file, f);
}

static status write_proposal(const verification_files *to, fault *f)
{
    output file;
    TRY(open_text(to, to->propose, &file, f));
    proposal_write(file.stream, to->sweep, to->judged);
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

/* The store is closed in any case. */
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

status verification_files_close(verification_files *to, const overview *o, const environment *e,
                                fault *f)
{
    status outcome = write_store(to, e, f);
    if (outcome == STATUS_OK)
        outcome = write_texts(to, o, e, f);
    json_part_free(&to->part);
    to->open = 0;
    return outcome;
}

void verification_files_drop(verification_files *to)
{
    if (!to->open)
        return;
    if (to->output != NULL)
        store_close(&to->store, NULL, NULL, NULL);
    json_part_free(&to->part);
    to->open = 0;
}

/* Allowed increase of an error: between processors, the kernels of LAPACK change errors of some
 * series near rounding by up to 1.2 %. */
static const double LARGER = 0.02;

/* Allowed relative change of a limit if no reference value checks it as closely: 1e-5, so that a
 * fault of 1e-3 is detected wherever it changes a limit by a hundredth of itself. */
static const double MOVED = 1e-5;

/* The run as it will be stored, read back, so that both sides are treated in the same way. */
static status read_back(const sweep *s, const judgement *j, stored_results *out, fault *f)
{
    const char *folder = getenv("TMPDIR");
    char path[PATH_MAX];
    const environment e = environment_now(1);
    if (snprintf(path, sizeof path, "%s/beamwork-XXXXXX", folder != NULL ? folder : "/tmp") >=
        (int)sizeof path)
        return fault_set(f, STATUS_FAULT, "TMPDIR: the name is too long");
    const int file = mkstemp(path);
    if (file < 0)
        return fault_set(f, STATUS_FAULT, "%.200s: cannot be written; set TMPDIR to a folder",
                         path);
    close(file);
    status outcome = store_write(path, NULL, s, j, &e, f);
    if (outcome == STATUS_OK)
        outcome = results_read(path, out, f);
    unlink(path);
    return outcome;
}

/* A line of the comparison, "worse    NAME n=4: WHY". */
static status add_line(const char *line, judgement *j, fault *f)
{
    static const comparison_kind counted[] = {CHANGE_WORSE, CHANGE_GONE};
    for (size_t i = 0; i < sizeof counted / sizeof counted[0]; i++) {
        const char *kind = comparison_kind_names[counted[i]];
        const size_t length = strlen(kind);
        if (strncmp(line, kind, length) != 0 || line[length] != ' ')
            continue;
        const char *name = line + length + strspn(line + length, " "), *why = strstr(name, ": ");
        regression one;
        snprintf(one.of, sizeof one.of, "%.*s", why != NULL ? (int)(why - name) : (int)strlen(name),
                 name);
        snprintf(one.why, sizeof one.why, "%s%s", counted[i] == CHANGE_GONE ? "gone" : "",
                 why != NULL ? why + (counted[i] == CHANGE_GONE ? 0 : 2) : "");
        return memory_append(&j->regression, &j->regressions, &one, sizeof one, "regressions", f);
    }
    return STATUS_OK;
}

static status add_lines(char *text, judgement *j, fault *f)
{
    char *rest = NULL;
    for (char *line = strtok_r(text, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest))
        TRY(add_line(line, j, f));
    return STATUS_OK;
}

static status compare(const stored_results *former, const char *name, const stored_results *now,
                      judgement *j, fault *f)
{
    const comparison_limits limits = {LARGER, RESULTS_FLOOR, DBL_MAX};
    char *text = NULL;
    size_t size = 0;
    comparison c;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a comparison");
    comparison_run(to, former, now, &limits, NULL, &c);
    status outcome =
        fclose(to) == 0 ? STATUS_OK : fault_set(f, STATUS_FAULT, "out of memory for a comparison");
    if (outcome == STATUS_OK && c.pairs == 0)
        outcome = fault_set(f, STATUS_REFUSED,
                            "--not-worse-than %.120s has no results of this run; give a run of the "
                            "same formulations and cases",
                            name);
    if (outcome == STATUS_OK)
        outcome = add_lines(text, j, f);
    free(text);
    return outcome;
}

/* The limit of a quantity of a series at its default point in the former run, or NULL. */
static const result_limit *limit_of_former(const stored_results *former, const sweep *s,
                                           const verdict *v)
{
    const series *one = &s->series[v->series];
    const sweep_point *p = &s->point[one->point];
    char name[FAULT_TEXT];
    snprintf(name, sizeof name, "%s/default/%s", p->type->name, one->formulation.key);
    for (int i = 0; p->text[0] == '\0' && i < former->seriess; i++)
        for (int k = 0; strcmp(former->series[i].name, name) == 0 && k < former->series[i].limits;
             k++)
            if (strcmp(former->series[i].limit[k].quantity, p->scene.quantity[v->quantity].name) ==
                0)
                return &former->series[i].limit[k];
    return NULL;
}

/* Does a reference value check the limit as closely? Not if it is an estimate, if the limit has a
 * larger uncertainty, or if a known deviation allows it to differ. */
static int is_judged_closely(const verdict *v, double slack)
{
    return (v->kind == VERDICT_PASS || v->kind == VERDICT_BIASED_AS_PREDICTED ||
            v->kind == VERDICT_WRONG_AS_PREDICTED) &&
           strcmp(v->truth->kind, "exact") == 0 &&
           3 * v->fit.limit_uncertainty + v->truth->uncertainty <= slack;
}

static status find_moved(const stored_results *former, const sweep *s, judgement *j, fault *f)
{
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        const series *one = &s->series[v->series];
        const scene_quantity *q = &s->point[one->point].scene.quantity[v->quantity];
        const result_limit *old = isfinite(v->fit.limit) && v->kind != VERDICT_OTHER_MODEL
                                      ? limit_of_former(former, s, v)
                                      : NULL;
        if (old == NULL || one->imported != NULL)
            continue;
        const double slack = MOVED * fmax(fabs(old->value), q->near_zero);
        if (fabs(v->fit.limit - old->value) <= slack || is_judged_closely(v, slack))
            continue;
        regression new;
        snprintf(new.of, sizeof new.of, "%s/default/%s", s->point[one->point].type->name,
                 one->formulation.key);
        snprintf(new.why, sizeof new.why,
                 "limit of %s %.10g -> %.10g %s, which no reference value checks as closely",
                 q->name, old->value, v->fit.limit, q->unit);
        TRY(memory_append(&j->regression, &j->regressions, &new, sizeof new, "regressions", f));
    }
    return STATUS_OK;
}

status regressions_find(const stored_results *former, const char *name, const sweep *s,
                        judgement *j, fault *f)
{
    stored_results now = {.cells = 0};
    status outcome = read_back(s, j, &now, f);
    if (outcome == STATUS_OK)
        outcome = compare(former, name, &now, j, f);
    if (outcome == STATUS_OK)
        outcome = find_moved(former, s, j, f);
    results_free(&now);
    return outcome;
}
