/* What a path says of itself: where its points are drawn, and which of them are limit points.
 *
 * At a limit point the load factor has an extremum, at a bifurcation it has none: the points of the
 * path alone tell how many there are of the first kind. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/tools/kit/ask.h"

static const double times = -3, shift = 0.7; /* of the abscissa */

/* A cantilever bent by a force that rises, falls and rises again: the largest deflection is at the
 * station 0.4. Or continued in its deflection. */
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

/* Of what is drawn over the path, or of its control coordinate, each by itself and with a factor
 * and an offset. */
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
        /* the control coordinate is what is drawn */
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

/* How often the load factor turns along the points of a path. */
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

/* Points of the last step have no turn behind them: they may show one point less. */
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

/* Lengths in another unit: the same points, the same part of the load's work. */
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

int main(void)
{
    abscissas(0);
    abscissas(1);
    events();
    units("snap_through", "");
    units("snap_through", "control=arc");
    units("lee_frame", "plane=0");
    return gsl_test_summary();
}
