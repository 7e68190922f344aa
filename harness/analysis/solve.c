#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/model/model.h"
#include "harness/time/time.h"

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

/* Returns 1 if the analysis failed before leaving the undeformed state. This does not apply to
 * motions, whose structure may be free, nor to harmonic analyses. */
static int is_stuck(const analysis_outcome *o)
{
    const int failed = o->status == STATUS_SINGULAR || o->status == STATUS_NOT_CONVERGED;
    return failed && o->kind != SCENE_MOTION && o->kind != SCENE_HARMONIC &&
           (!outcome_has_path(o) || outcome_path_of(o)->reached == 0);
}

static void advise_prestressed(const analysis_context *c, int analysis, fault *f)
{
    const scene_analysis *a = &c->scene->analysis[analysis];
    const int base = a->follows, is_linear = a->kind == SCENE_LINEAR || a->kind == SCENE_BUCKLING,
              of_linear = base != SCENE_NONE && c->scene->analysis[base].kind == SCENE_LINEAR;
    const size_t used = strlen(f->text);
    snprintf(f->text + used, sizeof f->text - used,
             "; if pretension or temperatures make the structure stiff, use %s",
             of_linear || (base == SCENE_NONE && is_linear)
                 ? "a static path, which includes that stiffness"
                 : "more elements or stations");
}

static void explain(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    fault why = {""};
    if (o->status == STATUS_SINGULAR && c->work->singular)
        singular_explain(c, f);
    else if (!is_stuck(o))
        return;
    else
        o->status = singular_mechanism(c, o->status, f);
    if (model_frees(c->model) && singular_mechanism(c, STATUS_OK, &why) != STATUS_OK)
        advise_prestressed(c, analysis, f);
}

/* Returns 1 if a step, starting with index `from`, has an indefinite tangent. */
static int has_negative(const solve_result *r, int from)
{
    for (int i = from; i < r->steps; i++)
        if (r->step[i].negative_pivots > 0)
            return 1;
    return 0;
}

/* Returns NOT_CONVERGED if a path failed, or has steps with an indefinite tangent, because the
 * stiffness of the structure at rest is indefinite. */
static status check_undeformed_state(analysis_context *c, const analysis_outcome *o, int first_step,
                                     fault *f)
{
    if (!outcome_has_path(o) || o->kind == SCENE_COMPLIANCE || o->kind == SCENE_MOTION ||
        o->kind == SCENE_HARMONIC ||
        (o->status == STATUS_OK && !has_negative(c->result, first_step)) ||
        newton_check_rest(c->model, NULL) != STATUS_OK)
        return o->status;
    fault why = {""};
    linear_system s = {0};
    const counters work = c->run->counters;
    const status at_rest = linear_system_alloc(c, &s, &why);
    linear_system_free(&s);
    c->run->counters = work;
    return at_rest == STATUS_NOT_CONVERGED ? fault_set(f, at_rest, "%s", why.text) : o->status;
}

/* Returns the failure of the linear analysis whose stresses the analysis includes. */
static status check_base(const analysis_context *c, int analysis, fault *f)
{
    const int base = c->scene->analysis[analysis].follows;
    const analysis_outcome *o = base != SCENE_NONE ? &c->outcomes[base] : NULL;
    if (o == NULL || o->kind != SCENE_LINEAR || o->status == STATUS_OK)
        return STATUS_OK;
    return fault_set(f, o->status, "the analysis of the base state failed: %.150s", o->reason);
}

/* Checks, before any analysis runs, that the model supports the motions and that the formulation
 * supports the damping. */
static status check_supported(const analysis_context *c, fault *f)
{
    int damps = 0;
    for (int i = 0; i < c->scene->analyses; i++) {
        const scene_analysis *a = &c->scene->analysis[i];
        const analysis_context own = context_of(c, i);
        if (!context_runs(c, i) || c->options->sample > 0)
            continue;
        damps |= a->kind == SCENE_MOTION || a->kind == SCENE_HARMONIC || a->damped;
        if (a->kind == SCENE_MOTION)
            TRY(motion_check(&own, i, f));
    }
    if (!damps)
        return STATUS_OK;
    const equations eq = {c->model, loading_of(c->model, 0), c->run};
    run_damping d;
    const status outcome = damping_begin(&eq, &d, f);
    damping_end(&eq, &d);
    return outcome;
}

/* Runs analyses. The first failure determines the overall status. perfect 0: analyses of the
 * imperfect structure; 1: analyses of the perfect structure; otherwise: all analyses. */
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
        o->status = stop_check(&f);
        if (o->status == STATUS_OK)
            o->status = scene_inputs_check(c->scene, i, &f);
        if (o->status == STATUS_OK)
            o->status = newton_check_rest(c->model, &f);
        if (o->status == STATUS_OK)
            o->status = check_base(c, i, &f);
        if (o->status == STATUS_OK)
            o->status = run(&own, i, o, &f);
        history_evaluate_steps(c->result, c->scene, i, first_step);
        if (a->kind == SCENE_ROTATION)
            rotation_evaluate_stations(&own, i, o);
        explain(&own, i, o, &f);
        o->status = check_undeformed_state(&own, o, first_step, &f);
        snprintf(o->reason, sizeof o->reason, "%s", f.text);
        if (o->status != STATUS_OK && c->result->status == STATUS_OK) {
            c->result->status = o->status;
            snprintf(c->result->reason, sizeof c->result->reason, "%s", f.text);
        }
    }
}

/* Gives the solution the status of a later stage that failed, unless the solution has failed
 * before. */
static void corrupt(solve_result *r, status outcome, const fault *f)
{
    if (outcome == STATUS_OK || r->status != STATUS_OK)
        return;
    r->status = outcome;
    snprintf(r->reason, sizeof r->reason, "%s", f->text);
}

static void keep_states(analysis_context *c)
{
    fault f = {""};
    solve_result *r = c->result;
    if (c->options->shapes > 0)
        corrupt(r, collect_shapes(c, c->options->shapes, &r->shapes, &f), &f);
    if (c->options->systems)
        corrupt(r, collect_systems(c, &r->systems, &f), &f);
}

/* Sets the value of an envelope of quantities to that of the governing quantity, and adds its
 * name. */
static void put_envelope(const scene *s, solve_result *r, int quantity)
{
    const scene_quantity *q = &s->quantity[quantity];
    quantity_result *to = &r->quantity[quantity];
    for (int i = 0; q->what.kind == SCENE_ENVELOPE_OF && i < q->overs; i++) {
        const quantity_result *one = &r->quantity[q->over[i]];
        const char *name = s->quantity[q->over[i]].name;
        if (one->status != STATUS_OK) {
            char why[FAULT_TEXT];
            snprintf(why, sizeof why, "%s has no value: %.250s", name, one->reason);
            quantity_no_value(to, one->status, why);
            return;
        }
        const double value = quantity_scaled(q, one->value);
        if (i > 0 && !quantity_governs(q->what.of.envelope, value, to->value))
            continue;
        to->value = value;
        to->rounding = one->rounding;
        snprintf(to->meaning, sizeof to->meaning, "%s%s%.60s", name,
                 one->meaning[0] != '\0' ? ", " : "", one->meaning);
    }
}

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
    to->negative_pivots =
        to->negative_pivots > more->negative_pivots ? to->negative_pivots : more->negative_pivots;
    to->condition = fmax(to->condition, more->condition);
}

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
    run_state_end(&p->run);
    model_free(p->m);
    model_imperfect_free(p->shape);
}

static status imperfect_begin(const analysis_context *c, imperfect *p, fault *f)
{
    const model_size size = model_sizes(c->model);
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    if (x == NULL)
        return fault_memory(f, "imperfections");
    status outcome = imperfection_of_modes(c, x, f);
    if (outcome == STATUS_OK)
        outcome = model_imperfect_alloc(c->model, x, &p->shape, f);
    free(x);
    TRY(outcome);
    TRY(model_imperfect_build(c->model, p->shape, &p->m, f));
    return run_state_begin(&p->run, p->m, c->options->threads, f);
}

/* Gives all analyses, or only those of the imperfect structure, a failure that excludes them. */
static void exclude(analysis_context *c, int perfect, status outcome, const fault *f)
{
    for (int i = 0; i < c->scene->analyses; i++) {
        analysis_outcome *o = &c->outcomes[i];
        if (!perfect && scene_is_perfect(c->scene, i))
            continue;
        o->kind = c->scene->analysis[i].kind;
        o->status = outcome;
        snprintf(o->reason, sizeof o->reason, "%s", f->text);
    }
    corrupt(c->result, outcome, f);
}

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
    exclude(c, 0, ready, &f);
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
    const numerics_work before = numerics_work_done();
    memset(result, 0, sizeof *result);
    TRY(run_state_begin(&run, m, c.options->threads, f));
    phases_request(&run.phases, c.options->phases);
    const double start = clock_processor_seconds();
    result->quantity = calloc((size_t)s->quantities + 1, sizeof *result->quantity);
    c.outcomes = calloc((size_t)s->analyses + 1, sizeof *c.outcomes);
    if (result->quantity == NULL || c.outcomes == NULL) {
        free(c.outcomes);
        run_state_end(&run);
        return fault_memory(f, "a solution");
    }
    result->quantities = s->quantities;
    fault unsupported = {""};
    const status supported = check_supported(&c, &unsupported);
    if (supported != STATUS_OK)
        exclude(&c, 1, supported, &unsupported);
    else if (s->imperfections > 0)
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
    result->counters = run.counters;
    result->counters.numerics = numerics_work_since(&before);
    keep_states(&c);
    for (int i = 0; i < s->analyses; i++)
        outcome_free(&c.outcomes[i]);
    free(c.outcomes);
    imperfect_free(&other);
    run_state_end(&run);
    if (result->status != STATUS_OK && f != NULL)
        snprintf(f->text, sizeof f->text, "%s", result->reason);
    return result->status;
}
