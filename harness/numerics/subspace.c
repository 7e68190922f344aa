#include "harness/numerics/subspace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

status subspace_alloc(subspace *b, eigen_product *S, void *context, const sparse *M,
                      const sparse *G, int room, fault *f)
{
    const size_t n = (size_t)M->n, most = (size_t)(room < M->n ? room : M->n);
    memset(b, 0, sizeof *b);
    b->S = S;
    b->context = context;
    b->M = M;
    b->G = G;
    b->n = M->n;
    b->room = (int)most;
    b->V = malloc((most * n + 1) * sizeof(double));
    b->SV = malloc((most * n + 1) * sizeof(double));
    b->MV = malloc((most * n + 1) * sizeof(double));
    b->GV = malloc((most * n + 1) * sizeof(double));
    b->Mp = calloc(most * most + 1, sizeof(double));
    b->Gp = calloc(most * most + 1, sizeof(double));
    const int good = b->V != NULL && b->SV != NULL && b->MV != NULL && b->GV != NULL &&
                     b->Mp != NULL && b->Gp != NULL;
    return good ? STATUS_OK
                : fault_set(f, STATUS_FAULT, "out of memory for a basis of %zu vectors", most);
}

void subspace_free(subspace *b)
{
    free(b->V);
    free(b->SV);
    free(b->MV);
    free(b->GV);
    free(b->Mp);
    free(b->Gp);
}

void subspace_skew_mul(const sparse *G, const double x[], double y[])
{
    if (!G->symmetric) {
        sparse_mul(G, x, y);
        return;
    }
    memset(y, 0, (size_t)G->n * sizeof *y);
    for (int j = 0; j < G->n; j++)
        for (int k = G->column[j]; k < G->column[j + 1]; k++) {
            y[G->row[k]] += G->value[k] * x[j];
            if (G->row[k] != j)
                y[j] -= G->value[k] * x[G->row[k]];
        }
}

int subspace_add(subspace *b, const double x[])
{
    const double negligible = 1e-7; /* of a vector, in directions that are new */
    const size_t n = (size_t)b->n, at = (size_t)b->count * n;
    if (b->count == b->room)
        return 0;
    double *v = b->V + at, *Sv = b->SV + at;
    memcpy(v, x, n * sizeof *v);
    b->S(b->context, v, Sv);
    const double before = sqrt(fmax(0, dense_dot(b->n, v, Sv)));
    for (int pass = 0; pass < 2; pass++) /* twice is enough */
        for (int i = 0; i < b->count; i++) {
            const double c = dense_dot(b->n, b->SV + (size_t)i * n, v);
            for (size_t k = 0; k < n; k++)
                v[k] -= c * b->V[(size_t)i * n + k];
        }
    b->S(b->context, v, Sv);
    const double size = sqrt(fmax(0, dense_dot(b->n, v, Sv)));
    if (!(size > negligible * before))
        return 0;
    for (size_t k = 0; k < n; k++) {
        v[k] /= size;
        Sv[k] /= size;
    }
    sparse_mul(b->M, v, b->MV + at);
    subspace_skew_mul(b->G, v, b->GV + at);
    const int last = b->count++;
    for (int i = 0; i <= last; i++) {
        const double m = dense_dot(b->n, b->V + (size_t)i * n, b->MV + at),
                     g = dense_dot(b->n, b->V + (size_t)i * n, b->GV + at);
        b->Mp[i * b->room + last] = b->Mp[last * b->room + i] = m;
        b->Gp[i * b->room + last] = i == last ? 0 : g;
        b->Gp[last * b->room + i] = i == last ? 0 : -g;
    }
    return 1;
}
