/* The beam of J. C. Simo and L. Vu-Quoc, Comput. Methods Appl. Mech. Engrg. 58 (1986): two nodes,
 * one point, whose rotation and curvature are updated by interpolated spatial rotation increments.
 * It gives forces and stiffness with a history. Strains depend on the path and on rigid rotations
 * (M. A. Crisfield, G. Jelenic, Proc. R. Soc. A 455, 1999).
 *
 * The strains are those of incremental.c, but forces follow from interpolated virtual rotations, so
 * they derive from an energy only for small increments, and the stiffness is unsymmetric. Here the
 * increments are those since the last accepted state; in the paper, those of each iteration.
 *
 * With the increments p, q of the nodes, t = (p + q)/2, t' = (q - p)/l, and the values L and k of
 * the last accepted state, the point has
 *   R = exp(t~) L, curvature R^T w = k + L^T T(t)^T t', strain R^T r' - (1, 0, 0),
 * force n and moment m. The forces on the nodes are -n and n; the moments are -m and m, both minus
 * (l/2) r' x n. T(t) = 1 + (1 - cos t)/t^2 t~ + (t - sin t)/t^3 t~^2.
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK simo_vu_quoc.c -o simo_vu_quoc.so
 *   beamwork element-test --element ./simo_vu_quoc.so */
#include <math.h>
#include <string.h>

#include "elements/element.h"

enum { N = 2 * NODE_COORDINATES };

struct element_data {
    double length;
    double rigidity[6]; /* of elongation, shear y, z [N], torsion, bending y, z [N m^2] */
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
    const double l = request->length, EI[] = {c->young * c->Iy, c->young * c->Iz};
    const int shear = (request->features & FEATURE_SHEAR) != 0;
    (void)f;
    out->length = l;
    /* rigid in shear: residual bending flexibility l^2/(12 EI) (MacNeal 1978) */
    const double one[6] = {c->young * c->A,
                           shear ? c->shear_modulus / c->F[0] : 12 * EI[1] / (l * l),
                           shear ? c->shear_modulus / c->F[4] : 12 * EI[0] / (l * l),
                           c->shear_modulus * c->It,
                           EI[0],
                           EI[1]};
    memcpy(out->rigidity, one, sizeof one);
    return STATUS_OK;
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
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

/* y = A x, or A^T x */
static void apply(const double A[9], int transposed, const double x[3], double y[3])
{
    for (int i = 0; i < 3; i++)
        y[i] = transposed ? A[i] * x[0] + A[3 + i] * x[1] + A[6 + i] * x[2]
                          : A[3 * i] * x[0] + A[3 * i + 1] * x[1] + A[3 * i + 2] * x[2];
}

/* R diag(rigidity) R^T x */
static void stiff(const double R[9], const double rigidity[3], const double x[3], double y[3])
{
    double own[3];
    apply(R, 1, x, own);
    for (int i = 0; i < 3; i++)
        own[i] *= rigidity[i];
    apply(R, 0, own, y);
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

/* a = sin s/s, b = (1 - cos s)/s^2, c = (s - sin s)/s^3 for s = |t|, and their derivatives with
 * respect to s, divided by s. Neglected terms of the series are below 1e-15. */
typedef struct factors {
    double a, b, c, da, db, dc;
} factors;

static factors factors_of(const double t[3])
{
    const double q = t[0] * t[0] + t[1] * t[1] + t[2] * t[2], s = sqrt(q), h = sin(s / 2);
    if (s < 0.05)
        return (factors){1 - q / 6 * (1 - q / 20 * (1 - q / 42)),
                         (1 - q / 12 * (1 - q / 30 * (1 - q / 56))) / 2,
                         (1 - q / 20 * (1 - q / 42 * (1 - q / 72))) / 6,
                         -(1 - q / 10 * (1 - q / 28)) / 3,
                         -(1 - q / 15 * (1 - q / 112. * 3)) / 12,
                         -(1 - q / 21 * (1 - q / 48)) / 60};
    const double a = sin(s) / s, b = 2 * h * h / q, c = (1 - a) / q;
    return (factors){a, b, c, (cos(s) - a) / q, (a - 2 * b) / q, (b - 3 * c) / q};
}

/* The point, and the increments that led to it. */
typedef struct place {
    double p[2][3], t[3], rate[3], R[9], k[3];
    factors f;
} place;

static void at_point(const element_data *d, const node_state x[], const memory *m, place *at)
{
    double turn[9], T[9], turned[3];
    for (int k = 0; k < 2; k++)
        increment(x[k].R, m->node[k], at->p[k]);
    for (int i = 0; i < 3; i++) {
        at->t[i] = (at->p[0][i] + at->p[1][i]) / 2;
        at->rate[i] = (at->p[1][i] - at->p[0][i]) / d->length;
    }
    at->f = factors_of(at->t);
    series(at->t, at->f.a, at->f.b, turn);
    product(turn, m->L, 0, at->R);
    series(at->t, -at->f.b, at->f.c, T);
    apply(T, 0, at->rate, turned);
    apply(m->L, 1, turned, at->k);
    for (int i = 0; i < 3; i++)
        at->k[i] += m->k[i];
}

/* Computes the virtual rotation a = T dt of the point due to a spatial rotation increment e of a
 * node, and da/dx = T dt' + T' dt, where dt = T(p)^-1 e/2. side: -1 or 1. */
static void turning(const element_data *d, const place *at, int node, const double e[3],
                    double a[3], double b[3])
{
    const double *p = at->p[node], *t = at->t, *r = at->rate, side = node ? 1 : -1;
    const double s = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    const double part = s < 1e-2 ? 1. / 12 + s * s / 720 : (1 - s / 2 / tan(s / 2)) / (s * s);
    double T[9], v[3], tv[3], rv[3], dot_tr = 0, dot_tv = 0, dot_rv = 0;
    series(p, -0.5, part, T);
    apply(T, 0, e, v);
    for (int i = 0; i < 3; i++) {
        v[i] /= 2;
        dot_tr += t[i] * r[i];
        dot_tv += t[i] * v[i];
        dot_rv += r[i] * v[i];
    }
    cross(t, v, tv);
    cross(r, v, rv);
    for (int i = 0; i < 3; i++) { /* T v = a v + b t x v + c (t.v) t */
        const factors *f = &at->f;
        a[i] = f->a * v[i] + f->b * tv[i] + f->c * dot_tv * t[i];
        b[i] = 2 * side / d->length * a[i] +
               dot_tr * (f->da * v[i] + f->db * tv[i] + f->dc * dot_tv * t[i]) + f->b * rv[i] +
               f->c * (dot_rv * t[i] + dot_tv * r[i]);
    }
}

/* Computes column j of the stiffness: the change of the forces F due to changes of the state. */
static void column(const element_data *d, const place *at, const double slope[3], const double n[3],
                   const double m[3], int j, double K[N * N])
{
    const int node = j / NODE_COORDINATES, c = j % NODE_COORDINATES;
    double e[3] = {0}, r[3] = {0}, a[3] = {0}, b[3] = {0}, g[3], dn[3], dm[3], more[3], lever[3];
    if (c == 6)
        return;
    e[c % 3] = 1;
    if (c < 3)
        r[c] = (node ? 1 : -1) / d->length;
    else
        turning(d, at, node, e, a, b);
    cross(a, slope, g);
    for (int i = 0; i < 3; i++)
        g[i] = r[i] - g[i];
    stiff(at->R, d->rigidity, g, dn);
    cross(a, n, more);
    for (int i = 0; i < 3; i++)
        dn[i] += more[i];
    stiff(at->R, d->rigidity + 3, b, dm);
    cross(a, m, more);
    for (int i = 0; i < 3; i++)
        dm[i] += more[i];
    cross(r, n, lever);
    cross(slope, dn, more);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            K[(NODE_COORDINATES * k + i) * N + j] = (k ? 1 : -1) * dn[i];
            K[(NODE_COORDINATES * k + 3 + i) * N + j] =
                (k ? 1 : -1) * dm[i] - d->length / 2 * (lever[i] + more[i]);
        }
}

static status force(const element_data *d, const node_state x[], force_output *out)
{
    place at;
    double slope[3], g[3], k[3], n[3], m[3], lever[3];
    at_point(d, x, (const memory *)out->history, &at);
    for (int i = 0; i < 3; i++)
        slope[i] = (x[1].r[i] - x[0].r[i]) / d->length;
    apply(at.R, 1, slope, g);
    for (int i = 0; i < 3; i++) {
        g[i] = d->rigidity[i] * (g[i] - (i == 0));
        k[i] = d->rigidity[3 + i] * at.k[i];
    }
    apply(at.R, 0, g, n);
    apply(at.R, 0, k, m);
    cross(slope, n, lever);
    for (int i = 0; i < N && out->F != NULL; i++) {
        const int c = i % NODE_COORDINATES, side = i < NODE_COORDINATES ? -1 : 1;
        out->F[i] = c < 3   ? side * n[c]
                    : c < 6 ? side * m[c - 3] - d->length / 2 * lever[c - 3]
                            : 0;
    }
    if (out->K == NULL)
        return STATUS_OK;
    memset(out->K, 0, N * N * sizeof *out->K);
    for (int j = 0; j < N; j++)
        column(d, &at, slope, n, m, j, out->K);
    return STATUS_OK;
}

static int history(const double options[])
{
    (void)options;
    return VALUES;
}

static void begin(const element_data *d, const node_state x[], double values[])
{
    memory *m = (memory *)values;
    (void)d;
    memset(m, 0, sizeof *m);
    memcpy(m->node[0], x[0].R, sizeof x[0].R);
    memcpy(m->node[1], x[1].R, sizeof x[1].R);
    memcpy(m->L, x[0].R, sizeof x[0].R);
}

static void commit(const element_data *d, const node_state x[], double values[])
{
    memory *m = (memory *)values;
    place at;
    at_point(d, x, m, &at);
    memcpy(m->node[0], x[0].R, sizeof x[0].R);
    memcpy(m->node[1], x[1].R, sizeof x[1].R);
    memcpy(m->L, at.R, sizeof at.R);
    memcpy(m->k, at.k, sizeof at.k);
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "simo_vu_quoc",
    .summary = "two nodes, one integration point, updated by interpolated rotation increments, "
               "without warping",
    .source = "Simo, Vu-Quoc, Comput. Methods Appl. Mech. Engrg. 58 (1986), linear interpolation",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN | LIMIT_NOT_OBJECTIVE | LIMIT_PATH_DEPENDENT,
    .data_size = data_size,
    .prepare = prepare,
    .force = force,
    .history = history,
    .begin = begin,
    .commit = commit,
};
