#include "elements/sheet/relations.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/quadrature.h"

enum { POINTS = 8, N = RELATIONS_STRAINS }; /* exact to degree 15: products of two cubics and the weight s need 7 */

void relations_shear(const element_request *request, double *Phi_y, double *Phi_z)
{
    const section *c = request->section;
    const double l2 = request->length * request->length;
    const int shear = (request->features & FEATURE_SHEAR) != 0;
    *Phi_y = shear ? 12 * c->young * c->Iz * c->F[0] / (c->shear_modulus * l2) : 0;
    *Phi_z = shear ? 12 * c->young * c->Iy * c->F[4] / (c->shear_modulus * l2) : 0;
}

void relations_fields(double L, double Phi_y, double Phi_z, int warping, double x, double f[FIELD_COUNT][LOCALS])
{
    const double fy = Phi_y / (2 + 2 * Phi_y), fz = Phi_z / (2 + 2 * Phi_z);
    memset(f, 0, FIELD_COUNT * sizeof f[0]);
    /* N Eq. 19, or linear where nothing warps. */
    f[FIELD_PX][LOCAL_PX] = warping ? x * x * (3 - 2 * x) : x;
    f[FIELD_PX1][LOCAL_PX] = (warping ? 6 * x * (1 - x) : 1) / L;
    if (warping) {
        f[FIELD_PX2][LOCAL_PX] = (6 - 12 * x) / (L * L);
        f[FIELD_PX][LOCAL_WP] = L * x * (1 - x) * (1 - x);
        f[FIELD_PX][LOCAL_WQ] = L * x * x * (x - 1);
        f[FIELD_PX1][LOCAL_WP] = 1 - 4 * x + 3 * x * x;
        f[FIELD_PX1][LOCAL_WQ] = x * (3 * x - 2);
        f[FIELD_PX2][LOCAL_WP] = (6 * x - 4) / L;
        f[FIELD_PX2][LOCAL_WQ] = (6 * x - 2) / L;
    }
    /* N Eqs. 14, 15: p and q, then the part of shear that both share. */
    const double p[3] = {L * x * (1 - x) * (1 - x), 1 - 4 * x + 3 * x * x, (6 * x - 4) / L};
    const double q[3] = {L * x * x * (x - 1), x * (3 * x - 2), (6 * x - 2) / L};
    const double both[3] = {L * x * (-1 + x * (3 - 2 * x)), -1 + 6 * x * (1 - x), (6 - 12 * x) / L};
    for (int k = 0; k < 3; k++) {
        f[FIELD_UY + k][LOCAL_ZP] = p[k] + fy * both[k];
        f[FIELD_UY + k][LOCAL_ZQ] = q[k] + fy * both[k];
        f[FIELD_UZ + k][LOCAL_YP] = -p[k] - fz * both[k];
        f[FIELD_UZ + k][LOCAL_YQ] = -q[k] - fz * both[k];
    }
}

/* Q += c (a b^T + b a^T). */
static void add(double Q[LOCALS * LOCALS], double c, const double a[LOCALS], const double b[LOCALS])
{
    for (int i = 0; i < LOCALS; i++)
        for (int j = 0; j < LOCALS; j++)
            Q[LOCALS * i + j] += c * (a[i] * b[j] + b[i] * a[j]);
}

/* Second-order strains of N Eq. 7 at one point, weighted into the eight integrals. */
static void add_point(double L, double Phi_y, double Phi_z, double trapeze, int warping, double x, double w, double Q[N][N * N])
{
    const double ds = w * L, s = x * L;
    double f[FIELD_COUNT][LOCALS], phi_y[LOCALS], phi_z[LOCALS], tilt_y[LOCALS], tilt_z[LOCALS], gap_y[LOCALS], gap_z[LOCALS];
    relations_fields(L, Phi_y, Phi_z, warping, x, f);
    for (int k = 0; k < LOCALS; k++) {
        const double gy = k == LOCAL_ZP || k == LOCAL_ZQ ? -Phi_y / (2 + 2 * Phi_y) : 0; /* constant shear angles */
        const double gz = k == LOCAL_YP || k == LOCAL_YQ ? Phi_z / (2 + 2 * Phi_z) : 0;
        phi_z[k] = f[FIELD_UY1][k] - gy;
        phi_y[k] = -f[FIELD_UZ1][k] + gz;
        tilt_y[k] = phi_y[k] / 2 + f[FIELD_UZ1][k]; /* of g_x = u_x' - phi_y (phi_y/2 + u_z') - phi_z (phi_z/2 - u_y') */
        tilt_z[k] = phi_z[k] / 2 - f[FIELD_UY1][k];
        gap_y[k] = phi_y[k] + f[FIELD_UZ1][k]; /* g_y = g_y0 + phi_x (phi_y + u_z') */
        gap_z[k] = phi_z[k] - f[FIELD_UY1][k]; /* g_z = g_z0 + phi_x (phi_z - u_y') */
    }
    double phi_y1[LOCALS], phi_z1[LOCALS];
    for (int k = 0; k < LOCALS; k++) {
        phi_y1[k] = -f[FIELD_UZ2][k];
        phi_z1[k] = f[FIELD_UY2][k];
    }
    const double *px = f[FIELD_PX], *px1 = f[FIELD_PX1];
    add(Q[0], -ds, phi_y, tilt_y);
    add(Q[0], -ds, phi_z, tilt_z);
    add(Q[0], trapeze * ds / 2, px1, px1);
    add(Q[1], L * ds, phi_y1, phi_z); /* kappa_x = phi_x' + phi_y' phi_z */
    add(Q[6], L * ds, phi_y1, phi_z);
    add(Q[7], L * ds, phi_y1, phi_z);
    add(Q[2], (L - s) * ds, phi_z1, px); /* kappa_y = phi_y' + phi_z' phi_x */
    add(Q[3], s * ds, phi_z1, px);
    add(Q[4], -(L - s) * ds, phi_y1, px); /* kappa_z = phi_z' - phi_y' phi_x */
    add(Q[5], -s * ds, phi_y1, px);
    add(Q[2], -ds, px, gap_z);
    add(Q[3], ds, px, gap_z);
    add(Q[4], ds, px, gap_y);
    add(Q[5], -ds, px, gap_y);
}

void relations_add_terms(relations_map *map, int row, const double Q[N * N])
{
    double largest = 0;
    for (int i = 0; i < N * N; i++)
        largest = fmax(largest, fabs(Q[i]));
    for (int a = 0; a < N; a++)
        for (int b = a; b < N; b++)
            if (fabs(Q[N * a + b]) > 1e-15 * largest && map->terms < RELATIONS_MAX_TERMS)
                map->term[map->terms++] = (relations_term){row, a, b, Q[N * a + b]};
}

void relations_apply(const relations_map *map, const double x[N], double y[N], double dy[N][N])
{
    for (int k = 0; k < N; k++)
        y[k] = map->linear[k] * x[k];
    for (int i = 0; i < map->terms; i++) {
        const relations_term *t = &map->term[i];
        y[t->row] += (t->a == t->b ? 0.5 : 1) * t->value * x[t->a] * x[t->b];
    }
    if (dy == NULL)
        return;
    memset(dy, 0, N * sizeof dy[0]);
    for (int k = 0; k < N; k++)
        dy[k][k] = map->linear[k];
    for (int i = 0; i < map->terms; i++) {
        const relations_term *t = &map->term[i];
        dy[t->row][t->a] += t->value * x[t->b];
        if (t->a != t->b)
            dy[t->row][t->b] += t->value * x[t->a];
    }
}

void relations_add_second(const relations_map *map, const double w[N], double H[N * N])
{
    for (int i = 0; i < map->terms; i++) {
        const relations_term *t = &map->term[i];
        const double value = w[t->row] * t->value;
        H[N * t->a + t->b] += value;
        if (t->a != t->b)
            H[N * t->b + t->a] += value;
    }
}

status relations_prepare(const element_request *request, double Phi_y, double Phi_z, relations *r, fault *f)
{
    double x[POINTS], w[POINTS], Q[N][N * N] = {{0}};
    const section *c = request->section;
    const double L = request->length, linear[N] = {1, L, -L, L, -L, L, L * L, L * L};
    memset(r, 0, sizeof *r);
    if (!(L > 0) || !isfinite(L))
        return fault_set(f, STATUS_REFUSED, "element length %g m: it must be positive", L);
    const status made = quadrature_points(POINTS, x, w, f);
    if (made != STATUS_OK)
        return made;
    r->length = L;
    memcpy(r->map.linear, linear, sizeof linear);
    for (int i = 0; i < POINTS; i++)
        add_point(L, Phi_y, Phi_z, request->features & FEATURE_TRAPEZE ? c->Ip / c->A : 0,
                  (request->features & FEATURE_WARPING) != 0, x[i], w[i], Q);
    for (int k = 0; k < N; k++)
        relations_add_terms(&r->map, k, Q[k]);
    return STATUS_OK;
}

void relations_strain(const relations *r, const node_state x[2], strain_output *out)
{
    local_frame l;
    double A[N][LOCALS], e[N]; /* de_k/dx_a */
    const int second = out->s != NULL && out->H != NULL;
    local_evaluate(r->length, x, second ? 2 : out->J != NULL ? 1 : 0, &l);
    relations_apply(&r->map, l.value, e, A);
    if (out->e != NULL)
        memcpy(out->e, e, sizeof e);
    if (out->J != NULL)
        dense_mul(N, LOCALS, 14, &A[0][0], &l.gradient[0][0], out->J);
    if (!second)
        return;
    double w[LOCALS] = {0}, S[LOCALS * LOCALS] = {0}, work[LOCALS * 14];
    for (int k = 0; k < N; k++)
        for (int a = 0; a < LOCALS; a++)
            w[a] += out->s[k] * A[k][a];
    relations_add_second(&r->map, out->s, S);
    memset(out->H, 0, 14 * 14 * sizeof(double));
    dense_add_congruence(LOCALS, 14, &l.gradient[0][0], S, out->H, work);
    local_add_hessian(&l, w, out->H);
}
