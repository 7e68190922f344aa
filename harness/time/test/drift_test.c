/* Energy gained against work done: of loads that come and go, of gravity, of a drive. What is
 * missing shrinks with the order of the scheme, and for the conserving one there is nothing. */
#include <math.h>

#include "harness/time/test/moving.h"

extern const element_type element_geometrically_exact;
extern const case_type case_free_flight_space, case_spin_up, case_elbow, case_pendulum;

/* Largest of all stations, by the largest energy. */
static double drift(const case_type *type, scene_scheme scheme, double step, double end)
{
    scene s;
    answer a;
    moving_case(type, "", &s);
    const int motion = moving_add(&s, scheme, step, end);
    moving_range(&s, "drift", motion, SCENE_DRIFT);
    moving_range(&s, "energy", motion, SCENE_ENERGY);
    moving_range(&s, "work", motion, SCENE_WORK);
    ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
    scene_free(&s);
    const double energy = moving_largest(&a, "energy"), work = moving_largest(&a, "work");
    gsl_test(!(fabs(work / energy - 1) < 0.01), "%s: all energy is work (%g of %g J)%s", type->name,
             work, energy, a.reason);
    return moving_largest(&a, "drift") / energy;
}

/* radau: of the shortest step; conserving: of the first two. */
static const struct {
    const case_type *type;
    double step, end, conserving;
} drift_motion[] = {{&case_free_flight_space, 0.05, 6, 1e-13},
                    {&case_spin_up, 0.05, 4, 1e-13},
                    {&case_elbow, 0.125, 5, 1e-13},
                    {&case_pendulum, 0.005, 0.5, 1e-13}};

int main(void)
{
    for (int i = 0; i < (int)(sizeof drift_motion / sizeof drift_motion[0]); i++) {
        const double h = drift_motion[i].step, end = drift_motion[i].end;
        const char *name = drift_motion[i].type->name;
        const double first = drift(drift_motion[i].type, SCENE_ALPHA, h / 2, end),
                     second = drift(drift_motion[i].type, SCENE_ALPHA, h / 4, end);
        gsl_test(!(second < 1e-4 && fabs(first / second - 4) < 0.4),
                 "%s: drift of alpha of second order (%g, %g)", name, first, second);
        const double radau = drift(drift_motion[i].type, SCENE_RADAU, h / 2, end),
                     shorter = drift(drift_motion[i].type, SCENE_RADAU, h / 4, end);
        gsl_test(!(shorter < 1e-8 && radau / shorter > 5),
                 "%s: drift of radau of higher order (%g, %g)", name, radau, shorter);
        for (int k = 0; k < 2; k++) {
            const double exact = drift(drift_motion[i].type, SCENE_CONSERVING, h / (1 << k), end);
            gsl_test(!(exact < drift_motion[i].conserving),
                     "%s: no drift of the conserving scheme (%g)", name, exact);
        }
    }
    return gsl_test_summary();
}
