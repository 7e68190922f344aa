#include <stdio.h>
#include <string.h>

#include "harness/cli/cli_impl.h"
#include "harness/experiments/experiments.h"
#include "harness/records/records.h"
#include "harness/terminal/terminal.h"

const char *const results_about[] = {
    "HDF5, followed by a line with the length and the checksum of the file. Attributes of the "
    "root: schema, schema_version, program_version, commit, compiler, flags, libraries, processor, "
    "clock (UTC), threads, unfinished_cells (of an interrupted run). Below /cases/CASE "
    "(attributes: summary, source) there is a table for each kind of record; the attributes of a "
    "table are the units and summaries of its columns, in order.",
    "JSON and CSV use the same names. Fields marked * exist only in JSON and CSV; in HDF5, the "
    "group or an attribute gives them. Missing numbers are NaN (JSON: null). [unit]: see the "
    "column 'unit'.",
    "curve_x, curve_value: points of all curves of a case, one curve after the other.",
    "shapes/POINT (verify --shapes, solve --shapes; attributes formulation, elements): members "
    "(end nodes p and q, section), first_point (index of the first point of each member, then "
    "the number of points), bodies "
    "of the nodes (body or -1, fixed components as bits), released (released components at both "
    "ends of each member, as bits), sections/I and, for tapered members, far_ends/MEMBER (corners "
    "of walls, y and z in m). For each state: kind, acting (load "
    "case or combination), analysis, value and scale; with [states x points]: position, "
    "orientation "
    "(quaternion), force, moment and bimoment; with [states x nodes]: nodes (positions of the "
    "nodes).",
    "The table 'points' also has a column for each parameter of the case. The keys are point, "
    "formulation and elements.",
    "/experiments/NAME contains the results of the verb NAME (option -o of bench, converge, "
    "element-test, motion, stress and sweep), "
    "with the root attributes of the run. A later run of the same experiment replaces its group; "
    "verify replaces everything outside /experiments. bench and converge: declarations and "
    "cases/CASE, as in the root. The tables of the other verbs also have the fields marked * as "
    "columns.",
    NULL};

/* Returns entry *i of a NULL-terminated list. If *i is beyond the end, subtracts the length from it
 * and returns NULL. */
static const record_type *take(const record_type *const *list, int *i)
{
    for (; *list != NULL; list++)
        if ((*i)-- == 0)
            return *list;
    return NULL;
}

/* Returns table *i of the experiments of all verbs. If there is none, subtracts the number of these
 * tables from *i and returns a table with type NULL. */
static results_record of_experiment(const verb *const *verbs, int *i)
{
    results_record r = {"", NULL};
    for (; *verbs != NULL && r.type == NULL; verbs++) {
        const experiment_type *e = (*verbs)->experiment;
        r.type = e != NULL ? take(e->records, i) : NULL;
        snprintf(r.place, sizeof r.place, "/experiments/%s/", e != NULL ? e->name : "");
    }
    return r;
}

results_record results_record_at(const verb *const *verbs, int i)
{
    static const record_type *const first[] = {&record_declaration, NULL}, *const of_solve[] = {
                                                                               &record_truth, NULL};
    const struct {
        const char *place;
        const record_type *const *list;
    } part[] = {{"/", first}, {"/cases/CASE/", record_types}, {"solve --format json, ", of_solve}};
    results_record r = {"", NULL};
    for (int k = 0; k < (int)(sizeof part / sizeof part[0]) && r.type == NULL; k++) {
        r.type = take(part[k].list, &i);
        snprintf(r.place, sizeof r.place, "%s", part[k].place);
    }
    return r.type != NULL ? r : of_experiment(verbs, &i);
}

results_field results_field_of(const schema_field *f)
{
    results_field out = {.kind = f->key == KEY_AROUND ? "text *" : schema_kind_name(f->kind),
                         .unit = strcmp(f->unit, OWN_UNIT) == 0 ? "[unit]" : f->unit};
    int used = snprintf(out.text, sizeof out.text, "%s", f->summary);
    for (int i = 0; i < f->words && used < (int)sizeof out.text; i++)
        used += snprintf(out.text + used, sizeof out.text - (size_t)used, "%s%s",
                         i > 0 ? ", " : " (", f->word(i));
    if (f->words > 0 && used < (int)sizeof out.text)
        snprintf(out.text + used, sizeof out.text - (size_t)used, ")");
    return out;
}

typedef struct schema_request {
    const char *format;
} schema_request;

static void show_field(const schema_field *which)
{
    const results_field f = results_field_of(which);
    printf("  %-20s %-7s %-7s %s\n", which->name, f.kind, f.unit, f.text);
}

static void show(results_record r)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(r.type, KEY_AROUND, list);
    printf("\n%s%s: %s\n", r.place, r.type->table, r.type->summary);
    for (int i = 0; i < count; i++)
        show_field(list[i]);
}

static void add_record(json_t *list, results_record r)
{
    json_t *one = json_record_type(r.type);
    json_object_set_new(one, "place", json_string(r.place));
    json_array_append_new(list, one);
}

static status write_json(const verb *const *verbs, fault *f)
{
    json_t *records = json_array();
    for (int i = 0; results_record_at(verbs, i).type != NULL; i++)
        add_record(records, results_record_at(verbs, i));
    return json_finish(json_pack("{s:s,s:i,s:o}", "schema", SCHEMA_NAME, "schema_version",
                                 SCHEMA_VERSION, "records", records),
                       stdout, f);
}

static int answer(const command_line *l, void *request)
{
    const schema_request *r = request;
    fault f = {""};
    if (l->arguments > 0)
        return message_fail(STATUS_REFUSED,
                            "schema accepts no case as an argument, because it describes the files "
                            "of all cases; remove the argument");
    if (r->format[0] == 'j')
        return message_exit(write_json(l->verbs, &f), &f);
    printf("%s, version %d\n", SCHEMA_NAME, SCHEMA_VERSION);
    for (int i = 0; results_about[i] != NULL; i++)
        paragraph_write(stdout, 0, 0, results_about[i]);
    for (int i = 0; results_record_at(l->verbs, i).type != NULL; i++)
        show(results_record_at(l->verbs, i));
    return EXIT_AS_EXPECTED; /* main flushes the output */
}

#define IN(at) .member = offsetof(schema_request, at)
static const verb_group shared[] = {SHARED(record, format), {NULL, 0}};
const verb verb_schema = {"schema",
                          "",
                          "describes results files: tables, columns, units",
                          "Describes the files of verify, of the experiments and of solve (-o "
                          "FILE), and the records of JSON and CSV.",
                          "beamwork schema --format json",
                          shared,
                          NULL,
                          sizeof(schema_request),
                          .place = VERB_EXCHANGE + 30,
                          .answer = answer};
