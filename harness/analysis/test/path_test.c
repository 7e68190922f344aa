/* Curves must have the requested abscissas, and limit points must be found at the extremes of the
 * load. Also tests convergence of Newton's method, and round-off in slender bars and fine
 * meshes. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/newton/newton.h"
#include "harness/study/study.h"
#include "harness/tools/kit/accepted.h"
#include "harness/tools/kit/ask.h"

static const double times = -3, shift = 0.7;

/* A cantilever under a force that rises, falls and rises again, with its largest deflection at the
 * station 0.4. If value[0] is not zero, the analysis is a continuation controlled by the
 * deflection. */
static status build(const double value[], scene *s, fault *f)
{
    static const double station[] = {0.1, 0.4, 0.7, 1}, deflection[] = {0.1, 0.2, 0.3},
                        rise[] = {0, 0.4, 0.7, 1}, force[] = {0, 0.5, -0.4, 0.3}, y[] = {0, 1, 0};
    (void)f;
    section_spec spec = section_spec_rectangle(12e4, 5e4, 0.1, 0.1);
    const int continued = value[0] != 0, root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, 1, 0, 0);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), y);
    scene_hold_all(s, root);
    const int pull = scene_add_load(s, SCENE_FORCE, tip, 0, 1, 0);
    const int path = continued ? scene_add_continuation(s, 3, deflection,
                                                        (scene_control){.node = tip,
                                                                        .component = SCENE_UY,
                                                                        .step = 0.05,
                                                                        .step_max = 0.05})
                               : scene_add_static(s, 4, station, 1);
    if (!continued)
        scene_set_factor(s, pull, 4, rise, force);
    static const scene_reduction reduction[] = {SCENE_CURVE, SCENE_CURVE, SCENE_MAX,
                                                SCENE_MIN,   SCENE_LAST,  SCENE_AT};
    for (int i = 0; i < 6; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "deflection_%d", i);
        scene_quantity *q = scene_add_quantity(s, name, "m", path, scene_coordinate(tip, SCENE_UY));
        scene_set_curve(q, "x", "", i > 0 ? times : 1, i > 0 ? shift : 0);
        q->reduction = reduction[i];
        q->at = continued ? 0.2 : 0.7;
    }
    return STATUS_OK;
}

static const parameter_type table[] = {
    {"continued", "1", 0, 0, 1, NULL, "1: in its deflection, 0: by its load"}, {0}};
static const case_type drawn = {.name = "drawn", .parameters = {table}, .build = build};

static status solve_edited(const case_type *type, const element_type *formulation_type, int n,
                           const char *parameters, const scene_edit *edit, cell_result *out)
{
    cell_request request = {.type = type, .elements = n, .edit = *edit};
    formulation chosen;
    fault f = {""};
    formulation_default(formulation_type, &chosen);
    cell_formulation(&request, &chosen);
    parameters_default(type, request.parameter);
    gsl_test(parameters_parse(type, parameters, request.parameter, NULL, &f) != STATUS_OK,
             "%s %s: %s", type->name, parameters, f.text);
    return cell_run(&request, out, &f);
}

static status solve(const case_type *type, const element_type *formulation_type, int n,
                    const char *parameters, cell_result *out)
{
    return solve_edited(type, formulation_type, n, parameters, &(scene_edit){SCENE_EDIT_NONE, 0},
                        out);
}

static void abscissas(int continued)
{
    cell_result r;
    const char *what = continued ? "continued" : "loaded";
    gsl_test(solve(&drawn, formulation_find("collocation"), 4,
                   continued ? "continued=1" : "continued=0", &r) != STATUS_OK,
             "%s: %s", what, r.solve.reason);
    const quantity_result *q = r.solve.quantity;
    const curve *plain = &q[0].curve, *moved = &q[1].curve;
    gsl_test(plain->points < 3 || moved->points != plain->points, "%s: %d points", what,
             plain->points);
    for (int i = 0; i < plain->points && i < moved->points; i++) {
        gsl_test(moved->value[i] != plain->value[i], "%s: values of point %d", what, i);
        gsl_test_abs(moved->x[i], times * plain->x[i] + shift, 1e-15, "%s: abscissa of point %d",
                     what, i);
        gsl_test_abs(plain->x[i],
                     continued ? plain->value[i] : scene_path_of(&r.scene.analysis[0])->value[i],
                     1e-9, "%s: point %d itself", what, i);
    }
    static const double place[2][4] = {{0.4, 0.7, 1, 0.7}, {0.3, 0.1, 0.3, 0.2}};
    for (int i = 0; i < 4; i++)
        gsl_test_abs(q[2 + i].x, times * place[continued][i] + shift, 1e-12,
                     "%s: abscissa of reduction %d", what, i);
    cell_result_free(&r);
}

static int turns_of(const curve *c)
{
    int turns = 0;
    for (int i = 2; i < c->points; i++)
        turns += (c->value[i] - c->value[i - 1]) * (c->value[i - 1] - c->value[i - 2]) < 0;
    return turns;
}

static const curve *load_curve(const cell_result *r)
{
    for (int i = 0; i < r->solve.quantities; i++)
        if (r->scene.quantity[i].what.kind == SCENE_FACTOR_AT &&
            r->solve.quantity[i].curve.points > 0)
            return &r->solve.quantity[i].curve;
    return NULL;
}

static void kinds_of(const char *name, const element_type *type, int n, const char *parameters,
                     int count[EVENT_KINDS])
{
    cell_result r;
    solve(case_find(name, NULL), type, n, parameters, &r);
    const curve *load = load_curve(&r);
    int limits = 0;
    for (int i = 0; i < r.solve.events; i++) {
        const path_event *e = &r.solve.event[i];
        count[e->kind]++;
        limits += e->kind == EVENT_LIMIT_POINT;
        if (e->kind != EVENT_BRANCH_JUMP)
            gsl_test((e->measure > 1e-5) != (e->kind == EVENT_LIMIT_POINT),
                     "%s %s, %s: a %s on whose null vector the load does %.1e of its work", name,
                     parameters, type->name, result_event_name(e->kind), e->measure);
    }
    if (load != NULL && r.solve.status == STATUS_OK)
        gsl_test_int(limits, turns_of(load), "%s %s, %s: limit points, and turns of the load", name,
                     parameters, type->name);
    cell_result_free(&r);
}

static void events(void)
{
    static const char *const path[][2] = {{"snap_through", ""},
                                          {"snap_through", "control=arc"},
                                          {"snap_through", "control=arc;step=0.1"},
                                          {"lee_frame", ""},
                                          {"lee_frame", "plane=0"},
                                          {"lee_frame", "plane=0;step=0.2"},
                                          {"c_cantilever", "w=1.0"}};
    int count[EVENT_KINDS] = {0};
    for (size_t i = 0; i < sizeof path / sizeof path[0]; i++)
        for (int k = 0; registry_formulations[k] != NULL; k++)
            kinds_of(path[i][0], registry_formulations[k], 4, path[i][1], count);
    gsl_test(count[EVENT_LIMIT_POINT] < 40 || count[EVENT_BIFURCATION] < 8,
             "%d limit points and %d bifurcations", count[EVENT_LIMIT_POINT],
             count[EVENT_BIFURCATION]);
}

static void units(const char *name, const char *parameters)
{
    cell_result in_metres, r;
    const case_type *type = case_find(name, NULL);
    const element_type *chosen = formulation_find("beamw_consistent");
    solve(type, chosen, 4, parameters, &in_metres);
    solve_edited(type, chosen, 4, parameters, &(scene_edit){SCENE_EDIT_UNIT, 1000}, &r);
    gsl_test(r.solve.events < 2 || r.solve.events != in_metres.solve.events,
             "%s %s in millimetres: %d events, not %d", name, parameters, r.solve.events,
             in_metres.solve.events);
    for (int i = 0; i < r.solve.events && i < in_metres.solve.events; i++) {
        const path_event *e = &r.solve.event[i], *expected = &in_metres.solve.event[i];
        gsl_test(e->kind != expected->kind, "%s %s in millimetres: event %d", name, parameters, i);
        gsl_test(!(fabs(e->measure - expected->measure) < 1e-6),
                 "%s %s in millimetres: measure of event %d is %g, not %g", name, parameters, i,
                 e->measure, expected->measure);
    }
    cell_result_free(&in_metres);
    cell_result_free(&r);
}

static void path_tests(void)
{
    abscissas(0);
    abscissas(1);
    events();
    units("snap_through", "");
    units("snap_through", "control=arc");
    units("lee_frame", "plane=0");
}

static int found(const char *name, const char *parameters, const element_type *e, int n,
                 ask_tally *tally, answer *out)
{
    const question q = {
        .type = case_find(name, NULL), .parameters = parameters, .formulation = e, .elements = n};
    ask(&q, out);
    return ask_count(tally, out, "%s, %s, n = %d", name, parameters, n);
}

static void stiff_in_shear(const element_type *e)
{
    static const int n[2] = {4, 16};
    double apart[2][2];
    ask_tally tally = {0};
    for (int k = 0; k < 2; k++) {
        static answer sheared, rigid;
        const int both = found("shear_elastica", "GA=1e12", e, n[k], &tally, &sheared) +
                         found("elastica", "", e, n[k], &tally, &rigid);
        if (both < 2)
            break;
        apart[k][0] = fabs(answer_of(&sheared, "v") / answer_of(&rigid, "w_over_L") - 1);
        apart[k][1] = fabs(answer_of(&sheared, "u") / answer_of(&rigid, "u_over_L") + 1);
    }
    ask_conclude(&tally, e, "stiff in shear");
    if (tally.count[ASK_ANSWERED] == 4)
        for (int i = 0; i < 2; i++)
            gsl_test(!(apart[0][i] <= 1e-9 || apart[1][i] <= apart[0][i] / 10),
                     "%s: %s in the limit GA to infinity is that without shear (%.1e)", e->name,
                     i == 0 ? "deflection" : "shortening", apart[0][i]);
}

static double curved(const element_type *e, double curvature, ask_tally *tally)
{
    static answer a;
    scene s;
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    const case_type *type = case_find("elastica", &f);
    parameters_default(type, value);
    scene_init(&s, type->name);
    gsl_test(case_build(type, value, &s, &f) != STATUS_OK, "elastica: built (%s)", f.text);
    scene_member_at(&s, 0)->curvature[2] = curvature;
    ask_scene(&s, e, NULL, 4, &a);
    scene_free(&s);
    return ask_count(tally, &a, "curvature %g", curvature) ? a.value[0] : NAN;
}

static void nearly_straight(const element_type *e)
{
    ask_tally tally = {0};
    const double straight = curved(e, 0, &tally), more = curved(e, 1e-4, &tally),
                 slope = (more - curved(e, -1e-4, &tally)) / 2e-4;
    const int least = isnan(slope) ? 0 : -15;
    for (int power = -5; power >= least; power -= 2) {
        const double curvature = pow(10, power), change = curved(e, curvature, &tally) - straight;
        gsl_test_abs(change, slope * curvature, 1e-3 * fabs(slope) * curvature + 2e-14,
                     "%s: an initial curvature of 1e%d", e->name, power);
    }
    ask_conclude(&tally, e, "nearly straight");
    gsl_test(tally.count[ASK_ANSWERED] > 1 && !(fabs(slope) > 1e-3),
             "%s: an initial curvature matters (%.1e)", e->name, slope);
}

static void without_shear(const element_type *e, const element_type *rigid)
{
    static answer a, b;
    ask_tally tally = {0};
    const int both = found("c_column", "shear=0", e, 4, &tally, &a) +
                     found("c_column", "shear=0", rigid, 4, &tally, &b);
    gsl_test(both < 2 || a.count != b.count, "%s and %s solve the column without shear", e->name,
             rigid->name);
    for (int i = 0; i < a.count && i < b.count; i++)
        gsl_test_rel(b.value[i], a.value[i], 1e-11,
                     "%s: %s of the column is that of %s without shear", rigid->name, a.name[i],
                     e->name);
}

static void limits_tests(void)
{
    without_shear(formulation_find("beamw"), formulation_find("beamw_vlasov"));
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        stiff_in_shear(registry_formulations[i]);
        nearly_straight(registry_formulations[i]);
    }
}

static const double length = 1;

static void sequences(void)
{
    static const struct {
        const char *what;
        int count;
        double correction[6];
        refinement_state end;
    } row[] = {
        {"exact at once, twice refined all the same", 3, {1, 0, 0}, REFINEMENT_ENDS},
        {"digits to spare", 3, {1, 1e-8, 1e-16}, REFINEMENT_ENDS},
        {"slow, and it arrives", 6, {1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10}, REFINEMENT_ENDS},
        {"settles with enough digits", 5, {1, 1e-4, 1e-7, 3e-8, 2e-8}, REFINEMENT_ENDS},
        {"settles with too few", 4, {1, 1e-2, 1e-4, 8e-5}, REFINEMENT_LOST},
        {"grows", 4, {1, 0.1, 0.5, 3}, REFINEMENT_LOST},
        {"no number", 4, {1, 0.1, NAN, NAN}, REFINEMENT_LOST},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        solution_refinement r = {0};
        for (int k = 0; k < row[i].count; k++)
            gsl_test_int((int)refinement_next(&r, row[i].correction[k]),
                         (int)(k == row[i].count - 1 ? row[i].end : REFINEMENT_GOES_ON),
                         "%s: correction %d", row[i].what, k);
    }
    solution_refinement r = {0};
    double correction = 1;
    int steps = 1;
    while (refinement_next(&r, correction *= 0.9) == REFINEMENT_GOES_ON && steps < 1000)
        steps++;
    gsl_test(steps > 100, "what falls slowly ends after %d corrections", steps);
}

static void bar(scene *s, double side, const double direction[3])
{
    static const double y_axis[3] = {0.1, 1, 0.05};
    section_spec spec = section_spec_rectangle(2e11, 2e11 / 2.6, side, side);
    scene_init(s, "bar");
    const int root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, length * direction[0], length * direction[1],
                                   length * direction[2]);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), y_axis);
    scene_hold_all(s, root);
    scene_add_load(s, SCENE_FORCE, tip, direction[0], direction[1], direction[2]);
    const int linear = scene_add_linear(s);
    static const char *const name[3] = {"u_x", "u_y", "u_z"};
    for (int k = 0; k < 3; k++)
        scene_add_quantity(s, name[k], "m", linear, scene_coordinate(tip, k));
}

static void pushed(const element_type *e, ask_tally *tally, double slenderness,
                   const double direction[3], int n)
{
    static answer a;
    scene s;
    const double side = length / slenderness, exact = length / (2e11 * side * side);
    bar(&s, side, direction);
    ask_scene(&s, e, NULL, n, &a);
    scene_free(&s);
    if (slenderness > 2e4) {
        if (a.status == STATUS_SINGULAR)
            gsl_test(strstr(a.reason, "round-off") == NULL,
                     "%s, slenderness %g, %d elements: the cause is named: %s", e->name,
                     slenderness, n, a.reason);
        if (a.status != STATUS_OK)
            return;
    } else if (!ask_count(tally, &a, "bar of slenderness %g, %d elements", slenderness, n)) {
        return;
    }
    /* allowed relative error: 64 eps (L/side)^2 for the forces, plus round-off of the nodal
     * positions */
    const double settles = 64 * DBL_EPSILON * slenderness * slenderness + 1e-14 * n;
    for (int k = 0; k < 3; k++)
        gsl_test(!(fabs(a.value[k] / exact - direction[k]) <= settles),
                 "%s, slenderness %g, %d elements: component %d is off by %.1e of the displacement",
                 e->name, slenderness, n, k, a.value[k] / exact - direction[k]);
}

static void too_slender(const element_type *e)
{
    static const double direction[3] = {0.8, 0.6, 0};
    static answer a;
    scene s;
    bar(&s, 1e-6, direction);
    ask_scene(&s, e, NULL, 1, &a);
    scene_free(&s);
    gsl_test(a.status != STATUS_SINGULAR && a.outcome != ASK_REFUSED &&
                 a.outcome != ASK_NOT_OFFERED,
             "%s: a bar of slenderness 1e6 has too few digits (%s)", e->name, a.reason);
}

static void slender_bars(const element_type *e, ask_tally *tally)
{
    static const double direction[][3] = {{1, 0, 0}, {2.0 / 3, -1.0 / 3, 2.0 / 3}, {0.8, 0.6, 0}};
    for (double slenderness = 10; slenderness < 2e6; slenderness *= 10)
        for (int d = 0; d < 3; d++)
            for (int n = 1; n <= 64; n *= 8)
                pushed(e, tally, slenderness, direction[d], n);
}

static void compliance_of_many(void)
{
    static answer coarse, fine;
    const question many = {.type = case_find("sheet_cantilever", NULL),
                           .parameters = "stations=1",
                           .formulation = registry_formulations[0],
                           .elements = 12000};
    question few = many;
    few.elements = 1500;
    ask(&few, &coarse);
    ask(&many, &fine);
    gsl_test(coarse.outcome != ASK_ANSWERED || fine.outcome != ASK_ANSWERED, "sheets: %s %s",
             coarse.reason, fine.reason);
    const char *const quantity[] = {"C_xx", "C_uy_Fy", "C_thz_Mz", "C_uz_Fz"};
    for (int i = 0; i < 4; i++)
        gsl_test_rel(answer_of(&fine, quantity[i]), answer_of(&coarse, quantity[i]), 3e-7,
                     "%s of 12000 sheets is that of 1500", quantity[i]);
}

static void refinement_tests(void)
{
    sequences();
    for (int i = 0; accepted_at(i) != NULL; i++) {
        ask_tally tally = {0};
        slender_bars(accepted_at(i), &tally);
        too_slender(accepted_at(i));
        ask_conclude(&tally, accepted_at(i), "slender bars");
    }
    compliance_of_many();
}

int main(void)
{
    path_tests();
    limits_tests();
    refinement_tests();
    return gsl_test_summary();
}
