/* Analyses and quantities of a scene. */
#include "cases/scene/scene.h"

#include <math.h>

/* Which loads act. */
#define ACTING(otherwise)                                                                          \
    {"case",                                                                                       \
     ENTRY_NAME,                                                                                   \
     .group = 3,                                                                                   \
     .summary = "load case that acts",                                                             \
     .left_out = (otherwise),                                                                      \
     ENTRY_IN(scene_analysis, acting.load_case),                                                   \
     .of = SCENE_CASES},                                                                           \
    {                                                                                              \
        "combination", ENTRY_NAME, .group = 3, .summary = "of load cases that acts",               \
            .left_out = (otherwise), ENTRY_IN(scene_analysis, acting.combination),                 \
            .of = SCENE_COMBINATIONS                                                               \
    }
static const char all_loads[] = "all loads; needed where they have cases";

static const entry_field linear[] = {
    ACTING("all loads; where they have cases each one is solved, and quantities say which"),
    {.name = NULL}};

#define OMEGA(member)                                                                              \
    {"omega",                                                                                      \
     ENTRY_VECTOR,                                                                                 \
     .needed = 1,                                                                                  \
     .count = 3,                                                                                   \
     .unit = "rad/s",                                                                              \
     .summary = "angular velocity",                                                                \
     ENTRY_IN(scene_analysis, member.omega)},                                                      \
        {"centre",                                                                                 \
         ENTRY_VECTOR,                                                                             \
         .count = 3,                                                                               \
         .unit = "m",                                                                              \
         .summary = "a point of its axis",                                                         \
         .usual = "[0, 0, 0]",                                                                     \
         ENTRY_IN(scene_analysis, member.centre),                                                  \
         .always = 1}

static const entry_field spin[] = {OMEGA(of.walk.frame), {.name = NULL}},
                         spin_followed[] = {OMEGA(of.continuation.frame), {.name = NULL}};

#define ABOUT(what)                                                                                \
    {"about",                                                                                      \
     ENTRY_NAME,                                                                                   \
     .summary = (what),                                                                            \
     .left_out = "undeformed",                                                                     \
     ENTRY_IN(scene_analysis, follows),                                                            \
     .of = SCENE_ANALYSES}

#define STEPS                                                                                      \
    {"steps",                                                                                      \
     ENTRY_WHOLE,                                                                                  \
     .summary = "initial number of load steps between two stations; the step size adapts",         \
     .usual = "1",                                                                                 \
     ENTRY_IN(scene_analysis, of.walk.steps_between),                                              \
     .least = 1,                                                                                   \
     .most = 1000000}

static const entry_field path[] = {
    {"stations", ENTRY_NUMBERS, .needed = 1, .summary = "path parameter, ascending",
     ENTRY_IN(scene_analysis, of.walk.path)},
    STEPS,
    {"spin", ENTRY_MAP, .below = spin, .summary = "the axes turn", .left_out = "they do not"},
    ACTING(all_loads),
    {.name = NULL}};

#define RAYLEIGH                                                                                   \
    {"mass",          ENTRY_NUMBER,                                                                \
     .unit = "1/s",   .summary = "times the mass matrix",                                          \
     .usual = "0",    ENTRY_IN(scene_analysis, damping.mass),                                      \
     .most = INFINITY},                                                                            \
    {                                                                                              \
        "stiffness", ENTRY_NUMBER, .unit = "s",                                                    \
            .summary = "times the stiffness of members and springs, without that of stresses",     \
            .usual = "0", ENTRY_IN(scene_analysis, damping.stiffness), .most = INFINITY            \
    }

static const entry_field proportional[] = {RAYLEIGH, {.name = NULL}};

static const entry_field of_modes[] = {
    RAYLEIGH,
    {"ratio", ENTRY_NUMBER, .unit = "1", .summary = "damping ratio of every mode", .usual = "0",
     ENTRY_IN(scene_analysis, damping.ratio), .most = INFINITY},
    {"ratios", ENTRY_NUMBERS, .unit = "1",
     .summary = "those of the first modes, lowest frequency first; of the others: ratio",
     .left_out = "none", ENTRY_IN(scene_analysis, damping.ratios)},
    {.name = NULL}};

#define PROPORTIONAL                                                                               \
    {"damping", ENTRY_MAP, .below = proportional,                                                  \
     .summary = "Rayleigh damping, beside that of members and springs", .left_out = "none"}

static const entry_field modes[] = {
    {"wanted", ENTRY_NUMBER, .summary = "how many", .left_out = "as quantities ask for"},
    {"damped", ENTRY_WORD, .words = "no|yes",
     .summary = "modes with the damping of members, springs and `damping`", .usual = "no",
     ENTRY_IN(scene_analysis, damped)},
    PROPORTIONAL,
    ABOUT("static analysis about whose last state"),
    {.name = NULL}};

static const entry_field buckling[] = {
    {"wanted", ENTRY_NUMBER, .summary = "how many", .left_out = "as quantities ask for"},
    ABOUT("static analysis about whose last state"),
    ACTING(all_loads),
    {.name = "sign", .kind = ENTRY_LATER},
    {.name = NULL}};

static const entry_field compliance[] = {
    {"node", ENTRY_NAME, .needed = 1, .summary = "where",
     ENTRY_IN(scene_analysis, of.compliance.node), .of = SCENE_NODES},
    {"moments", ENTRY_WORD, .words = SCENE_MOMENTS_CHOICES,
     .summary = "convention of a reaction's moment on a rotating node", .usual = "spatial",
     ENTRY_IN(scene_analysis, of.compliance.moments), .always = 1},
    {"released", ENTRY_WORDS, .words = ENTRY_COMPONENTS,
     .summary = "prescribed components that are free", .usual = "[]",
     ENTRY_IN(scene_analysis, of.compliance.released)},
    ABOUT("static analysis, continuation or rotation at whose stations"),
    {.name = NULL}};

static const entry_field control[] = {
    {"node", ENTRY_NAME, .needed = 1, .summary = "whose translation",
     ENTRY_IN(scene_analysis, of.continuation.control.node), .of = SCENE_NODES},
    {"component", ENTRY_WORD, .needed = 1, .words = "ux|uy|uz", .summary = "of these",
     ENTRY_IN(scene_analysis, of.continuation.control.component)},
    {.name = NULL}};

static const entry_field continuation[] = {
    {"control", ENTRY_MAP, .needed = 1, .below = control, .summary = "coordinate that grows"},
    {"by", ENTRY_WORD, .words = "coordinate|arc", .summary = "what steps are measured in",
     .usual = "coordinate", ENTRY_IN(scene_analysis, of.continuation.control.by_arc), .always = 1},
    {"to", ENTRY_NUMBERS, .needed = 1, .unit = "m", .summary = "of the coordinate, as met",
     ENTRY_IN(scene_analysis, of.continuation.path)},
    {"step", ENTRY_NUMBER, .needed = 1, .summary = "first step",
     ENTRY_IN(scene_analysis, of.continuation.control.step)},
    {"step_max", ENTRY_NUMBER, .summary = "largest step", .left_out = "the first"},
    {"constant", ENTRY_WORD, .words = "no|yes", .summary = "steps keep their size", .usual = "no",
     ENTRY_IN(scene_analysis, of.continuation.control.constant_steps)},
    {"spin", ENTRY_MAP, .below = spin_followed, .summary = "the axes turn",
     .left_out = "they do not"},
    ACTING(all_loads),
    {.name = NULL}};

static const entry_field rotation[] = {
    OMEGA(of.walk.frame),
    {"stations", ENTRY_NUMBERS, .needed = 1, .summary = "factors of omega, ascending",
     ENTRY_IN(scene_analysis, of.walk.path)},
    STEPS,
    {"wanted", ENTRY_WHOLE, .summary = "modes to look for at first, of all families", .usual = "0",
     ENTRY_IN(scene_analysis, of.walk.modes), .most = 1000},
    ACTING(all_loads),
    {.name = NULL}};

static const entry_field start[] = {
    {"velocity", ENTRY_VECTOR, .count = 3, .unit = "m/s", .summary = "of all nodes",
     .usual = "[0, 0, 0]", ENTRY_IN(scene_analysis, of.motion.start.velocity)},
    {"spin", ENTRY_VECTOR, .count = 3, .unit = "rad/s", .summary = "of the whole, about the centre",
     .usual = "[0, 0, 0]", ENTRY_IN(scene_analysis, of.motion.start.spin)},
    {"centre", ENTRY_VECTOR, .count = 3, .unit = "m", .summary = "a point of its axis",
     .usual = "[0, 0, 0]", ENTRY_IN(scene_analysis, of.motion.start.centre)},
    {.name = NULL}};

#define OF_MODES                                                                                   \
    "of modes, which motions do not use; at a frequency f mass: 4*pi*f*ratio has that ratio, or "  \
    "damping: ratio/(pi*f) of members"
static const entry_field of_masses[] = {
    {"mass", ENTRY_NUMBER, .needed = 1, .unit = "1/s",
     .summary = "force by momentum of all masses, in fixed axes; not by conserving",
     ENTRY_IN(scene_analysis, damping.mass), .most = INFINITY},
    {"stiffness", ENTRY_LATER,
     .summary = "not of a motion; give it as damping: b [s] of each member, and b times their "
                "stiffness as damping of springs"},
    {"ratio", ENTRY_LATER, .summary = OF_MODES},
    {"ratios", ENTRY_LATER, .summary = OF_MODES},
    {.name = NULL}};
#undef OF_MODES

static const entry_field in_time[] = {
    {"stations", ENTRY_NUMBERS, .needed = 1, .unit = "s",
     .summary = "instants at which quantities are read, ascending; it begins at 0",
     ENTRY_IN(scene_analysis, of.motion.path)},
    {"integrator", ENTRY_WORD, .words = SCENE_SCHEME_CHOICES, .summary = "method",
     .left_out = "alpha where there is one of its parameters, or a step without a tolerance; else "
                 "radau"},
    {"step", ENTRY_NUMBER, .unit = "s",
     .summary = "of the integration; with a tolerance the first one",
     .left_out = "1/1000 of the last station", ENTRY_IN(scene_analysis, of.motion.step),
     .always = 1},
    {"tolerance", ENTRY_NUMBER,
     .summary = "of the error of time, relative to the largest motion so far (at most the size of "
                "the structure): by alpha and conserving of all steps together, each has its share "
                "by its length, by radau of the estimate of one step, which is far above its "
                "error; 0: all steps are equal",
     .left_out = "0 where there is a step; else 1e-3, by radau 1e-5: 0.1 % of the motion",
     ENTRY_IN(scene_analysis, of.motion.tolerance)},
    {"rho", ENTRY_NUMBER, .group = 1,
     .summary = "of alpha, 0 to 1: what remains after a step of motions that are not resolved",
     .usual = "0.9"},
    {"hht", ENTRY_NUMBER, .group = 1,
     .summary = "of alpha: the method of Hilber, Hughes and Taylor, 0 to 1/3",
     .left_out = "as rho says"},
    {"trapezoidal", ENTRY_WORD, .group = 1, .words = "no|yes",
     .summary = "of alpha: the trapezoidal rule, which may blow up; for comparison", .usual = "no"},
    {"parameters", ENTRY_VECTOR, .group = 1, .count = 2, .summary = "of alpha: alpha_m, alpha_f",
     .left_out = "as rho says"},
    {"mass", ENTRY_WORD, .words = SCENE_MASS_CHOICES,
     .summary = "of members: lumped at the nodes, or consistent, by alpha and radau",
     .left_out = "consistent by alpha and radau, lumped by the others or as the scene says",
     ENTRY_IN(scene_analysis, of.motion.mass), .first = SCENE_LUMPED},
    ABOUT("static analysis, continuation or rotation from whose last state, or motion that "
          "continues, with its rates and its time"),
    {"damping", ENTRY_MAP, .below = of_masses,
     .summary = "mass-proportional damping; of stiffness: damping of members and springs",
     .left_out = "none"},
    {"start", ENTRY_MAP, .below = start, .summary = "velocities at the start",
     .left_out = "at rest, or as about has it"},
    ACTING(all_loads),
    {.name = NULL}};

static const entry_field harmonic[] = {
    {"frequencies", ENTRY_NUMBERS, .needed = 1, .unit = "Hz", .summary = "ascending",
     ENTRY_IN(scene_analysis, of.harmonic)},
    {"solution", ENTRY_WORD, .words = "direct|modal",
     .summary = "by factors at each frequency, or by the modes "
                "without damping, with an error bound",
     .usual = "direct", ENTRY_IN(scene_analysis, by_modes)},
    {"modes", ENTRY_WHOLE, .summary = "how many, of the modal solution and of ratios; 0: all",
     .usual = "0", ENTRY_IN(scene_analysis, modes), .most = 1000000},
    {"damping", ENTRY_MAP, .below = of_modes,
     .summary = "beside that of members and springs: Rayleigh "
                "damping, and ratios of modes",
     .left_out = "none"},
    ABOUT("static or linear analysis about whose last state"),
    {.name = NULL}};

const entry_field entry_analysis[] = {
    {"linear", ENTRY_MAP, .needed = 1, .group = 1, .below = linear, .summary = "loads at factor 1",
     ENTRY_IN(scene_analysis, kind), .first = SCENE_LINEAR},
    {"static", ENTRY_MAP, .needed = 1, .group = 1, .below = path, .summary = "along a path",
     ENTRY_IN(scene_analysis, kind), .first = SCENE_STATIC},
    {"buckling", ENTRY_MAP, .needed = 1, .group = 1, .below = buckling, .summary = "critical loads",
     ENTRY_IN(scene_analysis, kind), .first = SCENE_BUCKLING},
    {"modal", ENTRY_MAP, .needed = 1, .group = 1, .below = modes,
     .summary = "frequencies; driven components are held", ENTRY_IN(scene_analysis, kind),
     .first = SCENE_MODAL},
    {"compliance", ENTRY_MAP, .needed = 1, .group = 1, .below = compliance, .summary = "6 x 6",
     ENTRY_IN(scene_analysis, kind), .first = SCENE_COMPLIANCE},
    {"continuation", ENTRY_MAP, .needed = 1, .group = 1, .below = continuation,
     .summary = "path of a load factor", ENTRY_IN(scene_analysis, kind),
     .first = SCENE_CONTINUATION},
    {"rotation", ENTRY_MAP, .needed = 1, .group = 1, .below = rotation, .summary = "stationary",
     ENTRY_IN(scene_analysis, kind), .first = SCENE_ROTATION},
    {"motion", ENTRY_MAP, .needed = 1, .group = 1, .below = in_time,
     .summary = "in time: dynamics; needs masses", ENTRY_IN(scene_analysis, kind),
     .first = SCENE_MOTION},
    {"harmonic", ENTRY_MAP, .needed = 1, .group = 1, .below = harmonic,
     .summary = "steady small vibration by frequency: responses; needs masses",
     ENTRY_IN(scene_analysis, kind), .first = SCENE_HARMONIC},
    {.name = NULL}};
