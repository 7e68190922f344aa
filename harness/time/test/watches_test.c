/* Largest and least values, crossings, periods and means of a motion that is known, a driven one,
 * to round-off; and of one that is not, with the order of the scheme and an estimate of what the
 * polynomial inside steps adds. */
#include <math.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/time/test/swung.h"

enum { INTEGRATOR, STEP, WATCHED, PARAMETERS };

/* 0.3 sin 5 t until 3 s. */
static const struct {
    const char *name;
    scene_reduction how;
    scene_passing of;
    double expected, at, tolerance; /* at < 0: of no value */
} known[] = {
    {"largest", SCENE_MAX, {.until = 1}, 0.3, PI / 10, 1e-12},
    {"least", SCENE_MIN, {.until = 1.5}, -0.3, 3 * PI / 10, 1e-12},
    {"largest behind 1.5 s", SCENE_MAX, {.from = 1.5}, 0.3, -1, 1e-12},
    {"largest before it turns", SCENE_MAX, {.until = 0.2}, 0.3 * 0.8414709848078965, 0.2, 1e-12},
    {"time of the largest", SCENE_MAX_TIME, {.until = 1}, PI / 10, PI / 10, 1e-9},
    {"time of the least", SCENE_MIN_TIME, {.until = 1.5}, 3 * PI / 10, 3 * PI / 10, 1e-9},
    {"first fall", SCENE_CROSSING, {0, SCENE_FALLING, 0, 0, 0}, PI / 5, PI / 5, 1e-12},
    {"second fall", SCENE_CROSSING, {0, SCENE_FALLING, 1, 0, 0}, 3 * PI / 5, -1, 1e-12},
    {"first rise", SCENE_CROSSING, {0, SCENE_RISING, 0, 0, 0}, 2 * PI / 5, -1, 1e-12},
    {"third of all", SCENE_CROSSING, {0, SCENE_EITHER, 2, 0, 0}, 3 * PI / 5, -1, 1e-12},
    {"rise behind 2 s", SCENE_CROSSING, {0, SCENE_RISING, 0, 2, 3}, 4 * PI / 5, -1, 1e-12},
    {"rise through 0.15", SCENE_CROSSING, {0.15, SCENE_RISING, 1, 0, 0}, 13 * PI / 30, -1, 1e-12},
    {"period", SCENE_PERIOD, {0, SCENE_RISING, 0, 0, 0}, 2 * PI / 5, -1, 1e-12},
    {"per second", SCENE_PER_SECOND, {0, SCENE_FALLING, 0, 0, 0}, 2.5 / PI, -1, 1e-12},
    {"mean of a period", SCENE_MEAN, {.until = 2 * PI / 5}, 0, -1, 1e-9},
    {"mean of half of it", SCENE_MEAN, {.from = PI / 5, .until = 2 * PI / 5}, -0.6 / PI, -1, 1e-8}};
enum { KNOWN = sizeof known / sizeof known[0] };

static status build_known(const double value[], scene *s, fault *f)
{
    static const double end[] = {3};
    (void)f;
    const swung of = swung_build(s);
    const int shaken = scene_add_moving_driver(s, "shaken");
    scene_drive_piece(s, shaken, 0, "0.3*sin(5*t)");
    scene_drive(s, of.base, SCENE_UY, shaken);
    scene_motion how = swung_motion((scene_scheme)value[INTEGRATOR], value[STEP]);
    how.start = (scene_start){.velocity = {0}};
    const int motion = scene_add_motion(s, SCENE_NONE, 1, end, how);
    for (int i = 0; i < KNOWN; i++)
        scene_set_passing(
            scene_add_quantity(s, known[i].name, "", motion, scene_coordinate(of.base, SCENE_UY)),
            known[i].how, known[i].of);
    scene_set_passing(
        scene_add_quantity(s, "never", "", motion, scene_coordinate(of.base, SCENE_UY)),
        SCENE_CROSSING, (scene_passing){.level = 0.5});
    return STATUS_OK;
}

static status build_free(const double value[], scene *s, fault *f)
{
    static const double end[] = {2};
    (void)f;
    const swung of = swung_build(s);
    const int motion = scene_add_motion(s, SCENE_NONE, 1, end,
                                        swung_motion((scene_scheme)value[INTEGRATOR], value[STEP]));
    scene_add_quantity(s, "x", "m", motion, scene_coordinate(of.tip, SCENE_UX));
    if (value[WATCHED] == 0)
        return STATUS_OK;
    const scene_extract z = scene_coordinate(of.tip, SCENE_UZ);
    scene_set_passing(scene_add_quantity(s, "crossing", "s", motion, z), SCENE_CROSSING,
                      (scene_passing){.level = -0.4, .direction = SCENE_EITHER});
    scene_set_passing(scene_add_quantity(s, "least", "m", motion, z), SCENE_MIN,
                      (scene_passing){.until = 0});
    scene_set_passing(scene_add_quantity(s, "most", "m", motion, z), SCENE_MAX,
                      (scene_passing){.from = 0.3, .until = 1.9});
    return STATUS_OK;
}

static const parameter_type table[] = {
    [INTEGRATOR] = {"integrator", "1", 0, 0, 3, TIMED_INTEGRATORS, "scheme"},
    [STEP] = {"step", "s", 0.02, 1e-6, 1, NULL, "of it"},
    [WATCHED] = {"watched", "1", 1, 0, 1, NULL, "1: between stations, too"},
    {0}};
static const case_type driven = {.name = "driven", .parameters = {table}, .build = build_known},
                       flown = {.name = "flown", .parameters = {table}, .build = build_free};

static void exactly(int scheme, double step)
{
    cell_result r;
    swung_solve(&driven, (const double[]){scheme, step, 1}, PARAMETERS, &r);
    for (int i = 0; i < KNOWN; i++) {
        const quantity_result *q = &r.solve.quantity[i];
        const double expected = known[i].expected;
        gsl_test(q->status != STATUS_OK, "scheme %d, %s: %s", scheme, known[i].name, q->reason);
        gsl_test(!(fabs(q->value - expected) <= known[i].tolerance),
                 "scheme %d, %s: %.15g, not %.15g", scheme, known[i].name, q->value, expected);
        gsl_test(known[i].at >= 0 && !(fabs(q->x - known[i].at) <= 1e-9),
                 "scheme %d, %s at %.15g, not %.15g", scheme, known[i].name, q->x, known[i].at);
    }
    gsl_test(r.solve.quantity[KNOWN].status != STATUS_NO_VALUE, "a level that is never reached: %g",
             r.solve.quantity[KNOWN].value);
    cell_result_free(&r);
}

/* Errors fall with the order of the scheme, estimates of what lies between steps as fast. */
static void freely(const char *name, int scheme, double step, double order)
{
    cell_result exact, r[2], unwatched;
    swung_solve(&flown, (const double[]){SCENE_RADAU, 0.002, 1}, PARAMETERS, &exact);
    swung_solve(&flown, (const double[]){scheme, step, 0}, PARAMETERS, &unwatched);
    for (int i = 0; i < 2; i++)
        swung_solve(&flown, (const double[]){scheme, step / (1 << i), 1}, PARAMETERS, &r[i]);
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
