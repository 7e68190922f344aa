/* Linkages with large rotations (four-bar linkage, universal joint) must move like rigid links, and
 * messages must name mechanisms that can move freely. Springs must satisfy equilibrium and closed
 * forms. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "harness/analysis/test/hinged.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/scenes.h"

enum { STATIONS = 5, BARS = 3 };
static const double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
static const double crank = 1, coupler = 3.5, rocker = 3, ground = 4, begin = 0.4;

/* Computes the position of the joint between coupler and rocker for an angle of the crank. The
 * joint is above the line through the fixed pivots. */
static void fourth(double angle, double out[2])
{
    const double x = crank * cos(angle), y = crank * sin(angle), dx = ground - x, dy = -y,
                 d = hypot(dx, dy), a = (coupler * coupler - rocker * rocker + d * d) / (2 * d),
                 h = sqrt(coupler * coupler - a * a);
    out[0] = x + (a * dx - h * dy) / d;
    out[1] = y + (a * dy + h * dx) / d;
}

static double Q[9];
static double linkage_turned,
    pushed; /* angle of the crank [rad], and force [N] on the joint between coupler and rocker */

static int add_at(scene *s, double x, double y)
{
    const double at[3] = {x, y, 0};
    double r[3];
    mat3_mul_vec(Q, at, r);
    return scene_add_node(s, r[0], r[1], r[2]);
}

static void pivot(scene *s, int node, int motion)
{
    static const double z[3] = {0, 0, 1};
    scene_node *n = scene_node_at(s, node);
    scene_hold(s, node, SCENE_UX, SCENE_UZ);
    n->rotation = SCENE_ROTATION_SEQUENCE;
    mat3_mul_vec(Q, z, n->axis[0]);
    n->angle[0] = motion;
}

static void add_bars(scene *s, int turning, int *second, int *third)
{
    static const double z[3] = {0, 0, 1};
    const double push[3] = {0, -pushed, 0};
    double joint[2], across[3], load[3];
    fourth(begin, joint);
    mat3_mul_vec(Q, z, across);
    mat3_mul_vec(Q, push, load);
    const int profile = add_section(s), first = add_at(s, 0, 0);
    *second = add_at(s, crank * cos(begin), crank * sin(begin));
    *third = add_at(s, joint[0], joint[1]);
    const int last = add_at(s, ground, 0);
    pivot(s, first, turning);
    pivot(s, last, SCENE_FREE);
    scene_add_member(s, first, *second, profile, across);
    const int bar = scene_add_member(s, *second, *third, profile, across);
    scene_add_member(s, *third, last, profile, across);
    scene_release_end(s, bar, 0, SCENE_RY);
    scene_release_end(s, bar, 1, SCENE_RY);
    scene_add_load(s, SCENE_FORCE, *third, load[0], load[1], load[2]);
}

static status build_four_bar(const double value[], scene *s, fault *f)
{
    static const double path[] = {0, 1};
    const double angle[] = {0, linkage_turned};
    double stations[STATIONS];
    int second, third;
    (void)value;
    (void)f;
    add_bars(s, scene_add_driver(s, "angle", 2, path, angle), &second, &third);
    for (int i = 0; i < STATIONS; i++)
        stations[i] = (i + 1.0) / STATIONS;
    const int statics = scene_add_static(s, STATIONS, stations, 3);
    for (int i = 0; i < 6; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "move_%d", i);
        scene_add_quantity(s, name, "m", statics,
                           scene_coordinate(i < 3 ? third : second, SCENE_UX + i % 3));
    }
    for (int i = 0; i < BARS; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "N_%d", i);
        scene_add_quantity(s, name, "N", statics, scene_internal_at(i, 1, SCENE_N));
        snprintf(name, sizeof name, "M_%d", i);
        scene_add_quantity(s, name, "N m", statics, scene_internal_at(i, 0, SCENE_MY));
    }
    return STATUS_OK;
}

static void solve_four_bar(const char *chosen, double angle, double force, const double axes[9],
                           cell_result *r)
{
    memcpy(Q, axes, sizeof Q);
    linkage_turned = angle;
    pushed = force;
    cells_solve(build_four_bar, chosen, 1, r);
}

static void four_bar(const char *chosen)
{
    cell_result r;
    const double angle = 3.4;
    double from[2], to[2];
    solve_four_bar(chosen, angle, 0, straight, &r);
    fourth(begin, from);
    fourth(begin + angle, to);
    const double exact[6] = {to[0] - from[0],
                             to[1] - from[1],
                             0,
                             crank * (cos(begin + angle) - cos(begin)),
                             crank * (sin(begin + angle) - sin(begin)),
                             0};
    gsl_test_int(r.solve.quantities, 12, "%s: quantities of a linkage", chosen);
    for (int i = 0; i < r.solve.quantities; i++) {
        const double expected = i < 6 ? exact[i] : 0, value = r.solve.quantity[i].value;
        gsl_test(!(fabs(value - expected) <= 1e-8), "%s: four bars: %s is %.12g, not %.12g", chosen,
                 r.scene.quantity[i].name, value, expected);
    }
    cell_result_free(&r);
}

static void in_other_axes(const char *chosen)
{
    static const double about[3] = {0.7, -1.1, 0.4};
    double q[4], other[9], expected[3];
    cell_result a, b;
    rotation_exp(about, q);
    rotation_matrix(q, other);
    solve_four_bar(chosen, 1.1, 2, straight, &a);
    solve_four_bar(chosen, 1.1, 2, other, &b);
    for (int k = 0; k < 6 && a.solve.quantities == 12 && b.solve.quantities == 12; k += 3) {
        const double moved[3] = {a.solve.quantity[k].value, a.solve.quantity[k + 1].value,
                                 a.solve.quantity[k + 2].value};
        mat3_mul_vec(other, moved, expected);
        for (int i = 0; i < 3; i++)
            gsl_test(!(fabs(b.solve.quantity[k + i].value - expected[i]) <= 1e-9),
                     "%s: in other axes %s is %.12g, not %.12g", chosen,
                     b.scene.quantity[k + i].name, b.solve.quantity[k + i].value, expected[i]);
    }
    for (int k = 6; k < a.solve.quantities; k++)
        gsl_test(!(fabs(b.solve.quantity[k].value - a.solve.quantity[k].value) <= 1e-7),
                 "%s: in other axes %s is %.12g, not %.12g", chosen, b.scene.quantity[k].name,
                 b.solve.quantity[k].value, a.solve.quantity[k].value);
    gsl_test(!(fabs(a.solve.quantity[7].value) > 0.1), "%s: the crank is bent: %g", chosen,
             a.solve.quantity[7].value);
    gsl_test(!(fabs(a.solve.quantity[9].value) < 1e-9), "%s: moment of a hinge: %g", chosen,
             a.solve.quantity[9].value);
    cell_result_free(&a);
    cell_result_free(&b);
}

static status build_universal(const double value[], scene *s, fault *f)
{
    static const double path[] = {0, 1}, angle[] = {0, 2.6}, beta = 0.6;
    const double along[3] = {cos(beta), 0, sin(beta)};
    (void)value;
    (void)f;
    const int profile = add_section(s), first = scene_add_node(s, 0, 0, 0),
              joint = scene_add_node(s, 1, 0, 0),
              last = scene_add_node(s, 1 + along[0], 0, along[2]),
              drive = scene_add_driver(s, "angle", 2, path, angle);
    scene_hold_all(s, first);
    scene_drive(s, first, SCENE_RX, drive);
    scene_add_member(s, first, joint, profile, y_axis);
    const int shaft = scene_add_member(s, joint, last, profile, y_axis);
    scene_release_end(s, shaft, 0, SCENE_RY);
    scene_release_end(s, shaft, 0, SCENE_RZ);
    scene_hold(s, last, SCENE_UX, SCENE_UZ);
    scene_node *n = scene_node_at(s, last);
    n->rotation = SCENE_ROTATION_SEQUENCE;
    memcpy(n->axis[0], along, sizeof along);
    const int statics = scene_add_static(s, 1, &path[1], 10);
    scene_add_quantity(s, "rx", "rad", statics, scene_coordinate(last, SCENE_RX));
    scene_add_quantity(s, "rz", "rad", statics, scene_coordinate(last, SCENE_RZ));
    scene_add_quantity(s, "torque", "N m", statics, scene_internal_at(0, 0, SCENE_MX));
    scene_add_quantity(s, "bending", "N m", statics, scene_internal_at(shaft, 1, SCENE_MY));
    return STATUS_OK;
}

static void universal_joint(const char *chosen)
{
    cell_result r;
    cells_solve(build_universal, chosen, 1, &r);
    const double beta = 0.6, turn = atan2(cos(beta) * sin(2.6), cos(2.6)),
                 exact[] = {turn * cos(beta), turn * sin(beta), 0, 0};
    gsl_test_int(r.solve.quantities, 4, "%s: quantities of a joint", chosen);
    for (int i = 0; i < r.solve.quantities; i++)
        gsl_test(!(fabs(r.solve.quantity[i].value - exact[i]) <= 1e-8),
                 "%s: universal joint: %s is %.12g, not %.12g", chosen, r.scene.quantity[i].name,
                 r.solve.quantity[i].value, exact[i]);
    cell_result_free(&r);
}

static status build_loose(const double value[], scene *s, fault *f)
{
    const double end = 1;
    int second, third;
    (void)value;
    (void)f;
    add_bars(s, SCENE_FREE, &second, &third);
    if (linkage_turned > 0)
        scene_add_linear(s);
    else
        scene_add_static(s, 1, &end, 2);
    return STATUS_OK;
}

static status build_between(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    const int profile = add_section(s), first = scene_add_node(s, 0, 0, 0),
              last = scene_add_node(s, 1, 0, 0),
              bar = scene_add_member(s, first, last, profile, y_axis);
    scene_hold_all(s, first);
    scene_hold_all(s, last);
    scene_release_end(s, bar, 0, SCENE_UY);
    scene_release_end(s, bar, 0, SCENE_RZ);
    scene_release_end(s, bar, 1, SCENE_RZ);
    scene_add_load(s, SCENE_DISTRIBUTED, bar, 0, 1, 0);
    scene_add_linear(s);
    return STATUS_OK;
}

static void named(const char *chosen, status (*build)(const double[], scene *, fault *),
                  const char *expected)
{
    static const parameter_type none[] = {{.name = NULL}};
    const case_type type = {.name = "loose",
                            .summary = "a case of the test",
                            .source = "none",
                            .parameters = {none},
                            .build = build};
    formulation fm;
    fault f = {""};
    cell_result r;
    gsl_test(formulation_parse(chosen, &fm, &f) != STATUS_OK, "%s exists", chosen);
    cell_request request = {.type = &type, .elements = 2, .formulation = fm.type};
    gsl_test_int((int)cell_run(&request, &r, &f), STATUS_SINGULAR, "%s: a mechanism: %s", chosen,
                 f.text);
    gsl_test(strncmp(f.text, expected, strlen(expected)) != 0, "%s: %s ... not: %s", chosen,
             expected, f.text);
    cell_result_free(&r);
}

static void linkage_tests(void)
{
    static const char *const newton[] = {"", ":newton=displacement", ":newton=dense"};
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const char *name = registry_formulations[i]->name;
        for (int k = 0; k < 3; k++) {
            char chosen[80];
            snprintf(chosen, sizeof chosen, "%s%s", name, newton[k]);
            four_bar(chosen);
            universal_joint(chosen);
        }
        in_other_axes(name);
        memcpy(Q, straight, sizeof Q);
        for (int k = 0; k < 2; k++) {
            linkage_turned = k;
            named(name, build_loose, "node 1 can turn about (0, 0, ");
        }
        named(name, build_between, "member 0 can turn about (0, 0, ");
    }
}

#define SPRINGS "harness/analysis/test/springs.yaml"

static const double length = 1.3, kappa = 3.7;

static void check(const cell_result *r, int i, double exact, double allowed, const char *chosen)
{
    if (i < r->solve.quantities)
        gsl_test_rel(r->solve.quantity[i].value, exact, allowed, "%s: %s", chosen,
                     r->scene.quantity[i].name);
    else
        gsl_test(1, "%s: quantity %d is there", chosen, i);
}

static void equilibrium(const cell_result *r, const char *chosen)
{
    const double load[3] = {0.3, 1, 0.2},
                 at[3][3] = {{0, 0, 0}, {length, 0.4, 0.3}, {length, 0, 0}};
    double R[6], G[6], sprung[3] = {0};
    for (int i = 0; i < 6; i++) {
        R[i] = r->solve.quantity[2 + i].value;
        G[i] = r->solve.quantity[8 + i].value;
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
    scenes_solve(SPRINGS, chosen, 4, &r, "of=tip");
    check(&r, 0, length / (1 + kappa), 1e-6, chosen);
    check(&r, 1, length / 2 / (1 + kappa), 1e-6, chosen);
    equilibrium(&r, chosen);
    cell_result_free(&r);
    scenes_solve(SPRINGS, chosen, 4, &r, "of=tip_and_edge");
    equilibrium(&r, chosen);
    cell_result_free(&r);
}

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
    scenes_solve(SPRINGS, chosen, n, &r, "of=beam");
    const double L3 = length * length * length, u = hinged_zero(buckled, PI / 2, PI),
                 v = 2 * hinged_zero(vibrating, PI / 2, PI) / length;
    check(&r, 0, L3 / (48 * EI) * (1 - 0.75 * kappa / (2 + kappa)), allowed, chosen);
    check(&r, 1, v * v * sqrt(EI / mass) / (2 * PI), allowed, chosen);
    cell_result_free(&r);
    scenes_solve(SPRINGS, chosen, n, &r, "of=column");
    check(&r, 0, EI * 4 * u * u / (length * length), allowed, chosen);
    cell_result_free(&r);
    scenes_solve(SPRINGS, chosen, n, &r, "of=roll");
    const double turned = 2.9 / kappa, bent = 2.9;
    check(&r, 0, length * ((sin(turned + bent) - sin(turned)) / bent - 1), allowed, chosen);
    check(&r, 1, length * (cos(turned) - cos(turned + bent)) / bent, allowed, chosen);
    cell_result_free(&r);
}

static void stiff(const char *chosen)
{
    cell_result sprung, rigid;
    scenes_solve(SPRINGS, chosen, 3, &sprung, "of=sprung_body");
    scenes_solve(SPRINGS, chosen, 3, &rigid, "of=body");
    gsl_test_int(rigid.solve.quantities, 17, "%s: all quantities", chosen);
    for (int i = 0; i < rigid.solve.quantities; i++)
        check(&sprung, i, rigid.solve.quantity[i].value, 3e-6, chosen);
    cell_result_free(&sprung);
    cell_result_free(&rigid);
}

static void spring_tests(void)
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
}

int main(void)
{
    linkage_tests();
    spring_tests();
    return gsl_test_summary();
}
