/* Parameters of a scene file. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/expression.h"
#include "cases/format/scene_file_impl.h"
#include "cases/format/units.h"
#include "elements/shared/choice.h"

static const char *text_of(const document_node *entry, const char *key, const char *otherwise)
{
    const document_node *n = document_find(entry, key);
    return n != NULL && n->kind == DOCUMENT_TEXT ? n->text : otherwise;
}

static double number_of(const document_node *entry, const char *key, double otherwise, mistakes *m)
{
    const document_node *n = document_find(entry, key);
    double value = otherwise;
    return n != NULL && expression_number(n, NULL, m, &value) ? value : otherwise;
}

/* [0, 1] */
static int is_switch(const document_node *choices)
{
    return choices->kind == DOCUMENT_LIST && choices->count == 2 &&
           choices->item[0]->kind == DOCUMENT_TEXT && strcmp(choices->item[0]->text, "0") == 0 &&
           choices->item[1]->kind == DOCUMENT_TEXT && strcmp(choices->item[1]->text, "1") == 0;
}

static void read_switch(parameter_type *p, const document_node *value, mistakes *m)
{
    p->unit = "1";
    p->max = 1;
    if (expression_number(value, NULL, m, &p->value) && p->value != 0 && p->value != 1)
        document_mistake(m, value, 0, "%s: the default is none of its choices 0|1", p->name);
}

/* [a, b, c] -> "a|b|c"; NULL after a mistake. */
static const char *join_choices(scene_file *file, const document_node *list, mistakes *m)
{
    char text[400] = "";
    size_t used = 0;
    int good = list->kind == DOCUMENT_LIST && list->count > 0;
    for (int i = 0; good && i < list->count; i++) {
        const document_node *one = list->item[i];
        const size_t length = one->kind == DOCUMENT_TEXT ? strlen(one->text) : 0;
        good = length > 0 && length < 40 && scope_name_length(one->text) == length &&
               used + length + 2 < sizeof text;
        if (good)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", i > 0 ? "|" : "",
                                     one->text);
    }
    if (!good)
        document_mistake(m, list, 0, "choices: a list of words is expected: [fixed, free]");
    return good ? arena_copy(&file->arena, text, used) : NULL;
}

static void read_choice(parameter_type *p, const document_node *value, mistakes *m)
{
    const int index = value->kind == DOCUMENT_TEXT ? choice_index(p->choices, value->text) : -1;
    p->unit = "";
    p->value = index >= 0 ? index : 0;
    if (index < 0)
        document_mistake(m, value, 0, "%s: the default is none of its choices %s", p->name,
                         p->choices);
}

/* any_unit: the scene has units of its own, and its parameters theirs. */
static void read_number(parameter_type *p, const document_node *entry, int any_unit, mistakes *m)
{
    const document_node *unit = document_find(entry, "unit"), *at = document_find(entry, "value");
    p->unit = text_of(entry, "unit", "1");
    if (unit != NULL && !any_unit)
        units_check(unit, m);
    p->min = number_of(entry, "min", -DBL_MAX, m);
    p->max = number_of(entry, "max", DBL_MAX, m);
    const int read = expression_number(at, NULL, m, &p->value);
    if (p->min > p->max)
        document_mistake(m, document_find(entry, "max"), 0, "%s: max = %g is below min = %g",
                         p->name, p->max, p->min);
    else if (read && !(p->value >= p->min && p->value <= p->max))
        document_mistake(m, at, 0, "%s = %g %s is outside its range %g .. %g", p->name, p->value,
                         p->unit, p->min, p->max);
    /* a range of exactly 0 .. 1 without unit is that of a switch for --set */
    if (p->min == 0 && p->max == 1)
        p->max = nextafter(1, 2);
}

void parameter_table_read(scene_file *file, mistakes *m)
{
    const document_node *all = document_find(file->root, "parameters");
    const scope *names = NULL;
    if (all != NULL)
        for (int i = 0; i < all->count; i++) {
            const document_node *entry = all->item[i], *choices = document_find(entry, "choices");
            if (file->parameters == CASE_MAX_PARAMETERS) {
                document_mistake(m, all->key[i], 0,
                                 "more than %d parameters; put others under 'let'",
                                 CASE_MAX_PARAMETERS);
                break;
            }
            parameter_type *p = &file->parameter[file->parameters++];
            *p =
                (parameter_type){.name = all->key[i]->text, .summary = text_of(entry, "about", "")};
            if (scope_accepts(names, all->key[i], m))
                names = scope_number(names, p->name, 0, &file->arena);
            if (choices != NULL && !is_switch(choices))
                p->choices = join_choices(file, choices, m);
            if (p->choices != NULL)
                read_choice(p, document_find(entry, "value"), m);
            else if (choices != NULL && is_switch(choices))
                read_switch(p, document_find(entry, "value"), m);
            else if (choices == NULL)
                read_number(p, entry, document_find(file->root, "units") != NULL, m);
        }
    file->type.parameters[0] = file->parameter;
}

const scope *parameter_table_names(const parameter_type *p, const double value[], arena *a)
{
    const scope *names = NULL;
    for (; p->name != NULL; p++, value++) {
        char word[48];
        if (p->choices == NULL) {
            names = scope_number(names, p->name, *value, a);
            continue;
        }
        choice_name(p->choices, (int)*value, word, sizeof word);
        const char *kept = arena_copy(a, word, strlen(word));
        if (kept != NULL)
            names = scope_choice(names, p->name, kept, p->choices, a);
    }
    return names;
}
