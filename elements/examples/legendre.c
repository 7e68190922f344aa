/* A spectral Legendre element, as in BeamDyn (Q. Wang, M. A. Sprague, J. Jonkman, N. Johnson, B.
 * Jonkman, Wind Energy 20, 2017): p + 1 nodes at the Gauss-Lobatto points, polynomials of degree p
 * through the nodes, and p Gauss points.
 *
 * The rotations relative to the first node are interpolated, so the strains are objective. They are
 * given by Wiener-Milenkovic parameters c = 4 tan(angle/4) axis. With c0 = 2 - c.c/8 and s = 2/(4 -
 * c0)^2,
 *   R(c) = 1 + s (c0 c~ + c~ c~), and the spin is L dc with L = s (c0 + c~ + c c^T/4),
 *   L^-1 = (c0 - c~ + c c^T/4)/2.
 * With the rotation R1 of the first node, c_k of R1^T R_k, c = sum N_k c_k and g = R1^T r', the
 * strains are l (R^T g - (1, 0, 0)) and l^2 R^T L c' [m] at each point, minus their values in the
 * undeformed element, which may be curved.
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK legendre.c -lm -o legendre.so
 *   beamwork verify --element ./legendre.so -f legendre */
#include <math.h>
#include <string.h>

#include "elements/element.h"

enum { MOST = ELEMENT_MAX_NODES - 1, SIX = 6, EACH = NODE_COORDINATES };

struct element_data {
    int order;
    double length, N[MOST][MOST + 1], dN[MOST][MOST + 1]; /* at the points; dN = dN/ds */
    double rest[SIX * MOST];                              /* strains of the undeformed element */
    double C[SIX * MOST * SIX * MOST];                    /* [N/m] */
};

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

/* Returns the Legendre polynomial of degree n, and that of degree n - 1 in *before. */
static double legendre(int n, double x, double *before)
{
    double P = 1, next;
    *before = 0;
    for (int k = 0; k < n; k++, *before = P, P = next)
        next = ((2 * k + 1) * x * P - k * *before) / (k + 1);
    return P;
}

/* Computes the Gauss-Lobatto points on [0, 1]. */
static void places(const double options[], double place[])
{
    const int p = (int)options[0];
    for (int k = 0; k <= p; k++) {
        double x = -cos(acos(-1) * k / p), before;
        for (int i = 0; i < 20 && k > 0 && k < p; i++) {
            const double P = legendre(p, x, &before);
            x -= (x * P - before) / ((p + 1) * P);
        }
        place[k] = (1 + x) / 2;
    }
}

/* Computes point g of p Gauss points on [0, 1]. */
static double gauss(int p, int g, double *weight)
{
    double x = -cos(acos(-1) * (g + 0.75) / (p + 0.5)), slope = 1, before;
    for (int i = 0; i < 20; i++) {
        const double P = legendre(p, x, &before);
        slope = p * (before - x * P) / (1 - x * x);
        x -= P / slope;
    }
    *weight = 1 / ((1 - x * x) * slope * slope);
    return (1 + x) / 2;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A = a + b v~ + d (u w^T + w u^T)/2 */
static void sum(double a, double b, const double v[3], double d, const double u[3],
                const double w[3], double A[9])
{
    const double skew[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    for (int i = 0; i < 9; i++)
        A[i] = a * (i % 4 == 0) + b * skew[i] + d / 2 * (u[i / 3] * w[i % 3] + w[i / 3] * u[i % 3]);
}

/* D = A B, or A^T B; A [3 x 3], B [3 x n] */
static void product(const double A[9], const double B[], int n, int transposed, double D[])
{
    for (int i = 0; i < 3 * n; i++) {
        const double *a = A + (transposed ? i / n : 3 * (i / n));
        const int next = transposed ? 3 : 1;
        D[i] = a[0] * B[i % n] + a[next] * B[n + i % n] + a[2 * next] * B[2 * n + i % n];
    }
}

/* Computes the parameters of R1^T R2. */
static void parameters(const double R1[9], const double R2[9], double c[3])
{
    double R[9];
    product(R1, R2, 3, 1, R);
    const double axis[3] = {(R[7] - R[5]) / 2, (R[2] - R[6]) / 2, (R[3] - R[1]) / 2};
    const double sine = sqrt(dot(axis, axis)), angle = atan2(sine, (R[0] + R[4] + R[8] - 1) / 2);
    for (int i = 0; i < 3; i++)
        c[i] = axis[i] * (sine > 0 ? 4 * tan(angle / 4) / sine : 1);
}

typedef struct point {
    double R[9], L[9], dL[9], g[3]; /* dL = dL/ds */
    double e[SIX];                  /* strains */
} point;

static void at_point(const element_data *d, int at, const node_state x[], double c[][3], point *out)
{
    double v[3] = {0}, dv[3] = {0}, slope[3] = {0}, spin[3];
    for (int k = 0; k <= d->order; k++)
        for (int i = 0; i < 3; i++) {
            v[i] += d->N[at][k] * c[k][i];
            dv[i] += d->dN[at][k] * c[k][i];
            slope[i] += d->dN[at][k] * (x[k].r[i] - x[0].r[i]);
        }
    const double c0 = 2 - dot(v, v) / 8, dc0 = -dot(v, dv) / 4, s = 2 / ((4 - c0) * (4 - c0));
    sum(1 - s * dot(v, v), s * c0, v, s, v, v, out->R);
    sum(s * c0, s, v, s / 4, v, v, out->L);
    sum(s * dc0, s, dv, s / 2, v, dv, out->dL);
    for (int i = 0; i < 9; i++)
        out->dL[i] += 2 * dc0 / (4 - c0) * out->L[i];
    product(x[0].R, slope, 1, 1, out->g);
    product(out->R, out->g, 1, 1, out->e);
    product(out->L, dv, 1, 0, spin);
    product(out->R, spin, 1, 1, out->e + 3);
    for (int i = 0; i < 3; i++) {
        out->e[i] = d->length * (out->e[i] - (i == 0));
        out->e[3 + i] *= d->length * d->length;
    }
}

/* Adds A [3 x 3] times the rotation of node k relative to the first node to three rows of J. */
static void add(const double A[9], double size, int n, int k, double J[])
{
    for (int i = 0; i < 9; i++) {
        J[i / 3 * n + EACH * k + 3 + i % 3] += size * A[i];
        J[i / 3 * n + 3 + i % 3] -= size * A[i];
    }
}

/* Computes six rows of J. turn[k]: L^-1 R1^T of the nodes. */
static void derivatives(const element_data *d, int at, const double R1[9], double turn[][9],
                        const point *q, double J[])
{
    const int n = EACH * (d->order + 1);
    const double l = d->length, *v = q->g;
    double g[9], lever[9], back[9], A[9], B[9];
    for (int i = 0; i < 9; i++)
        back[i] = R1[3 * (i % 3) + i / 3];
    sum(0, 1, v, 0, v, v, g);
    product(q->R, g, 3, 1, lever);
    product(lever, back, 3, 0, A);
    for (int i = 0; i < 9; i++)
        J[i / 3 * n + 3 + i % 3] += l * A[i];
    product(q->R, back, 3, 1, A);
    for (int k = 0; k <= d->order; k++) {
        for (int i = 0; i < 9; i++)
            J[i / 3 * n + EACH * k + i % 3] += l * d->dN[at][k] * A[i];
        if (k == 0)
            continue;
        product(q->L, turn[k], 3, 0, g);
        product(lever, g, 3, 0, B);
        add(B, l * d->N[at][k], n, k, J);
        product(q->R, g, 3, 1, B);
        add(B, l * l * d->dN[at][k], n, k, J + 3 * n);
        product(q->dL, turn[k], 3, 0, g);
        product(q->R, g, 3, 1, B);
        add(B, l * l * d->N[at][k], n, k, J + 3 * n);
    }
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    const int p = d->order, n = EACH * (p + 1);
    double c[MOST + 1][3], turn[MOST + 1][9];
    for (int k = 0; k <= p; k++) {
        double inverse[9], back[9];
        for (int i = 0; i < 9; i++)
            back[i] = x[0].R[3 * (i % 3) + i / 3];
        parameters(x[0].R, x[k].R, c[k]);
        sum(1 - dot(c[k], c[k]) / 16, -0.5, c[k], 1. / 8, c[k], c[k], inverse);
        product(inverse, back, 3, 0, turn[k]);
    }
    if (out->J != NULL)
        memset(out->J, 0, (size_t)(SIX * p * n) * sizeof *out->J);
    for (int at = 0; at < p; at++) {
        point q;
        at_point(d, at, x, c, &q);
        for (int i = 0; i < SIX && out->e != NULL; i++)
            out->e[SIX * at + i] = q.e[i] - d->rest[SIX * at + i];
        if (out->J != NULL)
            derivatives(d, at, x[0].R, turn, &q, out->J + SIX * at * n);
    }
}

/* Computes the position and rotation at s on the arc of the undeformed element: R = exp(s k~). */
static void arc(const element_request *request, double s, node_state *out)
{
    const double *k = request->curvature, t = s * sqrt(dot(k, k)), half = sin(t / 2);
    const double v[3] = {s * k[0], s * k[1], s * k[2]}, square = t * t,
                 along[3] = {s * (1 + request->strain[0]), s * request->strain[1],
                             s * request->strain[2]};
    const double first = t > 0 ? sin(t) / t : 1, second = t > 0 ? 2 * half * half / square : 0.5;
    const double third = t > 1e-2 ? (1 - first) / square : 1. / 6 - square / 120;
    double A[9];
    sum(1 - second * square, first, v, second, v, v, out->R);
    sum(1 - third * square, second, v, third, v, v, A);
    product(A, along, 1, 0, out->r);
}

/* Computes the polynomials through n positions at x, and their derivatives d/ds. */
static void lagrange(int n, const double at[], double x, double l, double N[], double dN[])
{
    for (int k = 0; k < n; k++) {
        N[k] = 1;
        dN[k] = 0;
        for (int j = 0; j < n; j++)
            if (j != k) {
                dN[k] = (dN[k] * (x - at[j]) + N[k] / l) / (at[k] - at[j]);
                N[k] *= (x - at[j]) / (at[k] - at[j]);
            }
    }
}

/* Inverts a symmetric positive definite matrix. */
static void invert(int n, double A[])
{
    for (int k = 0; k < n; k++) {
        const double pivot = A[k * n + k];
        A[k * n + k] = 1;
        for (int j = 0; j < n; j++)
            A[k * n + j] /= pivot;
        for (int i = 0; i < n; i++) {
            const double by = A[i * n + k];
            for (int j = 0; j < n && i != k; j++)
                A[i * n + j] = (j == k ? 0 : A[i * n + j]) - by * A[k * n + j];
        }
    }
}

/* Computes the flexibility of the section. It is zero for rigid shear. */
static void flexibility_of(const element_request *request, double F[SIX * SIX])
{
    const section *c = request->section;
    const double E = c->young, G = c->shear_modulus,
                 shear = request->features & FEATURE_SHEAR ? 1 / G : 0;
    const double own[SIX] = {1 / (E * c->A),  shear * c->F[0], shear * c->F[4],
                             1 / (G * c->It), 1 / (E * c->Iy), 1 / (E * c->Iz)};
    memcpy(F, c->stiffness, SIX * SIX * sizeof *F);
    for (int i = 0; i < SIX && !c->matrices; i++)
        F[7 * i] = own[i];
    if (c->matrices)
        invert(SIX, F);
}

/* Adds the flexibility of the part of the bending moment that the points do not represent, to a
 * section that is rigid in shear: l^2/(4 (4 p^2 - 1) EI) (Qz - My')^2, and the same for
 * Qy + Mz' (with p = 1, MacNeal's residual bending flexibility). */
static void add_bending(int p, double l, const double at[], const double weight[], int plane,
                        double flexibility, double F[])
{
    const int m = SIX * p, Q = 1 + plane, M = 5 - plane;
    for (int g = 0; g < p; g++) {
        double row[SIX * MOST] = {0}, N[MOST], dN[MOST];
        lagrange(p, at, at[g], l, N, dN);
        for (int h = 0; h < p; h++)
            row[SIX * h + M] = (plane ? -1 : 1) * dN[h] * l / weight[h];
        row[SIX * g + Q] = 1 / weight[g];
        for (int i = 0; i < m * m; i++)
            F[i] += l * weight[g] * l * l / (4 * (4 * p * p - 1)) * flexibility * row[i / m] *
                    row[i % m];
    }
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    const int p = (int)request->options[0], m = SIX * p;
    const double l = request->length;
    double place[MOST + 1], at[MOST], weight[MOST], F[SIX * SIX];
    node_state x[MOST + 1];
    (void)f;
    memset(out, 0, sizeof *out);
    out->order = p;
    out->length = l;
    places(request->options, place);
    flexibility_of(request, F);
    for (int g = 0; g < p; g++) {
        at[g] = gauss(p, g, &weight[g]);
        lagrange(p + 1, place, at[g], l, out->N[g], out->dN[g]);
        /* with strains in m, stresses are weight Q and weight M/l */
        for (int i = 0; i < SIX * SIX; i++)
            out->C[(SIX * g + i / SIX) * m + SIX * g + i % SIX] =
                l / weight[g] * F[i] * (i / SIX < 3 ? 1 : l) * (i % SIX < 3 ? 1 : l);
    }
    for (int plane = 0; plane < 2; plane++)
        if (F[7 * (1 + plane)] == 0)
            add_bending(p, l, at, weight, plane, F[7 * (5 - plane)], out->C);
    invert(m, out->C);
    for (int k = 0; k <= p; k++)
        arc(request, l * place[k], &x[k]);
    double e[SIX * MOST];
    strain(out, x, &(strain_output){.e = e});
    memcpy(out->rest, e, (size_t)m * sizeof *e);
    return STATUS_OK;
}

static status stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    const int m = SIX * d->order;
    double energy = 0;
    (void)inner;
    for (int i = 0; i < m; i++) {
        double sigma = 0;
        for (int j = 0; j < m; j++)
            sigma += d->C[i * m + j] * e[j];
        energy += sigma * e[i] / 2;
        if (out->sigma != NULL)
            out->sigma[i] = sigma;
    }
    if (out->C != NULL)
        memcpy(out->C, d->C, (size_t)(m * m) * sizeof *out->C);
    if (out->energy != NULL)
        *out->energy = energy;
    if (out->residual != NULL)
        *out->residual = 0;
    return STATUS_OK;
}

static int nodes(const double options[])
{
    return (int)options[0] + 1;
}

static int strains(const double options[])
{
    return SIX * (int)options[0];
}

static element_order order(element_analysis a, const double options[])
{
    const int p = (int)options[0];
    (void)a;
    return (element_order){p > 2 ? 2 * p - 2 : 2 * p, 2 * p};
}

static const parameter_type own[] = {
    {"order", "1", 4, 2, MOST, NULL, "degree p of the polynomials: p + 1 nodes, p points"}, {0}};

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "legendre",
    .summary = "spectral Legendre element with 3 to 8 nodes, flexible in shear, no warping",
    .source = "Wang et al., Wind Energy 20 (2017): BeamDyn; p Gauss points",
    .family = "example",
    .offers = FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS |
              FEATURE_ROTARY_INERTIA | FEATURE_CURVATURE | FEATURE_COUPLED,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN | LIMIT_ORDER_DEPENDENT,
    .leaves = LEAVES_H,
    .data_size = data_size,
    .prepare = prepare,
    .options = {own},
    .nodes = nodes,
    .places = places,
    .strains = strains,
    .strain = strain,
    .stress = stress,
    .order = order,
};
