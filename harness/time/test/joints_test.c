/* Two bars joined in every way that a scene knows, thrown by a force that follows and a moment that
 * does not, and then left alone: energy is the work of these, and stays, and so do both momenta
 * where nothing is held. */
#include <stdio.h>

#include "harness/time/test/flight.h"
#include "harness/tools/kit/scenes.h"

static const double y_axis[] = {0, 1, 0};

/* What joins the second bar to the first. */
typedef struct tested_joint {
    const char *name;
    int released, component[SCENE_RELEASED]; /* at the second bar's begin */
    int offset, spring, ground, hinge;       /* hinge 2: driven */
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

/* Largest changes behind the loads, relative. */
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

int main(void)
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
    return gsl_test_summary();
}
