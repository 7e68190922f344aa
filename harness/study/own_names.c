#include "harness/study/own_names.h"

#include <string.h>

#include "cases/format/mistakes.h"
#include "elements/shared/choice.h"
#include "harness/formulations/formulations.h"

static int is_among(const case_type *const list[], const case_type *type)
{
    while (*list != NULL && *list != type)
        list++;
    return *list != NULL;
}

const case_type *own_names_case_at(const case_type *const run[], int i)
{
    for (int k = 0; run[k] != NULL; k++)
        if (i-- == 0)
            return run[k];
    for (int k = 0; registry_cases[k] != NULL; k++)
        if (!is_among(run, registry_cases[k]) && i-- == 0)
            return registry_cases[k];
    return NULL;
}

const case_type *own_names_case(const case_type *const run[], const char *name)
{
    const case_type *type;
    for (int i = 0; (type = own_names_case_at(run, i)) != NULL; i++)
        if (strcmp(type->name, name) == 0)
            return type;
    return NULL;
}

const scene_quantity *own_names_quantity(const scene *s, const char *name)
{
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, name) == 0)
            return &s->quantity[i];
    return NULL;
}

static const char *case_name_at(const void *context, int i)
{
    const case_type *type = own_names_case_at(context, i);
    return type != NULL ? type->name : NULL;
}

const char *own_names_near_case(const case_type *const run[], const char *name,
                                char text[FAULT_TEXT])
{
    return mistakes_remedy(choice_nearest(name, case_name_at, run),
                           "; 'beamwork list cases' shows them, --scene FILE adds one", text);
}

static const char *formulation_name_at(const void *context, int i)
{
    (void)context;
    const element_type *type = formulations_at(i);
    return type != NULL ? type->name : NULL;
}

const char *own_names_near_formulation(const char *name, char text[FAULT_TEXT])
{
    return mistakes_remedy(choice_nearest(name, formulation_name_at, NULL),
                           "; 'beamwork list formulations' shows them, --element loads one", text);
}

static const char *quantity_name_at(const void *context, int i)
{
    const scene *s = context;
    return i < s->quantities ? s->quantity[i].name : NULL;
}

const char *own_names_near_quantity(const scene *s, const char *name, char text[FAULT_TEXT])
{
    return mistakes_remedy(choice_nearest(name, quantity_name_at, s),
                           "; 'beamwork list CASE' shows them", text);
}
