/* Reduced linear models: static shapes of interface coordinates and motions, and modes with the
 * interface fixed (R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313); without an
 * interface, modes and static shapes of forces. Shapes and modes are those of the symmetric part of
 * K. */
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "harness/numerics/numerics_impl.h"

static status no_memory(fault *f)
{
    return fault_memory(f, "a reduced model");
}

typedef struct reduction {
    const second_order *m;
    int inner, edge;
    int *of;      /* [n] coordinates, inner coordinates first */
    double *K;    /* [inner^2] symmetric stiffness, which becomes its Cholesky factor */
    double *mode; /* [inner^2] K-orthonormal modes, by columns, with the highest frequency first */
    double *mu;   /* [inner] 1/w^2 of the modes */
    double *V;
    double *r; /* [motions x n] static deflection shapes due to unit prescribed motions */
    int columns;
    /* number of modes in V: the requested modes, and modes with the same frequency as the last
     * requested mode */
    int modes;
} reduction;

static double symmetric(const second_order *m, const double A[], int i, int j)
{
    const size_t N = (size_t)m->n + (size_t)m->motions;
    return 0.5 * (A[(size_t)i * N + (size_t)j] + A[(size_t)j * N + (size_t)i]);
}

static status decompose(reduction *b, fault *f)
{
    const size_t inner = (size_t)b->inner;
    for (size_t i = 0; i < inner; i++)
        for (size_t j = 0; j < inner; j++) {
            b->K[i * inner + j] = symmetric(b->m, b->m->K, b->of[i], b->of[j]);
            b->mode[i * inner + j] = symmetric(b->m, b->m->M, b->of[i], b->of[j]);
        }
    const int info = b->inner == 0 ? 0
                                   : LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'L', b->inner, b->mode,
                                                   b->inner, b->K, b->inner, b->mu);
    if (info > b->inner)
        return fault_set(f, STATUS_REFUSED,
                         "the stiffness with the interface fixed is not positive definite, because "
                         "the structure is free to move; name interface nodes that support it");
    return info == 0 ? STATUS_OK
                     : fault_set(f, STATUS_NOT_CONVERGED,
                                 "the modes for a reduced model did not converge; give another "
                                 "number of modes");
}

/* Sets the number of modes. REFUSED: it exceeds the number of coordinates with mass, apart from
 * rounding errors. */
static status take_modes(reduction *b, int modes, fault *f)
{
    const double same = 1e-6;
    const int n = b->inner;
    int most = 0;
    while (most < n && b->mu[n - 1 - most] > n * DBL_EPSILON * b->mu[n - 1])
        most++;
    if (modes > most)
        return fault_set(f, STATUS_REFUSED,
                         "the number of modes with mass is %d%s; give at most %d", most,
                         b->edge > 0 ? " while the interface is fixed" : "", most);
    b->modes = modes;
    while (b->modes > 0 && b->modes < most &&
           b->mu[n - 1 - b->modes] > (1 - 2 * same) * b->mu[n - b->modes])
        b->modes++;
    return STATUS_OK;
}

static void solve_inner(const reduction *b, double force[], double sign, double out[])
{
    LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'L', b->inner, 1, b->K, b->inner, force, b->inner);
    for (int i = 0; i < b->inner; i++)
        out[b->of[i]] = sign * force[i];
}

static void add_shape(reduction *b, const double force[], double room[])
{
    const int n = b->inner;
    double *x = b->V + (size_t)b->columns * (size_t)n, left = 0;
    memcpy(x, force, (size_t)n * sizeof *x);
    LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'L', n, 1, b->K, n, x, n);
    const double size = dense_dot(n, x, force);
    for (int pass = 0; pass < 3; pass++) {
        for (int k = 0; k < n; k++) {
            room[k] = 0;
            for (int j = 0; j < n; j++)
                room[k] += symmetric(b->m, b->m->K, k, j) * x[j];
        }
        left = dense_dot(n, x, room);
        if (!(left > (pass == 0 ? 0 : 1e-16) * size))
            return;
        for (int i = 0; i < b->columns; i++) {
            const double *v = b->V + (size_t)i * (size_t)n, part = dense_dot(n, v, room);
            for (int k = 0; k < n; k++)
                x[k] -= part * v[k];
        }
    }
    for (int k = 0; k < n; k++)
        x[k] /= sqrt(left);
    b->columns++;
}

static void build(reduction *b, double room[])
{
    const second_order *m = b->m;
    const size_t n = (size_t)m->n;
    for (int k = 0; k < b->edge; k++) {
        double *v = b->V + (size_t)b->columns++ * n;
        for (int i = 0; i < b->inner; i++)
            room[i] = symmetric(m, m->K, b->of[i], b->of[b->inner + k]);
        solve_inner(b, room, -1, v);
        v[b->of[b->inner + k]] = 1;
    }
    for (int k = 0; k < b->modes; k++) {
        double *v = b->V + (size_t)b->columns++ * n;
        for (int i = 0; i < b->inner; i++)
            v[b->of[i]] = b->mode[(size_t)(b->inner - 1 - k) * (size_t)b->inner + (size_t)i];
    }
    for (int u = 0; u < m->inputs && b->edge == 0 && b->columns < m->n; u++) {
        for (int i = 0; i < m->n && m->motion_of[u] < 0; i++)
            room[i] = m->B[(size_t)i * (size_t)m->inputs + (size_t)u];
        if (m->motion_of[u] < 0)
            add_shape(b, room, room + n);
    }
    for (int k = 0; k < m->motions; k++) {
        for (int i = 0; i < b->inner; i++)
            room[i] = m->K[(size_t)b->of[i] * (n + (size_t)m->motions) + n + (size_t)k];
        solve_inner(b, room, -1, b->r + (size_t)k * n);
    }
}

static void assemble(const reduction *b, double left[], double right[])
{
    const second_order *m = b->m;
    const size_t n = (size_t)m->n, r = (size_t)b->columns, motions = (size_t)m->motions,
                 width = r + motions;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < r; j++)
            left[i * width + j] = right[i * width + j] = b->V[j * n + i];
        for (size_t k = 0; k < motions; k++)
            right[i * width + r + k] = b->r[k * n + i];
    }
    for (size_t k = 0; k < motions; k++)
        left[(n + k) * width + r + k] = right[(n + k) * width + r + k] = 1;
}

static void project(const double left[], const double A[], const double right[], size_t N, size_t R,
                    double room[], double out[])
{
    memset(room, 0, N * R * sizeof *room);
    memset(out, 0, R * R * sizeof *out);
    for (size_t i = 0; i < N; i++)
        for (size_t k = 0; k < N; k++)
            for (size_t j = 0; j < R && A[i * N + k] != 0; j++)
                room[i * R + j] += A[i * N + k] * right[k * R + j];
    for (size_t k = 0; k < N; k++)
        for (size_t i = 0; i < R; i++)
            for (size_t j = 0; j < R && left[k * R + i] != 0; j++)
                out[i * R + j] += left[k * R + i] * room[k * R + j];
}

/* Subtracts z^T (K q + C q' + M q'' - B u), which is zero, from row y of the outputs, where z is
 * the static shape of the output. The remainder is due to inertia and damping (mode acceleration
 * method). */
static void correct_output(const reduction *b, int y, double *L[3], double D[], double room[])
{
    const second_order *m = b->m;
    const size_t N = (size_t)m->n + (size_t)m->motions, u = (size_t)m->inputs, row = (size_t)y;
    double *const z = room, *const force = room + m->n;
    const double *const by[] = {m->K, m->C, m->M};
    memset(z, 0, (size_t)m->n * sizeof *z);
    for (int i = 0; i < b->inner; i++)
        force[i] = m->L[0][row * N + (size_t)b->of[i]];
    solve_inner(b, force, 1, z);
    memcpy(D + row * u, m->D + row * u, u * sizeof *D);
    for (int rate = 0; rate < 3; rate++) {
        memcpy(L[rate] + row * N, m->L[rate] + row * N, N * sizeof *D);
        for (size_t i = 0; i < (size_t)m->n; i++)
            for (size_t k = 0; k < N && z[i] != 0; k++)
                L[rate][row * N + k] -= z[i] * by[rate][i * N + k];
    }
    for (size_t i = 0; i < (size_t)m->n; i++)
        for (size_t j = 0; j < u; j++)
            D[row * u + j] += z[i] * m->B[i * u + j];
}

static status reduce(reduction *b, int *modes, second_order *out, double **T, double **room,
                     fault *f)
{
    const second_order *m = b->m;
    const size_t n = (size_t)m->n, motions = (size_t)m->motions, N = n + motions;
    TRY(decompose(b, f));
    TRY(take_modes(b, *modes, f));
    *modes = b->modes;
    build(b, *room);
    const size_t R = (size_t)b->columns + motions, u = (size_t)m->inputs, y = (size_t)m->outputs;
    double *more = realloc(*room, (2 * N * R + 3 * y * N + 2 * n + 1) * sizeof **room);
    *T = calloc(N * R + 1, sizeof **T);
    if (more != NULL)
        *room = more;
    if (more == NULL || *T == NULL)
        return no_memory(f);
    TRY(second_order_alloc(b->columns, m->motions, m->inputs, m->outputs, out, f));
    double *const left = *room, *const half = *room + N * R;
    memset(left, 0, N * R * sizeof *left);
    assemble(b, left, *T);
    project(left, m->K, *T, N, R, half, out->K);
    project(left, m->C, *T, N, R, half, out->C);
    project(left, m->M, *T, N, R, half, out->M);
    for (size_t k = 0; k < N; k++)
        for (size_t i = 0; i < R; i++)
            for (size_t j = 0; j < u; j++)
                out->B[i * u + j] += left[k * R + i] * m->B[k * u + j];
    double *L[3] = {half, half + y * N, half + 2 * y * N}, *own = half + 3 * y * N;
    for (size_t i = 0; i < y; i++)
        correct_output(b, (int)i, L, out->D, own);
    for (int rate = 0; rate < 3; rate++)
        for (size_t i = 0; i < y; i++)
            for (size_t k = 0; k < N; k++)
                for (size_t j = 0; j < R; j++)
                    out->L[rate][i * R + j] += L[rate][i * N + k] * (*T)[k * R + j];
    memcpy(out->motion_of, m->motion_of, u * sizeof *out->motion_of);
    return STATUS_OK;
}

status second_order_reduce(const second_order *m, const char edge[], int *modes, second_order *out,
                           double **T, fault *f)
{
    const size_t n = (size_t)m->n;
    reduction b = {.m = m};
    *out = (second_order){0};
    *T = NULL;
    b.of = calloc(n + 1, sizeof *b.of);
    b.K = calloc(n * n + 1, sizeof *b.K);
    b.mode = calloc(n * n + 1, sizeof *b.mode);
    b.mu = calloc(n + 1, sizeof *b.mu);
    b.V = calloc((n + 1) * n + 1, sizeof *b.V);
    b.r = calloc((size_t)m->motions * n + 1, sizeof *b.r);
    double *room = calloc(2 * n + 1, sizeof *room);
    status outcome = STATUS_OK;
    if (b.of == NULL || b.K == NULL || b.mode == NULL || b.mu == NULL || b.V == NULL ||
        b.r == NULL || room == NULL)
        outcome = no_memory(f);
    for (int at_edge = 0; at_edge < 2 && outcome == STATUS_OK; at_edge++)
        for (int i = 0; i < m->n; i++)
            if (edge[i] == at_edge) {
                b.of[b.inner + b.edge] = i;
                b.inner += !at_edge;
                b.edge += at_edge;
            }
    if (outcome == STATUS_OK)
        outcome = reduce(&b, modes, out, T, &room, f);
    void *const block[] = {b.of, b.K, b.mode, b.mu, b.V, b.r, room};
    for (size_t i = 0; i < sizeof block / sizeof block[0]; i++)
        free(block[i]);
    return outcome;
}

status second_order_frequencies(const second_order *m, double hertz[], fault *f)
{
    const size_t n = (size_t)m->n;
    double *K = calloc(2 * n * n + n + 1, sizeof *K), *M = K + n * n, *mu = M + n * n;
    if (K == NULL)
        return no_memory(f);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            K[i * n + j] = symmetric(m, m->K, (int)i, (int)j);
            M[i * n + j] = symmetric(m, m->M, (int)i, (int)j);
        }
    const int info =
        n == 0 ? 0 : LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'N', 'L', m->n, M, m->n, K, m->n, mu);
    for (size_t i = 0; i < n; i++)
        hertz[i] =
            info == 0 && mu[n - 1 - i] > 0 ? 1 / sqrt(mu[n - 1 - i]) / (2 * PI) : (double)NAN;
    free(K);
    return STATUS_OK;
}
