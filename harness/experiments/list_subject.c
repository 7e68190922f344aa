#include "harness/experiments/list_subject.h"

#include <stdio.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/formulations/formulations.h"

/* All names that may be asked about, one after the other. */
static const char *name_at(const void *context, int i)
{
    static const char *const words[] = {"cases", "formulations"};
    (void)context;
    if (i < 2)
        return words[i];
    i -= 2;
    for (int k = 0; registry_cases[k] != NULL; k++, i--)
        if (i == 0)
            return registry_cases[k]->name;
    const element_type *type = formulations_at(i);
    return type != NULL ? type->name : NULL;
}

static status refuse(const char *name, fault *f)
{
    const char *near = choice_nearest(name, name_at, NULL);
    return fault_set(
        f, STATUS_REFUSED,
        "'%.60s' is neither a case nor a formulation%s%s%s; 'beamwork list' shows them all", name,
        near != NULL ? ", did you mean '" : "", near != NULL ? near : "", near != NULL ? "'?" : "");
}

status list_subject_find(const char *name, list_subject *out, fault *f)
{
    char bare[SCENE_NAME];
    memset(out, 0, sizeof *out);
    out->cases = name == NULL || strcmp(name, "cases") == 0;
    out->formulations = name == NULL || strcmp(name, "formulations") == 0;
    if (out->cases || out->formulations)
        return STATUS_OK;
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (strcmp(registry_cases[i]->name, name) == 0) {
            out->type = registry_cases[i];
            return STATUS_OK;
        }
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(name, ":"), name);
    return formulation_find(bare) != NULL ? formulation_parse(name, &out->chosen, f)
                                          : refuse(name, f);
}
