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

/* clang-format off */
#define COLUMN_TABLE(default_shear) \
    [COLUMN_LENGTH] = {"length", "m", 6.0, 1e-6, 1e6, NULL, "length of the beam"}, \
    [COLUMN_HEIGHT] = {"height", "m", 0.6, 1e-6, 1e6, NULL, "centre-line height of the web"}, \
    [COLUMN_WIDTH] = {"width", "m", 0.6, 1e-6, 1e6, NULL, "centre-line width of the flanges"}, \
    [COLUMN_FLANGE] = {"flange_thickness", "m", 0.03, 1e-9, 1e3, NULL, \
        "thickness of the flanges"}, \
    [COLUMN_WEB] = {"web_thickness", "m", 0.03, 1e-9, 1e3, NULL, "thickness of the web"}, \
    [COLUMN_YOUNG] = {"young", "Pa", 144e9, 1e-3, 1e15, NULL, "modulus of elasticity"}, \
    [COLUMN_SHEAR_MODULUS] = {"shear_modulus", "Pa", 4.14e9, 1e-6, 1e15, NULL, "shear modulus"}, \
    [COLUMN_DENSITY] = {"density", "kg/m^3", 1389.0, 1e-9, 1e9, NULL, "density"}, \
    [COLUMN_DATA] = {"section_data", "", CHANNEL_SHEAR_FLOW, 0, 0, CHANNEL_DATA_CHOICES, \
        "constants computed from the walls, or as printed (of the default sizes only)"}, \
    [COLUMN_SHEAR] = {"shear", "1", default_shear, 0, 1, NULL, \
        "1: flexible in shear, 0: shear-rigid"}, \
    [COLUMN_STABILITY] = { "shear_stability", "", 0, 0, 0, "engesser|haringx", \
        "theory of shear in stability"}
/* clang-format on */

/* Adds section, nodes, member and fork supports: u at x = 0, v, w and phi_x at both ends; bending rotations and
 * warping are free. ends[0] is the node at x = 0, ends[1] the one at x = length, which can move along x. */
status column_build(const parameter_type parameters[], const double value[], scene *s, int ends[2],
                    fault *f);

#endif
