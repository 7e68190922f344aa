/* Loads on nodes of a rotated rigid body must be the derivatives of their work within 1e-9, must
 * follow their factors along the path, and must have their derivatives in the tangent within
 * 1e-5. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton_impl.h"
#include "harness/newton/test/turned_body.h"
#include "harness/tools/kit/scenes.h"

static double slope(const turned_body *s, int k)
{
    return (8 * (turned_body_work_at(s, k, turned_body_step, -1, 0) -
                 turned_body_work_at(s, k, -turned_body_step, -1, 0)) -
            (turned_body_work_at(s, k, 2 * turned_body_step, -1, 0) -
             turned_body_work_at(s, k, -2 * turned_body_step, -1, 0))) /
           (12 * turned_body_step);
}

static void conjugate(int body, scene_load_kind kind)
{
    turned_body s;
    double load[MOST], F[6], at[3], edge[3], q[4], arm[3], moment[3];
    turned_body_prepare(body, kind, &s);
    turned_body_loads(&s, load);
    for (int k = 0; k < s.n; k++)
        gsl_test(!(fabs(load[k] - slope(&s, k)) <= 1e-9),
                 "%s, %s: load %d is %.12g, its work rises by %.12g", turned_body_name[body],
                 kind == SCENE_FORCE ? "force" : "moment", k, load[k], slope(&s, k));
    kinematics_frame(s.m, s.turned, 1, at, q);
    kinematics_frame(s.m, s.turned, 2, edge, q);
    for (int i = 0; i < 3; i++)
        arm[i] = edge[i] - at[i];
    vec3_cross(arm, s.scene.load[0].vector, moment);
    run_state run;
    run_state_begin(&run, s.m, 1, NULL);
    equations eq = {.m = s.m, .run = &run};
    loads_at_node(&eq, s.turned, kinematics_state_path(s.turned), 1, F);
    run_state_end(&run);
    for (int i = 0; i < 3; i++) {
        const double v = s.scene.load[0].vector[i], force = kind == SCENE_FORCE ? v : 0,
                     m = kind == SCENE_FORCE ? moment[i] : v;
        gsl_test(!(fabs(F[i] - force) <= 1e-14) || !(fabs(F[3 + i] - m) <= 1e-14),
                 "%s: force and moment on the body: %g, %g", turned_body_name[body], F[i],
                 F[3 + i]);
    }
    turned_body_release(&s);
}

static void follow_stations(scene_load *load, const double path[3], const double value[3])
{
    load->stations = 3;
    load->path = malloc(3 * sizeof *path);
    load->factor = malloc(3 * sizeof *value);
    memcpy(load->path, path, 3 * sizeof *path);
    memcpy(load->factor, value, 3 * sizeof *value);
}

static void rates(void)
{
    static const double path[] = {0, 1, 3}, value[] = {0, 2, 1};
    static const struct {
        double path, rate;
    } row[] = {{-1, 0}, {0, 2}, {0.5, 2}, {1, -0.5}, {2, -0.5}, {3, 0}, {4, 0}};
    turned_body s;
    run_state run;
    double unit[MOST], out[MOST];
    turned_body_prepare(FREE_TURNS, SCENE_FORCE, &s);
    turned_body_loads(&s, unit);
    run_state_begin(&run, s.m, 1, NULL);
    equations eq = {.m = s.m, .run = &run};
    loads_rate(&eq, s.turned, 0.3, out);
    for (int k = 0; k < s.n; k++)
        gsl_test_abs(out[k], unit[k], 1e-11, "proportional load: its rate is itself");
    follow_stations(&s.scene.load[0], path, value);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        loads_rate(&eq, s.turned, row[i].path, out);
        for (int k = 0; k < s.n; k++)
            gsl_test(!(fabs(out[k] - row[i].rate * unit[k]) <= 1e-11),
                     "rate at path %g: %g of the load, not %g", row[i].path, out[k] / unit[k],
                     row[i].rate);
    }
    run_state_end(&run);
    turned_body_release(&s);
}

static void factors(void)
{
    static const double path[] = {0.5, 1, 3}, value[] = {0.25, 2, 1};
    static const double row[][2] = {{0, 0.25}, {0.5, 0.25}, {0.75, 1.125}, {1, 2},
                                    {2, 1.5},  {3, 1},      {4, 1}};
    turned_body s;
    turned_body_prepare(FREE_TURNS, SCENE_FORCE, &s);
    follow_stations(&s.scene.load[0], path, value);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        double F[6];
        fault f = {""};
        double residual[MOST], dx[MOST] = {0};
        run_state run;
        model_linearisation lin = {.path = row[i][0], .residual = residual};
        run_state_begin(&run, s.m, 1, NULL);
        equations eq = {.m = s.m, .run = &run};
        linearise_state(&eq, &run.memory, s.turned, &lin, &f);
        advance_state(&eq, &run.memory, s.turned, dx, row[i][0], NULL);
        loads_at_node(&eq, s.turned, kinematics_state_path(s.turned), 1, F);
        run_state_end(&run);
        gsl_test_abs(F[0], row[i][1] * s.scene.load[0].vector[0], 1e-14, "factor at path %g",
                     row[i][0]);
    }
    turned_body_release(&s);
}

static void reference(void)
{
    static const double path[] = {0.5, 1, 3}, value[] = {0.25, 2, 1};
    const double end = 1, at = 0.75, expected[2] = {3 * 0.75, -5 * 1.125};
    const section_spec spec = sections_of(1, 1, 1, 1);
    formulation chosen;
    scene s;
    model *m = NULL;
    fault f = {""};
    double out[MOST];
    scene_init(&s, "two loads");
    const int tip = scenes_cantilever(&s, &spec);
    scene_add_load(&s, SCENE_FORCE, tip, 3, 0, 0);
    follow_stations(scene_load_at(&s, scene_add_load(&s, SCENE_FORCE, tip, 0, -5, 0)), path, value);
    scene_add_static(&s, 1, &end, 1);
    formulation_parse("beamw", &chosen, &f);
    const model_request request = {
        .scene = &s, .type = chosen.type, .options = chosen.option, .elements = 1};
    const int good =
        scene_validate(&s, &f) == STATUS_OK && model_alloc(&request, &m, &f) == STATUS_OK;
    gsl_test(!good, "%s", f.text);
    if (!good)
        return;
    run_state run;
    run_state_begin(&run, m, 1, NULL);
    equations eq = {.m = m, .run = &run};
    loads_reference(&eq, at, out);
    run_state_end(&run);
    for (int i = 0; i < 2; i++)
        gsl_test_abs(out[kinematics_coordinate(m, tip, SCENE_UX + i)], expected[i], 1e-14,
                     "load %d at path %g", i, at);
    model_free(m);
    scene_free(&s);
}

static void loads_tests(void)
{
    for (int body = 0; body < BODIES; body++) {
        conjugate(body, SCENE_FORCE);
        conjugate(body, SCENE_MOMENT);
    }
    rates();
    factors();
    reference();
}

static void stiffness(int body)
{
    turned_body s;
    fault f = {""};
    const sparse *pattern;
    sparse K;
    run_state run;
    turned_body_prepare(body, SCENE_FORCE, &s);
    run_state_begin(&run, s.m, 1, NULL);
    const equations eq = {.m = s.m, .run = &run};
    gsl_test(assemble_pattern_of_states(s.m, run.patterns, 0, &pattern, &f) != STATUS_OK ||
                 sparse_alloc_like(pattern, &K, &f) != STATUS_OK,
             "pattern");
    rotating_frame_load_stiffness(&eq, s.turned, 1, &K);
    double largest = 0;
    for (int j = 0; j < s.n; j++)
        for (int k = K.column[j]; k < K.column[j + 1]; k++) {
            const int i = K.row[k];
            const double h = turned_body_step, mixed = turned_body_work_at(&s, i, h, j, h) -
                                                       turned_body_work_at(&s, i, h, j, -h) -
                                                       turned_body_work_at(&s, i, -h, j, h) +
                                                       turned_body_work_at(&s, i, -h, j, -h);
            gsl_test(!(fabs(K.value[k] + mixed / (4 * h * h)) <= 1e-5),
                     "%s: stiffness (%d, %d) of a force: %.8g, not %.8g", turned_body_name[body], i,
                     j, K.value[k], -mixed / (4 * h * h));
            largest = fmax(largest, fabs(K.value[k]));
        }
    gsl_test(!(largest > 0.1), "%s: the force has a stiffness: %g", turned_body_name[body],
             largest);
    sparse_free_values(&K);
    run_state_end(&run);
    turned_body_release(&s);
}

/* If coordinates are angles, the load's part of K is minus the derivative of the generalised
 * load. */
static void stiffness_of_angles(int body, scene_load_kind kind, int follower, const double at[3])
{
    turned_body s;
    fault f = {""};
    const sparse *pattern;
    sparse K;
    run_state run;
    turned_body_prepare(body, kind, &s);
    s.scene.load[0].follower = follower;
    memcpy(s.scene.load[0].at, at, sizeof s.scene.load[0].at);
    run_state_begin(&run, s.m, 1, NULL);
    const equations eq = {.m = s.m, .run = &run};
    gsl_test(assemble_pattern_of_states(s.m, run.patterns, 0, &pattern, &f) != STATUS_OK ||
                 sparse_alloc_like(pattern, &K, &f) != STATUS_OK,
             "pattern");
    gsl_test((follower || kind == SCENE_MOMENT) && K.symmetric, "%s: an unsymmetric pattern",
             turned_body_name[body]);
    rotating_frame_load_stiffness(&eq, s.turned, 1, &K);
    for (int j = 0; j < s.n; j++) {
        double load[2][MOST];
        for (int side = 0; side < 2; side++) {
            double dx[MOST] = {0};
            turned_body there = s;
            dx[j] = side == 0 ? -turned_body_step : turned_body_step;
            turned_body_move(&s, s.turned, dx, s.moved);
            there.turned = s.moved;
            turned_body_loads(&there, load[side]);
        }
        for (int k = K.column[j]; k < K.column[j + 1]; k++) {
            const int i = K.row[k];
            const double change = (load[1][i] - load[0][i]) / (2 * turned_body_step);
            gsl_test(!(fabs(K.value[k] + change) <= 1e-5),
                     "%s, %s: stiffness (%d, %d) is %.8g, the load changes by %.8g",
                     turned_body_name[body], kind == SCENE_FORCE ? "force" : "moment", i, j,
                     K.value[k], change);
        }
    }
    sparse_free_values(&K);
    run_state_end(&run);
    turned_body_release(&s);
}

static void load_stiffness_tests(void)
{
    for (int body = 0; body < BODIES; body++)
        stiffness(body);
    for (int body = THREE_ANGLES; body <= TWO_ANGLES; body++) {
        static const double here[3] = {0, 0, 0}, there[3] = {-0.2, 0.5, 0.9};
        for (int follower = 0; follower < 2; follower++) {
            stiffness_of_angles(body, SCENE_FORCE, follower, here);
            stiffness_of_angles(body, SCENE_FORCE, follower, there);
            stiffness_of_angles(body, SCENE_MOMENT, follower, here);
        }
    }
}

int main(void)
{
    loads_tests();
    load_stiffness_tests();
    return gsl_test_summary();
}
