/* Cantilever of N section 4.1: a sheet of 100 x 100 x 2.25 mm whose tip is deflected by 0.15 L
 * without rotation in 15 steps. Warping is restrained. Node p of every element is towards the root,
 * except in reversed cantilevers. The expected values are those of an independent prototype of the
 * same equations. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/sheet/sheet.h"
#include "elements/test/kit.h"

extern const element_type element_sheet_second, element_sheet_second_consistent,
    element_sheet_third, element_sheet_third_printed;

enum { N = 8, NODE = 7, NODAL = 14, MOST = 20, SIZE = NODE * MOST, STEPS = 15, ITERATIONS = 12 };
enum { TIP_UY = 1, TIP_THZ = 5, TIP_WARP = 6 };

typedef struct cantilever {
    const element_type *type;
    element_data *data;
    int n, reversed;
    node_state node[MOST + 1];
    double e[MOST][N], sigma[MOST][N]; /* [element][strain] unknowns that each element eliminates */
} cantilever;

/* Adds the contribution of one element: K += J^T C J + H, force += J^T [P'(e) + C (D(x) - e)] (N
 * section 4, condensed). */
static void element_terms(const cantilever *c, int i, double K[NODAL * NODAL], double force[NODAL],
                          double J[N * NODAL], double incompatibility[N], double P[N],
                          double C[N * N])
{
    static const double half_turn[9] = {-1, 0, 0, 0, 1, 0, 0, 0, -1};
    double e[N], work[N * NODAL], s[N];
    node_state x[2] = {c->node[i], c->node[i + 1]};
    if (c->reversed)
        for (int k = 0; k < 2; k++) {
            x[k] = c->node[i + 1 - k];
            mat3_mul(c->node[i + 1 - k].R, half_turn, x[k].R);
        }
    c->type->strain(c->data, x, &(strain_output){.e = e, .J = J, .s = c->sigma[i], .H = K});
    if (c->type->stress(c->data, c->e[i], NULL, &(stress_output){.sigma = P, .C = C}) != STATUS_OK)
        gsl_test(1, "%s: stress of element %d", c->type->name, i);
    for (int k = 0; k < N; k++)
        incompatibility[k] = e[k] - c->e[i][k];
    dense_mul_vec(N, N, C, incompatibility, s);
    for (int k = 0; k < N; k++)
        s[k] += P[k];
    memset(force, 0, NODAL * sizeof *force);
    dense_add_transpose_mul(NODAL, N, 1, J, s, force);
    dense_add_congruence(N, NODAL, J, C, K, work);
}

static int row_of(const cantilever *c, int i, int a)
{
    return NODE * (i - 1) + (c->reversed ? (a + NODE) % NODAL : a);
}

static void assemble(const cantilever *c, double *K, double *force)
{
    const int size = NODE * c->n;
    memset(K, 0, (size_t)(size * size) * sizeof *K);
    memset(force, 0, (size_t)size * sizeof *force);
    for (int i = 0; i < c->n; i++) {
        double Ke[NODAL * NODAL], fe[NODAL], J[N * NODAL], incompatibility[N], P[N], C[N * N];
        element_terms(c, i, Ke, fe, J, incompatibility, P, C);
        for (int a = 0; a < NODAL; a++) {
            const int row = row_of(c, i, a);
            if (row < 0)
                continue;
            force[row] += fe[a];
            for (int b = 0; b < NODAL; b++)
                if (row_of(c, i, b) >= 0)
                    K[size * row + row_of(c, i, b)] += Ke[NODAL * a + b];
        }
    }
}

static void hold(int size, double *K, double *right, int coordinate, double motion)
{
    for (int j = 0; j < size; j++)
        K[size * coordinate + j] = j == coordinate;
    right[coordinate] = motion;
}

/* Updates strains and stresses with de = D(x) - e + J dx and dsigma = P' + C de - sigma, then moves
 * the nodes. */
static void advance(cantilever *c, const double *dx)
{
    for (int i = 0; i < c->n; i++) {
        double Ke[NODAL * NODAL], fe[NODAL], J[N * NODAL], incompatibility[N], P[N], C[N * N],
            motion[NODAL] = {0}, de[N], ds[N];
        element_terms(c, i, Ke, fe, J, incompatibility, P, C);
        for (int a = 0; a < NODAL; a++)
            motion[a] = row_of(c, i, a) >= 0 ? dx[row_of(c, i, a)] : 0;
        dense_mul_vec(N, NODAL, J, motion, de);
        for (int k = 0; k < N; k++)
            de[k] += incompatibility[k];
        dense_mul_vec(N, N, C, de, ds);
        for (int k = 0; k < N; k++) {
            c->e[i][k] += de[k];
            c->sigma[i][k] = P[k] + ds[k];
        }
    }
    for (int i = 1; i <= c->n; i++) {
        const double *d = dx + NODE * (i - 1);
        double q[4], turn[9], R[9];
        for (int k = 0; k < 3; k++) {
            c->node[i].r[k] += d[k];
            c->node[i].u[k] += d[k];
        }
        rotation_exp(d + 3, q);
        rotation_matrix(q, turn);
        memcpy(R, c->node[i].R, sizeof R);
        mat3_mul(turn, R, c->node[i].R);
        c->node[i].a += d[6];
    }
}

static int step(cantilever *c, double deflection, double *K, double *right)
{
    const int size = NODE * c->n, tip = NODE * (c->n - 1);
    int pivot[SIZE];
    for (int iteration = 1; iteration <= ITERATIONS; iteration++) {
        double largest = 0;
        assemble(c, K, right);
        for (int i = 0; i < size; i++)
            right[i] = -right[i];
        hold(size, K, right, tip + TIP_UY, deflection - c->node[c->n].u[1]);
        hold(size, K, right, tip + TIP_THZ, 0);
        hold(size, K, right, tip + TIP_WARP, 0);
        if (dense_lu(size, K, pivot) != 0)
            return ITERATIONS + 1;
        dense_lu_solve(size, 1, K, pivot, right);
        advance(c, right);
        for (int i = 0; i < size; i++)
            largest = fmax(largest, fabs(right[i]));
        if (largest < 1e-12)
            return iteration;
    }
    return ITERATIONS + 1;
}

/* Computes the compliances of the tip along x and z. A dead spatial moment m at the tip adds -1/2
 * m~ to the Hessian in the exponential chart. */
static void compliance(const cantilever *c, double *K, double *right, double *C_xx, double *C_zz)
{
    const int size = NODE * c->n, tip = NODE * (c->n - 1);
    int pivot[SIZE];
    assemble(c, K, right);
    const double *m = right + tip + 3;
    const double skew[9] = {0, -m[2], m[1], m[2], 0, -m[0], -m[1], m[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[size * (tip + 3 + i) + tip + 3 + j] -= skew[3 * i + j] / 2;
    hold(size, K, right, tip + TIP_WARP, 0);
    gsl_test(dense_lu(size, K, pivot) != 0, "%s: tangent at the end", c->type->name);
    for (int k = 0; k < 3; k += 2) {
        memset(right, 0, (size_t)size * sizeof *right);
        right[tip + k] = 1;
        dense_lu_solve(size, 1, K, pivot, right);
        *(k == 0 ? C_xx : C_zz) = right[tip + k];
    }
}

static void solve(const element_type *type, int n, int reversed, double *C_xx, double *C_zz)
{
    const double L = 0.1, nu = 0.3;
    cantilever *c = calloc(1, sizeof *c);
    double *K = malloc(sizeof(double) * SIZE * SIZE), *right = malloc(sizeof(double) * SIZE);
    int most = 0;
    section_spec spec = section_spec_rectangle(200e9, 200e9 / (2 * (1 + nu)), 0.1, 0.00225);
    spec.given.Iw = pow(0.1 * 0.00225, 3) / 144;
    spec.shear_factor[0] = spec.shear_factor[1] = 10 * (1 + nu) / (12 + 11 * nu);
    const section s = sections_computed(&spec);
    const element_request request = {.section = &s,
                                     .length = L / n,
                                     .features = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE |
                                                 FEATURE_LARGE};
    c->type = type;
    c->n = n;
    c->reversed = reversed;
    c->data = calloc(1, type->data_size(&request));
    gsl_test(type->prepare(&request, c->data, NULL) != STATUS_OK, "%s: prepared", type->name);
    for (int i = 0; i <= n; i++) {
        c->node[i].r[0] = L * i / n;
        c->node[i].R[0] = c->node[i].R[4] = c->node[i].R[8] = 1;
    }
    for (int k = 1; k <= STEPS; k++) {
        const int iterations = step(c, 0.15 * L * k / STEPS, K, right);
        most = iterations > most ? iterations : most;
    }
    gsl_test(most > 4, "%s, n = %d: at most %d iterations in a step", type->name, n, most);
    compliance(c, K, right, C_xx, C_zz);
    free(c->data);
    free(c);
    free(K);
    free(right);
}

static void sheet_cantilever_tests(void)
{
    static const struct {
        const element_type *type;
        int n;
        double C_xx, C_zz; /* [m/N] */
    } row[] = {
        {&element_sheet_second, 1, 3.9369867e-7, 1.987331e-8},
        {&element_sheet_second, 2, 3.9619195e-7, 2.348288e-8},
        {&element_sheet_second, 3, 3.9703679e-7, 2.542387e-8},
        {&element_sheet_second, 4, 3.9718827e-7, 2.593329e-8},
        {&element_sheet_second, 20, 3.9725972e-7, 2.623353e-8},
        {&element_sheet_third, 1, 3.9472445e-7, 2.633920e-8},
        {&element_sheet_third, 2, 3.9673504e-7, 2.632057e-8},
        {&element_sheet_third_printed, 1, 3.9472445e-7, 2.470177e-8},
    };
    /* Errors of C_zz in percent, relative to the geometrically exact beam, of elements that include
     * shear in the strains. `rounding` is half a unit of the last digit. */
    static const struct {
        int n;
        double percent, rounding;
    } consistent[] = {{1, -24.45, 5e-3},
                      {2, -10.59, 5e-3},
                      {4, -1.156, 5e-4},
                      {8, -0.0901, 5e-5},
                      {16, -0.0070, 5e-5}};
    const double exact = 2.620413704e-8;
    double C_xx, C_zz;
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        solve(row[i].type, row[i].n, 0, &C_xx, &C_zz);
        gsl_test_rel(C_xx, row[i].C_xx, 1e-6, "%s, n = %d: C_xx", row[i].type->name, row[i].n);
        gsl_test_rel(C_zz, row[i].C_zz, 1e-6, "%s, n = %d: C_zz", row[i].type->name, row[i].n);
    }
    for (size_t i = 0; i < sizeof consistent / sizeof consistent[0]; i++) {
        solve(&element_sheet_second_consistent, consistent[i].n, 0, &C_xx, &C_zz);
        gsl_test_abs(100 * (C_zz / exact - 1), consistent[i].percent, consistent[i].rounding,
                     "sheet_second_consistent, n = %d: error of C_zz in percent", consistent[i].n);
    }
    solve(&element_sheet_second, 1, 1, &C_xx, &C_zz);
    gsl_test_rel(C_zz, 2.0197e-8, 3e-5, "sheet_second, reversed: C_zz");
    solve(&element_sheet_third, 1, 1, &C_xx, &C_zz);
    gsl_test_rel(C_zz, 2.6633e-8, 3e-5, "sheet_third, reversed: C_zz");
}

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

/* Computes the strains of N Eq. 37 as printed, except that L replaces L^2 in the last term of e1,
 * because e1 is a length. */
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
    static const char *const reported_name[] = {"element is 0 m", "element is nan m", "overflows",
                                                "torsion"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        element_data *d = calloc(1, type->data_size(&bad[i]));
        fault f = {""};
        const status outcome = type->prepare(&bad[i], d, &f);
        gsl_test(outcome != STATUS_REFUSED || strstr(f.text, reported_name[i]) == NULL,
                 "%s: refused (%s)", type->name, f.text);
        free(d);
    }
}

static void sheet_tests(void)
{
    printed_equation();
    for (int i = 0; i < TYPES; i++) {
        derivatives_of_strain(types[i]);
        derivatives_of_stress(types[i]);
        refusals(types[i]);
    }
}

int main(void)
{
    sheet_cantilever_tests();
    sheet_tests();
    return gsl_test_summary();
}
