#include "harness/analysis/extract_section.h"

#include <math.h>
#include <stdlib.h>

#include "harness/equations/internal.h"
#include "harness/equations/internal_stress.h"
#include "harness/equations/linear.h"
#include "harness/inertia/shares.h"
#include "harness/model/kinematics.h"
#include "harness/solver/quantity.h"

static const int value_of[SCENE_RESULTANTS] = {[SCENE_N] = SPAN_N,
                                               [SCENE_QY] = SPAN_QY,
                                               [SCENE_QZ] = SPAN_QZ,
                                               [SCENE_MX] = SPAN_MX,
                                               [SCENE_MY] = SPAN_MY,
                                               [SCENE_MZ] = SPAN_MZ,
                                               [SCENE_BIMOMENT] = SPAN_BIMOMENT,
                                               [SCENE_MX_SAINT_VENANT] = SPAN_MX_SAINT_VENANT,
                                               [SCENE_MX_WARPING] = SPAN_MX_WARPING,
                                               [SCENE_MX_WAGNER] = SPAN_MX_WAGNER};

/* One resultant, times a sign; its magnitude where the sign is zero. */
typedef struct chosen {
    scene_resultant resultant;
    double sign;
} chosen;

static double measured(void *context, int element, double x, const double resultants[])
{
    (void)element;
    (void)x;
    const chosen *what = context;
    const double value = resultants[value_of[what->resultant]];
    return what->sign != 0 ? what->sign * value : fabs(value);
}

static status internal_of(const analysis_context *c, const scene_internal *what,
                          const internal_state *s, double *out, fault *f)
{
    double all[SPAN_VALUES];
    if (what->along != SCENE_ALONG_PLACE) {
        static const double sign[] = {
            [SCENE_ALONG_MAX] = 1, [SCENE_ALONG_MIN] = -1, [SCENE_ALONG_LARGEST] = 0};
        chosen of = {what->resultant, sign[what->along]};
        TRY(internal_largest(c->model, s, what->member, measured, &of, out, f));
        *out *= of.sign < 0 ? -1 : 1;
        return STATUS_OK;
    }
    if ((what->place == 0 || what->place == 1) && what->resultant <= SCENE_BIMOMENT)
        internal_at_end(c->model, s, what->member, what->place == 1, all);
    else
        TRY(internal_at(c->model, s, what->member, what->place, all, f));
    *out = all[value_of[what->resultant]];
    return STATUS_OK;
}

static status value_in(const analysis_context *c, const scene_quantity *q, const internal_state *s,
                       double *out, fault *f)
{
    static const stress_measure measure[] = {[SCENE_VON_MISES] = STRESS_VON_MISES,
                                             [SCENE_NORMAL_MAX] = STRESS_NORMAL_MAX,
                                             [SCENE_NORMAL_MIN] = STRESS_NORMAL_MIN};
    if (q->what.kind == SCENE_INTERNAL)
        return internal_of(c, scene_internal_of(q), s, out, f);
    const scene_stress *what = scene_stress_of(q);
    if (what->whole)
        return internal_stress_largest(c->model, s, what->member, measure[what->measure], out, f);
    return internal_stress_at(c->model, s, what->member, what->place, measure[what->measure], out,
                              f);
}

typedef struct moving_state {
    const model *m;
    const model_state *s;
    const outcome_instant *at;
} moving_state;

static void inertia_at_ends(const void *context, int element, double ends[2][7])
{
    const moving_state *of = context;
    shares_ends(of->m, of->s, of->at->rate, of->at->acceleration, element, ends);
}

static void inertia_along(const void *context, int element, double density[ELEMENT_MAX_NODES][6])
{
    const moving_state *of = context;
    shares_along(of->m, of->s, of->at->rate, of->at->acceleration, element, density);
}

double extract_section_state(const analysis_context *c, const scene_quantity *q,
                             const model_state *s, const outcome_instant *moving,
                             quantity_result *r)
{
    const moving_state of = {c->model, s, moving};
    const internal_inertia inertia = {inertia_at_ends, inertia_along, &of};
    const internal_state at = {
        .s = s, .path = kinematics_state_path(s), .moving = moving != NULL ? &inertia : NULL};
    double value = NAN;
    fault f = {""};
    const status outcome = value_in(c, q, &at, &value, &f);
    if (outcome == STATUS_OK)
        return value;
    quantity_no_value(r, outcome, f.text);
    return NAN;
}

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
        outcome = value_in(c, q, &at, &value, &f);
    if (outcome == STATUS_OK)
        r->value = quantity_scaled(q, value);
    else
        quantity_no_value(r, outcome, f.text);
    free(sigma);
}
