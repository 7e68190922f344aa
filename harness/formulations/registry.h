/* The two generated lists: what exists in elements/ and cases/. NULL-terminated. */
#ifndef BEAMWORK_REGISTRY_H
#define BEAMWORK_REGISTRY_H

#include "cases/case.h"
#include "elements/element.h"

extern const element_type *const registry_formulations[];
extern const case_type *const registry_cases[];

#endif
