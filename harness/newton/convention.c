#include "harness/newton/convention.h"

#include <string.h>

#include "elements/math/dense.h"

enum { N = 6 };

/* B = A^-1, both [n x n]; A is lost.  Not 0: it has none, beside its round-off. */
static int invert(int n, double A[], double B[])
{
    int pivot[N];
    memset(B, 0, (size_t)(n * n) * sizeof *B);
    for (int i = 0; i < n; i++)
        B[i * n + i] = 1;
    const int failed = dense_lu_regular(n, A, pivot);
    if (failed == 0)
        dense_lu_solve(n, n, A, pivot, B);
    return failed;
}

/* K -= times m~/2 on the turns. */
static void subtract_half_skew(const movable *v, double times, const double of[3], double K[])
{
    const double m[3] = {times * of[0], times * of[1], times * of[2]},
                 skew[9] = {0, -m[2], m[1], m[2], 0, -m[0], -m[1], m[0], 0};
    const int n = v->count;
    if (v->whole) {
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                if (v->component[i] >= 3 && v->component[j] >= 3)
                    K[i * n + j] -= skew[3 * (v->component[i] - 3) + v->component[j] - 3] / 2;
        return;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++)
                    K[i * n + j] -=
                        v->span[(3 + r) * n + i] * skew[3 * r + c] * v->span[(3 + c) * n + j] / 2;
}

static void symmetrise(int n, double K[])
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            K[i * n + j] = K[j * n + i] = (K[i * n + j] + K[j * n + i]) / 2;
}

int convention_changes(scene_moments of_tangent, scene_moments convention, const double m[3])
{
    return convention == SCENE_MOMENTS_SYMMETRISED ||
           (convention != of_tangent && vec3_norm(m) > 0);
}

/* How many times m~/2 is taken off. */
static int times_of(scene_moments of_tangent, scene_moments convention)
{
    return (convention != SCENE_MOMENTS_SEMITANGENTIAL) - (of_tangent == SCENE_MOMENTS_SPATIAL);
}

/* to[m x m] = T A T^T, T [m x n]; m, n at most N. */
static void congruence(int m, int n, const double T[], const double A[], double to[])
{
    double half[N * N];
    dense_mul(m, n, n, T, A, half);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++)
            to[i * m + j] = dense_dot(n, half + i * n, T + j * n);
}

/* to = dual C dual^T: on the motions alone. */
static void gather(const movable *v, const double C[36], double to[])
{
    const int n = v->count;
    if (!v->whole)
        congruence(n, N, v->dual, C, to);
    for (int i = 0; v->whole && i < n; i++)
        for (int j = 0; j < n; j++)
            to[i * n + j] = C[N * v->component[i] + v->component[j]];
}

/* Of whole components; the sums leave no negative zero. */
static void scatter(const movable *v, const double from[], double to[36])
{
    const int n = v->count;
    memset(to, 0, N * N * sizeof *to);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            to[N * v->component[i] + v->component[j]] += from[i * n + j];
}

/* C = span from span^T */
static void scatter_compliance(const movable *v, const double from[], double C[36])
{
    if (v->whole)
        scatter(v, from, C);
    else
        congruence(N, v->count, v->span, from, C);
}

/* K = dual^T from dual */
static void scatter_stiffness(const movable *v, const double from[], double K[36])
{
    const int n = v->count;
    double half[N * N];
    if (v->whole) {
        scatter(v, from, K);
        return;
    }
    memset(K, 0, N * N * sizeof *K);
    dense_mul(n, n, N, from, v->dual, half);
    dense_add_transpose_mul(N, n, N, v->dual, half, K);
}

status convention_apply(scene_moments of_tangent, scene_moments convention, const movable *motions,
                        const double m[3], double C[36], double K[36], fault *f)
{
    double A[N * N], B[N * N], inverse[N * N];
    gather(motions, C, A);
    if (invert(motions->count, A, B) != 0)
        return fault_set(f, STATUS_SINGULAR, "the compliance matrix is singular");
    if (convention_changes(of_tangent, convention, m)) {
        subtract_half_skew(motions, times_of(of_tangent, convention), m, B);
        if (convention == SCENE_MOMENTS_SYMMETRISED)
            symmetrise(motions->count, B);
        memcpy(A, B, sizeof A);
        if (invert(motions->count, A, inverse) != 0)
            return fault_set(f, STATUS_SINGULAR, "the stiffness with %s moments is singular",
                             scene_moments_name(convention));
        scatter_compliance(motions, inverse, C);
    }
    scatter_stiffness(motions, B, K);
    return STATUS_OK;
}
