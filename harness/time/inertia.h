/* Forces of inertia of the masses that frames carry, in inertial axes; with a mass, its first
 * moment c and tensor J about the frame, in spatial axes: force  m a + w' x c + w x (w x c), moment
 * c x a + J w' + w x J w. */
#ifndef BEAMWORK_INERTIA_H
#define BEAMWORK_INERTIA_H

#include "harness/newton/newton.h"
#include "harness/time/carried.h"
#include "harness/time/charts.h"
#include "harness/time/forms.h"

/* F[6]: force and moment about the frame that the motion of a mass takes. */
void inertia_force_at(const carried_mass *, const frame_rates *, double F[6]);
void inertia_force(const model *, const carried_mass *, const model_state *, const double v[],
                   const double a[], double F[6]);
/* out[free + driven] -= forces of inertia at rates v and their derivatives a (NULL: zero, which
 * leaves those of the velocities). */
void inertia_subtract(const model *, const carried_masses *, const model_state *, const double v[],
                      const double a[], double out[]);

/* S += derivative of the forces of inertia by the coordinates; of rotations in the exponential
 * chart, like every other part of a tangent. */
void inertia_add_tangent(const equations *, const carried_masses *, const model_state *,
                         const double v[], const double a[], const inertia_relation *, sparse *S);

/* Of one frame: derivatives of its force and moment [6 x 6, row-major]. */
typedef struct inertia_parts {
    double place[36]; /* by spatial increments, at fixed rates in its axes; exponential chart */
    double velocity[36], acceleration[36]; /* by those, spatial */
    double turn[9]; /* columns: spatial turn by each coordinate of rotation */
    double rate[9]; /* likewise angular velocity by the rate of each */
} inertia_parts;
void inertia_frame(const model *, const carried_masses *, int index, const model_state *,
                   const double v[], const double a[], inertia_parts *out);
/* out = A diag(translation 1, B); then rows of rotation by their coordinates: K <- diag(1, turn^T)
 * K. */
void inertia_times(const double A[36], double translation, const double B[9], double out[36]);
void inertia_rows(const double turn[9], double K[36]);
typedef struct inertia_balance {
    double kinetic;     /* [J] */
    double momentum[3]; /* [kg m/s] */
    double angular[3];  /* about the origin [kg m^2/s] */
} inertia_balance;
/* ends[released ends x 6]: velocities of the centres of their masses, and in their axes angular
 * velocities; NULL: those of v. */
void inertia_of(const model *, const carried_masses *, const model_state *, const double v[],
                const double ends[], inertia_balance *out);

#endif
