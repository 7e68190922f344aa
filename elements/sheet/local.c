/* F^T R^p = R(p) = Ry(yp) Rz(zp), whose first row is n seen from p, and F^T R^q = Ry(yq) Rz(zq)
 * Rx(px).
 *
 * With w_F the spin of the frame, a vector fixed in space has the rate a x w_F in frame axes.  The
 * chord gives w_F,y = -v_z/l and w_F,z = v_y/l; that p does not twist against the frame gives
 * w_F,x. */
#include "elements/sheet/local.h"

#include <string.h>

#include "elements/math/dense.h"

void sheet_local_of(double chord, const node_state x[2], sheet_local_state *out)
{
    const double *p = x[0].R, *q = x[1].R;
    double d[3], moved[3], D[3], F[3][3], M[9];
    for (int i = 0; i < 3; i++) {
        d[i] = x[1].r[i] - x[0].r[i];
        moved[i] = x[1].u[i] - x[0].u[i];
    }
    mat3_transpose_mul_vec(p, d, D);
    const double l = sqrt(vec3_dot(d, d)), h = sqrt(D[0] * D[0] + D[1] * D[1]);
    for (int i = 0; i < 3; i++) {
        F[0][i] = d[i] / l;
        F[1][i] = (p[3 * i + 1] * D[0] - p[3 * i] * D[1]) / h;
    }
    vec3_cross(F[0], F[1], F[2]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out->F[3 * i + k] = F[k][i];
    mat3_transpose_mul(out->F, q, M);
    const double m = sqrt(M[0] * M[0] + M[6] * M[6]);
    out->l = l;
    out->q[SHEET_LOCAL_U] = vec3_elongation(d, moved, chord);
    out->q[SHEET_LOCAL_YP] = atan2(D[2], h);
    out->q[SHEET_LOCAL_ZP] = atan2(-D[1], D[0]);
    out->q[SHEET_LOCAL_YQ] = atan2(-M[6], M[0]);
    out->q[SHEET_LOCAL_ZQ] = atan2(M[3], m);
    out->q[SHEET_LOCAL_PX] = atan2(-M[5], M[4]);
    out->q[SHEET_LOCAL_WP] = x[0].a;
    out->q[SHEET_LOCAL_WQ] = x[1].a;
    out->tan_yp = D[2] / h;
    out->sec_yp = l / h;
    out->cos_yq = M[0] / m;
    out->sin_yq = -M[6] / m;
    out->tan_zq = M[3] / m;
    out->sec_zq = 1 / m;
}

/* Rates that the local ones are made of: rows over v, P, Q. */
typedef struct spins {
    double frame[3][SHEET_RATE_TURNS];    /* w_F */
    double bend[SHEET_RATE_TURNS];        /* P_z - w_F,z */
    double relative[3][SHEET_RATE_TURNS]; /* Q - w_F */
    double across[SHEET_RATE_TURNS];      /* its part cos(yq) w_x - sin(yq) w_z */
} spins;

static spins spins_of(const sheet_local_state *s)
{
    spins w;
    memset(&w, 0, sizeof w);
    w.frame[1][SHEET_RATE_V + 2] = -1 / s->l;
    w.frame[2][SHEET_RATE_V + 1] = 1 / s->l;
    w.bend[SHEET_RATE_P + 2] = 1;
    w.bend[SHEET_RATE_V + 1] = -1 / s->l;
    w.frame[0][SHEET_RATE_P] = 1;
    w.frame[0][SHEET_RATE_P + 2] = -s->tan_yp;
    w.frame[0][SHEET_RATE_V + 1] = s->tan_yp / s->l;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < SHEET_RATE_TURNS; j++)
            w.relative[i][j] = -w.frame[i][j];
        w.relative[i][SHEET_RATE_Q + i] += 1;
    }
    for (int j = 0; j < SHEET_RATE_TURNS; j++)
        w.across[j] = s->cos_yq * w.relative[0][j] - s->sin_yq * w.relative[2][j];
    return w;
}

void sheet_local_rates(const sheet_local_state *s, double R[SHEET_LOCAL_COORDINATES * SHEET_RATES])
{
    const spins w = spins_of(s);
    memset(R, 0, SHEET_LOCAL_COORDINATES * SHEET_RATES * sizeof(double));
    R[SHEET_LOCAL_U * SHEET_RATES + SHEET_RATE_V] = 1;
    R[SHEET_LOCAL_YP * SHEET_RATES + SHEET_RATE_P + 1] = 1;
    R[SHEET_LOCAL_YP * SHEET_RATES + SHEET_RATE_V + 2] = 1 / s->l;
    for (int j = 0; j < SHEET_RATE_TURNS; j++) {
        R[SHEET_LOCAL_ZP * SHEET_RATES + j] = s->sec_yp * w.bend[j];
        R[SHEET_LOCAL_ZQ * SHEET_RATES + j] =
            s->sin_yq * w.relative[0][j] + s->cos_yq * w.relative[2][j];
        R[SHEET_LOCAL_PX * SHEET_RATES + j] = s->sec_zq * w.across[j];
        R[SHEET_LOCAL_YQ * SHEET_RATES + j] = w.relative[1][j] - s->tan_zq * w.across[j];
    }
    R[SHEET_LOCAL_WP * SHEET_RATES + SHEET_RATE_WP] =
        R[SHEET_LOCAL_WQ * SHEET_RATES + SHEET_RATE_WQ] = 1;
}

/* A += c a b^T; a is often sparse. */
static void add_product(double c, const double a[SHEET_RATE_TURNS],
                        const double b[SHEET_RATE_TURNS],
                        double A[SHEET_RATE_TURNS * SHEET_RATE_TURNS])
{
    for (int i = 0; i < SHEET_RATE_TURNS; i++)
        if (a[i] != 0)
            for (int j = 0; j < SHEET_RATE_TURNS; j++)
                A[SHEET_RATE_TURNS * i + j] += c * a[i] * b[j];
}

/* Weights of the accelerations dv/dt, dP/dt, dQ/dt in sum t_k d2q_k/dt2, from those of dw/dt and
 * d(bend)/dt. */
static void acceleration_weights(const sheet_local_state *s,
                                 const double t[SHEET_LOCAL_COORDINATES], const double relative[3],
                                 double bend, double g[SHEET_RATE_TURNS])
{
    const double about_z = bend + s->tan_yp * relative[0];
    g[SHEET_RATE_V] = t[SHEET_LOCAL_U];
    g[SHEET_RATE_V + 1] = -(about_z + relative[2]) / s->l;
    g[SHEET_RATE_V + 2] = (t[SHEET_LOCAL_YP] + relative[1]) / s->l;
    g[SHEET_RATE_P] = -relative[0];
    g[SHEET_RATE_P + 1] = t[SHEET_LOCAL_YP];
    g[SHEET_RATE_P + 2] = about_z;
    for (int i = 0; i < 3; i++)
        g[SHEET_RATE_Q + i] = relative[i];
}

/* Vectors turn with the frame, lengths change: terms of the accelerations. */
static void add_frame_terms(const sheet_local_state *s, const spins *w,
                            const double g[SHEET_RATE_TURNS],
                            double A[SHEET_RATE_TURNS * SHEET_RATE_TURNS])
{
    for (int i = 0; i < 3; i++) { /* g . (a x w_F) = w_F . (g x a) for a = v, P, Q */
        const int next = (i + 1) % 3, last = (i + 2) % 3;
        double row[SHEET_RATE_TURNS] = {0};
        for (int block = 0; block < SHEET_RATE_TURNS; block += 3) {
            row[block + last] = g[block + next];
            row[block + next] = -g[block + last];
        }
        add_product(1, w->frame[i], row, A);
    }
    A[SHEET_RATE_V + 1] -= g[SHEET_RATE_V + 1] / s->l; /* d(1/l)/dt = -v_x/l^2 in v_y/l and v_z/l */
    A[SHEET_RATE_V + 2] -= g[SHEET_RATE_V + 2] / s->l;
}

void sheet_local_add_second(const sheet_local_state *s,
                            const double R[SHEET_LOCAL_COORDINATES * SHEET_RATES],
                            const double t[SHEET_LOCAL_COORDINATES],
                            double H[SHEET_RATES * SHEET_RATES])
{
    const spins w = spins_of(s);
    /* weights of d(across)/dt, dw/dt and d(bend)/dt */
    const double across = t[SHEET_LOCAL_PX] * s->sec_zq - t[SHEET_LOCAL_YQ] * s->tan_zq,
                 bend = t[SHEET_LOCAL_ZP] * s->sec_yp;
    const double relative[3] = {t[SHEET_LOCAL_ZQ] * s->sin_yq + across * s->cos_yq,
                                t[SHEET_LOCAL_YQ],
                                t[SHEET_LOCAL_ZQ] * s->cos_yq - across * s->sin_yq};
    double g[SHEET_RATE_TURNS], A[SHEET_RATE_TURNS * SHEET_RATE_TURNS] = {0},
                                                     zq_and_across[SHEET_RATE_TURNS];
    acceleration_weights(s, t, relative, bend, g);
    add_frame_terms(s, &w, g, A);
    /* d(1/cos yp)/dt in zp, d(tan yp)/dt in w_x */
    add_product((bend * s->tan_yp + relative[0] * s->sec_yp * s->sec_yp), w.bend,
                R + SHEET_LOCAL_YP * SHEET_RATES, A);
    /* d(across)/dt = .. - yq' zq', d(zq')/dt = .. + yq' across; d(1/cos zq)/dt in px, d(tan zq)/dt
     * in yq */
    for (int j = 0; j < SHEET_RATE_TURNS; j++)
        zq_and_across[j] =
            t[SHEET_LOCAL_ZQ] * w.across[j] - across * R[SHEET_LOCAL_ZQ * SHEET_RATES + j];
    add_product(1, R + SHEET_LOCAL_YQ * SHEET_RATES, zq_and_across, A);
    add_product((t[SHEET_LOCAL_PX] * s->tan_zq - t[SHEET_LOCAL_YQ] * s->sec_zq) * s->sec_zq,
                R + SHEET_LOCAL_ZQ * SHEET_RATES, w.across, A);
    for (int i = 0; i < SHEET_RATE_TURNS; i++)
        for (int j = 0; j < SHEET_RATE_TURNS; j++)
            H[SHEET_RATES * i + j] +=
                (A[SHEET_RATE_TURNS * i + j] + A[SHEET_RATE_TURNS * j + i]) / 2;
}

void sheet_local_nodal_gradient(const sheet_local_state *s, int m, const double A[], double J[])
{
    for (int i = 0; i < m; i++) {
        const double *a = A + SHEET_RATES * i;
        double *row = J + SHEET_LOCAL_NODAL * i;
        mat3_mul_vec(s->F, a + SHEET_RATE_V, row + NODE_COORDINATES);
        mat3_mul_vec(s->F, a + SHEET_RATE_P, row + 3);
        mat3_mul_vec(s->F, a + SHEET_RATE_Q, row + NODE_COORDINATES + 3);
        for (int k = 0; k < 3; k++)
            row[k] = -row[NODE_COORDINATES + k];
        row[6] = a[SHEET_RATE_WP];
        row[NODE_COORDINATES + 6] = a[SHEET_RATE_WQ];
    }
}

/* K(row + i, column + j) = K(column + j, row + i) = B_ij. */
static void put(int row, int column, double sign, const double B[9],
                double K[SHEET_LOCAL_NODAL * SHEET_LOCAL_NODAL])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[SHEET_LOCAL_NODAL * (row + i) + column + j] =
                K[SHEET_LOCAL_NODAL * (column + j) + row + i] = sign * B[3 * i + j];
}

void sheet_local_nodal_form(const sheet_local_state *s, const double H[SHEET_RATES * SHEET_RATES],
                            double K[SHEET_LOCAL_NODAL * SHEET_LOCAL_NODAL])
{
    static const int place[3] = {7, 3, 10}; /* of v, P, Q; v is minus the motion of p too */
    for (int a = 0; a < 3; a++)
        for (int b = 0; b <= a; b++) {
            double block[9], half[9], turned[9];
            for (int i = 0; i < 3; i++) /* F B F^T = (F (F B)^T)^T */
                for (int j = 0; j < 3; j++)
                    block[3 * i + j] = H[SHEET_RATES * (3 * a + i) + 3 * b + j];
            mat3_mul(s->F, block, half);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    turned[3 * i + j] = vec3_dot(half + 3 * i, s->F + 3 * j);
            put(place[a], place[b], 1, turned, K);
            if (b == 0)
                put(place[a], 0, -1, turned, K);
            if (a == 0)
                put(0, 0, 1, turned, K);
        }
    double rows[2 * SHEET_LOCAL_NODAL];
    sheet_local_nodal_gradient(s, 2, H + SHEET_RATES * SHEET_RATE_WP, rows);
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < SHEET_LOCAL_NODAL; j++)
            K[SHEET_LOCAL_NODAL * (6 + NODE_COORDINATES * k) + j] =
                K[SHEET_LOCAL_NODAL * j + 6 + NODE_COORDINATES * k] =
                    rows[SHEET_LOCAL_NODAL * k + j];
}
