/* Quantities of a scene from the outcomes of its analyses. */
#include "harness/analysis/extract.h"

#include <math.h>
#include <string.h>

#include "harness/analysis/continuation_extract.h"
#include "harness/analysis/extract_path.h"
#include "harness/analysis/extract_section.h"
#include "harness/analysis/extract_spectrum.h"
#include "harness/model/kinematics.h"
#include "harness/solver/quantity.h"

static void from_linear(const analysis_context *c, const scene_quantity *q,
                        const analysis_outcome *o, quantity_result *r)
{
    const scene_component *what = scene_component_of(q);
    const double *x = outcome_displacements(o);
    int index[6];
    double T[36], sum = 0;
    const int n = kinematics_node_jacobian(c->model, NULL, what->node, 6, index, T);
    for (int k = 0; k < n; k++)
        sum += T[what->component * n + k] * x[index[k]];
    r->value = quantity_scaled(q, sum);
}

/* Did it leave something, though it failed? */
static int has_anything(const analysis_outcome *o)
{
    if (o->kind == SCENE_CONTINUATION && outcome_continuation_of(o)->points > 0)
        return 1;
    if (outcome_has_path(o))
        return outcome_path_of(o)->reached > 0;
    if (!outcome_has_spectrum(o))
        return 0;
    const outcome_side *positive = &outcome_spectrum_of(o)->positive,
                       *negative = &outcome_spectrum_of(o)->negative;
    return positive->count + negative->count > 0 || positive->status != STATUS_OK ||
           negative->status != STATUS_OK;
}

void extract_quantity(const analysis_context *c, const scene_quantity *q, quantity_result *r)
{
    const analysis_outcome *o = &c->outcomes[q->analysis];
    memset(r, 0, sizeof *r);
    if (o->status != STATUS_OK && !has_anything(o)) {
        quantity_no_value(r, o->status, o->reason);
        return;
    }
    switch (c->scene->analysis[q->analysis].kind) {
    case SCENE_LINEAR:
        if (q->what.kind == SCENE_COORDINATE)
            from_linear(c, q, o, r);
        else
            extract_section_linear(c, q, o, r);
        break;
    case SCENE_BUCKLING:
        extract_spectrum_buckling(q, o, r);
        break;
    case SCENE_MODAL:
        extract_spectrum_modal(c, q, o, r);
        break;
    case SCENE_CONTINUATION:
        if (!continuation_extract(c, q, o, r))
            extract_path(c, q, o, r);
        break;
    case SCENE_STATIC:
    case SCENE_COMPLIANCE:
    case SCENE_MOTION:
        extract_path(c, q, o, r);
        break;
    case SCENE_ROTATION:
        extract_path(c, q, o, r);
        if (outcome_rotation_of(o)->modes != NULL && isnan(r->value) && r->status == STATUS_OK)
            quantity_no_value(r, STATUS_NO_VALUE, "the mesh has no mode of this kind");
        break;
    }
    if (r->status == STATUS_OK && !isfinite(r->value))
        quantity_no_value(r, STATUS_SINGULAR, "the value is not finite");
}
