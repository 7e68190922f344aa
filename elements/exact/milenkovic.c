#include "elements/exact/milenkovic.h"

#include "elements/math/dense.h"

void exact_milenkovic_forms(double t, exact_milenkovic_form *orientation,
                            exact_milenkovic_form *curvature)
{
    /* u = cos^2(angle/4); u' = -u^2/16 */
    const double u = 16 / (16 + t), u2 = u * u, first[2] = {-u2 / 16, -u2 * u / 8},
                 second[2] = {u2 * u / 128, 3 * u2 * u2 / 128};
    *orientation = (exact_milenkovic_form){
        .s = {1, 0, 0},
        .p = {2 * u2 - u, 2 * first[1] - first[0], 2 * second[1] - second[0]},
        .q = {u2 / 2, first[1] / 2, second[1] / 2},
    };
    *curvature = (exact_milenkovic_form){
        .s = {u, first[0], second[0]},
        .p = {u2 / 2, first[1] / 2, second[1] / 2},
        .q = {u2 / 8, first[1] / 8, second[1] / 8},
    };
}

void exact_milenkovic_vector(const exact_milenkovic_form *f, const double x[3], const double y[3],
                             double out[3])
{
    double once[3], twice[3];
    vec3_cross(x, y, once);
    vec3_cross(x, once, twice);
    for (int i = 0; i < 3; i++)
        out[i] = f->s[0] * y[i] - f->p[0] * once[i] + f->q[0] * twice[i];
}

void exact_milenkovic_gradient(const exact_milenkovic_form *f, const double x[3], const double w[3],
                               const double y[3], double dx[3], double dy[3])
{
    double yw[3], wx[3];
    vec3_cross(y, w, yw);
    vec3_cross(w, x, wx);
    const double t = vec3_dot(x, x), wy = vec3_dot(w, y), xw = vec3_dot(x, w), xy = vec3_dot(x, y);
    const double along = 2 * (f->s[1] * wy - f->p[1] * vec3_dot(x, yw) +
                              f->q[1] * (xw * xy - t * wy) - f->q[0] * wy);
    for (int i = 0; i < 3; i++) {
        dx[i] = along * x[i] - f->p[0] * yw[i] + f->q[0] * (w[i] * xy + y[i] * xw);
        dy[i] = (f->s[0] - f->q[0] * t) * w[i] - f->p[0] * wx[i] + f->q[0] * xw * x[i];
    }
}

void exact_milenkovic_add_hessian(const exact_milenkovic_form *f, const double x[3],
                                  const double w[3], const double y[3], double XX[9], double XY[9])
{
    double yw[3], wx[3], slope[3];
    vec3_cross(y, w, yw);
    vec3_cross(w, x, wx);
    const double t = vec3_dot(x, x), wy = vec3_dot(w, y), xw = vec3_dot(x, w), xy = vec3_dot(x, y);
    const double once = vec3_dot(x, yw), twice = xw * xy - t * wy;
    const double level = 2 * (f->s[1] * wy - f->p[1] * once + f->q[1] * twice - f->q[0] * wy);
    const double bent = 4 * (f->s[2] * wy - f->p[2] * once + f->q[2] * twice);
    const double cross[9] = {0, w[2], -w[1], -w[2], 0, w[0], w[1], -w[0], 0}; /* w~ transposed */
    for (int i = 0; i < 3; i++) /* what meets 2 x, the gradient of t */
        slope[i] = 2 * (f->q[1] * (w[i] * xy + y[i] * xw - 2 * x[i] * wy) - f->p[1] * yw[i]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            XX[3 * i + j] += bent * x[i] * x[j] + slope[i] * x[j] + x[i] * slope[j] +
                             f->q[0] * (w[i] * y[j] + y[i] * w[j]) + (i == j ? level : 0);
            XY[3 * i + j] += 2 * x[i] *
                                 ((f->s[1] - f->q[1] * t - f->q[0]) * w[j] - f->p[1] * wx[j] +
                                  f->q[1] * xw * x[j]) -
                             f->p[0] * cross[3 * i + j] +
                             f->q[0] * (w[i] * x[j] + (i == j ? xw : 0));
        }
}
