/* What a formulation leaves out, made from what it gives: derivatives by differences, strains and
 * stresses from a force or an energy. */
#ifndef BEAMWORK_ADAPTERS_H
#define BEAMWORK_ADAPTERS_H

#include "elements/element.h"

/* *out: the whole interface for the same beam: `given` itself where it leaves nothing out. Refuses
 * types that contradict themselves. */
status adapters_complete(const element_type *given, const double options[], element_type *out,
                         fault *f);

/* Relative error that differences leave in its stiffness, as measured on beams
 * (test/adapters_test.c); 0: it leaves nothing to them. */
double adapters_error(const element_type *given);

/* In a few words what the type leaves to differences; "" where that is nothing. */
const char *adapters_words(const element_type *given);

#endif
