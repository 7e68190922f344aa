/* Stresses at points of a section, computed from its resultants.
 *
 * The normal stress along the fibres includes N/A - Mz y/Iz + My z/Iy - B omega/Iw and, with the
 * Wagner torque, the additional stress due to twist of a fibre at the distance rho from the shear
 * centre, relative to the section as a whole. The shear stress includes Saint-Venant torsion
 * (rectangles by the exact series, walls G t kappa at their surfaces, cells their Bredt flow, tubes
 * G R kappa), the flow of Qy, Qz and of the restrained warping in walls, and in rectangles the
 * parabolas 3/2 Q/A and similar ones for warping. The stresses do not include concentrations at
 * corners, fillets and ends, the transverse shear of tubes, or stresses across a wall. */
#ifndef BEAMWORK_SECTION_STRESS_H
#define BEAMWORK_SECTION_STRESS_H

#include "elements/section/section.h"

enum { STRESS_MAX_POINTS = 14 * SECTION_MAX_WALLS };

/* Stresses at a point per unit of each resultant. */
typedef struct stress_point {
    double y, z;         /* from the centroid, principal axes [m] */
    double omega;        /* warping function, u_x = -omega a [m^2] */
    double across[4][2]; /* shear stress in y and z per unit Qy and Qz [1/m^2], M_w [1/m^3] and G
                          * kappa [m] */
} stress_point;

typedef struct stress_points {
    const section *section;
    int count; /* 0 for a tube: its critical fibres depend on the direction of the bending moment */
    double radius; /* of a tube [m], else 0 */
    stress_point point[STRESS_MAX_POINTS];
} stress_points;

/* Resultants on a section in principal axes; moments are about the centroid. */
typedef struct stress_resultants {
    double N, Qy, Qz, My, Mz, bimoment;
    double warping; /* torque due to restrained warping M_w [N m] */
    double twist;   /* kappa_x [1/m] */
    int turned;     /* 1: the twist rotates the fibres (Wagner torque) */
} stress_resultants;

typedef enum stress_measure {
    STRESS_VON_MISES,
    STRESS_NORMAL_MAX, /* largest along the fibres: tension positive */
    STRESS_NORMAL_MIN
} stress_measure;

/* Computes the stress points. Rectangle: corners, midpoints of sides, and centre. Wall: ends,
 * middle, and points where y, z or omega is zero (where the shear flow is largest), on both
 * surfaces, and the outer corner where two walls meet. constants: computed from the description.
 * REFUSED: a section given by constants, which has no points. */
status stress_points_of(const section_spec *, const section *constants, stress_points *, fault *);

/* Returns the largest von Mises stress or the largest or smallest normal stress of all points
 * [Pa]. */
double stress_of(const stress_points *, const stress_resultants *, stress_measure);

#endif
