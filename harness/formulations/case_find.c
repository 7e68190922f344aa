#include "harness/formulations/case_find.h"

#include <string.h>

#include "elements/shared/choice.h"
#include "harness/formulations/registry.h"

static const char *case_name(const void *context, int i)
{
    (void)context;
    return registry_cases[i] != NULL ? registry_cases[i]->name : NULL;
}

const case_type *case_find(const char *name, fault *f)
{
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (strcmp(registry_cases[i]->name, name) == 0)
            return registry_cases[i];
    choice_unknown("case", name, case_name, f);
    return NULL;
}
