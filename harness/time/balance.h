/* Energies and momenta of a motion at an instant. */
#ifndef BEAMWORK_BALANCE_H
#define BEAMWORK_BALANCE_H

#include "harness/time/carried.h"
#include "harness/time/instant.h"

/* out[SCENE_BALANCES]; of the drift the energy of the begin is not yet taken off. */
status balance_of(const model *, const carried_masses *, const instant *,
                  double out[SCENE_BALANCES], fault *);
/* Strain energy [J] that is there when all coordinates are off by their rounding: less is none. */
double balance_rounding(const model *);

#endif
