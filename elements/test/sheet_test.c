/* Sheet elements against the printed equations and against differences. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/sheet/strains.h"
#include "elements/test/nodes.h"
#include "elements/test/sections.h"

extern const element_type element_sheet_second, element_sheet_second_consistent,
    element_sheet_third, element_sheet_third_printed;

static const element_type *const types[] = {&element_sheet_second, &element_sheet_second_consistent,
                                            &element_sheet_third, &element_sheet_third_printed};
enum { TYPES = sizeof types / sizeof types[0], SHEET_N = 8, SHEET_NODAL = 14 };

static section sheet_of(double width, double thickness)
{
    section_spec spec = section_spec_rectangle(198.7e9, 76.3e9, width, thickness);
    spec.density = 7823;
    spec.shear_factor[0] = spec.shear_factor[1] = 0.853;
    return sections_computed(&spec);
}

static element_data *prepare(const element_type *type, const section *c, double length,
                             unsigned features, const double k[3])
{
    element_request request = {.section = c, .length = length, .features = features};
    fault f;
    if (k != NULL)
        memcpy(request.curvature, k, sizeof request.curvature);
    element_data *d = calloc(1, type->data_size(&request));
    gsl_test(d == NULL || type->prepare(&request, d, &f) != STATUS_OK, "%s: prepared", type->name);
    return d;
}

static double scaled_difference(int n, const double a[], const double b[])
{
    double worst = 0, largest = 0;
    for (int i = 0; i < n; i++) {
        worst = fmax(worst, fabs(a[i] - b[i]));
        largest = fmax(largest, fabs(b[i]));
    }
    return worst / largest;
}

/* N Eq. 37, word for word but for the last term of e1, where L^2 must be L: a length is
 * expected. */
static void printed_strains(double L, double Ite, const double q[SHEET_N], double e[SHEET_N])
{
    const double u = q[SHEET_LOCAL_U], px = q[SHEET_LOCAL_PX], yp = q[SHEET_LOCAL_YP],
                 yq = q[SHEET_LOCAL_YQ], zp = q[SHEET_LOCAL_ZP], zq = q[SHEET_LOCAL_ZQ],
                 Wp = q[SHEET_LOCAL_WP], Wq = q[SHEET_LOCAL_WQ], L2 = L * L,
                 turn = L * (yp + yq) * (zp - zq) / 2;
    e[0] = u + L * (2 * yp * yp + 2 * yq * yq + 2 * zp * zp + 2 * zq * zq) / 30 +
           L * (-yp * yq - zp * zq) / 30 +
           Ite * (18 * px * px - 3 * L * px * (Wp + Wq)) / (30 * L) +
           Ite * L * (2 * Wp * Wp - Wp * Wq + 2 * Wq * Wq) / 30;
    e[1] = L * px - turn;
    e[2] = -L * yp - L * px * (zp - 2 * zq) / 10 - L2 * Wp * zp / 10 + L2 * Wq * (zp - zq) / 30;
    e[3] = L * yq + L * px * (2 * zp + 9 * zq) / 10 + L2 * Wp * (zq - zp) / 30 - L2 * Wq * zq / 10;
    e[4] = -L * zp + L * px * (yp - 2 * yq) / 10 + L2 * Wp * yp / 10 + L2 * Wq * (yq - yp) / 30;
    e[5] = L * zq - L * px * (2 * yp + 9 * yq) / 10 + L2 * Wp * (yp - yq) / 30 + L2 * Wq * yq / 10;
    e[6] = L2 * Wp - turn;
    e[7] = L2 * Wq - turn;
}

static void printed_equation(void)
{
    const double L = 0.1873,
                 q[SHEET_N] = {2.385e-3, 0.317, -0.0419, 0.0573, 0.1931, -0.0871, 1.371, -0.713};
    const section c = sheet_of(0.0912, 0.00217);
    const element_request request = {
        .section = &c, .length = L, .features = FEATURE_WARPING | FEATURE_TRAPEZE};
    sheet_strains_table table;
    double e[SHEET_N], printed[SHEET_N];
    gsl_test(sheet_strains_prepare(&request, 0, 0, &table, NULL) != STATUS_OK,
             "strains are integrated");
    dense_mul_vec(SHEET_N, SHEET_N, table.Lambda, q, e);
    for (int t = 0; t < table.terms; t++) {
        const int j = table.term[t].j, k = table.term[t].k;
        const double value = table.term[t].c * q[j] * q[k] / (j == k ? 2 : 1);
        e[table.term[t].i] += value;
        e[6] += table.term[t].i == 1 ? value : 0;
        e[7] += table.term[t].i == 1 ? value : 0;
    }
    printed_strains(L, c.Ip / c.A, q, printed);
    for (int i = 0; i < SHEET_N; i++)
        gsl_test_rel(e[i], printed[i], 1e-14, "N Eq. 37, e%d", i + 1);
}

/* Nodes of a strained element far from its initial place. */
static void strained(double L, node_state x[2])
{
    static const double step[2][7] = {{0.013, -0.021, 0.037, 0.713, -0.437, 1.21, 0.83},
                                      {-0.023, 0.017, 0.031, 1.037, -0.291, 1.493, -1.27}};
    for (int k = 0; k < 2; k++) {
        double q[4];
        memset(&x[k], 0, sizeof x[k]);
        rotation_exp(step[k] + 3, q);
        rotation_matrix(q, x[k].R);
        x[k].a = step[k][6];
        const double along[3] = {k * L * 0.97, 0, 0};
        double placed[3];
        rotation_exp(step[0] + 3, q);
        rotation_apply(q, along, placed);
        for (int i = 0; i < 3; i++) {
            x[k].r[i] = placed[i] + step[k][i] * L;
            x[k].u[i] = x[k].r[i] - (i == 0 ? k * L : 0);
        }
    }
}

static void derivatives_of_strain(const element_type *type)
{
    static const double s[SHEET_N] = {0.713, -1.37, 0.837, 1.193, -0.571, 0.391, 1.117, -0.673};
    const double L = 0.1873;
    const section c = sheet_of(0.0912, 0.00217);
    element_data *data = prepare(type, &c, L, type->offers & ~(unsigned)FEATURE_CURVATURE, NULL);
    node_state x[2];
    strained(L, x);
    for (unsigned seed = 1; seed <= 4; seed++) {
        double d[SHEET_NODAL];
        nodes_increments(2, L, 1, seed, d);
        const nodes_departure found = nodes_differences(type, data, 2, SHEET_N, x, d, s);
        gsl_test(!(found.first < 1e-11), "%s: J is de/dx (%.1e)", type->name, found.first);
        gsl_test(!(found.second < 1e-11), "%s: H is the derivative of J^T s (%.1e)", type->name,
                 found.second);
    }
    free(data);
}

/* Energy, sigma and C with every feature and initial curvature on; third-order: G against
 * differences of C. */
static void derivatives_of_stress(const element_type *type)
{
    static const double stencil[4] = {1, -8, 8, -1}, at[4] = {-2, -1, 1, 2};
    const double L = 0.1873, h = 1e-3, none[SHEET_N] = {0}, k[3] = {0, 0.117, 0.371};
    const double e[SHEET_N] = {1.3e-6, 1.9e-3, -2.1e-5, 3.7e-5, 4.1e-3, -5.3e-3, 2.3e-3, 1.1e-3};
    const double d[SHEET_N] = {0.7e-6, 1.1e-3, 1.3e-5, -2.3e-5, -2.9e-3, 1.7e-3, -1.9e-3, 0.7e-3};
    const section c = sheet_of(0.0912, 0.00217);
    element_data *data = prepare(type, &c, L, type->offers, k);
    double sigma[SHEET_N], C[SHEET_N * SHEET_N], Cd[SHEET_N],
        dP = 0, ds[SHEET_N] = {0}, work = 0, C0[SHEET_N * SHEET_N], stress[SHEET_N],
        dC[SHEET_N * SHEET_N] = {0}, G[SHEET_N * SHEET_N];
    type->stress(data, e, NULL, &(stress_output){.sigma = sigma, .C = C});
    for (int n = 0; n < 4; n++) {
        double moved[SHEET_N], near[SHEET_N], P, s[SHEET_N], Cn[SHEET_N * SHEET_N];
        for (int i = 0; i < SHEET_N; i++) {
            moved[i] = e[i] + at[n] * h * d[i];
            near[i] = at[n] * h * d[i];
        }
        type->stress(data, moved, NULL, &(stress_output){.energy = &P, .sigma = s});
        type->stress(data, near, NULL, &(stress_output){.C = Cn});
        dP += stencil[n] * P / (12 * h);
        for (int i = 0; i < SHEET_N; i++)
            ds[i] += stencil[n] * s[i] / (12 * h);
        for (int i = 0; i < SHEET_N * SHEET_N; i++)
            dC[i] += stencil[n] * Cn[i] / (12 * h);
    }
    dense_mul_vec(SHEET_N, SHEET_N, C, d, Cd);
    for (int i = 0; i < SHEET_N; i++)
        work += sigma[i] * d[i];
    gsl_test_rel(dP, work, 1e-10, "%s: sigma is the gradient of the energy", type->name);
    gsl_test(!(scaled_difference(SHEET_N, ds, Cd) < 1e-10),
             "%s: C is the derivative of sigma (%.1e)", type->name,
             scaled_difference(SHEET_N, ds, Cd));
    if (type->geometric != NULL) {
        type->stress(data, none, NULL, &(stress_output){.C = C0});
        dense_mul_vec(SHEET_N, SHEET_N, C0, d, stress);
        type->geometric(data, stress, G);
        gsl_test(!(scaled_difference(SHEET_N * SHEET_N, dC, G) < 1e-9),
                 "%s: G is the derivative of C (%.1e)", type->name,
                 scaled_difference(SHEET_N * SHEET_N, dC, G));
    }
    free(data);
}

/* What cannot be prepared is refused with its culprit. */
static void refusals(const element_type *type)
{
    const section c = sheet_of(0.0912, 0.00217);
    const element_request bad[] = {
        {.section = &c, .length = 0, .features = FEATURE_WARPING},
        {.section = &c, .length = NAN, .features = FEATURE_WARPING},
        {.section = &c, .length = 1e-70, .features = FEATURE_WARPING},
        {.section = &c,
         .length = 1,
         .features = FEATURE_WAGNER_TORQUE | FEATURE_CURVATURE,
         .curvature = {0.1, 0, 0}},
    };
    static const char *const culprit[] = {"length 0", "length nan", "overflows", "torsion"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        element_data *d = calloc(1, type->data_size(&bad[i]));
        fault f = {""};
        const status outcome = type->prepare(&bad[i], d, &f);
        gsl_test(outcome != STATUS_REFUSED || strstr(f.text, culprit[i]) == NULL,
                 "%s: refused (%s)", type->name, f.text);
        free(d);
    }
}

int main(void)
{
    printed_equation();
    for (int i = 0; i < TYPES; i++) {
        derivatives_of_strain(types[i]);
        derivatives_of_stress(types[i]);
        refusals(types[i]);
    }
    return gsl_test_summary();
}
