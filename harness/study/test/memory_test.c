/* Memory exhaustion: every allocation fails once, in a few small cells, in reading reference
 * values, and in a results file. The test is linked with --wrap, which intercepts calls in the code
 * of this program. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cases/format/format.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void __real_free(void *old);
FILE *__real_open_memstream(char **text, size_t *size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void __wrap_free(void *old);
char *__wrap_strdup(const char *text);
FILE *__wrap_open_memstream(char **text, size_t *size);
char *__wrap_strndup(const char *text, size_t size);

static long calls, refused_call,
    live; /* refused_call: number of the call that must fail; 0: none */

static int refuse(void)
{
    return ++calls == refused_call;
}

void *__wrap_malloc(size_t size)
{
    void *p = refuse() ? NULL : __real_malloc(size);
    live += p != NULL;
    return p;
}

void *__wrap_calloc(size_t count, size_t size)
{
    void *p = refuse() ? NULL : __real_calloc(count, size);
    live += p != NULL;
    return p;
}

void *__wrap_realloc(void *old, size_t size)
{
    void *p = refuse() ? NULL : __real_realloc(old, size);
    live += p != NULL && old == NULL;
    return p;
}

void __wrap_free(void *old)
{
    live -= old != NULL;
    __real_free(old);
}

char *__wrap_strndup(const char *text, size_t size)
{
    const size_t length = strnlen(text, size);
    char *copy = __wrap_malloc(length + 1);
    if (copy != NULL) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

char *__wrap_strdup(const char *text)
{
    return __wrap_strndup(text, strlen(text));
}

FILE *__wrap_open_memstream(char **text, size_t *size)
{
    FILE *file = refuse() ? NULL : __real_open_memstream(text, size);
    live += file != NULL;
    return file;
}

/* An operation to be tested. Returns STATUS_OK and sets *value to a sum over the results, or
 * returns a failure. */
typedef status memory_attempt(const void *what, double *value, fault *f);

static void exhaust(const char *name, memory_attempt *run, const void *what, int most)
{
    double right = NAN;
    fault f = {""};
    calls = refused_call = 0;
    const long before = live;
    gsl_test(run(what, &right, &f) != STATUS_OK, "%s: with enough memory (%s)", name, f.text);
    const long all = calls, step = all / most + 1;
    int bad_status = 0, bad_line = 0, wrong = 0, leaks = live != before;
    char worst[FAULT_TEXT + 100] = "";
    for (long k = 1; k <= all; k += step) {
        double value = NAN;
        fault why = {""};
        calls = 0;
        refused_call = k;
        const status outcome = run(what, &value, &why);
        refused_call = 0;
        const int reports_it = outcome == STATUS_FAULT ||
                               (outcome == STATUS_REFUSED && strstr(why.text, "memory") != NULL);
        const int good = outcome == STATUS_OK
                             ? fabs(value - right) <= 1e-13 * fabs(right)
                             : reports_it && why.text[0] != '\0' && strchr(why.text, '\n') == NULL;
        bad_status += outcome != STATUS_OK && !reports_it;
        bad_line += outcome != STATUS_OK && reports_it && !good;
        wrong += outcome == STATUS_OK && !good;
        leaks += live != before;
        if ((!good || live != before) && worst[0] == '\0')
            snprintf(worst, sizeof worst, "call %ld of %ld: %s '%s', %ld live", k, all,
                     status_name(outcome), why.text, live - before);
        if (getenv("MEMORY_TEST_ALL") != NULL && (!good || live != before))
            fprintf(stderr, "%s: call %ld of %ld: %s '%s', value %.17g (%.17g), %ld live\n", name,
                    k, all, status_name(outcome), why.text, value, right, live - before);
        live = before;
    }
    gsl_test(all < 10, "%s: %ld allocations", name, all);
    gsl_test(bad_status + bad_line > 0, "%s: %d failures of another kind, %d without a line; %s",
             name, bad_status, bad_line, worst);
    gsl_test(wrong > 0, "%s: %d wrong answers; %s", name, wrong, worst);
    gsl_test(leaks > 0, "%s: %d leaks; %s", name, leaks, worst);
}

typedef struct cell_choice {
    const char *case_name, *formulation;
    int elements;
} cell_choice;

static status solve(const void *what, double *value, fault *f)
{
    const cell_choice *choice = what;
    cell_request request = {.elements = choice->elements};
    cell_result r;
    formulation chosen;
    request.type = case_find(choice->case_name, f);
    if (request.type == NULL || formulation_parse(choice->formulation, &chosen, f) != STATUS_OK)
        return STATUS_REFUSED;
    parameters_default(request.type, request.parameter);
    cell_formulation(&request, &chosen);
    const status outcome = cell_run(&request, &r, f);
    *value = 0;
    for (int i = 0; i < r.solve.quantities; i++)
        *value += isfinite(r.solve.quantity[i].value) ? r.solve.quantity[i].value : 0;
    cell_result_free(&r);
    return outcome;
}

static status read_truths(const void *what, double *value, fault *f)
{
    truths t;
    const status outcome = truths_read(what, &t, f);
    *value = outcome == STATUS_OK ? t.rows : NAN;
    if (outcome == STATUS_OK)
        truths_free(&t);
    return outcome;
}

static status read_scene(const void *what, double *value, fault *f)
{
    scene_file *file = NULL;
    mistakes m;
    scene s;
    truths t = {0};
    double parameter[CASE_MAX_PARAMETERS] = {0};
    TRY(scene_file_read(what, &file, &m, f));
    parameter_defaults(scene_file_case(file)->parameters, parameter);
    scene_init(&s, "scene");
    status outcome = case_build(scene_file_case(file), parameter, &s, f);
    if (outcome == STATUS_OK)
        outcome = scene_truths_add_all(file, &t, f);
    *value = t.rows;
    const int nodes = outcome == STATUS_OK ? s.nodes : 0;
    for (int i = 0; i < nodes; i++)
        *value += fabs(s.node[i].position[0]) + 3 * fabs(s.node[i].position[1]);
    truths_free(&t);
    scene_free(&s);
    scene_file_free(file);
    return outcome;
}

static status write_results(const void *what, double *value, fault *f)
{
    static const int mesh[] = {1, 2};
    double parameter[CASE_MAX_PARAMETERS] = {0};
    const environment e = environment_now(1);
    sweep s;
    formulation chosen;
    truths none = {0};
    evaluation j = {0};
    parameters_default(registry_cases[0], parameter);
    formulation_default(registry_formulations[0], &chosen);
    TRY(plan_one(registry_cases[0], parameter, &chosen, 1, mesh, 2, &s, f));
    for (int i = 0; i < s.series[0].meshes; i++)
        s.series[0].cell[i].solve.status = STATUS_SINGULAR;
    status outcome = evaluation_make(&s, &none, 0, &j, f);
    if (outcome == STATUS_OK)
        outcome = store_write(what, NULL, &s, &j, &e, f);
    *value = access(what, F_OK) == 0;
    if (outcome != STATUS_OK && *value != 0)
        fault_set(f, STATUS_OK, "a file\nwas left");
    unlink(what);
    evaluation_free(&j);
    sweep_free(&s);
    return outcome;
}

int main(void)
{
    static const cell_choice choice[] = {
        {"elastica", "collocation", 2},        {"elastica", "beamw:newton=dense", 4},
        {"c_column", "beamw_consistent", 2},   {"sheet_cantilever", "sheet_third", 1},
        {"spherical_joint", "sheet_third", 1}, {"moment_buckling", "geometrically_exact", 2},
        {"warping_torsion", "beamw_vlasov", 2}};
    const char *truths_path =
        getenv("BEAMWORK_TRUTHS") != NULL ? getenv("BEAMWORK_TRUTHS") : "build/truths.h5";
    char path[64];
    for (size_t i = 0; i < sizeof choice / sizeof choice[0]; i++) {
        char name[100];
        snprintf(name, sizeof name, "%s with %s", choice[i].case_name, choice[i].formulation);
        exhaust(name, solve, &choice[i], 120);
    }
    exhaust("guide", read_scene, "cases/examples/leaf_spring_guide.yaml", 400);
    exhaust("parts", read_scene, "cases/examples/folded_leaf_stage.yaml", 400);
    exhaust("truths", read_truths, truths_path, 40);
    snprintf(path, sizeof path, "/tmp/beamwork_memory_%ld.h5", (long)getpid());
    exhaust("results", write_results, path, 200);
    return gsl_test_summary();
}
