#include "harness/formulations/formulations_impl.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/formulations/adapted.h"

static int add(stencil_function *f, const void *context, int count, int i, double si, int j,
               double sj, double weight, double out[])
{
    double values[STENCIL_MOST];
    const int outcome = f(context, i, si, j, sj, values);
    for (int k = 0; k < count && outcome == 0; k++)
        out[k] += weight * values[k];
    return outcome;
}

int stencil_first(stencil_function *f, const void *context, int count, int i, double out[])
{
    static const double weight[] = {45. / 60, -9. / 60, 1. / 60};
    int outcome = 0;
    memset(out, 0, (size_t)count * sizeof *out);
    for (int k = 0; k < 3 && outcome == 0; k++) {
        const double h = (k + 1) * stencil_first_step, w = weight[k] / stencil_first_step;
        outcome = add(f, context, count, i, h, i, 0, w, out);
        if (outcome == 0)
            outcome = add(f, context, count, i, -h, i, 0, -w, out);
    }
    return outcome;
}

int stencil_second(stencil_function *f, const void *context, int count, int i, int j, double out[])
{
    /* weights for finite differences with steps h, 2 h and 3 h, whose errors are even powers of
     * h */
    static const double weight[] = {3. / 2, -3. / 5, 1. / 10};
    int outcome = 0;
    memset(out, 0, (size_t)count * sizeof *out);
    for (int k = 0; k < 3; k++)
        for (int sign = 0; sign < 4 && outcome == 0; sign++) {
            const double h = (k + 1) * stencil_second_step / (i == j ? 2 : 1);
            const double si = sign & 1 ? -h : h, sj = sign & 2 ? -h : h;
            const double w = weight[k] / (4 * h * h) * (si * sj > 0 ? 1 : -1);
            outcome = add(f, context, count, i, si, j, sj, w, out);
        }
    return outcome;
}

void chart_move(const node_state x[], int nodes, int scalars, const double step[], node_state out[])
{
    const double *more = step + (ptrdiff_t)NODE_COORDINATES * nodes;
    memcpy(out, x, (size_t)nodes * sizeof *x);
    for (int k = 0; k < nodes; k++, step += NODE_COORDINATES) {
        for (int i = 0; i < 3; i++) {
            out[k].r[i] += step[i];
            out[k].u[i] += step[i];
        }
        if (step[3] != 0 || step[4] != 0 || step[5] != 0) {
            double q[4], turn[9];
            rotation_exp(step + 3, q);
            rotation_matrix(q, turn);
            mat3_mul(turn, x[k].R, out[k].R);
        }
        out[k].a += step[6];
        for (int i = 0; i < scalars; i++)
            out[k].scalar[i] += more[scalars * k + i];
    }
}

double chart_unit(int c, int nodes, double length)
{
    if (c >= NODE_COORDINATES * nodes)
        return 1;
    c %= NODE_COORDINATES;
    if (c < 3)
        return length;
    return c < 6 ? 1 : 1 / length;
}

/* Computes 1 + a psi~ + b psi~^2. */
static void quadratic(const double psi[3], double a, double b, double T[9])
{
    const double p[9] = {0, -psi[2], psi[1], psi[2], 0, -psi[0], -psi[1], psi[0], 0};
    double square[9];
    mat3_mul(p, p, square);
    for (int i = 0; i < 9; i++)
        T[i] = (i % 4 == 0) + a * p[i] + b * square[i];
}

void chart_dexp(const double psi[3], double T[9])
{
    const double t = vec3_norm(psi), half = sin(t / 2);
    if (t < 1e-2) /* neglected terms are below 1e-16 */
        quadratic(psi, 1. / 2 - t * t / 24 + t * t * t * t / 720,
                  1. / 6 - t * t / 120 + t * t * t * t / 5040, T);
    else
        quadratic(psi, 2 * half * half / (t * t), (t - sin(t)) / (t * t * t), T);
}

void chart_dexp_inverse(const double psi[3], double T[9])
{
    const double t = vec3_norm(psi);
    if (t < 1e-1) /* the neglected term is below 1e-16 */
        quadratic(psi, -1. / 2,
                  1. / 12 + t * t / 720 + t * t * t * t / 30240 + t * t * t * t * t * t / 1209600,
                  T);
    else
        quadratic(psi, -1. / 2, (1 - t / 2 / tan(t / 2)) / (t * t), T);
}

/* no further element is added if the answers exceed this number of bytes */
enum { ENOUGH = 1 << 24 };

static int make_room(gather *g)
{
    const int room = g->room > 0 ? 2 * g->room : 256;
    const size_t count = (size_t)room, nodes = (size_t)g->nodes;
    const element_data **data = realloc(g->data, count * sizeof(void *));
    if (data == NULL)
        return 0;
    g->data = data;
    const double **history = realloc(g->history, count * sizeof(void *));
    if (history == NULL)
        return 0;
    g->history = history;
    node_state *x = realloc(g->x, count * nodes * sizeof *x);
    if (x == NULL)
        return 0;
    g->x = x;
    double *answer = realloc(g->answer, count * g->size * sizeof *answer);
    if (answer == NULL)
        return 0;
    g->answer = answer;
    g->room = room;
    return 1;
}

const double *gather_next(gather *g, const element_data *own, const node_state x[],
                          const double *history)
{
    if (g->answered)
        return g->answer + (size_t)g->next++ * g->size;
    if (g->failed || (g->count == g->room && !make_room(g))) {
        g->failed = 1;
        return NULL;
    }
    g->data[g->count] = own;
    g->history[g->count] = history;
    memcpy(g->x + (size_t)g->count * (size_t)g->nodes, x, (size_t)g->nodes * sizeof *x);
    g->count++;
    return NULL;
}

static int is_full(const gather *g)
{
    return g->failed || (size_t)g->count * g->size * sizeof *g->answer > ENOUGH;
}

/* Passes the answers to the elements. start[i]: first state of element i. */
static void hand_out(gather *g, const int start[], int first, int end, gather_element *element,
                     gather_evaluate *evaluate, void *context)
{
    for (int k = 0; k < g->count && !g->failed; k += GATHER_TOGETHER)
        evaluate(context, g, k, g->count - k < GATHER_TOGETHER ? g->count - k : GATHER_TOGETHER);
    g->answered = 1;
    for (int i = first; i < end; i++) {
        g->next = start[i];
        element(context, g->failed ? NULL : g, i);
    }
    g->answered = g->count = g->failed = 0;
}

void gather_run(int count, int nodes, size_t size, gather_element *element,
                gather_evaluate *evaluate, void *context)
{
    gather g = {.nodes = nodes, .size = size};
    int first = 0, *start = malloc((size_t)count * sizeof *start);
    for (int i = 0; i < count && start == NULL; i++)
        element(context, NULL, i);
    for (int i = 0; i < count && start != NULL; i++) {
        start[i] = g.count;
        element(context, &g, i);
        if (i + 1 < count && !is_full(&g))
            continue;
        hand_out(&g, start, first, i + 1, element, evaluate, context);
        first = i + 1;
    }
    free(start);
    free(g.data);
    free(g.history);
    free(g.x);
    free(g.answer);
}

typedef struct difference_place {
    const element_data *data;
    const node_state *x;
    const double *s;       /* stresses, for second derivatives */
    const double *history; /* history of the element; NULL: none */
    differences_jacobian *jacobian;
    gather *together;
} difference_place;

static void moved(const difference_place *at, int i, double si, int j, double sj, node_state out[])
{
    double step[ELEMENT_MAX_COORDINATES] = {0};
    const element_data *d = at->data;
    step[i] += si * chart_unit(i, d->nodes, d->length);
    step[j] += sj * chart_unit(j, d->nodes, d->length);
    chart_move(at->x, d->nodes, d->scalars, step, out);
}

/* Copies an answer, or writes zeros if there is no answer yet. */
static void copy_answer(const double *answer, int count, double values[])
{
    if (answer != NULL)
        memcpy(values, answer, (size_t)count * sizeof *values);
    else
        memset(values, 0, (size_t)count * sizeof *values);
}

static int strains_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const difference_place *at = context;
    node_state x[ELEMENT_MAX_NODES];
    if (at->together == NULL || !at->together->answered)
        moved(at, i, si, j, sj, x);
    if (at->together == NULL)
        at->data->given->strain(adapted_own(at->data), x,
                                &(strain_output){.e = values, .history = at->history});
    else
        copy_answer(gather_next(at->together, adapted_own(at->data), x, at->history),
                    at->data->strains, values);
    return 0;
}

/* Computes s.e, whose second derivative is H. */
static int work_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const difference_place *at = context;
    double e[ELEMENT_MAX_STRAINS];
    strains_at(context, i, si, j, sj, e);
    values[0] = 0;
    for (int k = 0; k < at->data->strains; k++)
        values[0] += at->s[k] * e[k];
    return 0;
}

/* Computes J^T s. */
static int forces_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const difference_place *at = context;
    const int n = adapted_coordinates(at->data);
    double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES];
    node_state x[ELEMENT_MAX_NODES];
    if (at->together == NULL || !at->together->answered)
        moved(at, i, si, j, sj, x);
    if (at->together == NULL)
        at->jacobian(at->data, x, at->history, J);
    else
        copy_answer(gather_next(at->together, adapted_own(at->data), x, at->history),
                    at->data->strains * n, J);
    for (int c = 0; c < n; c++) {
        values[c] = 0;
        for (int k = 0; k < at->data->strains; k++)
            values[c] += J[k * n + c] * at->s[k];
    }
    return 0;
}

/* Returns the factor that converts a derivative per unit step of coordinate c (chart_unit) to a
 * derivative with respect to c. */
static double per_unit(const element_data *d, int c)
{
    return 1 / chart_unit(c, d->nodes, d->length);
}

static void first(const difference_place *at, double J[])
{
    const element_data *d = at->data;
    const int n = adapted_coordinates(d);
    double column[ELEMENT_MAX_STRAINS];
    for (int c = 0; c < n; c++) {
        stencil_first(strains_at, at, d->strains, c, column);
        for (int k = 0; k < d->strains; k++)
            J[k * n + c] = column[k] * per_unit(d, c);
    }
}

static void second(const difference_place *at, double H[])
{
    const element_data *d = at->data;
    const int n = adapted_coordinates(d);
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double value;
            stencil_second(work_at, at, 1, i, j, &value);
            H[i * n + j] = H[j * n + i] = value * per_unit(d, i) * per_unit(d, j);
        }
}

static void curvature(const difference_place *at, double H[])
{
    const element_data *d = at->data;
    const int n = adapted_coordinates(d);
    double column[ELEMENT_MAX_COORDINATES];
    memset(H, 0, (size_t)(n * n) * sizeof *H);
    for (int j = 0; j < n; j++) {
        stencil_first(forces_at, at, n, j, column);
        for (int i = 0; i < n; i++) {
            const double half = column[i] * per_unit(d, j) / 2;
            H[i * n + j] += half;
            H[j * n + i] += half;
        }
    }
}

void differences_curvature(const element_data *d, const node_state x[],
                           differences_jacobian *jacobian, const double s[], double H[])
{
    curvature(&(difference_place){.data = d, .x = x, .s = s, .jacobian = jacobian}, H);
}

static void given_jacobian(const element_data *d, const node_state x[], const double *history,
                           double J[])
{
    d->given->strain(adapted_own(d), x, &(strain_output){.J = J, .history = history});
}

static int leaves_j(const element_data *d)
{
    return (d->given->leaves & LEAVES_J) != 0;
}

static int leaves_h(const element_data *d)
{
    return (d->given->leaves & (LEAVES_J | LEAVES_H)) != 0;
}

/* Returns the requested outputs that the type itself computes. The others are NULL. */
static strain_output given_part(const element_data *d, const strain_output *out)
{
    strain_output requested = *out;
    requested.J = leaves_j(d) ? NULL : out->J;
    requested.H = leaves_h(d) ? NULL : out->H;
    requested.s = leaves_h(d) ? NULL : out->s;
    return requested;
}

static void made_part(const element_data *d, const node_state x[], gather *together,
                      const strain_output *out)
{
    const difference_place at = {.data = d,
                                 .x = x,
                                 .s = out->s,
                                 .history = out->history,
                                 .jacobian = given_jacobian,
                                 .together = together};
    if (leaves_j(d) && out->J != NULL)
        first(&at, out->J);
    if (!leaves_h(d) || out->s == NULL || out->H == NULL)
        return;
    if (leaves_j(d))
        second(&at, out->H);
    else
        curvature(&at, out->H);
}

typedef struct many {
    const element_data *const *data;
    const node_state *x;
    strain_output *out;
} many;

static void make_one(void *context, gather *together, int i)
{
    const many *all = context;
    const element_data *d = all->data[i];
    made_part(d, all->x + i * d->nodes, together, &all->out[i]);
}

static void evaluate_states(void *context, gather *g, int first_state, int count)
{
    const many *all = context;
    strain_output out[GATHER_TOGETHER];
    for (int i = 0; i < count; i++) {
        double *answer = g->answer + (size_t)(first_state + i) * g->size;
        out[i] =
            leaves_j(all->data[0]) ? (strain_output){.e = answer} : (strain_output){.J = answer};
        out[i].history = g->history[first_state + i];
    }
    all->data[0]->given->strain_many(count, g->data + first_state,
                                     g->x + (size_t)first_state * (size_t)g->nodes, out);
}

static void give_parts(int count, const many *all)
{
    const element_data *own[ADAPTED_TOGETHER];
    strain_output requested[ADAPTED_TOGETHER];
    for (int i = 0; i < count; i += ADAPTED_TOGETHER) {
        const int part = adapted_owns(count - i, all->data + i, own);
        for (int k = 0; k < part; k++)
            requested[k] = given_part(all->data[i + k], &all->out[i + k]);
        all->data[0]->given->strain_many(part, own, all->x + i * all->data[0]->nodes, requested);
    }
}

static int has_history(int count, const element_data *const data[], strain_output out[])
{
    int missing = 0;
    for (int i = 0; i < count; i++) {
        const element_data *d = data[i];
        const int n = adapted_coordinates(d);
        if (d->history == 0 || out[i].history != NULL)
            continue;
        missing = 1;
        for (int k = 0; out[i].e != NULL && k < d->strains; k++)
            out[i].e[k] = NAN;
        for (int k = 0; out[i].J != NULL && k < d->strains * n; k++)
            out[i].J[k] = NAN;
        for (int k = 0; out[i].s != NULL && out[i].H != NULL && k < n * n; k++)
            out[i].H[k] = NAN;
    }
    return !missing;
}

void differences_strain_many(int count, const element_data *const data[], const node_state x[],
                             strain_output out[])
{
    many all = {data, x, out};
    if (count == 0 || !has_history(count, data, out))
        return;
    give_parts(count, &all);
    const element_data *d = data[0];
    const int answer = leaves_j(d) ? d->strains : d->strains * adapted_coordinates(d);
    gather_run(count, d->nodes, (size_t)answer, make_one, evaluate_states, &all);
}

void differences_strain(const element_data *d, const node_state x[], strain_output *out)
{
    if (d->given->strain_many != NULL) {
        differences_strain_many(1, &d, x, out);
        return;
    }
    if (!has_history(1, &d, out))
        return;
    strain_output requested = given_part(d, out);
    d->given->strain(adapted_own(d), x, &requested);
    made_part(d, x, NULL, out);
}
