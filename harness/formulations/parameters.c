#include "harness/formulations/parameters.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Of the program, not of the source of a case. */
static int is_shared(const parameter_type *p)
{
    return case_is_omit(p) || case_is_mass(p);
}

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
            any[i] = all && !is_shared(parameter_at(c->parameters, i));
    return all ? STATUS_OK : assignment_parse(&list, text, value, any, f);
}

void parameters_text(const case_type *c, const double value[], char *text, int size)
{
    const assignment_list list = parameters_list(c);
    assignment_text(&list, value, text, size);
}

void parameters_source_text(const case_type *c, const double value[], char *text, int size)
{
    double of[CASE_MAX_PARAMETERS];
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++)
        of[i] = is_shared(p) ? p->value : value[i];
    parameters_text(c, of, text, size);
}

int parameters_of_source(const case_type *c)
{
    int count = 0;
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++)
        count += !is_shared(p);
    return count;
}

uint64_t parameters_hash(const case_type *c, const double value[], const int any[])
{
    parameters_words none;
    none.known = 0;
    return parameters_hash_next(c, value, any, &none);
}

/* "name=%.17g;", or "name=*;", in words->text. */
static void write_word(const parameter_type *p, int i, double value, int any,
                       parameters_words *words)
{
    const size_t size = sizeof words->text[i];
    if (i < words->known && words->any[i] == any && words->value[i] == value &&
        !signbit(words->value[i]) == !signbit(value)) /* "-0" is another word */
        return;
    words->value[i] = value;
    words->any[i] = any;
    if (any)
        snprintf(words->text[i], size, "%s=*;", p->name);
    else
        snprintf(words->text[i], size, "%s=%.17g;", p->name, value);
}

uint64_t parameters_hash_next(const case_type *c, const double value[], const int any[],
                              parameters_words *before)
{
    uint64_t hash = 14695981039346656037ull;
    const parameter_type *p;
    int i = 0;
    for (; (p = parameter_at(c->parameters, i)) != NULL; i++) {
        write_word(p, i, value[i], any != NULL && any[i], before);
        if (is_shared(p) && value[i] == 0)
            continue; /* points have the names that they had before there was it */
        for (const char *at = before->text[i]; *at != '\0'; at++)
            hash = (hash ^ (unsigned char)*at) * 1099511628211ull;
    }
    before->known = i;
    return hash;
}
