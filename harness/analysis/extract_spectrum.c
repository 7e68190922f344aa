#include "harness/analysis/extract_spectrum.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/newton/newton.h"

/* Value i of a side, or why it has none. */
static void take_eigenvalue(const scene_quantity *q, const outcome_side *side, int i, double unit,
                            quantity_result *r)
{
    if (isnan(side->value[i])) {
        quantity_no_value(r, side->status, side->reason);
        return;
    }
    r->value = quantity_scaled(q, side->value[i] / unit);
    r->rounding = side->error != NULL ? side->error[i] : 0;
}

static void take_meaning(const outcome_spectrum *from, quantity_result *r)
{
    if (r->status == STATUS_OK)
        memcpy(r->meaning, from->meaning, sizeof r->meaning);
}

void extract_spectrum_buckling(const scene_quantity *q, const analysis_outcome *o,
                               quantity_result *r)
{
    const scene_critical_load *load = scene_critical_load_of(q);
    const outcome_spectrum *found = outcome_spectrum_of(o);
    const outcome_side *side = load->sign > 0 ? &found->positive : &found->negative;
    const char *sign = load->sign > 0 ? "positive" : "negative";
    char why[FAULT_TEXT];
    if (load->order < side->count) {
        take_eigenvalue(q, side, load->order, 1, r);
        take_meaning(found, r);
        return;
    }
    if (side->status != STATUS_OK)
        snprintf(why, sizeof why, "%s", side->reason);
    else if (side->reason[0] != '\0')
        snprintf(why, sizeof why, "no %s load%s: %.250s", sign,
                 side->count > 0 ? " of this order" : "", side->reason);
    else
        snprintf(why, sizeof why, "no %s critical load of this order", sign);
    quantity_no_value(r, side->status, why);
}

/* *found: the mode of the kind and order that is asked for; -1: there is none. x[free + driven] is
 * work space. */
static status find_mode(const analysis_context *c, const scene_mode *wanted,
                        const outcome_side *side, double x[], int *found, fault *f)
{
    const size_t n = (size_t)model_sizes(c->model).free;
    int order = 0;
    *found = -1;
    for (int i = 0; i < side->count; i++) {
        mode_shape shape;
        memcpy(x, side->mode + (size_t)i * n, n * sizeof *x);
        TRY(modes_identify(c->model, c->scene, x, &shape, f));
        if (modes_in_family(wanted, &shape) && order++ == wanted->order) {
            *found = i;
            return STATUS_OK;
        }
    }
    return STATUS_OK;
}

void extract_spectrum_modal(const analysis_context *c, const scene_quantity *q,
                            const analysis_outcome *o, quantity_result *r)
{
    const model_size size = model_sizes(c->model);
    const outcome_side *side = &outcome_spectrum_of(o)->positive;
    fault f = {"out of memory for a mode"};
    int found = -1;
    if (q->what.kind == SCENE_GROWTH) {
        r->value = quantity_scaled(q, outcome_spectrum_of(o)->growth);
        take_meaning(outcome_spectrum_of(o), r);
        return;
    }
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    const status known =
        x != NULL ? find_mode(c, scene_mode_of(q), side, x, &found, &f) : STATUS_FAULT;
    free(x);
    if (known != STATUS_OK)
        quantity_no_value(r, known, f.text);
    else if (found >= 0)
        take_eigenvalue(q, side, found, 2 * PI, r);
    else if (side->status != STATUS_OK)
        quantity_no_value(r, side->status, side->reason);
    else
        quantity_no_value(r, STATUS_NO_VALUE, "the mesh has no mode of this kind");
    take_meaning(outcome_spectrum_of(o), r);
}
