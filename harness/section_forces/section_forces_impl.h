/* The inside of section_forces/. */
#ifndef BEAMWORK_SECTION_FORCES_IMPL_H
#define BEAMWORK_SECTION_FORCES_IMPL_H

#include "harness/section_forces/section_forces.h"

/* x = g(x) by Anderson's mixing: iterations that a plain repetition would let grow converge too. */

enum { FIXED_POINT_MAX = 160 };

/* out = g(x), [n] each; 0, or 1 where it cannot be evaluated. */
typedef int (*fixed_point_map)(void *context, const double x[], double out[]);

/* From the start in x[n], n <= FIXED_POINT_MAX.  Ends where no entry moves by more than `enough`,
 * or where that no longer falls; returns the largest last move; INFINITY where the map failed. */
double fixed_point_find(int n, fixed_point_map map, void *context, double enough, double x[]);

/* Non-uniform torsion between two sections whose bimoments and warping amplitudes are known.
 *
 *   EIw a' = B, B' = -M_w, M_s = K k + M_w, k = a + F_w M_w + f:
 * torque M_s about the shear centre, twist rate k, amplitude a, M_w the part of the restrained
 * warping, K what the twist meets, F_w the flexibility of warping in shear, f what transverse
 * forces add to it.  Of the four values at the ends two decide: the solution with (B_p, a_q) near p
 * passes into the one with (a_p, B_q) near q, each well posed for any K >= 0. */

typedef struct span_torsion {
    double EIw;                         /* 0: nothing warps */
    double flexibility;                 /* F_w */
    double bimoment[2], amplitude[2];   /* at p, q */
    double torque[SPAN_GRID_POINTS];    /* M_s */
    double stiffness[SPAN_GRID_POINTS]; /* K */
    double shear[SPAN_GRID_POINTS];     /* f */
} span_torsion;

typedef struct span_twist {
    double rate[SPAN_GRID_POINTS], bimoment[SPAN_GRID_POINTS],
        warping[SPAN_GRID_POINTS]; /* k, B, M_w */
} span_twist;

/* Over [0, 1] in units of the length. 0, or 1 where the equations are singular. */
int span_twist_solve(const span_grid *g, const span_torsion *t, span_twist *out);

#endif
