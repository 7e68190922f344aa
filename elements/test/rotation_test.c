/* Compares rotation matrices, products of rotations and the logarithm with their definitions, also
 * for angles near 0 and pi. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "elements/beamw/variants.h"
#include "elements/collocation/collocation.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/sheet/sheet.h"
#include "elements/test/kit.h"

enum { MANY = 11, S = ELEMENT_MAX_STRAINS, X = ELEMENT_MAX_COORDINATES, INNER = 24 };

typedef struct answers {
    double e[S], J[S * X], H[X * X], energy, sigma[S], C[S * S], residual, memory[INNER * S];
    status outcome;
} answers;

typedef struct batch {
    const element_type *type;
    const char *name;
    double option[ELEMENT_MAX_OPTIONS];
    int nodes, strains;
    element_data *kind[2];
    const element_data *data[MANY];
    node_state x[MANY * ELEMENT_MAX_NODES];
    double weight[MANY][S], inner[MANY][INNER];
    answers alone[MANY];
} batch;

static const double batch_length[2] = {0.13, 0.31}; /* [m] */

static element_data *batch_prepare(const element_type *type, const double option[], int kind,
                                   unsigned features)
{
    section_spec spec = section_spec_rectangle(198.7e9, 76.3e9, 0.05, 0.0007);
    const section c = sections_computed(&spec);
    const element_request request = {.section = &c,
                                     .length = batch_length[kind],
                                     .features = features,
                                     .options = option,
                                     .curvature = {0, kind * 0.2, 0.3},
                                     .strain = {0, 0, kind * 1e-3}};
    fault f;
    element_data *d = calloc(1, type->data_size(&request));
    gsl_test(d == NULL || type->prepare(&request, d, &f) != STATUS_OK, "%s: prepared", type->name);
    return d;
}

static void batch_set_up(batch *b, unsigned features)
{
    static const int kind_of[MANY] = {0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1};
    for (int kind = 0; kind < 2; kind++)
        b->kind[kind] = batch_prepare(b->type, b->option, kind, features);
    for (int k = 0; k < MANY; k++) {
        double d[X], weights[X];
        const double size = k == 7 ? 40 : (k % 2 ? 0.3 : 0.003);
        b->data[k] = b->kind[kind_of[k]];
        nodes_increments(b->nodes, batch_length[kind_of[k]], size, 71 + (unsigned)k, d);
        nodes_increments(b->nodes, 1, 2, 171 + (unsigned)k, weights);
        memcpy(b->weight[k], weights, sizeof b->weight[k][0] * (size_t)b->strains);
        nodes_place(b->nodes, batch_length[kind_of[k]], d, b->x + k * b->nodes);
        if (b->type->rest != NULL)
            b->type->rest(b->data[k], b->inner[k]);
        for (int i = 0; i < element_inner(b->type, b->option); i++)
            b->inner[k][i] += 0.1 * size * sin(9.0 * i + k);
        strain_output out = {.e = b->alone[k].e};
        b->type->strain(b->data[k], b->x + k * b->nodes, &out);
    }
}

static void batch_free(batch *b)
{
    free(b->kind[0]);
    free(b->kind[1]);
}

enum { BATCH_FEATURES = 3 };
static unsigned batch_features(int turn)
{
    const unsigned all = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_GEOMETRIC |
                         FEATURE_LARGE | FEATURE_CURVATURE;
    return (const unsigned[]){all, FEATURE_SHEAR | FEATURE_LARGE | FEATURE_WAGNER_TORQUE,
                              all | FEATURE_WAGNER_TORQUE}[turn];
}

/* Returns a batch of elements of this type. The first `options` options are given in option[]; all
 * other options have their defaults. */
static batch batch_of(const element_type *type, const double option[], int options, int turn)
{
    batch b = {.type = type, .name = type->name};
    for (int i = 0; i < options; i++)
        b.option[i] = option[i];
    b.nodes = element_nodes(type, b.option);
    b.strains = element_strains(type, b.option);
    batch_set_up(&b, batch_features(turn));
    return b;
}

static const double eps = 4 * DBL_EPSILON;
static const double axis[3] = {0.48, -0.6, 0.64}; /* unit vector */

static double largest_difference(int n, const double a[], const double b[])
{
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

static void turn(double angle, double q[4])
{
    const double phi[3] = {angle * axis[0], angle * axis[1], angle * axis[2]};
    rotation_exp(phi, q);
}

/* Computes Rodrigues' formula v cos + (axis x v) sin + axis (axis . v)(1 - cos). */
static void rodrigues(double angle, const double v[3], double out[3])
{
    double across[3];
    const double along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    vec3_cross(axis, v, across);
    for (int i = 0; i < 3; i++)
        out[i] = v[i] * cos(angle) + across[i] * sin(angle) +
                 axis[i] * along * 2 * sin(angle / 2) * sin(angle / 2);
}

static void one_angle(double angle)
{
    const double v[3] = {2.385, -1.17, 0.713};
    double q[4], R[9], again[4], phi[3], minus[4], expected[3], found[3], column[3];
    turn(angle, q);
    rodrigues(angle, v, expected);
    rotation_apply(q, v, found);
    gsl_test(!(largest_difference(3, found, expected) < 4 * eps),
             "angle %g: turns a vector as Rodrigues does", angle);
    rotation_matrix(q, R);
    for (int i = 0; i < 3; i++)
        column[i] = R[3 * i] * v[0] + R[3 * i + 1] * v[1] + R[3 * i + 2] * v[2];
    gsl_test(!(largest_difference(3, column, expected) < 4 * eps), "angle %g: so does the matrix",
             angle);
    rotation_from_matrix(R, again);
    const double side =
        again[0] * q[0] + again[1] * q[1] + again[2] * q[2] + again[3] * q[3] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        again[i] *= side;
    gsl_test(!(largest_difference(4, again, q) < 4 * eps),
             "angle %g: the matrix gives the quaternion back, or its negative", angle);

    /* the logarithm is the shorter rotation, for q and for -q, which represent the same rotation */
    const double shorter = remainder(angle, 2 * PI);
    for (int i = 0; i < 3; i++)
        expected[i] = shorter * axis[i];
    for (int i = 0; i < 4; i++)
        minus[i] = -q[i];
    const double allowed = fabs(fabs(shorter) - PI) < 1e-15
                               ? 2 * PI + 1
                               : 8 * eps; /* at pi, the sense of rotation is arbitrary */
    rotation_log(q, phi);
    gsl_test(!(largest_difference(3, phi, expected) < allowed), "angle %g: its vector", angle);
    rotation_log(minus, phi);
    gsl_test(!(largest_difference(3, phi, expected) < allowed),
             "angle %g: the vector of the negative", angle);
    gsl_test(!(vec3_norm(phi) <= PI * (1 + eps)), "angle %g: at most half a turn", angle);
}

static void small_angles(void)
{
    for (double angle = 1; angle > 1e-300; angle /= 7) {
        double q[4], phi[3];
        turn(angle, q);
        rotation_log(q, phi);
        for (int i = 0; i < 3; i++)
            gsl_test_rel(phi[i], angle * axis[i], 8 * eps, "angle %g: exponential and logarithm",
                         angle);
    }
}

static void products(void)
{
    const double first[3] = {0.3, -1.1, 0.7}, second[3] = {-0.9, 0.2, 1.6},
                 v[3] = {0.713, 2.385, -1.17};
    double a[4], b[4], ab[4], back[4], step[4], phi[3], one[3], two[3], both[3];
    rotation_exp(first, a);
    rotation_exp(second, b);
    rotation_compose(a, b, ab);
    rotation_apply(b, v, one);
    rotation_apply(a, one, two);
    rotation_apply(ab, v, both);
    gsl_test(!(largest_difference(3, two, both) < 4 * eps), "a o b turns by b, then by a");
    memcpy(back, a, sizeof a);
    rotation_compose(back, b, back);
    gsl_test(largest_difference(4, back, ab) > 0, "the product may take the place of a factor");
    rotation_conjugate(a, back);
    rotation_apply(back, two, both);
    gsl_test(!(largest_difference(3, both, one) < 4 * eps), "the conjugate turns back");
    rotation_between(a, b, phi);
    rotation_exp(phi, step);
    rotation_compose(step, a, ab);
    const double side = ab[0] * b[0] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        ab[i] *= side;
    gsl_test(!(largest_difference(4, ab, b) < 4 * eps),
             "the increment from a to b, in fixed axes, turns a into b");
}

static void triads(void)
{
    const double x[3] = {2, -3, 6}, y[3] = {1, 1, 1}, parallel[3] = {-4, 6, -12},
                 zero[3] = {0, 0, 0};
    double R[9], q[4], again[9];
    gsl_test_int(rotation_triad(x, y, R), 0, "a triad");
    for (int i = 0; i < 3; i++)
        gsl_test_rel(R[3 * i], x[i] / 7, eps, "its x axis");
    gsl_test(!(R[1] * y[0] + R[4] * y[1] + R[7] * y[2] > 0), "its y axis is on the side of y");
    gsl_test_abs(R[2] * y[0] + R[5] * y[1] + R[8] * y[2], 0, eps, "its z axis is across y");
    rotation_from_matrix(R, q);
    rotation_matrix(q, again);
    gsl_test(!(largest_difference(9, R, again) < 4 * eps), "it is a rotation");
    gsl_test_int(rotation_triad(x, parallel, R), -1, "no triad from parallel vectors");
    gsl_test_int(rotation_triad(zero, y, R), -1, "nor from a vector of length zero");
}

static void rotation_tests(void)
{
    for (double angle = -2 * PI; angle < 2 * PI + 0.1; angle += PI / 16)
        one_angle(angle);
    one_angle(PI - 1e-9);
    one_angle(PI + 1e-9);
    small_angles();
    products();
    triads();
}

enum { POINTS = 16 };

/* Integrates r = int exp(turn s) e ds from 0 to x. The difference r - x e is integrated instead of
 * r, so there is no cancellation. The integrand is (sin w)/w t x e + (1 - cos w)/w^2 t x (t x e),
 * where t = turn s and w = |t|. */
static void integrate(const double turn[3], const double e[3], double x, double across[3])
{
    double at[POINTS], weight[POINTS];
    quadrature_points(POINTS, at, weight);
    across[0] = across[1] = across[2] = 0;
    for (int i = 0; i < POINTS; i++) {
        const double s = x * at[i], part[3] = {turn[0] * s, turn[1] * s, turn[2] * s},
                     w = vec3_norm(part), half = sin(w / 2);
        double once[3], twice[3];
        vec3_cross(part, e, once);
        vec3_cross(part, once, twice);
        for (int k = 0; k < 3; k++)
            across[k] += x * weight[i] *
                         (w > 0 ? sin(w) / w * once[k] + 2 * half * half / (w * w) * twice[k] : 0);
    }
}

static void compare(double angle, double x)
{
    static const double direction[][3] = {{0, 0, 1}, {0, 1, 0}, {0.6, 0, 0.8}, {0, 0.6, -0.8}},
                        e[] = {1.01, 0, 0}, sheared[] = {0.98, 0.03, -0.02};
    for (int i = 0; i < 4; i++)
        for (int shear = 0; shear < 2; shear++) {
            const double *along = shear ? sheared : e;
            double turn[3], r[3], q[4], exact[3], right[4], worst = 0, turned = 0;
            for (int k = 0; k < 3; k++)
                turn[k] = angle * direction[i][k];
            arc_at(turn, along, x, r, q);
            integrate(turn, along, x, exact);
            const double size = vec3_norm(exact), digits = 1e-15 * x * 2;
            for (int k = 0; k < 3; k++)
                worst = fmax(worst, fabs(r[k] - x * along[k] - exact[k]));
            gsl_test(!(worst <= 2e-12 * size + digits), "%g rad, at %g: off by %.1e of %.1e", angle,
                     x, worst, size);
            const double part[3] = {turn[0] * x, turn[1] * x, turn[2] * x};
            rotation_exp(part, right);
            for (int k = 0; k < 4; k++)
                turned = fmax(turned, fabs(q[k] - right[k]));
            gsl_test(!(turned < 1e-15), "%g rad, at %g: orientation off by %.1e", angle, x, turned);
            double back[3], away = 0;
            arc_to(part, r, back);
            for (int k = 0; k < 3; k++)
                away = fmax(away, fabs(back[k] - x * along[k]));
            gsl_test(!(away < 2e-15 * x), "%g rad, to %g: direction off by %.1e", angle, x, away);
        }
}

static void arc_tests(void)
{
    static const double angle[] = {0,   1e-12, 1e-8, 1e-6, 9e-5, 1.1e-4, 1e-3, 0.01,
                                   0.1, 0.25,  0.29, 0.31, 0.5,  1,      2,    3},
                        x[] = {0.1, 0.5, 1};
    for (size_t i = 0; i < sizeof angle / sizeof angle[0]; i++)
        for (int k = 0; k < 3; k++)
            compare(angle[i], x[k]);
}

extern const element_type element_sheet_second, element_sheet_second_consistent,
    element_sheet_third, element_sheet_third_printed;

typedef void equations_function(int count, const element_data *const data[], const node_state x[],
                                const double *const e[], const double *const inner[],
                                const double *const s[], equations_output out[], status outcome[]);

static const struct {
    const element_type *type;
    equations_function *equations;
} family[] = {{&element_sheet_second, sheet_lanes_second_equations_plain},
              {&element_sheet_second_consistent, sheet_lanes_second_equations_plain},
              {&element_sheet_third, sheet_lanes_third_equations_plain},
              {&element_sheet_third_printed, sheet_lanes_third_equations_plain}};

typedef struct whole {
    double J[S * X], C[S * S], incompatibility[S], sigma[S], force[X], present[X], K[X * X];
    status outcome;
} whole;

static void alone_of(const batch *b, int k, const double e[], int tangent, whole *out)
{
    const int n = b->strains, columns = NODE_COORDINATES * b->nodes;
    double more[S], work[S * X];
    memset(out, 0, sizeof *out);
    strain_output strain = {.e = out->incompatibility,
                            .J = out->J,
                            .s = tangent ? b->weight[k] : NULL,
                            .H = tangent ? out->K : NULL};
    stress_output stress = {.sigma = out->sigma, .C = out->C};
    b->type->strain(b->data[k], b->x + k * b->nodes, &strain);
    out->outcome = b->type->stress(b->data[k], e, NULL, &stress);
    for (int i = 0; i < n; i++)
        out->incompatibility[i] -= e[i];
    dense_mul_vec(n, n, out->C, out->incompatibility, more);
    for (int i = 0; i < n; i++)
        out->sigma[i] += more[i];
    dense_add_transpose_mul(columns, n, 1, out->J, out->sigma, out->force);
    dense_add_transpose_mul(columns, n, 1, out->J, b->weight[k], out->present);
    if (tangent)
        dense_add_congruence(n, columns, out->J, out->C, out->K, work);
}

static int differs(const whole *a, const whole *b)
{
    const double *p = a->J, *q = b->J;
    int different = a->outcome != b->outcome;
    for (size_t i = 0; i < offsetof(whole, outcome) / sizeof *p && a->outcome == STATUS_OK; i++)
        different |= p[i] != q[i];
    return different;
}

static void equations(batch *b, equations_function *many, int first, int count, int tangent)
{
    equations_output out[MANY];
    const double *e[MANY] = {NULL}, *s[MANY] = {NULL}, *inner[MANY] = {NULL};
    double at[MANY][S];
    status outcome[MANY];
    static whole together[MANY], alone;
    int different = 0;
    memset(together, 0, sizeof together);
    for (int k = 0; k < count; k++) {
        whole *w = &together[k];
        for (int i = 0; i < b->strains; i++)
            at[k][i] = 0.93 * b->alone[first + k].e[i];
        e[k] = at[k];
        s[k] = b->weight[first + k];
        out[k] = (equations_output){.J = w->J,
                                    .C = w->C,
                                    .incompatibility = w->incompatibility,
                                    .sigma = w->sigma,
                                    .force = w->force,
                                    .present = w->present,
                                    .K = tangent ? w->K : NULL};
    }
    many(count, b->data + first, b->x + first * b->nodes, e, inner, s, out, outcome);
    for (int k = 0; k < count; k++) {
        together[k].outcome = outcome[k];
        alone_of(b, first + k, e[k], tangent, &alone);
        different += differs(&alone, &together[k]);
    }
    gsl_test_int(different, 0, "%s: elements of other equations, %d at once, tangent %d", b->name,
                 count, tangent);
}

static void compare_equations(batch *b, equations_function *many)
{
    for (int count = 1; count <= MANY; count++)
        for (int first = 0; first + count <= MANY; first++)
            for (int tangent = 0; tangent < 2; tangent++)
                equations(b, many, first, count, tangent);
}

static void lanes_equations_tests(void)
{
    for (size_t i = 0; i < sizeof family / sizeof family[0]; i++)
        for (int k = 0; k < BATCH_FEATURES; k++) {
            batch b = batch_of(family[i].type, NULL, 0, k);
            compare_equations(&b, b.type->equations_many);
            b.name = "without AVX2";
            compare_equations(&b, family[i].equations);
            batch_free(&b);
        }
}

extern const element_type element_beamw, element_beamw_vlasov, element_beamw_first,
    element_beamw_consistent;
extern const element_type element_sheet_second, element_sheet_second_consistent,
    element_sheet_third, element_sheet_third_printed, element_collocation,
    element_geometrically_exact;

typedef void strains_function(int count, const element_data *const data[], const node_state x[],
                              strain_output out[]);
typedef void stresses_function(int count, const element_data *const data[], const double *const e[],
                               const double *const inner[], stress_output out[], status outcome[]);

static const struct {
    const element_type *type;
    strains_function *strain;
    stresses_function *stress;
    double option[3];
} lanes_family[] = {
    {&element_beamw, beamw_lanes_modes_plain, beamw_lanes_modified_plain, {0}},
    {&element_beamw_vlasov, beamw_lanes_modes_plain, beamw_lanes_modified_plain, {0}},
    {&element_beamw_first, beamw_lanes_modes_plain, beamw_lanes_modified_plain, {0}},
    {&element_beamw_consistent, beamw_lanes_helicoidal_plain, beamw_lanes_consistent_plain, {0}},
    {&element_beamw_consistent,
     beamw_lanes_helicoidal_plain,
     beamw_lanes_consistent_plain,
     {0, 0, 1}},
    {&element_beamw_consistent,
     beamw_lanes_helicoidal_plain,
     beamw_lanes_consistent_plain,
     {0, 1, 1}},
    {&element_sheet_second, sheet_lanes_strain_plain, sheet_lanes_second_plain, {0}},
    {&element_sheet_second_consistent, sheet_lanes_strain_plain, sheet_lanes_second_plain, {0}},
    {&element_sheet_third, sheet_lanes_strain_plain, sheet_lanes_third_plain, {0}},
    {&element_sheet_third_printed, sheet_lanes_strain_plain, sheet_lanes_third_plain, {0}},
    {&element_collocation, exact_lanes_stages_strain_plain, exact_lanes_stages_stress_plain, {2}},
    {&element_collocation, exact_lanes_stages_strain_plain, exact_lanes_stages_stress_plain, {5}},
    {&element_geometrically_exact,
     exact_lanes_gauss_strain_plain,
     exact_lanes_gauss_stress_plain,
     {0}},
    {&element_geometrically_exact,
     exact_lanes_gauss_strain_plain,
     exact_lanes_gauss_stress_plain,
     {1}},
};

static strain_output strain_of(const batch *b, int k, answers *a, int what)
{
    return (strain_output){.e = what & 1 ? a->e : NULL,
                           .J = what & 2 ? a->J : NULL,
                           .s = what & 4 ? b->weight[k] : NULL,
                           .H = what & 4 ? a->H : NULL};
}

static stress_output stress_of(const batch *b, answers *a, int what)
{
    return (stress_output){.energy = what & 1 ? &a->energy : NULL,
                           .sigma = what & 2 ? a->sigma : NULL,
                           .C = what & 4 ? a->C : NULL,
                           .residual = what & 1 ? &a->residual : NULL,
                           .memory = what & 4 && b->type->memory != NULL ? a->memory : NULL};
}

static void strains(batch *b, strains_function *many, int first, int count, int what)
{
    strain_output out[MANY];
    answers together[MANY], alone;
    int different = 0;
    memset(together, 0, sizeof together);
    for (int k = 0; k < count; k++)
        out[k] = strain_of(b, first + k, &together[k], what);
    many(count, b->data + first, b->x + first * b->nodes, out);
    for (int k = 0; k < count; k++) {
        memset(&alone, 0, sizeof alone);
        strain_output one = strain_of(b, first + k, &alone, what);
        b->type->strain(b->data[first + k], b->x + (first + k) * b->nodes, &one);
        different += memcmp(&alone, &together[k], sizeof alone) != 0;
    }
    gsl_test_int(different, 0, "%s: elements of other strains, %d at once, wanted %d", b->name,
                 count, what);
}

static void stresses(batch *b, stresses_function *many, int first, int count, int what)
{
    stress_output out[MANY];
    const double *e[MANY] = {NULL}, *inner[MANY] = {NULL};
    status outcome[MANY];
    answers together[MANY], alone;
    int different = 0;
    memset(together, 0, sizeof together);
    for (int k = 0; k < count; k++) {
        out[k] = stress_of(b, &together[k], what);
        e[k] = b->alone[first + k].e;
        inner[k] = b->inner[first + k];
    }
    many(count, b->data + first, e, inner, out, outcome);
    for (int k = 0; k < count; k++) {
        memset(&alone, 0, sizeof alone);
        stress_output one = stress_of(b, &alone, what);
        const status ended = b->type->stress(b->data[first + k], e[k], inner[k], &one);
        different += ended != outcome[k] ||
                     (ended == STATUS_OK && memcmp(&alone, &together[k], sizeof alone) != 0);
    }
    gsl_test_int(different, 0, "%s: elements of other stresses, %d at once, wanted %d", b->name,
                 count, what);
}

static void lanes_compare(batch *b, strains_function *strain, stresses_function *stress)
{
    for (int what = 1; what < 8; what++)
        for (int count = 1; count <= MANY; count++)
            for (int first = 0; first + count <= MANY; first += 3) {
                if (strain != NULL)
                    strains(b, strain, first, count, what);
                if (stress != NULL)
                    stresses(b, stress, first, count, what);
            }
}

static void lanes_tests(void)
{
    for (size_t i = 0; i < sizeof lanes_family / sizeof lanes_family[0]; i++)
        for (int k = 0; k < BATCH_FEATURES; k++) {
            batch b = batch_of(lanes_family[i].type, lanes_family[i].option, 3, k);
            lanes_compare(&b, b.type->strain_many, b.type->stress_many);
            b.name = "without AVX2";
            lanes_compare(&b, lanes_family[i].strain, lanes_family[i].stress);
            batch_free(&b);
        }
}

int main(void)
{
    rotation_tests();
    arc_tests();
    lanes_equations_tests();
    lanes_tests();
    return gsl_test_summary();
}
