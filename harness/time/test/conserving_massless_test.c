/* Rotations without inertia with the conserving scheme: what is kept is kept, their rates follow
 * the motion instead of changing their signs, a node turns by several angles; a scene where nothing
 * that turns has inertia is refused, as is a node that turns by two free angles. */
#include <stdio.h>

#include "harness/model/model.h"
#include "harness/time/test/flight.h"
#include "harness/tools/kit/scenes.h"

static const double massless_y_axis[] = {0, 1, 0};

static struct {
    double polar;
    int angles;
} massless_how = {20, 0};

/* A rod thrown by a force and a moment that come and go. */
static status massless_build(const double value[], scene *s, fault *f)
{
    static const double end = 10;
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 1e4, .GA = 1e4, .GJ = 500, .EI = 500, .mass = 1, .polar = massless_how.polar});
    const int profile = scene_add_section(s, &spec), A = scene_add_node(s, 0, 0, 0),
              B = scene_add_node(s, 6, 0, 0);
    (void)value, (void)f;
    scene_add_member(s, A, B, profile, massless_y_axis);
    const int loads[] = {scene_add_load(s, SCENE_FORCE, B, 0.1, 0, 0),
                         scene_add_load(s, SCENE_MOMENT, B, 0.2, 1, 0.5)};
    for (int i = 0; i < 2; i++) {
        scene_load_piece(s, loads[i], 1, "40*t^2*(1 - t)^2");
        scene_load_piece(s, loads[i], 0, "0");
    }
    if (massless_how.angles) {
        scene_node *n = scene_node_at(s, A);
        scene_hold(s, A, SCENE_UX, SCENE_UZ);
        n->rotation = SCENE_ROTATION_SEQUENCE;
        for (int k = 0; k < massless_how.angles; k++) {
            n->axis[k][k] = 1;
            n->angle[k] = SCENE_FREE;
        }
    }
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_motion(s, SCENE_NONE, 1, &end,
                     (scene_motion){.scheme = SCENE_CONSERVING,
                                    .alpha = scene_alpha_of_radius(0.9),
                                    .step = 0.05});
    return STATUS_OK;
}

/* Largest change of a rate of rotation from one step to the next [rad/s]. */
static double roughest(double h)
{
    flight f;
    double rough = 0, energy = 0, drift = 0, angular = 0, before[6] = {0};
    inertia_balance kept = {0};
    status outcome = flight_begin(&f, massless_build, "geometrically_exact", 4);
    for (int i = 0; i < 10 / h && outcome == STATUS_OK; i++) {
        outcome = flight_step(&f, h);
        if (f.now.time < 1 + 1.5 * h) {
            energy = flight_energy(&f);
            kept = flight_inertia(&f);
        }
        drift = fmax(drift, i * h < 2 ? 0 : fabs(flight_energy(&f) / energy - 1));
        const inertia_balance now = flight_inertia(&f);
        for (int k = 0; k < 3; k++)
            angular = fmax(angular, i * h < 2 ? 0 : fabs(now.angular[k] - kept.angular[k]));
        for (int k = 0; k < 6; k++) {
            const double rate = f.now.v[model_vertex(f.m, k / 3)->coordinate[SCENE_RX + k % 3]];
            rough = fmax(rough, fabs(rate - before[k]));
            before[k] = rate;
        }
    }
    gsl_test(outcome != STATUS_OK, "%g s: %s", h, f.why.text);
    gsl_test(!(drift < 1e-12 && angular < 1e-12 * vec3_norm(kept.angular)),
             "%g s: energy %.1e, angular momentum %.1e", h, drift, angular);
    flight_end(&f);
    return rough;
}

static void refused(const char *words)
{
    flight f;
    const status outcome = flight_begin(&f, massless_build, "geometrically_exact", 2);
    gsl_test(outcome != STATUS_REFUSED || strstr(f.why.text, words) == NULL, "refused: %s",
             f.why.text);
    flight_end(&f);
}

/* A node that turns by three angles, which carry each other, keeps energy. */
static void by_angles(void)
{
    flight f;
    double energy = 0, drift = 0;
    status outcome = flight_begin(&f, massless_build, "geometrically_exact", 2);
    for (int i = 0; i < 200 && outcome == STATUS_OK; i++) {
        outcome = flight_step(&f, 0.05);
        energy = i == 30 ? flight_energy(&f) : energy;
        drift = fmax(drift, i <= 30 ? 0 : fabs(flight_energy(&f) / energy - 1));
    }
    gsl_test(outcome != STATUS_OK, "by angles: %s", f.why.text);
    gsl_test(!(energy > 1e-3 && drift < 1e-11), "by angles: %g J, and energy drifts by %.1e",
             energy, drift);
    flight_end(&f);
}

int main(void)
{
    const double first = roughest(0.05), second = roughest(0.025);
    gsl_test(!(fabs(first / second - 2) < 0.4), "rates follow the motion: they change by %g and %g",
             first, second);
    massless_how.polar = 0;
    refused("no rotation has inertia");
    massless_how.polar = 20;
    massless_how.angles = 3;
    by_angles();
    massless_how.angles = 2;
    refused("two free angles");
    return gsl_test_summary();
}
