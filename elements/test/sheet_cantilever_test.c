/* Cantilever of N section 4.1: sheet 100 x 100 x 2.25 mm, tip deflected by 0.15 L without rotation
 * in 15 steps, its warping held; compliances of the tip with the prescribed motion replaced by dead
 * forces and spatial moments, p of every element at the root.  Values from an independent prototype
 * of the same equations. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/sections.h"

extern const element_type element_sheet_second, element_sheet_second_consistent,
    element_sheet_third, element_sheet_third_printed;

enum { N = 8, NODE = 7, NODAL = 14, MOST = 20, SIZE = NODE * MOST, STEPS = 15, ITERATIONS = 12 };
enum { TIP_UY = 1, TIP_THZ = 5, TIP_WARP = 6 };

typedef struct cantilever {
    const element_type *type;
    element_data *data;
    int n, reversed; /* 1: p of every element at the tip's side */
    node_state node[MOST + 1];
    double e[MOST][N], sigma[MOST][N]; /* unknowns of their own, condensed element by element */
} cantilever;

/* What one element adds: K += J^T C J + H, force += J^T [P'(e) + C (D(x) - e)] (N section 4,
 * condensed). */
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

/* Row of an element's coordinate; below 0: the root. */
static int row_of(const cantilever *c, int i, int a)
{
    return NODE * (i - 1) + (c->reversed ? (a + NODE) % NODAL : a);
}

/* K(7n x 7n) and internal forces of the nodes 1..n; the root's columns have no motion. */
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

/* The row of a coordinate that is held keeps only its motion. */
static void hold(int size, double *K, double *right, int coordinate, double motion)
{
    for (int j = 0; j < size; j++)
        K[size * coordinate + j] = j == coordinate;
    right[coordinate] = motion;
}

/* de = D(x) - e + J dx, dsigma = P' + C de - sigma, then the nodes move. */
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

/* Newton to the next deflection; returns the iterations. */
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

/* Dead spatial moment m at the tip: -1/2 m~ beside the Hessian of the exponential chart. */
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
    spec.given.Iw = pow(0.1 * 0.00225, 3) / 144; /* of a thin one */
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

int main(void)
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
    /* shear kept in the strains: error in C_zz against the geometrically exact beam, in percent,
     * and half of its last digit */
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
    /* the elements are not symmetric in p and q */
    solve(&element_sheet_second, 1, 1, &C_xx, &C_zz);
    gsl_test_rel(C_zz, 2.0197e-8, 3e-5, "sheet_second, reversed: C_zz");
    solve(&element_sheet_third, 1, 1, &C_xx, &C_zz);
    gsl_test_rel(C_zz, 2.6633e-8, 3e-5, "sheet_third, reversed: C_zz");
    return gsl_test_summary();
}
