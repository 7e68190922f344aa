/* How increments, rates and their derivatives follow from each other while a state moves. */
#ifndef BEAMWORK_CHARTS_H
#define BEAMWORK_CHARTS_H

#include "harness/model/model.h"

/* What the rates and their derivatives do while a state moves: for translations, warping and angles
 * dv = g dx, da = b dx; for a rotation in the frame's axes the same with d inc in place of dx,
 * which is X R^T times the spatial increment, X = inverse Jacobian of turning.h at inc[free +
 * driven]. */
typedef struct inertia_relation {
    double b, g; /* [1/s^2], [1/s] */
    const double *inc;
} inertia_relation;
/* N[3 x 3]: what inc of a vertex gains by increments of its coordinates of rotation in the state
 * that it leads to, whose orientation is R. */
void inertia_chart(const model *, int vertex, const double inc[], const double R[9], double N[9]);

/* R N: the same in spatial axes. */
void inertia_turn(const model *, int vertex, const model_state *, const double inc[], double E[9]);

/* Columns: spatial turn of a body by each coordinate of its rotation; angular velocity by the rate
 * of each. */
void inertia_turns(const model *, const model_state *, int vertex, double turn[9], double rate[9]);

#endif
