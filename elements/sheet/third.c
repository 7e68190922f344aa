#include "elements/sheet/sheet.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/sheet/potential.h"

enum { N = SHEET_STRAINS, CURVED = SHEET_INVERSE_CURVED };

size_t sheet_third_data_size(const element_request *request)
{
    (void)request;
    return sizeof(sheet_inverse_data);
}

static void partial_inverse(double L, int warp, sheet_inverse_data *d)
{
    static const struct {
        int row, i, j;
        double c; /* coefficient, to be multiplied by 1/L for u and by 1/L^2 for the angles */
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

status sheet_third_stress(const element_data *d, const double e[], const double inner[],
                          stress_output *out)
{
    (void)inner;
    return sheet_inverse_stress(sheet_inverse_of(d), e, out) ? STATUS_OK : STATUS_SINGULAR;
}

void sheet_third_stress_many(int count, const element_data *const data[], const double *const e[],
                             const double *const inner[], stress_output out[], status outcome[])
{
    REAL_CHOSEN(sheet_lanes_third)(count, data, e, inner, out, outcome);
}

void sheet_third_equations_many(int count, const element_data *const data[], const node_state x[],
                                const double *const e[], const double *const inner[],
                                const double *const s[], equations_output out[], status outcome[])
{
    REAL_CHOSEN(sheet_lanes_third_equations)(count, data, x, e, inner, s, out, outcome);
}

/* Sets the energy and stresses of N Eq. 52 at e = 0, in the undeformed arc. Returns REFUSED if the
 * initial curvature is too large. */
static status set_rest(const element_request *request, sheet_inverse_data *out, fault *f)
{
    const double none[N] = {0};
    double energy, stress[N];
    stress_output there = {.energy = &energy, .sigma = stress};
    if (sheet_third_stress((const element_data *)(const void *)out, none, NULL, &there) !=
        STATUS_OK)
        return fault_set(
            f, STATUS_REFUSED,
            "element of length %g m: the initial curvature is too large; use more elements",
            request->length);
    out->rest_energy = energy;
    memcpy(out->rest_stress, stress, sizeof stress);
    return STATUS_OK;
}

status sheet_third_prepare(const element_request *request, int printed, element_data *data,
                           fault *f)
{
    sheet_inverse_data *out = (sheet_inverse_data *)(void *)data;
    memset(out, 0, sizeof *out);
    TRY(sheet_base_prepare(request, SHEET_BASE_PRINTED, &out->base, f));
    if (request->strain[1] != 0)
        return fault_set(f, STATUS_REFUSED,
                         "the initial shear strain along the thickness is %g, but N Eq. 50 does "
                         "not include this strain; remove it",
                         request->strain[1]);
    out->bending =
        request->length * request->length / (request->section->young * request->section->Iz);
    partial_inverse(request->length, sheet_fields_warp(request), out);
    TRY(sheet_coefficients_prepare(request, printed, &out->potential, f));
    return set_rest(request, out, f);
}

/* If the element is bent to u = psi (x - x^2) L, with the end slopes psi and -psi, M_z = M~z + u F
 * is not linear. With f = F L^2/EIz, the energy EIz/(2 L) (4 + f/3 - f^2/180) psi^2 is positive up
 * to f = 30 + sqrt(1620). For the other bending shape, with psi at both ends, the energy is
 * positive up to f = 185. */
double sheet_third_tension(const element_data *data, const double sigma[])
{
    const sheet_inverse_data *d = sheet_inverse_of(data);
    const double most = 30 + sqrt(1620);
    return sigma[0] > 0 ? sqrt(sigma[0] * d->bending / most) : 0;
}

/* Differentiates at e = 0 along the strain v that has the stress sigma: x' = (dx/de) v and (dx/de)'
 * = X v. The product rule gives C'. */
void sheet_third_geometric(const element_data *data, const double sigma[], double G[])
{
    const sheet_inverse_data *d = sheet_inverse_of(data);
    const double zero[N] = {0};
    double x[N], row[CURVED][N] = {{0}}, turning[CURVED][N], g[N], h[N * N], T[N * N], v[N],
                 LU[N * N], along[N], dx[N], mixed[N * N];
    int pivot[N];
    memset(G, 0, N * N * sizeof *G);
    sheet_inverse_point(d, zero, x, row);
    if (sheet_potential_evaluate(&d->potential, x, NULL, g, h) != STATUS_OK)
        return;
    sheet_inverse_second(d, row, g, h, LU);
    for (int k = 6; k < N; k++) /* without amplitudes, e7 and e8 have no stress */
        LU[N * k + k] += LU[N * k + k] == 0;
    memcpy(v, sigma, sizeof v);
    if (dense_lu(N, LU, pivot) != 0)
        return;
    dense_lu_solve(N, 1, LU, pivot, v);
    for (int k = 0; k < N; k++)
        dx[k] = d->scale[k] * v[k];
    for (int r = 0; r < CURVED; r++) {
        for (int k = 0; k < N; k++)
            dx[sheet_inverse_curved[r]] += row[r][k] * v[k];
        dense_mul_vec(N, N, d->X[r], v, turning[r]);
    }
    if (sheet_potential_third(&d->potential, x, dx, T) != STATUS_OK)
        return;
    dense_mul_vec(N, N, h, dx, along);
    sheet_inverse_second(d, row, along, T, G);
    for (int i = 0; i < N; i++)
        sheet_inverse_multiply(d, row, h + N * i);
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++) {
            mixed[N * i + k] = 0;
            for (int r = 0; r < CURVED; r++)
                mixed[N * i + k] += h[N * sheet_inverse_curved[r] + i] * turning[r][k];
        }
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++)
            G[N * i + k] += mixed[N * i + k] + mixed[N * k + i];
}
