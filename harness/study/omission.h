/* What a formulation leaves out of the physics of a scene, and what that changes: nothing that is
 * asked for, or it solves another model. */
#ifndef BEAMWORK_OMISSION_H
#define BEAMWORK_OMISSION_H

#include "harness/model/model.h"

typedef struct omission {
    unsigned what;          /* FEATURE_* and OMIT_* bits (model.h); 0: nothing */
    char words[OMIT_WORDS]; /* the same, as results have it */
    int other;              /* 1: another model */
    int exact;              /* 1: there is none of it in the sections, or the analyses see none */
    double change;          /* bound, relative, of what it changes in asked values; NAN: unknown */
    char quantity[SCENE_NAME]; /* the one that it changes most; empty: none */
    char why[FAULT_TEXT];      /* the bound is unknown */
} omission;

/* Above this part of a value it is another model. */
extern const double omission_most;
/* So many times what two coarse solutions of a formulation that has the physics differ by, with it
 * and without it, bounds what it changes. */
extern const double omission_safety;

/* What the type leaves out of a scene. Where no formulation of the program has all of it, or the
 * one that has finds no values, the bound is unknown, and the model another one. */
void omission_of(const scene *, const element_type *, omission *out);
/* What leaving that out changes on one mesh, of the asked value that it changes most; NAN: not all
 * have a value there, or no formulation has all of the scene. */
double omission_on_mesh(const scene *, unsigned what, int elements);
/* "without shear: changes no asked value by more than 2e-06", "another model: shear is not modelled
 * (changes frequency_1 by about 16 %)". */
enum { OMISSION_TEXT = OMIT_WORDS + SCENE_NAME + FAULT_TEXT + 80 };
void omission_words(const omission *, char text[OMISSION_TEXT]);

#endif
