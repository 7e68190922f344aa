/* Formulations that the project has accepted. */
#ifndef BEAMWORK_TEST_ACCEPTED_H
#define BEAMWORK_TEST_ACCEPTED_H

#include "elements/element.h"

/* Returns accepted formulation number i; NULL: i is too large. The first call reads the packed
 * reference values (BEAMWORK_TRUTHS, or build/truths.h5), which identify the new formulations. */
const element_type *accepted_at(int i);

#endif
