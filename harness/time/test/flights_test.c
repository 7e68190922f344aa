/* Free flights with the conserving scheme: energy and momenta over 40 s however stiff the rod is in
 * tension and shear, order 2, time reversal, and answers that neither the axes nor the direction of
 * the member change. */
#include <stdio.h>

#include "cases/scene/scene.h"
#include "harness/time/test/flight.h"
#include "harness/tools/kit/scenes.h"

static struct {
    double stiffening, turn[4]; /* the scene's axes, a quaternion */
} how = {1, {1, 0, 0, 0}};

static const double flights_h = 0.05, thrown = 5; /* [s] a step; until then the loads act */

/* The rod of free_flight_space. */
static status flights_build(const double value[], scene *s, fault *f)
{
    static const double end = 50, y[3] = {0, 1, 0}, at[2][3] = {{0, 0, 8}, {6, 0, 0}},
                        force[3] = {0.1, 0, 0}, moment[3] = {0, 1, 0.5};
    const double k = how.stiffening;
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 1e4 * k, .GA = 1e4 * k, .GJ = 500, .EI = 500, .mass = 1, .polar = 20, .rotary = 10});
    const int profile = scene_add_section(s, &spec);
    double v[5][3];
    (void)value, (void)f;
    rotation_apply(how.turn, y, v[0]);
    rotation_apply(how.turn, at[0], v[1]);
    rotation_apply(how.turn, at[1], v[2]);
    rotation_apply(how.turn, force, v[3]);
    rotation_apply(how.turn, moment, v[4]);
    const int A = scene_add_node(s, v[1][0], v[1][1], v[1][2]),
              B = scene_add_node(s, v[2][0], v[2][1], v[2][2]);
    scene_add_member(s, A, B, profile, v[0]);
    const int loads[] = {scene_add_load(s, SCENE_FORCE, B, v[3][0], v[3][1], v[3][2]),
                         scene_add_load(s, SCENE_MOMENT, B, v[4][0], v[4][1], v[4][2])};
    for (int i = 0; i < 2; i++) {
        scene_load_piece(s, loads[i], 2.5, "80*t");
        scene_load_piece(s, loads[i], thrown, "400 - 80*t");
        scene_load_piece(s, loads[i], 0, "0");
    }
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_motion(s, SCENE_NONE, 1, &end,
                     (scene_motion){.scheme = SCENE_CONSERVING,
                                    .alpha = scene_alpha_of_radius(0.9),
                                    .step = flights_h});
    return STATUS_OK;
}

static status reversed(const double value[], scene *s, fault *f)
{
    static const scene_edit edit = {SCENE_EDIT_REVERSE, 0};
    TRY(flights_build(value, s, f));
    return scene_edit_apply(s, &edit, f);
}

/* So many steps; a failure fails the test. */
static void fly(flight *f, int steps, double step)
{
    status outcome = STATUS_OK;
    for (int i = 0; i < steps && outcome == STATUS_OK; i++)
        outcome = flight_step(f, step);
    gsl_test(outcome != STATUS_OK, "EA x %g, steps of %g s: %s", how.stiffening, step, f->why.text);
}

/* Places of both ends, in the axes of the scene that is not turned. */
static void ends_of(const flight *f, double r[6])
{
    double back[4];
    rotation_conjugate(how.turn, back);
    for (int i = 0; i < 2; i++) {
        kinematics_position(f->m, f->now.state, i, r + 3 * i);
        rotation_apply(back, r + 3 * i, r + 3 * i);
    }
}

static double apart(const double a[6], const double b[6])
{
    double largest = 0;
    for (int i = 0; i < 6; i++)
        largest = fmax(largest, fabs(a[i] - b[i]));
    return largest;
}

/* Mean iterations of a step. */
static double long_flight(const char *with)
{
    flight f;
    double drift = 0, angular = 0, momentum = 0;
    gsl_test(flight_begin(&f, flights_build, with, 4) != STATUS_OK, "%s: %s", with, f.why.text);
    fly(&f, (int)lround(thrown / flights_h), flights_h);
    const double energy = flight_energy(&f);
    const inertia_balance before = flight_inertia(&f);
    for (int i = 0; i < 80; i++) {
        fly(&f, 10, flights_h);
        const inertia_balance now = flight_inertia(&f);
        drift = fmax(drift, fabs(flight_energy(&f) / energy - 1));
        for (int k = 0; k < 3; k++) {
            angular = fmax(angular, fabs(now.angular[k] - before.angular[k]));
            momentum = fmax(momentum, fabs(now.momentum[k] - before.momentum[k]));
        }
    }
    angular /= vec3_norm(before.angular);
    momentum /= vec3_norm(before.momentum);
    const double iterations = (double)f.sum / f.steps;
    gsl_test(!(drift < 1e-12), "%s, EA x %g: energy changes by %.1e in 40 s", with, how.stiffening,
             drift);
    gsl_test(!(angular < 1e-12 && momentum < 1e-12), "%s, EA x %g: momenta change by %.1e, %.1e",
             with, how.stiffening, angular, momentum);
    gsl_test(!(iterations < 5.5), "%s, EA x %g: %.2f iterations a step", with, how.stiffening,
             iterations);
    flight_end(&f);
    return iterations;
}

static void stiff_flights(const char *with)
{
    static const double times[] = {1, 1e4, 1e6};
    double least = INFINITY, most = 0;
    for (int i = 0; i < 3; i++) {
        how.stiffening = times[i];
        const double iterations = long_flight(with);
        least = fmin(least, iterations);
        most = fmax(most, iterations);
    }
    how.stiffening = 1;
    gsl_test(!(most < 1.5 * least), "%s: %.2f to %.2f iterations a step at EA x 1 .. 1e6", with,
             least, most);
}

/* Errors fall by 4 while steps are halved: of their differences. */
static void order(const char *with)
{
    double r[4][6];
    for (int i = 0; i < 4; i++) {
        flight f;
        gsl_test(flight_begin(&f, flights_build, with, 4) != STATUS_OK, "%s: %s", with, f.why.text);
        fly(&f, 150 << i, flights_h / (1 << i));
        ends_of(&f, r[i]);
        flight_end(&f);
    }
    const double ratio = sqrt(apart(r[0], r[1]) / apart(r[2], r[3]));
    gsl_test(fabs(ratio - 4) > 0.6, "%s: differences fall by %.2f from %.1e, step %g s", with,
             ratio, apart(r[0], r[1]), flights_h);
}

static void reversal(const char *with)
{
    flight f;
    double before[6], after[6];
    gsl_test(flight_begin(&f, flights_build, with, 4) != STATUS_OK, "%s: %s", with, f.why.text);
    fly(&f, 120, flights_h);
    ends_of(&f, before);
    fly(&f, 100, flights_h);
    ends_of(&f, after);
    gsl_test(!(apart(before, after) > 10), "%s: it goes away by %.1f m", with,
             apart(before, after));
    fly(&f, 100, -flights_h);
    ends_of(&f, after);
    gsl_test(!(apart(before, after) < 1e-10), "%s, EA x %g: back within %.1e m of %g m", with,
             how.stiffening, apart(before, after), 40.);
    flight_end(&f);
}

static void same_answers(const char *with)
{
    static const double turn[3] = {0.7, -1.1, 1.9};
    double r[3][6];
    for (int i = 0; i < 3; i++) {
        flight f;
        rotation_exp(turn, how.turn);
        if (i < 2)
            memcpy(how.turn, (double[4]){1, 0, 0, 0}, sizeof how.turn);
        gsl_test(flight_begin(&f, i == 1 ? reversed : flights_build, with, 4) != STATUS_OK,
                 "%s: %s", with, f.why.text);
        fly(&f, 150, flights_h);
        ends_of(&f, r[i]);
        flight_end(&f);
    }
    memcpy(how.turn, (double[4]){1, 0, 0, 0}, sizeof how.turn);
    gsl_test(!(apart(r[0], r[1]) < 1e-10), "%s: the same from q to p, but for %.1e m", with,
             apart(r[0], r[1]));
    gsl_test(!(apart(r[0], r[2]) < 1e-10), "%s: the same in other axes, but for %.1e m", with,
             apart(r[0], r[2]));
}

int main(void)
{
    static const char *const with[] = {"geometrically_exact", "geometrically_exact:nodes=2",
                                       "collocation"};
    for (int i = 0; i < 3; i++) {
        stiff_flights(with[i]);
        order(with[i]);
        same_answers(with[i]);
        reversal(with[i]);
        how.stiffening = 1e6;
        reversal(with[i]);
        how.stiffening = 1;
    }
    return gsl_test_summary();
}
