/* The spherical flexure joint of N section 4.2: base - three folded sheets - intermediate body - three more - end effector.
 * All fold lines pass through the joint's centre. Geometry reconstructed from N Table 1 and its published stiffnesses. */
#ifndef BEAMWORK_CASES_JOINT_H
#define BEAMWORK_CASES_JOINT_H

#include "cases/case.h"

/* The first parameters of every case with such joints, in this order. */
enum {
    JOINT_LENGTH,
    JOINT_WIDTH,
    JOINT_THICKNESS,
    JOINT_YOUNG,
    JOINT_POISSON,
    JOINT_FOLD_ANGLE,
    JOINT_RADIUS,
    JOINT_POLAR,
    JOINT_AZIMUTH,
    JOINT_FOLD_WARPING,
    JOINT_WAGNER,
    JOINT_DIRECTION,
    JOINT_PARAMETERS
};

/* clang-format off */
#define JOINT_TABLE \
    [JOINT_LENGTH] = {"length", "m", 0.0681, 1e-6, 1e3, NULL, "length of a sheet"}, \
    [JOINT_WIDTH] = {"width", "m", 0.0282, 1e-6, 1e3, NULL, \
        "width of a sheet, along the fold line"}, \
    [JOINT_THICKNESS] = {"thickness", "m", 0.000838, 1e-9, 1e3, NULL, "thickness of a sheet"}, \
    [JOINT_YOUNG] = {"young", "Pa", 210e9, 1e-3, 1e15, NULL, "modulus of elasticity"}, \
    [JOINT_POISSON] = {"poisson", "1", 0.3, -0.99, 0.49, NULL, "Poisson's ratio"}, \
    [JOINT_FOLD_ANGLE] = {"fold_angle", "rad", 86.2 * JOINT_DEGREE, 0.01, 3.13, NULL, \
        "angle between the two sheets of a fold"}, \
    [JOINT_RADIUS] = {"radius", "m", 0.0343, 1e-6, 1e3, NULL, \
        "distance of a fold line's outer end from the centre"}, \
    [JOINT_POLAR] = {"polar_angle", "rad", 40.2 * JOINT_DEGREE, 0.01, 1.56, NULL, \
        "angle between a fold line and the z axis"}, \
    [JOINT_AZIMUTH] = {"azimuth", "rad", 0.0, -6.3, 6.3, NULL, "azimuth of the first fold"}, \
    [JOINT_FOLD_WARPING] = {"fold_warping", "", 0, 0, 0, "shared|free|fixed", \
        "warping of the two sheets at their fold"}, \
    [JOINT_WAGNER] = {"wagner", "1", 1, 0, 1, NULL, "1: Wagner torque (N Eq. 46)"}, \
    [JOINT_DIRECTION] = {"element_direction", "", 0, 0, 0, "bodies|chained", \
        "elements begin at the bodies, or run base - fold - body"}
/* clang-format on */

#define JOINT_DEGREE 0.017453292519943295

/* Section and physics that all joints of a scene share; refuses sheets that would reach through the centre.
 * Returns the section's index in *profile. */
status joint_prepare(const double value[], scene *s, int *profile, fault *f);

/* Adds one joint between two bodies (nodes of the scene): centre [m], axes: columns are the joint's x (azimuth 0), y and
 * z in global directions, row-major. Returns the node of the intermediate body, placed at the centre. */
int joint_add(const double value[], scene *s, int profile, const double centre[3],
              const double axes[9], int base, int effector);

#endif
