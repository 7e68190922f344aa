#include "elements/beamw/follow.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

enum { E = FORMS_STRAINS, N = MODIFIED_VARIABLES, M = FORMS_MODIFIED, INNER = 6, MOST = 30 };
static const double close_enough = 1e-12; /* of the size of z: Newton's next correction would be its square */

void follow_prepare(const section *c, double l, int shear, int warping, const twist *t, const stiffness_fields *fields, follow *out)
{
    const double Ka[3] = {12 * c->young * c->Iz / l, 12 * c->young * c->Iy / l, t->uneven};
    stiffness_even(c, l, t, fields, out->S0);
    memcpy(out->Ka, Ka, sizeof Ka);
    for (int i = 0; i < 9; i++)
        out->f[i] = shear ? c->F[i] / (c->shear_modulus * l) : 0;
    memcpy(out->H, fields->h, sizeof out->H);
    memcpy(out->hg, fields->hg, sizeof out->hg);
    if (warping)
        return;
    forms_merge_torsion(E, out->S0);
    for (int k = 0; k < M; k++) {
        forms_merge_torsion(N, out->Q[k]);
        for (int i = 0; i < N; i++)
            out->Q[k][N * i + N - 1] = out->Q[k][N * (N - 1) + i] = 0;
    }
    for (int i = 0; i < 3; i++)
        out->f[6 + i] = out->f[3 * i + 2] = 0;
    for (int i = 0; i < 2; i++) {
        double *rows[2] = {out->H + E * i, out->hg + E * i};
        for (int k = 0; k < 2; k++) {
            rows[k][1] += rows[k][6] + rows[k][7];
            rows[k][6] = rows[k][7] = 0;
        }
    }
    memset(out->H + 2 * E, 0, E * sizeof(double));
    memset(out->hg + 2 * E, 0, E * sizeof(double));
}

typedef struct inside {
    double y[N], q[3];
    double B[E][N];                /* d(ebar)/dy */
    double ebar[E], c[E];          /* and the stress dual to it */
    double r[INNER];               /* of z, of q */
    double hessian[INNER * INNER]; /* of z, q */
} inside;

/* sum_k c_k Q_k + B^T S0 B, entry (i, j). */
static double curvature(const follow *d, const inside *s, double SB[E][N], int i, int j)
{
    double sum = 0;
    for (int k = 0; k < E; k++)
        sum += s->B[k][i] * SB[k][j];
    for (int k = 0; k < M; k++)
        sum += s->c[k] * d->Q[k][N * i + j];
    return sum;
}

static void evaluate(const follow *d, inside *s)
{
    memset(s->B, 0, sizeof s->B);
    for (int k = 0; k < E; k++) {
        s->ebar[k] = s->y[k];
        s->B[k][k] = 1;
    }
    for (int k = 0; k < M; k++)
        for (int i = 0; i < N; i++) {
            double row = 0;
            for (int j = 0; j < N; j++)
                row += d->Q[k][N * i + j] * s->y[j];
            s->B[k][i] += row;
            s->ebar[k] += row * s->y[i] / 2;
        }
    dense_mul_vec(E, E, d->S0, s->ebar, s->c);
    dense_add_transpose_mul(E, 3, 1, d->H, s->q, s->c);
}

static void products(const follow *d, const inside *s, double SB[E][N], double HB[3][N])
{
    dense_mul(E, E, N, d->S0, &s->B[0][0], &SB[0][0]);
    dense_mul(3, E, N, d->H, &s->B[0][0], &HB[0][0]);
}

static void inner_equations(const follow *d, inside *s, double SB[E][N], double HB[3][N])
{
    for (int i = 0; i < 3; i++) {
        double *z = s->hessian + INNER * i, *q = s->hessian + INNER * (3 + i), h = 0;
        s->r[i] = d->Ka[i] * s->y[E + i] - s->q[i];
        for (int k = 0; k < E; k++) {
            s->r[i] += s->c[k] * s->B[k][E + i];
            h += d->H[E * i + k] * s->ebar[k];
        }
        s->r[3 + i] = h - s->y[E + i];
        for (int j = 0; j < 3; j++) {
            s->r[3 + i] -= d->f[3 * i + j] * s->q[j];
            z[j] = curvature(d, s, SB, E + i, E + j) + (i == j ? d->Ka[i] : 0);
            z[3 + j] = HB[j][E + i] - (i == j);
            q[j] = HB[i][E + j] - (i == j);
            q[3 + j] = -d->f[3 * i + j];
        }
    }
}

/* Newton's method for z and q; 0 when it converged. */
static int settle(const follow *d, inside *s)
{
    for (int count = 0; count < MOST; count++) {
        double SB[E][N], HB[3][N], change = 0, size = 0, K[INNER * INNER];
        int pivot[INNER];
        evaluate(d, s);
        products(d, s, SB, HB);
        inner_equations(d, s, SB, HB);
        memcpy(K, s->hessian, sizeof K);
        if (dense_lu(INNER, K, pivot) != 0)
            return 1;
        dense_lu_solve(INNER, 1, K, pivot, s->r);
        for (int i = 0; i < 3; i++) {
            double reach = fabs(s->y[E + i]);
            for (int k = 0; k < E; k++)
                reach += fabs(d->H[E * i + k] * s->y[k]);
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
static int condense(const follow *d, inside *s, double C[E * E])
{
    double SB[E][N], HB[3][N], mixed[INNER * E], solved[INNER * E];
    int pivot[INNER];
    products(d, s, SB, HB);
    inner_equations(d, s, SB, HB);
    for (int j = 0; j < E; j++) {
        for (int i = 0; i < 3; i++) {
            mixed[E * i + j] = curvature(d, s, SB, E + i, j);
            mixed[E * (3 + i) + j] = HB[i][j];
        }
        for (int i = 0; i < E; i++)
            C[E * i + j] = curvature(d, s, SB, i, j);
    }
    memcpy(solved, mixed, sizeof solved);
    if (dense_lu(INNER, s->hessian, pivot) != 0)
        return 1;
    dense_lu_solve(INNER, E, s->hessian, pivot, solved);
    for (int i = 0; i < E; i++)
        for (int j = 0; j < E; j++)
            for (int k = 0; k < INNER; k++)
                C[E * i + j] -= mixed[E * k + i] * solved[E * k + j];
    return 0;
}

status follow_stress(const follow *d, const double e[E], stress_output *out)
{
    inside s;
    memcpy(s.y, e, E * sizeof *e);
    dense_mul_vec(3, E, d->hg, e, s.y + E);
    for (int i = 0; i < 3; i++)
        s.q[i] = d->Ka[i] * s.y[E + i];
    if (settle(d, &s) != 0)
        return STATUS_NOT_CONVERGED;
    evaluate(d, &s);
    if (out->energy != NULL) {
        double energy = 0;
        for (int k = 0; k < E; k++)
            energy += s.ebar[k] * s.c[k] / 2; /* S0 ebar + H^T q */
        for (int i = 0; i < 3; i++) {
            double h = 0;
            for (int k = 0; k < E; k++)
                h += d->H[E * i + k] * s.ebar[k];
            energy += d->Ka[i] * s.y[E + i] * s.y[E + i] / 2 + s.q[i] * (h / 2 - s.y[E + i]);
            for (int j = 0; j < 3; j++)
                energy -= s.q[i] * d->f[3 * i + j] * s.q[j] / 2;
        }
        *out->energy = energy;
    }
    if (out->sigma != NULL)
        for (int i = 0; i < E; i++) {
            out->sigma[i] = 0;
            for (int k = 0; k < E; k++)
                out->sigma[i] += s.c[k] * s.B[k][i];
        }
    if (out->residual != NULL)
        *out->residual = 0;
    return out->C != NULL && condense(d, &s, out->C) != 0 ? STATUS_SINGULAR : STATUS_OK;
}
