#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/model/model.h"
#include "harness/time/time.h"

static void extract_spectrum_buckling(const analysis_context *, const scene_quantity *,
                                      const analysis_outcome *, quantity_result *);
static void extract_spectrum_modal(const analysis_context *, const scene_quantity *,
                                   analysis_outcome *, quantity_result *);

static const char *const no_frequency =
    "the mesh has no mode of this kind that is distinguishable from round-off; use more elements, "
    "or add mass to coordinates that have little or none";

/* Returns 1 if this component of the node is defined. A rotation is undefined if all members at the
 * node release it. */
static int is_turned(const scene *s, int node, int component, fault *f)
{
    double axis[3];
    const int idle = component >= SCENE_RX ? scene_idle_turn(s, node, axis) : 0;
    if (idle == 0 || (idle == SCENE_IDLE_AXIS && fabs(axis[component - SCENE_RX]) <= 1e-9))
        return 1;
    fault_set(
        f, STATUS_REFUSED,
        "%s can rotate freely, because all members there release this rotation, so its angle is "
        "undefined; request the angle of the other end of a member, or join one of the members",
        scene_called(s, SCENE_NODES, node).text);
    return 0;
}

static int is_defined(const scene *s, const scene_quantity *q, fault *f)
{
    const quantity_type *type = quantity_type_of(q);
    scene_component one;
    for (int i = 0; type->turns != NULL && type->turns(s, q, i, &one); i++)
        if (!is_turned(s, one.node, one.component, f))
            return 0;
    return 1;
}

/* Returns 0 if the quantity requires a strain energy that the formulation does not have. */
static int has_energy(const analysis_context *c, const scene_quantity *q, fault *f)
{
    const int of = q->what.kind == SCENE_BALANCE ? (int)q->what.of.balance : SCENE_KINETIC;
    if (!model_absolute(c->model) ||
        (of != SCENE_STRAIN && of != SCENE_ENERGY && of != SCENE_DRIFT))
        return 1;
    fault_set(f, STATUS_REFUSED,
              "forces with a history need not derive from an energy, so %s has no strain energy; "
              "remove this quantity, or use another formulation",
              model_formulation(c->model));
    return 0;
}

static void under_one(const analysis_context *c, const scene_quantity *q, const analysis_outcome *o,
                      int acting, quantity_result *r)
{
    const analysis_context own = context_under(c, acting);
    double *sigma = calloc((size_t)model_stresses(c->model) + 1, sizeof *sigma), value = NAN;
    const reading from = {.eq = &own.eq,
                          .state = kinematics_rest(c->model),
                          .x = outcome_displacements(o, acting),
                          .sigma = sigma};
    fault f = {"out of memory for stresses"};
    status outcome = sigma != NULL ? STATUS_OK : STATUS_FAULT;
    if (outcome == STATUS_OK && from.x == NULL)
        outcome =
            fault_set(&f, STATUS_FAULT, "%s was not solved",
                      acting != 0 ? scene_acting_called(c->scene, acting).text : "the analysis");
    if (outcome == STATUS_OK && scene_reads_forces(q))
        outcome = linear_whole_stresses(&own.eq, from.x, 1, sigma, &f);
    if (outcome == STATUS_OK)
        outcome = reading_whole(&from, q, &value, &f);
    if (outcome == STATUS_OK)
        r->value = quantity_scaled(q, value);
    else
        quantity_no_value(r, outcome, f.text);
    free(sigma);
}

static void from_envelope(const analysis_context *c, const scene_quantity *q,
                          const analysis_outcome *o, quantity_result *r)
{
    quantity_result best = {.status = STATUS_OK};
    int acting;
    for (int i = 0; (acting = scene_acting_in(c->scene, q, i)) != 0; i++) {
        quantity_result one = {.status = STATUS_OK};
        under_one(c, q, o, acting, &one);
        if (one.status == STATUS_OK && i > 0 &&
            !quantity_governs(q->envelope, one.value, best.value))
            continue;
        best = one;
        snprintf(best.meaning, sizeof best.meaning, "%s",
                 scene_acting_called(c->scene, acting).text);
        if (one.status != STATUS_OK)
            break;
    }
    *r = best;
}

static void from_linear(const analysis_context *c, const scene_quantity *q,
                        const analysis_outcome *o, quantity_result *r)
{
    if (q->envelope != SCENE_ENVELOPE_NONE)
        from_envelope(c, q, o, r);
    else
        under_one(c, q, o,
                  scene_solves_all(c->scene, q->analysis) ? scene_acting_in(c->scene, q, 0)
                                                          : c->eq.loading.acting,
                  r);
}

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
    analysis_outcome *o = &c->outcomes[q->analysis];
    fault f = {""};
    memset(r, 0, sizeof *r);
    if (q->what.kind == SCENE_ENVELOPE_OF)
        return;
    if (!is_defined(c->scene, q, &f) || !has_energy(c, q, &f)) {
        quantity_no_value(r, STATUS_REFUSED, f.text);
        return;
    }
    if (o->status != STATUS_OK && !has_anything(o)) {
        quantity_no_value(r, o->status, o->reason);
        return;
    }
    if (o->kind == SCENE_MOTION && outcome_motion_of(o)->undefined != NULL &&
        outcome_motion_of(o)->undefined[q - c->scene->quantity]) {
        quantity_no_value(r, motion_undefined(c->scene, q, &f), f.text);
        return;
    }
    switch (c->scene->analysis[q->analysis].kind) {
    case SCENE_LINEAR:
        from_linear(c, q, o, r);
        break;
    case SCENE_BUCKLING:
        extract_spectrum_buckling(c, q, o, r);
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
    case SCENE_HARMONIC:
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
        quantity_no_value(r, STATUS_SINGULAR,
                          "the value is NaN or Inf; check stiffnesses, loads and units");
}

static void take_eigenvalue(const scene_quantity *q, const outcome_side *side, int i,
                            quantity_result *r)
{
    const quantity_eigenvalue found = {side->value[i], side->growth != NULL ? -side->growth[i] : 0};
    const double size = hypot(found.decay, found.value);
    const double undamped = 1e-4;
    double part;
    if (isnan(found.value)) {
        quantity_no_value(r, side->status, side->reason);
        return;
    }
    r->value = quantity_scaled(q, quantity_type_of(q)->eigenvalue(q, &found, &part));
    r->rounding = side->error != NULL ? side->error[i] : 0;
    if (side->growth != NULL && part == 0 && found.decay == 0 && r->rounding > undamped)
        quantity_no_value(r, STATUS_NOT_CONVERGED,
                          "the damping is lost in round-off; use fewer elements");
    if (side->growth != NULL)
        r->rounding = part != 0 ? r->rounding * size / fabs(part) : 0;
}

static void take_meaning(const outcome_spectrum *from, quantity_result *r)
{
    if (r->status == STATUS_OK)
        memcpy(r->meaning, from->meaning, sizeof r->meaning);
}

/* Adds the kind of buckling mode i to the meaning of the result. Does nothing in a plane, or about
 * a loaded state. */
static void name_kind(const analysis_context *c, const scene_quantity *q, const outcome_side *side,
                      int i, quantity_result *r)
{
    const model_size size = model_sizes(c->model);
    const double equal = 1e-8, *value = side->value;
    const char *kind = NULL;
    fault f;
    if (side->mode == NULL || r->status != STATUS_OK || c->scene->plane != SCENE_SPACE ||
        c->scene->analysis[q->analysis].follows != SCENE_NONE)
        return;
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    if (x == NULL)
        return;
    memcpy(x, side->mode + (size_t)i * (size_t)size.free, (size_t)size.free * sizeof *x);
    const status known = modes_kind(c->model, c->scene, x, &kind, &f);
    free(x);
    if (known != STATUS_OK)
        return;
    const int twice =
        (i > 0 && fabs(value[i] - value[i - 1]) <= equal * fabs(value[i])) ||
        (i + 1 < side->count && fabs(value[i + 1] - value[i]) <= equal * fabs(value[i]));
    const size_t used = strlen(r->meaning);
    snprintf(r->meaning + used, sizeof r->meaning - used, "%s%s%s", used > 0 ? ", " : "", kind,
             twice ? ", double" : "");
}

static void extract_spectrum_buckling(const analysis_context *c, const scene_quantity *q,
                                      const analysis_outcome *o, quantity_result *r)
{
    const scene_critical_load *load = scene_critical_load_of(q);
    const outcome_spectrum *found = outcome_spectrum_of(o);
    const outcome_side *side = load->sign > 0 ? &found->positive : &found->negative;
    const char *sign = load->sign > 0 ? "positive" : "negative";
    char why[FAULT_TEXT];
    if (load->order < side->count) {
        take_eigenvalue(q, side, load->order, r);
        take_meaning(found, r);
        name_kind(c, q, side, load->order, r);
        return;
    }
    if (side->status != STATUS_OK)
        snprintf(why, sizeof why, "%s", side->reason);
    else if (side->reason[0] != '\0')
        snprintf(why, sizeof why, "no %s critical load%s: %.250s", sign,
                 side->count > 0 ? " with this index" : "", side->reason);
    else
        snprintf(why, sizeof why,
                 "there is no %s critical load with this index; request a lower index", sign);
    quantity_no_value(r, side->status, why);
}

/* Identifies mode i unless it is already identified. x[free + driven]: work space. */
static status identify(const analysis_context *c, int i, double x[], outcome_side *side, fault *f)
{
    const size_t n = (size_t)model_sizes(c->model).free;
    if (side->shape == NULL)
        side->shape = calloc((size_t)side->count + 1, sizeof *side->shape);
    if (side->shape == NULL)
        return fault_memory(f, "modes");
    for (; side->identified <= i; side->identified++) {
        memcpy(x, side->mode + (size_t)side->identified * n, n * sizeof *x);
        TRY(modes_identify(c->model, c->scene, x, &side->shape[side->identified], f));
    }
    return STATUS_OK;
}

/* Sets *found to the index of the mode of the requested kind and number; -1: none. x[free +
 * driven]: work space. */
static status find_mode(const analysis_context *c, const scene_mode *wanted, outcome_side *side,
                        double x[], int *found, fault *f)
{
    int order = 0;
    *found = -1;
    for (int i = 0; i < side->count; i++) {
        TRY(identify(c, i, x, side, f));
        if (modes_in_family(wanted, &side->shape[i]) && order++ == wanted->order) {
            *found = i;
            return STATUS_OK;
        }
    }
    return STATUS_OK;
}

static void extract_spectrum_modal(const analysis_context *c, const scene_quantity *q,
                                   analysis_outcome *o, quantity_result *r)
{
    const model_size size = model_sizes(c->model);
    outcome_side *side = &o->left.spectrum.positive;
    fault f = {"out of memory for a mode"};
    int found = -1;
    if (q->what.kind == SCENE_GROWTH) {
        r->value = quantity_scaled(q, outcome_spectrum_of(o)->growth);
        take_meaning(outcome_spectrum_of(o), r);
        if (r->status == STATUS_OK && outcome_spectrum_of(o)->growth_meaning != NULL)
            snprintf(r->meaning, sizeof r->meaning, "%s", outcome_spectrum_of(o)->growth_meaning);
        return;
    }
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    const status known =
        x != NULL ? find_mode(c, scene_mode_of(q), side, x, &found, &f) : STATUS_FAULT;
    free(x);
    if (known != STATUS_OK)
        quantity_no_value(r, known, f.text);
    else if (found >= 0)
        take_eigenvalue(q, side, found, r);
    else if (side->status != STATUS_OK)
        quantity_no_value(r, side->status, side->reason);
    else
        quantity_no_value(r, STATUS_NO_VALUE,
                          "the mesh has no mode of this kind with this index; use more elements");
    take_meaning(outcome_spectrum_of(o), r);
}
