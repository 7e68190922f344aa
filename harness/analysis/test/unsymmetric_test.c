/* Small motions about states with an unsymmetric stiffness: columns under a follower load at the
 * tip, compared with Beck's characteristic equation and LAPACK. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "harness/analysis/analysis_impl.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/numerics/test/matrices.h"
#include "harness/study/study.h"

/* Clamped column of length 1, EI = 1, mass 1, with an additional mass at its tip, in `planes`
 * uncoupled planes. The stiffness in the second plane is `ratio` times that in the first, and the
 * compressive force P follows the tip. */
typedef struct checked_column {
    sparse K, M, C;
} checked_column;

static void add_plane(int elements, int planes, int plane, double P, double stiffness, double tip,
                      double eta, checked_column *c)
{
    double k[16], g[16], m[16];
    const int n = 2 * elements;
    sparse *const all[] = {&c->K, &c->M, &c->C};
    matrices_beam(1.0 / elements, k, g, m);
    for (int e = 0; e < elements; e++)
        for (int a = 0; a < 4; a++)
            for (int b = 0; b < 4; b++) {
                const int i = 2 * e + a - 2, j = 2 * e + b - 2, at = 4 * a + b;
                const double value[] = {stiffness * k[at] - P * g[at], m[at],
                                        eta * stiffness * k[at]};
                for (int which = 0; i >= 0 && j >= 0 && which < 3; which++)
                    all[which]->value[(plane * n + j) * planes * n + plane * n + i] += value[which];
            }
    const int w = plane * n + n - 2, turn = w + 1;
    c->K.value[turn * planes * n + w] += P;
    c->M.value[w * planes * n + w] += tip;
}

static void column_init(int elements, int planes, double P, double ratio, double tip, double eta,
                        checked_column *c)
{
    const int n = 2 * elements * planes;
    double *full = calloc((size_t)n * (size_t)n, sizeof *full);
    for (int i = 0; i < n * n; i++)
        full[i] = 1;
    c->K = matrices_from_dense(n, 0, full);
    c->M = matrices_from_dense(n, 0, full);
    c->C = matrices_from_dense(n, 0, full);
    memset(c->K.value, 0, (size_t)(n * n) * sizeof(double));
    memset(c->M.value, 0, (size_t)(n * n) * sizeof(double));
    memset(c->C.value, 0, (size_t)(n * n) * sizeof(double));
    for (int plane = 0; plane < planes; plane++)
        add_plane(elements, planes, plane, P, plane == 0 ? 1 : ratio, tip, eta, c);
    free(full);
}

static void column_free(checked_column *c)
{
    matrices_free(&c->K);
    matrices_free(&c->M);
    matrices_free(&c->C);
}

static void solve(const checked_column *c, int damped, int wanted, unsymmetric_result *r)
{
    matrix_factor *fa = NULL;
    fault f = {""};
    factor_alloc(&c->K, &fa, &f);
    gsl_test_int((int)factor_numeric(fa, &c->K, &f), STATUS_OK, "%s", f.text);
    const unsymmetric_problem p = {.K = &c->K,
                                   .M = &c->M,
                                   .C = damped ? &c->C : NULL,
                                   .K_factor = fa,
                                   .wanted = wanted,
                                   .estimate = 1};
    gsl_test_int((int)unsymmetric_solve(&p, r, &f), STATUS_OK, "%s", f.text);
    factor_free(fa);
}

/* Returns (w2^2 - w1^2)^2/4, where w1 and w2 are the first two circular frequencies; negative
 * beyond the load at which they coincide. */
static double difference(double P, int elements, double tip)
{
    checked_column c;
    unsymmetric_result r;
    column_init(elements, 1, P, 1, tip, 0, &c);
    solve(&c, 0, 4, &r);
    const double a = r.frequency[0] * r.frequency[0], b = r.frequency[1] * r.frequency[1];
    const double imaginary = 2 * r.frequency[0] * r.growth[0];
    const double value = r.growth[0] != 0 ? -imaginary * imaginary : (b - a) * (b - a) / 4;
    unsymmetric_free(&r);
    column_free(&c);
    return value;
}

/* Returns the load at which two frequencies coincide, found by bisection and then by linear
 * interpolation on the unstable side. */
static double flutter_load(double low, double high, int elements, double tip)
{
    while (high - low > 1e-3 * high) {
        const double middle = (low + high) / 2;
        if (difference(middle, elements, tip) < 0)
            high = middle;
        else
            low = middle;
    }
    double a = high, b = high * 1.001, fa = difference(a, elements, tip),
           fb = difference(b, elements, tip);
    for (int i = 0; i < 3; i++) {
        const double at = a + 0.99 * (a - b) * fa / (fb - fa);
        b = a;
        fb = fa;
        a = at;
        fa = difference(a, elements, tip);
    }
    return a + (a - b) * fa / (fb - fa);
}

static void columns(void)
{
    gsl_test_rel(flutter_load(15, 25, 2, 0), 20.1924, 1e-5, "two elements");
    gsl_test_rel(flutter_load(15, 25, 8, 0), 20.0543, 1e-5, "eight elements");
    gsl_test_rel(flutter_load(15, 25, 32, 0), 20.0509536, 2e-6, "Beck");
    gsl_test_rel(flutter_load(12, 25, 16, 0.1), 17.59528, 2e-5, "Pflueger 0.1");
    gsl_test_rel(flutter_load(12, 25, 16, 1), 16.21213, 2e-5, "Pflueger 1");
}

static void near_flutter(void)
{
    static const double load[] = {19, 20.05, 20.0509, 20.052, 20.1, 22};
    for (size_t i = 0; i < sizeof load / sizeof load[0]; i++)
        for (int planes = 1; planes <= 2; planes++) {
            static const double ratio[] = {1, 1 + 1e-9, 1 + 1e-4};
            for (int k = 0; k < 3; k++) {
                checked_column c;
                unsymmetric_result r;
                column_init(32, planes, load[i], ratio[k], 0, 0, &c);
                solve(&c, 0, 4 * planes, &r);
                int growing = 0;
                for (int j = 0; j < r.count; j++)
                    growing += r.growth[j] > 0;
                gsl_test_int(r.count, 4 * planes, "load %g: modes", load[i]);
                const int expected = load[i] > 20.051 ? planes : 0;
                if (planes == 1 || k < 2)
                    gsl_test_int(growing, expected,
                                 "load %g, ratio %.9g: growing modes of %d planes", load[i],
                                 ratio[k], planes);
                const double mean =
                    (r.frequency[0] * r.frequency[0] + r.frequency[planes] * r.frequency[planes] -
                     r.growth[0] * r.growth[0] - r.growth[planes] * r.growth[planes]) /
                    2;
                if (planes == 1 && fabs(load[i] - 20.051) < 2e-3)
                    gsl_test_rel(sqrt(mean), 11.01556, 5e-5, "mean of those that meet");
                gsl_test(!(r.error[0] > 0 && r.error[0] < 1e-2), "estimate %g", r.error[0]);
                unsymmetric_free(&r);
                column_free(&c);
            }
        }
}

static void damped(void)
{
    static const double load[] = {10.9, 10.97, 20};
    for (int i = 0; i < 3; i++) {
        checked_column c;
        unsymmetric_result r;
        double growth = -INFINITY;
        column_init(16, 1, load[i], 1, 0, 1e-3, &c);
        solve(&c, 1, 3, &r);
        for (int j = 0; j < r.count; j++)
            growth = fmax(growth, r.growth[j]);
        gsl_test((growth > 0) != (load[i] > 10.94), "load %g: growth %g with damping", load[i],
                 growth);
        unsymmetric_free(&r);
        column_free(&c);
    }
}

static void unloaded(void)
{
    static const double root[] = {1.8751040687, 4.6940911330, 7.8547574382, 10.995540735};
    checked_column c;
    unsymmetric_result r;
    column_init(32, 2, 0, 1, 0, 0, &c);
    solve(&c, 0, 8, &r);
    gsl_test_int(r.count, 8, "two planes");
    for (int i = 0; i < 8; i++) {
        gsl_test_rel(r.frequency[i], root[i / 2] * root[i / 2], 1e-5, "frequency %d", i);
        gsl_test(r.growth[i] != 0, "growth %d: %g", i, r.growth[i]);
    }
    unsymmetric_free(&r);
    column_free(&c);
}

static void unsymmetric_tests(void)
{
    columns();
    near_flutter();
    damped();
    unloaded();
}

enum { AS, SUPPORT, LOADED };
enum { POINTS, AT_HUB, BESIDE };
enum { FREE, HINGED };
enum { MASSES = 4, MODES = 4 };

static const parameter_type parameter[] = {
    [AS] = {"as", "", 0, 0, 0, "points|hub|beside", "how the body is described"},
    [SUPPORT] = {"support", "", 0, 0, 0, "free|hinged", "how it turns"},
    [LOADED] = {"loaded", "1", 1, 0, 1, NULL, "1: frequencies about a loaded state too"},
    {0},
};

static const double mass[MASSES] = {0.31, 0.17, 0.23, 0.41}, hub_at[3] = {0.53, 0.11, -0.07},
                    point[MASSES][3] = {{0.61, 0.05, 0.03},
                                        {0.47, 0.19, -0.01},
                                        {0.58, 0.13, -0.16},
                                        {0.66, 0.02, -0.09}};

static scene_body body_of_points(const double from[3])
{
    scene_body b = {0};
    double centre[3] = {0};
    for (int k = 0; k < MASSES; k++) {
        b.mass += mass[k];
        for (int i = 0; i < 3; i++)
            centre[i] += mass[k] * point[k][i];
    }
    for (int i = 0; i < 3; i++) {
        centre[i] /= b.mass;
        b.centre[i] = centre[i] - from[i];
    }
    for (int k = 0; k < MASSES; k++)
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, l = (i + 2) % 3;
            const double x = point[k][i] - centre[i], y = point[k][j] - centre[j],
                         z = point[k][l] - centre[l];
            b.inertia[i] += mass[k] * (y * y + z * z);
            b.inertia[3 + i] -= mass[k] * x * y;
        }
    return b;
}

static void add_body(scene *s, int hub, int as)
{
    if (as == POINTS)
        for (int k = 0; k < MASSES; k++)
            scene_set_body(s, scene_add_attached(s, hub, point[k][0], point[k][1], point[k][2]),
                           (scene_body){.mass = mass[k]});
    if (as == AT_HUB)
        scene_set_body(s, hub, body_of_points(hub_at));
    if (as == BESIDE)
        scene_set_body(s, scene_add_attached(s, hub, point[2][0], point[2][1], point[2][2]),
                       body_of_points(point[2]));
}

static void add_frequencies(scene *s, int analysis, const char *stem)
{
    for (int i = 0; i < MODES; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "%s_%d", stem, i);
        scene_add_quantity(s, name, "Hz", analysis, scene_frequency(i, SCENE_ANY));
    }
}

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[3] = {0.1, 1, 0.2}, end = 1;
    (void)f;
    section_spec spec = section_spec_rectangle(2.1e11, 8e10, 0.02, 0.004);
    spec.density = 7800;
    const int profile = scene_add_section(s, &spec), root = scene_add_node(s, 0, 0, 0),
              hub = scene_add_node(s, hub_at[0], hub_at[1], hub_at[2]),
              tip = scene_add_attached(s, hub, 0.5, 0.08, 0.02);
    scene_add_member(s, root, tip, profile, y_axis);
    scene_hold_all(s, root);
    if (value[SUPPORT] == HINGED) {
        scene_node *n = scene_node_at(s, hub);
        n->rotation = SCENE_ROTATION_SEQUENCE;
        memcpy(n->axis[0], (const double[3]){0.2, 1, 0.3}, sizeof n->axis[0]);
        memcpy(n->axis[1], (const double[3]){0.7, -0.1, 1}, sizeof n->axis[1]);
    }
    add_body(s, hub, (int)value[AS]);
    scene_add_load(s, SCENE_FORCE, tip, 0, 11, 17);
    add_frequencies(s, scene_add_modal(s, SCENE_NONE), "rest");
    if (value[LOADED] != 0)
        add_frequencies(s, scene_add_modal(s, scene_add_static(s, 1, &end, 4)), "loaded");
    const int rotation =
        scene_add_rotation(s, 1, &end, 8, 2 * MODES,
                           (scene_rotating_frame){.omega = {3, -7, 11}, .centre = {-0.3, 0.2, 0}});
    add_frequencies(s, rotation, "turning");
    scene_add_quantity(s, "moved", "m", rotation, scene_coordinate(tip, SCENE_UY));
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "reaction_%d", c);
        scene_add_quantity(s, name, c < SCENE_RX ? "N" : "N m", rotation, scene_reaction(root, c));
    }
    return STATUS_OK;
}

static const case_type with_body = {.name = "with_body",
                                    .summary = "a case of the test",
                                    .source = "none",
                                    .parameters = {parameter},
                                    .build = build};

static void body_solve(const char *chosen, int as, int support, int loaded, cell_result *r)
{
    cell_request request = {.type = &with_body, .elements = 3};
    formulation fm;
    fault f = {""};
    gsl_test(formulation_parse(chosen, &fm, &f) != STATUS_OK, "%s exists", chosen);
    request.parameter[AS] = as;
    request.parameter[SUPPORT] = support;
    request.parameter[LOADED] = loaded;
    request.formulation = fm.type;
    request.solve.newton = formulation_newton(&fm);
    memcpy(request.option, fm.option, sizeof request.option);
    gsl_test(cell_run(&request, r, &f) != STATUS_OK, "%s solved: %s", chosen, f.text);
    gsl_test_int(r->solve.quantities, (2 + loaded) * MODES + 7, "%s: all quantities", chosen);
}

static void compare(const cell_result *a, const cell_result *b, double allowed, const char *what)
{
    for (int i = 0; i < a->solve.quantities && i < b->solve.quantities; i++)
        gsl_test_rel(b->solve.quantity[i].value, a->solve.quantity[i].value, allowed, "%s: %s",
                     what, a->scene.quantity[i].name);
}

static void descriptions(const char *chosen, int support)
{
    static const char *const as[] = {"points", "one body at the hub", "one body beside it"};
    cell_result points, other;
    body_solve(chosen, POINTS, support, 1, &points);
    for (int i = AT_HUB; i <= BESIDE; i++) {
        char what[120];
        snprintf(what, sizeof what, "%s, support %d, %s", chosen, support, as[i]);
        body_solve(chosen, i, support, 1, &other);
        compare(&points, &other, 1e-9, what);
        cell_result_free(&other);
    }
    cell_result_free(&points);
}

static void algorithms(void)
{
    static const char *const form[] = {"collocation:newton=dense",
                                       "collocation:newton=displacement"};
    cell_result mixed, other;
    body_solve("collocation", AT_HUB, FREE, 0, &mixed);
    for (int i = 0; i < 2; i++) {
        body_solve(form[i], AT_HUB, FREE, 0, &other);
        compare(&mixed, &other, 1e-8, form[i]);
        cell_result_free(&other);
    }
    cell_result_free(&mixed);
}

static void body_tests(void)
{
    static const char *const chosen[] = {"geometrically_exact", "beamw_consistent", "collocation"};
    for (int i = 0; i < 3; i++)
        for (int support = FREE; support <= HINGED; support++)
            descriptions(chosen[i], support);
    algorithms();
}

enum { ELEMENTS = 24, MEMBERS = 2, MOST_WAVES = 5, TURN_Y = 4, TURN_Z = 5, WARPING = 6 };
static const double length = 2;

static int make(const double R[9], scene *s, model **m)
{
    fault f = {""};
    section_spec spec = section_spec_rectangle(2e11, 8e10, 0.2, 0.1);
    scene_init(s, "made_up");
    const double y[3] = {R[1], R[4], R[7]};
    const int profile = scene_add_section(s, &spec);
    for (int i = 0; i < MEMBERS; i++) {
        const int p = scene_add_node(s, 5 * i, 0, 0),
                  q = scene_add_node(s, 5 * i + length * R[0], length * R[3], length * R[6]);
        scene_add_member(s, p, q, profile, y);
    }
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
    scene_add_modal(s, SCENE_NONE);
    const model_request request = {s, formulation_find("geometrically_exact"), NULL, ELEMENTS, 1,
                                   0};
    const status made = model_alloc(&request, m, &f);
    gsl_test(made != STATUS_OK, "two members: %s", f.text);
    return made == STATUS_OK;
}

/* Adds a sine with the given number of half-waves to component k, in the axes of the member, at all
 * nodes of the member. */
static void add(const model *m, const double R[9], int member, int k, int waves, double size,
                double x[])
{
    int vertex[2 * ELEMENTS + 1];
    const int count = model_member_vertices(m, member, vertex);
    for (int i = 0; i < count; i++) {
        const double value = size * sin(waves * PI * (i + 0.3) / (count - 1 + 0.6));
        const mesh_vertex *v = model_vertex(m, vertex[i]);
        if (k < WARPING)
            for (int c = 0; c < 3; c++)
                x[v->coordinate[3 * (k / 3) + c]] += R[3 * c + k % 3] * value;
        else
            for (int e = model_first_element(m, member); e < model_first_element(m, member + 1);
                 e++)
                for (int end = 0; end < model_nodes(m); end++)
                    if (model_element(m, e)->vertex[end] == vertex[i])
                        x[model_warp(m, model_element(m, e)->warp[end])] = value;
    }
}

typedef struct modes_part {
    int component, waves;
    double size;
} modes_part;

static void modes_compare(const model *m, const scene *s, const double R[9], int parts,
                          const modes_part *p, scene_family family, int half_waves,
                          const char *what)
{
    double *x = calloc((size_t)model_all_coordinates(m) + 1, sizeof *x);
    mode_shape shape = {SCENE_ANY, 0};
    fault f = {""};
    for (int i = 0; i < parts; i++)
        for (int member = 0; member < MEMBERS; member++)
            add(m, R, member, p[i].component, p[i].waves + member, p[i].size, x);
    gsl_test(modes_identify(m, s, x, &shape, &f) != STATUS_OK, "%s: %s", what, f.text);
    gsl_test(shape.family != family, "%s: %s", what, modes_family_name(shape.family));
    gsl_test_int(shape.half_waves, half_waves, "%s: half-waves", what);
    free(x);
}

static void in_direction(const double R[9])
{
    static const scene_family moved[] = {SCENE_AXIAL, SCENE_BENDING_Y, SCENE_BENDING_Z,
                                         SCENE_TORSION};
    scene s;
    model *m = NULL;
    if (make(R, &s, &m)) {
        const section *c = model_section(m, 0);
        const double r = sqrt(c->Ip / c->A);
        for (int waves = 1; waves <= MOST_WAVES; waves++) {
            for (int k = 0; k < 4; k++)
                modes_compare(m, &s, R, 1, &(modes_part){k, waves, 1e-3}, moved[k], waves,
                              "one motion");
            for (int k = 0; k < 4; k++)
                for (int other = 0; other < 4; other++)
                    if (other != k)
                        modes_compare(
                            m, &s, R, 2,
                            (modes_part[]){{k, waves, k == 3 ? 1 / r : 1},
                                           {other, waves + 2, other == 3 ? 0.8 / r : 0.8}},
                            moved[k], waves, "the larger of two motions");
            static const int turn[] = {TURN_Z, TURN_Y, WARPING};
            const double unit[] = {1 / r, 1 / r, 1 / (r * r)};
            for (int k = 0; k < 3; k++) {
                modes_compare(m, &s, R, 1, &(modes_part){turn[k], waves, 1}, moved[k + 1], waves,
                              "in place");
                for (int other = 0; other < 3; other++)
                    if (other != k)
                        modes_compare(m, &s, R, 2,
                                      (modes_part[]){{turn[k], waves, unit[k]},
                                                     {turn[other], waves + 2, 0.8 * unit[other]}},
                                      moved[k + 1], waves, "the larger of two turns in place");
                modes_compare(m, &s, R, 2,
                              (modes_part[]){{turn[k], waves, unit[k]}, {1, waves + 1, 1e-3}},
                              moved[1], waves + 1, "the least motion counts before turns");
                modes_compare(m, &s, R, 2,
                              (modes_part[]){{turn[k], waves, unit[k]}, {1, waves + 1, 1e-12}},
                              moved[k + 1], waves, "but for round-off");
            }
        }
    }
    model_free(m);
    scene_free(&s);
}

static void families(void)
{
    for (int family = SCENE_AXIAL; family <= SCENE_TORSION; family++)
        for (int waves = 1; waves <= 3; waves++) {
            const mode_shape shape = {(scene_family)family, waves};
            for (int requested = SCENE_ANY; requested <= SCENE_TORSION; requested++)
                for (int half_waves = 0; half_waves <= 3; half_waves++) {
                    const scene_mode wanted = {.family = (scene_family)requested,
                                               .half_waves = half_waves};
                    const int fits = requested == SCENE_ANY || requested == family ||
                                     (requested == SCENE_NOT_AXIAL && family != SCENE_AXIAL);
                    gsl_test_int(modes_in_family(&wanted, &shape),
                                 fits && (half_waves == 0 || half_waves == waves),
                                 "family %d with %d half-waves, asked for %d with %d", family,
                                 waves, requested, half_waves);
                }
        }
}

static void modes_tests(void)
{
    static const double along[][3] = {{1, 0, 0}, {0, 0, 1}, {1, -2, 3}},
                        beside[][3] = {{0, 1, 0}, {1, 0, 0}, {3, 1, 1}};
    for (int i = 0; i < 3; i++) {
        double R[9];
        rotation_triad(along[i], beside[i], R);
        in_direction(R);
    }
    families();
}

int main(void)
{
    unsymmetric_tests();
    body_tests();
    modes_tests();
    return gsl_test_summary();
}
