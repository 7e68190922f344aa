#include "elements/exact/stiffness.h"

#include <math.h>
#include <string.h>

#include "elements/exact/coupled.h"
#include "elements/exact/fields.h"
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
    for (int i = 0; i < f->field; i++) {
        for (int j = 0; j < m; j++) {
            out->twist[i][j] = f->twist[i][j];
            for (int k = 0; k < f->free - m; k++)
                out->twist[i][j] += f->twist[i][m + k] * X[k * m + j];
        }
        out->torque[i] = f->weight[i] * c->torque * unit / (out->l0 * out->l0);
        for (int g = 0; g < f->points; g++)
            for (int j = 0; j < m; j++)
                for (int k = 0; k < m; k++)
                    out->Q[g][j * m + k] += f->weight[i] * f->through[i][g] / (f->w[g] * out->l0) *
                                            out->twist[i][j] * out->twist[i][k];
    }
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
    return STATUS_OK;
}

/* r of point g as a vector of strains, S r, and r . S r' are sparse: three entries each. */
static int entry(int g, int i)
{
    return 6 * g + (i == 0 ? 0 : 3 + i);
}

static double along(const exact_stiffness *k, const double stress[], int g)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += k->r[i] * stress[entry(g, i)];
    return sum;
}

/* C += S r_g t_g^T + t_g (S r_g)^T + t_g (r_g . S r_h) t_h^T + tau_g Q_g */
static void add_modified_tangent(const exact_stiffness *k, double t[][EXACT_STIFFNESS_MAX_STRAINS],
                                 const double tau[], double C[])
{
    const int n = k->strains;
    double Sr[EXACT_STRAIN_MAX_POINTS][EXACT_STIFFNESS_MAX_STRAINS] = {{0}};
    for (int g = 0; g < k->points; g++)
        for (int j = 0; j < n; j++)
            for (int i = 0; i < 3; i++)
                Sr[g][j] += k->r[i] * k->S[j * n + entry(g, i)];
    for (int g = 0; g < k->points; g++)
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                C[i * n + j] +=
                    Sr[g][i] * t[g][j] + t[g][i] * Sr[g][j] + tau[g] * k->Q[g][i * n + j];
    for (int g = 0; g < k->points; g++)
        for (int h = 0; h < k->points; h++) {
            const double coupling = along(k, Sr[g], h);
            if (coupling != 0)
                for (int i = 0; i < n; i++)
                    for (int j = 0; j < n; j++)
                        C[i * n + j] += coupling * t[g][i] * t[h][j];
        }
}

/* Wagner torque: energy sum torque_i (twist_i . e)^4. */
static double add_torque(const exact_stiffness *k, const double e[], double sigma[], double C[])
{
    const int n = k->strains;
    double energy = 0;
    for (int p = 0; p < k->field && k->torque[p] != 0; p++) {
        double twist = 0;
        for (int i = 0; i < n; i++)
            twist += k->twist[p][i] * e[i];
        const double force = 4 * k->torque[p] * twist * twist * twist,
                     slope = 12 * k->torque[p] * twist * twist;
        energy += force * twist / 4;
        for (int i = 0; i < n; i++) {
            if (sigma != NULL)
                sigma[i] += force * k->twist[p][i];
            if (C != NULL)
                for (int j = 0; j < n; j++)
                    C[i * n + j] += slope * k->twist[p][i] * k->twist[p][j];
        }
    }
    return energy;
}

status exact_stiffness_stress(const exact_stiffness *k, const double e[], stress_output *out)
{
    const int n = k->strains;
    double modified[EXACT_STIFFNESS_MAX_STRAINS], stress[EXACT_STIFFNESS_MAX_STRAINS],
        t[EXACT_STRAIN_MAX_POINTS][EXACT_STIFFNESS_MAX_STRAINS], tau[EXACT_STRAIN_MAX_POINTS],
        energy = 0;
    memcpy(modified, e, (size_t)n * sizeof *e);
    if (k->modified)
        for (int g = 0; g < k->points; g++) {
            double half = 0;
            dense_mul_vec(n, n, k->Q[g], e, t[g]);
            for (int i = 0; i < n; i++)
                half += e[i] * t[g][i] / 2;
            for (int i = 0; i < 3; i++)
                modified[entry(g, i)] += k->r[i] * half;
        }
    dense_mul_vec(n, n, k->S, modified, stress);
    for (int i = 0; i < n; i++)
        energy += stress[i] * modified[i] / 2;
    for (int g = 0; g < k->points; g++)
        tau[g] = along(k, stress, g);
    if (out->C != NULL) {
        memcpy(out->C, k->S, (size_t)(n * n) * sizeof *out->C);
        if (k->modified)
            add_modified_tangent(k, t, tau, out->C);
    }
    if (k->modified)
        for (int g = 0; g < k->points; g++)
            for (int i = 0; i < n; i++)
                stress[i] += tau[g] * t[g][i];
    energy += add_torque(k, e, stress, out->C);
    if (out->sigma != NULL)
        memcpy(out->sigma, stress, (size_t)n * sizeof *stress);
    if (out->energy != NULL)
        *out->energy = energy;
    if (out->residual != NULL)
        *out->residual = 0;
    return STATUS_OK;
}

void exact_stiffness_geometric(const exact_stiffness *k, const double sigma[], double G[])
{
    const int n = k->strains;
    memset(G, 0, (size_t)(n * n) * sizeof *G);
    for (int g = 0; g < k->points; g++) {
        const double tau = along(k, sigma, g);
        for (int i = 0; i < n * n; i++)
            G[i] += tau * k->Q[g][i];
    }
}
