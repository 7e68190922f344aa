/* Rods and bodies in motion, for tests of masses: bodies at offsets from their nodes, sections with
 * an eccentric centre of mass, and a channel with warping. A sequence of angles and released ends
 * are optional. */
#ifndef BEAMWORK_TEST_MASSES_H
#define BEAMWORK_TEST_MASSES_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/vec3.h"
#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/time/time_impl.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_collocation, element_geometrically_exact,
    element_beamw_consistent;

enum { MOST = 120 };

static inline void turn_in_sequence(scene *s, int node)
{
    static const double axis[3][3] = {{0, 0, 1}, {0.6, 0.8, 0}, {1, 0, 0}};
    scene_node_at(s, node)->rotation = SCENE_ROTATION_SEQUENCE;
    memcpy(scene_node_at(s, node)->axis, axis, sizeof axis);
}

/* Properties of the rods per length: mass [kg/m], position of its centre relative to the line [m],
 * and moments of inertia about this centre [kg m]. */
static const double mass = 1.5, centre[3] = {0, 0.06, -0.1}, about[3] = {0.04, 0.025, 0.015};

static inline section_spec heavy(void)
{
    section_spec spec = timed_profile(&(timed_section){
        .EA = 2e3, .GA = 1e3, .GJ = 3, .EI = 5, .mass = mass, .polar = 1, .rotary = 1});
    double *M = spec.constants.mass;
    const double skew[9] = {0,          -centre[2], centre[1], centre[2], 0,
                            -centre[0], -centre[1], centre[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            M[6 * i + 3 + j] = M[6 * (3 + j) + i] = -mass * skew[3 * i + j];
            M[6 * (3 + i) + 3 + j] = (i == j ? about[i] + mass * vec3_dot(centre, centre) : 0) -
                                     mass * (centre[i] * centre[j]);
        }
    return spec;
}

static inline section_spec channel(void)
{
    static const double point[4][2] = {{0.1, 0.14}, {0, 0.14}, {0, -0.14}, {0.1, -0.14}},
                        thickness[3] = {0.012, 0.012, 0.012};
    section_spec spec = section_spec_walls(210e9, 80e9, 3, point, NULL, thickness);
    spec.density = 100;
    return spec;
}

static inline void build(scene *s, int warps, int released)
{
    static const double y[3] = {0.1, 1, 0.2};
    const section_spec spec = warps ? channel() : heavy();
    scene_init(s, "masses");
    const int profile = scene_add_section(s, &spec), A = scene_add_node(s, 0, 0, 0),
              B = scene_add_node(s, 1, 0.1, 0.2), beside = scene_add_attached(s, B, 1.1, 0.3, 0.1),
              C = scene_add_node(s, 2, 0, 0.3), D = scene_add_node(s, 2.8, 0.4, 0);
    scene_set_body(s, A,
                   (scene_body){0.7, {0.1, -0.2, 0.3}, {0.05, 0.06, 0.07, 0.011, -0.012, 0.013}});
    scene_set_body(s, beside, (scene_body){0.4, {0.2, 0.1, 0}, {0.03, 0.05, 0.04, 0, 0.01, 0}});
    scene_set_body(s, C, (scene_body){0.5, {0, 0.3, -0.1}, {0.02, 0.03, 0.04, 0.005, 0, 0.003}});
    if (released)
        turn_in_sequence(s, C);
    scene_add_member(s, A, B, profile, y);
    const int second = scene_add_member(s, beside, C, profile, y),
              third = scene_add_member(s, C, D, profile, y);
    if (released) {
        scene_release_end(s, second, 0, SCENE_RY);
        scene_release_end(s, second, 0, SCENE_RZ);
        scene_release_end(s, second, 0, SCENE_UY);
        scene_release_end(s, second, 0, SCENE_UX);
        scene_release_end(s, third, 0, SCENE_RX);
        scene_release_end(s, third, 0, SCENE_RY);
        scene_release_end(s, third, 0, SCENE_RZ);
        scene_release_end(s, third, 0, SCENE_UZ);
    }
    scene_demand(s, FEATURE_MASS | FEATURE_ROTARY_INERTIA);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_MOMENTS | FEATURE_WAGNER_TORQUE |
                      (warps ? FEATURE_SHEAR : 0));
}

typedef struct moving_one {
    scene scene;
    model *m;
    frame_masses masses;
    model_state *rest, *now;
    int all;
    double inc[MOST], v[MOST], a[MOST];
} moving_one;

static inline void some(int n, double size, uint64_t *seed, double out[])
{
    for (int i = 0; i < n; i++)
        out[i] = size * random_number(seed);
}

/* Begins a motion. `add` adds parts to the scene; NULL: none. */
static inline void begin_with(moving_one *o, const element_type *type, int released,
                              void (*add)(scene *))
{
    double option[ELEMENT_MAX_OPTIONS] = {0};
    fault f = {""};
    uint64_t seed = 7;
    memset(o, 0, sizeof *o);
    build(&o->scene, type == &element_beamw_consistent, released);
    if (add != NULL)
        add(&o->scene);
    formulation chosen;
    formulation_default(type, &chosen);
    memcpy(option, chosen.option, sizeof option);
    const model_request request = {
        .scene = &o->scene, .type = type, .options = option, .elements = 2};
    const status outcome = model_alloc(&request, &o->m, &f);
    gsl_test(outcome != STATUS_OK, "%s: %s", type->name, f.text);
    if (outcome != STATUS_OK)
        exit(gsl_test_summary());
    gsl_test(frame_masses_alloc(o->m, &o->masses, &f) != STATUS_OK, "%s", f.text);
    gsl_test(kinematics_state_alloc(o->m, &o->rest, &f) != STATUS_OK ||
                 kinematics_state_alloc(o->m, &o->now, &f) != STATUS_OK,
             "%s", f.text);
    o->all = model_all_coordinates(o->m);
    gsl_test(o->all > MOST, "%d coordinates", o->all);
    some(o->all, 0.4, &seed, o->inc);
    some(o->all, 1, &seed, o->v);
    some(o->all, 3, &seed, o->a);
    increment_apply(o->m, o->rest, o->inc, 0, o->now);
}

static inline void begin(moving_one *o, const element_type *type, int released)
{
    begin_with(o, type, released, NULL);
}

static inline void end(moving_one *o)
{
    frame_masses_free(&o->masses);
    kinematics_state_free(o->rest);
    kinematics_state_free(o->now);
    model_free(o->m);
    scene_free(&o->scene);
}

#endif
