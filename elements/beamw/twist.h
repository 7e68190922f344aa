/* How the rate of twist is distributed along an element: cubic functions (J Eq. 38), or hyperbolic
 * ones, the exact linear solution with Saint-Venant torsion.  With M_w = -B' constant but for
 * torsion, T = G It kx + M_w and kx - a = f (Q, M_w), B'' = (lambda/l)^2 B,  lambda^2 = l^2 G It/(E
 * Iw (1 + r)),  r = G It f_ww, l^2 kx = e2 + A odd(x) + tw even(x);  odd -> 1 - 2x, even -> 6x(1-x)
 * - 1 for lambda -> 0. */
#ifndef BEAMWORK_BEAMW_TWIST_H
#define BEAMWORK_BEAMW_TWIST_H

#include "elements/section/section.h"
#include "elements/shared/status.h"

typedef enum beamw_twist_kind { BEAMW_TWIST_CUBIC, BEAMW_TWIST_HYPERBOLIC } beamw_twist_kind;

typedef struct beamw_twist {
    double uneven;   /* [N m^3] stiffness of hg_w, the even part of the warping */
    double opposite; /* [N/m] of A = (e7 - e8)/2, the odd part */
    double lambda;   /* 0: cubic */
    double excess;   /* lambda/2 coth(lambda/2) - 1 */
    double soft;     /* 1 + r */
    double
        lag[2]; /* G It (f_yw, f_zw) [m]: kx above its mean takes so much from the shear strains */
} beamw_twist;

/* shear: 0 where the section is rigid in shear.  Iw = 0 has cubic functions only: nothing warps. */
beamw_twist beamw_twist_of(const section *c, double l, int shear, beamw_twist_kind kind);

typedef struct beamw_twist_shapes {
    double odd, even;                   /* as above */
    double odd_integral, even_integral; /* from 0 to x */
} beamw_twist_shapes;

beamw_twist_shapes beamw_twist_at(const beamw_twist *t, double x);

enum { BEAMW_TWIST_MAX_POINTS = 144 };

/* Points and weights on [from, to] in [0, 1] that integrate products of two of the shapes with
 * polynomials; returns how many. */
int beamw_twist_points(const beamw_twist *t, double from, double to,
                       double x[BEAMW_TWIST_MAX_POINTS], double w[BEAMW_TWIST_MAX_POINTS]);

#endif
