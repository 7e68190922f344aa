/* Loads along members and at offsets must have the correct total force and moment for an
 * unsymmetric section in any direction. Elements that are evaluated together must give the same
 * digits as one at a time. Reactions at the node of a rigid arm must balance the loads. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/test/kit.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/tools/kit/scenes.h"

enum { MOST = 120 };
static const double along[3] = {0.6, 0.8, 0}, across[3] = {-0.8, 0.6, 0};

static int add_angle(scene *s)
{
    static const double point[3][2] = {{0, 0}, {0.1, 0}, {0, 0.05}}, thickness[2] = {0.01, 0.01};
    static const int ends[2][2] = {{0, 1}, {0, 2}};
    section_spec spec = section_spec_walls(2e5, 8e4, 2, point, ends, thickness);
    spec.density = 3;
    return scene_add_section(s, &spec);
}

static void to_fixed(const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = along[i] * v[0] + across[i] * v[1] + (i == 2 ? v[2] : 0);
}

static void sums_of(const scene_load *load, const char *name, double force[3], double moment[3])
{
    const double end = 1;
    formulation chosen;
    scene s;
    model *m = NULL;
    fault f = {""};
    double residual[MOST];
    scene_init(&s, "member");
    const int p = scene_add_node(&s, 0, 0, 0),
              q = scene_add_node(&s, 2 * along[0], 2 * along[1], 0);
    scene_add_member(&s, p, q, add_angle(&s), across);
    scene_add_static(&s, 1, &end, 1);
    *scene_load_at(&s, scene_add_load(&s, load->kind, 0, 0, 0, 0)) = *load;
    gsl_test(formulation_parse(name, &chosen, &f) != STATUS_OK ||
                 scene_validate(&s, &f) != STATUS_OK,
             "%s", f.text);
    const model_request request = {&s, chosen.type, chosen.option, 3, 0, 0};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s: %s", name, f.text);
    run_state run;
    model_linearisation lin = {.path = 1, .residual = residual};
    run_state_begin(&run, m, 1, NULL);
    equations eq = {.m = m, .run = &run};
    gsl_test(linearise_state(&eq, &run.memory, kinematics_rest(m), &lin, &f) != STATUS_OK, "%s: %s",
             name, f.text);
    run_state_end(&run);
    for (int i = 0; i < 3; i++)
        force[i] = moment[i] = 0;
    for (int k = 0; k < model_sizes(m).vertices; k++) {
        double r[3], q4[4], here[3], turning[3];
        kinematics_frame(m, kinematics_rest(m), k, r, q4);
        for (int i = 0; i < 3; i++) {
            here[i] = residual[kinematics_coordinate(m, k, SCENE_UX + i)];
            force[i] += here[i];
            moment[i] += residual[kinematics_coordinate(m, k, SCENE_RX + i)];
            r[i] -= along[i];
        }
        vec3_cross(r, here, turning);
        for (int i = 0; i < 3; i++)
            moment[i] += turning[i];
    }
    model_free(m);
    scene_free(&s);
}

static void along_a_member(const char *name)
{
    static const double v[3] = {1, -2, 3}, at[3] = {0, 0.5, -0.25};
    double F[3], M[3], fixed[3], arm[3], expected[3];
    scene_load load = scene_load_of(SCENE_DISTRIBUTED, 0, v[0], v[1], v[2]);
    load.axes = SCENE_AXES_MEMBER;
    memcpy(load.at, at, sizeof at);
    to_fixed(v, fixed);
    to_fixed(at, arm);
    vec3_cross(arm, fixed, expected);
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], 2 * fixed[i], 1e-13, "%s: force %d in member axes", name, i);
        gsl_test_abs(M[i], 2 * expected[i], 1e-13, "%s: moment %d of its offset", name, i);
    }
    load.axes = SCENE_AXES_FIXED;
    vec3_cross(at, v, expected);
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], 2 * v[i], 1e-13, "%s: force %d in fixed axes", name, i);
        gsl_test_abs(M[i], 2 * expected[i], 1e-13, "%s: moment %d, fixed axes", name, i);
    }
    memset(load.at, 0, sizeof load.at);
    load.kind = SCENE_DISTRIBUTED_MOMENT;
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], 0, 1e-13, "%s: moments along a member are no force", name);
        gsl_test_abs(M[i], 2 * v[i], 1e-13, "%s: distributed moment %d", name, i);
    }
    load.kind = SCENE_GRAVITY;
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], 2 * 3 * 0.0015 * v[i], 1e-13, "%s: weight %d", name, i);
        gsl_test_abs(M[i], 0, 1e-13, "%s: weight acts at the centroids", name);
    }
}

/* A load that varies linearly from v to w along a part of a member: q = (v + w)/2 + s (w - v) at
 * the fraction c + h s of the length, where s is from -1/2 to 1/2. */
static void along_a_part(const char *name, int lumped)
{
    static const double v[3] = {1, -2, 3}, w[3] = {-0.5, 1, 2}, range[2] = {0.15, 0.72};
    const double h = range[1] - range[0], c = (range[0] + range[1]) / 2;
    double F[3], M[3], arm[3], expected[3];
    scene_load load = scene_load_of(SCENE_DISTRIBUTED, 0, v[0], v[1], v[2]);
    load.varies = 1;
    load.lumped = lumped;
    memcpy(load.last, w, sizeof load.last);
    memcpy(load.range, range, sizeof load.range);
    for (int i = 0; i < 3; i++)
        arm[i] = 2 * h * ((2 * c - 1) * (v[i] + w[i]) / 2 + h * (w[i] - v[i]) / 6);
    vec3_cross(along, arm, expected);
    sums_of(&load, name, F, M);
    for (int i = 0; i < 3; i++) {
        gsl_test_abs(F[i], h * (v[i] + w[i]), 1e-13, "%s: force %d of a part", name, i);
        gsl_test_abs(M[i], expected[i], 1e-13, "%s: moment %d of a part", name, i);
    }
}

static void cantilever(const element_type *type, int attached, int follower, double out[6])
{
    static const double P[3] = {0.2, -0.3, 0.4}, edge[3] = {0.1, 0.2, -0.3};
    const double end = 1;
    const section_spec spec = sections_of(1e4, 1, 1, 1);
    scene s;
    model *m = NULL;
    solve_result r = {0};
    fault f = {""};
    scene_init(&s, "cantilever");
    const int tip = scenes_cantilever(&s, &spec),
              where = attached ? scene_add_attached(&s, tip, 1 + edge[0], edge[1], edge[2]) : tip;
    scene_load *load = scene_load_at(&s, scene_add_load(&s, SCENE_FORCE, where, P[0], P[1], P[2]));
    load->follower = follower;
    if (!attached)
        memcpy(load->at, edge, sizeof edge);
    const int path = scene_add_static(&s, 1, &end, 1);
    static const char *const name[] = {"x", "y", "z", "mx", "my", "mz"};
    for (int i = 0; i < 6; i++)
        scene_add_quantity(&s, name[i], "1", path,
                           i < 3 ? scene_coordinate(tip, SCENE_UX + i)
                                 : scene_reaction(tip - 1, SCENE_UX + i));
    const model_request request = {&s, type, NULL, 4, 0, 0};
    const int good = scene_validate(&s, &f) == STATUS_OK &&
                     model_alloc(&request, &m, &f) == STATUS_OK &&
                     solve_scene(&s, m, NULL, &r, &f) == STATUS_OK;
    gsl_test(!good, "%s: %s", type->name, f.text);
    for (int i = 0; i < 6; i++)
        out[i] = good ? r.quantity[i].value : NAN;
    result_free(&r);
    model_free(m);
    scene_free(&s);
}

static void offset_is_an_arm(const element_type *type)
{
    for (int follower = 0; follower < 2; follower++) {
        double arm[6], offset[6];
        cantilever(type, 1, follower, arm);
        cantilever(type, 0, follower, offset);
        for (int i = 0; i < 6; i++)
            gsl_test(!(fabs(offset[i] - arm[i]) <= 1e-11), "%s%s: %d is %.15g, on an arm %.15g",
                     type->name, follower ? ", follower" : "", i, offset[i], arm[i]);
        gsl_test(!(fabs(offset[1]) > 0.05), "%s: the tip moves", type->name);
    }
}

static void applied_tests(void)
{
    static const char *const name[] = {"geometrically_exact:nodes=2", "geometrically_exact:nodes=3",
                                       "beamw_consistent"};
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        along_a_member(name[i]);
        along_a_part(name[i], 0);
        along_a_part(name[i], 1);
    }
    for (int i = 0; registry_formulations[i] != NULL; i++)
        offset_is_an_arm(registry_formulations[i]);
}

enum { ELEMENTS = 7, MEMBERS = 3, QUANTITIES = 6 };

static void set_up(scene *s)
{
    const double y[3] = {0, 1, 0}, end = 1;
    const section_spec spec[2] = {section_spec_rectangle(2e11, 8e10, 0.02, 0.002),
                                  section_spec_rectangle(2e11, 8e10, 0.03, 0.001)};
    int node[MEMBERS + 1], of[2];
    scene_init(s, "line");
    for (int k = 0; k < 2; k++)
        of[k] = scene_add_section(s, &spec[k]);
    for (int k = 0; k <= MEMBERS; k++)
        node[k] = scene_add_node(s, 0.2 * k, 0, 0);
    for (int k = 0; k < MEMBERS; k++)
        scene_add_member(s, node[k], node[k + 1], of[k % 2], y);
    scene_hold_all(s, node[0]);
    scene_add_load(s, SCENE_FORCE, node[MEMBERS], 0.1, 0.4, 0.2);
    scene_add_static(s, 1, &end, 1);
    for (int k = 0; k < QUANTITIES; k++) {
        const char name[2] = {(char)('a' + k), 0};
        scene_add_quantity(s, name, "1", 0, scene_coordinate(node[MEMBERS], k));
    }
}

static void solved(const element_type *type, double value[QUANTITIES])
{
    scene s;
    model *m = NULL;
    solve_result r = {0};
    fault f = {""};
    set_up(&s);
    const model_request request = {&s, type, NULL, ELEMENTS, 0, 0};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK ||
                 solve_scene(&s, m, NULL, &r, &f) != STATUS_OK,
             "%s: %s", type->name, f.text);
    for (int k = 0; k < QUANTITIES; k++)
        value[k] = r.quantities > k ? r.quantity[k].value : NAN;
    result_free(&r);
    model_free(m);
    scene_free(&s);
}

static void same_answers(const element_type *type)
{
    double together[QUANTITIES], alone[QUANTITIES];
    element_type one = *type;
    one.lanes = 0;
    one.strain_many = NULL;
    one.stress_many = NULL;
    one.equations_many = NULL;
    solved(type, together);
    solved(&one, alone);
    gsl_test(memcmp(together, alone, sizeof alone) != 0, "%s: in lanes %.17g, one at a time %.17g",
             type->name, together[1], alone[1]);
}

static const element_type *inner;
static int requested;
static const double failing =
    0.4 + 0.2 * 3 / ELEMENTS; /* start of the fourth element of the last member [m] */

static void fail(int count, const node_state x[], int nodes, status outcome[])
{
    for (int k = 0; k < count; k++)
        if (fabs(x[k * nodes].r[0] - failing) < 1e-9)
            outcome[k] = STATUS_SINGULAR;
}

static void failing_equations(int count, const element_data *const data[], const node_state x[],
                              const double *const e[], const double *const own[],
                              const double *const s[], equations_output out[], status outcome[])
{
    requested++;
    inner->equations_many(count, data, x, e, own, s, out, outcome);
    fail(count, x, element_nodes(inner, NULL), outcome);
}

static void named(const element_type *type)
{
    scene s;
    model *m = NULL;
    model_state *state = NULL;
    fault f = {""};
    element_type wrong = *type;
    inner = type;
    wrong.equations_many = failing_equations;
    set_up(&s);
    const model_request request = {&s, &wrong, NULL, ELEMENTS, 0, 0};
    if (model_alloc(&request, &m, &f) == STATUS_OK &&
        kinematics_state_alloc(m, &state, &f) == STATUS_OK) {
        const model_size size = model_sizes(m);
        double *residual = calloc((size_t)(size.free + size.driven) + 1, sizeof *residual);
        run_state run;
        model_linearisation lin = {.residual = residual};
        run_state_begin(&run, m, 1, NULL);
        equations eq = {.m = m, .run = &run};
        requested = 0;
        const status outcome =
            residual != NULL ? linearise_state(&eq, &run.memory, state, &lin, &f) : STATUS_FAULT;
        gsl_test(outcome != (requested > 0 ? STATUS_SINGULAR : STATUS_OK),
                 "%s: an element that cannot be evaluated", type->name);
        gsl_test(requested > 0 && strstr(f.text, "element 17 of member 2") == NULL, "%s: '%s'",
                 type->name, f.text);
        run_state_end(&run);
        free(residual);
    } else {
        gsl_test(1, "%s: %s", type->name, f.text);
    }
    kinematics_state_free(state);
    model_free(m);
    scene_free(&s);
}

static void chunk_tests(void)
{
    int found = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        if (type->lanes == 0)
            continue;
        same_answers(type);
        if (type->equations_many != NULL) {
            named(type);
            found++;
        }
    }
    gsl_test(found == 0, "a formulation with equations in lanes");
}

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
    scene_add_load(&s, SCENE_FORCE, foot, 5, 6, 7);
    scene_add_static(&s, 1, &end, 1);
    for (int k = 0; k < 9; k++) {
        char name[8];
        snprintf(name, sizeof name, "q%d", k);
        scene_add_quantity(&s, name, "1", 0,
                           k < 6 ? scene_reaction(foot, k) : scene_coordinate(tip, k - 6));
    }
    const model_request request = {&s, type, NULL, 2, 0, 0};
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

static void reaction_tests(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++)
        foot_of_an_arm(registry_formulations[i]);
}

int main(void)
{
    applied_tests();
    chunk_tests();
    reaction_tests();
    return gsl_test_summary();
}
