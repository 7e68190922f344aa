#include "harness/experiments/experiments_impl.h"

#include <string.h>

static status gathered(const experiment_type *e, const record_type *type, const void *found,
                       subjects *out, fault *f)
{
    *out = (subjects){0};
    e->gather(found, type, out);
    if (!out->bad)
        return STATUS_OK;
    gather_free(out);
    return fault_memory(f, "results");
}

static status put_about(const experiment_type *e, const void *found, record_file *r, hid_t at,
                        fault *f)
{
    subjects list;
    const environment now = environment_now(1);
    store_environment(r, at, &now);
    if (e->about == NULL)
        return STATUS_OK;
    TRY(gathered(e, e->about, found, &list, f));
    record_fields(r, at, e->about, &list.row[0]);
    gather_free(&list);
    return STATUS_OK;
}

static status put_tables(const experiment_type *e, const void *found, record_file *r, hid_t at,
                         fault *f)
{
    for (int i = 0; e->records[i] != NULL; i++) {
        subjects list;
        TRY(gathered(e, e->records[i], found, &list, f));
        record_rows_alone(r, at, e->records[i], list.count, list.row);
        gather_free(&list);
    }
    return STATUS_OK;
}

static status write_group(const experiment_type *e, const void *found, const char *path, fault *f)
{
    record_file r;
    TRY(record_open(&r, f));
    const hid_t at = kept_group(&r, e->name);
    status outcome = put_about(e, found, &r, at, f);
    if (outcome == STATUS_OK)
        outcome = put_tables(e, found, &r, at, f);
    H5Gclose(at);
    return outcome == STATUS_OK ? kept_close(&r, e->name, path, f) : record_drop(&r, outcome);
}

static status add_about(const experiment_type *e, const void *found, json_t *root, fault *f)
{
    subjects list;
    if (e->about == NULL)
        return STATUS_OK;
    TRY(gathered(e, e->about, found, &list, f));
    json_object_update_new(root, json_record(e->about, &list.row[0], KEY_AROUND));
    gather_free(&list);
    return STATUS_OK;
}

static status add_tables(const experiment_type *e, const void *found, json_t *root, fault *f)
{
    for (int i = 0; e->records[i] != NULL; i++) {
        subjects list;
        TRY(gathered(e, e->records[i], found, &list, f));
        json_t *all = json_array();
        for (int k = 0; k < list.count; k++)
            json_record_add(all, e->records[i], &list.row[k], KEY_AROUND);
        json_object_set_new(root, e->records[i]->table, all);
        gather_free(&list);
    }
    return STATUS_OK;
}

static status write_json(const experiment_type *e, const void *found, FILE *to, fault *f)
{
    const environment now = environment_now(1);
    json_t *root =
        json_pack("{s:i,s:s,s:s,s:s}", "schema_version", SCHEMA_VERSION, "program_version",
                  now.version, "commit", now.commit, "clock", now.clock);
    status outcome = add_about(e, found, root, f);
    if (outcome == STATUS_OK)
        outcome = add_tables(e, found, root, f);
    if (outcome == STATUS_OK)
        return json_finish(root, to, f);
    json_decref(root);
    return outcome;
}

static status write_csv(const experiment_type *e, const void *found, FILE *to, fault *f)
{
    subjects list;
    csv_part row = {.type = e->rows};
    TRY(gathered(e, e->rows, found, &list, f));
    csv_record_head(to, 1, &row);
    for (int i = 0; i < list.count; i++) {
        row.s = list.row[i];
        csv_record_line(to, 1, &row);
    }
    gather_free(&list);
    return STATUS_OK;
}

static status write_form(const experiment_type *e, const char *format, const void *found, FILE *to,
                         fault *f)
{
    if (e->write != NULL)
        return e->write(to, format, found, f);
    if (strcmp(format, "json") == 0)
        return write_json(e, found, to, f);
    if (strcmp(format, "csv") == 0)
        return write_csv(e, found, to, f);
    e->print(to, found);
    return STATUS_OK;
}

static status write_file(const experiment_type *e, const char *path, const char *format,
                         const void *found, fault *f)
{
    output file;
    TRY(output_open(path, &file, f));
    return output_finish(&file, write_form(e, format, found, file.stream, f), f);
}

experiment_output experiment_output_of(const char *path, const char *format, const char *json)
{
    const int stored = path != NULL && output_is_hdf5(path);
    return (experiment_output){stored ? path : NULL, stored ? NULL : path, format, json};
}

static status store_found(const experiment_type *e, const void *found, const char *path, fault *f)
{
    if (e->cells == NULL)
        return write_group(e, found, path, f);
    const experiment_cells c = e->cells(found);
    return store_write(path, e->name, c.sweep, c.evaluated, c.made, f);
}

static status leave(const experiment_type *e, const experiment_output *to, const void *found,
                    fault *f)
{
    if (to->results != NULL)
        TRY(store_found(e, found, to->results, f));
    if (to->json != NULL)
        TRY(write_file(e, to->json, "json", found, f));
    return write_file(e, to->text, to->format, found, f);
}

static status step(status (*what)(const void *requested, void *found, fault *f),
                   const void *requested, void *found, fault *f)
{
    return what != NULL ? what(requested, found, f) : STATUS_OK;
}

status experiment_plan(const experiment_type *e, const void *requested, void *found, fault *f)
{
    return step(e->plan, requested, found, f);
}

status experiment_run(const experiment_type *e, const void *requested, const experiment_output *to,
                      void *found, fault *f)
{
    TRY(step(e->run, requested, found, f));
    TRY(step(e->evaluate, requested, found, f));
    return leave(e, to, found, f);
}

status experiment_do(const experiment_type *e, const void *requested, const experiment_output *to,
                     void *found, fault *f)
{
    TRY(experiment_plan(e, requested, found, f));
    return experiment_run(e, requested, to, found, f);
}

/* Returns the certificate of the record. The index of the subject is the index of the part. */
static const certificate *certificate_of(const subject *s)
{
    return s->owner;
}

static void get_formulation(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_of(s)->chosen.key);
}

static void get_family(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_part_name(s->index));
}

static void get_what(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_part_words(s->index));
}

static void get_summary(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_of(s)->chosen.type->summary);
}

static void get_source(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_of(s)->chosen.type->source);
}

static void get_leaves(const subject *s, field_value *out)
{
    schema_set_text(out, adapters_words(certificate_of(s)->chosen.type));
}

static void get_hash(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_of(s)->hash);
}

static void get_kept(const subject *s, field_value *out)
{
    out->whole = certificate_holds(certificate_of(s));
}

static void get_compared(const subject *s, field_value *out)
{
    out->whole = certificate_compared(certificate_of(s));
}

static const schema_field key_of_formulation[] = {
    {"formulation", "", FIELD_TEXT,
     "name of the formulation, with options that differ from their defaults",
     .get = get_formulation, .key = KEY},
    {0}};
static const schema_field key_of_family[] = {
    {"family", "", FIELD_TEXT, "group of checks or measurements", .get = get_family, .key = KEY},
    {0}};
static const schema_field fields_of_certificate[] = {
    {"summary", "", FIELD_TEXT, "summary of the formulation", .get = get_summary},
    {"source", "", FIELD_TEXT, "source of the formulation", .get = get_source},
    {"leaves", "", FIELD_TEXT, "functions provided by adapters", .get = get_leaves},
    {"hash", "", FIELD_TEXT,
     "SHA-256 of the shared object, of the files that the command names, or of the program",
     .get = get_hash},
    {"kept", "", FIELD_FLAG, "true if no requirement is violated", .get = get_kept},
    {"compared", "1", FIELD_INT, "number of compared values, plus yes/no checks",
     .get = get_compared},
    {0}};
static const record_type record_certificate = {
    "certificate",
    "formulations",
    "checks of a formulation against the interface requirements",
    {key_of_formulation, fields_of_certificate}};

static const schema_field fields_of_part[] = {
    {"what", "", FIELD_TEXT, "summary of the requirements", .get = get_what}, {0}};
static const record_type record_part = {
    "part", "parts", "a group of checks or measurements", {key_of_family, fields_of_part}};

static const char *word_of_check(int outcome)
{
    static const char *const word[CHECK_OUTCOMES] = {"holds", "broken", "not claimed"};
    return word[outcome];
}

static const schema_field fields_of_check[] = {
    {"claim", "", FIELD_TEXT, "name of the requirement", AT(check_result, name), .key = KEY},
    {"outcome", "", FIELD_ENUM, "outcome of the check", AT(check_result, outcome),
     .word = word_of_check, .words = CHECK_OUTCOMES},
    {"compared", "1", FIELD_INT, "number of compared numbers, or of yes/no checks",
     AT(check_result, compared)},
    {"worst", "1", FIELD_DOUBLE, "largest deviation; infinite if a yes/no check failed",
     AT(check_result, worst)},
    {"allowed", "1", FIELD_DOUBLE, "allowed deviation", AT(check_result, allowed)},
    {"sentence", "", FIELD_TEXT, "description of the worst violation", AT(check_result, sentence)},
    {0}};
static const record_type record_check = {
    "claim",
    "claims",
    "an interface requirement, and the deviation of a formulation from it",
    {key_of_formulation, key_of_family, fields_of_check}};

static const schema_field key_of_measure[] = {
    {"name", "", FIELD_TEXT, "name of the measurement", AT(element_measure, name), .key = KEY},
    {0}};
static const schema_field fields_of_measure[] = {
    {"order", "1", FIELD_DOUBLE, "order of the errors", AT(element_measure, order)},
    {"least", "1", FIELD_INT, "lowest order declared by the formulation; 0: no order is required",
     AT(element_measure, least)},
    {"highest", "1", FIELD_INT, "highest order declared by the formulation",
     AT(element_measure, highest)},
    {"locks", "", FIELD_FLAG, "true if the errors increase as the structure becomes thinner",
     AT(element_measure, locks)},
    {"wrong_limit", "", FIELD_FLAG,
     "true if the error of a linear state is above 1e-6 with four elements, and more than half "
     "of that with one element",
     AT(element_measure, wrong_limit)},
    {"words", "", FIELD_TEXT, "reason for a missing value, or description of the value",
     AT(element_measure, words)},
    {0}};
static const record_type record_measure = {
    "measure",
    "measured",
    "errors over meshes, thicknesses or turns",
    {key_of_formulation, key_of_family, key_of_measure, fields_of_measure}};

/* Returns the abscissa of a point of a measurement. The group of the subject is the index of the
 * point. */
static void get_at(const subject *s, field_value *out)
{
    out->numbers = &((const element_measure *)s->record)->at[s->group];
}

static void get_error(const subject *s, field_value *out)
{
    out->numbers = &((const element_measure *)s->record)->error[s->group];
}

static const schema_field fields_of_point[] = {
    {"at", "1", FIELD_DOUBLE, "number of elements, thickness over length, or number of turns",
     .get = get_at},
    {"error", "1", FIELD_DOUBLE, "error relative to the exact value", .get = get_error},
    {0}};
static const record_type record_measured_point = {
    "measured_point",
    "measured_points",
    "an error of a measured value",
    {key_of_formulation, key_of_family, key_of_measure, fields_of_point}};

static void gather_points(const element_measure *m, subject one, subjects *out)
{
    one.record = m;
    for (one.group = 0; one.group < m->points; one.group++)
        gather_add(out, &one);
}

static void gather_part(const certificate_part *part, const record_type *type, subject one,
                        subjects *out)
{
    for (int i = 0; type == &record_check && i < part->check_results.count; i++) {
        one.record = &part->check_results.check_result[i];
        gather_add(out, &one);
    }
    for (int i = 0; type == &record_measure && i < part->measures.count; i++) {
        one.record = &part->measures.measure[i];
        gather_add(out, &one);
    }
    for (int i = 0; type == &record_measured_point && i < part->measures.count; i++)
        gather_points(&part->measures.measure[i], one, out);
}

static void gather_element_test(const void *found, const record_type *type, subjects *out)
{
    const certificates *c = found;
    for (int k = 0; type == &record_part && k < CERTIFICATE_PARTS; k++)
        gather_add(out, &(subject){.index = k});
    for (int i = 0; i < c->count; i++) {
        const subject one = {.owner = &c->all[i]};
        if (type == &record_certificate)
            gather_add(out, &one);
        for (int k = 0; k < CERTIFICATE_PARTS; k++)
            gather_part(&c->all[i].part[k], type, (subject){.owner = one.owner, .index = k}, out);
    }
}

static const record_type *const records_of_element_test[] = {
    &record_certificate, &record_part,           &record_check,
    &record_measure,     &record_measured_point, NULL};
static void print_element_test(FILE *to, const void *found)
{
    const certificates *c = found;
    certificate_text(to, screen_of(to), c->all, c->count, c->verbose, c->quiet);
}

static status write_element_test(FILE *to, const char *format, const void *found, fault *f)
{
    const certificates *c = found;
    if (strcmp(format, "json") == 0)
        return write_json(&experiment_element_test, found, to, f);
    if (strcmp(format, "csv") == 0)
        certificate_csv(to, c->all, c->count);
    else if (strcmp(format, "text") != 0)
        certificate_paper(to, strcmp(format, "latex") == 0, c->all, c->count);
    else
        print_element_test(to, found);
    return STATUS_OK;
}

static status run(const void *requested, void *found, fault *f)
{
    const certificate_request *r = requested;
    certificates *c = found;
    c->count = r->count;
    return certificate_find(r, &c->all, f);
}

const experiment_type experiment_element_test = {.name = "element-test",
                                                 .run = run,
                                                 .records = records_of_element_test,
                                                 .gather = gather_element_test,
                                                 .print = print_element_test,
                                                 .write = write_element_test};
