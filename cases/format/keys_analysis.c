/* Keys of what is asked: analyses, quantities, truths. */
#include <stddef.h>

#include "cases/format/keys.h"
#include "cases/scene/quantity.h"
#include "cases/scene/scene.h"

#define COMPONENTS "ux|uy|uz|rx|ry|rz"

static const scene_key nothing[] = {{.name = NULL}};

static const scene_key spin[] = {
    {"omega", KEY_VECTOR, .needed = 1, .count = 3, .unit = "rad/s", .summary = "angular velocity"},
    {"centre", KEY_VECTOR, .count = 3, .unit = "m", .summary = "a point of its axis",
     .usual = "[0, 0, 0]"},
    {.name = NULL}};

static const scene_key path[] = {
    {"stations", KEY_NUMBERS, .needed = 1, .summary = "path parameter, ascending"},
    {"steps", KEY_NUMBER,
     .summary = "load steps between two stations, to begin with; longer where that goes well",
     .usual = "1"},
    {"spin", KEY_MAP, .below = spin, .summary = "the axes turn", .left_out = "they do not"},
    {.name = NULL}};

static const scene_key modes[] = {
    {"wanted", KEY_NUMBER, .summary = "how many", .left_out = "as quantities ask for"},
    {"about", KEY_NAME, .summary = "static analysis about whose last state",
     .left_out = "undeformed"},
    {.name = NULL}};

static const scene_key buckling[] = {
    {"wanted", KEY_NUMBER, .summary = "how many", .left_out = "as quantities ask for"},
    {"about", KEY_NAME, .summary = "static analysis about whose last state",
     .left_out = "undeformed"},
    {.name = "sign", .kind = KEY_LATER},
    {.name = NULL}};

static const scene_key compliance[] = {
    {"node", KEY_NAME, .needed = 1, .summary = "where"},
    {"about", KEY_NAME, .summary = "static analysis, continuation or rotation at whose stations",
     .left_out = "undeformed"},
    {"released", KEY_WORDS, .words = COMPONENTS, .summary = "prescribed components that are free",
     .usual = "[]"},
    {"moments", KEY_WORD, .words = "spatial|semitangential|symmetrised",
     .summary = "what a reaction's moment does while its node turns", .usual = "spatial"},
    {.name = NULL}};

static const scene_key control[] = {
    {"node", KEY_NAME, .needed = 1, .summary = "whose translation"},
    {"component", KEY_WORD, .needed = 1, .words = "ux|uy|uz", .summary = "of these"},
    {.name = NULL}};

static const scene_key continuation[] = {
    {"control", KEY_MAP, .needed = 1, .below = control, .summary = "coordinate that grows"},
    {"by", KEY_WORD, .words = "coordinate|arc", .summary = "what steps are measured in",
     .usual = "coordinate"},
    {"to", KEY_NUMBERS, .needed = 1, .unit = "m", .summary = "of the coordinate, as met"},
    {"step", KEY_NUMBER, .needed = 1, .summary = "first step"},
    {"step_max", KEY_NUMBER, .summary = "largest step", .left_out = "the first"},
    {"constant", KEY_WORD, .words = "yes|no", .summary = "steps keep their size", .usual = "no"},
    {"spin", KEY_MAP, .below = spin, .summary = "the axes turn", .left_out = "they do not"},
    {.name = NULL}};

static const scene_key rotation[] = {
    {"omega", KEY_VECTOR, .needed = 1, .count = 3, .unit = "rad/s", .summary = "angular velocity"},
    {"centre", KEY_VECTOR, .count = 3, .unit = "m", .summary = "a point of its axis",
     .usual = "[0, 0, 0]"},
    {"stations", KEY_NUMBERS, .needed = 1, .summary = "factors of omega, ascending"},
    {"steps", KEY_NUMBER,
     .summary = "load steps between two stations, to begin with; longer where that goes well",
     .usual = "1"},
    {"wanted", KEY_NUMBER, .summary = "modes to look for at first, of all families", .usual = "0"},
    {.name = NULL}};

static const scene_key start[] = {{"velocity", KEY_VECTOR, .count = 3, .unit = "m/s",
                                   .summary = "of all nodes", .usual = "[0, 0, 0]"},
                                  {"spin", KEY_VECTOR, .count = 3, .unit = "rad/s",
                                   .summary = "of the whole, about the centre",
                                   .usual = "[0, 0, 0]"},
                                  {"centre", KEY_VECTOR, .count = 3, .unit = "m",
                                   .summary = "a point of its axis", .usual = "[0, 0, 0]"},
                                  {.name = NULL}};

static const scene_key in_time[] = {
    {"stations", KEY_NUMBERS, .needed = 1, .unit = "s",
     .summary = "instants at which quantities are read, ascending; it begins at 0"},
    {"integrator", KEY_WORD, .words = SCENE_SCHEME_CHOICES, .summary = "method",
     .left_out = "alpha where there is one of its parameters, or a step without a tolerance; else "
                 "radau"},
    {"step", KEY_NUMBER, .unit = "s",
     .summary = "of the integration; with a tolerance the first one",
     .left_out = "1/1000 of the last station"},
    {"tolerance", KEY_NUMBER,
     .summary = "of the error of time, relative to the largest motion so far (at most the size of "
                "the structure): by alpha and conserving of all steps together, each has its share "
                "by its length, by radau of the estimate of one step, which is far above its "
                "error; 0: all steps are alike",
     .left_out = "0 where there is a step; else 1e-3, by radau 1e-5: 0.1 % of the motion"},
    {"rho", KEY_NUMBER, .group = 1,
     .summary = "of alpha, 0 to 1: what is left in a step of motions that are not resolved",
     .usual = "0.9"},
    {"hht", KEY_NUMBER, .group = 1,
     .summary = "of alpha: the method of Hilber, Hughes and Taylor, 0 to 1/3",
     .left_out = "as rho says"},
    {"trapezoidal", KEY_WORD, .group = 1, .words = "no|yes",
     .summary = "of alpha: the trapezoidal rule, which may blow up; for comparison", .usual = "no"},
    {"parameters", KEY_VECTOR, .group = 1, .count = 2, .summary = "of alpha: alpha_m, alpha_f",
     .left_out = "as rho says"},
    {"mass", KEY_WORD, .words = SCENE_MASS_CHOICES,
     .summary = "of members: lumped at the nodes, or consistent, by alpha and radau",
     .left_out = "consistent by alpha and radau, lumped by the others or as the scene says"},
    {"about", KEY_NAME,
     .summary = "static analysis, continuation or rotation from whose last state, or motion that "
                "goes on, with its "
                "rates and its time",
     .left_out = "undeformed"},
    {"start", KEY_MAP, .below = start, .summary = "velocities at the begin",
     .left_out = "at rest, or as about has it"},
    {.name = NULL}};

const scene_key keys_analysis[] = {
    {"linear", KEY_MAP, .needed = 1, .group = 1, .below = nothing, .summary = "loads at factor 1"},
    {"static", KEY_MAP, .needed = 1, .group = 1, .below = path, .summary = "along a path"},
    {"buckling", KEY_MAP, .needed = 1, .group = 1, .below = buckling, .summary = "critical loads"},
    {"modal", KEY_MAP, .needed = 1, .group = 1, .below = modes,
     .summary = "frequencies; driven components are held"},
    {"compliance", KEY_MAP, .needed = 1, .group = 1, .below = compliance, .summary = "6 x 6"},
    {"continuation", KEY_MAP, .needed = 1, .group = 1, .below = continuation,
     .summary = "path of a load factor"},
    {"rotation", KEY_MAP, .needed = 1, .group = 1, .below = rotation, .summary = "stationary"},
    {"motion", KEY_MAP, .needed = 1, .group = 1, .below = in_time,
     .summary = "in time: dynamics; needs masses"},
    {.name = NULL}};

#define TAKEN                                                                                      \
    {"analysis", KEY_NAME, .needed = 1, .summary = "analysis"},                                    \
        {"at", KEY_NUMBER, .group = 1, .summary = "station", .left_out = "as take says"},          \
        {"take",                                                                                   \
         KEY_WORD,                                                                                 \
         .group = 1,                                                                               \
         .words = SCENE_TAKE_CHOICES,                                                              \
         .summary = "of all stations",                                                             \
         .usual = "last"}

static const scene_key component[] = {
    TAKEN,
    {"node", KEY_NAME, .needed = 1, .summary = "node"},
    {"component", KEY_WORD, .needed = 1, .words = COMPONENTS, .summary = "of its coordinates"},
    {.name = NULL}};

static const scene_key reaction[] = {
    TAKEN,
    {"node", KEY_NAME, .needed = 1, .summary = "node"},
    {"component", KEY_WORD, .needed = 1, .words = COMPONENTS "|turn_1",
     .summary = "of its coordinates; turn_1: about the first axis of its sequence"},
    {.name = NULL}};

static const scene_key internal[] = {
    TAKEN,
    {"member", KEY_NAME, .needed = 1, .summary = "member"},
    {"end", KEY_WORD, .needed = 1, .group = 2, .words = "from|to", .summary = "of the member"},
    {"where", KEY_NUMBER, .needed = 1, .group = 2, .summary = "0 'from' to 1 'to', of its length"},
    {"side", KEY_WORD, .words = "from|to",
     .summary = "of 'where', towards that node: resultants jump where a load acts", .usual = "to"},
    {"along", KEY_WORD, .needed = 1, .group = 2, .words = "max|min|largest",
     .summary = "over the member: largest and least value, or largest magnitude"},
    {"resultant", KEY_WORD, .needed = 1, .words = SCENE_RESULTANT_CHOICES,
     .summary = "of what lies towards 'to', in the turned section's principal axes"},
    {.name = NULL}};

static const scene_key stress[] = {
    TAKEN,
    {"member", KEY_NAME, .needed = 1, .summary = "member; its section not given by constants"},
    {"where", KEY_NUMBER, .summary = "0 'from' to 1 'to', of its length",
     .left_out = "all along it"},
    {"side", KEY_WORD, .words = "from|to",
     .summary = "of 'where', towards that node: resultants jump where a load acts", .usual = "to"},
    {"measure", KEY_WORD, .words = SCENE_STRESS_CHOICES, .summary = "over the section's points",
     .usual = "von_mises"},
    {.name = NULL}};

static const scene_key entry[] = {
    TAKEN,
    {"row", KEY_WORD, .needed = 1, .words = COMPONENTS, .summary = "response"},
    {"column", KEY_WORD, .needed = 1, .words = COMPONENTS, .summary = "force or moment"},
    {.name = NULL}};

static const scene_key diagonal[] = {
    TAKEN,
    {"component", KEY_WORD, .needed = 1, .words = COMPONENTS, .summary = "of the coordinates"},
    {.name = NULL}};

static const scene_key critical[] = {
    {"analysis", KEY_NAME, .needed = 1, .summary = "analysis"},
    {"which", KEY_NUMBER, .summary = "counted from 0", .usual = "0"},
    {"sign", KEY_WORD, .words = "positive|negative", .summary = "of the load factor",
     .usual = "positive"},
    {.name = NULL}};

static const scene_key frequency[] = {
    TAKEN,
    {"which", KEY_NUMBER, .summary = "counted from 0, of the family", .usual = "0"},
    {"family", KEY_WORD, .words = "any|not_axial|axial|bending_y|bending_z|torsion",
     .summary = "of modes", .usual = "any"},
    {"half_waves", KEY_NUMBER, .summary = "of the mode; 0: any", .usual = "0"},
    {.name = NULL}};

static const scene_key whole[] = {TAKEN, {.name = NULL}};

static const scene_key motion[] = {
    TAKEN, {"motion", KEY_NAME, .needed = 1, .summary = "unknown motion"}, {.name = NULL}};

static const scene_key orientation[] = {
    TAKEN,
    {"node", KEY_NAME, .needed = 1, .summary = "node"},
    {"row", KEY_WORD, .needed = 1, .words = "x|y|z", .summary = "of its rotation matrix"},
    {"column", KEY_WORD, .needed = 1, .words = "x|y|z", .summary = "of it"},
    {.name = NULL}};

static const scene_key energy[] = {
    TAKEN,
    {"of", KEY_WORD, .needed = 1, .words = "kinetic|strain|energy|work|dissipated|drift",
     .summary = "drift: energy and what was dissipated, less energy of the begin and work"},
    {.name = NULL}};

static const scene_key momentum[] = {TAKEN,
                                     {"component", KEY_WORD, .needed = 1,
                                      .words = "px|py|pz|lx|ly|lz",
                                      .summary = "p: linear; l: angular, about the origin"},
                                     {.name = NULL}};

static const scene_key relative[] = {
    TAKEN,
    {"node", KEY_NAME, .needed = 1, .summary = "node"},
    {"from", KEY_NAME, .needed = 1, .summary = "node in whose axes"},
    {"component", KEY_WORD, .needed = 1, .words = COMPONENTS, .summary = "of its motion"},
    {.name = NULL}};

static const scene_key critical_point[] = {
    {"analysis", KEY_NAME, .needed = 1, .summary = "continuation"},
    {"kind", KEY_WORD, .needed = 1, .words = "limit|bifurcation", .summary = "of the point"},
    {"which", KEY_NUMBER, .summary = "counted from 0", .usual = "0"},
    {"value", KEY_WORD, .words = "factor|coordinate",
     .summary = "what of it: the load factor or the coordinate", .usual = "factor"},
    {.name = NULL}};

static const scene_key abscissa[] = {
    {"quantity", KEY_NAME, .summary = "whose curve, of the same path, it is",
     .left_out = "the path, or time"},
    {"name", KEY_TEXT, .summary = "its name", .left_out = "path, or time"},
    {"unit", KEY_TEXT, .summary = "its unit", .left_out = "1; over time, with factor 1, s"},
    {"factor", KEY_NUMBER, .summary = "times the path parameter", .usual = "1"},
    {"offset", KEY_NUMBER, .summary = "added to it", .usual = "0"},
    {.name = NULL}};

static const scene_key when[] = {
    {"level", KEY_NUMBER, .summary = "that is crossed, in SI units before factor and offset",
     .usual = "0"},
    {"direction", KEY_WORD, .words = SCENE_DIRECTION_CHOICES, .summary = "of the crossing",
     .usual = "rising"},
    {"which", KEY_NUMBER, .summary = "crossing, counted from 0", .usual = "0"},
    {"from", KEY_NUMBER, .summary = "begin of the window [s]", .usual = "0"},
    {"until", KEY_NUMBER, .summary = "its end [s]", .left_out = "that of the motion"},
    {.name = NULL}};

static const scene_key prediction[] = {
    {"value", KEY_NUMBER, .needed = 1, .summary = "of a model with an error of its own"},
    {"source", KEY_TEXT, .needed = 1, .summary = "of the model"},
    {.name = NULL}};

const scene_key keys_quantity[] = {
    {"displacement", KEY_MAP, .needed = 1, .group = 1, .below = component,
     .summary = "or rotation, of a node"},
    {"reaction", KEY_MAP, .needed = 1, .group = 1, .below = reaction,
     .summary = "of a held or driven component"},
    {"compliance", KEY_MAP, .needed = 1, .group = 1, .below = entry,
     .summary = "entry of the matrix"},
    {"stiffness", KEY_MAP, .needed = 1, .group = 1, .below = diagonal,
     .summary = "1/compliance, the other components free"},
    {"critical_factor", KEY_MAP, .needed = 1, .group = 1, .below = critical,
     .summary = "critical load factor"},
    {"frequency", KEY_MAP, .needed = 1, .group = 1, .below = frequency,
     .summary = "natural frequency"},
    {"growth", KEY_MAP, .needed = 1, .group = 1, .below = whole,
     .summary = "largest rate of growth of a small motion"},
    {"factor_at", KEY_MAP, .needed = 1, .group = 1, .below = whole,
     .summary = "load factor where the control coordinate has a value"},
    {"critical_point", KEY_MAP, .needed = 1, .group = 1, .below = critical_point,
     .summary = "where the tangent is singular"},
    {"motion", KEY_MAP, .needed = 1, .group = 1, .below = motion,
     .summary = "value of an unknown motion"},
    {"internal", KEY_MAP, .needed = 1, .group = 1, .below = internal,
     .summary = "resultant of stresses on a section of a member"},
    {"stress", KEY_MAP, .needed = 1, .group = 1, .below = stress,
     .summary = "largest stress of a member or of a section of it"},
    {"rate", KEY_MAP, .needed = 1, .group = 1, .below = component,
     .summary = "velocity of a node, or angular velocity in its own axes"},
    {"orientation", KEY_MAP, .needed = 1, .group = 1, .below = orientation,
     .summary = "entry of a node's rotation matrix"},
    {"relative", KEY_MAP, .needed = 1, .group = 1, .below = relative,
     .summary = "displacement or rotation as seen from another node"},
    {"energy", KEY_MAP, .needed = 1, .group = 1, .below = energy, .summary = "of a motion"},
    {"momentum", KEY_MAP, .needed = 1, .group = 1, .below = momentum, .summary = "of a motion"},
    {"unit", KEY_TEXT, .summary = "SI unit", .left_out = "that of the kind"},
    {"tolerance", KEY_NUMBER, .summary = "relative, of the limit", .usual = "1e-3"},
    {"order", KEY_NUMBER, .summary = "least order of convergence", .usual = "0"},
    {"near_zero", KEY_NUMBER, .summary = "scale of errors of values near zero", .usual = "0"},
    {"factor", KEY_NUMBER, .summary = "reported value = factor value + offset", .usual = "1"},
    {"offset", KEY_NUMBER, .summary = "in the same unit", .usual = "0"},
    {"x", KEY_MAP, .below = abscissa, .summary = "abscissa of a curve",
     .left_out = "the path or time"},
    {"when", KEY_MAP, .below = when, .summary = "of a motion: which crossing, and its window",
     .left_out = "the first that rises through 0"},
    {"prediction", KEY_MAP, .below = prediction, .summary = "shown, never judged",
     .left_out = "none"},
    {.name = NULL}};

const scene_key keys_truth[] = {
    {"quantity", KEY_NAME, .needed = 1, .summary = "quantity"},
    {"value", KEY_NUMBER, .needed = 1, .summary = "in its unit"},
    {"kind", KEY_WORD, .needed = 1,
     .words = "exact|predicted|independent|agreement|consensus|published|reconstructed|experiment",
     .summary = "how it is known"},
    {"source", KEY_TEXT, .needed = 1, .summary = "who says so"},
    {"uncertainty", KEY_NUMBER, .summary = "of the value, same unit", .usual = "0"},
    {"formulation", KEY_TEXT, .summary = "of whom it speaks", .left_out = "of the continuum"},
    {"theory", KEY_WORD, .words = SCENE_SHEAR_THEORIES, .summary = "of shear in stability",
     .left_out = "of any"},
    {"parameters", KEY_NAMES, .below = nothing, .summary = "NAME: VALUE", .left_out = "any values"},
    {"at", KEY_NUMBER, .summary = "point of a curve", .left_out = "of the one value"},
    {"model", KEY_WORD, .words = "plate|solid", .summary = "another one: informs, never gates",
     .left_out = "of beams"},
    {"convention", KEY_TEXT, .summary = "of moments", .left_out = "that of the analysis"},
    {.name = NULL}};
