/* Quantities of a scene from the outcomes of its analyses. */
#include "harness/analysis/extract.h"

#include <math.h>
#include <string.h>

#include "cases/scene/names.h"
#include "cases/scene/quantity_type.h"
#include "harness/analysis/continuation_extract.h"
#include "harness/analysis/extract_path.h"
#include "harness/analysis/extract_section.h"
#include "harness/analysis/extract_spectrum.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

static const char *const no_frequency = "the mesh has no mode of this kind that is distinguishable "
                                        "from round-off: coordinates without mass, "
                                        "or with hardly any beside the heaviest, have none";

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

/* Has a node an angle of its own about this component? */
static int is_turned(const scene *s, int node, int component, fault *f)
{
    double axis[3];
    const int idle = component >= SCENE_RX ? scene_idle_turn(s, node, axis) : 0;
    if (idle == 0 || (idle == SCENE_IDLE_AXIS && fabs(axis[component - SCENE_RX]) <= 1e-9))
        return 1;
    fault_set(f, STATUS_REFUSED,
              "%s turns by itself, all members there release that: it has no angle; ask for that "
              "of a member's other end, or join one of them",
              scene_called(s, SCENE_NODES, node).text);
    return 0;
}

/* Is it defined where nodes turn by themselves? */
static int is_defined(const scene *s, const scene_quantity *q, fault *f)
{
    const quantity_type *type = quantity_type_of(q);
    scene_component one;
    for (int i = 0; type->turns != NULL && type->turns(s, q, i, &one); i++)
        if (!is_turned(s, one.node, one.component, f))
            return 0;
    return 1;
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
    fault f = {""};
    memset(r, 0, sizeof *r);
    if (!is_defined(c->scene, q, &f)) {
        quantity_no_value(r, STATUS_REFUSED, f.text);
        return;
    }
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
            quantity_no_value(r, o->status != STATUS_OK ? o->status : STATUS_NO_VALUE,
                              o->status != STATUS_OK ? o->reason : no_frequency);
        break;
    }
    if (r->status == STATUS_OK && !isfinite(r->value))
        quantity_no_value(r, STATUS_SINGULAR, "the value is not finite");
}
