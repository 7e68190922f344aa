/* Largest and least values, crossings, periods and means of a motion that is known, a driven one,
 * to round-off; and of one that is not, with the order of the scheme and an estimate of what the
 * polynomial inside steps adds. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/tools/kit/scenes.h"

#define WATCHES_SWUNG "harness/time/test/swung.yaml"

/* Of the base, 0.3 sin 5 t until 3 s. */
static const struct {
    const char *name;
    double expected, at, tolerance; /* at < 0: of no value */
} known[] = {{"largest", 0.3, PI / 10, 1e-12},
             {"known_least", -0.3, 3 * PI / 10, 1e-12},
             {"largest_behind_1_5_s", 0.3, -1, 1e-12},
             {"largest_before_it_turns", 0.3 * 0.8414709848078965, 0.2, 1e-12},
             {"time_of_the_largest", PI / 10, PI / 10, 1e-9},
             {"time_of_the_least", 3 * PI / 10, 3 * PI / 10, 1e-9},
             {"first_fall", PI / 5, PI / 5, 1e-12},
             {"second_fall", 3 * PI / 5, -1, 1e-12},
             {"first_rise", 2 * PI / 5, -1, 1e-12},
             {"third_of_all", 3 * PI / 5, -1, 1e-12},
             {"rise_behind_2_s", 4 * PI / 5, -1, 1e-12},
             {"rise_through_0_15", 13 * PI / 30, -1, 1e-12},
             {"period", 2 * PI / 5, -1, 1e-12},
             {"per_second", 2.5 / PI, -1, 1e-12},
             {"mean_of_a_period", 0, -1, 1e-9},
             {"mean_of_half_of_it", -0.6 / PI, -1, 1e-8}};
enum { KNOWN = sizeof known / sizeof known[0] };

static void exactly(int scheme, double step)
{
    cell_result r;
    scenes_solve(WATCHES_SWUNG, "collocation", 1, &r,
                 "base=shaken;thrown=0;read=known;end=3;integrator=%s;step=%g",
                 scenes_integrator[scheme], step);
    for (int i = 0; i < KNOWN; i++) {
        const quantity_result *q =
            &r.solve.quantity[scenes_find(&r.scene, SCENE_QUANTITIES, known[i].name)];
        const double expected = known[i].expected;
        gsl_test(q->status != STATUS_OK, "scheme %d, %s: %s", scheme, known[i].name, q->reason);
        gsl_test(!(fabs(q->value - expected) <= known[i].tolerance),
                 "scheme %d, %s: %.15g, not %.15g", scheme, known[i].name, q->value, expected);
        gsl_test(known[i].at >= 0 && !(fabs(q->x - known[i].at) <= 1e-9),
                 "scheme %d, %s at %.15g, not %.15g", scheme, known[i].name, q->x, known[i].at);
    }
    const quantity_result *never =
        &r.solve.quantity[scenes_find(&r.scene, SCENE_QUANTITIES, "never")];
    gsl_test(never->status != STATUS_NO_VALUE, "a level that is never reached: %g", never->value);
    cell_result_free(&r);
}

static void fly(int scheme, double step, int watched, cell_result *out)
{
    scenes_solve(WATCHES_SWUNG, "collocation", 1, out, "end=2;read=%s;integrator=%s;step=%g",
                 watched ? "crossings" : "way", scenes_integrator[scheme], step);
}

/* Errors fall with the order of the scheme, estimates of what lies between steps as fast. */
static void freely(const char *name, int scheme, double step, double order)
{
    cell_result exact, r[2], unwatched;
    fly(SCENE_RADAU, 0.002, 1, &exact);
    fly(scheme, step, 0, &unwatched);
    for (int i = 0; i < 2; i++)
        fly(scheme, step / (1 << i), 1, &r[i]);
    gsl_test(memcmp(&unwatched.solve.quantity[0].value, &r[0].solve.quantity[0].value,
                    sizeof(double)) != 0,
             "%s: who is watched moves otherwise", name);
    gsl_test_int(unwatched.solve.steps, r[0].solve.steps, "%s: steps of who is watched", name);
    for (int q = 1; q < exact.solve.quantities; q++) {
        const quantity_result *true_one = &exact.solve.quantity[q], *one[2];
        double error[2];
        for (int i = 0; i < 2; i++) {
            one[i] = &r[i].solve.quantity[q];
            error[i] = fabs(one[i]->value - true_one->value);
            gsl_test(!(one[i]->rounding > 0 &&
                       one[i]->rounding * fabs(true_one->value) < 3 * error[i] + 1e-9),
                     "%s, %s: error %.2e, estimate of its part %.2e", name,
                     exact.scene.quantity[q].name, error[i],
                     one[i]->rounding * fabs(true_one->value));
        }
        gsl_test(!(log2(error[0] / error[1]) > order - 0.5), "%s, %s: errors %.2e and %.2e", name,
                 exact.scene.quantity[q].name, error[0], error[1]);
    }
    cell_result_free(&exact);
    cell_result_free(&unwatched);
    cell_result_free(&r[0]);
    cell_result_free(&r[1]);
}

int main(void)
{
    exactly(SCENE_ALPHA, 0.02);
    exactly(SCENE_ALPHA, 0.013);
    exactly(SCENE_CONSERVING, 0.02);
    exactly(SCENE_RADAU, 0.02);
    freely("alpha", SCENE_ALPHA, 0.005, 2);
    freely("conserving", SCENE_CONSERVING, 0.02, 2);
    freely("radau", SCENE_RADAU, 0.04, 5);
    return gsl_test_summary();
}
