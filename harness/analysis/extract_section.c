#include "harness/analysis/extract_section.h"

#include <math.h>
#include <stdlib.h>

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/time.h"

/* Under the loads at path 1. */
static double reaction_of(const equations *eq, const scene_component *what, const double sigma[])
{
    const model *m = eq->m;
    double F[6], L[6];
    linearise_node_force(eq, kinematics_rest(m), sigma, what->node, F);
    loads_at_node(eq, kinematics_rest(m), 1, what->node, L);
    return F[what->component] - L[what->component];
}

void extract_section_linear(const analysis_context *c, const scene_quantity *q,
                            const analysis_outcome *o, quantity_result *r)
{
    double *sigma = calloc((size_t)model_stresses(c->model) + 1, sizeof *sigma), value;
    const internal_state at = {
        .s = kinematics_rest(c->model), .sigma = sigma, .x = outcome_displacements(o), .path = 1};
    fault f = {"out of memory for stresses"};
    status outcome = sigma != NULL ? linear_whole_stresses(&c->eq, at.x, sigma, &f) : STATUS_FAULT;
    if (outcome == STATUS_OK && q->what.kind == SCENE_REACTION)
        value = reaction_of(&c->eq, scene_component_of(q), sigma);
    else if (outcome == STATUS_OK)
        outcome = resultants_in_section(&c->eq, q, &at, &value, &f);
    if (outcome == STATUS_OK)
        r->value = quantity_scaled(q, value);
    else
        quantity_no_value(r, outcome, f.text);
    free(sigma);
}
