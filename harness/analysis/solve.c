#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/model/model.h"
#include "harness/time/time.h"

static status buckling_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
static status linear_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

typedef status analysis_function(analysis_context *, int analysis, analysis_outcome *, fault *);

static analysis_function *function_of(const scene *s, const scene_analysis *a)
{
    const int is_loaded = a->follows != SCENE_NONE && s->analysis[a->follows].kind == SCENE_STATIC;
    switch (a->kind) {
    case SCENE_LINEAR:
        return linear_analysis;
    case SCENE_BUCKLING:
        return is_loaded ? loaded_buckling : buckling_analysis;
    case SCENE_MODAL:
        return a->damped ? damped_modal : is_loaded ? loaded_modal : modal_analysis;
    case SCENE_STATIC:
        return static_analysis;
    case SCENE_COMPLIANCE:
        return compliance_analysis;
    case SCENE_CONTINUATION:
        return continuation_analysis;
    case SCENE_ROTATION:
        return rotation_analysis;
    case SCENE_HARMONIC:
        return harmonic_analysis;
    case SCENE_MOTION:
        break;
    }
    return motion_analysis;
}

/* Did the analysis fail before leaving the undeformed state? For a motion the structure may be
 * free.
 */
static int is_stuck(const analysis_outcome *o)
{
    const int failed = o->status == STATUS_SINGULAR || o->status == STATUS_NOT_CONVERGED;
    return failed && o->kind != SCENE_MOTION && o->kind != SCENE_HARMONIC &&
           (!outcome_has_path(o) || outcome_path_of(o)->reached == 0);
}

/* Does the analysis have a step with an indefinite tangent? */
static int has_negative(const solve_result *r, int from)
{
    for (int i = from; i < r->steps; i++)
        if (r->step[i].negative_pivots > 0)
            return 1;
    return 0;
}

/* Detects a path that starts from a structure whose stiffness is indefinite at rest. Called if the
 * path was unstable or failed; not counted as work. */
static status judge_rest(analysis_context *c, const analysis_outcome *o, int first_step, fault *f)
{
    if (!outcome_has_path(o) || o->kind == SCENE_COMPLIANCE || o->kind == SCENE_MOTION ||
        o->kind == SCENE_HARMONIC ||
        (o->status == STATUS_OK && !has_negative(c->result, first_step)) ||
        newton_judge_rest(c->model, NULL) != STATUS_OK) /* which has been reported already */
        return o->status;
    fault why = {""};
    linear_system s = {0};
    const counters work = c->run->counters;
    const status at_rest = linear_system_alloc(c, &s, &why);
    linear_system_free(&s);
    c->run->counters = work;
    return at_rest == STATUS_NOT_CONVERGED ? fault_set(f, at_rest, "%s", why.text) : o->status;
}

/* Runs analyses; the first failure determines the overall status. perfect: 0, 1: those of the
 * imperfect or the perfect structure; otherwise all. */
static void run_analyses(analysis_context *c, int perfect)
{
    for (int i = 0; i < c->scene->analyses; i++) {
        analysis_outcome *o = &c->outcomes[i];
        fault f = {""};
        const scene_analysis *a = &c->scene->analysis[i];
        if (perfect < 2 && scene_is_perfect(c->scene, i) != perfect)
            continue;
        analysis_function *run = function_of(c->scene, a);
        o->kind = a->kind;
        if (!context_runs(c, i) || (c->options->sample > 0 && a->kind != SCENE_STATIC))
            continue;
        analysis_context own = context_of(c, i);
        c->work->singular = 0;
        const int first_step = c->result->steps;
        o->status = scene_inputs_check(c->scene, i, &f);
        if (o->status == STATUS_OK)
            o->status = newton_judge_rest(c->model, &f);
        if (o->status == STATUS_OK)
            o->status = run(&own, i, o, &f);
        history_judge_steps(c->result, c->scene, i, first_step);
        if (a->kind == SCENE_ROTATION)
            rotation_judge_stations(&own, i, o);
        if (o->status == STATUS_SINGULAR && c->work->singular)
            singular_explain(&own, &f);
        else if (is_stuck(o))
            o->status = singular_mechanism(&own, o->status, &f);
        o->status = judge_rest(&own, o, first_step, &f);
        snprintf(o->reason, sizeof o->reason, "%s", f.text);
        if (o->status != STATUS_OK && c->result->status == STATUS_OK) {
            c->result->status = o->status;
            snprintf(c->result->reason, sizeof c->result->reason, "%s", f.text);
        }
    }
}

/* Gives the solution the status of a failed later stage, unless it has failed before. */
static void spoil(solve_result *r, status outcome, const fault *f)
{
    if (outcome == STATUS_OK || r->status != STATUS_OK)
        return;
    r->status = outcome;
    snprintf(r->reason, sizeof r->reason, "%s", f->text);
}

/* Shapes and the matrices of all states, if requested. */
static void keep_states(analysis_context *c)
{
    fault f = {""};
    solve_result *r = c->result;
    if (c->options->shapes > 0)
        spoil(r, collect_shapes(c, c->options->shapes, &r->shapes, &f), &f);
    if (c->options->systems)
        spoil(r, collect_systems(c, &r->systems, &f), &f);
}

/* Reports the value of the governing quantity, and names it. */
static void put_envelope(const scene *s, solve_result *r, int quantity)
{
    const scene_quantity *q = &s->quantity[quantity];
    quantity_result *to = &r->quantity[quantity];
    double most = -INFINITY;
    for (int i = 0; q->what.kind == SCENE_ENVELOPE_OF && i < q->overs; i++) {
        const quantity_result *one = &r->quantity[q->over[i]];
        const char *name = s->quantity[q->over[i]].name;
        if (one->status != STATUS_OK) {
            char why[FAULT_TEXT];
            snprintf(why, sizeof why, "%s has no value: %.250s", name, one->reason);
            quantity_no_value(to, one->status, why);
            return;
        }
        const double value = quantity_scaled(q, one->value),
                     size = q->what.of.envelope == SCENE_ENVELOPE_MIN       ? -value
                            : q->what.of.envelope == SCENE_ENVELOPE_LARGEST ? fabs(value)
                                                                            : value;
        if (!(size > most))
            continue;
        most = size;
        to->value = q->what.of.envelope == SCENE_ENVELOPE_MIN ? value : size;
        to->rounding = one->rounding;
        snprintf(to->meaning, sizeof to->meaning, "%s%s%.60s", name,
                 one->meaning[0] != '\0' ? ", " : "", one->meaning);
    }
}

/* Reports a curve over another quantity, at the points that both have. */
static void put_over(const scene *s, solve_result *r, int quantity)
{
    const int over = scene_abscissa_of(s, &s->quantity[quantity]);
    const curve *of = over != SCENE_NONE ? &r->quantity[over].curve : NULL;
    curve *c = &r->quantity[quantity].curve;
    for (int i = 0; of != NULL && i < c->points; i++)
        c->x[i] = i < of->points ? of->value[i] : NAN;
}

static void add_counters(const counters *more, counters *to)
{
    to->strain_evaluations += more->strain_evaluations;
    to->stress_evaluations += more->stress_evaluations;
    to->inertia_evaluations += more->inertia_evaluations;
    to->geometric_evaluations += more->geometric_evaluations;
    to->iterations += more->iterations;
    to->steps += more->steps;
    to->rejected_steps += more->rejected_steps;
    to->factorisations += more->factorisations;
    to->solutions += more->solutions;
    to->factor_entries += more->factor_entries;
    to->factor_flops += more->factor_flops;
    to->dense_operations += more->dense_operations;
    to->negative_pivots =
        to->negative_pivots > more->negative_pivots ? to->negative_pivots : more->negative_pivots;
    to->condition = fmax(to->condition, more->condition);
}

/* Data for the analyses of the imperfect structure. */
typedef struct imperfect {
    model_imperfect *shape;
    model *m;
    run_state run;
    context_work work;
    analysis_context c;
    const analysis_context *sides[2];
} imperfect;

static void imperfect_free(imperfect *p)
{
    factor_free(p->work.left);
    run_state_end(&p->run);
    model_free(p->m);
    model_imperfect_free(p->shape);
}

static status imperfect_begin(const analysis_context *c, imperfect *p, fault *f)
{
    const model_size size = model_sizes(c->model);
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    if (x == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for imperfections");
    status outcome = imperfection_of_modes(c, x, f);
    if (outcome == STATUS_OK)
        outcome = model_imperfect_alloc(c->model, x, &p->shape, f);
    free(x);
    TRY(outcome);
    TRY(model_imperfect_build(c->model, p->shape, &p->m, f));
    return run_state_begin(&p->run, p->m, c->options->threads, f);
}

/* Runs the analyses whose modes are imperfections, then those of the imperfect structure. */
static void run_imperfect(analysis_context *c, imperfect *p)
{
    fault f = {""};
    run_analyses(c, 1);
    const status ready = imperfect_begin(c, p, &f);
    if (ready == STATUS_OK) {
        p->c = *c;
        p->c.model = p->m;
        p->c.scene = model_scene(p->m);
        p->c.run = &p->run;
        p->c.work = &p->work;
        p->sides[0] = &p->c;
        p->sides[1] = c;
        run_analyses(&p->c, 0);
        p->c.sides = c->sides = p->sides;
        return;
    }
    for (int i = 0; i < c->scene->analyses; i++) {
        analysis_outcome *o = &c->outcomes[i];
        if (scene_is_perfect(c->scene, i))
            continue;
        o->kind = c->scene->analysis[i].kind;
        o->status = ready;
        snprintf(o->reason, sizeof o->reason, "%s", f.text);
    }
    spoil(c->result, ready, &f);
}

status solve_scene(const scene *s, const model *m, const solve_options *options,
                   solve_result *result, fault *f)
{
    static const solve_options defaults = {0};
    run_state run;
    context_work work = {0};
    imperfect other = {0};
    analysis_context c = {.scene = s,
                          .model = m,
                          .run = &run,
                          .options = options != NULL ? options : &defaults,
                          .result = result,
                          .work = &work};
    memset(result, 0, sizeof *result);
    TRY(run_state_begin(&run, m, c.options->threads, f));
    phases_want(&run.phases, c.options->phases);
    const double start = clock_processor_seconds();
    result->quantity = calloc((size_t)s->quantities + 1, sizeof *result->quantity);
    c.outcomes = calloc((size_t)s->analyses + 1, sizeof *c.outcomes);
    if (result->quantity == NULL || c.outcomes == NULL) {
        free(c.outcomes);
        run_state_end(&run);
        return fault_set(f, STATUS_FAULT, "out of memory for a solution");
    }
    result->quantities = s->quantities;
    if (s->imperfections > 0)
        run_imperfect(&c, &other);
    else
        run_analyses(&c, 2);
    result->seconds_setup = work.setup + other.work.setup;
    result->seconds_solve = clock_processor_seconds() - start - result->seconds_setup;
    if (c.options->phases)
        phases_of_whole(&run.phases, result->seconds_solve, result->phase);
    for (int i = 0; i < s->quantities; i++) {
        quantity_result *q = &result->quantity[i];
        const analysis_context own = context_of(&c, s->quantity[i].analysis);
        extract_quantity(&own, &s->quantity[i], q);
        q->change = NAN;
        if (q->status == STATUS_FAULT && result->status == STATUS_OK) {
            result->status = STATUS_FAULT;
            snprintf(result->reason, sizeof result->reason, "%s", q->reason);
        }
    }
    for (int i = 0; i < s->quantities; i++) {
        put_over(s, result, i);
        put_envelope(s, result, i);
    }
    add_counters(&other.run.counters, &run.counters);
    result->counters = run.counters; /* shapes are for drawing, so their work is not counted */
    keep_states(&c);
    for (int i = 0; i < s->analyses; i++)
        outcome_free(&c.outcomes[i]);
    free(c.outcomes);
    factor_free(work.left);
    imperfect_free(&other);
    run_state_end(&run);
    if (result->status != STATUS_OK && f != NULL)
        snprintf(f->text, sizeof f->text, "%s", result->reason);
    return result->status;
}

/* Linear statics about the undeformed state: one factorisation, and a right-hand side for each load
 * case and combination that is read. The initial strains of members are in each of them once, so
 * combinations are not sums of solutions. */

/* Does a quantity of the analysis read this load case or combination? If no quantity does, all
 * count as read. */
static int is_read(const scene *s, int analysis, int acting)
{
    int any = 0;
    for (int k = 0; k < s->quantities; k++) {
        const scene_quantity *q = &s->quantity[k];
        int one;
        any |= q->analysis == analysis;
        for (int i = 0; q->analysis == analysis && (one = scene_acting_in(s, q, i)) != 0; i++)
            if (one == acting)
                return 1;
    }
    return !any;
}

static status solutions_alloc(const analysis_context *c, int analysis, outcome_linear *l, fault *f)
{
    const model_size size = model_sizes(c->model);
    const scene *s = c->scene;
    const int all = scene_solves_all(s, analysis), most = all ? s->combinations + s->cases : 1;
    l->coordinates = (size_t)size.free + (size_t)size.driven;
    l->acting = calloc((size_t)most, sizeof *l->acting);
    if (l->acting == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for load cases");
    for (int number = 1; all && number <= most; number++)
        if (is_read(s, analysis, number))
            l->acting[l->solutions++] = number;
    if (!all)
        l->acting[l->solutions++] = c->eq.loading.acting;
    l->x = calloc((size_t)l->solutions * l->coordinates + 1, sizeof *l->x);
    return l->x != NULL ? STATUS_OK
                        : fault_set(f, STATUS_FAULT, "out of memory for a linear solution");
}

/* The caller, linear_analysis, frees *s, also after a failure. */
static status displace(analysis_context *c, int analysis, linear_system *s, outcome_linear *l,
                       fault *f)
{
    TRY(solutions_alloc(c, analysis, l, f));
    TRY(linear_system_alloc(c, s, f));
    for (int i = 0; i < l->solutions; i++) {
        analysis_context one = context_under(c, l->acting[i]);
        TRY(linear_system_solve(&one, s, 1, l->x + (size_t)i * l->coordinates, f));
    }
    return STATUS_OK;
}

static status linear_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    linear_system s = {0};
    const status result = displace(c, analysis, &s, &o->left.linear, f);
    linear_system_free(&s);
    return result;
}

/* Linear buckling about the undeformed state: (K + G_0 + lambda G) x = 0 with G from the stresses
 * due to the change of loads from path 0 to 1, and G_0 from those at path 0, which are constant and
 * include initial strains. */

/* Quadratic forms of the loads scaled by the load factor (growing) and of the constant loads
 * (staying). */
typedef struct prestresses {
    quadratic_forms growing, staying;
    int stays;         /* 0: no constant stress */
    sparse G, of_stay; /* geometric stiffness of both */
    double *product;   /* [free] */
} prestresses;

static double stiffness_form(void *context, const double mode[])
{
    prestresses *p = context;
    const double K = quadratic_forms_stiffness(&p->growing, mode);
    return p->stays ? K + quadratic_forms_geometric(&p->staying, mode) : K;
}

static double stiffness_rounding(void *context, const double mode[])
{
    prestresses *p = context;
    const double K = quadratic_forms_stiffness_rounding(&p->growing, mode);
    return p->stays ? K + quadratic_forms_geometric_rounding(&p->staying, mode) : K;
}

static void stiffness_product(void *context, const double mode[], double y[])
{
    prestresses *p = context;
    quadratic_forms_product(&p->growing, mode, y);
    if (!p->stays)
        return;
    sparse_mul(&p->of_stay, mode, p->product);
    for (int i = 0; i < p->growing.free; i++)
        y[i] += p->product[i];
}

static double geometric_form(void *context, const double mode[])
{
    prestresses *p = context;
    return quadratic_forms_geometric(&p->growing, mode);
}

static double geometric_rounding(void *context, const double mode[])
{
    prestresses *p = context;
    return quadratic_forms_geometric_rounding(&p->growing, mode);
}

/* Moves the modes to the outcome, with lambda = 1/mu. */
static void keep(eigen_side *side, outcome_side *to)
{
    for (int i = 0; i < side->count; i++)
        side->mu[i] = 1 / side->mu[i];
    outcome_take(side, to);
}

/* Number of eigenvalues of each sign that the quantities request. */
static void wanted_of(const analysis_context *c, int analysis, eigen_problem *p)
{
    p->largest = imperfection_modes(c->scene, analysis);
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (!scene_asks(q, analysis, SCENE_CRITICAL_FACTOR))
            continue;
        const scene_critical_load *load = scene_critical_load_of(q);
        int *side = load->sign > 0 ? &p->largest : &p->smallest;
        if (*side < load->order + 1)
            *side = load->order + 1;
    }
}

static void subtract(const sparse *from, sparse *a)
{
    for (int i = 0; i < a->column[a->n]; i++)
        a->value[i] -= from->value[i];
}

/* K += G of the constant stresses, under which the structure must be stable; the remaining stresses
 * grow. */
static status split_stays(analysis_context *c, linear_system *s, prestresses *p, fault *f)
{
    const model_size size = model_sizes(c->model);
    p->stays = 1;
    p->product = calloc((size_t)size.free + 1, sizeof *p->product);
    if (p->product == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for constant loads");
    TRY(quadratic_forms_alloc(&c->eq, &s->K, &p->staying, f));
    TRY(linear_system_solve(c, s, 0, p->staying.load_x, f));
    TRY(quadratic_forms_load(&c->eq, &p->staying, 0, 1, f));
    TRY(sparse_alloc_like(&s->K, &p->of_stay, f));
    TRY(linear_geometric_stiffness(&c->eq, p->staying.sigma, 0, &p->of_stay, f));
    for (int i = 0; i < size.free + size.driven; i++)
        p->growing.load_x[i] -= p->staying.load_x[i];
    for (int i = 0; i < s->K.column[s->K.n]; i++)
        s->K.value[i] += p->of_stay.value[i];
    c->run->counters.factorisations++;
    const status factored = context_factor(c, s->factor, &s->K, f);
    if (factored == STATUS_SINGULAR ||
        (factored == STATUS_OK && factor_count(s->factor).negative_pivots > 0))
        return fault_set(
            f, STATUS_REFUSED,
            "%s, which are constant, are critical without the scaled loads; reduce them",
            linear_initial(c->model) == 0 ? "the loads at path 0"
            : !loads_begin(&c->eq)        ? "the strains of members"
                                          : "the loads at path 0 and strains of members");
    return factored;
}

/* The linear solution, its stresses and their geometric stiffness. */
static status prestress(analysis_context *c, linear_system *s, prestresses *p, fault *f)
{
    if (!s->K.symmetric)
        return fault_set(f, STATUS_REFUSED,
                         "linear buckling requires a symmetric stiffness matrix");
    TRY(along_path_proportional(c->scene, c->eq.loading.acting, f));
    TRY(quadratic_forms_alloc(&c->eq, &s->K, &p->growing, f));
    TRY(linear_system_solve(c, s, 1, p->growing.load_x, f));
    if (loads_begin(&c->eq) || linear_initial(c->model) > 0)
        TRY(split_stays(c, s, p, f));
    TRY(quadratic_forms_load(&c->eq, &p->growing, 1, 0, f));
    TRY(sparse_alloc_like(&s->K, &p->G, f));
    TRY(linear_geometric_stiffness(&c->eq, p->growing.sigma, 1, &p->G, f));
    if (p->stays) {
        subtract(&p->staying.loads, &p->G);
        subtract(&p->staying.loads, &p->growing.loads);
    }
    return STATUS_OK;
}

typedef struct buckling {
    linear_system system;
    prestresses of;
    eigen_result found;
} buckling;

/* Frees everything except the results. */
static void buckling_free(buckling *b)
{
    linear_system_free(&b->system);
    sparse_free_values(&b->of.G);
    sparse_free_values(&b->of.of_stay);
    quadratic_forms_free(&b->of.growing);
    quadratic_forms_free(&b->of.staying);
    free(b->of.product);
}

/* The caller, buckling_analysis, frees *b, also after a failure. */
static status solve(analysis_context *c, int analysis, buckling *b, fault *f)
{
    TRY(linear_system_alloc(c, &b->system, f));
    TRY(prestress(c, &b->system, &b->of, f));
    eigen_problem p = {.K = &b->system.K,
                       .A = &b->of.G,
                       .K_factor = b->system.factor,
                       .sign = -1,
                       .K_energy = stiffness_form,
                       .A_energy = geometric_form,
                       .K_rounding = stiffness_rounding,
                       .A_rounding = geometric_rounding,
                       .K_product = stiffness_product,
                       .context = &b->of};
    wanted_of(c, analysis, &p);
    const status result = eigen_solve(&p, &b->found, f);
    context_count_eigen(c, &b->found);
    return result;
}

/* Do the nodes rotate without displacement? Only then can the load depend on the element length, by
 * local buckling of elements. */
static int only_turns(const analysis_context *c, const eigen_side *side, int i)
{
    const double no_shift = 1e-6;
    const model_size size = model_sizes(c->model);
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    if (x == NULL)
        return 0;
    memcpy(x, side->mode + (size_t)i * (size_t)size.free, (size_t)size.free * sizeof *x);
    const double part = metric_shift_part(c->model, x);
    free(x);
    return part < no_shift;
}

/* The same problem on a mesh of half the element length. */
static status solve_halved(const analysis_context *c, int analysis, eigen_result *found, fault *f)
{
    model *halved = NULL;
    run_state run = {0}; /* its work is not counted */
    context_work work = {0};
    buckling b = {0};
    status result = model_halved(c->model, &halved, f);
    if (result == STATUS_OK)
        result = run_state_begin(&run, halved, 1, f);
    if (result == STATUS_OK) {
        analysis_context finer = {.scene = c->scene,
                                  .model = halved,
                                  .run = &run,
                                  .options = c->options,
                                  .result = c->result,
                                  .work = &work};
        finer.eq = (equations){halved, loading_of(halved, analysis), &run};
        result = solve(&finer, analysis, &b, f);
    }
    *found = b.found;
    buckling_free(&b);
    run_state_end(&run);
    model_free(halved);
    return result;
}

/* Removes mesh-dependent loads. A load that grows with the square of the number of elements is not
 * a property of the structure: elements without shear flexibility buckle by themselves (12 EI/l^2
 * acts as GA). That load and all higher loads are removed. */
static void drop_of_mesh(eigen_side *side, const eigen_side *finer, int i)
{
    const double diverging = 2;
    const int is_there = i < finer->count && isfinite(finer->mu[i]);
    const double ratio = is_there ? side->mu[i] / finer->mu[i] : INFINITY;
    if (ratio < diverging)
        return;
    snprintf(side->reason, sizeof side->reason,
             "%.4g is an artefact of the mesh, whose nodes rotate without moving: %s with elements "
             "half as "
             "long",
             1 / side->mu[i], is_there ? "it is several times as large" : "it is not there");
    side->count = i;
}

static void judge_side(const analysis_context *c, int analysis, int positive, eigen_result *r)
{
    eigen_side *side = positive ? &r->positive : &r->negative;
    eigen_result finer = {0};
    for (int i = 0; i < side->count; i++) {
        if (!isfinite(side->mu[i]) || !only_turns(c, side, i))
            continue;
        if (finer.n == 0 && solve_halved(c, analysis, &finer, NULL) == STATUS_FAULT)
            break;
        drop_of_mesh(side, positive ? &finer.positive : &finer.negative, i);
    }
    eigen_free(&finer);
}

static status buckling_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    buckling b = {0};
    const status result = solve(c, analysis, &b, f);
    for (int positive = 0; positive < 2; positive++)
        judge_side(c, analysis, positive, &b.found);
    keep(&b.found.positive, &o->left.spectrum.positive);
    keep(&b.found.negative, &o->left.spectrum.negative);
    eigen_free(&b.found);
    buckling_free(&b);
    return result;
}
