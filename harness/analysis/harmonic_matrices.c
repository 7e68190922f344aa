/* Steady-state vibration about a state, with one solution for each frequency. The dynamic stiffness
 * is D(w) = K + i w C - w^2 M - (w^2 - i a w)^2/(1 + i b w) B. C contains the proportional damping
 * a M + b K. B is the inertia of the motions inside elements in an unstressed structure
 * (field/field.h). The real form is [Re D, -Im D; Im D, Re D] [Re x; Im x] = [Re f; Im f]. Damped
 * modes are the eigenvectors of D at s = i w. */
#include "harness/analysis/analysis_impl.h"

#include <complex.h>
#include <stdlib.h>

#include "harness/model/model.h"
#include "harness/time/time.h"

static status no_memory(fault *f)
{
    return fault_memory(f, "a harmonic analysis");
}

double complex harmonic_dynamic(const vibration *v, double w, int k)
{
    double complex D = v->K.value[k] - w * w * v->M.value[k];
    if (v->inside) {
        const scene_proportional *damping = &v->c->scene->analysis[v->analysis].damping;
        const double complex moves = w * (w - I * damping->mass);
        D -= moves * moves / (1 + I * w * damping->stiffness) * v->B.value[k];
    }
    return v->damped ? D + I * w * v->C.value[k] : D;
}

/* Computes K of the undeformed structure, and B if there are no stresses. displaced: displacements
 * of a linear solution, whose stresses K includes; NULL: none. */
static status linear_system_of(vibration *v, const double displaced[], fault *f)
{
    const equations *eq = &v->c->eq;
    TRY(linear_stiffness(eq, &v->K, f));
    if (displaced == NULL) {
        v->inside = !v->plain && rotating_frame_inner_matrix(eq, &v->B);
        return STATUS_OK;
    }
    TRY(linear_whole_stresses(eq, displaced, 1, v->room, f));
    TRY(linear_geometric_stiffness(eq, v->room, 1, &v->C, f));
    for (int i = 0; i < v->K.column[v->K.n]; i++)
        v->K.value[i] += v->C.value[i];
    return STATUS_OK;
}

/* Computes K at the end of the static path. REFUSED: this state is not available or is unstable. */
static status tangent_of(vibration *v, const analysis_outcome *o, fault *f)
{
    analysis_context *c = v->c;
    const outcome_path *path = outcome_path_of(o);
    if (path->stations == 0 || path->reached < path->stations)
        return fault_set(f, o->status != STATUS_OK ? o->status : STATUS_REFUSED,
                         "the base state was not reached: %.150s", o->reason);
    v->state = path->state[path->reached - 1];
    const double at = kinematics_state_path(v->state);
    const step_stability stands =
        history_stability_at(c->result, c->scene->analysis[v->analysis].follows, at);
    if ((stands == STEP_UNSTABLE && !v->rotates) || stands == STEP_GROWS)
        return fault_set(f, STATUS_REFUSED,
                         "the state at path %g is unstable, so there are no steady vibrations "
                         "about it; end the path before this state",
                         at);
    model_linearisation lin = {.path = at, .K = &v->K, .residual = v->room};
    return linearise_state(&c->eq, &c->run->memory, v->state, &lin, f);
}

/* Computes K, and C with all effects of rates, about a state during a motion, for all
 * coordinates. */
static status small_motions(const vibration *v, sparse *K, sparse *C, sparse *G, fault *f)
{
    const outcome_about *about = v->about;
    const scene_analysis *a = &v->c->scene->analysis[v->analysis];
    sparse_copy_leading(&about->K, K);
    sparse_copy_leading(&about->G, G);
    if (a->axes == SCENE_TURNING_OWN || a->axes_of != SCENE_NONE)
        TRY(about_turning(v->c->model, about, a->axes_of, K, G, C, f));
    for (int i = 0; i < C->column[C->n]; i++)
        C->value[i] = about->C.value[i] + G->value[i];
    return STATUS_OK;
}

static status instant_of(vibration *v, int whole, const analysis_outcome *o, fault *f)
{
    analysis_context *c = v->c;
    const sparse *pattern;
    sparse all[3] = {{0}};
    const double time = scene_instant_of(c->scene, v->analysis);
    v->about = outcome_about_at(o, time);
    if (v->about == NULL)
        return fault_set(f, o->status != STATUS_OK ? o->status : STATUS_REFUSED,
                         "the motion did not reach %g s: %.150s", time, o->reason);
    TRY(assemble_pattern_whole(c->model, c->run->patterns, whole, &pattern, f));
    TRY(sparse_alloc_like(pattern, &v->K, f));
    TRY(sparse_alloc_like(pattern, &v->M, f));
    TRY(sparse_alloc_like(pattern, &v->C, f));
    TRY(sparse_alloc_like(pattern, &v->B, f));
    status outcome = STATUS_OK;
    for (int i = 0; i < 3 && outcome == STATUS_OK; i++)
        outcome = sparse_alloc_like(&v->about->K, &all[i], f);
    if (outcome == STATUS_OK)
        outcome = small_motions(v, &all[0], &all[1], &all[2], f);
    if (outcome == STATUS_OK) {
        sparse_copy_leading(&all[0], &v->K);
        sparse_copy_leading(&all[1], &v->C);
        sparse_copy_leading(&v->about->M, &v->M);
    }
    for (int i = 0; i < 3; i++)
        sparse_free_values(&all[i]);
    v->damped = 1;
    v->state = v->about->state;
    return outcome;
}

static status damping_of(vibration *v, fault *f)
{
    analysis_context *c = v->c;
    const scene_proportional *damping = &c->scene->analysis[v->analysis].damping;
    v->damped = damping_acts(c->model) || damping->mass > 0 || damping->stiffness > 0;
    if (!v->damped) {
        sparse_zero(&v->C);
        return STATUS_OK;
    }
    TRY(damping_matrix(&c->eq, v->state, damping->stiffness, &v->C, f));
    for (int i = 0; i < v->C.column[v->C.n]; i++)
        v->C.value[i] += damping->mass * v->M.value[i];
    return STATUS_OK;
}

status harmonic_matrices(vibration *v, int whole, fault *f)
{
    analysis_context *c = v->c;
    const int follows = c->scene->analysis[v->analysis].follows;
    const sparse *pattern;
    if (follows != SCENE_NONE && c->scene->analysis[follows].kind == SCENE_MOTION)
        return instant_of(v, whole, &c->outcomes[follows], f);
    v->rotates = follows != SCENE_NONE && scene_rotates(&c->scene->analysis[follows]);
    TRY(v->rotates ? assemble_pattern_whole(c->model, c->run->patterns, whole, &pattern, f)
        : follows != SCENE_NONE
            ? assemble_pattern_of_states(c->model, c->run->patterns, whole, &pattern, f)
            : assemble_pattern_at_rest(c->model, c->run->patterns, 1, whole, &pattern, f));
    TRY(sparse_alloc_like(pattern, &v->K, f));
    TRY(sparse_alloc_like(pattern, &v->M, f));
    TRY(sparse_alloc_like(pattern, &v->C, f));
    TRY(sparse_alloc_like(pattern, &v->B, f));
    if (follows == SCENE_NONE) {
        if (linear_initial(c->model) > 0)
            return fault_set(f, STATUS_REFUSED,
                             "members have initial strains, whose stresses are absent in the "
                             "undeformed state; name a static analysis with 'about'");
        TRY(linear_system_of(v, NULL, f));
    } else if (c->scene->analysis[follows].kind == SCENE_LINEAR) {
        const analysis_outcome *o = &c->outcomes[follows];
        TRY(linear_system_of(v, outcome_displacements(o, c->eq.loading.acting), f));
    } else {
        TRY(tangent_of(v, &c->outcomes[follows], f));
    }
    sparse *G = v->rotates ? &v->B : NULL;
    TRY(rotating_frame_inertia(&c->eq, v->state, kinematics_state_path(v->state), &v->M, G, f));
    TRY(damping_of(v, f));
    for (int i = 0; i < v->C.column[v->C.n] && v->rotates; i++)
        v->C.value[i] += v->B.value[i];
    v->damped |= v->rotates;
    return STATUS_OK;
}

static void append(vibration *v, int column, int row, int source)
{
    const int at = v->first[column + 1]++;
    if (v->row == NULL)
        return;
    v->row[at] = row;
    v->source[at] = source;
}

/* Lists the entries of the free block, including both halves of a symmetric matrix. While v->row is
 * NULL, only counts the entries of column j in first[j + 1]. */
static void unfold(vibration *v)
{
    for (int j = 0; j < v->free; j++)
        for (int k = v->K.column[j]; k < v->K.column[j + 1]; k++) {
            const int i = v->K.row[k];
            if (i >= v->free)
                continue;
            append(v, j, i, k);
            if (v->K.symmetric && i != j)
                append(v, i, j, k);
        }
}

int harmonic_border(const vibration *v)
{
    const double *U;
    return v->c->scene->analysis[v->analysis].by_modes ? 0 : harmonic_modes_damped(v->modes, &U);
}

/* Appends the entries of the loops in column j of one half: gain S^T x + own u = 0, and -P u.
 * Returns the new number of entries. */
static int loops_column(const vibration *v, int j, double w, int count, int row[],
                        double complex z[])
{
    const int n = v->free, first = n + harmonic_border(v);
    for (int l = 0; l < v->loops; l++) {
        const control_loop *loop = &v->loop[l];
        double complex own;
        const double complex gain = loops_gain(loop, w, &own);
        if (j < n && loop->measured[j] != 0) {
            row[count] = first + l;
            z[count++] = gain * loop->measured[j];
        }
        for (int i = 0; i < n && j == first + l; i++)
            if (loop->push[i] != 0) {
                row[count] = i;
                z[count++] = -loop->push[i];
            }
        if (j == first + l) {
            row[count] = j;
            z[count++] = own;
        }
    }
    return count;
}

/* Sets the entries of column j of one half: their rows, and their values at w. Returns their
 * number. */
static int column_of(const vibration *v, int j, double w, int row[], double complex z[])
{
    const int n = v->free, more = harmonic_border(v);
    const double *U;
    int count = 0;
    harmonic_modes_damped(v->modes, &U);
    for (int k = j < n ? v->first[j] : 0; j < n && k < v->first[j + 1]; k++) {
        row[count] = v->row[k];
        z[count++] = harmonic_dynamic(v, w, v->source[k]);
    }
    for (int i = 0; j < n && i < more; i++) {
        row[count] = n + i;
        z[count++] = I * w * U[(size_t)i * (size_t)n + (size_t)j];
    }
    for (int i = 0; j >= n && j < n + more && i < n; i++) {
        row[count] = i;
        z[count++] = U[(size_t)(j - n) * (size_t)n + (size_t)i];
    }
    if (j >= n && j < n + more) {
        row[count] = j;
        z[count++] = -1;
    }
    return loops_column(v, j, w, count, row, z);
}

/* Fills D at the frequency w, including its pattern. */
static void fill(vibration *v, double w)
{
    const int n = v->free + harmonic_border(v) + v->loops;
    int at = 0;
    for (int j = 0; j < 2 * n; j++) {
        const int imaginary = j >= n, count = column_of(v, j % n, w, v->rows, v->column);
        v->D.column[j] = at;
        for (int half = 0; half < 2; half++)
            for (int k = 0; k < count; k++) {
                const double complex z = v->column[k];
                v->D.row[at] = half * n + v->rows[k];
                v->D.value[at++] = half == imaginary ? creal(z) : half ? cimag(z) : -cimag(z);
            }
    }
    v->D.column[2 * n] = at;
}

status harmonic_pattern(vibration *v, fault *f)
{
    const int n = v->free;
    v->first = calloc((size_t)n + 2, sizeof *v->first);
    if (v->first == NULL)
        return no_memory(f);
    unfold(v);
    int entries = 0;
    for (int j = 0; j < n; j++) {
        const int count = v->first[j + 1];
        v->first[j + 1] = entries;
        entries += count;
    }
    v->row = calloc((size_t)entries + 1, sizeof *v->row);
    v->source = calloc((size_t)entries + 1, sizeof *v->source);
    if (v->row == NULL || v->source == NULL)
        return no_memory(f);
    unfold(v);
    return STATUS_OK;
}

status harmonic_matrix(vibration *v, fault *f)
{
    const int more = harmonic_border(v) + v->loops, n = v->free + more;
    const size_t entries =
        (size_t)v->first[v->free] + 2 * (size_t)more * (size_t)v->free + (size_t)more;
    v->D = (sparse){.n = 2 * n,
                    .column = calloc(2 * (size_t)n + 1, sizeof(int)),
                    .row = calloc(4 * entries + 1, sizeof(int)),
                    .value = calloc(4 * entries + 1, sizeof(double))};
    v->rows = calloc((size_t)n + 1, sizeof *v->rows);
    v->column = calloc((size_t)n + 1, sizeof *v->column);
    if (v->D.column == NULL || v->D.row == NULL || v->D.value == NULL || v->rows == NULL ||
        v->column == NULL)
        return no_memory(f);
    fill(v, 0);
    return factor_alloc(&v->D, &v->factor, f);
}

status harmonic_factor(vibration *v, double w, fault *f)
{
    fill(v, w);
    v->c->run->counters.factorisations++;
    return factor_numeric(v->factor, &v->D, f);
}

void harmonic_release(vibration *v)
{
    factor_free(v->factor);
    sparse_free_values(&v->K);
    sparse_free_values(&v->M);
    sparse_free_values(&v->C);
    sparse_free_values(&v->B);
    free(v->D.column);
    free(v->D.row);
    free(v->D.value);
    free(v->first);
    free(v->row);
    free(v->source);
    free(v->rows);
    free(v->column);
    free(v->x);
    free(v->found);
    free(v->left);
    free(v->output);
    free(v->dual);
    free(v->room);
    loops_free(v);
    harmonic_modes_free(v->modes);
}

status harmonic_begin(vibration *v, fault *f)
{
    const model_size size = model_sizes(v->c->model);
    v->free = size.free;
    v->all = size.free + size.driven;
    v->state = kinematics_rest(v->c->model);
    v->room = calloc((size_t)model_stresses(v->c->model) + (size_t)v->all + 1, sizeof *v->room);
    if (v->room == NULL)
        return no_memory(f);
    TRY(harmonic_matrices(v, 1, f));
    return loops_find(v, f);
}

status harmonic_system(analysis_context *c, int analysis, vibration *out, fault *f)
{
    *out = (vibration){.c = c, .analysis = analysis};
    TRY(harmonic_begin(out, f));
    return scene_has_ratios(&c->scene->analysis[analysis]) ? harmonic_modes_find(out, f)
                                                           : STATUS_OK;
}
