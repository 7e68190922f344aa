/* Masses carried by vectors y(x) of an element's coordinates: points, and unit vectors fixed to
 * sections, whose mass is then a rotary inertia.  Kinetic energy 1/2 mass |dy/dt|^2; in a frame
 * that turns steadily dy/dt = T x' + Omega x y with T = dy/dx, hence the centrifugal potential -1/2
 * mass |Omega x y|^2 and the gyroscopic matrix 2 mass T^T Omega~ T. */
#ifndef BEAMWORK_MOVING_H
#define BEAMWORK_MOVING_H

#include "elements/element.h"

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
/* Lower halves from the upper ones; once, behind everything that is added. */
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

#endif
