/* The screw displacement that takes node p and its triad to node q.
 * With R half way between the triads of the nodes, D the chord in its axes, psi the rotation vector
 * and a = psi/2, the translation along the way in axes that turn on it is
 *   U = V^-1 D,  V = int from -1/2 to 1/2 of exp(x psi~) dx,  V^-1 = mu + nu a a^T,
 *   mu = |a|/sin |a|,  nu = (1 - mu)/|a|^2. */
#ifndef BEAMWORK_BEAMW_SCREW_H
#define BEAMWORK_BEAMW_SCREW_H

#include "elements/element.h"

/* mu, nu, tau = tan(|a|/2)/|a| and their derivatives with respect to |a|^2. */
typedef struct screw_factors {
    double mu[2], nu[3], tau[2];
} screw_factors;

typedef struct screw {
    double R[9]; /* triad of the middle */
    double D[3], a[3];
    double U[3];      /* less l0 along x */
    double extension; /* D_x - l0 [m] */
    double along;     /* a . D */
    double T[9];      /* dU/dpsi; dU/dD is V^-1 */
    double V[9];      /* V^-1 */
    screw_factors f;
} screw;

/* l0 [m]: length at rest; x[2]: states of the nodes. */
screw beamw_screw(double l0, const node_state x[2]);

#endif
