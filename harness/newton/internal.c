#include "harness/newton/newton_impl.h"

#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/section/section.h"

/* A vertex, and the force from which the lumped loads on the vertex are subtracted. */
typedef struct share {
    int vertex;
    double *force; /* [6] */
} share;

static void take_off(void *context, const applied *what)
{
    const share *of = context;
    double moment[3];
    if (what->vertex != of->vertex)
        return;
    for (int i = 0; i < 6; i++)
        of->force[i] -= what->F[i];
    if (!what->offset)
        return;
    vec3_cross(what->arm, what->F, moment);
    for (int i = 0; i < 3; i++)
        of->force[3 + i] -= moment[i];
}

/* Returns 1 if the load acts inside the element. A load at an end of the element acts on the
 * node. */
static int lies_along(const model *m, int element, const scene_load *load)
{
    double part[2];
    return applied_part(m, element, load, part) &&
           (!scene_load_within(load) || applied_inside(part[0]));
}

static void note_taken(const model *m, const double force[], double sign, double taken[2][3])
{
    for (int end = 0; end < 2; end++)
        for (int i = 0; i < 3; i++)
            taken[end][i] += sign * force[NODE_COORDINATES * (end ? model_nodes(m) - 1 : 0) + i];
}

/* Subtracts the couples of a distributed weight or centrifugal force on a two-node element from
 * ends[]; inertia has the same couples (harness/time/deformable.c). taken[]: forces that were
 * subtracted at the ends; overwritten. */
static void take_couple(const mesh_element *el, const node_state x[], double taken[2][3],
                        double ends[2][7])
{
    for (int e = 0; e < 2; e++)
        for (int i = 0; i < 3; i++)
            taken[e][i] /= el->share[e];
    for (int e = 0; e < 2; e++) {
        double arm[3], moment[3];
        for (int i = 0; i < 3; i++) {
            arm[i] = x[!e].r[i] - x[e].r[i];
            ends[e][i] -= el->couple[e] * (taken[!e][i] - taken[e][i]);
        }
        vec3_cross(arm, taken[e], moment);
        for (int i = 0; i < 3; i++)
            ends[e][3 + i] -= el->couple[e] * moment[i];
    }
}

/* Computes the external forces on the first (0) and last (1) node of an element, excluding loads
 * along the element, in global axes: ends[2][7]. x: nodes of the element. */
static void ends_of(const equations *eq, const internal_state *s, int i, node_state x[],
                    double ends[2][7])
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, i);
    double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], force[ELEMENT_MAX_COORDINATES] = {0},
                                                             along[ELEMENT_MAX_COORDINATES] = {0};
    const size_t first = (size_t)i * (size_t)model_strains(m);
    kinematics_gather(m, s->s, el, x);
    model_type(m)->strain(model_kind(m, el->kind)->data, x,
                          &(strain_output){.J = J, .history = model_history_of(m, s->s, i)});
    dense_add_transpose_mul(model_own_coordinates(m), model_strains(m), 1, J,
                            s->sigma != NULL ? &s->sigma[first] : &s->s->sigma[first], force);
    double taken[2][3] = {{0}};
    if (rotating_frame_lumps(eq))
        note_taken(m, force, 1, taken);
    rotating_frame_add(eq, x, i, s->path, force, NULL, NULL);
    if (rotating_frame_lumps(eq))
        note_taken(m, force, -1, taken);
    for (int l = 0; l < model_scene(m)->loads; l++) {
        const scene_load *load = &model_scene(m)->load[l];
        if (lies_along(m, i, load) && distributed_spreads(eq, load) &&
            !distributed_takes(eq, i, load))
            distributed_add_one(eq, s->s, x, i, load, applied_factor(eq, load, s->path), along,
                                NULL);
    }
    distributed_add_own(eq, s->x != NULL ? kinematics_rest(m) : s->s, x, i, s->path, along, NULL);
    for (int k = 0; k < model_own_coordinates(m); k++)
        force[k] -= along[k];
    for (int end = 0; end < 2; end++) {
        const int k = end ? model_nodes(m) - 1 : 0;
        share of = {el->vertex[k], force + NODE_COORDINATES * k};
        for (int l = 0; l < model_scene(m)->loads; l++) {
            const scene_load *load = &model_scene(m)->load[l];
            if (!lies_along(m, i, load) || distributed_spreads(eq, load))
                continue;
            const int weighted = applied_with_mass(load);
            double before[3];
            memcpy(before, of.force, sizeof before);
            applied_element(m, s->s, load, applied_factor(eq, load, s->path), i, take_off, &of);
            for (int c = 0; c < 3 && weighted; c++)
                taken[end][c] += before[c] - of.force[c];
        }
        memcpy(ends[end], force + NODE_COORDINATES * k, 7 * sizeof(double));
    }
    if (model_nodes(m) == 2)
        take_couple(el, x, taken, ends);
    if (s->moving != NULL)
        s->moving->ends(s->moving->context, i, ends);
}

/* Returns the angle [rad] between the axes of the constant section of the element and the axes of a
 * tapered member at the position. */
static double axes_turned(const model *m, int member, double place, const mesh_element *el)
{
    const scene *s = model_scene(m);
    const scene_member *sm = &s->member[member];
    section_spec spec;
    section c;
    if (!scene_member_tapers(sm))
        return 0;
    section_taper_at(&s->section[sm->section], &s->section[sm->section_q], place, &spec);
    const int known = section_compute(&spec, &c, NULL) == STATUS_OK;
    return known ? c.axes_angle - model_section(m, model_kind(m, el->kind)->section)->axes_angle
                 : 0;
}

static void turn_components(double angle, double v[3])
{
    const double c = cos(angle), d = sin(angle), y = v[1];
    if (angle != 0) {
        v[1] = c * y + d * v[2];
        v[2] = c * v[2] - d * y;
    }
}

void internal_at_end(const equations *eq, const internal_state *s, int member, int end,
                     double out[7])
{
    const model *m = eq->m;
    const int i = end ? model_first_element(m, member + 1) - 1 : model_first_element(m, member),
              k = end ? model_nodes(m) - 1 : 0;
    node_state x[ELEMENT_MAX_NODES];
    double force[2][7];
    ends_of(eq, s, i, x, force);
    const double angle = axes_turned(m, member, end, model_element(m, i));
    mat3_transpose_mul_vec(x[k].R, force[end], out);
    mat3_transpose_mul_vec(x[k].R, force[end] + 3, out + 3);
    turn_components(angle, out);
    turn_components(angle, out + 3);
    out[6] = force[end][6];
    for (int c = 0; c < 7 && !end; c++)
        out[c] *= -1;
}

static void take_ends(const equations *eq, const internal_state *s, int i, span_end end[2])
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, i);
    node_state x[ELEMENT_MAX_NODES];
    double force[2][7], moved[ELEMENT_MAX_COORDINATES] = {0};
    ends_of(eq, s, i, x, force);
    if (s->x != NULL)
        kinematics_local(m, s->s, el, s->x, moved);
    for (int e = 0; e < 2; e++) {
        const int k = e ? model_nodes(m) - 1 : 0;
        const double sign = e ? 1 : -1;
        memcpy(end[e].frame.r, x[k].r, sizeof end[e].frame.r);
        memcpy(end[e].frame.R, x[k].R, sizeof end[e].frame.R);
        for (int c = 0; c < 3; c++) {
            end[e].force[c] = sign * force[e][c];
            end[e].moment[c] = sign * force[e][3 + c];
        }
        end[e].bimoment = sign * force[e][6];
        end[e].amplitude = x[k].a + moved[NODE_COORDINATES * k + 6];
    }
}

/* Loads along an element. */
typedef struct internal_between {
    distributed_loads loads;
    int acts, nodes; /* acts: 1 if loads act along the element; nodes: number of nodes with inertia
                        forces, 0: at rest */
    double density[ELEMENT_MAX_NODES][6];
} internal_between;

static void between_at(void *context, double x, const span_frame *at, span_load *out)
{
    internal_between *of = context;
    double part[ELEMENT_MAX_NODES];
    memset(out, 0, sizeof *out);
    if (of->acts)
        distributed_at(&of->loads, x, at, out);
    if (of->nodes > 0)
        lagrange_at(of->nodes, model_places(of->loads.m), x, part, NULL);
    for (int k = 0; k < of->nodes; k++)
        for (int i = 0; i < 3; i++) {
            out->force[i] -= part[k] * of->density[k][i];
            out->moment[i] -= part[k] * of->density[k][3 + i];
        }
}

static void moves_of(const equations *eq, const internal_state *s, int i, span_frame begin[2],
                     span_move end[2])
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, i);
    node_state now[ELEMENT_MAX_NODES], rest[ELEMENT_MAX_NODES];
    double moved[ELEMENT_MAX_COORDINATES] = {0};
    kinematics_gather(m, s->s, el, now);
    kinematics_gather(m, kinematics_rest(m), el, rest);
    if (s->x != NULL)
        kinematics_local(m, s->s, el, s->x, moved);
    for (int e = 0; e < 2; e++) {
        const int k = e ? model_nodes(m) - 1 : 0;
        memcpy(begin[e].r, rest[k].r, sizeof begin[e].r);
        memcpy(begin[e].R, rest[k].R, sizeof begin[e].R);
        double q[4], back[4];
        rotation_from_matrix(now[k].R, q);
        rotation_from_matrix(rest[k].R, back);
        rotation_conjugate(back, back);
        rotation_compose(q, back, q);
        rotation_log(q, end[e].turn);
        for (int c = 0; c < 3; c++) {
            const double *by = &moved[NODE_COORDINATES * k];
            end[e].displacement[c] = s->x != NULL ? by[c] : now[k].u[c];
            end[e].turn[c] = s->x != NULL ? by[3 + c] : end[e].turn[c];
        }
    }
}

static status recover_moved(const equations *eq, const internal_state *s, int i, const span_grid *g,
                            double x, span_move *moved, span_fields *out, fault *f)
{
    const model *m = eq->m;
    const mesh_kind *kind = model_kind_of(m, i);
    internal_between loads = {.loads = {eq, m, i, s->path},
                              .nodes = s->moving != NULL ? model_nodes(m) : 0};
    element_request request = {.section = model_section(m, kind->section),
                               .length = kind->length,
                               .options = model_options(m)};
    span_problem problem = {
        .request = &request, .linear = s->x != NULL, .context = &loads, .load = NULL};
    TRY(features_of_section(m, kind->section, &request.features, f));
    memcpy(request.curvature, kind->curvature, sizeof request.curvature);
    memcpy(request.strain, kind->strain, sizeof request.strain);
    if (!problem.linear)
        free_strain_amounts(eq, i, s->path, request.strain, request.curvature);
    const int jump = distributed_jumps(&loads.loads);
    if (jump != SCENE_NONE)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: %s begins, ends or acts within the fraction %g of the length from an end or from "
            "another such position, so resultants would have a kink inside an element; move the "
            "load to that position, or put a node there",
            scene_called(model_scene(m), SCENE_MEMBERS, model_element(m, i)->member).text,
            scene_called(model_scene(m), SCENE_LOADS, jump).text, DIVISION_LEAST);
    loads.acts = distributed_acts(&loads.loads);
    if (loads.nodes > 0)
        s->moving->along(s->moving->context, i, loads.density);
    if (loads.acts || loads.nodes > 0)
        problem.load = between_at;
    take_ends(eq, s, i, problem.end);
    TRY(span_recover(g, &problem, out, f));
    if (moved != NULL) {
        span_frame begin[2];
        span_move end[2];
        moves_of(eq, s, i, begin, end);
        span_moved(g, &problem, out, begin, kind->curvature, end, x, moved);
    }
    return STATUS_OK;
}

static status recover(const equations *eq, const internal_state *s, int i, const span_grid *g,
                      span_fields *out, fault *f)
{
    return recover_moved(eq, s, i, g, 0, NULL, out, f);
}

status internal_moved(const equations *eq, const internal_state *s, int member, double place,
                      double out[6], fault *f)
{
    const double most = 3;
    const model *m = eq->m;
    double x;
    const int i =
        model_first_element(m, member) + division_at(model_division(m), member, place, 0, &x);
    span_grid g;
    span_fields fields;
    span_move moved = {.turn = {0}};
    span_grid_make(&g);
    TRY(recover_moved(eq, s, i, &g, x, &moved, &fields, f));
    memcpy(out, moved.displacement, sizeof moved.displacement);
    memcpy(out + 3, moved.turn, sizeof moved.turn);
    if (s->x == NULL && vec3_norm(moved.turn) > most)
        return fault_set(f, STATUS_NO_VALUE,
                         "%s has rotated by %.3g rad there, but its rotation vector is available "
                         "only up to %g rad; request the rotation of a node",
                         scene_called(model_scene(m), SCENE_MEMBERS, member).text,
                         vec3_norm(moved.turn), most);
    return STATUS_OK;
}

status internal_at(const equations *eq, const internal_state *s, const internal_place *at,
                   double out[], fault *f)
{
    const model *m = eq->m;
    const int member = at->member;
    double x;
    const int i = model_first_element(m, member) +
                  division_at(model_division(m), member, at->place, at->before, &x);
    span_grid g;
    span_fields fields;
    span_grid_make(&g);
    TRY(recover(eq, s, i, &g, &fields, f));
    span_at(&g, &fields, x, out);
    const double angle = axes_turned(m, member, at->place, model_element(m, i));
    turn_components(angle, &out[SPAN_N]);
    turn_components(angle, &out[SPAN_MX]);
    return STATUS_OK;
}

typedef struct measured {
    const span_grid *g;
    const span_fields *fields;
    int element; /* index of the element along the member */
    internal_measure of;
    void *context;
} measured;

static double measure_at(const measured *what, double x)
{
    double v[SPAN_VALUES];
    span_at(what->g, what->fields, x, v);
    return what->of(what->context, what->element, x, v);
}

/* Refines a maximum between a and b by golden-section search. */
static double refined(const measured *what, double a, double b)
{
    const double golden = (sqrt(5) - 1) / 2;
    double c = b - golden * (b - a), d = a + golden * (b - a), at_c = measure_at(what, c),
           at_d = measure_at(what, d);
    for (int i = 0; i < 40; i++)
        if (at_c > at_d) {
            b = d;
            d = c;
            at_d = at_c;
            c = b - golden * (b - a);
            at_c = measure_at(what, c);
        } else {
            a = c;
            c = d;
            at_c = at_d;
            d = a + golden * (b - a);
            at_d = measure_at(what, d);
        }
    return fmax(at_c, at_d);
}

static void take_largest(const measured *what, double *largest)
{
    double value[SPAN_GRID_POINTS];
    for (int j = 0; j < SPAN_GRID_POINTS; j++) {
        value[j] = what->of(what->context, what->element, what->g->x[j], what->fields->value[j]);
        *largest = fmax(*largest, value[j]);
    }
    for (int j = 1; j + 1 < SPAN_GRID_POINTS; j++) {
        const double before = value[j] - value[j - 1], behind = value[j] - value[j + 1];
        if (before >= 0 && behind >= 0 && value[j] + before + behind > *largest)
            *largest = fmax(*largest, refined(what, what->g->x[j - 1], what->g->x[j + 1]));
    }
}

status internal_largest(const equations *eq, const internal_state *s, int member,
                        internal_measure of, void *context, double *out, fault *f)
{
    const model *m = eq->m;
    span_grid g;
    if (axes_turned(m, member, 0, model_element(m, model_first_element(m, member))) != 0 ||
        axes_turned(m, member, 1, model_element(m, model_first_element(m, member + 1) - 1)) != 0)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: the axes of the sections rotate along the member; request single positions",
            scene_called(model_scene(m), SCENE_MEMBERS, member).text);
    span_grid_make(&g);
    *out = -INFINITY;
    for (int i = model_first_element(m, member); i < model_first_element(m, member + 1); i++) {
        span_fields fields;
        TRY(recover(eq, s, i, &g, &fields, f));
        take_largest(&(measured){&g, &fields, i - model_first_element(m, member), of, context},
                     out);
    }
    return STATUS_OK;
}

typedef struct member_points {
    const model *m;
    int member, tapers;
    int turned; /* 1: stresses include the inclination of the fibres due to twist */
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

static status take_local(member_points *of, double place, fault *f)
{
    const scene_member *sm = &model_scene(of->m)->member[of->member];
    section_spec spec;
    section_taper_at(&model_scene(of->m)->section[sm->section],
                     &model_scene(of->m)->section[sm->section_q], place, &spec);
    TRY(section_compute(&spec, &of->local, f));
    return stress_points_of(&spec, &of->local, &of->points, f);
}

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
