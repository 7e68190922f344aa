/* The generalized strains are weighted integrals of the second-order strains of N Eq. 7,
 *   kx = phi_x' + phi_y' phi_z,  ky = phi_y' + phi_z' phi_x,  kz = phi_z' - phi_y' phi_x,
 *   gx = u_x' - phi_y (phi_y/2 + u_z') - phi_z (phi_z/2 - u_y') + Ite phi_x'^2/2,
 *   gy = gy0 + phi_x (phi_y + u_z'),  gz = gz0 + phi_x (phi_z - u_y'),
 * over the linear solution N Eqs. 14-19:
 *   e1 = int gx, e2 = L int kx, e3 = int [(L-s) ky - gz], e4 = int [s ky + gz], e5 = int [(L-s) kz
 * + gy], e6 = int [s kz - gy], e7 = L^2 Wp + L int phi_y' phi_z, e8 = L^2 Wq + L int phi_y' phi_z.
 * With Phi = 0 they are N Eq. 37 (the last term of its e1 has L^2 for L). */
#include "elements/sheet/strains.h"

#include <math.h>
#include <string.h>

#include "elements/math/arc.h"
#include "elements/math/dense.h"
#include "elements/math/quadrature.h"
#include "elements/math/rotation.h"
#include "elements/sheet/fields.h"

enum { N = SHEET_LOCAL_COORDINATES, POINTS = 4 }; /* products of degree 7 at most: exact */

/* Q += c (a b^T + b a^T): the quadratic c (a . q)(b . q). */
static void add_product(double c, const double a[N], const double b[N], double Q[N * N])
{
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            Q[N * i + j] += c * (a[i] * b[j] + b[i] * a[j]);
}

static void add_point(double x, double ds, double l0, double trapeze, const sheet_fields *f,
                      double Q[SHEET_STRAINS_LISTED][N * N])
{
    double lag_y[N], lag_z[N];
    for (int i = 0; i < N; i++) {
        lag_y[i] = f->phi_y[i] + f->duz[i];
        lag_z[i] = f->phi_z[i] - f->duy[i];
    }
    const double from_p = x * l0, to_q = (1 - x) * l0;
    add_product(-ds / 2, f->phi_y, f->phi_y, Q[0]);
    add_product(-ds, f->phi_y, f->duz, Q[0]);
    add_product(-ds / 2, f->phi_z, f->phi_z, Q[0]);
    add_product(ds, f->phi_z, f->duy, Q[0]);
    add_product(ds * trapeze / 2, f->dphi_x, f->dphi_x, Q[0]);
    add_product(ds * l0, f->dphi_y, f->phi_z, Q[1]);
    add_product(ds * to_q, f->dphi_z, f->phi_x, Q[2]);
    add_product(-ds, f->phi_x, lag_z, Q[2]);
    add_product(ds * from_p, f->dphi_z, f->phi_x, Q[3]);
    add_product(ds, f->phi_x, lag_z, Q[3]);
    add_product(-ds * to_q, f->dphi_y, f->phi_x, Q[4]);
    add_product(ds, f->phi_x, lag_y, Q[4]);
    add_product(-ds * from_p, f->dphi_y, f->phi_x, Q[5]);
    add_product(-ds, f->phi_x, lag_y, Q[5]);
}

static void list_terms(double Q[SHEET_STRAINS_LISTED][N * N], sheet_strains_table *out)
{
    for (int i = 0; i < SHEET_STRAINS_LISTED; i++)
        for (int j = 0; j < N; j++)
            for (int k = j; k < N; k++)
                if (Q[i][N * j + k] != 0) {
                    out->term[out->terms].c = Q[i][N * j + k];
                    out->term[out->terms].i = i;
                    out->term[out->terms].j = j;
                    out->term[out->terms++].k = k;
                }
}

status sheet_strains_prepare(const element_request *request, double Phi_y, double Phi_z,
                             sheet_strains_table *out, fault *f)
{
    const section *c = request->section;
    const double l0 = request->length,
                 trapeze = request->features & FEATURE_TRAPEZE ? c->Ip / c->A : 0;
    const int amplitude = (request->features & FEATURE_WARPING) != 0;
    double x[POINTS], w[POINTS], Q[SHEET_STRAINS_LISTED][N * N] = {{0}};
    memset(out, 0, sizeof *out);
    if (!(l0 > 0) || !isfinite(l0))
        return fault_set(f, STATUS_REFUSED, "element length %g m: it must be positive", l0);
    quadrature_points(POINTS, x, w);
    out->Lambda[N * 0 + SHEET_LOCAL_U] = 1;
    out->Lambda[N * 1 + SHEET_LOCAL_PX] = l0;
    out->Lambda[N * 2 + SHEET_LOCAL_YP] = -l0;
    out->Lambda[N * 3 + SHEET_LOCAL_YQ] = l0;
    out->Lambda[N * 4 + SHEET_LOCAL_ZP] = -l0;
    out->Lambda[N * 5 + SHEET_LOCAL_ZQ] = l0;
    /* without amplitudes the twist is uniform: Wp = Wq = px/l0 */
    out->Lambda[N * 6 + (amplitude ? SHEET_LOCAL_WP : SHEET_LOCAL_PX)] = amplitude ? l0 * l0 : l0;
    out->Lambda[N * 7 + (amplitude ? SHEET_LOCAL_WQ : SHEET_LOCAL_PX)] = amplitude ? l0 * l0 : l0;
    for (int i = 0; i < POINTS; i++) {
        const sheet_fields at = sheet_fields_at(l0, x[i], Phi_y, Phi_z, sheet_fields_warp(request));
        add_point(x[i], w[i] * l0, l0, trapeze, &at, Q);
    }
    list_terms(Q, out);
    return STATUS_OK;
}

/* E[8 x 8] = de/dq at q, e[8]. */
static void gradient(const sheet_strains_table *m, const double q[N], double e[SHEET_STRAINS],
                     double E[SHEET_STRAINS * N])
{
    double quadratic[SHEET_STRAINS][N] = {{0}};
    for (int t = 0; t < m->terms; t++) {
        const int i = m->term[t].i, j = m->term[t].j, k = m->term[t].k;
        quadratic[i][j] += m->term[t].c * q[k];
        if (j != k)
            quadratic[i][k] += m->term[t].c * q[j];
    }
    memcpy(quadratic[6], quadratic[1], sizeof quadratic[1]);
    memcpy(quadratic[7], quadratic[1], sizeof quadratic[1]);
    for (int i = 0; i < SHEET_STRAINS; i++) {
        e[i] = 0;
        for (int j = 0; j < N; j++) {
            E[N * i + j] = m->Lambda[N * i + j] + quadratic[i][j];
            e[i] += (m->Lambda[N * i + j] + quadratic[i][j] / 2) * q[j];
        }
    }
}

/* Q = sum s_i Q_i. */
static void weighted(const sheet_strains_table *m, const double s[SHEET_STRAINS], double Q[N * N])
{
    const double weight[SHEET_STRAINS_LISTED] = {s[0], s[1] + s[6] + s[7], s[2], s[3], s[4], s[5]};
    memset(Q, 0, N * N * sizeof *Q);
    for (int t = 0; t < m->terms; t++)
        Q[N * m->term[t].j + m->term[t].k] += weight[m->term[t].i] * m->term[t].c;
    for (int j = 0; j < N; j++)
        for (int k = 0; k < j; k++)
            Q[N * j + k] = Q[N * k + j];
}

enum {
    ANGLES = SHEET_LOCAL_WP - SHEET_LOCAL_PX,
    FIRST = SHEET_LOCAL_PX * SHEET_RATES
}; /* rows of R that are not single ones */

/* A[m x 11] = E[m x 8] R. */
static void chain(int m, const double E[], const double R[N * SHEET_RATES], double A[])
{
    for (int i = 0; i < m; i++) {
        const double *e = E + N * i;
        double *a = A + SHEET_RATES * i;
        for (int j = 0; j < SHEET_RATES; j++)
            a[j] = 0;
        a[SHEET_RATE_V] = e[SHEET_LOCAL_U];
        a[SHEET_RATE_WP] = e[SHEET_LOCAL_WP];
        a[SHEET_RATE_WQ] = e[SHEET_LOCAL_WQ];
        for (int k = 0; k < ANGLES; k++)
            for (int j = 0; j < SHEET_RATE_TURNS; j++)
                a[j] += e[SHEET_LOCAL_PX + k] * R[FIRST + SHEET_RATES * k + j];
    }
}

/* H[11 x 11] = R^T Q R, Q[8 x 8] without u. */
static void congruence(const double Q[N * N], const double R[N * SHEET_RATES],
                       double H[SHEET_RATES * SHEET_RATES])
{
    double QR[N * SHEET_RATES];
    chain(N, Q, R, QR);
    memset(H, 0, SHEET_RATES * SHEET_RATES * sizeof(double));
    for (int k = 0; k < ANGLES; k++)
        for (int i = 0; i < SHEET_RATE_TURNS; i++)
            for (int j = 0; j < SHEET_RATES; j++)
                H[SHEET_RATES * i + j] +=
                    R[FIRST + SHEET_RATES * k + i] * QR[SHEET_RATES * (SHEET_LOCAL_PX + k) + j];
    memcpy(H + SHEET_RATES * SHEET_RATE_WP, QR + SHEET_RATES * SHEET_LOCAL_WP,
           2 * SHEET_RATES * sizeof(double));
}

/* With E = de/dq, R = dq/d(rates) and T the rates of the nodes' coordinates: J = E R T and
 * sum s_i d2e_i/dx2 = T^T [R^T (sum s_i Q_i) R + sum_k t_k q_k''] T, t = E^T s. */
void sheet_strains_evaluate(const sheet_strains_table *table, const node_state x[2],
                            strain_output *out)
{
    double e[SHEET_STRAINS], E[SHEET_STRAINS * N], R[N * SHEET_RATES];
    sheet_local_state s;
    sheet_local_of(table->chord, x, &s);
    s.q[SHEET_LOCAL_WP] += table->torsion;
    s.q[SHEET_LOCAL_WQ] += table->torsion;
    gradient(table, s.q, e, E);
    if (out->e != NULL)
        for (int i = 0; i < SHEET_STRAINS; i++)
            out->e[i] = e[i] - table->rest[i];
    const int second = out->s != NULL && out->H != NULL;
    if (out->J == NULL && !second)
        return;
    sheet_local_rates(&s, R);
    if (out->J != NULL) {
        double along[SHEET_STRAINS * SHEET_RATES];
        chain(SHEET_STRAINS, E, R, along);
        sheet_local_nodal_gradient(&s, SHEET_STRAINS, along, out->J);
    }
    if (second) {
        double Q[N * N], t[N] = {0}, H[SHEET_RATES * SHEET_RATES];
        weighted(table, out->s, Q);
        dense_add_transpose_mul(N, SHEET_STRAINS, 1, E, out->s, t);
        congruence(Q, R, H);
        sheet_local_add_second(&s, R, t, H);
        sheet_local_nodal_form(&s, H, out->H);
    }
}

void sheet_strains_set_rest(const element_request *request, sheet_strains_table *out)
{
    const double l0 = request->length, *k = request->curvature, *g = request->strain;
    const double rotation[3] = {k[0] * l0, k[1] * l0, k[2] * l0}, along[3] = {1, 0, 0},
                 strained[3] = {1 + g[0], g[1], g[2]};
    double arc[3], unstressed[3], q[4], rest[SHEET_STRAINS];
    node_state x[2];
    memset(x, 0, sizeof x);
    arc_at(rotation, along, 1, arc, q);
    arc_at(rotation, strained, 1, unstressed, q);
    for (int i = 0; i < 3; i++) {
        x[1].r[i] = l0 * unstressed[i];
        x[1].u[i] = l0 * (unstressed[i] - arc[i]);
        x[0].R[4 * i] = 1;
    }
    rotation_matrix(q, x[1].R);
    out->chord = l0 * vec3_norm(arc);
    out->torsion = k[0];
    sheet_strains_evaluate(out, x, &(strain_output){.e = rest});
    memcpy(out->rest, rest, sizeof rest);
}
