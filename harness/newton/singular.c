#include "harness/newton/newton_impl.h"

#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"

status quadratic_forms_alloc(const equations *eq, const sparse *pattern, quadratic_forms *p,
                             fault *f)
{
    const model *m = eq->m;
    const model_size size = model_sizes(m);
    const size_t all = (size_t)(size.free + size.driven) + 1,
                 stresses = (size_t)model_stresses(m) + 1;
    double **const of_coordinates[] = {&p->load_x, &p->x, &p->force, &p->product},
                   **const of_stresses[] = {&p->sigma, &p->stress};
    int good = 1;
    memset(p, 0, sizeof *p);
    p->eq = eq;
    p->free = size.free;
    for (int i = 0; i < 4; i++)
        good &= (*of_coordinates[i] = calloc(all, sizeof(double))) != NULL;
    for (int i = 0; i < 2; i++)
        good &= (*of_stresses[i] = calloc(stresses, sizeof(double))) != NULL;
    return good ? sparse_alloc_like(pattern, &p->loads, f) : fault_memory(f, "prestress and modes");
}

void quadratic_forms_free(quadratic_forms *p)
{
    double *const all[] = {p->load_x, p->x, p->force, p->product, p->sigma, p->stress};
    for (int i = 0; i < 6; i++)
        free(all[i]);
    sparse_free_values(&p->loads);
    memset(p, 0, sizeof *p);
}

status quadratic_forms_load(const equations *eq, quadratic_forms *p, double path, int whole,
                            fault *f)
{
    rotating_frame_load_stiffness(eq, kinematics_rest(eq->m), path, &p->loads);
    return whole ? linear_whole_stresses(eq, p->load_x, path, p->sigma, f)
                 : linear_growing_stresses(eq, p->load_x, path, p->sigma, f);
}

static const double *all_of(quadratic_forms *p, const double x[])
{
    memcpy(p->x, x, (size_t)p->free * sizeof *x);
    return p->x;
}

double quadratic_forms_stiffness(quadratic_forms *p, const double x[])
{
    return linear_strain_energy2(p->eq, all_of(p, x));
}

double quadratic_forms_stiffness_rounding(quadratic_forms *p, const double x[])
{
    return linear_strain_rounding(p->eq, all_of(p, x));
}

double quadratic_forms_geometric(quadratic_forms *p, const double x[])
{
    sparse_mul(&p->loads, x, p->product);
    return linear_geometric_energy2(p->eq, p->sigma, all_of(p, x)) +
           dense_dot(p->free, x, p->product);
}

double quadratic_forms_geometric_rounding(quadratic_forms *p, const double x[])
{
    return linear_geometric_rounding(p->eq, p->load_x, p->sigma, all_of(p, x));
}

void quadratic_forms_product(quadratic_forms *p, const double x[], double y[])
{
    linear_stresses(p->eq, all_of(p, x), p->stress, NULL);
    linear_forces(p->eq, p->stress, p->force);
    memcpy(y, p->force, (size_t)p->free * sizeof *y);
}

/* Above this condition number, no digit of a solution is reliable, and a failure is attributed to
 * rounding. */
static const double no_digits = 1e15;

static void name_motion(const scene *s, int node, const double motion[6], double length, fault *f)
{
    const double *at = s->node[node].position;
    const double *shift = motion, *turn = motion + 3;
    const int turns = vec3_norm(turn) * length > 1e-6 * vec3_norm(shift);
    const double *v = turns ? turn : shift, size = vec3_norm(v);
    fault_set(f, STATUS_SINGULAR,
              "neither %s at (%.4g, %.4g, %.4g) nor any part joined to it is supported: it can %s "
              "(%.3g, %.3g, %.3g); prevent this motion",
              scene_called(s, SCENE_NODES, node).text, at[0], at[1], at[2],
              turns ? "turn about" : "move along", v[0] / size, v[1] / size, v[2] / size);
}

status singular_mechanism(const analysis_context *c, status otherwise, fault *f)
{
    int node, member;
    double motion[6];
    if (!linkage_mechanism(c->model, &node, &member, motion))
        return otherwise;
    const double *shift = motion, *turn = motion + 3,
                 turned = vec3_norm(turn) * model_length(c->model);
    const int turns = turned > 1e-6 * vec3_norm(shift);
    const double *v = turns ? turn : shift, size = vec3_norm(v);
    double axis[3];
    for (int i = 0; i < 3; i++)
        axis[i] = fabs(v[i]) > 1e-9 * size ? v[i] / size : 0;
    return fault_set(f, STATUS_SINGULAR,
                     "%s can %s (%.3g, %.3g, %.3g) without deformation: %s form a mechanism; join "
                     "one of them, prevent this motion, or drive it",
                     node >= 0 ? scene_called(c->scene, SCENE_NODES, node).text
                               : scene_called(c->scene, SCENE_MEMBERS, member).text,
                     turns ? "turn about" : "move along", axis[0], axis[1], axis[2],
                     model_releases(c->model) > 0 ? "the released ends"
                                                  : "parts joined by constraints");
}

/* Returns the ratio of the largest to the smallest stiffness of coordinates of K. */
static double spread(const model *m, const sparse *K)
{
    const model_size size = model_sizes(m);
    double *weight = malloc(((size_t)(size.free + size.driven) + 1) * sizeof *weight), largest = 0,
           least = INFINITY;
    if (weight == NULL)
        return 1;
    metric_of(m, weight);
    for (int j = 0; j < K->n; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++)
            if (K->row[k] == j && weight[j] > 0) {
                largest = fmax(largest, fabs(K->value[k]) / weight[j]);
                least = fmin(least, fabs(K->value[k]) / weight[j]);
            }
    free(weight);
    return largest > 0 ? largest / least : 1;
}

enum { LOST = 1, NO_NUMBER };

static int has_no_number(const sparse *K)
{
    int found = 0;
    for (int k = 0; K->value != NULL && k < K->column[K->n]; k++)
        found |= !isfinite(K->value[k]);
    return found;
}

/* Returns the condition number of the stiffness of an undeformed model; INFINITY: the stiffness
 * cannot be factored. *lost: LOST, all digits are lost to rounding; NO_NUMBER, entries are NaN or
 * Inf. */
static double condition_at_rest(const analysis_context *c, const equations *eq, int *lost)
{
    const counters work = eq->run->counters;
    context_work apart = {0};
    analysis_context one = {.scene = c->scene,
                            .model = eq->m,
                            .run = eq->run,
                            .eq = *eq,
                            .options = c->options,
                            .work = &apart};
    linear_system s;
    double condition = 1;
    const status outcome = linear_system_alloc(&one, &s, NULL);
    if (outcome == STATUS_OK)
        condition = factor_condition(s.factor, &s.K);
    else if (outcome == STATUS_SINGULAR)
        condition = INFINITY;
    *lost = outcome == STATUS_SINGULAR ||
            (outcome == STATUS_OK && !(condition * spread(eq->m, &s.K) <= no_digits));
    if (outcome != STATUS_OK && has_no_number(&s.K))
        *lost = NO_NUMBER;
    linear_system_free(&s);
    eq->run->counters = work;
    return condition;
}

/* Returns the condition number of the same scene with one element per member. *elements: number of
 * these elements. *lost: 1 if all digits are lost even on this mesh. */
static double condition_when_coarse(const analysis_context *c, int *elements, int *lost)
{
    model *coarse = NULL;
    run_state run = {0};
    double condition = 1;
    *elements = model_sizes(c->model).elements;
    *lost = 0;
    if (model_coarse(c->model, &coarse, NULL) == STATUS_OK &&
        run_state_begin(&run, coarse, 1, NULL) == STATUS_OK) {
        condition = condition_at_rest(c, &(equations){.m = coarse, .run = &run}, lost);
        *elements = model_sizes(coarse).elements;
    }
    run_state_end(&run);
    model_free(coarse);
    return condition;
}

static void explain_loss(const analysis_context *c, fault *f)
{
    const int elements = model_sizes(c->model).elements;
    int few, lost;
    const double coarse = condition_when_coarse(c, &few, &lost);
    if (lost)
        fault_set(
            f, STATUS_SINGULAR,
            "the stiffness matrix is lost in round-off, whatever the mesh: the stiffnesses "
            "differ too much, or a stiffness of a section is zero; correct sections and springs");
    else
        fault_set(
            f, STATUS_SINGULAR,
            "the stiffness matrix of %d elements is lost in round-off: the structure is supported, "
            "but a condition number of about %.0e leaves none of 16 digits; use fewer elements",
            elements, coarse * pow((double)elements / few, 4));
}

void singular_explain(analysis_context *c, fault *f)
{
    double motion[6];
    int node, lost;
    if (supports_loose_part(c->model, &node, motion)) {
        name_motion(c->scene, node, motion, model_length(c->model), f);
        return;
    }
    if (singular_mechanism(c, STATUS_OK, f) != STATUS_OK)
        return;
    condition_at_rest(c, &c->eq, &lost);
    if (lost == NO_NUMBER)
        fault_set(f, STATUS_SINGULAR,
                  "the formulation returned NaN or Inf; check its energy, stresses and derivatives "
                  "in the undeformed state");
    else if (lost)
        explain_loss(c, f);
    else
        fault_set(f, STATUS_SINGULAR,
                  "the stiffness matrix is singular, because the structure is at a critical point; "
                  "reduce the loads, or use a continuation");
}
