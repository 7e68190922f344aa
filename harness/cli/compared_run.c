#include "harness/cli/cli_impl.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/experiments/experiments.h"
#include "harness/model/model.h"
#include "harness/numerics/numerics.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

enum { MOST_REPEATS = 10000, NAME = 40 };
static const double budget_seconds = 3, lap_seconds = 0.002;

static void set_counted(compared_run *c)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int fields = schema_fields(&record_cell, 0, list);
    c->counts = 0;
    for (int i = 0; i < fields; i++)
        if (strcmp(list[i]->unit, "1") == 0)
            c->counted[c->counts++] = list[i];
}

static void count_cell(compared_run *c, cell_result *cell)
{
    const series one = {.meshes = 1, .mesh = {c->request.elements}, .cell = cell};
    const subject s = {.series = &one, .record = cell};
    for (int i = 0; i < c->counts; i++) {
        field_value v;
        schema_read(&s, c->counted[i], &v);
        c->count[i] = c->counted[i]->kind == FIELD_DOUBLE ? *v.numbers : (double)v.whole;
    }
}

static status lap_here(compared_run *c, double *seconds, fault *f)
{
    const double start = clock_processor_seconds();
    for (int i = 0; i < c->repeats; i++) {
        cell_result cell;
        const status outcome = cell_run(&c->request, &cell, f);
        count_cell(c, &cell);
        cell_result_free(&cell);
        if (outcome != STATUS_OK)
            return outcome;
    }
    const double end = start + (1 + c->slowdown) * (clock_processor_seconds() - start);
    do
        *seconds = clock_processor_seconds() - start;
    while (start + *seconds < end);
    return STATUS_OK;
}

static status read_lap(compared_run *c, FILE *from, double *seconds, fault *f)
{
    json_error_t where;
    json_t *root = json_loadf(from, 0, &where), *cell = json_object_get(root, record_cell.name);
    *seconds = json_number_value(json_object_get(cell, "seconds_setup")) +
               json_number_value(json_object_get(cell, "seconds_solve"));
    for (int i = 0; i < c->counts; i++)
        c->count[i] = json_number_value(json_object_get(cell, c->counted[i]->name));
    json_decref(root);
    return *seconds > 0 ? STATUS_OK
                        : fault_set(f, STATUS_FAULT,
                                    "%s: the output of 'solve --format json' contains no times; "
                                    "give the path of a newer build of beamwork",
                                    c->program);
}

static status lap_elsewhere(compared_run *c, double *seconds, fault *f)
{
    int ends[2], how = 0;
    const pid_t child = pipe(ends) == 0 ? fork() : -1;
    if (child < 0)
        return fault_set(f, STATUS_FAULT,
                         "%s cannot be started; close other programs, and run the command again",
                         c->program);
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        char *argument[CONTESTANT_ARGUMENTS] = {NULL};
        for (int i = 0; c->argument[i] != NULL; i++)
            argument[i] = strdup(c->argument[i]);
        execv(c->program, argument);
        _exit(EXIT_FAULT);
    }
    close(ends[1]);
    FILE *from = fdopen(ends[0], "r");
    const status outcome = from != NULL ? read_lap(c, from, seconds, f)
                                        : fault_set(f, STATUS_FAULT,
                                                    "the output of %s cannot be read; close other "
                                                    "programs, and run the command again",
                                                    c->program);
    if (from != NULL)
        fclose(from);
    waitpid(child, &how, 0);
    if (WIFEXITED(how) && WEXITSTATUS(how) == EXIT_AS_EXPECTED)
        return outcome;
    return fault_set(f, STATUS_FAULT,
                     "%s did not complete this run; give the path of a build of beamwork that "
                     "supports this case, formulation and options",
                     c->program);
}

static status lap(void *what, double *seconds, fault *f)
{
    compared_run *c = what;
    return c->program != NULL ? lap_elsewhere(c, seconds, f) : lap_here(c, seconds, f);
}

static status set_repeats(compared_run *a, compared_run *b, fault *f)
{
    double first = 0, second = 0;
    a->repeats = b->repeats = 1;
    for (int i = 0; i < 2; i++) {
        TRY(lap(a, &first, f));
        TRY(lap(b, &second, f));
    }
    const double shorter = first < second ? first : second;
    if (a->program == NULL && shorter < lap_seconds)
        a->repeats = b->repeats =
            lap_seconds / shorter < MOST_REPEATS ? 1 + (int)(lap_seconds / shorter) : MOST_REPEATS;
    return STATUS_OK;
}

defaults compared_run_defaults(bench_options *r, const case_type *type)
{
    return (defaults){.wanted = {.type = type,
                                 .parameter = r->of.parameter,
                                 .select = r->select,
                                 .keep_all = r->solver.keep_all,
                                 .threads = r->solver.threads},
                      .chosen = &r->chosen,
                      .meshes = &r->meshes,
                      .truths = &r->truths};
}

void compared_run_here(compared_run *c, const bench_options *r, const scene *s,
                       const formulation *chosen, int elements)
{
    memset(c, 0, sizeof *c);
    c->request = (cell_request){.scene = s, .elements = elements, .keep_all = r->solver.keep_all};
    cell_formulation(&c->request, chosen);
    snprintf(c->name, sizeof c->name, "%s, n = %d", chosen->key, elements);
}

void compared_run_elsewhere(compared_run *c, const bench_options *r, const char *program)
{
    int n = 0;
    memset(c, 0, sizeof *c);
    snprintf(c->elements, sizeof c->elements, "%d", r->meshes.elements[0]);
    const char *const first[] = {program, "solve",    "--format",
                                 "json",  "-f",       r->chosen.formulation[0].key,
                                 "-n",    c->elements};
    for (size_t i = 0; i < sizeof first / sizeof first[0]; i++)
        c->argument[n++] = first[i];
    if (r->of.scene_path != NULL)
        c->argument[n++] = "--scene";
    c->argument[n++] = r->of.scene_path != NULL ? r->of.scene_path : r->of.name;
    if (r->solver.keep_all)
        c->argument[n++] = "--all-dofs";
    for (int i = 0; i < r->of.set.count; i++) {
        c->argument[n++] = "--set";
        c->argument[n++] = r->of.set.text[i];
    }
    c->argument[n] = NULL;
    c->program = program;
    snprintf(c->name, sizeof c->name, "%.500s, n = %s", program, c->elements);
}

status compared_run_measure(compared_run *a, compared_run *b, against_times *out, fault *f)
{
    set_counted(a);
    set_counted(b);
    rounds_pin();
    TRY(set_repeats(a, b, f));
    return against_run(lap, a, b, budget_seconds, out, f);
}

static void show_one(char letter, const compared_run *c, double seconds)
{
    int at = printf("%c  ", letter);
    if (paragraph_columns(c->name) <= NAME)
        at += printf("%s", c->name);
    else {
        paragraph_write(stdout, at, at, c->name);
        at = 0;
    }
    printf("%*s %10.4g ms\n", NAME + 3 - at, "", 1e3 * seconds / c->repeats);
}

static void show_work(const compared_run *a, const compared_run *b)
{
    int first = 0;
    while (first < a->counts && a->count[first] == b->count[first])
        first++;
    if (first == a->counts) {
        puts("the same work");
        return;
    }
    paragraph words;
    const int at = printf("work differs: ");
    FILE *to = paragraph_begin(&words, stdout);
    for (int i = first; i < a->counts; i++)
        if (a->count[i] != b->count[i])
            fprintf(to, "%s%s %.10g against %.10g", i > first ? ", " : "", a->counted[i]->name,
                    a->count[i], b->count[i]);
    paragraph_end(&words, at, 2);
}

/* Returns the reason why the two cells are not ranked; "": they are ranked. */
static const char *unranked(const compared_run *a, const compared_run *b)
{
    const char *why = reach_unranked(a->request.formulation);
    return why[0] != '\0' ? why : reach_unranked(b->request.formulation);
}

static const char *outcome_of(const compared_run *a, const compared_run *b, const against_times *v)
{
    return unranked(a, b)[0] != '\0' ? "unranked" : against_name(v->outcome);
}

void compared_run_unranked(const compared_run *a, const compared_run *b)
{
    const compared_run *both[] = {a, b};
    for (int i = 0; i < 2; i++) {
        const char *why = reach_unranked(both[i]->request.formulation);
        if (why[0] != '\0')
            printf("%s: %s, so its times are not ranked\n", both[i]->name, why);
    }
}

static void lacking(const compared_run *c, char words[OMIT_WORDS])
{
    words[0] = '\0';
    if (c->program == NULL && c->request.scene != NULL)
        missing_omit_words(missing_omits(c->request.scene, c->request.formulation), words);
}

static void show_lacking(char letter, const compared_run *c)
{
    char words[OMIT_WORDS];
    lacking(c, words);
    if (words[0] != '\0')
        printf("%c: %s not modelled\n", letter, words);
}

void compared_run_show(const compared_run *a, const compared_run *b, const against_times *v)
{
    show_one('A', a, v->a);
    show_one('B', b, v->b);
    const int at = printf("B takes ");
    paragraph_printf(stdout, at, 2,
                     "%.4f times as long as A (%.4f to %.4f with 99.9 %% confidence, %d pairs): %s",
                     v->ratio, v->low, v->high, v->pairs, outcome_of(a, b, v));
    show_lacking('A', a);
    show_lacking('B', b);
    compared_run_unranked(a, b);
    show_work(a, b);
}

json_t *compared_run_json(const compared_run *a, const compared_run *b, const against_times *v)
{
    json_t *counts = json_array();
    for (int i = 0; i < a->counts; i++)
        json_array_append_new(counts, json_pack("{s:s,s:f,s:f}", "name", a->counted[i]->name, "a",
                                                a->count[i], "b", b->count[i]));
    char lacks[2][OMIT_WORDS];
    lacking(a, lacks[0]);
    lacking(b, lacks[1]);
    return json_pack("{s:s,s:s,s:f,s:f,s:f,s:f,s:f,s:i,s:s,s:s,s:s,s:o}", "a", a->name, "b",
                     b->name, "seconds_a", v->a / a->repeats, "seconds_b", v->b / b->repeats,
                     "ratio", v->ratio, "low", v->low, "high", v->high, "pairs", v->pairs,
                     "outcome", outcome_of(a, b, v), "not_modelled_a", lacks[0], "not_modelled_b",
                     lacks[1], "work", counts);
}
