#ifndef BEAMWORK_SHARED_MASSES_H
#define BEAMWORK_SHARED_MASSES_H

#include "elements/element.h"

/* Masses attached to vectors y(x) that depend on the coordinates x of an element. A vector is the
 * position of a point, or a unit vector fixed to a section, for which the mass is a rotary inertia.
 * The kinetic energy is 1/2 mass |dy/dt|^2. In a frame that rotates at a constant rate, dy/dt = T
 * x' + Omega x y with T = dy/dx. This gives the centrifugal potential -1/2 mass |Omega x y|^2 and
 * the gyroscopic matrix 2 mass T^T Omega~ T. */

typedef struct moving_vector {
    double mass; /* mass [kg], or rotary inertia of a unit vector [kg m^2] */
    double y[3]; /* position relative to a point of the rotation axis [m], or a unit vector, used
                    only in a rotating frame */
    int at, columns; /* coordinates that move the vector: at .. at + columns - 1 */
    const double *T; /* [3 x columns] dy/dx, row-major */
} moving_vector;

void moving_clear(int n, inertia_output *out);
/* Adds a mass and sets F[3] to its centrifugal force, or zero if the frame does not rotate. The
 * caller must subtract F . d2y/dx2 from moving_stiffness. Only the upper halves of M, N and G are
 * set; moving_complete sets the lower halves. */
void moving_add(const moving_vector *v, const element_rotating_frame *frame, int n,
                inertia_output *out, double F[3]);
/* Copies the upper halves of the matrices to the lower halves (G with a minus sign). The caller
 * calls this function once, after all masses have been added. */
void moving_complete(int n, inertia_output *out);
/* Returns the matrix to which the terms of the second derivatives of y are added, or NULL if this
 * matrix is not requested or the frame does not rotate. */
static inline double *moving_stiffness(const element_rotating_frame *frame,
                                       const inertia_output *out)
{
    return frame != NULL ? out->N : NULL;
}
/* Subtracts F . d2v/dtheta2 (exponential chart) from N, for a vector v that is fixed to the node
 * whose rotations begin at coordinate `at`. */
void moving_rotation_stiffness(const double F[3], const double v[3], int at, int n, double N[]);
/* Adds -v~ to the columns at .. at + 2 of T[3 x columns], for a vector v that rotates with a
 * node. */
void moving_rotation_gradient(const double v[3], int at, int columns, double T[]);

/* Inertia of a node with the mass of a piece of beam (J Eq. 73, with the inertia tensor corrected
 * to diag(Ip, Iy, Iz)). */

enum { LUMPED_VECTORS = 7 };

typedef struct lumped_mass {
    double mass;      /* [kg] */
    double rotary[3]; /* rotary inertia Ip, Iy, Iz about the columns of R [kg m^2] */
    double warping;   /* warping inertia [kg m^4] */
    int turns; /* 1 with rotary inertia; 0 if only the twist has inertia, which is independent of a
                  rotating frame */
    int vectors; /* number of vectors that represent the whole inertia of a section given by
                    matrices, or 0 for other sections; if the number is not 0, the members above are
                    not used */
    double vector[LUMPED_VECTORS][3],
        carried[LUMPED_VECTORS]; /* vectors fixed to R, with their masses, where the first is the
                                    centre of mass [m] and the others have the length 1 or sqrt(2)
                                  */
} lumped_mass;

/* Returns the lumped mass of `length` [m] of beam. For a section given by matrices, all entries of
 * the mass matrix are used. For other sections without FEATURE_ROTARY_INERTIA, only translations
 * and the twist (polar moment of inertia) have inertia. */
lumped_mass lumped_of(const section *c, unsigned features, double length);

/* Adds the fraction `share` of the mass to a node whose coordinates begin at `at` among n
 * coordinates. moving_complete must be called at the end. */
void lumped_add(const lumped_mass *l, double share, const node_state *x,
                const element_rotating_frame *frame, int at, int n, inertia_output *out);

/* Computes the shares of the nodes at place[nodes] of an element, which integrate the polynomial
 * through the nodes exactly: one half each for two nodes, Simpson's rule for three. */
void lumped_shares(int nodes, const double place[], double share[]);

/* Adds zeros for additional unknowns to the outputs of n nodes: [n] -> [wide], [n x n] -> [wide x
 * wide]. */
void inertia_widen(int n, int wide, inertia_output *out);
status lumped_element(const lumped_mass *whole, int nodes, const double share[],
                      const node_state x[], const element_rotating_frame *frame,
                      inertia_output *out);

/* Computes the masses j of the three unit vectors of a section with the rotary inertia diag(Ip, Iy,
 * Iz) = sum_k j_k (1 - e_k e_k^T). */
void lumped_directors(const double rotary[3], double j[3]);

#endif
