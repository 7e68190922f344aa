#include "harness/numerics/gyroscopic_count.h"

#include <stdlib.h>
#include <string.h>

/* The Hermitian A + i B as a real symmetric matrix of twice the size, [a, -b; b, a] for each entry:
 * its eigenvalues come in pairs. */
static status doubled_alloc(const sparse *pattern, sparse *out, fault *f)
{
    const int n = pattern->n, entries = pattern->column[n];
    memset(out, 0, sizeof *out);
    out->n = 2 * n;
    out->symmetric = 1;
    out->column = calloc(2 * (size_t)n + 1, sizeof *out->column);
    out->row = malloc((4 * (size_t)entries + 1) * sizeof *out->row);
    out->value = malloc((4 * (size_t)entries + 1) * sizeof *out->value);
    return out->column != NULL && out->row != NULL && out->value != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for a matrix of %d coordinates", 2 * n);
}

static void doubled_free(sparse *a)
{
    free(a->column);
    free(a->row);
    free(a->value);
}

static void fill(const sparse *K, const sparse *M, const sparse *G, double omega, sparse *out)
{
    int at = 0;
    for (int j = 0; j < K->n; j++)
        for (int half = 0; half < 2; half++) {
            for (int k = K->column[j]; k < K->column[j + 1]; k++) {
                const int i = K->row[k];
                const double a = K->value[k] - omega * omega * M->value[k], b = omega * G->value[k];
                if (i < j) {
                    out->row[at] = 2 * i;
                    out->value[at++] = half == 0 ? a : -b;
                    out->row[at] = 2 * i + 1;
                    out->value[at++] = half == 0 ? b : a;
                } else if (i == j) {
                    out->row[at] = 2 * i + half;
                    out->value[at++] = a;
                }
            }
            out->column[2 * j + half + 1] = at;
        }
}

/* With what gyroscopic_count frees. */
static status count(const sparse *K, const sparse *M, const sparse *G, double omega,
                    sparse *doubled, matrix_factor **factors, int *below, fault *f)
{
    TRY(doubled_alloc(K, doubled, f));
    fill(K, M, G, omega, doubled);
    TRY(factor_alloc(doubled, factors, f));
    TRY(factor_numeric(*factors, doubled, f));
    *below = factor_count(*factors).negative_pivots / 2;
    return STATUS_OK;
}

status gyroscopic_count(const sparse *K, const sparse *M, const sparse *G, double omega, int *below,
                        fault *f)
{
    sparse doubled;
    matrix_factor *factors = NULL;
    const status outcome = count(K, M, G, omega, &doubled, &factors, below, f);
    factor_free(factors);
    doubled_free(&doubled);
    return outcome;
}
