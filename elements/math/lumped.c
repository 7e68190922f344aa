#include "elements/math/lumped.h"

#include "elements/math/dense.h"

static void skew(const double v[3], double S[9])
{
    const double all[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    for (int i = 0; i < 9; i++)
        S[i] = all[i];
}

void lumped_rotary(const double inertia[7], const double R[9], double J[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            J[3 * i + j] = R[3 * i] * inertia[3] * R[3 * j] + R[3 * i + 1] * inertia[4] * R[3 * j + 1] +
                           R[3 * i + 2] * inertia[5] * R[3 * j + 2];
}

void lumped_convective(const double J[9], const double w[3], double h[3], double dh_dw[9])
{
    double momentum[3], W[9], P[9];
    mat3_mul_vec(J, w, momentum);
    vec3_cross(w, momentum, h);
    skew(w, W);
    skew(momentum, P);
    mat3_mul(W, J, dh_dw);
    for (int i = 0; i < 9; i++)
        dh_dw[i] -= P[i];
}

/* d(J v)/dtheta = J v~ - (J v)~. */
static void turned(const double J[9], const double v[3], double out[9])
{
    double Jv[3], V[9], P[9];
    mat3_mul_vec(J, v, Jv);
    skew(v, V);
    skew(Jv, P);
    mat3_mul(J, V, out);
    for (int i = 0; i < 9; i++)
        out[i] -= P[i];
}

void lumped_turning(const double J[9], const double w[3], const double alpha[3], double dfdx[9])
{
    double W[9], of_w[9], convective[9];
    turned(J, alpha, dfdx);
    turned(J, w, of_w);
    skew(w, W);
    mat3_mul(W, of_w, convective);
    for (int i = 0; i < 9; i++)
        dfdx[i] += convective[i];
}
