/* Every formulation flies freely with the conserving scheme: sheets, thin-walled sections that warp
 * and whose shear centre is beside the centroid, curved members, members of two sections, spinning
 * and swinging. Energy and both momenta stay; steps go back to where they came from. */
#include <stdio.h>

#include "elements/test/sections.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/time/test/flight.h"
#include "harness/tools/kit/ask.h"

enum { FORMULATIONS_STEPS = 60 };

/* How a rod of the test looks. */
typedef struct look {
    const char *name;
    section_kind kind;
    double curvature[3]; /* [1/m] */
    int tapers;
    double h, speed, spin; /* [s], [m/s] of the swing, [rad/s] */
} look;

static const look looks[] = {
    {.name = "sheet", .kind = SECTION_RECTANGLE, .h = 1e-3, .speed = 2, .spin = 32},
    {.name = "channel", .kind = SECTION_WALLS, .h = 2e-4, .speed = 2, .spin = 32},
    {.name = "arc", .kind = SECTION_RECTANGLE, .curvature = {0, 0, 1.1}, .h = 2.5e-4, .speed = 0.3},
    {.name = "two sections",
     .kind = SECTION_RECTANGLE,
     .tapers = 1,
     .h = 1e-3,
     .speed = 2,
     .spin = 32},
};
enum { LOOKS = sizeof looks / sizeof looks[0] };

static const look *formulations_present;
static const double length = 0.5;

static section_spec profile_of(double thickness)
{
    static const double point[][2] = {{0.04, 0.02}, {0, 0.02}, {0, -0.02}, {0.04, -0.02}},
                        wall[] = {1.5e-3, 1.5e-3, 1.5e-3};
    section_spec spec = formulations_present->kind == SECTION_RECTANGLE
                            ? section_spec_rectangle(2e11, 8e10, 0.1, thickness)
                            : section_spec_walls(2e11, 8e10, 3, point, NULL, wall);
    spec.density = 7800;
    return spec;
}

/* Unit: along the member of unit length, initial axes those of the scene. */
static status formulations_build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0}, axis[] = {0.36, 0.48, -0.8}, end = 1;
    const section_spec spec = profile_of(2.25e-3), thick = profile_of(3e-3);
    scene_motion motion = {.scheme = SCENE_CONSERVING,
                           .alpha = scene_alpha_of_radius(0.9),
                           .step = formulations_present->h,
                           .start = {.velocity = {0.3, -0.2, 1}}};
    (void)value, (void)f;
    for (int i = 0; i < 3; i++)
        motion.start.spin[i] = formulations_present->spin * axis[i];
    const int profile = scene_add_section(s, &spec), A = scene_add_node(s, 0, 0, 0),
              B = scene_add_node(s, length, 0, 0), rod = scene_add_member(s, A, B, profile, y_axis);
    if (formulations_present->tapers)
        scene_member_at(s, rod)->section_q = scene_add_section(s, &thick);
    memcpy(scene_member_at(s, rod)->curvature, formulations_present->curvature,
           sizeof formulations_present->curvature);
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_motion(s, SCENE_NONE, 1, &end, motion);
    return STATUS_OK;
}

/* The rod begins to bend: velocities across it, with no momentum on a straight one. */
static void swing(flight *f)
{
    const model *m = f->m;
    const double speed = formulations_present->speed;
    for (int i = 0; i < model_first_release(m); i++) {
        const double x = 2 * model_vertex(m, i)->position[0] / length - 1;
        const int *at = model_vertex(m, i)->coordinate;
        for (int k = 1; k < 3; k++)
            f->now.v[at[k]] += speed * (3 * x * x - 1) / 2;
        f->now.v[at[SCENE_RY]] -= speed * 6 * x / length;
        f->now.v[at[SCENE_RZ]] += speed * 6 * x / length;
    }
}

static int is_offered(const element_type *type)
{
    scene s;
    fault f;
    scene_init(&s, "flight");
    formulations_build(NULL, &s, &f);
    const int offered = ask_offered(&s, type);
    scene_free(&s);
    return offered;
}

static void formulations_fly(const element_type *type)
{
    flight f;
    double drift = 0, angular = 0, momentum = 0, from[3], to[3], most = 0;
    status outcome = flight_begin(&f, formulations_build, type->name, 4);
    if (outcome != STATUS_OK) {
        gsl_test(1, "%s, %s: %s", formulations_present->name, type->name, f.why.text);
        flight_end(&f);
        return;
    }
    swing(&f);
    const double energy = flight_energy(&f);
    const inertia_balance before = flight_inertia(&f);
    kinematics_position(f.m, f.now.state, 1, from);
    for (int i = 0; i < 2 * FORMULATIONS_STEPS && outcome == STATUS_OK; i++) {
        outcome = flight_step(&f, i < FORMULATIONS_STEPS ? formulations_present->h
                                                         : -formulations_present->h);
        const inertia_balance now = flight_inertia(&f);
        drift = fmax(drift, fabs(flight_energy(&f) / energy - 1));
        most = fmax(most, flight_strain_energy(&f) / energy);
        for (int k = 0; k < 3; k++) {
            angular = fmax(angular, fabs(now.angular[k] - before.angular[k]));
            momentum = fmax(momentum, fabs(now.momentum[k] - before.momentum[k]));
        }
    }
    kinematics_position(f.m, f.now.state, 1, to);
    for (int k = 0; k < 3; k++)
        to[k] -= from[k];
    gsl_test(outcome != STATUS_OK, "%s, %s: %s", formulations_present->name, type->name,
             f.why.text);
    gsl_test(!(most > 1e-4), "%s, %s: deforms (%.1e)", formulations_present->name, type->name,
             most);
    gsl_test(!(drift < 1e-11), "%s, %s: energy %.1e", formulations_present->name, type->name,
             drift);
    gsl_test(!(angular < 1e-12 * vec3_norm(before.angular) &&
               momentum < 1e-12 * vec3_norm(before.momentum)),
             "%s, %s: momenta %.1e %.1e", formulations_present->name, type->name,
             angular / vec3_norm(before.angular), momentum / vec3_norm(before.momentum));
    gsl_test(!(vec3_norm(to) < 1e-9), "%s, %s: back within %.1e m", formulations_present->name,
             type->name, vec3_norm(to));
    gsl_test(f.sum > 7 * f.steps, "%s, %s: %.2f iterations a step", formulations_present->name,
             type->name, f.sum / (f.steps + 1e-9));
    flight_end(&f);
}

int main(void)
{
    for (int i = 0; i < LOOKS; i++) {
        int flown = 0;
        formulations_present = &looks[i];
        for (int k = 0; registry_formulations[k] != NULL; k++)
            if (is_offered(registry_formulations[k])) {
                formulations_fly(registry_formulations[k]);
                flown++;
            }
        gsl_test(flown < 2, "%s: %d formulations fly", formulations_present->name, flown);
    }
    return gsl_test_summary();
}
