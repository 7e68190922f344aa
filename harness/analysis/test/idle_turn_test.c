/* Nodes that turn by themselves, because all their members release that: what else they do is
 * defined, in a plane and in space, along the axes and across them; their angle is not. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/sections.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"

enum { PLANE = 1, BALL = 2 };
static const double turn_E = 210e9, I = 1e-6, P = 960;

/* Two members of 1 m that meet in hinges about their z, which is `R` times it; how: PLANE: all but
 * the frame's plane is held, BALL: all turns are released. */
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
    /* two cantilevers share the load; shear adds little where it is rigid in these sections */
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
    if (a.count < 2) /* not offered */
        return;
    gsl_test(!isfinite(a.value[0]), "%s: %s moves", e->name, what);
    gsl_test(!isnan(a.value[1]) || strstr(a.why[1], "turns by itself") == NULL,
             "%s: %s has no angle (%s)", e->name, what, a.why[1]);
}

int main(void)
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
        ask_conclude(&tally, e, "turns by itself");
    }
    two_hinges(&s, none, 0, 1);
    gsl_test(scene_validate(&s, &f) != STATUS_REFUSED || strstr(f.text, "turns by itself") == NULL,
             "a moment that nothing takes is refused (%s)", f.text);
    scene_free(&s);
    return gsl_test_summary();
}
