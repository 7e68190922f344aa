/* Damping in proportion to stiffness: a slow mode decays by eta w/2, what turns as a whole does not
 * decay, and what is lost is accounted for. */
#include <math.h>

#include "elements/math/pi.h"
#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

#define DAMPING_RODS "harness/time/test/rods.yaml"

/* Angular frequency of the lowest mode. */
static double lowest(void)
{
    answer a;
    scenes_ask(DAMPING_RODS, &element_geometrically_exact, 6, &a, "of=modal");
    return 2 * PI * answer_of(&a, "f");
}

/* h: of a period */
static void decay(scene_scheme scheme, double h, double drift)
{
    const double w = lowest(), ratio = 0.03, eta = 2 * ratio / w, period = 2 * PI / w;
    answer a;
    scenes_ask(DAMPING_RODS, &element_geometrically_exact, 6, &a,
               "of=damped;integrator=%s;damping=%.17g;step=%.17g;end=%.17g",
               scenes_integrator[scheme], eta, h * period, 10 * period);
    const double found = -log(answer_of(&a, "late") / answer_of(&a, "early")) / (6 * 4 * PI);
    gsl_test(!(fabs(found / ratio - 1) < 3e-3), "scheme %d: decays by %g, expected %g %s", scheme,
             found, ratio, a.reason);
    gsl_test(!(moving_largest(&a, "drift") < drift * moving_largest(&a, "energy")),
             "scheme %d: what decays is lost to damping (%g of %g J)", scheme,
             moving_largest(&a, "drift"), moving_largest(&a, "energy"));
}

/* A free rod turns, bent by nothing but its inertia: what is lost stays small. Returns the drift.
 */
static double turn(scene_scheme scheme, double eta, double h)
{
    answer a;
    scenes_ask(DAMPING_RODS, &element_geometrically_exact, 4, &a,
               "of=free;end=2;integrator=%s;damping=%g;step=%g", scenes_integrator[scheme], eta, h);
    const double lost = moving_largest(&a, "lost"), energy = moving_largest(&a, "energy");
    gsl_test(!(lost > 0 && lost < 2e-4 * energy), "scheme %d, damping %g s: lost %g of %g J %s",
             scheme, eta, lost, energy, a.reason);
    gsl_test(!(fabs(answer_of(&a, "Lz") - 1.004) < 2e-4), "angular momentum stays (%.9g)",
             answer_of(&a, "Lz"));
    return moving_largest(&a, "drift") / energy;
}

int main(void)
{
    decay(SCENE_ALPHA, 0.01, 0.02);
    decay(SCENE_RADAU, 0.02, 1e-3);
    decay(SCENE_CONSERVING, 0.01, 1e-12);
    for (int stiff = 0; stiff < 2; stiff++) {
        const double eta = stiff ? 10 : 0.01, first = turn(SCENE_ALPHA, eta, 0.01),
                     second = turn(SCENE_ALPHA, eta, 0.005);
        gsl_test(!(second < 2e-5 && fabs(first / second - 4) < 0.6),
                 "damping %g s: drift of alpha of second order (%g, %g)", eta, first, second);
    }
    for (int stiff = 0; stiff < 2; stiff++) {
        const double eta = stiff ? 10 : 0.01, exact = turn(SCENE_CONSERVING, eta, 0.01);
        gsl_test(!(exact < 1e-12), "damping %g s: no drift of the conserving scheme (%g)", eta,
                 exact);
    }
    const double radau = turn(SCENE_RADAU, 0.01, 0.01), shorter = turn(SCENE_RADAU, 0.01, 0.005);
    gsl_test(!(shorter < 5e-9 && radau / shorter > 12), "drift of radau of high order (%g, %g)",
             radau, shorter);
    return gsl_test_summary();
}
