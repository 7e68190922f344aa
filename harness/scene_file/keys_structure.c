/* Keys of what a structure consists of. */
#include <stddef.h>

#include "harness/scene_file/keys.h"

#define COMPONENTS "ux|uy|uz|rx|ry|rz"

const scene_key keys_parameter[] = {
    {"value", KEY_FORMS, .needed = 1, .summary = "default: an expression of constants, or a word"},
    {"unit", KEY_TEXT, .summary = "SI unit; 1 for a plain number"},
    {"min", KEY_NUMBER, .summary = "least value"},
    {"max", KEY_NUMBER, .summary = "largest value"},
    {"choices", KEY_FORMS, .summary = "[WORD, ...]: the words that may be chosen"},
    {"about", KEY_TEXT, .summary = "what it is, in one line"},
    {.name = NULL}};

static const scene_key number[] = {{"", KEY_NUMBER, .summary = "an expression"}, {.name = NULL}};

static const scene_key rectangle[] = {
    {"width", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "along the member's z axis"},
    {"thickness", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "along its y axis"},
    {.name = NULL}};

static const scene_key tube[] = {
    {"diameter", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "outer one"},
    {"thickness", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "half the diameter: a bar"},
    {.name = NULL}};

static const scene_key point[] = {{"", KEY_VECTOR, .count = 2, .unit = "m", .summary = "[y, z]"},
                                  {.name = NULL}};

static const scene_key wall[] = {
    {"from", KEY_NAME, .needed = 1, .summary = "point where it begins"},
    {"to", KEY_NAME, .needed = 1, .summary = "point where it ends"},
    {"thickness", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "of the wall"},
    {.name = NULL}};

static const scene_key constants[] = {
    {"A", KEY_NUMBER, .needed = 1, .unit = "m^2", .summary = "area"},
    {"Iy", KEY_NUMBER, .needed = 1, .unit = "m^4", .summary = "int z^2 dA"},
    {"Iz", KEY_NUMBER, .needed = 1, .unit = "m^4", .summary = "int y^2 dA"},
    {"It", KEY_NUMBER, .needed = 1, .unit = "m^4", .summary = "torsion constant"},
    {"Iw", KEY_NUMBER, .unit = "m^6", .summary = "warping constant; 0: nothing warps"},
    {"Ip", KEY_NUMBER, .unit = "m^4", .summary = "polar moment; Iy + Iz where it is left out"},
    {"ys", KEY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along y"},
    {"zs", KEY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along z"},
    {"wagner_y", KEY_NUMBER, .unit = "m^5", .summary = "int y (y^2 + z^2) dA"},
    {"wagner_z", KEY_NUMBER, .unit = "m^5", .summary = "int z (y^2 + z^2) dA"},
    {"wagner_torque", KEY_NUMBER, .unit = "m^6", .summary = "c of the energy E c kx^4 per length"},
    {"D", KEY_VECTOR, .count = 9, .group = 1, .summary = "shear rigidities/G, order y, z, omega"},
    {"F", KEY_VECTOR, .count = 9, .group = 1, .summary = "its inverse; neither: rigid in shear"},
    {.name = NULL}};

static const scene_key given[] = {
    {"Iw", KEY_NUMBER, .unit = "m^6", .summary = "warping constant"},
    {"ys", KEY_NUMBER, .unit = "m", .summary = "shear centre, along y"},
    {"zs", KEY_NUMBER, .unit = "m", .summary = "shear centre, along z"},
    {"Dy", KEY_NUMBER, .unit = "m^2", .summary = "shear rigidity/G along y"},
    {"Dz", KEY_NUMBER, .unit = "m^2", .summary = "shear rigidity/G along z"},
    {"Dw", KEY_NUMBER, .unit = "m^4", .summary = "shear rigidity/G of warping"},
    {"Dyz", KEY_NUMBER, .unit = "m^2", .summary = "coupling of y and z"},
    {"Dyw", KEY_NUMBER, .unit = "m^3", .summary = "coupling of y and warping"},
    {"Dzw", KEY_NUMBER, .unit = "m^3", .summary = "coupling of z and warping"},
    {"It", KEY_NUMBER, .unit = "m^4", .summary = "torsion constant"},
    {"Ip", KEY_NUMBER, .unit = "m^4", .summary = "polar moment"},
    {.name = NULL}};

/* Sizes are those of the walls' centre lines. */
static const scene_key flanged[] = {
    {"depth", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "between the flanges"},
    {"flange", KEY_NUMBER, .needed = 1, .unit = "m",
     .summary = "its width; channel, zed: from the web"},
    {"flange_thickness", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "of both flanges"},
    {"web_thickness", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "of the web"},
    {.name = NULL}};

static const scene_key legs[] = {
    {"along_y", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "length of this leg"},
    {"along_z", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "length of that one"},
    {"thickness", KEY_NUMBER, .needed = 1, .unit = "m", .summary = "of both"},
    {.name = NULL}};

const scene_key keys_section[] = {
    {"rectangle", KEY_MAP, .needed = 1, .group = 1, .below = rectangle, .summary = "solid"},
    {"walls", KEY_LIST, .needed = 1, .group = 1, .below = wall, .summary = "thin straight walls"},
    {"constants", KEY_MAP, .needed = 1, .group = 1, .below = constants, .summary = "as given"},
    {"i", KEY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "web along z, in the middle"},
    {"channel", KEY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "flanges towards -y"},
    {"zed", KEY_MAP, .needed = 1, .group = 1, .below = flanged,
     .summary = "upper flange towards -y"},
    {"angle", KEY_MAP, .needed = 1, .group = 1, .below = legs, .summary = "from its corner"},
    {"box", KEY_MAP, .needed = 1, .group = 1, .below = flanged, .summary = "closed, two webs"},
    {"tube", KEY_MAP, .needed = 1, .group = 1, .below = tube, .summary = "circular, or a bar"},
    {"stiffness", KEY_NUMBERS, .needed = 1, .group = 1,
     .summary =
         "(N, Qy, Qz, Mx, My, Mz) from (gx, gy, gz, kx, ky, kz) on the member's line: the 36 "
         "of a symmetric matrix, or its diagonal"},
    {"mass", KEY_NUMBERS,
     .summary = "of stiffness, per length, of (vx, vy, vz, wx, wy, wz): 36, or the diagonal"},
    {"cells", KEY_NUMBER, .summary = "how many the walls close; 0 where it is left out"},
    {"points", KEY_NAMES, .below = point, .summary = "of walls, in axes of one's own"},
    {"young", KEY_NUMBER, .unit = "Pa", .summary = "modulus of elasticity; of all but stiffness"},
    {"shear_modulus", KEY_NUMBER, .unit = "Pa", .summary = "E/(2 (1 + nu)); of all but stiffness"},
    {"density", KEY_NUMBER, .unit = "kg/m^3", .summary = "0 where it is left out: no inertia"},
    {"shear_factor", KEY_FORMS, .summary = "rectangle: k, or [k_y, k_z]; left out: 5/6"},
    {"thickness_terms", KEY_WORD, .words = "no|yes", .summary = "walls: t^3 terms too"},
    {"given", KEY_MAP, .below = given, .summary = "replaces computed constants"},
    {.name = NULL}};

static const scene_key drive[] = {{"ux", KEY_NAME, .summary = "motion"},
                                  {"uy", KEY_NAME, .summary = "motion"},
                                  {"uz", KEY_NAME, .summary = "motion"},
                                  {"rx", KEY_NAME, .summary = "motion"},
                                  {"ry", KEY_NAME, .summary = "motion"},
                                  {"rz", KEY_NAME, .summary = "motion"},
                                  {.name = NULL}};

static const scene_key fork_[] = {
    {"axis", KEY_VECTOR, .needed = 1, .count = 3, .summary = "the section's own axis"},
    {"web", KEY_VECTOR, .needed = 1, .count = 3, .summary = "direction that the guides embrace"},
    {.name = NULL}};

static const scene_key turn[] = {
    {"axis", KEY_FORMS, .needed = 1, .summary = "x, y, z or [3]: turns with the angles before it"},
    {"angle", KEY_NAME, .needed = 1, .summary = "free, held or a motion"},
    {.name = NULL}};

static const scene_key rotation[] = {
    {"sequence", KEY_LIST, .needed = 1, .group = 1, .below = turn, .summary = "one to three turns"},
    {"vector", KEY_FORMS, .needed = 1, .group = 1, .summary = "[MOTION, MOTION, MOTION]"},
    {.name = NULL}};

const scene_key keys_node[] = {
    {"at", KEY_VECTOR, .needed = 1, .count = 3, .unit = "m", .summary = "position"},
    {"hold", KEY_WORDS, .words = "all|" COMPONENTS, .summary = "components that do not move"},
    {"drive", KEY_MAP, .below = drive, .summary = "components that follow a motion"},
    {"part_of", KEY_NAME, .summary = "node that it moves with, as one rigid body"},
    {"rotation", KEY_MAP, .below = rotation, .summary = "how it turns, where not freely"},
    {"fork", KEY_MAP, .below = fork_, .summary = "no turn about the turned section's axis"},
    {"mass", KEY_NUMBER, .unit = "kg", .summary = "of a rigid body that moves with it"},
    {"centre", KEY_VECTOR, .count = 3, .unit = "m", .summary = "of that mass, from the node"},
    {"inertia", KEY_VECTOR, .count = 6, .unit = "kg m^2",
     .summary = "tensor about that centre: [xx, yy, zz, xy, yz, zx]"},
    {.name = "velocity", .kind = KEY_LATER},
    {.name = "spin", .kind = KEY_LATER},
    {.name = NULL}};

static const scene_key release[] = {
    {"from", KEY_WORDS, .words = COMPONENTS,
     .summary = "at that end, in the member's axes: [rz] is a hinge, [rx, ry, rz] a ball"},
    {"to", KEY_WORDS, .words = COMPONENTS,
     .summary = "of two turns the first axis stays with the node, the second with the member"},
    {.name = NULL}};

const scene_key keys_member[] = {
    {"from", KEY_NAME, .needed = 1, .summary = "node where its x axis begins"},
    {"to", KEY_NAME, .needed = 1, .summary = "node where it ends"},
    {"section", KEY_FORMS, .needed = 1,
     .summary = "NAME, or [at from, at to]: sizes change linearly, elements are prismatic"},
    {"y", KEY_VECTOR, .needed = 1, .count = 3, .summary = "direction of the section's y axis"},
    {"warping", KEY_FORMS, .summary = "free, fixed, {shared: NAME}, or [at from, at to]"},
    {"curvature", KEY_VECTOR, .count = 3, .unit = "1/m", .summary = "initial twist, curvatures"},
    {"strain", KEY_VECTOR, .count = 3, .unit = "1", .summary = "initial elongation, shears"},
    {"divisions", KEY_NUMBER, .summary = "elements, whatever the mesh"},
    {.name = "offset", .kind = KEY_LATER},
    {"release", KEY_MAP, .below = release,
     .summary = "what its ends do not pass on: hinges, slides"},
    {"damping", KEY_NUMBER, .unit = "s",
     .summary = "in time: rates of its strains times its stiffness at rest, times this"},
    {.name = NULL}};

const scene_key keys_spring[] = {
    {"from", KEY_NAME, .summary = "node in whose axes it deforms; left out: the ground"},
    {"to", KEY_NAME, .needed = 1, .summary = "node at its other end"},
    {"stiffness", KEY_NUMBERS, .needed = 1,
     .summary = "of ux, uy, uz [N/m], rx, ry, rz [N m]: six, or the 36 of a symmetric matrix"},
    {.name = NULL}};

static const scene_key condition[] = {
    {"node", KEY_NAME, .needed = 1, .summary = "node whose coordinate is prescribed instead"},
    {"component", KEY_WORD, .needed = 1, .words = COMPONENTS, .summary = "of its coordinates"},
    {"motion", KEY_NAME, .needed = 1, .summary = "by this motion"},
    {.name = NULL}};

static const scene_key piece[] = {
    {"until", KEY_NUMBER, .unit = "s", .summary = "where it ends; the last one does not"},
    {"is", KEY_TEXT, .needed = 1, .summary = "expression of the time t [s]"},
    {.name = NULL}};

static const scene_key table[] = {
    {"at", KEY_NUMBERS, .needed = 1, .unit = "s", .summary = "instants, ascending"},
    {"value", KEY_NUMBERS, .needed = 1, .summary = "at these; the first before, the last behind"},
    {.name = NULL}};

const scene_key keys_motion[] = {
    {"unit", KEY_WORD, .words = "m|rad", .summary = "of its values"},
    {"path", KEY_NUMBERS, .summary = "path parameter, ascending"},
    {"value", KEY_NUMBERS, .summary = "at these, linear between; in time what it has at the end"},
    {"such_that", KEY_MAP, .group = 1, .below = condition, .summary = "unknown"},
    {"unknown", KEY_WORD, .words = "true|yes", .summary = "for the reader of the file"},
    {"time", KEY_TEXT, .group = 1,
     .summary = "in time: expression of the time t [s]; value in m or rad (30*deg*t)"},
    {"pieces", KEY_LIST, .group = 1, .below = piece,
     .summary = "likewise, one expression after the other; value and velocity do not jump"},
    {"table", KEY_MAP, .group = 1, .below = table,
     .summary = "likewise, a cubic spline that begins and ends at rest"},
    {.name = NULL}};

const scene_key keys_load[] = {
    {"force", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N", .summary = "at a node"},
    {"moment", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N m", .summary = "at one"},
    {"distributed", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N/m",
     .summary = "along a member"},
    {"distributed_moment", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N",
     .summary = "moments along a member, N m per m"},
    {"gravity", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "m/s^2",
     .summary = "on a member, whose section has a density, on a node, which has a mass, or on all "
                "that has"},
    {"on", KEY_NAME, .needed = 1, .summary = "node or member; of gravity also: all"},
    {"path", KEY_NUMBERS, .summary = "path parameter, ascending"},
    {"factor", KEY_NUMBERS, .summary = "at these; left out: the path parameter itself"},
    {"time", KEY_TEXT, .group = 2,
     .summary = "factor in time: expression of the time t [s]; left out: as at the end of the path "
                "that the motion follows, or 1"},
    {"pieces", KEY_LIST, .group = 2, .below = piece,
     .summary = "likewise, one expression after the other; it may jump between"},
    {"table", KEY_MAP, .group = 2, .below = table, .summary = "likewise, linear between"},
    {"at", KEY_VECTOR, .count = 3, .unit = "m",
     .summary = "of forces: offset from the node or the centroids"},
    {"axes", KEY_WORD, .words = "fixed|member",
     .summary = "of vector and 'at': fixed, or the undeformed member's"},
    {"follower", KEY_WORD, .words = "false|true|no|yes",
     .summary = "true: its direction turns with the node or the sections"},
    {.name = NULL}};

const scene_key keys_part[] = {
    {"let", KEY_NAMES, .below = number, .summary = "values derived for the part"},
    {"nodes", KEY_ENTRIES, .below = keys_node, .summary = "NAME is INSTANCE.NAME in the scene"},
    {"members", KEY_ENTRIES, .below = keys_member, .summary = "between nodes or places"},
    {"springs", KEY_ENTRIES, .below = keys_spring, .summary = "in the part's axes"},
    {"loads", KEY_ENTRIES, .below = keys_load, .summary = "in the part's axes"},
    {"places", KEY_FORMS, .summary = "[NAME, ...]: nodes of the scene that instances connect"},
    {.name = NULL}};

static const scene_key axes[] = {
    {"x", KEY_VECTOR, .needed = 1, .count = 3, .summary = "the part's x axis in the scene"},
    {"z", KEY_VECTOR, .needed = 1, .count = 3, .summary = "its z axis"},
    {.name = NULL}};

static const scene_key angles[] = {
    {"x", KEY_NUMBER, .group = 1, .unit = "rad", .summary = "about x"},
    {"y", KEY_NUMBER, .group = 1, .unit = "rad", .summary = "about y"},
    {"z", KEY_NUMBER, .group = 1, .unit = "rad", .summary = "about z"},
    {.name = NULL}};

static const scene_key outer[] = {{"", KEY_NAME, .summary = "node of the scene"}, {.name = NULL}};

const scene_key keys_instance[] = {
    {"part", KEY_NAME, .needed = 1, .summary = "name of the part"},
    {"at", KEY_VECTOR, .needed = 1, .count = 3, .unit = "m", .summary = "its origin"},
    {"axes", KEY_MAP, .group = 1, .below = axes, .summary = "its axes; left out: the scene's"},
    {"turn", KEY_MAP, .group = 1, .below = angles, .summary = "one angle about an axis"},
    {"connect", KEY_NAMES, .below = outer, .summary = "PLACE: NODE"},
    {.name = NULL}};

const scene_key keys_loop[] = {
    {"for", KEY_FORMS, .summary = "{NAME: a..b | a..b step c | a..b/n | [list], ...}: loops"},
    {"let", KEY_NAMES, .below = number, .summary = "values derived for this entry"},
    {.name = NULL}};
