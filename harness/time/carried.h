/* Masses that the frames of a model carry: those of the elements, lumped at their nodes, and rigid
 * bodies. What is joined rigidly to a frame belongs to it: one mass, one centre, one tensor. */
#ifndef BEAMWORK_CARRIED_H
#define BEAMWORK_CARRIED_H

#include "harness/model/model.h"

/* At one frame, in axes that turn with it and were the fixed ones at rest. */
typedef struct carried_mass {
    int frame;         /* vertex with coordinates of its own, or of a released end */
    double mass;       /* [kg] */
    double moment[3];  /* mass times its centre, from the frame [kg m] */
    double inertia[9]; /* about the frame [kg m^2] */
} carried_mass;

typedef struct carried_masses {
    int masses;
    carried_mass *mass; /* [masses] one for each frame that carries any */
    double *warping;    /* [coordinates] of warping amplitudes [kg m^4], else 0 */
    double total;       /* [kg] of these */
    int spread; /* 1: elements spread theirs along themselves (spread.h), and none is here */
} carried_masses;

/* Elements of two nodes carry a half at each, of three Simpson's shares (J Eq. 73). What an end has
 * that is released from its node moves with turns and shifts of its own. */
status carried_alloc(const model *, carried_masses *, fault *);
/* Rigid bodies alone, beside masses that elements spread. */
status carried_alloc_spread(const model *, carried_masses *, fault *);
void carried_free(carried_masses *);
/* Of one node of an element, about it, and of its warping amplitude [kg m^4]. */
struct mesh_element;
void carried_share(const model *, const struct mesh_element *, int node, carried_mass *,
                   double *warping);

#endif
