#include "elements/geometrically_exact/stiffness.h"

#include <math.h>
#include <string.h>

#include "elements/geometrically_exact/coupled.h"
#include "elements/geometrically_exact/fields.h"
#include "elements/geometrically_exact/stressed.h"
#include "elements/math/dense.h"

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

/* The twist rate at the points of the field by the strains that it depends on. */
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

/* r of point g as a vector of strains has three entries. */
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
        return fault_set(
            fault_out, STATUS_REFUSED,
            "element of length %g m: its shear flexibility cannot be separated from bending",
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
