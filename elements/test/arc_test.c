/* Points along an arc of constant curvature, beside the integral of its tangent: the deflections
 * across it have all their digits, however flat or wound it is. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>

#include "elements/math/arc.h"
#include "elements/math/dense.h"
#include "elements/math/quadrature.h"
#include "elements/math/rotation.h"

enum { POINTS = 16 };

/* r = int exp(turn s) e ds from 0 to x: r less x e, from what a turn adds to e, so that nothing
 * cancels. The integrand is (sin w)/w t x e + (1 - cos w)/w^2 t x (t x e), t = turn s. */
static void integrate(const double turn[3], const double e[3], double x, double across[3])
{
    double at[POINTS], weight[POINTS];
    quadrature_points(POINTS, at, weight);
    across[0] = across[1] = across[2] = 0;
    for (int i = 0; i < POINTS; i++) {
        const double s = x * at[i], part[3] = {turn[0] * s, turn[1] * s, turn[2] * s},
                     w = vec3_norm(part), half = sin(w / 2);
        double once[3], twice[3];
        vec3_cross(part, e, once);
        vec3_cross(part, once, twice);
        for (int k = 0; k < 3; k++)
            across[k] += x * weight[i] *
                         (w > 0 ? sin(w) / w * once[k] + 2 * half * half / (w * w) * twice[k] : 0);
    }
}

static void compare(double angle, double x)
{
    static const double direction[][3] = {{0, 0, 1}, {0, 1, 0}, {0.6, 0, 0.8}, {0, 0.6, -0.8}},
                        e[] = {1.01, 0, 0}, sheared[] = {0.98, 0.03, -0.02};
    for (int i = 0; i < 4; i++)
        for (int shear = 0; shear < 2; shear++) {
            const double *along = shear ? sheared : e;
            double turn[3], r[3], q[4], exact[3], right[4], worst = 0, turned = 0;
            for (int k = 0; k < 3; k++)
                turn[k] = angle * direction[i][k];
            arc_at(turn, along, x, r, q);
            integrate(turn, along, x, exact);
            const double size = vec3_norm(exact), digits = 1e-15 * x * 2;
            for (int k = 0; k < 3; k++)
                worst = fmax(worst, fabs(r[k] - x * along[k] - exact[k]));
            gsl_test(!(worst <= 2e-12 * size + digits), "%g rad, at %g: off by %.1e of %.1e", angle,
                     x, worst, size);
            const double part[3] = {turn[0] * x, turn[1] * x, turn[2] * x};
            rotation_exp(part, right);
            for (int k = 0; k < 4; k++)
                turned = fmax(turned, fabs(q[k] - right[k]));
            gsl_test(!(turned < 1e-15), "%g rad, at %g: orientation off by %.1e", angle, x, turned);
        }
}

int main(void)
{
    static const double angle[] = {0,   1e-12, 1e-8, 1e-6, 9e-5, 1.1e-4, 1e-3, 0.01,
                                   0.1, 0.25,  0.29, 0.31, 0.5,  1,      2,    3},
                        x[] = {0.1, 0.5, 1};
    for (size_t i = 0; i < sizeof angle / sizeof angle[0]; i++)
        for (int k = 0; k < 3; k++)
            compare(angle[i], x[k]);
    return gsl_test_summary();
}
