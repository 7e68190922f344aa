#include "harness/study/study_impl.h"

#include <assert.h>
#include <fnmatch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

const char truth_kinds[] =
    "exact|predicted|independent|consensus|agreement|published|reconstructed|experiment|"
    "unrepeatable";

/* Returns 1 if the row also holds for other values of the parameter. */
static int may_differ(const truth *row, const parameter_type *p)
{
    return row->formulation[0] == '\0' && case_is_mass(p);
}

static int same_point(const truth *row, const case_type *type, const double value[])
{
    const double *at = row->parameter;
    int i = 0;
    for (int part = 0; part < PARAMETER_PARTS && type->parameters[part] != NULL; part++)
        for (const parameter_type *p = type->parameters[part]; p->name != NULL; p++, i++)
            if (!row->any[i] && fabs(value[i] - at[i]) > 1e-14 * fabs(at[i]) && !may_differ(row, p))
                return 0;
    return 1;
}

static int is_of_formulation(const char *pattern, const char *key)
{
    char bare[64];
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(key, ":"), key);
    return fnmatch(pattern, key, 0) == 0 || fnmatch(pattern, bare, 0) == 0;
}

int truth_holds(const truth *row, const case_type *type, const double value[])
{
    return row->type == type && same_point(row, type, value);
}

int truth_gates(const truth *row)
{
    return strcmp(row->kind, "agreement") != 0 && strcmp(row->kind, "unrepeatable") != 0;
}

const truth *truth_of(const truths *t, const case_type *type, const double value[],
                      const char *quantity, const char *theory_name)
{
    return truth_of_theory(t, type, value, quantity, theory_name, NULL);
}

const truth *truth_of_theory(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *theory_name, const char *theories)
{
    const truth *best = NULL;
    for (int i = truth_index_first(t, type, quantity); i < t->rows; i = truth_index_next(t, i)) {
        const truth *row = &t->row[i];
        const int fits = row->formulation[0] == '\0' && !row->on_curve &&
                         strcmp(row->model, theory_name) == 0 &&
                         (truth_gates(row) || strcmp(theory_name, "same") != 0);
        const int follows = fits && (theories == NULL || row->theory[0] == '\0' ||
                                     choice_index(theories, row->theory) >= 0);
        if (follows && truth_holds(row, type, value) &&
            (best == NULL ||
             choice_index(truth_kinds, row->kind) < choice_index(truth_kinds, best->kind)))
            best = row;
    }
    return best;
}

const truth *truth_agreed(const truths *t, const case_type *type, const double value[],
                          const char *quantity)
{
    for (int i = truth_index_first(t, type, quantity); i < t->rows; i = truth_index_next(t, i)) {
        const truth *row = &t->row[i];
        if (strcmp(row->kind, "agreement") == 0 && !row->on_curve &&
            strcmp(row->model, "same") == 0 && truth_holds(row, type, value))
            return row;
    }
    return NULL;
}

const truth *truth_predicted(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *key)
{
    for (int i = truth_index_first(t, type, quantity); i < t->rows; i = truth_index_next(t, i)) {
        const truth *row = &t->row[i];
        if (strcmp(row->kind, "predicted") == 0 && !row->on_curve &&
            truth_holds(row, type, value) && is_of_formulation(row->formulation, key))
            return row;
    }
    return NULL;
}

static int is_of(const truth *row, const case_type *type, const char *quantity)
{
    return row->type == type && strcmp(row->quantity, quantity) == 0;
}

static uint64_t hash_of(const case_type *type, const char *quantity)
{
    uint64_t hash = 14695981039346656037ULL ^ (uint64_t)(uintptr_t)type;
    for (const char *c = quantity; *c != '\0'; c++)
        hash = (hash ^ (unsigned char)*c) * 1099511628211ULL;
    return hash;
}

/* Returns the position in the hash table of the first row of the case and quantity, or the free
 * position for such a row. */
static int frame_motion_of(const truths *t, const case_type *type, const char *quantity)
{
    int at = (int)(hash_of(type, quantity) % (uint64_t)t->places);
    while (t->first[at] >= 0 && !is_of(&t->row[t->first[at]], type, quantity))
        at = (at + 1) % t->places;
    return at;
}

static int walk(const truths *t, const case_type *type, const char *quantity, int i)
{
    while (i < t->rows && !is_of(&t->row[i], type, quantity))
        i++;
    return i;
}

int truth_index_first(const truths *t, const case_type *type, const char *quantity)
{
    const int first = t->indexed > 0 ? t->first[frame_motion_of(t, type, quantity)] : -1;
    return first >= 0 ? first : walk(t, type, quantity, t->indexed);
}

int truth_index_next(const truths *t, int i)
{
    const truth *row = &t->row[i];
    if (i < t->indexed && t->next[i] < t->indexed)
        return t->next[i];
    return walk(t, row->type, row->quantity, i < t->indexed ? t->indexed : i + 1);
}

static void chain(truths *t)
{
    for (int k = 0; k < t->places; k++)
        t->first[k] = -1;
    for (int i = t->rows - 1; i >= 0; i--) {
        const int at = frame_motion_of(t, t->row[i].type, t->row[i].quantity);
        t->next[i] = t->first[at] >= 0 ? t->first[at] : t->rows;
        t->first[at] = i;
    }
    t->indexed = t->rows;
}

status truth_index_make(truths *t, fault *f)
{
    const size_t places = 2 * (size_t)t->rows + 1;
    int *first = malloc(places * sizeof *first),
        *next = malloc(((size_t)t->rows + 1) * sizeof *next);
    if (first == NULL || next == NULL) {
        free(first);
        free(next);
        return fault_memory(f, "reference values");
    }
    truth_index_free(t);
    t->first = first;
    t->next = next;
    t->places = (int)places;
    chain(t);
    return STATUS_OK;
}

void truth_index_free(truths *t)
{
    free(t->first);
    free(t->next);
    t->first = t->next = NULL;
    t->indexed = t->places = 0;
}

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
                         "correct reference/defaults.csv and the table of the case",
                         r->path, i + 1, r->name);
    return STATUS_OK;
}

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

/* Returns 1 if the row is a derived limit with a formulation and without a number of elements, or
 * another row with both or neither. */
static int elements_fit(const truth *row)
{
    const int of_formulation = row->formulation[0] != '\0';
    if (strcmp(row->kind, "predicted") == 0)
        return of_formulation && row->elements == 0;
    return row->elements >= 0 && (row->elements > 0) == of_formulation;
}

static const char models[] = "same|other";

const char *truth_words(const char *column)
{
    const struct {
        const char *column, *words;
    } all[] = {{"kind", truth_kinds},
               {"model", models},
               {"theory", SCENE_SHEAR_THEORIES},
               {"convention", conventions}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (strcmp(all[i].column, column) == 0)
            return all[i].words;
    return NULL;
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
    if (!is_known(row->model, models))
        return "model";
    if (!is_known_or_empty(row->theory, SCENE_SHEAR_THEORIES))
        return "theory";
    return is_known_or_empty(row->convention, conventions) ? NULL : "convention";
}

typedef struct loose_columns {
    char **parameters;
    uint64_t *hash;
} loose_columns;

static status read_columns(const table_columns *r, loose_columns *loose, truth *row)
{
    static const columns_field field[] = {{"formulation", COLUMN_TEXT,
                                           offsetof(truth, formulation)},
                                          {"theory", COLUMN_TEXT, offsetof(truth, theory)},
                                          {"quantity", COLUMN_TEXT, offsetof(truth, quantity)},
                                          {"unit", COLUMN_TEXT, offsetof(truth, unit)},
                                          {"kind", COLUMN_TEXT, offsetof(truth, kind)},
                                          {"model", COLUMN_TEXT, offsetof(truth, model)},
                                          {"convention", COLUMN_TEXT, offsetof(truth, convention)},
                                          {"source", COLUMN_TEXT, offsetof(truth, source)},
                                          {"at", COLUMN_REAL, offsetof(truth, at)},
                                          {"value", COLUMN_REAL, offsetof(truth, value)},
                                          {"uncertainty", COLUMN_REAL,
                                           offsetof(truth, uncertainty)},
                                          {"elements", COLUMN_INT, offsetof(truth, elements)}},
                               hash = {"hash", COLUMN_HASH, 0},
                               parameters = {"parameters", COLUMN_TEXT, 0};
    for (size_t k = 0; k < sizeof field / sizeof field[0]; k++)
        TRY(columns_read(r, &field[k], row, sizeof *row));
    TRY(columns_read(r, &hash, loose->hash, sizeof *loose->hash));
    return columns_read(r, &parameters, loose->parameters, sizeof *loose->parameters);
}

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
    if (loose->parameters == NULL || loose->hash == NULL)
        return fault_memory(r->f, "reference values");
    TRY(read_columns(r, loose, row));
    return fill_rows(r, type, loose, row);
}

status truth_rows_read(const table_columns *r, const case_type *type, truth *row)
{
    assert(r->rows >= 0);
    loose_columns loose = {.parameters = calloc((size_t)r->rows + 1, sizeof *loose.parameters),
                           .hash = calloc((size_t)r->rows + 1, sizeof *loose.hash)};
    const status outcome = read_loose(r, type, &loose, row);
    if (loose.parameters != NULL)
        for (int i = 0; i < r->rows; i++)
            free(loose.parameters[i]);
    free(loose.parameters);
    free(loose.hash);
    return outcome;
}
