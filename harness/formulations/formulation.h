/* -f name:key=value,...: a formulation with its options. */
#ifndef BEAMWORK_FORMULATION_H
#define BEAMWORK_FORMULATION_H

#include "cases/case.h"
#include "elements/element.h"
#include "harness/formulations/assignment.h"

enum { FORMULATION_KEY = 128, FORMULATION_OPTIONS = ELEMENT_MAX_OPTIONS + 1 };

/* The mixed Newton condensed element by element; for comparison, in displacements only, and
 * uncondensed with dense elimination. */
typedef enum newton_form {
    NEWTON_MIXED,
    NEWTON_DISPLACEMENT,
    NEWTON_DENSE,
    NEWTON_FORMS
} newton_form;

typedef struct formulation {
    const element_type *type;
    double option[FORMULATION_OPTIONS]; /* its own, in table order, and those that all take */
    /* name, and the options that differ from their defaults */
    char key[FORMULATION_KEY];
} formulation;

/* What every formulation takes, behind its own options. */
extern const parameter_type formulation_common[];
/* The options of a type and those that every formulation takes. */
assignment_list formulation_options(const element_type *);
newton_form formulation_newton(const formulation *);
status formulation_parse(const char *text, formulation *out, fault *f);
/* The type that "name" or "name:key=value,..." means, or NULL. */
const element_type *formulation_find(const char *key);
void formulation_default(const element_type *type, formulation *out);
/* The default with choice `choice` of option `index`; 0 when there is no such choice, or it is the
 * default itself. */
int formulation_choice(const element_type *type, int index, int choice, formulation *out);
/* Features on which the options that differ from their defaults bear (element_judged). */
unsigned formulation_bears_on(const formulation *chosen);

#endif
