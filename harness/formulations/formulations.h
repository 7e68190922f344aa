/* All formulations: those of elements/, then those that were loaded. */
#ifndef BEAMWORK_FORMULATIONS_H
#define BEAMWORK_FORMULATIONS_H

#include "elements/element.h"

enum { FORMULATIONS_MOST_LOADED = 16 };

/* Number i, or NULL behind the last one. */
const element_type *formulations_at(int i);
/* Of this name, or NULL. */
const element_type *formulations_named(const char *name, size_t length);
/* Was it loaded from outside? */
int formulations_is_loaded(const element_type *t);
/* 1: the project has not accepted it: it was loaded, or it is not among those that
 * formulations_accept names; until that names any, all of the tree's are accepted. Its verdicts
 * gate where somebody loaded or named it (sweep_gates). */
int formulations_is_new(const element_type *t);
/* One that is accepted (reference/accepted.csv); a name that is not here is passed over. */
void formulations_accept(const char *name);
/* Adds one; refuses a name that is there, and words that mean more than one (all). The type stays
 * the caller's, and so does `from`: what --element calls it, or NULL. */
status formulations_add(const element_type *t, const char *from, fault *f);
/* What --element called it; NULL: it was not loaded so. */
const char *formulations_element(const element_type *t);

#endif
