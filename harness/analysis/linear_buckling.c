#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/model/model.h"

/* Linear statics about the undeformed state: one factorisation, and one right-hand side for each
 * load case or combination that a quantity needs. Each right-hand side contains the initial strains
 * of members once, so the solution of a combination is not the sum of the solutions of its load
 * cases. */

/* Returns 1 if a quantity of the analysis needs this load case or combination. Also returns 1 if no
 * quantity needs any of them, because all are then computed. */
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
        return fault_memory(f, "load cases");
    for (int number = 1; all && number <= most; number++)
        if (is_read(s, analysis, number))
            l->acting[l->solutions++] = number;
    if (!all)
        l->acting[l->solutions++] = c->eq.loading.acting;
    l->x = calloc((size_t)l->solutions * l->coordinates + 1, sizeof *l->x);
    return l->x != NULL ? STATUS_OK : fault_memory(f, "a linear solution");
}

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

status linear_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    linear_system s = {0};
    const status result = displace(c, analysis, &s, &o->left.linear, f);
    linear_system_free(&s);
    return result;
}

/* Linear buckling about the undeformed state: (K + G_0 + lambda G) x = 0. G follows from the
 * stresses due to the change of loads from path 0 to 1. G_0 follows from the stresses at path 0,
 * which are constant and include initial strains. */

/* Quadratic forms for the stresses due to loads that are scaled by the load factor (growing), and
 * for the stresses due to constant loads (constant_part). */
typedef struct prestresses {
    quadratic_forms growing, constant_part;
    int has_constant;      /* 0: no constant stress */
    sparse G, of_constant; /* geometric stiffness of the growing and of the constant stresses */
    double *product;       /* [free] */
} prestresses;

static double stiffness_form(void *context, const double mode[])
{
    prestresses *p = context;
    const double K = quadratic_forms_stiffness(&p->growing, mode);
    return p->has_constant ? K + quadratic_forms_geometric(&p->constant_part, mode) : K;
}

static double stiffness_rounding(void *context, const double mode[])
{
    prestresses *p = context;
    const double K = quadratic_forms_stiffness_rounding(&p->growing, mode);
    return p->has_constant ? K + quadratic_forms_geometric_rounding(&p->constant_part, mode) : K;
}

static void stiffness_product(void *context, const double mode[], double y[])
{
    prestresses *p = context;
    quadratic_forms_product(&p->growing, mode, y);
    if (!p->has_constant)
        return;
    sparse_mul(&p->of_constant, mode, p->product);
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

/* Sets the number of eigenvalues of each sign that the quantities and imperfections request. */
static void wanted_of(const analysis_context *c, int analysis, eigen_problem *p)
{
    p->largest = imperfection_modes(c->scene, analysis);
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if (!scene_requests(q, analysis, SCENE_CRITICAL_FACTOR))
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

/* Adds G of the constant stresses to K. The structure must be stable under these stresses. Only the
 * remaining stresses grow. */
static status split_constant(analysis_context *c, linear_system *s, prestresses *p, fault *f)
{
    const model_size size = model_sizes(c->model);
    p->has_constant = 1;
    p->product = calloc((size_t)size.free + 1, sizeof *p->product);
    if (p->product == NULL)
        return fault_memory(f, "constant loads");
    TRY(quadratic_forms_alloc(&c->eq, &s->K, &p->constant_part, f));
    TRY(linear_system_solve(c, s, 0, p->constant_part.load_x, f));
    TRY(quadratic_forms_load(&c->eq, &p->constant_part, 0, 1, f));
    TRY(sparse_alloc_like(&s->K, &p->of_constant, f));
    TRY(linear_geometric_stiffness(&c->eq, p->constant_part.sigma, 0, &p->of_constant, f));
    for (int i = 0; i < size.free + size.driven; i++)
        p->growing.load_x[i] -= p->constant_part.load_x[i];
    for (int i = 0; i < s->K.column[s->K.n]; i++)
        s->K.value[i] += p->of_constant.value[i];
    c->run->counters.factorisations++;
    const status factored = context_factor(c, s->factor, &s->K, f);
    if (factored == STATUS_SINGULAR ||
        (factored == STATUS_OK && factor_count(s->factor).negative_pivots > 0))
        return fault_set(f, STATUS_REFUSED,
                         "%s, which are constant, are critical even without the scaled loads; "
                         "reduce the constant loads or strains",
                         linear_initial(c->model) == 0 ? "the loads at path 0"
                         : !loads_begin(&c->eq)        ? "the strains of members"
                                                : "the loads at path 0 and strains of members");
    return factored;
}

static status prestress(analysis_context *c, linear_system *s, prestresses *p, fault *f)
{
    if (!s->K.symmetric)
        return fault_set(f, STATUS_REFUSED,
                         "linear buckling requires a symmetric stiffness matrix; request the "
                         "critical load about a static path");
    TRY(along_path_proportional(c->scene, c->eq.loading.acting, f));
    TRY(quadratic_forms_alloc(&c->eq, &s->K, &p->growing, f));
    TRY(linear_system_solve(c, s, 1, p->growing.load_x, f));
    if (loads_begin(&c->eq) || linear_initial(c->model) > 0)
        TRY(split_constant(c, s, p, f));
    TRY(quadratic_forms_load(&c->eq, &p->growing, 1, 0, f));
    TRY(sparse_alloc_like(&s->K, &p->G, f));
    TRY(linear_geometric_stiffness(&c->eq, p->growing.sigma, 1, &p->G, f));
    if (p->has_constant) {
        subtract(&p->constant_part.loads, &p->G);
        subtract(&p->constant_part.loads, &p->growing.loads);
    }
    return STATUS_OK;
}

typedef struct buckling {
    linear_system system;
    prestresses of;
    eigen_result found;
} buckling;

static void buckling_free(buckling *b)
{
    linear_system_free(&b->system);
    sparse_free_values(&b->of.G);
    sparse_free_values(&b->of.of_constant);
    quadratic_forms_free(&b->of.growing);
    quadratic_forms_free(&b->of.constant_part);
    free(b->of.product);
}

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

/* Returns 1 if the nodes of mode i rotate but are not displaced. Only then can the critical load
 * depend on the element length, because elements buckle locally. */
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

static status solve_halved(const analysis_context *c, int analysis, eigen_result *found, fault *f)
{
    model *halved = NULL;
    run_state run = {0};
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
 * a property of the structure: elements without shear flexibility buckle individually (12 EI/l^2
 * acts as GA). This load and all higher loads are removed. */
static void drop_of_mesh(eigen_side *side, const eigen_side *finer, int i)
{
    const double diverging = 2;
    const int is_there = i < finer->count && isfinite(finer->mu[i]);
    const double ratio = is_there ? side->mu[i] / finer->mu[i] : INFINITY;
    if (ratio < diverging)
        return;
    snprintf(side->reason, sizeof side->reason,
             "%.4g is an artefact of the mesh, whose nodes rotate without translation: %s with "
             "elements half as long; use more elements",
             1 / side->mu[i], is_there ? "it is several times as large" : "it does not occur");
    side->count = i;
}

static void evaluate_side(const analysis_context *c, int analysis, int positive, eigen_result *r)
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

status buckling_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    buckling b = {0};
    const status result = solve(c, analysis, &b, f);
    for (int positive = 0; positive < 2; positive++)
        evaluate_side(c, analysis, positive, &b.found);
    keep(&b.found.positive, &o->left.spectrum.positive);
    keep(&b.found.negative, &o->left.spectrum.negative);
    eigen_free(&b.found);
    buckling_free(&b);
    return result;
}
