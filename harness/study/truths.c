#include "harness/study/truths.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/accepted.h"
#include "harness/study/columns.h"
#include "harness/study/truth_index.h"
#include "harness/study/truth_rows.h"
#include "harness/study/truths_file.h"

status truths_reserve(truths *t, int more, fault *f)
{
    if (t->rows + more <= t->room)
        return STATUS_OK;
    const size_t room = (size_t)t->rows + (size_t)more;
    truth *row = realloc(t->row, (room + 1) * sizeof *row);
    if (row == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for truths");
    t->row = row;
    t->room = (int)room;
    return STATUS_OK;
}

truth *truths_add(truths *t, fault *f)
{
    if (t->rows >= t->room && truths_reserve(t, t->rows / 4 + 16, f) != STATUS_OK)
        return NULL;
    memset(&t->row[t->rows], 0, sizeof *t->row);
    return &t->row[t->rows++];
}

static status read_table(table_columns *r, const case_type *type, truths *out)
{
    r->rows = r->group >= 0 ? columns_length(r->group, "value") : -1;
    if (r->rows < 0)
        return columns_broken(r, "value");
    TRY(truths_reserve(out, r->rows, r->f));
    for (int i = 0; i < r->rows; i++)
        truths_add(out, r->f);
    return truth_rows_read(r, type, out->row + out->rows - r->rows);
}

static status read_case(const char *path, hid_t all, const case_type *type, truths *out, fault *f)
{
    table_columns r = {.path = path, .f = f};
    snprintf(r.name, sizeof r.name, "%s", type->name);
    if (H5Lexists(all, type->name, H5P_DEFAULT) <= 0)
        return STATUS_OK; /* its verdicts will be "no truth" */
    r.group = H5Gopen2(all, type->name, H5P_DEFAULT);
    const status outcome = read_table(&r, type, out);
    if (r.group >= 0)
        H5Gclose(r.group);
    return outcome;
}

static status read_cases(const char *path, hid_t all, const case_type *only, truths *out, fault *f)
{
    if (only != NULL)
        return read_case(path, all, only, out, f);
    for (int i = 0; registry_cases[i] != NULL; i++)
        TRY(read_case(path, all, registry_cases[i], out, f));
    return STATUS_OK;
}

/* Tables of cases that do not exist would otherwise never be missed. */
static void find_strangers(hid_t all, truths *out)
{
    char name[64];
    for (hsize_t i = 0; H5Lget_name_by_idx(all, ".", H5_INDEX_NAME, H5_ITER_INC, i, name,
                                           sizeof name, H5P_DEFAULT) > 0;
         i++) {
        int known = 0;
        for (int k = 0; registry_cases[k] != NULL; k++)
            known |= strcmp(registry_cases[k]->name, name) == 0;
        if (!known && out->strangers++ == 0)
            snprintf(out->stranger, sizeof out->stranger, "%s", name);
    }
}

/* What is read of a file. */
typedef struct truths_wanted {
    const char *group; /* of tables, one for every case; NULL: none */
    const case_type *only;
    int rules;
} truths_wanted;

static status read_tables(const char *path, hid_t file, const truths_wanted *what, truths *out,
                          fault *f)
{
    const hid_t all = H5Gopen2(file, what->group, H5P_DEFAULT);
    if (all < 0)
        return fault_set(f, STATUS_FAULT, "%s: no %s in it; build it again ('make all')", path,
                         what->group);
    const status outcome = read_cases(path, all, what->only, out, f);
    if (outcome == STATUS_OK)
        find_strangers(all, out);
    H5Gclose(all);
    return outcome;
}

/* With what read_file closes. */
static status read_open(const char *path, const truths_wanted *what, hid_t *file, truths *out,
                        fault *f)
{
    TRY(truths_file_open(path, file, f));
    if (what->group != NULL)
        TRY(read_tables(path, *file, what, out, f));
    if (!what->rules)
        return STATUS_OK;
    TRY(accepted_read(path, *file, f));
    return rules_read(path, *file, &out->rule, &out->rules, f);
}

static status read_file(const char *path, const truths_wanted *what, truths *out, fault *f)
{
    hid_t file;
    const status outcome = read_open(path, what, &file, out, f);
    if (file >= 0)
        H5Fclose(file);
    return outcome;
}

static status read_new(const char *path, const truths_wanted *what, truths *out, fault *f)
{
    memset(out, 0, sizeof *out);
    status outcome = read_file(path, what, out, f);
    if (outcome == STATUS_OK)
        outcome = truth_index_make(out, f);
    if (outcome != STATUS_OK)
        truths_free(out);
    return outcome;
}

status truths_read(const char *path, truths *out, fault *f)
{
    return truths_read_case(path, NULL, out, f);
}

status truths_read_case(const char *path, const case_type *type, truths *out, fault *f)
{
    return read_new(path, &(truths_wanted){.group = "truths", .only = type, .rules = 1}, out, f);
}

status truths_read_rules(const char *path, truths *out, fault *f)
{
    return read_new(path, &(truths_wanted){.rules = 1}, out, f);
}

status truths_read_extremes(const char *path, truths *out, fault *f)
{
    return read_file(path, &(truths_wanted){.group = "extremes"}, out, f);
}

void truths_free(truths *t)
{
    for (int i = 0; i < t->rows; i++) {
        truth *r = &t->row[i];
        char *const all[] = {r->formulation, r->theory, r->quantity,   r->unit,
                             r->kind,        r->model,  r->convention, r->source};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            free(all[k]);
    }
    rules_free(t->rule, t->rules);
    truth_index_free(t);
    free(t->row);
    memset(t, 0, sizeof *t);
}
