/* Node states moved by increments, as the derivatives of element.h mean it: positions and warping
 * amplitudes added, rotations R <- exp(dphi~) R. */
#ifndef BEAMWORK_CHART_H
#define BEAMWORK_CHART_H

#include "elements/element.h"

/* out = x moved by step[7 nodes] (dr [m], dphi [rad], da [rad/m] of each node). */
void chart_move(const node_state x[], int nodes, const double step[], node_state out[]);

/* The size of a small step of coordinate c that means the same for beams of every length [m, rad,
 * rad/m]. */
double chart_unit(int c, double length);

/* d(exp(psi)) exp(-psi) = dexp(psi) dpsi: spatial increment of a rotation vector's rotation, row
 * major; and its inverse, |psi| < 2 pi. */
void chart_dexp(const double psi[3], double T[9]);
void chart_dexp_inverse(const double psi[3], double T[9]);

#endif
