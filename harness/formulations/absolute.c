/* Strains and stresses of an element that computes forces with a history. Its strains are the
 * motions of its nodes (adapted.h). */
#include "harness/formulations/formulations_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/formulations/adapted.h"

enum { N = NODE_COORDINATES * ABSOLUTE_NODES, M = ABSOLUTE_MOST, ROTATION = 3, WARPING = 7 };

int absolute_is(const element_type *given, const double options[])
{
    return given->force != NULL && element_history(given, options) > 0;
}

#define STRAINS_OF(n)                                                                              \
    static int strains_##n(const double options[])                                                 \
    {                                                                                              \
        (void)options;                                                                             \
        return (n) * ABSOLUTE_NODE;                                                                \
    }
STRAINS_OF(2)
STRAINS_OF(3)
STRAINS_OF(4)
STRAINS_OF(5)
STRAINS_OF(6)
STRAINS_OF(7)

int (*absolute_strains(int nodes))(const double[])
{
    static int (*const strains[ABSOLUTE_NODES + 1])(const double[]) = {
        NULL, NULL, strains_2, strains_3, strains_4, strains_5, strains_6, strains_7};
    return strains[nodes];
}

/* The values of a node in the history of the completed type. */
typedef struct kept_node {
    double r[3], q[4], last[4];
} kept_node;

static kept_node kept_of(const element_data *d, const double history[], int node)
{
    kept_node out;
    memcpy(&out, history + d->history + node * ABSOLUTE_KEPT, sizeof out);
    return out;
}

static void keep(const element_data *d, double history[], int node, const kept_node *k)
{
    memcpy(history + d->history + node * ABSOLUTE_KEPT, k, sizeof *k);
}

/* Computes the quaternion of a rotation, with the sign for which it is nearer to `last`. */
static void quaternion(const double R[9], const double last[4], double q[4])
{
    rotation_from_matrix(R, q);
    const int opposite = dense_dot(4, q, last) < 0;
    for (int i = 0; i < 4; i++)
        q[i] = opposite ? -q[i] : q[i];
}

/* Computes p = (0, v) q for the quaternion q. */
static void turned(const double v[3], const double q[4], double p[4])
{
    double across[3];
    vec3_cross(v, q + 1, across);
    p[0] = -vec3_dot(v, q + 1);
    for (int i = 0; i < 3; i++)
        p[1 + i] = q[0] * v[i] + across[i];
}

/* Computes (0, e_i) q, where e_i is the unit vector along axis i. */
static void turned_about(int i, const double q[4], double p[4])
{
    double v[3] = {0, 0, 0};
    v[i] = 1;
    turned(v, q, p);
}

static void nothing(const element_data *d, strain_output *out)
{
    const int n = NODE_COORDINATES * d->nodes;
    for (int i = 0; i < d->strains && out->e != NULL; i++)
        out->e[i] = NAN;
    for (int i = 0; i < d->strains * n && out->J != NULL; i++)
        out->J[i] = NAN;
    for (int i = 0; i < n * n && out->s != NULL && out->H != NULL; i++)
        out->H[i] = NAN;
}

static void node_strain(const element_data *d, const node_state *x, int node, const kept_node *k,
                        const strain_output *out)
{
    const double l = d->length;
    const int n = NODE_COORDINATES * d->nodes, first = ABSOLUTE_NODE * node,
              column = NODE_COORDINATES * node;
    double q[4];
    quaternion(x->R, k->last, q);
    for (int i = 0; i < 3 && out->e != NULL; i++)
        out->e[first + i] = x->u[i];
    for (int i = 0; i < 4 && out->e != NULL; i++)
        out->e[first + ROTATION + i] = 2 * l * (q[i] - k->q[i]);
    if (out->e != NULL)
        out->e[first + WARPING] = l * l * x->a;
    for (int j = 0; j < 3 && out->J != NULL; j++) {
        double p[4];
        turned_about(j, q, p);
        out->J[(first + j) * n + column + j] = 1;
        for (int i = 0; i < 4; i++)
            out->J[(first + ROTATION + i) * n + column + 3 + j] = l * p[i];
    }
    if (out->J != NULL)
        out->J[(first + WARPING) * n + column + 6] = l * l;
    for (int i = 0; i < 3 && out->s != NULL && out->H != NULL; i++)
        out->H[(column + 3 + i) * (n + 1)] = -l / 2 * dense_dot(4, out->s + first + ROTATION, q);
}

void absolute_strain(const element_data *d, const node_state x[], strain_output *out)
{
    const size_t n = (size_t)NODE_COORDINATES * (size_t)d->nodes;
    if (out->history == NULL) {
        nothing(d, out);
        return;
    }
    if (out->J != NULL)
        memset(out->J, 0, (size_t)d->strains * n * sizeof *out->J);
    if (out->s != NULL && out->H != NULL)
        memset(out->H, 0, n * n * sizeof *out->H);
    for (int k = 0; k < d->nodes; k++) {
        const kept_node own = kept_of(d, out->history, k);
        node_strain(d, &x[k], k, &own, out);
    }
}

typedef struct absolute_place {
    const element_data *data;
    const double *history;
    node_state x[ABSOLUTE_NODES];
    double q[ABSOLUTE_NODES][4], size[ABSOLUTE_NODES];
    gather *together;
} absolute_place;

static absolute_place configuration_of(const element_data *d, const double e[],
                                       const double history[], gather *together)
{
    absolute_place at = {.data = d, .history = history, .together = together};
    for (int k = 0; k < d->nodes && history != NULL; k++) {
        const kept_node own = kept_of(d, history, k);
        const double *first = e + (ptrdiff_t)ABSOLUTE_NODE * k;
        for (int i = 0; i < 4; i++)
            at.q[k][i] = own.q[i] + first[ROTATION + i] / (2 * d->length);
        at.size[k] = sqrt(dense_dot(4, at.q[k], at.q[k]));
        for (int i = 0; i < 4; i++)
            at.q[k][i] /= at.size[k];
        for (int i = 0; i < 3; i++) {
            at.x[k].u[i] = first[i];
            at.x[k].r[i] = own.r[i] + first[i];
        }
        rotation_matrix(at.q[k], at.x[k].R);
        at.x[k].a = first[WARPING] / (d->length * d->length);
    }
    return at;
}

static void moved(const absolute_place *at, int i, double si, int j, double sj, node_state out[])
{
    double step[N] = {0};
    step[i] += si * chart_unit(i, at->data->nodes, at->data->length);
    step[j] += sj * chart_unit(j, at->data->nodes, at->data->length);
    chart_move(at->x, at->data->nodes, 0, step, out);
}

static int forces_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const absolute_place *at = context;
    node_state x[ELEMENT_MAX_NODES];
    moved(at, i, si, j, sj, x);
    return (int)forces_of(at->data, at->together, x,
                          &(force_output){.F = values, .history = at->history});
}

/* Computes K = dF/dx along spatial increments. */
static status stiffness_here(const absolute_place *at, double K[])
{
    const element_data *d = at->data;
    const int n = NODE_COORDINATES * d->nodes;
    double column[N];
    int outcome = 0;
    if (!(d->given->leaves & LEAVES_TANGENT))
        return forces_of(d, at->together, at->x, &(force_output){.K = K, .history = at->history});
    for (int j = 0; j < n && outcome == 0; j++) {
        outcome = stencil_first(forces_at, at, n, j, column);
        for (int i = 0; i < n && outcome == 0; i++)
            K[i * n + j] = column[i] / chart_unit(j, d->nodes, d->length);
    }
    return (status)outcome;
}

/* Computes B [7 nodes x strains], the derivative of the states of the nodes with respect to the
 * strains. */
static void motion(const absolute_place *at, double B[])
{
    const element_data *d = at->data;
    const int m = d->strains;
    memset(B, 0, (size_t)(NODE_COORDINATES * d->nodes * m) * sizeof *B);
    for (int k = 0; k < d->nodes; k++) {
        double *rows = B + (ptrdiff_t)(NODE_COORDINATES * k) * m + (ptrdiff_t)ABSOLUTE_NODE * k;
        for (int i = 0; i < 3; i++) {
            double p[4];
            turned_about(i, at->q[k], p);
            rows[i * m + i] = 1;
            for (int j = 0; j < 4; j++)
                rows[(3 + i) * m + ROTATION + j] = p[j] / (d->length * at->size[k]);
        }
        rows[6 * m + WARPING] = 1 / (d->length * d->length);
    }
}

/* Computes the stresses for which J^T sigma = F. */
static void stresses(const absolute_place *at, const double F[], double sigma[])
{
    const double l = at->data->length;
    for (int k = 0; k < at->data->nodes; k++) {
        const double *own = F + (ptrdiff_t)NODE_COORDINATES * k;
        double *out = sigma + (ptrdiff_t)ABSOLUTE_NODE * k;
        memcpy(out, own, 3 * sizeof *out);
        turned(own + 3, at->q[k], out + ROTATION);
        for (int i = 0; i < 4; i++)
            out[ROTATION + i] /= l;
        out[WARPING] = own[6] / (l * l);
    }
}

/* Adds the change of the stresses sigma due to the strains, for constant F, to C. */
static void add_turning(const absolute_place *at, const double F[], double C[])
{
    const double l = at->data->length;
    const int m = at->data->strains;
    for (int k = 0; k < at->data->nodes; k++)
        for (int j = 0; j < 4; j++) {
            double along[4], change[4];
            for (int i = 0; i < 4; i++)
                along[i] = ((i == j) - at->q[k][i] * at->q[k][j]) / (2 * l * l * at->size[k]);
            turned(F + NODE_COORDINATES * k + 3, along, change);
            const int first = ABSOLUTE_NODE * k + ROTATION;
            for (int i = 0; i < 4; i++)
                C[(first + i) * m + first + j] += change[i];
        }
}

static status tangent(const absolute_place *at, const double F[], double C[])
{
    const element_data *d = at->data;
    const int n = NODE_COORDINATES * d->nodes, m = d->strains;
    absolute_place unit = *at;
    double K[N * N], B[N * M], left[N * M], KB[N * M];
    TRY(stiffness_here(at, K));
    motion(at, B);
    for (int k = 0; k < d->nodes; k++)
        unit.size[k] = 1;
    motion(&unit, left);
    dense_mul(n, n, m, K, B, KB);
    memset(C, 0, (size_t)(m * m) * sizeof *C);
    dense_add_transpose_mul(m, n, m, left, KB, C);
    add_turning(at, F, C);
    return STATUS_OK;
}

static status stress_at(const absolute_place *at, stress_output *out)
{
    double F[N] = {0};
    if (at->history == NULL)
        return STATUS_FAULT;
    if (out->residual != NULL)
        *out->residual = 0;
    if (out->energy != NULL)
        *out->energy = NAN;
    if (out->sigma == NULL && out->C == NULL)
        return STATUS_OK;
    TRY(forces_of(at->data, at->together, at->x, &(force_output){.F = F, .history = at->history}));
    if (out->sigma != NULL)
        stresses(at, F, out->sigma);
    return out->C != NULL ? tangent(at, F, out->C) : STATUS_OK;
}

typedef struct absolute_many {
    const element_data *const *data;
    const double *const *e;
    stress_output *out;
    status *outcome;
} absolute_many;

static void stress_of_one(void *context, gather *together, int i)
{
    const absolute_many *all = context;
    const absolute_place at =
        configuration_of(all->data[i], all->e[i], all->out[i].history, together);
    all->outcome[i] = stress_at(&at, &all->out[i]);
}

static void evaluate_states(void *context, gather *g, int first, int count)
{
    const absolute_many *all = context;
    forces_evaluate(all->data[0], g, first, count);
}

void absolute_stress_many(int count, const element_data *const data[], const double *const e[],
                          const double *const inner[], stress_output out[], status outcome[])
{
    absolute_many all = {data, e, out, outcome};
    (void)inner;
    if (count > 0)
        gather_run(count, data[0]->nodes, forces_size(data[0]), stress_of_one, evaluate_states,
                   &all);
}

status absolute_stress(const element_data *d, const double e[], const double inner[],
                       stress_output *out)
{
    status outcome;
    if (d->given->force_many == NULL) {
        const absolute_place at = configuration_of(d, e, out->history, NULL);
        return stress_at(&at, out);
    }
    absolute_stress_many(1, &d, &e, &inner, out, &outcome);
    return outcome;
}

void absolute_begin(const element_data *d, const node_state x[], double history[])
{
    memset(history, 0, (size_t)d->history * sizeof *history);
    if (d->given->begin != NULL)
        d->given->begin(adapted_own(d), x, history);
    for (int k = 0; k < d->nodes; k++) {
        kept_node own;
        for (int i = 0; i < 3; i++)
            own.r[i] = x[k].r[i] - x[k].u[i];
        rotation_from_matrix(x[k].R, own.q);
        memcpy(own.last, own.q, sizeof own.last);
        keep(d, history, k, &own);
    }
}

void absolute_commit(const element_data *d, const node_state x[], double history[])
{
    d->given->commit(adapted_own(d), x, history);
    for (int k = 0; k < d->nodes; k++) {
        kept_node own = kept_of(d, history, k);
        double q[4];
        quaternion(x[k].R, own.last, q);
        memcpy(own.last, q, sizeof own.last);
        keep(d, history, k, &own);
    }
}
