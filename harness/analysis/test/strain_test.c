/* Initial strains due to temperature or misfit, compared with closed forms in analyses about the
 * undeformed state. Also tests bars whose free rotation has no effect, and critical loads in the
 * presence of constant loads. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"
#include "harness/tools/kit/scenes.h"

static const double E = 2e11, G = 8e10, A = 1e-3, Iy = 4e-8, Iz = 1e-8, rho = 7800, L = 2,
                    y_axis[3] = {0, 1, 0};

static int add_section(scene *s)
{
    section_spec spec = sections_of(A, Iy, Iz, 2e-6);
    spec.young = E;
    spec.shear_modulus = G;
    spec.density = rho;
    return scene_add_section(s, &spec);
}

static double euler(void)
{
    return PI * PI * E * Iz / (L * L);
}

/* Two members along x, from 0 over L/2 to L, with the given initial strains and without supports.
 * The nodes are 0, 1, 2. */
static void two_members(scene *s, const char *name, const double first[3], const double second[3])
{
    scene_init(s, name);
    const int profile = add_section(s);
    for (int i = 0; i < 3; i++)
        scene_add_node(s, i * L / 2, 0, 0);
    for (int i = 0; i < 2; i++)
        memcpy(scene_member_at(s, scene_add_member(s, i, i + 1, profile, y_axis))->strain,
               i ? second : first, 3 * sizeof *first);
}

static void pin(scene *s)
{
    for (int i = 0; i < 3; i += 2)
        scene_hold(s, i, SCENE_UX, SCENE_RX);
}

static int solved(scene *s, const element_type *e, ask_tally *tally, int n, answer *a)
{
    ask_scene(s, e, NULL, n, a);
    scene_free(s);
    return ask_count(tally, a, "%s, %d elements", s->name, n);
}

static void clamped(const element_type *e, ask_tally *tally)
{
    static const double eps = 1e-4, hot[3] = {1e-4, 0, 0}, none[3] = {0};
    static answer a;
    scene s;
    two_members(&s, "clamped", hot, none);
    scene_hold_all(&s, 0);
    scene_hold_all(&s, 2);
    const int linear = scene_add_linear(&s);
    scene_add_quantity(&s, "N_hot", "N", linear, scene_internal_at(0, 0, SCENE_N));
    scene_add_quantity(&s, "N_inside", "N", linear, scene_internal_at(0, 0.3, SCENE_N));
    scene_add_quantity(&s, "N_cold", "N", linear, scene_internal_at(1, 1, SCENE_N));
    scene_add_quantity(&s, "ux", "m", linear, scene_coordinate(1, SCENE_UX));
    if (!solved(&s, e, tally, 2, &a))
        return;
    for (int i = 0; i < 3; i++)
        gsl_test_rel(a.value[i], -E * A * eps / 2, 1e-9, "%s: %s of two clamped members, one hot",
                     e->name, a.name[i]);
    gsl_test_rel(a.value[3], eps * L / 4, 1e-9, "%s: the hot one pushes the other", e->name);
}

static void cantilever(const element_type *e, ask_tally *tally)
{
    static const double hot[3] = {1e-3, 0, 0}, cold[3] = {-2e-4, 0, 0};
    static answer a;
    scene s;
    two_members(&s, "cantilever", hot, cold);
    scene_hold_all(&s, 0);
    scene_add_load(&s, SCENE_FORCE, 2, 0, 3, 0);
    const int linear = scene_add_linear(&s);
    scene_add_quantity(&s, "ux", "m", linear, scene_coordinate(2, SCENE_UX));
    scene_add_quantity(&s, "uy", "m", linear, scene_coordinate(2, SCENE_UY));
    scene_add_quantity(&s, "N", "N", linear, scene_internal_at(0, 0, SCENE_N));
    if (!solved(&s, e, tally, 2, &a))
        return;
    gsl_test_rel(a.value[0], (hot[0] + cold[0]) * L / 2, 1e-9, "%s: a free end moves", e->name);
    gsl_test_rel(a.value[1], 3 * gsl_pow_3(L) / (3 * E * Iz), 2e-3,
                 "%s: and a load moves it across all the same", e->name);
    gsl_test_abs(a.value[2], 0, 1e-6, "%s: without a force", e->name);
}

static void portal(const element_type *e, ask_tally *tally)
{
    static const double shrinks = -1e-3, height = 1, width = 2;
    static answer a;
    scene s;
    scene_init(&s, "portal");
    const int profile = add_section(&s);
    const double at[4][2] = {{0, 0}, {0, height}, {width, height}, {width, 0}};
    for (int i = 0; i < 4; i++)
        scene_add_node(&s, at[i][0], at[i][1], 0);
    for (int i = 0; i < 3; i++) {
        const double y[3] = {i == 1 ? 0 : -1, i == 1 ? 1 : 0, 0};
        scene_add_member(&s, i, i + 1, profile, y);
    }
    scene_hold_all(&s, 0);
    scene_hold_all(&s, 3);
    scene_member_at(&s, 1)->strain[0] = shrinks;
    const int linear = scene_add_linear(&s);
    scene_add_quantity(&s, "N", "N", linear, scene_internal_at(1, 0.5, SCENE_N));
    if (!solved(&s, e, tally, 4, &a))
        return;
    const double k = E * Iz, head = height * height / (2 * k) / (height / k + width / (2 * k)),
                 flexibility = height * height * height / (3 * k) -
                               head * height * height / (2 * k) + width / (2 * E * A);
    gsl_test_rel(a.value[0], -shrinks * width / 2 / flexibility, 3e-3,
                 "%s: a beam that is too short pulls its columns", e->name);
}

/* Checks the frequency f = f0 sqrt(1 - N/N_Euler) of a heated and of a cooled member, and the
 * mid-span deflection under a force. */
static void pinned(const element_type *e, ask_tally *tally)
{
    static const double part[] = {0.5,
                                  -1.5}; /* N relative to Euler's load, positive in compression */
    static answer a;
    for (int i = 0; i < 2; i++) {
        const double P = part[i] * euler(), hot[3] = {P / (E * A), 0, 0},
                     f0 = PI / 2 / (L * L) * sqrt(E * Iz / (rho * A));
        scene s;
        two_members(&s, "pinned", hot, hot);
        pin(&s);
        const int modal = scene_add_modal(&s, SCENE_NONE),
                  compliance = scene_add_compliance(&s, SCENE_NONE, (scene_compliance){.node = 1});
        scene_add_quantity(&s, "first", "Hz", modal, scene_frequency(0, SCENE_BENDING_Y));
        scene_add_quantity(&s, "second", "Hz", modal, scene_frequency(1, SCENE_BENDING_Y));
        scene_add_quantity(&s, "c", "m/N", compliance, scene_compliance_entry(SCENE_UY, SCENE_UY));
        if (!solved(&s, e, tally, 16, &a))
            return;
        gsl_test_rel(a.value[0], f0 * sqrt(1 - part[i]), 2e-3, "%s: frequency of a beam, %g Euler",
                     e->name, part[i]);
        gsl_test_rel(a.value[1], 4 * f0 * sqrt(1 - part[i] / 4), 4e-3,
                     "%s: its second frequency, %g Euler", e->name, part[i]);
        const double u = PI / 2 * sqrt(fabs(part[i])),
                     bends = 3 * (part[i] > 0 ? tan(u) - u : u - tanh(u)) / gsl_pow_3(u);
        gsl_test_rel(a.value[2], gsl_pow_3(L) / (48 * E * Iz) * bends, 2e-3,
                     "%s: its compliance, %g Euler", e->name, part[i]);
    }
}

static void column(const element_type *e, ask_tally *tally)
{
    static answer a;
    const double hot[3] = {0.5 * euler() / (E * A), 0, 0};
    scene s;
    two_members(&s, "column", hot, hot);
    pin(&s);
    scene_add_load(&s, SCENE_FORCE, 1, -2, 0, 0);
    scene_add_quantity(&s, "P", "N", scene_add_buckling(&s, SCENE_NONE),
                       scene_critical_factor(1, 0));
    if (solved(&s, e, tally, 16, &a))
        gsl_test_rel(2 * a.value[0], 28005.43, 1e-5, "%s: critical load of a hot column", e->name);
}

static void flying(const element_type *e, ask_tally *tally)
{
    static const double hot[3] = {1e-3, 0, 0}, none[3] = {0};
    static answer a[2];
    for (int i = 0; i < 2; i++) {
        scene s;
        two_members(&s, "flying", i ? hot : none, i ? hot : none);
        scenes_ask_frequencies(&s, "f", scene_add_modal(&s, SCENE_NONE), 8);
        if (!solved(&s, e, tally, 4, &a[i]))
            return;
    }
    for (int i = 6; i < 8; i++)
        gsl_test_rel(a[1].value[i], a[0].value[i], 3e-3, "%s: frequency %d of a free hot bar",
                     e->name, i);
}

static void refuses(const element_type *e)
{
    static const double hot[3] = {1e-3, 0, 0};
    static answer a;
    scene s;
    two_members(&s, "refused", hot, hot);
    scene_hold_all(&s, 0);
    scene_add_quantity(&s, "ux", "m", scene_add_linear(&s), scene_coordinate(2, SCENE_UX));
    ask_scene(&s, e, NULL, 1, &a);
    scene_free(&s);
    if (!(e->offers & FEATURE_CURVATURE))
        gsl_test(a.status != STATUS_REFUSED || strstr(a.reason, "initial strain") == NULL ||
                     strstr(a.reason, "curvature") != NULL,
                 "%s: names what it lacks (%s)", e->name, a.reason);
}

static void strain_tests(void)
{
    int walked = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *e = registry_formulations[i];
        ask_tally tally = {0};
        refuses(e);
        clamped(e, &tally);
        cantilever(e, &tally);
        portal(e, &tally);
        pinned(e, &tally);
        column(e, &tally);
        flying(e, &tally);
        ask_conclude(&tally, e, "initial strains");
        walked += (e->offers & FEATURE_CURVATURE) != 0;
    }
    gsl_test(walked < 3, "%d formulations have initial strains", walked);
}

enum { PLANE = 1, BALL = 2 };
static const double turn_E = 210e9, I = 1e-6, P = 960;

/* Two members of 1 m with hinges about their z axis between them, rotated by `R`. PLANE: motion out
 * of the plane is fixed; BALL: all rotations are released. */
static void two_hinges(scene *s, const double R[9], int how, int moment)
{
    double at[3][3], y[3], force[3];
    section_spec spec = sections_of(1e-3, I, I, 2e-6);
    spec.young = turn_E;
    spec.shear_modulus = 81e9;
    spec.density = 7800;
    scene_init(s, "two_hinges");
    const int profile = scene_add_section(s, &spec);
    for (int i = 0; i < 3; i++) {
        const double along[3] = {i, 0, 0}, across[3] = {0, 1, 0}, push[3] = {0, P, 0};
        mat3_mul_vec(R, along, at[i]);
        mat3_mul_vec(R, across, y);
        mat3_mul_vec(R, push, force);
        scene_add_node(s, at[i][0], at[i][1], at[i][2]);
    }
    for (int i = 0; i < 2; i++) {
        const int m = scene_add_member(s, i, i + 1, profile, y);
        scene_release_end(s, m, 1 - i, SCENE_RZ);
        if (how & BALL)
            scene_release_end(s, m, 1 - i, SCENE_RY);
    }
    for (int i = 0; i < 2 && (how & BALL); i++)
        scene_release_end(s, i, 1 - i, SCENE_RX);
    scene_hold_all(s, 0);
    scene_hold_all(s, 2);
    if (how & PLANE) {
        scene_hold(s, 1, SCENE_UZ, SCENE_RY);
    }
    scene_add_load(s, SCENE_FORCE, 1, force[0], force[1], force[2]);
    if (moment)
        scene_add_load(s, SCENE_MOMENT, 1, 0, 0, 1);
}

static double along_force(const answer *a, const double R[9])
{
    return R[1] * a->value[0] + R[4] * a->value[1] + R[7] * a->value[2];
}

static void ask_one(const element_type *e, ask_tally *tally, const double R[9], int how,
                    const char *what)
{
    static const double end = 1;
    static answer a;
    scene s;
    two_hinges(&s, R, how, 0);
    const int linear = scene_add_linear(&s), path = scene_add_static(&s, 1, &end, 1),
              modal = scene_add_modal(&s, SCENE_NONE);
    for (int i = 0; i < 3; i++)
        scene_add_quantity(&s, (const char *[]){"x", "y", "z"}[i], "m", linear,
                           scene_coordinate(1, i));
    scene_add_quantity(&s, "N", "N", path, scene_internal_at(0, 0, SCENE_N));
    scene_add_quantity(&s, "f", "Hz", modal, scene_frequency(0, SCENE_ANY));
    fault f = {""};
    gsl_test(scene_validate(&s, &f) != STATUS_OK, "%s: is a scene (%s)", what, f.text);
    ask_scene(&s, e, NULL, 2, &a);
    scene_free(&s);
    if (!ask_count(tally, &a, "%s", what))
        return;
    gsl_test_rel(along_force(&a, R), P / 6 / (turn_E * I), 5e-3, "%s: %s", e->name, what);
    gsl_test(!(a.value[4] > 0), "%s: %s has a frequency", e->name, what);
}

static void angle(const element_type *e, const double R[9], int how, const char *what)
{
    static answer a;
    scene s;
    two_hinges(&s, R, how, 0);
    const int linear = scene_add_linear(&s);
    scene_add_quantity(&s, "uy", "m", linear, scene_coordinate(1, SCENE_UY));
    scene_add_quantity(&s, "rz", "rad", linear, scene_coordinate(1, SCENE_RZ));
    ask_scene(&s, e, NULL, 1, &a);
    scene_free(&s);
    if (a.count < 2)
        return;
    gsl_test(!isfinite(a.value[0]), "%s: %s moves", e->name, what);
    gsl_test(!isnan(a.value[1]) || strstr(a.why[1], "can rotate freely") == NULL,
             "%s: %s has no angle (%s)", e->name, what, a.why[1]);
}

static void idle_turn_tests(void)
{
    static const double none[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, turn[3] = {0.3, -0.8, 0.5};
    double q[4], skew[9];
    fault f = {""};
    scene s;
    rotation_exp(turn, q);
    rotation_matrix(q, skew);
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *e = registry_formulations[i];
        ask_tally tally = {0};
        ask_one(e, &tally, none, 0, "in space");
        ask_one(e, &tally, skew, 0, "askew");
        ask_one(e, &tally, none, PLANE, "in a plane");
        ask_one(e, &tally, skew, BALL, "balls");
        angle(e, none, 0, "in space");
        angle(e, skew, BALL, "balls");
        ask_conclude(&tally, e, "can rotate freely");
    }
    two_hinges(&s, none, 0, 1);
    gsl_test(scene_validate(&s, &f) != STATUS_REFUSED ||
                 strstr(f.text, "can rotate freely") == NULL,
             "a moment that nothing takes is refused (%s)", f.text);
    scene_free(&s);
}

enum { NO_MODE, PUSHES, PULLS, BOTH_GROW, CRITICAL, BENT, WAYS };

static void staying_column(int way, scene *s)
{
    static const double stays[WAYS] = {0, -1.5, 2, -0.5, -4, 0}, zero = 0, one = 1,
                        ends[3] = {0, 0.5, 1};
    const double growing[3] = {0.5, 0.75, 1}, bent[3] = {0, 0.6, 1};
    const section_spec spec = sections_of(1e6, 2, 1, 1);
    scene_init(s, "column");
    const int tip = scenes_cantilever(s, &spec);
    const int push = scene_add_load(s, SCENE_FORCE, tip, -1, 0, 0);
    if (way == BOTH_GROW)
        scene_set_factor(s, push, 3, ends, growing);
    else if (way == BENT)
        scene_set_factor(s, push, 3, ends, bent);
    else if (way != NO_MODE)
        scene_set_factor(s, scene_add_load(s, SCENE_FORCE, tip, stays[way], 0, 0), 1, &zero, &one);
    const int buckling = scene_add_buckling(s, SCENE_NONE);
    scene_add_quantity(s, "first", "N", buckling, scene_critical_factor(1, 0));
    scene_add_quantity(s, "second", "N", buckling, scene_critical_factor(1, 1));
}

static int answered(const element_type *e, ask_tally *tally, int way, answer *a)
{
    scene s;
    staying_column(way, &s);
    ask_scene(&s, e, NULL, 4, a);
    scene_free(&s);
    return ask_count(tally, a, "column %d", way);
}

static void staying_refuses(const element_type *e, int way, const char *words)
{
    answer a;
    scene s;
    staying_column(way, &s);
    ask_scene(&s, e, NULL, 4, &a);
    scene_free(&s);
    if (e->offers & FEATURE_GEOMETRIC)
        gsl_test(a.status != STATUS_REFUSED || strstr(a.reason, words) == NULL, "%s: refused (%s)",
                 e->name, a.reason);
}

static void staying_tests(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *e = registry_formulations[i];
        ask_tally tally = {0};
        static answer alone, other;
        if (answered(e, &tally, NO_MODE, &alone)) {
            if (answered(e, &tally, PUSHES, &other))
                for (int k = 0; k < 2; k++)
                    gsl_test_rel(other.value[k], alone.value[k] - 1.5, 1e-8,
                                 "%s: what pushes stays", e->name);
            if (answered(e, &tally, PULLS, &other))
                for (int k = 0; k < 2; k++)
                    gsl_test_rel(other.value[k], alone.value[k] + 2, 1e-8, "%s: what pulls stays",
                                 e->name);
            if (answered(e, &tally, BOTH_GROW, &other))
                for (int k = 0; k < 2; k++)
                    gsl_test_rel(other.value[k], (alone.value[k] - 0.5) / 0.5, 1e-8,
                                 "%s: half of it grows", e->name);
        }
        staying_refuses(e, CRITICAL, "critical even without the scaled");
        staying_refuses(e, BENT, "do not vary linearly");
        ask_conclude(&tally, e, "loads that stay");
    }
}

int main(void)
{
    strain_tests();
    idle_turn_tests();
    staying_tests();
    return gsl_test_summary();
}
