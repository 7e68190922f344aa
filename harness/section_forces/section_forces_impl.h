#ifndef BEAMWORK_SECTION_FORCES_IMPL_H
#define BEAMWORK_SECTION_FORCES_IMPL_H

#include "harness/section_forces/section_forces.h"

/* Solves x = g(x) with Anderson mixing, which may converge even if plain iteration diverges. */

enum { FIXED_POINT_MAX = 160 };

/* Computes out = g(x) for x[n]. Returns 0, or 1 if g(x) cannot be evaluated. */
typedef int (*fixed_point_map)(void *context, const double x[], double out[]);

/* Non-uniform torsion between two sections whose bimoments and warping amplitudes are known. The
 * equations are EIw a' = B, B' = -M_w, M_s = K k + M_w, k = a + F_w M_w + f. M_s is the torque
 * about the shear centre, k the twist rate, a the warping amplitude, B the bimoment, and M_w the
 * torque due to restrained warping. K is the torsional stiffness, F_w the flexibility of warping in
 * shear, and f the contribution of transverse forces. */

typedef struct span_torsion {
    double EIw;                         /* 0: the section does not warp */
    double flexibility;                 /* F_w */
    double bimoment[2], amplitude[2];   /* values at p and q */
    double torque[SPAN_GRID_POINTS];    /* M_s */
    double stiffness[SPAN_GRID_POINTS]; /* K */
    double shear[SPAN_GRID_POINTS];     /* f */
} span_torsion;

typedef struct span_twist {
    double rate[SPAN_GRID_POINTS], bimoment[SPAN_GRID_POINTS],
        warping[SPAN_GRID_POINTS]; /* k, B, M_w */
} span_twist;

/* Computes share[SPAN_GRID_POINTS], the weights of the grid points in the value at x. */
void span_grid_at(const span_grid *g, double x, double share[]);
/* Computes the integral of component k from 0 to x[i]: out[i][k]. values, out: [points x count],
 * row-major. */
void span_grid_integrate(const span_grid *g, int count, const double values[], double out[]);
/* Solves the equation, starting from x[n] with n <= FIXED_POINT_MAX. Stops when no entry changes by
 * more than `enough`, when a change is not finite, or after 100 evaluations of the map. x becomes
 * the value of the map with the smallest largest change of an entry. Returns this change; INFINITY:
 * the map failed, or no change was finite. */
double fixed_point_find(int n, fixed_point_map map, void *context, double enough, double x[]);

#endif
