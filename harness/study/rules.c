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

static status read_all(table_columns *c, rule **out)
{
    static const columns_field field[] = {
        {"rule", 1, offsetof(rule, name)},
        {"formulations", 1, offsetof(rule, formulations)},
        {"cases", 1, offsetof(rule, cases)},
        {"condition", 1, offsetof(rule, condition)},
        {"quantities", 1, offsetof(rule, quantities)},
        {"verdicts", 1, offsetof(rule, verdicts)},
        {"predicted", 1, offsetof(rule, predicted)},
        {"cause", 1, offsetof(rule, cause)},
        {"proof", 1, offsetof(rule, proof)},
        {"largest_error", 0, offsetof(rule, largest_error)},
    };
    c->rows = c->group >= 0 ? columns_length(c->group, "rule") : -1;
    if (c->rows < 0)
        return columns_broken(c, "rule");
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
    c.group = H5Gopen2(file, "findings", H5P_DEFAULT);
    *out = NULL;
    const status outcome = read_all(&c, out);
    if (c.group >= 0)
        H5Gclose(c.group);
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

/* Returns the number of rows of an open column; -1: the column is not one-dimensional. */
static int length_of(hid_t set)
{
    hsize_t size = 0;
    const hid_t space = set >= 0 ? H5Dget_space(set) : -1;
    const int good = space >= 0 && H5Sget_simple_extent_ndims(space) == 1 &&
                     H5Sget_simple_extent_dims(space, &size, NULL) == 1 && size < 10000000;
    handles_close(1, &space);
    return good ? (int)size : -1;
}

int columns_length(hid_t group, const char *column)
{
    const hid_t set = H5Dopen2(group, column, H5P_DEFAULT);
    const int length = length_of(set);
    handles_close(1, &set);
    return length;
}

status columns_numbers(const table_columns *r, const char *column, hid_t type, void *out)
{
    const hid_t set = H5Dopen2(r->group, column, H5P_DEFAULT);
    const int good =
        length_of(set) == r->rows && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) >= 0;
    handles_close(1, &set);
    return good ? STATUS_OK : columns_broken(r, column);
}

status columns_strings(const table_columns *r, const char *column, char **out)
{
    const hid_t set = H5Dopen2(r->group, column, H5P_DEFAULT);
    const hid_t stored = length_of(set) == r->rows ? H5Dget_type(set) : -1;
    int good = stored >= 0 && H5Tget_class(stored) == H5T_STRING && !H5Tis_variable_str(stored);
    const size_t size = good ? H5Tget_size(stored) : 1;
    char *all = good && size < 100000 ? calloc((size_t)r->rows + 1, size) : NULL;
    /* The stored type is read without conversion, because HDF5 clears a large buffer for each
     * conversion. */
    good = good && all != NULL && H5Dread(set, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, all) >= 0;
    for (int i = 0; i < r->rows && good; i++)
        good = (out[i] = strndup(all + (size_t)i * size, size)) != NULL;
    free(all);
    handles_close(2, (const hid_t[]){stored, set});
    return good ? STATUS_OK : columns_broken(r, column);
}

status columns_read(const table_columns *r, const columns_field *field, void *base, size_t stride)
{
    assert(r->rows >= 0);
    const size_t size = field->is_text ? sizeof(char *) : sizeof(double);
    char *all = calloc((size_t)r->rows + 1, size);
    if (all == NULL)
        return fault_memory(r->f, "column %s of %s", field->column, r->name);
    const status outcome = field->is_text
                               ? columns_strings(r, field->column, (char **)(void *)all)
                               : columns_numbers(r, field->column, H5T_NATIVE_DOUBLE, all);
    for (int i = 0; i < r->rows; i++)
        memcpy((char *)base + (size_t)i * stride + field->offset, all + (size_t)i * size, size);
    free(all);
    return outcome;
}

static status accept_all(table_columns *c)
{
    c->rows = c->group >= 0 ? columns_length(c->group, "formulation") : -1;
    if (c->rows < 0)
        return columns_broken(c, "formulation");
    char **name = calloc((size_t)c->rows + 1, sizeof *name);
    if (name == NULL)
        return fault_memory(c->f, "accepted formulations");
    const status outcome = columns_strings(c, "formulation", name);
    for (int i = 0; i < c->rows; i++) {
        if (outcome == STATUS_OK)
            formulations_accept(name[i]);
        free(name[i]);
    }
    free(name);
    return outcome;
}

status accepted_read(const char *path, hid_t file, fault *f)
{
    table_columns c = {.path = path, .name = "accepted", .f = f};
    c.group = H5Lexists(file, c.name, H5P_DEFAULT) > 0 ? H5Gopen2(file, c.name, H5P_DEFAULT) : -1;
    const status outcome = accept_all(&c);
    if (c.group >= 0)
        H5Gclose(c.group);
    return outcome;
}
