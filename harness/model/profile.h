/* Sections of the elements: those of the scene and, behind them, of members whose section changes
 * along them one for each element, at its middle.  Members that change between the same two and
 * have as many elements share theirs.
 *
 * The pieces are prismatic: what they come to has an error of second order in their length,
 * whatever the formulation. */
#ifndef BEAMWORK_MODEL_PROFILE_H
#define BEAMWORK_MODEL_PROFILE_H

#include "harness/model/model_impl.h"

/* Those of the scene. */
status profile_scene(model *m, fault *f);
/* divisions [members]: elements of each.  All that m->section has is then there to stay. */
status profile_members(model *m, const int divisions[], fault *f);
/* Index in m->section of an element of a member, counted along it. */
int profile_at(const model *m, int member, int number);
/* profile_members, and *sections: how many the model has then. */
status profile_count(model *m, const int count[], int *sections, fault *f);

#endif
