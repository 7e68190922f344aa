#include "harness/solver/singular.h"

#include <math.h>
#include <stdlib.h>

#include "elements/math/dense.h"
#include "harness/model/metric.h"
#include "harness/model/supports.h"
#include "harness/solver/context.h"
#include "harness/solver/linear_system.h"

/* Beyond this condition no digit is sure: what fails then fails by round-off. */
static const double no_digits = 1e15;

/* A rigid motion that the supports allow, in words. */
static void name_motion(int node, const double motion[6], double length, fault *f)
{
    const double *shift = motion, *turn = motion + 3;
    const int turns = vec3_norm(turn) * length > 1e-6 * vec3_norm(shift);
    const double *v = turns ? turn : shift, size = vec3_norm(v);
    fault_set(f, STATUS_SINGULAR,
              "node %d is not held, nor what it is joined to: it can %s (%.3g, %.3g, %.3g); hold "
              "it against that",
              node, turns ? "turn about" : "move along", v[0] / size, v[1] / size, v[2] / size);
}

/* How far apart the stiffnesses of K's coordinates are, displacements in units of the structure's
 * length: a structure that turns mixes them.  1 when memory ran out. */
static double spread(const model *m, const sparse *K)
{
    const model_size size = model_sizes(m);
    double *weight = malloc(((size_t)(size.free + size.driven) + 1) * sizeof *weight), largest = 0,
           least = INFINITY;
    if (weight == NULL)
        return 1;
    model_metric(m, weight);
    for (int j = 0; j < K->n; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++)
            if (K->row[k] == j && weight[j] > 0) {
                largest = fmax(largest, fabs(K->value[k]) / weight[j]);
                least = fmin(least, fabs(K->value[k]) / weight[j]);
            }
    free(weight);
    return largest > 0 ? largest / least : 1;
}

/* 1: the stiffness of a model at rest has no digits to spare. */
static int is_lost_at_rest(const analysis_context *c, model *m)
{
    const counters work = *model_counters(m);
    analysis_context one = {.scene = c->scene, .model = m, .options = c->options};
    linear_system s;
    const status outcome = linear_system_alloc(&one, &s, NULL);
    const int lost = outcome == STATUS_SINGULAR ||
                     (outcome == STATUS_OK &&
                      !(factor_condition(s.factor, &s.K) * spread(m, &s.K) <= no_digits));
    linear_system_free(&s);
    *model_counters(m) = work;
    return lost;
}

/* 1: so is that of the same scene with one element per member. */
static int is_lost_when_coarse(const analysis_context *c)
{
    model *coarse = NULL;
    const int lost =
        model_coarse(c->model, &coarse, NULL) == STATUS_OK && is_lost_at_rest(c, coarse);
    model_free(coarse);
    return lost;
}

void singular_explain(analysis_context *c, fault *f)
{
    double motion[6];
    int node;
    const int elements = model_sizes(c->model).elements;
    if (model_loose_part(c->model, &node, motion))
        name_motion(node, motion, model_length(c->model), f);
    else if (!is_lost_at_rest(c, c->model))
        fault_set(f, STATUS_SINGULAR,
                  "the stiffness matrix is singular: the structure is at a critical point");
    else if (is_lost_when_coarse(c))
        fault_set(f, STATUS_SINGULAR,
                  "the stiffness matrix is lost in round-off, whatever the mesh: its stiffnesses "
                  "are too far apart, or one of a "
                  "section is zero");
    else
        fault_set(f, STATUS_SINGULAR,
                  "the stiffness matrix of %d elements is lost in round-off: everything is held; "
                  "use fewer elements",
                  elements);
}
