/* A rigid body is what its points are: masses without inertia at attached nodes give the motions of
 * one body with their centre and inertia, at rest, loaded and in a frame that turns, wherever on
 * the body it is said to be, and however the body may turn. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

enum { AS, SUPPORT, LOADED };
enum { POINTS, AT_HUB, BESIDE };
enum { FREE, HINGED };
enum { MASSES = 4, MODES = 4 };

static const parameter_type parameter[] = {
    [AS] = {"as", "", 0, 0, 0, "points|hub|beside", "how the body is described"},
    [SUPPORT] = {"support", "", 0, 0, 0, "free|hinged", "how it turns"},
    [LOADED] = {"loaded", "1", 1, 0, 1, NULL, "1: frequencies about a loaded state too"},
    {0},
};

static const double mass[MASSES] = {0.31, 0.17, 0.23, 0.41}, hub_at[3] = {0.53, 0.11, -0.07},
                    point[MASSES][3] = {{0.61, 0.05, 0.03},
                                        {0.47, 0.19, -0.01},
                                        {0.58, 0.13, -0.16},
                                        {0.66, 0.02, -0.09}};

/* Of the points, its centre from `from`. */
static scene_body body_of_points(const double from[3])
{
    scene_body b = {0};
    double centre[3] = {0};
    for (int k = 0; k < MASSES; k++) {
        b.mass += mass[k];
        for (int i = 0; i < 3; i++)
            centre[i] += mass[k] * point[k][i];
    }
    for (int i = 0; i < 3; i++) {
        centre[i] /= b.mass;
        b.centre[i] = centre[i] - from[i];
    }
    for (int k = 0; k < MASSES; k++)
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, l = (i + 2) % 3;
            const double x = point[k][i] - centre[i], y = point[k][j] - centre[j],
                         z = point[k][l] - centre[l];
            b.inertia[i] += mass[k] * (y * y + z * z);
            b.inertia[3 + i] -= mass[k] * x * y;
        }
    return b;
}

static void add_body(scene *s, int hub, int as)
{
    if (as == POINTS)
        for (int k = 0; k < MASSES; k++)
            scene_set_body(s, scene_add_attached(s, hub, point[k][0], point[k][1], point[k][2]),
                           (scene_body){.mass = mass[k]});
    if (as == AT_HUB)
        scene_set_body(s, hub, body_of_points(hub_at));
    if (as == BESIDE)
        scene_set_body(s, scene_add_attached(s, hub, point[2][0], point[2][1], point[2][2]),
                       body_of_points(point[2]));
}

static void add_frequencies(scene *s, int analysis, const char *stem)
{
    for (int i = 0; i < MODES; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "%s_%d", stem, i);
        scene_add_quantity(s, name, "Hz", analysis, scene_frequency(i, SCENE_ANY));
    }
}

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[3] = {0.1, 1, 0.2}, end = 1;
    (void)f;
    section_spec spec = section_spec_rectangle(2.1e11, 8e10, 0.02, 0.004);
    spec.density = 7800;
    const int profile = scene_add_section(s, &spec), root = scene_add_node(s, 0, 0, 0),
              hub = scene_add_node(s, hub_at[0], hub_at[1], hub_at[2]),
              tip = scene_add_attached(s, hub, 0.5, 0.08, 0.02);
    scene_add_member(s, root, tip, profile, y_axis);
    scene_hold_all(s, root);
    if (value[SUPPORT] == HINGED) {
        scene_node *n = scene_node_at(s, hub);
        n->rotation = SCENE_ROTATION_SEQUENCE;
        memcpy(n->axis[0], (const double[3]){0.2, 1, 0.3}, sizeof n->axis[0]);
        memcpy(n->axis[1], (const double[3]){0.7, -0.1, 1}, sizeof n->axis[1]);
    }
    add_body(s, hub, (int)value[AS]);
    scene_add_load(s, SCENE_FORCE, tip, 0, 11, 17);
    add_frequencies(s, scene_add_modal(s, SCENE_NONE), "rest");
    if (value[LOADED] != 0)
        add_frequencies(s, scene_add_modal(s, scene_add_static(s, 1, &end, 4)), "loaded");
    const int rotation =
        scene_add_rotation(s, 1, &end, 8, 2 * MODES,
                           (scene_rotating_frame){.omega = {3, -7, 11}, .centre = {-0.3, 0.2, 0}});
    add_frequencies(s, rotation, "turning");
    scene_add_quantity(s, "moved", "m", rotation, scene_coordinate(tip, SCENE_UY));
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "reaction_%d", c);
        scene_add_quantity(s, name, c < SCENE_RX ? "N" : "N m", rotation, scene_reaction(root, c));
    }
    return STATUS_OK;
}

static const case_type with_body = {.name = "with_body",
                                    .summary = "a case of the test",
                                    .source = "none",
                                    .parameters = {parameter},
                                    .build = build};

static void body_solve(const char *chosen, int as, int support, int loaded, cell_result *r)
{
    cell_request request = {.type = &with_body, .elements = 3};
    formulation fm;
    fault f = {""};
    gsl_test(formulation_parse(chosen, &fm, &f) != STATUS_OK, "%s exists", chosen);
    request.parameter[AS] = as;
    request.parameter[SUPPORT] = support;
    request.parameter[LOADED] = loaded;
    request.formulation = fm.type;
    request.solve.newton = formulation_newton(&fm);
    memcpy(request.option, fm.option, sizeof request.option);
    gsl_test(cell_run(&request, r, &f) != STATUS_OK, "%s solved: %s", chosen, f.text);
    gsl_test_int(r->solve.quantities, (2 + loaded) * MODES + 7, "%s: all quantities", chosen);
}

static void compare(const cell_result *a, const cell_result *b, double allowed, const char *what)
{
    for (int i = 0; i < a->solve.quantities && i < b->solve.quantities; i++)
        gsl_test_rel(b->solve.quantity[i].value, a->solve.quantity[i].value, allowed, "%s: %s",
                     what, a->scene.quantity[i].name);
}

static void descriptions(const char *chosen, int support)
{
    static const char *const as[] = {"points", "one body at the hub", "one body beside it"};
    cell_result points, other;
    body_solve(chosen, POINTS, support, 1, &points);
    for (int i = AT_HUB; i <= BESIDE; i++) {
        char what[120];
        snprintf(what, sizeof what, "%s, support %d, %s", chosen, support, as[i]);
        body_solve(chosen, i, support, 1, &other);
        compare(&points, &other, 1e-9, what);
        cell_result_free(&other);
    }
    cell_result_free(&points);
}

static void algorithms(void)
{
    static const char *const form[] = {"collocation:newton=dense",
                                       "collocation:newton=displacement"};
    cell_result mixed, other;
    body_solve("collocation", AT_HUB, FREE, 0, &mixed);
    for (int i = 0; i < 2; i++) {
        body_solve(form[i], AT_HUB, FREE, 0, &other);
        compare(&mixed, &other, 1e-8, form[i]);
        cell_result_free(&other);
    }
    cell_result_free(&mixed);
}

int main(void)
{
    static const char *const chosen[] = {"geometrically_exact", "beamw_consistent", "collocation"};
    for (int i = 0; i < 3; i++)
        for (int support = FREE; support <= HINGED; support++)
            descriptions(chosen[i], support);
    algorithms();
    return gsl_test_summary();
}
