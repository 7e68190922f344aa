/* Quadratic parts of the modified modes, as products of linear functionals of e. */
#include "elements/beamw/modified.h"

#include <stddef.h>

typedef struct term {
    int mode, i, j; /* ebar_mode += c e_i e_j, counted from 1 as in the paper */
    double c;
} term;

static void add_term(element_data *d, const term *t, double scale)
{
    double a[8] = {0}, b[8] = {0};
    a[t->i - 1] = b[t->j - 1] = 1;
    forms_add_product(d->Q[t->mode - 1], t->c * scale, a, b);
}

/* l0 times the bilinear part of J Eq. 66. */
static const term eq66[] = {
    {1, 3, 3, 2 / 30.0},  {1, 3, 4, 1 / 30.0},  {1, 4, 4, 2 / 30.0},  {1, 5, 5, 2 / 30.0},  {1, 5, 6, 1 / 30.0},
    {1, 6, 6, 2 / 30.0},  {2, 4, 5, 1},         {2, 3, 6, -1},        {3, 2, 5, 1 / 10.0},  {3, 2, 6, 1 / 5.0},
    {3, 5, 7, 1 / 10.0},  {3, 5, 8, -1 / 30.0}, {3, 6, 8, -1 / 30.0}, {4, 2, 5, -1 / 5.0},  {4, 2, 6, -1 / 10.0},
    {4, 5, 7, 1 / 30.0},  {4, 6, 7, 1 / 30.0},  {4, 6, 8, -1 / 10.0}, {5, 2, 3, -1 / 10.0}, {5, 2, 4, -1 / 5.0},
    {5, 3, 7, -1 / 10.0}, {5, 3, 8, 1 / 30.0},  {5, 4, 8, 1 / 30.0},  {6, 2, 3, 1 / 5.0},   {6, 2, 4, 1 / 10.0},
    {6, 3, 7, -1 / 30.0}, {6, 4, 7, -1 / 30.0}, {6, 4, 8, 1 / 10.0},
};

void modified_printed(const section *c, unsigned features, element_data *d)
{
    const double l = d->l0, l3 = l * l * l;
    for (size_t i = 0; i < sizeof eq66 / sizeof eq66[0]; i++)
        add_term(d, &eq66[i], 1 / l);
    const double e2[8] = {0, 1}, A[8] = {[6] = 0.5, [7] = -0.5}, t[8] = {[1] = 1, [6] = -0.5, [7] = -0.5};
    if (features & FEATURE_TRAPEZE) {
        const double k = c->Ip / c->A / (2 * l3);
        forms_add_product(d->Q[0], k, e2, e2);
        forms_add_product(d->Q[0], k / 3, A, A);
        forms_add_product(d->Q[0], k / 5, t, t);
    }
    forms_add_product(d->Q[0], -(c->ys * c->ys + c->zs * c->zs) / (10 * l3), e2, e2);
    d->modified = 1;
}

/* out = sum of c_i f_i. */
static void combine(double out[8], int n, const double c[], const double *const f[])
{
    for (int k = 0; k < 8; k++) {
        out[k] = 0;
        for (int i = 0; i < n; i++)
            out[k] += c[i] * f[i][k];
    }
}

typedef struct fields {
    double e2[8], A[8], tw[8], Vs[8], Vt[8], Ws[8], Wt[8], ap[8], bp[8], aq[8], bq[8];
} fields;

static fields fields_of(const section *c, double l, const stiffness_fields *s)
{
    fields f;
    const double e2[8] = {0, 1}, sum_y[8] = {0, 0, 1, 1}, sum_z[8] = {0, 0, 0, 0, 1, 1};
    for (int k = 0; k < 8; k++) {
        f.e2[k] = e2[k];
        f.A[k] = s->A[k];
        f.tw[k] = s->tw[k];
    }
    combine(f.Vs, 2, (double[]){-0.5, c->zs / l}, (const double *[]){sum_z, f.A});
    combine(f.Vt, 2, (double[]){-l, -c->zs / l}, (const double *[]){s->hg[0], f.tw});
    combine(f.Ws, 2, (double[]){0.5, -c->ys / l}, (const double *[]){sum_y, f.A});
    combine(f.Wt, 2, (double[]){-l, c->ys / l}, (const double *[]){s->hg[1], f.tw});
    combine(f.ap, 3, (double[]){-2 / 3.0, -1 / 6.0, 1 / 30.0}, (const double *[]){f.e2, f.A, f.tw});
    combine(f.bp, 2, (double[]){0.1, -0.1}, (const double *[]){f.tw, f.A});
    combine(f.aq, 3, (double[]){-2 / 3.0, 1 / 6.0, 1 / 30.0}, (const double *[]){f.e2, f.A, f.tw});
    combine(f.bq, 2, (double[]){-0.1, -0.1}, (const double *[]){f.tw, f.A});
    return f;
}

/* e1bar: the exact integral of (v_c'^2 + w_c'^2 + Ip/A phi'^2)/2, less the shear where the section's rotation counts. */
static void elongation(const section *c, unsigned features, const stiffness_fields *s, const fields *f, element_data *d)
{
    const double l = d->l0, haringx = features & FEATURE_HARINGX ? 1 : 0;
    double *Q = d->Q[0];
    forms_add_product(Q, 1 / (6 * l), f->Vs, f->Vs);
    forms_add_product(Q, 1 / (6 * l), f->Ws, f->Ws);
    forms_add_product(Q, 1 / (10 * l), f->Vt, f->Vt);
    forms_add_product(Q, 1 / (10 * l), f->Wt, f->Wt);
    if (features & FEATURE_TRAPEZE) {
        const double k = c->Ip / c->A / (2 * l * l * l);
        forms_add_product(Q, k, f->e2, f->e2);
        forms_add_product(Q, k / 3, f->A, f->A);
        forms_add_product(Q, k / 5, f->tw, f->tw);
    }
    forms_add_product(Q, -haringx * l / 2, s->g[0], s->g[0]);
    forms_add_product(Q, -haringx * l / 2, s->g[1], s->g[1]);
    forms_add_product(Q, -haringx * c->zs / l, s->g[0], f->e2);
    forms_add_product(Q, haringx * c->ys / l, s->g[1], f->e2);
}

static void torsion_and_bending(unsigned features, const stiffness_fields *s, const fields *f, element_data *d)
{
    const double l = d->l0, haringx = features & FEATURE_HARINGX ? 1 : 0;
    const double sum_y[8] = {0, 0, 1, 1}, sum_z[8] = {0, 0, 0, 0, 1, 1};
    double half_p[8], half_q[8];
    forms_add_product(d->Q[1], 1, sum_y, s->hg[0]);
    forms_add_product(d->Q[1], 1, sum_z, s->hg[1]);
    combine(half_p, 2, (double[]){0.5, 1 / 6.0}, (const double *[]){f->e2, f->A});
    combine(half_q, 2, (double[]){0.5, -1 / 6.0}, (const double *[]){f->e2, f->A});
    const struct {
        int mode;
        double sign;
        const double *S, *T, *a, *b, *g, *half;
    } bending[] = {{2, 1, f->Vs, f->Vt, f->ap, f->bp, s->g[0], half_p},
                   {3, -1, f->Vs, f->Vt, f->aq, f->bq, s->g[0], half_q},
                   {4, 1, f->Ws, f->Wt, f->ap, f->bp, s->g[1], half_p},
                   {5, -1, f->Ws, f->Wt, f->aq, f->bq, s->g[1], half_q}};
    for (size_t i = 0; i < sizeof bending / sizeof bending[0]; i++) {
        double *Q = d->Q[bending[i].mode];
        forms_add_product(Q, bending[i].sign / l, bending[i].S, bending[i].a);
        forms_add_product(Q, bending[i].sign / l, bending[i].T, bending[i].b);
        forms_add_product(Q, haringx, bending[i].g, bending[i].half);
    }
}

/* Axial strain that is quadratic over the section, phi'^2 (y^2 + z^2)/2, bends a section without that symmetry. */
static void wagner_moments(const section *c, const fields *f, element_data *d)
{
    const double l2 = d->l0 * d->l0, by = c->wagner_z / c->Iy / (4 * l2), bz = c->wagner_y / c->Iz / (4 * l2);
    const double share[4] = {by, by, -bz, -bz};
    for (int i = 0; i < 4; i++) {
        double *Q = d->Q[2 + i];
        const double side = i % 2 == 0 ? 1 : -1;
        forms_add_product(Q, share[i], f->e2, f->e2);
        forms_add_product(Q, share[i] / 3, f->A, f->A);
        forms_add_product(Q, share[i] / 5, f->tw, f->tw);
        forms_add_product(Q, side * share[i] * 2 / 3, f->A, f->e2);
        forms_add_product(Q, -side * share[i] * 4 / 15, f->A, f->tw);
    }
}

void modified_consistent(const section *c, unsigned features, const stiffness_fields *s, element_data *d)
{
    const fields f = fields_of(c, d->l0, s);
    elongation(c, features, s, &f, d);
    torsion_and_bending(features, s, &f, d);
    if (features & FEATURE_WAGNER_MOMENTS)
        wagner_moments(c, &f, d);
    d->modified = 1;
}
