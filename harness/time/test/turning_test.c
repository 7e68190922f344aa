/* The tangent operator of turns, its inverse and its derivative, against differences of the
 * rotations themselves: on both sides of where series take over. */
#include "harness/time/time_impl.h"

#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "elements/test/worst.h"

static const double along[3] = {0.48, -0.6, 0.64}, other[3] = {0.7, 0.4, -0.9}, step = 1e-4;

/* Vector of exp(-t~) exp(s~). */
static void between(const double t[3], const double s[3], double out[3])
{
    double p[4], q[4], back[4];
    rotation_exp(t, p);
    rotation_exp(s, q);
    rotation_conjugate(p, back);
    rotation_compose(back, q, q);
    rotation_log(q, out);
}

/* What f(t + x d) is over x at 0, of fourth order: out[3]. */
static void differ(void (*f)(const double t[3], double out[3]), const double t[3],
                   const double d[3], double out[3])
{
    static const double at[4] = {-2, -1, 1, 2}, weight[4] = {1, -8, 8, -1};
    memset(out, 0, 3 * sizeof *out);
    for (int k = 0; k < 4; k++) {
        double moved[3], value[3];
        for (int i = 0; i < 3; i++)
            moved[i] = t[i] + at[k] * step * d[i];
        f(moved, value);
        for (int i = 0; i < 3; i++)
            out[i] += weight[k] * value[i] / (12 * step);
    }
}

static double begin[3];

static void turned(const double t[3], double out[3])
{
    between(begin, t, out);
}

static void rates(const double t[3], double out[3])
{
    double Jr[9];
    turning_jacobian(t, Jr);
    mat3_mul_vec(Jr, other, out);
}

static void check(const char *what, double angle, const double found[3], const double expected[3])
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = worst_of(largest, fabs(found[i] - expected[i]));
    gsl_test(!(largest < 1e-10), "%s at %g rad: %g", what, angle, largest);
}

static void turn(double angle)
{
    double Jr[9], inverse[9], D[9], found[3], expected[3], back[3];
    for (int i = 0; i < 3; i++)
        begin[i] = angle * along[i];
    turning_jacobian(begin, Jr);
    mat3_mul_vec(Jr, other, found);
    differ(turned, begin, other, expected);
    check("angular velocity", angle, found, expected);
    turning_inverse(begin, inverse);
    mat3_mul_vec(inverse, found, back);
    check("inverse", angle, back, other);
    turning_derivative(begin, other, D);
    for (int k = 0; k < 3; k++) {
        const double axis[3] = {k == 0, k == 1, k == 2};
        mat3_mul_vec(D, axis, found);
        differ(rates, begin, axis, expected);
        check("derivative", angle, found, expected);
    }
    memcpy(found, begin, sizeof found);
    turning_add(found, other);
    between(begin, found, back);
    check("one turn behind another", angle, back, other);
}

/* Where series take over they are exact to rounding: nothing jumps there. */
static void seam(double angle)
{
    static const char *const what[] = {"Jr", "its inverse", "its derivative"};
    double value[2][3][9], t[3];
    for (int side = 0; side < 2; side++) {
        for (int i = 0; i < 3; i++)
            t[i] = angle * (side ? 1 + 1e-14 : 1 - 1e-14) * along[i];
        turning_jacobian(t, value[side][0]);
        turning_inverse(t, value[side][1]);
        turning_derivative(t, other, value[side][2]);
    }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 9; i++)
            gsl_test_abs(value[1][k][i], value[0][k][i], 2e-15, "%s at %g rad, entry %d", what[k],
                         angle, i);
}

int main(void)
{
    static const double angle[] = {0, 1e-3, 0.02, 0.0499, 0.0501, 0.4, 1.3, 1.9};
    for (int i = 0; i < (int)(sizeof angle / sizeof angle[0]); i++)
        turn(angle[i]);
    seam(0.05);
    return gsl_test_summary();
}
