#include "cases/format/format_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

static void write_values_word(writer *w, const char *words, int index);

static void write_value(writer *w, const entry_field *k, const void *entry)
{
    const void *at = (const char *)entry + k->at;
    const int whole = k->size == sizeof(int) ? *(const int *)at : 0;
    const scene_path *path = at;
    switch (k->kind) {
    case ENTRY_NUMBER:
        write_values_number(w, *(const double *)at);
        break;
    case ENTRY_WHOLE:
        fprintf(w->to, "%d", whole);
        break;
    case ENTRY_VECTOR:
    case ENTRY_DIRECTION:
    case ENTRY_POSITION:
        write_values_numbers(w, k->count, at);
        break;
    case ENTRY_NUMBERS:
        write_values_numbers(w, path->stations, path->value);
        break;
    case ENTRY_NAME:
        write_values_name(w, k->of, whole);
        break;
    case ENTRY_WORD:
        write_values_word(w, k->words, entry_index(k, whole));
        break;
    case ENTRY_FLAG:
        write_values_word(w, k->words, whole);
        break;
    case ENTRY_WORDS:
        write_values_bits(w, k->words, *(const unsigned *)at);
        break;
    default:
        break;
    }
}

static int is_key(const char *own, const char *of, const char *key)
{
    const char *dot = strchr(own, '.');
    const size_t size = dot != NULL ? (size_t)(dot - own) : 0;
    return dot == NULL
               ? strcmp(own, key) == 0
               : strcmp(dot + 1, key) == 0 && strncmp(own, of, size) == 0 && of[size] == '\0';
}

static const write_own *find_own(const write_own own[], const char *of, const char *key)
{
    for (; own != NULL && own->key != NULL; own++)
        if (is_key(own->key, of, key))
            return own;
    return NULL;
}

/* Returns 1 if the key must be written: it is required, differs from its default, or is always
 * written. */
static int is_due(const entry_field *k, const void *entry)
{
    const int must = k->always || (k->needed && k->group == 0);
    return (must && (k->kind != ENTRY_NAME || k->size > 0)) || !entry_is_usual(k, entry);
}

static void write_map(writer *w, const entry_field *table, const void *entry, const write_own own[],
                      const char *of)
{
    w->begun = 0;
    fputc('{', w->to);
    for (const entry_field *k = table; k->name != NULL; k++) {
        const write_own *by_hand = find_own(own, of, k->name);
        if (by_hand != NULL)
            by_hand->write(w, entry);
        else if ((k->size > 0 || k->kind == ENTRY_MAP) && is_due(k, entry)) {
            write_values_key(w, k->name);
            if (k->kind == ENTRY_MAP)
                write_map(w, entry_below(k), entry, own, k->name);
            else
                write_value(w, k, entry);
        }
    }
    fputc('}', w->to);
    w->begun = 1;
}

void write_entry(writer *w, const entry_field *table, const void *entry, const write_own own[])
{
    write_map(w, table, entry, own, "");
}

const char *const write_values_component[6] = {"ux", "uy", "uz", "rx", "ry", "rz"};

static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789.";

void write_values_key(writer *w, const char *key)
{
    fprintf(w->to, "%s%s: ", w->begun ? ", " : "", key);
    w->begun = 1;
}

static void write_values_word(writer *w, const char *words, int index)
{
    char word[SCENE_NAME];
    choice_name(words, index, word, sizeof word);
    fputs(word, w->to);
}

void write_values_bits(writer *w, const char *words, unsigned bits)
{
    const char *before = "[";
    for (int i = 0; bits >> i != 0; i++)
        if (bits >> i & 1u) {
            fputs(before, w->to);
            write_values_word(w, words, i);
            before = ", ";
        }
    fputc(']', w->to);
}

void write_values_number(writer *w, double value)
{
    char text[40];
    if (!isfinite(value)) {
        w->unwritable = 1;
        return;
    }
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    fputs(text, w->to);
}

void write_values_numbers(writer *w, int count, const double value[])
{
    fputc('[', w->to);
    for (int i = 0; i < count; i++) {
        fputs(i > 0 ? ", " : "", w->to);
        write_values_number(w, value[i]);
    }
    fputc(']', w->to);
}

int write_values_any(int count, const double value[])
{
    for (int i = 0; i < count; i++)
        if (value[i] != 0)
            return 1;
    return 0;
}

void write_values_if(writer *w, const char *key, double value, double otherwise)
{
    if (value == otherwise && !signbit(value) == !signbit(otherwise))
        return;
    write_values_key(w, key);
    write_values_number(w, value);
}

void write_values_quoted(writer *w, const char *text)
{
    fputc('"', w->to);
    for (; *text != '\0'; text++)
        fprintf(w->to, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
    fputc('"', w->to);
}

/* Returns 1 if gravity on a node with this name would act on a member, because members take
 * precedence over nodes. */
static int is_mistaken(const scene *s, int node, const char *name)
{
    int weighs = 0, other = 0;
    for (int i = 0; i < s->loads; i++)
        weighs |= s->load[i].kind == SCENE_WEIGHT && s->load[i].where == node;
    for (int i = 0; weighs && i < s->members; i++)
        other |= strcmp(scene_own_name(s, SCENE_MEMBERS, i), name) == 0;
    return other;
}

/* Returns 1 if no earlier entry of the list has the name, and a file allows the name as a key. */
static int is_good_name(const scene *s, scene_list list, int index, const char *name)
{
    static const char *const taken[] = {"free", "held", "all"};
    for (size_t i = 0; i < sizeof taken / sizeof taken[0]; i++)
        if (strcmp(name, taken[i]) == 0)
            return 0;
    if (name[strspn(name, letters)] != '\0')
        return 0;
    for (int i = 0; i < index; i++)
        if (strcmp(scene_own_name(s, list, i), name) == 0)
            return 0;
    return list != SCENE_NODES || !is_mistaken(s, index, name);
}

void write_values_name(writer *w, scene_list list, int index)
{
    const scene_words name = scene_name(w->scene, list, index);
    const int good = is_good_name(w->scene, list, index, name.text);
    fputs(good ? name.text : scene_numbered(w->scene, list, index).text, w->to);
}

void write_values_named(writer *w, const char *before, scene_list list, int index)
{
    fputs(before, w->to);
    write_values_name(w, list, index);
}

void write_values_motion(writer *w, int index)
{
    write_values_name(w, SCENE_DRIVERS, index);
}

void write_values_matrix(writer *w, const double A[36])
{
    double diagonal[6];
    int whole = 0;
    for (int k = 0; k < 36; k++)
        whole |= k % 7 != 0 && A[k] != 0;
    for (int k = 0; k < 6; k++)
        diagonal[k] = A[7 * k];
    write_values_numbers(w, whole ? 36 : 6, whole ? A : diagonal);
}

static void write_shear(writer *w, const void *entry)
{
    const section_spec *spec = entry;
    const section *c = &spec->constants;
    const int by_D = c->F[0] == 0 && c->D[0] != 0;
    if (!write_values_any(9, by_D ? c->D : c->F) && !(spec->zeros & SECTION_ZERO_SHEAR))
        return;
    write_values_key(w, by_D ? "D" : "F");
    write_values_numbers(w, 9, by_D ? c->D : c->F);
}

static void write_walls(writer *w, const void *entry)
{
    const section_spec *spec = entry;
    if (spec->kind != SECTION_WALLS)
        return;
    write_values_key(w, "points");
    for (int i = 0; i < spec->points; i++) {
        fprintf(w->to, "%sp%d: ", i > 0 ? ", " : "{", i);
        write_values_numbers(w, 2, spec->point[i]);
    }
    fputs("}, walls: [", w->to);
    for (int i = 0; i < spec->walls; i++) {
        fprintf(w->to, "%s{from: p%d, to: p%d, thickness: ", i > 0 ? ", " : "", spec->wall[i].from,
                spec->wall[i].to);
        write_values_number(w, spec->wall[i].thickness);
        fputc('}', w->to);
    }
    fputc(']', w->to);
}

static void write_shear_factor(writer *w, const void *entry)
{
    const section_spec *spec = entry;
    if (spec->kind != SECTION_RECTANGLE || !write_values_any(2, spec->shear_factor))
        return;
    write_values_key(w, "shear_factor");
    write_values_numbers(w, 2, spec->shear_factor);
}

static void write_matrices(writer *w, const section *c)
{
    fputs("{stiffness: ", w->to);
    write_values_matrix(w, c->stiffness);
    if (write_values_any(36, c->mass)) {
        fputs(", mass: ", w->to);
        write_values_matrix(w, c->mass);
    }
    fputc('}', w->to);
}

void write_sections(writer *w)
{
    static const write_own own[] = {{"D", write_shear},
                                    {"points", write_walls},
                                    {"shear_factor", write_shear_factor},
                                    {NULL, NULL}};
    fputs("sections:\n", w->to);
    for (int i = 0; i < w->scene->sections; i++) {
        const section_spec *spec = &w->scene->section[i];
        write_values_named(w, "  ", SCENE_SECTIONS, i);
        fputs(": ", w->to);
        if (spec->kind == SECTION_MATRICES)
            write_matrices(w, &spec->constants);
        else
            write_entry(w, entry_section, spec, own);
        fputc('\n', w->to);
    }
}

static void write_largest(writer *w, const void *entry)
{
    const scene_control *c = &scene_continuation_of(entry)->control;
    write_values_if(w, "step_max", c->step_max, c->step);
}

static void write_integrator(writer *w, const void *entry)
{
    write_values_key(w, "integrator");
    write_values_word(w, SCENE_SCHEME_CHOICES, (int)scene_motion_of(entry)->scheme);
}

static void write_parameters(writer *w, const void *entry)
{
    const scene_motion *m = scene_motion_of(entry);
    if (m->scheme != SCENE_ALPHA)
        return;
    write_values_key(w, "parameters");
    write_values_numbers(w, 2, (const double[]){m->alpha.mass, m->alpha.force});
}

void write_analyses(writer *w)
{
    static const write_own own[] = {{"step_max", write_largest},
                                    {"integrator", write_integrator},
                                    {"parameters", write_parameters},
                                    {NULL, NULL}};
    fputs("analyses:\n", w->to);
    for (int i = 0; i < w->scene->analyses; i++) {
        write_values_named(w, "  ", SCENE_ANALYSES, i);
        fputs(": ", w->to);
        write_entry(w, entry_analysis, &w->scene->analysis[i], own);
        fputc('\n', w->to);
    }
}

static void write_end(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    const int internal = q->what.kind == SCENE_INTERNAL;
    if (internal && scene_internal_of(q)->along != SCENE_ALONG_PLACE)
        return;
    const double place = internal ? scene_internal_of(q)->place : q->what.of.deflection.place;
    if (place == 0 || place == 1) {
        write_values_key(w, "end");
        write_values_word(w, "from|to", place == 1);
    } else {
        write_values_key(w, "where");
        write_values_number(w, place);
    }
}

static void write_where(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    if (q->what.kind != SCENE_STRESS || scene_stress_of(q)->whole)
        return;
    write_values_key(w, "where");
    write_values_number(w, scene_stress_of(q)->place);
}

/* Writes the side of a discontinuity if it is that of p (the default is that of q) and the quantity
 * is at a position. */
static void write_side(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    const int stress = q->what.kind == SCENE_STRESS;
    const double place = stress ? scene_stress_of(q)->place : scene_internal_of(q)->place;
    const int before = stress ? scene_stress_of(q)->before : scene_internal_of(q)->before,
              is_given = stress ? !scene_stress_of(q)->whole : place > 0 && place < 1;
    if (is_given && before) {
        write_values_key(w, "side");
        write_values_word(w, "from|to", 0);
    }
}

static void write_taken(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    if (q->reduction == SCENE_LAST)
        return;
    write_values_key(w, q->reduction == SCENE_AT ? "at" : "take");
    if (q->reduction == SCENE_AT)
        write_values_number(w, q->at);
    else
        write_values_word(w, SCENE_TAKE_CHOICES,
                          q->transform != SCENE_HISTORY
                              ? SCENE_REDUCTIONS - 1 + (int)q->transform - SCENE_SPECTRUM
                              : (int)q->reduction - (q->reduction > SCENE_AT));
}

static void write_overs(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    if (q->overs == 0)
        return;
    write_values_key(w, "combinations");
    for (int i = 0; i < q->overs; i++)
        write_values_named(w, i > 0 ? ", " : "[", SCENE_COMBINATIONS, q->over[i]);
    fputc(']', w->to);
}

static void write_members(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    write_values_key(w, "quantities");
    for (int i = 0; i < q->overs; i++) {
        fputs(i > 0 ? ", " : "[", w->to);
        write_values_quoted(w, w->scene->quantity[q->over[i]].name);
    }
    fputc(']', w->to);
}

static void write_unit(writer *w, const void *entry)
{
    write_values_key(w, "unit");
    write_values_quoted(w, ((const scene_quantity *)entry)->unit);
}

static void write_abscissa(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    if (q->reduction != SCENE_CURVE)
        return;
    write_values_key(w, "x");
    fputs(q->x.is_quantity ? "{quantity: " : "{name: ", w->to);
    write_values_quoted(w, q->x.name);
    if (!q->x.is_quantity) {
        write_values_key(w, "unit");
        write_values_quoted(w, q->x.unit);
        write_values_if(w, "factor", q->x.factor, 1);
        write_values_if(w, "offset", q->x.offset, 0);
    }
    fputc('}', w->to);
}

static void write_prediction(writer *w, const void *entry)
{
    const scene_prediction *p = &((const scene_quantity *)entry)->prediction;
    if (p->source == NULL)
        return;
    write_values_key(w, "prediction");
    fputs("{value: ", w->to);
    write_values_number(w, p->value);
    write_values_key(w, "source");
    write_values_quoted(w, p->source);
    fputc('}', w->to);
}

void write_quantities(writer *w)
{
    static const write_own own[] = {{"internal.end", write_end},
                                    {"internal.where", write_where},
                                    {"deflection.end", write_end},
                                    {"deflection.where", write_where},
                                    {"stress.where", write_where},
                                    {"internal.side", write_side},
                                    {"stress.side", write_side},
                                    {"combinations", write_overs},
                                    {"quantities", write_members},
                                    {"at", write_taken},
                                    {"unit", write_unit},
                                    {"x", write_abscissa},
                                    {"prediction", write_prediction},
                                    {NULL, NULL}};
    fputs(w->scene->quantities > 0 ? "quantities:\n" : "", w->to);
    for (int i = 0; i < w->scene->quantities; i++) {
        const scene_quantity *q = &w->scene->quantity[i];
        fputs("  ", w->to);
        write_values_quoted(w, q->name);
        fputs(": ", w->to);
        write_entry(w, entry_quantity, q, own);
        fputc('\n', w->to);
    }
}
