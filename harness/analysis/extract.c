/* Quantities of a scene from the outcomes of its analyses. */
#include "harness/analysis/extract.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/analysis/continuation_extract.h"
#include "harness/equations/internal.h"
#include "harness/equations/linear.h"
#include "harness/equations/linearise.h"
#include "harness/equations/loads.h"
#include "harness/model/kinematics.h"
#include "harness/solver/context.h"
#include "harness/solver/modes.h"
#include "harness/solver/quantity.h"

static const double TURN = 2 * PI; /* rad */

/* [Hz]; NAN: no mode of this kind. */
static double frequency_of(const scene_quantity *q, const rotation_modes *modes)
{
    int order = 0;
    for (int i = 0; i < modes->count; i++)
        if (modes->growth[i] == 0 && modes_in_family(scene_mode_of(q), &modes->shape[i]) &&
            order++ == scene_mode_of(q)->order)
            return modes->frequency[i] / TURN;
    return NAN;
}

/* [1/s]; NAN: there are no modes. */
static double growth_of(const rotation_modes *modes)
{
    double largest = 0;
    for (int i = 0; i < modes->count; i++)
        largest = fmax(largest, modes->growth[i]);
    return modes->count > 0 ? largest : NAN;
}

static double reaction_of(const analysis_context *c, const scene_component *what,
                          const model_state *s)
{
    double F[6], L[6];
    linearise_node_force(c->model, s, what->node, F);
    loads_at_node(c->model, s, what->node, L);
    return F[what->component] - L[what->component];
}

/* NULL: no quantity asked for them. */
static const rotation_modes *modes_at(const analysis_outcome *o, int i)
{
    rotation_modes *const modes = outcome_rotation_of(o)->modes;
    return modes != NULL ? &modes[i] : NULL;
}

static double internal_of(const analysis_context *c, const scene_internal *what,
                          const model_state *s, const double sigma[], double path)
{
    double all[SCENE_BIMOMENT + 1];
    internal_at_end(c->model, s, sigma, path, what->member, what->end, all);
    return all[what->resultant];
}

/* Value of a quantity of the path at one station. */
static double extracted(const analysis_context *c, const scene_quantity *q,
                        const analysis_outcome *o, int i)
{
    const outcome_path *path = outcome_path_of(o);
    switch (q->what.kind) {
    case SCENE_COORDINATE:
        return kinematics_component(c->model, path->state[i], scene_component_of(q)->node,
                                    scene_component_of(q)->component);
    case SCENE_REACTION:
        return reaction_of(c, scene_component_of(q), path->state[i]);
    case SCENE_COMPLIANCE_ENTRY:
        return outcome_compliance_of(o)
            ->matrix[36 * i + 6 * scene_entry_of(q)->row + scene_entry_of(q)->column];
    case SCENE_STIFFNESS_ENTRY:
        return 1 / outcome_compliance_of(o)->matrix[36 * i + 7 * scene_entry_of(q)->row];
    case SCENE_DRIVER_VALUE:
        return kinematics_driver_value(c->model, path->state[i], scene_driver_of(q));
    case SCENE_FREQUENCY:
        return modes_at(o, i) != NULL ? frequency_of(q, modes_at(o, i)) : NAN;
    case SCENE_GROWTH:
        return modes_at(o, i) != NULL ? growth_of(modes_at(o, i)) : NAN;
    case SCENE_FACTOR_AT:
        return kinematics_state_path(path->state[i]);
    case SCENE_INTERNAL:
        return internal_of(c, scene_internal_of(q), path->state[i], NULL,
                           kinematics_state_path(path->state[i]));
    case SCENE_CRITICAL_FACTOR:
    case SCENE_CRITICAL_POINT:
        break;
    }
    return NAN;
}

static double at_station(const analysis_context *c, const scene_quantity *q,
                         const analysis_outcome *o, int i)
{
    return quantity_scaled(q, extracted(c, q, o, i));
}

static double abscissa(const scene_quantity *q, const outcome_path *p, int i)
{
    return p->value[i] * q->x.factor + q->x.offset;
}

static void take_curve(const analysis_context *c, const scene_quantity *q,
                       const analysis_outcome *o, quantity_result *r)
{
    const outcome_path *p = outcome_path_of(o);
    r->curve.x = calloc((size_t)p->reached + 1, sizeof(double));
    r->curve.value = calloc((size_t)p->reached + 1, sizeof(double));
    if (r->curve.x == NULL || r->curve.value == NULL) {
        quantity_no_value(r, STATUS_FAULT, "out of memory");
        return;
    }
    r->curve.points = p->reached;
    for (int i = 0; i < p->reached; i++) {
        r->curve.x[i] = abscissa(q, p, i);
        r->curve.value[i] = at_station(c, q, o, i);
    }
    r->value = p->reached > 0 ? r->curve.value[p->reached - 1] : NAN;
}

/* Why a path ends before a station: the reason of the analysis that is followed. */
static const char *reason_of_path(const analysis_context *c, const scene_quantity *q)
{
    const int follows = c->scene->analysis[q->analysis].follows;
    return follows != SCENE_NONE && c->outcomes[follows].status != STATUS_OK
               ? c->outcomes[follows].reason
               : "the path does not reach this station";
}

static void path_ends(const analysis_context *c, const scene_quantity *q, const analysis_outcome *o,
                      quantity_result *r)
{
    if (o->status != STATUS_OK)
        quantity_no_value(r, o->status, o->reason);
    else
        quantity_no_value(r, STATUS_NOT_CONVERGED, reason_of_path(c, q));
}

static void from_path(const analysis_context *c, const scene_quantity *q, const analysis_outcome *o,
                      quantity_result *r)
{
    const outcome_path *p = outcome_path_of(o);
    const int complete = p->reached == p->stations;
    int chosen = -1;
    for (int i = 0; i < p->reached; i++) {
        const double value =
            q->reduction == SCENE_MAX || q->reduction == SCENE_MIN ? at_station(c, q, o, i) : 0;
        const int better = q->reduction == SCENE_MAX ? value > r->value : value < r->value;
        const int here = q->reduction == SCENE_AT
                             ? fabs(p->value[i] - q->at) <= 1e-12 * fmax(1, fabs(q->at))
                             : i == p->stations - 1;
        if ((q->reduction == SCENE_MAX || q->reduction == SCENE_MIN) ? chosen < 0 || better
                                                                     : here) {
            chosen = i;
            r->value = value;
        }
    }
    if (q->reduction == SCENE_CURVE) {
        take_curve(c, q, o, r);
        if (!complete)
            path_ends(c, q, o, r);
        return;
    }
    if (chosen < 0 || (q->reduction != SCENE_AT && !complete)) {
        path_ends(c, q, o, r);
        return;
    }
    r->value = at_station(c, q, o, chosen);
    r->x = abscissa(q, p, chosen);
}

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

static void from_buckling(const scene_quantity *q, const analysis_outcome *o, quantity_result *r)
{
    const scene_critical_load *load = scene_critical_load_of(q);
    const outcome_spectrum *found = outcome_spectrum_of(o);
    const outcome_side *side = load->sign > 0 ? &found->positive : &found->negative;
    const char *sign = load->sign > 0 ? "positive" : "negative";
    char why[FAULT_TEXT];
    if (load->order < side->count) {
        take_eigenvalue(q, side, load->order, 1, r);
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

static void from_modes(const analysis_context *c, const scene_quantity *q,
                       const analysis_outcome *o, quantity_result *r)
{
    const model_size size = model_sizes(c->model);
    const outcome_side *side = &outcome_spectrum_of(o)->positive;
    fault f = {"out of memory for a mode"};
    int found = -1;
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    const status known =
        x != NULL ? find_mode(c, scene_mode_of(q), side, x, &found, &f) : STATUS_FAULT;
    free(x);
    if (known != STATUS_OK)
        quantity_no_value(r, known, f.text);
    else if (found >= 0)
        take_eigenvalue(q, side, found, TURN, r);
    else if (side->status != STATUS_OK)
        quantity_no_value(r, side->status, side->reason);
    else
        quantity_no_value(r, STATUS_NO_VALUE, "the mesh has no mode of this kind");
}

/* At full load, about the undeformed state. */
static void internal_of_linear(const analysis_context *c, const scene_quantity *q,
                               const analysis_outcome *o, quantity_result *r)
{
    const model_size size = model_sizes(c->model);
    double *sigma = calloc((size_t)size.elements * (size_t)size.strains + 1, sizeof *sigma);
    fault f = {"out of memory for stresses"};
    const status known = sigma != NULL
                             ? linear_stresses(c->model, outcome_displacements(o), sigma, &f)
                             : STATUS_FAULT;
    if (known != STATUS_OK)
        quantity_no_value(r, known, f.text);
    else
        r->value = quantity_scaled(
            q, internal_of(c, scene_internal_of(q), kinematics_rest(c->model), sigma, 1));
    free(sigma);
}

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
        if (q->what.kind == SCENE_INTERNAL)
            internal_of_linear(c, q, o, r);
        else
            from_linear(c, q, o, r);
        break;
    case SCENE_BUCKLING:
        from_buckling(q, o, r);
        break;
    case SCENE_MODAL:
        from_modes(c, q, o, r);
        break;
    case SCENE_CONTINUATION:
        if (!continuation_extract(c, q, o, r))
            from_path(c, q, o, r);
        break;
    case SCENE_STATIC:
    case SCENE_COMPLIANCE:
        from_path(c, q, o, r);
        break;
    case SCENE_ROTATION:
        from_path(c, q, o, r);
        if (outcome_rotation_of(o)->modes != NULL && isnan(r->value) && r->status == STATUS_OK)
            quantity_no_value(r, STATUS_NO_VALUE, "the mesh has no mode of this kind");
        break;
    }
    if (r->status == STATUS_OK && !isfinite(r->value))
        quantity_no_value(r, STATUS_SINGULAR, "the value is not finite");
}
