/* Linear buckling about the undeformed state: (K + lambda G) x = 0 with G from the stresses of the
 * reference load. */
#include "harness/analysis/buckling.h"

#include "harness/algebra/eigen.h"
#include "harness/model/linear.h"
#include "harness/solver/context.h"
#include "harness/solver/linear_forms.h"
#include "harness/solver/linear_system.h"

static double stiffness_form(void *context, const double mode[])
{
    return linear_forms_stiffness(context, mode);
}

static double stiffness_rounding(void *context, const double mode[])
{
    return linear_forms_stiffness_rounding(context, mode);
}

static void stiffness_product(void *context, const double mode[], double y[])
{
    linear_forms_product(context, mode, y);
}

static double geometric_form(void *context, const double mode[])
{
    return linear_forms_geometric(context, mode);
}

static double geometric_rounding(void *context, const double mode[])
{
    return linear_forms_geometric_rounding(context, mode);
}

/* Moves the modes into the outcome, with lambda = 1/mu. */
static void keep(eigen_side *side, outcome_side *to)
{
    for (int i = 0; i < side->count; i++)
        side->mu[i] = 1 / side->mu[i];
    outcome_take(side, to);
}

/* How many eigenvalues of each sign the quantities ask for. */
static void wanted_of(const analysis_context *c, int analysis, eigen_problem *p)
{
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

/* The linear solution, its stresses and their geometric stiffness. */
static status prestress(analysis_context *c, linear_system *s, linear_forms *about, sparse *G,
                        fault *f)
{
    if (!s->K.symmetric)
        return fault_set(f, STATUS_REFUSED, "linear buckling needs a symmetric stiffness matrix");
    TRY(linear_forms_alloc(c->model, &s->K, about, f));
    TRY(linear_system_solve(c, s, about->load_x, f));
    TRY(linear_forms_load(about, f));
    TRY(sparse_alloc_like(&s->K, G, f));
    return linear_geometric_stiffness(c->model, about->sigma, G, f);
}

typedef struct buckling {
    linear_system system;
    linear_forms about;
    sparse G;
    eigen_result found;
} buckling;

/* With what buckling_analysis frees. */
static status solve(analysis_context *c, int analysis, buckling *b, fault *f)
{
    TRY(linear_system_alloc(c, &b->system, f));
    TRY(prestress(c, &b->system, &b->about, &b->G, f));
    eigen_problem p = {.K = &b->system.K,
                       .A = &b->G,
                       .K_factor = b->system.factor,
                       .sign = -1,
                       .K_energy = stiffness_form,
                       .A_energy = geometric_form,
                       .K_rounding = stiffness_rounding,
                       .A_rounding = geometric_rounding,
                       .K_product = stiffness_product,
                       .context = &b->about};
    wanted_of(c, analysis, &p);
    const status result = eigen_solve(&p, &b->found, f);
    model_counters(c->model)->solutions += b->found.solutions;
    model_counters(c->model)->factorisations += b->found.factorisations;
    return result;
}

status buckling_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    buckling b = {0};
    const status result = solve(c, analysis, &b, f);
    keep(&b.found.positive, &o->of.spectrum.positive);
    keep(&b.found.negative, &o->of.spectrum.negative);
    eigen_free(&b.found);
    linear_system_free(&b.system);
    sparse_free_values(&b.G);
    linear_forms_free(&b.about);
    return result;
}
