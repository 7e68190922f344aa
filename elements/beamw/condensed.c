#include "elements/beamw/condensed.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

enum {
    E = BEAMW_STRAINS,
    N = BEAMW_MODIFIED_VARIABLES,
    M = BEAMW_MODIFIED,
    EVEN = BEAMW_CONDENSED_EVEN,
    ALL = BEAMW_CONDENSED_ALL,
    INNER = 6,
    MOST = 30
};
static const double close_enough =
    1e-7; /* of the size of z: what is left is of the size of its square */

/* Uniform torsion: no A, no warping part, rows and columns of z_w empty. */
static void without_warping(beamw_condensed *out)
{
    for (int r = 0; r < ALL; r++) {
        out->P[r][1] += out->P[r][6] + out->P[r][7];
        out->P[r][6] = out->P[r][7] = 0;
        beamw_variants_merge_torsion(N, out->Q[r]);
        for (int i = 0; i < N; i++)
            out->Q[r][N * i + N - 1] = out->Q[r][N * (N - 1) + i] = 0;
    }
    memset(out->P[ALL - 1], 0, sizeof out->P[0]);
    memset(out->Q[ALL - 1], 0, sizeof out->Q[0]);
    for (int i = 0; i < 3; i++) {
        out->f[6 + i] = out->f[3 * i + 2] = 0;
        out->hg[E * i + 1] += out->hg[E * i + 6] + out->hg[E * i + 7];
        out->hg[E * i + 6] = out->hg[E * i + 7] = 0;
    }
    memset(out->hg + 2 * E, 0, E * sizeof(double));
}

void beamw_condensed_prepare(const section *c, double l, int shear, int warping,
                             const beamw_twist *t, const beamw_stiffness_fields *fields,
                             double Q[BEAMW_MODIFIED][N * N], beamw_condensed *out)
{
    const double l3 = l * l * l;
    const double k[EVEN] = {c->young * c->A / l, c->shear_modulus * c->It / l3,
                            c->young * c->Iy / l3, c->young * c->Iz / l3, t->opposite};
    const double Ka[3] = {12 * c->young * c->Iz / l, 12 * c->young * c->Iy / l, t->uneven};
    const double P[EVEN][E] = {
        {1}, {0, 1}, {0, 0, 1, 1}, {0, 0, 0, 0, 1, 1}, {0, 0, 0, 0, 0, 0, 0.5, -0.5}};
    memcpy(out->k, k, sizeof k);
    memcpy(out->Ka, Ka, sizeof Ka);
    memcpy(out->P, P, sizeof P);
    memcpy(out->P[EVEN], fields->h, 3 * sizeof out->P[0]);
    memcpy(out->hg, fields->hg, sizeof out->hg);
    for (int i = 0; i < 9; i++)
        out->f[i] = shear ? c->F[i] / (c->shear_modulus * l) : 0;
    memset(out->Q, 0, sizeof out->Q);
    for (int r = 0; r < ALL; r++)
        for (int j = 0; j < M; j++)
            if (out->P[r][j] != 0)
                for (int i = 0; i < N * N; i++)
                    out->Q[r][i] += out->P[r][j] * Q[j][i];
    if (!warping)
        without_warping(out);
}

typedef struct internal_modes {
    double y[N], q[3];
    double B[ALL][N];              /* d(u, h)/dy */
    double u[ALL], dual[ALL];      /* (u, h), and k u, q */
    double r[INNER];               /* of z, of q */
    double hessian[INNER * INNER]; /* of z, q */
} internal_modes;

static void evaluate(const beamw_condensed *d, internal_modes *s)
{
    for (int r = 0; r < ALL; r++) {
        s->u[r] = 0;
        for (int i = 0; i < N; i++) {
            const double *Q = d->Q[r] + N * i, linear = i < E ? d->P[r][i] : 0;
            double row = 0;
            for (int j = 0; j < N; j++)
                row += Q[j] * s->y[j];
            s->B[r][i] = linear + row;
            s->u[r] += (linear + row / 2) * s->y[i];
        }
        s->dual[r] = r < EVEN ? d->k[r] * s->u[r] : s->q[r - EVEN];
    }
}

/* Entry (i, j) of sum k_r B_r B_r^T + dual_r Q_r. */
static double curvature(const beamw_condensed *d, const internal_modes *s, int i, int j)
{
    double sum = 0;
    for (int r = 0; r < EVEN; r++)
        sum += d->k[r] * s->B[r][i] * s->B[r][j];
    for (int r = 0; r < ALL; r++)
        sum += s->dual[r] * d->Q[r][N * i + j];
    return sum;
}

static void inner_equations(const beamw_condensed *d, internal_modes *s)
{
    for (int i = 0; i < 3; i++) {
        double *z = s->hessian + INNER * i, *q = s->hessian + INNER * (3 + i);
        s->r[i] = d->Ka[i] * s->y[E + i] - s->q[i];
        for (int r = 0; r < ALL; r++)
            s->r[i] += s->dual[r] * s->B[r][E + i];
        s->r[3 + i] = s->u[EVEN + i] - s->y[E + i];
        for (int j = 0; j < 3; j++) {
            s->r[3 + i] -= d->f[3 * i + j] * s->q[j];
            z[j] = curvature(d, s, E + i, E + j) + (i == j ? d->Ka[i] : 0);
            z[3 + j] = s->B[EVEN + j][E + i] - (i == j);
            q[j] = s->B[EVEN + i][E + j] - (i == j);
            q[3 + j] = -d->f[3 * i + j];
        }
    }
}

/* Newton's method for z and q; 0 when it converged. */
static int settle(const beamw_condensed *d, internal_modes *s)
{
    for (int count = 0; count < MOST; count++) {
        double change = 0, size = 0, K[INNER * INNER];
        int pivot[INNER];
        evaluate(d, s);
        inner_equations(d, s);
        memcpy(K, s->hessian, sizeof K);
        if (dense_lu(INNER, K, pivot) != 0)
            return 1;
        dense_lu_solve(INNER, 1, K, pivot, s->r);
        for (int i = 0; i < 3; i++) {
            double reach = fabs(s->y[E + i]);
            for (int k = 0; k < E; k++)
                reach += fabs(d->P[EVEN + i][k] * s->y[k]);
            change += d->Ka[i] * s->r[i] * s->r[i];
            size += d->Ka[i] * reach * reach;
            s->y[E + i] -= s->r[i];
            s->q[i] -= s->r[3 + i];
        }
        if (change <= close_enough * close_enough * size)
            return 0;
        if (!isfinite(change))
            return 1;
    }
    return 1;
}

/* C = C_ee - C_ei K^-1 C_ie. */
static int condense(const beamw_condensed *d, internal_modes *s, double C[E * E])
{
    double mixed[INNER * E], solved[INNER * E];
    int pivot[INNER];
    inner_equations(d, s);
    for (int j = 0; j < E; j++) {
        for (int i = 0; i < 3; i++) {
            mixed[E * i + j] = curvature(d, s, E + i, j);
            mixed[E * (3 + i) + j] = s->B[EVEN + i][j];
        }
        for (int i = 0; i <= j; i++)
            C[E * i + j] = curvature(d, s, i, j);
    }
    memcpy(solved, mixed, sizeof solved);
    if (dense_lu(INNER, s->hessian, pivot) != 0)
        return 1;
    dense_lu_solve(INNER, E, s->hessian, pivot, solved);
    for (int i = 0; i < E; i++)
        for (int j = i; j < E; j++) {
            for (int k = 0; k < INNER; k++)
                C[E * i + j] -= mixed[E * k + i] * solved[E * k + j];
            C[E * j + i] = C[E * i + j];
        }
    return 0;
}

static double energy(const beamw_condensed *d, const internal_modes *s)
{
    double sum = 0;
    for (int r = 0; r < EVEN; r++)
        sum += s->dual[r] * s->u[r] / 2;
    for (int i = 0; i < 3; i++) {
        sum += d->Ka[i] * s->y[E + i] * s->y[E + i] / 2 + s->q[i] * (s->u[EVEN + i] - s->y[E + i]);
        for (int j = 0; j < 3; j++)
            sum -= s->q[i] * d->f[3 * i + j] * s->q[j] / 2;
    }
    return sum;
}

status beamw_condensed_stress(const beamw_condensed *d, const double e[E], stress_output *out)
{
    internal_modes s;
    memcpy(s.y, e, E * sizeof *e);
    dense_mul_vec(3, E, d->hg, e, s.y + E);
    for (int i = 0; i < 3; i++)
        s.q[i] = d->Ka[i] * s.y[E + i];
    if (settle(d, &s) != 0)
        return STATUS_NOT_CONVERGED;
    evaluate(d, &s);
    if (out->energy != NULL)
        *out->energy = energy(d, &s);
    if (out->sigma != NULL)
        for (int i = 0; i < E; i++) {
            out->sigma[i] = 0;
            for (int r = 0; r < ALL; r++)
                out->sigma[i] += s.dual[r] * s.B[r][i];
        }
    if (out->residual != NULL)
        *out->residual = 0;
    return out->C != NULL && condense(d, &s, out->C) != 0 ? STATUS_SINGULAR : STATUS_OK;
}
