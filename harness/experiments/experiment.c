#include "harness/experiments/experiment.h"

#include <string.h>

#include "harness/records/records.h"

static status gathered(const experiment_type *e, const record_type *type, const void *found,
                       subjects *out, fault *f)
{
    *out = (subjects){0};
    e->gather(found, type, out);
    if (!out->bad)
        return STATUS_OK;
    gather_free(out);
    return fault_set(f, STATUS_FAULT, "out of memory for results");
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
    return store_write(path, e->name, c.sweep, c.judged, c.made, f);
}

/* The files first: nobody may read the table. */
static status leave(const experiment_type *e, const experiment_output *to, const void *found,
                    fault *f)
{
    if (to->results != NULL)
        TRY(store_found(e, found, to->results, f));
    if (to->json != NULL)
        TRY(write_file(e, to->json, "json", found, f));
    return write_file(e, to->text, to->format, found, f);
}

static status step(status (*what)(const void *asked, void *found, fault *f), const void *asked,
                   void *found, fault *f)
{
    return what != NULL ? what(asked, found, f) : STATUS_OK;
}

status experiment_plan(const experiment_type *e, const void *asked, void *found, fault *f)
{
    return step(e->plan, asked, found, f);
}

status experiment_run(const experiment_type *e, const void *asked, const experiment_output *to,
                      void *found, fault *f)
{
    TRY(step(e->run, asked, found, f));
    TRY(step(e->judge, asked, found, f));
    return leave(e, to, found, f);
}

status experiment_do(const experiment_type *e, const void *asked, const experiment_output *to,
                     void *found, fault *f)
{
    TRY(experiment_plan(e, asked, found, f));
    return experiment_run(e, asked, to, found, f);
}
