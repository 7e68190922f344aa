/* Critical loads of bars whose answer is known, for every formulation: sign, order and number of
 * equal values, what does not exist. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/analysis/test/bar.h"
#include "harness/tools/kit/accepted.h"

static void compressed(scene *s, const double direction[3])
{
    bar_push(s, bar_cantilever(s, direction), direction, -1);
}

static void stretched(scene *s, const double direction[3])
{
    bar_push(s, bar_cantilever(s, direction), direction, 1);
}

static void unloaded(scene *s, const double direction[3])
{
    bar_push(s, bar_cantilever(s, direction), direction, 0);
}

/* Held at both ends and pushed in the middle: one half is compressed, the other stretched. */
static void half_and_half(scene *s, const double direction[3])
{
    const int a = scene_add_node(s, 0, 0, 0), b = bar_end(s, direction, length / 2),
              c = bar_end(s, direction, length);
    const int profile = bar_section(s);
    scene_add_member(s, a, b, profile, y_axis);
    scene_add_member(s, b, c, profile, y_axis);
    scene_hold_all(s, a);
    scene_hold_all(s, c);
    bar_push(s, b, direction, 1);
}

/* The force acts on a rigid arm of the bar's length beyond its tip, or before it. */
static void with_arm(scene *s, const double direction[3], double arm)
{
    const int tip = bar_cantilever(s, direction);
    const double at = length + arm;
    const int end =
        scene_add_attached(s, tip, at * direction[0], at * direction[1], at * direction[2]);
    bar_push(s, end, direction, -1);
}

static void arm_beyond(scene *s, const double direction[3])
{
    with_arm(s, direction, length);
}

static void arm_before(scene *s, const double direction[3])
{
    with_arm(s, direction, -length / 2);
}

/* tan(kL) = 1/(k a) in (0, pi/2) for a > 0, (pi/2, pi) for a < 0. */
static double load_with_arm(double arm)
{
    double low = (arm > 0 ? 1e-9 : 0.5 + 1e-9) * PI / length,
           high = low + (0.5 - 2e-9) * PI / length;
    for (int i = 0; i < 200; i++) {
        const double k = (low + high) / 2, value = cos(k * length) - k * arm * sin(k * length);
        *(value > 0 ? &low : &high) = k;
    }
    return low * low * bar_rigidity();
}

static void expect(const element_type *e, const char *what, const loads *l, int sign, int order,
                   double exact, double tolerance)
{
    gsl_test_rel(l->value[sign][order], exact, tolerance, "%s, %s: %s load %d (%s)", e->name, what,
                 sign == 0 ? "positive" : "negative", order + 1, l->why[sign][order]);
}

static void expect_none(const element_type *e, const char *what, const loads *l, int sign)
{
    for (int i = 0; i < WANTED; i++)
        gsl_test(!isnan(l->value[sign][i]) ||
                     strstr(l->why[sign][i], sign == 0 ? "no positive" : "no negative") == NULL,
                 "%s, %s: %g, %s", e->name, what, l->value[sign][i], l->why[sign][i]);
}

/* Every load twice, about y and about z. */
static void columns(const element_type *e, ask_tally *tally, const double direction[3])
{
    const double first = bar_euler() / 4, exact[WANTED] = {first, first, 9 * first, 9 * first};
    loads l;
    if (!bar_find(e, tally, compressed, direction, ELEMENTS, &l))
        return;
    for (int i = 0; i < WANTED; i++) {
        expect(e, "compressed", &l, 0, i, exact[i], i < 2 ? 2e-3 : 2e-2);
        if (i % 2 == 1)
            gsl_test_rel(l.value[0][i], l.value[0][i - 1], 1e-7, "%s: loads %d and %d are equal",
                         e->name, i, i + 1);
    }
    if (bar_find(e, tally, stretched, direction, ELEMENTS, &l)) {
        for (int i = 0; i < WANTED; i++)
            expect(e, "stretched", &l, 1, i, -exact[i], i < 2 ? 2e-3 : 2e-2);
    }
    if (bar_find(e, tally, unloaded, direction, ELEMENTS, &l)) {
        expect_none(e, "without load", &l, 0);
        expect_none(e, "without load", &l, 1);
    }
    if (bar_find(e, tally, half_and_half, direction, ELEMENTS, &l))
        for (int i = 0; i < WANTED; i++) {
            gsl_test_rel(l.value[0][i], -l.value[1][i], 1e-7,
                         "%s, half and half: load %d has both signs", e->name, i + 1);
            gsl_test(i > 0 && !(l.value[0][i] >= l.value[0][i - 1] * (1 - 1e-9)),
                     "%s, half and half: load %d in order", e->name, i + 1);
        }
    if (bar_find(e, tally, arm_beyond, direction, ELEMENTS, &l))
        expect(e, "arm beyond the tip", &l, 0, 0, load_with_arm(length), 2e-3);
    if (bar_find(e, tally, arm_before, direction, ELEMENTS, &l))
        expect(e, "arm before the tip", &l, 0, 0, load_with_arm(-length / 2), 5e-3);
}

int main(void)
{
    for (int i = 0; accepted_at(i) != NULL; i++) {
        const element_type *e = accepted_at(i);
        ask_tally tally = {0};
        columns(e, &tally, along_x);
        columns(e, &tally, oblique);
        gsl_test((e->offers & FEATURE_GEOMETRIC) && tally.values == 0,
                 "%s offers stability and solves none of it", e->name);
        ask_conclude(&tally, e, "critical loads of bars");
    }
    return gsl_test_summary();
}
