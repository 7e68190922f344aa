/* Gravity on bodies: the force m g must act at the centre of mass, which moves with the node. Also:
 * forks at the ends of a bent beam, and released ends. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
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

static void hanging(void)
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

/* The period of small oscillations of a body whose centre is at a distance d from its pin is 2 pi
 * sqrt(I/(m g d)), where I is the moment of inertia about the pin. */
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
    } requested[] = {{"work", scene_balance_of(SCENE_WORK)},
                     {"drift", scene_balance_of(SCENE_DRIFT)},
                     {"y_x", scene_orientation_entry(pin, 1, 0)},
                     {"y_y", scene_orientation_entry(pin, 1, 1)},
                     {"y_z", scene_orientation_entry(pin, 1, 2)}};
    enum { REQUESTED = sizeof requested / sizeof *requested };
    for (int i = 0; i < REQUESTED; i++)
        scene_set_curve(scene_add_quantity(&s, requested[i].name, "", motion, requested[i].what),
                        "t", "s", 1, 0);
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

/* A massless column carries a body whose centre is at the height `above` its head. It buckles at k
 * L tan(k L) = L/above, with k^2 = P/(E I). */
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

static void weight_tests(void)
{
    by_hand();
    hanging();
    period();
    for (int holds = 1; holds < 4; holds++)
        top(holds);
    column(0);
    column(0.2);
}

enum { MOVED = 0, MOMENT = 3, TURN = 6, VALUES = 9 };

/* Builds a beam on two forks with a force at mid-span. Q rotates the scene from a beam along x with
 * its web along z. */
static void bent_beam(const double Q[9], const double force[3], scene *s)
{
    static const char *const name[VALUES] = {"u0", "u1", "u2", "M0", "M1", "M2", "t0", "t1", "t2"};
    const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1}, end = 1;
    double axis[3], across[3], web[3], load[3];
    section_spec spec = section_spec_rectangle(1e5, 4e4, 0.1, 0.15);
    spec.shear_factor[0] = spec.shear_factor[1] = 5.0 / 6;
    spec.given.Iw = 0;
    mat3_mul_vec(Q, x, axis);
    mat3_mul_vec(Q, y, across);
    mat3_mul_vec(Q, z, web);
    mat3_mul_vec(Q, force, load);
    scene_init(s, "bent_beam");
    const int profile = scene_add_section(s, &spec), first = scene_add_node(s, 0, 0, 0),
              middle = scene_add_node(s, axis[0], axis[1], axis[2]),
              last = scene_add_node(s, 2 * axis[0], 2 * axis[1], 2 * axis[2]);
    scene_add_member(s, first, middle, profile, across);
    scene_add_member(s, middle, last, profile, across);
    scene_hold(s, first, SCENE_UX, SCENE_UZ);
    scene_hold(s, last, SCENE_UX, SCENE_UZ);
    scene_fork(s, first, axis, web);
    scene_fork(s, last, axis, web);
    scene_add_load(s, SCENE_FORCE, middle, load[0], load[1], load[2]);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
    const int path = scene_add_static(s, 1, &end, 1);
    for (int i = 0; i < VALUES; i++) {
        const int node = i < MOMENT ? middle : first,
                  component = i % 3 + (i < MOMENT ? SCENE_UX : SCENE_RX);
        scene_add_quantity(s, name[i], "1", path,
                           i >= MOMENT && i < TURN ? scene_reaction(node, component)
                                                   : scene_coordinate(node, component));
    }
}

static int solve(const element_type *type, const double Q[9], const double force[3],
                 ask_tally *tally, double value[VALUES])
{
    static answer a;
    scene s;
    bent_beam(Q, force, &s);
    ask_scene(&s, type, NULL, 4, &a);
    scene_free(&s);
    memcpy(value, a.value, VALUES * sizeof *value);
    return ask_count(tally, &a, "a beam between forks");
}

static const double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static void web_between_guides(const element_type *type, ask_tally *tally)
{
    const double force[3] = {0, 0.6, -6}, normal[3] = {0, -1, 0}, z[3] = {0, 0, 1};
    double value[VALUES], q[4], web[3], along[3];
    if (!solve(type, straight, force, tally, value))
        return;
    rotation_exp(value + TURN, q);
    rotation_apply(q, z, web);
    vec3_cross(web, normal, along);
    const double *M = value + MOMENT, size = vec3_norm(M),
                 part = fabs(vec3_dot(M, along)) / vec3_norm(along);
    gsl_test(!(fabs(vec3_dot(web, normal)) <= 1e-13), "%s: the web leaves its guides: %.1e",
             type->name, vec3_dot(web, normal));
    gsl_test(!(fabs(value[TURN + 1]) > 0.1) || !(fabs(value[TURN]) > 1e-4),
             "%s: the beam is bent, and turned about x: %g, %g", type->name, value[TURN + 1],
             value[TURN]);
    gsl_test(!(part >= (1 - 1e-9) * size) || !(size > 1e-3),
             "%s: the fork's moment %g is not across web and normal: %g", type->name, size, part);
}

static void in_other_axes(const element_type *type, ask_tally *tally)
{
    const double force[3] = {0, 0.6, -6}, turn[3] = {0.7, -1.1, 0.4};
    double before[VALUES], after[VALUES], expected[3], q[4], Q[9];
    rotation_exp(turn, q);
    rotation_matrix(q, Q);
    if (!solve(type, straight, force, tally, before) || !solve(type, Q, force, tally, after))
        return;
    for (int kind = MOVED; kind < VALUES; kind += 3) {
        mat3_mul_vec(Q, before + kind, expected);
        const double size = vec3_norm(expected);
        for (int i = 0; i < 3; i++)
            gsl_test(!(fabs(after[kind + i] - expected[i]) <= 1e-8 * size),
                     "%s in other axes: value %d is %.12g, not %.12g", type->name, kind + i,
                     after[kind + i], expected[i]);
    }
}

static void refuse(const char *why, void (*corrupt)(scene *))
{
    const double force[3] = {0, 0, -1};
    scene s;
    fault f = {""};
    bent_beam(straight, force, &s);
    corrupt(&s);
    gsl_test_int((int)scene_validate(&s, &f), STATUS_REFUSED, "%s: %s", why, f.text);
    gsl_test(strncmp(f.text, "node 0: ", 8) != 0 || strchr(f.text, ';') == NULL,
             "%s: culprit and remedy are named: %s", why, f.text);
    scene_free(&s);
}

static void held_too(scene *s)
{
    scene_hold(s, 0, SCENE_RY, SCENE_RY);
}

static void web_along(scene *s)
{
    const double x[3] = {1, 0, 0};
    scene_fork(s, 0, x, x);
}

static void no_web(scene *s)
{
    const double x[3] = {1, 0, 0}, zero[3] = {0, 0, 0};
    scene_fork(s, 0, x, zero);
}

static void axis_across(scene *s)
{
    const double y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    scene_fork(s, 0, y, z);
}

static void fork_tests(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        ask_tally tally = {0};
        web_between_guides(registry_formulations[i], &tally);
        in_other_axes(registry_formulations[i], &tally);
        ask_conclude(&tally, registry_formulations[i], "forks");
    }
    refuse("a fork and a held rotation", held_too);
    refuse("a web along the axis", web_along);
    refuse("no web", no_web);
    refuse("an axis across the member", axis_across);
}

static const double young = 2e11, side = 0.02, length = 1;

typedef struct released_request {
    double force, moment;
    unsigned driven;
} released_request;

static void make(scene *s, const released_request *what)
{
    static const double to[6] = {-0.002, 0.06, -0.03, 0.04, 0.05, 0.1}, y[3] = {0, 1, 0.3},
                        path[2] = {0, 1};
    const double EI = young * pow(side, 4) / 12;
    section_spec spec = section_spec_rectangle(young, young / 2.6, 1.5 * side, side);
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, length, 0, 0);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), y);
    scene_hold_all(s, root);
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        char name[SCENE_NAME];
        const double value[2] = {0, to[c] * (c < 3 ? length : 1)};
        snprintf(name, sizeof name, "drive_%d", c);
        if (what->driven >> c & 1U)
            scene_drive(s, tip, c, scene_add_driver(s, name, 2, path, value));
    }
    const double F = what->force * EI / (length * length), M = what->moment * EI / length;
    scene_add_load(s, SCENE_FORCE, tip, 0.5 * F, F, -0.7 * F);
    scene_add_load(s, SCENE_MOMENT, tip, -0.4 * M, M, 0.8 * M);
    const int compliance = scene_add_compliance(s, scene_add_static(s, 1, &path[1], 5),
                                                (scene_compliance){.node = tip,
                                                                   .moments = SCENE_MOMENTS_SPATIAL,
                                                                   .released = what->driven});
    for (int k = 0; k < 36; k++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "C_%d%d", k / 6, k % 6);
        scene_add_quantity(s, name, "", compliance, scene_compliance_entry(k / 6, k % 6));
    }
}

static void released_solve(const element_type *type, const released_request *what, answer *out)
{
    scene s;
    scene_init(&s, "released");
    make(&s, what);
    ask_scene(&s, type, NULL, 4, out);
    scene_free(&s);
}

static double apart(const answer *a, const answer *b)
{
    double worst = 0;
    for (int k = 0; k < 36; k++) {
        const double size = sqrt(fabs(a->value[7 * (k / 6)] * a->value[7 * (k % 6)])),
                     difference = fabs(a->value[k] - b->value[k]) / size;
        worst = isnan(difference) || difference > worst ? difference : worst;
    }
    return worst;
}

static void released_tests(void)
{
    static const released_request driven[] = {{0, 0, 0x3f}, {0.5, 0, 0x38}};
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        ask_tally t = {.values = 0};
        for (int k = 0; k < 2; k++) {
            answer without, with;
            released_request loaded = driven[k];
            loaded.moment += 0.9;
            loaded.force += (loaded.driven & 7U) != 0 ? 0.6 : 0;
            released_solve(type, &driven[k], &without);
            released_solve(type, &loaded, &with);
            if (!ask_count(&t, &without, "reactions alone") ||
                !ask_count(&t, &with, "a load beside them"))
                continue;
            const double difference = apart(&without, &with);
            gsl_test(!(difference < 1e-9),
                     "%s, driven %02x: a load in place of a part of the reaction (%.1e)",
                     type->name, driven[k].driven, difference);
        }
        ask_conclude(&t, type, "released");
    }
}

int main(void)
{
    weight_tests();
    fork_tests();
    released_tests();
    return gsl_test_summary();
}
