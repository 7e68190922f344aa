#include "elements/geometrically_exact/fields.h"

#include <math.h>
#include <string.h>

#include "elements/geometrically_exact/line.h"
#include "elements/math/dense.h"
#include "elements/math/quadrature.h"

static void add_square(exact_fields *f, double k, const double row[])
{
    for (int i = 0; i < f->free; i++)
        if (row[i] != 0)
            for (int j = 0; j < f->free; j++)
                f->energy[i * f->all + j] += k * row[i] * row[j];
}

static void add_product(exact_fields *f, double k, int i, int j)
{
    f->energy[i * f->all + j] += k;
    f->energy[j * f->all + i] += k;
}

/* a and a' at x as rows on (strains, bubbles). */
static void amplitude(const exact_fields *f, double x, double a[EXACT_FIELDS_MAX_FREE],
                      double da[EXACT_FIELDS_MAX_FREE])
{
    double at[ELEMENT_MAX_NODES], L[ELEMENT_MAX_NODES], dL[ELEMENT_MAX_NODES], bubble = 1,
                                                                               slope = 0;
    memset(a, 0, EXACT_FIELDS_MAX_FREE * sizeof *a);
    memset(da, 0, EXACT_FIELDS_MAX_FREE * sizeof *da);
    for (int k = 0; k < f->nodes; k++) {
        at[k] = (double)k / (f->nodes - 1);
        slope = slope * 4 * (x - at[k]) + bubble * 4;
        bubble *= 4 * (x - at[k]);
    }
    exact_line_lagrange(f->nodes, at, x, L, dL);
    for (int k = 0; k < f->nodes; k++) {
        a[6 * f->points + k] = L[k];
        da[6 * f->points + k] = dL[k];
    }
    /* prod (x - x_k) times Legendre's polynomials 1, 2 x - 1 */
    const double factor[2] = {1, 2 * x - 1}, rate[2] = {0, 2};
    for (int j = 0; j < f->warping_bubbles; j++) {
        a[f->strains + j] = bubble * factor[j];
        da[f->strains + j] = slope * factor[j] + bubble * rate[j];
    }
}

static void twist_fields(exact_fields *f)
{
    double a[EXACT_STIFFNESS_MAX_FIELD][EXACT_FIELDS_MAX_FREE];
    for (int i = 0; i < f->field; i++) {
        exact_line_lagrange(f->points, f->x, f->at[i], f->through[i], NULL);
        for (int g = 0; g < f->points; g++)
            f->twist[i][6 * g + 3] = f->through[i][g];
        if (f->warping_bubbles == 0)
            continue;
        amplitude(f, f->at[i], a[i], f->slope[i]);
        for (int g = 0; g < f->points; g++)
            for (int k = 0; k < f->free; k++)
                f->mean[g][k] += f->weight[i] * f->through[i][g] / f->w[g] * a[i][k];
    }
    if (f->warping_bubbles > 0)
        for (int i = 0; i < f->field; i++)
            for (int k = 0; k < f->free; k++) {
                f->twist[i][k] += a[i][k];
                for (int g = 0; g < f->points; g++)
                    f->twist[i][k] -= f->through[i][g] * f->mean[g][k];
            }
}

/* -1/2 w/(k EI) (Q -+ M')^2: what the part of the moment above the points' polynomial makes
 * flexible, M' its slope. */
static void residual_bending(exact_fields *f, int g, int Q, int M, double sign, double flexibility)
{
    double row[EXACT_FIELDS_MAX_ALL] = {0}; /* on Q, M of the points */
    row[f->free + EXACT_FIELDS_STRESSES * g + Q] = 1;
    if (f->points == 2)
        for (int h = 0; h < 2; h++)
            row[f->free + EXACT_FIELDS_STRESSES * h + M] =
                -sign * (h == 0 ? -1 : 1) / (f->x[1] - f->x[0]);
    for (int i = f->free; i < f->all; i++)
        for (int j = f->free; j < f->all; j++)
            f->energy[i * f->all + j] -= f->w[g] * flexibility * row[i] * row[j];
}

/* Stress times strain less half of stress times flexibility, at one point; shears are those of the
 * shear centre. */
static void energy_of_point(const beam_constants *c, exact_fields *f, int g)
{
    const int e = 6 * g, Q = f->free + EXACT_FIELDS_STRESSES * g;
    const double w = f->w[g];
    f->energy[e * (f->all + 1)] += w * c->EA;
    add_product(f, w, Q, e + 1);
    add_product(f, -w * c->zs, Q, e + 3);
    add_product(f, w, Q + 1, e + 2);
    add_product(f, w * c->ys, Q + 1, e + 3);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (f->warping_bubbles > 0 || (i < 2 && j < 2))
                f->energy[(Q + i) * f->all + Q + j] -= w * c->F[3 * i + j];
    if (f->warping_bubbles == 0)
        f->energy[(Q + 2) * (f->all + 1)] = -1; /* no bimoment, hence no warping torque */
    else
        add_product(f, w, Q + 2, e + 3);
    if (f->warping_bubbles > 0)
        for (int k = 0; k < f->free; k++)
            if (f->mean[g][k] != 0)
                add_product(f, -w * f->mean[g][k], Q + 2, k);
    add_product(f, w, Q + 3, e + 4);
    add_product(f, w, Q + 4, e + 5);
    f->energy[(Q + 3) * (f->all + 1)] -= w / c->EIy;
    f->energy[(Q + 4) * (f->all + 1)] -= w / c->EIz;
    const int rigid = !(c->F[0] > 0 && c->F[4] > 0);
    if (f->points > 1 && !rigid)
        return;
    /* int (M - polynomial)^2 for a linear and for a quadratic moment */
    const double part = f->points == 1 ? 1.0 / 12 : 1.0 / 60;
    residual_bending(f, g, 0, 4, -1, part / c->EIz); /* Q_y = -M_z' */
    residual_bending(f, g, 1, 3, 1, part / c->EIy);  /* Q_z = M_y' */
}

static void energy_of_fields(const beam_constants *c, exact_fields *f)
{
    for (int i = 0; i < f->field; i++) {
        add_square(f, f->weight[i] * c->GJ, f->twist[i]);
        add_square(f, f->weight[i] * c->EIw, f->slope[i]);
    }
    for (int g = 0; g < f->points; g++)
        energy_of_point(c, f, g);
}

int exact_fields_eliminate(const exact_fields *f, double X[])
{
    const int n = f->all - f->strains, m = f->strains;
    double A[EXACT_FIELDS_MAX_ALL * EXACT_FIELDS_MAX_ALL];
    int pivot[EXACT_FIELDS_MAX_ALL];
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            A[i * n + j] = f->energy[(m + i) * f->all + m + j];
        for (int j = 0; j < m; j++)
            X[i * m + j] = -f->energy[(m + i) * f->all + j];
    }
    const int failed = dense_lu(n, A, pivot);
    if (failed == 0)
        dense_lu_solve(n, m, A, pivot, X);
    return failed;
}

void exact_fields_prepare(const beam_constants *c, int nodes, exact_fields *f)
{
    memset(f, 0, sizeof *f);
    f->nodes = nodes;
    f->points = nodes - 1;
    f->strains = 6 * f->points + nodes;
    f->warping_bubbles = c->warping ? f->points : 0;
    f->free = f->strains + f->warping_bubbles;
    f->all = f->free + EXACT_FIELDS_STRESSES * f->points;
    f->field = 4 * f->points + 1;
    quadrature_points(f->points, f->x, f->w);
    quadrature_points(f->field, f->at, f->weight);
    twist_fields(f);
    energy_of_fields(c, f);
}
