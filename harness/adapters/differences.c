/* Derivatives of strains by central differences of sixth order in the rotation chart. */
#include <string.h>

#include "harness/adapters/adapted.h"
#include "harness/adapters/chart.h"
#include "harness/adapters/stencil.h"

/* Where differences are taken. */
typedef struct place {
    const element_data *data;
    const node_state *x;
    const double *s;                /* for second derivatives */
    differences_jacobian *jacobian; /* of the strains, where there is one */
} place;

static void moved(const place *at, int i, double si, int j, double sj, node_state out[])
{
    double step[ELEMENT_MAX_COORDINATES] = {0};
    step[i] += si * chart_unit(i, at->data->length);
    step[j] += sj * chart_unit(j, at->data->length);
    chart_move(at->x, at->data->nodes, step, out);
}

static int strains_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const place *at = context;
    node_state x[ELEMENT_MAX_NODES];
    moved(at, i, si, j, sj, x);
    at->data->given->strain(adapted_own(at->data), x, &(strain_output){.e = values});
    return 0;
}

/* s.e, whose second derivative is H. */
static int work_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const place *at = context;
    double e[ELEMENT_MAX_STRAINS];
    strains_at(context, i, si, j, sj, e);
    values[0] = 0;
    for (int k = 0; k < at->data->strains; k++)
        values[0] += at->s[k] * e[k];
    return 0;
}

/* J^T s. */
static int forces_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const place *at = context;
    const int n = NODE_COORDINATES * at->data->nodes;
    double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    node_state x[ELEMENT_MAX_NODES];
    moved(at, i, si, j, sj, x);
    at->jacobian(at->data, x, J);
    for (int c = 0; c < n; c++) {
        values[c] = 0;
        for (int k = 0; k < at->data->strains; k++)
            values[c] += J[k * n + c] * at->s[k];
    }
    return 0;
}

/* From differences per unit to derivatives. */
static double per_unit(const element_data *d, int c)
{
    return 1 / chart_unit(c, d->length);
}

static void first(const place *at, double J[])
{
    const element_data *d = at->data;
    const int n = NODE_COORDINATES * d->nodes;
    double column[ELEMENT_MAX_STRAINS];
    for (int c = 0; c < n; c++) {
        stencil_first(strains_at, at, d->strains, c, column);
        for (int k = 0; k < d->strains; k++)
            J[k * n + c] = column[k] * per_unit(d, c);
    }
}

static void second(const place *at, double H[])
{
    const element_data *d = at->data;
    const int n = NODE_COORDINATES * d->nodes;
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double value;
            stencil_second(work_at, at, 1, i, j, &value);
            H[i * n + j] = H[j * n + i] = value * per_unit(d, i) * per_unit(d, j);
        }
}

void differences_curvature(const element_data *d, const node_state x[],
                           differences_jacobian *jacobian, const double s[], double H[])
{
    const place at = {.data = d, .x = x, .s = s, .jacobian = jacobian};
    const int n = NODE_COORDINATES * d->nodes;
    double column[ELEMENT_MAX_COORDINATES];
    memset(H, 0, (size_t)(n * n) * sizeof *H);
    for (int j = 0; j < n; j++) {
        stencil_first(forces_at, &at, n, j, column);
        for (int i = 0; i < n; i++) { /* the symmetric part: that of the exponential chart */
            const double half = column[i] * per_unit(d, j) / 2;
            H[i * n + j] += half;
            H[j * n + i] += half;
        }
    }
}

static void given_jacobian(const element_data *d, const node_state x[], double J[])
{
    d->given->strain(adapted_own(d), x, &(strain_output){.J = J});
}

void differences_strain(const element_data *d, const node_state x[], strain_output *out)
{
    const element_type *t = d->given;
    const place at = {.data = d, .x = x, .s = out->s};
    const int leaves_j = (t->leaves & LEAVES_J) != 0,
              leaves_h = leaves_j || (t->leaves & LEAVES_H) != 0;
    strain_output asked = *out;
    asked.J = leaves_j ? NULL : out->J;
    asked.H = leaves_h ? NULL : out->H;
    asked.s = leaves_h ? NULL : out->s;
    t->strain(adapted_own(d), x, &asked);
    if (leaves_j && out->J != NULL)
        first(&at, out->J);
    if (!leaves_h || out->s == NULL || out->H == NULL)
        return;
    if (leaves_j)
        second(&at, out->H);
    else
        differences_curvature(d, x, given_jacobian, out->s, out->H);
}
