/* How the relative motion of a step (cayley.h) changes with dr, c, da of the nodes, in closed form.
 */
#ifndef BEAMWORK_CAYLEY_SLOPES_H
#define BEAMWORK_CAYLEY_SLOPES_H

#include "harness/time/cayley.h"

/* d phi_j = own_j dc_j + common_j dc, d z_j likewise, with c the mean; spin dc: of G. */
typedef struct cayley_slopes {
    double kappa[3], b[3], spin[9];
    double own[ELEMENT_MAX_NODES][9], common[ELEMENT_MAX_NODES][9];
    double z_own[ELEMENT_MAX_NODES][3], z_common[ELEMENT_MAX_NODES][3];
} cayley_slopes;
void cayley_slopes_of(const cayley_step *, cayley_slopes *);

/* out += weight A Y: A[rows x 7 nodes] by the spatial increments of x(s) becomes by dr, c, da. */
void cayley_slopes_columns(const cayley_step *, const cayley_slopes *, const cayley_point *,
                           double weight, int rows, const double A[], double out[]);
/* K[7 nodes x 7 nodes] += derivative of cayley_forces at fixed f[7 nodes]. */
void cayley_slopes_forces(const cayley_step *, const cayley_slopes *, const double f[], double K[]);

#endif
