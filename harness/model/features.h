/* What a scene needs, in features of formulations (FEATURE_* bits). */
#ifndef BEAMWORK_MODEL_FEATURES_H
#define BEAMWORK_MODEL_FEATURES_H

#include "harness/model/model.h"

/* Feature bits the scene needs and those of them the type does not offer, or a limit it hits, in
 * words; 0: it can run. */
unsigned features_needed(const scene *);
/* Those without which an asked quantity means nothing. */
unsigned features_of_quantities(const scene *);
/* The same with the theory of shear in stability that the type has instead of the one the scene
 * asks for: FEATURE_* bits. */
unsigned features_needed_of(const scene *, const element_type *);
/* The theory of shear that values of the type on this scene follow: a bit of shear_theory; 0:
 * nothing is flexible in shear. */
unsigned features_theory(const scene *, const element_type *);
/* Those of them that one quantity depends on: inertia only where it is a frequency or of a rotating
 * structure. */
unsigned features_needed_by_quantity(const scene *, int quantity);

#endif
