/* Richardson extrapolation: what the values f of three meshes of n elements say of f + c n^-p. */
#ifndef BEAMWORK_RICHARDSON_H
#define BEAMWORK_RICHARDSON_H

/* Order from three values by bisection, at most bisected_order; NAN where the changes fit none. */
double richardson_order(const double n[3], const double f[3]);
/* Richardson's limit from the last two of three values. */
double richardson_limit(const double n[3], const double f[3], double p);
/* Change of the extrapolated limit per change of the values: root of the sum of squares. */
double richardson_amplification(const double n[3], const double f[3], double p);

#endif
