/* Stations wherever they lie: inside steps as exact as at their ends, any number in one step, at
 * the begin too; and the motion does not notice them. */
#include <math.h>
#include <string.h>

#include "harness/time/test/swung.h"

enum { INTEGRATOR, STEP, ASKED, PARAMETERS };
/* Stations that are asked for, by the parameter. */
enum { ODD, ENDS, BOTH, ASKED_KINDS };

static const double odd[] = {0,     0.1037, 0.1041, 0.2113, 0.2891, 0.3579, 0.4233,
                             0.497, 0.5511, 0.6103, 0.6789, 0.7357, 0.8},
                    ends[] = {0, 0.08, 0.16, 0.24, 0.32, 0.4, 0.48, 0.56, 0.64, 0.72, 0.76, 0.8};
enum { ODDS = sizeof odd / sizeof odd[0], ENDINGS = sizeof ends / sizeof ends[0] };

static const struct {
    const char *name;
    scene_component of;
    int rate;
} read[] = {{"x", {1, SCENE_UX}, 0},
            {"y", {1, SCENE_UY}, 0},
            {"turn", {1, SCENE_RY}, 0},
            {"v", {1, SCENE_UZ}, 1},
            {"spin", {1, SCENE_RX}, 1}};
enum { KINEMATIC = sizeof read / sizeof read[0], ENERGY = KINEMATIC, STRAIN, READINGS };

static void add(scene *s, int motion, int forces)
{
    for (int i = 0; i < READINGS; i++) {
        const scene_extract what = i == ENERGY   ? scene_balance_of(SCENE_ENERGY)
                                   : i == STRAIN ? scene_balance_of(SCENE_STRAIN)
                                   : read[i].rate
                                       ? scene_rate(read[i].of.node, read[i].of.component)
                                       : scene_coordinate(read[i].of.node, read[i].of.component);
        scene_quantity *q = scene_add_quantity(s,
                                               i == ENERGY   ? "energy"
                                               : i == STRAIN ? "strain"
                                                             : read[i].name,
                                               "", motion, what);
        if (i < KINEMATIC || forces)
            scene_set_curve(q, "t", "s", 1, 0);
    }
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    swung_build(s);
    const scene_motion how = swung_motion((scene_scheme)value[INTEGRATOR], value[STEP]);
    const int at_ends = value[ASKED] == ENDS;
    const int motion =
        scene_add_motion(s, SCENE_NONE, at_ends ? ENDINGS : ODDS, at_ends ? ends : odd, how);
    add(s, motion, value[ASKED] != ODD);
    return STATUS_OK;
}

static const parameter_type table[] = {
    [INTEGRATOR] = {"integrator", "1", 0, 0, 3, TIMED_INTEGRATORS, "scheme"},
    [STEP] = {"step", "s", 0.04, 1e-6, 1, NULL, "of it"},
    [ASKED] = {"asked", "1", 0, 0, ASKED_KINDS, NULL, "which stations"},
    {0}};
static const case_type flown = {.name = "flown", .parameters = {table}, .build = build};

static void solve(int scheme, double step, int asked, cell_result *out)
{
    swung_solve(&flown, (const double[]){scheme, step, asked}, PARAMETERS, out);
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
