/* With B = I + Q(e): sigma = B^T S ebar, dsigma/de = B^T S B + sum (S ebar)_i Q_i. */
#include "elements/beamw/variants.h"

#include <string.h>

#include "elements/beamw/modes.h"
#include "elements/math/dense.h"

void beamw_variants_add_product(double Q[8 * 8], double c, const double a[8], const double b[8])
{
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 8; j++)
            Q[8 * i + j] += c * (a[i] * b[j] + b[i] * a[j]);
}

void beamw_variants_merge_torsion(int n, double A[])
{
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < n; i++)
            for (int k = 6; k < 8; k++) {
                double *from = pass == 0 ? &A[n * i + k] : &A[n * k + i],
                       *to = pass == 0 ? &A[n * i + 1] : &A[n + i];
                *to += *from;
                *from = 0;
            }
}

void beamw_variants_drop_warping(element_data *d)
{
    beamw_variants_merge_torsion(BEAMW_STRAINS, d->S);
    for (int i = 0; i < BEAMW_MODIFIED; i++)
        beamw_variants_merge_torsion(BEAMW_STRAINS, d->Q[i]);
}

size_t beamw_variants_data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

void beamw_variants_strain(const element_data *d, const node_state x[], strain_output *out)
{
    beamw_modes_strain(d->l0, x, out);
}

status beamw_variants_stress(const element_data *d, const double e[], const double inner[],
                             stress_output *out)
{
    (void)inner;
    double B[8 * 8] = {0}, modified[8], conjugate[8];
    memcpy(modified, e, sizeof modified);
    for (int i = 0; i < 8; i++)
        B[9 * i] = 1;
    if (d->modified)
        for (int k = 0; k < BEAMW_MODIFIED; k++) {
            double row[8];
            dense_mul_vec(8, 8, d->Q[k], e, row);
            for (int j = 0; j < 8; j++) {
                B[8 * k + j] += row[j];
                modified[k] += row[j] * e[j] / 2;
            }
        }
    dense_mul_vec(8, 8, d->S, modified, conjugate);
    if (out->energy != NULL) {
        *out->energy = 0;
        for (int i = 0; i < 8; i++)
            *out->energy += modified[i] * conjugate[i] / 2;
    }
    if (out->sigma != NULL) {
        memset(out->sigma, 0, 8 * sizeof(double));
        dense_add_transpose_mul(8, 8, 1, B, conjugate, out->sigma);
    }
    if (out->C != NULL) {
        if (d->modified) {
            double work[8 * 8];
            beamw_variants_geometric(d, conjugate, out->C);
            dense_add_congruence(8, 8, B, d->S, out->C, work);
        } else {
            memcpy(out->C, d->S, sizeof d->S);
        }
    }
    if (out->residual != NULL)
        *out->residual = 0;
    return STATUS_OK;
}

void beamw_variants_geometric(const element_data *d, const double sigma[], double G[])
{
    memset(G, 0, 64 * sizeof(double));
    if (d->modified)
        for (int k = 0; k < BEAMW_MODIFIED; k++)
            for (int i = 0; i < 64; i++)
                G[i] += sigma[k] * d->Q[k][i];
}
