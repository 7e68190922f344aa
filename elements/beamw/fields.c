#include "elements/beamw/fields.h"

#include <math.h>
#include <string.h>

#include "elements/beamw/variants.h"
#include "elements/math/dense.h"
#include "elements/math/scalar.h"

/* For a bimoment that is odd about the middle, B = b sinh(lambda (x - 1/2))/sinh(lambda/2), the
 * complementary energy is 1/2 [(T - M)^2 l/(G It) + l (Q, M) f (Q, M) + M^2 l (1/(G It) + f_ww)
 * excess], where M is the mean of M_w. Bending, shear and warping are in series as for cubic
 * functions, with the warping stiffness E Iw lambda^2/(l excess). For even B, the energy follows
 * from the products B a at the ends. No expression below overflows or loses digits by cancellation,
 * for any lambda > 0. */

enum { CUBIC_POINTS = 4, PANEL_POINTS = 16, LAYER_PANELS = 4 };
/* Largest product of lambda and panel width for which 16 points integrate with an error below
 * e^-20. */
static const double panel_decay = 10;

/* Returns sinh h - h. */
static double sinh_excess(double h)
{
    if (fabs(h) > 1)
        return sinh(h) - h;
    double term = h, sum = 0;
    for (int k = 1; k < 10; k++) {
        term *= h * h / (2 * k * (2 * k + 1));
        sum += term;
    }
    return sum;
}

/* Returns sinh(lambda y)/sinh(lambda/2) for |y| <= 1/2. */
static double sinh_ratio(double lambda, double y)
{
    const double a = fabs(y),
                 ratio = exp(lambda * (a - 0.5)) * expm1(-2 * lambda * a) / expm1(-lambda);
    return y < 0 ? -ratio : ratio;
}

beamw_twist beamw_twist_of(const section *c, double l, int shear, beamw_twist_kind kind)
{
    const double EIw = c->young * c->Iw, GIt = c->shear_modulus * c->It, l3 = l * l * l;
    beamw_twist t = {.uneven = 12 * EIw / l + GIt * l / 5,
                     .opposite = GIt / (3 * l3) + 4 * EIw / (l3 * l * l),
                     .soft = 1};
    if (kind == BEAMW_TWIST_CUBIC || !(GIt > 0) || !(EIw > 0))
        return t;
    if (shear) {
        t.soft = 1 + c->F[8] * c->It;
        t.lag[0] = c->F[2] * c->It;
        t.lag[1] = c->F[5] * c->It;
    }
    t.lambda = l * sqrt(GIt / EIw / t.soft);
    const double h = t.lambda / 2, half = sinh(fmin(h, 1) / 2);
    t.excess = h < 1 ? (2 * h * half * half - sinh_excess(h)) / sinh(h)
                     : h * (1 + exp(-2 * h)) / -expm1(-2 * h) - 1;
    t.uneven = EIw / l * (t.lambda * t.lambda / t.excess);
    t.opposite = 4 * EIw / (l3 * l * l) * (1 + t.excess);
    return t;
}

beamw_twist_shapes beamw_twist_at(const beamw_twist *t, double x)
{
    const double y = x - 0.5, h = t->lambda / 2;
    beamw_twist_shapes s;
    if (t->lambda == 0) {
        s.odd = 1 - 2 * x;
        s.even = 6 * x * (1 - x) - 1;
        s.odd_integral = x * (1 - x);
        s.even_integral = x * (3 * x - 2 * x * x - 1);
        return s;
    }
    const double ratio = sinh_ratio(t->lambda, y);
    s.odd = -ratio / t->soft;
    s.odd_integral =
        expm1(-2 * h * x) * expm1(-2 * h * (1 - x)) / (-2 * h * expm1(-2 * h)) / t->soft;
    if (h < 1) {
        const double half = sinh(h * y), scale = sinh(h) * t->excess * t->soft;
        s.even = (sinh_excess(h) - 2 * h * half * half) / scale;
        s.even_integral = (y * sinh_excess(h) - sinh_excess(2 * h * y) / 2) / scale;
    } else {
        const double a = t->lambda * fabs(y),
                     cosh_ratio = exp(a - h) * (1 + exp(-2 * a)) / -expm1(-2 * h);
        s.even = (1 - h * cosh_ratio) / (t->excess * t->soft);
        s.even_integral = (y - ratio / 2) / (t->excess * t->soft);
    }
    return s;
}

static int panels_of(const beamw_twist *t, double edge[2 * LAYER_PANELS + 2])
{
    int panels = 1;
    if (t->lambda <= 2 * LAYER_PANELS * panel_decay) {
        panels = t->lambda > panel_decay ? (int)ceil(t->lambda / panel_decay) : 1;
        for (int i = 0; i <= panels; i++)
            edge[i] = (double)i / panels;
        return panels;
    }
    panels = 2 * LAYER_PANELS + 1;
    for (int i = 0; i <= LAYER_PANELS; i++) {
        edge[i] = i * panel_decay / t->lambda;
        edge[panels - i] = 1 - edge[i];
    }
    return panels;
}

int beamw_twist_points(const beamw_twist *t, double from, double to,
                       double x[BEAMW_TWIST_MAX_POINTS], double w[BEAMW_TWIST_MAX_POINTS])
{
    double point[PANEL_POINTS], weight[PANEL_POINTS], edge[2 * LAYER_PANELS + 2];
    const int each = t->lambda == 0 ? CUBIC_POINTS : PANEL_POINTS, panels = panels_of(t, edge);
    int count = 0;
    quadrature_points(each, point, weight);
    for (int k = 0; k < panels; k++) {
        const double begin = fmax(edge[k], from), length = fmin(edge[k + 1], to) - begin;
        for (int i = 0; i < each && length > 0; i++, count++) {
            x[count] = begin + length * point[i];
            w[count] = length * weight[i];
        }
    }
    return count;
}

/* Let h be the antisymmetric part of the deformation and A = (e7 - e8)/2. The energy of the linear
 * fields of J section 3.2 is 1/2 [EA/l e1^2 + EIy/l^3 (e3+e4)^2 + EIz/l^3 (e5+e6)^2 + GIt/l^3 (e2^2
 * + A^2/3) + 4 EIw/l^5 A^2 + h^T K h], where K is the stiffness of bending and shear in series.
 * This form has no cancellation for Phi -> 0 or Phi -> inf. */

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

/* Computes M of hg = M h, where hg is the bending part of h. */
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
    /* this form of (Ka + G l D)^-1 G l D = (I + F Ka/(G l))^-1 also exists for F = 0 */
    double A[9];
    int pivot[3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            A[3 * i + j] = (i == j) + c->F[3 * i + j] * stiffness[j] / (c->shear_modulus * l);
            M[3 * i + j] = i == j;
        }
    dense_lu(3, A, pivot);
    dense_lu_solve(3, 3, A, pivot, M);
}

static void series(const section *c, double l, beamw_stiffness_shear kind,
                   const double stiffness[3], const double M[9], double K[9])
{
    const double bend[3] = {stiffness[0], stiffness[1], 12 * c->young * c->Iw / l},
                 torsion = c->shear_modulus * c->It * l / 5;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            if (kind != BEAMW_STIFFNESS_DIAGONAL)
                K[3 * i + j] = (stiffness[i] * M[3 * i + j] + stiffness[j] * M[3 * j + i]) / 2;
            else if (i == j) /* J App. A: bending and shear in series, plus Saint-Venant torsion of
                                the twist due to shear */
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
