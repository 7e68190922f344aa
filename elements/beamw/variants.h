/* The stress function that every BEAMW variant shares: energy 1/2 ebar^T S ebar of modified modes
 * ebar_i = e_i + 1/2 e^T Q_i e (J Eqs. 62-66).  A variant says only what S and Q are. */
#ifndef BEAMWORK_BEAMW_VARIANTS_H
#define BEAMWORK_BEAMW_VARIANTS_H

#include "elements/beamw/quadratic.h"
#include "elements/beamw/spread.h"
#include "elements/element.h"

enum {
    BEAMW_STRAINS = 8,
    BEAMW_MODIFIED = 6, /* e7 and e8 are never modified */
    BEAMW_QUADRATIC_TERMS = BEAMW_MODIFIED * BEAMW_STRAINS * (BEAMW_STRAINS + 1) / 2
};

struct element_data {
    double l0;                                        /* [m] */
    double S[8 * 8];                                  /* [N/m] */
    double Q[BEAMW_MODIFIED][8 * 8];                  /* [1/m], symmetric */
    int terms;                                        /* what is not zero in Q ... */
    beamw_quadratic_term term[BEAMW_QUADRATIC_TERMS]; /* ... entry: of [8 x 8], i <= j */
    int springs;                                      /* and in S */
    struct {
        double c;
        short i, j;
    } spring[BEAMW_STRAINS * BEAMW_STRAINS];
    beamw_spread spread;
};

/* Q += c (a b^T + b a^T): the quadratic c (a . e)(b . e). */
void beamw_variants_add_product(double Q[8 * 8], double c, const double a[8], const double b[8]);

/* Uniform torsion, where nothing warps: e7 and e8 follow e2.  A[n x n] <- T^T A T, and the same for
 * a whole variant. */
void beamw_variants_merge_torsion(int n, double A[]);
void beamw_variants_drop_warping(element_data *d);
/* Once S and Q are known. */
void beamw_variants_list(element_data *d);

size_t beamw_variants_data_size(const element_request *);
void beamw_variants_strain(const element_data *d, const node_state x[], strain_output *out);
void beamw_variants_strain_many(int count, const element_data *const data[], const node_state x[],
                                strain_output out[]);
status beamw_variants_stress(const element_data *d, const double e[], const double inner[],
                             stress_output *out);
void beamw_variants_stress_many(int count, const element_data *const data[],
                                const double *const e[], const double *const inner[],
                                stress_output out[], status outcome[]);
void beamw_variants_geometric(const element_data *d, const double sigma[], double G[]);

#endif
