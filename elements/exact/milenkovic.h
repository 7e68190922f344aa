/* Rotations by Wiener-Milenkovic parameters x = 4 tan(angle/4) about the axis (Rodrigues' modified
 * vectors): regular up to a full turn, and rational. R^T y and the curvature kappa of a line on
 * which x varies with slope x' are of one kind, w . R^T y = B(w, y; x),  w . kappa = B(w, x'; x),
 *   B(w, y; x) = s w . y - p x . (y x w) + q [(x . w)(x . y) - t w . y],  s, p, q functions of t =
 * |x|^2. */
#ifndef BEAMWORK_EXACT_MILENKOVIC_H
#define BEAMWORK_EXACT_MILENKOVIC_H

/* s, p, q, each with its first and second derivative. */
typedef struct exact_milenkovic_form {
    double s[3], p[3], q[3];
} exact_milenkovic_form;

void exact_milenkovic_forms(double t, exact_milenkovic_form *orientation,
                            exact_milenkovic_form *curvature);

/* B for w along each axis: the vector itself [3]. */
void exact_milenkovic_vector(const exact_milenkovic_form *f, const double x[3], const double y[3],
                             double out[3]);

/* Gradients of B with respect to x and y. */
void exact_milenkovic_gradient(const exact_milenkovic_form *f, const double x[3], const double w[3],
                               const double y[3], double dx[3], double dy[3]);

/* XX += d2B/dx2, XY += d2B/dx dy (rows x). */
void exact_milenkovic_add_hessian(const exact_milenkovic_form *f, const double x[3],
                                  const double w[3], const double y[3], double XX[9], double XY[9]);

#endif
