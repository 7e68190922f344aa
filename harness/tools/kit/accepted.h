/* Formulations that the project has accepted: those whose answers tests compare with what is right.
 * What a new one must keep in any case is tested of all (harness/model/test/kinds_test.c,
 * harness/analysis/test/invariants_test.c). */
#ifndef BEAMWORK_TEST_ACCEPTED_H
#define BEAMWORK_TEST_ACCEPTED_H

#include "elements/element.h"

/* Number i of them, or NULL after the last one; the first call reads the packed reference values
 * (BEAMWORK_TRUTHS, or build/truths.h5) and names the new ones. */
const element_type *accepted_at(int i);

#endif
