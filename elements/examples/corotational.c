/* A corotational beam with two nodes: the linear beam in axes that follow the element. It returns
 * forces and stiffness, as a user element of a finite element program does.
 *   axes: x along the chord, y in the plane of the chord and the mean of the y axes of the nodes
 *     (Battini and Pacoste, Comput. Methods Appl. Mech. Engrg. 191 (2002));
 *   rotations of the nodes relative to these axes: measured by the sine, t = axis sin(angle)
 *     (Crisfield, ibid. 81 (1990));
 *   stiffness: the complete derivative; its parts have the names of Felippa and Haugen, ibid. 194
 *     (2005).
 *
 *   cc -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK corotational.c -lm -o corotational.so
 *   beamwork verify --element ./corotational.so -f corotational */
#include <math.h>
#include <string.h>

#include "elements/element.h"

enum { N = 12, NODES = 2 * NODE_COORDINATES }; /* (u, phi) of two nodes, as in element.h */

struct element_data {
    double length, axial; /* [m], E A / l [N/m] */
    double k[36]; /* stiffness of the moments on both nodes with respect to their rotations [N m] */
};

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(element_data);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    const section *c = request->section;
    const double l = request->length, shear = request->features & FEATURE_SHEAR ? 12 : 0;
    const double GI = c->shear_modulus * c->It, EI[] = {GI, c->young * c->Iy, c->young * c->Iz};
    (void)f;
    memset(out, 0, sizeof *out);
    out->length = l;
    out->axial = c->young * c->A / l;
    for (int i = 0; i < 3; i++) { /* torsion, then bending of the Timoshenko beam, or of the
                                     Bernoulli beam if phi = 0 */
        const double phi = shear * EI[i] * c->F[i == 1 ? 4 : 0] / (c->shear_modulus * l * l);
        const double near = i == 0 ? 1 : (4 + phi) / (1 + phi);
        const double far = i == 0 ? -1 : (2 - phi) / (1 + phi);
        out->k[7 * i] = out->k[7 * (i + 3)] = near * EI[i] / l;
        out->k[7 * i + 3] = out->k[7 * i + 18] = far * EI[i] / l;
    }
    return STATUS_OK;
}

/* Adds A B to C [m x n]. A is [m x k], or [k x m] if transposed. */
static void add(int m, int n, int k, int transposed, const double *A, const double *B, double *C)
{
    for (int i = 0; i < m * k * n; i++) {
        const int row = i / n / k, p = i / n % k, j = i % n;
        C[row * n + j] += A[transposed ? p * m + row : row * k + p] * B[p * n + j];
    }
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Computes S, where S b = scale v x b. */
static void spin(double scale, const double v[3], double S[9])
{
    const double one[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    for (int i = 0; i < 9; i++)
        S[i] = scale * one[i];
}

static status force(const element_data *d, const node_state x[], force_output *out)
{
    double E[9], y[3], square = 0, change = 0; /* the rows of E are the axes */
    for (int i = 0; i < 3; i++) {
        const double du = x[1].u[i] - x[0].u[i];
        E[i] = x[1].r[i] - x[0].r[i];
        y[i] = (x[0].R[3 * i + 1] + x[1].R[3 * i + 1]) / 2;
        square += E[i] * E[i];
        change += du * (2 * E[i] - du); /* change of the squared length, from which the elongation
                                           follows without cancellation */
    }
    cross(E, y, E + 6);
    const double ln = sqrt(square), n = d->axial * change / (ln + d->length);
    const double height = sqrt(E[6] * E[6] + E[7] * E[7] + E[8] * E[8]);
    for (int i = 0; i < 3; i++) {
        E[i] /= ln;
        E[6 + i] /= height;
    }
    cross(E + 6, E, E + 3);
    if (!(height > 0)) /* true if the mean y axis is along the chord */
        return STATUS_SINGULAR;

    /* The following quantities are in the element axes: S = E R, t of both nodes, and the moments M
     * on the nodes. */
    double S[2][9] = {{0}}, t[6], M[6] = {0}, energy = n * n / d->axial / 2;
    for (int k = 0; k < 2; k++) {
        add(3, 3, 3, 0, E, x[k].R, S[k]);
        for (int i = 0; i < 3; i++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            t[3 * k + i] = (S[k][3 * b + a] - S[k][3 * a + b]) / 2;
        }
    }
    add(6, 1, 6, 0, d->k, t, M);
    for (int i = 0; i < 6; i++)
        energy += M[i] * t[i] / 2;

    /* The chord changes by d ln = r d. The axes rotate by omega = W d; the x component of omega
     * follows from the mean y axis (q1, q2, 0). The nodes rotate by P d = phi - omega relative to
     * the axes. */
    const double q1 = (S[0][1] + S[1][1]) / 2, q2 = (S[0][4] + S[1][4]) / 2, s = q1 / q2;
    double r[N] = {-1, 0, 0, 0, 0, 0, 1}, W[3 * N] = {0}, P[6 * N], D[6 * N] = {0};
    for (int k = 0; k < 2; k++) {
        W[2 * N + 6 * k + 1] = r[6 * k] / ln;
        W[N + 6 * k + 2] = -r[6 * k] / ln;
        W[6 * k + 2] = s * W[N + 6 * k + 2];
        W[6 * k + 3] = S[k][4] / (2 * q2);
        W[6 * k + 4] = -S[k][1] / (2 * q2);
    }
    for (int i = 0; i < 6 * N; i++)
        P[i] = (i % N == i / N + (i < 3 * N ? 3 : 6)) - W[i % (3 * N)];

    double F[N], K[N * N] = {0}, kD[6 * N] = {0}, dq[2][3 * N] = {{0}}, torque = 0;
    for (int k = 0; k < 2; k++) { /* dt = D d = A P d */
        double A[9], H[9], HP[3 * N] = {0}, B[9], *Pk = P + 3 * k * N, *Mk = M + 3 * k;
        const double q[3] = {S[k][1], S[k][4], S[k][7]};
        for (int i = 0; i < 9; i++) {
            A[i] = ((i % 4 == 0) * (S[k][0] + S[k][4] + S[k][8]) - S[k][i]) / 2;
            H[i] = -Mk[i / 3] * t[3 * k + i % 3]; /* d(A^T M) = -(M t^T + S^T M~ / 2) P d */
        }
        for (int i = 0; i < 3; i++)
            torque += A[3 * i] * Mk[i];
        spin(-0.5, Mk, B);
        add(3, 3, 3, 1, S[k], B, H);
        add(3, N, 3, 0, H, Pk, HP);
        add(N, N, 3, 1, Pk, HP, K); /* geometric stiffness due to moments */
        add(3, N, 3, 0, A, Pk, D + 3 * k * N);
        spin(-1, q, B);
        add(3, N, 3, 0, B, Pk, dq[k]);
    }
    for (int i = 0; i < N; i++)
        F[i] = n * r[i];
    add(N, 1, 6, 1, D, M, F);
    add(6, N, 6, 0, d->k, D, kD);
    add(N, N, 6, 1, D, kD, K); /* material stiffness */
    for (int b = 0; b < N; b += 3) {
        double B[9];
        spin(-1, F + b, B);
        add(3, N, 3, 0, B, W, K + b * N); /* geometric stiffness: forces rotate with the axes */
    }
    for (int i = 0; i < 2 * N;
         i++) { /* material stiffness, and geometric stiffness due to the change of W */
        const int k = i / N, j = i % N;
        const double d1 = (dq[0][j] + dq[1][j]) / 2, d2 = (dq[0][N + j] + dq[1][N + j]) / 2;
        double *row = K + 6 * k * N + j;
        row[0] += r[6 * k] * d->axial * r[j];
        row[N] -= F[6 * k + 1] * r[j] / ln;
        row[2 * N] -= F[6 * k + 2] * r[j] / ln + torque * W[N + 6 * k + 2] * (d1 - s * d2) / q2;
        row[3 * N] -= torque * (dq[k][N + j] - S[k][4] * d2 / q2) / (2 * q2);
        row[4 * N] += torque * (dq[k][j] - S[k][1] * d2 / q2) / (2 * q2);
    }

    double T[N * NODES] = {0}, KT[N * NODES] = {0}; /* global axes, without warping */
    for (int i = 0; i < 36; i++)
        T[i / 3 * NODES + i / 9 * 3 + i / 18 + i % 3] = E[i % 9];
    if (out->energy != NULL)
        *out->energy = energy;
    if (out->F != NULL) {
        memset(out->F, 0, NODES * sizeof *F);
        add(NODES, 1, N, 1, T, F, out->F);
    }
    if (out->K != NULL) {
        memset(out->K, 0, NODES * NODES * sizeof *K);
        add(N, NODES, N, 0, K, T, KT);
        add(NODES, NODES, N, 1, T, KT, out->K);
    }
    return STATUS_OK;
}

const element_type beamwork_element = {
    .abi = ELEMENT_ABI,
    .size = sizeof(element_type),
    .name = "corotational",
    .summary = "two nodes, linear beam in axes that follow the element",
    .source = "Crisfield (1990); axes of Battini and Pacoste (2002)",
    .family = "example",
    .offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA,
    .shear_theories = SHEAR_ENGESSER,
    .limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_QUARTER_TURN,
    .data_size = data_size,
    .prepare = prepare,
    .force = force,
};
