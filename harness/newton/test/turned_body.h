/* A beam with a rigid body at its end, in a state rotated about a general axis. A load acts at an
 * offset from the node of the body. */
#ifndef BEAMWORK_TEST_TURNED_BODY_H
#define BEAMWORK_TEST_TURNED_BODY_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/tools/kit/scenes.h"

enum { MOST = 40 };

enum { FREE_TURNS, THREE_ANGLES, TWO_ANGLES, FORK, BODIES };

static const char *const turned_body_name[] = {"free turns", "three angles", "two angles",
                                               "a fork"};

static inline void beam_and_body(int body, scene_load_kind kind, scene *s)
{
    const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1}, end = 1;
    static const double sequence[3][3] = {{0, 0, 1}, {0.6, 0.8, 0}, {1, 0, 0}};
    const section_spec spec = sections_of(1e3, 2, 1, 1);
    scene_init(s, "beam_and_body");
    const int node = scenes_cantilever(s, &spec),
              edge = scene_add_attached(s, node, 1.3, -0.4, 0.25);
    if (body == THREE_ANGLES || body == TWO_ANGLES) {
        scene_node *n = scene_node_at(s, node);
        n->rotation = SCENE_ROTATION_SEQUENCE;
        memcpy(n->axis, sequence, (body == THREE_ANGLES ? 3 : 2) * sizeof n->axis[0]);
    } else if (body == FORK) {
        scene_fork(s, node, x, z);
    }
    scene_add_load(s, kind, edge, 0.7, -1.1, 0.4);
    scene_add_static(s, 1, &end, 1);
}

typedef struct turned_body {
    scene scene;
    model *m;
    model_state *turned, *moved;
    int n;
} turned_body;

static inline void turned_body_move(const turned_body *s, const model_state *from,
                                    const double dx[], model_state *to)
{
    double residual[MOST];
    fault f = {""};
    run_state run;
    model_linearisation lin = {.path = 1, .residual = residual};
    run_state_begin(&run, s->m, 1, NULL);
    equations eq = {.m = s->m, .run = &run};
    kinematics_state_copy(s->m, from, to);
    gsl_test(linearise_state(&eq, &run.memory, to, &lin, &f) != STATUS_OK, "linearised: %s",
             f.text);
    advance_state(&eq, &run.memory, to, dx, 1, NULL);
    run_state_end(&run);
}

static inline void turned_body_prepare(int body, scene_load_kind kind, turned_body *s)
{
    fault f = {""};
    double dx[MOST];
    beam_and_body(body, kind, &s->scene);
    int i = 0;
    for (; strcmp(registry_formulations[i]->name, "geometrically_exact") != 0; i++) {}
    const model_request what = {&s->scene, registry_formulations[i], NULL, 1, 0, 0};
    gsl_test(scene_validate(&s->scene, &f) != STATUS_OK ||
                 model_alloc(&what, &s->m, &f) != STATUS_OK,
             "%s: %s", turned_body_name[body], f.text);
    kinematics_state_alloc(s->m, &s->turned, &f);
    kinematics_state_alloc(s->m, &s->moved, &f);
    s->n = model_sizes(s->m).free;
    for (int k = 0; k < s->n; k++)
        dx[k] = 0.5 * sin(1.7 * k + 0.4);
    turned_body_move(s, kinematics_rest(s->m), dx, s->turned);
}

static inline void turned_body_release(turned_body *s)
{
    kinematics_state_free(s->turned);
    kinematics_state_free(s->moved);
    model_free(s->m);
    scene_free(&s->scene);
}

/* Computes the generalised loads at the end of the path. */
static inline void turned_body_loads(const turned_body *s, double out[])
{
    double without[MOST];
    fault f = {""};
    run_state run;
    model_linearisation with = {.path = 1, .residual = out},
                        none = {.path = 0, .residual = without};
    run_state_begin(&run, s->m, 1, NULL);
    equations eq = {.m = s->m, .run = &run};
    linearise_state(&eq, &run.memory, s->turned, &with, &f);
    linearise_state(&eq, &run.memory, s->turned, &none, &f);
    run_state_end(&run);
    for (int k = 0; k < s->n; k++)
        out[k] -= without[k];
}

/* Computes the displacement and rotation of the loaded node relative to the rotated state. */
static inline void turned_body_motion(const turned_body *s, const double dx[], double d[3],
                                      double turn[3])
{
    double r[3], at[3], q[4], from[4];
    turned_body_move(s, s->turned, dx, s->moved);
    kinematics_frame(s->m, s->turned, 2, at, from);
    kinematics_frame(s->m, s->moved, 2, r, q);
    for (int i = 0; i < 3; i++)
        d[i] = r[i] - at[i];
    rotation_between(from, q, turn);
}

/* Returns the work of the load during the increments dx: exact for a force, to first order for a
 * moment. */
static inline double turned_body_work(const turned_body *s, const double dx[])
{
    const scene_load *load = &s->scene.load[0];
    double d[3], turn[3];
    turned_body_motion(s, dx, d, turn);
    return vec3_dot(load->vector, load->kind == SCENE_FORCE ? d : turn);
}

static const double turned_body_step = 1e-3;

static inline double turned_body_work_at(const turned_body *s, int i, double hi, int j, double hj)
{
    double dx[MOST] = {0};
    dx[i] += hi;
    if (j >= 0)
        dx[j] += hj;
    return turned_body_work(s, dx);
}

#endif
