#include "elements/exact/warping.h"

#include <string.h>

#include "elements/exact/line.h"
#include "elements/math/dense.h"

/* Polynomial through 0 and the stages: slopes at the stages and the value at 1, on (value at 0, values at the stages). */
static void polynomial(int stages, const double x[], double slope[][WARPING_MAX_STAGES + 1], double end[])
{
    double at[WARPING_MAX_STAGES + 1] = {0}, L[WARPING_MAX_STAGES + 1];
    memcpy(at + 1, x, (size_t)stages * sizeof *x);
    for (int i = 0; i < stages; i++)
        line_lagrange(stages + 1, at, x[i], L, slope[i]);
    line_lagrange(stages + 1, at, 1, end, NULL);
}

void warping_energy(const constants *c, int stages, const double x[], const double w[], double S[WARPING_MAX * WARPING_MAX])
{
    enum { P = WARPING_MAX_STAGES };
    const int n = stages + 3, p = stages, q = stages + 1, multiplier = stages + 2;
    const double flexible = c->F[8];
    double slope[P][P + 1], end[P + 1], bend[P + 1][P + 1], A[P * P], a[(P + 1) * WARPING_MAX] = {0}, T[P * WARPING_MAX];
    int pivot[P];
    polynomial(stages, x, slope, end);
    for (int i = 0; i <= stages; i++)
        for (int j = 0; j <= stages; j++) {
            bend[i][j] = 0;
            for (int k = 0; k < stages; k++)
                bend[i][j] += c->EIw * w[k] * slope[k][i] * slope[k][j];
        }
    /* Warping torque w T = bend a - multiplier end, twist rate = a + flexible T: a at the stages. */
    double *rows = a + n;
    a[p] = 1;
    for (int i = 0; i < stages; i++) {
        const double k = flexible / w[i];
        for (int j = 0; j < stages; j++)
            A[i * stages + j] = (i == j) + k * bend[i + 1][j + 1];
        rows[i * n + i] = 1;
        rows[i * n + p] = -k * bend[i + 1][0];
        rows[i * n + multiplier] = k * end[i + 1];
    }
    dense_lu(stages, A, pivot); /* never singular: both matrices of the product are positive semidefinite */
    dense_lu_solve(stages, n, A, pivot, rows);
    for (int i = 0; i < stages; i++)
        for (int j = 0; j < n; j++) {
            T[i * n + j] = j == multiplier ? -end[i + 1] / w[i] : 0;
            for (int k = 0; k <= stages; k++)
                T[i * n + j] += bend[i + 1][k] / w[i] * a[k * n + j];
        }
    memset(S, 0, WARPING_MAX * WARPING_MAX * sizeof *S);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            for (int k = 0; k <= stages; k++)
                for (int l = 0; l <= stages; l++)
                    S[i * n + j] += bend[k][l] * a[k * n + i] * a[l * n + j];
            for (int k = 0; k < stages; k++)
                S[i * n + j] += flexible * w[k] * T[k * n + i] * T[k * n + j];
        }
    for (int j = 0; j < n; j++) {
        double closing = j == q ? -1 : 0; /* a(1) - a_q */
        for (int k = 0; k <= stages; k++)
            closing += end[k] * a[k * n + j];
        S[multiplier * n + j] -= closing;
        S[j * n + multiplier] -= closing;
    }
}
