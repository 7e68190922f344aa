#include "harness/formulations/formulations_impl.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/formulations/adapted.h"

#define COUNT(n)                                                                                   \
    static int count_##n(const double options[])                                                   \
    {                                                                                              \
        (void)options;                                                                             \
        return n;                                                                                  \
    }
#define TEN(of, t)                                                                                 \
    of(t##0) of(t##1) of(t##2) of(t##3) of(t##4) of(t##5) of(t##6) of(t##7) of(t##8) of(t##9)
#define ALL(of)                                                                                    \
    of(0) of(1) of(2) of(3) of(4) of(5) of(6) of(7) of(8) of(9) TEN(of, 1) TEN(of, 2) TEN(of, 3)   \
        TEN(of, 4) TEN(of, 5)
ALL(COUNT)

places_count *places_strains(int nodes, int scalars)
{
#define NAMED(n) count_##n,
    static places_count *const all[] = {ALL(NAMED)};
    return all[6 * (nodes - 1) + nodes * (1 + scalars)];
}

/* Returns the undeformed distance [m] of node k from the first node. */
static double distance(const element_data *d, int k)
{
    return d->length * d->place[k];
}

/* Returns the row of the first warping strain. */
static int first_warping(const element_data *d)
{
    return 6 * (d->nodes - 1);
}

/* Computes the chord to node k [m] and its change [m] in the axes of the first node. */
static void chord(const node_state x[], int k, double to[3], double moved[3])
{
    double d[3], u[3];
    for (int i = 0; i < 3; i++) {
        d[i] = x[k].r[i] - x[0].r[i];
        u[i] = x[k].u[i] - x[0].u[i];
    }
    mat3_transpose_mul_vec(x[0].R, d, to);
    mat3_transpose_mul_vec(x[0].R, u, moved);
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
        double *own = e + 6 * (k - 1), to[3], moved[3], psi[3];
        chord(x, k, to, moved);
        relative_rotation(&x[0], &x[k], psi);
        own[0] = vec3_elongation(to, moved, distance(d, k));
        for (int i = 1; i < 3; i++)
            own[i] = 2 * l * to[i] / (vec3_norm(to) + to[0]);
        for (int i = 0; i < 3; i++)
            own[3 + i] = l * psi[i];
    }
    for (int k = 0; k < d->nodes; k++)
        e[first_warping(d) + k] = l * l * x[k].a;
    for (int i = 0; i < d->scalars * d->nodes; i++)
        e[first_warping(d) + d->nodes + i] = l * x[i / d->scalars].scalar[i % d->scalars];
}

/* Computes Q[3 x 3]: the derivatives of the three strains of a node's position with respect to the
 * chord to the node. */
static void direction_rows(double l, const double to[3], double Q[9])
{
    const double size = vec3_norm(to);
    for (int i = 0; i < 3; i++) {
        const double p = 2 * to[i] / (size + to[0]);
        for (int j = 0; j < 3; j++) {
            const double n = to[j] / size;
            Q[3 * i + j] = i == 0 ? n : l / (size + to[0]) * (2 * (i == j) - p * ((j == 0) + n));
        }
    }
}

/* Computes the rows of J for node k > 0: the derivatives of its position and rotation strains. */
static void node_rows(const element_data *d, const node_state x[], int k, double J[])
{
    const int n = adapted_coordinates(d);
    double to[3], moved[3], psi[3], T[9], Q[9], turned[9], placed[9];
    double *place = J + 6 * (k - 1) * n, *turn = place + 3 * n;
    chord(x, k, to, moved);
    relative_rotation(&x[0], &x[k], psi);
    chart_dexp_inverse(psi, T);
    direction_rows(d->length, to, Q);
    double back[9]; /* d(n.d) = n.dd + dphi.(n x d) for a vector n that rotates with the first node
                       by dphi, and the chord d */
    for (int i = 0; i < 9; i++)
        back[i] = x[0].R[3 * (i % 3) + i / 3];
    mat3_mul(T, back, turned);
    mat3_mul(Q, back, placed);
    for (int i = 0; i < 3; i++) {
        double lever[3], global[3];
        mat3_mul_vec(x[0].R, to, global);
        vec3_cross(global, placed + 3 * i, lever);
        for (int j = 0; j < 3; j++) {
            place[i * n + j] = -placed[3 * i + j];
            place[i * n + 3 + j] = -lever[j];
            place[i * n + NODE_COORDINATES * k + j] = placed[3 * i + j];
            turn[i * n + 3 + j] = -d->length * turned[3 * i + j];
            turn[i * n + NODE_COORDINATES * k + 3 + j] = d->length * turned[3 * i + j];
        }
    }
}

static void jacobian(const element_data *d, const node_state x[], const double *history, double J[])
{
    (void)history;
    const int n = adapted_coordinates(d);
    memset(J, 0, (size_t)(d->strains * n) * sizeof *J);
    for (int k = 1; k < d->nodes; k++)
        node_rows(d, x, k, J);
    for (int k = 0; k < d->nodes; k++)
        J[(first_warping(d) + k) * n + NODE_COORDINATES * k + 6] = d->length * d->length;
    for (int i = 0; i < d->scalars * d->nodes; i++)
        J[(first_warping(d) + d->nodes + i) * n + NODE_COORDINATES * d->nodes + i] = d->length;
}

void places_strain(const element_data *d, const node_state x[], strain_output *out)
{
    if (out->e != NULL)
        strains_of(d, x, out->e);
    if (out->J != NULL)
        jacobian(d, x, NULL, out->J);
    if (out->s != NULL && out->H != NULL)
        differences_curvature(d, x, jacobian, out->s, out->H);
}

/* Returns 1 + n_x of the direction n for which p = (e[1], e[2])/l. */
static double forward(double l, const double e[])
{
    return 8 / (4 + (e[1] * e[1] + e[2] * e[2]) / (l * l));
}

void places_nodes(const element_data *d, const double e[], node_state x[])
{
    const double l = d->length;
    memset(x, 0, (size_t)d->nodes * sizeof *x);
    for (int k = 0; k < d->nodes; k++) {
        double psi[3] = {0}, q[4];
        x[k].r[0] = distance(d, k);
        if (k > 0) {
            const double *own = e + 6 * (k - 1), c = forward(l, own);
            const double size = x[k].r[0] + own[0];
            x[k].u[0] = own[0] - size * (own[1] * own[1] + own[2] * own[2]) / (l * l) * c / 4;
            x[k].u[1] = size * own[1] / l * c / 2;
            x[k].u[2] = size * own[2] / l * c / 2;
            for (int i = 0; i < 3; i++) {
                x[k].r[i] += x[k].u[i];
                psi[i] = own[3 + i] / l;
            }
        }
        rotation_exp(psi, q);
        rotation_matrix(q, x[k].R);
        x[k].a = e[first_warping(d) + k] / (l * l);
        for (int i = 0; i < d->scalars; i++)
            x[k].scalar[i] = e[first_warping(d) + d->nodes + d->scalars * k + i] / l;
    }
}

/* Computes the derivatives of the relative position with respect to its three strains, in rows of
 * stride m. */
static void direction_columns(double l, double undeformed, const double e[], int m, double rows[])
{
    const double c = forward(l, e), size = undeformed + e[0];
    const double n[3] = {c - 1, e[1] / l * c / 2, e[2] / l * c / 2};
    for (int i = 0; i < 3; i++) {
        rows[i * m] = n[i];
        for (int j = 1; j < 3; j++) {
            const double straight = i == j ? c / 2 : 0;
            const double bent = i == 0 ? c * c / 4 : n[i] * c / 4;
            rows[i * m + j] = size / l * (straight - bent * e[j] / l);
        }
    }
}

void places_motion(const element_data *d, const double e[], double B[])
{
    const double l = d->length;
    const int m = d->strains;
    memset(B, 0, (size_t)(adapted_coordinates(d) * m) * sizeof *B);
    for (int i = 0; i < d->scalars * d->nodes; i++)
        B[(NODE_COORDINATES * d->nodes + i) * m + first_warping(d) + d->nodes + i] = 1 / l;
    for (int k = 0; k < d->nodes; k++) {
        double *rows = B + NODE_COORDINATES * k * m, psi[3], T[9];
        rows[6 * m + first_warping(d) + k] = 1 / (l * l);
        if (k == 0)
            continue;
        const int own = 6 * (k - 1);
        direction_columns(l, distance(d, k), e + own, m, rows + own);
        for (int i = 0; i < 3; i++)
            psi[i] = e[own + 3 + i] / l;
        chart_dexp(psi, T);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                rows[(3 + i) * m + own + 3 + j] = T[3 * i + j] / l;
    }
}

enum { OUTCOME, ENERGY, FORCES };

status forces_of(const element_data *d, gather *together, const node_state x[], force_output *out)
{
    static const double none[FORCES + ELEMENT_MAX_COORDINATES * (ELEMENT_MAX_COORDINATES + 1)];
    const size_t n = (size_t)adapted_coordinates(d);
    if (together == NULL)
        return d->given->force(adapted_own(d), x, out);
    const double *answer = gather_next(together, adapted_own(d), x, out->history);
    if (answer == NULL)
        answer = none;
    if (out->energy != NULL)
        *out->energy = answer[ENERGY];
    if (out->F != NULL)
        memcpy(out->F, answer + FORCES, n * sizeof *answer);
    if (out->K != NULL)
        memcpy(out->K, answer + FORCES + n, n * n * sizeof *answer);
    return (status)answer[OUTCOME];
}

size_t forces_size(const element_data *d)
{
    const int n = adapted_coordinates(d);
    if (d->given->leaves & LEAVES_FORCE)
        return FORCES;
    return (size_t)(d->given->leaves & LEAVES_TANGENT ? FORCES + n : FORCES + n + n * n);
}

void forces_evaluate(const element_data *d, gather *g, int first, int count)
{
    const element_type *given = d->given;
    force_output out[GATHER_TOGETHER];
    status outcome[GATHER_TOGETHER];
    for (int i = 0; i < count; i++) {
        double *answer = g->answer + (size_t)(first + i) * g->size;
        out[i] = (force_output){.history = g->history[first + i]};
        if (out[i].history == NULL)
            out[i].energy = answer + ENERGY;
        if (!(given->leaves & LEAVES_FORCE))
            out[i].F = answer + FORCES;
        if (!(given->leaves & (LEAVES_FORCE | LEAVES_TANGENT)))
            out[i].K = answer + FORCES + adapted_coordinates(d);
    }
    given->force_many(count, g->data + first, g->x + (size_t)first * (size_t)g->nodes, out,
                      outcome);
    for (int i = 0; i < count; i++)
        g->answer[(size_t)(first + i) * g->size + OUTCOME] = outcome[i];
}
