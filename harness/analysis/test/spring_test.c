/* Structures with springs against closed forms: a beam on rotational springs (deflection, buckling,
 * frequency), a sprung cantilever rolled up by a moment, a spring between two bodies that move. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/analysis/test/hinged.h"
#include "harness/tools/kit/scenes.h"

static const double length = 1.3, kappa = 3.7; /* kappa: of the springs, in EI/L */

static void rotational(scene *s, int p, int q, double k)
{
    double stiffness[36] = {0};
    stiffness[21] = stiffness[28] = stiffness[35] = k;
    scene_add_spring(s, p, q, stiffness);
}

/* Both ends held, and turning against springs; the second one to a body that is held itself. */
static status build_beam(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    const int profile = add_section(s), root = scene_add_node(s, 0, 0, 0),
              middle = scene_add_node(s, length / 2, 0, 0), end = scene_add_node(s, length, 0, 0),
              wall = scene_add_node(s, length, 0.3, 0);
    scene_member_at(s, scene_add_member(s, root, middle, profile, y_axis))->warp_q = 0;
    scene_member_at(s, scene_add_member(s, middle, end, profile, y_axis))->warp_p = 0;
    scene_hold(s, root, SCENE_UX, SCENE_UZ);
    scene_hold(s, end, SCENE_UY, SCENE_UZ);
    scene_hold_all(s, wall);
    rotational(s, SCENE_NONE, root, kappa * EI / length);
    rotational(s, wall, end, kappa * EI / length);
    scene_add_load(s, SCENE_FORCE, middle, 0, 1, 0);
    const int linear = scene_add_linear(s), modal = scene_add_modal(s, SCENE_NONE);
    scene_add_quantity(s, "deflection", "m", linear, scene_coordinate(middle, SCENE_UY));
    scene_add_quantity(s, "frequency", "Hz", modal, scene_frequency(0, SCENE_ANY));
    return STATUS_OK;
}

static status build_column(const double value[], scene *s, fault *f)
{
    build_beam(value, s, f);
    s->loads = s->analyses = s->quantities = 0;
    scene_add_load(s, SCENE_FORCE, 2, -1, 0, 0);
    scene_add_quantity(s, "critical", "N", scene_add_buckling(s, SCENE_NONE),
                       scene_critical_factor(1, 0));
    return STATUS_OK;
}

/* A bar on a spring at its root, pulled round by a moment. */
static status build_roll(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    const double end = 1;
    const int profile = add_section(s), root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, length, 0, 0);
    scene_add_member(s, root, tip, profile, y_axis);
    scene_hold(s, root, SCENE_UX, SCENE_UZ);
    rotational(s, SCENE_NONE, root, kappa * EI / length);
    scene_add_load(s, SCENE_MOMENT, tip, 0, 0, 2.9 * EI / length);
    const int path = scene_add_static(s, 1, &end, 8);
    scene_add_quantity(s, "x", "m", path, scene_coordinate(tip, SCENE_UX));
    scene_add_quantity(s, "y", "m", path, scene_coordinate(tip, SCENE_UY));
    return STATUS_OK;
}

/* Four quantities of a bar with a heavy body at its tip, which a spring holds there, or the tip
 * itself does. The spring's reference is off the body's node. */
static status build_body(scene *s, int sprung)
{
    static const double end = 1;
    double stiffness[36];
    const int profile = add_section(s), root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, length, 0.2, -0.1);
    const int body = sprung ? scene_add_node(s, length + 0.1, 0.25, 0.07)
                            : scene_add_attached(s, tip, length + 0.1, 0.25, 0.07);
    scene_add_member(s, root, tip, profile, y_axis);
    scene_hold_all(s, root);
    for (int i = 0; i < 36; i++)
        stiffness[i] = 1e8 * ((i % 7 == 0) + 0.1 * ((i / 6) * (i % 6) % 4));
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < i; j++)
            stiffness[6 * i + j] = stiffness[6 * j + i];
    if (sprung)
        scene_add_spring(s, tip, body, stiffness);
    scene_set_body(s, body,
                   (scene_body){.mass = 0.8,
                                .centre = {0.1, 0.05, -0.02},
                                .inertia = {0.02, 0.03, 0.025, 0.001, 0.002, -0.003}});
    scene_add_load(s, SCENE_FORCE, body, 0.5, 3, -4);
    const int modal = scene_add_modal(s, SCENE_NONE), path = scene_add_static(s, 1, &end, 4),
              loaded = scene_add_modal(s, path),
              turning = scene_add_rotation(s, 1, &end, 4, 4,
                                           (scene_rotating_frame){.omega = {0.3, -0.8, 1.7}});
    const int compliance = scene_add_compliance(s, path, (scene_compliance){.node = body});
    scenes_ask_frequencies(s, "rest", modal, 3);
    scenes_ask_frequencies(s, "loaded", loaded, 3);
    scenes_ask_frequencies(s, "turning", turning, 3);
    scenes_ask_motion(s, "moved", path, body);
    for (int i = 0; i < 3; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "reaction_%d", i);
        scene_add_quantity(s, name, "N m", path, scene_reaction(root, SCENE_RX + i));
    }
    scene_add_quantity(s, "critical", "1", scene_add_buckling(s, SCENE_NONE),
                       scene_critical_factor(1, 0));
    scene_add_quantity(s, "compliance", "m/N", compliance, scene_compliance_entry(1, 1));
    return STATUS_OK;
}

static status build_sprung(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    return build_body(s, 1);
}

static status build_rigid(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    return build_body(s, 0);
}

static void check(const cell_result *r, int i, double exact, double allowed, const char *chosen)
{
    if (i < r->solve.quantities)
        gsl_test_rel(r->solve.quantity[i].value, exact, allowed, "%s: %s", chosen,
                     r->scene.quantity[i].name);
    else
        gsl_test(1, "%s: quantity %d is there", chosen, i);
}

/* A cantilever with a spring at its tip, and a second body at it on a spring of six entries: the
 * tip's spring takes its part of the load, the clamp and the ground the rest. */
static status build_tip(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    double k[36] = {0}, six[36] = {0};
    const int profile = add_section(s), root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, length, 0, 0), ground = scene_add_node(s, length, 0.4, 0.3),
              edge = scene_add_attached(s, tip, length + 0.2, 0.1, -0.3);
    scene_add_member(s, root, tip, profile, y_axis);
    scene_hold_all(s, root);
    scene_hold_all(s, ground);
    k[7] = kappa * 3 * EI / gsl_pow_3(length);
    for (int i = 0; i < 6; i++)
        six[7 * i] = 0.1 * (i + 1) * EI / gsl_pow_3(length);
    scene_add_spring(s, SCENE_NONE, tip, k);
    if (value != NULL && value[0] > 0)
        scene_add_spring(s, ground, edge, six);
    scene_add_load(s, SCENE_FORCE, tip, 0.3, 1, 0.2);
    const int linear = scene_add_linear(s);
    scene_add_quantity(s, "moment", "N m", linear, scene_internal_at(0, 0, SCENE_MZ));
    scene_add_quantity(s, "inside", "N m", linear, scene_internal_at(0, 0.5, SCENE_MZ));
    for (int i = 0; i < 6; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "root_%d", i);
        scene_add_quantity(s, name, "N", linear, scene_reaction(root, i));
        snprintf(name, sizeof name, "ground_%d", i);
        scene_add_quantity(s, name, "N", linear, scene_reaction(ground, i));
    }
    scene_add_quantity(s, "uy", "m", linear, scene_coordinate(tip, SCENE_UY));
    return STATUS_OK;
}

static status build_two_springs(const double value[], scene *s, fault *f)
{
    (void)value;
    return build_tip((const double[]){1}, s, f);
}

/* Moments about the origin of forces and moments at two nodes, and the load. */
static void equilibrium(const cell_result *r, const char *chosen)
{
    const double load[3] = {0.3, 1, 0.2},
                 at[3][3] = {{0, 0, 0}, {length, 0.4, 0.3}, {length, 0, 0}};
    double R[6], G[6], sprung[3] = {0};
    for (int i = 0; i < 6; i++) {
        R[i] = r->solve.quantity[2 + 2 * i].value;
        G[i] = r->solve.quantity[3 + 2 * i].value;
    }
    sprung[1] = -kappa * 3 * EI / gsl_pow_3(length) * r->solve.quantity[14].value;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        gsl_test_abs(R[i] + G[i] + sprung[i] + load[i], 0, 1e-9, "%s: forces along %d", chosen, i);
        gsl_test_abs(R[3 + i] + G[3 + i] + at[1][j] * G[k] - at[1][k] * G[j] +
                         at[2][j] * (sprung[k] + load[k]) - at[2][k] * (sprung[j] + load[j]),
                     0, 1e-9, "%s: moments about %d", chosen, i);
    }
}

static void supported(const char *chosen)
{
    cell_result r;
    cells_solve(build_tip, chosen, 4, &r);
    check(&r, 0, length / (1 + kappa), 1e-6, chosen);
    check(&r, 1, length / 2 / (1 + kappa), 1e-6, chosen);
    equilibrium(&r, chosen);
    cell_result_free(&r);
    cells_solve(build_two_springs, chosen, 4, &r);
    equilibrium(&r, chosen);
    cell_result_free(&r);
}

/* Half the wave number times the length: tan u = -2 u/kappa, tan u + tanh u = -4 u/kappa. */
static double buckled(double u)
{
    return sin(u) + 2 * u / kappa * cos(u);
}

static double vibrating(double u)
{
    return sin(u) + cos(u) * (tanh(u) + 4 * u / kappa);
}

static void closed_forms(const char *chosen, int n, double allowed)
{
    cell_result r;
    cells_solve(build_beam, chosen, n, &r);
    const double L3 = length * length * length, u = hinged_zero(buckled, PI / 2, PI),
                 v = 2 * hinged_zero(vibrating, PI / 2, PI) / length;
    check(&r, 0, L3 / (48 * EI) * (1 - 0.75 * kappa / (2 + kappa)), allowed, chosen);
    check(&r, 1, v * v * sqrt(EI / mass) / (2 * PI), allowed, chosen);
    cell_result_free(&r);
    cells_solve(build_column, chosen, n, &r);
    check(&r, 0, EI * 4 * u * u / (length * length), allowed, chosen);
    cell_result_free(&r);
    cells_solve(build_roll, chosen, n, &r);
    const double turned = 2.9 / kappa, bent = 2.9;
    check(&r, 0, length * ((sin(turned + bent) - sin(turned)) / bent - 1), allowed, chosen);
    check(&r, 1, length * (cos(turned) - cos(turned + bent)) / bent, allowed, chosen);
    cell_result_free(&r);
}

/* A very stiff spring is a rigid body. */
static void stiff(const char *chosen)
{
    cell_result sprung, rigid;
    cells_solve(build_sprung, chosen, 3, &sprung);
    cells_solve(build_rigid, chosen, 3, &rigid);
    gsl_test_int(rigid.solve.quantities, 17, "%s: all quantities", chosen);
    for (int i = 0; i < rigid.solve.quantities; i++)
        check(&sprung, i, rigid.solve.quantity[i].value, 3e-6, chosen);
    cell_result_free(&sprung);
    cell_result_free(&rigid);
}

int main(void)
{
    supported("geometrically_exact");
    supported("beamw_consistent");
    supported("collocation");
    stiff("geometrically_exact");
    stiff("beamw_consistent");
    stiff("beamw_consistent:newton=displacement");
    static const char *const chosen[] = {"geometrically_exact", "beamw_consistent",
                                         "beamw_consistent:newton=displacement",
                                         "beamw_consistent:newton=dense"};
    for (int i = 0; i < 4; i++)
        closed_forms(chosen[i], i == 0 ? 32 : 12, 1e-5);
    closed_forms("sheet_third", 96, 1e-3);
    closed_forms("collocation", 96, 1e-3);
    return gsl_test_summary();
}
