/* Formulations that the project has accepted. Tests compare their results with reference values.
 * Requirements on new formulations are tested for all formulations
 * (harness/model/test/kinds_test.c, harness/analysis/test/invariants_test.c). */
#ifndef BEAMWORK_TEST_ACCEPTED_H
#define BEAMWORK_TEST_ACCEPTED_H

#include "elements/element.h"

/* Returns accepted formulation number i; NULL: i is too large. The first call reads the packed
 * reference values (BEAMWORK_TRUTHS, or build/truths.h5), which identify the new formulations. */
const element_type *accepted_at(int i);

#endif
