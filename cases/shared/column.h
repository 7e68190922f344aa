/* The simply supported C-shaped column of J section 5.1: what its cases have in common. */
#ifndef BEAMWORK_CASES_COLUMN_H
#define BEAMWORK_CASES_COLUMN_H

#include "cases/case.h"
#include "cases/shared/channel.h"

/* The first parameters of every such case, in this order. */
enum {
    COLUMN_LENGTH,
    COLUMN_HEIGHT,
    COLUMN_WIDTH,
    COLUMN_FLANGE,
    COLUMN_WEB,
    COLUMN_YOUNG,
    COLUMN_SHEAR_MODULUS,
    COLUMN_DENSITY,
    COLUMN_DATA,
    COLUMN_SHEAR,
    COLUMN_STABILITY,
    COLUMN_PARAMETERS
};

/* Their entries: a part before, the default of COLUMN_SHEAR, a part behind. */
extern const parameter_type column_parameters[], column_flexible[], column_rigid[],
    column_stability[];

/* Adds section, nodes, member and fork supports: u at x = 0, v, w and phi_x at both ends; bending
 * rotations and warping are free. ends[0] is the node at x = 0, ends[1] the one at x = length,
 * which can move along x. */
status column_build(const double value[], scene *s, int ends[2], fault *f);

#endif
