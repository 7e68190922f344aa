/* Gravity on bodies: forces m g at centres of mass that move with their nodes. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/vec3.h"
#include "elements/test/sections.h"
#include "harness/tools/kit/ask.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_collocation, element_geometrically_exact;

static const double g = 9.81, weight_end = 1, y_axis[3] = {0, 0, 1};

static int leaf_profile(scene *s)
{
    section_spec spec = section_spec_rectangle(210e9, 81e9, 10e-3, 2e-3);
    spec.density = 7800;
    return scene_add_section(s, &spec);
}

static const scene_body heavy = {
    .mass = 0.4, .centre = {0.02, -0.03, 0.05}, .inertia = {2e-4, 3e-4, 4e-4, 1e-5, 0, 0}};

/* Its weight as it is, or by hand. */
static void add_weight(scene *s, int node, const double by[3], int by_hand)
{
    const double m = by_hand ? s->node[node].body.mass : 1;
    const int load = scene_add_load(s, by_hand ? SCENE_FORCE : SCENE_WEIGHT, node, m * by[0],
                                    m * by[1], m * by[2]);
    if (by_hand)
        memcpy(scene_load_at(s, load)->at, s->node[node].body.centre, sizeof heavy.centre);
}

static void add_balances(scene *s, int motion, int scheme)
{
    static const char *const name[] = {"kinetic", "strain",     "energy",
                                       "work",    "dissipated", "drift"};
    for (int i = 0; i <= SCENE_DRIFT; i++) {
        char full[SCENE_NAME];
        snprintf(full, sizeof full, "%s_%d", name[i], scheme);
        scene_add_quantity(s, full, "J", motion, scene_balance_of((scene_balance)i));
    }
}

/* A cantilever with a body beside its tip, in all analyses. */
static void all_analyses(scene *s, int by_hand)
{
    static const double down[3] = {0.3, -9.81, 1.2}, spin[3] = {3, -2, 5}, path = 2e-4;
    scene_init(s, "weight");
    const int profile = leaf_profile(s), root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, 0.2, 0, 0), body = scene_add_attached(s, tip, 0.22, 0.01, 0);
    scene_hold_all(s, root);
    scene_add_member(s, root, tip, profile, y_axis);
    scene_set_body(s, body, heavy);
    add_weight(s, body, down, by_hand);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    const int bent = scene_add_static(s, 1, &weight_end, 2);
    scenes_ask_motion(s, "linear", scene_add_linear(s), body);
    scenes_ask_motion(s, "bent", bent, body);
    scenes_ask_frequencies(s, "frequency", scene_add_modal(s, bent), 4);
    scene_add_quantity(s, "critical", "", scene_add_buckling(s, SCENE_NONE),
                       scene_critical_factor(1, 0));
    scene_rotating_frame frame = {.centre = {0}};
    memcpy(frame.omega, spin, sizeof spin);
    scenes_ask_motion(s, "rotation", scene_add_rotation(s, 1, &weight_end, 2, 4, frame), body);
    for (int i = 0; i < SCENE_SCHEMES; i++) {
        char name[SCENE_NAME];
        const scene_motion how = {.scheme = (scene_scheme)i,
                                  .alpha = scene_alpha_of_radius(0.9),
                                  .step = i == SCENE_EXPLICIT ? 1e-7 : 2e-5};
        const int motion = scene_add_motion(s, SCENE_NONE, 1, &path, how);
        snprintf(name, sizeof name, "motion_%d", i);
        scenes_ask_motion(s, name, motion, body);
        add_balances(s, motion, i);
    }
}

/* Every analysis has the very bits of the force by hand. */
static void by_hand(void)
{
    scene s;
    static answer one, other;
    all_analyses(&s, 0);
    ask_scene(&s, &element_geometrically_exact, NULL, 2, &one);
    scene_free(&s);
    all_analyses(&s, 1);
    ask_scene(&s, &element_geometrically_exact, NULL, 2, &other);
    scene_free(&s);
    gsl_test(one.outcome != ASK_ANSWERED || one.values != one.count, "all analyses: %s",
             one.reason);
    for (int i = 0; i < one.count; i++)
        gsl_test(!(one.value[i] == other.value[i]), "%s: %.17g, by hand %.17g", one.name[i],
                 one.value[i], other.value[i]);
}

/* Hung on a short stiff bar: the reaction is both weights, the moment that of the centre where it
 * is then. */
static void hung(void)
{
    static const double down[3] = {0, -9.81, 0};
    const double *c = heavy.centre;
    scene s;
    answer a;
    scene_init(&s, "hung");
    const int profile = leaf_profile(&s), top = scene_add_node(&s, 0, 0, 0),
              low = scene_add_node(&s, 0, -0.05, 0),
              centre = scene_add_attached(&s, low, c[0], c[1] - 0.05, c[2]),
              bar = scene_add_member(&s, top, low, profile, y_axis);
    scene_hold_all(&s, top);
    scene_set_body(&s, low, heavy);
    add_weight(&s, low, down, 0);
    scene_add_load(&s, SCENE_GRAVITY, bar, down[0], down[1], down[2]);
    const int path = scene_add_static(&s, 1, &weight_end, 2);
    scene_add_quantity(&s, "fy", "N", path, scene_reaction(top, SCENE_UY));
    scene_add_quantity(&s, "mz", "N m", path, scene_reaction(top, SCENE_RZ));
    scene_add_quantity(&s, "ux", "m", path, scene_coordinate(centre, SCENE_UX));
    ask_scene(&s, &element_collocation, NULL, 2, &a);
    scene_free(&s);
    const double of_bar = 7800 * 10e-3 * 2e-3 * 0.05 * g, of_body = heavy.mass * g;
    gsl_test_rel(answer_of(&a, "fy"), of_bar + of_body, 1e-12, "reaction: %s", a.reason);
    gsl_test_rel(answer_of(&a, "mz"), (c[0] + answer_of(&a, "ux")) * of_body, 1e-4,
                 "moment, but for the bar's own weight where it bends");
}

/* A body on a pin that lets it turn about z alone, or freely on what is held there. */
static int pinned(scene *s, int holds, scene_body body)
{
    static const int last[] = {SCENE_RY, SCENE_UZ, SCENE_UY, SCENE_UY},
                     first[] = {SCENE_UX, SCENE_UX, SCENE_UX, SCENE_UY};
    scene_init(s, "pendulum");
    const section_spec spec = sections_of(1, 1, 1, 1);
    const int profile = scene_add_section(s, &spec), pin = scene_add_node(s, 0, 0, 0),
              a = scene_add_attached(s, pin, -0.1, 0, 0), b = scene_add_attached(s, pin, 0.1, 0, 0);
    scene_hold(s, pin, first[holds], last[holds]);
    scene_add_member(s, a, b, profile, y_axis);
    scene_set_body(s, pin, body);
    add_weight(s, pin, (const double[3]){0, -9.81, 0}, 0);
    return pin;
}

/* Small swings of a body whose centre is beside its pin, of any amplitude near none: 2 pi sqrt(I/m
 * g d). */
static void period(void)
{
    static const double steps[] = {[SCENE_ALPHA] = 5000,
                                   [SCENE_CONSERVING] = 5000,
                                   [SCENE_RADAU] = 100,
                                   [SCENE_EXPLICIT] = 100};
    const double pi = acos(-1), d = 0.3, small = 1e-4;
    const scene_body body = {.mass = 2, .centre = {0, -d, 0.1}, .inertia = {0.1, 0.1, 0.05}};
    const double I = body.inertia[2] + body.mass * d * d,
                 T = 2 * pi * sqrt(I / (body.mass * g * d)), until = 3.2 * T;
    scene s;
    answer a;
    const int pin = pinned(&s, 0, body), still = scene_add_static(&s, 1, &weight_end, 1);
    scenes_ask_frequencies(&s, "about", scene_add_modal(&s, still), 1);
    for (int i = 0; i < SCENE_SCHEMES; i++) {
        char name[8];
        const scene_motion how = {.scheme = (scene_scheme)i,
                                  .alpha = scene_alpha_of_radius(0.9),
                                  .step = T / steps[i],
                                  .start = {.spin = {0, 0, small * 2 * pi / T}}};
        const int motion = scene_add_motion(&s, SCENE_NONE, 1, &until, how);
        snprintf(name, sizeof name, "T_%d", i);
        scene_set_passing(
            scene_add_quantity(&s, name, "s", motion, scene_coordinate(pin, SCENE_RZ)),
            SCENE_PERIOD, (scene_passing){.direction = SCENE_FALLING});
    }
    ask_scene(&s, &element_collocation, NULL, 1, &a);
    scene_free(&s);
    gsl_test_rel(answer_of(&a, "about_0"), 1 / T, 1e-9, "about the hanging state: %s", a.reason);
    for (int i = 0; i < SCENE_SCHEMES; i++)
        gsl_test_rel(answer_of(&a, (const char *const[]){"T_0", "T_1", "T_2", "T_3"}[i]), T,
                     steps[i] > 1000 ? 2e-7 : 2e-8, "period of scheme %d: %s", i, a.reason);
}

/* A heavy top that falls, on a pin or on one that slides along z, or in the plane: the work of its
 * weight is what -m g . r_c loses, and all of it is energy. */
static void top(int holds)
{
    static const scene_body body = {
        .mass = 2, .centre = {0.2, 0.25, 0.1}, .inertia = {0.1, 0.12, 0.05, 0.01}};
    double at[ASK_POINTS];
    scene s;
    answer a;
    const int pin = pinned(&s, holds, body);
    for (int i = 0; i < ASK_POINTS; i++)
        at[i] = 0.25 * (i + 1);
    const scene_motion how = {
        .scheme = SCENE_CONSERVING, .step = 0.02, .start = {.spin = {1, 4, -2}}};
    const int motion = scene_add_motion(&s, SCENE_NONE, ASK_POINTS, at, how);
    const struct {
        const char *name;
        scene_extract what;
    } asked[] = {{"work", scene_balance_of(SCENE_WORK)},
                 {"drift", scene_balance_of(SCENE_DRIFT)},
                 {"y_x", scene_orientation_entry(pin, 1, 0)},
                 {"y_y", scene_orientation_entry(pin, 1, 1)},
                 {"y_z", scene_orientation_entry(pin, 1, 2)}};
    enum { ASKED = sizeof asked / sizeof *asked };
    for (int i = 0; i < ASKED; i++)
        scene_set_curve(scene_add_quantity(&s, asked[i].name, "", motion, asked[i].what), "t", "s",
                        1, 0);
    ask_scene(&s, &element_collocation, NULL, 1, &a);
    scene_free(&s);
    gsl_test(a.outcome != ASK_ANSWERED || a.points[0] != ASK_POINTS, "top: %s", a.reason);
    const double size = body.mass * g * vec3_norm(body.centre);
    double moved = 0;
    for (int i = 0; i < a.points[0]; i++) {
        const double way[3] = {a.curve[2][i], a.curve[3][i], a.curve[4][i]},
                     fallen = body.centre[1] - vec3_dot(way, body.centre);
        gsl_test_abs(a.curve[0][i] / size, body.mass * g * fallen / size, 1e-12, "work at %g s",
                     at[i]);
        gsl_test_abs(a.curve[1][i] / size, 0, 1e-12, "drift at %g s", at[i]);
        moved = fmax(moved, fabs(fallen));
    }
    gsl_test(!(moved > 0.1), "it falls: %g m", moved);
}

/* A column without mass under a body whose centre is `above` its head: k L tan(k L) = L/above, of
 * any height without. */
static void column(double above)
{
    const double L = 0.5, mass = 0.25, EI = 210e9 * 10e-3 * pow(2e-3, 3) / 12;
    double low = 0, high = acos(0);
    for (int i = 0; i < 60; i++) {
        const double x = (low + high) / 2;
        *(x * sin(x) * above < L * cos(x) ? &low : &high) = x;
    }
    scene s;
    answer a;
    scene_init(&s, "column");
    section_spec spec = section_spec_rectangle(210e9, 81e9, 10e-3, 2e-3);
    const int profile = scene_add_section(&s, &spec), foot = scene_add_node(&s, 0, 0, 0),
              head = scene_add_node(&s, L, 0, 0);
    scene_hold_all(&s, foot);
    scene_add_member(&s, foot, head, profile, (const double[3]){0, 1, 0});
    scene_set_body(&s, head, (scene_body){.mass = mass, .centre = {above, 0, 0}});
    add_weight(&s, head, (const double[3]){-9.81, 0, 0}, 0);
    scene_omit(&s, FEATURE_SHEAR);
    scene_add_quantity(&s, "factor", "", scene_add_buckling(&s, SCENE_NONE),
                       scene_critical_factor(1, 0));
    ask_scene(&s, &element_collocation, NULL, 16, &a);
    scene_free(&s);
    gsl_test_rel(answer_of(&a, "factor"), EI * low * low / (L * L) / (mass * g), 1e-5,
                 "column, centre %g m above: %s", above, a.reason);
}

int main(void)
{
    by_hand();
    hung();
    period();
    for (int holds = 1; holds < 4; holds++)
        top(holds);
    column(0);
    column(0.2);
    return gsl_test_summary();
}
