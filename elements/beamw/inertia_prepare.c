/* Functionals of the strains that the consistent mass is made of: see inertia.c. */
#include "elements/beamw/inertia.h"
#include "elements/beamw/inertia_point.h"
#include "elements/math/quadrature.h"

enum { BEAMW_CUBIC_POINTS = 4 };

static void functionals_at(const section *c, double l, const beamw_stiffness_fields *s, double x,
                           double field[BEAMW_FIELDS][8])
{
    const double e2[8] = {0, 1}, sum_y[8] = {0, 0, 1, 1}, sum_z[8] = {0, 0, 0, 0, 1, 1};
    const double bend_y[8] = {0, 0, 1 - x, -x},
                 bend_z[8] = {0, 0, 0, 0, 1 - x, -x}; /* slope of the chord less lin(theta) */
    const double b = x * (1 - x), cubic = b * (1 - 2 * x), db = 1 - 2 * x, dcubic = 1 - 6 * b;
    for (int k = 0; k < 8; k++) {
        const double chi_x = (b * s->A[k] - cubic * s->tw[k]) / l;
        field[CHI_X][k] = chi_x;
        field[NU_Y][k] = c->zs * chi_x - b / 2 * sum_z[k] - l * cubic * s->hg[0][k];
        field[NU_Z][k] = -c->ys * chi_x + b / 2 * sum_y[k] - l * cubic * s->hg[1][k];
        field[CHI_Z][k] = (bend_z[k] - db / 2 * sum_z[k]) / l - c->zs * e2[k] / (l * l) -
                          dcubic * s->hg[0][k] - s->g[0][k];
        field[CHI_Y][k] = (bend_y[k] - db / 2 * sum_y[k]) / l - c->ys * e2[k] / (l * l) +
                          dcubic * s->hg[1][k] + s->g[1][k];
        field[PSI][k] = (e2[k] + db * s->A[k] - dcubic * s->tw[k]) / (l * l) - s->g[2][k];
    }
}

void beamw_inertia_prepare(const section *c, unsigned features, beamw_inertia_kind kind,
                           const beamw_stiffness_fields *fields, element_data *d)
{
    beamw_spread *s = &d->spread;
    s->lumped = lumped_of(c, features, d->l0 / 2);
    static const double share[] = {
        [BEAMW_INERTIA_LUMPED] = 0, [BEAMW_INERTIA_CONSISTENT] = 1, [BEAMW_INERTIA_AVERAGED] = 0.5};
    s->share = share[kind];
    quadrature_points(BEAMW_CUBIC_POINTS, s->at, s->weight); /* exact for the square of a cubic */
    s->l0 = d->l0;
    s->points = BEAMW_CUBIC_POINTS;
    if (s->share > 0)
        for (int g = 0; g < s->points; g++) {
            functionals_at(c, d->l0, fields, s->at[g], s->field[g]);
            if (!(features & FEATURE_WARPING))
                for (int k = 0; k < BEAMW_FIELDS; k++) { /* uniform torsion: e7 and e8 follow e2 */
                    s->field[g][k][1] += s->field[g][k][6] + s->field[g][k][7];
                    s->field[g][k][6] = s->field[g][k][7] = 0;
                }
        }
}
