/* Strains that members have by themselves (heat, a misfit), in analyses about the undeformed state:
 * against closed forms, for every formulation that has them. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/pi.h"
#include "elements/test/sections.h"
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

/* Two members along x, from 0 over L/2 to L, of these strains, not held. Nodes 0, 1, 2. */
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

/* Between walls that it cannot push away, free to turn about y and z there. */
static void pin(scene *s)
{
    for (int i = 0; i < 3; i += 2)
        scene_hold(s, i, SCENE_UX, SCENE_RX);
}

static int asked(scene *s, const element_type *e, ask_tally *tally, int n, answer *a)
{
    ask_scene(s, e, NULL, n, a);
    scene_free(s);
    return ask_count(tally, a, "%s, %d elements", s->name, n);
}

/* Two clamped members, one of them hot: N = -EA eps/2, and the middle gives way by eps L/4. */
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
    if (!asked(&s, e, tally, 2, &a))
        return;
    for (int i = 0; i < 3; i++)
        gsl_test_rel(a.value[i], -E * A * eps / 2, 1e-9, "%s: %s of two clamped members, one hot",
                     e->name, a.name[i]);
    gsl_test_rel(a.value[3], eps * L / 4, 1e-9, "%s: the hot one pushes the other", e->name);
}

/* Free at one end: grows, and is bent by nothing. */
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
    if (!asked(&s, e, tally, 2, &a))
        return;
    gsl_test_rel(a.value[0], (hot[0] + cold[0]) * L / 2, 1e-9, "%s: a free end moves", e->name);
    gsl_test_rel(a.value[1], 3 * gsl_pow_3(L) / (3 * E * Iz), 2e-3,
                 "%s: and a load moves it across all the same", e->name);
    gsl_test_abs(a.value[2], 0, 1e-6, "%s: without a force", e->name);
}

/* A frame of two columns and a beam that is shorter than their distance. */
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
    if (!asked(&s, e, tally, 4, &a))
        return;
    /* half of it: a column under a force at its head, which the beam holds by 2 EI/width against
     * turning, and half of the beam */
    const double k = E * Iz, head = height * height / (2 * k) / (height / k + width / (2 * k)),
                 flexibility = height * height * height / (3 * k) -
                               head * height * height / (2 * k) + width / (2 * E * A);
    gsl_test_rel(a.value[0], -shrinks * width / 2 / flexibility, 3e-3,
                 "%s: a beam that is too short pulls its columns", e->name);
}

/* f = f0 sqrt(1 - N/N_Euler), heated and cooled; and the deflection of the middle by a force. */
static void pinned(const element_type *e, ask_tally *tally)
{
    static const double part[] = {0.5, -1.5}; /* of Euler's load, pressure positive */
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
        if (!asked(&s, e, tally, 16, &a))
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

/* A hot column between walls, pushed at its middle: the force P in one half and -P in the other add
 * to what the heat presses with, which does not grow. */
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
    if (asked(&s, e, tally, 16, &a)) /* own determinant of two spans */
        gsl_test_rel(2 * a.value[0], 28005.43, 1e-5, "%s: critical load of a hot column", e->name);
}

/* Nothing holds it, so that heat stresses nothing. */
static void flying(const element_type *e, ask_tally *tally)
{
    static const double hot[3] = {1e-3, 0, 0}, none[3] = {0};
    static answer a[2];
    for (int i = 0; i < 2; i++) {
        scene s;
        two_members(&s, "flying", i ? hot : none, i ? hot : none);
        scenes_ask_frequencies(&s, "f", scene_add_modal(&s, SCENE_NONE), 8);
        if (!asked(&s, e, tally, 4, &a[i]))
            return;
    }
    for (int i = 6; i < 8; i++)
        gsl_test_rel(a[1].value[i], a[0].value[i], 3e-3, "%s: frequency %d of a free hot bar",
                     e->name, i);
}

/* Of a formulation without. */
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

int main(void)
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
    return gsl_test_summary();
}
