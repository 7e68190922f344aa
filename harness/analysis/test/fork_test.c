/* Forks: the web stays between the guides however the beam is bent, the reaction turns with the
 * section, and nothing depends on the axes in which the scene is written.  A rotation held about a
 * fixed axis fails all three. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"

enum {
    MOVED = 0,
    MOMENT = 3,
    TURN = 6,
    VALUES = 9
}; /* of the middle, on the first fork, of the first fork */

/* Both ends in forks, translations held, a force in the middle; everything turned by Q from: beam
 * along x, web along z. */
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

/* 1: answered. */
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

/* In a state bent in both planes the web is at right angles to the guides' normal, and their
 * moment to web and normal. */
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

/* The same beam in other axes: vectors turn with it. */
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

static void refuse(const char *why, void (*spoil)(scene *))
{
    const double force[3] = {0, 0, -1};
    scene s;
    fault f = {""};
    bent_beam(straight, force, &s);
    spoil(&s);
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

int main(void)
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
    return gsl_test_summary();
}
