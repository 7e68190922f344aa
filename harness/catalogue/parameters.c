#include "harness/catalogue/parameters.h"

#include <stdio.h>
#include <string.h>

assignment_list parameters_list(const case_type *c)
{
    assignment_list list = {.what = "parameter",
                            .owner = c->name,
                            .option = c->file != NULL ? "--scene " : "",
                            .shown_by = c->file != NULL ? c->file : c->name,
                            .separator = ';'};
    memcpy(list.part, c->parameters, sizeof list.part);
    return list;
}

int parameters_count(const case_type *c)
{
    return parameter_count(c->parameters);
}

void parameters_default(const case_type *c, double value[])
{
    parameter_defaults(c->parameters, value);
}

status parameters_set(const case_type *c, const char *assignment, double value[], fault *f)
{
    const assignment_list list = parameters_list(c);
    return assignment_set(&list, assignment, value, NULL, NULL, f);
}

status parameters_parse(const case_type *c, const char *text, double value[], int any[], fault *f)
{
    const assignment_list list = parameters_list(c);
    const int n = parameters_count(c), all = strcmp(text, "*") == 0;
    parameters_default(c, value);
    if (any != NULL)
        for (int i = 0; i < n; i++)
            any[i] = all;
    return all ? STATUS_OK : assignment_parse(&list, text, value, any, f);
}

void parameters_text(const case_type *c, const double value[], char *text, int size)
{
    const assignment_list list = parameters_list(c);
    assignment_text(&list, value, text, size);
}

uint64_t parameters_hash(const case_type *c, const double value[], const int any[])
{
    uint64_t hash = 14695981039346656037ull;
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++) {
        char text[128];
        if (any != NULL && any[i])
            snprintf(text, sizeof text, "%s=*;", p->name);
        else
            snprintf(text, sizeof text, "%s=%.17g;", p->name, value[i]);
        for (const char *at = text; *at != '\0'; at++)
            hash = (hash ^ (unsigned char)*at) * 1099511628211ull;
    }
    return hash;
}
