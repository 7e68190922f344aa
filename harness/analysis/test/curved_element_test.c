/* Elements with an initial shape of constant curvature and torsion must have no stress in this
 * shape. Results under loads along straight and curved members must converge with the order of the
 * element. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"

enum { STRAINS = ELEMENT_MAX_STRAINS, INNER = 64, MEMORY = 4096, ARCS = 60, ELEMENT_POINTS = 32 };

typedef struct element_subject {
    const formulation *chosen;
    double length, turn[3], strain[3];
    element_data *data;
    int nodes, strains;
    double inner[INNER];
} element_subject;

static section rectangle(void)
{
    section_spec spec = section_spec_rectangle(210e9, 80.7e9, 0.0371, 0.0123);
    spec.shear_factor[0] = spec.shear_factor[1] = 0.847;
    return sections_computed(&spec);
}

static status prepare(const formulation *chosen, const section *c, double most, uint64_t *state,
                      element_subject *out, fault *f)
{
    const element_type *type = chosen->type;
    memset(out, 0, sizeof *out);
    out->chosen = chosen;
    out->length = 0.05 * (1.5 + random_number(state));
    double curvature[3];
    for (int i = 0; i < 3; i++) {
        out->turn[i] = most / sqrt(3) * random_number(state);
        curvature[i] = out->turn[i] / out->length;
        out->strain[i] = 0.1 * random_number(state);
    }
    if (type->lacks & LACKS_SHEAR_Y)
        out->strain[1] = 0;
    element_request request = {.section = c, .length = out->length, .options = chosen->option};
    request.features = type->offers & ~(unsigned)(FEATURE_WAGNER_TORQUE | FEATURE_ENGESSER);
    memcpy(request.curvature, curvature, sizeof curvature);
    memcpy(request.strain, out->strain, sizeof request.strain);
    out->nodes = element_nodes(type, chosen->option);
    out->strains = element_strains(type, chosen->option);
    out->data = calloc(1, type->data_size(&request));
    const status outcome = type->prepare(&request, out->data, f);
    if (outcome == STATUS_OK && type->rest != NULL)
        type->rest(out->data, out->inner);
    return outcome;
}

/* Computes r = int_0^x R (e_x + strain) dt and R = exp(x turn~) at x by quadrature, where `turn` is
 * the initial curvature. */
static void along_arc(const element_subject *s, double x, const double strain[3], double r[3],
                      double R[9])
{
    double t[ELEMENT_POINTS], w[ELEMENT_POINTS], q[4];
    const double direction[3] = {1 + strain[0], strain[1], strain[2]};
    memset(r, 0, 3 * sizeof *r);
    quadrature_points(ELEMENT_POINTS, t, w);
    for (int g = 0; g <= ELEMENT_POINTS; g++) {
        const double at = g < ELEMENT_POINTS ? x * t[g] : x,
                     part[3] = {s->turn[0] * at, s->turn[1] * at, s->turn[2] * at};
        double axis[3];
        rotation_exp(part, q);
        rotation_matrix(q, R);
        mat3_mul_vec(R, direction, axis);
        if (g < ELEMENT_POINTS)
            for (int i = 0; i < 3; i++)
                r[i] += x * w[g] * axis[i];
    }
}

static void place(const element_subject *s, const double motion[6], node_state x[])
{
    const double none[3] = {0};
    double q[4], turned[9];
    rotation_exp(motion + 3, q);
    rotation_matrix(q, turned);
    memset(x, 0, (size_t)s->nodes * sizeof *x);
    for (int k = 0; k < s->nodes; k++) {
        double free[3], arc[3], r[3], R[9];
        const double at = (double)k / (s->nodes - 1);
        along_arc(s, at, none, arc, R);
        along_arc(s, at, s->strain, free, R);
        mat3_mul(turned, R, x[k].R);
        mat3_mul_vec(turned, free, r);
        for (int i = 0; i < 3; i++) {
            x[k].r[i] = s->length * (r[i] + motion[i]);
            x[k].u[i] = x[k].r[i] - s->length * arc[i];
        }
    }
}

static status stress_at(element_subject *s, const double e[], stress_output *out)
{
    static double memory[MEMORY];
    const element_type *type = s->chosen->type;
    out->memory = type->memory != NULL ? memory : NULL;
    return type->stress(s->data, e, s->inner, out);
}

static double stress_of_arc(element_subject *s, const double motion[6])
{
    node_state x[ELEMENT_MAX_NODES];
    double e[STRAINS], sigma[STRAINS], C[STRAINS * STRAINS], worst = 0;
    place(s, motion, x);
    s->chosen->type->strain(s->data, x, &(strain_output){.e = e});
    if (stress_at(s, e, &(stress_output){.sigma = sigma, .C = C}) != STATUS_OK)
        return INFINITY;
    for (int i = 0; i < s->strains; i++) {
        double stiffness = 0;
        for (int j = 0; j < s->strains; j++)
            stiffness += fabs(C[i * s->strains + j]);
        worst = worst_of(worst, fabs(sigma[i]) / (stiffness * s->length));
    }
    return worst;
}

static double error_of_stress(element_subject *s)
{
    const double h = 1e-5 * s->length;
    double e[STRAINS], sigma[STRAINS], largest = 0, worst = 0;
    for (int i = 0; i < s->strains; i++)
        e[i] = 0.01 * s->length * cos(2.3 * i + 0.7);
    stress_at(s, e, &(stress_output){.sigma = sigma});
    for (int i = 0; i < s->strains; i++) {
        double energy[2];
        for (int k = 0; k < 2; k++) {
            e[i] += k == 0 ? h : -2 * h;
            stress_at(s, e, &(stress_output){.energy = &energy[k]});
        }
        e[i] += h;
        worst = worst_of(worst, fabs((energy[0] - energy[1]) / (2 * h) - sigma[i]));
        largest = fmax(largest, fabs(sigma[i]));
    }
    return worst / largest;
}

static double error_of_geometric(element_subject *s)
{
    const int n = s->strains;
    double e[STRAINS] = {0}, v[STRAINS], sigma[STRAINS] = {0}, C[3][STRAINS * STRAINS],
           G[STRAINS * STRAINS] = {0}, largest = 0, worst = 0;
    stress_at(s, e, &(stress_output){.C = C[0]});
    for (int i = 0; i < n; i++)
        v[i] = s->length * cos(1.9 * i + 0.2);
    dense_mul_vec(n, n, C[0], v, sigma);
    if (s->chosen->type->geometric != NULL)
        s->chosen->type->geometric(s->data, sigma, G);
    for (int k = 1; k < 3; k++) {
        for (int i = 0; i < n; i++)
            e[i] = (k == 1 ? 1e-5 : -1e-5) * v[i];
        stress_at(s, e, &(stress_output){.C = C[k]});
    }
    for (int i = 0; i < n * n; i++) {
        worst = worst_of(worst, fabs((C[1][i] - C[2][i]) / 2e-5 - G[i]));
        largest = fmax(largest, fabs(C[0][i]));
    }
    return worst / largest;
}

static void arcs(const formulation *chosen, const section *c)
{
    const double most = chosen->type->limits & LIMIT_QUARTER_TURN ? 1.5 : 3;
    const double still[6] = {0}, motion[6] = {0.3, -0.2, 0.1, 0.7, -1.1, 0.4};
    uint64_t state = 20240101;
    double stress = 0, derived = 0, geometric = 0;
    fault f = {""};
    element_subject straight;
    const int whole = prepare(chosen, c, 0, &state, &straight, &f) == STATUS_OK &&
                      chosen->type->inner == NULL && error_of_geometric(&straight) < 1e-6;
    free(straight.data);
    for (int i = 0; i < ARCS; i++) {
        element_subject s;
        const status outcome = prepare(chosen, c, most * (i + 1) / ARCS, &state, &s, &f);
        gsl_test(outcome != STATUS_OK, "%s: arc %d: %s", chosen->key, i, f.text);
        if (outcome == STATUS_OK) {
            stress =
                worst_of(stress, worst_of(stress_of_arc(&s, still), stress_of_arc(&s, motion)));
            if (chosen->type->inner == NULL) {
                derived = worst_of(derived, error_of_stress(&s));
                geometric = whole ? worst_of(geometric, error_of_geometric(&s)) : 0;
            }
        }
        free(s.data);
    }
    gsl_test(!(stress < 1e-13), "%s: no stress along any arc up to %g rad (%.1e)", chosen->key,
             most, stress);
    gsl_test(!(derived < 1e-6), "%s: stress from energy about an arc (%.1e)", chosen->key, derived);
    gsl_test(!(geometric < 1e-6), "%s: geometric stiffness about an arc (%.1e)", chosen->key,
             geometric);
}

static void curved_element_tests(void)
{
    const section c = rectangle();
    int offered = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        formulation chosen;
        if (!(type->offers & FEATURE_CURVATURE))
            continue;
        offered++;
        formulation_default(type, &chosen);
        arcs(&chosen, &c);
        for (int k = 0; k < parameter_count(type->options); k++)
            for (int choice = 0; choice < parameter_choices(parameter_at(type->options, k));
                 choice++)
                if (formulation_choice(type, k, choice, &chosen))
                    arcs(&chosen, &c);
    }
    gsl_test(offered == 0, "%d formulations offer initial curvature", offered);
}

extern const element_type element_collocation;

enum { ROOT, TIP, VALUES = 4 };

typedef enum form { STRAIGHT, CURVED, ARC } form;
typedef enum acting { UNIFORM, LINEAR, FOLLOWER, MOMENT } acting;
static const double y_axis[3] = {0, 1, 0}, path[4] = {0.25, 0.5, 0.75, 1};

static void member_of(form shape, scene *s)
{
    const double curved[3] = {0.3, 0.5, 0.8}, arc[3] = {0, 0, 1};
    const section_spec spec = sections_of(shape == ARC ? 1e10 : 1e4, 2, 1, 0.7);
    scene_init(s, "along");
    scene_add_node(s, 0, 0, 0);
    scene_add_node(s, shape == ARC ? sin(1) : 1, shape == ARC ? 1 - cos(1) : 0, 0);
    scene_add_member(s, ROOT, TIP, scene_add_section(s, &spec), y_axis);
    scene_hold_all(s, ROOT);
    if (shape != STRAIGHT)
        memcpy(scene_member_at(s, 0)->curvature, shape == ARC ? arc : curved, sizeof arc);
    scene_omit(s, SCENE_OMITTABLE);
}

static void load_of(acting what, scene *s)
{
    const double last[3] = {-3, -8, 1};
    scene_load *load = scene_load_at(
        s, what == MOMENT ? scene_add_load(s, SCENE_DISTRIBUTED_MOMENT, 0, 0, 0, 4)
                          : scene_add_load(s, SCENE_DISTRIBUTED, 0, what == LINEAR ? 5 : 0, -5, 3));
    load->follower = what == FOLLOWER;
    load->varies = what == LINEAR;
    memcpy(load->last, last, sizeof last);
}

static void values_of(const scene *s, int stages, int n, double out[VALUES])
{
    const double option[ELEMENT_MAX_OPTIONS] = {stages - 3};
    answer a;
    ask_scene(s, &element_collocation, option, n, &a);
    gsl_test(a.outcome != ASK_ANSWERED, "%d stages, n = %d: %s", stages, n, a.reason);
    for (int i = 0; i < VALUES; i++)
        out[i] = a.value[i];
}

static void order_of(const char *name, const scene *s, int stages, int n, double least,
                     double error)
{
    double right[VALUES], found[2][VALUES], worst[2] = {0};
    values_of(s, 8, 12, right);
    for (int k = 0; k < 2; k++) {
        values_of(s, stages, n << k, found[k]);
        for (int i = 0; i < VALUES; i++)
            worst[k] = worst_of(worst[k], fabs(found[k][i] - right[i]));
    }
    const double order = log2(worst[0] / worst[1]);
    gsl_test(!(order > least && worst[0] < error),
             "%s, %d stages: order %.2f of %.1f, error %.1e with n = %d", name, stages, order,
             least, worst[0], n);
}

static void ask_all(scene *s, int analysis)
{
    const int component[] = {SCENE_UX, SCENE_UY, SCENE_UZ};
    for (int i = 0; i < 3; i++) {
        const char name[] = {'u', (char)('x' + i), 0};
        scene_add_quantity(s, name, "m", analysis, scene_coordinate(TIP, component[i]));
    }
    scene_add_quantity(s, "M", "N m", analysis, scene_internal_at(0, 0.5, SCENE_MZ));
}

static void large_rotations(void)
{
    static const struct {
        const char *name;
        form shape;
        acting what;
        double least[2],
            error[2]; /* smallest order and largest error at n = 4, for 3 and 4 stages */
    } scenes[] = {
        {"a uniform load", STRAIGHT, UNIFORM, {5.7, 7.5}, {1e-5, 2e-7}},
        {"a linear one", STRAIGHT, LINEAR, {5.7, 7.5}, {1e-5, 2e-7}},
        {"one along a curved member", CURVED, LINEAR, {5.5, 7}, {1e-5, 2e-7}},
        {"one that follows", STRAIGHT, FOLLOWER, {3.6, 3.6}, {1e-2, 1e-2}},
        {"a moment along", STRAIGHT, MOMENT, {3.6, 3.6}, {1e-2, 1e-2}},
    };
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        scene s;
        member_of(scenes[i].shape, &s);
        load_of(scenes[i].what, &s);
        ask_all(&s, scene_add_static(&s, 4, path, 1));
        for (int k = 0; k < 2; k++)
            order_of(scenes[i].name, &s, 3 + k, 4, scenes[i].least[k], scenes[i].error[k]);
        scene_free(&s);
    }
}

/* Castigliano's theorem for an arc of 1 rad with EI = 1, R = 1 and a downward load of 1 per length.
 * The moment at t is due to the load beyond t, and the displacement of the tip is int M m/EI, where
 * m is the moment due to a unit force at the tip, without axial strain. */
static void arc_by_castigliano(void)
{
    enum { POINTS = 20 };
    double at[POINTS], weight[POINTS], sinks = 0, error[2];
    quadrature_points(POINTS, at, weight);
    for (int i = 0; i < POINTS; i++)
        sinks +=
            weight[i] * (cos(at[i]) - cos(1) - (1 - at[i]) * sin(at[i])) * (sin(1) - sin(at[i]));
    scene s;
    answer a;
    const double option[ELEMENT_MAX_OPTIONS] = {0};
    member_of(ARC, &s);
    scene_add_load(&s, SCENE_DISTRIBUTED, 0, 0, -1, 0);
    scene_add_quantity(&s, "u", "m", scene_add_linear(&s), scene_coordinate(TIP, SCENE_UY));
    for (int k = 0; k < 2; k++) {
        ask_scene(&s, &element_collocation, option, 1 << k, &a);
        error[k] = a.value[0] + sinks;
    }
    gsl_test(!(fabs(error[0]) < 1e-4 && log2(fabs(error[0] / error[1])) > 5.5),
             "an arc of 1 rad: off by %.1e, %.1e", error[0], error[1]);
    scene_free(&s);
}

/* A column under its own weight buckles at q L^3/EI = 7.837347 (Greenhill). */
static void own_weight(void)
{
    const double stations[1] = {1}, option[ELEMENT_MAX_OPTIONS] = {0}, right = 7.83734744;
    const section_spec spec = sections_of(1e8, 50, 1, 50);
    double error[2];
    scene s;
    answer a;
    scene_init(&s, "column");
    scene_add_node(&s, 0, 0, 0);
    scene_add_node(&s, 1, 0, 0);
    scene_add_member(&s, ROOT, TIP, scene_add_section(&s, &spec), y_axis);
    scene_hold_all(&s, ROOT);
    scene_omit(&s, SCENE_OMITTABLE);
    scene_add_load(&s, SCENE_DISTRIBUTED, 0, -1, 0, 0);
    const int state = scene_add_static(&s, 1, stations, 1);
    scene_add_quantity(&s, "q", "1", scene_add_buckling(&s, state), scene_critical_factor(1, 0));
    scene_add_quantity(&s, "linear", "1", scene_add_buckling(&s, SCENE_NONE),
                       scene_critical_factor(1, 0));
    for (int k = 0; k < 2; k++) {
        ask_scene(&s, &element_collocation, option, 2 << k, &a);
        gsl_test(a.outcome != ASK_ANSWERED, "%s", a.reason);
        error[k] = a.value[0] / right - 1;
        gsl_test(!(fabs(a.value[1] / right - 1) < (k ? 3e-4 : 3e-3)),
                 "own weight, linear buckling: off by %.1e", a.value[1] / right - 1);
    }
    gsl_test(!(fabs(error[0]) < 2e-4 && log2(error[0] / error[1]) > 5.5),
             "own weight about a state: off by %.1e, %.1e", error[0], error[1]);
    scene_free(&s);
}

static void along_equilibrium_tests(void)
{
    large_rotations();
    arc_by_castigliano();
    own_weight();
}

int main(void)
{
    curved_element_tests();
    along_equilibrium_tests();
    return gsl_test_summary();
}
