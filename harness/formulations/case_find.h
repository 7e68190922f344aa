/* Cases by their names. */
#ifndef BEAMWORK_CASE_FIND_H
#define BEAMWORK_CASE_FIND_H

#include "cases/case.h"

const case_type *case_find(const char *name, fault *f); /* NULL: unknown, f names the nearest */

#endif
