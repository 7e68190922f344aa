/* How long steps are: halved where one fails and twice as long behind those that do not, at most
 * what was asked for; by estimates of errors where a tolerance says so. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/tools/kit/scenes.h"

#define CONTROL_SWUNG "harness/time/test/swung.yaml"

static void turn(scene_scheme by, double step, double tolerance, double spin, cell_result *r)
{
    scenes_solve(CONTROL_SWUNG, "collocation", 1, r,
                 "base=heavy;thrown=0;end=2;integrator=%s;step=%g;tolerance=%.17g;spin=%g",
                 scenes_integrator[by], step, tolerance, spin);
}

/* A radian is the most of a step: of 3 rad/s a step of 0.5 s is halved whenever it is tried. */
static void halve(void)
{
    cell_result r;
    turn(SCENE_ALPHA, 0.5, 0, 3, &r);
    gsl_test_int(r.solve.motions, 9, "records of steps");
    for (int i = 1; i < r.solve.motions; i++) {
        const outcome_step *one = &r.solve.motion[i].at;
        gsl_test(!(fabs(one->step - 0.25) < 1e-12), "step %d is %g s long", i, one->step);
        gsl_test_int(one->rejected, i % 2, "step %d: tries of a longer one", i);
    }
    cell_result_free(&r);
}

/* By the order of the estimate of one step: a sixteenth of the tolerance takes twice the steps, and
 * hardly a step is rejected. */
static void follow(scene_scheme by, double order, double tolerance)
{
    int steps[2], rejected = 0;
    for (int k = 0; k < 2; k++) {
        cell_result r;
        const double most = tolerance / pow(2, k * order);
        turn(by, 0.1, most, 1, &r);
        steps[k] = r.solve.motions - 1;
        for (int i = 1; i < r.solve.motions; i++) {
            const outcome_step *one = &r.solve.motion[i].at;
            gsl_test(!(one->error <= most), "scheme %d, step %d: error %g", by, i, one->error);
            rejected += i > 1 ? one->rejected : 0;
        }
        cell_result_free(&r);
    }
    const double ratio = (double)steps[1] / steps[0];
    gsl_test(!(steps[0] > 20 && fabs(ratio - 2) < 0.15), "scheme %d: %d and %d steps", by, steps[0],
             steps[1]);
    gsl_test(rejected > steps[1] / 20, "scheme %d: %d longer steps rejected", by, rejected);
}

/* Where errors of steps add up: each step has its share by its length, all together the tolerance,
 * and hardly less. */
static void share(scene_scheme by, double tolerance)
{
    cell_result r;
    double sum = 0;
    turn(by, 0.1, tolerance, 1, &r);
    for (int i = 1; i < r.solve.motions; i++) {
        const outcome_step *one = &r.solve.motion[i].at;
        const double part = one->step / 2;
        gsl_test(!(one->error <= part * tolerance), "scheme %d, step %d: error %g of %g", by, i,
                 one->error, part * tolerance);
        sum += one->error;
    }
    gsl_test(!(sum < tolerance && sum > tolerance / 10), "scheme %d: %d steps add %g", by,
             r.solve.motions - 1, sum);
    cell_result_free(&r);
}

int main(void)
{
    halve();
    share(SCENE_ALPHA, 1e-3);
    share(SCENE_CONSERVING, 1e-3);
    follow(SCENE_RADAU, 4, 1e-8);
    return gsl_test_summary();
}
