/* With h the antisymmetric part of the deformation and A = (e7 - e8)/2, the energy of the linear
 * fields of J section 3.2 is 1/2 [EA/l e1^2 + EIy/l^3 (e3+e4)^2 + EIz/l^3 (e5+e6)^2 + GIt/l^3 (e2^2
 * + A^2/3) + 4 EIw/l^5 A^2 + h^T K h], K the stiffness of bending and shear in series.  Written so,
 * nothing cancels: neither for Phi -> 0 nor for Phi -> inf. */
#include "elements/beamw/stiffness.h"

#include <string.h>

#include "elements/beamw/variants.h"
#include "elements/math/dense.h"

enum { Y, Z, W };

static void antisymmetric_functionals(const section *c, double l, beamw_stiffness_fields *f)
{
    memset(f, 0, sizeof *f);
    f->h[Y][4] = 1 / (2 * l);
    f->h[Y][5] = -1 / (2 * l);
    f->h[Y][1] = -c->zs / (l * l);
    f->h[Z][3] = 1 / (2 * l);
    f->h[Z][2] = -1 / (2 * l);
    f->h[Z][1] = c->ys / (l * l);
    f->h[W][1] = 1 / (l * l);
    f->h[W][6] = f->h[W][7] = -1 / (2 * l * l);
    f->A[6] = 0.5;
    f->A[7] = -0.5;
}

/* Part of h that is bending: hg = M h. */
static void split(const section *c, double l, beamw_stiffness_shear kind, const double stiffness[3],
                  double M[9])
{
    memset(M, 0, 9 * sizeof(double));
    if (kind != BEAMW_STIFFNESS_COUPLED) {
        const double inertia[3] = {c->Iz, c->Iy, c->Iw};
        for (int i = 0; i < 3; i++) {
            const double D = c->D[4 * i];
            const double Phi = kind == BEAMW_STIFFNESS_RIGID || D == 0
                                   ? 0
                                   : 12 * c->young * inertia[i] / (c->shear_modulus * D * l * l);
            M[4 * i] = 1 / (1 + Phi);
        }
        return;
    }
    /* (Ka + G l D)^-1 G l D = (I + F Ka/(G l))^-1, which exists for F = 0 too */
    double A[9];
    int pivot[3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            A[3 * i + j] = (i == j) + c->F[3 * i + j] * stiffness[j] / (c->shear_modulus * l);
            M[3 * i + j] = i == j;
        }
    dense_lu(3, A, pivot); /* never singular: F and Ka are positive semidefinite */
    dense_lu_solve(3, 3, A, pivot, M);
}

/* K of the energy 1/2 h^T K h. */
static void series(const section *c, double l, beamw_stiffness_shear kind,
                   const double stiffness[3], const double M[9], double K[9])
{
    const double bend[3] = {stiffness[0], stiffness[1], 12 * c->young * c->Iw / l},
                 torsion = c->shear_modulus * c->It * l / 5;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            if (kind != BEAMW_STIFFNESS_DIAGONAL)
                K[3 * i + j] = (stiffness[i] * M[3 * i + j] + stiffness[j] * M[3 * j + i]) / 2;
            else if (i == j) /* J App. A: bending and shear in series, Saint-Venant torsion of the
                                flexible field */
                K[4 * i] = bend[i] * M[4 * i] + (i == W ? torsion * M[4 * i] * M[4 * i] : 0);
            else
                K[3 * i + j] =
                    c->shear_modulus * l * c->D[3 * i + j] * (1 - M[4 * i]) * (1 - M[4 * j]);
        }
}

static void add_square(double S[8 * 8], double k, const double a[8])
{
    beamw_variants_add_product(S, k / 2, a, a);
}

void beamw_stiffness_of(const section *c, double l, beamw_stiffness_shear kind,
                        const beamw_twist *t, beamw_stiffness_fields *f, double S[8 * 8])
{
    const double E = c->young, G = c->shear_modulus, l3 = l * l * l;
    const double Ka[3] = {12 * E * c->Iz / l, 12 * E * c->Iy / l, t->uneven};
    double M[9], K[9];
    antisymmetric_functionals(c, l, f);
    split(c, l, kind, Ka, M);
    series(c, l, kind, Ka, M, K);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 8; k++) {
            for (int j = 0; j < 3; j++)
                f->hg[i][k] += M[3 * i + j] * f->h[j][k];
            f->g[i][k] = f->h[i][k] - f->hg[i][k];
        }
    for (int k = 0; k < 8; k++)
        f->tw[k] = l * l * f->hg[W][k];

    const double e1[8] = {1}, e2[8] = {0, 1}, sum_y[8] = {0, 0, 1, 1},
                 sum_z[8] = {0, 0, 0, 0, 1, 1};
    memset(S, 0, 64 * sizeof(double));
    add_square(S, E * c->A / l, e1);
    add_square(S, E * c->Iy / l3, sum_y);
    add_square(S, E * c->Iz / l3, sum_z);
    add_square(S, G * c->It / l3, e2);
    add_square(S, t->opposite, f->A);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            beamw_variants_add_product(S, K[3 * i + j] / 2, f->h[i], f->h[j]);
}
