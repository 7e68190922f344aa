/* Critical loads where there is none or hardly one, for every formulation: rounding does not look
 * like a load, and loads of one sign do not depend on those of the other. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/analysis/test/bar.h"
#include "harness/formulations/formulations.h"

/* States in which one element, or none, can buckle: whatever there is of a load must not be
 * rounding. */
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

/* Displaced ends, no load: the stresses of nothing. */
static void bent_in_a_frame(scene *s, const double direction[3])
{
    const int tip = bar_cantilever(s, direction), low = bar_end(s, direction, length / 2);
    scene_add_member(s, tip, low, 0, (const double[3]){0.3, 0.1, 1});
    bar_push(s, low, y_axis, 1e-3);
}

/* An equal angle whose warping is left out, shear centre at its heel, between forks. */
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

/* Loads of one sign are the same whether or not the others are asked for, and whether or not those
 * are found: some formulations have one spurious load of the other sign for each element. */
static void one_side_alone(const element_type *e, ask_tally *tally)
{
    for (int n = 2; n <= 64; n *= 2) {
        loads both, alone;
        ask_tally any = {0}; /* negative ones may not be found */
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

/* A load that buckles this bar at this mesh is at most n^2 times Euler's, with room; rounding is
 * 1e16. */
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

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *e = registry_formulations[i];
        ask_tally tally = {0};
        no_rounding(e, &tally);
        one_side_alone(e, &tally);
        ask_conclude(&tally, e, "loads where there is none");
    }
    return gsl_test_summary();
}
