/* A cubic beam with two inner nodes: polynomials of degree 3 for positions, rotations and warping,
 * and 3 integration points, like BEAM188 of Ansys as described in N section 4. Non-uniform torsion
 * with warping shear follows M. Schulz, F. C. Filippou, J. Eng. Mech. 124 (1998).
 *
 * The quaternions q_k of R1^T R_k, relative to the first node, are interpolated: q = sum N_k q_k.
 * With q = (w, v), g = R1^T r' and k = 2 (w v' - w' v - v x v')/|q|^2, the strains at a point are
 *   l (R(q)^T g - (1, 0, 0)) + l (i^2/2 k_x^2, 0, 0), where i^2 = (Iy + Iz)/A with FEATURE_TRAPEZE,
 *   l^2 k, l^3 a' and l^2 (k_x - a) [m].
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK cubic.c -lm -o cubic.so
 *   beamwork verify --element ./cubic.so -f cubic */
#include <math.h>
#include <string.h>

#include "elements/element.h"

enum { NODES = 4, POINTS = 3, EACH = NODE_COORDINATES, N = EACH * NODES, KINDS = 8 };
enum { STRAINS = KINDS * POINTS };

struct element_data {
    double length, radius;                      /* radius: i^2 [m^2], or 0 */
    double N[POINTS][NODES], dN[POINTS][NODES]; /* at the points; dN = dN/ds */
    double C[STRAINS * STRAINS];                /* [N/m] */
    int warps;
};

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

/* Computes the polynomials through n positions at x, and their derivatives d/ds. */
static void lagrange(int n, const double at[], double x, double l, double value[], double slope[])
{
    for (int k = 0; k < n; k++) {
        value[k] = 1;
        slope[k] = 0;
        for (int j = 0; j < n; j++)
            if (j != k) {
                slope[k] = (slope[k] * (x - at[j]) + value[k] / l) / (at[k] - at[j]);
                value[k] *= (x - at[j]) / (at[k] - at[j]);
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

static status prepare(const element_request *request, element_data *out, fault *f)
{
    static const double node[NODES] = {0, 1. / 3, 2. / 3, 1},
                        weight[POINTS] = {5. / 18, 8. / 18, 5. / 18};
    static const int power[KINDS] = {0, 0, 0, 1, 1, 1, 2, 1},
                     moment_of[KINDS] = {0, 5, 4}; /* Qy: Mz, Qz: My */
    const section *c = request->section;
    const double l = request->length, E = c->young, G = c->shear_modulus, half = sqrt(0.6) / 2,
                 at[POINTS] = {0.5 - half, 0.5, 0.5 + half},
                 shear = request->features & FEATURE_SHEAR ? 1 / G : 0;
    (void)f;
    memset(out, 0, sizeof *out);
    out->length = l;
    out->radius = request->features & FEATURE_TRAPEZE ? (c->Iy + c->Iz) / c->A : 0;
    out->warps = (request->features & FEATURE_WARPING) != 0 && c->Iw > 0;
    const double GI = G * c->It,
                 own[KINDS] = {1 / (E * c->A),
                               shear * c->F[0],
                               shear * c->F[4],
                               1 / GI,
                               1 / (E * c->Iy),
                               1 / (E * c->Iz),
                               out->warps ? 1 / (E * c->Iw) : 1 / (GI * l * l),
                               out->warps ? fmax(shear * c->F[8], 1e-6 * l * l / (E * c->Iw))
                                          : 1 / GI};
    for (int p = 0; p < POINTS; p++) {
        double row[STRAINS], value[POINTS], slope[POINTS];
        lagrange(NODES, node, at[p], l, out->N[p], out->dN[p]);
        lagrange(POINTS, at, at[p], l, value, slope);
        for (int i = 0; i < KINDS; i++) {
            out->C[(STRAINS + 1) * (KINDS * p + i)] +=
                own[i] * l * pow(l, 2 * power[i]) / weight[p];
            if (own[i] > 0)
                continue;
            /* A section that is rigid in shear has the flexibility of the part of the moment that
             * the points do not represent: l^2/(140 EI) (Q -+ M')^2. */
            const int M = moment_of[i];
            memset(row, 0, sizeof row);
            row[KINDS * p + i] = pow(l, power[i]) / weight[p];
            for (int h = 0; h < POINTS; h++)
                row[KINDS * h + M] = (i == 2 ? -1 : 1) * slope[h] * pow(l, power[M]) / weight[h];
            for (int k = 0; k < STRAINS * STRAINS; k++)
                out->C[k] +=
                    l * weight[p] * l * l / 140 * own[M] * row[k / STRAINS] * row[k % STRAINS];
        }
    }
    invert(STRAINS, out->C);
    return STATUS_OK;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* out += size a x b */
static void cross(double size, const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] += size * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
}

/* y = R^T x */
static void back(const double R[9], const double x[3], double y[3])
{
    for (int i = 0; i < 3; i++)
        y[i] = R[i] * x[0] + R[3 + i] * x[1] + R[6 + i] * x[2];
}

/* Computes the quaternion (w, v) of R1^T R2, with w > 0. */
static void quaternion(const double R1[9], const double R2[9], double q[4])
{
    double R[9];
    for (int i = 0; i < 9; i++)
        R[i] =
            R1[i / 3] * R2[i % 3] + R1[3 + i / 3] * R2[3 + i % 3] + R1[6 + i / 3] * R2[6 + i % 3];
    const double axis[3] = {(R[7] - R[5]) / 2, (R[2] - R[6]) / 2, (R[3] - R[1]) / 2};
    const double sine = sqrt(dot(axis, axis)), angle = atan2(sine, (R[0] + R[4] + R[8] - 1) / 2);
    q[0] = cos(angle / 2);
    for (int i = 0; i < 3; i++)
        q[1 + i] = axis[i] * (sine > 0 ? sin(angle / 2) / sine : 0.5);
}

/* Values at a point, or their changes. */
typedef struct values {
    double q[4], dq[4], g[3], a, da;
} values;

/* Computes |q|^2 R(q)^T g and |q|^2 k, bilinear in two quaternions; if these differ, adds both
 * orders. */
static void forms(const double q[4], const double p[4], const double g[3], const double dp[4],
                  double turned[3], double k[3])
{
    const double *v = q + 1, *u = p + 1;
    for (int i = 0; i < 3; i++) {
        turned[i] = (q[0] * p[0] - dot(v, u)) * g[i] + v[i] * dot(u, g) + u[i] * dot(v, g);
        k[i] = 2 * (q[0] * dp[1 + i] - dp[0] * v[i]);
    }
    cross(-q[0], u, g, turned);
    cross(-p[0], v, g, turned);
    cross(-2, v, dp + 1, k);
}

/* Computes the strains of a point. */
static void strains_at(const element_data *d, const values *x, double e[KINDS])
{
    const double l = d->length, size = x->q[0] * x->q[0] + dot(x->q + 1, x->q + 1);
    double turned[3], k[3];
    forms(x->q, x->q, x->g, x->dq, turned, k);
    for (int i = 0; i < 3; i++) {
        e[i] = l * (turned[i] / size - (i == 0));
        e[3 + i] = l * l * k[i] / size;
    }
    e[0] += d->radius / 2 * e[3] * e[3] / (l * l * l);
    e[6] = d->warps ? l * l * l * x->da : 0;
    e[7] = d->warps ? e[3] - l * l * x->a : 0;
}

/* Computes the change of the strains e for a change dx of the values. */
static void change_at(const element_data *d, const values *x, const values *dx, const double e[],
                      double de[KINDS])
{
    const double l = d->length, size = x->q[0] * x->q[0] + dot(x->q + 1, x->q + 1),
                 grows = 2 * (x->q[0] * dx->q[0] + dot(x->q + 1, dx->q + 1)) / size,
                 own = d->radius / 2 * e[3] * e[3] / (l * l * l);
    double turned[3], k[3], twice[3], more[3], same[3], moved[3];
    forms(x->q, dx->q, x->g, dx->dq, twice, k);
    forms(dx->q, x->q, x->g, x->dq, same, more);
    forms(x->q, x->q, dx->g, x->dq, moved, turned);
    for (int i = 0; i < 3; i++) {
        const double before = e[i] - (i == 0 ? own - l : 0);
        de[i] = l * (2 * twice[i] + moved[i]) / size - before * grows;
        de[3 + i] = l * l * (k[i] + more[i]) / size - e[3 + i] * grows;
    }
    de[0] += d->radius * e[3] * de[3] / (l * l * l);
    de[6] = d->warps ? l * l * l * dx->da : 0;
    de[7] = d->warps ? de[3] - l * l * dx->a : 0;
}

/* Computes the changes of the values of point p for coordinate c of node k with quaternion q. */
static void move(const element_data *d, const node_state x[], int p, int k, int c,
                 const double q[4], values *out)
{
    const double n = d->N[p][k], dn = d->dN[p][k];
    double axis[3], spin[4];
    memset(out, 0, sizeof *out);
    if (c == 6) {
        out->a = n;
        out->da = dn;
        return;
    }
    for (int i = 0; i < 3; i++)
        axis[i] = x[0].R[3 * (c % 3) + i];
    for (int i = 0; i < 3 && c < 3; i++)
        out->g[i] = dn * axis[i];
    if (c < 3)
        return;
    spin[0] = -dot(axis, q + 1) / 2;
    for (int i = 0; i < 3; i++)
        spin[1 + i] = q[0] * axis[i] / 2;
    cross(0.5, axis, q + 1, spin + 1);
    for (int i = 0; i < 4; i++) {
        out->q[i] = n * spin[i];
        out->dq[i] = dn * spin[i];
    }
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    double q[NODES][4];
    for (int k = 0; k < NODES; k++)
        quaternion(x[0].R, x[k].R, q[k]);
    for (int p = 0; p < POINTS; p++) {
        double slope[3] = {0}, e[KINDS], de[KINDS], *J = out->J + KINDS * p * N;
        values now = {{0}, {0}, {0}, 0, 0}, by;
        for (int k = 0; k < NODES; k++) {
            for (int i = 0; i < 4; i++) {
                now.q[i] += d->N[p][k] * q[k][i];
                now.dq[i] += d->dN[p][k] * q[k][i];
            }
            for (int i = 0; i < 3; i++)
                slope[i] += d->dN[p][k] * (x[k].r[i] - x[0].r[i]);
            now.a += d->N[p][k] * x[k].a;
            now.da += d->dN[p][k] * x[k].a;
        }
        back(x[0].R, slope, now.g);
        strains_at(d, &now, e);
        if (out->e != NULL)
            memcpy(out->e + KINDS * p, e, sizeof e);
        for (int c = 0; c < N && out->J != NULL; c++) {
            const int k = c / EACH, own = c % EACH;
            move(d, x, p, k, own, q[k], &by);
            if (k == 0 && own > 2 && own < 6) { /* a rotation of the first node rotates the axes */
                double axis[3];
                for (int i = 0; i < 3; i++)
                    axis[i] = x[0].R[3 * (own - 3) + i];
                memset(&by, 0, sizeof by);
                cross(-1, axis, now.g, by.g);
                for (int j = 1; j < NODES; j++) {
                    values other;
                    move(d, x, p, j, own, q[j], &other);
                    for (int i = 0; i < 4; i++) {
                        by.q[i] -= other.q[i];
                        by.dq[i] -= other.dq[i];
                    }
                }
            }
            change_at(d, &now, &by, e, de);
            for (int i = 0; i < KINDS; i++)
                J[i * N + c] = de[i];
        }
    }
}

static status stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    double energy = 0;
    (void)inner;
    for (int i = 0; i < STRAINS; i++) {
        double sigma = 0;
        for (int j = 0; j < STRAINS; j++)
            sigma += d->C[i * STRAINS + j] * e[j];
        energy += sigma * e[i] / 2;
        if (out->sigma != NULL)
            out->sigma[i] = sigma;
    }
    if (out->C != NULL)
        memcpy(out->C, d->C, sizeof d->C);
    if (out->energy != NULL)
        *out->energy = energy;
    if (out->residual != NULL)
        *out->residual = 0;
    return STATUS_OK;
}

static const element_constants sizes = {
    .nodes = NODES,
    .strains = STRAINS,
    .order = {{4, 6}, {4, 4}, {6, 6}},
};

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "cubic",
    .summary = "four nodes, cubic, three points, with warping: like BEAM188 in N section 4",
    .source = "N section 4: BEAM188; Schulz, Filippou, J. Eng. Mech. 124 (1998)",
    .family = "example",
    .offers = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_GEOMETRIC |
              FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_HARINGX,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_HALF_TURN | LIMIT_ORDER_DEPENDENT,
    .leaves = LEAVES_H,
    .data_size = data_size,
    .prepare = prepare,
    .strain = strain,
    .stress = stress,
    .constants = &sizes,
};
