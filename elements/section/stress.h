/* Stresses at points of a section from the resultants on it.
 *
 * In are: along the fibres N/A - Mz y/Iz + My z/Iy - B omega/Iw, and where the twist turns them,
 * with the Wagner torque, what a fibre at the distance rho from the shear centre gets more than the
 * section takes as a whole; across them Saint-Venant's torsion (rectangles by the exact series,
 * walls G t kappa at their surfaces, cells their Bredt flow, tubes G R kappa), the flow of Qy, Qz
 * and of the restrained warping in walls, and in rectangles the parabolas 3/2 Q/A and its like of
 * the warping. Not in are: concentrations at corners, fillets and ends, transverse shear of tubes,
 * and stresses across a wall. */
#ifndef BEAMWORK_SECTION_STRESS_H
#define BEAMWORK_SECTION_STRESS_H

#include "elements/section/section.h"

enum { STRESS_MAX_POINTS = 12 * SECTION_MAX_WALLS };

/* A point: what each resultant makes there. */
typedef struct stress_point {
    double y, z;         /* from the centroid, principal axes [m] */
    double omega;        /* warping function, u_x = -omega a [m^2] */
    double across[4][2]; /* shear stress in y and z per Qy, Qz [1/m^2], M_w [1/m^3] and per G kappa
                            [m] */
} stress_point;

typedef struct stress_points {
    const section *section;
    int count;     /* of a tube none: its outermost fibres are where the bending moment says */
    double radius; /* of a tube [m]; else 0 */
    stress_point point[STRESS_MAX_POINTS];
} stress_points;

/* On a section, principal axes, moments about the centroid. */
typedef struct stress_resultants {
    double N, Qy, Qz, My, Mz, bimoment;
    double warping; /* torque of the restrained warping M_w [N m] */
    double twist;   /* kappa_x [1/m] */
    int turned;     /* 1: the twist turns the fibres (Wagner torque) */
} stress_resultants;

typedef enum stress_measure {
    STRESS_VON_MISES,
    STRESS_NORMAL_MAX, /* largest along the fibres: tension positive */
    STRESS_NORMAL_MIN
} stress_measure;

/* Corners, middles of sides and the centre of a rectangle; ends and middle of each wall and where
 * y, z or omega vanish in it (there the flow is largest), on both surfaces.  constants: what the
 * description came to, which stays there. REFUSED: given constants, which have no points. */
status stress_points_of(const section_spec *, const section *constants, stress_points *, fault *);

/* The largest von Mises stress, or the largest or least normal stress, of all points [Pa]. */
double stress_of(const stress_points *, const stress_resultants *, stress_measure);

#endif
