/* Stations wherever they lie: inside steps as exact as at their ends, any number in one step, at
 * the begin too; and the motion does not notice them. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/tools/kit/scenes.h"

#define STATIONS_SWUNG "harness/time/test/swung.yaml"

/* Stations that are asked for, by the parameter. */
enum { ODD, ENDS, BOTH, ASKED_KINDS };

static const char *const asked_for[ASKED_KINDS] = {
    "inside_steps;read=last_forces", "ends_of_steps;read=curves", "inside_steps;read=curves"};
enum { KINEMATIC = 5, STRAIN = 6, READINGS };

static void solve(int scheme, double step, int asked, cell_result *out)
{
    scenes_solve(STATIONS_SWUNG, "collocation", 1, out, "integrator=%s;step=%g;stations=%s",
                 scenes_integrator[scheme], step, asked_for[asked]);
}

/* Largest difference of the curves, each by the largest value of it. */
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

/* Errors of two step sizes against a far smaller one. */
static void errors_of(int scheme, double step, int asked, int last, double out[2])
{
    cell_result exact, r;
    solve(SCENE_RADAU, 0.002, asked, &exact);
    for (int i = 0; i < 2; i++) {
        solve(scheme, step / (1 << i), asked, &r);
        out[i] = apart(&r, &exact, 0, last);
        cell_result_free(&r);
    }
    cell_result_free(&exact);
}

/* Order of the scheme in and at the ends of steps, and no larger errors there: but of order 8, of
 * which the polynomial of order 6 loses some. */
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

/* The steps are what they are without stations, bit for bit; what is read by a step of its own is
 * near what the polynomial gives. */
static void undisturbed(const char *name, int scheme, double step)
{
    cell_result with[ASKED_KINDS];
    for (int i = 0; i < ASKED_KINDS; i++)
        solve(scheme, step, i, &with[i]);
    for (int q = 0; q < READINGS; q++) {
        const double last = with[ODD].solve.quantity[q].value;
        for (int i = 1; i < ASKED_KINDS; i++)
            gsl_test(memcmp(&last, &with[i].solve.quantity[q].value, sizeof last) != 0,
                     "%s: %s at the end is %.17g, not %.17g, stations %d", name,
                     with[ODD].scene.quantity[q].name, with[i].solve.quantity[q].value, last, i);
    }
    gsl_test(with[ODD].solve.steps != 20 || with[BOTH].solve.steps != 20, "%s: %d and %d steps",
             name, with[ODD].solve.steps, with[BOTH].solve.steps);
    gsl_test(!(apart(&with[ODD], &with[BOTH], 0, KINEMATIC - 1) < 0.02), "%s: %.2e apart", name,
             apart(&with[ODD], &with[BOTH], 0, KINEMATIC - 1));
    for (int i = 0; i < ASKED_KINDS; i++)
        cell_result_free(&with[i]);
}

int main(void)
{
    orders("alpha", SCENE_ALPHA, 0.02, 2);
    orders("conserving", SCENE_CONSERVING, 0.02, 2);
    orders("radau", SCENE_RADAU, 0.04, 5);
    orders("explicit", SCENE_EXPLICIT, 0.04, 5);
    undisturbed("alpha", SCENE_ALPHA, 0.04);
    undisturbed("conserving", SCENE_CONSERVING, 0.04);
    undisturbed("radau", SCENE_RADAU, 0.04);
    undisturbed("explicit", SCENE_EXPLICIT, 0.04);
    return gsl_test_summary();
}
