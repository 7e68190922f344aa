/* What is measured of every formulation, in groups. */
#ifndef BEAMWORK_MEASURED_H
#define BEAMWORK_MEASURED_H

#include "harness/experiments/claims.h"
#include "harness/experiments/measures.h"
#include "harness/formulations/formulations.h"

typedef void measured_run(const formulation *chosen, claims *, measures *out);

typedef struct measured_group {
    const char *name, *what; /* one word; what the numbers are, in a line */
    measured_run *run;
} measured_group;

enum { MEASURED_GROUPS = 3 };
extern const measured_group measured_groups[MEASURED_GROUPS];

measured_run measured_states;  /* of a cantilever, whose exact solution is known */
measured_run measured_locking; /* over thickness by length */
measured_run measured_orders;  /* over the number of elements */

#endif
