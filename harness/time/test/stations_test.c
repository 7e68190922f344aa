/* Values at stations must have the order of the integrator, inside steps and at their ends.
 * Stations must not change the motion. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/tools/kit/scenes.h"

#define STATIONS_SWUNG "harness/time/test/swung.yaml"

enum { ODD, ENDS, BOTH, REQUESTED_KINDS };

static const char *const requested_texts[REQUESTED_KINDS] = {
    "inside_steps;read=last_forces", "ends_of_steps;read=curves", "inside_steps;read=curves"};
enum { KINEMATIC = 5, STRAIN = 6, READINGS };

static void solve(int scheme, double step, int requested, cell_result *out)
{
    scenes_solve(STATIONS_SWUNG, "collocation", 1, out, "integrator=%s;step=%g;stations=%s",
                 scenes_integrator[scheme], step, requested_texts[requested]);
}

static double apart(const cell_result *a, const cell_result *b, int first, int last)
{
    double largest = 0;
    for (int q = first; q <= last; q++) {
        const curve *x = &a->solve.quantity[q].curve, *y = &b->solve.quantity[q].curve;
        double size = 0, most = 0;
        gsl_test(x->points == 0 || x->points != y->points, "points of curve %d", q);
        for (int i = 0; i < x->points && i < y->points; i++) {
            gsl_test(!isfinite(x->value[i] + y->value[i]), "curve %d at %g s: %s", q, x->x[i],
                     a->solve.quantity[q].reason);
            size = fmax(size, fabs(y->value[i]));
            most = fmax(most, fabs(x->value[i] - y->value[i]));
        }
        largest = fmax(largest, most / size);
    }
    return largest;
}

static void errors_of(int scheme, double step, int requested, int last, double out[2])
{
    cell_result exact, r;
    solve(SCENE_RADAU, 0.002, requested, &exact);
    for (int i = 0; i < 2; i++) {
        solve(scheme, step / (1 << i), requested, &r);
        out[i] = apart(&r, &exact, 0, last);
        cell_result_free(&r);
    }
    cell_result_free(&exact);
}

static void orders(const char *name, int scheme, double step, double order)
{
    double inside[2], at_ends[2], forces[2];
    errors_of(scheme, step, ODD, KINEMATIC - 1, inside);
    errors_of(scheme, step, ENDS, KINEMATIC - 1, at_ends);
    errors_of(scheme, step, BOTH, STRAIN, forces);
    gsl_test(!(log2(inside[0] / inside[1]) > order - 0.25), "%s: %.2e and %.2e inside steps", name,
             inside[0], inside[1]);
    gsl_test(!(log2(at_ends[0] / at_ends[1]) > order - 0.25), "%s: %.2e and %.2e at ends", name,
             at_ends[0], at_ends[1]);
    gsl_test(!(log2(forces[0] / forces[1]) > order - 0.25), "%s: %.2e and %.2e of forces", name,
             forces[0], forces[1]);
    gsl_test(scheme != SCENE_EXPLICIT && !(inside[1] < 1.3 * at_ends[1]),
             "%s: %.2e inside steps, %.2e at their ends", name, inside[1], at_ends[1]);
    gsl_test(!(inside[0] > 1e-9), "%s: nothing to be seen, %.1e", name, inside[0]);
}

static void undisturbed(const char *name, int scheme, double step)
{
    cell_result with[REQUESTED_KINDS];
    for (int i = 0; i < REQUESTED_KINDS; i++)
        solve(scheme, step, i, &with[i]);
    for (int q = 0; q < READINGS; q++) {
        const double last = with[ODD].solve.quantity[q].value;
        for (int i = 1; i < REQUESTED_KINDS; i++)
            gsl_test(memcmp(&last, &with[i].solve.quantity[q].value, sizeof last) != 0,
                     "%s: %s at the end is %.17g, not %.17g, stations %d", name,
                     with[ODD].scene.quantity[q].name, with[i].solve.quantity[q].value, last, i);
    }
    gsl_test(with[ODD].solve.steps != 20 || with[BOTH].solve.steps != 20, "%s: %d and %d steps",
             name, with[ODD].solve.steps, with[BOTH].solve.steps);
    gsl_test(!(apart(&with[ODD], &with[BOTH], 0, KINEMATIC - 1) < 0.02), "%s: %.2e apart", name,
             apart(&with[ODD], &with[BOTH], 0, KINEMATIC - 1));
    for (int i = 0; i < REQUESTED_KINDS; i++)
        cell_result_free(&with[i]);
}

static void stations_tests(void)
{
    orders("alpha", SCENE_ALPHA, 0.02, 2);
    orders("conserving", SCENE_CONSERVING, 0.02, 2);
    orders("radau", SCENE_RADAU, 0.04, 5);
    orders("explicit", SCENE_EXPLICIT, 0.04, 5);
    undisturbed("alpha", SCENE_ALPHA, 0.04);
    undisturbed("conserving", SCENE_CONSERVING, 0.04);
    undisturbed("radau", SCENE_RADAU, 0.04);
    undisturbed("explicit", SCENE_EXPLICIT, 0.04);
}

#define CONTROL_SWUNG "harness/time/test/swung.yaml"

static void turn(scene_scheme by, double step, double tolerance, double spin, cell_result *r)
{
    scenes_solve(CONTROL_SWUNG, "collocation", 1, r,
                 "base=heavy;thrown=0;end=2;integrator=%s;step=%g;tolerance=%.17g;spin=%g",
                 scenes_integrator[by], step, tolerance, spin);
}

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

static void control_tests(void)
{
    halve();
    share(SCENE_ALPHA, 1e-3);
    share(SCENE_CONSERVING, 1e-3);
    follow(SCENE_RADAU, 4, 1e-8);
}

#define RESUME_SWUNG "harness/time/test/swung.yaml"

static void same_linked(const char *name, int scheme, double tolerance, int parts, int joint)
{
    cell_result one, more;
    cell_result *const in[] = {&one, &more};
    for (int i = 0; i < 2; i++)
        scenes_solve(
            RESUME_SWUNG, "collocation", 1, in[i],
            "load=kick;read=balance;integrator=%s;step=%.17g;tolerance=%g;second=%s;parts=%d",
            scenes_integrator[scheme], 1 / 64.0, tolerance, joint ? "turns_and_slides" : "none",
            i == 0 ? 1 : parts);
    for (int i = 0; i < one.solve.quantities; i++) {
        gsl_test(one.solve.quantity[i].status != STATUS_OK, "%s: %s: %s", name,
                 one.scene.quantity[i].name, one.solve.quantity[i].reason);
        const double x = one.solve.quantity[i].value, y = more.solve.quantity[i].value;
        const int differs = tolerance > 0 ? !(fabs(x - y) <= 1e-11 * fmax(1, fabs(x)))
                                          : memcmp(&x, &y, sizeof x) != 0;
        gsl_test(differs, "%s in %d parts: %s is %.17g, in one %.17g", name, parts,
                 one.scene.quantity[i].name, y, x);
    }
    gsl_test_int(more.solve.steps, one.solve.steps, "%s: steps in %d parts", name, parts);
    gsl_test_int(more.solve.motions, one.solve.motions + parts - 1, "%s: records in %d parts", name,
                 parts);
    gsl_test(one.solve.steps < 20, "%s: %d steps", name, one.solve.steps);
    cell_result_free(&one);
    cell_result_free(&more);
}

static void same(const char *name, int scheme, double tolerance, int parts)
{
    same_linked(name, scheme, tolerance, parts, 0);
}

static void resume_tests(void)
{
    same("alpha", SCENE_ALPHA, 0, 3);
    same("conserving", SCENE_CONSERVING, 0, 3);
    same("radau", SCENE_RADAU, 0, 3);
    same("explicit", SCENE_EXPLICIT, 0, 3);
    same("alpha", SCENE_ALPHA, 1e-5, 2);
    same("radau", SCENE_RADAU, 1e-7, 2);
    same_linked("alpha with a joint", SCENE_ALPHA, 0, 3, 1);
    same_linked("conserving with a joint", SCENE_CONSERVING, 0, 3, 1);
}

#define FINITE_SWUNG "harness/time/test/swung.yaml"

static void stop(int scheme)
{
    cell_result r;
    fault f = {""};
    cell_request request = cells_of(scenes_case(FINITE_SWUNG), "collocation", 1);
    scenes_at(request.type, request.parameter, "load=gap;integrator=%s;step=%.17g",
              scenes_integrator[scheme], 1 / 512.0);
    const status outcome = cell_run(&request, &r, &f);
    gsl_test(outcome != STATUS_NOT_CONVERGED, "scheme %d: status %d", scheme, outcome);
    gsl_test(r.solve.motions < 100, "scheme %d: %d records", scheme, r.solve.motions);
    for (int i = 0; i < r.solve.motions; i++) {
        const outcome_step *one = &r.solve.motion[i].at;
        gsl_test(!(one->time <= 0.509), "scheme %d: there is a state at %g s", scheme, one->time);
        for (int k = 0; k < SCENE_BALANCES; k++)
            gsl_test(!isfinite(one->balance[k]), "scheme %d: at %g s balance %d is %g", scheme,
                     one->time, k, one->balance[k]);
    }
    cell_result_free(&r);
}

static void not_finite_tests(void)
{
    stop(SCENE_ALPHA);
    stop(SCENE_CONSERVING);
    stop(SCENE_RADAU);
    stop(SCENE_EXPLICIT);
}

#define PEAKS_SWUNG "harness/time/test/swung.yaml"

static void extrema_tests(void)
{
    static const double step[] = {0.04, 0.02, 0.00125};
    enum { RUNS = 3, WHEN = 4, READ = 6 };
    for (int jumps = 0; jumps < 2; jumps++) {
        double value[RUNS][READ];
        for (int i = 0; i < RUNS; i++) {
            cell_result out;
            scenes_solve(PEAKS_SWUNG, "collocation", 1, &out,
                         "read=peaks;end=2.5;integrator=radau;step=%g;load=%s", step[i],
                         jumps ? "push" : "none");
            for (int k = 0; k < READ; k++) {
                value[i][k] = out.solve.quantity[k].value;
                gsl_test(!isfinite(value[i][k]), "quantity %d with %g s", k, step[i]);
            }
            cell_result_free(&out);
        }
        for (int k = 0; k < READ; k++) {
            const double size = fabs(value[2][k]), coarse = fabs(value[0][k] - value[2][k]) / size,
                         fine = fabs(value[1][k] - value[2][k]) / size;
            gsl_test(!(fine < 1e-3 && (k == WHEN || fine < coarse / 6 || fine < 1e-5)),
                     "quantity %d, jumps %d: %.9g, errors %.3g %.3g", k, jumps, value[2][k], coarse,
                     fine);
        }
    }
}

#define OBSERVERS_SWUNG "harness/time/test/swung.yaml"

static const struct {
    const char *name;
    double expected, at, tolerance; /* at < 0: no value */
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
             {"rms_of_a_period", 0.3 * 0.7071067811865476, -1, 1e-9},
             {"mean_of_half_of_it", -0.6 / PI, -1, 1e-8}};
enum { KNOWN = sizeof known / sizeof known[0] };

static void exactly(int scheme, double step)
{
    cell_result r;
    scenes_solve(OBSERVERS_SWUNG, "collocation", 1, &r,
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

static void fly(int scheme, double step, int observed, cell_result *out)
{
    scenes_solve(OBSERVERS_SWUNG, "collocation", 1, out, "end=2;read=%s;integrator=%s;step=%g",
                 observed ? "crossings" : "way", scenes_integrator[scheme], step);
}

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

static void observers_tests(void)
{
    exactly(SCENE_ALPHA, 0.02);
    exactly(SCENE_ALPHA, 0.013);
    exactly(SCENE_CONSERVING, 0.02);
    exactly(SCENE_RADAU, 0.02);
    freely("alpha", SCENE_ALPHA, 0.005, 2);
    freely("conserving", SCENE_CONSERVING, 0.02, 2);
    freely("radau", SCENE_RADAU, 0.04, 5);
}

int main(void)
{
    stations_tests();
    control_tests();
    resume_tests();
    not_finite_tests();
    extrema_tests();
    observers_tests();
    return gsl_test_summary();
}
