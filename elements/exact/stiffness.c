#include "elements/exact/stiffness.h"

#include <math.h>
#include <string.h>

#include "elements/exact/line.h"
#include "elements/math/dense.h"

enum {
    MAX_BUBBLES = STRAIN_MAX_POINTS, /* of the warping amplitude */
    STRESSES = 5,                    /* Q_y, Q_z, M_w, M_y, M_z of a point */
    MAX_FREE = STIFFNESS_MAX_STRAINS + MAX_BUBBLES,
    MAX_ALL = MAX_FREE + STRESSES * STRAIN_MAX_POINTS
};

/* Everything the energy depends on before elimination: strains, bubbles, stresses; dimensionless. */
typedef struct fields {
    int nodes, points, strains, warping_bubbles, free, all, field;
    double x[STRAIN_MAX_POINTS], w[STRAIN_MAX_POINTS];           /* points of the strains */
    double at[STIFFNESS_MAX_FIELD], weight[STIFFNESS_MAX_FIELD]; /* points that integrate the fourth power of the twist rate */
    double through[STIFFNESS_MAX_FIELD][STRAIN_MAX_POINTS];      /* Lagrange polynomials on x, at `at` */
    double twist[STIFFNESS_MAX_FIELD][MAX_FREE];                 /* kappa_x */
    double slope[STIFFNESS_MAX_FIELD][MAX_FREE];                 /* a' */
    double mean[STRAIN_MAX_POINTS][MAX_FREE];                    /* P a at the points */
    double energy[MAX_ALL * MAX_ALL];                            /* 2 x the quadratic form */
} fields;

static void add_square(fields *f, double k, const double row[])
{
    for (int i = 0; i < f->free; i++)
        for (int j = 0; j < f->free && row[i] != 0; j++)
            f->energy[i * f->all + j] += k * row[i] * row[j];
}

static void add_product(fields *f, double k, int i, int j)
{
    f->energy[i * f->all + j] += k;
    f->energy[j * f->all + i] += k;
}

/* a and a' at x as rows on (strains, bubbles). */
static void amplitude(const fields *f, double x, double a[MAX_FREE], double da[MAX_FREE])
{
    double at[ELEMENT_MAX_NODES], L[ELEMENT_MAX_NODES], dL[ELEMENT_MAX_NODES], bubble = 1, slope = 0;
    memset(a, 0, MAX_FREE * sizeof *a);
    memset(da, 0, MAX_FREE * sizeof *da);
    for (int k = 0; k < f->nodes; k++) {
        at[k] = (double)k / (f->nodes - 1);
        slope = slope * 4 * (x - at[k]) + bubble * 4;
        bubble *= 4 * (x - at[k]);
    }
    line_lagrange(f->nodes, at, x, L, dL);
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

static void twist_fields(fields *f)
{
    double a[STIFFNESS_MAX_FIELD][MAX_FREE];
    for (int i = 0; i < f->field; i++) {
        line_lagrange(f->points, f->x, f->at[i], f->through[i], NULL);
        for (int g = 0; g < f->points; g++)
            f->twist[i][6 * g + 3] = f->through[i][g];
        if (f->warping_bubbles == 0)
            continue;
        amplitude(f, f->at[i], a[i], f->slope[i]);
        for (int g = 0; g < f->points; g++)
            for (int k = 0; k < f->free; k++)
                f->mean[g][k] += f->weight[i] * f->through[i][g] / f->w[g] * a[i][k];
    }
    for (int i = 0; i < f->field && f->warping_bubbles > 0; i++)
        for (int k = 0; k < f->free; k++) {
            f->twist[i][k] += a[i][k];
            for (int g = 0; g < f->points; g++)
                f->twist[i][k] -= f->through[i][g] * f->mean[g][k];
        }
}

/* -1/2 w/(k EI) (Q -+ M')^2: what the part of the moment above the points' polynomial makes flexible, M' its slope. */
static void residual_bending(fields *f, int g, int Q, int M, double sign, double flexibility)
{
    double row[MAX_ALL] = {0}; /* on Q, M of the points */
    row[f->free + STRESSES * g + Q] = 1;
    if (f->points == 2)
        for (int h = 0; h < 2; h++)
            row[f->free + STRESSES * h + M] = -sign * (h == 0 ? -1 : 1) / (f->x[1] - f->x[0]);
    for (int i = f->free; i < f->all; i++)
        for (int j = f->free; j < f->all; j++)
            f->energy[i * f->all + j] -= f->w[g] * flexibility * row[i] * row[j];
}

/* Stress times strain less half of stress times flexibility, at one point; shears are those of the shear centre. */
static void energy_of_point(const constants *c, fields *f, int g)
{
    const int e = 6 * g, Q = f->free + STRESSES * g;
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
    for (int k = 0; k < f->free && f->warping_bubbles > 0; k++)
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

static void energy_of_fields(const constants *c, fields *f)
{
    for (int i = 0; i < f->field; i++) {
        add_square(f, f->weight[i] * c->GJ, f->twist[i]);
        add_square(f, f->weight[i] * c->EIw, f->slope[i]);
    }
    for (int g = 0; g < f->points; g++)
        energy_of_point(c, f, g);
}

/* Bubbles and stresses as they follow from the strains: X[all - strains][strains]; 0, or the failing pivot. */
static int eliminate(const fields *f, double X[])
{
    const int n = f->all - f->strains, m = f->strains;
    double A[MAX_ALL * MAX_ALL];
    int pivot[MAX_ALL];
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

static void condense(const constants *c, const fields *f, const double X[], stiffness *out)
{
    const int m = f->strains;
    const double unit = c->energy / (out->l0 * out->l0);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) {
            double sum = 0;
            for (int k = 0; k < f->all - m; k++)
                sum += (f->energy[i * f->all + m + k] * X[k * m + j] + f->energy[j * f->all + m + k] * X[k * m + i]) / 2;
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
                    out->Q[g][j * m + k] +=
                        f->weight[i] * f->through[i][g] / (f->w[g] * out->l0) * out->twist[i][j] * out->twist[i][k];
    }
}

status stiffness_prepare(const element_request *request, int nodes, stiffness *out, fault *fault_out)
{
    constants c;
    fields f;
    double X[MAX_ALL * STIFFNESS_MAX_STRAINS];
    memset(out, 0, sizeof *out);
    const status outcome = constants_of(request, &c, fault_out);
    if (outcome != STATUS_OK)
        return outcome;
    memset(&f, 0, sizeof f);
    f.nodes = nodes;
    f.points = nodes - 1;
    f.strains = 6 * f.points + nodes;
    f.warping_bubbles = c.warping ? f.points : 0;
    f.free = f.strains + f.warping_bubbles;
    f.all = f.free + STRESSES * f.points;
    f.field = 4 * f.points + 1;
    line_gauss(f.points, f.x, f.w);
    line_gauss(f.field, f.at, f.weight);
    twist_fields(&f);
    energy_of_fields(&c, &f);
    out->strains = f.strains;
    out->points = f.points;
    out->field = f.field;
    out->l0 = request->length;
    out->modified = c.trapeze != 0 || c.bend_y != 0 || c.bend_z != 0 || c.torque != 0;
    out->r[0] = c.trapeze;
    out->r[1] = c.bend_y;
    out->r[2] = c.bend_z;
    if (eliminate(&f, X) != 0)
        return fault_set(fault_out, STATUS_REFUSED,
                         "element of length %g m: its shear flexibility cannot be separated from bending", request->length);
    condense(&c, &f, X, out);
    return STATUS_OK;
}

/* r of point g as a vector of strains, S r, and r . S r' are sparse: three entries each. */
static int entry(int g, int i)
{
    return 6 * g + (i == 0 ? 0 : 3 + i);
}

static double along(const stiffness *k, const double stress[], int g)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += k->r[i] * stress[entry(g, i)];
    return sum;
}

/* C += S r_g t_g^T + t_g (S r_g)^T + t_g (r_g . S r_h) t_h^T + tau_g Q_g */
static void add_modified_tangent(const stiffness *k, double t[][STIFFNESS_MAX_STRAINS], const double tau[], double C[])
{
    const int n = k->strains;
    double Sr[STRAIN_MAX_POINTS][STIFFNESS_MAX_STRAINS] = {{0}};
    for (int g = 0; g < k->points; g++)
        for (int j = 0; j < n; j++)
            for (int i = 0; i < 3; i++)
                Sr[g][j] += k->r[i] * k->S[j * n + entry(g, i)];
    for (int g = 0; g < k->points; g++)
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                C[i * n + j] += Sr[g][i] * t[g][j] + t[g][i] * Sr[g][j] + tau[g] * k->Q[g][i * n + j];
    for (int g = 0; g < k->points; g++)
        for (int h = 0; h < k->points; h++) {
            const double coupling = along(k, Sr[g], h);
            for (int i = 0; i < n && coupling != 0; i++)
                for (int j = 0; j < n; j++)
                    C[i * n + j] += coupling * t[g][i] * t[h][j];
        }
}

/* Wagner torque: energy sum torque_i (twist_i . e)^4. */
static double add_torque(const stiffness *k, const double e[], double sigma[], double C[])
{
    const int n = k->strains;
    double energy = 0;
    for (int p = 0; p < k->field && k->torque[p] != 0; p++) {
        double twist = 0;
        for (int i = 0; i < n; i++)
            twist += k->twist[p][i] * e[i];
        const double force = 4 * k->torque[p] * twist * twist * twist, slope = 12 * k->torque[p] * twist * twist;
        energy += force * twist / 4;
        for (int i = 0; i < n; i++) {
            if (sigma != NULL)
                sigma[i] += force * k->twist[p][i];
            for (int j = 0; j < n && C != NULL; j++)
                C[i * n + j] += slope * k->twist[p][i] * k->twist[p][j];
        }
    }
    return energy;
}

status stiffness_stress(const stiffness *k, const double e[], stress_output *out)
{
    const int n = k->strains;
    double modified[STIFFNESS_MAX_STRAINS], stress[STIFFNESS_MAX_STRAINS], t[STRAIN_MAX_POINTS][STIFFNESS_MAX_STRAINS],
        tau[STRAIN_MAX_POINTS], energy = 0;
    memcpy(modified, e, (size_t)n * sizeof *e);
    for (int g = 0; g < k->points && k->modified; g++) {
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
    for (int g = 0; g < k->points && k->modified; g++)
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

void stiffness_geometric(const stiffness *k, const double sigma[], double G[])
{
    const int n = k->strains;
    memset(G, 0, (size_t)(n * n) * sizeof *G);
    for (int g = 0; g < k->points; g++) {
        const double tau = along(k, sigma, g);
        for (int i = 0; i < n * n; i++)
            G[i] += tau * k->Q[g][i];
    }
}
