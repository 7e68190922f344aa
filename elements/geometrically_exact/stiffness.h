/* Energy of the strains of strain.h, each Gauss point standing for its part of the element (reduced
 * integration: nothing locks).  With ebar = e + 1/2 (e . Q_g e) r_g the energy is 1/2 ebar . S
 * ebar, plus the Wagner torque's quartic.
 *
 * Fields that the nodes do not show are eliminated once:
 *   - bubbles of the warping amplitude, one per point: a = sum L_k a_k + sum c_j beta_j.  The twist
 * rate is what the points measure plus what of a they do not see, kappa_x(s) = P kappa + a - P a
 * with P the interpolation through the points, so that without warping shear kappa_x = a holds
 * everywhere and nothing is penalised;
 *   - of the bending moment what is above the polynomial through the points: with two nodes its
 * linear part (MacNeal's residual bending flexibility: the linear element is exact for end loads,
 * also when it is rigid in shear); with three nodes the quadratic part (derived here), and only for
 * sections that are rigid in shear, which would leave no shear flexibility at all.  It measures Q
 * against the slope of M in section axes, which differ by kappa x M: with three nodes and no shear
 *     flexibility the order is four in a plane and two in space. */
#ifndef BEAMWORK_EXACT_STIFFNESS_H
#define BEAMWORK_EXACT_STIFFNESS_H

#include "elements/geometrically_exact/strain.h"
#include "elements/shared/beam_constants.h"

enum {
    EXACT_STIFFNESS_MAX_STRAINS = 6 * EXACT_STRAIN_MAX_POINTS + ELEMENT_MAX_NODES,
    EXACT_STIFFNESS_MAX_FIELD = 4 * EXACT_STRAIN_MAX_POINTS + 1
};

typedef struct exact_stiffness {
    int strains, points, field;
    double l0;
    int modified;                                                        /* 0: ebar = e */
    double S[EXACT_STIFFNESS_MAX_STRAINS * EXACT_STIFFNESS_MAX_STRAINS]; /* [N/m] */
    /* The strains that the twist rate depends on: there are few. */
    int twisting, place[EXACT_STIFFNESS_MAX_STRAINS], order[EXACT_STIFFNESS_MAX_STRAINS]; /* -1 */
    double Q[EXACT_STRAIN_MAX_POINTS][EXACT_STIFFNESS_MAX_STRAINS]
            [EXACT_STIFFNESS_MAX_STRAINS];    /* [1/m], among them: mean of kappa_x^2 about a
                                                 point */
    double r[3];                              /* on gamma_x, kappa_y, kappa_z of the point */
    double torque[EXACT_STIFFNESS_MAX_FIELD]; /* weight of kappa_x^4 [N/m^3] */
    double twist[EXACT_STIFFNESS_MAX_FIELD]
                [EXACT_STIFFNESS_MAX_STRAINS]; /* among them: l0^2 kappa_x = twist . e */
    double Sr[EXACT_STRAIN_MAX_POINTS][EXACT_STIFFNESS_MAX_STRAINS];
    double coupling[EXACT_STRAIN_MAX_POINTS][EXACT_STRAIN_MAX_POINTS]; /* r_g . S r_h */
} exact_stiffness;

/* Head of the element_data of elements with strains at Gauss points. */
typedef struct exact_gauss {
    exact_strain_line line;
    exact_stiffness stiffness;
} exact_gauss;

status exact_stiffness_prepare(const element_request *request, int nodes, exact_stiffness *out,
                               fault *f);
status exact_stiffness_stress(const exact_stiffness *k, const double e[], stress_output *out);
/* Derivative of C at e = 0 with respect to the strains that make the prestress sigma, its geometric
 * part. */
void exact_stiffness_geometric(const exact_stiffness *k, const double sigma[], double G[]);

#endif
