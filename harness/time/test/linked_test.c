/* Two rods that swing on a ball in space, joined by what lets turns or shifts through: inertia of
 * released ends moves with them, or energy would be made from nothing. */
#include <math.h>

#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

typedef struct joint {
    const char *name;
    int count, component[5];
} joint;

static const joint joints[] = {{"stiff", 0, {0}},
                               {"hinge", 1, {SCENE_RZ}},
                               {"universal", 2, {SCENE_RZ, SCENE_RY}},
                               {"ball", 3, {SCENE_RX, SCENE_RY, SCENE_RZ}},
                               {"slide", 1, {SCENE_UY}},
                               {"sliding hinge", 3, {SCENE_RZ, SCENE_UX, SCENE_UZ}}};

static double solve(const joint *of, double damping, scene_scheme scheme, double step, double *x,
                    char *why)
{
    static const double y_axis[] = {0, 1, 0}, end = 0.4;
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 6e3, .GA = 2e3, .GJ = 0.4, .EI = 0.6, .mass = 1.4, .polar = 4e-4, .rotary = 2e-4});
    scene s;
    answer a;
    scene_init(&s, of->name);
    scene_omit(&s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    const int profile = scene_add_section(&s, &spec), pin = scene_add_node(&s, 0, 0, 0),
              middle = scene_add_node(&s, 0.5, 0, 0.1), tip = scene_add_node(&s, 1, 0.2, 0),
              first = scene_add_member(&s, pin, middle, profile, y_axis),
              second = scene_add_member(&s, middle, tip, profile, y_axis);
    scene_member_at(&s, first)->damping = scene_member_at(&s, second)->damping = damping;
    scene_hold(&s, pin, SCENE_UX, SCENE_UZ);
    for (int i = 0; i < of->count; i++)
        scene_release_end(&s, second, 0, of->component[i]);
    if (of->count > 0 && of->component[of->count - 1] < SCENE_RX) { /* to the other rod's end */
        double stiffness[36] = {0};
        for (int i = 0; i < 3; i++)
            stiffness[7 * i] = 200;
        scene_add_spring(&s, pin, tip, stiffness);
    }
    for (int i = 0; i < 2; i++)
        scene_add_load(&s, SCENE_GRAVITY, i ? second : first, 0, -9.81, 0);
    const int motion = moving_add(&s, scheme, step, end);
    s.analysis[motion].of.motion.start = (scene_start){.spin = {1, 4, 2}};
    moving_range(&s, "drift", motion, SCENE_DRIFT);
    moving_range(&s, "kinetic", motion, SCENE_KINETIC);
    scene_add_quantity(&s, "x", "m", motion, scene_coordinate(tip, SCENE_UX));
    ask_scene(&s, &element_geometrically_exact, NULL, 2, &a);
    scene_free(&s);
    *x = answer_of(&a, "x");
    snprintf(why, FAULT_TEXT, "%s", a.reason);
    return moving_largest(&a, "drift") / moving_largest(&a, "kinetic");
}

int main(void)
{
    for (int i = 0; i < (int)(sizeof joints / sizeof joints[0]); i++) {
        double alpha, radau, shorter;
        char why[FAULT_TEXT];
        const double of_alpha = solve(&joints[i], 0, SCENE_ALPHA, 0.0025, &alpha, why),
                     of_radau = solve(&joints[i], 0, SCENE_RADAU, 0.005, &radau, why),
                     of_shorter = solve(&joints[i], 0, SCENE_RADAU, 0.0025, &shorter, why);
        gsl_test(!(of_shorter < 2e-7 && of_radau / of_shorter > 8),
                 "%s: drift of radau of higher order (%g, %g) %s", joints[i].name, of_radau,
                 of_shorter, why);
        gsl_test(!(of_alpha < 2e-4), "%s: drift of alpha (%g)", joints[i].name, of_alpha);
        gsl_test(!(fabs(radau - shorter) < 2e-5 && fabs(alpha - shorter) < 1e-3),
                 "%s: both come to the same place (%.9g, %.9g, %.9g)", joints[i].name, alpha, radau,
                 shorter);
        const double damped = solve(&joints[i], 0.02, SCENE_RADAU, 0.005, &radau, why);
        gsl_test(!(damped < 2e-5 && fabs(radau - shorter) > 1e-5),
                 "%s: damped (drift %g, at %.9g) %s", joints[i].name, damped, radau, why);
    }
    return gsl_test_summary();
}
