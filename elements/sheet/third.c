#include "elements/sheet/third.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/sheet/fields.h"
#include "elements/sheet/potential.h"

enum { N = SHEET_STRAINS, CURVED = 3 };

/* Local coordinates whose inverse is quadratic: x = scale e + 1/2 e^T X e (N Eqs. 58, 60, 61). */
static const int curved[CURVED] = {SHEET_LOCAL_U, SHEET_LOCAL_YP, SHEET_LOCAL_YQ};

typedef struct third_data {
    sheet_base_data base;
    sheet_potential potential;
    double scale[N];
    double X[CURVED][N * N];
    /* Of the potential with N Eq. 52 where the element is free of stress: it is less these. */
    double rest_energy, rest_stress[N]; /* [J], [N] */
} third_data;

static const third_data *data_of(const element_data *d)
{
    return (const third_data *)(const void *)d;
}

size_t sheet_third_data_size(const element_request *request)
{
    (void)request;
    return sizeof(third_data);
}

/* N Eqs. 58-65: the deformation function inverted to second order. */
static void partial_inverse(double L, int warp, third_data *d)
{
    static const struct {
        int row, i, j; /* strains counted from 1 */
        double c;      /* times 1/L for u, 1/L^2 for the angles */
    } term[] = {{0, 5, 5, -2.0 / 30}, {0, 5, 6, -1.0 / 30}, {0, 6, 6, -2.0 / 30},
                {1, 2, 5, 1.0 / 10},  {1, 2, 6, 2.0 / 10},  {1, 7, 5, 1.0 / 10},
                {1, 8, 5, -1.0 / 30}, {1, 8, 6, -1.0 / 30}, {2, 2, 5, 2.0 / 10},
                {2, 2, 6, -9.0 / 10}, {2, 8, 6, 1.0 / 10},  {2, 7, 5, -1.0 / 30},
                {2, 7, 6, -1.0 / 30}};
    const double linear[N] = {1, 1 / L, -1 / L, 1 / L, -1 / L, 1 / L, 1 / (L * L), 1 / (L * L)};
    memcpy(d->scale, linear, sizeof linear);
    for (size_t k = 0; k < sizeof term / sizeof term[0]; k++) {
        const int uniform = !warp && term[k].i > 6; /* e7 = e8 = e2 */
        const int i = uniform ? 1 : term[k].i - 1, j = term[k].j - 1;
        const double c = term[k].c / (term[k].row == 0 ? L : L * L);
        d->X[term[k].row][N * i + j] += c;
        d->X[term[k].row][N * j + i] += c;
    }
}

/* x(e), of strains counted from the undeformed arc, and the rows that dx/de has beside its
 * diagonal. */
static void invert(const third_data *d, const double e[N], double x[N], double row[CURVED][N])
{
    double whole[N];
    for (int k = 0; k < N; k++) {
        whole[k] = e[k] + d->base.table.rest[k];
        x[k] = d->scale[k] * whole[k];
    }
    for (int r = 0; r < CURVED; r++) {
        dense_mul_vec(N, N, d->X[r], whole, row[r]);
        for (int k = 0; k < N; k++)
            x[curved[r]] += row[r][k] * whole[k] / 2;
    }
}

/* A (dx/de) in place, A(N x N) by rows. */
static void multiply(const third_data *d, double row[CURVED][N], double A[N * N])
{
    for (int i = 0; i < N; i++) {
        double *a = A + N * i, factor[CURVED];
        for (int r = 0; r < CURVED; r++)
            factor[r] = a[curved[r]];
        for (int k = 0; k < N; k++)
            a[k] = a[k] * d->scale[k] + factor[0] * row[0][k] + factor[1] * row[1][k] +
                   factor[2] * row[2][k];
    }
}

static void transpose(double A[N * N])
{
    for (int i = 0; i < N; i++)
        for (int j = 0; j < i; j++) {
            const double swap = A[N * i + j];
            A[N * i + j] = A[N * j + i];
            A[N * j + i] = swap;
        }
}

/* C = (dx/de)^T h (dx/de) + sum_k g_k d2x_k/de2. */
static void second_derivative(const third_data *d, double row[CURVED][N], const double g[N],
                              const double h[N * N], double C[N * N])
{
    memcpy(C, h, N * N * sizeof(double));
    multiply(d, row, C);
    transpose(C);
    multiply(d, row, C);
    for (int r = 0; r < CURVED; r++)
        for (int k = 0; k < N * N; k++)
            C[k] += g[curved[r]] * d->X[r][k];
}

status sheet_third_stress(const element_data *data, const double e[], const double inner[],
                          stress_output *out)
{
    const third_data *d = data_of(data);
    double x[N], row[CURVED][N], g[N], h[N * N];
    const int first = out->sigma != NULL || out->C != NULL;
    (void)inner;
    invert(d, e, x, row);
    TRY(sheet_potential_evaluate(&d->potential, x, out->energy, first ? g : NULL,
                                 out->C != NULL ? h : NULL));
    if (out->sigma != NULL)
        for (int k = 0; k < N; k++)
            out->sigma[k] = d->scale[k] * g[k] + row[0][k] * g[curved[0]] +
                            row[1][k] * g[curved[1]] + row[2][k] * g[curved[2]] - d->rest_stress[k];
    if (out->energy != NULL) {
        *out->energy -= d->rest_energy;
        for (int k = 0; k < N; k++)
            *out->energy -= d->rest_stress[k] * e[k];
    }
    if (out->C != NULL)
        second_derivative(d, row, g, h, out->C);
    if (out->residual != NULL)
        *out->residual = 0;
    sheet_wagner_add(&d->base.wagner, e, out->energy, out->sigma, out->C);
    return STATUS_OK;
}

/* What is left of N Eq. 52 in the arc. */
static status set_rest(const element_request *request, third_data *out, fault *f)
{
    const double none[N] = {0};
    double energy, stress[N];
    stress_output there = {.energy = &energy, .sigma = stress};
    if (sheet_third_stress((const element_data *)(const void *)out, none, NULL, &there) !=
        STATUS_OK)
        return fault_set(
            f, STATUS_REFUSED,
            "element of length %g m: its initial curvature is too large; use more elements",
            request->length);
    out->rest_energy = energy;
    memcpy(out->rest_stress, stress, sizeof stress);
    return STATUS_OK;
}

status sheet_third_prepare(const element_request *request, int printed, element_data *data,
                           fault *f)
{
    third_data *out = (third_data *)(void *)data;
    memset(out, 0, sizeof *out);
    TRY(sheet_base_prepare(request, SHEET_BASE_PRINTED, &out->base, f));
    if (request->strain[1] != 0)
        return fault_set(
            f, STATUS_REFUSED,
            "initial shear strain %g along the thickness: N Eq. 50 knows none; leave it out",
            request->strain[1]);
    partial_inverse(request->length, sheet_fields_warp(request), out);
    TRY(sheet_coefficients_prepare(request, printed, &out->potential, f));
    return set_rest(request, out, f);
}

/* At e = 0 along the strain v whose stress is sigma: x' = (dx/de) v, (dx/de)' = X v, C' by the
 * product rule. */
void sheet_third_geometric(const element_data *data, const double sigma[], double G[])
{
    const third_data *d = data_of(data);
    const double zero[N] = {0};
    double x[N], row[CURVED][N], turning[CURVED][N], g[N], h[N * N], T[N * N], v[N], LU[N * N],
        along[N], dx[N], mixed[N * N];
    int pivot[N];
    memset(G, 0, N * N * sizeof *G);
    invert(d, zero, x, row);
    if (sheet_potential_evaluate(&d->potential, x, NULL, g, h) != STATUS_OK)
        return;
    second_derivative(d, row, g, h, LU);
    for (int k = 6; k < N; k++) /* no amplitudes: e7 and e8 carry no stress */
        LU[N * k + k] += LU[N * k + k] == 0;
    memcpy(v, sigma, sizeof v);
    if (dense_lu(N, LU, pivot) != 0)
        return;
    dense_lu_solve(N, 1, LU, pivot, v);
    for (int k = 0; k < N; k++)
        dx[k] = d->scale[k] * v[k];
    for (int r = 0; r < CURVED; r++) {
        for (int k = 0; k < N; k++)
            dx[curved[r]] += row[r][k] * v[k];
        dense_mul_vec(N, N, d->X[r], v, turning[r]);
    }
    if (sheet_potential_third(&d->potential, x, dx, T) != STATUS_OK)
        return;
    dense_mul_vec(N, N, h, dx, along);
    second_derivative(d, row, along, T, G);
    multiply(d, row, h);
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++) {
            mixed[N * i + k] = 0;
            for (int r = 0; r < CURVED; r++)
                mixed[N * i + k] += h[N * curved[r] + i] * turning[r][k];
        }
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++)
            G[N * i + k] += mixed[N * i + k] + mixed[N * k + i];
}
