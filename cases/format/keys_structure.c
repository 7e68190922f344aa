/* Keys of what a structure consists of. */
#include <stddef.h>

#include "cases/format/keys.h"

#define COMPONENTS "ux|uy|uz|rx|ry|rz"

const scene_key keys_parameter[] = {
    {"value", KEY_FORMS, .needed = 1, .summary = "default: an expression of constants, or a word"},
    {"unit", KEY_TEXT, .summary = "SI unit; 1 for a plain number", .usual = "1"},
    {"min", KEY_NUMBER, .summary = "least value", .left_out = "no limit"},
    {"max", KEY_NUMBER, .summary = "largest value", .left_out = "no limit"},
    {"choices", KEY_FORMS, .summary = "[WORD, ...]: the words that may be chosen",
     .left_out = "it is a number"},
    {"about", KEY_TEXT, .summary = "what it is, in one line", .left_out = "none"},
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
    {"Iw", KEY_NUMBER, .unit = "m^6", .summary = "warping constant; 0: nothing warps",
     .left_out = "not known: taken as 0"},
    {"Ip", KEY_NUMBER, .unit = "m^4", .summary = "polar moment", .left_out = "Iy + Iz"},
    {"ys", KEY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along y",
     .usual = "0"},
    {"zs", KEY_NUMBER, .unit = "m", .summary = "shear centre from the centroid, along z",
     .usual = "0"},
    {"wagner_y", KEY_NUMBER, .unit = "m^5", .summary = "int y (y^2 + z^2) dA",
     .left_out = "not known: taken as 0"},
    {"wagner_z", KEY_NUMBER, .unit = "m^5", .summary = "int z (y^2 + z^2) dA",
     .left_out = "not known: taken as 0"},
    {"wagner_torque", KEY_NUMBER, .unit = "m^6", .summary = "c of the energy E c kx^4 per length",
     .left_out = "not known: taken as 0"},
    {"D", KEY_VECTOR, .count = 9, .group = 1, .summary = "shear rigidities/G, order y, z, omega",
     .left_out = "that of F; neither: rigid in shear"},
    {"F", KEY_VECTOR, .count = 9, .group = 1, .summary = "its inverse",
     .left_out = "that of D; neither: rigid in shear"},
    {.name = NULL}};

static const scene_key given[] = {
    {"Iw", KEY_NUMBER, .unit = "m^6", .summary = "warping constant", .left_out = "as computed"},
    {"ys", KEY_NUMBER, .unit = "m", .summary = "shear centre, along y", .left_out = "as computed"},
    {"zs", KEY_NUMBER, .unit = "m", .summary = "shear centre, along z", .left_out = "as computed"},
    {"Dy", KEY_NUMBER, .unit = "m^2", .summary = "shear rigidity/G along y",
     .left_out = "as computed"},
    {"Dz", KEY_NUMBER, .unit = "m^2", .summary = "shear rigidity/G along z",
     .left_out = "as computed"},
    {"Dw", KEY_NUMBER, .unit = "m^4", .summary = "shear rigidity/G of warping",
     .left_out = "as computed"},
    {"Dyz", KEY_NUMBER, .unit = "m^2", .summary = "coupling of y and z", .left_out = "as computed"},
    {"Dyw", KEY_NUMBER, .unit = "m^3", .summary = "coupling of y and warping",
     .left_out = "as computed"},
    {"Dzw", KEY_NUMBER, .unit = "m^3", .summary = "coupling of z and warping",
     .left_out = "as computed"},
    {"It", KEY_NUMBER, .unit = "m^4", .summary = "torsion constant", .left_out = "as computed"},
    {"Ip", KEY_NUMBER, .unit = "m^4", .summary = "polar moment", .left_out = "as computed"},
    {"wagner_torque", KEY_NUMBER, .unit = "m^6", .summary = "c of the energy E c kx^4 per length",
     .left_out = "as computed"},
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
     .summary = "of stiffness, per length, of (vx, vy, vz, wx, wy, wz): 36, or the diagonal",
     .usual = "[0, 0, 0, 0, 0, 0]"},
    {"cells", KEY_NUMBER, .summary = "how many the walls close", .usual = "0"},
    {"points", KEY_NAMES, .below = point, .summary = "of walls, in axes of one's own",
     .left_out = "none"},
    {"young", KEY_NUMBER, .unit = "Pa", .summary = "modulus of elasticity; of all but stiffness",
     .left_out = "a mistake, unless stiffness is given"},
    {"shear_modulus", KEY_NUMBER, .unit = "Pa", .summary = "E/(2 (1 + nu)); of all but stiffness",
     .left_out = "a mistake, unless stiffness is given"},
    {"density", KEY_NUMBER, .unit = "kg/m^3", .summary = "0: no inertia", .usual = "0"},
    {"shear_factor", KEY_FORMS, .summary = "rectangle: k, or [k_y, k_z]",
     .left_out = "5/6, with the warping's own shear"},
    {"thickness_terms", KEY_WORD, .words = "no|yes", .summary = "walls: t^3 terms too",
     .usual = "no"},
    {"given", KEY_MAP, .below = given, .summary = "replaces computed constants",
     .left_out = "nothing is replaced"},
    {.name = NULL}};

static const scene_key drive[] = {{"ux", KEY_NAME, .summary = "motion", .left_out = "not driven"},
                                  {"uy", KEY_NAME, .summary = "motion", .left_out = "not driven"},
                                  {"uz", KEY_NAME, .summary = "motion", .left_out = "not driven"},
                                  {"rx", KEY_NAME, .summary = "motion", .left_out = "not driven"},
                                  {"ry", KEY_NAME, .summary = "motion", .left_out = "not driven"},
                                  {"rz", KEY_NAME, .summary = "motion", .left_out = "not driven"},
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
    {"hold", KEY_WORDS, .words = "all|" COMPONENTS,
     .summary = "components that do not move; of one turn alone: about that fixed "
                "axis",
     .usual = "[]"},
    {"drive", KEY_MAP, .below = drive, .summary = "components that follow a motion",
     .left_out = "nothing is driven"},
    {"part_of", KEY_NAME, .summary = "node that it moves with, as one rigid body",
     .left_out = "of no body"},
    {"rotation", KEY_MAP, .below = rotation, .summary = "how it turns, where not freely",
     .left_out = "as hold, drive and fork say"},
    {"fork", KEY_MAP, .below = fork_, .summary = "no turn about the turned section's axis",
     .left_out = "none"},
    {"mass", KEY_NUMBER, .unit = "kg", .summary = "of a rigid body that moves with it",
     .usual = "0"},
    {"centre", KEY_VECTOR, .count = 3, .unit = "m", .summary = "of that mass, from the node",
     .usual = "[0, 0, 0]"},
    {"inertia", KEY_VECTOR, .count = 6, .unit = "kg m^2",
     .summary = "tensor about that centre: [xx, yy, zz, xy, yz, zx]",
     .usual = "[0, 0, 0, 0, 0, 0]"},
    {.name = "velocity", .kind = KEY_LATER},
    {.name = "spin", .kind = KEY_LATER},
    {.name = NULL}};

static const scene_key release[] = {
    {"from", KEY_WORDS, .words = COMPONENTS,
     .summary = "at that end, in the member's axes: [rz] is a hinge, [rx, ry, rz] a ball",
     .usual = "[]"},
    {"to", KEY_WORDS, .words = COMPONENTS,
     .summary = "of two turns the first axis stays with the node, the second with the member",
     .usual = "[]"},
    {.name = NULL}};

const scene_key keys_member[] = {
    {"from", KEY_NAME, .needed = 1, .summary = "node where its x axis begins"},
    {"to", KEY_NAME, .needed = 1, .summary = "node where it ends"},
    {"section", KEY_FORMS, .needed = 1,
     .summary = "NAME, or [at from, at to]: sizes change linearly, elements are prismatic"},
    {"y", KEY_VECTOR, .needed = 1, .count = 3, .summary = "direction of the section's y axis"},
    {"warping", KEY_FORMS, .summary = "free, fixed, {shared: NAME}, or [at from, at to]",
     .left_out =
         "fixed where all six components of the node are held or driven or it is tied by part_of, "
         "and no turn is released; shared where two members run on in one line; else free"},
    {"curvature", KEY_VECTOR, .count = 3, .unit = "1/m", .summary = "initial twist, curvatures",
     .usual = "[0, 0, 0]"},
    {"strain", KEY_VECTOR, .count = 3, .unit = "1", .summary = "initial elongation, shears",
     .usual = "[0, 0, 0]"},
    {"divisions", KEY_NUMBER,
     .summary =
         "elements, whatever the mesh; of each piece where loads begin, end or act within it",
     .left_out = "as the mesh says"},
    {.name = "offset", .kind = KEY_LATER},
    {"release", KEY_MAP, .below = release,
     .summary = "what its ends do not pass on: hinges, slides", .left_out = "nothing"},
    {"damping", KEY_NUMBER, .unit = "s",
     .summary = "in time: rates of its strains times its stiffness at rest, times this",
     .usual = "0"},
    {.name = NULL}};

const scene_key keys_spring[] = {
    {"from", KEY_NAME, .summary = "node in whose axes it deforms", .left_out = "the ground"},
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
    {"until", KEY_NUMBER, .unit = "s", .summary = "where it ends; the last one does not",
     .left_out = "for ever, of the last one"},
    {"is", KEY_TEXT, .needed = 1, .summary = "expression of the time t [s]"},
    {.name = NULL}};

static const scene_key table[] = {
    {"at", KEY_NUMBERS, .needed = 1, .unit = "s", .summary = "instants, ascending"},
    {"value", KEY_NUMBERS, .needed = 1, .summary = "at these; the first before, the last behind"},
    {.name = NULL}};

const scene_key keys_motion[] = {
    {"unit", KEY_WORD, .words = "m|rad", .summary = "of its values",
     .left_out = "that of what it drives"},
    {"path", KEY_NUMBERS, .summary = "path parameter, ascending",
     .left_out = "none: needed with value"},
    {"value", KEY_NUMBERS, .summary = "at these, linear between; in time what it has at the end",
     .left_out = "none: in time, or unknown"},
    {"such_that", KEY_MAP, .group = 1, .below = condition, .summary = "unknown",
     .left_out = "it is known"},
    {"unknown", KEY_WORD, .words = "true|yes", .summary = "for the reader of the file",
     .left_out = "as such_that says"},
    {"time", KEY_TEXT, .group = 1,
     .summary = "in time: expression of the time t [s]; value in m or rad (30*deg*t)",
     .left_out = "it is along a path"},
    {"pieces", KEY_LIST, .group = 1, .below = piece,
     .summary = "likewise, one expression after the other; value and velocity do not jump",
     .left_out = "it is along a path"},
    {"table", KEY_MAP, .group = 1, .below = table,
     .summary = "likewise, a cubic spline that begins and ends at rest",
     .left_out = "it is along a path"},
    {.name = NULL}};

const scene_key keys_load[] = {
    {"force", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N",
     .summary = "at a node, or at 'where' of a member"},
    {"moment", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N m",
     .summary = "at one, or there"},
    {"distributed", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N/m",
     .summary = "along a member"},
    {"distributed_moment", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N",
     .summary = "moments along a member, N m per m"},
    {"gravity", KEY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "m/s^2",
     .summary = "on a member, whose section has a density, on a node, which has a mass, or on all "
                "that has"},
    {"on", KEY_NAME, .needed = 1, .summary = "node or member; of gravity also: all"},
    {"where", KEY_NUMBER,
     .summary = "of a force or a moment within a member: 0 'from' to 1 'to', of its length",
     .left_out = "it is at a node"},
    {"from", KEY_NUMBER, .summary = "of a distributed load: where it begins, of the length",
     .usual = "0"},
    {"to", KEY_NUMBER, .summary = "where it ends, of the length", .usual = "1"},
    {"to_value", KEY_VECTOR, .count = 3,
     .summary = "of a distributed load: what it is at 'to', linear from what it is at 'from'",
     .left_out = "the same all along"},
    {"lumped", KEY_WORD, .words = "false|true|no|yes",
     .summary = "of a distributed load or gravity: half of an element's share on each of its "
                "nodes, of second order",
     .usual = "no"},
    {"path", KEY_NUMBERS, .summary = "path parameter, ascending",
     .left_out = "none: needed with factor"},
    {"factor", KEY_NUMBERS, .summary = "at these", .left_out = "the path parameter itself"},
    {"time", KEY_TEXT, .group = 2, .summary = "factor in time: expression of the time t [s]",
     .left_out = "as at the end of the path that a motion follows, or 1"},
    {"pieces", KEY_LIST, .group = 2, .below = piece,
     .summary = "likewise, one expression after the other; it may jump between",
     .left_out = "likewise"},
    {"table", KEY_MAP, .group = 2, .below = table, .summary = "likewise, linear between",
     .left_out = "likewise"},
    {"at", KEY_VECTOR, .count = 3, .unit = "m",
     .summary = "of forces: offset from the node or the centroids", .usual = "[0, 0, 0]"},
    {"axes", KEY_WORD, .words = "fixed|member",
     .summary = "of vector and 'at': fixed, or the undeformed member's", .usual = "fixed"},
    {"follower", KEY_WORD, .words = "false|true|no|yes",
     .summary = "true: its direction turns with the node or the sections", .usual = "false"},
    {.name = NULL}};

const scene_key keys_part[] = {
    {"let", KEY_NAMES, .below = number, .summary = "values derived for the part",
     .left_out = "none"},
    {"nodes", KEY_ENTRIES, .below = keys_node, .summary = "NAME is INSTANCE.NAME in the scene",
     .left_out = "none"},
    {"members", KEY_ENTRIES, .below = keys_member, .summary = "between nodes or places",
     .left_out = "none"},
    {"springs", KEY_ENTRIES, .below = keys_spring, .summary = "in the part's axes",
     .left_out = "none"},
    {"loads", KEY_ENTRIES, .below = keys_load, .summary = "in the part's axes", .left_out = "none"},
    {"places", KEY_FORMS, .summary = "[NAME, ...]: nodes of the scene that instances connect",
     .left_out = "none"},
    {.name = NULL}};

static const scene_key axes[] = {
    {"x", KEY_VECTOR, .needed = 1, .count = 3, .summary = "the part's x axis in the scene"},
    {"z", KEY_VECTOR, .needed = 1, .count = 3, .summary = "its z axis"},
    {.name = NULL}};

static const scene_key angles[] = {
    {"x", KEY_NUMBER, .group = 1, .unit = "rad", .summary = "about x", .left_out = "no turn"},
    {"y", KEY_NUMBER, .group = 1, .unit = "rad", .summary = "about y", .left_out = "no turn"},
    {"z", KEY_NUMBER, .group = 1, .unit = "rad", .summary = "about z", .left_out = "no turn"},
    {.name = NULL}};

static const scene_key outer[] = {{"", KEY_NAME, .summary = "node of the scene"}, {.name = NULL}};

const scene_key keys_instance[] = {
    {"part", KEY_NAME, .needed = 1, .summary = "name of the part"},
    {"at", KEY_VECTOR, .needed = 1, .count = 3, .unit = "m", .summary = "its origin"},
    {"axes", KEY_MAP, .group = 1, .below = axes, .summary = "its axes",
     .left_out = "those of the scene"},
    {"turn", KEY_MAP, .group = 1, .below = angles, .summary = "one angle about an axis",
     .left_out = "none"},
    {"connect", KEY_NAMES, .below = outer, .summary = "PLACE: NODE",
     .left_out = "none; needed for each place"},
    {.name = NULL}};

const scene_key keys_loop[] = {
    {"for", KEY_FORMS, .summary = "{NAME: a..b | a..b step c | a..b/n | [list], ...}: loops",
     .left_out = "it is there once"},
    {"let", KEY_NAMES, .below = number, .summary = "values derived for this entry",
     .left_out = "none"},
    {.name = NULL}};
