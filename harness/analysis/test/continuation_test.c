/* Limit points, bifurcations and branch switching of continuations must agree with closed forms and
 * with each other. Also tests steps of Newton's method near critical points, and the number of
 * critical loads below a load. Results must not depend on the number of threads. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"
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
            gsl_test_rel(e->factor, k == 0 ? exact : -exact, 1e-11, "%s: its load", control[i]);
            gsl_test_int(e->negative_after - e->negative_before, k == 0 ? 1 : -1,
                         "%s: one pivot changes its sign", control[i]);
        }
        cell_result_free(&r);
    }
}

static void limit_points_of_fine_meshes(void)
{
    const double exact[2] = {1.8556727540, -0.94144315560};
    cell_result r = solve(case_find("lee_frame", NULL), "geometrically_exact", 96, "");
    gsl_test_int((int)r.solve.status, STATUS_OK, "lee_frame, 288 elements: %s", r.solve.reason);
    gsl_test_int(r.solve.events, 2, "lee_frame, 288 elements: two limit points");
    for (int k = 0; k < 2 && k < r.solve.events; k++)
        gsl_test_rel(r.solve.event[k].factor, exact[k], 5e-8, "lee_frame, 288 elements: limit %d",
                     k);
    gsl_test_rel(cells_value(&r, "deflection_at_limit"), 48.735137, 2e-5,
                 "lee_frame, 288 elements: deflection");
    cell_result_free(&r);
}

/* The bifurcations of a perfect cantilever column with its smallest stiffness about z are at P
 * (1 - P/EA) = (2 k - 1)^2 pi^2 EI/(4 L^2) for k = 1, 2 ..., where EI is the smallest bending
 * stiffness. */
static status build_column(const double value[], scene *s, fault *f)
{
    (void)f;
    const section_spec spec = sections_of(100, 40, 1, 40);
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE);
    const double along[2][3] = {{1, 0, 0}, {0.48, 0.6, 0.64}},
                 across[2][3] = {{0, 1, 0}, {0.8, 0, -0.6}};
    const double *const t = along[value[1] != 0];
    const double end = -0.3 * t[0], step = 0.0123 * t[0];
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, t[0], t[1], t[2]);
    scene_hold_all(s, root);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), across[value[1] != 0]);
    scene_add_load(s, SCENE_FORCE, tip, -t[0], -t[1], -t[2]);
    if (value[0] != 0)
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

/* A load step whose direction changes too much is repeated with a smaller size. Arcs of 0.5 lead
 * to another branch, on which the loaded point sways by 35 m instead of 94 m at the same
 * deflection. */
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

static void continuation_tests(void)
{
    limit_points();
    limit_points_of_fine_meshes();
    bifurcations("moment=0");
    bifurcations("moment=1");
    bifurcations("turned=1");
    both_kinds();
    constant_steps();
    jump_ends_constant_steps();
    jump_is_walked_around();
    long_arcs();
    refusals();
}

static double value_of(const char *case_name, const char *chosen, int n,
                       const char *const assignment[], const char *quantity)
{
    cell_request request = cells_of(case_find(case_name, NULL), chosen, n);
    cell_result r;
    fault f = {""};
    cells_set(&request, assignment);
    gsl_test(cell_run(&request, &r, &f) != STATUS_OK, "%s solved with %s: %s", case_name, chosen,
             f.text);
    const double value = cells_value(&r, quantity);
    cell_result_free(&r);
    return value;
}

static void stiff_before_buckling(void)
{
    const char *const included[] = {"prebuckling=included", "ratio=1e6", NULL};
    const double linear = 4.012599344, of_1e4 = 4.013057842318;
    gsl_test_rel(value_of("lateral_buckling", "collocation", 4, included, "load_factor"),
                 linear + (of_1e4 - linear) / 100, 1e-8,
                 "critical load, hardly any deflection before it");
}

static void deflected_before_buckling(void)
{
    static const struct {
        const char *ratio;
        double load;
    } exact[] = {{"ratio=10", 4.624628010365}, {"ratio=4", 7.053702891992}};
    for (int i = 0; i < 2; i++) {
        const char *const included[] = {"prebuckling=included", exact[i].ratio, NULL};
        gsl_test_rel(value_of("lateral_buckling", "collocation", 4, included, "load_factor"),
                     exact[i].load, 1e-7, "collocation, %s: critical load", exact[i].ratio);
    }
}

static status solve_column(scene_analysis_kind kind, double P, double M, double end, double *value,
                           fault *f)
{
    scene s;
    model *m = NULL;
    formulation fm;
    solve_result r;
    section_spec spec = sections_of(1e6, 2, 1, 1);
    spec.density = 1;
    scene_init(&s, "column");
    const int tip = scenes_cantilever(&s, &spec);
    if (P != 0)
        scene_add_load(&s, SCENE_FORCE, tip, -P, 0, 0);
    if (M != 0)
        scene_add_load(&s, SCENE_MOMENT, tip, 0, 0, M);
    const int path = scene_add_static(&s, 1, &end, 1);
    const int about =
        kind == SCENE_MODAL ? scene_add_modal(&s, path) : scene_add_buckling(&s, path);
    scene_add_quantity(&s, "wanted", "1", about,
                       kind == SCENE_MODAL ? scene_frequency(0, SCENE_ANY)
                                           : scene_critical_factor(1, 0));
    gsl_test(formulation_parse("beamw", &fm, f) != STATUS_OK, "beamw exists");
    const model_request what = {&s, fm.type, fm.option, 16, 0, 0};
    status outcome = model_alloc(&what, &m, f);
    if (outcome == STATUS_OK) {
        outcome = solve_scene(&s, m, NULL, &r, f);
        *value = r.quantity[0].value;
        result_free(&r);
    }
    model_free(m);
    scene_free(&s);
    return outcome;
}

static void columns(void)
{
    const double euler = PI * PI / 4;
    double value = NAN, rest = NAN;
    fault f = {""};
    gsl_test(solve_column(SCENE_BUCKLING, 1, 0, 0.5, &value, &f) != STATUS_OK, "column: %s",
             f.text);
    gsl_test_rel(value, euler, 1e-4, "Euler's load on the nonlinear path");
    gsl_test(solve_column(SCENE_BUCKLING, 10, 0, 1, &value, &f) != STATUS_OK, "column: %s", f.text);
    gsl_test_rel(10 * value, euler, 1e-4, "Euler's load from a state beyond it");
    gsl_test(solve_column(SCENE_MODAL, euler, 0, 1e-9, &rest, &f) != STATUS_OK, "column: %s",
             f.text);
    gsl_test_rel(2 * PI * rest, 1.8751040687 * 1.8751040687 / sqrt(1e6), 2e-3,
                 "first frequency of the unloaded column");
    gsl_test(solve_column(SCENE_MODAL, euler, 0, 0.999, &value, &f) != STATUS_OK, "column: %s",
             f.text);
    gsl_test(!(value > 0) || !(value < 0.05 * rest),
             "its frequency falls to zero at Euler's load: %g of %g Hz", value, rest);
}

static void refused(void)
{
    double value = NAN;
    fault f = {""};
    gsl_test(solve_column(SCENE_MODAL, 10, 0, 1, &value, &f) != STATUS_REFUSED ||
                 strstr(f.text, "critical") == NULL,
             "frequencies of a state beyond the critical load: %s", f.text);
    gsl_test(solve_column(SCENE_MODAL, 0, 1, 1, &value, &f) != STATUS_OK,
             "a moment dead about fixed axes has no potential, but frequencies: %s", f.text);
    gsl_test_rel(2 * PI * value, 1.8751040687 * 1.8751040687 / sqrt(1e6), 0.3,
                 "first frequency under a moment");
    gsl_test(solve_column(SCENE_BUCKLING, -1, 0, 1, &value, &f) != STATUS_NOT_CONVERGED ||
                 strstr(f.text, "no critical load") == NULL,
             "tension: %s", f.text);
}

static void equilibrium_tests(void)
{
    stiff_before_buckling();
    deflected_before_buckling();
    columns();
    refused();
}

static status run(const char *case_name, const char *key, int n, const char *const assignment[],
                  cell_result *out)
{
    cell_request request = cells_of(case_find(case_name, NULL), key, n);
    fault f = {""};
    cells_set(&request, assignment);
    return cell_run(&request, out, &f);
}

static void from_rest_in_one_step(void)
{
    const char *const once[] = {"steps=1", "wagner=0", NULL};
    int runs = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++)
        for (int n = 1; n <= 2; n++) {
            cell_result r;
            const char *name = registry_formulations[i]->name;
            const status outcome =
                run("spherical_joint", registry_formulations[i]->name, n, once, &r);
            if (ask_offered(&r.scene, registry_formulations[i])) {
                runs++;
                gsl_test(outcome != STATUS_OK || r.solve.steps != 1 ||
                             r.solve.step[0].rejected != 0,
                         "%s, n = %d: 15 degrees in one step, nothing rejected", name, n);
                gsl_test(!(r.counters.iterations <= 6), "%s, n = %d: in %ld iterations", name, n,
                         r.counters.iterations);
            }
            cell_result_free(&r);
        }
    gsl_test(runs < 16, "%d cells turned at once", runs);
}

static void few_iterations(void)
{
    static const struct {
        const char *case_name, *formulation;
        double most;
    } path[] = {{"spherical_joint", "sheet_third", 3.5},
                {"spherical_joint", "sheet_second", 3.5},
                {"hexapod", "sheet_third", 3.5},
                {"hexapod", "sheet_second", 3.5},
                {"sheet_cantilever", "sheet_third", 2.5}};
    for (size_t i = 0; i < sizeof path / sizeof path[0]; i++) {
        cell_result r;
        gsl_test(run(path[i].case_name, path[i].formulation, 1, (const char *const[]){NULL}, &r) !=
                     STATUS_OK,
                 "%s solved", path[i].case_name);
        const double average = (double)r.counters.iterations / (double)r.counters.steps;
        gsl_test(!(average <= path[i].most), "%s, %s: %.2f iterations a step", path[i].case_name,
                 path[i].formulation, average);
        cell_result_free(&r);
    }
}

/* Stiff deformations within short elements must not spoil quadratic convergence. */
static void iterations_do_not_grow(void)
{
    enum { FEW = 100, MANY = 2000 };
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const char *name = registry_formulations[i]->name, *const defaults[] = {NULL};
        cell_result few, many;
        const status one = run("c_cantilever", name, FEW, defaults, &few),
                     other = run("c_cantilever", name, MANY, defaults, &many);
        if (ask_offered(&few.scene, registry_formulations[i])) {
            gsl_test(one != STATUS_OK || other != STATUS_OK, "%s: c_cantilever is solved", name);
            gsl_test_int((int)many.counters.iterations, (int)few.counters.iterations,
                         "%s: iterations with %d elements", name, MANY);
        }
        cell_result_free(&few);
        cell_result_free(&many);
    }
}

static void guesses_change_nothing(void)
{
    const char *const defaults[] = {NULL};
    cell_request request = cells_of(case_find("spherical_joint", NULL), "sheet_third", 1);
    cell_result plain, halved;
    fault f = {""};
    gsl_test(run("spherical_joint", "sheet_third", 1, defaults, &plain) != STATUS_OK, "the curve");
    request.solve.steps_between = 3;
    gsl_test(cell_run(&request, &halved, &f) != STATUS_OK,
             "the curve in three steps from azimuth to azimuth");
    gsl_test(halved.counters.steps <= plain.counters.steps, "%ld and %ld steps",
             halved.counters.steps, plain.counters.steps);
    for (int k = 0; k < plain.solve.quantities; k++)
        gsl_test_rel(halved.solve.quantity[k].value, plain.solve.quantity[k].value, 1e-11, "%s",
                     plain.scene.quantity[k].name);
    cell_result_free(&plain);
    cell_result_free(&halved);
}

static void directions(void)
{
    static const struct {
        const char *formulation;
        double least, most;
    } row[] = {{"sheet_second", 1e-3, 5e-3},
               {"sheet_third", 1e-3, 5e-3},
               {"collocation", 0, 1e-10},
               {"geometrically_exact", 0, 1e-10}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        cell_result bodies, chained;
        run("spherical_joint", row[i].formulation, 1, (const char *const[]){"wagner=0", NULL},
            &bodies);
        run("spherical_joint", row[i].formulation, 1,
            (const char *const[]){"wagner=0", "element_direction=chained", NULL}, &chained);
        const double change = fabs(cells_value(&chained, "support_stiffness_max") /
                                       cells_value(&bodies, "support_stiffness_max") -
                                   1);
        gsl_test(!(change >= row[i].least && change <= row[i].most),
                 "%s, one element: the direction changes %.1e", row[i].formulation, change);
        cell_result_free(&bodies);
        cell_result_free(&chained);
    }
}

static void fold_warping(void)
{
    static const char *const choice[3] = {"fold_warping=fixed", "fold_warping=shared",
                                          "fold_warping=free"};
    double value[3];
    for (int i = 0; i < 3; i++) {
        cell_result r;
        run("spherical_joint", "sheet_third", 1, (const char *const[]){choice[i], NULL}, &r);
        value[i] = cells_value(&r, "support_stiffness_max");
        cell_result_free(&r);
    }
    gsl_test_rel(value[0], 9.37e5, 1e-3, "folds that do not warp");
    gsl_test_rel(value[1], 9.720e5, 1e-4, "folds that share their warping");
    gsl_test_rel(value[2], 9.92e5, 2e-3, "folds free to warp");
}

static void straight_column(scene *s, int stations, const double path[])
{
    const section_spec spec = sections_of(1e8, 4, 1, 10);
    scene_init(s, "straight_column");
    const int tip = scenes_cantilever(s, &spec);
    scene_add_load(s, SCENE_FORCE, tip, -1, 0, 0);
    scene_add_static(s, stations, path, 1);
}

static void inertia_counts_critical_loads(void)
{
    const double weak = PI * PI / 4;
    const double path[] = {0.9 * weak, 1.1 * weak, 3.9 * weak, 4.1 * weak, 8.8 * weak,
                           9.2 * weak, 24 * weak,  26 * weak,  35 * weak,  37 * weak};
    const int below[] = {
        0, 1, 1, 2, 2, 3,
        3, 4, 4, 5}; /* critical loads/weak: 1, 9, 25, 49 in the weak plane, 4, 36 in the other */
    enum { STATIONS = sizeof below / sizeof below[0] };
    const char *const names[] = {"beamw_consistent", "collocation", "geometrically_exact"};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        scene s;
        model *m = NULL;
        fault f = {""};
        formulation chosen;
        solve_result r = {0};
        straight_column(&s, STATIONS, path);
        formulation_parse(names[k], &chosen, &f);
        const model_request what = {&s, chosen.type, chosen.option, 16, 0, 0};
        status outcome = scene_validate(&s, &f);
        if (outcome == STATUS_OK)
            outcome = model_alloc(&what, &m, &f);
        if (outcome == STATUS_OK)
            outcome = solve_scene(&s, m, NULL, &r, &f);
        gsl_test(outcome != STATUS_OK || r.steps != STATIONS,
                 "%s: the straight path beyond critical loads (%s)", names[k], f.text);
        if (outcome == STATUS_OK)
            for (int i = 0; i < STATIONS; i++)
                gsl_test_int(r.step[i].negative_pivots, below[i],
                             "%s: critical loads below %.1f of the first", names[k],
                             path[i] / weak);
        gsl_test_int((int)r.counters.negative_pivots, 5, "%s: the most is counted", names[k]);
        result_free(&r);
        model_free(m);
        scene_free(&s);
    }
}

/* Threads add in a fixed order, so results with several threads must be equal to the bit. */
static void threads_change_no_bit(void)
{
    static const struct {
        const char *name, *key;
        int n, threads;
    } cells[] = {{"hexapod", "sheet_third", 1, 2},
                 {"hexapod", "collocation", 1, 2},
                 {"hexapod", "geometrically_exact", 1, 4},
                 {"spherical_joint", "sheet_third", 37, 3},
                 {"c_cantilever", "geometrically_exact", 331, 2}};
    for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++) {
        const char *name = cells[i].name, *key = cells[i].key;
        cell_request request = cells_of(case_find(name, NULL), key, cells[i].n);
        cell_result one, more;
        fault f = {""};
        gsl_test(cell_run(&request, &one, &f) != STATUS_OK, "%s, %s, one thread", name, key);
        request.threads = cells[i].threads;
        gsl_test(cell_run(&request, &more, &f) != STATUS_OK, "%s, %s, %d threads", name, key,
                 cells[i].threads);
        for (int k = 0; k < one.solve.quantities; k++)
            gsl_test(memcmp(&one.solve.quantity[k].value, &more.solve.quantity[k].value,
                            sizeof(double)) != 0,
                     "%s, %s: the same %s", name, key, one.scene.quantity[k].name);
        gsl_test(memcmp(&one.counters, &more.counters, sizeof one.counters) != 0,
                 "%s, %s: the same work", name, key);
        cell_result_free(&one);
        cell_result_free(&more);
    }
}

static void mechanisms_tests(void)
{
    threads_change_no_bit();
    from_rest_in_one_step();
    few_iterations();
    iterations_do_not_grow();
    guesses_change_nothing();
    directions();
    fold_warping();
    inertia_counts_critical_loads();
}

int main(void)
{
    continuation_tests();
    equilibrium_tests();
    mechanisms_tests();
    return gsl_test_summary();
}
