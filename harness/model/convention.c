#include "harness/model/convention.h"

#include <string.h>

#include "elements/math/dense.h"

enum { N = 6 };

/* B = A^-1, both [n x n]; A is lost. */
static int invert(int n, double A[], double B[])
{
    int pivot[N];
    memset(B, 0, (size_t)(n * n) * sizeof *B);
    for (int i = 0; i < n; i++)
        B[i * n + i] = 1;
    const int failed = dense_lu(n, A, pivot);
    if (failed == 0)
        dense_lu_solve(n, n, A, pivot, B);
    return failed;
}

static void subtract_half_skew(int n, const int component[], const double m[3], double K[])
{
    const double skew[9] = {0, -m[2], m[1], m[2], 0, -m[0], -m[1], m[0], 0};
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            if (component[i] >= 3 && component[j] >= 3)
                K[i * n + j] -= skew[3 * (component[i] - 3) + component[j] - 3] / 2;
}

static void symmetrise(int n, double K[])
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            K[i * n + j] = K[j * n + i] = (K[i * n + j] + K[j * n + i]) / 2;
}

int convention_changes(scene_moments convention, const double m[3])
{
    return convention == SCENE_MOMENTS_SYMMETRISED || (convention == SCENE_MOMENTS_SPATIAL && vec3_norm(m) > 0);
}

/* Of the movable components, and back. */
static void gather(int n, const int component[], const double from[36], double to[])
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            to[i * n + j] = from[N * component[i] + component[j]];
}

static void scatter(int n, const int component[], const double from[], double to[36])
{
    memset(to, 0, 36 * sizeof *to);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            to[N * component[i] + component[j]] = from[i * n + j];
}

status convention_apply(scene_moments convention, int count, const int component[], const double m[3], double C[36], double K[36],
                        fault *f)
{
    double A[N * N], B[N * N], inverse[N * N];
    gather(count, component, C, A);
    if (invert(count, A, B) != 0)
        return fault_set(f, STATUS_SINGULAR, "the compliance matrix is singular");
    if (convention_changes(convention, m)) {
        subtract_half_skew(count, component, m, B);
        if (convention == SCENE_MOMENTS_SYMMETRISED)
            symmetrise(count, B);
        memcpy(A, B, sizeof A);
        if (invert(count, A, inverse) != 0)
            return fault_set(f, STATUS_SINGULAR, "the stiffness with %s moments is singular", scene_moments_name(convention));
        scatter(count, component, inverse, C);
    }
    scatter(count, component, B, K);
    return STATUS_OK;
}
