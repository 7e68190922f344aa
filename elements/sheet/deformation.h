/* The deformation function of a table of strains, with its derivatives, of one element or of
 * several in lanes: with E = de/dq, R = dq/d(rates) and T the rates of the nodes' coordinates, J =
 * E R T and sum s_i d2e_i/dx2 = T^T [R^T (sum s_i Q_i) R + sum_k t_k q_k''] T, t = E^T s. */
#ifndef BEAMWORK_SHEET_DEFORMATION_H
#define BEAMWORK_SHEET_DEFORMATION_H

#include "elements/sheet/rates.h"
#include "elements/sheet/strains.h"

/* E[8 x 8] = de/dq at q, e[8]. */
static inline void sheet_deformation_gradient(const sheet_strains_table *m,
                                              const real q[SHEET_LOCAL_COORDINATES],
                                              real e[SHEET_STRAINS],
                                              real E[SHEET_STRAINS * SHEET_LOCAL_COORDINATES])
{
    enum { N = SHEET_LOCAL_COORDINATES };
    real quadratic[SHEET_STRAINS][N];
    memset(quadratic, 0, sizeof quadratic);
    for (int t = 0; t < m->terms; t++) {
        const int i = m->term[t].i, j = m->term[t].j, k = m->term[t].k;
        quadratic[i][j] += m->term[t].c * q[k];
        if (j != k)
            quadratic[i][k] += m->term[t].c * q[j];
    }
    memcpy(quadratic[6], quadratic[1], sizeof quadratic[1]);
    memcpy(quadratic[7], quadratic[1], sizeof quadratic[1]);
    for (int i = 0; i < SHEET_STRAINS; i++) {
        e[i] = real_of(0);
        for (int j = 0; j < N; j++) {
            E[N * i + j] = m->Lambda[N * i + j] + quadratic[i][j];
            e[i] += (m->Lambda[N * i + j] + quadratic[i][j] / 2) * q[j];
        }
    }
}

/* Q = sum s_i Q_i. */
static inline void sheet_deformation_weighted(const sheet_strains_table *m,
                                              const real s[SHEET_STRAINS], real Q[])
{
    enum { N = SHEET_LOCAL_COORDINATES };
    const real weight[SHEET_STRAINS_LISTED] = {s[0], s[1] + s[6] + s[7], s[2], s[3], s[4], s[5]};
    memset(Q, 0, N * N * sizeof *Q);
    for (int t = 0; t < m->terms; t++)
        Q[N * m->term[t].j + m->term[t].k] += weight[m->term[t].i] * m->term[t].c;
    for (int j = 0; j < N; j++)
        for (int k = 0; k < j; k++)
            Q[N * j + k] = Q[N * k + j];
}

/* As element_type.strain. */
static inline void sheet_deformation_evaluate(const sheet_strains_table *table,
                                              const node_real x[2], strain_real *out)
{
    enum { N = SHEET_LOCAL_COORDINATES };
    real e[SHEET_STRAINS], E[SHEET_STRAINS * N];
    sheet_local_state s;
    sheet_rates r;
    sheet_local_of(table->chord, x, &s);
    s.q[SHEET_LOCAL_WP] += table->torsion;
    s.q[SHEET_LOCAL_WQ] += table->torsion;
    sheet_deformation_gradient(table, s.q, e, E);
    if (out->e != NULL)
        for (int i = 0; i < SHEET_STRAINS; i++)
            out->e[i] = e[i] - table->rest[i];
    const int second = out->s != NULL && out->H != NULL;
    if (out->J == NULL && !second)
        return;
    sheet_rates_of(&s, &r);
    if (out->J != NULL)
        for (int i = 0; i < SHEET_STRAINS; i++) {
            real along[SHEET_RATES];
            sheet_rates_chain(&r, E + N * i, along);
            sheet_rates_nodal_row(&s, along, out->J + SHEET_LOCAL_NODAL * i);
        }
    if (second) {
        real Q[N * N], t[N], H[SHEET_RATES * SHEET_RATES];
        sheet_deformation_weighted(table, out->s, Q);
        for (int j = 0; j < N; j++) {
            t[j] = real_of(0);
            for (int i = 0; i < SHEET_STRAINS; i++)
                t[j] += out->s[i] * E[N * i + j];
        }
        sheet_rates_congruence(&r, Q, H);
        sheet_rates_add_second(&s, &r, t, H);
        sheet_rates_nodal_form(&s, H, out->H);
    }
}

#endif
