/* Inertia of a node that carries a mass, a rotary inertia fixed to its triad and a warping inertia. */
#ifndef BEAMWORK_LUMPED_H
#define BEAMWORK_LUMPED_H

/* inertia[7]: mass (3, equal) [kg], principal rotary inertias about the columns of R [kg m^2], warping [kg m^4].
 * All blocks are 3 x 3, row-major, in fixed axes. w, alpha: spatial angular velocity and acceleration, NULL: at rest. */
void lumped_rotary(const double inertia[7], const double R[9], double J[9]);                /* R diag R^T */
void lumped_convective(const double J[9], const double w[3], double h[3], double dh_dw[9]); /* h = w x J w */
/* d(J alpha + w x J w)/dtheta for the spatial increment theta of R. */
void lumped_turning(const double J[9], const double w[3], const double alpha[3], double dfdx[9]);

#endif
