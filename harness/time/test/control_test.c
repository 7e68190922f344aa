/* How long steps are: halved where one fails and twice as long behind those that do not, at most
 * what was asked for; by estimates of errors where a tolerance says so. */
#include <math.h>

#include "harness/time/test/swung.h"

enum { INTEGRATOR, STEP, TOLERANCE, SPIN, PARAMETERS };

static status build(const double value[], scene *s, fault *f)
{
    static const double end[] = {2};
    (void)f;
    const swung of = swung_build(s);
    scene_set_body(s, of.base, (scene_body){.mass = 100, .inertia = {100, 100, 100}});
    scene_motion how = swung_motion((scene_scheme)value[INTEGRATOR], value[STEP]);
    how.tolerance = value[TOLERANCE];
    how.start = (scene_start){.spin = {0, value[SPIN], 0}};
    const int motion = scene_add_motion(s, SCENE_NONE, 1, end, how);
    scene_add_quantity(s, "x", "m", motion, scene_coordinate(of.tip, SCENE_UX));
    return STATUS_OK;
}

static const parameter_type table[] = {
    [INTEGRATOR] = {"integrator", "1", 0, 0, 3, TIMED_INTEGRATORS, "scheme"},
    [STEP] = {"step", "s", 0.1, 1e-6, 1, NULL, "of it"},
    [TOLERANCE] = {"tolerance", "1", 0, 0, 1, NULL, "of the error of a step"},
    [SPIN] = {"spin", "rad/s", 0, 0, 10, NULL, "of all"},
    {0}};
static const case_type turned = {.name = "turned", .parameters = {table}, .build = build};

/* A radian is the most of a step: of 3 rad/s a step of 0.5 s is halved whenever it is tried. */
static void halve(void)
{
    cell_result r;
    swung_solve(&turned, (const double[]){SCENE_ALPHA, 0.5, 0, 3}, PARAMETERS, &r);
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
        swung_solve(&turned, (const double[]){by, 0.1, most, 1}, PARAMETERS, &r);
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
    swung_solve(&turned, (const double[]){by, 0.1, tolerance, 1}, PARAMETERS, &r);
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
