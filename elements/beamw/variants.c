#include "elements/beamw/variants.h"

#include <string.h>

#include "elements/beamw/modes.h"
#include "elements/beamw/modified_stress.h"

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

void beamw_variants_list(element_data *d)
{
    enum { E = BEAMW_STRAINS };
    d->terms = d->springs = 0;
    for (int k = 0; k < BEAMW_MODIFIED; k++)
        for (int i = 0; i < E; i++)
            for (int j = i; j < E; j++)
                if (d->Q[k][E * i + j] != 0)
                    d->term[d->terms++] = beamw_quadratic_of(d->Q[k][E * i + j], BEAMW_MODIFIED, E,
                                                             k, i, j, E * i + j);
    for (int i = 0; i < E; i++)
        for (int j = 0; j < E; j++)
            if (d->S[E * i + j] != 0) {
                d->spring[d->springs].c = d->S[E * i + j];
                d->spring[d->springs].i = (short)i;
                d->spring[d->springs++].j = (short)j;
            }
}

void beamw_variants_strain(const element_data *d, const node_state x[], strain_output *out)
{
    beamw_modes_evaluate(d->l0, x, out);
}

void beamw_variants_strain_many(int count, const element_data *const data[], const node_state x[],
                                strain_output out[])
{
    REAL_CHOSEN(beamw_lanes_modes)(count, data, x, out);
}

status beamw_variants_stress(const element_data *d, const double e[], const double inner[],
                             stress_output *out)
{
    (void)inner;
    beamw_modified_stress_evaluate(d, e, out);
    return STATUS_OK;
}

void beamw_variants_unstressed(const element_data *d, const double more[3], const node_state x[],
                               element_data *out)
{
    double e[BEAMW_STRAINS], D[BEAMW_MODIFIED * BEAMW_STRAINS + 1];
    (void)more;
    *out = *d;
    beamw_variants_strain(d, x, &(strain_output){.e = e});
    beamw_modified_stress_strains(d, e, D, out->free);
}

void beamw_variants_stress_many(int count, const element_data *const data[],
                                const double *const e[], const double *const inner[],
                                stress_output out[], status outcome[])
{
    REAL_CHOSEN(beamw_lanes_modified)(count, data, e, inner, out, outcome);
}

void beamw_variants_geometric(const element_data *d, const double sigma[], double G[])
{
    enum { E = BEAMW_STRAINS };
    memset(G, 0, E * E * sizeof *G);
    for (int t = 0; t < d->terms; t++)
        G[d->term[t].entry] += sigma[d->term[t].row] * d->term[t].c;
    for (int i = 0; i < E; i++)
        for (int j = 0; j < i; j++)
            G[E * i + j] = G[E * j + i];
}
