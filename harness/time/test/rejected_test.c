/* A step that is rejected leaves no trace: not in the instant that it began from, to the bit, nor
 * in the steps that follow it, with inner unknowns, springs, damping and what is driven; nor in
 * what a motion passes through, its stations and its records. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/math/pi.h"
#include "harness/time/test/flying.h"
#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

#define REJECTED_SWUNG "harness/time/test/swung.yaml"

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
    scenes_read(s, REJECTED_SWUNG, "base=shaken;second=%s;integrator=%s;step=0.02",
                by == SCENE_EXPLICIT ? "joined" : "slides", scenes_integrator[by]);
    /* which the reader refuses: no body is like that */
    scene_set_body(s, scenes_find(s, SCENE_NODES, "tip_free"),
                   (scene_body){0.3, {0, 0.1, 0.1}, {0.1, 0.2, 0.3, 0, 0.01, 0}});
}

static int same(const flying *f, const double a[], const double b[])
{
    return memcmp(a, b, flying_numbers(f, &f->now, NULL) * sizeof *a) == 0;
}

/* Pivots of an unsymmetric tangent are kept from step to step, and those of a step that was
 * rejected may be others. */
static int is_close(const flying *f, const double a[], const double b[])
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
        by == SCENE_RADAU ? is_close : same;
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

enum { STATIONS = 60, CROSSINGS = 4, PERIOD = CROSSINGS, MEAN, WAY, TIP };

/* Watched at the base, whose way is known: 0.3 sin 5 t; and the tip at many stations. */
static void watch(int by, double step, double tolerance, cell_result *out)
{
    scenes_solve(REJECTED_SWUNG, "collocation", 1, out,
                 "base=shaken;read=passed;stations=sixty;integrator=%s;step=%g;tolerance=%g",
                 scenes_integrator[by], step, tolerance);
}

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
    watch(by, step, tolerance, &r);
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
    watch(SCENE_RADAU, 0.1, 1e-8, &exact);
    pass(SCENE_ALPHA, 0.2, 3e-4, 0.1, &exact);
    pass(SCENE_CONSERVING, 0.2, 3e-4, 0.1, &exact);
    pass(SCENE_RADAU, 0.2, 1e-6, 4e-6, &exact);
    pass(SCENE_EXPLICIT, 0.2, 1e-6, 4e-5, &exact);
    cell_result_free(&exact);
    return gsl_test_summary();
}
