#include "harness/analysis/collect_systems.h"

#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/newton.h"

/* What all states share. */
typedef struct workspace {
    sparse K, M, G;
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
    w->residual = calloc(2 * all, sizeof *w->residual);
    w->sigma = calloc((size_t)model_stresses(c->model) + 1, sizeof *w->sigma);
    w->input = calloc((size_t)c->scene->loads * free_count + 1, sizeof *w->input);
    if (w->residual == NULL || w->sigma == NULL || w->input == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for matrices of states");
    w->load = w->residual + all;
    TRY(assemble_pattern_of_states(c->model, c->run->patterns, 0, &pattern, f));
    TRY(sparse_alloc_like(pattern, &w->K, f));
    TRY(sparse_alloc_like(pattern, &w->M, f));
    TRY(sparse_alloc_like(pattern, &w->G, f));
    return kinematics_state_alloc(c->model, &w->state, f);
}

static void workspace_free(workspace *w)
{
    sparse_free_values(&w->K);
    sparse_free_values(&w->M);
    sparse_free_values(&w->G);
    free(w->residual);
    free(w->sigma);
    free(w->input);
    kinematics_state_free(w->state);
}

/* The next entry, which system_matrices_free frees whatever becomes of it. */
static status next(system_matrices *s, state_matrices **out, fault *f)
{
    if (s->states == s->room) {
        const int room = 2 * s->room + 8;
        state_matrices *more = realloc(s->state, (size_t)room * sizeof *more);
        if (more == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for matrices of states");
        s->state = more;
        s->room = room;
    }
    *out = &s->state[s->states++];
    **out = (state_matrices){.analysis = SCENE_NONE, .station = SCENE_NONE};
    return STATUS_OK;
}

/* B: each load at factor 1, as it acts in the state. */
static status inputs(const analysis_context *c, const model_state *state, workspace *w,
                     triplets *out, fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t n = (size_t)size.free;
    for (int i = 0; i < c->scene->loads; i++) {
        memset(w->load, 0, (n + (size_t)size.driven) * sizeof *w->load);
        loads_add_one(&c->eq, state, &c->scene->load[i], 1, w->load);
        memcpy(w->input + (size_t)i * n, w->load, n * sizeof *w->input);
    }
    return triplets_of_columns(size.free, c->scene->loads, w->input, out, f);
}

/* With K known: B, and of a formulation with inertia M, and G where the axes turn. */
static status systems_keep(const analysis_context *c, const model_state *state, double path,
                           workspace *w, state_matrices *out, fault *f)
{
    out->path = path;
    TRY(triplets_of(&w->K, 0, &out->K, f));
    TRY(inputs(c, state, w, &out->B, f));
    if (!(model_sizes(c->model).features & FEATURE_MASS))
        return STATUS_OK;
    TRY(rotating_frame_inertia(&c->eq, state, path, &w->M, out->turns ? &w->G : NULL, f));
    TRY(triplets_of(&w->M, 0, &out->M, f));
    return out->turns ? triplets_of(&w->G, 1, &out->G, f) : STATUS_OK;
}

/* Of the undeformed structure; displaced: those of a linear solution whose stresses count, under
 * the loads at `path`, NULL: there are none. */
static status systems_keep_linear(const analysis_context *c, int analysis, const double displaced[],
                                  double path, workspace *w, system_matrices *s, fault *f)
{
    state_matrices *out = NULL;
    TRY(next(s, &out, f));
    out->analysis = analysis;
    TRY(linear_stiffness(&c->eq, &w->K, f));
    if (displaced != NULL) {
        TRY(linear_whole_stresses(&c->eq, displaced, w->sigma, f));
        TRY(linear_geometric_stiffness(&c->eq, w->sigma, path, &w->G, f));
        for (int i = 0; i < w->K.column[w->K.n]; i++)
            w->K.value[i] += w->G.value[i];
    }
    TRY(systems_keep(c, kinematics_rest(c->model), 0, w, out, f));
    return displaced == NULL && rotating_frame_inner_matrix(&c->eq, &w->G)
               ? triplets_of(&w->G, 0, &out->inside, f)
               : STATUS_OK;
}

/* The tangent of a state of a path, in the axes of the analysis. */
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
    return systems_keep(c, w->state, path, w, out, f);
}

static status systems_keep_path(const analysis_context *c, int analysis, workspace *w,
                                system_matrices *s, fault *f)
{
    const outcome_path *path = outcome_path_of(&c->outcomes[analysis]);
    const scene_analysis_kind kind = c->scene->analysis[analysis].kind;
    if (kind == SCENE_COMPLIANCE || kind == SCENE_MOTION) /* about those of another; no balance */
        return STATUS_OK;
    for (int i = 0; i < path->reached; i++)
        TRY(keep_state(c, analysis, i, path->state[i], w, s, f));
    return STATUS_OK;
}

/* Without loads; strains that members have by themselves remain. */
static status keep_unloaded(const analysis_context *c, int analysis, workspace *w,
                            system_matrices *s, fault *f)
{
    const analysis_context unloaded = context_unloaded(c);
    const double *strained = outcome_spectrum_of(&c->outcomes[analysis])->strained;
    return systems_keep_linear(&unloaded, analysis, strained, 0, w, s, f);
}

/* About what the modal analysis follows. */
static status keep_about(const analysis_context *c, int analysis, workspace *w, system_matrices *s,
                         fault *f)
{
    const int follows = c->scene->analysis[analysis].follows;
    if (follows == SCENE_NONE)
        return keep_unloaded(c, analysis, w, s, f);
    if (c->scene->analysis[follows].kind == SCENE_LINEAR)
        return systems_keep_linear(c, analysis, outcome_displacements(&c->outcomes[follows]), 1, w,
                                   s, f);
    const outcome_path *path = outcome_path_of(&c->outcomes[follows]);
    return keep_state(c, analysis, SCENE_NONE, path->state[path->reached - 1], w, s, f);
}

/* With its modes; nothing where it failed. */
static status keep_modal(const analysis_context *c, int analysis, workspace *w, system_matrices *s,
                         fault *f)
{
    if (c->outcomes[analysis].status != STATUS_OK)
        return STATUS_OK;
    TRY(keep_about(c, analysis, w, s, f));
    const outcome_side *found = &outcome_spectrum_of(&c->outcomes[analysis])->positive;
    state_matrices *out = &s->state[s->states - 1];
    const size_t count = (size_t)found->count, rows = (size_t)s->rows;
    out->frequency = malloc((count + 1) * sizeof *out->frequency);
    out->mode = malloc((count * rows + 1) * sizeof *out->mode);
    if (out->frequency == NULL || out->mode == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for matrices of states");
    out->modes = found->count;
    if (count > 0) {
        memcpy(out->frequency, found->value, count * sizeof *out->frequency);
        memcpy(out->mode, found->mode, count * rows * sizeof *out->mode);
    }
    return STATUS_OK;
}

static status collect(const analysis_context *c, workspace *w, system_matrices *s, fault *f)
{
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
        const analysis_context own = context_of(c, i);
        if (outcome_has_path(&c->outcomes[i]))
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
        return fault_set(f, STATUS_FAULT, "out of memory for matrices of states");
    rows_label(c->model, s->label);
    const status outcome = collect(c, &w, s, f);
    workspace_free(&w);
    if (outcome != STATUS_OK)
        system_matrices_free(s);
    return outcome;
}
