/* A beam whose rotations are updated: two nodes, one point, with rotation increments interpolated
 * between the nodes, as in A. Cardona, M. Geradin, Int. J. Numer. Meth. Eng. 26 (1988). Strains
 * depend on the path and on rigid rotations. Both errors vanish with shorter elements (M. A.
 * Crisfield, G. Jelenic, Proc. R. Soc. A 455, 1999).
 *
 * simo_vu_quoc.c has the same strains, but its forces follow from interpolated virtual rotations;
 * here they are the derivatives of the energy of the strains, at constant history.
 * The history of an element contains the rotations of both nodes in the last accepted state, and
 * the rotation L and the curvature k at the point. With the increments p, q of the nodes,
 *   t = (p + q)/2, t' = (q - p)/l, R = exp(t~) L, strains l (R^T r' - (1, 0, 0)) and
 *   l^2 (k + L^T T(t) t') [m], where t~ v = t x v and, with a = |t|, T(t) = 1 - (1 - cos a)/a^2 t~
 *   + (a - sin a)/a^3 t~^2.
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK incremental.c -o incremental.so
 *   beamwork element-test --element ./incremental.so */
#include <math.h>
#include <string.h>

#include "elements/element.h"

enum { STRAINS = 6 };

struct element_data {
    double length;
    double stiffness[STRAINS]; /* [N/m] */
};

/* The values of the history in the order of storage. Matrices are row-major. */
typedef struct memory {
    double node[2][9], L[9], k[3];
} memory;

enum { VALUES = sizeof(memory) / sizeof(double) };

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    const section *c = request->section;
    const double l = request->length;
    (void)f;
    /* transverse stiffness: shear if requested, and bending that a uniform curvature omits */
    out->length = l;
    const double shear = request->features & FEATURE_SHEAR ? l / c->shear_modulus : 0;
    const double Fy = shear * c->F[0] + l * l * l / (12 * c->young * c->Iz);
    const double Fz = shear * c->F[4] + l * l * l / (12 * c->young * c->Iy);
    const double l3 = l * l * l, one[STRAINS] = {c->young * c->A / l,
                                                 1 / Fy,
                                                 1 / Fz,
                                                 c->shear_modulus * c->It / l3,
                                                 c->young * c->Iy / l3,
                                                 c->young * c->Iz / l3};
    memcpy(out->stiffness, one, sizeof one);
    return STATUS_OK;
}

/* C = A B, or A B^T */
static void product(const double A[9], const double B[9], int transposed, double C[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            C[3 * i + j] = 0;
            for (int k = 0; k < 3; k++)
                C[3 * i + j] += A[3 * i + k] * (transposed ? B[3 * j + k] : B[3 * k + j]);
        }
}

/* y = A^T x */
static void back(const double A[9], const double x[3], double y[3])
{
    for (int i = 0; i < 3; i++)
        y[i] = A[i] * x[0] + A[3 + i] * x[1] + A[6 + i] * x[2];
}

/* 1 + a t~ + b t~^2 */
static void series(const double t[3], double a, double b, double A[9])
{
    const double square = t[0] * t[0] + t[1] * t[1] + t[2] * t[2];
    const double skew[9] = {0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[3 * i + j] = (i == j) * (1 - b * square) + a * skew[3 * i + j] + b * t[i] * t[j];
}

/* Computes the rotation vector of R S^T, with a magnitude below pi. */
static void increment(const double R[9], const double S[9], double t[3])
{
    double A[9];
    product(R, S, 1, A);
    const double axis[3] = {(A[7] - A[5]) / 2, (A[2] - A[6]) / 2, (A[3] - A[1]) / 2};
    const double sine = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double angle = atan2(sine, (A[0] + A[4] + A[8] - 1) / 2);
    for (int i = 0; i < 3; i++)
        t[i] = axis[i] * (sine > 0 ? angle / sine : 1);
}

/* Rotation and curvature at the point. */
static void at_point(const element_data *d, const node_state x[], const memory *m, double R[9],
                     double k[3])
{
    double p[3], q[3], t[3], rate[3], turned[3], turn[9], T[9];
    increment(x[0].R, m->node[0], p);
    increment(x[1].R, m->node[1], q);
    for (int i = 0; i < 3; i++) {
        t[i] = (p[i] + q[i]) / 2;
        rate[i] = (q[i] - p[i]) / d->length;
    }
    const double s = sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]), half = sin(s / 2);
    const double first = s > 1e-4 ? sin(s) / s : 1 - s * s / 6;
    const double second = s > 1e-4 ? 2 * half * half / (s * s) : 0.5 - s * s / 24;
    const double third =
        s > 1e-2 ? (s - sin(s)) / (s * s * s) : 1. / 6 - s * s / 120 + s * s * s * s / 5040;
    series(t, first, second, turn);
    product(turn, m->L, 0, R);
    series(t, -second, third, T);
    for (int i = 0; i < 3; i++)
        turned[i] = T[3 * i] * rate[0] + T[3 * i + 1] * rate[1] + T[3 * i + 2] * rate[2];
    back(m->L, turned, k);
    for (int i = 0; i < 3; i++)
        k[i] += m->k[i];
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    double R[9], k[3], slope[3], g[3];
    if (out->e == NULL)
        return;
    at_point(d, x, (const memory *)out->history, R, k);
    for (int i = 0; i < 3; i++)
        slope[i] = (x[1].r[i] - x[0].r[i]) / d->length;
    back(R, slope, g);
    for (int i = 0; i < 3; i++) {
        out->e[i] = d->length * (g[i] - (i == 0));
        out->e[3 + i] = d->length * d->length * k[i];
    }
}

static void begin(const element_data *d, const node_state x[], double history[])
{
    memory *m = (memory *)history;
    (void)d;
    memset(m, 0, sizeof *m);
    memcpy(m->node[0], x[0].R, sizeof x[0].R);
    memcpy(m->node[1], x[1].R, sizeof x[1].R);
    memcpy(m->L, x[0].R, sizeof x[0].R);
}

static void commit(const element_data *d, const node_state x[], double history[])
{
    memory *m = (memory *)history, now;
    at_point(d, x, m, now.L, now.k);
    memcpy(now.node[0], x[0].R, sizeof x[0].R);
    memcpy(now.node[1], x[1].R, sizeof x[1].R);
    *m = now;
}

static status stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    double energy = 0;
    (void)inner;
    if (out->C != NULL)
        memset(out->C, 0, STRAINS * STRAINS * sizeof *out->C);
    for (int i = 0; i < STRAINS; i++) {
        energy += d->stiffness[i] * e[i] * e[i] / 2;
        if (out->sigma != NULL)
            out->sigma[i] = d->stiffness[i] * e[i];
        if (out->C != NULL)
            out->C[i * STRAINS + i] = d->stiffness[i];
    }
    if (out->energy != NULL)
        *out->energy = energy;
    if (out->residual != NULL)
        *out->residual = 0;
    return STATUS_OK;
}

static int strains(const double options[])
{
    (void)options;
    return STRAINS;
}

static int history(const double options[])
{
    (void)options;
    return VALUES;
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "incremental",
    .summary =
        "two nodes, one integration point, interpolated rotation increments, without warping",
    .source = "Cardona, Geradin, Int. J. Numer. Meth. Eng. 26 (1988), one point of integration",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN | LIMIT_NOT_OBJECTIVE | LIMIT_PATH_DEPENDENT,
    .leaves = LEAVES_J,
    .data_size = data_size,
    .prepare = prepare,
    .strains = strains,
    .strain = strain,
    .stress = stress,
    .history = history,
    .begin = begin,
    .commit = commit,
};
