#include "harness/study/truth_rows.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/study/truth.h"

/* Parameters of a row, and whether they still mean what they meant when the table was packed. */
static status check_row(const table_columns *r, const case_type *type, int i, const char *text,
                        uint64_t hash, parameters_words *before, double value[], int any[])
{
    fault why = {""};
    if (parameters_parse(type, text, value, any, &why) != STATUS_OK)
        return fault_set(r->f, STATUS_FAULT, "%s: row %d of %s: %.200s", r->path, i + 1, r->name,
                         why.text);
    if (parameters_hash_next(type, value, any, before) != hash)
        return fault_set(r->f, STATUS_FAULT,
                         "%s: row %d of %s is stale: the defaults of the case have changed; "
                         "correct reference/defaults.csv and its tables",
                         r->path, i + 1, r->name);
    return STATUS_OK;
}

/* What a moment does while its node turns, and how prescribed rotations combine. */
static const char conventions[] =
    "vector|RyRzRx|spatial|spatial vector|spatial RyRzRx|semitangential|semitangential vector|"
    "semitangential RyRzRx|symmetrised|symmetrised vector|symmetrised RyRzRx";

static int is_known(const char *word, const char *choices)
{
    return choice_index(choices, word) >= 0;
}

static int is_known_or_empty(const char *word, const char *choices)
{
    return word[0] == '\0' || is_known(word, choices);
}

/* Are formulation and elements filled as the kind asks? */
static int elements_fit(const truth *row)
{
    const int of_formulation = row->formulation[0] != '\0';
    if (strcmp(row->kind, "predicted") == 0)
        return of_formulation && row->elements == 0;
    return row->elements >= 0 && (row->elements > 0) == of_formulation;
}

const char *truth_rows_wrong(const truth *row)
{
    if (!isfinite(row->value))
        return "value";
    if (!isfinite(row->uncertainty) || row->uncertainty < 0)
        return "uncertainty";
    if (isinf(row->at))
        return "at";
    if (!is_known(row->kind, truth_kinds))
        return "kind";
    if (!elements_fit(row))
        return "elements";
    if (!is_known(row->model, "same|other"))
        return "model";
    if (!is_known_or_empty(row->theory, SCENE_SHEAR_THEORIES))
        return "theory";
    return is_known_or_empty(row->convention, conventions) ? NULL : "convention";
}

/* Columns of a table that are not members of a row. */
typedef struct loose_columns {
    char **parameters;
    uint64_t *hash;
    int *elements;
} loose_columns;

static status read_columns(const table_columns *r, loose_columns *loose, truth *row)
{
    static const columns_field field[] = {{"formulation", 1, offsetof(truth, formulation)},
                                          {"theory", 1, offsetof(truth, theory)},
                                          {"quantity", 1, offsetof(truth, quantity)},
                                          {"unit", 1, offsetof(truth, unit)},
                                          {"kind", 1, offsetof(truth, kind)},
                                          {"model", 1, offsetof(truth, model)},
                                          {"convention", 1, offsetof(truth, convention)},
                                          {"source", 1, offsetof(truth, source)},
                                          {"at", 0, offsetof(truth, at)},
                                          {"value", 0, offsetof(truth, value)},
                                          {"uncertainty", 0, offsetof(truth, uncertainty)}};
    for (size_t k = 0; k < sizeof field / sizeof field[0]; k++)
        TRY(columns_read(r, &field[k], row, sizeof *row));
    TRY(columns_numbers(r, "elements", H5T_NATIVE_INT, loose->elements));
    TRY(columns_numbers(r, "hash", H5T_NATIVE_UINT64, loose->hash));
    return columns_strings(r, "parameters", loose->parameters);
}

/* Does row i repeat the parameters of the one before? */
static int is_of_same_point(const loose_columns *loose, int i)
{
    return i > 0 && loose->hash[i] == loose->hash[i - 1] &&
           strcmp(loose->parameters[i], loose->parameters[i - 1]) == 0;
}

static status fill_rows(const table_columns *r, const case_type *type, const loose_columns *loose,
                        truth *row)
{
    parameters_words before;
    before.known = 0;
    for (int i = 0; i < r->rows; i++) {
        row[i].type = type;
        row[i].elements = loose->elements[i];
        row[i].on_curve = !isnan(row[i].at);
        if (is_of_same_point(loose, i)) {
            memcpy(row[i].parameter, row[i - 1].parameter, sizeof row[i].parameter);
            memcpy(row[i].any, row[i - 1].any, sizeof row[i].any);
        } else
            TRY(check_row(r, type, i, loose->parameters[i], loose->hash[i], &before,
                          row[i].parameter, row[i].any));
        const char *wrong = truth_rows_wrong(&row[i]);
        if (wrong != NULL)
            return columns_broken(r, wrong);
    }
    return STATUS_OK;
}

static status read_loose(const table_columns *r, const case_type *type, loose_columns *loose,
                         truth *row)
{
    if (loose->parameters == NULL || loose->hash == NULL || loose->elements == NULL)
        return fault_set(r->f, STATUS_FAULT, "out of memory for truths");
    TRY(read_columns(r, loose, row));
    return fill_rows(r, type, loose, row);
}

status truth_rows_read(const table_columns *r, const case_type *type, truth *row)
{
    assert(r->rows >= 0);
    loose_columns loose = {.parameters = calloc((size_t)r->rows + 1, sizeof *loose.parameters),
                           .hash = calloc((size_t)r->rows + 1, sizeof *loose.hash),
                           .elements = calloc((size_t)r->rows + 1, sizeof *loose.elements)};
    const status outcome = read_loose(r, type, &loose, row);
    if (loose.parameters != NULL)
        for (int i = 0; i < r->rows; i++)
            free(loose.parameters[i]);
    free(loose.parameters);
    free(loose.hash);
    free(loose.elements);
    return outcome;
}
