/* bench --against: one cell in alternation with the same cell of another formulation (in this
 * process) or of another program (both are started anew for every lap and say their own time and
 * work as JSON). */
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/algebra/clock.h"
#include "harness/cli/cli.h"
#include "harness/schema/schema.h"
#include "harness/study/cell.h"
#include "harness/timing/against.h"
#include "harness/timing/rounds.h"

enum { MOST_REPEATS = 10000 };
static const double budget_seconds = 3, lap_seconds = 0.002;

typedef struct contestant {
    char name[FORMULATION_KEY + 512];
    cell_request request;
    const char *program;    /* NULL: in this process */
    const char **arguments; /* of the program, NULL-terminated */
    int repeats;            /* in one lap */
    double plant;           /* share of its time added to every lap */
    int counts;
    const schema_field *counted[SCHEMA_MOST_FIELDS]; /* size and work: what a cell counts */
    double count[SCHEMA_MOST_FIELDS];
} contestant;

/* The pure numbers of a cell's record. */
static void set_counted(contestant *c)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int fields = schema_fields(&record_cell, 0, list);
    for (int i = 0; i < fields; i++)
        if (strcmp(list[i]->unit, "1") == 0)
            c->counted[c->counts++] = list[i];
}

static void count_cell(contestant *c, cell_result *cell)
{
    const series one = {.meshes = 1, .mesh = {c->request.elements}, .cell = cell};
    const subject s = {.series = &one, .record = cell};
    for (int i = 0; i < c->counts; i++) {
        field_value v;
        schema_read(&s, c->counted[i], &v);
        c->count[i] = c->counted[i]->kind == FIELD_DOUBLE ? *v.numbers : (double)v.whole;
    }
}

static status lap_here(contestant *c, double *seconds, fault *f)
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
    const double end = start + (1 + c->plant) * (clock_processor_seconds() - start);
    do /* planted work */
        *seconds = clock_processor_seconds() - start;
    while (start + *seconds < end);
    return STATUS_OK;
}

/* What the program wrote: its seconds and its work. */
static status read_lap(contestant *c, FILE *from, double *seconds, fault *f)
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
                                    "%s: its 'solve --format json' tells no seconds", c->program);
}

static status lap_elsewhere(contestant *c, double *seconds, fault *f)
{
    int ends[2], how = 0;
    const pid_t child = pipe(ends) == 0 ? fork() : -1;
    if (child < 0)
        return fault_set(f, STATUS_FAULT, "cannot start %s", c->program);
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        execv(c->program, (char **)c->arguments);
        _exit(EXIT_FAULT);
    }
    close(ends[1]);
    FILE *from = fdopen(ends[0], "r");
    const status outcome = from != NULL
                               ? read_lap(c, from, seconds, f)
                               : fault_set(f, STATUS_FAULT, "cannot read from %s", c->program);
    if (from != NULL)
        fclose(from);
    waitpid(child, &how, 0);
    if (WIFEXITED(how) && WEXITSTATUS(how) == EXIT_AS_EXPECTED)
        return outcome;
    return fault_set(f, STATUS_FAULT, "%s does not solve that cell", c->program);
}

static status lap(void *what, double *seconds, fault *f)
{
    contestant *c = what;
    return c->program != NULL ? lap_elsewhere(c, seconds, f) : lap_here(c, seconds, f);
}

/* Enough repeats for a lap that the clock can tell. */
static status set_repeats(contestant *a, contestant *b, fault *f)
{
    double first = 0, second = 0;
    a->repeats = b->repeats = 1;
    for (int i = 0; i < 2; i++) { /* the first one warms up */
        TRY(lap(a, &first, f));
        TRY(lap(b, &second, f));
    }
    const double shorter = first < second ? first : second;
    if (a->program == NULL && shorter < lap_seconds)
        a->repeats = b->repeats =
            lap_seconds / shorter < MOST_REPEATS ? 1 + (int)(lap_seconds / shorter) : MOST_REPEATS;
    return STATUS_OK;
}

static void set_request(contestant *c, const command_request *r, const scene *s,
                        const formulation *chosen, int elements)
{
    c->request = (cell_request){.scene = s, .elements = elements, .keep_all = r->keep_all};
    cell_formulation(&c->request, chosen);
    snprintf(c->name, sizeof c->name, "%s, n = %d", chosen->key, elements);
}

enum { MOST_ARGUMENTS = 10 + 2 * CASE_MAX_PARAMETERS };

static void set_program(contestant *c, const command_request *r, const char *program,
                        char elements[16], const char *arguments[MOST_ARGUMENTS])
{
    int n = 0;
    snprintf(elements, 16, "%d", r->mesh[0]);
    const char *const first[] = {program, "solve", r->case_name,          "--format",
                                 "json",  "-f",    r->formulation[0].key, "-n",
                                 elements};
    for (size_t i = 0; i < sizeof first / sizeof first[0]; i++)
        arguments[n++] = first[i];
    for (int i = 0; i < r->assignments; i++) {
        arguments[n++] = "--set";
        arguments[n++] = r->assignment[i];
    }
    arguments[n] = NULL;
    c->program = program;
    c->arguments = arguments;
    snprintf(c->name, sizeof c->name, "%.500s", program);
}

static void show(const contestant *a, const contestant *b, const against *v)
{
    int same = 1;
    printf("A  %-40s %10.4g ms\nB  %-40s %10.4g ms\n", a->name, 1e3 * v->a / a->repeats, b->name,
           1e3 * v->b / b->repeats);
    printf("B takes %.4f times as long as A (%.4f to %.4f with 99.9 %% confidence, %d pairs): %s\n",
           v->ratio, v->low, v->high, v->pairs, against_name(v->outcome));
    for (int i = 0; i < a->counts; i++)
        if (a->count[i] != b->count[i]) {
            printf("%s %s %.10g against %.10g", same ? "work differs:" : ",", a->counted[i]->name,
                   a->count[i], b->count[i]);
            same = 0;
        }
    printf(same ? "the same work\n" : "\n");
}

static void show_json(const contestant *a, const contestant *b, const against *v)
{
    json_t *work = json_array();
    for (int i = 0; i < a->counts; i++)
        json_array_append_new(work, json_pack("{s:s,s:f,s:f}", "name", a->counted[i]->name, "a",
                                              a->count[i], "b", b->count[i]));
    json_t *root = json_pack("{s:s,s:s,s:f,s:f,s:f,s:f,s:f,s:i,s:s,s:o}", "a", a->name, "b",
                             b->name, "seconds_a", v->a / a->repeats, "seconds_b",
                             v->b / b->repeats, "ratio", v->ratio, "low", v->low, "high", v->high,
                             "pairs", v->pairs, "outcome", against_name(v->outcome), "work", work);
    json_dumpf(root, stdout, JSON_INDENT(1));
    putchar('\n');
    json_decref(root);
}

/* Another formulation in this process; both share the scene. */
static status set_formulations(const command_request *r, const case_type *type, scene *s,
                               contestant *a, contestant *b, fault *f)
{
    formulation other;
    TRY(formulation_parse(r->against, &other, f));
    TRY(cell_scene(type, r->parameter, NULL, s, f));
    set_request(a, r, s, &r->formulation[0], r->mesh[0]);
    set_request(b, r, s, &other, r->mesh[r->meshes - 1]);
    return STATUS_OK;
}

/* With a scene that cli_against frees. */
static status compete(const command_request *r, const case_type *type, scene *s, contestant *a,
                      contestant *b, against *answer, fault *f)
{
    if (a->program == NULL)
        TRY(set_formulations(r, type, s, a, b, f));
    set_counted(a);
    set_counted(b);
    rounds_pin();
    TRY(set_repeats(a, b, f));
    return against_run(lap, a, b, budget_seconds, answer, f);
}

int cli_against(command_request *r)
{
    contestant a = {.plant = 0}, b = {.plant = r->plant};
    const char *arguments[2][MOST_ARGUMENTS];
    char elements[2][16];
    scene s = {0};
    against answer;
    fault f = {""};
    if (r->case_count != 1 || r->formulations != 1 || r->meshes < 1 || r->meshes > 2)
        return message_fail(
            STATUS_REFUSED,
            "--against compares one cell: give one CASE, one -f and one -n (or two: A's and B's)");
    if (r->output != NULL)
        return message_fail(STATUS_REFUSED,
                            "--against writes no file; leave -o away, or give --format json");
    const case_type *type = case_input_find(r);
    if (type == NULL)
        return EXIT_REFUSED;
    if (strchr(r->against, '/') != NULL) {
        if (r->plant > 0 || r->meshes != 1)
            return message_fail(
                STATUS_REFUSED,
                "--plant and a second mesh are for another formulation in the same program");
        set_program(&a, r, "/proc/self/exe", elements[0], arguments[0]);
        set_program(&b, r, r->against, elements[1], arguments[1]);
    }
    const status outcome = compete(r, type, &s, &a, &b, &answer, &f);
    scene_free(&s);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    (r->format[0] == 'j' ? show_json : show)(&a, &b, &answer);
    return EXIT_AS_EXPECTED;
}
