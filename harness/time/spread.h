/* Masses that elements spread along themselves (element_type.spreads), in place of those lumped at
 * their nodes: what the motion of an element takes at its nodes, carried to the bodies that move
 * them and to ends that are released. Where an element cannot be evaluated all of its numbers are
 * NAN. */
#ifndef BEAMWORK_SPREAD_H
#define BEAMWORK_SPREAD_H

#include "harness/newton/newton.h"
#include "harness/time/charts.h"

struct mesh_element;

/* F[7 nodes]: on the nodes of an element themselves. */
void spread_force(const model *, int element, const model_state *, const double v[],
                  const double a[], double F[]);
/* As inertia_subtract, inertia_add_tangent and inertia_of have it of masses at frames. */
void spread_subtract(const model *, const model_state *, const double v[], const double a[],
                     double out[]);
void spread_add_tangent(const equations *, const model_state *, const double v[], const double a[],
                        const inertia_relation *, sparse *S);
void spread_add_balance(const model *, const model_state *, const double v[], double *kinetic,
                        double momentum[3], double angular[3]);

/* Of one element: derivatives of what the bodies that move its nodes take, and its ends where these
 * are released: 7 coordinates of each node. */
typedef struct spread_parts {
    const struct mesh_element *el;
    const model_state *state;
    int columns; /* coordinates of the element: 7 of each node, behind them those of released ends
                  */
    double place[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES], /* as inertia_parts */
        velocity[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES],
        acceleration[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    double turn[ELEMENT_MAX_NODES][9], rate[ELEMENT_MAX_NODES][9];
} spread_parts;
void spread_element(const model *, int element, const model_state *, const double v[],
                    const double a[], spread_parts *);
/* The same masses alone, at rest. */
void spread_masses(const model *, int element, const model_state *, spread_parts *);
/* How the motion of one body follows the coordinates: translations and warping by a factor, turns
 * by a matrix; of a released end spatial turns of its body and of a ball joint, others by the
 * factor. */
typedef struct spread_motion {
    double plain, turn[9], ball[9];
} spread_motion;
/* By spatial increments of the coordinates. */
void spread_place(const model *, const spread_parts *, spread_motion place[]);
/* out[columns x columns] += A diag(motions); then the rows of turns by their coordinates. */
void spread_times(const model *, const spread_parts *, const double A[],
                  const spread_motion motion[], double out[]);
void spread_rows(const spread_parts *, double K[]);

#endif
