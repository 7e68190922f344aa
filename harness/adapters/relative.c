/* Strains and stresses of an element that is known by its force, or by its energy: the strains are
 * the places of its nodes relative to the first one, in the axes of that one,
 *   e = (R0^T (r_k - r_0) - undeformed place, l log(R0^T R_k)) of every other node, l^2 a of all,
 * [m] and the stresses the derivative of the energy at the element whose first node rests. */
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/adapters/adapted.h"
#include "harness/adapters/chart.h"
#include "harness/adapters/stencil.h"

enum { MOST = 6 * (ELEMENT_MAX_NODES - 1) + ELEMENT_MAX_NODES };

int relative_strains_two(const double options[])
{
    (void)options;
    return 8;
}

int relative_strains_three(const double options[])
{
    (void)options;
    return MOST;
}

/* Distance of node k from the first one, undeformed [m]. */
static double place_of(const element_data *d, int k)
{
    return d->length * k / (d->nodes - 1);
}

static void relative_rotation(const node_state *a, const node_state *b, double psi[3])
{
    double R[9], q[4];
    mat3_transpose_mul(a->R, b->R, R);
    rotation_from_matrix(R, q);
    rotation_log(q, psi);
}

static void strains_of(const element_data *d, const node_state x[], double e[])
{
    const double l = d->length;
    for (int k = 1; k < d->nodes; k++) {
        double *own = e + 6 * (k - 1), between[3], psi[3];
        for (int i = 0; i < 3; i++)
            between[i] = x[k].r[i] - x[0].r[i];
        mat3_transpose_mul_vec(x[0].R, between, own);
        own[0] -= place_of(d, k);
        relative_rotation(&x[0], &x[k], psi);
        for (int i = 0; i < 3; i++)
            own[3 + i] = l * psi[i];
    }
    for (int k = 0; k < d->nodes; k++)
        e[6 * (d->nodes - 1) + k] = l * l * x[k].a;
}

/* Rows of one other node: derivatives of its relative place and rotation. */
static void node_rows(const element_data *d, const node_state x[], int k, double J[])
{
    const int n = NODE_COORDINATES * d->nodes;
    double between[3], psi[3], T[9], turned[9], *place = J + 6 * (k - 1) * n, *turn = place + 3 * n;
    for (int i = 0; i < 3; i++)
        between[i] = x[k].r[i] - x[0].r[i];
    relative_rotation(&x[0], &x[k], psi);
    chart_dexp_inverse(psi, T);
    for (int i = 0; i < 3; i++) { /* T R0^T */
        for (int j = 0; j < 3; j++)
            turned[3 * i + j] = T[3 * i] * x[0].R[3 * j] + T[3 * i + 1] * x[0].R[3 * j + 1] +
                                T[3 * i + 2] * x[0].R[3 * j + 2];
    }
    for (int i = 0; i < 3; i++) {
        const double axis[3] = {x[0].R[i], x[0].R[3 + i], x[0].R[6 + i]};
        double lever[3];
        vec3_cross(between, axis, lever); /* d(n_i . d) = n_i . dd + dphi . (n_i x d) */
        for (int j = 0; j < 3; j++) {
            place[i * n + j] = -axis[j];
            place[i * n + 3 + j] = -lever[j];
            place[i * n + NODE_COORDINATES * k + j] = axis[j];
            turn[i * n + 3 + j] = -d->length * turned[3 * i + j];
            turn[i * n + NODE_COORDINATES * k + 3 + j] = d->length * turned[3 * i + j];
        }
    }
}

static void jacobian(const element_data *d, const node_state x[], double J[])
{
    const int n = NODE_COORDINATES * d->nodes, first_warping = 6 * (d->nodes - 1);
    memset(J, 0, (size_t)(d->strains * n) * sizeof *J);
    for (int k = 1; k < d->nodes; k++)
        node_rows(d, x, k, J);
    for (int k = 0; k < d->nodes; k++)
        J[(first_warping + k) * n + NODE_COORDINATES * k + 6] = d->length * d->length;
}

void relative_strain(const element_data *d, const node_state x[], strain_output *out)
{
    if (out->e != NULL)
        strains_of(d, x, out->e);
    if (out->J != NULL)
        jacobian(d, x, out->J);
    if (out->s != NULL && out->H != NULL)
        differences_curvature(d, x, jacobian, out->s, out->H);
}

/* The element with these strains whose first node rests at the origin. */
static void representative(const element_data *d, const double e[], node_state x[])
{
    const double l = d->length;
    memset(x, 0, (size_t)d->nodes * sizeof *x);
    for (int k = 0; k < d->nodes; k++) {
        double psi[3] = {0}, q[4];
        x[k].r[0] = place_of(d, k);
        for (int i = 0; i < 3 && k > 0; i++) {
            x[k].u[i] = e[6 * (k - 1) + i];
            x[k].r[i] += x[k].u[i];
            psi[i] = e[6 * (k - 1) + 3 + i] / l;
        }
        rotation_exp(psi, q);
        rotation_matrix(q, x[k].R);
        x[k].a = e[6 * (d->nodes - 1) + k] / (l * l);
    }
}

/* B [7n x strains]: how the representative's nodes move with its strains. */
static void motion(const element_data *d, const double e[], double B[])
{
    const double l = d->length;
    const int m = d->strains;
    memset(B, 0, (size_t)(NODE_COORDINATES * d->nodes * m) * sizeof *B);
    for (int k = 0; k < d->nodes; k++) {
        double *rows = B + NODE_COORDINATES * k * m, psi[3], T[9];
        rows[6 * m + 6 * (d->nodes - 1) + k] = 1 / (l * l);
        if (k == 0)
            continue;
        for (int i = 0; i < 3; i++)
            psi[i] = e[6 * (k - 1) + 3 + i] / l;
        chart_dexp(psi, T);
        for (int i = 0; i < 3; i++) {
            rows[i * m + 6 * (k - 1) + i] = 1;
            for (int j = 0; j < 3; j++)
                rows[(3 + i) * m + 6 * (k - 1) + 3 + j] = T[3 * i + j] / l;
        }
    }
}

/* Where differences of energies and forces are taken. */
typedef struct place {
    const element_data *data;
    const double *e;
    const double *F; /* of the nodes, held while the strains move */
} place;

static void moved(const place *at, int i, double si, int j, double sj, double e[])
{
    memcpy(e, at->e, (size_t)at->data->strains * sizeof *e);
    e[i] += si * at->data->length;
    e[j] += sj * at->data->length;
}

static int energy_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const place *at = context;
    double e[MOST];
    node_state x[ELEMENT_MAX_NODES];
    moved(at, i, si, j, sj, e);
    representative(at->data, e, x);
    return (int)at->data->given->force(adapted_own(at->data), x, &(force_output){.energy = values});
}

static status stresses_of(const element_data *d, const double e[], double energy[], double sigma[]);

static int stresses_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const place *at = context;
    double e[MOST];
    moved(at, i, si, j, sj, e);
    return (int)stresses_of(at->data, e, NULL, values);
}

/* B^T F with the forces held. */
static int carried_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const place *at = context;
    const int m = at->data->strains;
    double e[MOST], B[ELEMENT_MAX_COORDINATES * MOST];
    moved(at, i, si, j, sj, e);
    motion(at->data, e, B);
    memset(values, 0, (size_t)m * sizeof *values);
    dense_add_transpose_mul(m, NODE_COORDINATES * at->data->nodes, 1, B, at->F, values);
    return 0;
}

static status energy_differences(const element_data *d, const double e[], double energy[],
                                 double sigma[])
{
    const place at = {.data = d, .e = e};
    double now;
    int outcome = energy_at(&at, 0, 0, 0, 0, &now);
    if (energy != NULL)
        *energy = now;
    for (int i = 0; i < d->strains && outcome == 0 && sigma != NULL; i++) {
        outcome = stencil_first(energy_at, &at, 1, i, &sigma[i]);
        sigma[i] /= d->length;
    }
    return (status)outcome;
}

static status stresses_of(const element_data *d, const double e[], double energy[], double sigma[])
{
    if (d->given->leaves & LEAVES_FORCE)
        return energy_differences(d, e, energy, sigma);
    double F[ELEMENT_MAX_COORDINATES], B[ELEMENT_MAX_COORDINATES * MOST];
    node_state x[ELEMENT_MAX_NODES];
    representative(d, e, x);
    TRY(d->given->force(adapted_own(d), x, &(force_output){.energy = energy, .F = F}));
    if (sigma == NULL)
        return STATUS_OK;
    motion(d, e, B);
    memset(sigma, 0, (size_t)d->strains * sizeof *sigma);
    dense_add_transpose_mul(d->strains, NODE_COORDINATES * d->nodes, 1, B, F, sigma);
    return STATUS_OK;
}

static void make_symmetric(int m, double C[])
{
    for (int i = 0; i < m; i++)
        for (int j = 0; j < i; j++)
            C[i * m + j] = C[j * m + i] = (C[i * m + j] + C[j * m + i]) / 2;
}

/* C += d f/d e, f [strains]. */
static int add_columns(const element_data *d, stencil_function *f, const place *at, double C[])
{
    const int m = d->strains;
    double column[MOST];
    int outcome = 0;
    for (int j = 0; j < m && outcome == 0; j++) {
        outcome = stencil_first(f, at, m, j, column);
        for (int i = 0; i < m && outcome == 0; i++)
            C[i * m + j] += column[i] / d->length;
    }
    return outcome;
}

/* B^T K B, and what B turns of the forces. */
static status given_tangent(const element_data *d, const double e[], double C[])
{
    const int n = NODE_COORDINATES * d->nodes, m = d->strains;
    double F[ELEMENT_MAX_COORDINATES], K[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    double B[ELEMENT_MAX_COORDINATES * MOST], work[ELEMENT_MAX_COORDINATES * MOST];
    node_state x[ELEMENT_MAX_NODES];
    const place at = {.data = d, .e = e, .F = F};
    representative(d, e, x);
    TRY(d->given->force(adapted_own(d), x, &(force_output){.F = F, .K = K}));
    motion(d, e, B);
    dense_add_congruence(n, m, B, K, C, work);
    return (status)add_columns(d, carried_at, &at, C);
}

static status second_energies(const element_data *d, const place *at, double C[])
{
    const int m = d->strains;
    int outcome = 0;
    for (int i = 0; i < m; i++)
        for (int j = 0; j <= i && outcome == 0; j++) {
            outcome = stencil_second(energy_at, at, 1, i, j, &C[i * m + j]);
            C[i * m + j] /= d->length * d->length;
            C[j * m + i] = C[i * m + j];
        }
    return (status)outcome;
}

static status tangent_of(const element_data *d, const double e[], double C[])
{
    const place at = {.data = d, .e = e};
    memset(C, 0, (size_t)(d->strains * d->strains) * sizeof *C);
    if (d->given->leaves & LEAVES_FORCE)
        return second_energies(d, &at, C);
    TRY(d->given->leaves & LEAVES_TANGENT ? (status)add_columns(d, stresses_at, &at, C)
                                          : given_tangent(d, e, C));
    make_symmetric(d->strains, C);
    return STATUS_OK;
}

status relative_stress(const element_data *d, const double e[], const double inner[],
                       stress_output *out)
{
    (void)inner;
    if (out->residual != NULL)
        *out->residual = 0;
    if (out->energy != NULL || out->sigma != NULL)
        TRY(stresses_of(d, e, out->energy, out->sigma));
    return out->C != NULL ? tangent_of(d, e, out->C) : STATUS_OK;
}
