/* An arc along which the triad turns steadily. */
#ifndef BEAMWORK_MATH_ARC_H
#define BEAMWORK_MATH_ARC_H

/* rotation [rad]: of the whole arc, its constant torsion and curvature times its length.  In the
 * axes at its start q = exp(x rotation~) and r = int_0^x exp(t rotation~) e dt, 0 <= x <= 1; e:
 * direction of the axis in the triad that turns with it, (1, 0, 0) but for initial strains. */
void arc_at(const double rotation[3], const double e[3], double x, double r[3], double q[4]);

#endif
