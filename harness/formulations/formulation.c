#include "harness/formulations/formulation.h"

#include <stdio.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/formulations/formulations.h"

const parameter_type formulation_common[] = {
    {"newton", "", NEWTON_MIXED, 0, 0, "mixed|displacement|dense",
     "Newton's iteration: coordinates, strains and stresses at once, condensed element by element; "
     "displacements only; or uncondensed with Gaussian elimination"},
    {0},
};

assignment_list formulation_options(const element_type *type)
{
    assignment_list list = {.what = "option",
                            .owner = type->name,
                            .option = "",
                            .shown_by = "formulations",
                            .separator = ','};
    int parts = 0;
    for (; parts < PARAMETER_PARTS - 1 && type->options[parts] != NULL; parts++)
        list.part[parts] = type->options[parts];
    list.part[parts] = formulation_common;
    return list;
}

newton_form formulation_newton(const formulation *chosen)
{
    return (newton_form)chosen->option[parameter_count(chosen->type->options)];
}

static const char *formulation_name(const void *context, int i)
{
    (void)context;
    const element_type *type = formulations_at(i);
    return type != NULL ? type->name : NULL;
}

const element_type *formulation_find(const char *key)
{
    return formulations_named(key, strcspn(key, ":"));
}

static void write_key(formulation *out)
{
    const assignment_list list = formulation_options(out->type);
    const int used = snprintf(out->key, sizeof out->key, "%s:", out->type->name);
    assignment_text(&list, out->option, out->key + used, FORMULATION_KEY - used);
    if (out->key[used] == '\0')
        out->key[used - 1] = '\0';
}

void formulation_default(const element_type *type, formulation *out)
{
    const assignment_list list = formulation_options(type);
    memset(out, 0, sizeof *out);
    out->type = type;
    parameter_defaults(list.part, out->option);
    write_key(out);
}

int formulation_choice(const element_type *type, int index, int choice, formulation *out)
{
    const parameter_type *o = parameter_at(type->options, index);
    if (choice >= parameter_choices(o) || choice == (int)o->value)
        return 0;
    formulation_default(type, out);
    out->option[index] = choice;
    write_key(out);
    return 1;
}

unsigned formulation_bears_on(const formulation *chosen)
{
    const element_type *type = chosen->type;
    unsigned features = 0;
    for (int i = 0; i < parameter_count(type->options); i++)
        if (chosen->option[i] != parameter_at(type->options, i)->value)
            features |= element_judged(type, i);
    return features;
}

/* Whoever loads one and misses its name is told what it is called. */
static status unknown(const char *name, fault *f)
{
    char loaded[200] = "";
    fault why = {""};
    for (int i = 0; formulations_at(i) != NULL; i++)
        if (formulations_is_loaded(formulations_at(i))) {
            const size_t used = strlen(loaded);
            snprintf(loaded + used, sizeof loaded - used, "%s%s",
                     used == 0 ? "; --element loaded " : ", ", formulations_at(i)->name);
        }
    const status outcome = choice_unknown("formulation", name, formulation_name, &why);
    return fault_set(f, outcome, "%.300s%s", why.text, loaded);
}

status formulation_parse(const char *text, formulation *out, fault *f)
{
    char name[FORMULATION_KEY];
    const size_t length = strcspn(text, ":");
    if (strlen(text) >= sizeof name)
        return fault_set(f, STATUS_REFUSED, "formulation '%.40s...': too long", text);
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    const element_type *type = formulation_find(name);
    if (type == NULL)
        return unknown(name, f);
    formulation_default(type, out);
    if (text[length] == '\0')
        return STATUS_OK;
    const assignment_list list = formulation_options(type);
    const char *options = text + length + 1;
    TRY(*options != '\0' ? assignment_parse(&list, options, out->option, NULL, f)
                         : assignment_set(&list, options, out->option, NULL, NULL, f));
    write_key(out);
    return STATUS_OK;
}
