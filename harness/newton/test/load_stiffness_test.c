/* Stiffness of loads on nodes of a rigid body in a turned state: the second derivative of their
 * work, or what the loads change by. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/newton/test/turned_body.h"

/* A dead force has a potential: its stiffness is the second derivative of the work, with the sign
 * of K. */
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

/* Where the coordinates are angles, the stiffness is what the generalised loads change by, also of
 * a moment or of a load that follows, which have no potential. at [m]: beside the node. */
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

int main(void)
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
    return gsl_test_summary();
}
