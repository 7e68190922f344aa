/* Loads along an element that computes the motion of its sections itself (element_type.line). A
 * load acts at r + R arm, where r is the position of the section and R are its axes. Its
 * generalised forces are P^T f + T^T m, where m contains the moment of f about r. */
#include "harness/newton/newton_impl.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/vec3.h"

enum { N = ELEMENT_MAX_COORDINATES };

static void times_cross(const double A[9], const double x[3], double out[9])
{
    const double X[9] = {0, -x[2], x[1], x[2], 0, -x[0], -x[1], x[0], 0};
    mat3_mul(A, X, out);
}

/* Computes force and moment in global axes at the point, and the derivatives df and dm [3 x 3] of
 * both with respect to rotations of the section. */
static void place_load(const field_load *load, line_output *at, double df[9], double dm[9])
{
    static const double minus[9] = {-1, 0, 0, 0, -1, 0, 0, 0, -1};
    double arm[3], moment[3];
    mat3_mul_vec(at->R, load->arm, arm);
    memcpy(at->force, load->force, sizeof at->force);
    memcpy(at->moment, load->moment, sizeof at->moment);
    memset(df, 0, 9 * sizeof *df);
    if (load->follower) {
        mat3_mul_vec(at->R, load->force, at->force);
        mat3_mul_vec(at->R, load->moment, at->moment);
        times_cross(minus, at->force, df);
    }
    vec3_cross(arm, at->force, moment);
    for (int i = 0; i < 3; i++)
        at->moment[i] += moment[i];
    if (load->follower) {
        times_cross(minus, at->moment, dm);
        return;
    }
    const double *f = at->force, F[9] = {0, -f[2], f[1], f[2], 0, -f[0], -f[1], f[0], 0};
    times_cross(F, arm, dm); /* (d x arm) x f = f~ arm~ d */
}

/* Subtracts H + (P^T df + T^T dm) T from K. */
static void subtract_stiffness(int n, const line_output *at, const double df[9], const double dm[9],
                               double K[])
{
    double by[3 * N];
    for (int i = 0; i < n * n; i++)
        K[i] -= at->H[i];
    dense_mul(3, 3, n, df, at->T, by);
    for (int i = 0; i < 3 * n; i++)
        by[i] = -by[i];
    dense_add_transpose_mul(n, 3, n, at->P, by, K);
    dense_mul(3, 3, n, dm, at->T, by);
    for (int i = 0; i < 3 * n; i++)
        by[i] = -by[i];
    dense_add_transpose_mul(n, 3, n, at->T, by, K);
}

static void add_stiffness(const model *m, int element, const node_state x[], int count,
                          line_output at[], const field_load load[], double K[])
{
    const int n = model_own_coordinates(m);
    double H[ELEMENT_ALONG_POINTS][N * N], df[9], dm[9];
    for (int k = 0; k < count; k++)
        at[k].H = H[k];
    model_type(m)->line(model_kind_of(m, element)->data, x, count, at);
    for (int k = 0; k < count; k++) {
        place_load(&load[k], &at[k], df, dm);
        subtract_stiffness(n, &at[k], df, dm, K);
    }
}

void line_add_loads(const model *m, int element, const node_state x[], int count, const double at[],
                    const field_load load[], double forces[], double K[])
{
    const int n = model_own_coordinates(m);
    line_output out[ELEMENT_ALONG_POINTS];
    double P[ELEMENT_ALONG_POINTS][3 * N], T[ELEMENT_ALONG_POINTS][3 * N], df[9], dm[9];
    for (int k = 0; k < count; k++)
        out[k] = (line_output){.at = at[k], .P = P[k], .T = T[k]};
    model_type(m)->line(model_kind_of(m, element)->data, x, count, out);
    for (int k = 0; k < count; k++) {
        place_load(&load[k], &out[k], df, dm);
        dense_add_transpose_mul(n, 3, 1, P[k], out[k].force, forces);
        dense_add_transpose_mul(n, 3, 1, T[k], out[k].moment, forces);
    }
    if (K != NULL)
        add_stiffness(m, element, x, count, out, load, K);
}
