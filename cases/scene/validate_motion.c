#include "cases/scene/scene_impl.h"

#include <math.h>
#include <string.h>

static status check_steps(const scene *s, const scene_motion *m, int i, fault *f)
{
    if (!(m->step > 0 && isfinite(m->step)))
        return fault_set(f, STATUS_REFUSED, "%s: the time step is %g s; give a positive step",
                         scene_called(s, SCENE_ANALYSES, i).text, m->step);
    if (!(m->tolerance >= 0 && m->tolerance < 1))
        return fault_set(f, STATUS_REFUSED,
                         "%s: the tolerance is %g; give a fraction of the largest displacement, "
                         "such as 1e-4, or 0 for equal steps",
                         scene_called(s, SCENE_ANALYSES, i).text, m->tolerance);
    for (int k = 0; k < m->path.stations; k++)
        if (!(m->path.value[k] >= 0 && isfinite(m->path.value[k])))
            return fault_set(
                f, STATUS_REFUSED,
                "%s: a station is at %g s, but a motion starts at 0 s; give times from 0 s",
                scene_called(s, SCENE_ANALYSES, i).text, m->path.value[k]);
    return STATUS_OK;
}

static status check_scheme(const scene *s, const scene_motion *m, int i, fault *f)
{
    if (m->scheme < SCENE_ALPHA || m->scheme >= SCENE_SCHEMES)
        return fault_set(f, STATUS_REFUSED,
                         "%s: unknown integrator; name ALPHA, CONSERVING, RADAU or EXPLICIT",
                         scene_called(s, SCENE_ANALYSES, i).text);
    if (m->scheme == SCENE_ALPHA &&
        !(m->alpha.mass >= -1 && m->alpha.mass <= m->alpha.force && m->alpha.force <= 0.5))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: with alpha_m = %g and alpha_f = %g, alpha is not unconditionally stable; "
            "give -1 <= alpha_m <= alpha_f <= 1/2, or rho from 0 to 1",
            scene_called(s, SCENE_ANALYSES, i).text, m->alpha.mass, m->alpha.force);
    if (m->mass < SCENE_MASS_USUAL || m->mass > SCENE_CONSISTENT)
        return fault_set(f, STATUS_REFUSED, "%s: unknown kind of mass; name LUMPED or CONSISTENT",
                         scene_called(s, SCENE_ANALYSES, i).text);
    if (m->mass == SCENE_CONSISTENT && m->scheme != SCENE_ALPHA && m->scheme != SCENE_RADAU)
        return fault_set(f, STATUS_REFUSED,
                         "%s: the integrator %s supports only lumped mass; give mass: lumped, or "
                         "integrator: alpha or radau",
                         scene_called(s, SCENE_ANALYSES, i).text,
                         m->scheme == SCENE_CONSERVING ? "conserving" : "explicit");
    return STATUS_OK;
}

static status check_resumed(const scene *s, const scene_analysis *a, int i, fault *f)
{
    const scene_path *before = scene_path_of(&s->analysis[a->follows]);
    const scene_start *start = &scene_motion_of(a)->start;
    for (int k = 0; k < 3; k++)
        if (start->velocity[k] != 0 || start->spin[k] != 0)
            return fault_set(f, STATUS_REFUSED,
                             "%s: the motion continues another motion with the velocities of that "
                             "motion; remove 'start'",
                             scene_called(s, SCENE_ANALYSES, i).text);
    if (scene_path_of(a)->value[0] < before->value[before->stations - 1])
        return fault_set(f, STATUS_REFUSED,
                         "%s: the motion continues another one that ends at %g s; give stations at "
                         "this time or later",
                         scene_called(s, SCENE_ANALYSES, i).text,
                         before->value[before->stations - 1]);
    return STATUS_OK;
}

static status scene_validate_mass(const scene *s, int i, fault *f)
{
    if (scene_has_mass(s))
        return STATUS_OK;
    return fault_set(
        f, STATUS_REFUSED,
        "%s: the structure has no mass; add a density or a mass to a section, or a mass to a node",
        scene_called(s, SCENE_ANALYSES, i).text);
}

static status check_follows(const scene *s, int i, fault *f)
{
    const int follows = s->analysis[i].follows;
    if (follows != SCENE_NONE && s->analysis[follows].kind != SCENE_STATIC &&
        s->analysis[follows].kind != SCENE_CONTINUATION &&
        s->analysis[follows].kind != SCENE_ROTATION && s->analysis[follows].kind != SCENE_MOTION)
        return fault_set(f, STATUS_REFUSED,
                         "%s: a motion starts from the last state of a static path, a "
                         "continuation, a rotation or a motion, but 'about' names an analysis of "
                         "the kind '%s'; name one of these analyses, or remove 'about'",
                         scene_called(s, SCENE_ANALYSES, i).text,
                         scene_analysis_name(s->analysis[follows].kind));
    if (follows != SCENE_NONE && s->analysis[follows].kind == SCENE_MOTION)
        TRY(check_resumed(s, &s->analysis[i], i, f));
    return scene_validate_mass(s, i, f);
}

/* Returns the interpolated value of a table at a path parameter. */
static double along_table(int stations, const double at[], const double value[], double path)
{
    int k = 0;
    while (k < stations && at[k] < path)
        k++;
    if (k == 0 || k == stations)
        return value[k == 0 ? 0 : stations - 1];
    const double part = (path - at[k - 1]) / (at[k] - at[k - 1]);
    return value[k - 1] + part * (value[k] - value[k - 1]);
}

static status refuse_path(scene_words owner_name, const char *what, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "%s: its %s are given over a path, but the transient analysis follows none; "
                     "give a function of time, or name a static analysis in 'about'",
                     owner_name.text, what);
}

static status check_driver(const scene *s, int d, int i, fault *f)
{
    const scene_driver *driver = &s->driver[d];
    const scene_path *path = scene_path_of(&s->analysis[i]);
    const double end = path->value[path->stations - 1];
    const int origin = scene_origin_of(s, i);
    double time, at[3];
    int derivative;
    if (driver->value == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "motion %s: its value is unknown, but a transient analysis requires it; "
                         "give the values",
                         driver->name);
    const scene_path *before = origin != SCENE_NONE ? scene_path_of(&s->analysis[origin]) : NULL;
    const double starts = before == NULL
                              ? 0
                              : along_table(driver->stations, driver->path, driver->value,
                                            before->value[before->stations - 1]);
    if (driver->function.pieces == 0) {
        if (before == NULL && (driver->stations > 1 || driver->value[0] != 0))
            return refuse_path(scene_called(s, SCENE_DRIVERS, d), "values", f);
        return STATUS_OK;
    }
    if (!function_finite(&driver->function, end, 2, &time))
        return fault_set(f, STATUS_REFUSED,
                         "motion %s: at %g s its value, velocity or acceleration is not finite; "
                         "give another function, or define the function in pieces",
                         driver->name, time);
    if (!function_smooth(&driver->function, end, &time, &derivative))
        return fault_set(f, STATUS_REFUSED,
                         "motion %s: the %s jumps at %g s, which would be an impact; make the "
                         "pieces join smoothly",
                         driver->name, derivative == 0 ? "value" : "velocity", time);
    function_at(&driver->function, 0, at);
    if (!(fabs(at[0] - starts) <= 1e-9 * (1 + fabs(starts))))
        return fault_set(
            f, STATUS_REFUSED,
            "motion %s: its value at 0 s is %g, but the analysis starts from %g; give a function "
            "with this initial value, or follow a static path that ends at the initial value",
            driver->name, at[0], starts);
    return STATUS_OK;
}

static status check_temperature(const scene *s, int l, int i, fault *f)
{
    const scene_load *load = &s->load[l];
    const scene_path *path = scene_path_of(&s->analysis[i]);
    const int origin = scene_origin_of(s, i);
    const scene_path *before = origin != SCENE_NONE ? scene_path_of(&s->analysis[origin]) : NULL;
    double time, at[3];
    int derivative;
    function_at(&load->function, 0, at);
    const double begin =
        before == NULL ? at[0] : along_path_factor(load, before->value[before->stations - 1]);
    if (scene_motion_of(&s->analysis[i])->scheme == SCENE_CONSERVING)
        return fault_set(f, STATUS_REFUSED,
                         "%s (conserving): %s changes in time and supplies energy; use the "
                         "integrator alpha or radau, or keep %s constant",
                         scene_called(s, SCENE_ANALYSES, i).text,
                         scene_called(s, SCENE_LOADS, l).text,
                         scene_called(s, SCENE_LOADS, l).text);
    if (!(fabs(at[0] - begin) <= 1e-9 * (1 + fabs(begin))))
        return fault_set(f, STATUS_REFUSED,
                         "%s: its factor at 0 s is %g, but the motion starts with %s of factor %g; "
                         "give a function with this initial factor",
                         scene_called(s, SCENE_LOADS, l).text, at[0], scene_heat_word(load), begin);
    if (!function_smooth(&load->function, path->value[path->stations - 1], &time, &derivative) &&
        derivative == 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: %s cannot jump, but jumps at %g s; let the factor change gradually",
                         scene_called(s, SCENE_LOADS, l).text, scene_heat_word(load), time);
    return STATUS_OK;
}

static status check_load(const scene *s, int l, int i, fault *f)
{
    const scene_load *load = &s->load[l];
    const scene_path *path = scene_path_of(&s->analysis[i]);
    double time;
    if (load->feedback.node != SCENE_NONE &&
        scene_motion_of(&s->analysis[i])->scheme == SCENE_CONSERVING)
        return fault_set(f, STATUS_REFUSED,
                         "%s (conserving): %s has feedback, which supplies energy; use "
                         "integrator: radau, alpha or explicit",
                         scene_called(s, SCENE_ANALYSES, i).text,
                         scene_called(s, SCENE_LOADS, l).text);
    if (load->towards != SCENE_NONE && scene_motion_of(&s->analysis[i])->scheme == SCENE_CONSERVING)
        return fault_set(f, STATUS_REFUSED,
                         "%s (conserving): the integrator does not support %s, a tension between "
                         "nodes; use integrator: radau, alpha or explicit",
                         scene_called(s, SCENE_ANALYSES, i).text,
                         scene_called(s, SCENE_LOADS, l).text);
    if (load->function.pieces == 0) {
        if (load->stations > 0 && s->analysis[i].follows == SCENE_NONE &&
            load->feedback.node == SCENE_NONE)
            return refuse_path(scene_called(s, SCENE_LOADS, l), "factors", f);
        return STATUS_OK;
    }
    if (!function_finite(&load->function, path->value[path->stations - 1], 0, &time))
        return fault_set(f, STATUS_REFUSED,
                         "%s: at %g s the factor is not finite; give another function, or define "
                         "the function in pieces",
                         scene_called(s, SCENE_LOADS, l).text, time);
    return load->kind == SCENE_TEMPERATURE ? check_temperature(s, l, i, f) : STATUS_OK;
}

static status scene_validate_motion(const scene *s, int i, fault *f)
{
    const scene_motion *m = scene_motion_of(&s->analysis[i]);
    TRY(check_steps(s, m, i, f));
    TRY(check_scheme(s, m, i, f));
    if (s->analysis[i].damping.mass > 0 && m->scheme == SCENE_CONSERVING)
        return fault_set(f, STATUS_REFUSED,
                         "%s: the integrator conserving does not support damping of masses; use "
                         "integrator: radau, alpha or explicit, or dashpots instead",
                         scene_called(s, SCENE_ANALYSES, i).text);
    for (int k = 0; k < s->springs && m->scheme == SCENE_CONSERVING; k++)
        if (scene_spring_circulates(&s->spring[k]))
            return fault_set(f, STATUS_REFUSED,
                             "%s (conserving): %s has an unsymmetric stiffness, which "
                             "supplies energy; use integrator: radau, alpha or explicit",
                             scene_called(s, SCENE_ANALYSES, i).text,
                             scene_called(s, SCENE_SPRINGS, k).text);
    TRY(check_follows(s, i, f));
    for (int d = 0; d < s->drivers; d++)
        TRY(check_driver(s, d, i, f));
    for (int l = 0; l < s->loads; l++)
        if (scene_acting_factor(s, scene_acting_of(s, i), s->load[l].load_case) != 0)
            TRY(check_load(s, l, i, f));
    return STATUS_OK;
}

static int moves(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            return 1;
    return 0;
}

/* Checks one function of time. `idle` is 1 if there is no transient analysis. */
static status check_function(const scene_function *of, int idle, fault *f)
{
    if (of->pieces == 0)
        return STATUS_OK;
    TRY(function_check(of, f));
    return idle ? fault_set(f, STATUS_REFUSED,
                            "it is a function of time, but no analysis is a motion; add a motion "
                            "analysis, or give values over a path")
                : STATUS_OK;
}

static int vibrates(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_HARMONIC || s->analysis[i].damped)
            return 1;
    return 0;
}

status scene_validate_functions(const scene *s, fault *f)
{
    const int idle = !moves(s);
    fault why = {""};
    for (int d = 0; d < s->drivers; d++) {
        const status outcome = check_function(&s->driver[d].function, idle, &why);
        if (outcome != STATUS_OK)
            return fault_set(f, outcome, "motion %s: %s", s->driver[d].name, why.text);
    }
    for (int l = 0; l < s->loads; l++) {
        const int refers = s->load[l].feedback.node != SCENE_NONE && vibrates(s);
        const status outcome = check_function(&s->load[l].function, idle && !refers, &why);
        if (outcome != STATUS_OK)
            return fault_set(f, outcome, "%s: %s", scene_called(s, SCENE_LOADS, l).text, why.text);
    }
    return STATUS_OK;
}

static status check_continuation(const scene *s, int i, fault *f)
{
    const scene_control *c = &scene_continuation_of(&s->analysis[i])->control;
    if (!(c->step > 0) || !(c->step_max >= c->step))
        return fault_set(f, STATUS_REFUSED,
                         "%s: the initial step is %g and the largest step is %g; give a positive "
                         "initial step and a largest step that is not smaller",
                         scene_called(s, SCENE_ANALYSES, i).text, c->step, c->step_max);
    return STATUS_OK;
}

static status check_path(const scene *s, const scene_analysis *a, int i, fault *f)
{
    const scene_path *path = scene_path_of(a);
    if (path->stations < 1)
        return fault_set(f, STATUS_REFUSED, "%s: the path has no stations; give at least one",
                         scene_called(s, SCENE_ANALYSES, i).text);
    if (a->kind != SCENE_CONTINUATION)
        for (int k = 1; k < path->stations; k++)
            if (!(path->value[k] > path->value[k - 1]))
                return fault_set(f, STATUS_REFUSED,
                                 "%s: the stations must ascend; sort them and remove repetitions",
                                 scene_called(s, SCENE_ANALYSES, i).text);
    return STATUS_OK;
}

static status check_compliance(const scene *s, const scene_analysis *a, int i, fault *f)
{
    if (a->follows != SCENE_NONE && scene_path_of(&s->analysis[a->follows]) == NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: a compliance is computed about a path or the undeformed structure; name a "
            "static analysis, or remove 'about'",
            scene_called(s, SCENE_ANALYSES, i).text);
    const scene_compliance *what = scene_compliance_of(a);
    const scene_node *n = what->node >= 0 && what->node < s->nodes ? &s->node[what->node] : NULL;
    static const char *const component_name[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
    for (int c = SCENE_UX; c <= SCENE_RZ && n != NULL; c++) {
        const int at = scene_node_coordinate(n, c);
        if ((what->released >> c & 1u) &&
            (at < SCENE_RX ? n->translation[at] : n->angle[at - SCENE_RX]) == SCENE_HELD)
            return fault_set(f, STATUS_REFUSED,
                             "%s: %s of %s is fixed, but only driven components can be released; "
                             "remove the component from 'released', or free it at the node",
                             scene_called(s, SCENE_ANALYSES, i).text, component_name[c],
                             scene_called(s, SCENE_NODES, what->node).text);
    }
    return n == NULL || scene_is_joined(s, what->node) || scene_is_constrained(s, what->node, ~0u)
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "%s: no member, spring or constraint moves %s; join one to this node, "
                           "or name another node",
                           scene_called(s, SCENE_ANALYSES, i).text,
                           scene_called(s, SCENE_NODES, what->node).text);
}

static status check_about_rotation(const scene *s, const scene_analysis *a, int i, fault *f)
{
    const scene_words owner_name = scene_called(s, SCENE_ANALYSES, i),
                      axes = scene_name(s, SCENE_ANALYSES, a->follows);
    if (a->by_modes || scene_has_ratios(a))
        return fault_set(f, STATUS_REFUSED,
                         "%s: modes without damping do not solve small motions in rotating axes "
                         "(%s); remove %s",
                         owner_name.text, axes.text,
                         a->by_modes ? "'solution'" : "the damping ratios");
    if (a->damping.mass > 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: damping in proportion to the mass acts in fixed axes, but %s has "
                         "rotating axes; remove mass, and give dashpots or damping: {stiffness: b}",
                         owner_name.text, axes.text);
    return STATUS_OK;
}

static status check_about(const scene *s, const scene_analysis *a, int i, fault *f)
{
    const scene_analysis_kind about = s->analysis[a->follows].kind;
    if (a->kind == SCENE_HARMONIC && scene_rotates(&s->analysis[a->follows]))
        return check_about_rotation(s, a, i, f);
    if (about == SCENE_STATIC || (about == SCENE_LINEAR && a->kind != SCENE_BUCKLING) ||
        (about == SCENE_ROTATION && a->kind == SCENE_HARMONIC))
        return STATUS_OK;
    if (a->kind == SCENE_HARMONIC)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: a harmonic analysis is about a static or linear analysis, a rotation, or an "
            "instant of a motion, but %s is a %s analysis; name one of these, or remove 'about'",
            scene_called(s, SCENE_ANALYSES, i).text, scene_name(s, SCENE_ANALYSES, a->follows).text,
            scene_analysis_name(about));
    return fault_set(
        f, STATUS_REFUSED,
        "%s: %s, but %s is a %s analysis; name a static analysis, or remove 'about'%s",
        scene_called(s, SCENE_ANALYSES, i).text,
        a->kind == SCENE_MODAL
            ? "a modal analysis is about a static or linear analysis or, with damped: yes, "
              "an instant of a motion"
            : "a buckling analysis is about a static analysis",
        scene_name(s, SCENE_ANALYSES, a->follows).text, scene_analysis_name(about),
        about == SCENE_ROTATION && a->kind == SCENE_MODAL
            ? ", or request the frequencies of the rotation itself"
        : about == SCENE_CONTINUATION && a->kind == SCENE_BUCKLING
            ? ", or request the critical points of the continuation"
            : "");
}

static int is_requested(const scene *s, int analysis)
{
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].analysis == analysis)
            return 1;
    return 0;
}

static status check_about_motion(const scene *s, const scene_analysis *a, int i, fault *f)
{
    const scene_words owner_name = scene_called(s, SCENE_ANALYSES, i);
    const scene_words motion = scene_name(s, SCENE_ANALYSES, a->follows);
    if (a->kind != SCENE_MODAL && a->kind != SCENE_HARMONIC)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: its base state belongs to a motion, whose forces are not in "
            "equilibrium without inertia forces; name a static analysis, or use modal: "
            "{damped: yes} or a harmonic analysis, which include inertia forces",
            owner_name.text);
    if (a->kind == SCENE_MODAL && !a->damped)
        return fault_set(f, STATUS_REFUSED,
                         "%s: at an instant of a motion (%s), velocities cause forces that "
                         "undamped modes do not include; add damped: yes",
                         owner_name.text, motion.text);
    if (a->by_modes || scene_has_ratios(a))
        return fault_set(f, STATUS_REFUSED,
                         "%s: undamped modes do not describe small motions about an instant of a "
                         "motion (%s); remove %s",
                         owner_name.text, motion.text,
                         a->by_modes ? "'solution'" : "the damping ratios");
    if (a->damping.mass > 0 || a->damping.stiffness > 0)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: small motions about an instant have the damping of the motion; remove "
            "'damping' here, and give damping: {mass: a} to %s, or 'damping' to "
            "members and springs",
            owner_name.text, motion.text);
    return STATUS_OK;
}

static status check_instant(const scene *s, const scene_analysis *a, int i, fault *f)
{
    const double time = scene_instant_of(s, i);
    if (a->kind != SCENE_MODAL && a->kind != SCENE_HARMONIC)
        return STATUS_OK;
    if (isnan(time) && isnan(a->time) && a->axes_of == SCENE_NONE && a->axes == SCENE_TURNING_OWN)
        return STATUS_OK;
    if (isnan(time))
        return fault_set(f, STATUS_REFUSED,
                         "%s: the analysis is not about a motion, but '%s' requires one; name a "
                         "motion with 'about', or remove the key",
                         scene_called(s, SCENE_ANALYSES, i).text,
                         !isnan(a->time)            ? "time"
                         : a->axes_of != SCENE_NONE ? "axes_of"
                                                    : "axes");
    const scene_analysis *motion = &s->analysis[a->follows];
    const scene_path *path = scene_path_of(motion);
    const double begin = scene_motion_begin(s, a->follows), end = path->value[path->stations - 1];
    return time >= begin && time <= end
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "%s: %g s is outside motion %s, which lasts from %g to %g s; give a "
                           "time in this range",
                           scene_called(s, SCENE_ANALYSES, i).text, time,
                           scene_name(s, SCENE_ANALYSES, a->follows).text, begin, end);
}

static status check_harmonic(const scene *s, const scene_analysis *a, int i, fault *f)
{
    const scene_path *ratios = &a->damping.ratios;
    const scene_words owner_name = scene_called(s, SCENE_ANALYSES, i);
    for (int k = 0; k < ratios->stations; k++)
        if (!(ratios->value[k] >= 0 && isfinite(ratios->value[k])))
            return fault_set(
                f, STATUS_REFUSED,
                "%s: a damping ratio is %g; give zero or a positive number, such as 0.02",
                owner_name.text, ratios->value[k]);
    if (a->modes > 0 && ratios->stations > a->modes)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: there are %d damping ratios, but modes: %d; increase 'modes', or remove ratios",
            owner_name.text, ratios->stations, a->modes);
    if (a->modes > 0 && !a->by_modes && !scene_has_ratios(a))
        return fault_set(f, STATUS_REFUSED,
                         "%s: a direct solution without damping ratios does not use modes; add "
                         "solution: modal, or remove modes",
                         owner_name.text);
    return STATUS_OK;
}

status scene_validate_analysis(const scene *s, int i, fault *f)
{
    const scene_analysis *a = &s->analysis[i];
    if (a->follows != SCENE_NONE && (a->follows < 0 || a->follows >= i))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: the analysis named by 'about' does not precede this one; name an earlier "
            "analysis",
            scene_called(s, SCENE_ANALYSES, i).text);
    if (a->follows != SCENE_NONE && a->kind != SCENE_MOTION &&
        s->analysis[a->follows].kind == SCENE_MOTION)
        TRY(check_about_motion(s, a, i, f));
    TRY(scene_validate_acting(s, i, f));
    TRY(check_instant(s, a, i, f));
    if (a->follows != SCENE_NONE && s->analysis[a->follows].kind != SCENE_MOTION &&
        (a->kind == SCENE_BUCKLING || a->kind == SCENE_MODAL || a->kind == SCENE_HARMONIC))
        TRY(check_about(s, a, i, f));
    if (scene_path_of(a) != NULL)
        TRY(check_path(s, a, i, f));
    if (a->kind == SCENE_CONTINUATION)
        return check_continuation(s, i, f);
    if (a->kind == SCENE_MOTION)
        return scene_validate_motion(s, i, f);
    if (a->kind == SCENE_HARMONIC && !(a->of.harmonic.value[0] >= 0))
        return fault_set(f, STATUS_REFUSED,
                         "%s: a frequency is %g Hz; give zero or positive frequencies",
                         scene_called(s, SCENE_ANALYSES, i).text, a->of.harmonic.value[0]);
    if (a->kind == SCENE_HARMONIC)
        TRY(check_harmonic(s, a, i, f));
    if (a->open_loops && !scene_has_feedback(s))
        return fault_set(f, STATUS_REFUSED, "%s: no load has feedback; remove 'loops'",
                         scene_called(s, SCENE_ANALYSES, i).text);
    if (a->kind == SCENE_MODAL && !a->damped && (a->damping.mass > 0 || a->damping.stiffness > 0))
        return fault_set(f, STATUS_REFUSED,
                         "%s: 'damping' is given, but the analysis computes undamped frequencies; "
                         "add damped: yes, or remove 'damping'",
                         scene_called(s, SCENE_ANALYSES, i).text);
    if ((a->kind == SCENE_MODAL || a->kind == SCENE_HARMONIC) && is_requested(s, i))
        return scene_validate_mass(s, i, f);
    return a->kind == SCENE_COMPLIANCE ? check_compliance(s, a, i, f) : STATUS_OK;
}

status scene_spectrum_stations(const scene *s, const scene_quantity *q, int *first, int *count,
                               fault *f)
{
    const scene_path *path = scene_path_of(&s->analysis[q->analysis]);
    const double *at = path->value, near = 1e-9 * fabs(at[path->stations - 1]);
    int begin = 0, end = path->stations;
    while (begin < end && at[begin] < q->passing.from - near)
        begin++;
    while (begin < end && q->passing.until > 0 && at[end - 1] > q->passing.until + near)
        end--;
    *first = begin;
    *count = end - begin;
    if (*count < 3)
        return fault_set(
            f, STATUS_REFUSED,
            "quantity %s: the number of stations in the window is %d, but a spectrum requires at "
            "least 3; give %s evenly spaced stations, such as stations: 0..1/1000",
            q->name, *count, scene_called(s, SCENE_ANALYSES, q->analysis).text);
    const double step = (at[end - 1] - at[begin]) / (*count - 1);
    for (int i = begin; i < end; i++)
        if (!(fabs(at[i] - (at[begin] + (i - begin) * step)) <= 1e-6 * step))
            return fault_set(f, STATUS_REFUSED,
                             "quantity %s: a spectrum requires evenly spaced stations, but %g s of "
                             "%s is not at %g s; give a range, such as stations: 0..1/1000, or a "
                             "window ('when') in which they are evenly spaced",
                             q->name, at[i], scene_called(s, SCENE_ANALYSES, q->analysis).text,
                             at[begin] + (i - begin) * step);
    return STATUS_OK;
}

static status check_begin(const scene *s, const scene_quantity *q, fault *f)
{
    const double from = q->passing.from, begin = scene_motion_begin(s, q->analysis);
    if (!(from > 0) || from >= begin * (1 - 1e-9))
        return STATUS_OK;
    return fault_set(
        f, STATUS_REFUSED,
        "quantity %s: its window begins at %g s, but %s begins at %.10g s, where %s ends; let the "
        "window begin there or later, or name %s",
        q->name, from, scene_called(s, SCENE_ANALYSES, q->analysis).text, begin,
        scene_name(s, SCENE_ANALYSES, s->analysis[q->analysis].follows).text,
        scene_name(s, SCENE_ANALYSES, s->analysis[q->analysis].follows).text);
}

static status check_spectrum(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_passing *p = &q->passing;
    int first, count;
    if (q->transform == SCENE_HISTORY)
        return p->taper == SCENE_TAPER_NONE
                   ? STATUS_OK
                   : fault_set(f, STATUS_REFUSED,
                               "quantity %s: a taper applies to spectra only; write take: spectrum "
                               "or psd, or remove 'taper'",
                               q->name);
    if (s->analysis[q->analysis].kind != SCENE_MOTION)
        return fault_set(
            f, STATUS_REFUSED,
            "quantity %s: a spectrum requires a motion; name a motion, or write take: curve",
            q->name);
    if (!(p->from >= 0) || !isfinite(p->until) || (p->until != 0 && !(p->until > p->from)))
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: the window from %g to %g s is invalid; give a window that "
                         "starts at 0 s or later and ends after its start",
                         q->name, p->from, p->until);
    TRY(check_begin(s, q, f));
    return scene_spectrum_stations(s, q, &first, &count, f);
}

static status refuse_station(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_analysis *a = &s->analysis[q->analysis];
    const scene_words owner_name = scene_called(s, SCENE_ANALYSES, q->analysis);
    const int about = a->kind != SCENE_LINEAR && a->follows != SCENE_NONE &&
                              scene_path_of(&s->analysis[a->follows]) != NULL
                          ? a->follows
                          : SCENE_NONE;
    if (about == SCENE_NONE)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: %s has one state and no stations; remove 'at' and 'take', "
                         "or use a static path",
                         q->name, owner_name.text);
    if (s->analysis[about].kind == SCENE_MOTION)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: %s is about one instant of %s and has no stations; remove "
                         "'at' and 'take', and select the instant with 'time' of the analysis",
                         q->name, owner_name.text, scene_name(s, SCENE_ANALYSES, about).text);
    return fault_set(f, STATUS_REFUSED,
                     "quantity %s: %s is about the last state of %s and has no stations; remove "
                     "'at' and 'take'; for an earlier state, add a path that ends there and name "
                     "it with 'about'",
                     q->name, owner_name.text, scene_name(s, SCENE_ANALYSES, about).text);
}

static status check_passing(const scene *s, const scene_quantity *q, fault *f)
{
    const scene_analysis *a = &s->analysis[q->analysis];
    const scene_passing *p = &q->passing;
    if (q->reduction < SCENE_LAST || q->reduction >= SCENE_REDUCTIONS)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: the statistic ('take') is unknown; name a known statistic",
                         q->name);
    const int stations =
        scene_path_of(a) != NULL || (a->kind == SCENE_COMPLIANCE && a->follows != SCENE_NONE);
    if (q->reduction != SCENE_LAST && !stations)
        return refuse_station(s, q, f);
    if (q->reduction > SCENE_CURVE && a->kind != SCENE_MOTION)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: times, crossings and means require a motion; name a motion, "
                         "or request a station or a curve",
                         q->name);
    if (!scene_is_passed(q, a->kind))
        return STATUS_OK;
    if (!isfinite(p->level) || p->order < 0 || p->direction < SCENE_RISING ||
        p->direction > SCENE_EITHER || !(p->from >= 0) || !isfinite(p->until) ||
        (p->until != 0 && !(p->until > p->from)))
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: the window from %g to %g s or the crossing is invalid; give "
                         "a finite level, a direction (rising, falling or either), and a window "
                         "that starts at 0 s or later and ends after its start",
                         q->name, p->from, p->until);
    return check_begin(s, q, f);
}

static int path_of_curve(const scene *s, const scene_quantity *q, int *points)
{
    const scene_analysis *a = &s->analysis[q->analysis];
    *points = a->kind == SCENE_CONTINUATION &&
              (q->what.kind == SCENE_FACTOR_AT || q->what.kind == SCENE_COORDINATE);
    return a->kind == SCENE_COMPLIANCE && a->follows != SCENE_NONE ? a->follows : q->analysis;
}

static status check_abscissa(const scene *s, const scene_quantity *q, fault *f)
{
    int points, others;
    if (q->reduction != SCENE_CURVE || !q->x.is_quantity)
        return STATUS_OK;
    const int over = scene_abscissa_of(s, q);
    const scene_quantity *x = over != SCENE_NONE ? &s->quantity[over] : NULL;
    if (x == NULL || x == q || x->reduction != SCENE_CURVE || q->transform != SCENE_HISTORY ||
        x->transform != SCENE_HISTORY)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: the abscissa %s must be another quantity with take: curve, "
                         "and neither of the two may be a spectrum; add take: curve to the "
                         "abscissa, or name another quantity",
                         q->name, q->x.name);
    if (x->analysis < 0 || x->analysis >= s->analyses ||
        path_of_curve(s, q, &points) != path_of_curve(s, x, &others) || points != others)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: the abscissa %s belongs to another path; name a quantity of "
                         "the same path",
                         q->name, x->name);
    return STATUS_OK;
}

status scene_validate_quantity(const scene *s, int i, fault *f)
{
    const scene_quantity *q = &s->quantity[i];
    for (int k = 0; k < i; k++)
        if (strcmp(s->quantity[k].name, q->name) == 0)
            return fault_set(f, STATUS_REFUSED,
                             "quantity %s: two quantities have this name; rename one", q->name);
    if (!scene_gives(s->analysis[q->analysis].kind, q))
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: its analysis does not provide this kind of quantity; name "
                         "another analysis",
                         q->name);
    TRY(scene_validate_case_of(s, q, f));
    TRY(check_passing(s, q, f));
    TRY(check_spectrum(s, q, f));
    TRY(check_abscissa(s, q, f));
    const quantity_type *type = quantity_type_of(q);
    return type->check != NULL ? type->check(s, q, f) : STATUS_OK;
}
