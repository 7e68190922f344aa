/* Rotations by Wiener-Milenkovic parameters x = 4 tan(angle/4) about the axis (Rodrigues' modified
 * vectors): regular up to a full turn, and rational. R^T y and the curvature kappa of a line on
 * which x varies with slope x' are of one kind, w . R^T y = B(w, y; x),  w . kappa = B(w, x'; x),
 *   B(w, y; x) = s w . y - p x . (y x w) + q [(x . w)(x . y) - t w . y],  s, p, q functions of t =
 * |x|^2. */
#ifndef BEAMWORK_EXACT_MILENKOVIC_H
#define BEAMWORK_EXACT_MILENKOVIC_H

#include "elements/math/vec3.h"

/* s, p, q, each with its first and second derivative. */
typedef struct exact_milenkovic_form {
    real s[3], p[3], q[3];
} exact_milenkovic_form;

static inline void exact_milenkovic_forms(real t, exact_milenkovic_form *orientation,
                                          exact_milenkovic_form *curvature)
{
    /* u = cos^2(angle/4); u' = -u^2/16 */
    const real u = 16 / (16 + t), u2 = u * u, u3 = u2 * u;
    const real first[2] = {u2 * (-1.0 / 16), u3 * (-1.0 / 8)},
               second[2] = {u3 * (1.0 / 128), u2 * u2 * (3.0 / 128)};
    *orientation = (exact_milenkovic_form){
        .s = {real_of(1), real_of(0), real_of(0)},
        .p = {2 * u2 - u, 2 * first[1] - first[0], 2 * second[1] - second[0]},
        .q = {u2 * 0.5, first[1] * 0.5, second[1] * 0.5},
    };
    *curvature = (exact_milenkovic_form){
        .s = {u, first[0], second[0]},
        .p = {u2 * 0.5, first[1] * 0.5, second[1] * 0.5},
        .q = {u2 * 0.125, first[1] * 0.125, second[1] * 0.125},
    };
}

/* B for w along each axis: the vector itself [3]. */
static inline void exact_milenkovic_vector(const exact_milenkovic_form *f, const real x[3],
                                           const real y[3], real out[3])
{
    real once[3], twice[3];
    vec3_cross(x, y, once);
    vec3_cross(x, once, twice);
    for (int i = 0; i < 3; i++)
        out[i] = f->s[0] * y[i] - f->p[0] * once[i] + f->q[0] * twice[i];
}

/* Gradients of the vector with respect to x and y: rows are its components. */
static inline void exact_milenkovic_gradients(const exact_milenkovic_form *f, const real x[3],
                                              const real y[3], real dx[9], real dy[9])
{
    const real t = vec3_dot(x, x), xy = vec3_dot(x, y), p = f->p[0], q = f->q[0];
    const real level = f->s[0] - q * t, bent = q * xy;
    real once[3], along[3];
    vec3_cross(x, y, once);
    for (int i = 0; i < 3; i++)
        along[i] =
            2 * (f->s[1] * y[i] - f->p[1] * once[i] + f->q[1] * (x[i] * xy - t * y[i]) - q * y[i]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            dx[3 * i + j] = along[i] * x[j] + q * (x[i] * y[j]);
            dy[3 * i + j] = q * (x[i] * x[j]);
        }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        dx[4 * i] += bent;
        dy[4 * i] += level;
        dx[3 * i + j] -= p * y[k];
        dx[3 * i + k] += p * y[j];
        dy[3 * i + j] += p * x[k];
        dy[3 * i + k] -= p * x[j];
    }
}

/* XX += d2B/dx2, XY = d2B/dx dy (rows x). */
static inline void exact_milenkovic_add_hessian(const exact_milenkovic_form *f, const real x[3],
                                                const real w[3], const real y[3], real XX[9],
                                                real XY[9])
{
    real yw[3], wx[3], slope[3], across[3];
    vec3_cross(y, w, yw);
    vec3_cross(w, x, wx);
    const real t = vec3_dot(x, x), wy = vec3_dot(w, y), xw = vec3_dot(x, w), xy = vec3_dot(x, y),
               p = f->p[0], q = f->q[0];
    const real once = vec3_dot(x, yw), twice = xw * xy - t * wy;
    const real level = 2 * (f->s[1] * wy - f->p[1] * once + f->q[1] * twice - q * wy);
    const real bent = 4 * (f->s[2] * wy - f->p[2] * once + f->q[2] * twice);
    const real turn = f->s[1] - f->q[1] * t - q, along = f->q[1] * xw;
    for (int i = 0; i < 3; i++) { /* slope: what meets 2 x, the gradient of t */
        slope[i] = 2 * (f->q[1] * (w[i] * xy + y[i] * xw - 2 * x[i] * wy) - f->p[1] * yw[i]) +
                   (0.5 * bent) * x[i];
        across[i] = 2 * (turn * w[i] - f->p[1] * wx[i] + along * x[i]);
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            XX[3 * i + j] += slope[i] * x[j] + x[i] * slope[j] + q * (w[i] * y[j] + y[i] * w[j]);
            XY[3 * i + j] = x[i] * across[j] + q * (w[i] * x[j]);
        }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        XX[4 * i] += level;
        XY[4 * i] += q * xw;
        XY[3 * i + j] -= p * w[k]; /* w~ transposed */
        XY[3 * i + k] += p * w[j];
    }
}

#endif
