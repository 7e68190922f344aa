/* For every formulation, critical loads of bars must have the known values, signs, order and
 * multiplicities. If a load does not exist, no value may be given. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/analysis/test/bar.h"
#include "harness/formulations/formulations.h"
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

/* Returns the critical load k^2 EI if the load acts at the distance a = `arm` beyond the end of the
 * bar of length L: tan(kL) = 1/(k a), with kL in (0, pi/2) if a > 0, and in (pi/2, pi) if a < 0. */
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

static void critical_tests(void)
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
}

static void bent_between_forks(scene *s, const double direction[3], int component)
{
    const int a = scene_add_node(s, 0, 0, 0), b = bar_end(s, direction, length);
    scene_add_member(s, a, b, bar_section(s), y_axis);
    scene_hold(s, a, SCENE_UX, SCENE_RX);
    scene_hold(s, b, SCENE_UY, SCENE_RX);
    scene_add_load(s, SCENE_MOMENT, a, 0, component == SCENE_RY, component == SCENE_RZ);
    scene_add_load(s, SCENE_MOMENT, b, 0, -(component == SCENE_RY), -(component == SCENE_RZ));
}

static void bent_about_y(scene *s, const double direction[3])
{
    bent_between_forks(s, direction, SCENE_RY);
}

static void bent_about_z(scene *s, const double direction[3])
{
    bent_between_forks(s, direction, SCENE_RZ);
}

static void pushed_across(scene *s, const double direction[3])
{
    const double across[3] = {direction[1], -direction[0], 0};
    bar_push(s, bar_cantilever(s, direction), across, 1);
}

static void bent_in_a_frame(scene *s, const double direction[3])
{
    const int tip = bar_cantilever(s, direction), low = bar_end(s, direction, length / 2);
    scene_add_member(s, tip, low, 0, (const double[3]){0.3, 0.1, 1});
    bar_push(s, low, y_axis, 1e-3);
}

static void angle(scene *s, int *foot, int *head)
{
    section_spec spec = section_spec_constants(young, young / 2.6);
    section *c = &spec.constants;
    c->A = 1.9e-3;
    c->Iy = 4.2e-6;
    c->Iz = 1.05e-6;
    c->Ip = c->Iy + c->Iz;
    c->It = 4e-8;
    c->ys = 0.041;
    c->wagner_y = -8.5e-8;
    *foot = scene_add_node(s, 0, 0, 0);
    *head = scene_add_node(s, length, 0, 0);
    scene_add_member(s, *foot, *head, scene_add_section(s, &spec), (const double[3]){0, 1, 0});
    scene_hold(s, *foot, SCENE_UX, SCENE_RX);
    scene_hold(s, *head, SCENE_UY, SCENE_RX);
    scene_omit(s, FEATURE_SHEAR | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
}

static void angle_bent(scene *s, const double direction[3])
{
    int foot, head;
    (void)direction;
    angle(s, &foot, &head);
    scene_add_load(s, SCENE_MOMENT, foot, 0, 1, 0);
    scene_add_load(s, SCENE_MOMENT, head, 0, -1, 0);
}

static void angle_compressed(scene *s, const double direction[3])
{
    int foot, head;
    angle(s, &foot, &head);
    bar_push(s, foot, direction, 1);
    bar_push(s, head, direction, -1);
}

static void one_side_alone(const element_type *e, ask_tally *tally)
{
    for (int n = 2; n <= 64; n *= 2) {
        loads both, alone;
        ask_tally any = {0};
        if (!bar_find_signs(e, tally, angle_compressed, along_x, n, 1, &alone))
            return;
        bar_find_signs(e, &any, angle_compressed, along_x, n, 2, &both);
        gsl_test(any.count[ASK_NOT_OFFERED] + any.count[ASK_REFUSED] > 0,
                 "%s, angle of %d elements: both signs are offered", e->name, n);
        for (int i = 0; i < WANTED; i++)
            gsl_test_rel(both.value[0][i], alone.value[0][i], 1e-9,
                         "%s, angle of %d elements: load %d beside negative ones (%s)", e->name, n,
                         i + 1, both.why[0][i]);
        gsl_test(isnan(both.value[1][0]) && both.why[1][0][0] == '\0',
                 "%s, angle of %d elements: a load, or why there is none", e->name, n);
    }
}

/* No critical load may exceed 1e9 times Euler's load (angle_bent: 1e15 N), because it would be due
 * to round-off. */
static void no_rounding(const element_type *e, ask_tally *tally)
{
    static build *const state[] = {angle_bent, bent_about_y, bent_about_z, pushed_across,
                                   bent_in_a_frame};
    for (int k = 0; k < 5; k++)
        for (int n = 1; n <= 64; n *= 4) {
            loads l;
            if (!bar_find(e, tally, state[k], k < 3 ? along_x : oblique, n, &l))
                continue;
            for (int i = 0; i < 2 * WANTED; i++) {
                const double value = l.value[i / WANTED][i % WANTED];
                gsl_test(fabs(value) > 1e9 * (k == 0 ? 1e6 : bar_euler()),
                         "%s, state %d, %d elements: load %g is rounding (%s)", e->name, k, n,
                         value, l.why[i / WANTED][i % WANTED]);
            }
        }
}

static void critical_rounding_tests(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *e = registry_formulations[i];
        ask_tally tally = {0};
        no_rounding(e, &tally);
        one_side_alone(e, &tally);
        ask_conclude(&tally, e, "loads where there is none");
    }
}

int main(void)
{
    critical_tests();
    critical_rounding_tests();
    return gsl_test_summary();
}
