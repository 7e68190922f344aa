#ifndef BEAMWORK_BEAMW_FIELDS_H
#define BEAMWORK_BEAMW_FIELDS_H

#include "elements/section/section.h"
#include "elements/shared/masses.h"
#include "elements/shared/status.h"

/* Distribution of the twist rate along an element: cubic functions (J Eq. 38), or hyperbolic
 * functions, which are the exact linear solution with Saint-Venant torsion. For the exact solution,
 * M_w = -B' is constant apart from the effect of torsion: T = G It kx + M_w and kx - a = f (Q,
 * M_w), B'' = (lambda/l)^2 B, lambda^2 = l^2 G It/(E Iw (1 + r)), r = G It f_ww, l^2 kx = e2 + A
 * odd(x) + tw even(x). In the limit lambda -> 0, odd is 1 - 2x and even is 6x(1-x) - 1. */

typedef enum beamw_twist_kind { BEAMW_TWIST_CUBIC, BEAMW_TWIST_HYPERBOLIC } beamw_twist_kind;

typedef struct beamw_twist {
    double uneven;   /* [N m^3] stiffness of hg_w, the even part of the warping */
    double opposite; /* [N/m] stiffness of A = (e7 - e8)/2, the odd part */
    double lambda;   /* 0 for the cubic function */
    double excess;   /* lambda/2 coth(lambda/2) - 1 */
    double soft;     /* 1 + r */
    double lag[2];   /* G It (f_yw, f_zw) [m]: ratio by which the part of kx above its mean reduces
                        the shear strains */
} beamw_twist;

/* Returns the twist functions of an element of length l. `shear` is 0 if the section is rigid in
 * shear. If It or Iw is 0, both kinds give cubic functions. */
beamw_twist beamw_twist_of(const section *c, double l, int shear, beamw_twist_kind kind);

typedef struct beamw_twist_shapes {
    double odd, even;                   /* odd(x) and even(x), as defined above */
    double odd_integral, even_integral; /* integrals of odd and even from 0 to x */
} beamw_twist_shapes;

beamw_twist_shapes beamw_twist_at(const beamw_twist *t, double x);

enum { BEAMW_TWIST_MAX_POINTS = 144 };

/* Computes the points and weights of a quadrature on [from, to] in [0, 1] for products of two shape
 * functions with polynomials. Returns the number of points. */
int beamw_twist_points(const beamw_twist *t, double from, double to,
                       double x[BEAMW_TWIST_MAX_POINTS], double w[BEAMW_TWIST_MAX_POINTS]);

/* Stiffness of the BEAMW variants as a sum of squares (J section 3.2, App. A), and the linear shear
 * functionals. */

typedef enum beamw_stiffness_shear {
    BEAMW_STIFFNESS_RIGID,    /* Phi = 0: Vlasov */
    BEAMW_STIFFNESS_DIAGONAL, /* J App. A, where Phi depends only on the diagonal of D */
    BEAMW_STIFFNESS_COUPLED /* uses the whole matrix D: exact at the nodes for any positive definite
                               D, provided that It = 0 or the twist is hyperbolic */
} beamw_stiffness_shear;

/* Linear functionals of e, used for stiffness, modified modes and inertia. */
typedef struct beamw_stiffness_fields {
    double h[3][8];  /* [1/m, 1/m, 1/m^2] mean antisymmetric deformation (y, z, omega), the sum of
                        the bending part and the shear strain */
    double hg[3][8]; /* bending part of h (warping part for omega) */
    double g[3][8];  /* [1/m, 1/m, 1/m^2] shear strains g_y, g_z, g_w: h - hg */
    double A[8];     /* (e7 - e8)/2 */
    double tw[8];    /* l0^2 hg_w */
} beamw_stiffness_fields;

/* Computes the stiffness. `t` is the result of beamw_twist_of for the same section, length and
 * value of `shear`. */
void beamw_stiffness_of(const section *c, double l0, beamw_stiffness_shear kind,
                        const beamw_twist *t, beamw_stiffness_fields *fields, double S[8 * 8]);

/* Mass along a two-node element. The displacements are the sum of interpolated nodal values and
 * functionals of the deformation modes (beamw/inertia.c). */

enum {
    BEAMW_GAUSS = 8,      /* largest number of points of the consistent mass */
    BEAMW_FIELDS = 6,     /* number of functionals at each point */
    BEAMW_FIELD_MODES = 8 /* number of modes of J Eq. 7 */
};

typedef struct beamw_spread {
    double l0;                                   /* [m] */
    lumped_mass lumped;                          /* inertia of one half of the element */
    int points;                                  /* number of points of the consistent mass */
    double at[BEAMW_GAUSS], weight[BEAMW_GAUSS]; /* on [0, 1] */
    double field[BEAMW_GAUSS][BEAMW_FIELDS]
                [BEAMW_FIELD_MODES]; /* functionals of e at the points, see inertia.c */
    double share; /* fraction of consistent mass: 0 for lumped mass, 1 for consistent mass, 1/2 for
                     the average */
} beamw_spread;

status beamw_spread_inertia(const beamw_spread *, const node_state x[2],
                            const element_rotating_frame *, inertia_output *);

/* Mass along a two-node element in transient analysis: inertia forces and their derivatives. The
 * masses follow the displacements defined above, but the warping mass is at the nodes. Without
 * rotary inertia, the twist is linear between the nodes. If the nodes move as a rigid body, all
 * masses move as part of this body. */

/* Adds M, taken, C and K at the rate in `out` to `out`; of M, only the upper half is valid
 * (moving_complete). The second function is for processors with AVX2 and gives bit-for-bit
 * identical results (elements/math/real.h). */
typedef void beamw_in_time(const beamw_spread *, const node_state x[2], inertia_output *out);
beamw_in_time beamw_in_time_plain, beamw_in_time_avx2;

#endif
