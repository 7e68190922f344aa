/* Forces of inertia of the masses that frames carry, in inertial axes; with a mass, its first
 * moment c and tensor J about the frame, in spatial axes: force  m a + w' x c + w x (w x c), moment
 * c x a + J w' + w x J w. */
#ifndef BEAMWORK_INERTIA_H
#define BEAMWORK_INERTIA_H

#include "harness/inertia/carried.h"
#include "harness/inertia/forms.h"

/* Of a node's frame or of a released end: forms_rates. */
void inertia_rates(const model *, const model_state *, int vertex, const double v[],
                   const double a[], frame_rates *);
/* F[6]: force and moment about the frame that the motion of a mass takes. */
void inertia_force_at(const carried_mass *, const frame_rates *, double F[6]);
void inertia_force(const model *, const carried_mass *, const model_state *, const double v[],
                   const double a[], double F[6]);
/* out[free + driven] -= forces of inertia at rates v and their derivatives a (NULL: zero, which
 * leaves those of the velocities). */
void inertia_subtract(const model *, const carried *, const model_state *, const double v[],
                      const double a[], double out[]);

/* What the rates and their derivatives do while a state moves: for translations, warping and angles
 * dv = g dx, da = b dx; for a rotation in the frame's axes the same with d inc in place of dx,
 * which is X R^T times the spatial increment, X = inverse Jacobian of turning.h at inc[free +
 * driven]. */
typedef struct inertia_relation {
    double b, g; /* [1/s^2], [1/s] */
    const double *inc;
} inertia_relation;
/* S += derivative of the forces of inertia by the coordinates; of rotations in the exponential
 * chart, like every other part of a tangent. */
void inertia_add_tangent(const model *, const carried *, const model_state *, const double v[],
                         const double a[], const inertia_relation *, sparse *S);

/* Of one frame: derivatives of its force and moment [6 x 6, row-major]. */
typedef struct inertia_parts {
    double place[36]; /* by spatial increments, at fixed rates in its axes; exponential chart */
    double velocity[36], acceleration[36]; /* by those, spatial */
    double turn[9]; /* columns: spatial turn by each coordinate of rotation */
    double rate[9]; /* likewise angular velocity by the rate of each */
} inertia_parts;
void inertia_frame(const model *, const carried *, int index, const model_state *, const double v[],
                   const double a[], inertia_parts *out);
/* out = A diag(translation 1, B); then rows of rotation by their coordinates: K <- diag(1, turn^T)
 * K. */
void inertia_times(const double A[36], double translation, const double B[9], double out[36]);
void inertia_rows(const double turn[9], double K[36]);
/* N[3 x 3]: what inc of a vertex gains by increments of its coordinates of rotation in the state
 * that it leads to, whose orientation is R. */
void inertia_chart(const model *, int vertex, const double inc[], const double R[9], double N[9]);

/* R N: the same in spatial axes. */
void inertia_turn(const model *, int vertex, const model_state *, const double inc[], double E[9]);

typedef struct inertia_balance {
    double kinetic;     /* [J] */
    double momentum[3]; /* [kg m/s] */
    double angular[3];  /* about the origin [kg m^2/s] */
} inertia_balance;
/* ends[released ends x 6]: velocities of the centres of their masses, and in their axes angular
 * velocities; NULL: those of v. */
void inertia_of(const model *, const carried *, const model_state *, const double v[],
                const double ends[], inertia_balance *out);

#endif
