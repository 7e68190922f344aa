/* Instants at which loads or what is driven has a kink or a jump: no step goes across. */
#ifndef BEAMWORK_KINKS_H
#define BEAMWORK_KINKS_H

#include "harness/model/model.h"

/* The first behind `time` [s]; INFINITY: there is none. */
double kinks_next(const model *, double time);
/* Where a step that ends at a kink reads its loads: just before. */
double kinks_before(const model *, double time);

#endif
