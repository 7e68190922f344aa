#include "harness/time/resultants.h"

#include <math.h>

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/shares.h"

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
typedef struct chosen_resultants {
    scene_resultant resultant;
    double sign;
} chosen_resultants;

static double measured(void *context, int element, double x, const double resultants[])
{
    (void)element;
    (void)x;
    const chosen_resultants *what = context;
    const double value = resultants[value_of[what->resultant]];
    return what->sign != 0 ? what->sign * value : fabs(value);
}

static status internal_of(const equations *eq, const scene_internal *what, const internal_state *s,
                          double *out, fault *f)
{
    double all[SPAN_VALUES];
    if (what->along != SCENE_ALONG_PLACE) {
        static const double sign[] = {
            [SCENE_ALONG_MAX] = 1, [SCENE_ALONG_MIN] = -1, [SCENE_ALONG_LARGEST] = 0};
        chosen_resultants of = {what->resultant, sign[what->along]};
        TRY(internal_largest(eq, s, what->member, measured, &of, out, f));
        *out *= of.sign < 0 ? -1 : 1;
        return STATUS_OK;
    }
    if ((what->place == 0 || what->place == 1) && what->resultant <= SCENE_BIMOMENT)
        internal_at_end(eq, s, what->member, what->place == 1, all);
    else
        TRY(internal_at(eq, s, &(internal_place){what->member, what->place, what->before}, all, f));
    *out = all[value_of[what->resultant]];
    return STATUS_OK;
}

status resultants_in_section(const equations *eq, const scene_quantity *q, const internal_state *s,
                             double *out, fault *f)
{
    static const stress_measure measure[] = {[SCENE_VON_MISES] = STRESS_VON_MISES,
                                             [SCENE_NORMAL_MAX] = STRESS_NORMAL_MAX,
                                             [SCENE_NORMAL_MIN] = STRESS_NORMAL_MIN};
    if (q->what.kind == SCENE_INTERNAL)
        return internal_of(eq, scene_internal_of(q), s, out, f);
    const scene_stress *what = scene_stress_of(q);
    if (what->whole)
        return internal_stress_largest(eq, s, what->member, measure[what->measure], out, f);
    return internal_stress_at(eq, s, &(internal_place){what->member, what->place, what->before},
                              measure[what->measure], out, f);
}

typedef struct moving_state {
    const model *m;
    const model_state *s;
    shares_motion motion;
} moving_state;

static void inertia_at_ends(const void *context, int element, double ends[2][7])
{
    const moving_state *of = context;
    shares_ends(of->m, of->s, &of->motion, element, ends);
}

static void inertia_along(const void *context, int element, double density[ELEMENT_MAX_NODES][6])
{
    const moving_state *of = context;
    shares_along(of->m, of->s, &of->motion, element, density);
}

static status reaction_of(const equations *eq, const scene_component *what, const model_state *s,
                          const shares_motion *motion, double *out, fault *f)
{
    const model *m = eq->m;
    double F[6], L[6];
    linearise_node_force(eq, s, NULL, what->node, F);
    loads_at_node(eq, s, kinematics_state_path(s), what->node, L);
    if (motion->v != NULL)
        TRY(shares_node(m, s, motion, what->node, F, f));
    *out = F[what->component] - L[what->component];
    return STATUS_OK;
}

status resultants_of(const equations *eq, const scene_quantity *q, const model_state *s,
                     const double v[], const double a[], double *out, fault *f)
{
    const model *m = eq->m;
    const moving_state of = {m, s, {v, a, model_spreads(m, q->analysis)}};
    const internal_inertia inertia = {inertia_at_ends, inertia_along, &of};
    if (q->what.kind == SCENE_REACTION)
        return reaction_of(eq, scene_component_of(q), s, &of.motion, out, f);
    const internal_state at = {
        .s = s, .path = kinematics_state_path(s), .moving = v != NULL ? &inertia : NULL};
    return resultants_in_section(eq, q, &at, out, f);
}
