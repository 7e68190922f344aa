#include "harness/catalogue/formulations.h"

#include <string.h>

#include "harness/catalogue/registry.h"

static const element_type *loaded[FORMULATIONS_MOST_LOADED + 1];

const element_type *formulations_at(int i)
{
    for (int k = 0; registry_formulations[k] != NULL; k++)
        if (i-- == 0)
            return registry_formulations[k];
    return i <= FORMULATIONS_MOST_LOADED ? loaded[i] : NULL;
}

const element_type *formulations_named(const char *name, size_t length)
{
    const element_type *t = NULL;
    for (int i = 0; (t = formulations_at(i)) != NULL; i++)
        if (strlen(t->name) == length && strncmp(t->name, name, length) == 0)
            return t;
    return NULL;
}

int formulations_is_new(const element_type *t)
{
    int found = 0;
    for (int i = 0; i < FORMULATIONS_MOST_LOADED && loaded[i] != NULL; i++)
        found |= loaded[i] == t;
    return found;
}

status formulations_add(const element_type *t, fault *f)
{
    int count = 0;
    if (formulations_named(t->name, strlen(t->name)) != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "formulation %s is there already; give it a name of its own", t->name);
    while (loaded[count] != NULL)
        count++;
    if (count == FORMULATIONS_MOST_LOADED)
        return fault_set(f, STATUS_REFUSED, "at most %d formulations can be loaded",
                         FORMULATIONS_MOST_LOADED);
    loaded[count] = t;
    return STATUS_OK;
}
