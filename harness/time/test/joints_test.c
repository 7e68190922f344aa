/* Two bars with every kind of joint are loaded by a follower force and a moment with fixed axes,
 * and then move without loads. The gain of energy must equal the work of the loads, and the energy
 * must then remain constant. */
#include <stdio.h>

#include "harness/model/model.h"
#include "harness/time/test/flight.h"
#include "harness/tools/kit/scenes.h"

static const double y_axis[] = {0, 1, 0};

typedef struct tested_joint {
    const char *name;
    int released, component[SCENE_RELEASED]; /* released components at the start of the second
                                                bar */
    int offset, spring, ground, hinge; /* 1 if the joint has an offset, a spring, or a spring to the
                                          ground; hinge 1: free, 2: prescribed */
} tested_joint;

static const tested_joint joints[] = {
    {.name = "rigid"},
    {.name = "hinge", .released = 1, .component = {SCENE_RY}},
    {.name = "universal joint", .released = 2, .component = {SCENE_RY, SCENE_RZ}},
    {.name = "ball", .released = 3, .component = {SCENE_RX, SCENE_RY, SCENE_RZ}},
    {.name = "slide", .released = 1, .component = {SCENE_UX}},
    {.name = "two slides and a turn", .released = 3, .component = {SCENE_RX, SCENE_UY, SCENE_UZ}},
    {.name = "ball that slides",
     .released = 5,
     .component = {SCENE_UX, SCENE_UY, SCENE_RX, SCENE_RY, SCENE_RZ}},
    {.name = "beside a body", .offset = 1},
    {.name = "slide beside a body", .released = 2, .component = {SCENE_RZ, SCENE_UX}, .offset = 1},
    {.name = "spring", .spring = 1},
    {.name = "spring to the ground", .ground = 1},
    {.name = "hinge about a fixed axis", .hinge = 1},
    {.name = "driven hinge", .hinge = 2},
    {.name = "driven hinge beside a body", .hinge = 2, .offset = 1},
};
enum { JOINTS = sizeof joints / sizeof joints[0] };

static const tested_joint *present;
static double stiffening;

static void add_springs(scene *s, int B, int C)
{
    double K[36] = {0};
    for (int i = 0; i < 6; i++)
        K[7 * i] = i < 3 ? 300 : 400;
    K[1] = K[6] = 50;
    K[22] = K[27] = 60;
    K[5] = K[30] = 20;
    if (present->spring)
        scene_add_spring(s, B, C, K);
    if (present->ground)
        scene_add_spring(s, SCENE_NONE, B, K);
}

static void add_motion(scene *s, int loaded)
{
    static const double end = 1, spin[] = {0.3, 1.1, -0.7}, velocity[] = {0.5, 0, 0.2};
    scene_motion how = {
        .scheme = SCENE_CONSERVING, .alpha = scene_alpha_of_radius(0.9), .step = 0.05};
    const int loads[] = {scene_add_load(s, SCENE_FORCE, loaded, 0.1, 0.02, 0),
                         scene_add_load(s, SCENE_MOMENT, loaded, 0, 1, 0.5)};
    scene_load_at(s, loads[0])->follower = 1;
    scene_load_at(s, loads[0])->at[1] = 0.4;
    for (int i = 0; i < 2; i++) {
        scene_load_piece(s, loads[i], 0.5, "80*t");
        scene_load_piece(s, loads[i], 1, "80 - 80*t");
        scene_load_piece(s, loads[i], 0, "0");
    }
    if (!present->hinge) {
        memcpy(how.start.spin, spin, sizeof spin);
        memcpy(how.start.velocity, velocity, sizeof velocity);
    }
    scene_add_motion(s, SCENE_NONE, 1, &end, how);
}

static status build(const double value[], scene *s, fault *f)
{
    static const double axis[] = {0.48, 0.6, 0.64};
    const double E = 1e4 * stiffening;
    const section_spec spec = timed_profile(&(timed_section){
        .EA = E, .GA = E, .GJ = 500, .EI = 500, .mass = 1, .polar = 20, .rotary = 10});
    const int profile = scene_add_section(s, &spec), A = scene_add_node(s, 0, 0, 0),
              B = scene_add_node(s, 3, 0, 0.4), C = scene_add_node(s, 5, 2, 1),
              D = present->offset   ? scene_add_attached(s, B, 3.3, 0.6, 0.7)
                  : present->spring ? scene_add_node(s, 3.5, 0.1, 0)
                                    : B;
    (void)value, (void)f;
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_member(s, A, B, profile, y_axis);
    const int second = scene_add_member(s, D, C, profile, y_axis);
    for (int k = 0; k < present->released; k++)
        scene_release_end(s, second, 0, present->component[k]);
    if (present->offset)
        scene_set_body(s, B,
                       (scene_body){.mass = 3,
                                    .centre = {0.2, 0.1, -0.3},
                                    .inertia = {4, 5, 6, 0.1, 0.2, 0.3}});
    add_springs(s, B, D);
    if (present->hinge) {
        scene_node *n = scene_node_at(s, A);
        scene_hold(s, A, SCENE_UX, SCENE_UZ);
        n->rotation = SCENE_ROTATION_SEQUENCE;
        memcpy(n->axis[0], axis, sizeof axis);
        n->angle[0] = SCENE_FREE;
        if (present->hinge == 2) {
            const int driver = scene_add_moving_driver(s, "angle");
            scene_drive_piece(s, driver, 0, "0.3*t^2");
            scene_node_at(s, A)->angle[0] = driver;
        }
    }
    add_motion(s, C);
    return STATUS_OK;
}

typedef struct joints_changes {
    double energy, angular, momentum;
} joints_changes;

static void compare(const flight *f, double energy, const inertia_balance *before,
                    joints_changes *most)
{
    const inertia_balance now = flight_inertia(f);
    most->energy = fmax(most->energy, fabs(flight_energy(f) / energy - 1));
    for (int i = 0; i < 3; i++) {
        most->angular = fmax(most->angular, fabs(now.angular[i] - before->angular[i]) /
                                                vec3_norm(before->angular));
        most->momentum = fmax(most->momentum, fabs(now.momentum[i] - before->momentum[i]) /
                                                  vec3_norm(before->momentum));
    }
}

static void fly(const char *with, double h)
{
    flight f;
    joints_changes most = {0, 0, 0};
    double energy = 0, gained = 0;
    inertia_balance before = {0};
    status outcome = flight_begin(&f, build, with, 2);
    const double begin = outcome == STATUS_OK ? flight_energy(&f) : 0;
    for (int i = 0; i < 100 && outcome == STATUS_OK; i++) {
        outcome = flight_step(&f, h);
        gained = fmax(gained, fabs(flight_energy(&f) - begin - f.now.work));
        if (i * h <= 1.001) {
            energy = flight_energy(&f);
            before = flight_inertia(&f);
        } else if (outcome == STATUS_OK) {
            compare(&f, energy, &before, &most);
        }
    }
    gsl_test(outcome != STATUS_OK, "%s, %s, EA x %g: flies: %s", present->name, with, stiffening,
             f.why.text);
    gsl_test(present->hinge < 2 && !(most.energy < 1e-12), "%s, %s, EA x %g: energy stays: %.1e",
             present->name, with, stiffening, most.energy);
    gsl_test(!(gained < 1e-12 * energy), "%s, %s, EA x %g: energy is work, but for %.1e of %g J",
             present->name, with, stiffening, gained, energy);
    if (!present->ground && !present->hinge)
        gsl_test(!(most.angular < 1e-12 && most.momentum < 1e-12),
                 "%s, %s, EA x %g: momenta stay: %.1e %.1e", present->name, with, stiffening,
                 most.angular, most.momentum);
    gsl_test(f.most > 4 || f.steps == 0, "%s, %s, EA x %g: %.2f iterations a step, %d at most",
             present->name, with, stiffening, f.sum / (f.steps + 1e-9), f.most);
    flight_end(&f);
}

static void joints_tests(void)
{
    for (int i = 0; i < JOINTS; i++) {
        present = &joints[i];
        for (int k = 0; k < 3; k++) {
            stiffening = pow(1e3, k);
            fly("geometrically_exact", 0.05);
        }
        stiffening = 1;
        fly("collocation", 0.05);
    }
}

static const double bodies_y_axis[] = {0, 1, 0};

static struct {
    double stiffness;
    /* 0: one body; 1: two bodies that together are equal to the one body; 2: bodies at offsets */
    int rod;
} how;

static int profile_of(scene *s, double E, double mass)
{
    const section_spec spec = timed_profile(&(timed_section){.EA = E,
                                                             .GA = E,
                                                             .GJ = how.rod == 2 ? 50 : E,
                                                             .EI = how.rod == 2 ? 50 : E,
                                                             .mass = mass,
                                                             .polar = mass / 50,
                                                             .rotary = mass / 100});
    return scene_add_section(s, &spec);
}

static void bodies_add_motion(scene *s, const double spin[3])
{
    static const double end = 10;
    scene_motion motion = {
        .scheme = SCENE_CONSERVING, .alpha = scene_alpha_of_radius(0.9), .step = 0.1};
    memcpy(motion.start.spin, spin, 3 * sizeof *spin);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_motion(s, SCENE_NONE, 1, &end, motion);
}

/* Builds a body with J = diag(1, 2, 3) about the middle of a massless rod. The middle does not
 * move. */
static status free_body(const double value[], scene *s, fault *f)
{
    static const double spin[] = {0.5, 0.2, 2};
    const int profile = profile_of(s, how.rod ? how.stiffness : 1, 0);
    (void)value, (void)f;
    if (how.rod == 0) {
        const int hub = scene_add_node(s, 0, 0, 0), A = scene_add_attached(s, hub, -0.5, 0, 0),
                  B = scene_add_attached(s, hub, 0.5, 0, 0);
        scene_add_member(s, A, B, profile, bodies_y_axis);
        scene_set_body(s, hub, (scene_body){.mass = 1, .inertia = {1, 2, 3}});
    } else {
        const int A = scene_add_node(s, -0.5, 0, 0), B = scene_add_node(s, 0.5, 0, 0);
        scene_add_member(s, A, B, profile, bodies_y_axis);
        scene_set_body(s, A, (scene_body){.mass = 1, .inertia = {0.5, 0.75, 1.25}});
        scene_set_body(s, B, (scene_body){.mass = 1, .inertia = {0.5, 0.75, 1.25}});
    }
    bodies_add_motion(s, spin);
    return STATUS_OK;
}

static status on_offsets(const double value[], scene *s, fault *f)
{
    static const double spin[] = {0.9, -0.6, 1.2};
    const int profile = profile_of(s, 1e4 * how.stiffness, 1), a = scene_add_node(s, -2.1, 0.6, 0),
              b = scene_add_node(s, 2, -0.3, 0.7), A = scene_add_attached(s, a, -1.5, 0, 0),
              B = scene_add_attached(s, b, 1.5, 0, 0);
    (void)value, (void)f;
    scene_add_member(s, A, B, profile, bodies_y_axis);
    scene_set_body(s, a, (scene_body){.mass = 2, .inertia = {0.4, 0.5, 0.7, 0.1}});
    scene_set_body(s, b,
                   (scene_body){.mass = 3, .centre = {0.1, 0.2, 0}, .inertia = {0.6, 0.9, 0.8}});
    bodies_add_motion(s, spin);
    return STATUS_OK;
}

static void bodies_fly(flight *f, int steps, double h, double *drift, double *angular)
{
    const double energy = flight_energy(f);
    const inertia_balance before = flight_inertia(f);
    status outcome = STATUS_OK;
    for (int i = 0; i < steps && outcome == STATUS_OK; i++) {
        outcome = flight_step(f, h);
        const inertia_balance now = flight_inertia(f);
        *drift = fmax(*drift, fabs(flight_energy(f) / energy - 1));
        for (int k = 0; k < 3; k++)
            *angular = fmax(*angular,
                            fabs(now.angular[k] - before.angular[k]) / vec3_norm(before.angular));
    }
    gsl_test(outcome != STATUS_OK, "steps of %g s: %s", h, f->why.text);
}

/* Returns the largest error of an entry of R at 10 s. The exact value was computed by quadrature of
 * the precession. */
static double error_of_body(double h)
{
    static const double exact[9] = {0.1439879275647, -0.9562925632996, 0.2545034579204,
                                    0.9873599189256, 0.1560479392089,  0.02773862231498,
                                    -0.066240978366, 0.2472924868379,  0.9666739671361};
    flight f;
    double drift = 0, angular = 0, error = 0, R[9];
    gsl_test(flight_begin(&f, free_body, "geometrically_exact", 1) != STATUS_OK, "%s", f.why.text);
    bodies_fly(&f, (int)lround(10 / h), h, &drift, &angular);
    rotation_matrix(f.now.state->q, R);
    for (int i = 0; i < 9; i++)
        error = fmax(error, fabs(R[i] - exact[i]));
    gsl_test(!(drift < 1e-12 && angular < 1e-12), "%d bodies, %g, %g s: energy %.1e, momentum %.1e",
             1 + how.rod, how.stiffness, h, drift, angular);
    gsl_test(f.most > 5, "%d bodies, %g, %g s: %d iterations at most", 1 + how.rod, how.stiffness,
             h, f.most);
    flight_end(&f);
    return error;
}

static void bodies(void)
{
    static const double known[] = {2.86e-1, 7.55e-2, 1.91e-2, 4.78e-3};
    for (int i = 0; i < 4; i++) {
        const double h = 0.2 / (1 << i);
        how.rod = 0;
        const double one = error_of_body(h);
        gsl_test(fabs(one / known[i] - 1) > 0.01, "%g s: R is wrong by %.3e, as known %.3e", h, one,
                 known[i]);
        how.rod = 1;
        for (int k = 2; k < 5; k++) {
            how.stiffness = pow(100, k);
            const double two = error_of_body(h);
            gsl_test(fabs(two - one) > 0.02 * one + 20 / how.stiffness,
                     "stiffness %g, %g s: R is wrong by %.3e", how.stiffness, h, two);
        }
    }
}

static void offset_flight(double h)
{
    const int steps = (int)lround(20 / h);
    flight f;
    double drift = 0, angular = 0, from[3], to[3];
    gsl_test(flight_begin(&f, on_offsets, "geometrically_exact", 2) != STATUS_OK, "%s", f.why.text);
    kinematics_position(f.m, f.now.state, 0, from);
    bodies_fly(&f, steps, h, &drift, &angular);
    gsl_test(!(drift < 1e-12 && angular < 1e-12), "EA x %g, %g s: energy %.1e, momentum %.1e",
             how.stiffness, h, drift, angular);
    gsl_test(f.sum > 4.2 * f.steps, "EA x %g, %g s: %.2f iterations", how.stiffness, h,
             (double)f.sum / f.steps);
    bodies_fly(&f, steps, -h, &drift, &angular);
    kinematics_position(f.m, f.now.state, 0, to);
    for (int i = 0; i < 3; i++)
        to[i] -= from[i];
    gsl_test(!(vec3_norm(to) < 1e-10), "EA x %g, %g s: back within %.1e m", how.stiffness, h,
             vec3_norm(to));
    flight_end(&f);
}

static void offsets(void)
{
    how.rod = 2;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            how.stiffness = pow(1e3, i);
            offset_flight(0.02 * (1 << k));
        }
}

static void bodies_tests(void)
{
    bodies();
    offsets();
}

static const double massless_y_axis[] = {0, 1, 0};

static struct {
    double polar;
    int angles;
} massless_how = {20, 0};

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

static double roughest(double h)
{
    flight f;
    double coarse_interval = 0, energy = 0, drift = 0, angular = 0, before[6] = {0};
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
            coarse_interval = fmax(coarse_interval, fabs(rate - before[k]));
            before[k] = rate;
        }
    }
    gsl_test(outcome != STATUS_OK, "%g s: %s", h, f.why.text);
    gsl_test(!(drift < 1e-12 && angular < 1e-12 * vec3_norm(kept.angular)),
             "%g s: energy %.1e, angular momentum %.1e", h, drift, angular);
    flight_end(&f);
    return coarse_interval;
}

static void refused(const char *words)
{
    flight f;
    const status outcome = flight_begin(&f, massless_build, "geometrically_exact", 2);
    gsl_test(outcome != STATUS_REFUSED || strstr(f.why.text, words) == NULL, "refused: %s",
             f.why.text);
    flight_end(&f);
}

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

static void conserving_massless_tests(void)
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
}

int main(void)
{
    joints_tests();
    bodies_tests();
    conserving_massless_tests();
    return gsl_test_summary();
}
