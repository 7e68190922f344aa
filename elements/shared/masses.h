/* Masses of an element: carried by vectors of its coordinates, and lumped at nodes. */
#ifndef BEAMWORK_SHARED_MASSES_H
#define BEAMWORK_SHARED_MASSES_H

#include "elements/element.h"

/* Masses carried by vectors y(x) of an element's coordinates: points, and unit vectors fixed to
 * sections, whose mass is then a rotary inertia.  Kinetic energy 1/2 mass |dy/dt|^2; in a frame
 * that turns steadily dy/dt = T x' + Omega x y with T = dy/dx, hence the centrifugal potential -1/2
 * mass |Omega x y|^2 and the gyroscopic matrix 2 mass T^T Omega~ T. */

typedef struct moving_vector {
    double mass; /* [kg], or [kg m^2] of a unit vector */
    double y[3]; /* from a point of the axis [m], or a unit vector; read only where a frame turns */
    int at, columns; /* the coordinates that move it: at .. at + columns - 1 */
    const double *T; /* [3 x columns] dy/dx, row-major */
} moving_vector;

/* Zeroes the requested outputs; n coordinates. */
void moving_clear(int n, inertia_output *out);
/* Adds a mass, but for the second derivatives of y, which are the caller's: moving_stiffness -=
 * F . d2y/dx2 with F[3] the centrifugal force, else zero. Of M, N and G
 * the upper half counts until moving_complete. */
void moving_add(const moving_vector *v, const element_rotating_frame *frame, int n,
                inertia_output *out, double F[3]);
/* Lower halves from the upper ones; once, after everything that is added. */
void moving_complete(int n, inertia_output *out);
/* Matrix to which second derivatives of y are added; NULL: not requested. */
static inline double *moving_stiffness(const element_rotating_frame *frame,
                                       const inertia_output *out)
{
    return frame != NULL ? out->N : NULL;
}
/* N -= F . d2v/dtheta2 of a vector v fixed to the node whose rotations begin at coordinate `at`
 * (exponential chart). */
void moving_rotation_stiffness(const double F[3], const double v[3], int at, int n, double N[]);
/* T[3 x columns] += -v~ in columns at .. at + 2: a vector v fixed to a node turns with it. */
void moving_rotation_gradient(const double v[3], int at, int columns, double T[]);

/* Inertia of a node that carries the mass of a piece of beam (J Eq. 73, its J corrected to diag(Ip,
 * Iy, Iz)). */

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
