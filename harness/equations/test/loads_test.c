/* Loads on nodes of a rigid body in a turned state, against the work they do: forces and moments
 * at an offset, their stiffness, their rates along the path. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/analysis/solve.h"
#include "harness/catalogue/formulations.h"
#include "harness/catalogue/registry.h"
#include "harness/equations/advance.h"
#include "harness/equations/linearise.h"
#include "harness/equations/loads.h"
#include "harness/equations/rotating_frame.h"
#include "harness/model/assemble.h"
#include "harness/model/kinematics.h"
#include "harness/model/model.h"

enum { MOST = 40 };
enum { FREE_TURNS, THREE_ANGLES, TWO_ANGLES, FORK, BODIES };
static const char *const body_name[] = {"free turns", "three angles", "two angles", "a fork"};

/* A beam from a clamp to a body, which a load acts on beside its own node. */
static void beam_and_body(int body, scene_load_kind kind, scene *s)
{
    const double y[3] = {0, 1, 0}, x[3] = {1, 0, 0}, z[3] = {0, 0, 1}, end = 1;
    static const double sequence[3][3] = {{0, 0, 1}, {0.6, 0.8, 0}, {1, 0, 0}};
    section_spec spec = section_spec_constants(1, 1);
    spec.constants =
        (section){.young = 1, .shear_modulus = 1, .A = 1e3, .Iy = 2, .Iz = 1, .It = 1, .Ip = 3};
    scene_init(s, "beam_and_body");
    const int root = scene_add_node(s, 0, 0, 0), node = scene_add_node(s, 1, 0, 0),
              edge = scene_add_attached(s, node, 1.3, -0.4, 0.25);
    scene_hold_all(s, root);
    scene_add_member(s, root, node, scene_add_section(s, &spec), y);
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

typedef struct subject {
    scene scene;
    model *m;
    model_state *turned, *moved;
    int n; /* free coordinates */
} subject;

static void move(const subject *s, const model_state *from, const double dx[], model_state *to)
{
    double residual[MOST];
    fault f = {""};
    model_linearisation lin = {.path = 1, .residual = residual};
    kinematics_state_copy(s->m, from, to);
    gsl_test(linearise_state(s->m, to, &lin, &f) != STATUS_OK, "linearised: %s", f.text);
    advance_state(s->m, to, dx, 1);
}

/* A state far from rest, turned about no special axis. */
static void prepare(int body, scene_load_kind kind, subject *s)
{
    fault f = {""};
    double dx[MOST];
    beam_and_body(body, kind, &s->scene);
    int i = 0;
    for (; strcmp(registry_formulations[i]->name, "geometrically_exact") != 0; i++) {}
    const model_request what = {&s->scene, registry_formulations[i], NULL, 1, 0};
    gsl_test(scene_validate(&s->scene, &f) != STATUS_OK ||
                 model_alloc(&what, &s->m, &f) != STATUS_OK,
             "%s: %s", body_name[body], f.text);
    kinematics_state_alloc(s->m, &s->turned, &f);
    kinematics_state_alloc(s->m, &s->moved, &f);
    s->n = model_sizes(s->m).free;
    for (int k = 0; k < s->n; k++)
        dx[k] = 0.5 * sin(1.7 * k + 0.4);
    move(s, kinematics_rest(s->m), dx, s->turned);
}

static void release(subject *s)
{
    kinematics_state_free(s->turned);
    kinematics_state_free(s->moved);
    model_free(s->m);
    scene_free(&s->scene);
}

/* Generalised loads of the path's end. */
static void loads_of(const subject *s, double out[])
{
    double without[MOST];
    fault f = {""};
    model_linearisation with = {.path = 1, .residual = out},
                        none = {.path = 0, .residual = without};
    linearise_state(s->m, s->turned, &with, &f);
    linearise_state(s->m, s->turned, &none, &f);
    for (int k = 0; k < s->n; k++)
        out[k] -= without[k];
}

/* Displacement of the loaded node less that of the turned state, and its turn since. */
static void motion_of(const subject *s, const double dx[], double d[3], double turn[3])
{
    double r[3], at[3], q[4], from[4];
    move(s, s->turned, dx, s->moved);
    kinematics_frame(s->m, s->turned, 2, at, from);
    kinematics_frame(s->m, s->moved, 2, r, q);
    for (int i = 0; i < 3; i++)
        d[i] = r[i] - at[i];
    rotation_between(from, q, turn);
}

/* Work of the load's first order: of a force all of it. */
static double work_of(const subject *s, const double dx[])
{
    const scene_load *load = &s->scene.load[0];
    double d[3], turn[3];
    motion_of(s, dx, d, turn);
    return vec3_dot(load->vector, load->kind == SCENE_FORCE ? d : turn);
}

static const double step = 1e-3;

static double work_at(const subject *s, int i, double hi, int j, double hj)
{
    double dx[MOST] = {0};
    dx[i] += hi;
    if (j >= 0)
        dx[j] += hj;
    return work_of(s, dx);
}

/* Five points: the error is of the fourth order. */
static double slope(const subject *s, int k)
{
    return (8 * (work_at(s, k, step, -1, 0) - work_at(s, k, -step, -1, 0)) -
            (work_at(s, k, 2 * step, -1, 0) - work_at(s, k, -2 * step, -1, 0))) /
           (12 * step);
}

static void conjugate(int body, scene_load_kind kind)
{
    subject s;
    double load[MOST], F[6], at[3], edge[3], q[4], arm[3], moment[3];
    prepare(body, kind, &s);
    loads_of(&s, load);
    for (int k = 0; k < s.n; k++)
        gsl_test(!(fabs(load[k] - slope(&s, k)) <= 1e-9),
                 "%s, %s: load %d is %.12g, its work rises by %.12g", body_name[body],
                 kind == SCENE_FORCE ? "force" : "moment", k, load[k], slope(&s, k));
    kinematics_frame(s.m, s.turned, 1, at, q);
    kinematics_frame(s.m, s.turned, 2, edge, q);
    for (int i = 0; i < 3; i++)
        arm[i] = edge[i] - at[i];
    vec3_cross(arm, s.scene.load[0].vector, moment);
    loads_at_node(s.m, s.turned, 1, F);
    for (int i = 0; i < 3; i++) {
        const double v = s.scene.load[0].vector[i], force = kind == SCENE_FORCE ? v : 0,
                     m = kind == SCENE_FORCE ? moment[i] : v;
        gsl_test(!(fabs(F[i] - force) <= 1e-14) || !(fabs(F[3 + i] - m) <= 1e-14),
                 "%s: force and moment on the body: %g, %g", body_name[body], F[i], F[3 + i]);
    }
    release(&s);
}

/* A dead force has a potential: its stiffness is the second derivative of the work, with the sign
 * of K. */
static void stiffness(int body)
{
    subject s;
    fault f = {""};
    const sparse *pattern;
    sparse K;
    prepare(body, SCENE_FORCE, &s);
    gsl_test(assemble_pattern(s.m, 0, &pattern, &f) != STATUS_OK ||
                 sparse_alloc_like(pattern, &K, &f) != STATUS_OK,
             "pattern");
    rotating_frame_load_stiffness(s.m, s.turned, 1, &K);
    double largest = 0;
    for (int j = 0; j < s.n; j++)
        for (int k = K.column[j]; k < K.column[j + 1]; k++) {
            const int i = K.row[k];
            const double h = step, mixed = work_at(&s, i, h, j, h) - work_at(&s, i, h, j, -h) -
                                           work_at(&s, i, -h, j, h) + work_at(&s, i, -h, j, -h);
            gsl_test(!(fabs(K.value[k] + mixed / (4 * h * h)) <= 1e-5),
                     "%s: stiffness (%d, %d) of a force: %.8g, not %.8g", body_name[body], i, j,
                     K.value[k], -mixed / (4 * h * h));
            largest = fmax(largest, fabs(K.value[k]));
        }
    gsl_test(!(largest > 0.1), "%s: the force has a stiffness: %g", body_name[body], largest);
    sparse_free_values(&K);
    release(&s);
}

static void follow_stations(scene_load *load, const double path[3], const double value[3])
{
    load->stations = 3;
    load->path = malloc(3 * sizeof *path);
    load->factor = malloc(3 * sizeof *value);
    memcpy(load->path, path, 3 * sizeof *path);
    memcpy(load->factor, value, 3 * sizeof *value);
}

/* Factor 0, 2, 1 at path 0, 1, 3: the rate at a station is that of what follows, and nothing
 * changes outside. */
static void rates(void)
{
    static const double path[] = {0, 1, 3}, value[] = {0, 2, 1};
    static const struct {
        double path, rate;
    } row[] = {{-1, 0}, {0, 2}, {0.5, 2}, {1, -0.5}, {2, -0.5}, {3, 0}, {4, 0}};
    subject s;
    double unit[MOST], out[MOST];
    prepare(FREE_TURNS, SCENE_FORCE, &s);
    loads_of(&s, unit);
    loads_rate(s.m, s.turned, 0.3, out);
    for (int k = 0; k < s.n; k++)
        gsl_test_abs(out[k], unit[k], 1e-11, "proportional load: its rate is itself");
    follow_stations(&s.scene.load[0], path, value);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        loads_rate(s.m, s.turned, row[i].path, out);
        for (int k = 0; k < s.n; k++)
            gsl_test(!(fabs(out[k] - row[i].rate * unit[k]) <= 1e-11),
                     "rate at path %g: %g of the load, not %g", row[i].path, out[k] / unit[k],
                     row[i].rate);
    }
    release(&s);
}

/* Where the coordinates are angles, the stiffness is what the generalised loads change by, also of
 * a moment or of a load that follows, which have no potential. at [m]: beside the node. */
static void stiffness_of_angles(int body, scene_load_kind kind, int follower, const double at[3])
{
    subject s;
    fault f = {""};
    const sparse *pattern;
    sparse K;
    prepare(body, kind, &s);
    s.scene.load[0].follower = follower;
    memcpy(s.scene.load[0].at, at, sizeof s.scene.load[0].at);
    gsl_test(assemble_pattern(s.m, 0, &pattern, &f) != STATUS_OK ||
                 sparse_alloc_like(pattern, &K, &f) != STATUS_OK,
             "pattern");
    gsl_test((follower || kind == SCENE_MOMENT) && K.symmetric, "%s: an unsymmetric pattern",
             body_name[body]);
    rotating_frame_load_stiffness(s.m, s.turned, 1, &K);
    for (int j = 0; j < s.n; j++) {
        double load[2][MOST];
        for (int side = 0; side < 2; side++) {
            double dx[MOST] = {0};
            subject there = s;
            dx[j] = side == 0 ? -step : step;
            move(&s, s.turned, dx, s.moved);
            there.turned = s.moved;
            loads_of(&there, load[side]);
        }
        for (int k = K.column[j]; k < K.column[j + 1]; k++) {
            const int i = K.row[k];
            const double change = (load[1][i] - load[0][i]) / (2 * step);
            gsl_test(!(fabs(K.value[k] + change) <= 1e-5),
                     "%s, %s: stiffness (%d, %d) is %.8g, the load changes by %.8g",
                     body_name[body], kind == SCENE_FORCE ? "force" : "moment", i, j, K.value[k],
                     change);
        }
    }
    sparse_free_values(&K);
    release(&s);
}

/* The load between its stations: on straight lines, and constant outside. */
static void factors(void)
{
    static const double path[] = {0.5, 1, 3}, value[] = {0.25, 2, 1};
    static const double row[][2] = {{0, 0.25}, {0.5, 0.25}, {0.75, 1.125}, {1, 2},
                                    {2, 1.5},  {3, 1},      {4, 1}};
    subject s;
    prepare(FREE_TURNS, SCENE_FORCE, &s);
    follow_stations(&s.scene.load[0], path, value);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        double F[6];
        fault f = {""};
        double residual[MOST], dx[MOST] = {0};
        model_linearisation lin = {.path = row[i][0], .residual = residual};
        linearise_state(s.m, s.turned, &lin, &f);
        advance_state(s.m, s.turned, dx, row[i][0]);
        loads_at_node(s.m, s.turned, 1, F);
        gsl_test_abs(F[0], row[i][1] * s.scene.load[0].vector[0], 1e-14, "factor at path %g",
                     row[i][0]);
    }
    release(&s);
}

enum { LINE, SPIN };

/* Forces of one component on the vertices of a member of length 2 along x: of a load along it, or of a frame that turns
 * about z. The ends come first. */
static void forces_along(int what, const char *name, double path, int follows, int nodes,
                         double out[])
{
    const double y[3] = {0, 1, 0}, z[3] = {0, 0, 0.3}, origin[3] = {0, 0, 0}, end = 1;
    formulation chosen;
    scene s;
    model *m = NULL;
    fault f = {""};
    section_spec spec = section_spec_constants(1, 1);
    spec.density = 1;
    spec.constants = (section){.A = 1, .Iy = 1, .Iz = 1, .It = 1, .Ip = 2};
    scene_init(&s, "member");
    const int p = scene_add_node(&s, 0, 0, 0), q = scene_add_node(&s, 2, 0, 0);
    const int member = scene_add_member(&s, p, q, scene_add_section(&s, &spec), y);
    scene_add_static(&s, 1, &end, 1);
    if (what == LINE)
        scene_add_load(&s, SCENE_DISTRIBUTED, member, 0, 3, 0);
    gsl_test(formulation_parse(name, &chosen, &f) != STATUS_OK, "%s", f.text);
    const model_request request = {&s, chosen.type, chosen.option, 1, 0};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s: %s", name, f.text);
    if (what == SPIN)
        rotating_frame_set(m, z, origin, follows);
    double residual[MOST];
    model_linearisation lin = {.path = path, .residual = residual};
    gsl_test(linearise_state(m, kinematics_rest(m), &lin, &f) != STATUS_OK, "%s: %s", name, f.text);
    for (int k = 0; k < nodes; k++)
        out[k] = residual[kinematics_coordinate(m, k, what == LINE ? SCENE_UY : SCENE_UX)];
    model_free(m);
    scene_free(&s);
}

/* A load along a member: all of it, with its first moment; the second moment is that of the rule (trapezoids; Simpson, exact). */
static void along_a_member(const char *name, int nodes)
{
    double F[MOST], sum[3] = {0};
    forces_along(LINE, name, 1, 0, nodes, F);
    for (int k = 0; k < nodes; k++) {
        const int place = k == 0 ? 0 : k == 1 ? nodes - 1 : 1;
        const double x = 2.0 * place / (nodes - 1), force = F[k];
        for (int power = 0; power < 3; power++)
            sum[power] += force * pow(x, power);
    }
    gsl_test_rel(sum[0], 3 * 2, 1e-14, "%s: all of the load", name);
    gsl_test_rel(sum[1], 3 * 2, 1e-14, "%s: its moment", name);
    gsl_test_rel(sum[2], nodes == 2 ? 3 * 4 : 3 * 8 / 3.0, 1e-14, "%s: its second moment", name);
}

/* Centrifugal forces grow with the square of the angular velocity, and that with the path where it follows it. */
static void turning_faster(void)
{
    static const char name[] = "geometrically_exact:nodes=2";
    double whole[2], half[2], steady[2];
    forces_along(SPIN, name, 1, 1, 2, whole);
    forces_along(SPIN, name, 0.5, 1, 2, half);
    forces_along(SPIN, name, 0.5, 0, 2, steady);
    for (int k = 0; k < 2; k++) {
        gsl_test_abs(half[k], whole[k] / 4, 1e-15, "half the angular velocity, force %d", k);
        gsl_test_abs(steady[k], whole[k], 1e-15,
                     "an angular velocity that does not follow the path, force %d", k);
    }
    gsl_test_rel(whole[1], 0.3 * 0.3 * 2, 1e-13, "half of the mass at the end, at radius 2");
}

/* A beam on an arm: what the body at its foot carries is the tip's force, and its moment about the body. */
static void foot_of_an_arm(const element_type *type)
{
    const double y[3] = {0, 1, 0}, end = 1, P[3] = {0.01, -0.02, 0.03};
    scene s;
    model *m = NULL;
    solve_result r = {0};
    fault f = {""};
    section_spec spec = section_spec_rectangle(1e4, 4e3, 0.1, 0.08);
    scene_init(&s, "arm");
    const int foot = scene_add_node(&s, 0, 0, 0),
              arm = scene_add_attached(&s, foot, 0.3, -0.4, 0.2);
    const int tip = scene_add_node(&s, 1.3, -0.4, 0.2);
    scene_hold_all(&s, foot);
    scene_add_member(&s, arm, tip, scene_add_section(&s, &spec), y);
    scene_add_load(&s, SCENE_FORCE, tip, P[0], P[1], P[2]);
    scene_add_load(&s, SCENE_FORCE, foot, 5, 6, 7); /* into the ground at once */
    scene_add_static(&s, 1, &end, 1);
    for (int k = 0; k < 9; k++) {
        char name[8];
        snprintf(name, sizeof name, "q%d", k);
        scene_add_quantity(&s, name, "1", 0,
                           k < 6 ? scene_reaction(foot, k) : scene_coordinate(tip, k - 6));
    }
    const model_request request = {&s, type, NULL, 2, 0};
    if (model_alloc(&request, &m, &f) == STATUS_OK &&
        solve_scene(&s, m, NULL, &r, &f) == STATUS_OK) {
        const double x[3] = {1.3 + r.quantity[6].value, -0.4 + r.quantity[7].value,
                             0.2 + r.quantity[8].value};
        double moment[3];
        vec3_cross(x, P, moment);
        for (int i = 0; i < 3; i++) {
            gsl_test_abs(r.quantity[i].value, -P[i] - 5 - i, 1e-9, "%s: reaction %d at the foot",
                         type->name, i);
            gsl_test_abs(r.quantity[3 + i].value, -moment[i], 1e-9,
                         "%s: reacting moment %d at the foot", type->name, i);
        }
    } else {
        gsl_test(1, "%s: %s", type->name, f.text);
    }
    result_free(&r);
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    for (int body = 0; body < BODIES; body++) {
        conjugate(body, SCENE_FORCE);
        conjugate(body, SCENE_MOMENT);
        stiffness(body);
    }
    for (int body = THREE_ANGLES; body <= TWO_ANGLES; body++) {
        static const double here[3] = {0, 0, 0}, there[3] = {-0.2, 0.5, 0.9};
        for (int follower = 0; follower < 2; follower++) {
            stiffness_of_angles(body, SCENE_FORCE, follower, here);
            stiffness_of_angles(body, SCENE_FORCE, follower, there);
            stiffness_of_angles(body, SCENE_MOMENT, follower, here);
        }
    }
    rates();
    factors();
    along_a_member("geometrically_exact:nodes=2", 2);
    along_a_member("geometrically_exact:nodes=3", 3);
    turning_faster();
    for (int i = 0; registry_formulations[i] != NULL; i++)
        foot_of_an_arm(registry_formulations[i]);
    return gsl_test_summary();
}
