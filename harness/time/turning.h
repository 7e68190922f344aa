/* Rotation vectors that belong to a turn of a frame between two instants, and their rates: with
 * R = R_n exp(t~), body rates W of R'(t) = R W~ and t' are
 *   W = Jr(t) t',  Jr(t) = 1 - (1 - cos |t|)/|t|^2 t~ + (|t| - sin |t|)/|t|^3 t~ t~.
 * 3 x 3 matrices are row-major. */
#ifndef BEAMWORK_TURNING_H
#define BEAMWORK_TURNING_H

void turning_jacobian(const double t[3], double Jr[9]);
/* Its inverse 1 + t~/2 + (1 - |t|/2 cot(|t|/2))/|t|^2 t~ t~; |t| < 2 pi. */
void turning_inverse(const double t[3], double inverse[9]);
/* d(Jr(t) y)/dt at fixed y. */
void turning_derivative(const double t[3], const double y[3], double D[9]);
/* t becomes the vector of exp(t~) exp(d~). */
void turning_add(double t[3], const double d[3]);

#endif
