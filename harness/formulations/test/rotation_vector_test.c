/* The error of interpolated total rotation vectors must be that of the derivation in
 * elements/examples/rotation_vector.c, within 1e-3, for rotations up to 5 rad. */
#define beamwork_element rotation_vector
#include "elements/examples/rotation_vector.c"
#undef beamwork_element

#include <gsl/gsl_test.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

static void rotation(const double vector[3], double R[9])
{
    double q[4];
    rotation_exp(vector, q);
    rotation_matrix(q, R);
}

/* Computes the strains per length of a beam along x whose nodes rotate by -d/2 and d/2 about z, and
 * which is then rotated by s about y as a whole, in steps. */
static void strains_of(double d, double s, double g[3])
{
    enum { STEPS = 20 };
    const element_data of = {.length = 1};
    double history[VALUES], e[STRAINS];
    node_state x[2] = {{.R = {1, 0, 0, 0, 1, 0, 0, 0, 1}}, {.R = {1, 0, 0, 0, 1, 0, 0, 0, 1}}};
    begin(&of, x, history);
    for (int step = 0; step <= STEPS; step++) {
        const double whole[3] = {0, s * step / STEPS, 0}, ahead[3] = {1, 0, 0};
        double turn[9], own[9];
        rotation(whole, turn);
        for (int k = 0; k < 2; k++) {
            const double bend[3] = {0, 0, k ? d / 2 : -d / 2};
            rotation(bend, own);
            mat3_mul(turn, own, x[k].R);
        }
        mat3_mul_vec(turn, ahead, x[1].r);
        strain(&of, x, &(strain_output){.e = e, .history = history});
        commit(&of, x, history);
    }
    memcpy(g, e, 3 * sizeof *g);
}

static void check(double s)
{
    static const double d[] = {0.02, 0.01};
    const double part = -(s - sin(s)) / (1 - cos(s)) / 16;
    double error[2];
    for (int k = 0; k < 2; k++) {
        double g[3];
        strains_of(d[k], s, g);
        error[k] = g[2] / (d[k] * d[k]) / part - 1;
    }
    gsl_test(!(fabs(error[1]) < 1e-3), "rotation by %g: the strain differs from the estimate by %g",
             s, error[1]);
    gsl_test(!(fabs(error[1] / error[0]) < 0.3 || fabs(error[0]) < 1e-6),
             "rotation by %g: the difference from the estimate is of second order (%g, %g)", s,
             error[0], error[1]);
}

int main(void)
{
    static const double size[] = {0.1, 1, 2, 3, 4, 5};
    for (size_t k = 0; k < sizeof size / sizeof size[0]; k++)
        check(size[k]);
    return gsl_test_summary();
}
