#include "harness/study/study_impl.h"

#include <assert.h>
#include <fnmatch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/feature.h"
#include "elements/shared/choice.h"

enum { WORD = RULES_WORD };

/* Copies the next word of a string. Returns the rest of the string; NULL: there is no further
 * word. */
static const char *next_word(const char *text, const char *separators, char word[WORD])
{
    text += strspn(text, separators);
    const size_t length = strcspn(text, separators), kept = length < WORD ? length : WORD - 1;
    memcpy(word, text, kept);
    word[kept] = '\0';
    return length > 0 ? text + length : NULL;
}

static int matches(const char *word, const char *text)
{
    return strpbrk(word, "*?[\\") == NULL ? strcmp(word, text) == 0 : fnmatch(word, text, 0) == 0;
}

static int list_has(const char *list, const char *text)
{
    char word[WORD];
    while ((list = next_word(list, " ", word)) != NULL)
        if (matches(word, text))
            return 1;
    return 0;
}

static int list_has_formulation(const char *list, const char *key)
{
    char bare[WORD];
    const size_t name = strcspn(key, ":");
    if (list_has(list, key))
        return 1;
    snprintf(bare, sizeof bare, "%.*s", (int)name, key);
    return key[name] != '\0' && list_has(list, bare);
}

typedef struct rules_term {
    unsigned feature;
    int negated;
    char parameter[WORD], sign[3], values[WORD];
} rules_term;

static int term_parse(const char *text, rules_term *out)
{
    char copy[WORD];
    memset(out, 0, sizeof *out);
    snprintf(copy, sizeof copy, "%s", text + strspn(text, " "));
    for (size_t n = strlen(copy); n > 0 && copy[n - 1] == ' '; n--)
        copy[n - 1] = '\0';
    out->negated = strncmp(copy, "not ", 4) == 0;
    out->feature = feature_named(copy + (out->negated ? 4 : 0));
    if (out->feature != 0)
        return 1;
    const size_t name = strcspn(copy, "=!<>"), sign = strspn(copy + name, "=!<>");
    snprintf(out->parameter, sizeof out->parameter, "%.*s", (int)name, copy);
    snprintf(out->sign, sizeof out->sign, "%.*s", (int)sign, copy + name);
    snprintf(out->values, sizeof out->values, "%s", copy + name + sign);
    static const char *const signs[] = {"=", "!=", "<", "<=", ">", ">="};
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++)
        if (strcmp(out->sign, signs[i]) == 0 && sign < sizeof out->sign)
            return name > 0 && out->values[0] != '\0';
    return 0;
}

/* Returns a number, or the index of a choice; NAN: the word is neither. */
static double value_of(const parameter_type *p, const char *word)
{
    double value;
    return assignment_value(p, word, &value) ? value : (double)NAN;
}

static int is_one_of(const parameter_type *p, const char *values, double value)
{
    char word[WORD];
    while ((values = next_word(values, "|", word)) != NULL)
        if (fabs(value_of(p, word) - value) <= 1e-14 * fabs(value))
            return 1;
    return 0;
}

static int compares(const rules_term *t, const parameter_type *p, double value)
{
    if (t->sign[0] == '=' || t->sign[0] == '!')
        return is_one_of(p, t->values, value) == (t->sign[0] == '=');
    const double bound = value_of(p, t->values);
    if (t->sign[1] == '=' && value == bound)
        return 1;
    return t->sign[0] == '<' ? value < bound : value > bound;
}

static int term_holds(const rules_term *t, const rule_subject *s)
{
    if (t->feature != 0)
        return ((s->features & t->feature) != 0) != t->negated;
    const int i = parameter_index(s->type->parameters, t->parameter);
    return i >= 0 && compares(t, parameter_at(s->type->parameters, i), s->parameter[i]);
}

static int condition_holds(const char *condition, const rule_subject *s)
{
    char word[WORD];
    rules_term t;
    while ((condition = next_word(condition, ";", word)) != NULL)
        if (!term_parse(word, &t) || !term_holds(&t, s))
            return 0;
    return 1;
}

int rules_hold(const rule *r, const rule_subject *s)
{
    return list_has(r->cases, s->type->name) && list_has(r->quantities, s->quantity) &&
           list_has_formulation(r->formulations, s->formulation) &&
           choice_index(r->verdicts, s->verdict) >= 0 && condition_holds(r->condition, s);
}

int rules_apply_to(const rule *r, const char *formulation_name)
{
    return list_has_formulation(r->formulations, formulation_name);
}

unsigned rules_features(const rule *r)
{
    char word[WORD];
    unsigned out = 0;
    rules_term t;
    for (const char *at = r->condition; (at = next_word(at, ";", word)) != NULL;)
        if (term_parse(word, &t) && !t.negated)
            out |= t.feature;
    return out;
}

void rules_confirm_limit(rule *r, const rule_subject *s)
{
    char word[WORD], here[WORD];
    unsigned bit = 1;
    snprintf(here, sizeof here, "%s/%s", s->type->name, s->quantity);
    for (const char *at = r->predicted; (at = next_word(at, " ", word)) != NULL; bit <<= 1)
        if (strcmp(word, here) == 0)
            r->confirmed |= bit;
}

int rules_is_observed(const rule *r)
{
    char word[WORD];
    unsigned all = 0;
    for (const char *at = r->predicted; (at = next_word(at, " ", word)) != NULL;)
        all = 2 * all + 1;
    return r->observed > 0 && r->confirmed == all;
}

/* Returns 1 if the term is a feature, or if a case of the rule has the parameter of the term and
 * this parameter can have all values in the term. */
static int term_means_something(const rule *r, const rules_term *t, const case_type *const cases[])
{
    int found = t->feature != 0;
    for (int k = 0; cases[k] != NULL && !found; k++) {
        const int i = parameter_index(cases[k]->parameters, t->parameter);
        char word[WORD];
        const char *values = t->values;
        found = i >= 0 && list_has(r->cases, cases[k]->name);
        while (found && (values = next_word(values, "|", word)) != NULL)
            found = isfinite(value_of(parameter_at(cases[k]->parameters, i), word));
    }
    return found;
}

int rules_bad_condition(const rule *r, const case_type *const cases[], char word[RULES_WORD])
{
    rules_term t;
    for (const char *at = r->condition; (at = next_word(at, ";", word)) != NULL;)
        if (!term_parse(word, &t) || !term_means_something(r, &t, cases))
            return 1;
    return 0;
}

const char *rules_next_word(const char *list, char word[RULES_WORD])
{
    return next_word(list, " ", word);
}

static status check_rule(const table_columns *c, const rule *r)
{
    char word[WORD];
    if (!rules_bad_condition(r, registry_cases, word))
        return STATUS_OK;
    return fault_set(
        c->f, STATUS_FAULT,
        "%.200s: known deviation '%.60s': condition '%.60s' is neither a feature nor a comparison "
        "with a parameter of the cases; correct reference/findings.csv and build again",
        c->path, r->name, word);
}

static status read_all(table_columns *c, hid_t file, rule **out)
{
    static const columns_field field[] = {
        {"rule", COLUMN_TEXT, offsetof(rule, name)},
        {"formulations", COLUMN_TEXT, offsetof(rule, formulations)},
        {"cases", COLUMN_TEXT, offsetof(rule, cases)},
        {"condition", COLUMN_TEXT, offsetof(rule, condition)},
        {"quantities", COLUMN_TEXT, offsetof(rule, quantities)},
        {"verdicts", COLUMN_TEXT, offsetof(rule, verdicts)},
        {"predicted", COLUMN_TEXT, offsetof(rule, predicted)},
        {"cause", COLUMN_TEXT, offsetof(rule, cause)},
        {"proof", COLUMN_TEXT, offsetof(rule, proof)},
        {"largest_error", COLUMN_REAL, offsetof(rule, largest_error)},
    };
    TRY(columns_open(c, file));
    rule *all = *out = calloc((size_t)c->rows + 1, sizeof *all);
    if (all == NULL)
        return fault_memory(c->f, "known deviations");
    for (size_t k = 0; k < sizeof field / sizeof field[0]; k++)
        TRY(columns_read(c, &field[k], all, sizeof *all));
    for (int i = 0; i < c->rows; i++)
        TRY(check_rule(c, &all[i]));
    return STATUS_OK;
}

status rules_read(const char *path, hid_t file, rule **out, int *count, fault *f)
{
    table_columns c = {.path = path, .name = "findings", .f = f};
    *out = NULL;
    const status outcome = read_all(&c, file, out);
    columns_close(&c);
    *count = *out != NULL ? c.rows : 0;
    return outcome;
}

void rules_free(rule *r, int count)
{
    for (int i = 0; i < count; i++) {
        char *const all[] = {r[i].name,       r[i].formulations, r[i].cases,     r[i].condition,
                             r[i].quantities, r[i].verdicts,     r[i].predicted, r[i].cause,
                             r[i].proof,      r[i].from};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            free(all[k]);
    }
    free(r);
}

status columns_broken(const table_columns *r, const char *column)
{
    return fault_set(r->f, STATUS_FAULT,
                     "%s: column %s of %s is missing or damaged; build the file again ('make all')",
                     r->path, column, r->name);
}

/* Describes a member of the stored type. Returns 0 if the type of the member is not one of
 * column_kind. */
static int describe_member(hid_t row, unsigned i, columns_member *out)
{
    char *const name = H5Tget_member_name(row, i);
    const hid_t type = H5Tget_member_type(row, i);
    const H5T_class_t class = H5Tget_class(type);
    out->offset = H5Tget_member_offset(row, i);
    out->size = H5Tget_size(type);
    out->kind = class == H5T_STRING  ? COLUMN_TEXT
                : class == H5T_FLOAT ? COLUMN_REAL
                : out->size == 4     ? COLUMN_INT
                                     : COLUMN_HASH;
    const int good = name != NULL && strlen(name) < sizeof out->name &&
                     (class == H5T_STRING  ? H5Tis_variable_str(type) == 0
                      : class == H5T_FLOAT ? H5Tequal(type, H5T_NATIVE_DOUBLE) > 0
                                           : H5Tequal(type, H5T_NATIVE_INT) > 0 ||
                                                 H5Tequal(type, H5T_NATIVE_UINT64) > 0);
    snprintf(out->name, sizeof out->name, "%s", good ? name : "");
    H5free_memory(name);
    handles_close(1, &type);
    return good;
}

static int describe(table_columns *t, hid_t set, hid_t row)
{
    hsize_t size = 0;
    const hid_t space = H5Dget_space(set);
    int good = row >= 0 && H5Tget_class(row) == H5T_COMPOUND && space >= 0 &&
               H5Sget_simple_extent_ndims(space) == 1 &&
               H5Sget_simple_extent_dims(space, &size, NULL) == 1 && size < 10000000;
    handles_close(1, &space);
    t->rows = good ? (int)size : 0;
    t->row_size = good ? H5Tget_size(row) : 0;
    t->members = good ? H5Tget_nmembers(row) : 0;
    good = good && t->members <= COLUMNS_MOST && t->row_size < 1000000;
    for (int i = 0; i < t->members && good; i++)
        good = describe_member(row, (unsigned)i, &t->member[i]);
    return good;
}

/* The stored type is read without conversion, because HDF5 clears a large buffer for each
 * conversion. */
static int read_set(table_columns *t, hid_t set)
{
    const hid_t row = set >= 0 ? H5Dget_type(set) : -1;
    int good = set >= 0 && describe(t, set, row);
    t->data = good ? calloc((size_t)t->rows + 1, t->row_size) : NULL;
    good = t->data != NULL && H5Dread(set, row, H5S_ALL, H5S_ALL, H5P_DEFAULT, t->data) >= 0;
    handles_close(1, &row);
    return good;
}

status columns_open(table_columns *t, hid_t at)
{
    t->data = NULL;
    t->rows = t->members = 0;
    const hid_t set =
        H5Lexists(at, t->name, H5P_DEFAULT) > 0 ? H5Dopen2(at, t->name, H5P_DEFAULT) : -1;
    const int good = read_set(t, set);
    handles_close(1, &set);
    if (good)
        return STATUS_OK;
    return fault_set(t->f, STATUS_FAULT,
                     "%s: the table %s is missing or damaged; build the file again ('make all')",
                     t->path, t->name);
}

void columns_close(table_columns *t)
{
    free(t->data);
    t->data = NULL;
}

static const columns_member *member_of(const table_columns *t, const columns_field *field)
{
    for (int i = 0; i < t->members; i++)
        if (t->member[i].kind == field->kind && strcmp(t->member[i].name, field->column) == 0)
            return &t->member[i];
    return NULL;
}

status columns_read(const table_columns *t, const columns_field *field, void *base, size_t stride)
{
    const columns_member *const m = member_of(t, field);
    if (m == NULL)
        return columns_broken(t, field->column);
    for (int i = 0; i < t->rows; i++) {
        const char *const from = t->data + (size_t)i * t->row_size + m->offset;
        char *const to = (char *)base + (size_t)i * stride + field->offset;
        if (field->kind != COLUMN_TEXT) {
            memcpy(to, from, m->size);
            continue;
        }
        char *const text = strndup(from, m->size);
        if (text == NULL)
            return fault_memory(t->f, "column %s of %s", field->column, t->name);
        memcpy(to, &text, sizeof text);
    }
    return STATUS_OK;
}

static void accept_all(char *const name[], int count, int are_read)
{
    for (int i = 0; i < count; i++) {
        if (are_read)
            formulations_accept(name[i]);
        free(name[i]);
    }
}

static status read_accepted(table_columns *t, hid_t file)
{
    static const columns_field field = {"formulation", COLUMN_TEXT, 0};
    TRY(columns_open(t, file));
    char **name = calloc((size_t)t->rows + 1, sizeof *name);
    if (name == NULL)
        return fault_memory(t->f, "accepted formulations");
    const status outcome = columns_read(t, &field, name, sizeof *name);
    accept_all(name, t->rows, outcome == STATUS_OK);
    free(name);
    return outcome;
}

status accepted_read(const char *path, hid_t file, fault *f)
{
    table_columns t = {.path = path, .name = "accepted", .f = f};
    const status outcome = read_accepted(&t, file);
    columns_close(&t);
    return outcome;
}
