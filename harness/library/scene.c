#include "harness/library/library_impl.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cases/format/format.h"
#include "harness/experiments/experiments.h"

static status new_scene(const case_type *type, scene_file *file, char *name, bw_scene **out,
                        fault *f)
{
    source *from;
    TRY(source_new(type, file, name, &from, f));
    bw_scene *s = calloc(1, sizeof *s);
    if (s == NULL) {
        source_release(from);
        return fault_memory(f, "a scene");
    }
    s->from = from;
    parameters_default(type, s->parameter);
    *out = s;
    return STATUS_OK;
}

static status find(const char *name, bw_scene **out, fault *f)
{
    if (out != NULL)
        *out = NULL;
    if (name == NULL || out == NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "bw_scene_case: an argument is NULL; give a name and a pointer for the scene");
    const case_type *type = case_find(name, f);
    return type != NULL ? new_scene(type, NULL, NULL, out, f) : STATUS_REFUSED;
}

bw_status bw_scene_case(const char *name, bw_scene **out, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, find(name, out, &c.fault));
}

static void report(const mistakes *m, call *c)
{
    document_text t;
    fault f;
    if (m->count > 0 && text_begin(&t, &f) == STATUS_OK)
        text_end(&t, mistakes_json(m, t.to, &f), &c->text, &f);
}

static status read_file(const char *bytes, size_t size, const char *name, scene_file **out,
                        mistakes *m, fault *f)
{
    return bytes != NULL ? scene_file_read_bytes(bytes, size, name, out, m, f)
                         : scene_file_read(name, out, m, f);
}

static status read_scene(const char *bytes, size_t size, const char *name, bw_scene **out, call *c)
{
    scene_file *file;
    mistakes m;
    char *kept = strdup(name);
    if (kept == NULL)
        return fault_memory(&c->fault, "a scene");
    const status outcome = read_file(bytes, size, kept, &file, &m, &c->fault);
    if (outcome == STATUS_OK)
        return new_scene(scene_file_case(file), file, kept, out, &c->fault);
    report(&m, c);
    free(kept);
    return outcome;
}

bw_status bw_scene_read(const char *bytes, size_t size, const char *name, bw_scene **out,
                        char **why)
{
    call c;
    call_begin(&c, why);
    if (out != NULL)
        *out = NULL;
    if (bytes == NULL || out == NULL)
        return call_end(
            &c, fault_set(
                    &c.fault, STATUS_REFUSED,
                    "bw_scene_read: an argument is NULL; give a text and a pointer for the scene"));
    return call_end(&c, read_scene(bytes, size, name != NULL ? name : "scene", out, &c));
}

bw_status bw_scene_open(const char *path, bw_scene **out, char **why)
{
    call c;
    call_begin(&c, why);
    if (out != NULL)
        *out = NULL;
    if (path == NULL || out == NULL)
        return call_end(
            &c, fault_set(
                    &c.fault, STATUS_REFUSED,
                    "bw_scene_open: an argument is NULL; give a path and a pointer for the scene"));
    return call_end(&c, read_scene(NULL, 0, path, out, &c));
}

bw_status bw_scene_set(bw_scene *s, const char *assignment, char **why)
{
    call c;
    call_begin(&c, why);
    if (s == NULL || assignment == NULL)
        return call_end(
            &c,
            fault_set(
                &c.fault, STATUS_REFUSED,
                "bw_scene_set: an argument is NULL; give a scene and a text such as NAME=VALUE"));
    return call_end(&c, parameters_set(source_case(s->from), assignment, s->parameter, &c.fault));
}

static status write_yaml(FILE *to, const bw_scene *handle, fault *f)
{
    const case_type *type = source_case(handle->from);
    const write_head head = {type->name, type->summary, type->source};
    scene s = {0};
    status outcome = cell_scene(type, handle->parameter, NULL, &s, f);
    if (outcome == STATUS_OK)
        outcome = write_scene(to, &s, &head, f);
    scene_free(&s);
    return outcome;
}

static status write_list(FILE *to, const bw_scene *handle, fault *f)
{
    return list_json_case(to, source_case(handle->from), handle->parameter, f);
}

static status document(const bw_scene *s, char **out, const char *what,
                       status (*write)(FILE *, const bw_scene *, fault *), fault *f)
{
    document_text t;
    if (out != NULL)
        *out = NULL;
    if (s == NULL || out == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "%s: an argument is NULL; give a scene and a pointer for the text", what);
    TRY(text_begin(&t, f));
    return text_end(&t, write(t.to, s, f), out, f);
}

bw_status bw_scene_write(const bw_scene *s, char **yaml, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, document(s, yaml, "bw_scene_write", write_yaml, &c.fault));
}

bw_status bw_scene_json(const bw_scene *s, char **json, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, document(s, json, "bw_scene_json", write_list, &c.fault));
}

void bw_scene_free(bw_scene *s)
{
    if (s == NULL)
        return;
    source_release(s->from);
    free(s);
}

static status list_write_list(FILE *to, const list_subject *what, const truths *deviations,
                              fault *f)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    if (what->type != NULL) {
        parameters_default(what->type, value);
        return list_json_case(to, what->type, value, f);
    }
    if (what->chosen.type != NULL)
        return list_json_formulation(to, &what->chosen, deviations->rule, deviations->rules, f);
    return list_json_all(to, what->cases, what->formulations, f);
}

static status list_of(const char *name, char **json, fault *f)
{
    list_subject what;
    truths deviations = {0};
    document_text t;
    if (json == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "bw_list: the pointer is NULL; give a pointer for the text");
    *json = NULL;
    TRY(list_subject_find(name, &what, f));
    TRY(text_begin(&t, f));
    known_read(NULL, &deviations, NULL);
    const status outcome = text_end(&t, list_write_list(t.to, &what, &deviations, f), json, f);
    truths_free(&deviations);
    return outcome;
}

bw_status bw_list(const char *what, char **json, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, list_of(what, json, &c.fault));
}

static status lost(fault *f)
{
    return fault_memory(f, "a document");
}

status text_begin(document_text *t, fault *f)
{
    *t = (document_text){0};
    t->to = open_memstream(&t->bytes, &t->size);
    return t->to != NULL ? STATUS_OK : lost(f);
}

status text_end(document_text *t, status written, char **out, fault *f)
{
    const int failed = fclose(t->to) != 0;
    *out = NULL;
    if (written != STATUS_OK || failed) {
        free(t->bytes);
        return written != STATUS_OK ? written : lost(f);
    }
    *out = t->bytes;
    return STATUS_OK;
}

/* Reads names that are separated by blanks. Text NULL: there are no names, and *count is 0. *named
 * (may be NULL): 1 if there are names and none is "all". */
static status contestants_parse(const char *names, formulation list[CONTESTANTS_MOST], int *count,
                                int *named, fault *f)
{
    int all = 0;
    char one[FORMULATION_KEY + 64];
    *count = 0;
    for (const char *at = names != NULL ? names : ""; *at != '\0';) {
        const int blanks = (int)strspn(at, " "), length = (int)strcspn(at + blanks, " ");
        at += blanks;
        if (length >= (int)sizeof one)
            return fault_set(f, STATUS_REFUSED,
                             "formulation '%.60s...': the name is too long; give a shorter one",
                             at);
        snprintf(one, sizeof one, "%.*s", length, at);
        if (length > 0)
            TRY(formulation_list_add(one, CONTESTANTS_MOST, list, count, f));
        all |= strcmp(one, "all") == 0;
        at += length;
    }
    if (named != NULL)
        *named = *count > 0 && !all;
    return STATUS_OK;
}

static int contestants_jobs(void)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    return processors < 1 ? 1 : processors < WORKERS_MOST ? (int)processors : WORKERS_MOST;
}

static status contestants_finished(const sweep *s, fault *f)
{
    return s->unfinished == 0 ? STATUS_OK
                              : fault_set(f, STATUS_TIME_LIMIT,
                                          "stopped before all runs were complete, as option 'stop' "
                                          "requested; number of missing runs: %d",
                                          s->unfinished);
}

typedef struct study {
    const bw_scene *scene;
    double level;
    const char *select;
    json_t *kept;
    formulation formulation[CONTESTANTS_MOST];
    int formulations, mesh[SCENE_MESHES], meshes, jobs, stop;
    truths truths;
    sweep sweep;
} study;

static status read_truths(study *s, fault *f)
{
    const scene_file *file = source_file(s->scene->from);
    return file != NULL ? scene_truths_add(file, s->scene->parameter, &s->truths, f)
                        : known_read(source_case(s->scene->from), &s->truths, f);
}

static status prepare(study *s, const char *names, const char *meshes, const char *options,
                      fault *f)
{
    const call_option table[] = {{"error", OPTION_SHARE, &s->level, 0, 0},
                                 {"select", OPTION_WORDS, &s->select, 0, 0},
                                 {"jobs", OPTION_WHOLE, &s->jobs, 1, WORKERS_MOST},
                                 {"stop", OPTION_FILE, &s->stop, 1, INT_MAX},
                                 {.name = NULL}};
    TRY(options_read(options, table, &s->kept, f));
    TRY(contestants_parse(names, s->formulation, &s->formulations, NULL, f));
    if (s->formulations == 0)
        TRY(formulation_list_add("all", CONTESTANTS_MOST, s->formulation, &s->formulations, f));
    if (meshes != NULL)
        TRY(meshes_parse(meshes, SCENE_MESHES, s->mesh, &s->meshes, f));
    TRY(read_truths(s, f));
    TRY(plan_one(source_case(s->scene->from), s->scene->parameter, s->formulation, s->formulations,
                 s->mesh, s->meshes, &s->sweep, f));
    return narrow_to(&s->sweep, s->select, f);
}

static status write_study(study *s, char **json, fault *f)
{
    const sweep_request request = {.jobs = s->jobs, .stop = s->stop};
    document_text t;
    TRY(verification_cells(&request, &s->truths, &s->sweep, f));
    TRY(contestants_finished(&s->sweep, f));
    TRY(families_add_truths(&s->sweep, 0, &s->truths, f));
    TRY(text_begin(&t, f));
    return text_end(&t, json_convergence_write(t.to, &s->sweep, &s->truths, s->level, f), json, f);
}

static status converge(const bw_scene *from, const char *names, const char *meshes,
                       const char *options, char **json, fault *f)
{
    study s = {.scene = from, .level = REACH_LINE_LEVEL, .jobs = contestants_jobs()};
    if (json != NULL)
        *json = NULL;
    if (from == NULL || json == NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "bw_converge: an argument is NULL; give a scene and a pointer for the text");
    status outcome = prepare(&s, names, meshes, options, f);
    if (outcome == STATUS_OK)
        outcome = write_study(&s, json, f);
    sweep_free(&s.sweep);
    truths_free(&s.truths);
    json_decref(s.kept);
    return outcome;
}

bw_status bw_converge(const bw_scene *from, const char *formulations, const char *meshes,
                      const char *options, char **json, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, converge(from, formulations, meshes, options, json, &c.fault));
}

enum {
    TIME_LIMIT = 120 /* [s] default time limit of a cell */,
    LONGEST = 1000000,
    DOUBLINGS = 10,
    PICTURES = 5
};

typedef struct verify_trial {
    const bw_scene *scene;
    const char *results;
    sweep_request request;
    const case_type *type[2];
    formulation formulation[CONTESTANTS_MOST];
    json_t *kept;
    /* path of the results of a previous run; the results of this run must not be worse; NULL:
     * none */
    const char *former_path;
    stored_results former;
    truths truths;
    sweep sweep;
    evaluation evaluation;
} verify_trial;

static status verify_read_truths(verify_trial *v, fault *f)
{
    if (v->scene == NULL)
        return known_read_all(&v->truths, f);
    const scene_file *file = source_file(v->scene->from);
    TRY(known_read(file == NULL ? source_case(v->scene->from) : NULL, &v->truths, f));
    return file != NULL ? scene_truths_add_all(file, &v->truths, f) : STATUS_OK;
}

static status read_former(verify_trial *v, fault *f)
{
    known_lock();
    const status outcome = results_read(v->former_path, &v->former, f);
    known_unlock();
    return outcome;
}

static status verify_prepare(verify_trial *v, const char *names, const char *options, fault *f)
{
    sweep_request *r = &v->request;
    const call_option table[] = {
        {"jobs", OPTION_WHOLE, &r->jobs, 1, WORKERS_MOST},
        {"time_limit", OPTION_WHOLE, &r->time_limit, 0, LONGEST},
        {"refine", OPTION_WHOLE, &r->doublings, 0, DOUBLINGS},
        {"doublings", OPTION_WHOLE, &r->doublings, 0, DOUBLINGS}, /* former name of "refine", which
                                                                   * version 0.2 used */
        {"shapes", OPTION_WHOLE, &r->shapes, 0, PICTURES},
        {"stop", OPTION_FILE, &r->stop, 1, INT_MAX},
        {"tolerance", OPTION_SHARE, &r->tolerance, 0, 0},
        {"not_worse_than", OPTION_WORDS, &v->former_path, 0, 0},
        {.name = NULL}};
    file_place where;
    TRY(options_read(options, table, &v->kept, f));
    TRY(contestants_parse(names, v->formulation, &r->formulations, &r->named, f));
    r->formulation = v->formulation;
    if (v->scene != NULL) {
        v->type[0] = source_case(v->scene->from);
        r->cases = v->type;
    }
    if (v->former_path != NULL)
        TRY(read_former(v, f));
    if (v->results != NULL) {
        TRY(output_try(v->results, OUTPUT_WHOLE_FILE, &where, f));
        TRY(kept_check(v->results, f));
    }
    return verify_read_truths(v, f);
}

static status evaluate(verify_trial *v, fault *f)
{
    const sweep_request *r = &v->request;
    const int whole = r->select == NULL && r->formulations == 0 && v->scene == NULL;
    TRY(plan_sweep(r, &v->truths, &v->sweep, f));
    TRY(verification_run(r, whole, NULL, &v->truths, &v->sweep, &v->evaluation, f));
    TRY(contestants_finished(&v->sweep, f));
    if (v->former_path == NULL)
        return STATUS_OK;
    known_lock();
    const status outcome =
        regressions_find(&v->former, v->former_path, &v->sweep, &v->evaluation, f);
    known_unlock();
    return outcome;
}

static status keep(const verify_trial *v, const environment *e, fault *f)
{
    if (v->results == NULL)
        return STATUS_OK;
    known_lock();
    const status outcome = store_write(v->results, NULL, &v->sweep, &v->evaluation, e, f);
    known_unlock();
    return outcome;
}

static status answer(verify_trial *v, char **json, fault *f)
{
    document_text t;
    TRY(evaluate(v, f));
    const environment e = environment_now(v->request.jobs);
    TRY(keep(v, &e, f));
    TRY(text_begin(&t, f));
    return text_end(&t, json_write_verdicts(t.to, &v->sweep, &v->evaluation, &e, NULL, f), json, f);
}

static status verify(verify_trial *v, const char *names, const char *options, char **json, fault *f)
{
    if (json == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "bw_verify: the pointer is NULL; give a pointer for the text");
    *json = NULL;
    status outcome = verify_prepare(v, names, options, f);
    if (outcome == STATUS_OK)
        outcome = answer(v, json, f);
    evaluation_free(&v->evaluation);
    results_free(&v->former);
    sweep_free(&v->sweep);
    truths_free(&v->truths);
    json_decref(v->kept);
    return outcome;
}

bw_status bw_verify(const bw_scene *from, const char *formulations, const char *select,
                    const char *options, const char *into, char **json, char **why)
{
    call c;
    call_begin(&c, why);
    verify_trial v = {
        .scene = from,
        .results = into,
        .request = {.select = select, .jobs = contestants_jobs(), .time_limit = TIME_LIMIT}};
    return call_end(&c, verify(&v, formulations, options, json, &c.fault));
}
