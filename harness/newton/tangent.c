/* The tangent of the free coordinates is factored once, and then bordered by the released
 * coordinates:
 *   [ K  U ] [x]   [f]
 *   [ V  W ] [z] = [g],   S = W - V K^-1 U,   z = S^-1 (g - V K^-1 f),   x = K^-1 f - K^-1 U z. */
#include "harness/newton/newton_impl.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

static int border_place(const border *, int coordinate);
static void border_fill(border *, int free_count, const sparse *K);
/* Solves the bordered system in place: x[columns x all]. Fixed and prescribed coordinates do not
 * change. */
static void bordered_solve(node_tangent *t, const bordered *s, int columns, double x[]);
/* Refines the columns of s->solution iteratively for s->load, all at once. The stiff part of the
 * residuals is computed from the element strains (stiffness_parts_material_products). SINGULAR: the
 * accuracy is insufficient because of rounding. */
static status bordered_refine(const equations *eq, node_tangent *t, const bordered *s, int columns,
                              fault *f);

/* Above this condition number, a solution has fewer than eight digits without refinement. */
static const double harmless_condition = 1e8;
static const double clear = 30, alike = 2;

static void copy_inside(node_tangent *t)
{
    if (t->inside.value != t->K.value)
        sparse_copy_leading(&t->K, &t->inside);
}

static status allocate(const analysis_context *c, const scene_compliance *a,
                       const condensation *members, node_tangent *t, fault *f)
{
    const sparse *inside, *whole;
    const model_size size = model_sizes(c->model);
    t->free = size.free;
    t->all = size.free + size.driven;
    TRY(border_alloc(c, a, &t->border, f));
    t->residual = calloc((size_t)t->all + 1, sizeof *t->residual);
    if (t->residual == NULL)
        return fault_memory(f, "a compliance");
    const int with_driven = t->border.count > 0;
    const border *b = &t->border;
    if (members != NULL)
        TRY(condensation_alloc_like(members, b->count, b->coordinate, &t->condensed, f));
    else
        TRY(context_condensation(c, b->count, b->coordinate, &t->condensed, f));
    TRY(assemble_pattern_of_states(c->model, c->run->patterns, with_driven, &whole, f));
    TRY(sparse_alloc_like(whole, &t->geometric, f));
    if (t->condensed != NULL)
        return condensation_as_factor(t->condensed, &t->own, f);
    TRY(assemble_pattern_of_states(c->model, c->run->patterns, 0, &inside, f));
    TRY(sparse_alloc_like(whole, &t->K, f));
    if (with_driven)
        TRY(sparse_alloc_like(inside, &t->inside, f));
    else
        t->inside = t->K;
    return STATUS_OK;
}

status tangent_alloc(analysis_context *c, const scene_compliance *a, const condensation *members,
                     node_tangent *t, fault *f)
{
    const double start = clock_processor_seconds();
    memset(t, 0, sizeof *t);
    const status outcome = allocate(c, a, members, t, f);
    c->work->setup += clock_processor_seconds() - start;
    return outcome;
}

void tangent_free(node_tangent *t)
{
    if (t->inside.value != t->K.value)
        sparse_free_values(&t->inside);
    sparse_free_values(&t->K);
    sparse_free_values(&t->geometric);
    factor_free(t->own);
    border_free(&t->border);
    free(t->residual);
}

static status factor_inside(analysis_context *c, node_tangent *t, fault *f)
{
    counters *n = &c->run->counters;
    if (t->own == NULL) {
        const double start = clock_processor_seconds();
        const status allocated = assemble_factor(c->run->patterns, &t->inside, &t->own, f);
        c->work->setup += clock_processor_seconds() - start;
        TRY(allocated);
    }
    t->factor = t->own;
    const status outcome = t->condensed != NULL ? context_factor_condensed(c, t->condensed, f)
                                                : context_factor(c, t->factor, &t->inside, f);
    const factor_counts counts = factor_count(t->factor);
    n->factorisations++;
    n->negative_pivots =
        counts.negative_pivots > n->negative_pivots ? counts.negative_pivots : n->negative_pivots;
    return outcome;
}

static int needs_refinement(node_tangent *t)
{
    const double apart = factor_count(t->factor).condition;
    const int clearly = t->condition > clear * harmless_condition ||
                        t->condition * clear < harmless_condition,
              same = apart < alike * t->apart && t->apart < alike * apart;
    if (t->condition == 0 || !clearly || !same) {
        t->condition = factor_condition(t->factor, &t->inside);
        t->apart = apart;
    }
    return t->condition > harmless_condition;
}

static status complete(analysis_context *c, const scene_compliance *a, const model_state *s,
                       const double reaction[6], node_tangent *t, fault *f)
{
    t->state = s;
    t->refined = t->condensed != NULL || needs_refinement(t);
    if (t->refined) {
        TRY(stiffness_parts_geometric(&c->eq, &c->run->memory, s, &t->geometric, f));
        loads_release_moment(c->model, s, a->node, reaction + 3, &t->geometric);
    }
    if (t->condensed == NULL)
        border_fill(&t->border, t->free, &t->K);
    t->coordinates =
        kinematics_node_jacobian(c->model, s, a->node, TANGENT_COMPONENTS, t->index, t->T);
    return STATUS_OK;
}

status tangent_at(analysis_context *c, const scene_compliance *a, const model_state *s,
                  const double reaction[6], node_tangent *t, fault *f)
{
    const int condensed = t->condensed != NULL;
    model_linearisation lin = {
        .path = kinematics_state_path(s), .K = condensed ? NULL : &t->K, .residual = t->residual};
    TRY(linearise_state(&c->eq, &c->run->memory, s, &lin, f));
    if (condensed)
        TRY(condensation_at(t->condensed, s, lin.path, f));
    loads_release_moment(c->model, s, a->node, reaction + 3,
                         condensed ? condensation_ends(t->condensed) : &t->K);
    if (!condensed)
        copy_inside(t);
    TRY(factor_inside(c, t, f));
    return complete(c, a, s, reaction, t, f);
}

status tangent_take(analysis_context *c, const scene_compliance *a, const model_state *s,
                    const double reaction[6], const sparse *K, const sparse *inside,
                    matrix_factor *fa, node_tangent *t, fault *f)
{
    const size_t size = (size_t)inside->column[inside->n] * sizeof *inside->value;
    memcpy(t->K.value, K->value, (size_t)K->column[K->n] * sizeof *K->value);
    loads_release_moment(c->model, s, a->node, reaction + 3, &t->K);
    copy_inside(t);
    t->factor = fa;
    if (memcmp(t->inside.value, inside->value, size) != 0)
        TRY(factor_inside(c, t, f));
    return complete(c, a, s, reaction, t, f);
}

status tangent_take_condensed(analysis_context *c, const scene_compliance *a, const model_state *s,
                              const double reaction[6], const condensation *members,
                              node_tangent *t, fault *f)
{
    condensation_take(t->condensed, members, s);
    loads_release_moment(c->model, s, a->node, reaction + 3, condensation_ends(t->condensed));
    TRY(factor_inside(c, t, f));
    return complete(c, a, s, reaction, t, f);
}

static int moves(const node_tangent *t, int k)
{
    return t->index[k] < t->free || border_place(&t->border, t->index[k]) >= 0;
}

/* load_of computes the loads on the moving coordinates due to a unit load on a component of the
 * node. motion_of returns the motion of a component due to the motions x of these coordinates. */
static void load_of(const node_tangent *t, const int moving[], int component, double x[])
{
    memset(x, 0, (size_t)t->all * sizeof *x);
    for (int k = 0; k < t->coordinates; k++)
        if (moving[k])
            x[t->index[k]] = t->T[component * t->coordinates + k];
}

static double motion_of(const node_tangent *t, const int moving[], int component, const double x[])
{
    double sum = 0;
    for (int k = 0; k < t->coordinates; k++)
        sum += moving[k] ? t->T[component * t->coordinates + k] * x[t->index[k]] : 0;
    return sum;
}

static status respond_all(const equations *eq, node_tangent *t, bordered *s, unsigned wanted,
                          unsigned components, double C[36], fault *f)
{
    int moving[TANGENT_COMPONENTS], component[TANGENT_COMPONENTS], count = 0;
    TRY(bordered_alloc(t, s, f));
    for (int k = 0; k < t->coordinates; k++)
        moving[k] = moves(t, k);
    for (int j = 0; j < TANGENT_COMPONENTS; j++)
        if (wanted & components & 1u << j) {
            load_of(t, moving, j, s->solution + count * t->all);
            component[count++] = j;
        }
    if (t->refined)
        memcpy(s->load, s->solution, (size_t)(count * t->all) * sizeof *s->load);
    bordered_solve(t, s, count, s->solution);
    if (t->refined)
        TRY(bordered_refine(eq, t, s, count, f));
    for (int c = 0; c < count; c++)
        for (int i = 0; i < TANGENT_COMPONENTS; i++)
            if (components >> i & 1u)
                C[6 * i + component[c]] = motion_of(t, moving, i, s->solution + c * t->all);
    return STATUS_OK;
}

status tangent_compliance(analysis_context *c, node_tangent *t, unsigned wanted,
                          unsigned components, double C[36], fault *f)
{
    bordered s = {0};
    memset(C, 0, 36 * sizeof *C);
    const status outcome = respond_all(&c->eq, t, &s, wanted, components, C, f);
    bordered_free(&s);
    return outcome;
}

static int columns_of(const node_tangent *t, int (*wanted)(const node_tangent *, int), double out[])
{
    int n = 0;
    for (int k = 0; k < t->coordinates; k++)
        n += wanted(t, k);
    for (int k = 0, at = 0; k < t->coordinates; k++)
        if (wanted(t, k)) {
            for (int i = 0; i < TANGENT_COMPONENTS; i++)
                out[i * n + at] = t->T[i * t->coordinates + k];
            at++;
        }
    return n;
}

static int is_free(const node_tangent *t, int k)
{
    return t->index[k] < t->free;
}

/* Computes the moment whose work per unit rate of angle k is g_k. Its component normal to all axes
 * b is zero. */
static void moment_of(int angles, double b[3][3], const double g[3], double moment[3])
{
    double A[9], factor[3] = {g[0], g[1], g[2]};
    int pivot[3];
    memset(moment, 0, 3 * sizeof *moment);
    for (int i = 0; i < angles; i++)
        for (int j = 0; j < angles; j++)
            A[i * angles + j] = vec3_dot(b[i], b[j]);
    if (dense_lu_regular(angles, A, pivot) != 0)
        return;
    dense_lu_solve(angles, 1, A, pivot, factor);
    for (int k = 0; k < angles; k++)
        for (int i = 0; i < 3; i++)
            moment[i] += factor[k] * b[k][i];
}

status tangent_driven_moment(analysis_context *c, const model_state *s, int node, node_tangent *t,
                             double moment[3], fault *f)
{
    const mesh_vertex *v = model_vertex(c->model, node);
    double b[3][3], g[3] = {0, 0, 0};
    int driven[3], others = v->angles == 1 || v->angles == 2, followed = 0;
    for (int k = 0; k < v->angles; k++) {
        const int at = v->coordinate[SCENE_RX + k],
                  tied = model_tie(c->model, node, SCENE_RX + k) != NULL;
        driven[k] = at != NONE && at >= t->free;
        followed |= driven[k] && tied;
        others |= at == NONE || tied;
    }
    if (!others)
        return STATUS_OK;
    if (followed) {
        model_linearisation lin = {.path = kinematics_state_path(s), .residual = t->residual};
        TRY(linearise_state(&c->eq, &c->run->memory, s, &lin, f));
    }
    kinematics_axes(c->model, s, node, b);
    for (int k = 0; k < v->angles; k++)
        if (driven[k])
            g[k] = followed ? -t->residual[v->coordinate[SCENE_RX + k]] : vec3_dot(moment, b[k]);
    moment_of(v->angles, b, g, moment);
    return STATUS_OK;
}

void tangent_prescribed(const node_tangent *t, double moment[3])
{
    double T[TANGENT_COMPONENTS * TANGENT_COMPONENTS], rest[3];
    const int n = columns_of(t, is_free, T);
    movable_prescribed(n, T, moment, rest);
    memcpy(moment, rest, sizeof rest);
}

void tangent_movable(const model *m, const node_tangent *t, movable *out)
{
    double T[TANGENT_COMPONENTS * TANGENT_COMPONENTS];
    const int n = columns_of(t, moves, T);
    movable_of(n, T, model_length(m), out);
}

static int is_released(const analysis_context *c, const scene_compliance *a, int coordinate)
{
    const scene_node *n = &c->scene->node[a->node];
    for (int k = 0; k < TANGENT_COMPONENTS; k++)
        if ((a->released >> k & 1u) &&
            kinematics_coordinate(c->model, a->node, scene_node_coordinate(n, k)) == coordinate)
            return 1;
    return 0;
}

status border_alloc(const analysis_context *c, const scene_compliance *a, border *b, fault *f)
{
    const model_size size = model_sizes(c->model);
    for (int i = size.free; i < size.free + size.driven; i++)
        if (is_released(c, a, i))
            b->coordinate[b->count++] = i;
    b->U = calloc((size_t)(b->count * size.free) + 1, sizeof *b->U);
    b->V = calloc((size_t)(b->count * size.free) + 1, sizeof *b->V);
    return b->U == NULL || b->V == NULL ? fault_memory(f, "a compliance") : STATUS_OK;
}

void border_free(border *b)
{
    free(b->U);
    free(b->V);
}

static int border_place(const border *b, int coordinate)
{
    for (int i = 0; i < b->count; i++)
        if (b->coordinate[i] == coordinate)
            return i;
    return -1;
}

static void border_fill(border *b, int free_count, const sparse *K)
{
    memset(b->U, 0, (size_t)(b->count * free_count) * sizeof *b->U);
    memset(b->V, 0, (size_t)(b->count * free_count) * sizeof *b->V);
    memset(b->W, 0, sizeof b->W);
    for (int j = 0; j < K->n; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++) {
            const int i = K->row[k], row = i >= free_count ? border_place(b, i) : -1,
                      column = j >= free_count ? border_place(b, j) : -1;
            const double value = K->value[k];
            if (i < free_count && column >= 0)
                b->U[column * free_count + i] = value;
            if (j < free_count && row >= 0)
                b->V[row * free_count + j] = value;
            if (row >= 0 && column >= 0)
                b->W[row * b->count + column] = value;
            if (K->symmetric && i < free_count && column >= 0)
                b->V[column * free_count + i] = value;
            if (K->symmetric && row >= 0 && column >= 0)
                b->W[column * b->count + row] = value;
        }
}

status bordered_alloc(node_tangent *t, bordered *out, fault *f)
{
    const border *b = &t->border;
    const size_t all = (size_t)t->all + 1;
    const int columns = t->condensed != NULL ? 0 : b->count;
    const size_t size = TANGENT_COMPONENTS * all;
    out->Z = calloc((size_t)(columns * t->free) + 1, sizeof *out->Z);
    out->solution = calloc(3 * size + all, sizeof *out->solution);
    if (out->Z == NULL || out->solution == NULL)
        return fault_memory(f, "a compliance");
    out->load = out->solution + size;
    out->rest = out->load + size;
    out->weight = out->rest + size;
    memcpy(out->Z, b->U, (size_t)(columns * t->free) * sizeof *out->Z);
    factor_solve_many(t->factor, columns, t->free, out->Z);
    for (int i = 0; i < columns; i++)
        for (int j = 0; j < columns; j++)
            out->S[i * b->count + j] = b->W[i * b->count + j] -
                                       dense_dot(t->free, b->V + i * t->free, out->Z + j * t->free);
    return columns > 0 && dense_lu_regular(b->count, out->S, out->pivot) != 0
               ? fault_set(f, STATUS_SINGULAR,
                           "the structure is not supported without its prescribed motion; fix more "
                           "components, or release fewer")
               : STATUS_OK;
}

void bordered_free(bordered *s)
{
    free(s->Z);
    free(s->solution);
}

static void add_released(const node_tangent *t, const bordered *s, double x[])
{
    const border *b = &t->border;
    double z[TANGENT_BORDER];
    for (int i = 0; i < b->count; i++)
        z[i] = x[b->coordinate[i]] - dense_dot(t->free, b->V + i * t->free, x);
    dense_lu_solve(b->count, 1, s->S, s->pivot, z);
    for (int i = 0; i < b->count; i++) {
        for (int k = 0; k < t->free; k++)
            x[k] -= s->Z[i * t->free + k] * z[i];
        x[b->coordinate[i]] = z[i];
    }
}

static void bordered_solve(node_tangent *t, const bordered *s, int columns, double x[])
{
    factor_solve_many(t->factor, columns, t->all, x);
    for (int c = 0; c < columns && t->condensed == NULL && t->border.count > 0; c++)
        add_released(t, s, x + c * t->all);
}

/* Computes the residuals s->rest[count] of these columns. */
static void residuals_of(const equations *eq, const node_tangent *t, const bordered *s, int count,
                         const int column[])
{
    const double *x[TANGENT_COMPONENTS];
    double *rest[TANGENT_COMPONENTS];
    memset(s->rest, 0, (size_t)(count * t->all) * sizeof *s->rest);
    for (int c = 0; c < count; c++) {
        x[c] = s->solution + column[c] * t->all;
        rest[c] = s->rest + c * t->all;
        sparse_mul(&t->geometric, x[c], rest[c]);
    }
    stiffness_parts_material_products(eq->m, &eq->run->memory, t->state, count, x, rest);
    for (int c = 0; c < count; c++)
        for (int k = 0; k < t->all; k++)
            rest[c][k] = k < t->free || border_place(&t->border, k) >= 0
                             ? s->load[column[c] * t->all + k] - rest[c][k]
                             : 0;
}

static refinement_state correct(const node_tangent *t, const bordered *s, const double change[],
                                double x[], solution_refinement *r)
{
    for (int k = 0; k < t->all; k++)
        x[k] += change[k];
    return refinement_next(r, refinement_part(t->all, s->weight, change, x, 0));
}

static status bordered_refine(const equations *eq, node_tangent *t, const bordered *s, int columns,
                              fault *f)
{
    solution_refinement r[TANGENT_COMPONENTS];
    int column[TANGENT_COMPONENTS];
    for (int c = 0; c < columns; c++) {
        r[c] = (solution_refinement){.corrections = t->condensed != NULL ? 2 : 1, .last = 1};
        column[c] = c;
    }
    metric_of(eq->m, s->weight);
    for (int count = columns, rest = 0; count > 0; count = rest) {
        residuals_of(eq, t, s, count, column);
        bordered_solve(t, s, count, s->rest);
        rest = 0;
        for (int c = 0; c < count; c++) {
            const int at = column[c];
            const refinement_state state =
                correct(t, s, s->rest + c * t->all, s->solution + at * t->all, &r[at]);
            if (state == REFINEMENT_LOST)
                return refinement_refuse(&r[at], "the compliance", f);
            if (state == REFINEMENT_GOES_ON)
                column[rest++] = at;
        }
    }
    return STATUS_OK;
}

enum { LEAST = 2, MOST = 30 };

static const double sure_digits = 1e-9, enough_digits = 1e-6;

refinement_state refinement_evaluate(solution_refinement *r, double correction)
{
    r->last = correction;
    return correction <= enough_digits ? REFINEMENT_ENDS : REFINEMENT_LOST;
}

refinement_state refinement_next(solution_refinement *r, double correction)
{
    const int step = r->corrections++, settles = !(correction < r->last / 2);
    r->last = correction;
    if (step >= LEAST && correction <= sure_digits)
        return REFINEMENT_ENDS;
    if ((step > LEAST && settles) || step == MOST)
        return refinement_evaluate(r, correction);
    return REFINEMENT_GOES_ON;
}

status refinement_refuse(const solution_refinement *r, const char *what, fault *f)
{
    const int digits = r->last < 1 ? (int)-log10(r->last) : 0; /* NAN: no digits */
    return fault_set(f, STATUS_SINGULAR,
                     "%s is lost in round-off (significant digits: %d; relative corrections stay "
                     "at %.1e); use fewer elements or a less slender structure",
                     what, digits, r->last);
}

static double size_of(int n, const double weight[], const double x[])
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += weight[i] * x[i] * x[i];
    return sqrt(sum);
}

double refinement_part(int n, const double weight[], const double change[], const double x[],
                       double least)
{
    const double size = size_of(n, weight, change);
    return size == 0 ? 0 : size / fmax(size_of(n, weight, x), least);
}
