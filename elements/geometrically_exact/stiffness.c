#include <math.h>
#include <string.h>

#include "elements/geometrically_exact/exact.h"
#include "elements/geometrically_exact/stressed.h"
#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "elements/shared/beam_constants.h"

enum { ALL = 6 };

/* Adds 1/12 A^T Fkk A to F, where A (N, Q, M) = (0, Qz, -Qy) is the slope of the moment. */
static void add_linear_moment(double F[36])
{
    static const int shear[] = {2, 1}, moment[] = {4, 5};
    static const double sign[] = {1, -1};
    double added[4];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            added[2 * i + j] = sign[i] * sign[j] * F[ALL * moment[i] + moment[j]] / 12;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            F[ALL * shear[i] + shear[j]] += added[2 * i + j];
}

status exact_coupled_stiffness(const beam_constants *c, int points, int strains, double length,
                               double S[], fault *f)
{
    const double unit = c->energy / (length * length);
    double x[EXACT_MAX_NODES], w[EXACT_MAX_NODES], C[36], F[36];
    quadrature_points(points, x, w);
    memcpy(C, c->C, sizeof C);
    if (points == 1) {
        int failed = beam_coupled_inverse(ALL, c->C, F);
        add_linear_moment(F);
        failed = failed != 0 || beam_coupled_inverse(ALL, F, C) != 0;
        if (failed)
            return beam_coupled_too_stiff(length, f);
    }
    for (int g = 0; g < points; g++)
        for (int i = 0; i < ALL; i++)
            for (int j = 0; j < ALL; j++)
                S[(ALL * g + i) * strains + ALL * g + j] = unit * w[g] * C[ALL * i + j];
    return STATUS_OK;
}

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

/* Computes a and a' at x as row vectors, which multiply the strains and the bubble functions. */
static void amplitude(const exact_fields *f, double x, double a[EXACT_FIELDS_MAX_FREE],
                      double da[EXACT_FIELDS_MAX_FREE])
{
    double at[EXACT_MAX_NODES], L[EXACT_MAX_NODES], dL[EXACT_MAX_NODES], bubble = 1, slope = 0;
    memset(a, 0, EXACT_FIELDS_MAX_FREE * sizeof *a);
    memset(da, 0, EXACT_FIELDS_MAX_FREE * sizeof *da);
    for (int k = 0; k < f->nodes; k++) {
        at[k] = (double)k / (f->nodes - 1);
        slope = slope * 4 * (x - at[k]) + bubble * 4;
        bubble *= 4 * (x - at[k]);
    }
    lagrange_at(f->nodes, at, x, L, dL);
    for (int k = 0; k < f->nodes; k++) {
        a[6 * f->points + k] = L[k];
        da[6 * f->points + k] = dL[k];
    }
    /* the bubble functions are prod (x - x_k) times the Legendre polynomials 1 and 2 x - 1 */
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
        lagrange_at(f->points, f->x, f->at[i], f->through[i], NULL);
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

/* Adds -1/2 w/(k EI) (Q -+ M')^2, where k is 12 for one point and 60 for two. This is the
 * flexibility for the part of the moment that the polynomial through the points, with the slope M',
 * does not represent. */
static void residual_bending(exact_fields *f, int g, int Q, int M, double sign, double flexibility)
{
    double row[EXACT_FIELDS_MAX_ALL] = {0};
    row[f->free + EXACT_FIELDS_STRESSES * g + Q] = 1;
    if (f->points == 2)
        for (int h = 0; h < 2; h++)
            row[f->free + EXACT_FIELDS_STRESSES * h + M] =
                -sign * (h == 0 ? -1 : 1) / (f->x[1] - f->x[0]);
    for (int i = f->free; i < f->all; i++)
        for (int j = f->free; j < f->all; j++)
            f->energy[i * f->all + j] -= f->w[g] * flexibility * row[i] * row[j];
}

/* Adds the energy of a Gauss point, where shear forces act at the shear centre. */
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
        f->energy[(Q + 2) * (f->all + 1)] = -1;
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
    /* int (M - polynomial)^2 for a linear moment (one point) or a quadratic moment */
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

static void condense(const beam_constants *c, const exact_fields *f, const double X[],
                     exact_stiffness *out)
{
    const int m = f->strains;
    const double unit = c->energy / (out->l0 * out->l0);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) {
            double sum = 0;
            for (int k = 0; k < f->all - m; k++)
                sum += (f->energy[i * f->all + m + k] * X[k * m + j] +
                        f->energy[j * f->all + m + k] * X[k * m + i]) /
                       2;
            out->S[i * m + j] = unit * (f->energy[i * f->all + j] + sum);
        }
    for (int i = 0; i < f->field; i++)
        out->torque[i] = f->weight[i] * c->torque * unit / (out->l0 * out->l0);
}

static void condense_twist(const exact_fields *f, const double X[], exact_stiffness *out)
{
    const int m = f->strains;
    double twist[EXACT_STIFFNESS_MAX_FIELD][EXACT_STIFFNESS_MAX_STRAINS];
    for (int j = 0; j < m; j++) {
        int seen = 0;
        for (int i = 0; i < f->field; i++) {
            twist[i][j] = f->twist[i][j];
            for (int k = 0; k < f->free - m; k++)
                twist[i][j] += f->twist[i][m + k] * X[k * m + j];
            seen |= twist[i][j] != 0;
        }
        out->order[j] = seen ? out->twisting : -1;
        for (int i = 0; i < f->field && seen; i++)
            out->twist[i][out->twisting] = twist[i][j];
        if (seen)
            out->place[out->twisting++] = j;
    }
    for (int i = 0; i < f->field; i++)
        for (int g = 0; g < f->points; g++)
            for (int j = 0; j < out->twisting; j++)
                for (int k = 0; k < out->twisting; k++)
                    out->Q[g][j][k] += f->weight[i] * f->through[i][g] / (f->w[g] * out->l0) *
                                       out->twist[i][j] * out->twist[i][k];
}

static void condense_modified(exact_stiffness *out)
{
    const int n = out->strains;
    for (int g = 0; g < out->points; g++)
        for (int j = 0; j < n; j++)
            for (int i = 0; i < 3; i++)
                out->Sr[g][j] += out->r[i] * out->S[j * n + exact_stressed_entry(g, i)];
    for (int g = 0; g < out->points; g++)
        for (int h = 0; h < out->points; h++)
            out->coupling[g][h] = exact_stressed_along(out, out->Sr[g], h);
}

status exact_stiffness_prepare(const element_request *request, int nodes, exact_stiffness *out,
                               fault *fault_out)
{
    beam_constants c;
    exact_fields f;
    double X[EXACT_FIELDS_MAX_ALL * EXACT_STIFFNESS_MAX_STRAINS];
    memset(out, 0, sizeof *out);
    TRY(beam_constants_of(request, &c, fault_out));
    if (c.coupled) {
        out->strains = 6 * (nodes - 1) + nodes;
        out->points = nodes - 1;
        out->l0 = request->length;
        return exact_coupled_stiffness(&c, out->points, out->strains, out->l0, out->S, fault_out);
    }
    exact_fields_prepare(&c, nodes, &f);
    out->strains = f.strains;
    out->points = f.points;
    out->field = f.field;
    out->l0 = request->length;
    out->modified = c.trapeze != 0 || c.bend_y != 0 || c.bend_z != 0 || c.torque != 0;
    out->r[0] = c.trapeze;
    out->r[1] = c.bend_y;
    out->r[2] = c.bend_z;
    if (exact_fields_eliminate(&f, X) != 0)
        return fault_set(fault_out, STATUS_REFUSED,
                         "element of length %g m: its shear flexibility cannot be separated from "
                         "bending; use fewer "
                         "elements",
                         request->length);
    condense(&c, &f, X, out);
    condense_twist(&f, X, out);
    condense_modified(out);
    return STATUS_OK;
}

status exact_stiffness_stress(const exact_stiffness *k, const double e[], stress_output *out)
{
    status outcome;
    exact_stressed_stress(k, 1, &e, out, &outcome);
    return outcome;
}

void exact_stiffness_geometric(const exact_stiffness *k, const double sigma[], double G[])
{
    const int n = k->strains;
    memset(G, 0, (size_t)(n * n) * sizeof *G);
    for (int g = 0; g < k->points; g++) {
        const double tau = exact_stressed_along(k, sigma, g);
        for (int i = 0; i < k->twisting; i++)
            for (int j = 0; j < k->twisting; j++)
                G[k->place[i] * n + k->place[j]] += tau * k->Q[g][i][j];
    }
}
