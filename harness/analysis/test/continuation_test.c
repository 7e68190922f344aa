/* Continuation: limit points, bifurcations and branch jumps, against closed forms and against each
 * other. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"
#include "elements/test/sections.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"
#include "harness/tools/kit/scenes.h"

static cell_result solve(const case_type *type, const char *formulation_text, int n,
                         const char *assignments)
{
    cell_request request = cells_of(type, formulation_text, n);
    cell_result result;
    fault f = {""};
    gsl_test(parameters_parse(type, assignments, request.parameter, NULL, &f) != STATUS_OK,
             "%s: %s", type->name, f.text);
    cell_run(&request, &result, &f);
    return result;
}

static double load(const char *assignments, const char *formulation_text)
{
    cell_result r = solve(case_find("c_cantilever", NULL), formulation_text, 10, assignments);
    const double value = cells_value(&r, "load_at_w");
    gsl_test_int((int)r.solve.status, STATUS_OK, "c_cantilever (%s) is solved: %s", assignments,
                 r.solve.reason);
    cell_result_free(&r);
    return value;
}

static void limit_points(void)
{
    const double c = pow(cos(0.3), 2 / 3.0), exact = 2 * pow(1 - c, 1.5);
    const char *const control[] = {"control=arc", "control=displacement", "control=arc;step=0.005",
                                   "control=arc;step=0.1"};
    for (int i = 0; i < 4; i++) {
        cell_result r = solve(case_find("snap_through", NULL), "beamw", 1, control[i]);
        gsl_test_int(r.solve.events, 2, "%s: two events", control[i]);
        for (int k = 0; k < 2 && k < r.solve.events; k++) {
            const path_event *e = &r.solve.event[k];
            gsl_test_int((int)e->kind, EVENT_LIMIT_POINT, "%s: a limit point", control[i]);
            /* a trial may end a correction early, where its tangent is singular */
            gsl_test_rel(e->factor, k == 0 ? exact : -exact, 1e-11, "%s: its load", control[i]);
            gsl_test_int(e->negative_after - e->negative_before, k == 0 ? 1 : -1,
                         "%s: one pivot changes its sign", control[i]);
        }
        cell_result_free(&r);
    }
}

/* A perfect cantilever column, its least stiffness about z: bifurcations at P (1 - P/EA) = (2 k -
 * 1)^2 pi^2 EI/(4 L^2). */
static status build_column(const double value[], scene *s, fault *f)
{
    (void)f;
    const section_spec spec = sections_of(100, 40, 1, 40);
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE);
    /* along x, or turned so that its load works on every coordinate */
    const double along[2][3] = {{1, 0, 0}, {0.48, 0.6, 0.64}},
                 across[2][3] = {{0, 1, 0}, {0.8, 0, -0.6}};
    const double *const t = along[value[1] != 0];
    const double end = -0.3 * t[0], step = 0.0123 * t[0];
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, t[0], t[1], t[2]);
    scene_hold_all(s, root);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), across[value[1] != 0]);
    scene_add_load(s, SCENE_FORCE, tip, -t[0], -t[1], -t[2]);
    if (value[0] != 0) /* an unsymmetric pattern */
        scene_add_load(s, SCENE_MOMENT, tip, 0, 0, 0);
    const int path = scene_add_continuation(
        s, 1, &end,
        (scene_control){.node = tip, .component = SCENE_UX, .step = step, .step_max = step});
    scene_add_quantity(s, "bifurcation", "N", path,
                       scene_critical_point(SCENE_BIFURCATION, 0, SCENE_LOAD_FACTOR));
    return STATUS_OK;
}

static void bifurcations(const char *assignment)
{
    static const parameter_type table[] = {
        {"moment", "1", 0, 0, 1, NULL, "1: with a moment of no size"},
        {"turned", "1", 0, 0, 1, NULL, "1: along no axis"},
        {0}};
    const case_type column = {.name = "column", .parameters = {table}, .build = build_column};
    const double EA = 100;
    cell_result r = solve(&column, "collocation", 8, assignment);
    gsl_test_int((int)r.solve.status, STATUS_OK,
                 "the column is compressed to 0.7 of its length: %s", r.solve.reason);
    gsl_test(r.solve.events < 1, "a bifurcation is met");
    const double Euler = PI * PI / 4, exact = EA * (1 - sqrt(1 - 4 * Euler / EA)) / 2;
    for (int i = 0; i < r.solve.events; i++) {
        gsl_test_int((int)r.solve.event[i].kind, EVENT_BIFURCATION, "event %d is a bifurcation", i);
        gsl_test(!(r.solve.event[i].measure < 1e-8), "the load does no work on its null vector");
    }
    gsl_test_rel(cells_value(&r, "bifurcation"), exact, 1e-7,
                 "the first lies at the buckling load of the compressed column");
    cell_result_free(&r);
}

/* A space frame with both kinds: its plane is left before the limit point is reached. */
static void both_kinds(void)
{
    static const event_kind kind[] = {EVENT_BIFURCATION, EVENT_LIMIT_POINT, EVENT_LIMIT_POINT};
    static const int after[] = {1, 2, 1};
    cell_result r = solve(case_find("lee_frame", NULL), "beamw_consistent", 8, "plane=0");
    gsl_test_int(r.solve.events, 3, "three critical points");
    for (int i = 0; i < 3 && i < r.solve.events; i++) {
        gsl_test_int((int)r.solve.event[i].kind, (int)kind[i], "point %d is a %s", i,
                     result_event_name(kind[i]));
        gsl_test_int(r.solve.event[i].negative_after, after[i], "negative pivots after it");
        gsl_test((r.solve.event[i].measure < 1e-5) != (kind[i] == EVENT_BIFURCATION),
                 "the work of the load on its null vector");
    }
    cell_result_free(&r);
}

static void constant_steps(void)
{
    const double adaptive = load("w=1.0", "beamw_vlasov"),
                 constant = load("w=1.0;step=0.02", "beamw_vlasov"),
                 long_steps = load("w=1.0;step=0.15", "beamw_vlasov"),
                 displacement = load("w=1.0", "beamw_vlasov:newton=displacement");
    gsl_test_rel(constant, adaptive, 1e-11, "constant and adaptive steps find the same state");
    gsl_test_rel(long_steps, adaptive, 1e-11,
                 "so do steps that must be walked again in smaller ones");
    gsl_test_rel(displacement, adaptive, 1e-11, "so does Newton in displacements only");
}

static const char jump[] = "w=0.5;load_point=E;step=0.25";

static void jump_ends_constant_steps(void)
{
    cell_result r = solve(case_find("c_cantilever", NULL), "beamw_first", 10, jump);
    gsl_test_int((int)r.solve.status, STATUS_NOT_CONVERGED,
                 "coarse steps at E do not succeed silently");
    gsl_test(strstr(r.solve.reason, "jumps to another branch") == NULL,
             "the reason names the jump: %s", r.solve.reason);
    gsl_test_int(r.solve.events, 1, "one event");
    if (r.solve.events == 1) {
        const path_event *e = &r.solve.event[0];
        gsl_test_int((int)e->kind, EVENT_BRANCH_JUMP, "which is the jump");
        gsl_test_rel(e->factor, 11832.2, 1e-5, "the load on the path itself at w = 0.25 m");
        gsl_test(!(e->other_factor > 1.3 * e->factor), "the load of the other branch, %g",
                 e->other_factor);
    }
    gsl_test(r.counters.rejected_steps < 1, "the step is counted as rejected");
    cell_result_free(&r);
}

static status build_adaptive(const double value[], scene *s, fault *f)
{
    const status outcome = case_build(case_find("c_cantilever", f), value, s, f);
    s->analysis[0].of.continuation.control.constant_steps = 0;
    return outcome;
}

static void jump_is_walked_around(void)
{
    case_type type = *case_find("c_cantilever", NULL);
    type.build = build_adaptive;
    cell_result r = solve(&type, "beamw_first", 10, jump);
    gsl_test_int((int)r.solve.status, STATUS_OK, "adaptive steps go on: %s", r.solve.reason);
    gsl_test(r.solve.events != 1 || r.solve.event[0].kind != EVENT_BRANCH_JUMP,
             "and name the jump");
    gsl_test_rel(cells_value(&r, "load_at_w"), load("w=0.5;load_point=E", "beamw_first"), 1e-11,
                 "on the branch they started on");
    cell_result_free(&r);
}

static status build_long_arcs(const double value[], scene *s, fault *f)
{
    const status outcome = case_build(case_find("lee_frame", f), value, s, f);
    s->analysis[0].of.continuation.control.constant_steps = 1;
    s->analysis[0].of.continuation.control.step *= 5;
    s->analysis[0].of.continuation.control.step_max *= 5;
    return outcome;
}

/* Steps so long that each swings too far are walked again in smaller ones. Most led to the same
 * branch and nothing has jumped; arcs of 0.5 meet another, on which the loaded point has swayed by
 * 35 m and not by 94 m at the same deflection. */
static void long_arcs(void)
{
    static const char *const step[] = {"step=0.02", "step=0.05", "step=0.15", "step=0.2"};
    case_type type = *case_find("lee_frame", NULL);
    cell_result adaptive = solve(&type, "beamw_consistent", 4, "");
    const double load_back = cells_value(&adaptive, "limit_load_back");
    cell_result_free(&adaptive);
    type.build = build_long_arcs;
    for (int i = 0; i < 4; i++) {
        cell_result r = solve(&type, "beamw_consistent", 4, step[i]);
        gsl_test_int((int)r.solve.status, STATUS_OK, "constant arcs, five times %s: %s", step[i],
                     r.solve.reason);
        gsl_test_int(r.solve.events, 2, "constant arcs, five times %s: two limit points", step[i]);
        gsl_test_rel(cells_value(&r, "limit_load_back"), load_back, 1e-10,
                     "constant arcs, five times %s: the same load", step[i]);
        cell_result_free(&r);
    }
    cell_result r = solve(&type, "beamw_consistent", 4, "step=0.1");
    gsl_test_int((int)r.solve.status, STATUS_NOT_CONVERGED,
                 "constant arcs of 0.5: a jump ends the path: %s", r.solve.reason);
    gsl_test(r.solve.events < 1 || r.solve.event[r.solve.events - 1].kind != EVENT_BRANCH_JUMP,
             "constant arcs of 0.5: it is named");
    cell_result_free(&r);
}

static void refusals(void)
{
    scene s;
    fault f = {""};
    double value[CASE_MAX_PARAMETERS];
    const case_type *type = case_find("c_cantilever", &f);
    parameters_default(type, value);
    scene_init(&s, "refused");
    gsl_test_int((int)case_build(type, value, &s, &f), STATUS_OK, "a scene to spoil");
    s.analysis[0].of.continuation.control.component = SCENE_RX;
    gsl_test_int((int)scene_validate(&s, &f), STATUS_REFUSED,
                 "a rotation as control coordinate: %s", f.text);
    s.analysis[0].of.continuation.control.component = SCENE_UZ;
    s.analysis[0].of.continuation.control.step = 0;
    gsl_test_int((int)scene_validate(&s, &f), STATUS_REFUSED, "steps of no length: %s", f.text);
    scene_free(&s);
    cell_result r = solve(type, "beamw_first:newton=dense", 5, "");
    gsl_test_int((int)r.solve.status, STATUS_REFUSED, "newton=dense: %s", r.solve.reason);
    cell_result_free(&r);
}

int main(void)
{
    limit_points();
    bifurcations("moment=0");
    bifurcations("moment=1");
    bifurcations("turned=1");
    both_kinds();
    constant_steps();
    jump_ends_constant_steps();
    jump_is_walked_around();
    long_arcs();
    refusals();
    return gsl_test_summary();
}
