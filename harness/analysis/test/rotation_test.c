/* Structures in steady rotation: results must be independent of the frame, the option values of the
 * formulation and the reference point of a body. Also tests frequencies of a free beam, and
 * solutions on fine meshes. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/case.h"
#include "elements/math/scalar.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"
#include "harness/tools/kit/scenes.h"

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

/* With k = Omega L/c = 1/2, where c is the speed of sound, the elongation of a bar of length L is L
 * (tan k/k - 1) at the angular velocity Omega. Elements of higher order must agree with it on one
 * mesh within 1e-8, other elements in the limit of fine meshes within 1e-9. */
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

static void rotation_tests(void)
{
    stretch();
    algorithms();
    reference_point();
    at_rest();
    instability_is_named();
}

/* A free beam has six rigid-body modes of frequency zero, then the bending modes (k_i L)^2
 * sqrt(EI/(rho A L^4)) with cos(k_i L) cosh(k_i L) = 1. The stiffness matrix is singular, so the
 * solver shifts it. */

enum { MODES = 10, RIGID = 6 };
static const double length = 2.385, thickness = 0.011, width = 0.017, young = 2.1e11,
                    density = 7300;
static const double root[2] = {4.7300407448627040, 7.8532046240958376};

static double exact(int i)
{
    const double height = i % 2 == 0 ? thickness : width, k = root[i / 2] / length;
    return k * k * sqrt(young * height * height / 12 / density) / (2 * PI);
}

static void frequencies(const char *name, int elements, double allowed)
{
    cell_result r;
    scenes_solve("harness/analysis/test/bars.yaml", name, elements, &r, "bar=free");
    for (int i = 0; i < MODES && i < r.solve.quantities; i++) {
        const double value = r.solve.quantity[i].value;
        if (i < RIGID)
            gsl_test_abs(value, 0, 1e-3 * exact(0), "%s: motion %d of a rigid body", name, i);
        else
            gsl_test_rel(value, exact(i - RIGID), allowed, "%s: frequency %d", name, i - RIGID);
    }
    gsl_test_int(r.solve.quantities, MODES, "all of them");
    cell_result_free(&r);
}

static void free_beam_tests(void)
{
    frequencies("beamw_vlasov", 32, 1e-5);
    frequencies("beamw_first", 32, 1e-5);
    frequencies("beamw_vlasov", 600, 2e-7);
    frequencies("beamw_vlasov", 2400, 2e-7);
}

static double solve_value_of(const char *case_name, const char *formulation_text, int n,
                             int keep_all, const char *assignment, const char *quantity,
                             long *iterations)
{
    cell_request request = cells_of(case_find(case_name, NULL), formulation_text, n);
    cell_result result;
    fault f = {""};
    if (assignment[0] != '\0')
        cells_set(&request, (const char *const[]){assignment, NULL});
    request.keep_all = keep_all;
    gsl_test(cell_run(&request, &result, &f) != STATUS_OK, "%s solved with %s (%s)", case_name,
             formulation_text, f.text);
    const double value = cells_value(&result, quantity);
    if (iterations != NULL)
        *iterations = result.counters.iterations;
    cell_result_free(&result);
    return value;
}

static void leaving_out_changes_nothing(void)
{
    static const struct {
        const char *case_name, *quantity;
    } pairs[] = {{"c_column", "buckling_load"},
                 {"warping_torsion", "twist_ratio"},
                 {"sheet_cantilever", "C_zz"},
                 {"elastica", "theta"},
                 {"wagner_torsion", "shortening"}};
    for (size_t i = 0; i < 4; i++) {
        const double lean =
            solve_value_of(pairs[i].case_name, "beamw", 4, 0, "", pairs[i].quantity, NULL);
        const double full =
            solve_value_of(pairs[i].case_name, "beamw", 4, 1, "", pairs[i].quantity, NULL);
        gsl_test_rel(full, lean, 1e-10, "%s: keeping everything gives the same %s",
                     pairs[i].case_name, pairs[i].quantity);
    }
}

static void newton(void)
{
    long mixed = 0, displacement = 0;
    const double a =
        solve_value_of("sheet_cantilever", "beamw_consistent", 4, 0, "", "C_xx", &mixed);
    const double b = solve_value_of("sheet_cantilever", "beamw_consistent:newton=displacement", 4,
                                    0, "", "C_xx", &displacement);
    gsl_test_rel(b, a, 1e-9, "both kinds of Newton find the same equilibrium");
    const double c =
        solve_value_of("sheet_cantilever", "beamw_consistent:newton=dense", 4, 0, "", "C_xx", NULL);
    gsl_test_rel(c, a, 1e-10, "and so does the uncondensed system");
    gsl_test(!(mixed <= 4 * 15),
             "mixed Newton takes at most four iterations a step (%ld in 15 steps)", mixed);
}

static void no_element_is_turned_round(void)
{
    const double value = solve_value_of("spherical_joint", "beamw_consistent", 32, 0, "wagner=0",
                                        "support_stiffness_max", NULL);
    gsl_test_rel(value, 953153.87, 1e-3,
                 "spherical joint on fine meshes: no silent jump to a reversed element");
}

static void fine_mesh(void)
{
    const double coarse =
        solve_value_of("c_column", "beamw_vlasov", 256, 0, "shear=0", "buckling_load", NULL);
    const double fine =
        solve_value_of("c_column", "beamw_vlasov", 1024, 0, "shear=0", "buckling_load", NULL);
    const double exact = 16117335.51891;
    gsl_test_rel(fine, exact, 2e-6, "1024 elements: %.3g from the exact load", fine / exact - 1);
    const double order = log((coarse - exact) / (fine - exact)) / log(4);
    gsl_test(!(fabs(order - 2) < 0.1), "round-off does not hide the order on 1024 elements (%.2f)",
             order);
}

static void frame_of_strips(void)
{
    const double exact = 0.6222080872197;
    for (int n = 8; n <= 32; n *= 2) {
        const double moment = solve_value_of("right_angle_frame", "beamw_consistent", n, 0, "",
                                             "critical_moment", NULL);
        gsl_test_rel((moment / exact - 1) * n * n, 0.411, 0.01,
                     "right-angle frame of %d elements a leg: second order", n);
    }
}

static void equal_elements(void)
{
    const double critical = solve_value_of("lateral_buckling", "geometrically_exact", 256, 0,
                                           "load=mid", "load_factor", NULL);
    gsl_test_rel(critical, 16.93613215047, 1e-6, "lateral buckling with 512 elements");
}

static void modes_in_place(void)
{
    for (int keep_all = 0; keep_all < 2; keep_all++)
        for (int k = 1; k <= 13; k++) {
            char name[SCENE_NAME];
            snprintf(name, sizeof name, "frequency_%d", k);
            const double value =
                solve_value_of("c_column", "beamw_consistent", 2, keep_all, "", name, NULL);
            gsl_test(isfinite(value) != (k <= 12), "c_column, keep_all = %d: %s is %g Hz", keep_all,
                     name, value);
        }
}

static void solve_tests(void)
{
    modes_in_place();
    leaving_out_changes_nothing();
    newton();
    no_element_is_turned_round();
    fine_mesh();
    frame_of_strips();
    equal_elements();
}

int main(void)
{
    rotation_tests();
    free_beam_tests();
    solve_tests();
    return gsl_test_summary();
}
