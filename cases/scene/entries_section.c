/* What sections consist of. */
#include <math.h>

#include "cases/scene/entry.h"

static const entry_field rectangle[] = {
    {"width", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "along the member's z axis",
     ENTRY_IN(section_spec, width)},
    {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "along its y axis",
     ENTRY_IN(section_spec, height)},
    {.name = NULL}};

static const entry_field tube[] = {{"diameter", ENTRY_NUMBER, .needed = 1, .unit = "m",
                                    .summary = "outer one", ENTRY_IN(section_spec, diameter)},
                                   {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m",
                                    .summary = "half the diameter: a bar",
                                    ENTRY_IN(section_spec, wall_thickness)},
                                   {.name = NULL}};

static const entry_field point[] = {
    {"", ENTRY_VECTOR, .count = 2, .unit = "m", .summary = "[y, z]"}, {.name = NULL}};

static const entry_field wall[] = {
    {"from", ENTRY_NAME, .needed = 1, .summary = "point where it begins"},
    {"to", ENTRY_NAME, .needed = 1, .summary = "point where it ends"},
    {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "of the wall"},
    {.name = NULL}};

/* A zero that is given says that there is none, of what is not known otherwise. */
#define ZERO(bit) .zeros = offsetof(section_spec, zeros), .zero = (bit)

static const entry_field constants[] = {
    {"A", ENTRY_NUMBER, .needed = 1, .unit = "m^2", .summary = "area",
     ENTRY_IN(section_spec, constants.A)},
    {"Iy", ENTRY_NUMBER, .needed = 1, .unit = "m^4", .summary = "int z^2 dA",
     ENTRY_IN(section_spec, constants.Iy)},
    {"Iz", ENTRY_NUMBER, .needed = 1, .unit = "m^4", .summary = "int y^2 dA",
     ENTRY_IN(section_spec, constants.Iz)},
    {"It", ENTRY_NUMBER, .needed = 1, .unit = "m^4", .summary = "torsion constant",
     ENTRY_IN(section_spec, constants.It)},
    {"Ip", ENTRY_NUMBER, .unit = "m^4", .summary = "polar moment", .left_out = "Iy + Iz",
     ENTRY_IN(section_spec, constants.Ip), .always = 1},
    {"Iw", ENTRY_NUMBER, .unit = "m^6", .summary = "warping constant; 0: nothing warps",
     .left_out = "not known: taken as 0", ENTRY_IN(section_spec, constants.Iw),
     ZERO(SECTION_ZERO_WARPING)},
    {"ys", ENTRY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along y",
     .usual = "0", ENTRY_IN(section_spec, constants.ys), .mirrors = "-"},
    {"zs", ENTRY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along z",
     .usual = "0", ENTRY_IN(section_spec, constants.zs)},
    {"wagner_y", ENTRY_NUMBER, .unit = "m^5", .summary = "int y (y^2 + z^2) dA",
     .left_out = "not known: taken as 0", ENTRY_IN(section_spec, constants.wagner_y),
     .mirrors = "-", ZERO(SECTION_ZERO_WAGNER_Y)},
    {"wagner_z", ENTRY_NUMBER, .unit = "m^5", .summary = "int z (y^2 + z^2) dA",
     .left_out = "not known: taken as 0", ENTRY_IN(section_spec, constants.wagner_z),
     ZERO(SECTION_ZERO_WAGNER_Z)},
    {"wagner_torque", ENTRY_NUMBER, .unit = "m^6", .summary = "c of the energy E c kx^4 per length",
     .left_out = "not known: taken as 0", ENTRY_IN(section_spec, constants.wagner_torque),
     ZERO(SECTION_ZERO_WAGNER_TORQUE)},
    {"D", ENTRY_VECTOR, .count = 9, .group = 1, .summary = "shear rigidities/G, order y, z, omega",
     .left_out = "that of F; neither: rigid in shear"},
    {"F", ENTRY_VECTOR, .count = 9, .group = 1, .summary = "its inverse",
     .left_out = "that of D; neither: rigid in shear"},
    {.name = NULL}};

#define GIVEN(constant)                                                                            \
    .left_out = "as computed", ENTRY_IN(section_spec, given.constant), .otherwise = NAN
static const entry_field given[] = {
    {"Iw", ENTRY_NUMBER, .unit = "m^6", .summary = "warping constant", GIVEN(Iw)},
    {"ys", ENTRY_NUMBER, .unit = "m", .summary = "shear centre, along y", GIVEN(ys),
     .mirrors = "-"},
    {"zs", ENTRY_NUMBER, .unit = "m", .summary = "shear centre, along z", GIVEN(zs)},
    {"Dy", ENTRY_NUMBER, .unit = "m^2", .summary = "shear rigidity/G along y", GIVEN(Dy)},
    {"Dz", ENTRY_NUMBER, .unit = "m^2", .summary = "shear rigidity/G along z", GIVEN(Dz)},
    {"Dw", ENTRY_NUMBER, .unit = "m^4", .summary = "shear rigidity/G of warping", GIVEN(Dw)},
    {"Dyz", ENTRY_NUMBER, .unit = "m^2", .summary = "coupling of y and z", GIVEN(Dyz),
     .mirrors = "-"},
    {"Dyw", ENTRY_NUMBER, .unit = "m^3", .summary = "coupling of y and warping", GIVEN(Dyw)},
    {"Dzw", ENTRY_NUMBER, .unit = "m^3", .summary = "coupling of z and warping", GIVEN(Dzw),
     .mirrors = "-"},
    {"It", ENTRY_NUMBER, .unit = "m^4", .summary = "torsion constant", GIVEN(It)},
    {"Ip", ENTRY_NUMBER, .unit = "m^4", .summary = "polar moment", GIVEN(Ip)},
    {"wagner_torque", ENTRY_NUMBER, .unit = "m^6", .summary = "c of the energy E c kx^4 per length",
     GIVEN(wagner_torque)},
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
    {"rectangle", ENTRY_MAP, .needed = 1, .group = 1, .below = rectangle, .summary = "solid",
     ENTRY_IN(section_spec, kind), .first = SECTION_RECTANGLE},
    {"points", ENTRY_NAMES, .below = point, .summary = "of walls, in any axes", .left_out = "none"},
    {"walls", ENTRY_LIST, .needed = 1, .group = 1, .below = wall, .summary = "thin straight walls"},
    {"constants", ENTRY_MAP, .needed = 1, .group = 1, .below = constants, .summary = "as given",
     ENTRY_IN(section_spec, kind), .first = SECTION_CONSTANTS},
    {"i", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "web along z, in the middle"},
    {"channel", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "flanges towards -y"},
    {"zed", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "upper flange towards -y"},
    {"angle", ENTRY_MAP, .needed = 1, .group = 1, .below = legs, .summary = "from its corner"},
    {"box", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged, .summary = "closed, two webs"},
    {"tube", ENTRY_MAP, .needed = 1, .group = 1, .below = tube, .summary = "circular, or a bar",
     ENTRY_IN(section_spec, kind), .first = SECTION_TUBE},
    {"stiffness", ENTRY_NUMBERS, .needed = 1, .group = 1,
     .summary =
         "(N, Qy, Qz, Mx, My, Mz) from (gx, gy, gz, kx, ky, kz) on the member's line: the 36 "
         "of a symmetric matrix, or its diagonal"},
    {"mass", ENTRY_NUMBERS,
     .summary = "of stiffness, per length, of (vx, vy, vz, wx, wy, wz): 36, or the diagonal",
     .usual = "[0, 0, 0, 0, 0, 0]"},
    {"shear_factor", ENTRY_FORMS, .summary = "rectangle: k, or [k_y, k_z]",
     .left_out = "5/6, with the warping's own shear"},
    {"thickness_terms", ENTRY_WORD, .words = "no|yes", .summary = "walls: t^3 terms too",
     .usual = "no", ENTRY_IN(section_spec, thickness_terms)},
    {"cells", ENTRY_WHOLE, .summary = "how many the walls close", .usual = "0",
     ENTRY_IN(section_spec, cells), .most = SECTION_MAX_WALLS},
    {"given", ENTRY_MAP, .below = given, .summary = "replaces computed constants",
     .left_out = "nothing is replaced"},
    {"young", ENTRY_NUMBER, .unit = "Pa", .summary = "modulus of elasticity; of all but stiffness",
     .left_out = "a mistake, unless stiffness is given", ENTRY_IN(section_spec, young),
     .otherwise = 1, .always = 1},
    {"shear_modulus", ENTRY_NUMBER, .unit = "Pa", .summary = "E/(2 (1 + nu)); of all but stiffness",
     .left_out = "a mistake, unless stiffness is given", ENTRY_IN(section_spec, shear_modulus),
     .otherwise = 1, .always = 1},
    {"density", ENTRY_NUMBER, .unit = "kg/m^3", .summary = "0: no inertia", .usual = "0",
     ENTRY_IN(section_spec, density)},
    {.name = NULL}};
