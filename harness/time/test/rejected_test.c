/* A step that is rejected leaves no trace: not in the instant that it began from, to the bit, nor
 * in the steps that follow it, with inner unknowns, springs, damping and what is driven; nor in
 * what a motion passes through, its stations and its records. */
#include <math.h>

#include "elements/math/pi.h"
#include "harness/time/test/flying.h"
#include "harness/time/test/moving.h"
#include "harness/time/test/swung.h"

extern const element_type element_geometrically_exact, element_collocation;
extern const case_type case_free_flight_space;

/* A free rod on its way, bent by its load. */
static void throw_rod(scene *s, scene_scheme by)
{
    moving_case(&case_free_flight_space, "", s);
    scene_member_at(s, 0)->damping = by <= SCENE_ALPHA || by == SCENE_RADAU ? 1e-3 : 0;
    moving_add(s, by, 0.05, 1);
}

/* Two rods with a joint and a spring across it, on a base that shakes. */
static void shake_rods(scene *s, scene_scheme by)
{
    static const double end[] = {1}, y_axis[] = {0, 1, 0};
    double stiffness[36] = {0};
    scene_init(s, "shaken");
    const swung of = swung_build(s);
    const int far = scene_add_node(s, 1.8, 0, 0.4),
              second = scene_add_member(s, of.tip, far, 0, y_axis),
              shaken = scene_add_moving_driver(s, "shaken");
    scene_set_body(s, of.tip, (scene_body){0.3, {0, 0.1, 0.1}, {0.1, 0.2, 0.3, 0, 0.01, 0}});
    scene_drive_piece(s, shaken, 0, "0.3*sin(5*t)");
    scene_drive(s, of.base, SCENE_UY, shaken);
    for (int i = 0; i < 6; i++)
        stiffness[7 * i] = i < 3 ? 20 : 0.5;
    scene_add_spring(s, of.base, far, stiffness);
    if (by != SCENE_EXPLICIT) {
        scene_release_end(s, second, 0, SCENE_RY);
        scene_release_end(s, second, 0, SCENE_UX);
        scene_member_at(s, second)->damping = 0.01;
    }
    scene_motion how = swung_motion(by, 0.02);
    how.start.velocity[1] = 0;
    scene_add_motion(s, SCENE_NONE, 1, end, how);
}

static int same(const flying *f, const double a[], const double b[])
{
    return memcmp(a, b, flying_numbers(f, &f->now, NULL) * sizeof *a) == 0;
}

/* Pivots of an unsymmetric tangent are kept from step to step, and those of a step that was
 * rejected may be others. */
static int close(const flying *f, const double a[], const double b[])
{
    const double rounding = 1e-11;
    for (size_t i = 0; i < flying_numbers(f, &f->now, NULL); i++)
        if (fabs(a[i] - b[i]) > rounding * (1 + fabs(a[i])))
            return 0;
    return 1;
}

/* Too long for Newton, at last, and some that succeed and are not taken. */
static int try_in_vain(flying *f, double h)
{
    int failed = 0;
    for (int k = 1; k < 6; k++)
        failed += flying_try(f, pow(8, k) * h) != STATUS_OK;
    gsl_test(flying_try(f, 0.7 * h) != STATUS_OK, "a short step: %s", f->why.text);
    return failed;
}

static void reject(const char *name, void (*build)(scene *, scene_scheme), const element_type *type,
                   int elements, scene_scheme by, double h)
{
    scene s;
    flying tried, plain;
    build(&s, by);
    gsl_test(flying_begin(&s, type, elements, &tried) != STATUS_OK, "%s: %s", name, tried.why.text);
    gsl_test(flying_begin(&s, type, elements, &plain) != STATUS_OK, "%s: %s", name, plain.why.text);
    for (int i = 0; i < 3; i++) {
        flying_step(&tried, h);
        flying_step(&plain, h);
    }
    double *before = flying_all(&tried);
    gsl_test(try_in_vain(&tried, h) == 0, "%s, scheme %d: a long step fails", name, by);
    double *behind = flying_all(&tried);
    gsl_test(!same(&tried, before, behind), "%s, scheme %d: a rejected step leaves all bits", name,
             by);
    const status again = flying_step(&plain, h);
    flying_step(&tried, h);
    double *then = flying_all(&tried), *without = flying_all(&plain);
    int (*const agrees)(const flying *, const double[], const double[]) =
        by == SCENE_RADAU ? close : same;
    gsl_test(again != STATUS_OK || !agrees(&tried, then, without),
             "%s, scheme %d: what follows a rejected step knows nothing of it (%s)", name, by,
             plain.why.text);
    gsl_test(by == SCENE_RADAU ? !(fabs(tried.error / plain.error - 1) < 1e-8)
                               : memcmp(&tried.error, &plain.error, sizeof tried.error) != 0,
             "%s, scheme %d: nor does its error (%g, %g)", name, by, tried.error, plain.error);
    free(before);
    free(behind);
    free(then);
    free(without);
    flying_end(&tried);
    flying_end(&plain);
    scene_free(&s);
}

enum { INTEGRATOR, STEP, TOLERANCE, PARAMETERS };
enum { STATIONS = 60, CROSSINGS = 4, PERIOD = CROSSINGS, MEAN, WAY, TIP };

/* Watched at the base, whose way is known: 0.3 sin 5 t; and the tip at many stations. */
static status build_watched(const double value[], scene *s, fault *f)
{
    (void)f;
    double at[STATIONS];
    for (int i = 0; i < STATIONS; i++)
        at[i] = 3.0 * (i + 1) / STATIONS;
    const swung of = swung_build(s);
    const int shaken = scene_add_moving_driver(s, "shaken");
    scene_drive_piece(s, shaken, 0, "0.3*sin(5*t)");
    scene_drive(s, of.base, SCENE_UY, shaken);
    scene_motion how = swung_motion((scene_scheme)value[INTEGRATOR], value[STEP]);
    how.tolerance = value[TOLERANCE];
    how.start.velocity[1] = 0;
    const int motion = scene_add_motion(s, SCENE_NONE, STATIONS, at, how);
    const scene_extract way = scene_coordinate(of.base, SCENE_UY);
    for (int i = 0; i < CROSSINGS; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "crossing %d", i);
        scene_set_passing(scene_add_quantity(s, name, "s", motion, way), SCENE_CROSSING,
                          (scene_passing){.direction = SCENE_EITHER, .order = i});
    }
    scene_set_passing(scene_add_quantity(s, "period", "s", motion, way), SCENE_PERIOD,
                      (scene_passing){.direction = SCENE_RISING});
    scene_set_passing(scene_add_quantity(s, "mean", "m", motion, way), SCENE_MEAN,
                      (scene_passing){.until = 1});
    scene_set_curve(scene_add_quantity(s, "way", "m", motion, way), "t", "s", 1, 0);
    scene_set_curve(scene_add_quantity(s, "tip", "m", motion, scene_coordinate(of.tip, SCENE_UY)),
                    "t", "s", 1, 0);
    return STATUS_OK;
}

static const parameter_type table[] = {
    [INTEGRATOR] = {"integrator", "1", 0, 0, 3, TIMED_INTEGRATORS, "scheme"},
    [STEP] = {"step", "s", 0.1, 1e-6, 1, NULL, "of it"},
    [TOLERANCE] = {"tolerance", "1", 0, 0, 1, NULL, "of the error of a step"},
    {0}};
static const case_type watched = {.name = "watched", .parameters = {table}, .build = build_watched};

static void near(int by, const char *what, double found, double expected)
{
    gsl_test(!(fabs(found - expected) < 1e-9), "scheme %d, %s: %.12g, expected %.12g", by, what,
             found, expected);
}

/* What is passed is passed once, whatever was tried before, and stations are those of the
 * steps that are taken: `close` [m] to the tip's way by short ones. */
static void pass(int by, double step, double tolerance, double close, const cell_result *exact)
{
    cell_result r;
    swung_solve(&watched, (const double[]){by, step, tolerance}, PARAMETERS, &r);
    const quantity_result *q = r.solve.quantity;
    for (int i = 0; i < CROSSINGS; i++)
        near(by, r.scene.quantity[i].name, q[i].value, (i + 1) * PI / 5);
    near(by, "period", q[PERIOD].value, 2 * PI / 5);
    near(by, "mean", q[MEAN].value, 0.06 * (1 - cos(5)));
    gsl_test_int(q[WAY].curve.points, STATIONS, "scheme %d: stations", by);
    for (int i = 0; i < q[WAY].curve.points; i++)
        near(by, "station", q[WAY].curve.value[i], 0.3 * sin(5 * 3.0 * (i + 1) / STATIONS));
    const curve *tip = &q[TIP].curve, *way = &exact->solve.quantity[TIP].curve;
    double apart = 0;
    for (int i = 0; i < tip->points; i++)
        apart = fmax(apart, fabs(tip->value[i] - way->value[i]));
    gsl_test(!(apart < close), "scheme %d: stations are %g m beside the way", by, apart);
    gsl_test(r.counters.rejected_steps < 2, "scheme %d: %ld steps are rejected", by,
             r.counters.rejected_steps);
    gsl_test_int(r.solve.motions, r.solve.steps + 1, "scheme %d: a record of each step", by);
    int rejected = 0;
    for (int i = 1; i < r.solve.motions; i++) {
        const outcome_step *one = &r.solve.motion[i].at, *before = &r.solve.motion[i - 1].at;
        gsl_test(!(fabs(one->time - before->time - one->step) < 1e-12),
                 "scheme %d: step %d from %g to %g s is %g s long", by, i, before->time, one->time,
                 one->step);
        rejected += one->rejected;
    }
    gsl_test_int(rejected, (int)r.counters.rejected_steps, "scheme %d: rejected in records", by);
    cell_result_free(&r);
}

int main(void)
{
    for (int by = 0; by < SCENE_SCHEMES; by++) {
        const scene_scheme of = (scene_scheme)by;
        const double h = by == SCENE_EXPLICIT ? 0.002 : 0.05;
        reject("rod", throw_rod, &element_geometrically_exact, 3, of, h);
        reject("shaken", shake_rods, &element_collocation, 1, of, h / 4);
    }
    cell_result exact;
    swung_solve(&watched, (const double[]){SCENE_RADAU, 0.1, 1e-8}, PARAMETERS, &exact);
    pass(SCENE_ALPHA, 0.2, 3e-4, 0.1, &exact);
    pass(SCENE_CONSERVING, 0.2, 3e-4, 0.1, &exact);
    pass(SCENE_RADAU, 0.2, 1e-6, 4e-6, &exact);
    pass(SCENE_EXPLICIT, 0.2, 1e-6, 4e-5, &exact);
    cell_result_free(&exact);
    return gsl_test_summary();
}
