/* Coefficients of the third-order potential against values to 120 digits, and the limits of the
 * stress functions. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "elements/sheet/potential.h"
#include "elements/sheet/torsion.h"
#include "elements/test/bimoment_values.h"

extern const element_type element_sheet_second, element_sheet_third, element_sheet_third_printed;

enum { COEFFICIENTS_N = 8, MX = 1, MYP, MYQ, MODES = 5 };
enum {
    ONE,
    PX = 1 + SHEET_LOCAL_PX,
    ZP = 1 + SHEET_LOCAL_ZP,
    ZQ = 1 + SHEET_LOCAL_ZQ,
    WP = 1 + SHEET_LOCAL_WP,
    WQ = 1 + SHEET_LOCAL_WQ
};

/* Unit torques M, PP, PQ, QP, QQ: stress and the variable it is multiplied with. */
static const int stress_of[MODES] = {MX, MYP, MYP, MYQ, MYQ},
                 variable_of[MODES] = {ONE, ZP, ZQ, ZP, ZQ};

static double find(int count, const sheet_potential_term terms[], int i, int j, int a, int b)
{
    for (int k = 0; k < count; k++)
        if (terms[k].i == i && terms[k].j == j &&
            ((terms[k].a == a && terms[k].b == b) || (terms[k].a == b && terms[k].b == a)))
            return terms[k].c;
    return 0;
}

static double error_of(double got, double expected)
{
    return expected == 0 ? fabs(got) : fabs(got / expected - 1);
}

/* A[k][l] of the table, lower triangle by rows. */
static double compliance(const double value[], int k, int l)
{
    return k >= l ? value[k * (k + 1) / 2 + l] : value[l * (l + 1) / 2 + k];
}

/* What the table says of the coefficient of v_a v_b in A_ij: every pair of unit torques that makes
 * it. */
static double expected_compliance(const double value[], int i, int j, int a, int b)
{
    double sum = 0;
    for (int k = 0; k < MODES; k++)
        for (int l = 0; l < MODES; l++) {
            const int va = variable_of[k], vb = variable_of[l];
            if (stress_of[k] == i && stress_of[l] == j &&
                ((va == a && vb == b) || (va == b && vb == a)))
                sum += compliance(value, k, l);
        }
    return sum;
}

static void coefficients(void)
{
    static const int twist[3] = {PX, WP, WQ}, ends[3][2] = {{WP, WP}, {WP, WQ}, {WQ, WQ}};
    double worst = 0;
    for (size_t row = 0; row < sizeof bimoment_values / sizeof bimoment_values[0]; row++) {
        const double lambda = bimoment_values[row].lambda, *value = bimoment_values[row].value;
        /* L = GJ = 1, EIw = 1/lambda^2 */
        const section c = {.young = 1,
                           .shear_modulus = 1,
                           .A = 1,
                           .Iy = 1,
                           .Iz = 1,
                           .It = 1,
                           .Iw = 1 / (lambda * lambda),
                           .Ip = 2};
        const element_request request = {.section = &c, .length = 1, .features = FEATURE_WARPING};
        sheet_potential p;
        gsl_test(sheet_coefficients_prepare(&request, bimoment_values[row].printed, &p, NULL) !=
                     STATUS_OK,
                 "potential, lambda = %g", lambda);
        double error = 0;
        for (int k = 0; k < MODES; k++)
            for (int l = 0; l <= k; l++) {
                const int i = stress_of[k], j = stress_of[l], a = variable_of[k],
                          b = variable_of[l];
                error = fmax(error, error_of(find(p.terms_A, p.A, i, j, a, b),
                                             expected_compliance(value, i, j, a, b)));
            }
        for (int k = 0; k < MODES; k++)
            for (int m = 0; m < 3; m++)
                error = fmax(
                    error, error_of(find(p.terms_b, p.b, stress_of[k], 0, variable_of[k], twist[m]),
                                    value[15 + 3 * k + m]));
        for (int m = 0; m < 3; m++)
            error = fmax(error, error_of(find(p.terms_P0, p.P0, 0, 0, ends[m][0], ends[m][1]),
                                         value[30 + m]));
        gsl_test(!(error < 2e-14), "lambda = %g, sign of u_y %s: coefficients (%.1e)", lambda,
                 bimoment_values[row].printed ? "printed" : "corrected", error);
        worst = fmax(worst, error);
    }
    gsl_test(!(worst > 0 && worst < 2e-14), "largest relative error of all coefficients: %.1e",
             worst);
}

/* Without warping stiffness the torque twists by t/GJ: the limit lambda -> inf, reached like
 * 1/lambda. */
static void uniform_torsion(void)
{
    static const double torque[SHEET_TORSION_MODES][SHEET_TORSION_DEGREE + 1] = {
        {1}, {-1, 4, -5, 2}, {0, 2, -4, 2}, {0, 0, -2, 2}, {0, 0, -1, 2}};
    sheet_torsion_integrals limit, near[2];
    double error[2] = {0};
    sheet_torsion_integrate(INFINITY, torque, &limit);
    for (int n = 0; n < 2; n++) {
        sheet_torsion_integrate(n == 0 ? 1e6 : 1e8, torque, &near[n]);
        for (int k = 0; k < SHEET_TORSION_MODES; k++)
            for (int l = 0; l < SHEET_TORSION_MODES; l++)
                error[n] = fmax(error[n], fabs(near[n].compliance[k][l] - limit.compliance[k][l]));
    }
    gsl_test(!(error[0] < 3e-6 && fabs(error[1] / error[0] - 0.01) < 1e-3),
             "lambda -> inf is uniform torsion (%.1e, %.1e)", error[0], error[1]);
}

static void stiffness_at_rest(const element_type *type, const section *c, unsigned features,
                              double C[COEFFICIENTS_N * COEFFICIENTS_N])
{
    const double e[COEFFICIENTS_N] = {0};
    const element_request request = {.section = c, .length = 0.9, .features = features};
    element_data *d = calloc(1, type->data_size(&request));
    gsl_test(d == NULL || type->prepare(&request, d, NULL) != STATUS_OK, "%s: prepared",
             type->name);
    type->stress(d, e, NULL, &(stress_output){.C = C});
    free(d);
}

/* Undeformed, the third-order element is the second-order one: with shear in the width only, as N
 * Eq. 50 has it, and up to the hyperbolic twist, which is the cubic one for lambda -> 0. */
static void second_order_limit(void)
{
    section c = {.young = 3.1,
                 .shear_modulus = 1.3,
                 .A = 0.7,
                 .Iy = 0.23,
                 .Iz = 0.0117,
                 .It = 0.031,
                 .Iw = 1e4,
                 .Ip = 0.2417};
    double second[COEFFICIENTS_N * COEFFICIENTS_N], third[COEFFICIENTS_N * COEFFICIENTS_N],
        worst = 0;
    c.F[4] = 1 / (0.83 * c.A);
    for (int warping = 0; warping < 2; warping++)
        for (int printed = 0; printed < 2; printed++) {
            const unsigned features = FEATURE_SHEAR | (warping ? FEATURE_WARPING : 0);
            const element_type *type =
                printed ? &element_sheet_third_printed : &element_sheet_third;
            stiffness_at_rest(&element_sheet_second, &c, features, second);
            stiffness_at_rest(type, &c, features, third);
            /* without amplitudes e7 = e8 = e2: only their sum of stiffness counts */
            if (!warping)
                for (int pass = 0; pass < 2; pass++) {
                    double *C = pass == 0 ? second : third;
                    for (int i = 0; i < COEFFICIENTS_N; i++)
                        C[COEFFICIENTS_N * i + 1] +=
                            C[COEFFICIENTS_N * i + 6] + C[COEFFICIENTS_N * i + 7],
                            C[COEFFICIENTS_N * i + 6] = C[COEFFICIENTS_N * i + 7] = 0;
                    for (int j = 0; j < COEFFICIENTS_N; j++)
                        C[COEFFICIENTS_N + j] +=
                            C[COEFFICIENTS_N * 6 + j] + C[COEFFICIENTS_N * 7 + j],
                            C[COEFFICIENTS_N * 6 + j] = C[COEFFICIENTS_N * 7 + j] = 0;
                }
            for (int i = 0; i < COEFFICIENTS_N; i++)
                for (int j = 0; j < COEFFICIENTS_N; j++)
                    worst = fmax(worst, fabs(third[COEFFICIENTS_N * i + j] -
                                             second[COEFFICIENTS_N * i + j]) /
                                            (sqrt(second[(COEFFICIENTS_N + 1) * i] *
                                                  second[(COEFFICIENTS_N + 1) * j]) +
                                             1e-300));
        }
    gsl_test(!(worst < 1e-14), "the undeformed third-order element is the second-order one (%.1e)",
             worst);
}

int main(void)
{
    coefficients();
    uniform_torsion();
    second_order_limit();
    return gsl_test_summary();
}
