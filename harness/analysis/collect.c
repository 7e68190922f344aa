#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/model/model.h"
#include "harness/time/time.h"

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* Returns the number of states of an analysis that are kept. most: limit for a path. */
static int count_of(const analysis_outcome *o, int most)
{
    if (o->kind == SCENE_MOTION)
        return outcome_motion_of(o)->frames.reached;
    if (outcome_has_path(o))
        return outcome_path_of(o)->state != NULL ? least(outcome_path_of(o)->reached, most) : 0;
    if (!outcome_has_spectrum(o))
        return outcome_linear_of(o)->x != NULL ? outcome_linear_of(o)->solutions : 0;
    const outcome_side *positive = &outcome_spectrum_of(o)->positive,
                       *negative = &outcome_spectrum_of(o)->negative;
    return least(positive->count, SHAPES_MODES) * (positive->mode != NULL) +
           least(negative->count, SHAPES_MODES) * (negative->mode != NULL);
}

static void keep(const analysis_context *c, shapes *s, const shape_state *what,
                 const model_state *state)
{
    s->state[s->states] = *what;
    centreline_fill(c->model, state, s->point + (size_t)s->states * (size_t)s->points);
    centreline_nodes(c->model, state, s->node + 3 * (size_t)s->states * (size_t)s->nodes);
    s->states++;
}

static void keep_path(const analysis_context *c, int analysis, int most, shapes *s)
{
    const outcome_path *o = outcome_path_of(&c->outcomes[analysis]);
    const int count = count_of(&c->outcomes[analysis], most);
    for (int i = 0; i < count; i++) {
        const int at = count > 1 ? (int)((long)i * (o->reached - 1) / (count - 1)) : o->reached - 1;
        keep(c, s, &(shape_state){SHAPE_PATH, analysis, o->value[at], 1}, o->state[at]);
    }
}

static void keep_motion(const analysis_context *c, int analysis, shapes *s)
{
    const outcome_path *o = &outcome_motion_of(&c->outcomes[analysis])->frames;
    for (int i = 0; i < o->reached; i++)
        keep(c, s, &(shape_state){SHAPE_MOTION, analysis, o->value[i], 1}, o->state[i]);
}

/* The displacement starts from the state that the analysis follows (an instant of a motion or the
 * last state of a path), or from the undeformed state. */
static status keep_displaced(const analysis_context *c, shape_state *what, const double x[],
                             const double sigma[], shapes *s, fault *f)
{
    const int follows = c->scene->analysis[what->analysis].follows;
    const outcome_path *path = follows != SCENE_NONE && outcome_has_path(&c->outcomes[follows])
                                   ? outcome_path_of(&c->outcomes[follows])
                                   : NULL;
    const double time = scene_instant_of(c->scene, what->analysis);
    const outcome_about *of_motion =
        isnan(time) ? NULL : outcome_about_at(&c->outcomes[follows], time);
    const model_state *about = of_motion != NULL ? of_motion->state
                               : path != NULL && path->reached > 0 && path->state != NULL
                                   ? path->state[path->reached - 1]
                                   : kinematics_rest(c->model);
    model_state *moved = NULL;
    const status outcome = centreline_displaced(c->model, about, x, sigma, &what->scale, &moved, f);
    if (outcome == STATUS_OK)
        keep(c, s, what, moved);
    kinematics_state_free(moved);
    return outcome;
}

static status keep_displacements(const analysis_context *c, int analysis, double sigma[], shapes *s,
                                 fault *f)
{
    const outcome_linear *l = outcome_linear_of(&c->outcomes[analysis]);
    for (int i = 0; i < l->solutions; i++) {
        const analysis_context one = context_under(c, l->acting[i]);
        const double *x = l->x + (size_t)i * l->coordinates;
        shape_state what = {SHAPE_LINEAR, analysis, l->acting[i] > 0 ? l->acting[i] : 1, 1};
        TRY(linear_whole_stresses(&one.eq, x, 1, sigma, f));
        TRY(keep_displaced(&one, &what, x, sigma, s, f));
    }
    return STATUS_OK;
}

static status keep_linear(const analysis_context *c, int analysis, shapes *s, fault *f)
{
    double *sigma = calloc((size_t)model_stresses(c->model) + 1, sizeof *sigma);
    if (sigma == NULL)
        return fault_memory(f, "the shape of a linear solution");
    const status outcome = keep_displacements(c, analysis, sigma, s, f);
    free(sigma);
    return outcome;
}

static status keep_modes_in(const analysis_context *c, int analysis, const outcome_side *side,
                            double x[], shapes *s, fault *f)
{
    const size_t n = (size_t)model_sizes(c->model).free;
    const int buckling = c->scene->analysis[analysis].kind == SCENE_BUCKLING;
    for (int i = 0; i < least(side->count, SHAPES_MODES); i++) {
        shape_state what = {buckling ? SHAPE_BUCKLING : SHAPE_MODE, analysis,
                            buckling ? side->value[i] : side->value[i] / (2 * PI), 0};
        memcpy(x, side->mode + n * (size_t)i, n * sizeof *x);
        TRY(keep_displaced(c, &what, x, NULL, s, f));
    }
    return STATUS_OK;
}

static status keep_modes(const analysis_context *c, int analysis, const outcome_side *side,
                         shapes *s, fault *f)
{
    const model_size size = model_sizes(c->model);
    if (side->mode == NULL)
        return STATUS_OK;
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    const status outcome = x != NULL ? keep_modes_in(c, analysis, side, x, s, f)
                                     : fault_memory(f, "the shape of a mode");
    free(x);
    return outcome;
}

/* Stores all shapes. After a failure, collect_shapes frees *s. */
static status keep_all(const analysis_context *c, int most, shapes *s, fault *f)
{
    TRY(shapes_alloc(s, f));
    s->states = 0;
    centreline_points(c->model, s->first);
    const analysis_context *first = c->sides != NULL ? c->sides[0] : c;
    keep(first, s, &(shape_state){SHAPE_UNDEFORMED, -1, 0, 1}, kinematics_rest(first->model));
    for (int i = 0; i < c->scene->analyses; i++) {
        const analysis_outcome *o = &c->outcomes[i];
        const analysis_context own = context_of(c, i);
        if (o->kind == SCENE_MOTION) {
            keep_motion(&own, i, s);
        } else if (outcome_has_path(o)) {
            keep_path(&own, i, most, s);
        } else if (outcome_has_spectrum(o)) {
            TRY(keep_modes(&own, i, &outcome_spectrum_of(o)->positive, s, f));
            TRY(keep_modes(&own, i, &outcome_spectrum_of(o)->negative, s, f));
        } else if (count_of(o, most) > 0) {
            TRY(keep_linear(&own, i, s, f));
        }
    }
    return STATUS_OK;
}

status collect_shapes(const analysis_context *c, int most, shapes *s, fault *f)
{
    memset(s, 0, sizeof *s);
    s->members = c->scene->members;
    s->nodes = c->scene->nodes;
    s->points = centreline_points(c->model, NULL);
    s->states = 1;
    for (int i = 0; i < c->scene->analyses; i++)
        s->states += count_of(&c->outcomes[i], most);
    const status outcome = keep_all(c, most, s, f);
    if (outcome != STATUS_OK)
        shapes_free(s);
    return outcome;
}

typedef struct workspace {
    sparse K, M, G,
        C; /* matrices of the states, with the driven coordinates if linear models are requested */
    int models, free, all;
    double *residual, *load; /* [free + driven] */
    double *sigma;           /* [stresses] */
    double *input;           /* [loads x free] */
    model_state *state;
} workspace;

static status workspace_alloc(const analysis_context *c, workspace *w, fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t free_count = (size_t)size.free, all = free_count + (size_t)size.driven + 1;
    const sparse *pattern;
    memset(w, 0, sizeof *w);
    w->models = c->options->systems > 1;
    w->free = size.free;
    w->all = size.free + size.driven;
    w->residual = calloc(2 * all, sizeof *w->residual);
    w->sigma = calloc((size_t)model_stresses(c->model) + 1, sizeof *w->sigma);
    w->input = calloc((size_t)c->scene->loads * free_count + 1, sizeof *w->input);
    if (w->residual == NULL || w->sigma == NULL || w->input == NULL)
        return fault_memory(f, "matrices of states");
    w->load = w->residual + all;
    TRY(assemble_pattern_of_states(c->model, c->run->patterns, w->models, &pattern, f));
    TRY(sparse_alloc_like(pattern, &w->K, f));
    TRY(sparse_alloc_like(pattern, &w->M, f));
    TRY(sparse_alloc_like(pattern, &w->G, f));
    TRY(sparse_alloc_like(pattern, &w->C, f));
    return kinematics_state_alloc(c->model, &w->state, f);
}

static void workspace_free(workspace *w)
{
    sparse_free_values(&w->K);
    sparse_free_values(&w->M);
    sparse_free_values(&w->G);
    sparse_free_values(&w->C);
    free(w->residual);
    free(w->sigma);
    free(w->input);
    kinematics_state_free(w->state);
}

static status next(system_matrices *s, state_matrices **out, fault *f)
{
    if (s->states == s->room) {
        const int room = 2 * s->room + 8;
        state_matrices *more = realloc(s->state, (size_t)room * sizeof *more);
        if (more == NULL)
            return fault_memory(f, "matrices of states");
        s->state = more;
        s->room = room;
    }
    *out = &s->state[s->states++];
    **out = (state_matrices){.analysis = SCENE_NONE, .station = SCENE_NONE};
    return STATUS_OK;
}

static status inputs(const analysis_context *c, const model_state *state, workspace *w,
                     triplets *out, fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t n = (size_t)size.free;
    for (int i = 0; i < c->scene->loads; i++) {
        memset(w->load, 0, (n + (size_t)size.driven) * sizeof *w->load);
        loads_add_one(&c->eq, state, &c->scene->load[i], 1, w->load);
        loads_add_temperature(&c->eq, state, &c->scene->load[i], 1, w->load);
        memcpy(w->input + (size_t)i * n, w->load, n * sizeof *w->input);
    }
    return triplets_of_columns(size.free, c->scene->loads, w->input, out, f);
}

static status keep_block(const workspace *w, const sparse *a, int skew, triplets *out, fault *f)
{
    TRY(triplets_of(a, skew, out, f));
    triplets_lead(out, w->free);
    return STATUS_OK;
}

static status keep_model(const analysis_context *c, const model_state *state, const workspace *w,
                         const system_matrices *s, state_matrices *out, fault *f)
{
    analysis_context own = *c;
    const vibration v = {.c = &own,
                         .analysis = out->analysis,
                         .free = w->free,
                         .all = w->all,
                         .state = state,
                         .K = w->K,
                         .M = w->M,
                         .C = w->C,
                         .damped = damping_acts(c->model)};
    return w->models ? second_order_keep(&v, out->turns ? &w->G : NULL, s, out, f) : STATUS_OK;
}

/* Stores K, which the caller has computed, and B. If the model has inertia, also stores M, C if
 * there is damping, and G if the axes rotate. */
static status systems_keep(const analysis_context *c, const model_state *state, double path,
                           workspace *w, const system_matrices *s, state_matrices *out, fault *f)
{
    out->path = path;
    TRY(keep_block(w, &w->K, 0, &out->K, f));
    TRY(inputs(c, state, w, &out->B, f));
    if (!(model_sizes(c->model).features & FEATURE_MASS))
        return STATUS_OK;
    TRY(rotating_frame_inertia(&c->eq, state, path, &w->M, out->turns ? &w->G : NULL, f));
    TRY(keep_block(w, &w->M, 0, &out->M, f));
    if (damping_acts(c->model)) {
        TRY(damping_matrix(&c->eq, state, 0, &w->C, f));
        TRY(keep_block(w, &w->C, 0, &out->C, f));
    }
    if (out->turns)
        TRY(keep_block(w, &w->G, 1, &out->G, f));
    return keep_model(c, state, w, s, out, f);
}

/* Stores the matrices of the undeformed structure. displaced: displacements of the linear solution
 * that cause the stresses, under the loads at `path`; NULL: there are no stresses. */
static status systems_keep_linear(const analysis_context *c, int analysis, const double displaced[],
                                  double path, workspace *w, system_matrices *s, fault *f)
{
    state_matrices *out = NULL;
    TRY(next(s, &out, f));
    out->analysis = analysis;
    TRY(linear_stiffness(&c->eq, &w->K, f));
    if (displaced != NULL) {
        TRY(linear_whole_stresses(&c->eq, displaced, path, w->sigma, f));
        TRY(linear_geometric_stiffness(&c->eq, w->sigma, path, &w->G, f));
        for (int i = 0; i < w->K.column[w->K.n]; i++)
            w->K.value[i] += w->G.value[i];
    }
    TRY(systems_keep(c, kinematics_rest(c->model), 0, w, s, out, f));
    return displaced == NULL && rotating_frame_inner_matrix(&c->eq, &w->G)
               ? keep_block(w, &w->G, 0, &out->inside, f)
               : STATUS_OK;
}

static status keep_state(const analysis_context *c, int analysis, int station,
                         const model_state *state, workspace *w, system_matrices *s, fault *f)
{
    state_matrices *out = NULL;
    const double path = kinematics_state_path(state);
    model_linearisation lin = {.path = path, .K = &w->K, .residual = w->residual};
    TRY(next(s, &out, f));
    out->analysis = analysis;
    out->station = station;
    out->turns = scene_rotates(&c->scene->analysis[analysis]);
    kinematics_state_copy(c->model, state, w->state);
    if (c->options->newton == NEWTON_DISPLACEMENT)
        TRY(linearise_make_compatible(&c->eq, w->state, f));
    TRY(linearise_state(&c->eq, &c->run->memory, w->state, &lin, f));
    return systems_keep(c, w->state, path, w, s, out, f);
}

static status systems_keep_path(const analysis_context *c, int analysis, workspace *w,
                                system_matrices *s, fault *f)
{
    const outcome_path *path = outcome_path_of(&c->outcomes[analysis]);
    const scene_analysis_kind kind = c->scene->analysis[analysis].kind;
    if (kind == SCENE_COMPLIANCE || kind == SCENE_MOTION)
        return STATUS_OK;
    for (int i = 0; i < path->reached; i++)
        TRY(keep_state(c, analysis, i, path->state[i], w, s, f));
    return STATUS_OK;
}

static status keep_unloaded(const analysis_context *c, int analysis, workspace *w,
                            system_matrices *s, fault *f)
{
    const analysis_context unloaded = context_unloaded(c);
    const double *strained = outcome_spectrum_of(&c->outcomes[analysis])->strained;
    return systems_keep_linear(&unloaded, analysis, strained, 0, w, s, f);
}

static status keep_about(const analysis_context *c, int analysis, workspace *w, system_matrices *s,
                         fault *f)
{
    const int follows = c->scene->analysis[analysis].follows;
    if (follows == SCENE_NONE)
        return keep_unloaded(c, analysis, w, s, f);
    if (c->scene->analysis[follows].kind == SCENE_LINEAR)
        return systems_keep_linear(
            c, analysis, outcome_displacements(&c->outcomes[follows], c->eq.loading.acting), 1, w,
            s, f);
    const outcome_path *path = outcome_path_of(&c->outcomes[follows]);
    return keep_state(c, analysis, SCENE_NONE, path->state[path->reached - 1], w, s, f);
}

/* Stores the matrices about a state during a motion. C is the damping matrix, and G contains the
 * other effects of the rates. */
static status keep_instant(const analysis_context *c, int analysis, workspace *w,
                           system_matrices *s, fault *f)
{
    const scene_analysis *motion = &c->scene->analysis[c->scene->analysis[analysis].follows];
    analysis_context own = *c;
    vibration v = {0};
    state_matrices *out = NULL;
    const outcome_about *about = outcome_about_at(
        &c->outcomes[c->scene->analysis[analysis].follows], scene_instant_of(c->scene, analysis));
    TRY(next(s, &out, f));
    out->analysis = analysis;
    out->path = about->time;
    out->turns = 1;
    status outcome = harmonic_system(&own, analysis, &v, f);
    if (outcome == STATUS_OK)
        outcome = keep_block(w, &v.K, 0, &out->K, f);
    if (outcome == STATUS_OK)
        outcome = keep_block(w, &about->M, 0, &out->M, f);
    if (outcome == STATUS_OK && (damping_acts(c->model) || motion->damping.mass > 0))
        outcome = keep_block(w, &about->C, 0, &out->C, f);
    if (outcome == STATUS_OK) {
        for (int i = 0; i < v.B.column[v.B.n]; i++)
            v.B.value[i] = v.C.value[i] - about->C.value[i];
        outcome = keep_block(w, &v.B, 0, &out->G, f);
        sparse_zero(&v.B);
    }
    if (outcome == STATUS_OK)
        outcome = inputs(c, about->state, w, &out->B, f);
    if (outcome == STATUS_OK && w->models)
        outcome = second_order_keep(&v, NULL, s, out, f);
    harmonic_release(&v);
    return outcome;
}

static status keep_modal(const analysis_context *c, int analysis, workspace *w, system_matrices *s,
                         fault *f)
{
    if (c->outcomes[analysis].status != STATUS_OK)
        return STATUS_OK;
    TRY(isnan(scene_instant_of(c->scene, analysis)) ? keep_about(c, analysis, w, s, f)
                                                    : keep_instant(c, analysis, w, s, f));
    const outcome_side *found = &outcome_spectrum_of(&c->outcomes[analysis])->positive;
    state_matrices *out = &s->state[s->states - 1];
    const size_t count = (size_t)found->count, rows = (size_t)s->rows;
    out->frequency = malloc((count + 1) * sizeof *out->frequency);
    out->mode = malloc((count * rows + 1) * sizeof *out->mode);
    if (out->frequency == NULL || out->mode == NULL)
        return fault_memory(f, "matrices of states");
    out->modes = found->count;
    if (count > 0) {
        memcpy(out->frequency, found->value, count * sizeof *out->frequency);
        memcpy(out->mode, found->mode, count * rows * sizeof *out->mode);
    }
    return STATUS_OK;
}

static status keep_harmonic(analysis_context *c, int analysis, const workspace *w,
                            system_matrices *s, fault *f)
{
    vibration v = {0};
    state_matrices *out = NULL;
    if (!w->models || c->outcomes[analysis].status != STATUS_OK)
        return STATUS_OK;
    TRY(next(s, &out, f));
    out->analysis = analysis;
    status outcome = harmonic_system(c, analysis, &v, f);
    if (outcome == STATUS_OK) {
        out->path = kinematics_state_path(v.state);
        outcome = second_order_keep(&v, NULL, s, out, f);
    }
    if (outcome == STATUS_OK && v.inside)
        outcome = harmonic_inside(c, analysis, &out->model.apart, &out->model.farthest, f);
    harmonic_release(&v);
    return outcome;
}

static status collect(const analysis_context *c, workspace *w, system_matrices *s, fault *f)
{
    if (c->sides != NULL)
        c = c->sides[0];
    TRY(workspace_alloc(c, w, f));
    const analysis_context rest = {.scene = c->scene,
                                   .model = c->model,
                                   .run = c->run,
                                   .eq = {.m = c->model, .run = c->run},
                                   .options = c->options,
                                   .result = c->result,
                                   .outcomes = c->outcomes,
                                   .work = c->work};
    TRY(systems_keep_linear(&rest, SCENE_NONE, NULL, 0, w, s, f));
    for (int i = 0; i < c->scene->analyses; i++) {
        if (!context_runs(c, i))
            continue;
        analysis_context own = context_of(c, i);
        if (c->scene->analysis[i].kind == SCENE_HARMONIC)
            TRY(keep_harmonic(&own, i, w, s, f));
        else if (outcome_has_path(&c->outcomes[i]))
            TRY(systems_keep_path(&own, i, w, s, f));
        else if (c->scene->analysis[i].kind == SCENE_MODAL)
            TRY(keep_modal(&own, i, w, s, f));
    }
    return STATUS_OK;
}

status collect_systems(const analysis_context *c, system_matrices *s, fault *f)
{
    workspace w;
    memset(s, 0, sizeof *s);
    s->rows = model_sizes(c->model).free;
    s->label = calloc((size_t)s->rows + 1, sizeof *s->label);
    if (s->label == NULL)
        return fault_memory(f, "matrices of states");
    rows_label(c->model, s->label);
    memset(&w, 0, sizeof w);
    status outcome = c->options->systems > 1 ? second_order_list(c->scene, s, f) : STATUS_OK;
    if (outcome == STATUS_OK)
        outcome = collect(c, &w, s, f);
    workspace_free(&w);
    if (outcome != STATUS_OK)
        system_matrices_free(s);
    return outcome;
}
