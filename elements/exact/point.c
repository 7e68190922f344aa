/* In the axes of the section, A = u^-1 dQ/m and D = u^-1 dQ'/m, with (A0, A) their scalar and
 * vector parts: dkappa = 2 D - A0 kappa - 2 eta A - A x kappa,   dv = dy - 2 A x v, d2kappa = 2
 * (A0^2 - |A|^2) kappa + 8 eta A0 A + 4 A0 A x kappa - 4 (A0 D + D0 A + A x D), d2v = 4 A0 A x v +
 * 4 A x (A x v) - 4 A x dy, from the expansion of Q^-1 Q' and of the rotation 2 Im Q/Re Q. */
#include "elements/exact/point.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

void exact_point_align(int nodes, double q[][4])
{
    for (int k = 1; k < nodes; k++) {
        double dot = 0;
        for (int i = 0; i < 4; i++)
            dot += q[k - 1][i] * q[k][i];
        if (dot < 0)
            for (int i = 0; i < 4; i++)
                q[k][i] = -q[k][i];
    }
}

void exact_point_at(int nodes, const double q[], const double N[], const double dN[],
                    const double y[3], exact_point *p)
{
    double Q[4] = {0}, S[4] = {0}, inverse[4], h[4];
    for (int k = 0; k < nodes; k++)
        for (int i = 0; i < 4; i++) {
            Q[i] += N[k] * q[4 * k + i];
            S[i] += dN[k] * q[4 * k + i];
        }
    p->m = sqrt(Q[0] * Q[0] + Q[1] * Q[1] + Q[2] * Q[2] + Q[3] * Q[3]);
    for (int i = 0; i < 4; i++)
        p->u[i] = Q[i] / p->m;
    rotation_conjugate(p->u, inverse);
    rotation_compose(inverse, S, h);
    p->eta = h[0] / p->m;
    for (int i = 0; i < 3; i++)
        p->kappa[i] = 2 * h[i + 1] / p->m;
    rotation_matrix(p->u, p->R);
    mat3_transpose_mul_vec(p->R, y, p->v);
}

void exact_point_gradient(const exact_point *p, const double n[3], const double f[3], double Q[4],
                          double S[4])
{
    double across[3], v_cross_f[3], A[4], D[4];
    vec3_cross(p->kappa, n, across);
    vec3_cross(p->v, f, v_cross_f);
    A[0] = -vec3_dot(n, p->kappa) / p->m;
    D[0] = 0;
    for (int i = 0; i < 3; i++) {
        A[i + 1] = -(2 * p->eta * n[i] + across[i] + 2 * v_cross_f[i]) / p->m;
        D[i + 1] = 2 * n[i] / p->m;
    }
    rotation_compose(p->u, A, Q);
    rotation_compose(p->u, D, S);
}

/* out = U W U^T/m^2, U the matrix of the product with u from the left. */
static void to_fixed(const exact_point *p, double W[16], double out[16])
{
    double half[16];
    for (int i = 0; i < 4; i++)
        rotation_compose(p->u, &W[4 * i], &half[4 * i]); /* rows: W U^T */
    for (int j = 0; j < 4; j++) {
        double column[4];
        for (int i = 0; i < 4; i++)
            column[i] = half[4 * i + j] / (p->m * p->m);
        rotation_compose(p->u, column, column);
        for (int i = 0; i < 4; i++)
            out[4 * i + j] = column[i];
    }
}

void exact_point_hessian(const exact_point *p, const double n[3], const double f[3], double QQ[16],
                         double QS[16], double QY[12])
{
    double across[3], v_cross_f[3], AA[16], AD[16], AY[12] = {0};
    const double *v = p->v, nk = vec3_dot(n, p->kappa), fv = vec3_dot(f, v);
    vec3_cross(p->kappa, n, across);
    vec3_cross(v, f, v_cross_f);
    memset(AD, 0, sizeof AD);
    AA[0] = 2 * nk;
    for (int i = 0; i < 3; i++) {
        AA[i + 1] = AA[4 * (i + 1)] = 4 * p->eta * n[i] + 2 * across[i] + 2 * v_cross_f[i];
        for (int j = 0; j < 3; j++)
            AA[4 * (i + 1) + j + 1] =
                2 * (f[i] * v[j] + v[i] * f[j]) - (i == j ? 2 * nk + 4 * fv : 0);
        AD[i + 1] = AD[4 * (i + 1)] = -2 * n[i];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        AD[4 * (i + 1) + j + 1] = -2 * n[k];
        AD[4 * (j + 1) + i + 1] = 2 * n[k];
        AY[3 * (i + 1) + j] = -2 * f[k];
        AY[3 * (j + 1) + i] = 2 * f[k];
    }
    to_fixed(p, AA, QQ);
    to_fixed(p, AD, QS);
    double half[12];
    dense_mul(4, 3, 3, AY,
              (const double[9]){p->R[0], p->R[3], p->R[6], p->R[1], p->R[4], p->R[7], p->R[2],
                                p->R[5], p->R[8]},
              half);
    for (int j = 0; j < 3; j++) {
        double column[4];
        for (int i = 0; i < 4; i++)
            column[i] = half[3 * i + j] / p->m;
        rotation_compose(p->u, column, column);
        for (int i = 0; i < 4; i++)
            QY[3 * i + j] = column[i];
    }
}

void exact_point_increment(const double q[4], double P[12])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double matrix[12] = {-x, -y, -z, w, z, -y, -z, w, x, y, -x, w};
    memcpy(P, matrix, sizeof matrix);
}
