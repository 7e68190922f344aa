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
/* 1: the project has not accepted it, and its verdicts do not gate: it was loaded, or it is not
 * among those that formulations_accept names; until that names any, all of the tree's are
 * accepted. */
int formulations_is_new(const element_type *t);
/* One that gates (reference/accepted.csv); a name that is not here is passed over. */
void formulations_accept(const char *name);
/* From now on all gate, by findings of one's own. */
void formulations_accept_all(void);
/* Adds one; refuses a name that is there, and words that mean more than one (all). The type stays
 * the caller's. */
status formulations_add(const element_type *t, fault *f);

#endif
