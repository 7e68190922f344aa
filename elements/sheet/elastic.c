#include "elements/sheet/elastic.h"

#include <string.h>

#include "elements/math/dense.h"

enum { N = SHEET_STRAINS };

double sheet_elastic_phi_y(const section *c, double l0)
{
    return 12 * c->young * c->Iz * c->F[0] / (c->shear_modulus * l0 * l0);
}

double sheet_elastic_phi_z(const section *c, double l0)
{
    return 12 * c->young * c->Iy * c->F[4] / (c->shear_modulus * l0 * l0);
}

/* (4 + Phi)/(1 + Phi) = 1 + 3/(1 + Phi), (-2 + Phi)/(1 + Phi) = 1 - 3/(1 + Phi): N Eqs. 35, 36. */
static void bending(double EI, double l0, double Phi, int at, double S[N * N])
{
    const double k = EI / (l0 * l0 * l0), antisymmetric = 3 / (1 + Phi);
    S[N * at + at] = S[N * (at + 1) + at + 1] = k * (1 + antisymmetric);
    S[N * at + at + 1] = S[N * (at + 1) + at] = k * (1 - antisymmetric);
}

void sheet_elastic_stiffness(const section *c, double l0, double Phi_y, double Phi_z,
                             double S[N * N])
{
    static const int torsion[3] = {1, 6, 7};
    static const double saint_venant[3][3] = {{36, -3, -3}, {-3, 4, -1}, {-3, -1, 4}};
    static const double warping[3][3] = {{12, -6, -6}, {-6, 4, 2}, {-6, 2, 4}};
    const double l3 = l0 * l0 * l0, GJ = c->shear_modulus * c->It / (30 * l3),
                 EIw = c->young * c->Iw / (l3 * l0 * l0);
    memset(S, 0, N * N * sizeof(double));
    S[0] = c->young * c->A / l0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            S[N * torsion[i] + torsion[j]] = GJ * saint_venant[i][j] + EIw * warping[i][j];
    bending(c->young * c->Iy, l0, Phi_z, 2, S);
    bending(c->young * c->Iz, l0, Phi_y, 4, S);
}
