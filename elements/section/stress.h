/* Stresses at points of a section, computed from its resultants.
 *
 * The normal stress along the fibres is N/A - Mz y/Iz + My z/Iy - B omega/Iw. If the Wagner torque
 * is active, the stress due to the rotation of a fibre about the shear centre is added, without its
 * resultants N, My and Mz.
 *
 * The shear stress contains the following terms:
 *   - Saint-Venant torsion: the exact series for rectangles, G t kappa at the surfaces of walls,
 *     the Bredt flow in cells, and G R kappa for tubes;
 *   - the shear flow due to Qy, Qz and restrained warping in walls;
 *   - parabolas with the maximum 3/2 Q/A, and similar ones for warping, in rectangles.
 *  The stresses do not include concentrations at corners, fillets and ends, the transverse shear of
 *  tubes, or stresses across a wall. */
#ifndef BEAMWORK_SECTION_STRESS_H
#define BEAMWORK_SECTION_STRESS_H

#include "elements/section/section.h"

enum { STRESS_MAX_POINTS = 14 * SECTION_MAX_WALLS };

typedef struct stress_point {
    double y, z;         /* distance from the centroid along the principal axes [m] */
    double omega;        /* warping function omega [m^2], where u_x = -omega a */
    double across[4][2]; /* shear stress in y and z for a unit value of Qy and Qz [1/m^2], M_w
                            [1/m^3] and G kappa [m] */
} stress_point;

typedef struct stress_points {
    const section *section;
    int count; /* number of points, or 0 for a tube, whose critical fibres depend on the direction
                  of the bending moment */
    double radius; /* radius of a tube [m], or 0 for other sections */
    stress_point point[STRESS_MAX_POINTS];
} stress_points;

/* Resultants on a section in principal axes. Moments are about the centroid. */
typedef struct stress_resultants {
    double N, Qy, Qz, My, Mz, bimoment;
    double warping; /* torque due to restrained warping M_w [N m] */
    double twist;   /* twist rate kappa_x [1/m] */
    int turned;     /* 1 if the twist rotates the fibres (Wagner torque) */
} stress_resultants;

typedef enum stress_measure {
    STRESS_VON_MISES,
    STRESS_NORMAL_MAX, /* largest stress along the fibres; tension is positive */
    STRESS_NORMAL_MIN
} stress_measure;

/* Computes the stress points. The points of a rectangle are the corners, the midpoints of sides,
 * and the centre. The points of a wall are on both surfaces, at the ends, in the middle, and where
 * y, z or omega is zero, which is where the shear flow is largest. The outer corner where two walls
 * meet is added, unless they are nearly parallel. `constants` must be computed from the
 * description. Returns REFUSED for a section given by constants or matrices, which has no points,
 * and for invalid walls. */
status stress_points_of(const section_spec *, const section *constants, stress_points *, fault *);

/* Returns the largest von Mises stress, or the largest or smallest normal stress, of all points
 * [Pa]. */
double stress_of(const stress_points *, const stress_resultants *, stress_measure);

#endif
