/* Masses carried by vectors y(x) of an element's coordinates: points, and unit vectors fixed to
 * sections, whose mass is then a rotary inertia.  Kinetic energy 1/2 mass |dy/dt|^2; in a frame
 * that turns steadily dy/dt = T x' + Omega x y with T = dy/dx, hence the centrifugal potential -1/2
 * mass |Omega x y|^2 and the gyroscopic matrix 2 mass T^T Omega~ T. In time the motion takes T^T
 * mass (T x'' + y_c) with y_c = x' . d2y/dx2 . x', the acceleration that x'' = 0 leaves. */
#ifndef BEAMWORK_MOVING_H
#define BEAMWORK_MOVING_H

#include "elements/element.h"

typedef struct moving_vector {
    double mass; /* [kg], or [kg m^2] of a unit vector */
    double y[3]; /* from a point of the axis [m], or a unit vector; read only where a frame turns */
    int at, columns; /* the coordinates that move it: at .. at + columns - 1 */
    const double *T; /* [3 x columns] dy/dx, row-major */
    /* In time. */
    double convective[3];       /* y_c */
    const double *rates;        /* [3 x columns] dy_c/dx'; where C is wanted */
    const double *displacement; /* [3 x columns] of d(T x'' + y_c)/dx; where K is wanted */
} moving_vector;

/* In time: how a node turns. */
typedef struct moving_turn {
    double w[3], wd[3]; /* angular velocity and its derivative, spatial */
} moving_turn;
void moving_turn_of(const inertia_output *, int at, moving_turn *);
/* What a vector f fixed to a node adds to convective[3], and NULL: not wanted, to rates and
 * displacement [3 x columns] in the columns of its rotations, at .. at + 2. */
void moving_fixed(const moving_turn *, const double f[3], int at, int columns, double convective[3],
                  double rates[], double displacement[]);

/* Zeroes what is wanted; n coordinates. */
void moving_clear(int n, inertia_output *out);
/* Adds a mass, but for the second derivatives of y, which are the caller's: moving_stiffness -=
 * F . d2y/dx2 with F[3] the centrifugal force, in time that of inertia, else zero. Of M, N and G
 * the upper half counts until moving_complete. */
void moving_add(const moving_vector *v, const element_rotating_frame *frame, int n,
                inertia_output *out, double F[3]);
/* A moment of inertia about axes n of nodes that turn: kinetic energy 1/2 mass (row . x')^2, whose
 * row has weight n at the rotations of each node, at .. at + 2, and the gradient of a strain. */
typedef struct moving_twist {
    double mass;       /* [kg m^2] */
    const double *row; /* [n] */
    int nodes, at[2];
    double weight[2], axis[2][3];
    double curvature;    /* x' . d2/dx2 . x' of the strain */
    const double *slope; /* [n] half its derivative by x'; NULL: there is no strain */
} moving_twist;
/* In time: taken and C, but not M. */
void moving_add_twist(const moving_twist *, int n, inertia_output *out);
/* Lower halves from the upper ones; once, behind everything that is added. */
void moving_complete(int n, inertia_output *out);
/* 1: forces of a motion in time are wanted. */
static inline int moving_in_time(const element_rotating_frame *frame, const inertia_output *out)
{
    return frame == NULL && out->rate != NULL;
}
/* Where second derivatives of y count: N in a frame, K in time; NULL: they are not wanted. */
static inline double *moving_stiffness(const element_rotating_frame *frame,
                                       const inertia_output *out)
{
    if (frame != NULL)
        return out->N;
    return out->rate != NULL ? out->K : NULL;
}
/* N -= F . d2v/dtheta2 of a vector v fixed to the node whose rotations begin at coordinate `at`
 * (exponential chart). */
void moving_rotation_stiffness(const double F[3], const double v[3], int at, int n, double N[]);
/* T[3 x columns] += -v~ in columns at .. at + 2: a vector v fixed to a node turns with it. */
void moving_rotation_gradient(const double v[3], int at, int columns, double T[]);

#endif
