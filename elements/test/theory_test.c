/* Compares the energies of elements with those on the pages of the elements. */
#include <gsl/gsl_integration.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/collocation/collocated.h"
#include "elements/element.h"
#include "elements/geometrically_exact/exact.h"
#include "elements/math/dense.h"
#include "elements/math/real.h"
#include "elements/math/scalar.h"
#include "elements/test/kit.h"

extern const element_type element_beamw, element_beamw_first, element_beamw_vlasov,
    element_sheet_second, element_sheet_second_consistent;

enum { E = 8, STATES = 5, GAUSS = 5 };

static double energy_of(const element_type *type, const section *c, double l, unsigned features,
                        const double e[E])
{
    double options[ELEMENT_MAX_OPTIONS] = {0}, energy = NAN;
    fault f = {""};
    parameter_defaults(type->options, options);
    const element_request request = {
        .section = c, .length = l, .features = features, .options = options};
    element_data *data = calloc(1, type->data_size(&request));
    gsl_test(data == NULL || type->prepare(&request, data, &f) != STATUS_OK, "%s (%s)", type->name,
             f.text);
    gsl_test(type->stress(data, e, NULL, &(stress_output){.energy = &energy}) != STATUS_OK, "%s",
             type->name);
    free(data);
    return energy;
}

/* Computes J Eq. 66 with the indices 1 to 8 of the paper. ebar[7] and ebar[8] are not modified. */
static void modified(const section *c, double l, const double e[E + 1], double ebar[E + 1])
{
    const double A = (e[7] - e[8]) / 2, t = e[2] - (e[7] + e[8]) / 2, l3 = l * l * l;
    memcpy(ebar, e, (E + 1) * sizeof *e);
    ebar[1] += (2 * e[3] * e[3] + e[3] * e[4] + 2 * e[4] * e[4] + 2 * e[5] * e[5] + e[5] * e[6] +
                2 * e[6] * e[6]) /
                   (30 * l) +
               c->Ip / c->A / (2 * l3) * (e[2] * e[2] + A * A / 3 + t * t / 5) -
               (c->ys * c->ys + c->zs * c->zs) / (10 * l3) * e[2] * e[2];
    ebar[2] += (e[4] * e[5] - e[3] * e[6]) / l;
    ebar[3] +=
        (e[2] * (e[5] / 10 + e[6] / 5) + e[5] * (e[7] / 10 - e[8] / 30) - e[6] * e[8] / 30) / l;
    ebar[4] += (-e[2] * (e[5] / 5 + e[6] / 10) + (e[5] + e[6]) * e[7] / 30 - e[6] * e[8] / 10) / l;
    ebar[5] +=
        (-e[2] * (e[3] / 10 + e[4] / 5) - e[3] * (e[7] / 10 - e[8] / 30) + e[4] * e[8] / 30) / l;
    ebar[6] += (e[2] * (e[3] / 5 + e[4] / 10) - (e[3] + e[4]) * e[7] / 30 + e[4] * e[8] / 10) / l;
}

/* Phi[3] are the shear parameters for y, z and w. */
static double squares(const section *c, double l, const double Phi[3], const double b[E + 1])
{
    const double l2 = l * l, l3 = l2 * l, A = (b[7] - b[8]) / 2, G = c->shear_modulus;
    const double inertia[3] = {c->Iz, c->Iy, c->Iw};
    const double h[3] = {(b[5] - b[6]) / (2 * l) - c->zs / l2 * b[2],
                         (b[4] - b[3]) / (2 * l) + c->ys / l2 * b[2],
                         (b[2] - (b[7] + b[8]) / 2) / l2};
    double sum = c->young * c->A / l * b[1] * b[1] + G * c->It / l3 * (b[2] * b[2] + A * A / 3) +
                 c->young / l3 * (c->Iy * pow(b[3] + b[4], 2) + c->Iz * pow(b[5] + b[6], 2)) +
                 4 * c->young * c->Iw / (l2 * l3) * A * A +
                 G * c->It * l / (5 * pow(1 + Phi[2], 2)) * h[2] * h[2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum +=
                (i == j ? 12 * c->young * inertia[i] / (l * (1 + Phi[i]))
                        : G * l * c->D[3 * i + j] * Phi[i] * Phi[j] / (1 + Phi[i]) / (1 + Phi[j])) *
                h[i] * h[j];
    return sum / 2;
}

static void beamw(void)
{
    static const double point[4][2] = {{0, 0}, {-0.03, 0.01}, {-0.03, 0.07}, {0.01, 0.08}},
                        thickness[3] = {0.004, 0.003, 0.005};
    const section_spec spec = section_spec_walls(207e9, 79e9, 3, point, NULL, thickness);
    const section c = sections_computed(&spec);
    const unsigned rigid = FEATURE_WARPING | FEATURE_ECCENTRIC | FEATURE_TRAPEZE;
    const double l = 0.31, none[3] = {0}, inertia[3] = {c.Iz, c.Iy, c.Iw};
    double Phi[3], e[E + 1] = {0}, ebar[E + 1];
    uint64_t seed = 1;
    for (int i = 0; i < 3; i++)
        Phi[i] = 12 * c.young * inertia[i] / (c.shear_modulus * c.D[4 * i] * l * l);
    for (int state = 0; state < STATES; state++) {
        for (int i = 1; i <= E; i++)
            e[i] = 0.2 * l * random_number(&seed);
        modified(&c, l, e, ebar);
        gsl_test_rel(energy_of(&element_beamw, &c, l, rigid | FEATURE_SHEAR, e + 1),
                     squares(&c, l, Phi, ebar), 1e-13, "beamw");
        gsl_test_rel(energy_of(&element_beamw_first, &c, l, rigid | FEATURE_SHEAR, e + 1),
                     squares(&c, l, Phi, e), 1e-13, "beamw_first");
        gsl_test_rel(energy_of(&element_beamw_vlasov, &c, l, rigid, e + 1),
                     squares(&c, l, none, ebar), 1e-13, "beamw_vlasov");
    }
}

static double sheet_energy(const section *c, double l, const double e[E + 1])
{
    const double l3 = l * l * l, G = c->shear_modulus, sum = e[7] + e[8],
                 square = e[7] * e[7] + e[8] * e[8], product = e[7] * e[8];
    const double Phi_y = 12 * c->young * c->Iz * c->F[0] / (G * l * l),
                 Phi_z = 12 * c->young * c->Iy * c->F[4] / (G * l * l);
    double x[GAUSS], w[GAUSS],
        P = c->young * c->A / (2 * l) * e[1] * e[1] +
            c->young * c->Iy / (2 * l3) *
                (pow(e[3] + e[4], 2) + 3 / (1 + Phi_z) * pow(e[3] - e[4], 2)) +
            c->young * c->Iz / (2 * l3) *
                (pow(e[5] + e[6], 2) + 3 / (1 + Phi_y) * pow(e[5] - e[6], 2)) +
            G * c->It / (30 * l3) * (18 * e[2] * e[2] - 3 * e[2] * sum + 2 * square - product) +
            c->young * c->Iw / (l3 * l * l) *
                (6 * e[2] * e[2] - 6 * e[2] * sum + 2 * square + 2 * product);
    quadrature_points(GAUSS, x, w);
    for (int i = 0; i < GAUSS; i++) {
        const double k = (6 * x[i] * (1 - x[i]) * e[2] + (1 - x[i]) * (1 - 3 * x[i]) * e[7] +
                          x[i] * (3 * x[i] - 2) * e[8]) /
                         (l * l);
        P += w[i] * l * c->young * c->wagner_torque * pow(k, 4);
    }
    return P;
}

static void sheets(void)
{
    section_spec spec = section_spec_rectangle(198.7e9, 76.3e9, 0.1, 0.00225);
    spec.sheet_warping = 1;
    spec.shear_factor[0] = spec.shear_factor[1] = 0.853;
    const section c = sections_computed(&spec);
    const unsigned features =
        FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE;
    const double l = 0.12;
    double e[E + 1] = {0};
    uint64_t seed = 2;
    for (int state = 0; state < STATES; state++) {
        for (int i = 1; i <= E; i++)
            e[i] = 0.2 * l * random_number(&seed);
        gsl_test_rel(energy_of(&element_sheet_second, &c, l, features, e + 1),
                     sheet_energy(&c, l, e), 1e-13, "sheet_second");
        gsl_test_rel(energy_of(&element_sheet_second_consistent, &c, l, features, e + 1),
                     sheet_energy(&c, l, e), 1e-13, "sheet_second_consistent");
    }
}

static void theory_tests(void)
{
    beamw();
    sheets();
}

extern const element_type element_collocation;

enum { OUTER = EXACT_STAGES_OUTER, UNKNOWNS = EXACT_STAGES_UNKNOWNS, MOST = EXACT_STAGES_MAX };

static exact_stages strip(int stages, unsigned features)
{
    section_spec spec = section_spec_rectangle(200e9, 80e9, 0.05, 0.002);
    const section c = sections_computed(&spec);
    exact_stages s;
    fault f;
    const element_request request = {
        .section = &c, .length = 0.1, .features = features, .type = &element_collocation};
    gsl_test(exact_stages_prepare(&request, stages, &s, &f), "an element of %d stages", stages);
    return s;
}

static double departure(const double a[], const double b[])
{
    double worst = 0;
    for (int i = 0; i < OUTER; i++)
        for (int j = 0; j < OUTER; j++) {
            const double scale = sqrt(fabs(b[i * (OUTER + 1)] * b[j * (OUTER + 1)])),
                         apart = fabs(a[i * OUTER + j] - b[i * OUTER + j]);
            if (apart != 0)
                worst = worst_of(worst, apart / scale);
        }
    return worst;
}

static status stress(const exact_stages *s, const double e[], const double inner[],
                     stress_output *out)
{
    status outcome;
    exact_collocated_stress(s, 1, &e, &inner, out, &outcome);
    return outcome;
}

static void both(int stages, unsigned features)
{
    const exact_stages s = strip(stages, features);
    uint64_t seed = 7;
    double e[OUTER], inner[UNKNOWNS], worst = 0, following = 0;
    int definite = 1;
    for (int round = 0; round < 20; round++) {
        static exact_collocated plain, exchanged;
        for (int i = 0; i < OUTER; i++)
            e[i] = 0.003 * random_number(&seed);
        for (int i = 0; i < s.unknowns; i++)
            inner[i] = (i < 3 ? 3 : 0.0005) * random_number(&seed);
        exact_collocated_evaluate(stages, &s, e, inner, NULL, plain.A);
        exact_blocks_eliminate(stages, stages + 3, stages + 1, plain.A, plain.V, plain.d);
        definite &= exact_blocks_definite(stages, plain.A, plain.d, 0);
        memcpy(exchanged.A, plain.A, sizeof plain.A);
        gsl_test(exact_collocated_exchange(stages, OUTER + 1, 0, &exchanged),
                 "with exchange of rows");
        double C[2][OUTER * OUTER];
        for (int i = 0; i < OUTER; i++)
            for (int j = 0; j < OUTER; j++) {
                C[0][i * OUTER + j] = exact_collocated_entry(stages, &plain, i, j, 0);
                C[1][i * OUTER + j] = exact_collocated_entry(stages, &exchanged, i, j, 0);
            }
        worst = worst_of(worst, departure(C[0], C[1]));
        for (int J = 0; J < 3; J++) {
            exact_blocks_solve(stages, stages + 1, stages + J, plain.V, plain.X[J]);
            double apart = 0, scale = 0;
            for (int i = 0; i < stages; i++)
                for (int j = 0; j < 9; j++) {
                    scale = fmax(scale, fabs(exchanged.X[J][i][j]));
                    apart = worst_of(apart, fabs(plain.X[J][i][j] - exchanged.X[J][i][j]));
                }
            following = worst_of(following, apart / scale);
        }
    }
    gsl_test(!definite, "%d stages: nothing to exchange in moderate states", stages);
    gsl_test(!(worst < 1e-11), "%d stages: C with and without exchange (%.1e)", stages, worst);
    gsl_test(!(following < 1e-7), "%d stages: unknowns follow alike (%.1e)", stages, following);
}

static void compressed(int stages)
{
    const exact_stages s = strip(stages, FEATURE_SHEAR | FEATURE_LARGE);
    const double e[OUTER] = {0};
    double inner[UNKNOWNS] = {0}, low = 0, high = 100, C[4][OUTER * OUTER];
    static exact_collocated w;
    int lost = 0;
    while (high - low > 4e-16 * high && high - low > 0) {
        const double middle = (low + high) / 2;
        if (!(middle > low) || !(middle < high))
            break;
        inner[0] = -middle;
        exact_collocated_evaluate(stages, &s, e, inner, NULL, w.A);
        exact_blocks_eliminate(stages, stages + 3, stages + 1, w.A, w.V, w.d);
        lost = !exact_blocks_definite(stages, w.A, w.d, 0);
        *(lost ? &high : &low) = middle;
    }
    gsl_test(!(fabs(high / (M_PI * M_PI) - 1) < 0.02), "%d stages: held ends buckle at %.6f EI/l^2",
             stages, high);
    const double at[4] = {low, high, high * (1 - 1e-8), high * (1 + 1e-8)};
    for (int i = 0; i < 4; i++) {
        inner[0] = -at[i];
        gsl_test(stress(&s, e, inner, &(stress_output){.C = C[i]}), "%d stages: stress", stages);
    }
    for (int i = 0; i < OUTER * OUTER; i++)
        C[2][i] = (C[2][i] + C[3][i]) / 2;
    for (int i = 0; i < 2; i++) {
        const double worst = departure(C[i], C[2]);
        gsl_test(!(worst < 1e-4), "%d stages: C where a pivot %s (%.1e)", stages,
                 i == 0 ? "is almost lost" : "vanishes", worst);
    }
}

static void collocated_tests(void)
{
    for (int stages = 3; stages <= MOST; stages++) {
        both(stages, FEATURE_SHEAR | FEATURE_WARPING | FEATURE_TRAPEZE | FEATURE_LARGE);
        both(stages, FEATURE_LARGE);
        compressed(stages);
    }
}

enum { W = CONGRUENCE_WIDEST };

typedef void add_function(int m, int n, const double *J, const double *S, double *K);

static void plain_loops(int m, int n, const double *J, const double *S, double *K)
{
    double SJ[W * W];
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++) {
            SJ[i * n + j] = 0;
            for (int l = 0; l < m; l++)
                SJ[i * n + j] += S[i * m + l] * J[l * n + j];
        }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            for (int l = 0; l < m; l++)
                K[i * n + j] += J[l * n + i] * SJ[l * n + j];
}

static void fill(uint64_t *seed, int count, double v[])
{
    for (int i = 0; i < count; i++)
        v[i] = random_number(seed);
}

static void compare(const char *name, add_function *add)
{
    uint64_t seed = 5;
    int different = 0;
    for (int m = 1; m <= W; m++)
        for (int n = 1; n <= W; n++) {
            double J[W * W], S[W * W], K[W * W + 1], expected[W * W + 1];
            fill(&seed, m * n, J);
            fill(&seed, m * m, S);
            fill(&seed, n * n + 1, K);
            memcpy(expected, K, sizeof K[0] * (size_t)(n * n + 1));
            plain_loops(m, n, J, S, expected);
            add(m, n, J, S, K);
            different += memcmp(expected, K, sizeof K[0] * (size_t)(n * n + 1)) != 0;
        }
    gsl_test_int(different, 0, "sizes whose bits are not those of plain loops: %s", name);
}

static void congruence_tests(void)
{
    compare("without AVX2", congruence_add_plain);
    compare("chosen for this processor", REAL_CHOSEN(congruence_add));
}

/* Compares warping inside an exact element with the closed-form solution of nonuniform torsion, for
 * thick and thin boundary layers.
 *
 * The warping amplitude a = p(x) + A exp(-lambda x) + B exp(-lambda (1 - x)), where p is a
 * polynomial of degree stages - 1, minimises the energy for the warping torque T = GJ (p - P a) -
 * EIw p'' and the twist rate P a + F T at the Gauss points. The bimoments at the ends are -EIw
 * a'(0), EIw a'(1). */

enum { WARPING_MOST = EXACT_WARPING_MAX_STAGES };

/* Coefficients of x^k in p, and the amplitudes A and B of the two boundary layers. */
typedef struct amplitude {
    int stages;
    double lambda, p[WARPING_MOST], layer[2];
} amplitude;

static double polynomial(const amplitude *a, double x, int order)
{
    double sum = 0;
    for (int k = a->stages - 1; k >= order; k--) {
        double factor = 1;
        for (int i = 0; i < order; i++)
            factor *= k - i;
        sum = sum * x + factor * a->p[k];
    }
    return sum;
}

static double layers(const amplitude *a, double x, double rest)
{
    return a->layer[0] * exp(-a->lambda * x) + a->layer[1] * exp(-a->lambda * rest);
}

/* Computes the means of the layers, weighted by the Lagrange polynomials of the points. The
 * intervals of integration double from 1/1000 of the layer thickness at each end. */
static void layer_means(const amplitude *a, const double x[], const double w[], double mean[])
{
    gsl_integration_glfixed_table *t = gsl_integration_glfixed_table_alloc(12);
    memset(mean, 0, (size_t)a->stages * sizeof *mean);
    for (double from = 0, to = fmin(1e-3 / a->lambda, 0.5); from < 0.5;
         from = to, to = fmin(2 * to, 0.5))
        for (size_t g = 0; g < 12; g++) {
            double at, weight, L[WARPING_MOST];
            gsl_integration_glfixed_point(from, to, g, &at, &weight, t);
            lagrange_at(a->stages, x, at, L, NULL);
            for (int i = 0; i < a->stages; i++)
                mean[i] += weight * L[i] / w[i] * layers(a, at, 1 - at);
            lagrange_at(a->stages, x, 1 - at, L, NULL);
            for (int i = 0; i < a->stages; i++)
                mean[i] += weight * L[i] / w[i] * layers(a, 1 - at, at);
        }
    gsl_integration_glfixed_table_free(t);
}

static double warping_departure(const beam_constants *c, const amplitude *a)
{
    const int m = a->stages + 2;
    double x[WARPING_MOST], w[WARPING_MOST], mean[WARPING_MOST], z[EXACT_WARPING_MAX],
        exact[EXACT_WARPING_MAX], S[EXACT_WARPING_MAX * EXACT_WARPING_MAX], size = 0, worst = 0;
    quadrature_points(a->stages, x, w);
    layer_means(a, x, w, mean);
    for (int i = 0; i < a->stages; i++) {
        const double T = -c->GJ * mean[i] - c->EIw * polynomial(a, x[i], 2);
        z[i] = polynomial(a, x[i], 0) + mean[i] + c->F[8] * T;
        exact[i] = w[i] * T;
    }
    const double far = exp(-a->lambda), l = a->lambda;
    z[m - 2] = polynomial(a, 0, 0) + a->layer[0] + a->layer[1] * far;
    z[m - 1] = polynomial(a, 1, 0) + a->layer[0] * far + a->layer[1];
    exact[m - 2] = -c->EIw * (polynomial(a, 0, 1) + l * (-a->layer[0] + a->layer[1] * far));
    exact[m - 1] = c->EIw * (polynomial(a, 1, 1) + l * (-a->layer[0] * far + a->layer[1]));
    exact_warping_energy(c, a->stages, x, w, S);
    for (int i = 0; i < m; i++) {
        double sum = 0;
        for (int j = 0; j < m; j++)
            sum += S[i * m + j] * z[j];
        size = fmax(size, fabs(exact[i]));
        worst = worst_of(worst, fabs(sum - exact[i]));
    }
    return worst / size;
}

static void warping_compare(int stages, double lambda, double shear)
{
    const beam_constants c = {.GJ = 0.7, .EIw = 0.7 / (lambda * lambda), .F = {[8] = shear}};
    double layer = 0, smooth = 0, mixed = 0;
    uint64_t seed = (uint64_t)stages;
    for (int side = 0; side < 2; side++) {
        amplitude a = {.stages = stages, .lambda = lambda};
        a.layer[side] = 1;
        layer = worst_of(layer, warping_departure(&c, &a));
    }
    for (int k = 0; k < stages; k++) {
        amplitude a = {.stages = stages, .lambda = lambda};
        a.p[k] = 1;
        if (k > 0)
            smooth = worst_of(smooth, warping_departure(&c, &a));
    }
    amplitude a = {.stages = stages, .lambda = lambda};
    for (int k = 0; k < stages; k++)
        a.p[k] = random_number(&seed);
    a.layer[0] = random_number(&seed);
    a.layer[1] = random_number(&seed);
    mixed = warping_departure(&c, &a);
    gsl_test(!(layer < 1e-9), "lambda = %g, %d stages, shear %g: layers (%.1e)", lambda, stages,
             shear, layer);
    gsl_test(!(smooth < 1e-9), "lambda = %g, %d stages, shear %g: between them (%.1e)", lambda,
             stages, shear, smooth);
    gsl_test(!(mixed < 1e-9), "lambda = %g, %d stages, shear %g: both (%.1e)", lambda, stages,
             shear, mixed);
}

static void warping_tests(void)
{
    static const double lambda[] = {0.1, 1, 5, 15, 19.9, 20.1, 50, 300, 1e4},
                        shear[] = {0, 0.3, 40};
    for (int stages = 3; stages <= WARPING_MOST; stages++)
        for (size_t i = 0; i < sizeof lambda / sizeof lambda[0]; i++)
            for (size_t k = 0; k < sizeof shear / sizeof shear[0]; k++)
                warping_compare(stages, lambda[i], shear[k]);
}

int main(void)
{
    theory_tests();
    collocated_tests();
    congruence_tests();
    warping_tests();
    return gsl_test_summary();
}
