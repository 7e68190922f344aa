/* Compliance of a node in a deformed state.  Prescribed motion that is released is replaced by its reactions as dead loads;
 * a moment that is dead about fixed axes adds -m~/2 to the rotation block of the symmetric stiffness. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/solve/analysis.h"

enum { COMPONENTS = 6, MAX_BORDER = 12 };

typedef struct border {
    int count;
    int coordinate[MAX_BORDER]; /* released: driven coordinates that are free now */
    double *U, *V;              /* [count x free]: K_fr; K_rf */
    double W[MAX_BORDER * MAX_BORDER];
} border;

typedef struct tangent {
    sparse K;      /* of all coordinates when something is released, else of the free ones */
    sparse inside; /* free x free */
    factor *factor;
    border border;
    int free, all;
    double *residual;
    int index[COMPONENTS], coordinates; /* the node's */
    double T[COMPONENTS * COMPONENTS];
} tangent;

static int is_released(const analysis_context *c, const scene_analysis *a, int coordinate)
{
    for (int k = 0; k < COMPONENTS; k++)
        if ((a->released >> k & 1u) && model_coordinate(c->model, a->node, k) == coordinate)
            return 1;
    return 0;
}

static status border_alloc(const analysis_context *c, const scene_analysis *a, tangent *t, fault *f)
{
    border *b = &t->border;
    const model_size size = model_sizes(c->model);
    t->free = size.free;
    t->all = size.free + size.driven;
    for (int i = size.free; i < t->all; i++)
        if (is_released(c, a, i))
            b->coordinate[b->count++] = i;
    b->U = calloc((size_t)(b->count * t->free) + 1, sizeof *b->U);
    b->V = calloc((size_t)(b->count * t->free) + 1, sizeof *b->V);
    t->residual = calloc((size_t)t->all + 1, sizeof *t->residual);
    return b->U == NULL || b->V == NULL || t->residual == NULL ? fault_set(f, STATUS_FAULT, "out of memory for a compliance")
                                                               : STATUS_OK;
}

static int place_in_border(const border *b, int coordinate)
{
    for (int i = 0; i < b->count; i++)
        if (b->coordinate[i] == coordinate)
            return i;
    return -1;
}

static void fill_border(tangent *t)
{
    border *b = &t->border;
    memset(b->U, 0, (size_t)(b->count * t->free) * sizeof *b->U);
    memset(b->V, 0, (size_t)(b->count * t->free) * sizeof *b->V);
    memset(b->W, 0, sizeof b->W);
    for (int j = 0; j < t->K.n; j++)
        for (int k = t->K.column[j]; k < t->K.column[j + 1]; k++) {
            const int i = t->K.row[k], row = i >= t->free ? place_in_border(b, i) : -1,
                      column = j >= t->free ? place_in_border(b, j) : -1;
            const double value = t->K.value[k];
            if (i < t->free && column >= 0)
                b->U[column * t->free + i] = value;
            if (j < t->free && row >= 0)
                b->V[row * t->free + j] = value;
            if (row >= 0 && column >= 0)
                b->W[row * b->count + column] = value;
            if (t->K.symmetric && i < t->free && column >= 0)
                b->V[column * t->free + i] = value;
            if (t->K.symmetric && row >= 0 && column >= 0)
                b->W[column * b->count + row] = value;
        }
}

/* The free block: the first columns of the whole, whose driven rows come last. */
static void copy_inside(tangent *t)
{
    if (t->inside.value == t->K.value)
        return;
    for (int j = 0; j < t->free; j++)
        memcpy(&t->inside.value[t->inside.column[j]], &t->K.value[t->K.column[j]],
               (size_t)(t->inside.column[j + 1] - t->inside.column[j]) * sizeof *t->inside.value);
}

static status tangent_alloc(analysis_context *c, const scene_analysis *a, tangent *t, fault *f)
{
    const sparse *inside, *whole;
    const double start = seconds_now();
    memset(t, 0, sizeof *t);
    status outcome = border_alloc(c, a, t, f);
    const int with_driven = t->border.count > 0;
    if (outcome == STATUS_OK)
        outcome = model_pattern(c->model, 0, &inside, f);
    if (outcome == STATUS_OK)
        outcome = model_pattern(c->model, with_driven, &whole, f);
    if (outcome == STATUS_OK)
        outcome = sparse_alloc_like(whole, &t->K, f);
    if (outcome == STATUS_OK && with_driven)
        outcome = sparse_alloc_like(inside, &t->inside, f);
    if (outcome == STATUS_OK && !with_driven)
        t->inside = t->K;
    if (outcome == STATUS_OK)
        outcome = factor_alloc(inside, &t->factor, f);
    c->setup += seconds_now() - start;
    return outcome;
}

static void tangent_free(tangent *t)
{
    if (t->inside.value != t->K.value)
        sparse_free_values(&t->inside);
    sparse_free_values(&t->K);
    factor_free(t->factor);
    free(t->border.U);
    free(t->border.V);
    free(t->residual);
}

/* reaction[6]: force and moment of the prescription on the node. */
static status tangent_at(analysis_context *c, const scene_analysis *a, const model_state *s, const double reaction[6], tangent *t,
                         fault *f)
{
    model_linearisation lin = {.path = model_state_path(s), .K = &t->K, .residual = t->residual};
    status outcome = model_linearise(c->model, s, &lin, f);
    if (outcome == STATUS_OK) {
        model_release_moment(c->model, s, a->node, reaction + 3, &t->K);
        copy_inside(t);
        outcome = factor_numeric(t->factor, &t->inside, f);
    }
    counters *n = model_counters(c->model);
    n->factorisations++;
    n->factor_flops += factor_count(t->factor).flops;
    fill_border(t);
    t->coordinates = model_node_jacobian(c->model, s, a->node, COMPONENTS, t->index, t->T);
    return outcome;
}

/* Coordinates of the node that move: free or released. */
static int moves(const tangent *t, int k)
{
    return t->index[k] < t->free || place_in_border(&t->border, t->index[k]) >= 0;
}

static double dot(int n, const double a[], const double b[])
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Response of the node to a unit load on one component; x: [free], z: [border]. */
static void respond(tangent *t, counters *n, int component, const double Z[], const double S[], const int pivot[], double *x,
                    double response[COMPONENTS])
{
    const border *b = &t->border;
    double z[MAX_BORDER] = {0};
    memset(x, 0, (size_t)t->free * sizeof *x);
    for (int k = 0; k < t->coordinates; k++) {
        const int place = place_in_border(b, t->index[k]);
        if (t->index[k] < t->free)
            x[t->index[k]] = t->T[component * t->coordinates + k];
        else if (place >= 0)
            z[place] = t->T[component * t->coordinates + k];
    }
    factor_solve(t->factor, x);
    n->solutions++;
    for (int i = 0; i < b->count; i++)
        z[i] -= dot(t->free, b->V + i * t->free, x);
    if (b->count > 0)
        dense_lu_solve(b->count, 1, S, pivot, z);
    for (int i = 0; i < b->count; i++)
        for (int k = 0; k < t->free; k++)
            x[k] -= Z[i * t->free + k] * z[i];
    for (int i = 0; i < COMPONENTS; i++) {
        response[i] = 0;
        for (int k = 0; k < t->coordinates; k++) {
            const int place = place_in_border(b, t->index[k]);
            const double moved = t->index[k] < t->free ? x[t->index[k]] : place >= 0 ? z[place] : 0;
            response[i] += t->T[i * t->coordinates + k] * (moves(t, k) ? moved : 0);
        }
    }
}

/* C[6 x 6] with conservative (semitangential) moments; columns outside `wanted` stay zero. */
static status symmetric_compliance(analysis_context *c, tangent *t, unsigned wanted, double C[36], fault *f)
{
    const border *b = &t->border;
    counters *n = model_counters(c->model);
    double *Z = calloc((size_t)(b->count * t->free) + 1, sizeof *Z), *x = calloc((size_t)t->free + 1, sizeof *x),
           S[MAX_BORDER * MAX_BORDER];
    int pivot[MAX_BORDER];
    status outcome = Z == NULL || x == NULL ? fault_set(f, STATUS_FAULT, "out of memory for a compliance") : STATUS_OK;
    for (int i = 0; i < b->count && outcome == STATUS_OK; i++) {
        memcpy(Z + i * t->free, b->U + i * t->free, (size_t)t->free * sizeof *Z);
        factor_solve(t->factor, Z + i * t->free);
        n->solutions++;
    }
    for (int i = 0; i < b->count && outcome == STATUS_OK; i++)
        for (int j = 0; j < b->count; j++)
            S[i * b->count + j] = b->W[i * b->count + j] - dot(t->free, b->V + i * t->free, Z + j * t->free);
    if (outcome == STATUS_OK && b->count > 0 && dense_lu(b->count, S, pivot) != 0)
        outcome = fault_set(f, STATUS_SINGULAR, "the structure is not held when the prescribed motion is released");
    memset(C, 0, 36 * sizeof *C);
    for (int j = 0; j < COMPONENTS && outcome == STATUS_OK; j++) {
        double response[COMPONENTS];
        if (!(wanted >> j & 1u))
            continue;
        respond(t, n, j, Z, S, pivot, x, response);
        for (int i = 0; i < COMPONENTS; i++)
            C[6 * i + j] = response[i];
    }
    free(Z);
    free(x);
    return outcome;
}

/* Components of the node that can move at all. */
static int movable(const tangent *t, int component[COMPONENTS])
{
    int count = 0;
    for (int i = 0; i < COMPONENTS; i++) {
        double size = 0;
        for (int k = 0; k < t->coordinates; k++)
            size += moves(t, k) ? fabs(t->T[i * t->coordinates + k]) : 0;
        if (size > 0)
            component[count++] = i;
    }
    return count;
}

/* C <- (C^-1 - m~/2 on the rotations)^-1 over the components that can move. */
static status add_dead_moment(const tangent *t, const double m[3], double C[36], fault *f)
{
    const double skew[9] = {0, -m[2], m[1], m[2], 0, -m[0], -m[1], m[0], 0};
    int component[COMPONENTS], pivot[COMPONENTS];
    const int n = movable(t, component);
    double A[36], K[36] = {0};
    for (int i = 0; i < n; i++) {
        K[i * n + i] = 1;
        for (int j = 0; j < n; j++)
            A[i * n + j] = C[6 * component[i] + component[j]];
    }
    if (dense_lu(n, A, pivot) != 0)
        return fault_set(f, STATUS_SINGULAR, "the compliance matrix is singular");
    dense_lu_solve(n, n, A, pivot, K);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            if (component[i] >= 3 && component[j] >= 3)
                K[i * n + j] -= skew[3 * (component[i] - 3) + component[j] - 3] / 2;
    memset(A, 0, sizeof A);
    for (int i = 0; i < n; i++)
        A[i * n + i] = 1;
    if (dense_lu(n, K, pivot) != 0)
        return fault_set(f, STATUS_SINGULAR, "the stiffness with dead moments is singular");
    dense_lu_solve(n, n, K, pivot, A);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            C[6 * component[i] + component[j]] = A[i * n + j];
    return STATUS_OK;
}

/* Loads whose response some quantity asks for. */
static unsigned wanted_columns(const analysis_context *c, int analysis)
{
    unsigned wanted = 0;
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (q->analysis == analysis && (q->kind == SCENE_COMPLIANCE_ENTRY || q->kind == SCENE_STIFFNESS_ENTRY))
            wanted |= 1u << q->column;
    }
    return wanted;
}

static status compliance_at(analysis_context *c, const scene_analysis *a, const model_state *s, tangent *t, unsigned wanted,
                            double C[36], fault *f)
{
    double F[6], load[6];
    int component[COMPONENTS];
    model_node_force(c->model, s, a->node, F);
    model_node_load(c->model, s, a->node, load);
    for (int i = 0; i < 6; i++)
        F[i] -= load[i];
    status outcome = tangent_at(c, a, s, F, t, f);
    if (outcome != STATUS_OK)
        return outcome;
    const int count = movable(t, component), turns = count > 0 && component[count - 1] >= 3;
    const int dead = a->moments == SCENE_MOMENTS_SPATIAL && turns && vec3_norm(F + 3) > 0;
    if (dead)
        for (int i = 0; i < count; i++)
            wanted |= 1u << component[i];
    outcome = symmetric_compliance(c, t, wanted, C, f);
    if (outcome == STATUS_OK && dead)
        outcome = add_dead_moment(t, F + 3, C, f);
    return outcome;
}

status analysis_compliance(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    const scene_analysis *a = &c->scene->analysis[analysis];
    const analysis_outcome *path = a->follows == SCENE_NONE ? NULL : &c->outcomes[a->follows];
    const int reached = path != NULL ? path->reached : 1;
    tangent t;
    status result = tangent_alloc(c, a, &t, f);
    o->stations = path != NULL ? path->stations : 1;
    o->path = calloc((size_t)o->stations + 1, sizeof *o->path);
    o->compliance = calloc((size_t)o->stations * 36 + 1, sizeof *o->compliance);
    if (o->path == NULL || o->compliance == NULL)
        result = fault_set(f, STATUS_FAULT, "out of memory for a compliance");
    const unsigned wanted = wanted_columns(c, analysis);
    for (int i = 0; i < reached && result == STATUS_OK; i++) {
        const model_state *s = path != NULL ? path->state[i] : model_rest(c->model);
        result = compliance_at(c, a, s, &t, wanted, o->compliance + 36 * (size_t)i, f);
        if (result == STATUS_OK) {
            o->path[i] = path != NULL ? path->path[i] : 0;
            o->reached++;
        }
    }
    tangent_free(&t);
    return result;
}
