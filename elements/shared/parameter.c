#include "elements/shared/parameter.h"

#include <string.h>

const parameter_type *parameter_at(const parameter_type *const part[PARAMETER_PARTS], int i)
{
    for (int p = 0; p < PARAMETER_PARTS && part[p] != NULL; p++)
        for (const parameter_type *one = part[p]; one->name != NULL; one++)
            if (i-- == 0)
                return one;
    return NULL;
}

int parameter_count(const parameter_type *const part[PARAMETER_PARTS])
{
    int n = 0;
    for (int p = 0; p < PARAMETER_PARTS && part[p] != NULL; p++)
        for (const parameter_type *one = part[p]; one->name != NULL; one++)
            n++;
    return n;
}

int parameter_index(const parameter_type *const part[PARAMETER_PARTS], const char *name)
{
    const parameter_type *one;
    for (int i = 0; (one = parameter_at(part, i)) != NULL; i++)
        if (strcmp(one->name, name) == 0)
            return i;
    return -1;
}

void parameter_defaults(const parameter_type *const part[PARAMETER_PARTS], double value[])
{
    const parameter_type *one;
    for (int i = 0; (one = parameter_at(part, i)) != NULL; i++)
        value[i] = one->value;
}

int parameter_choices(const parameter_type *p)
{
    if (p->choices == NULL)
        return 0;
    int n = 1;
    for (const char *at = p->choices; *at != '\0'; at++)
        n += *at == '|';
    return n;
}
