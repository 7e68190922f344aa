/* Rotations against what they mean: matrices that turn a plane, products, the shorter way of the
 * logarithm, angles near 0 and near pi. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/pi.h"
#include "elements/math/rotation.h"

static const double eps = 4 * DBL_EPSILON;
static const double axis[3] = {0.48, -0.6, 0.64}; /* of length 1 */

static double largest_difference(int n, const double a[], const double b[])
{
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

static void turn(double angle, double q[4])
{
    const double phi[3] = {angle * axis[0], angle * axis[1], angle * axis[2]};
    rotation_exp(phi, q);
}

/* Rodrigues: v cos + (axis x v) sin + axis (axis . v)(1 - cos). */
static void rodrigues(double angle, const double v[3], double out[3])
{
    double across[3];
    const double along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    vec3_cross(axis, v, across);
    for (int i = 0; i < 3; i++)
        out[i] = v[i] * cos(angle) + across[i] * sin(angle) +
                 axis[i] * along * 2 * sin(angle / 2) * sin(angle / 2);
}

static void one_angle(double angle)
{
    const double v[3] = {2.385, -1.17, 0.713};
    double q[4], R[9], again[4], phi[3], minus[4], expected[3], found[3], column[3];
    turn(angle, q);
    rodrigues(angle, v, expected);
    rotation_apply(q, v, found);
    gsl_test(!(largest_difference(3, found, expected) < 4 * eps),
             "angle %g: turns a vector as Rodrigues does", angle);
    rotation_matrix(q, R);
    for (int i = 0; i < 3; i++)
        column[i] = R[3 * i] * v[0] + R[3 * i + 1] * v[1] + R[3 * i + 2] * v[2];
    gsl_test(!(largest_difference(3, column, expected) < 4 * eps), "angle %g: so does the matrix",
             angle);
    rotation_from_matrix(R, again);
    const double side =
        again[0] * q[0] + again[1] * q[1] + again[2] * q[2] + again[3] * q[3] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        again[i] *= side;
    gsl_test(!(largest_difference(4, again, q) < 4 * eps),
             "angle %g: the matrix gives the quaternion back, or its negative", angle);

    /* The shorter way, for q and for -q, which are the same rotation. */
    const double shorter = remainder(angle, 2 * PI);
    for (int i = 0; i < 3; i++)
        expected[i] = shorter * axis[i];
    for (int i = 0; i < 4; i++)
        minus[i] = -q[i];
    const double allowed =
        fabs(fabs(shorter) - PI) < 1e-15 ? 2 * PI + 1 : 8 * eps; /* at pi both ways are as short */
    rotation_log(q, phi);
    gsl_test(!(largest_difference(3, phi, expected) < allowed), "angle %g: its vector", angle);
    rotation_log(minus, phi);
    gsl_test(!(largest_difference(3, phi, expected) < allowed),
             "angle %g: the vector of the negative", angle);
    gsl_test(!(vec3_norm(phi) <= PI * (1 + eps)), "angle %g: at most half a turn", angle);
}

static void small_angles(void)
{
    for (double angle = 1; angle > 1e-300; angle /= 7) {
        double q[4], phi[3];
        turn(angle, q);
        rotation_log(q, phi);
        for (int i = 0; i < 3; i++)
            gsl_test_rel(phi[i], angle * axis[i], 8 * eps, "angle %g: exponential and logarithm",
                         angle);
    }
}

static void products(void)
{
    const double first[3] = {0.3, -1.1, 0.7}, second[3] = {-0.9, 0.2, 1.6},
                 v[3] = {0.713, 2.385, -1.17};
    double a[4], b[4], ab[4], back[4], step[4], phi[3], one[3], two[3], both[3];
    rotation_exp(first, a);
    rotation_exp(second, b);
    rotation_compose(a, b, ab);
    rotation_apply(b, v, one);
    rotation_apply(a, one, two);
    rotation_apply(ab, v, both);
    gsl_test(!(largest_difference(3, two, both) < 4 * eps), "a o b turns by b, then by a");
    memcpy(back, a, sizeof a);
    rotation_compose(back, b, back);
    gsl_test(largest_difference(4, back, ab) > 0, "the product may take the place of a factor");
    rotation_conjugate(a, back);
    rotation_apply(back, two, both);
    gsl_test(!(largest_difference(3, both, one) < 4 * eps), "the conjugate turns back");
    rotation_between(a, b, phi);
    rotation_exp(phi, step);
    rotation_compose(step, a, ab);
    const double side = ab[0] * b[0] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        ab[i] *= side;
    gsl_test(!(largest_difference(4, ab, b) < 4 * eps),
             "the increment from a to b, in fixed axes, turns a into b");
}

static void triads(void)
{
    const double x[3] = {2, -3, 6}, y[3] = {1, 1, 1}, parallel[3] = {-4, 6, -12},
                 zero[3] = {0, 0, 0};
    double R[9], q[4], again[9];
    gsl_test_int(rotation_triad(x, y, R), 0, "a triad");
    for (int i = 0; i < 3; i++)
        gsl_test_rel(R[3 * i], x[i] / 7, eps, "its x axis");
    gsl_test(!(R[1] * y[0] + R[4] * y[1] + R[7] * y[2] > 0), "its y axis is on the side of y");
    gsl_test_abs(R[2] * y[0] + R[5] * y[1] + R[8] * y[2], 0, eps, "its z axis is across y");
    rotation_from_matrix(R, q);
    rotation_matrix(q, again);
    gsl_test(!(largest_difference(9, R, again) < 4 * eps), "it is a rotation");
    gsl_test_int(rotation_triad(x, parallel, R), -1, "no triad from parallel vectors");
    gsl_test_int(rotation_triad(zero, y, R), -1, "nor from a vector of length zero");
}

int main(void)
{
    for (double angle = -2 * PI; angle < 2 * PI + 0.1; angle += PI / 16)
        one_angle(angle);
    one_angle(PI - 1e-9);
    one_angle(PI + 1e-9);
    small_angles();
    products();
    triads();
    return gsl_test_summary();
}
