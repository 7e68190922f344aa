/* If rotations of a node are fixed, the results (within 1e-10) and the rejections must not depend
 * on whether the unknowns of these rotations are eliminated or kept. */
#include <math.h>
#include <stdio.h>

#include "cases/shared/shared.h"
#include "elements/math/rotation.h"
#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

static const double y_axis[] = {0, 1, 0};

enum { HELD, RELEASED, INTEGRATOR };
static const parameter_type parameter[] = {
    [HELD] = {"held", "1", 0, 0, 7, NULL, "bits of the turns of the pin"},
    [RELEASED] = {"released", "1", 0, 0, 7, NULL, "bits of turns of the second rod, at the first"},
    [INTEGRATOR] = {"integrator", "", 0, 0, 0, TIMED_INTEGRATORS, "time-integration method"},
    {0}};

static int add_rod(scene *s)
{
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 6e3, .GA = 2e3, .GJ = 0.4, .EI = 0.6, .mass = 1.4, .polar = 4e-4, .rotary = 2e-4});
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    return scene_add_section(s, &spec);
}

static status build(const double value[], scene *s, fault *f)
{
    static const double end = 0.1;
    const int profile = add_rod(s), pin = scene_add_node(s, 0, 0, 0),
              middle = scene_add_node(s, 0.5, 0, 0.1), tip = scene_add_node(s, 1, 0.2, 0);
    (void)f;
    scene_add_member(s, pin, middle, profile, y_axis);
    const int second = scene_add_member(s, middle, tip, profile, y_axis);
    scene_hold(s, pin, SCENE_UX, SCENE_UZ);
    for (int k = 0; k < 3; k++) {
        if ((int)value[HELD] >> k & 1)
            scene_hold(s, pin, SCENE_RX + k, SCENE_RX + k);
        if ((int)value[RELEASED] >> k & 1)
            scene_release_end(s, second, 0, SCENE_RX + k);
    }
    scene_load_piece(s, scene_add_load(s, SCENE_FORCE, tip, 0.3, -2, 1), 0, "t");
    const int motion = scene_add_motion(s, SCENE_NONE, 1, &end,
                                        (scene_motion){.scheme = (scene_scheme)value[INTEGRATOR],
                                                       .alpha = scene_alpha_of_radius(0.9),
                                                       .step = 0.01});
    for (int k = 0; k < 3; k++) {
        char name[] = {'u', (char)('x' + k), '\0'};
        scene_add_quantity(s, name, "m", motion, scene_coordinate(tip, SCENE_UX + k));
    }
    return STATUS_OK;
}

static const case_type linked = {
    .name = "linked", .parameters = {parameter}, .build = build, .summary = "of the test"};

static void solve(int held, int released, int integrator, int keep_all, answer *a)
{
    static const char *const scheme[] = {"alpha", "conserving", "radau"};
    char words[80];
    snprintf(words, sizeof words, "held=%d;released=%d;integrator=%s", held, released,
             scheme[integrator]);
    ask(&(question){.type = &linked,
                    .parameters = words,
                    .formulation = &element_geometrically_exact,
                    .elements = 2,
                    .keep_all = keep_all},
        a);
}

static void kept(int held, int released, int integrator)
{
    answer plain, all;
    const int count = (held & 1) + (held >> 1 & 1) + (held >> 2);
    solve(held, released, integrator, 0, &plain);
    solve(held, released, integrator, 1, &all);
    gsl_test(plain.outcome != (count == 1 ? ASK_REFUSED : ASK_ANSWERED),
             "%d turns held, scheme %d, released %d: %s", count, integrator, released,
             plain.reason);
    gsl_test(all.outcome != plain.outcome, "rows of %d turns kept: %s", count, all.reason);
    if (count == 1) {
        static const char *const back[] = {
            "about y, then about z, and back about both axes results in a rotation about x;",
            "about x, then about z, and back about both axes results in a rotation about y;",
            "about x, then about y, and back about both axes results in a rotation about z;"};
        gsl_test(strstr(plain.reason, back[held / 2]) == NULL, "left out: %s", plain.reason);
        gsl_test(strstr(all.reason, back[held / 2]) == NULL, "kept: %s", all.reason);
        return;
    }
    for (int i = 0; i < plain.count; i++)
        gsl_test(!(fabs(all.value[i] - plain.value[i]) < 1e-10),
                 "%d turns held, scheme %d, released %d: %s is %.15g, with rows kept %.15g", count,
                 integrator, released, plain.name[i], plain.value[i], all.value[i]);
}

static void way(void)
{
    static const double angle = 0.5, path[] = {0, 1, 2, 3, 4}, first[] = {0, angle, angle, 0, 0},
                        then[] = {0, 0, angle, angle, 0};
    double mark[3] = {0, 1, 0}, back[3];
    scene s;
    answer a;
    scene_init(&s, "way");
    const int profile = add_rod(&s), pin = scene_add_node(&s, 0, 0, 0),
              tip = scene_add_node(&s, 0.5, 0, 0), beside = scene_add_attached(&s, pin, 0, 1, 0);
    scene_add_member(&s, pin, tip, profile, y_axis);
    scene_hold(&s, pin, SCENE_UX, SCENE_RX);
    scene_drive(&s, pin, SCENE_RY, scene_add_driver(&s, "first", 5, path, first));
    scene_drive(&s, pin, SCENE_RZ, scene_add_driver(&s, "then", 5, path, then));
    scene_add_quantity(&s, "z", "m", scene_add_static(&s, 4, path + 1, 4),
                       scene_coordinate(beside, SCENE_UZ));
    ask_scene(&s, &element_geometrically_exact, NULL, 1, &a);
    scene_free(&s);
    for (int i = 0; i < 4; i++) {
        const double turn = i < 2 ? angle : -angle;
        double q[4];
        rotation_exp((const double[3]){0, i % 2 == 0 ? turn : 0, i % 2 ? turn : 0}, q);
        rotation_apply(q, mark, back);
        memcpy(mark, back, sizeof mark);
    }
    gsl_test_abs(answer_of(&a, "z"), mark[2], 1e-12, "turned about x: %s", a.reason);
    gsl_test(!(fabs(mark[2]) > 0.2), "and not by nothing: %g m", mark[2]);
}

int main(void)
{
    for (int integrator = SCENE_ALPHA; integrator <= SCENE_RADAU; integrator++)
        for (int held = 0; held < 8; held++) {
            kept(held, 0, integrator);
            kept(held, 6, integrator);
        }
    way();
    return gsl_test_summary();
}
