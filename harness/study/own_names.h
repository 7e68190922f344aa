/* Names that the tables of a project speak of. */
#ifndef BEAMWORK_OWN_NAMES_H
#define BEAMWORK_OWN_NAMES_H

#include "cases/case.h"
#include "elements/element.h"
#include "harness/study/truths.h"

/* The case of this name: among those of the run (ends with NULL), or built in; NULL: none. */
const case_type *own_names_case(const case_type *const run[], const char *name);
/* Number i of the run's cases and the built-in ones that are not among them; NULL behind the
 * last. */
const case_type *own_names_case_at(const case_type *const run[], int i);
/* The scene's quantity of that name, or NULL. */
const scene_quantity *own_names_quantity(const scene *s, const char *name);
/* "; did you mean 'NEAR'?" of cases, formulations, or a scene's quantities, or the remedy. */
const char *own_names_near_case(const case_type *const run[], const char *name,
                                char text[FAULT_TEXT]);
const char *own_names_near_formulation(const char *name, char text[FAULT_TEXT]);
const char *own_names_near_quantity(const scene *s, const char *name, char text[FAULT_TEXT]);

#endif
