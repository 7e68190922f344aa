/* Structures that turn steadily, through the program's own door: what does not depend on the frame,
 * the formulation's algorithm or the reference point of a body; the stretch of a thick beam; and
 * that a structure at rest pays nothing. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/case.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"

static status run(const case_type *type, const char *chosen, int n, const char *const assignment[],
                  cell_result *r)
{
    cell_request request = cells_of(type, chosen, n);
    fault f = {""};
    cells_set(&request, assignment);
    const status outcome = cell_run(&request, r, &f);
    gsl_test(outcome != STATUS_OK, "%s solved with %s: %s", type->name, chosen, f.text);
    return outcome;
}

static double value_of(const char *case_name, const char *chosen, int n,
                       const char *const assignment[], const char *quantity)
{
    cell_result r;
    run(case_find(case_name, NULL), chosen, n, assignment, &r);
    const double value = cells_value(&r, quantity);
    cell_result_free(&r);
    return value;
}

/* k = Omega L/c = 1/2 with c the speed of sound: L (tan k/k - 1), by elements of higher order and
 * in the limit of the others. */
static void stretch(void)
{
    const char *const thick[] = {"omega_star=5", "slenderness=10", NULL};
    const double exact = tan(0.5) / 0.5 - 1;
    gsl_test_rel(
        value_of("rotating_cantilever", "geometrically_exact:nodes=3", 64, thick, "stretch"), exact,
        1e-8, "stretch, elements with a middle node");
    static const char *const each[] = {"beamw:mass=lumped", "beamw:mass=consistent",
                                       "beamw:mass=averaged", "sheet_third", "collocation"};
    for (size_t i = 0; i < sizeof each / sizeof each[0]; i++) {
        const double a = value_of("rotating_cantilever", each[i], 64, thick, "stretch"),
                     b = value_of("rotating_cantilever", each[i], 128, thick, "stretch"),
                     c = value_of("rotating_cantilever", each[i], 256, thick, "stretch");
        const double coarse = (4 * b - a) / 3, fine = (4 * c - b) / 3;
        gsl_test_rel((16 * fine - coarse) / 15, exact, 1e-9, "stretch, %s: limit", each[i]);
    }
}

/* Whichever way equilibrium is found. */
static void algorithms(void)
{
    const char *const inclined[] = {"axis=0.7", "omega_star=12", "slenderness=30", NULL};
    static const char *const quantity[] = {"stretch", "flap_1", "lag_2"};
    for (int i = 0; i < 3; i++) {
        const double mixed =
            value_of("rotating_cantilever", "beamw_consistent", 6, inclined, quantity[i]);
        gsl_test_rel(value_of("rotating_cantilever", "beamw_consistent:newton=dense", 6, inclined,
                              quantity[i]),
                     mixed, 1e-9, "uncondensed: the same %s", quantity[i]);
        gsl_test_rel(value_of("rotating_cantilever", "beamw_consistent:newton=displacement", 6,
                              inclined, quantity[i]),
                     mixed, 1e-9, "in displacements: the same %s", quantity[i]);
        gsl_test_rel(
            value_of("rotating_cantilever", "geometrically_exact", 32, inclined, quantity[i]),
            value_of("rotating_cantilever", "beamw_consistent", 64, inclined, quantity[i]), 5e-5,
            "bent by an inclined axis: two formulations agree on %s", quantity[i]);
    }
}

enum { BODY };
static const parameter_type with_body_parameters[] = {
    [BODY] = {"body", "1", 0, 0, 1, NULL,
              "1: the tip is attached to a body whose reference point is elsewhere"},
    {0},
};

/* An inclined channel that turns about an axis beside it. */
static status build_with_body(const double value[], scene *s, fault *f)
{
    (void)f;
    static const double point[4][2] = {{0.1, 0.14}, {0, 0.14}, {0, -0.14}, {0.1, -0.14}},
                        thickness[3] = {0.012, 0.012, 0.012}, y_axis[3] = {0.1, 1, 0.2};
    section_spec spec = section_spec_walls(210e9, 80e9, 3, point, NULL, thickness);
    spec.density = 7800;
    const int profile = scene_add_section(s, &spec), root = scene_add_node(s, 0, 0, 0);
    const int tip = value[BODY] != 0
                        ? scene_add_attached(s, scene_add_node(s, 7.3, 0.9, -0.4), 6, 1, 0.5)
                        : scene_add_node(s, 6, 1, 0.5);
    scene_add_member(s, root, tip, profile, y_axis);
    scene_hold_all(s, root);
    scene_omit(s, FEATURE_SHEAR | FEATURE_WAGNER_TORQUE);
    const double end = 1;
    const int rotation = scene_add_rotation(
        s, 1, &end, 8, 0, (scene_rotating_frame){.omega = {3, -7, 21}, .centre = {-0.3, 0.2, 0}});
    for (int i = 0; i < 4; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "frequency_%d", i);
        scene_add_quantity(s, name, "Hz", rotation, scene_frequency(i, SCENE_ANY));
    }
    scene_add_quantity(s, "moved", "m", rotation, scene_coordinate(tip, SCENE_UY));
    return STATUS_OK;
}

/* The centrifugal and gyroscopic terms of a rigid offset: the same structure in other
 * coordinates. */
static void reference_point(void)
{
    static const case_type type = {.name = "with_body",
                                   .summary = "",
                                   .source = "",
                                   .parameters = {with_body_parameters},
                                   .build = build_with_body};
    static const char *const each[] = {"beamw_consistent", "beamw_consistent:mass=lumped",
                                       "geometrically_exact"};
    const char *const attached[] = {"body=1", NULL};
    for (int i = 0; i < 3; i++) {
        cell_result plain, body;
        run(&type, each[i], 4, NULL, &plain);
        run(&type, each[i], 4, attached, &body);
        gsl_test_rel(cells_value(&body, "moved"), cells_value(&plain, "moved"), 1e-9,
                     "%s: deflection with a body", each[i]);
        for (int k = 0; k < 4; k++) {
            char name[SCENE_NAME];
            snprintf(name, sizeof name, "frequency_%d", k);
            gsl_test_rel(cells_value(&body, name), cells_value(&plain, name), 1e-9,
                         "%s: %s with a body", each[i], name);
        }
        const step_record *last = &body.solve.step[body.solve.steps - 1];
        const iteration_record *end = &body.solve.iteration[last->first + last->iterations - 1];
        gsl_test(
            !(end[0].correction <= fmax(100 * end[-1].correction * end[-1].correction, 1e-13)),
            "%s: quadratic convergence with centrifugal stiffness at an offset (%.1e after %.1e)",
            each[i], end[0].correction, end[-1].correction);
        cell_result_free(&plain);
        cell_result_free(&body);
    }
}

/* Counted work of the same path with and without a rotating frame. */
static void at_rest(void)
{
    const char *const slow[] = {"omega=1e-6", NULL};
    cell_result rest, turning;
    run(case_find("c_cantilever", NULL), "beamw_consistent", 10, NULL, &rest);
    run(case_find("c_cantilever", NULL), "beamw_consistent", 10, slow, &turning);
    gsl_test(rest.counters.inertia_evaluations != 0,
             "a structure at rest: %ld evaluations of inertia", rest.counters.inertia_evaluations);
    gsl_test(turning.counters.inertia_evaluations < turning.counters.strain_evaluations,
             "one that turns: %ld evaluations of inertia, %ld of strains",
             turning.counters.inertia_evaluations, turning.counters.strain_evaluations);
    gsl_test(rest.counters.strain_evaluations != turning.counters.strain_evaluations,
             "both: %ld evaluations of strains", rest.counters.strain_evaluations);
    gsl_test_rel(cells_value(&turning, "load_at_w"), cells_value(&rest, "load_at_w"), 1e-9,
                 "hardly turning is at rest");
    cell_result_free(&rest);
    cell_result_free(&turning);
}

/* An inward beam buckles under its own centrifugal force, and the result says so. */
static void instability_is_named(void)
{
    const char *const inward[] = {"hub_radius=-2", "omega_star=4", NULL};
    cell_result r;
    run(case_find("rotating_cantilever", NULL), "beamw", 8, inward, &r);
    gsl_test(strstr(r.solve.reason, "divergence") == NULL, "the instability is named: %s",
             r.solve.reason);
    gsl_test(!(cells_value(&r, "growth") > 1), "and grows");
    cell_result_free(&r);
}

int main(void)
{
    stretch();
    algorithms();
    reference_point();
    at_rest();
    instability_is_named();
    return gsl_test_summary();
}
