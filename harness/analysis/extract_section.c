#include "harness/analysis/extract_section.h"

#include <math.h>
#include <stdlib.h>

#include "harness/equations/linear.h"
#include "harness/model/kinematics.h"
#include "harness/motion/resultants.h"
#include "harness/solver/quantity.h"

void extract_section_linear(const analysis_context *c, const scene_quantity *q,
                            const analysis_outcome *o, quantity_result *r)
{
    const model_size size = model_sizes(c->model);
    double *sigma = calloc((size_t)size.elements * (size_t)size.strains + 1, sizeof *sigma), value;
    const internal_state at = {
        .s = kinematics_rest(c->model), .sigma = sigma, .x = outcome_displacements(o), .path = 1};
    fault f = {"out of memory for stresses"};
    status outcome = sigma != NULL ? linear_stresses(c->model, at.x, sigma, &f) : STATUS_FAULT;
    if (outcome == STATUS_OK)
        outcome = resultants_in_section(c->model, q, &at, &value, &f);
    if (outcome == STATUS_OK)
        r->value = quantity_scaled(q, value);
    else
        quantity_no_value(r, outcome, f.text);
    free(sigma);
}
