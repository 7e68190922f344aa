#include "harness/newton/internal_stress.h"

#include <math.h>
#include <string.h>

#include "elements/section/taper.h"
#include "harness/model/model.h"
#include "harness/newton/equations_impl.h"

/* The points of one member; those of a place of it where its section changes. */
typedef struct member_points {
    const model *m;
    int member, tapers;
    int turned; /* the twist turns fibres */
    stress_measure what;
    section local;
    stress_points points;
} member_points;

static status prepare(const model *m, const internal_state *s, int member, stress_measure what,
                      member_points *out, fault *f)
{
    const scene_member *sm = &model_scene(m)->member[member];
    unsigned features;
    TRY(features_of_section(m, profile_at(m, member, 0), &features, f));
    out->m = m;
    out->member = member;
    out->tapers = scene_member_tapers(sm);
    out->turned = s->x == NULL && (features & FEATURE_WAGNER_TORQUE);
    out->what = what;
    return stress_points_of(&model_scene(m)->section[sm->section], model_section(m, sm->section),
                            &out->points, f);
}

/* The section at a place of a member whose section changes. */
static status take_local(member_points *of, double place, fault *f)
{
    const scene_member *sm = &model_scene(of->m)->member[of->member];
    section_spec spec;
    section_taper_at(&model_scene(of->m)->section[sm->section],
                     &model_scene(of->m)->section[sm->section_q], place, &spec);
    TRY(section_compute(&spec, &of->local, f));
    return stress_points_of(&spec, &of->local, &of->points, f);
}

/* The resultants, which are in the principal axes of the element's section, in those of the points;
 * the twist is that of the local stiffness. */
static stress_resultants local_resultants(const member_points *of, int element, const double v[])
{
    const section *c = of->points.section,
                  *whole = model_section(of->m, profile_at(of->m, of->member, element));
    const double angle = c->axes_angle - whole->axes_angle, e = cos(angle), d = sin(angle);
    stress_resultants r = {.N = v[SPAN_N],
                           .Qy = e * v[SPAN_QY] + d * v[SPAN_QZ],
                           .Qz = e * v[SPAN_QZ] - d * v[SPAN_QY],
                           .My = e * v[SPAN_MY] + d * v[SPAN_MZ],
                           .Mz = e * v[SPAN_MZ] - d * v[SPAN_MY],
                           .bimoment = v[SPAN_BIMOMENT],
                           .warping = v[SPAN_MX_WARPING],
                           .twist = v[SPAN_TWIST],
                           .turned = of->turned};
    if (of->tapers && c->It > 0)
        r.twist = v[SPAN_MX_SAINT_VENANT] / (c->shear_modulus * c->It);
    return r;
}

static double stress_measured(void *context, int element, double x, const double v[])
{
    member_points *of = context;
    fault f;
    if (of->tapers && take_local(of, division_place(model_division(of->m), of->member, element, x),
                                 &f) != STATUS_OK)
        return NAN;
    const stress_resultants r = local_resultants(of, element, v);
    return (of->what == STRESS_NORMAL_MIN ? -1 : 1) * stress_of(&of->points, &r, of->what);
}

static double signed_value(stress_measure what, double value)
{
    return what == STRESS_NORMAL_MIN ? -value : value;
}

status internal_stress_at(const equations *eq, const internal_state *s, const internal_place *at,
                          stress_measure what, double *out, fault *f)
{
    const model *m = eq->m;
    member_points of;
    double v[SPAN_VALUES], x;
    TRY(prepare(m, s, at->member, what, &of, f));
    TRY(internal_at(eq, s, at, v, f));
    const int element = division_at(model_division(m), at->member, at->place, at->before, &x);
    *out = signed_value(what, stress_measured(&of, element, x, v));
    return STATUS_OK;
}

status internal_stress_largest(const equations *eq, const internal_state *s, int member,
                               stress_measure what, double *out, fault *f)
{
    const model *m = eq->m;
    member_points of;
    TRY(prepare(m, s, member, what, &of, f));
    TRY(internal_largest(eq, s, member, stress_measured, &of, out, f));
    *out = signed_value(what, *out);
    return STATUS_OK;
}
