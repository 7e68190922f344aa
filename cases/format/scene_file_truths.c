/* Truths of a scene file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/build.h"
#include "cases/format/builder.h"
#include "cases/format/expression.h"
#include "cases/format/keys.h"
#include "cases/format/scene_file_impl.h"

/* A truth at a point. */
typedef struct file_truth {
    int holds; /* 1: at this point */
    scene_truth says;
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
    const int holds = visit_point(file, f, point);
    scene_truth t = {.parameter = value,
                     .value = fields_number(f, "value", 0),
                     .uncertainty = fields_number(f, "uncertainty", 0),
                     .at = fields_number(f, "at", NAN),
                     .quantity = fields_text(f, "quantity", ""),
                     .unit = "",
                     .kind = fields_text(f, "kind", ""),
                     .formulation = fields_text(f, "formulation", ""),
                     .theory = fields_text(f, "theory", ""),
                     .model = fields_have(f, "model") ? "other" : "same",
                     .convention = fields_text(f, "convention", ""),
                     .source = fields_text(f, "source", "")};
    fields_word(f, "kind", kinds, 0);
    fields_word(f, "theory", SCENE_SHEAR_THEORIES, 0);
    fields_word(f, "model", "plate|solid", 0);
    if (!(t.uncertainty >= 0))
        document_mistake(m, document_find(f->map, "uncertainty"), 0,
                         "an uncertainty of %g; give none, or one above zero", t.uncertainty);
    if ((strcmp(t.kind, "predicted") == 0) != (t.formulation[0] != '\0'))
        document_mistake(m, f->place, 0,
                         "a truth of kind predicted is of a formulation, and no other is");
    const scene_quantity *q = quantity_of(s, t.quantity);
    if (q == NULL)
        fields_entry(f, "quantity", SCENE_QUANTITIES);
    else
        t.unit = q->unit;
    return (file_truth){holds, t};
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
    r.b.names = unroll_let(document_find(file->root, "let"),
                           parameter_table_names(file->parameter, value, a), a, m);
    /* constants of sections are names, too */
    scene of_sections;
    scene_init(&of_sections, "");
    r.b.scene = &of_sections;
    build_sections(&r.b);
    r.b.scene = NULL;
    scene_free(&of_sections);
    r.b.list[SCENE_QUANTITIES].count =
        unroll_entries(document_find(file->root, "quantities"), r.b.names, a, m,
                       &r.b.list[SCENE_QUANTITIES].entry);
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

/* With what scene_file_truths frees. */
static status give_at(const scene_file *file, const double point[], scene *s, arena *a,
                      scene_truth_taker *take, void *to, fault *f)
{
    mistakes m = {.file = file->path};
    TRY(file->type.build_from(file, point, s, f));
    truth_reader r = open_truths(file, point, a, &m);
    for (int i = 0; i < r.count; i++) {
        const fields those = fields_of(&r.b, &r.list[i]);
        const file_truth one = read_one(file, &those, s, point);
        m.out_of_memory |= a->failed;
        TRY(mistakes_status(&m, f));
        if (one.holds)
            TRY(take(to, &one.says, f));
    }
    m.out_of_memory |= a->failed;
    return mistakes_status(&m, f);
}

status scene_file_truths(const scene_file *file, const double value[], scene_truth_taker *take,
                         void *to, fault *f)
{
    arena a = {0};
    double point[CASE_MAX_PARAMETERS] = {0};
    scene s;
    memcpy(point, value, (size_t)file->parameters * sizeof *point);
    scene_init(&s, file->type.name);
    const status outcome = give_at(file, point, &s, &a, take, to, f);
    scene_free(&s);
    arena_free(&a);
    return outcome;
}

/* At the defaults, and at every other point that a truth speaks of. */
static status give_everywhere(const scene_file *file, arena *a, scene_truth_taker *take, void *to,
                              fault *f)
{
    mistakes m = {.file = file->path};
    double defaults[CASE_MAX_PARAMETERS] = {0};
    parameter_defaults(file->type.parameters, defaults);
    TRY(scene_file_truths(file, defaults, take, to, f));
    const truth_reader r = open_truths(file, defaults, a, &m);
    for (int i = 0; i < r.count; i++) {
        builder b = r.b;
        const fields those = fields_of(&b, &r.list[i]);
        double point[CASE_MAX_PARAMETERS];
        memcpy(point, defaults, sizeof point);
        if (!visit_point(file, &those, point))
            TRY(scene_file_truths(file, point, take, to, f));
    }
    m.out_of_memory |= a->failed;
    return mistakes_status(&m, f);
}

status scene_file_truths_all(const scene_file *file, scene_truth_taker *take, void *to, fault *f)
{
    arena a = {0};
    const status outcome = give_everywhere(file, &a, take, to, f);
    arena_free(&a);
    return outcome;
}
