/* Inertia of a node that carries the mass of a piece of beam (J Eq. 73, its J corrected to diag(Ip,
 * Iy, Iz)). */
#ifndef BEAMWORK_LUMPED_H
#define BEAMWORK_LUMPED_H

#include "elements/element.h"

enum { LUMPED_VECTORS = 7 };

typedef struct lumped_mass {
    double mass;      /* [kg] */
    double rotary[3]; /* Ip, Iy, Iz about the columns of R [kg m^2] */
    double warping;   /* [kg m^4] */
    int turns; /* 1: rotary inertia; 0: a twist has inertia, but a rotating frame does nothing to it
                */
    int vectors; /* of a section by its matrices, all of its inertia; 0: none, else the rest is not
                    there */
    double vector[LUMPED_VECTORS][3],
        carried[LUMPED_VECTORS]; /* fixed to R, with their masses: the
                  first is the centre of mass [m], the others are of length 1 or root 2 */
} lumped_mass;

/* Lumped mass of `length` [m] of beam. A section by its matrices has all that they give. For
 * others, without FEATURE_ROTARY_INERTIA only translations and the polar moment of the twist
 * count. */
lumped_mass lumped_of(const section *c, unsigned features, double length);

/* Adds `share` of it at a node whose coordinates begin at `at` of n; moving_complete ends it. */
void lumped_add(const lumped_mass *l, double share, const node_state *x,
                const element_rotating_frame *frame, int at, int n, inertia_output *out);

/* Shares of an element's nodes by itself: a half at both, of three nodes Simpson's. */
const double *lumped_shares(int nodes);

/* An element whose nodes carry these shares of its mass. */
status lumped_element(const lumped_mass *whole, int nodes, const double share[],
                      const node_state x[], const element_rotating_frame *frame,
                      inertia_output *out);

/* Masses j of the three unit vectors of a section that have the rotary inertia diag(Ip, Iy, Iz) =
 * sum_k j_k (1 - e_k e_k^T). */
void lumped_directors(const double rotary[3], double j[3]);

#endif
