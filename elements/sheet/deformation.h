/* First and second derivatives of the local coordinates with respect to eleven rates, for constant
 * velocity and constant spatial angular velocity. The rates are the velocity v of q relative to p
 * and the angular velocities P and Q of the nodes, in frame axes, and the rates of the two warping
 * amplitudes.
 *
 * Let w_F be the angular velocity of the frame. A vector a fixed in space has the rate a x w_F in
 * frame axes. The chord gives w_F,y = -v_z/l and w_F,z = v_y/l; the condition that p does not twist
 * relative to the frame gives w_F,x. Only nonzero derivatives are stored; their positions are the
 * same in all states. */
#ifndef BEAMWORK_SHEET_DEFORMATION_H
#define BEAMWORK_SHEET_DEFORMATION_H

#include <string.h>

#include "elements/sheet/sheet.h"

enum {
    SHEET_RATE_V = 0,
    SHEET_RATE_P = 3,
    SHEET_RATE_Q = 6,
    SHEET_RATE_TURNS = 9,
    SHEET_RATE_WP = 9,
    SHEET_RATE_WQ,
    SHEET_RATES
};

/* Number of rates that rotate q relative to the frame about x and z: v_y, P_x, P_z, Q_x, Q_z. */
enum { SHEET_RATE_MIXED = 5 };
static const int sheet_rates_mixed[SHEET_RATE_MIXED] = {
    SHEET_RATE_V + 1, SHEET_RATE_P, SHEET_RATE_P + 2, SHEET_RATE_Q, SHEET_RATE_Q + 2};

typedef struct sheet_rates {
    real inverse, lean;            /* 1/l and tan(yp)/l, which occur in w_F */
    real across[SHEET_RATE_MIXED]; /* cos(yq) w_x - sin(yq) w_z, where w = Q - w_F */
    real px[SHEET_RATE_MIXED], zq[SHEET_RATE_MIXED];
    real yq[SHEET_RATE_MIXED]; /* entries in addition to v_z/l and Q_y */
    real zp_v, zp_p; /* entries with respect to v_y and P_z. The rate of u is v_x, and that of yp is
                        P_y + v_z/l */
} sheet_rates;

static inline void sheet_rates_of(const sheet_local_state *s, sheet_rates *out)
{
    const real inverse = 1 / s->l, lean = s->tan_yp / s->l, one = real_of(1), none = real_of(0);
    const real x[SHEET_RATE_MIXED] = {-lean, -one, s->tan_yp, one, none};
    const real z[SHEET_RATE_MIXED] = {-inverse, none, none, none, one};
    out->inverse = inverse;
    out->lean = lean;
    out->zp_v = s->sec_yp * -inverse;
    out->zp_p = s->sec_yp;
    for (int j = 0; j < SHEET_RATE_MIXED; j++) {
        out->across[j] = s->cos_yq * x[j] - s->sin_yq * z[j];
        out->zq[j] = s->sin_yq * x[j] + s->cos_yq * z[j];
        out->px[j] = s->sec_zq * out->across[j];
        out->yq[j] = -(s->tan_zq * out->across[j]);
    }
}

/* Computes a[11] = e[8] dq/d(rates). */
static inline void sheet_rates_chain(const sheet_rates *r, const real e[SHEET_LOCAL_COORDINATES],
                                     real a[SHEET_RATES])
{
    const real px = e[SHEET_LOCAL_PX], yp = e[SHEET_LOCAL_YP], yq = e[SHEET_LOCAL_YQ],
               zp = e[SHEET_LOCAL_ZP], zq = e[SHEET_LOCAL_ZQ];
    a[SHEET_RATE_V] = e[SHEET_LOCAL_U];
    a[SHEET_RATE_V + 1] = px * r->px[0] + yq * r->yq[0] + zp * r->zp_v + zq * r->zq[0];
    a[SHEET_RATE_V + 2] = yp * r->inverse + yq * r->inverse;
    a[SHEET_RATE_P] = px * r->px[1] + yq * r->yq[1] + zq * r->zq[1];
    a[SHEET_RATE_P + 1] = yp;
    a[SHEET_RATE_P + 2] = px * r->px[2] + yq * r->yq[2] + zp * r->zp_p + zq * r->zq[2];
    a[SHEET_RATE_Q] = px * r->px[3] + yq * r->yq[3] + zq * r->zq[3];
    a[SHEET_RATE_Q + 1] = yq;
    a[SHEET_RATE_Q + 2] = px * r->px[4] + yq * r->yq[4] + zq * r->zq[4];
    a[SHEET_RATE_WP] = e[SHEET_LOCAL_WP];
    a[SHEET_RATE_WQ] = e[SHEET_LOCAL_WQ];
}

static inline int sheet_rates_used(int i, int j)
{
    return j / 3 <= i / 3;
}

/* Computes H[11 x 11] = R^T Q R in the used blocks, where R = dq/d(rates). Q[8 x 8] is symmetric
 * and zero for u. */
static inline void sheet_rates_congruence(const sheet_rates *r, const real Q[],
                                          real H[SHEET_RATES * SHEET_RATES])
{
    enum { N = SHEET_LOCAL_COORDINATES };
    real QR[N][SHEET_RATES];
    for (int k = SHEET_LOCAL_PX; k < N; k++)
        sheet_rates_chain(r, Q + N * k, QR[k]);
    const real *px = QR[SHEET_LOCAL_PX], *yp = QR[SHEET_LOCAL_YP], *yq = QR[SHEET_LOCAL_YQ],
               *zp = QR[SHEET_LOCAL_ZP], *zq = QR[SHEET_LOCAL_ZQ];
    for (int j = 0; j < SHEET_RATE_TURNS; j++) {
        H[SHEET_RATES * SHEET_RATE_V + j] = real_of(0);
        H[SHEET_RATES * (SHEET_RATE_V + 1) + j] =
            r->px[0] * px[j] + r->yq[0] * yq[j] + r->zp_v * zp[j] + r->zq[0] * zq[j];
        H[SHEET_RATES * (SHEET_RATE_V + 2) + j] = r->inverse * yp[j] + r->inverse * yq[j];
        H[SHEET_RATES * SHEET_RATE_P + j] = r->px[1] * px[j] + r->yq[1] * yq[j] + r->zq[1] * zq[j];
        H[SHEET_RATES * (SHEET_RATE_P + 1) + j] = yp[j];
        H[SHEET_RATES * (SHEET_RATE_P + 2) + j] =
            r->px[2] * px[j] + r->yq[2] * yq[j] + r->zp_p * zp[j] + r->zq[2] * zq[j];
        H[SHEET_RATES * SHEET_RATE_Q + j] = r->px[3] * px[j] + r->yq[3] * yq[j] + r->zq[3] * zq[j];
        H[SHEET_RATES * (SHEET_RATE_Q + 1) + j] = yq[j];
        H[SHEET_RATES * (SHEET_RATE_Q + 2) + j] =
            r->px[4] * px[j] + r->yq[4] * yq[j] + r->zq[4] * zq[j];
    }
    memcpy(H + SHEET_RATES * SHEET_RATE_WP, QR[SHEET_LOCAL_WP], 2 * sizeof QR[0]);
}

/* Computes the weights of the accelerations dv/dt, dP/dt, dQ/dt in sum t_k d2q_k/dt2. The weights
 * are computed from those of dw/dt and d(bend)/dt, where bend = P_z - w_F,z. */
static inline void sheet_rates_weights(const sheet_local_state *s,
                                       const real t[SHEET_LOCAL_COORDINATES],
                                       const real relative[3], real bend, real g[SHEET_RATE_TURNS])
{
    const real about_z = bend + s->tan_yp * relative[0];
    g[SHEET_RATE_V] = t[SHEET_LOCAL_U];
    g[SHEET_RATE_V + 1] = -(about_z + relative[2]) / s->l;
    g[SHEET_RATE_V + 2] = (t[SHEET_LOCAL_YP] + relative[1]) / s->l;
    g[SHEET_RATE_P] = -relative[0];
    g[SHEET_RATE_P + 1] = t[SHEET_LOCAL_YP];
    g[SHEET_RATE_P + 2] = about_z;
    for (int i = 0; i < 3; i++)
        g[SHEET_RATE_Q + i] = relative[i];
}

/* Computes A, the sum of the products of w_F,i and row i of g x a for a = v, P, Q. A represents two
 * effects: the rotation of vectors with the frame, g . (a x w_F) = w_F . (g x a), and the change of
 * length in v_y/l and v_z/l, d(1/l)/dt = -v_x/l^2. */
static inline void sheet_rates_turn(const sheet_local_state *s, const sheet_rates *r,
                                    const real g[SHEET_RATE_TURNS],
                                    real A[SHEET_RATE_TURNS][SHEET_RATE_TURNS])
{
    for (int b = 0; b < SHEET_RATE_TURNS; b += 3) {
        const real *c = g + b;
        A[SHEET_RATE_V + 1][b] = r->inverse * -c[1];
        A[SHEET_RATE_V + 1][b + 1] = r->lean * -c[2] + r->inverse * c[0];
        A[SHEET_RATE_V + 1][b + 2] = r->lean * c[1];
        A[SHEET_RATE_V + 2][b] = -r->inverse * c[2];
        A[SHEET_RATE_V + 2][b + 2] = -r->inverse * -c[0];
        A[SHEET_RATE_P][b + 1] = -c[2];
        A[SHEET_RATE_P][b + 2] = c[1];
        A[SHEET_RATE_P + 2][b + 1] = -s->tan_yp * -c[2];
        A[SHEET_RATE_P + 2][b + 2] = -s->tan_yp * c[1];
    }
    A[SHEET_RATE_V][SHEET_RATE_V + 1] = -(g[SHEET_RATE_V + 1] / s->l);
    A[SHEET_RATE_V][SHEET_RATE_V + 2] = -(g[SHEET_RATE_V + 2] / s->l);
}

/* Adds sum_k t_k d2q_k/dt2, a symmetric form in the rates, to the used blocks of H[11 x 11]. */
static inline void sheet_rates_add_second(const sheet_local_state *s, const sheet_rates *r,
                                          const real t[SHEET_LOCAL_COORDINATES],
                                          real H[SHEET_RATES * SHEET_RATES])
{
    /* weights of d(across)/dt, d(bend)/dt and dw/dt */
    const real across = t[SHEET_LOCAL_PX] * s->sec_zq - t[SHEET_LOCAL_YQ] * s->tan_zq,
               bend = t[SHEET_LOCAL_ZP] * s->sec_yp;
    const real relative[3] = {t[SHEET_LOCAL_ZQ] * s->sin_yq + across * s->cos_yq, t[SHEET_LOCAL_YQ],
                              t[SHEET_LOCAL_ZQ] * s->cos_yq - across * s->sin_yq};
    real g[SHEET_RATE_TURNS], A[SHEET_RATE_TURNS][SHEET_RATE_TURNS];
    memset(A, 0, sizeof A);
    sheet_rates_weights(s, t, relative, bend, g);
    sheet_rates_turn(s, r, g, A);
    /* the time derivatives of 1/cos yp in zp' and of tan yp in w_x are proportional to bend yp' */
    const real yp = bend * s->tan_yp + relative[0] * s->sec_yp * s->sec_yp, yp_v = yp * -r->inverse;
    A[SHEET_RATE_P + 2][SHEET_RATE_P + 1] += yp;
    A[SHEET_RATE_P + 2][SHEET_RATE_V + 2] += yp * r->inverse;
    A[SHEET_RATE_V + 1][SHEET_RATE_P + 1] += yp_v;
    A[SHEET_RATE_V + 1][SHEET_RATE_V + 2] += yp_v * r->inverse;
    /* d(across)/dt = ... - yq' zq' and d(zq')/dt = ... + yq' across; then the time derivatives of
     * 1/cos zq in px' and of tan zq in yq' */
    const real zq = (t[SHEET_LOCAL_PX] * s->tan_zq - t[SHEET_LOCAL_YQ] * s->sec_zq) * s->sec_zq;
    for (int j = 0; j < SHEET_RATE_MIXED; j++) {
        const int column = sheet_rates_mixed[j];
        const real both = t[SHEET_LOCAL_ZQ] * r->across[j] - across * r->zq[j];
        A[SHEET_RATE_V + 2][column] += r->inverse * both;
        A[SHEET_RATE_Q + 1][column] += both;
        for (int i = 0; i < SHEET_RATE_MIXED; i++) {
            real *a = &A[sheet_rates_mixed[i]][column];
            *a += r->yq[i] * both;
            *a += zq * r->zq[i] * r->across[j];
        }
    }
    for (int i = 0; i < SHEET_RATE_TURNS; i++)
        for (int j = 0; j < SHEET_RATE_TURNS; j++)
            if (sheet_rates_used(i, j))
                H[SHEET_RATES * i + j] += (A[i][j] + A[j][i]) / 2;
}

/* Computes a row of J[14] = a[11] d(rates)/dx, with respect to the coordinates of the nodes. */
static inline void sheet_rates_nodal_row(const sheet_local_state *s, const real a[SHEET_RATES],
                                         real row[SHEET_LOCAL_NODAL])
{
    mat3_mul_vec(s->F, a + SHEET_RATE_V, row + NODE_COORDINATES);
    mat3_mul_vec(s->F, a + SHEET_RATE_P, row + 3);
    mat3_mul_vec(s->F, a + SHEET_RATE_Q, row + NODE_COORDINATES + 3);
    for (int k = 0; k < 3; k++)
        row[k] = -row[NODE_COORDINATES + k];
    row[6] = a[SHEET_RATE_WP];
    row[NODE_COORDINATES + 6] = a[SHEET_RATE_WQ];
}

static inline void sheet_rates_put(int row, int column, int negative, const real B[9],
                                   real K[SHEET_LOCAL_NODAL * SHEET_LOCAL_NODAL])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[SHEET_LOCAL_NODAL * (row + i) + column + j] =
                K[SHEET_LOCAL_NODAL * (column + j) + row + i] =
                    negative ? -B[3 * i + j] : B[3 * i + j];
}

/* Transforms the form H[11 x 11] to the coordinates of the nodes, K[14 x 14]. */
static inline void sheet_rates_nodal_form(const sheet_local_state *s,
                                          const real H[SHEET_RATES * SHEET_RATES],
                                          real K[SHEET_LOCAL_NODAL * SHEET_LOCAL_NODAL])
{
    static const int place[3] = {7, 3, 10};
    for (int a = 0; a < 3; a++)
        for (int b = 0; b <= a; b++) {
            real block[9], half[9], turned[9];
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    block[3 * i + j] = H[SHEET_RATES * (3 * a + i) + 3 * b + j];
            mat3_mul(s->F, block, half);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    turned[3 * i + j] = vec3_dot(half + 3 * i, s->F + 3 * j);
            sheet_rates_put(place[a], place[b], 0, turned, K);
            if (b == 0)
                sheet_rates_put(place[a], 0, 1, turned, K);
            if (a == 0)
                sheet_rates_put(0, 0, 0, turned, K);
        }
    for (int k = 0; k < 2; k++) {
        real row[SHEET_LOCAL_NODAL];
        sheet_rates_nodal_row(s, H + SHEET_RATES * (SHEET_RATE_WP + k), row);
        for (int j = 0; j < SHEET_LOCAL_NODAL; j++)
            K[SHEET_LOCAL_NODAL * (6 + NODE_COORDINATES * k) + j] =
                K[SHEET_LOCAL_NODAL * j + 6 + NODE_COORDINATES * k] = row[j];
    }
}

/* The deformation function of a table of strains with its derivatives, for one element or several
 * in lanes. Let E = de/dq, R = dq/d(rates), T the rates of the coordinates of the nodes, and t =
 * E^T s. Then J = E R T, and sum s_i d2e_i/dx2 = T^T [R^T (sum s_i Q_i) R + sum_k t_k q_k''] T. */

/* Computes E[8 x 8] = de/dq and the strains e[8] at q. */
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

/* Implements element_type.strain. */
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
