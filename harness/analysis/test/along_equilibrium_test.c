/* Loads along members inside the equilibrium of `collocation`: orders of displacements and of the
 * moment within, at large rotations, of curved members, and of critical loads about a state. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/quadrature.h"
#include "elements/test/sections.h"
#include "elements/test/worst.h"
#include "harness/tools/kit/ask.h"

extern const element_type element_collocation;

enum { ROOT, TIP, VALUES = 4 };

typedef enum form { STRAIGHT, CURVED, ARC } form;
typedef enum acting { UNIFORM, LINEAR, FOLLOWER, MOMENT } acting;
static const double y_axis[3] = {0, 1, 0}, path[4] = {0.25, 0.5, 0.75, 1};

static void member_of(form shape, scene *s)
{
    const double curved[3] = {0.3, 0.5, 0.8}, arc[3] = {0, 0, 1};
    const section_spec spec = sections_of(shape == ARC ? 1e10 : 1e4, 2, 1, 0.7);
    scene_init(s, "along");
    scene_add_node(s, 0, 0, 0);
    /* of a length of 1: the chord of 1 rad */
    scene_add_node(s, shape == ARC ? sin(1) : 1, shape == ARC ? 1 - cos(1) : 0, 0);
    scene_add_member(s, ROOT, TIP, scene_add_section(s, &spec), y_axis);
    scene_hold_all(s, ROOT);
    if (shape != STRAIGHT)
        memcpy(scene_member_at(s, 0)->curvature, shape == ARC ? arc : curved, sizeof arc);
    scene_omit(s, SCENE_OMITTABLE);
}

static void load_of(acting what, scene *s)
{
    const double last[3] = {-3, -8, 1};
    scene_load *load = scene_load_at(
        s, what == MOMENT ? scene_add_load(s, SCENE_DISTRIBUTED_MOMENT, 0, 0, 0, 4)
                          : scene_add_load(s, SCENE_DISTRIBUTED, 0, what == LINEAR ? 5 : 0, -5, 3));
    load->follower = what == FOLLOWER;
    load->varies = what == LINEAR;
    memcpy(load->last, last, sizeof last);
}

static void values_of(const scene *s, int stages, int n, double out[VALUES])
{
    const double option[ELEMENT_MAX_OPTIONS] = {stages - 3};
    answer a;
    ask_scene(s, &element_collocation, option, n, &a);
    gsl_test(a.outcome != ASK_ANSWERED, "%d stages, n = %d: %s", stages, n, a.reason);
    for (int i = 0; i < VALUES; i++)
        out[i] = a.value[i];
}

/* Largest error with n elements, and the order from there to 2 n. */
static void order_of(const char *name, const scene *s, int stages, int n, double least,
                     double error)
{
    double right[VALUES], found[2][VALUES], worst[2] = {0};
    values_of(s, 8, 12, right);
    for (int k = 0; k < 2; k++) {
        values_of(s, stages, n << k, found[k]);
        for (int i = 0; i < VALUES; i++)
            worst[k] = worst_of(worst[k], fabs(found[k][i] - right[i]));
    }
    const double order = log2(worst[0] / worst[1]);
    gsl_test(!(order > least && worst[0] < error),
             "%s, %d stages: order %.2f of %.1f, error %.1e with n = %d", name, stages, order,
             least, worst[0], n);
}

static void ask_all(scene *s, int analysis)
{
    const int component[] = {SCENE_UX, SCENE_UY, SCENE_UZ};
    for (int i = 0; i < 3; i++) {
        const char name[] = {'u', (char)('x' + i), 0};
        scene_add_quantity(s, name, "m", analysis, scene_coordinate(TIP, component[i]));
    }
    scene_add_quantity(s, "M", "N m", analysis, scene_internal_at(0, 0.5, SCENE_MZ));
}

static void large_rotations(void)
{
    static const struct {
        const char *name;
        form shape;
        acting what;
        double least[2], error[2]; /* of 3 and 4 stages, n = 4 */
    } scenes[] = {
        {"a uniform load", STRAIGHT, UNIFORM, {5.7, 7.5}, {1e-5, 2e-7}},
        {"a linear one", STRAIGHT, LINEAR, {5.7, 7.5}, {1e-5, 2e-7}},
        {"one along a curved member", CURVED, LINEAR, {5.5, 7}, {1e-5, 2e-7}},
        /* on the field that all types share */
        {"one that follows", STRAIGHT, FOLLOWER, {3.6, 3.6}, {1e-2, 1e-2}},
        {"a moment along", STRAIGHT, MOMENT, {3.6, 3.6}, {1e-2, 1e-2}},
    };
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        scene s;
        member_of(scenes[i].shape, &s);
        load_of(scenes[i].what, &s);
        ask_all(&s, scene_add_static(&s, 4, path, 1));
        for (int k = 0; k < 2; k++)
            order_of(scenes[i].name, &s, 3 + k, 4, scenes[i].least[k], scenes[i].error[k]);
        scene_free(&s);
    }
}

/* Castigliano, EI = 1, load 1 down per length of an arc of 1 rad, R = 1: moments at t are those of
 * the load beyond it, the tip's displacement int M m, without stretch. */
static void arc_by_castigliano(void)
{
    enum { POINTS = 20 };
    double at[POINTS], weight[POINTS], sinks = 0, error[2];
    quadrature_points(POINTS, at, weight);
    for (int i = 0; i < POINTS; i++)
        sinks +=
            weight[i] * (cos(at[i]) - cos(1) - (1 - at[i]) * sin(at[i])) * (sin(1) - sin(at[i]));
    scene s;
    answer a;
    const double option[ELEMENT_MAX_OPTIONS] = {0};
    member_of(ARC, &s);
    scene_add_load(&s, SCENE_DISTRIBUTED, 0, 0, -1, 0);
    scene_add_quantity(&s, "u", "m", scene_add_linear(&s), scene_coordinate(TIP, SCENE_UY));
    for (int k = 0; k < 2; k++) {
        ask_scene(&s, &element_collocation, option, 1 << k, &a);
        error[k] = a.value[0] + sinks;
    }
    gsl_test(!(fabs(error[0]) < 1e-4 && log2(fabs(error[0] / error[1])) > 5.5),
             "an arc of 1 rad: off by %.1e, %.1e", error[0], error[1]);
    scene_free(&s);
}

/* A column under its own weight about a loaded state: q L^3/EI = 7.837347 (Greenhill). */
static void own_weight(void)
{
    const double stations[1] = {1}, option[ELEMENT_MAX_OPTIONS] = {0}, right = 7.83734744;
    const section_spec spec = sections_of(1e8, 50, 1, 50);
    double error[2];
    scene s;
    answer a;
    scene_init(&s, "column");
    scene_add_node(&s, 0, 0, 0);
    scene_add_node(&s, 1, 0, 0);
    scene_add_member(&s, ROOT, TIP, scene_add_section(&s, &spec), y_axis);
    scene_hold_all(&s, ROOT);
    scene_omit(&s, SCENE_OMITTABLE);
    scene_add_load(&s, SCENE_DISTRIBUTED, 0, -1, 0, 0);
    const int state = scene_add_static(&s, 1, stations, 1);
    scene_add_quantity(&s, "q", "1", scene_add_buckling(&s, state), scene_critical_factor(1, 0));
    scene_add_quantity(&s, "linear", "1", scene_add_buckling(&s, SCENE_NONE),
                       scene_critical_factor(1, 0));
    for (int k = 0; k < 2; k++) {
        ask_scene(&s, &element_collocation, option, 2 << k, &a);
        gsl_test(a.outcome != ASK_ANSWERED, "%s", a.reason);
        error[k] = a.value[0] / right - 1;
        gsl_test(!(fabs(a.value[1] / right - 1) < (k ? 3e-4 : 3e-3)),
                 "own weight, linear buckling: off by %.1e", a.value[1] / right - 1);
    }
    gsl_test(!(fabs(error[0]) < 2e-4 && log2(error[0] / error[1]) > 5.5),
             "own weight about a state: off by %.1e, %.1e", error[0], error[1]);
    scene_free(&s);
}

int main(void)
{
    large_rotations();
    arc_by_castigliano();
    own_weight();
    return gsl_test_summary();
}
