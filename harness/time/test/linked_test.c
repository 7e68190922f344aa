/* Two rods that swing on a ball in space, joined by what lets turns or shifts through: inertia of
 * released ends moves with them, or energy would be made from nothing. */
#include <math.h>

#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

#define LINKED_RODS "harness/time/test/rods.yaml"

static const char *const joints[] = {"stiff", "hinge", "universal",
                                     "ball",  "slide", "sliding_hinge"};

static double solve(const char *joint, double damping, scene_scheme scheme, double step, double *x,
                    char *why)
{
    answer a;
    scenes_ask(LINKED_RODS, &element_geometrically_exact, 2, &a,
               "of=linked;end=0.4;joint=%s;damping=%g;integrator=%s;step=%g", joint, damping,
               scenes_integrator[scheme], step);
    *x = answer_of(&a, "x");
    snprintf(why, FAULT_TEXT, "%s", a.reason);
    return moving_largest(&a, "drift") / moving_largest(&a, "kinetic");
}

int main(void)
{
    for (int i = 0; i < (int)(sizeof joints / sizeof joints[0]); i++) {
        double alpha, radau, shorter;
        char why[FAULT_TEXT];
        const double of_alpha = solve(joints[i], 0, SCENE_ALPHA, 0.0025, &alpha, why),
                     of_radau = solve(joints[i], 0, SCENE_RADAU, 0.005, &radau, why),
                     of_shorter = solve(joints[i], 0, SCENE_RADAU, 0.0025, &shorter, why);
        gsl_test(!(of_shorter < 2e-7 && of_radau / of_shorter > 8),
                 "%s: drift of radau of higher order (%g, %g) %s", joints[i], of_radau, of_shorter,
                 why);
        gsl_test(!(of_alpha < 2e-4), "%s: drift of alpha (%g)", joints[i], of_alpha);
        gsl_test(!(fabs(radau - shorter) < 2e-5 && fabs(alpha - shorter) < 1e-3),
                 "%s: both come to the same place (%.9g, %.9g, %.9g)", joints[i], alpha, radau,
                 shorter);
        const double damped = solve(joints[i], 0.02, SCENE_RADAU, 0.005, &radau, why);
        gsl_test(!(damped < 2e-5 && fabs(radau - shorter) > 1e-5),
                 "%s: damped (drift %g, at %.9g) %s", joints[i], damped, radau, why);
    }
    return gsl_test_summary();
}
