/* What sections consist of. */
#include <math.h>

#include "cases/scene/entry.h"

static const entry_field rectangle[] = {
    {"width", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "along the member's z axis"},
    {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "along its y axis"},
    {.name = NULL}};

static const entry_field tube[] = {
    {"diameter", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "outer one"},
    {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "half the diameter: a bar"},
    {.name = NULL}};

static const entry_field point[] = {
    {"", ENTRY_VECTOR, .count = 2, .unit = "m", .summary = "[y, z]"}, {.name = NULL}};

static const entry_field wall[] = {
    {"from", ENTRY_NAME, .needed = 1, .summary = "point where it begins"},
    {"to", ENTRY_NAME, .needed = 1, .summary = "point where it ends"},
    {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "of the wall"},
    {.name = NULL}};

static const entry_field constants[] = {
    {"A", ENTRY_NUMBER, .needed = 1, .unit = "m^2", .summary = "area"},
    {"Iy", ENTRY_NUMBER, .needed = 1, .unit = "m^4", .summary = "int z^2 dA"},
    {"Iz", ENTRY_NUMBER, .needed = 1, .unit = "m^4", .summary = "int y^2 dA"},
    {"It", ENTRY_NUMBER, .needed = 1, .unit = "m^4", .summary = "torsion constant"},
    {"Iw", ENTRY_NUMBER, .unit = "m^6", .summary = "warping constant; 0: nothing warps",
     .left_out = "not known: taken as 0"},
    {"Ip", ENTRY_NUMBER, .unit = "m^4", .summary = "polar moment", .left_out = "Iy + Iz"},
    {"ys", ENTRY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along y",
     .usual = "0"},
    {"zs", ENTRY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along z",
     .usual = "0"},
    {"wagner_y", ENTRY_NUMBER, .unit = "m^5", .summary = "int y (y^2 + z^2) dA",
     .left_out = "not known: taken as 0"},
    {"wagner_z", ENTRY_NUMBER, .unit = "m^5", .summary = "int z (y^2 + z^2) dA",
     .left_out = "not known: taken as 0"},
    {"wagner_torque", ENTRY_NUMBER, .unit = "m^6", .summary = "c of the energy E c kx^4 per length",
     .left_out = "not known: taken as 0"},
    {"D", ENTRY_VECTOR, .count = 9, .group = 1, .summary = "shear rigidities/G, order y, z, omega",
     .left_out = "that of F; neither: rigid in shear"},
    {"F", ENTRY_VECTOR, .count = 9, .group = 1, .summary = "its inverse",
     .left_out = "that of D; neither: rigid in shear"},
    {.name = NULL}};

static const entry_field given[] = {
    {"Iw", ENTRY_NUMBER, .unit = "m^6", .summary = "warping constant", .left_out = "as computed"},
    {"ys", ENTRY_NUMBER, .unit = "m", .summary = "shear centre, along y",
     .left_out = "as computed"},
    {"zs", ENTRY_NUMBER, .unit = "m", .summary = "shear centre, along z",
     .left_out = "as computed"},
    {"Dy", ENTRY_NUMBER, .unit = "m^2", .summary = "shear rigidity/G along y",
     .left_out = "as computed"},
    {"Dz", ENTRY_NUMBER, .unit = "m^2", .summary = "shear rigidity/G along z",
     .left_out = "as computed"},
    {"Dw", ENTRY_NUMBER, .unit = "m^4", .summary = "shear rigidity/G of warping",
     .left_out = "as computed"},
    {"Dyz", ENTRY_NUMBER, .unit = "m^2", .summary = "coupling of y and z",
     .left_out = "as computed"},
    {"Dyw", ENTRY_NUMBER, .unit = "m^3", .summary = "coupling of y and warping",
     .left_out = "as computed"},
    {"Dzw", ENTRY_NUMBER, .unit = "m^3", .summary = "coupling of z and warping",
     .left_out = "as computed"},
    {"It", ENTRY_NUMBER, .unit = "m^4", .summary = "torsion constant", .left_out = "as computed"},
    {"Ip", ENTRY_NUMBER, .unit = "m^4", .summary = "polar moment", .left_out = "as computed"},
    {"wagner_torque", ENTRY_NUMBER, .unit = "m^6", .summary = "c of the energy E c kx^4 per length",
     .left_out = "as computed"},
    {.name = NULL}};

/* Sizes are those of the walls' centre lines. */
static const entry_field flanged[] = {
    {"depth", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "between the flanges"},
    {"flange", ENTRY_NUMBER, .needed = 1, .unit = "m",
     .summary = "its width; channel, zed: from the web"},
    {"flange_thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "of both flanges"},
    {"web_thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "of the web"},
    {.name = NULL}};

static const entry_field legs[] = {
    {"along_y", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "length of this leg"},
    {"along_z", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "length of that one"},
    {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "of both"},
    {.name = NULL}};

const entry_field entry_section[] = {
    {"rectangle", ENTRY_MAP, .needed = 1, .group = 1, .below = rectangle, .summary = "solid"},
    {"walls", ENTRY_LIST, .needed = 1, .group = 1, .below = wall, .summary = "thin straight walls"},
    {"constants", ENTRY_MAP, .needed = 1, .group = 1, .below = constants, .summary = "as given"},
    {"i", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "web along z, in the middle"},
    {"channel", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "flanges towards -y"},
    {"zed", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "upper flange towards -y"},
    {"angle", ENTRY_MAP, .needed = 1, .group = 1, .below = legs, .summary = "from its corner"},
    {"box", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged, .summary = "closed, two webs"},
    {"tube", ENTRY_MAP, .needed = 1, .group = 1, .below = tube, .summary = "circular, or a bar"},
    {"stiffness", ENTRY_NUMBERS, .needed = 1, .group = 1,
     .summary =
         "(N, Qy, Qz, Mx, My, Mz) from (gx, gy, gz, kx, ky, kz) on the member's line: the 36 "
         "of a symmetric matrix, or its diagonal"},
    {"mass", ENTRY_NUMBERS,
     .summary = "of stiffness, per length, of (vx, vy, vz, wx, wy, wz): 36, or the diagonal",
     .usual = "[0, 0, 0, 0, 0, 0]"},
    {"cells", ENTRY_NUMBER, .summary = "how many the walls close", .usual = "0"},
    {"points", ENTRY_NAMES, .below = point, .summary = "of walls, in axes of one's own",
     .left_out = "none"},
    {"young", ENTRY_NUMBER, .unit = "Pa", .summary = "modulus of elasticity; of all but stiffness",
     .left_out = "a mistake, unless stiffness is given"},
    {"shear_modulus", ENTRY_NUMBER, .unit = "Pa", .summary = "E/(2 (1 + nu)); of all but stiffness",
     .left_out = "a mistake, unless stiffness is given"},
    {"density", ENTRY_NUMBER, .unit = "kg/m^3", .summary = "0: no inertia", .usual = "0"},
    {"shear_factor", ENTRY_FORMS, .summary = "rectangle: k, or [k_y, k_z]",
     .left_out = "5/6, with the warping's own shear"},
    {"thickness_terms", ENTRY_WORD, .words = "no|yes", .summary = "walls: t^3 terms too",
     .usual = "no"},
    {"given", ENTRY_MAP, .below = given, .summary = "replaces computed constants",
     .left_out = "nothing is replaced"},
    {.name = NULL}};
