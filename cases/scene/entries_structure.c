#include "cases/scene/scene.h"

#include <math.h>

static const entry_field drive[] = {
    {"ux", ENTRY_NAME, .summary = "motion", .left_out = "not driven"},
    {"uy", ENTRY_NAME, .summary = "motion", .left_out = "not driven"},
    {"uz", ENTRY_NAME, .summary = "motion", .left_out = "not driven"},
    {"rx", ENTRY_NAME, .summary = "motion", .left_out = "not driven"},
    {"ry", ENTRY_NAME, .summary = "motion", .left_out = "not driven"},
    {"rz", ENTRY_NAME, .summary = "motion", .left_out = "not driven"},
    {.name = NULL}};

static const entry_field fork_[] = {
    {"axis", ENTRY_DIRECTION, .needed = 1, .count = 3, .summary = "axis of the section",
     ENTRY_IN(scene_node, axis[0])},
    {"web", ENTRY_DIRECTION, .needed = 1, .count = 3,
     .summary = "direction of the web between the guides of the fork",
     ENTRY_IN(scene_node, axis[1])},
    {.name = NULL}};

static const entry_field turn[] = {
    {"axis", ENTRY_FORMS, .needed = 1,
     .summary = "rotation axis, x, y, z or [3], which rotates with the preceding angles"},
    {"angle", ENTRY_NAME, .needed = 1, .summary = "free, held or the name of a motion"},
    {.name = NULL}};

static const entry_field rotation[] = {{"sequence", ENTRY_LIST, .needed = 1, .group = 1,
                                        .below = turn,
                                        .summary = "one to three successive rotations"},
                                       {"vector", ENTRY_FORMS, .needed = 1, .group = 1,
                                        .summary = "rotation vector: [MOTION, MOTION, MOTION]"},
                                       {.name = NULL}};

static const entry_field axes[] = {
    {"x", ENTRY_DIRECTION, .count = 3, .summary = "direction of the x axis; give two of x, y and z",
     .left_out = "perpendicular to the other two", ENTRY_IN(scene_node, axes[0])},
    {"y", ENTRY_DIRECTION, .count = 3, .summary = "direction of the y axis, perpendicular to x",
     .left_out = "perpendicular to the other two", ENTRY_IN(scene_node, axes[1])},
    {"z", ENTRY_DIRECTION, .count = 3, .summary = "direction of the z axis, instead of x or y",
     .left_out = "perpendicular to the other two"},
    {"member", ENTRY_NAME,
     .summary =
         "straight member that ends at the node and whose axes are used instead of directions",
     .left_out = "directions"},
    {.name = NULL}};

const entry_field entry_node[] = {
    {"at", ENTRY_POSITION, .needed = 1, .count = 3, .unit = "m", .summary = "position",
     ENTRY_IN(scene_node, position)},
    {"part_of", ENTRY_NAME, .summary = "node to which this node is rigidly connected",
     .left_out = "no rigid connection", ENTRY_IN(scene_node, attached), .of = SCENE_NODES},
    {"axes", ENTRY_MAP, .below = axes,
     .summary = "axes of 'hold', 'drive' and the reactions of the node, for inclined supports",
     .left_out = "axes of the scene"},
    {"hold", ENTRY_WORDS, .words = "all|" ENTRY_COMPONENTS,
     .summary = "fixed components; a single fixed rotation is about an axis fixed in space",
     .usual = "[]"},
    {"drive", ENTRY_MAP, .below = drive, .summary = "components that follow a motion, by its name",
     .left_out = "none"},
    {"rotation", ENTRY_MAP, .below = rotation, .summary = "constraint of the node's rotation",
     .left_out = "as given by hold, drive and fork"},
    {"fork", ENTRY_MAP, .below = fork_,
     .summary = "no rotation about the axis of the rotated section", .left_out = "none",
     ENTRY_IN(scene_node, rotation), .first = SCENE_ROTATION_FORK},
    {"mass", ENTRY_NUMBER, .unit = "kg", .summary = "mass of a rigid body fixed to the node",
     .usual = "0", ENTRY_IN(scene_node, body.mass), .most = INFINITY},
    {"centre", ENTRY_DIRECTION, .count = 3, .unit = "m",
     .summary = "centre of mass, relative to the node", .usual = "[0, 0, 0]",
     ENTRY_IN(scene_node, body.centre)},
    {"inertia", ENTRY_VECTOR, .count = 6, .unit = "kg m^2",
     .summary = "inertia tensor about the centre of mass: [xx, yy, zz, xy, yz, zx]",
     .usual = "[0, 0, 0, 0, 0, 0]", ENTRY_IN(scene_node, body.inertia)},
    {.name = "velocity", .kind = ENTRY_LATER},
    {.name = "spin", .kind = ENTRY_LATER},
    {.name = NULL}};

static const entry_field release[] = {
    {"from", ENTRY_WORDS, .words = ENTRY_COMPONENTS,
     .summary = "released components at the start, in the member's axes: [rz] is a hinge, [rx, ry, "
                "rz] a ball joint",
     .usual = "[]"},
    {"to", ENTRY_WORDS, .words = ENTRY_COMPONENTS,
     .summary = "released components at the end; if two rotations are released, the first axis "
                "moves with the node and the second with the member",
     .usual = "[]"},
    {.name = NULL}};

static const entry_field offset[] = {
    {"from", ENTRY_DIRECTION, .count = 3, .unit = "m", .summary = "offset of the end at 'from'",
     .usual = "[0, 0, 0]", ENTRY_IN(scene_member, offset[0])},
    {"to", ENTRY_DIRECTION, .count = 3, .unit = "m", .summary = "offset of the end at 'to'",
     .usual = "[0, 0, 0]", ENTRY_IN(scene_member, offset[1])},
    {.name = NULL}};

static const entry_field imperfection[] = {
    {"amplitude", ENTRY_VECTOR, .needed = 1, .count = 2, .unit = "m",
     .summary = "amplitude along the section's y and z axes", ENTRY_IN(scene_member, bow),
     .mirrors = "-+"},
    {"half_waves", ENTRY_WHOLE,
     .summary = "number of half-waves of the sine between the ends of the member", .usual = "1",
     ENTRY_IN(scene_member, half_waves), .least = 1, .most = 1000},
    {.name = NULL}};

static const entry_field foundation[] = {
    {"translation", ENTRY_VECTOR, .count = 3, .unit = "N/m^2",
     .summary = "stiffness along the member's x, y and z axes: force per length and displacement",
     .usual = "[0, 0, 0]", .at = offsetof(scene_member, foundation), .size = 3 * sizeof(double),
     .most = INFINITY},
    {"rotation", ENTRY_VECTOR, .count = 3, .unit = "N",
     .summary = "stiffness about the member's x, y and z axes: moment per length and rotation",
     .usual = "[0, 0, 0]", .at = offsetof(scene_member, foundation) + 3 * sizeof(double),
     .size = 3 * sizeof(double), .most = INFINITY},
    {.name = NULL}};

#define KEY(type, name, dimensions, ...) {__VA_ARGS__, ENTRY_IN(scene_member, name)},
#define ROW(...)                         {__VA_ARGS__},
const entry_field entry_member[] = {
#include "cases/scene/keys_member.h"
    {.name = NULL}};

#define FILE_OF_TABLE                                                                              \
    "CSV file, relative to the scene file; 'at' and 'value' are then columns of the file, by "     \
    "header or number"
#define NO_FILE "none: numbers here"
#define TABLE(which, k, length, force)                                                             \
    static const entry_field table_##which[] = {                                                   \
        {"file", ENTRY_TEXT, .summary = FILE_OF_TABLE, .left_out = NO_FILE},                       \
        {"at", ENTRY_NUMBERS, .needed = 1, .unit = (length),                                       \
         .summary = "displacements or rotations, ascending", ENTRY_IN(scene_spring, table[k].at)}, \
        {"value", ENTRY_NUMBERS, .needed = 1, .unit = (force),                                     \
         .summary = "forces or moments at the values of 'at', linear between and beyond the "      \
                    "points; they must not decrease, and must be 0 at 0",                          \
         ENTRY_IN(scene_spring, table[k].value)},                                                  \
        {.name = NULL}};
TABLE(ux, 0, "m", "N")
TABLE(uy, 1, "m", "N")
TABLE(uz, 2, "m", "N")
TABLE(rx, 3, "rad", "N m")
TABLE(ry, 4, "rad", "N m")
TABLE(rz, 5, "rad", "N m")
#undef TABLE

static const entry_field tables[] = {
    {"ux", ENTRY_MAP, .below = table_ux, .summary = "force over displacement", .left_out = "none"},
    {"uy", ENTRY_MAP, .below = table_uy, .summary = "force over displacement", .left_out = "none"},
    {"uz", ENTRY_MAP, .below = table_uz, .summary = "force over displacement", .left_out = "none"},
    {"rx", ENTRY_MAP, .below = table_rx, .summary = "moment over rotation", .left_out = "none"},
    {"ry", ENTRY_MAP, .below = table_ry, .summary = "moment over rotation", .left_out = "none"},
    {"rz", ENTRY_MAP, .below = table_rz, .summary = "moment over rotation", .left_out = "none"},
    {.name = NULL}};

const entry_field entry_spring[] = {
    {"from", ENTRY_NAME,
     .summary = "first node; deformations are measured along the axes of this node",
     .left_out = "the ground", ENTRY_IN(scene_spring, p), .of = SCENE_NODES},
    {"to", ENTRY_NAME, .needed = 1, .summary = "second node", ENTRY_IN(scene_spring, q),
     .of = SCENE_NODES},
    {"tables", ENTRY_MAP, .below = tables,
     .summary = "force and moment tables, in addition to stiffness: gaps, stops, one-sided springs",
     .left_out = "none"},
    {"stiffness", ENTRY_NUMBERS,
     .summary = "for ux, uy, uz [N/m], rx, ry, rz [N m]: six values, or the 36 entries of a "
                "matrix, which may be unsymmetric for bearings",
     .left_out = "none; required if there is no damping and no table"},
    {"damping", ENTRY_NUMBERS,
     .summary = "dashpot coefficients for ux, uy, uz [N s/m], rx, ry, rz [N m s]: six values, or "
                "36 entries",
     .left_out = "none"},
    {.name = NULL}};

static const entry_field condition[] = {
    {"node", ENTRY_NAME, .needed = 1, .summary = "node whose coordinate the condition prescribes",
     ENTRY_IN(scene_driver, condition_node), .of = SCENE_NODES},
    {"component", ENTRY_WORD, .needed = 1, .words = ENTRY_COMPONENTS,
     .summary = "coordinate of the node", ENTRY_IN(scene_driver, condition_component)},
    {"motion", ENTRY_NAME, .needed = 1, .summary = "motion that prescribes that coordinate",
     ENTRY_IN(scene_driver, condition_driver), .of = SCENE_DRIVERS},
    {.name = NULL}};

static const entry_field piece[] = {
    {"until", ENTRY_NUMBER, .unit = "s", .summary = "end of the piece; the last piece has none",
     .left_out = "no end; for the last piece only"},
    {"is", ENTRY_TEXT, .needed = 1, .summary = "expression of the time t [s]"},
    {.name = NULL}};

static const entry_field table[] = {
    {"file", ENTRY_TEXT, .summary = FILE_OF_TABLE, .left_out = NO_FILE},
    {"at", ENTRY_NUMBERS, .needed = 1, .unit = "s", .summary = "times, ascending"},
    {"value", ENTRY_NUMBERS, .needed = 1,
     .summary = "values at these times; constant before the first and after the last"},
    {.name = NULL}};

const entry_field entry_driver[] = {
    {"unit", ENTRY_WORD, .words = "m|rad", .summary = "unit of the values",
     .left_out = "unit of the driven component"},
    {"path", ENTRY_NUMBERS, .summary = "path parameter, ascending",
     .left_out = "none; required with value"},
    {"value", ENTRY_NUMBERS,
     .summary = "values at the path parameters, linear in between; a transient analysis uses the "
                "last value",
     .left_out = "none, for a function of time or an unknown motion"},
    {"such_that", ENTRY_MAP, .group = 1, .below = condition,
     .summary = "condition that determines an unknown motion", .left_out = "the motion is known"},
    {"unknown", ENTRY_WORD, .words = "true|yes",
     .summary = "a remark for readers of the file; it has no effect",
     .left_out = "as given by such_that"},
    {"time", ENTRY_TEXT, .group = 1,
     .summary =
         "value as a function of time: expression of the time t [s], in m or rad, such as 30*deg*t",
     .left_out = "a motion along the path"},
    {"pieces", ENTRY_LIST, .group = 1, .below = piece,
     .summary = "value as a function of time, given by successive expressions; value and velocity "
                "must be continuous",
     .left_out = "a motion along the path"},
    {"table", ENTRY_MAP, .group = 1, .below = table,
     .summary = "value as a function of time, given by a table: a cubic spline that starts and "
                "ends at rest",
     .left_out = "a motion along the path"},
    {"case", ENTRY_NAME, .summary = "load case to which the motion belongs",
     .left_out = "none: the motion acts in all load cases", ENTRY_IN(scene_driver, load_case),
     .of = SCENE_CASES},
    {.name = NULL}};

static const entry_field feedback[] = {
    {"node", ENTRY_NAME, .needed = 1, .summary = "node whose component is measured",
     ENTRY_IN(scene_load, feedback.node), .of = SCENE_NODES},
    {"component", ENTRY_WORD, .needed = 1, .words = ENTRY_COMPONENTS,
     .summary = "displacement or rotation that is measured, along fixed axes",
     ENTRY_IN(scene_load, feedback.component)},
    {"from", ENTRY_NAME, .summary = "node whose corresponding component is subtracted",
     .left_out = "none: the displacement itself", ENTRY_IN(scene_load, feedback.from),
     .of = SCENE_NODES},
    {"proportional", ENTRY_NUMBER,
     .summary = "gain of the error, which is the reference minus the measured value [1/m, 1/rad]",
     .usual = "0", ENTRY_IN(scene_load, feedback.proportional)},
    {"derivative", ENTRY_NUMBER, .summary = "gain of the rate of the error [s/m, s/rad]",
     .usual = "0", ENTRY_IN(scene_load, feedback.derivative)},
    {"integral", ENTRY_NUMBER,
     .summary = "gain of the integral of the error over time, from the start of the motion [1/(m "
                "s), 1/(rad s)]",
     .usual = "0", ENTRY_IN(scene_load, feedback.integral)},
    {"limit", ENTRY_NUMBER, .summary = "largest magnitude of the factor", .left_out = "none",
     ENTRY_IN(scene_load, feedback.limit), .most = INFINITY},
    {.name = NULL}};

#define KEY(type, name, dimensions, ...) {__VA_ARGS__, ENTRY_IN(scene_load, name)},
#define ROW(...)                         {__VA_ARGS__},
const entry_field entry_load[] = {
#include "cases/scene/keys_load.h"
    {.name = NULL}};

const entry_field entry_constraint[] = {
    {"equal", ENTRY_FORMS, .summary = "[NODE, NODE, ...]: nodes with equal components",
     .left_out = "none; required with 'components'"},
    {"components", ENTRY_WORDS, .words = ENTRY_COMPONENTS,
     .summary = "components that are equal, along the nodes' axes; of the rotations, all three, or "
                "one if the others are fixed",
     .left_out = "none; required with 'equal'"},
    {"node", ENTRY_NAME, .summary = "node whose component is 'ratio' times that of 'of'",
     .left_out = "none; required with 'ratio'"},
    {"component", ENTRY_WORD, .words = ENTRY_COMPONENTS,
     .summary = "component of both nodes, along their axes; a rotation only if the other rotations "
                "are fixed",
     .left_out = "none; required with 'ratio'"},
    {"ratio", ENTRY_NUMBER, .unit = "1", .summary = "nonzero; may be negative",
     .left_out = "none; required with 'node'"},
    {"of", ENTRY_NAME, .summary = "the other node", .left_out = "none; required with 'ratio'"},
    {"diaphragm", ENTRY_FORMS,
     .summary = "[NODE, ...]: nodes that follow 'master' as in a rigid floor: they translate "
                "perpendicular to 'normal' and rotate about 'normal' with it",
     .left_out = "none; required with 'master'"},
    {"master", ENTRY_NAME, .summary = "node that the nodes of the diaphragm follow",
     .left_out = "none; required with 'diaphragm'"},
    {"normal", ENTRY_WORD, .words = "x|y|z",
     .summary = "axis normal to the rigid plane of the diaphragm",
     .left_out = "none; required with 'diaphragm'"},
    {.name = NULL}};

const entry_field entry_imperfection[] = {
    {"mode_of", ENTRY_NAME,
     .summary = "buckling or modal analysis of the perfect structure, which provides the mode",
     .left_out = "none; required without 'shifts'", ENTRY_IN(scene_imperfection, analysis),
     .of = SCENE_ANALYSES},
    {"which", ENTRY_WHOLE,
     .summary = "index of the mode, counted from 0; buckling modes are counted over positive "
                "critical loads only",
     .usual = "0", ENTRY_IN(scene_imperfection, order), .most = ENTRY_MOST_ORDER},
    {"amplitude", ENTRY_NUMBER, .unit = "m",
     .summary = "largest displacement of a point of a member",
     .left_out = "none; required with 'mode_of'", ENTRY_IN(scene_imperfection, amplitude)},
    {"direction", ENTRY_DIRECTION, .count = 3,
     .summary = "approximate direction of the largest displacement; required if two modes have the "
                "same load or frequency",
     .left_out = "largest component of the displacement is positive",
     ENTRY_IN(scene_imperfection, direction)},
    {"shifts", ENTRY_FORMS, .unit = "m",
     .summary = "{NODE: [dx, dy, dz], ...}, or {file: CSV} with the columns node, dx, dy, dz",
     .left_out = "none; required without 'mode_of'"},
    {"factor", ENTRY_NUMBER, .summary = "factor of all shifts", .usual = "1",
     ENTRY_IN(scene_imperfection, factor)},
    {.name = NULL}};

const entry_field entry_combination[] = {
    {"", ENTRY_NUMBER, .summary = "factor of this load case", .left_out = "it does not act"},
    {.name = NULL}};

const entry_field *entry_of_load(scene_load_kind kind)
{
    static const int key[] = {0, 1, 2, 3, 4, 4, 0, 1, 5};
    return &entry_load[key[kind]];
}

/* Keys of sections. */

static const entry_field rectangle[] = {
    {"width", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "along the member's z axis",
     ENTRY_IN(section_spec, width)},
    {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "along the member's y axis",
     ENTRY_IN(section_spec, height)},
    {.name = NULL}};

static const entry_field tube[] = {{"diameter", ENTRY_NUMBER, .needed = 1, .unit = "m",
                                    .summary = "outer diameter", ENTRY_IN(section_spec, diameter)},
                                   {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m",
                                    .summary = "wall thickness; half the diameter for a solid bar",
                                    ENTRY_IN(section_spec, wall_thickness)},
                                   {.name = NULL}};

static const entry_field point[] = {
    {"", ENTRY_VECTOR, .count = 2, .unit = "m", .summary = "[y, z]"}, {.name = NULL}};

static const entry_field wall[] = {
    {"from", ENTRY_NAME, .needed = 1, .summary = "start point"},
    {"to", ENTRY_NAME, .needed = 1, .summary = "end point"},
    {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "wall thickness"},
    {.name = NULL}};

/* Records that a constant was given as zero, because zero otherwise means that it is computed. */
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
    {"Iw", ENTRY_NUMBER, .unit = "m^6", .summary = "warping constant; 0: no warping",
     .left_out = "unknown: assumed to be 0", ENTRY_IN(section_spec, constants.Iw),
     ZERO(SECTION_ZERO_WARPING)},
    {"ys", ENTRY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along y",
     .usual = "0", ENTRY_IN(section_spec, constants.ys), .mirrors = "-"},
    {"zs", ENTRY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along z",
     .usual = "0", ENTRY_IN(section_spec, constants.zs)},
    {"wagner_y", ENTRY_NUMBER, .unit = "m^5", .summary = "int y (y^2 + z^2) dA",
     .left_out = "unknown: assumed to be 0", ENTRY_IN(section_spec, constants.wagner_y),
     .mirrors = "-", ZERO(SECTION_ZERO_WAGNER_Y)},
    {"wagner_z", ENTRY_NUMBER, .unit = "m^5", .summary = "int z (y^2 + z^2) dA",
     .left_out = "unknown: assumed to be 0", ENTRY_IN(section_spec, constants.wagner_z),
     ZERO(SECTION_ZERO_WAGNER_Z)},
    {"wagner_torque", ENTRY_NUMBER, .unit = "m^6",
     .summary = "c in the energy E c kx^4 per length of the twist kx",
     .left_out = "unknown: assumed to be 0", ENTRY_IN(section_spec, constants.wagner_torque),
     ZERO(SECTION_ZERO_WAGNER_TORQUE)},
    {"D", ENTRY_VECTOR, .count = 9, .group = 1,
     .summary = "matrix of shear rigidities/G, in the order y, z, omega",
     .left_out = "inverse of F; without D and F: rigid in shear"},
    {"F", ENTRY_VECTOR, .count = 9, .group = 1, .summary = "inverse of D",
     .left_out = "inverse of D; without D and F: rigid in shear"},
    {.name = NULL}};

#define GIVEN(constant)                                                                            \
    .left_out = "as computed", ENTRY_IN(section_spec, given.constant), .otherwise = NAN
static const entry_field given[] = {
    {"A", ENTRY_NUMBER, .unit = "m^2", .summary = "walls: area", GIVEN(A)},
    {"Iy", ENTRY_NUMBER, .unit = "m^4", .summary = "walls: integral of z^2 dA", GIVEN(Iy)},
    {"Iz", ENTRY_NUMBER, .unit = "m^4", .summary = "walls: integral of y^2 dA", GIVEN(Iz)},
    {"Iw", ENTRY_NUMBER, .unit = "m^6", .summary = "warping constant", GIVEN(Iw)},
    {"beta", ENTRY_NUMBER, .unit = "rad",
     .summary = "walls: angle from the y axis of the points to the principal y axis", GIVEN(beta),
     .mirrors = "-"},
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
    {"wagner_torque", ENTRY_NUMBER, .unit = "m^6",
     .summary = "c in the energy E c kx^4 per length of the twist kx", GIVEN(wagner_torque)},
    {.name = NULL}};

/* Dimensions refer to the centre lines of the walls. */
static const entry_field flanged[] = {
    {"depth", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "distance between the flanges"},
    {"flange", ENTRY_NUMBER, .needed = 1, .unit = "m",
     .summary = "width of a flange; channel and zed: measured from the web"},
    {"flange_thickness", ENTRY_NUMBER, .needed = 1, .unit = "m",
     .summary = "thickness of both flanges"},
    {"web_thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "thickness of the web"},
    {.name = NULL}};

static const entry_field legs[] = {
    {"along_y", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "length of the leg along y"},
    {"along_z", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "length of the leg along z"},
    {"thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "thickness of both legs"},
    {.name = NULL}};

static const entry_field tee[] = {
    {"depth", ENTRY_NUMBER, .needed = 1, .unit = "m",
     .summary = "depth of the web, from the flange's centre line to its end"},
    {"flange", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "width of the flange"},
    {"flange_thickness", ENTRY_NUMBER, .needed = 1, .unit = "m",
     .summary = "thickness of the flange"},
    {"web_thickness", ENTRY_NUMBER, .needed = 1, .unit = "m", .summary = "thickness of the web"},
    {.name = NULL}};

const entry_field entry_section[] = {
    {"rectangle", ENTRY_MAP, .needed = 1, .group = 1, .below = rectangle,
     .summary = "solid rectangle", ENTRY_IN(section_spec, kind), .first = SECTION_RECTANGLE},
    {"points", ENTRY_NAMES, .below = point, .summary = "end points of walls, in any axes",
     .left_out = "none"},
    {"walls", ENTRY_LIST, .needed = 1, .group = 1, .below = wall, .summary = "thin straight walls"},
    {"constants", ENTRY_MAP, .needed = 1, .group = 1, .below = constants,
     .summary = "given constants", ENTRY_IN(section_spec, kind), .first = SECTION_CONSTANTS},
    {"i", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "I-section: web along z, in the middle of the flanges"},
    {"channel", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "flanges towards -y"},
    {"zed", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "upper flange towards -y"},
    {"angle", ENTRY_MAP, .needed = 1, .group = 1, .below = legs,
     .summary = "angle section, whose legs start at the corner"},
    {"box", ENTRY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "closed box with two webs"},
    {"tube", ENTRY_MAP, .needed = 1, .group = 1, .below = tube,
     .summary = "circular tube, or solid bar", ENTRY_IN(section_spec, kind), .first = SECTION_TUBE},
    {"t", ENTRY_MAP, .needed = 1, .group = 1, .below = tee,
     .summary = "flange along y, web from it towards -z"},
    {"profile", ENTRY_TEXT, .needed = 1, .group = 1,
     .summary =
         "rolled section: IPE200, HEA200, HEB200, HEM200, UPN200, L100x10, SHS100x5, RHS200x100x5, "
         "CHS114.3x5"},
    {"stiffness", ENTRY_NUMBERS, .needed = 1, .group = 1,
     .summary = "stiffness matrix that gives (N, Qy, Qz, Mx, My, Mz) from (gx, gy, gz, kx, ky, kz) "
                "on the member's line: 36 entries, symmetric, or the six of the diagonal"},
    {"mass", ENTRY_NUMBERS,
     .summary = "with 'stiffness': matrix of mass per length for (vx, vy, vz, wx, wy, wz): 36 "
                "entries, or the six of the diagonal",
     .usual = "[0, 0, 0, 0, 0, 0]"},
    {"shear_factor", ENTRY_FORMS, .summary = "rectangle: k, or [k_y, k_z]",
     .left_out = "5/6, also for the shear due to warping"},
    {"thickness_terms", ENTRY_WORD, .words = "no|yes", .summary = "walls: include t^3 terms",
     .usual = "no", ENTRY_IN(section_spec, thickness_terms)},
    {"cells", ENTRY_WHOLE, .summary = "number of closed cells formed by the walls", .usual = "0",
     ENTRY_IN(section_spec, cells), .most = SECTION_MAX_WALLS},
    {"given", ENTRY_MAP, .below = given, .summary = "constants that replace the computed constants",
     .left_out = "none"},
    {"young", ENTRY_NUMBER, .unit = "Pa",
     .summary = "modulus of elasticity; for all sections except those given by stiffness",
     .left_out = "required, unless stiffness is given", ENTRY_IN(section_spec, young),
     .otherwise = 1, .always = 1},
    {"shear_modulus", ENTRY_NUMBER, .unit = "Pa",
     .summary = "E/(2 (1 + nu)); for all sections except those given by stiffness",
     .left_out = "required, unless stiffness is given", ENTRY_IN(section_spec, shear_modulus),
     .otherwise = 1, .always = 1},
    {"density", ENTRY_NUMBER, .unit = "kg/m^3", .summary = "density; 0: no inertia", .usual = "0",
     ENTRY_IN(section_spec, density)},
    {"expansion", ENTRY_NUMBER, .unit = "1/K", .summary = "coefficient of thermal expansion",
     .usual = "0", ENTRY_IN(section_spec, expansion)},
    {.name = NULL}};
