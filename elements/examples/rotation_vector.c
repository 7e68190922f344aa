/* A beam whose total rotation vectors are interpolated: two nodes, one point, as in the total form
 * of A. Cardona, M. Geradin, Int. J. Numer. Meth. Eng. 26 (1988). Strains do not depend on the
 * path, but rigid rotations change them: the counterexample of M. A. Crisfield, G. Jelenic, Proc.
 * R. Soc. A 455 (1999).
 *
 * With the rotation vectors p, q of both nodes from the undeformed state, t = (p + q)/2,
 * t' = (q - p)/l, and the undeformed rotation L, the point has R = exp(t~) L, and the strains are
 * l (R^T r' - (1, 0, 0)) and l^2 L^T T(t)^T t' [m], where T(t)^T = 1 - (1 - cos t)/t^2 t~ + (t -
 * sin t)/t^3 t~^2. The history contains L and the last p and q, because a matrix determines a
 * vector only up to full turns. At full turns (2 pi, 4 pi, ...) the derivatives of the vector are
 * infinite.
 *
 * If nodes with the rotation vectors +d/2 and -d/2 are also rotated by a vector of magnitude s that
 * is perpendicular to d, the point rotates about this vector by
 *   -d^2/16 (s - sin s)/(1 - cos s)
 * too far, to second order in d, which becomes a shear strain.
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK rotation_vector.c -lm -o rotation_vector.so
 *   beamwork element-test --element ./rotation_vector.so */
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
    double L[9], node[2][3];
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

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
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
    const double skew[9] = {0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            A[3 * i + j] = (i == j) * (1 - b * dot(t, t)) + a * skew[3 * i + j] + b * t[i] * t[j];
}

/* Computes the rotation vector of R S^T that is nearest to the vector `last`. Vectors of the same
 * rotation differ by full turns. */
static void vector(const double R[9], const double S[9], const double last[3], double t[3])
{
    const double pi = 3.14159265358979323846;
    double A[9];
    product(R, S, 1, A);
    const double axis[3] = {(A[7] - A[5]) / 2, (A[2] - A[6]) / 2, (A[3] - A[1]) / 2};
    const double sine = sqrt(dot(axis, axis));
    const double angle = atan2(sine, (A[0] + A[4] + A[8] - 1) / 2), size = sqrt(dot(last, last));
    if (!(size > 0)) { /* from the undeformed state, the nearest vector is the shortest */
        for (int i = 0; i < 3; i++)
            t[i] = axis[i] * (sine > 0 ? angle / sine : 1);
        return;
    }
    double unit[3];
    for (int i = 0; i < 3; i++) /* the axis of a vanishing rotation is that of the last vector */
        unit[i] = sine > 0 ? axis[i] / sine : last[i] / size;
    const double turns = nearbyint((dot(last, unit) - angle) / (2 * pi));
    for (int i = 0; i < 3; i++)
        t[i] = unit[i] * (angle + 2 * pi * turns);
}

static void vectors(const node_state x[], const memory *m, double of[2][3])
{
    for (int k = 0; k < 2; k++)
        vector(x[k].R, m->L, m->node[k], of[k]);
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    const memory *m = (const memory *)out->history;
    double of[2][3], t[3], rate[3], slope[3], turn[9], R[9], T[9], turned[3], k[3], g[3];
    if (out->e == NULL)
        return;
    vectors(x, m, of);
    for (int i = 0; i < 3; i++) {
        t[i] = (of[0][i] + of[1][i]) / 2;
        rate[i] = (of[1][i] - of[0][i]) / d->length;
        slope[i] = (x[1].r[i] - x[0].r[i]) / d->length;
    }
    const double s = sqrt(dot(t, t)), half = sin(s / 2);
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
    back(R, slope, g);
    for (int i = 0; i < 3; i++) {
        out->e[i] = d->length * (g[i] - (i == 0));
        out->e[3 + i] = d->length * d->length * k[i];
    }
}

static void begin(const element_data *d, const node_state x[], double values[])
{
    memory *m = (memory *)values;
    (void)d;
    memset(m, 0, sizeof *m);
    memcpy(m->L, x[0].R, sizeof x[0].R);
}

static void commit(const element_data *d, const node_state x[], double values[])
{
    memory *m = (memory *)values;
    double of[2][3];
    (void)d;
    vectors(x, m, of);
    memcpy(m->node, of, sizeof of);
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
    .name = "rotation_vector",
    .summary =
        "two nodes, one integration point, interpolated total rotation vectors, without warping",
    .source = "Cardona, Geradin, Int. J. Numer. Meth. Eng. 26 (1988), total form; Crisfield, "
              "Jelenic, Proc. R. Soc. A 455 (1999)",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN | LIMIT_NOT_OBJECTIVE,
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
