/* Stationary rotation: equilibrium in a rotating frame at increasing angular velocity, and small
 * motions about this equilibrium with the gyroscopic, centrifugal and geometric terms (J Eq. 76: K0
 * + N0 + G0). */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"

/* number of additional modes, because modes of other families may lie between the requested
 * modes */
enum { OTHERS = 2 };

/* The tangent in two parts: the matrix of the geometric part, and the data of the last
 * linearisation, from which the material part follows. */
typedef struct tangent_parts {
    const model *m;
    const linear_memory *memory;
    const model_state *state;
    const sparse *geometric;
    double *x, *y; /* [free + driven] vectors in which prescribed coordinates are zero */
    int free_count, all;
} tangent_parts;

static void tangent_product(void *context, const double mode[], double product[])
{
    const tangent_parts *t = context;
    const size_t size = (size_t)t->free_count * sizeof *mode;
    memcpy(t->x, mode, size);
    memset(t->y, 0, (size_t)t->all * sizeof *t->y);
    sparse_mul(t->geometric, t->x, t->y);
    stiffness_parts_material_products(t->m, t->memory, t->state, 1, (const double *const[]){t->x},
                                      (double *const[]){t->y});
    memcpy(product, t->y, size);
}

static double tangent_rounding(void *context, const double mode[])
{
    const tangent_parts *t = context;
    memcpy(t->x, mode, (size_t)t->free_count * sizeof *mode);
    return stiffness_parts_material_rounding(t->m, t->memory, t->state, t->x) +
           sparse_rounding(t->geometric, mode, mode);
}

typedef struct matrices {
    sparse K, M, G, geometric; /* the geometric part of K */
    matrix_factor *factor;
    double *residual, *x, *y; /* [free + driven] */
} matrices;

static status allocate(const analysis_context *c, matrices *a, fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t all = (size_t)(size.free + size.driven) + 1;
    sparse *const each[] = {&a->K, &a->M, &a->G, &a->geometric};
    const sparse *pattern = NULL;
    a->residual = calloc(all, sizeof(double));
    a->x = calloc(all, sizeof(double));
    a->y = calloc(all, sizeof(double));
    if (a->residual == NULL || a->x == NULL || a->y == NULL)
        return fault_memory(f, "modes");
    TRY(assemble_pattern_of_states(c->model, c->run->patterns, 0, &pattern, f));
    for (int i = 0; i < 4; i++)
        TRY(sparse_alloc_like(pattern, each[i], f));
    return assemble_factor(c->run->patterns, pattern, &a->factor, f);
}

static status matrices_alloc(analysis_context *c, matrices *a, fault *f)
{
    const double begin = clock_processor_seconds();
    memset(a, 0, sizeof *a);
    const status outcome = allocate(c, a, f);
    c->work->setup += clock_processor_seconds() - begin;
    return outcome;
}

static void matrices_free(matrices *a)
{
    sparse_free_values(&a->K);
    sparse_free_values(&a->M);
    sparse_free_values(&a->G);
    sparse_free_values(&a->geometric);
    factor_free(a->factor);
    free(a->residual);
    free(a->x);
    free(a->y);
}

static status linearise(analysis_context *c, const model_state *state, matrices *a, fault *f)
{
    const double path = kinematics_state_path(state);
    model_linearisation lin = {.path = path, .K = &a->K, .residual = a->residual};
    TRY(linearise_state(&c->eq, &c->run->memory, state, &lin, f));
    TRY(rotating_frame_inertia(&c->eq, state, path, &a->M, &a->G, f));
    TRY(stiffness_parts_geometric(&c->eq, &c->run->memory, state, &a->geometric, f));
    c->run->counters.factorisations++;
    TRY(context_factor(c, a->factor, &a->K, f));
    return context_symmetric(a->factor, "frequencies in a rotating frame", f);
}

static status identify(analysis_context *c, const gyroscopic_result *r, double mode[],
                       rotation_modes *out, fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t n = (size_t)size.free, all = n + (size_t)size.driven;
    for (int i = 0; i < r->count; i++) {
        memcpy(mode + (size_t)i * all, r->mode + (size_t)i * n, n * sizeof *mode);
        out->frequency[i] = r->frequency[i];
        out->growth[i] = r->growth[i];
        out->error[i] = r->error[i];
    }
    TRY(modes_separate(c->model, c->scene, r->count, r->frequency, all, mode, f));
    for (int i = 0; i < r->count; i++)
        TRY(modes_identify(c->model, c->scene, mode + (size_t)i * all, &out->shape[i], f));
    return STATUS_OK;
}

static status take_modes(analysis_context *c, const gyroscopic_result *r, rotation_modes *out,
                         fault *f)
{
    const model_size size = model_sizes(c->model);
    const size_t all = (size_t)size.free + (size_t)size.driven, count = (size_t)r->count;
    double *mode = calloc(count * all + 1, sizeof *mode);
    out->frequency = calloc(3 * count + 1, sizeof(double));
    out->shape = calloc(count + 1, sizeof *out->shape);
    status outcome = STATUS_FAULT;
    if (mode == NULL || out->frequency == NULL || out->shape == NULL) {
        fault_memory(f, "modes");
    } else {
        out->growth = out->frequency + count;
        out->error = out->growth + count;
        out->count = r->count;
        out->negative = r->negative;
        out->unproven = r->unproven;
        outcome = identify(c, r, mode, out, f);
    }
    free(mode);
    return outcome;
}

/* Returns 1 if quantities of this analysis need modes at any station. elsewhere 1: at a station
 * other than the last. */
static int needs_modes(const analysis_context *c, int analysis, int elsewhere)
{
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if ((scene_requests(q, analysis, SCENE_FREQUENCY) ||
             scene_requests(q, analysis, SCENE_GROWTH)) &&
            (!elsewhere || q->reduction != SCENE_LAST))
            return 1;
    }
    return 0;
}

/* Returns 1 if the modes of a station are needed. */
static int are_wanted_at(const analysis_context *c, int analysis, const outcome_path *path,
                         int station)
{
    if (c->options->values_only)
        return extract_path_has(c, analysis, path->stations, path->value, station);
    return station == path->stations - 1 || needs_modes(c, analysis, 1);
}

static int modes_wanted(const analysis_context *c, int analysis)
{
    int wanted = scene_walk_of(&c->scene->analysis[analysis])->modes;
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (scene_requests(q, analysis, SCENE_FREQUENCY) && wanted < scene_mode_of(q)->order + 1)
            wanted = scene_mode_of(q)->order + 1;
    }
    return wanted + OTHERS;
}

static int is_enough(const analysis_context *c, int analysis, const rotation_modes *modes)
{
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        int found = 0;
        if (!scene_requests(q, analysis, SCENE_FREQUENCY))
            continue;
        for (int k = 0; k < modes->count; k++)
            found += modes->growth[k] == 0 && modes_in_family(scene_mode_of(q), &modes->shape[k]);
        if (found <= scene_mode_of(q)->order)
            return 0;
    }
    return 1;
}

static status find_modes(analysis_context *c, const gyroscopic_problem *problem,
                         gyroscopic_result *result, rotation_modes *out, fault *f)
{
    const status found = gyroscopic_solve(problem, result, f);
    c->run->counters.factorisations += result->factorisations;
    TRY(found);
    return take_modes(c, result, out, f);
}

/* Computes `wanted` modes, or all modes if there are fewer. *enough: 1 if there is a mode for every
 * quantity or if there are no more modes. */
static status try_modes(analysis_context *c, int analysis, const gyroscopic_problem *problem,
                        rotation_modes *out, int *enough, fault *f)
{
    gyroscopic_result result = {0};
    const status outcome = find_modes(c, problem, &result, out, f);
    *enough = result.count < problem->wanted || is_enough(c, analysis, out);
    gyroscopic_free(&result);
    return outcome;
}

static status modes_at(analysis_context *c, int analysis, const model_state *state, matrices *a,
                       rotation_modes *out, fault *f)
{
    const model_size size = model_sizes(c->model);
    tangent_parts about = {c->model,  &c->run->memory,        state, &a->geometric, a->x, a->y,
                           size.free, size.free + size.driven};
    gyroscopic_problem problem = {.K = &a->K,
                                  .M = &a->M,
                                  .G = &a->G,
                                  .K_factor = a->factor,
                                  .K_product = tangent_product,
                                  .K_rounding = tangent_rounding,
                                  .context = &about};
    int enough = 0;
    for (problem.wanted = modes_wanted(c, analysis); !enough; problem.wanted *= 2) {
        outcome_modes_free(out);
        TRY(linearise(c, state, a, f));
        TRY(try_modes(c, analysis, &problem, out, &enough, f));
    }
    return STATUS_OK;
}

/* Returns 1 if mode i grows by more than rounding. */
static int grows(const rotation_modes *modes, int i)
{
    return modes->growth[i] > modes->error[i] * hypot(modes->growth[i], modes->frequency[i]);
}

static void note_instability(analysis_context *c, const rotation_modes *modes, double path)
{
    for (int i = 0; i < modes->count; i++)
        if (grows(modes, i) && c->result->reason[0] == '\0')
            snprintf(c->result->reason, sizeof c->result->reason,
                     "unstable at path %g: %s, %s, growth rate %.4g 1/s", path,
                     modes_family_name(modes->shape[i].family),
                     modes->frequency[i] > 0 ? "flutter" : "divergence", modes->growth[i]);
}

/* Reports the first station where the computed modes do not explain all negative eigenvalues. */
static void note_unproven(analysis_context *c, const rotation_modes *modes, double path)
{
    if (modes->unproven > 0 && c->result->reason[0] == '\0')
        snprintf(c->result->reason, sizeof c->result->reason,
                 "at path %g, the modes found do not account for %d of the negative eigenvalues of "
                 "the stiffness matrix; other modes may grow; increase 'wanted'",
                 path, modes->unproven);
}

static status modes_of(analysis_context *c, int analysis, matrices *a, outcome_rotation *out,
                       fault *f)
{
    const outcome_path *o = &out->path;
    out->modes = calloc((size_t)o->stations + 1, sizeof *out->modes);
    if (out->modes == NULL)
        return fault_memory(f, "modes");
    TRY(matrices_alloc(c, a, f));
    for (int i = 0; i < o->stations; i++) {
        if (!are_wanted_at(c, analysis, o, i))
            continue;
        TRY(modes_at(c, analysis, o->state[i], a, &out->modes[i], f));
        note_unproven(c, &out->modes[i], o->value[i]);
        note_instability(c, &out->modes[i], o->value[i]);
    }
    return STATUS_OK;
}

/* Returns the stability according to the modes. If there are no negative eigenvalues, no mode
 * grows. Otherwise the modes decide, provided that all modes are known and explain all negative
 * eigenvalues. */
static step_stability stability_of(const rotation_modes *modes)
{
    int known = modes->unproven == 0;
    for (int i = 0; i < modes->count; i++) {
        if (grows(modes, i))
            return STEP_GROWS;
        known &= modes->growth[i] == 0 && modes->error[i] <= EIGEN_LARGEST_ERROR;
    }
    return modes->negative == 0 ? STEP_STABLE : known ? STEP_HELD : STEP_OPEN;
}

void rotation_evaluate_stations(analysis_context *c, int analysis, const analysis_outcome *o)
{
    const outcome_rotation *r = outcome_rotation_of(o);
    for (int i = 0; r->modes != NULL && i < r->path.stations; i++)
        if (r->modes[i].count > 0)
            history_evaluate_station(c->result, analysis, r->path.value[i],
                                     stability_of(&r->modes[i]));
}

status rotation_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    matrices a = {0};
    TRY(static_analysis(c, analysis, o, f));
    if (!needs_modes(c, analysis, 0))
        return STATUS_OK;
    const status outcome = modes_of(c, analysis, &a, &o->left.rotation, f);
    matrices_free(&a);
    return outcome;
}
