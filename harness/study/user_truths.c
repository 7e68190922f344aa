#include "harness/study/study_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "elements/shared/choice.h"

static const char head[] = "case,parameters,formulation,theory,elements,quantity,at,value,unit,"
                           "uncertainty,kind,model,convention,source";
enum {
    CASE,
    PARAMETERS,
    FORMULATION,
    THEORY,
    ELEMENTS,
    QUANTITY,
    AT,
    VALUE,
    UNIT,
    UNCERTAINTY,
    KIND,
    MODEL,
    CONVENTION,
    SOURCE,
    COLUMNS
};
static const char *const names[COLUMNS] = {
    "case",  "parameters", "formulation", "theory", "elements", "quantity",   "at",
    "value", "unit",       "uncertainty", "kind",   "model",    "convention", "source"};

typedef struct truths_reader {
    const case_type *const *run;
    const case_type *only;
    truths *t;
    mistakes *m;
    const user_table_row *row;
    int good;
} truths_reader;

#define WRONG(r, column, ...)                                                                      \
    ((r)->good = 0, mistakes_add((r)->m, (r)->row->line, (column) + 1, __VA_ARGS__))

static void take_number(truths_reader *r, int column, double *out)
{
    const char *text = r->row->field[column];
    if (!line_number(text, out))
        WRONG(r, column, "%s '%.40s' is not a finite number; give one", names[column], text);
}

static void take_elements(truths_reader *r, int *out)
{
    char *end;
    const char *text = r->row->field[ELEMENTS];
    const long count = strtol(text, &end, 10);
    *out = 0;
    if (text[0] == '\0')
        return;
    if (*end != '\0' || count < 1 || count > INT_MAX)
        WRONG(r, ELEMENTS,
              "elements '%.40s' is not a positive whole number; give one, or leave the field empty "
              "for a value of the continuum",
              text);
    else
        *out = (int)count;
}

static void check_quantity(truths_reader *r, const case_type *type, const double value[])
{
    char near[FAULT_TEXT];
    fault why = {""};
    scene s;
    const char *name = r->row->field[QUANTITY], *unit = r->row->field[UNIT];
    scene_init(&s, type->name);
    const int built = case_build(type, value, &s, &why) == STATUS_OK;
    const scene_quantity *q = user_names_quantity(&s, name);
    if (!built)
        WRONG(r, PARAMETERS, "%s is rejected at this parameter point: %.200s", type->name,
              why.text);
    else if (q == NULL)
        WRONG(r, QUANTITY, "%s has no quantity '%.60s'%s", type->name, name,
              user_names_near_quantity(&s, name, near));
    else if (strcmp(q->unit, unit) != 0)
        WRONG(r, UNIT, "the unit of %s is '%s', not '%.40s'; convert the value", name, q->unit,
              unit);
    scene_free(&s);
}

static void check_formulation(truths_reader *r)
{
    char near[FAULT_TEXT], bare[FORMULATION_KEY];
    const char *key = r->row->field[FORMULATION];
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(key, ":"), key);
    if (key[0] != '\0' && formulation_find(key) == NULL)
        WRONG(r, FORMULATION, "no formulation is called '%.60s'%s", key,
              user_names_near_formulation(bare, near));
}

static int same(const char *a, const char *b)
{
    return strcmp(a, b) == 0;
}

static int same_point(const truth *a, const truth *b)
{
    for (int i = 0; i < CASE_MAX_PARAMETERS; i++)
        if (a->any[i] != b->any[i] || (!a->any[i] && a->parameter[i] != b->parameter[i]))
            return 0;
    return 1;
}

/* Returns an existing reference value for the same quantity; NULL: none. */
static const truth *known(const truths *t, const truth *row)
{
    for (int i = 0; i < t->rows; i++) {
        const truth *k = &t->row[i];
        if (k->type == row->type && k->elements == row->elements && same_point(k, row) &&
            k->on_curve == row->on_curve && (!k->on_curve || k->at == row->at) &&
            same(k->quantity, row->quantity) && same(k->kind, row->kind) &&
            same(k->formulation, row->formulation) && same(k->theory, row->theory) &&
            same(k->model, row->model) && same(k->convention, row->convention))
            return k;
    }
    return NULL;
}

static void take_row(truths_reader *r, const case_type *type, truth *out)
{
    char *const *field = r->row->field;
    fault why = {""};
    *out = (truth){.type = type,
                   .formulation = field[FORMULATION],
                   .theory = field[THEORY],
                   .quantity = field[QUANTITY],
                   .unit = field[UNIT],
                   .kind = field[KIND],
                   .model = field[MODEL],
                   .convention = field[CONVENTION],
                   .source = field[SOURCE],
                   .at = NAN};
    if (parameters_parse(type, field[PARAMETERS], out->parameter, out->any, &why) != STATUS_OK) {
        WRONG(r, PARAMETERS, "%.250s", why.text);
        return;
    }
    take_number(r, VALUE, &out->value);
    take_number(r, UNCERTAINTY, &out->uncertainty);
    take_elements(r, &out->elements);
    out->on_curve = field[AT][0] != '\0';
    if (out->on_curve)
        take_number(r, AT, &out->at);
    if (field[SOURCE][0] == '\0')
        WRONG(r, SOURCE, "the source is empty; name a publication or a program");
    check_formulation(r);
    check_quantity(r, type, out->parameter);
}

static void wrong_word(truths_reader *r, int column)
{
    const char *words = truth_words(names[column]), *given = r->row->field[column];
    if (words != NULL)
        WRONG(r, column, "%s '%.40s' is unknown; give one of %s", names[column], given, words);
    else
        WRONG(r, column, "%s '%.40s' is negative; give zero or a positive number", names[column],
              given);
}

static void check_row(truths_reader *r, const truth *row)
{
    const char *wrong = truth_rows_wrong(row);
    for (int i = 0; i < COLUMNS && wrong != NULL; i++)
        if (same(names[i], wrong) && i == ELEMENTS)
            WRONG(r, i,
                  "a value of one mesh requires a formulation and elements, a predicted limit "
                  "requires a formulation, and any other reference value must have neither; fill "
                  "or empty these columns");
        else if (same(names[i], wrong))
            wrong_word(r, i);
    const truth *other = r->good ? known(r->t, row) : NULL;
    if (other != NULL)
        WRONG(r, QUANTITY,
              "a reference value of this kind already exists: %.10g (%.100s); only one can be "
              "compared, so remove one of them",
              other->value, other->source);
}

static status add(truths_reader *r, const truth *row, fault *f)
{
    truth *to = truths_add(r->t, f);
    if (to == NULL)
        return STATUS_FAULT;
    *to = *row;
    char **const text[] = {&to->formulation, &to->theory, &to->quantity,   &to->unit,
                           &to->kind,        &to->model,  &to->convention, &to->source};
    int good = 1;
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
        good &= (*text[i] = strdup(*text[i])) != NULL;
    return good ? STATUS_OK : fault_memory(f, "reference values");
}

static status add_rows(const user_table *rows, truths_reader *r, fault *f)
{
    for (int i = 0; i < rows->rows; i++) {
        char near[FAULT_TEXT];
        truth one;
        r->row = &rows->row[i];
        r->good = 1;
        const char *name = r->row->field[CASE];
        const case_type *type = user_names_case(r->run, name);
        if (r->only != NULL && (type == NULL || type != r->only))
            continue;
        if (type == NULL) {
            WRONG(r, CASE, "no case is called '%.60s'%s", name,
                  user_names_near_case(r->run, name, near));
            continue;
        }
        take_row(r, type, &one);
        if (r->good)
            check_row(r, &one);
        if (r->good)
            TRY(add(r, &one, f));
    }
    return STATUS_OK;
}

status user_truths_read(const char *path, const case_type *const run[], const case_type *only,
                        truths *t, mistakes *m, fault *f)
{
    user_table rows;
    truths_reader r = {.run = run, .only = only, .t = t, .m = m};
    status outcome = user_table_read(path, head, &rows, m, f);
    if (outcome == STATUS_OK)
        outcome = add_rows(&rows, &r, f);
    if (outcome == STATUS_OK)
        outcome = truth_index_make(t, f);
    user_table_free(&rows);
    return outcome;
}
