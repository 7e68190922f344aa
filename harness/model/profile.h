/* Sections of the elements: those of the scene and, behind them, of members whose section changes
 * along them one for each element, at its middle.  Members that change between the same two and
 * have as many elements, all of one length, share theirs.
 *
 * The pieces are prismatic: what they come to has an error of second order in their length,
 * whatever the formulation. */
#ifndef BEAMWORK_MODEL_PROFILE_H
#define BEAMWORK_MODEL_PROFILE_H

#include "harness/model/model.h"

/* Those of the scene. */
status profile_scene(model *m, fault *f);
/* Of all elements of the divided members.  All that m->section has is then there to stay;
 * *sections: how many that are. */
status profile_members(model *m, int *sections, fault *f);
/* Index in m->section of an element of a member, counted along it. */
int profile_at(const model *m, int member, int number);

#endif
