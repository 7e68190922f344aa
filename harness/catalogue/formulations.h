/* All formulations: those of elements/, then those that were loaded. */
#ifndef BEAMWORK_FORMULATIONS_H
#define BEAMWORK_FORMULATIONS_H

#include "elements/element.h"

enum { FORMULATIONS_MOST_LOADED = 16 };

/* Number i, or NULL behind the last one. */
const element_type *formulations_at(int i);
/* Of this name, or NULL. */
const element_type *formulations_named(const char *name, size_t length);
/* 1: it was loaded, no rule of the ledger speaks of it, and it does not gate. */
int formulations_is_new(const element_type *t);
/* Adds one; refuses a name that is there. The type stays the caller's. */
status formulations_add(const element_type *t, fault *f);

#endif
