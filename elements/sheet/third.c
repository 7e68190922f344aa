#include "elements/sheet/third.h"

#include <string.h>

#include "elements/beamw/inertia.h"
#include "elements/math/dense.h"
#include "elements/sheet/potential.h"

typedef struct third_data {
    element_data linear; /* inertia only; S is not used */
    relations relations;
    potential potential;
    relations_map inverse; /* local coordinates from strains: N Eqs. 58-65 */
    int warps;
} third_data;

static const third_data *data_of(const element_data *d)
{
    return (const third_data *)(const void *)d;
}

size_t third_data_size(const element_request *request)
{
    (void)request;
    return sizeof(third_data);
}

/* Strains counted from 1, as in the paper. */
static void add_term(double X[RELATIONS_STRAINS * RELATIONS_STRAINS], int i, int j, double c)
{
    X[RELATIONS_STRAINS * (i - 1) + j - 1] += c;
    X[RELATIONS_STRAINS * (j - 1) + i - 1] += c;
}

/* e7 = e8 = e2 where nothing warps: everything that multiplies e7 or e8 multiplies e2. */
static void follow(double M[RELATIONS_STRAINS * RELATIONS_STRAINS])
{
    enum { N = RELATIONS_STRAINS };
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < N; i++)
            for (int k = 6; k < 8; k++) {
                double *from = pass == 0 ? &M[N * i + k] : &M[N * k + i], *to = pass == 0 ? &M[N * i + 1] : &M[N + i];
                *to += *from;
                *from = 0;
            }
}

/* N Eqs. 58-65: the deformation function inverted to second order. */
static void partial_inverse(double L, int warps, relations_map *inverse)
{
    double X[RELATIONS_STRAINS][RELATIONS_STRAINS * RELATIONS_STRAINS] = {{0}};
    const double L2 = L * L, linear[RELATIONS_STRAINS] = {1, 1 / L, -1 / L, 1 / L, -1 / L, 1 / L, 1 / L2, 1 / L2};
    memcpy(inverse->linear, linear, sizeof linear);
    add_term(X[LOCAL_U], 5, 5, -1 / (15 * L));
    add_term(X[LOCAL_U], 5, 6, -1 / (30 * L));
    add_term(X[LOCAL_U], 6, 6, -1 / (15 * L));
    add_term(X[LOCAL_YP], 2, 5, 1 / (10 * L2));
    add_term(X[LOCAL_YP], 2, 6, 2 / (10 * L2));
    add_term(X[LOCAL_YP], 7, 5, 1 / (10 * L2));
    add_term(X[LOCAL_YP], 8, 5, -1 / (30 * L2));
    add_term(X[LOCAL_YP], 8, 6, -1 / (30 * L2));
    add_term(X[LOCAL_YQ], 2, 5, 2 / (10 * L2));
    add_term(X[LOCAL_YQ], 2, 6, -9 / (10 * L2));
    add_term(X[LOCAL_YQ], 8, 6, 1 / (10 * L2));
    add_term(X[LOCAL_YQ], 7, 5, -1 / (30 * L2));
    add_term(X[LOCAL_YQ], 7, 6, -1 / (30 * L2));
    for (int a = 0; a < RELATIONS_STRAINS; a++) {
        if (!warps)
            follow(X[a]);
        if (!warps && a >= LOCAL_WP)
            inverse->linear[a] = 0;
        relations_add_terms(inverse, a, X[a]);
    }
}

status third_prepare(const element_request *request, int printed, element_data *d, fault *f)
{
    third_data *out = (third_data *)(void *)d;
    stiffness_fields fields;
    memset(out, 0, sizeof *out);
    out->linear.l0 = request->length;
    out->warps = (request->features & FEATURE_WARPING) != 0;
    stiffness_of(request->section, request->length, STIFFNESS_RIGID, &fields, out->linear.S);
    if (request->features & FEATURE_MASS)
        inertia_prepare(request->section, request->features, INERTIA_LUMPED, &fields, &out->linear);
    partial_inverse(request->length, out->warps, &out->inverse);
    const status made = relations_prepare(request, 0, 0, &out->relations, f);
    return made == STATUS_OK ? potential_prepare(request, printed, &out->potential, f) : made;
}

void third_strain(const element_data *d, const node_state x[], strain_output *out)
{
    relations_strain(&data_of(d)->relations, x, out);
}

status third_stress(const element_data *base, const double e[], const double inner[], stress_output *out)
{
    enum { N = RELATIONS_STRAINS };
    (void)inner;
    const third_data *d = data_of(base);
    double x[N], J[N][N], P, g[N], h[N * N];
    relations_apply(&d->inverse, e, x, J);
    const status outcome = potential_evaluate(&d->potential, x, &P, g, h);
    if (outcome != STATUS_OK)
        return outcome;
    if (out->energy != NULL)
        *out->energy = P;
    if (out->sigma != NULL) {
        memset(out->sigma, 0, N * sizeof(double));
        dense_add_transpose_mul(N, N, 1, &J[0][0], g, out->sigma);
    }
    if (out->C != NULL) {
        double work[N * N];
        memset(out->C, 0, N * N * sizeof(double));
        dense_add_congruence(N, N, &J[0][0], h, out->C, work);
        relations_add_second(&d->inverse, g, out->C);
    }
    if (out->residual != NULL)
        *out->residual = 0;
    return STATUS_OK;
}

/* dC/de in the direction whose stress is sigma, at e = 0: by the quadratic parts of the potential, through a small strain. */
void third_geometric(const element_data *d, const double sigma[], double G[])
{
    enum { N = RELATIONS_STRAINS };
    double zero[N] = {0}, C[N * N], de[N], side[2][N * N], size = 0;
    int pivot[N];
    double LU[N * N];
    third_stress(d, zero, NULL, &(stress_output){.C = C});
    memcpy(LU, C, sizeof LU);
    for (int k = 6; k < N && !data_of(d)->warps; k++)
        LU[N * k + k] = 1;
    memcpy(de, sigma, sizeof de);
    memset(G, 0, N * N * sizeof *G);
    if (dense_lu(N, LU, pivot) != 0)
        return;
    dense_lu_solve(N, 1, LU, pivot, de);
    for (int i = 0; i < N; i++)
        size = fmax(size, fabs(de[i]));
    const double t = size > 0 ? 1e-4 * data_of(d)->relations.length / size : 0; /* odd terms only: the cubic ones are 1e-8 */
    for (int k = 0; k < 2 && t > 0; k++) {
        double e[N];
        for (int i = 0; i < N; i++)
            e[i] = (k == 0 ? t : -t) * de[i];
        third_stress(d, e, NULL, &(stress_output){.C = side[k]});
    }
    for (int i = 0; i < N * N && t > 0; i++)
        G[i] = (side[0][i] - side[1][i]) / (2 * t);
}

status third_inertia(const element_data *d, const node_state x[], const node_rate v[], const node_rate a[], inertia_output *out)
{
    return inertia_of(&data_of(d)->linear, x, v, a, out);
}
