/* -f name:key=value,...: a formulation with its options. */
#ifndef BEAMWORK_FORMULATIONS_H
#define BEAMWORK_FORMULATIONS_H

#include "cases/case.h"
#include "harness/analysis/solve.h"

enum { FORMULATION_KEY = 128 };

typedef struct formulation {
    const element_type *type;
    double option[ELEMENT_MAX_OPTIONS];
    solve_newton newton;
    char key
        [FORMULATION_KEY]; /* name, and the options that differ from their defaults, in table order */
} formulation;

extern const char
    formulation_newtons[]; /* choices of the option newton, which every formulation takes */

status formulation_parse(const char *text, formulation *out, fault *f);
/* The type that "name" or "name:key=value,..." means, or NULL. */
const element_type *formulation_find(const char *key);
void formulation_default(const element_type *type, formulation *out);
/* The default with choice `choice` of option `index`; 0 when there is no such choice, or it is the default itself. */
int formulation_choice(const element_type *type, int index, int choice, formulation *out);
/* Features on which the options that differ from their defaults bear (element_option.judged). */
unsigned formulation_bears_on(const formulation *chosen);
const case_type *case_find(const char *name, fault *f); /* NULL: unknown, f names the nearest */

#endif
