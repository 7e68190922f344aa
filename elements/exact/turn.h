/* Rotation vectors psi: R^T y and the curvature kappa = psi' - a psi x psi' + b psi x (psi x psi') of a line on which psi varies,
 * with derivatives.  Both are of one kind,
 *   x . R^T y = B(c, a; x, y),  x . kappa = B(a, b; x, psi'),
 *   B(p, q; x, y) = x . y - p psi . (y x x) + q [(psi . x)(psi . y) - t x . y],  t = |psi|^2,
 *   c = sin(angle)/angle, a = (1 - cos)/angle^2, b = (angle - sin)/angle^3. */
#ifndef BEAMWORK_EXACT_TURN_H
#define BEAMWORK_EXACT_TURN_H

/* A function of t with its first and second derivative. */
typedef struct turn_functions {
    double c[3], a[3], b[3];
} turn_functions;

void turn_functions_at(double t, turn_functions *out);

/* B for x along each axis: the vector itself [3]. */
void turn_vector(const double psi[3], double p, double q, const double y[3], double out[3]);

/* Gradients of B with respect to psi and y. */
void turn_gradient(const double psi[3], const double p[3], const double q[3], const double x[3], const double y[3], double d_psi[3],
                   double d_y[3]);

/* PP += d2B/dpsi2, PY += d2B/dpsi dy (rows psi). */
void turn_add_hessian(const double psi[3], const double p[3], const double q[3], const double x[3], const double y[3], double PP[9],
                      double PY[9]);

#endif
