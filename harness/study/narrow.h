/* A planned sweep of one point, reduced to what a selection speaks of. */
#ifndef BEAMWORK_NARROW_H
#define BEAMWORK_NARROW_H

#include "harness/study/sweep.h"

/* Before the run: keeps the quantities that the selection (formulations/formulations.h; NULL: all)
 * holds for with some formulation, and the formulations it holds for with some quantity. REFUSED:
 * it is malformed, has a word that names nothing, or holds for nothing. */
status narrow_to(sweep *s, const char *select, fault *f);
/* The same of a scene by itself, before it is planned. Its formulation may still be open (type
 * NULL): words that could name one then leave the scene as it is. */
status narrow_scene(scene *, const case_type *, const double parameter[], const formulation *,
                    const char *select, fault *);

#endif
