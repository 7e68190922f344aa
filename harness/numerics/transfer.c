/* Transfer functions of linear models, with a bound of their rounding errors. */
#include <complex.h>
#include <float.h>
#include <lapacke.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/numerics/numerics_impl.h"

typedef struct transfer {
    const second_order *m;
    double complex w; /* i times the circular frequency */
    size_t N, u, y;
    double complex *D, *x, *z; /* [N^2] dynamic stiffness, then its factors; [N x u] x = D^-1 B;
                                  [N x y] z = D^-T L^T */
    double *scale; /* [N] largest |K_ii| + w |C_ii| + w^2 |M_ii| among the coordinates of the same
                      kind */
    int *pivot;
} transfer;

static double complex output_row(const transfer *t, size_t i, size_t k)
{
    const double *const *L = (const double *const *)t->m->L;
    return L[0][i * t->N + k] + t->w * L[1][i * t->N + k] + t->w * t->w * L[2][i * t->N + k];
}

static void fill(const transfer *t)
{
    const second_order *m = t->m;
    for (size_t i = 0; i < t->N * t->N; i++)
        t->D[i] = m->K[i] + t->w * m->C[i] + t->w * t->w * m->M[i];
    for (size_t i = 0; i < t->N * t->u; i++)
        t->x[i] = m->B[i];
    for (size_t i = 0; i < t->y; i++)
        for (size_t k = 0; k < t->N; k++)
            t->z[k * t->y + i] = output_row(t, i, k);
}

static void take(const transfer *t, double complex out[])
{
    for (size_t i = 0; i < t->y * t->u; i++)
        out[i] = t->m->D[i];
    for (size_t i = 0; i < t->y; i++)
        for (size_t k = 0; k < t->N; k++) {
            const double complex L = output_row(t, i, k);
            for (size_t j = 0; j < t->u && L != 0; j++)
                out[i * t->u + j] += L * t->x[k * t->u + j];
        }
}

static void scale(const transfer *t, const char kind[])
{
    const second_order *m = t->m;
    double largest[CHAR_MAX + 1] = {0};
    for (size_t i = 0; i < t->N; i++) {
        const size_t k = i * t->N + i;
        double *of = &largest[(int)kind[i]];
        *of = fmax(*of, fabs(m->K[k]) + cabs(t->w * m->C[k]) + cabs(t->w * t->w * m->M[k]));
    }
    for (size_t i = 0; i < t->N; i++)
        t->scale[i] = largest[(int)kind[i]];
}

/* Returns |S^1/2 x| for a column of x, where S is the diagonal matrix of `scale`. */
static double size_of(const transfer *t, const double complex x[], size_t columns, size_t column)
{
    double square = 0;
    for (size_t k = 0; k < t->N; k++)
        square += t->scale[k] * pow(cabs(x[k * columns + column]), 2);
    return sqrt(square);
}

/* Computes out[y x u], a bound of the rounding errors. The change of L D^-1 B is z^T dD x, where dD
 * is a few roundings of the size of S in the norm. */
static void bound(const transfer *t, double out[])
{
    const double roundings = 32 * DBL_EPSILON;
    for (size_t i = 0; i < t->y; i++)
        for (size_t j = 0; j < t->u; j++)
            out[i * t->u + j] = roundings * (fabs(t->m->D[i * t->u + j]) +
                                             size_of(t, t->z, t->y, i) * size_of(t, t->x, t->u, j));
}

status second_order_transfer(const second_order *m, double w, double pairs[], const char kind[],
                             double rounding[], fault *f)
{
    const size_t N = (size_t)m->n + (size_t)m->motions, u = (size_t)m->inputs,
                 y = (size_t)m->outputs;
    double complex *room = calloc(N * (N + u + y) + 1, sizeof *room);
    double *scales = calloc(N + 1, sizeof *scales);
    int *pivot = calloc(N + 1, sizeof *pivot);
    int info = -1;
    if (room != NULL && scales != NULL && pivot != NULL) {
        const transfer t = {.m = m,
                            .w = I * w,
                            .N = N,
                            .u = u,
                            .y = y,
                            .D = room,
                            .x = room + N * N,
                            .z = room + N * (N + u),
                            .scale = scales,
                            .pivot = pivot};
        fill(&t);
        info = u == 0 ? 0
                      : LAPACKE_zgesv(LAPACK_ROW_MAJOR, (int)N, m->inputs, t.D, (int)N, pivot, t.x,
                                      m->inputs);
        take(&t, (double complex *)pairs);
        if (info == 0 && kind != NULL && u > 0 && y > 0)
            info = LAPACKE_zgetrs(LAPACK_ROW_MAJOR, 'T', (int)N, m->outputs, t.D, (int)N, pivot,
                                  t.z, m->outputs);
        if (info == 0 && kind != NULL) {
            scale(&t, kind);
            bound(&t, rounding);
        }
    }
    free(room);
    free(scales);
    free(pivot);
    if (info > 0)
        return fault_set(f, STATUS_SINGULAR,
                         "the response at %g Hz is infinite; add damping, or remove this frequency",
                         w / (2 * PI));
    return info == 0 ? STATUS_OK : fault_memory(f, "transfer functions");
}
