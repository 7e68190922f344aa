/* Loads along members and at offsets: force and moment of all of them, in member axes of any
 * section; an offset is a rigid arm. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/test/sections.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/tools/kit/scenes.h"

enum { MOST = 120 };
static const double along[3] = {0.6, 0.8, 0}, across[3] = {-0.8, 0.6, 0};

/* A leg longer than the other: principal axes off the walls. */
static int add_angle(scene *s)
{
    static const double point[3][2] = {{0, 0}, {0.1, 0}, {0, 0.05}}, thickness[2] = {0.01, 0.01};
    static const int ends[2][2] = {{0, 1}, {0, 2}};
    section_spec spec = section_spec_walls(2e5, 8e4, 2, point, ends, thickness);
    spec.density = 3;
    return scene_add_section(s, &spec);
}

static void to_fixed(const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = along[i] * v[0] + across[i] * v[1] + (i == 2 ? v[2] : 0);
}

/* Force of the loads on a member of length 2 at rest, and their moment about its middle.
 */
static void sums_of(const scene_load *load, const char *name, double force[3], double moment[3])
{
    const double end = 1;
    formulation chosen;
    scene s;
    model *m = NULL;
    fault f = {""};
    double residual[MOST];
    scene_init(&s, "member");
    const int p = scene_add_node(&s, 0, 0, 0),
              q = scene_add_node(&s, 2 * along[0], 2 * along[1], 0);
    scene_add_member(&s, p, q, add_angle(&s), across);
    scene_add_static(&s, 1, &end, 1);
    *scene_load_at(&s, scene_add_load(&s, load->kind, 0, 0, 0, 0)) = *load;
    gsl_test(formulation_parse(name, &chosen, &f) != STATUS_OK ||
                 scene_validate(&s, &f) != STATUS_OK,
             "%s", f.text);
    const model_request request = {&s, chosen.type, chosen.option, 3, 0};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s: %s", name, f.text);
    run_state run;
    model_linearisation lin = {.path = 1, .residual = residual};
    run_state_begin(&run, m, 1, NULL);
    equations eq = {.m = m, .run = &run};
    gsl_test(linearise_state(&eq, &run.memory, kinematics_rest(m), &lin, &f) != STATUS_OK, "%s: %s",
             name, f.text);
    run_state_end(&run);
    for (int i = 0; i < 3; i++)
        force[i] = moment[i] = 0;
    for (int k = 0; k < model_sizes(m).vertices; k++) {
        double r[3], q4[4], here[3], turning[3];
        kinematics_frame(m, kinematics_rest(m), k, r, q4);
        for (int i = 0; i < 3; i++) {
            here[i] = residual[kinematics_coordinate(m, k, SCENE_UX + i)];
            force[i] += here[i];
            moment[i] += residual[kinematics_coordinate(m, k, SCENE_RX + i)];
            r[i] -= along[i];
        }
        vec3_cross(r, here, turning);
        for (int i = 0; i < 3; i++)
            moment[i] += turning[i];
    }
    model_free(m);
    scene_free(&s);
}

static void along_a_member(const char *name)
{
    static const double v[3] = {1, -2, 3}, at[3] = {0, 0.5, -0.25};
    double F[3], M[3], fixed[3], arm[3], expected[3];
    scene_load load = scene_load_of(SCENE_DISTRIBUTED, 0, v[0], v[1], v[2]);
    load.axes = SCENE_AXES_MEMBER;
    memcpy(load.at, at, sizeof at);
    to_fixed(v, fixed);
    to_fixed(at, arm);
    vec3_cross(arm, fixed, expected);
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], 2 * fixed[i], 1e-13, "%s: force %d in member axes", name, i);
        gsl_test_abs(M[i], 2 * expected[i], 1e-13, "%s: moment %d of its offset", name, i);
    }
    load.axes = SCENE_AXES_FIXED;
    vec3_cross(at, v, expected);
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], 2 * v[i], 1e-13, "%s: force %d in fixed axes", name, i);
        gsl_test_abs(M[i], 2 * expected[i], 1e-13, "%s: moment %d, fixed axes", name, i);
    }
    memset(load.at, 0, sizeof load.at);
    load.kind = SCENE_DISTRIBUTED_MOMENT;
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], 0, 1e-13, "%s: moments along a member are no force", name);
        gsl_test_abs(M[i], 2 * v[i], 1e-13, "%s: distributed moment %d", name, i);
    }
    load.kind = SCENE_GRAVITY;
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], 2 * 3 * 0.0015 * v[i], 1e-13, "%s: weight %d", name, i);
        gsl_test_abs(M[i], 0, 1e-13, "%s: weight acts at the centroids", name);
    }
}

/* A load that varies along a part of a member: q = (v + w)/2 + s (w - v), x = c + h s. */
static void along_a_part(const char *name, int lumped)
{
    static const double v[3] = {1, -2, 3}, w[3] = {-0.5, 1, 2}, range[2] = {0.15, 0.72};
    const double h = range[1] - range[0], c = (range[0] + range[1]) / 2;
    double F[3], M[3], arm[3], expected[3];
    scene_load load = scene_load_of(SCENE_DISTRIBUTED, 0, v[0], v[1], v[2]);
    load.varies = 1;
    load.lumped = lumped;
    memcpy(load.last, w, sizeof load.last);
    memcpy(load.range, range, sizeof load.range);
    for (int i = 0; i < 3; i++)
        arm[i] = 2 * h * ((2 * c - 1) * (v[i] + w[i]) / 2 + h * (w[i] - v[i]) / 6);
    vec3_cross(along, arm, expected);
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], h * (v[i] + w[i]), 1e-13, "%s: force %d of a part", name, i);
        gsl_test_abs(M[i], expected[i], 1e-13, "%s: moment %d of a part", name, i);
    }
}

/* A load at an offset of a bent cantilever's tip: force and reacting moment. */
static void cantilever(const element_type *type, int attached, int follower, double out[6])
{
    static const double P[3] = {0.2, -0.3, 0.4}, edge[3] = {0.1, 0.2, -0.3};
    const double end = 1;
    const section_spec spec = sections_of(1e4, 1, 1, 1);
    scene s;
    model *m = NULL;
    solve_result r = {0};
    fault f = {""};
    scene_init(&s, "cantilever");
    const int tip = scenes_cantilever(&s, &spec),
              where = attached ? scene_add_attached(&s, tip, 1 + edge[0], edge[1], edge[2]) : tip;
    scene_load *load = scene_load_at(&s, scene_add_load(&s, SCENE_FORCE, where, P[0], P[1], P[2]));
    load->follower = follower;
    if (!attached)
        memcpy(load->at, edge, sizeof edge);
    const int path = scene_add_static(&s, 1, &end, 1);
    static const char *const name[] = {"x", "y", "z", "mx", "my", "mz"};
    for (int i = 0; i < 6; i++)
        scene_add_quantity(&s, name[i], "1", path,
                           i < 3 ? scene_coordinate(tip, SCENE_UX + i)
                                 : scene_reaction(tip - 1, SCENE_UX + i));
    const model_request request = {&s, type, NULL, 4, 0};
    const int good = scene_validate(&s, &f) == STATUS_OK &&
                     model_alloc(&request, &m, &f) == STATUS_OK &&
                     solve_scene(&s, m, NULL, &r, &f) == STATUS_OK;
    gsl_test(!good, "%s: %s", type->name, f.text);
    for (int i = 0; i < 6; i++)
        out[i] = good ? r.quantity[i].value : NAN;
    result_free(&r);
    model_free(m);
    scene_free(&s);
}

static void offset_is_an_arm(const element_type *type)
{
    for (int follower = 0; follower < 2; follower++) {
        double arm[6], offset[6];
        cantilever(type, 1, follower, arm);
        cantilever(type, 0, follower, offset);
        for (int i = 0; i < 6; i++)
            gsl_test(!(fabs(offset[i] - arm[i]) <= 1e-11), "%s%s: %d is %.15g, on an arm %.15g",
                     type->name, follower ? ", follower" : "", i, offset[i], arm[i]);
        gsl_test(!(fabs(offset[1]) > 0.05), "%s: the tip moves", type->name);
    }
}

int main(void)
{
    static const char *const name[] = {"geometrically_exact:nodes=2", "geometrically_exact:nodes=3",
                                       "beamw_consistent"};
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        along_a_member(name[i]);
        along_a_part(name[i], 0);
        along_a_part(name[i], 1);
    }
    for (int i = 0; registry_formulations[i] != NULL; i++)
        offset_is_an_arm(registry_formulations[i]);
    return gsl_test_summary();
}
