/* A formulation from outside that runs in this process: when it crashes or does not come back, the
 * program ends with one line that names it. */
#ifndef BEAMWORK_GUARD_H
#define BEAMWORK_GUARD_H

#include "harness/formulations/formulation.h"

/* From now on; seconds: 0 for no limit. Does nothing for formulations of the program's own. */
void guard_formulation(const formulation *chosen, int seconds);

#endif
