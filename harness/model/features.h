/* What a scene needs, in features of formulations (FEATURE_* bits). */
#ifndef BEAMWORK_MODEL_FEATURES_H
#define BEAMWORK_MODEL_FEATURES_H

#include "harness/model/model.h"

/* Feature bits the scene needs and those of them the type does not offer, or a limit it hits, in
 * words; 0: it can run. */
/* 1: in this motion elements of the type spread their mass along themselves. */
int features_spreads(const scene *, int analysis, const element_type *, const double options[]);

unsigned features_needed(const scene *);
/* Those without which an asked quantity means nothing. */
unsigned features_of_quantities(const scene *);
/* Of the physics that it would call for, what the scene leaves out. */
unsigned features_omitted(const scene *);
/* Of the physics that it does not leave out, what a section that is given by its numbers has
 * nothing of, and what counts where there are the analyses of the scene: zero, as far as the
 * numbers say. */
unsigned features_not_given(const scene *, int section);
/* Of walls: does its bimoment turn it on, which no formulation has, where the analyses have
 * stresses and neither warping nor the Wagner torque is left out? */
int features_one_sided(const scene *, int section);
/* The same with the theory of shear in stability that the type has instead of the one the scene
 * asks for: FEATURE_* bits. */
unsigned features_needed_of(const scene *, const element_type *);
/* The theory of shear in stability that values of the type on this scene follow: a bit of
 * shear_theory; 0: nothing is flexible in shear, or nothing is stressed. */
unsigned features_theory(const scene *, const element_type *);
/* Is there shear, and stability that its theory matters to? */
int features_sheared(const scene *);
/* Its name: "Haringx"; of SHEAR_OWN what the type says of it; "" of 0. */
const char *features_theory_words(const element_type *, unsigned theory);
/* Those of them that one quantity depends on: inertia only where it is a frequency or of a rotating
 * structure. */
unsigned features_needed_by_quantity(const scene *, int quantity);

int features_eccentric(const section *c); /* its shear centre is not its centroid */
status features_of_section(const model *m, int section, unsigned *features, fault *f);

#endif
