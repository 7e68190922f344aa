/* Released ends in a rotated state: the tangent must be the derivative of the forces within 1e-8,
 * for any release, node position and load on the member. Also tests sizes of corrections, condensed
 * members, and access to the outcomes of analyses. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/test/ended.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/tools/kit/cells.h"

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
    const model_request what = {&t->scene, chosen.type, chosen.option, 1, 0, 0};
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

/* Solves for equilibrium under a fraction of the load and checks that the corrections decrease
 * quadratically, as with an exact tangent. Returns 1 if there is equilibrium. */
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
    linearise_state(&t->eq, &t->run.memory, t->moved, &lin, &f);
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

static void release_tests(void)
{
    static const char *const formulation_name[] = {"geometrically_exact:nodes=2",
                                                   "geometrically_exact:nodes=3", "beamw"};
    for (size_t i = 0; i < sizeof formulation_name / sizeof *formulation_name; i++)
        for (int place = ON_NODE; place < PLACES; place++)
            for (size_t k = 0; k < sizeof sets / sizeof sets[0]; k++)
                check(formulation_name[i], place, sets[k]);
}

static const double length = 2;

static int warping_member(const element_type *type, int first, int last, scene *s, model **m)
{
    const double y[3] = {0, 1, 0}, end = 1;
    fault f = {""};
    section_spec spec = section_spec_rectangle(1e4, 4e3, 0.2, 0.05);
    scene_init(s, "member");
    const int p = scene_add_node(s, 0, 0, 0), q = scene_add_node(s, length, 0, 0);
    scene_add_member(s, p, q, scene_add_section(s, &spec), y);
    if (first <= last)
        scene_hold(s, q, first, last);
    scene_add_static(s, 1, &end, 1);
    const model_request request = {s, type, NULL, 3, 0, 0};
    const status made = model_alloc(&request, m, &f);
    gsl_test(made != STATUS_OK, "%s: %s", type->name, f.text);
    return made == STATUS_OK;
}

static double size_of(model *m, int coordinate, double step)
{
    const model_size size = model_sizes(m);
    const size_t n = (size_t)(size.free + size.driven);
    double *dx = calloc(n, sizeof *dx), *residual = calloc(n, sizeof *residual), out = NAN;
    model_state *s;
    fault f = {""};
    run_state run;
    model_linearisation lin = {.residual = residual};
    run_state_begin(&run, m, 1, NULL);
    equations eq = {.m = m, .run = &run};
    if (kinematics_state_alloc(m, &s, &f) == STATUS_OK &&
        linearise_state(&eq, &run.memory, s, &lin, &f) == STATUS_OK) {
        dx[coordinate] = step;
        out = advance_state(&eq, &run.memory, s, dx, 0, NULL);
    }
    run_state_end(&run);
    kinematics_state_free(s);
    free(dx);
    free(residual);
    return out;
}

static void corrections(const element_type *type)
{
    scene s;
    model *m = NULL;
    const double step = 1e-5;
    if (warping_member(type, SCENE_UX, SCENE_RZ, &s, &m)) {
        int translations = 0, turns = 0, amplitudes = 0;
        const int n = model_sizes(m).free;
        for (int k = 0; k < n; k++) {
            const double size = size_of(m, k, step) / step;
            const int translation = fabs(size * length - 1) < 1e-9, turn = fabs(size - 1) < 1e-9,
                      warp = fabs(size - length) < 1e-9;
            gsl_test(type->inner != NULL ? !(size > 0.4 / length) : translation + turn + warp != 1,
                     "%s: coordinate %d counts as %g", type->name, k, size);
            gsl_test(!isnan(size_of(m, k, NAN)), "%s: coordinate %d may be no number", type->name,
                     k);
            translations += translation;
            turns += turn;
            amplitudes += warp;
        }
        gsl_test(type->inner == NULL && turns != translations, "%s: as many turns as translations",
                 type->name);
        gsl_test(type->inner == NULL && (type->offers & FEATURE_WARPING) && amplitudes == 0,
                 "%s: amplitudes of warping count", type->name);
    }
    model_free(m);
    scene_free(&s);
}

static double strain_of(const equations *eq, model_state *s)
{
    double worst = 0;
    fault f = {""};
    gsl_test(linearise_make_compatible(eq, s, &f) != STATUS_OK, "turned: %s", f.text);
    for (int k = 0; k < model_elements(eq->m) * model_strains(eq->m); k++)
        worst = fmax(worst, fabs(s->e[k]));
    return worst;
}

static int driven_member(const element_type *type, scene *s, model **m)
{
    static const char *const name[3] = {"x", "y", "z"};
    static const double station[2] = {0, 4}, angle[2] = {0, 1};
    const double y[3] = {0, 1, 0};
    fault f = {""};
    section_spec spec = section_spec_rectangle(1e4, 4e3, 0.2, 0.05);
    scene_init(s, "driven");
    const int p = scene_add_node(s, 0, 0, 0), body = scene_add_node(s, 60, -90, 30),
              q = scene_add_attached(s, body, length, 0, 0);
    scene_node_at(s, body)->rotation = SCENE_ROTATION_VECTOR;
    for (int c = 0; c < 3; c++)
        scene_node_at(s, body)->angle[c] = scene_add_driver(s, name[c], 2, station, angle);
    scene_add_member(s, p, q, scene_add_section(s, &spec), y);
    scene_add_static(s, 1, station + 1, 1);
    const model_request request = {s, type, NULL, 3, 0, 0};
    const status made = model_alloc(&request, m, &f);
    gsl_test(made != STATUS_OK, "%s: %s", type->name, f.text);
    return made == STATUS_OK;
}

/* Moves all vertices as one rigid body, by an increment and by an extrapolation. */
static void move_rigidly(const equations *eq, const double dx[], model_state *state[3])
{
    const model *m = eq->m;
    double *residual = calloc((size_t)model_all_coordinates(m), sizeof *residual);
    fault f = {""};
    model_linearisation lin = {.residual = residual};
    const model_state *const last[] = {state[0], state[1]};
    gsl_test(linearise_state(eq, &eq->run->memory, state[1], &lin, &f) != STATUS_OK, "at rest: %s",
             f.text);
    advance_state(eq, &eq->run->memory, state[1], dx, 1, NULL);
    gsl_test(!extrapolate_state(eq, 2, last, 2, state[2]), "extrapolated");
    for (int i = 1; i < 3; i++) {
        const double strain = strain_of(eq, state[i]);
        gsl_test(!(strain < 1e-13), "%s: a rigid motion strains by %.1e", model_type(m)->name,
                 strain);
    }
    free(residual);
}

static void rigid_motion(const element_type *type)
{
    static const double turn[3] = {0.5, -0.7, 0.9}, shift[3] = {0.3, -0.2, 0.4};
    scene s;
    model *m = NULL;
    model_state *state[3];
    run_state run;
    fault f = {""};
    if (driven_member(type, &s, &m) && run_state_begin(&run, m, 1, &f) == STATUS_OK) {
        const equations eq = {.m = m, .run = &run};
        double *dx = calloc((size_t)model_all_coordinates(m), sizeof *dx);
        for (int i = 0; i < 3; i++)
            gsl_test(kinematics_state_alloc(m, &state[i], &f) != STATUS_OK, "%s", f.text);
        for (int v = 0; v < model_vertices(m); v++) {
            double along[3];
            if (model_vertex(m, v)->body != v)
                continue;
            vec3_cross(turn, model_vertex(m, v)->position, along);
            for (int c = 0; c < 3; c++) {
                dx[model_vertex(m, v)->coordinate[c]] = along[c] + shift[c];
                dx[model_vertex(m, v)->coordinate[3 + c]] = turn[c];
            }
        }
        move_rigidly(&eq, dx, state);
        for (int i = 0; i < 3; i++)
            kinematics_state_free(state[i]);
        free(dx);
        run_state_end(&run);
    }
    model_free(m);
    scene_free(&s);
}

static void loose_about_the_far_end(const element_type *type)
{
    scene s;
    model *m = NULL;
    const double arm[3] = {length, 0, 0};
    if (warping_member(type, SCENE_UX, SCENE_UZ, &s, &m)) {
        int node = -1;
        double motion[6], there[3];
        gsl_test(!supports_loose_part(m, &node, motion) || node != 0, "%s: it is loose",
                 type->name);
        vec3_cross(motion + 3, arm, there);
        for (int i = 0; i < 3; i++)
            gsl_test_abs(motion[i] + there[i], 0, 1e-12, "%s: the held end stays, direction %d",
                         type->name, i);
        gsl_test(!(vec3_norm(motion + 3) > 1e-3), "%s: it turns", type->name);
    }
    model_free(m);
    scene_free(&s);
}

static void advance_tests(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        corrections(registry_formulations[i]);
        rigid_motion(registry_formulations[i]);
    }
    loose_about_the_far_end(registry_formulations[0]);
}

static const char *const formulations[] = {"beamw", "sheet_third", "geometrically_exact:nodes=3",
                                           "collocation"};
/* IN_PIECES: elements of pieces of two elements, and of one */
enum {
    FORMULATIONS = sizeof formulations / sizeof formulations[0],
    NEVER = 1000000,
    IN_PIECES = 9
};

static void shorten(const case_type *type, double parameter[])
{
    const int time = parameter_index(type->parameters, "time");
    if (time >= 0)
        parameter[time] /= 5;
}

static status test_condensation_solve(const case_type *type, const char *of, int elements,
                                      int condensed, cell_result *out)
{
    cell_request request = cells_of(type, of, elements);
    fault f = {""};
    shorten(type, request.parameter);
    request.solve.condensed = condensed;
    return cell_run(&request, out, &f);
}

/* Returns the largest magnitude of the quantities with this unit, the reference of differences. */
static double scale_of(const cell_result *r, const char *unit)
{
    double largest = 0;
    for (int i = 0; i < r->solve.quantities; i++)
        if (strcmp(r->scene.quantity[i].unit, unit) == 0 &&
            r->solve.quantity[i].status == STATUS_OK)
            largest = fmax(largest, fabs(r->solve.quantity[i].value));
    return largest;
}

static int compare(const char *name, const char *of, const cell_result *a, const cell_result *b)
{
    int compared = 0;
    for (int i = 0; i < a->solve.quantities; i++) {
        const quantity_result *p = &a->solve.quantity[i], *q = &b->solve.quantity[i];
        const scene_quantity *what = &a->scene.quantity[i];
        gsl_test(p->status != q->status, "%s, %s, %s: %s", name, of, what->name, q->reason);
        if (p->status != STATUS_OK || q->status != STATUS_OK)
            continue;
        const double apart = fabs(p->value - q->value),
                     size = fabs(p->value) + 1e-3 * scale_of(a, what->unit);
        gsl_test(!(apart <= 1e-7 * size), "%s, %s, %s: %.10g assembled, %.10g condensed", name, of,
                 what->name, p->value, q->value);
        compared++;
    }
    return compared;
}

static int both_ways(const case_type *type, const char *of, int elements)
{
    cell_result assembled, condensed;
    const status one = test_condensation_solve(type, of, elements, NEVER, &assembled),
                 other = test_condensation_solve(type, of, elements, 1, &condensed);
    gsl_test(one != other, "%s, %s: solved both ways", type->name, of);
    const int compared = one == STATUS_OK && other == STATUS_OK
                             ? compare(type->name, of, &assembled, &condensed)
                             : 0;
    cell_result_free(&assembled);
    cell_result_free(&condensed);
    return compared;
}

static void cases(void)
{
    int compared = 0;
    for (int i = 0; registry_cases[i] != NULL; i++) {
        for (int k = 0; k < FORMULATIONS; k++)
            compared += both_ways(registry_cases[i], formulations[k], 2);
        compared += both_ways(registry_cases[i], formulations[i % FORMULATIONS], IN_PIECES);
    }
    gsl_test(compared < 500, "%d values of cases were compared", compared);
}

static status hinged(const double value[], scene *s, fault *f)
{
    const double y[3] = {0, 1, 0}, end = 1;
    section_spec spec = section_spec_rectangle(2e11, 8e10, 0.02, 0.001);
    (void)value;
    (void)f;
    scene_init(s, "hinged");
    const int root = scene_add_node(s, 0, 0, 0), body = scene_add_node(s, 0.1, 0, 0),
              beside = scene_add_attached(s, body, 0.11, 0.01, 0.005),
              tip = scene_add_node(s, 0.2, 0.02, 0), leaf = scene_add_section(s, &spec);
    scene_hold_all(s, root);
    scene_hold(s, tip, SCENE_UX, SCENE_RX);
    scene_add_member(s, root, body, leaf, y);
    const int second = scene_add_member(s, beside, tip, leaf, y);
    scene_release_end(s, second, 0, SCENE_RZ);
    scene_release_end(s, second, 1, SCENE_UX);
    scene_add_load(s, SCENE_FORCE, body, 0.5, 1, 0.3);
    scene_add_load(s, SCENE_FORCE, beside, 0, 0.4, 0.3);
    const int path = scene_add_static(s, 1, &end, 3);
    for (int i = 0; i < 6; i++)
        scene_add_quantity(s, (const char *[]){"ux", "uy", "uz", "rx", "ry", "rz"}[i],
                           i < 3 ? "m" : "rad", path, scene_coordinate(body, i));
    return STATUS_OK;
}

static void released(void)
{
    static const parameter_type none[] = {{0}};
    const case_type type = {.name = "hinged",
                            .summary = "a case of the test",
                            .source = "none",
                            .parameters = {none},
                            .build = hinged};
    int compared = 0;
    for (int k = 0; k < FORMULATIONS; k++)
        compared += both_ways(&type, formulations[k], 3);
    gsl_test(compared < 12, "%d values with released ends were compared", compared);
}

static void many(const case_type *type)
{
    cell_result few, more;
    const status one = test_condensation_solve(type, "beamw_consistent", 128, 0, &few),
                 other = test_condensation_solve(type, "beamw_consistent", 4000, 0, &more);
    gsl_test(one != STATUS_OK || other != STATUS_OK, "%s: solved with 4000 elements", type->name);
    gsl_test(more.counters.iterations > few.counters.iterations + 5,
             "%s: %ld iterations with 4000 elements, %ld with 128", type->name,
             more.counters.iterations, few.counters.iterations);
    for (int i = 0; i < few.solve.quantities && one == STATUS_OK && other == STATUS_OK; i++)
        gsl_test_rel(more.solve.quantity[i].value, few.solve.quantity[i].value, 2e-5, "%s, %s",
                     type->name, few.scene.quantity[i].name);
    cell_result_free(&few);
    cell_result_free(&more);
}

static void condensation_tests(void)
{
    int found = 0;
    cases();
    released();
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (strcmp(registry_cases[i]->name, "c_cantilever") == 0) {
            many(registry_cases[i]);
            found = 1;
        }
    gsl_test(!found, "c_cantilever is there");
}

static void handed_over(status outcome, int rounding, const char *reason, const char *said)
{
    double *mu = malloc(sizeof *mu), *mode = malloc(sizeof *mode), *error = malloc(sizeof *error);
    eigen_side from = {.count = 1,
                       .mu = mu,
                       .mode = mode,
                       .error = error,
                       .status = outcome,
                       .rounding = rounding};
    analysis_outcome o = {.kind = SCENE_BUCKLING};
    outcome_side *side = &o.left.spectrum.positive;
    snprintf(from.reason, sizeof from.reason, "%s", reason);
    outcome_take(&from, side);
    gsl_test(side->count != 1 || side->value != mu || side->mode != mode || side->error != error ||
                 side->status != outcome,
             "'%s': what was found", reason);
    gsl_test(from.mu != NULL || from.mode != NULL || from.error != NULL,
             "'%s': it is not freed twice", reason);
    gsl_test(said == NULL ? side->reason[0] != '\0' : strstr(side->reason, said) == NULL,
             "'%s', %d lost: says '%s'", reason, rounding, side->reason);
    outcome_free(&o);
}

static void read_displacements(const void *o)
{
    outcome_displacements(o, 0);
}
static void read_spectrum(const void *o)
{
    outcome_spectrum_of(o);
}
static void read_path(const void *o)
{
    outcome_path_of(o);
}
static void read_compliance(const void *o)
{
    outcome_compliance_of(o);
}
static void read_rotation(const void *o)
{
    outcome_rotation_of(o);
}
static void read_continuation(const void *o)
{
    outcome_continuation_of(o);
}
static void read_walk(const void *o)
{
    analysis_outcome copy = *(const analysis_outcome *)o;
    outcome_walk(&copy);
}

static void by_kind(void)
{
    enum { KINDS = SCENE_ROTATION + 1 };
    static const struct {
        const char *name;
        void (*read)(const void *);
        unsigned kinds;
    } row[] = {
        {"displacements", read_displacements, 1 << SCENE_LINEAR},
        {"spectrum", read_spectrum, 1 << SCENE_BUCKLING | 1 << SCENE_MODAL},
        {"path", read_path,
         1 << SCENE_STATIC | 1 << SCENE_COMPLIANCE | 1 << SCENE_CONTINUATION | 1 << SCENE_ROTATION},
        {"compliance", read_compliance, 1 << SCENE_COMPLIANCE},
        {"rotation", read_rotation, 1 << SCENE_ROTATION},
        {"continuation", read_continuation, 1 << SCENE_CONTINUATION},
        {"walk", read_walk, 1 << SCENE_STATIC | 1 << SCENE_ROTATION},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        for (int kind = 0; kind < KINDS; kind++)
            gsl_test_int(
                ended_by(row[i].read, &(analysis_outcome){.kind = (scene_analysis_kind)kind}),
                row[i].kinds >> kind & 1 ? 0 : SIGABRT, "%s of kind %d", row[i].name, kind);
}

static void outcome_tests(void)
{
    by_kind();
    handed_over(STATUS_OK, 0, "", NULL);
    handed_over(STATUS_OK, 1, "", "round-off");
    handed_over(STATUS_OK, 3, "", "round-off");
    handed_over(STATUS_NOT_CONVERGED, 0, "2 are missing", "2 are missing");
    handed_over(STATUS_NOT_CONVERGED, 1, "2 are missing", "2 are missing");
}

int main(void)
{
    release_tests();
    advance_tests();
    condensation_tests();
    outcome_tests();
    return gsl_test_summary();
}
