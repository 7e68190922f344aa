#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

status stage_alloc(analysis_context *c, const frame_masses *masses, motion_stage *s, fault *f)
{
    const model_size size = model_sizes(c->model);
    const sparse *pattern;
    const size_t all = (size_t)(size.free + size.driven) + 1;
    memset(s, 0, sizeof *s);
    s->c = c;
    s->masses = masses;
    s->free = size.free;
    s->all = size.free + size.driven;
    newton_convergence_start(c->options->criterion, model_leaves(c->model) != 0, size.elements,
                             &s->newton_convergence);
    s->residual = calloc(all, sizeof *s->residual);
    s->dx = calloc(all, sizeof *s->dx);
    if (s->residual == NULL || s->dx == NULL)
        return fault_memory(f, "the time integration");
    if (c->options->newton != NEWTON_DISPLACEMENT)
        TRY(strain_update_alloc(&c->eq, &s->strain_update, f));
    TRY(assemble_pattern_in_time(c->model, c->run->patterns, &pattern, f));
    TRY(sparse_alloc_like(pattern, &s->S, f));
    return factor_alloc_copies(pattern, 1, &s->factor, f);
}

void stage_free(motion_stage *s)
{
    free(s->residual);
    free(s->dx);
    strain_update_free(s->strain_update);
    sparse_free_values(&s->S);
    factor_free(s->factor);
}

int stage_stands(const newton_convergence *a)
{
    const double near = 1e-4, slow = 0.1;
    return a->correction <= near && a->stress_change <= near && a->correction <= slow * a->before;
}

static void rates_of(const motion_stage *s, stage_rates *r)
{
    for (int i = 0; i < s->free; i++) {
        r->v[i] = r->v0[i] + r->g * r->inc[i];
        r->a[i] = r->a0[i] + r->b * r->inc[i];
    }
}

status stage_direction(motion_stage *s, int fresh, fault *f)
{
    if (fresh)
        TRY(context_factor(s->c, s->factor, &s->S, f));
    memcpy(s->dx, s->residual, (size_t)s->free * sizeof *s->dx);
    memset(s->dx + s->free, 0, (size_t)(s->all - s->free) * sizeof *s->dx);
    factor_solve(s->factor, s->dx);
    context_count_factorisations(s->c, s->factor, &s->counted);
    return STATUS_OK;
}

static void add_entry(void *S, int row, int column, double value)
{
    assemble_subtract(S, row, column, -value);
}

static status direction(motion_stage *s, int fresh, double time, const stage_rates *r,
                        model_state *now, step_record *record, fault *f)
{
    const model *m = s->c->model;
    model_linearisation lin = {.path = s->begins ? time : discontinuities_before(m, time),
                               .K = fresh ? &s->S : NULL,
                               .residual = s->residual};
    const inertia_relation with = {r->b, r->g, r->inc};
    if (s->c->options->newton == NEWTON_DISPLACEMENT)
        TRY(linearise_make_compatible(&s->c->eq, now, f));
    feedback_take(&s->c->eq, now, r->v, lin.path);
    TRY(linearise_state(&s->c->eq, &s->c->run->memory, now, &lin, f));
    inertia_subtract(m, s->masses, now, r->v, r->a, s->residual);
    s->c->run->counters.inertia_evaluations +=
        s->masses->spread ? model_sizes(m).elements * (1 + fresh) : 0;
    if (fresh)
        inertia_add_tangent(&s->c->eq, s->masses, now, r->v, r->a, &with, &s->S);
    if (fresh)
        feedback_tangent(&s->c->eq, now, &(feedback_gains){1, r->g, r->h / 2}, add_entry, &s->S);
    record->incompatibility = lin.incompatibility;
    return stage_direction(s, fresh, f);
}

typedef struct stage_solution {
    motion_stage *s;
    const model_state *from;
    double time;
    stage_rates *r;
    model_state *now;
} stage_solution;

static status correct(void *of, int iteration, newton_correction *out, step_record *record,
                      fault *f)
{
    const stage_solution *one = of;
    motion_stage *s = one->s;
    const model *m = s->c->model;
    const int fresh = iteration == 1 || !stage_stands(&s->newton_convergence);
    const feedback_step past = {one->r->h, one->time - one->r->h,
                                discontinuities_before(m, one->time)};
    feedback_integrate(&s->c->eq, one->from, one->now, &past, one->now->feedback);
    TRY(direction(s, fresh, one->time, one->r, one->now, record, f));
    increment_add(m, one->now, s->dx, one->r->inc);
    strain_update_begin(s->strain_update, one->now);
    out->at = one->time;
    out->size =
        advance_state(&s->c->eq, &s->c->run->memory, one->now, s->dx, one->time, &out->stress);
    rates_of(s, one->r);
    return STATUS_OK;
}

static void prepare(void *of, int iteration, double correction)
{
    const stage_solution *one = of;
    strain_update_apply(one->s->strain_update, one->now, iteration, correction);
}

status stage_solve(motion_stage *s, const model_state *from, double time, stage_rates *r,
                   model_state *now, step_record *record, fault *f)
{
    stage_solution one = {s, from, time, r, now};
    const newton_use use = newton_in_time(s->c, &one, correct, prepare);
    increment_apply(s->c->model, from, r->inc, time, now);
    rates_of(s, r);
    return newton_iterate(s->c, &use, &s->newton_convergence, record, f);
}

enum { MOST = ELEMENT_MAX_STRAINS };

struct strain_update {
    const equations *eq;
    const model *m;
    double *before; /* [elements x strains] strains for which the stresses were linearised */
    double
        /* size of the correction after which the stresses of all elements agreed with their
         * targets; 0: not yet in this step */
        settled;
};

static int curved(const model *m, const element_data *data, double length)
{
    double e[MOST] = {0}, sigma[MOST], rest[MOST * MOST] = {0}, C[MOST * MOST] = {0};
    const size_t bytes = (size_t)(model_strains(m) * model_strains(m)) * sizeof *C;
    if (model_type(m)->stress(data, e, NULL, &(stress_output){.sigma = sigma, .C = rest}) !=
        STATUS_OK)
        return 1;
    for (int k = 0; k < model_strains(m); k++)
        e[k] = 0.01 * length / (k + 1);
    return model_type(m)->stress(data, e, NULL, &(stress_output){.sigma = sigma, .C = C}) !=
               STATUS_OK ||
           memcmp(C, rest, bytes) != 0;
}

static int wanted(const model *m)
{
    const int elsewhere = model_type(m)->stress_many != NULL && model_type(m)->lanes == 0;
    if (model_inner(m) > 0 || elsewhere || model_absolute(m))
        return 0;
    for (int k = 0; k < model_kinds(m); k++)
        if (curved(m, model_kind(m, k)->data, model_kind(m, k)->length))
            return 1;
    return 0;
}

status strain_update_alloc(const equations *eq, strain_update **out, fault *f)
{
    const model *m = eq->m;
    const size_t strains = (size_t)model_elements(m) * (size_t)model_strains(m);
    strain_update *c = NULL;
    *out = NULL;
    if (!wanted(m))
        return STATUS_OK;
    c = malloc(sizeof *c + strains * sizeof *c->before);
    if (c == NULL)
        return fault_memory(f, "the strains of a step");
    c->eq = eq;
    c->m = m;
    c->before = (double *)(c + 1);
    c->settled = 0;
    *out = c;
    return STATUS_OK;
}

void strain_update_free(strain_update *c)
{
    free(c);
}

void strain_update_begin(strain_update *c, const model_state *s)
{
    if (c != NULL)
        memcpy(c->before, s->e,
               (size_t)(model_elements(c->m) * model_strains(c->m)) * sizeof *s->e);
}

typedef struct strain_update_search {
    const equations *eq;
    const model *m;
    int element;
    double path; /* time [s] of the free strains */
    double near; /* [N] distance below which stresses agree */
    double e[MOST], sigma[MOST], C[MOST * MOST];
} strain_update_search;

static double near_of(int n, const double sigma[])
{
    double largest = 0;
    for (int i = 0; i < n; i++)
        largest = fmax(largest, fabs(sigma[i]));
    return 0.1 * largest;
}

/* Computes gap[n] = goal - sigma. Returns the largest absolute value of a component; NAN: a
 * component is not finite. */
static double gap_of(int n, const double goal[], const double sigma[], double gap[])
{
    double sum = 0, largest = 0;
    for (int i = 0; i < n; i++) {
        gap[i] = goal[i] - sigma[i];
        sum += gap[i];
        largest = fmax(largest, fabs(gap[i]));
    }
    return isfinite(sum) ? largest : NAN;
}

static int evaluate(strain_update_search *w)
{
    w->eq->run->counters.stress_evaluations++;
    return model_type(w->m)->stress(free_strain_data(w->eq, w->element, w->path), w->e, NULL,
                                    &(stress_output){.sigma = w->sigma, .C = w->C}) == STATUS_OK;
}

/* Computes e += C^-1 gap. Returns 0 if C is singular. */
static int move(strain_update_search *w, double gap[])
{
    const int n = model_strains(w->m);
    int pivot[MOST];
    double LU[MOST * MOST];
    memcpy(LU, w->C, (size_t)(n * n) * sizeof *LU);
    for (int i = 0; i < n; i++) {
        double row = 0;
        for (int j = 0; j < n; j++)
            row = fmax(row, fabs(LU[n * i + j]));
        if (row == 0)
            LU[n * i + i] = 1;
    }
    if (dense_lu_regular(n, LU, pivot) != 0)
        return 0;
    dense_lu_solve(n, 1, LU, pivot, gap);
    for (int i = 0; i < n; i++)
        w->e[i] += gap[i];
    return 1;
}

/* Runs Newton's method as long as the gap decreases. Returns 1 if the gap is small enough. */
static int reach_target(strain_update_search *w, const double goal[])
{
    enum { MOST_ITERATIONS = 8 };
    const double contracts = 0.3;
    double before = INFINITY;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        double gap[MOST];
        const double off = evaluate(w) ? gap_of(model_strains(w->m), goal, w->sigma, gap) : NAN;
        if (off <= w->near)
            return 1;
        if (!(off <= contracts * before) || !move(w, gap))
            return 0;
        before = off;
    }
    return 0;
}

/* Moves the stresses in steps from their current values to the target. Returns 1 if they reach
 * it. */
static int follow(strain_update_search *w, const double goal[])
{
    const int n = model_strains(w->m);
    const double shortest = 1.0 / 256, longest = 0.5;
    double part = longest, begin[MOST], target[MOST], gap[MOST];
    strain_update_search at = *w;
    if (!evaluate(&at))
        return 0;
    memcpy(begin, at.sigma, sizeof begin);
    for (double done = 0; done < 1 && part >= shortest;) {
        const double next = fmin(1, done + part);
        for (int i = 0; i < n; i++)
            target[i] = next < 1 ? begin[i] + next * (goal[i] - begin[i]) : goal[i];
        *w = at;
        gap_of(n, target, at.sigma, gap);
        if (move(w, gap) && reach_target(w, target)) {
            at = *w;
            done = next;
            part = fmin(longest, 2 * part);
        } else
            part /= 2;
    }
    return part >= shortest;
}

/* Returns the target stresses for the strains of an element; NULL: the element has no stresses at
 * e. The target is the stress of the state or, with damping, its part that depends on strains only:
 * P'(e) + P''(e) de, where e are the strains before the increment. */
static const double *target_of(const strain_update *c, const model_state *s, int element,
                               double room[])
{
    const model *m = c->m;
    const size_t first = (size_t)element * (size_t)model_strains(m);
    double C[MOST * MOST], de[MOST], more[MOST];
    if (run_damping_of(c->eq->run->damping, m, element) == NULL)
        return s->sigma + first;
    c->eq->run->counters.stress_evaluations++;
    if (model_type(m)->stress(free_strain_data(c->eq, element, s->path), c->before + first, NULL,
                              &(stress_output){.sigma = room, .C = C}) != STATUS_OK)
        return NULL;
    for (int k = 0; k < model_strains(m); k++)
        de[k] = s->e[first + (size_t)k] - c->before[first + (size_t)k];
    dense_mul_vec(model_strains(m), model_strains(m), C, de, more);
    for (int k = 0; k < model_strains(m); k++)
        room[k] += more[k];
    return room;
}

static void find(const strain_update *c, double path, int element, const double sigma[], double e[])
{
    const size_t n = (size_t)model_strains(c->m);
    strain_update_search w = {.eq = c->eq,
                              .m = c->m,
                              .element = element,
                              .path = path,
                              .near = near_of(model_strains(c->m), sigma)};
    memcpy(w.e, e, n * sizeof *e);
    if (reach_target(&w, sigma)) {
        memcpy(e, w.e, n * sizeof *e);
        return;
    }
    memcpy(w.e, c->before + (size_t)element * n, n * sizeof *e);
    if (follow(&w, sigma))
        memcpy(e, w.e, n * sizeof *e);
}

static void settled(const strain_update *c, const model_state *s, int count, const int index[],
                    const double *const goal[], int is[])
{
    const model *m = c->m;
    const element_data *data[CHUNK_MOST];
    const double *e[CHUNK_MOST], *inner[CHUNK_MOST] = {NULL};
    double sigma[CHUNK_MOST][MOST], gap[MOST];
    stress_output out[CHUNK_MOST];
    status outcome[CHUNK_MOST];
    for (int k = 0; k < count; k++) {
        data[k] = free_strain_data(c->eq, index[k], s->path);
        e[k] = &s->e[(size_t)index[k] * (size_t)model_strains(m)];
        out[k] = (stress_output){.sigma = sigma[k]};
    }
    c->eq->run->counters.stress_evaluations += count;
    if (count > 1 && c->eq->run->free_strain == NULL)
        model_type(m)->stress_many(count, data, e, inner, out, outcome);
    else
        for (int k = 0; k < count; k++)
            outcome[k] = model_type(m)->stress(data[k], e[k], NULL, &out[k]);
    for (int k = 0; k < count; k++)
        is[k] = goal[k] == NULL ||
                (outcome[k] == STATUS_OK && gap_of(model_strains(m), goal[k], sigma[k], gap) <=
                                                near_of(model_strains(m), goal[k]));
}

static int follow_stresses(const strain_update *c, model_state *s, int first, int end)
{
    const size_t n = (size_t)model_strains(c->m);
    unsigned char done[CHUNK_WINDOW] = {0};
    int index[CHUNK_MOST], is[CHUNK_MOST], count, all = 1;
    double room[CHUNK_MOST][MOST];
    const double *goal[CHUNK_MOST];
    while ((count = chunk_next(c->m, first, end, done, index)) > 0) {
        for (int k = 0; k < count; k++)
            goal[k] = target_of(c, s, index[k], room[k]);
        settled(c, s, count, index, goal, is);
        for (int k = 0; k < count; k++)
            if (!is[k]) {
                find(c, s->path, index[k], goal[k], &s->e[(size_t)index[k] * n]);
                all = 0;
            }
    }
    return all;
}

void strain_update_apply(strain_update *c, model_state *s, int iteration, double correction)
{
    int all = 1;
    if (c == NULL || (iteration > 1 && correction <= c->settled))
        return;
    for (int first = 0; first < model_elements(c->m); first += CHUNK_WINDOW) {
        const int rest = model_elements(c->m) - first;
        all &= follow_stresses(c, s, first, first + (rest < CHUNK_WINDOW ? rest : CHUNK_WINDOW));
    }
    c->settled = all ? correction : 0;
}
