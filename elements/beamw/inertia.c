/* Linear fields (formulation of J section 3.2, shear functionals as in stiffness.h), x = s/l, c = x (1 - x):
 *   v_s = chord - [(e5+e6)/2 c + l hg_y c (1-2x)],  w_s = chord + [(e3+e4)/2 c - l hg_z c (1-2x)],
 *   l phi = l phi_p + e2 x + A c - tw c (1-2x),     v_c = v_s + zs phi,  w_c = w_s - ys phi,
 *   theta_z = v_s' - g_y,  theta_y = -(w_s' - g_z),  a = phi' - g_w. */
#include "elements/beamw/inertia.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/lumped.h"

enum { N = 14, FIELDS = 7 };
typedef enum field { U, V, W, PHI, THETA_Y, THETA_Z, WARP } field;

/* e = L x of small motions in element axes. */
static void linear_strains(double l, double L[8][N])
{
    memset(L, 0, 8 * sizeof L[0]);
    L[0][0] = -1, L[0][7] = 1;
    L[1][3] = -l, L[1][10] = l;
    L[2][2] = 1, L[2][9] = -1, L[2][4] = -l;
    L[3][2] = -1, L[3][9] = 1, L[3][11] = l;
    L[4][1] = -1, L[4][8] = 1, L[4][5] = -l;
    L[5][1] = 1, L[5][8] = -1, L[5][12] = l;
    L[6][6] = L[7][13] = l * l;
}

static void add_strain(double row[N], double factor, const double functional[8], double L[8][N])
{
    for (int k = 0; k < 8; k++)
        for (int j = 0; j < N; j++)
            row[j] += factor * functional[k] * L[k][j];
}

/* Rows of the seven fields at x as functions of the 14 coordinates. */
static void fields_at(const section *c, double l, const stiffness_fields *s, double L[8][N], double x, double F[FIELDS][N])
{
    const double e1[8] = {1}, e2[8] = {0, 1}, sum_y[8] = {0, 0, 1, 1}, sum_z[8] = {0, 0, 0, 0, 1, 1};
    const double b = x * (1 - x), cubic = b * (1 - 2 * x), db = 1 - 2 * x, dcubic = 1 - 6 * b;
    double phi[N] = {0}, dphi[N] = {0};
    memset(F, 0, FIELDS * sizeof F[0]);
    phi[3] = 1;
    add_strain(phi, x / l, e2, L);
    add_strain(phi, b / l, s->A, L);
    add_strain(phi, -cubic / l, s->tw, L);
    add_strain(dphi, 1 / (l * l), e2, L);
    add_strain(dphi, db / (l * l), s->A, L);
    add_strain(dphi, -dcubic / (l * l), s->tw, L);

    F[U][0] = 1;
    add_strain(F[U], x, e1, L);
    /* Chord of the shear centre: v_s = v - zs phi, w_s = w + ys phi at the nodes. */
    F[V][1] = 1 - x, F[V][8] = x, F[V][3] = -c->zs * (1 - x), F[V][10] = -c->zs * x;
    F[W][2] = 1 - x, F[W][9] = x, F[W][3] = c->ys * (1 - x), F[W][10] = c->ys * x;
    add_strain(F[V], -b / 2, sum_z, L);
    add_strain(F[V], -l * cubic, s->hg[0], L);
    add_strain(F[W], b / 2, sum_y, L);
    add_strain(F[W], -l * cubic, s->hg[1], L);
    F[THETA_Z][1] = -1 / l, F[THETA_Z][8] = 1 / l, F[THETA_Z][3] = c->zs / l, F[THETA_Z][10] = -c->zs / l;
    add_strain(F[THETA_Z], -db / (2 * l), sum_z, L);
    add_strain(F[THETA_Z], -dcubic, s->hg[0], L);
    add_strain(F[THETA_Z], -1, s->g[0], L);
    F[THETA_Y][2] = 1 / l, F[THETA_Y][9] = -1 / l, F[THETA_Y][3] = c->ys / l, F[THETA_Y][10] = -c->ys / l;
    add_strain(F[THETA_Y], -db / (2 * l), sum_y, L);
    add_strain(F[THETA_Y], dcubic, s->hg[1], L);
    add_strain(F[THETA_Y], 1, s->g[1], L);
    for (int j = 0; j < N; j++) {
        F[V][j] += c->zs * phi[j];
        F[W][j] -= c->ys * phi[j];
        F[PHI][j] = phi[j];
        F[WARP][j] = dphi[j];
    }
    add_strain(F[WARP], -1, s->g[2], L);
}

static void consistent_matrix(const section *c, double l, const double per_length[FIELDS], const stiffness_fields *s,
                              double L[8][N], double M[N * N])
{
    /* Gauss with four points: exact for the square of a cubic. */
    static const double at[2] = {0.86113631159405257522, 0.33998104358485626480},
                        weight[2] = {0.34785484513745385737, 0.65214515486254614263};
    for (int point = 0; point < 4; point++) {
        const double x = (1 + (point % 2 ? 1 : -1) * at[point / 2]) / 2;
        double F[FIELDS][N];
        fields_at(c, l, s, L, x, F);
        for (int k = 0; k < FIELDS; k++)
            for (int i = 0; i < N; i++)
                for (int j = 0; j < N; j++)
                    M[N * i + j] += weight[point / 2] / 2 * l * per_length[k] * F[k][i] * F[k][j];
    }
}

void inertia_prepare(const section *c, unsigned features, inertia_kind kind, const stiffness_fields *fields, element_data *d)
{
    const double rotary = features & FEATURE_ROTARY_INERTIA ? 1 : 0, warps = features & FEATURE_WARPING ? 1 : 0, rho = c->density;
    const double node[7] = {c->A, c->A, c->A, c->Ip, rotary * c->Iy, rotary * c->Iz, rotary * warps * c->Iw};
    for (int i = 0; i < 7; i++)
        d->lumped[i] = rho * d->l0 / 2 * node[i];
    d->share = kind == INERTIA_LUMPED ? 0 : kind == INERTIA_CONSISTENT ? 1 : 0.5;
    if (d->share == 0)
        return;
    const double per_length[FIELDS] = {rho * node[0], rho * node[1], rho * node[2], rho * node[3],
                                       rho * node[4], rho * node[5], rho * node[6]};
    double L[8][N];
    linear_strains(d->l0, L);
    if (!warps) {
        memcpy(L[6], L[1], sizeof L[6]);
        memcpy(L[7], L[1], sizeof L[7]);
    }
    consistent_matrix(c, d->l0, per_length, fields, L, d->consistent);
}

/* Axes that move with the element: x along the chord, y near the mean of the nodes' y axes. */
static void element_axes(const node_state x[2], double B[9])
{
    double axis[3][3];
    for (int i = 0; i < 3; i++) {
        axis[0][i] = x[1].r[i] - x[0].r[i];
        axis[1][i] = x[0].R[3 * i + 1] + x[1].R[3 * i + 1];
    }
    vec3_cross(axis[0], axis[1], axis[2]);
    const double length = vec3_norm(axis[0]), across = vec3_norm(axis[2]);
    for (int i = 0; i < 3; i++) {
        axis[0][i] /= length;
        axis[2][i] /= across;
    }
    vec3_cross(axis[2], axis[0], axis[1]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            B[3 * i + k] = axis[k][i];
}

/* First index of the vector that coordinate i belongs to, and its length (3, or 1 for warping). */
static int vector_of(int i, int *size)
{
    const int at = i % 7;
    *size = at == 6 ? 1 : 3;
    return at == 6 ? i : i - at % 3;
}

static void add_consistent(const element_data *d, const node_state x[2], double M[N * N])
{
    double B[9];
    element_axes(x, B);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            int rows, columns;
            const int row = vector_of(i, &rows), column = vector_of(j, &columns);
            for (int k = 0; k < rows; k++)
                for (int m = 0; m < columns; m++) {
                    const double turn = (rows == 3 ? B[3 * (i - row) + k] : 1) * (columns == 3 ? B[3 * (j - column) + m] : 1);
                    M[N * i + j] += d->share * turn * d->consistent[N * (row + k) + column + m];
                }
        }
}

/* out(14 x 14) block of node `node`, rotations: += B(3 x 3). */
static void add_rotation_block(int node, double factor, const double B[9], double *out)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[N * (7 * node + 3 + i) + 7 * node + 3 + j] += factor * B[3 * i + j];
}

static void node_inertia(const element_data *d, int node, const node_state *x, const node_rate *v, const node_rate *a,
                         inertia_output *out)
{
    static const double rest[3] = {0, 0, 0};
    const double lumped = 1 - d->share;
    const double *w = v != NULL ? v->w : rest, *alpha = a != NULL ? a->w : rest;
    double J[9], h[3], dh[9], dx[9];
    lumped_rotary(d->lumped, x->R, J);
    if (out->M != NULL) {
        add_rotation_block(node, lumped, J, out->M);
        for (int i = 0; i < 3; i++)
            out->M[(N + 1) * (7 * node + i)] += lumped * d->lumped[i];
        out->M[(N + 1) * (7 * node + 6)] += lumped * d->lumped[6];
    }
    lumped_convective(J, w, h, dh);
    for (int i = 0; i < 3 && out->h != NULL; i++)
        out->h[7 * node + 3 + i] += h[i];
    if (out->dh_dv != NULL)
        add_rotation_block(node, 1, dh, out->dh_dv);
    if (out->dfdx != NULL) {
        lumped_turning(J, w, alpha, dx);
        add_rotation_block(node, 1, dx, out->dfdx);
    }
}

status inertia_of(const element_data *d, const node_state x[], const node_rate v[], const node_rate a[], inertia_output *out)
{
    if ((v != NULL || a != NULL) && d->share != 0)
        return STATUS_REFUSED;
    double *const matrices[] = {out->M, out->dh_dv, out->dfdx};
    for (int k = 0; k < 3; k++)
        if (matrices[k] != NULL)
            memset(matrices[k], 0, N * N * sizeof(double));
    if (out->h != NULL)
        memset(out->h, 0, N * sizeof(double));
    for (int node = 0; node < 2; node++)
        node_inertia(d, node, &x[node], v != NULL ? &v[node] : NULL, a != NULL ? &a[node] : NULL, out);
    if (out->M != NULL && d->share != 0)
        add_consistent(d, x, out->M);
    return STATUS_OK;
}
