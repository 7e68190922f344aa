/* The complementary energy of B odd about the middle, B = b sinh(lambda (x - 1/2))/sinh(lambda/2),
 * is 1/2 [(T - M)^2 l/(G It) + l (Q, M) f (Q, M) + M^2 l (1/(G It) + f_ww) excess],  M the mean of
 * M_w: bending, shear and warping in series, as with cubic functions, the warping with the
 * stiffness E Iw lambda^2/(l excess).  Of B even it is that of the ends, B a.  Nothing here
 * overflows or cancels for any lambda > 0. */
#include "elements/beamw/twist.h"

#include <math.h>

#include "elements/math/quadrature.h"

enum { CUBIC_POINTS = 4, PANEL_POINTS = 16, LAYER_PANELS = 4 };
/* Lambda times the width of a panel: e^-20 within 16 points. */
static const double panel_decay = 10;

/* sinh h - h. */
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

/* sinh(lambda y)/sinh(lambda/2), |y| <= 1/2. */
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

/* Where the panels of an element end; returns how many panels. */
static int panels_of(const beamw_twist *t, double edge[2 * LAYER_PANELS + 2])
{
    int panels = 1;
    if (t->lambda <= 2 * LAYER_PANELS * panel_decay) {
        panels = t->lambda > panel_decay ? (int)ceil(t->lambda / panel_decay) : 1;
        for (int i = 0; i <= panels; i++)
            edge[i] = (double)i / panels;
        return panels;
    }
    /* layers at the ends, nothing but polynomials between */
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
