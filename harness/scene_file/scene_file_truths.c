/* Truths of a scene file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/language/expression.h"
#include "harness/scene_file/build.h"
#include "harness/scene_file/builder.h"
#include "harness/scene_file/keys.h"
#include "harness/scene_file/scene_file_impl.h"

/* A truth at a point, before its texts are copied. */
typedef struct file_truth {
    int holds; /* 1: at this point */
    double value, uncertainty, at;
    const char *quantity, *unit, *kind, *formulation, *theory, *model, *convention, *source;
} file_truth;

static const scene_quantity *quantity_of(const scene *s, const char *name)
{
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, name) == 0)
            return &s->quantity[i];
    return NULL;
}

/* One parameter that a truth names: its index and value there; -1 after a mistake. */
static int named_value(const scene_file *file, const fields *f, const document_node *those, int i,
                       double *value)
{
    const int index = parameter_index(file->type.parameters, those->key[i]->text);
    mistakes *m = f->b->mistakes;
    if (index < 0) {
        document_mistake(m, those->key[i], 0, "the scene has no parameter '%.40s'",
                         those->key[i]->text);
        return -1;
    }
    const parameter_type *p = &file->parameter[index];
    if (p->choices != NULL)
        *value = fields_word_of(f, those->item[i], p->name, p->choices, 0);
    else if (expression_number(those->item[i], NULL, m, value) &&
             !(*value >= p->min && *value <= p->max))
        document_mistake(m, those->item[i], 0, "%s = %g is outside its range %g .. %g", p->name,
                         *value, p->min, p->max);
    return index;
}

/* Moves `point` to the values that the truth names; 1: it was there already. */
static int visit_point(const scene_file *file, const fields *f, double point[])
{
    const document_node *those = document_find(f->map, "parameters");
    int same = 1;
    if (those != NULL)
        for (int i = 0; i < those->count; i++) {
            double value = 0;
            const int index = named_value(file, f, those, i, &value);
            same &= index >= 0 && point[index] == value;
            if (index >= 0)
                point[index] = value;
        }
    return same;
}

static file_truth read_one(const scene_file *file, const fields *f, const scene *s,
                           const double value[])
{
    static const char kinds[] =
        "exact|predicted|independent|agreement|consensus|published|reconstructed|experiment";
    double point[CASE_MAX_PARAMETERS];
    mistakes *m = f->b->mistakes;
    memcpy(point, value, sizeof point);
    file_truth t = {.holds = visit_point(file, f, point),
                    .value = fields_number(f, "value", 0),
                    .uncertainty = fields_number(f, "uncertainty", 0),
                    .at = fields_number(f, "at", NAN),
                    .quantity = fields_text(f, "quantity", ""),
                    .kind = fields_text(f, "kind", ""),
                    .formulation = fields_text(f, "formulation", ""),
                    .theory = fields_text(f, "theory", ""),
                    .model = fields_have(f, "model") ? "other" : "same",
                    .convention = fields_text(f, "convention", ""),
                    .source = fields_text(f, "source", "")};
    fields_word(f, "kind", kinds, 0);
    fields_word(f, "theory", TRUTH_THEORIES, 0);
    fields_word(f, "model", "plate|solid", 0);
    if (!(t.uncertainty >= 0))
        document_mistake(m, document_find(f->map, "uncertainty"), 0,
                         "an uncertainty of %g; give none, or one above zero", t.uncertainty);
    if ((strcmp(t.kind, "predicted") == 0) != (t.formulation[0] != '\0'))
        document_mistake(m, f->place, 0,
                         "a truth of kind predicted is of a formulation, and no other is");
    const scene_quantity *q = quantity_of(s, t.quantity);
    if (q == NULL)
        fields_entry(f, "quantity", LIST_QUANTITIES);
    else
        t.unit = q->unit;
    return t;
}

/* What is needed to read truths of a point. */
typedef struct truth_reader {
    builder b;
    unrolled *list;
    int count;
} truth_reader;

static truth_reader open_truths(const scene_file *file, const double value[], arena *a, mistakes *m)
{
    truth_reader r = {.b = {.arena = a, .mistakes = m, .root = file->root}};
    r.b.names =
        unroll_let(document_find(file->root, "let"), parameter_table_names(file, value, a), a, m);
    /* constants of sections are names, too */
    scene of_sections;
    scene_init(&of_sections, "");
    r.b.scene = &of_sections;
    build_sections(&r.b);
    r.b.scene = NULL;
    scene_free(&of_sections);
    r.b.list[LIST_QUANTITIES].count = unroll_entries(
        document_find(file->root, "quantities"), r.b.names, a, m, &r.b.list[LIST_QUANTITIES].entry);
    r.count = unroll_entries(document_find(file->root, "truths"), r.b.names, a, m, &r.list);
    return r;
}

void scene_file_truths_check(const scene_file *file, const scene *s, const double value[],
                             mistakes *m)
{
    arena a = {0};
    truth_reader r = open_truths(file, value, &a, m);
    for (int i = 0; i < r.count; i++) {
        const fields f = fields_of(&r.b, &r.list[i]);
        read_one(file, &f, s, value);
    }
    m->out_of_memory |= a.failed;
    arena_free(&a);
}

static int same_point(const scene_file *file, const double a[], const double b[])
{
    for (int i = 0; i < file->parameters; i++)
        if (a[i] != b[i])
            return 0;
    return 1;
}

static int is_known_row(const scene_file *file, const truths *t, const double value[],
                        const file_truth *one)
{
    for (int i = 0; i < t->rows; i++)
        if (t->row[i].type == &file->type && strcmp(t->row[i].quantity, one->quantity) == 0 &&
            strcmp(t->row[i].kind, one->kind) == 0 &&
            strcmp(t->row[i].formulation, one->formulation) == 0 &&
            strcmp(t->row[i].theory, one->theory) == 0 &&
            strcmp(t->row[i].model, one->model) == 0 &&
            same_point(file, t->row[i].parameter, value) &&
            (isnan(one->at) ? !t->row[i].on_curve : t->row[i].at == one->at))
            return 1;
    return 0;
}

static status add_row(const scene_file *file, const double value[], const file_truth *one,
                      truths *t, fault *f)
{
    truth *more = realloc(t->row, (size_t)(t->rows + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for truths");
    t->row = more;
    truth *row = &more[t->rows++];
    memset(row, 0, sizeof *row);
    row->type = &file->type;
    memcpy(row->parameter, value, sizeof row->parameter);
    row->value = one->value;
    row->uncertainty = one->uncertainty;
    row->on_curve = !isnan(one->at);
    row->at = one->at;
    char **const to[] = {&row->formulation, &row->theory, &row->quantity,   &row->unit,
                         &row->kind,        &row->model,  &row->convention, &row->source};
    const char *const from[] = {one->formulation, one->theory, one->quantity,   one->unit,
                                one->kind,        one->model,  one->convention, one->source};
    for (size_t i = 0; i < sizeof to / sizeof to[0]; i++)
        if ((*to[i] = strdup(from[i])) == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for truths");
    return STATUS_OK;
}

/* With what scene_file_truths_add frees. */
static status add_at(const scene_file *file, const double point[], scene *s, arena *a, truths *t,
                     fault *f)
{
    mistakes m = {.file = file->path};
    TRY(file->type.build_from(file, point, s, f));
    truth_reader r = open_truths(file, point, a, &m);
    for (int i = 0; i < r.count; i++) {
        const fields those = fields_of(&r.b, &r.list[i]);
        const file_truth one = read_one(file, &those, s, point);
        m.out_of_memory |= a->failed;
        TRY(mistakes_status(&m, f));
        if (one.holds && !is_known_row(file, t, point, &one))
            TRY(add_row(file, point, &one, t, f));
    }
    m.out_of_memory |= a->failed;
    return mistakes_status(&m, f);
}

status scene_file_truths_add(const scene_file *file, const double value[], truths *t, fault *f)
{
    arena a = {0};
    double point[CASE_MAX_PARAMETERS] = {0};
    scene s;
    memcpy(point, value, (size_t)file->parameters * sizeof *point);
    scene_init(&s, file->type.name);
    const status outcome = add_at(file, point, &s, &a, t, f);
    scene_free(&s);
    arena_free(&a);
    return outcome;
}

/* At the defaults, and at every other point that a truth speaks of. */
static status add_everywhere(const scene_file *file, arena *a, truths *t, fault *f)
{
    mistakes m = {.file = file->path};
    double defaults[CASE_MAX_PARAMETERS] = {0};
    parameter_defaults(file->type.parameters, defaults);
    TRY(scene_file_truths_add(file, defaults, t, f));
    const truth_reader r = open_truths(file, defaults, a, &m);
    for (int i = 0; i < r.count; i++) {
        builder b = r.b;
        const fields those = fields_of(&b, &r.list[i]);
        double point[CASE_MAX_PARAMETERS];
        memcpy(point, defaults, sizeof point);
        if (!visit_point(file, &those, point))
            TRY(scene_file_truths_add(file, point, t, f));
    }
    m.out_of_memory |= a->failed;
    return mistakes_status(&m, f);
}

status scene_file_truths_add_all(const scene_file *file, truths *t, fault *f)
{
    arena a = {0};
    const status outcome = add_everywhere(file, &a, t, f);
    arena_free(&a);
    return outcome;
}
