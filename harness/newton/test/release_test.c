/* Released ends in a turned state: a tangent that is the derivative of the forces, whatever is
 * released, wherever the node is and whatever acts on the member; Newton's method converges as it
 * does with a true tangent. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

enum { MOST = 60, ON_NODE, ON_BODY, ON_ANGLES, PLACES };

static const char *const place_name[] = {[ON_NODE] = "a node",
                                         [ON_BODY] = "a node beside its body",
                                         [ON_ANGLES] = "a body with a sequence of angles"};

static const char *const sets[][2] = {{"rz", ""},     {"ry rz", ""},       {"rx ry rz", "rz ry"},
                                      {"ux", ""},     {"uy ry", "rz"},     {"ux uy rz ry", ""},
                                      {"", "uz"},     {"uz rx ry rz", ""}, {"", "uy ux rz rx ry"},
                                      {"rx rz", "ry"}};

static void release(scene *s, int member, int end, const char *words)
{
    for (const char *w = words; w[0] != '\0' && w[1] != '\0'; w += w[2] == ' ' ? 3 : 2)
        scene_release_end(s, member, end, (w[0] == 'r' ? SCENE_RX : SCENE_UX) + w[1] - 'x');
}

static void soft_spring(scene *s, int node, double k)
{
    double K[36] = {0};
    for (int i = 0; i < 6; i++)
        K[7 * i] = k * (1 + 0.1 * i);
    scene_add_spring(s, SCENE_NONE, node, K);
}

/* A clamped member to a body, a member from there to a node on a spring; loads of every kind on the
 * second one. */
static void bent(int place, const char *const set[2], scene *s)
{
    static const double sequence[3][3] = {{0, 0, 1}, {0.6, 0.8, 0}, {1, 0, 0}};
    const double y[3] = {0, 1, 0}, across[3] = {0.3, 1, -0.2}, end = 1;
    section_spec spec = section_spec_constants(10, 10);
    spec.density = 1;
    spec.constants =
        (section){.young = 10, .shear_modulus = 10, .A = 30, .Iy = 2, .Iz = 1, .It = 1, .Ip = 3};
    scene_init(s, "bent");
    const int root = scene_add_node(s, 0, 0, 0), body = scene_add_node(s, 1, 0, 0),
              beside = place == ON_NODE ? body : scene_add_attached(s, body, 1.2, -0.3, 0.25),
              tip = scene_add_node(s, 2.1, 0.4, 0.5), profile = scene_add_section(s, &spec);
    scene_hold_all(s, root);
    if (place == ON_ANGLES) {
        scene_node *n = scene_node_at(s, body);
        n->rotation = SCENE_ROTATION_SEQUENCE;
        memcpy(n->axis, sequence, sizeof n->axis);
    }
    scene_add_member(s, root, body, profile, y);
    const int member = scene_add_member(s, beside, tip, profile, across);
    release(s, member, 0, set[0]);
    release(s, member, 1, set[1]);
    soft_spring(s, body, 3);
    soft_spring(s, tip, 4);
    scene_add_load(s, SCENE_FORCE, tip, 0.7, -1.1, 0.4);
    scene_add_load(s, SCENE_MOMENT, body, 3.5, -4, 5);
    for (int i = 0; i < 4; i++) {
        const int kind = i % 2 ? SCENE_DISTRIBUTED_MOMENT : SCENE_DISTRIBUTED;
        scene_load *l = scene_load_at(
            s, scene_add_load(s, (scene_load_kind)kind, member, 0.3 - 0.1 * i, 0.4, -0.5));
        l->follower = i > 1;
        if (kind == SCENE_DISTRIBUTED)
            for (int k = 0; k < 3; k++)
                l->at[k] = 0.1 * (k + 1) - 0.25;
    }
    scene_add_static(s, 1, &end, 1);
}

typedef struct release_subject {
    scene scene;
    model *m;
    run_state run;
    equations eq;
    model_state *s, *moved;
    sparse K;
    int n;
    double A[MOST * MOST], residual[MOST];
} release_subject;

static int prepare(release_subject *t, const char *formulation_name)
{
    const sparse *pattern;
    formulation chosen;
    fault f = {""};
    const int parsed = formulation_parse(formulation_name, &chosen, &f) == STATUS_OK;
    const model_request what = {&t->scene, chosen.type, chosen.option, 1, 0};
    const int good =
        parsed && scene_validate(&t->scene, &f) == STATUS_OK &&
        model_alloc(&what, &t->m, &f) == STATUS_OK &&
        run_state_begin(&t->run, t->m, 1, &f) == STATUS_OK &&
        kinematics_state_alloc(t->m, &t->s, &f) == STATUS_OK &&
        kinematics_state_alloc(t->m, &t->moved, &f) == STATUS_OK &&
        assemble_pattern_of_states(t->m, t->run.patterns, 0, &pattern, &f) == STATUS_OK &&
        sparse_alloc_like(pattern, &t->K, &f) == STATUS_OK;
    gsl_test(!good, "%s: %s", formulation_name, f.text);
    t->eq = (equations){.m = t->m, .run = &t->run};
    t->n = good ? model_sizes(t->m).free : 0;
    gsl_test(t->n > MOST || t->n < 12, "%d coordinates", t->n);
    return good;
}

static void clean(release_subject *t)
{
    sparse_free_values(&t->K);
    kinematics_state_free(t->s);
    kinematics_state_free(t->moved);
    run_state_end(&t->run);
    model_free(t->m);
    scene_free(&t->scene);
}

static void linearised(release_subject *t, const model_state *s, double path)
{
    fault f = {""};
    model_linearisation lin = {.path = path, .K = &t->K, .residual = t->residual};
    gsl_test(linearise_state(&t->eq, &t->run.memory, s, &lin, &f) != STATUS_OK, "linearised: %s",
             f.text);
    memset(t->A, 0, sizeof t->A);
    for (int j = 0; j < t->n; j++)
        for (int k = t->K.column[j]; k < t->K.column[j + 1]; k++)
            t->A[t->K.row[k] * t->n + j] = t->K.value[k];
}

/* Equilibrium under a part of the load: 1 when the corrections fall as with a true tangent. */
static int solve(release_subject *t, double path, const char *what)
{
    int pivot[MOST];
    double size = 1, before = 1;
    for (int count = 0; count < 20 && size > 1e-11; count++) {
        linearised(t, t->s, path);
        gsl_test(dense_lu(t->n, t->A, pivot) != 0, "%s: a singular tangent", what);
        dense_lu_solve(t->n, 1, t->A, pivot, t->residual);
        before = size;
        size = 0;
        for (int k = 0; k < t->n; k++)
            size = fmax(size, fabs(t->residual[k]));
        advance_state(&t->eq, &t->run.memory, t->s, t->residual, path, NULL);
    }
    gsl_test(!(size <= 1e-11), "%s: no equilibrium at %g", what, path);
    gsl_test(!(size <= 100 * before * before + 1e-13), "%s: corrections %.1e after %.1e", what,
             size, before);
    return size <= 1e-11;
}

static void residual_at(release_subject *t, int k, double h, double out[])
{
    double dx[MOST] = {0};
    fault f = {""};
    model_linearisation lin = {.path = 1, .residual = out};
    kinematics_state_copy(t->m, t->s, t->moved);
    dx[k] = h;
    linearise_state(&t->eq, &t->run.memory, t->moved, &lin, &f); /* what advance_state works on */
    advance_state(&t->eq, &t->run.memory, t->moved, dx, 1, NULL);
    linearise_make_compatible(&t->eq, t->moved, &f);
    linearise_state(&t->eq, &t->run.memory, t->moved, &lin, &f);
}

static void derivative(release_subject *t, const char *what)
{
    static const double h = 1e-4;
    double worst = 0, largest = 0;
    linearise_make_compatible(&t->eq, t->s, NULL);
    linearised(t, t->s, 1);
    for (int j = 0; j < t->n; j++) {
        double far[2][MOST], near[2][MOST];
        for (int side = 0; side < 2; side++) {
            residual_at(t, j, side ? h : -h, near[side]);
            residual_at(t, j, side ? 2 * h : -2 * h, far[side]);
        }
        for (int i = 0; i < t->n; i++) {
            const double slope =
                (8 * (near[1][i] - near[0][i]) - (far[1][i] - far[0][i])) / (12 * h);
            worst = fmax(worst, fabs(slope + t->A[i * t->n + j]));
            largest = fmax(largest, fabs(slope));
        }
    }
    gsl_test(!(worst <= 1e-8 * largest), "%s: tangent differs by %.1e of %.1e", what, worst,
             largest);
}

static double turn_of(const release_subject *t, int node)
{
    double phi[3];
    for (int i = 0; i < 3; i++)
        phi[i] = kinematics_component(t->m, t->s, node, SCENE_RX + i);
    return vec3_norm(phi);
}

static void check(const char *formulation_name, int place, const char *const set[2])
{
    release_subject *t = calloc(1, sizeof *t);
    int good = 1;
    char what[120];
    snprintf(what, sizeof what, "%s, %s releases [%s] [%s]", formulation_name, place_name[place],
             set[0], set[1]);
    bent(place, set, &t->scene);
    if (prepare(t, formulation_name)) {
        for (int step = 1; step <= 5 && good; step++)
            good = solve(t, 0.2 * step, what);
        gsl_test(!(turn_of(t, 1) > 0.2), "%s: the body turns by %g", what, turn_of(t, 1));
        if (good)
            derivative(t, what);
    }
    clean(t);
    free(t);
}

int main(void)
{
    static const char *const formulation_name[] = {"geometrically_exact:nodes=2",
                                                   "geometrically_exact:nodes=3", "beamw"};
    for (size_t i = 0; i < sizeof formulation_name / sizeof *formulation_name; i++)
        for (int place = ON_NODE; place < PLACES; place++)
            for (size_t k = 0; k < sizeof sets / sizeof sets[0]; k++)
                check(formulation_name[i], place, sets[k]);
    return gsl_test_summary();
}
