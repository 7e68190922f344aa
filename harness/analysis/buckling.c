/* Linear buckling about the undeformed state: (K + lambda G) x = 0 with G from the stresses of the
 * reference load. */
#include "harness/algebra/eigen.h"
#include "harness/analysis/analysis.h"
#include "harness/analysis/equilibrium.h"
#include "harness/analysis/linear_forms.h"

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
        if (q->kind != SCENE_CRITICAL_FACTOR || q->analysis != analysis)
            continue;
        int *side = q->sign > 0 ? &p->largest : &p->smallest;
        if (*side < q->order + 1)
            *side = q->order + 1;
    }
}

/* The linear solution, its stresses and their geometric stiffness. */
static status prestress(analysis_context *c, linear_system *s, linear_forms *about, sparse *G,
                        fault *f)
{
    if (!s->K.symmetric)
        return fault_set(f, STATUS_REFUSED, "linear buckling needs a symmetric stiffness matrix");
    status result = linear_forms_alloc(c->model, &s->K, about, f);
    if (result == STATUS_OK)
        result = linear_system_solve(c, s, about->load_x, f);
    if (result == STATUS_OK)
        result = linear_forms_load(about, f);
    if (result == STATUS_OK)
        result = sparse_alloc_like(&s->K, G, f);
    return result == STATUS_OK ? model_geometric_stiffness(c->model, about->sigma, G, f) : result;
}

status analysis_buckling(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    const int follows = c->scene->analysis[analysis].follows;
    if (follows != SCENE_NONE && c->scene->analysis[follows].kind == SCENE_STATIC)
        return equilibrium_buckling(c, analysis, o, f);
    linear_system s;
    linear_forms about = {0};
    sparse G = {0};
    eigen_result e = {0};
    status result = linear_system_alloc(c, &s, f);
    if (result == STATUS_OK)
        result = prestress(c, &s, &about, &G, f);
    if (result == STATUS_OK) {
        eigen_problem p = {.K = &s.K,
                           .A = &G,
                           .K_factor = s.factor,
                           .sign = -1,
                           .K_energy = stiffness_form,
                           .A_energy = geometric_form,
                           .K_rounding = stiffness_rounding,
                           .A_rounding = geometric_rounding,
                           .K_product = stiffness_product,
                           .context = &about};
        wanted_of(c, analysis, &p);
        result = eigen_solve(&p, &e, f);
        model_counters(c->model)->solutions += e.solutions;
        model_counters(c->model)->factorisations += e.factorisations;
    }
    keep(&e.positive, &o->positive);
    keep(&e.negative, &o->negative);
    eigen_free(&e);
    linear_system_free(&s);
    sparse_free_values(&G);
    linear_forms_free(&about);
    return result;
}
