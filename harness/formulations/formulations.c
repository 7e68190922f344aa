#include "harness/formulations/formulations.h"

#include <string.h>

#include "harness/formulations/registry.h"

enum { MOST_ACCEPTED = 256 };

static const element_type *formulations_loaded[FORMULATIONS_MOST_LOADED + 1];
static const char *loaded_from[FORMULATIONS_MOST_LOADED];
static const element_type *accepted[MOST_ACCEPTED + 1];
static int are_told;

const element_type *formulations_at(int i)
{
    for (int k = 0; registry_formulations[k] != NULL; k++)
        if (i-- == 0)
            return registry_formulations[k];
    return i <= FORMULATIONS_MOST_LOADED ? formulations_loaded[i] : NULL;
}

const element_type *formulations_named(const char *name, size_t length)
{
    const element_type *t = NULL;
    for (int i = 0; (t = formulations_at(i)) != NULL; i++)
        if (strlen(t->name) == length && strncmp(t->name, name, length) == 0)
            return t;
    return NULL;
}

static int is_among(const element_type *const list[], const element_type *t)
{
    int i = 0;
    while (list[i] != NULL && list[i] != t)
        i++;
    return list[i] != NULL;
}

int formulations_is_loaded(const element_type *t)
{
    return is_among(formulations_loaded, t);
}

int formulations_is_new(const element_type *t)
{
    return formulations_is_loaded(t) || (are_told && !is_among(accepted, t));
}

void formulations_accept(const char *name)
{
    int count = 0;
    const element_type *t = formulations_named(name, strlen(name));
    are_told = 1;
    while (accepted[count] != NULL)
        count++;
    if (t != NULL && !is_among(accepted, t) && count < MOST_ACCEPTED)
        accepted[count] = t;
}

/* Words that stand where the name of a formulation may stand. */
static int is_reserved(const char *name)
{
    static const char *const words[] = {"all", "cases", "formulations"};
    int found = 0;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        found |= strcmp(name, words[i]) == 0;
    return found;
}

status formulations_add(const element_type *t, const char *from, fault *f)
{
    int count = 0;
    if (is_reserved(t->name))
        return fault_set(f, STATUS_REFUSED,
                         "no formulation can be called '%s', which is a word of the command line; "
                         "give it another name",
                         t->name);
    if (formulations_named(t->name, strlen(t->name)) != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "formulation %s is there already; give it a name of its own", t->name);
    while (formulations_loaded[count] != NULL)
        count++;
    if (count == FORMULATIONS_MOST_LOADED)
        return fault_set(f, STATUS_REFUSED, "at most %d formulations can be loaded",
                         FORMULATIONS_MOST_LOADED);
    formulations_loaded[count] = t;
    loaded_from[count] = from;
    return STATUS_OK;
}

const char *formulations_element(const element_type *t)
{
    for (int i = 0; formulations_loaded[i] != NULL; i++)
        if (formulations_loaded[i] == t)
            return loaded_from[i];
    return NULL;
}
