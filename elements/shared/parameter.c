#include "elements/shared/parameter.h"

#include <string.h>

int parameter_count(const parameter_type table[])
{
    int n = 0;
    while (table != NULL && table[n].name != NULL)
        n++;
    return n;
}

int parameter_index(const parameter_type table[], const char *name)
{
    for (int i = 0; i < parameter_count(table); i++)
        if (strcmp(table[i].name, name) == 0)
            return i;
    return -1;
}

void parameter_defaults(const parameter_type table[], double value[])
{
    for (int i = 0; i < parameter_count(table); i++)
        value[i] = table[i].value;
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
