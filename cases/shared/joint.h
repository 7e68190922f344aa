/* The spherical flexure joint of N section 4.2: base - three folded sheets - intermediate body -
 * three more - end effector. All fold lines pass through the joint's centre. Geometry reconstructed
 * from N Table 1 and its published stiffnesses. */
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

/* Their entries. */
extern const parameter_type joint_parameters[];

#define JOINT_DEGREE 0.017453292519943295

/* Section and physics that all joints of a scene share; refuses sheets that would reach through the
 * centre. Returns the section's index in *profile. */
status joint_prepare(const double value[], scene *s, int *profile, fault *f);

/* Adds one joint between two bodies (nodes of the scene): centre [m], axes: columns are the joint's
 * x (azimuth 0), y and z in global directions, row-major. Returns the node of the intermediate
 * body, placed at the centre. */
int joint_add(const double value[], scene *s, int profile, const double centre[3],
              const double axes[9], int base, int effector);

#endif
