/* What is measured of every formulation, in groups. */
#ifndef BEAMWORK_MEASURED_H
#define BEAMWORK_MEASURED_H

#include "harness/catalogue/formulation.h"
#include "harness/certificate/measures.h"
#include "harness/contract/claims.h"

typedef void measured_run(const formulation *chosen, claims *, measures *out);

typedef struct measured_group {
    const char *name, *what; /* one word; what the numbers are, in a line */
    measured_run *run;
} measured_group;

extern const measured_group measured_groups[];

#endif
