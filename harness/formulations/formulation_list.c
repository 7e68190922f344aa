#include "harness/formulations/formulation_list.h"

#include <string.h>

#include "harness/formulations/formulations.h"

static status add_all(int most, formulation list[], int *count, fault *f)
{
    for (int i = 0; formulations_at(i) != NULL; i++) {
        if (*count == most)
            return fault_set(f, STATUS_REFUSED, "too many formulations; give at most %d", most);
        formulation_default(formulations_at(i), &list[(*count)++]);
    }
    return STATUS_OK;
}

status formulation_list_add(const char *text, int most, formulation list[], int *count, fault *f)
{
    if (strcmp(text, "all") == 0)
        return add_all(most, list, count, f);
    if (*count == most)
        return fault_set(f, STATUS_REFUSED, "too many formulations; give at most %d", most);
    TRY(formulation_parse(text, &list[*count], f));
    for (int i = 0; i < *count; i++)
        if (strcmp(list[i].key, list[*count].key) == 0)
            return fault_set(f, STATUS_REFUSED, "a formulation is given twice; give it once");
    ++*count;
    return STATUS_OK;
}
