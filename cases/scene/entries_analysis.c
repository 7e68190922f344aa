#include "cases/scene/scene.h"

#include <math.h>

#define ACTING(otherwise)                                                                          \
    {"case",                                                                                       \
     ENTRY_NAME,                                                                                   \
     .group = 3,                                                                                   \
     .summary = "load case that acts",                                                             \
     .left_out = (otherwise),                                                                      \
     ENTRY_IN(scene_analysis, acting.load_case),                                                   \
     .of = SCENE_CASES},                                                                           \
    {                                                                                              \
        "combination", ENTRY_NAME, .group = 3, .summary = "combination whose load cases act",      \
            .left_out = (otherwise), ENTRY_IN(scene_analysis, acting.combination),                 \
            .of = SCENE_COMBINATIONS                                                               \
    }
static const char all_loads[] = "all loads; required if the loads have cases";

static const entry_field linear[] = {
    ACTING("all loads; if the loads have cases, every case is solved and quantities select one"),
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
         .summary = "a point of the rotation axis",                                                \
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

/* Keys of analyses of small motions about an instant of a motion. */
#define INSTANT                                                                                    \
    {"time",                                                                                       \
     ENTRY_NUMBER,                                                                                 \
     .unit = "s",                                                                                  \
     .summary = "time during the motion that 'about' names",                                       \
     .left_out = "the end of the motion",                                                          \
     ENTRY_IN(scene_analysis, time),                                                               \
     .otherwise = NAN,                                                                             \
     .most = INFINITY},                                                                            \
        {"axes",                                                                                   \
         ENTRY_WORD,                                                                               \
         .group = 2,                                                                               \
         .words = "own|fixed",                                                                     \
         .summary =                                                                                \
             "axes of small motions about an instant of a motion. own: those of each node, which " \
             "rotate with the node; fixed: axes fixed in space",                                   \
         .usual = "own",                                                                           \
         ENTRY_IN(scene_analysis, axes)},                                                          \
    {                                                                                              \
        "axes_of", ENTRY_NAME, .group = 2,                                                         \
            .summary =                                                                             \
                "node with which the axes of all small motions about an instant of a motion "      \
                "rotate",                                                                          \
            .left_out = "as given by axes", ENTRY_IN(scene_analysis, axes_of), .of = SCENE_NODES   \
    }

#define STEPS                                                                                      \
    {"steps",                                                                                      \
     ENTRY_WHOLE,                                                                                  \
     .summary = "initial number of load steps between two stations; the step size adapts",         \
     .usual = "1",                                                                                 \
     ENTRY_IN(scene_analysis, of.walk.steps_between),                                              \
     .least = 1,                                                                                   \
     .most = 1000000}

static const entry_field path[] = {{"stations", ENTRY_NUMBERS, .needed = 1,
                                    .summary = "path parameter, ascending",
                                    ENTRY_IN(scene_analysis, of.walk.path)},
                                   STEPS,
                                   {"spin", ENTRY_MAP, .below = spin, .summary = "rotating axes",
                                    .left_out = "axes fixed in space"},
                                   ACTING(all_loads),
                                   {.name = NULL}};

#define RAYLEIGH                                                                                   \
    {"mass",          ENTRY_NUMBER,                                                                \
     .unit = "1/s",   .summary = "coefficient of the mass matrix",                                 \
     .usual = "0",    ENTRY_IN(scene_analysis, damping.mass),                                      \
     .most = INFINITY},                                                                            \
    {                                                                                              \
        "stiffness", ENTRY_NUMBER, .unit = "s",                                                    \
            .summary = "coefficient of the stiffness matrix of members and springs, without "      \
                       "geometric stiffness",                                                      \
            .usual = "0", ENTRY_IN(scene_analysis, damping.stiffness), .most = INFINITY            \
    }

static const entry_field proportional[] = {RAYLEIGH, {.name = NULL}};

static const entry_field of_modes[] = {
    RAYLEIGH,
    {"ratio", ENTRY_NUMBER, .unit = "1", .summary = "damping ratio of every mode", .usual = "0",
     ENTRY_IN(scene_analysis, damping.ratio), .most = INFINITY},
    {"ratios", ENTRY_NUMBERS, .unit = "1",
     .summary = "damping ratios of the first modes, lowest frequency first; 'ratio' applies to all "
                "other modes",
     .left_out = "none", ENTRY_IN(scene_analysis, damping.ratios)},
    {.name = NULL}};

#define PROPORTIONAL                                                                               \
    {"damping", ENTRY_MAP, .below = proportional,                                                  \
     .summary = "Rayleigh damping, in addition to the damping of members and springs",             \
     .left_out = "none"}

#define LOOPS                                                                                      \
    {"loops",                                                                                      \
     ENTRY_WORD,                                                                                   \
     .words = "closed|open",                                                                       \
     .summary = "open: loads with feedback do not act",                                            \
     .usual = "closed",                                                                            \
     ENTRY_IN(scene_analysis, open_loops)}

static const entry_field modes[] = {
    {"wanted", ENTRY_NUMBER, .summary = "number of modes",
     .left_out = "as required by the quantities"},
    {"damped", ENTRY_WORD, .words = "no|yes",
     .summary = "yes: the modes include the damping of members and springs and that of 'damping'",
     .usual = "no", ENTRY_IN(scene_analysis, damped)},
    LOOPS,
    PROPORTIONAL,
    ABOUT("static or linear analysis, whose last state is the base state; or motion, whose state "
          "at 'time' is the base state"),
    INSTANT,
    {.name = NULL}};

static const entry_field buckling[] = {{"wanted", ENTRY_NUMBER, .summary = "number of modes",
                                        .left_out = "as required by the quantities"},
                                       ABOUT("static analysis, whose last state is the base state"),
                                       ACTING(all_loads),
                                       {.name = "sign", .kind = ENTRY_LATER},
                                       {.name = NULL}};

static const entry_field compliance[] = {
    {"node", ENTRY_NAME, .needed = 1, .summary = "loaded node",
     ENTRY_IN(scene_analysis, of.compliance.node), .of = SCENE_NODES},
    {"moments", ENTRY_WORD, .words = SCENE_MOMENTS_CHOICES,
     .summary = "moment convention for reactions on a rotating node", .usual = "spatial",
     ENTRY_IN(scene_analysis, of.compliance.moments), .always = 1},
    {"released", ENTRY_WORDS, .words = ENTRY_COMPONENTS,
     .summary = "prescribed components that are free", .usual = "[]",
     ENTRY_IN(scene_analysis, of.compliance.released)},
    ABOUT("static analysis, continuation or rotation; the compliance is computed at its stations"),
    {.name = NULL}};

static const entry_field control[] = {
    {"node", ENTRY_NAME, .needed = 1, .summary = "node to which the coordinate belongs",
     ENTRY_IN(scene_analysis, of.continuation.control.node), .of = SCENE_NODES},
    {"component", ENTRY_WORD, .needed = 1, .words = "ux|uy|uz",
     .summary = "translation of the node",
     ENTRY_IN(scene_analysis, of.continuation.control.component)},
    {.name = NULL}};

static const entry_field continuation[] = {
    {"control", ENTRY_MAP, .needed = 1, .below = control,
     .summary = "coordinate that increases along the path"},
    {"by", ENTRY_WORD, .words = "coordinate|arc", .summary = "measure of the steps",
     .usual = "coordinate", ENTRY_IN(scene_analysis, of.continuation.control.by_arc), .always = 1},
    {"to", ENTRY_NUMBERS, .needed = 1, .unit = "m",
     .summary = "values of the coordinate, in the order of the path",
     ENTRY_IN(scene_analysis, of.continuation.path)},
    {"step", ENTRY_NUMBER, .needed = 1, .summary = "initial step",
     ENTRY_IN(scene_analysis, of.continuation.control.step)},
    {"step_max", ENTRY_NUMBER, .summary = "largest step", .left_out = "the initial step"},
    {"constant", ENTRY_WORD, .words = "no|yes", .summary = "constant step size", .usual = "no",
     ENTRY_IN(scene_analysis, of.continuation.control.constant_steps)},
    {"spin", ENTRY_MAP, .below = spin_followed, .summary = "rotating axes",
     .left_out = "axes fixed in space"},
    ACTING(all_loads),
    {.name = NULL}};

static const entry_field rotation[] = {
    OMEGA(of.walk.frame),
    {"stations", ENTRY_NUMBERS, .needed = 1, .summary = "factors of omega, ascending",
     ENTRY_IN(scene_analysis, of.walk.path)},
    STEPS,
    {"wanted", ENTRY_WHOLE,
     .summary = "number of modes that are computed first; more follow if quantities require them",
     .usual = "0", ENTRY_IN(scene_analysis, of.walk.modes), .most = 1000},
    ACTING(all_loads),
    {.name = NULL}};

static const entry_field start[] = {
    {"velocity", ENTRY_VECTOR, .count = 3, .unit = "m/s", .summary = "velocity of all nodes",
     .usual = "[0, 0, 0]", ENTRY_IN(scene_analysis, of.motion.start.velocity)},
    {"spin", ENTRY_VECTOR, .count = 3, .unit = "rad/s",
     .summary = "angular velocity of the structure about 'centre'", .usual = "[0, 0, 0]",
     ENTRY_IN(scene_analysis, of.motion.start.spin)},
    {"centre", ENTRY_VECTOR, .count = 3, .unit = "m", .summary = "a point of the rotation axis",
     .usual = "[0, 0, 0]", ENTRY_IN(scene_analysis, of.motion.start.centre)},
    {.name = NULL}};

#define OF_MODES                                                                                   \
    "only for modes, which motions do not use; at a frequency f, mass: 4*pi*f*ratio, or damping: " \
    "ratio/(pi*f) of members, gives the same damping ratio"
static const entry_field of_masses[] = {
    {"mass", ENTRY_NUMBER, .needed = 1, .unit = "1/s",
     .summary = "damping force divided by momentum, for all masses, along fixed axes; not "
                "supported by the integrator conserving",
     ENTRY_IN(scene_analysis, damping.mass), .most = INFINITY},
    {"stiffness", ENTRY_LATER,
     .summary = "not for motions; give each member damping: b [s], and each spring a damping of b "
                "times its stiffness"},
    {"ratio", ENTRY_LATER, .summary = OF_MODES},
    {"ratios", ENTRY_LATER, .summary = OF_MODES},
    {.name = NULL}};
#undef OF_MODES

static const entry_field in_time[] = {
    {"stations", ENTRY_NUMBERS, .needed = 1, .unit = "s",
     .summary = "output times, ascending; the motion starts at 0",
     ENTRY_IN(scene_analysis, of.motion.path)},
    {"integrator", ENTRY_WORD, .words = SCENE_SCHEME_CHOICES, .summary = "method",
     .left_out =
         "alpha if one of its parameters is given, or a step without a tolerance; otherwise radau"},
    {"step", ENTRY_NUMBER, .unit = "s",
     .summary = "time step; initial time step if a tolerance is given",
     .left_out = "1/1000 of the last station", ENTRY_IN(scene_analysis, of.motion.step),
     .always = 1},
    {"tolerance", ENTRY_NUMBER,
     .summary =
         "tolerance of the time-integration error, relative to the largest displacement so "
         "far (at most the size of the structure). alpha, conserving and explicit: for "
         "all steps together, distributed in proportion to their lengths; radau: for the error "
         "estimate of one step, which is far above the actual error. 0: equal steps",
     .left_out = "0 if a step is given; otherwise 1e-5 for radau, and 1e-3 (0.1 % of the "
                 "displacements) for the other integrators",
     ENTRY_IN(scene_analysis, of.motion.tolerance)},
    {"rho", ENTRY_NUMBER, .group = 1,
     .summary = "alpha: spectral radius at infinite frequency, 0 to 1", .usual = "0.9"},
    {"hht", ENTRY_NUMBER, .group = 1,
     .summary = "alpha: parameter of the method of Hilber, Hughes and Taylor, 0 to 1/3",
     .left_out = "as given by rho"},
    {"trapezoidal", ENTRY_WORD, .group = 1, .words = "no|yes",
     .summary = "alpha: use the trapezoidal rule, for comparison; the rule may become unstable",
     .usual = "no"},
    {"parameters", ENTRY_VECTOR, .group = 1, .count = 2, .summary = "alpha: alpha_m, alpha_f",
     .left_out = "as given by rho"},
    {"mass", ENTRY_WORD, .words = SCENE_MASS_CHOICES,
     .summary = "mass of members: lumped at the nodes, or consistent (alpha and radau only)",
     .left_out = "as given for the scene; otherwise consistent with alpha and radau, and lumped "
                 "with the other integrators",
     ENTRY_IN(scene_analysis, of.motion.mass), .first = SCENE_LUMPED},
    ABOUT("static analysis, continuation or rotation, whose last state is the initial state; or a "
          "motion, which is continued from its last state and time"),
    {"damping", ENTRY_MAP, .below = of_masses,
     .summary = "mass-proportional damping; for stiffness-proportional damping, use 'damping' of "
                "members and springs",
     .left_out = "none"},
    {"start", ENTRY_MAP, .below = start,
     .summary = "velocities at the start, added to those of a rotation in 'about'",
     .left_out = "at rest, or as given by 'about'"},
    ACTING(all_loads),
    {.name = NULL}};

static const entry_field harmonic[] = {
    {"frequencies", ENTRY_NUMBERS, .needed = 1, .unit = "Hz", .summary = "frequencies, ascending",
     ENTRY_IN(scene_analysis, of.harmonic)},
    {"solution", ENTRY_WORD, .words = "direct|modal",
     .summary = "direct: factorisation at each frequency; modal: superposition of undamped modes, "
                "with an error bound",
     .usual = "direct", ENTRY_IN(scene_analysis, by_modes)},
    {"modes", ENTRY_WHOLE,
     .summary = "number of modes for the modal solution and for damping ratios; 0: all",
     .usual = "0", ENTRY_IN(scene_analysis, modes), .most = 1000000},
    {"damping", ENTRY_MAP, .below = of_modes,
     .summary = "Rayleigh damping and modal damping ratios, in addition to the damping of members "
                "and springs",
     .left_out = "none"},
    LOOPS,
    ABOUT("static or linear analysis or rotation, whose last state is the base state; or motion, "
          "whose state at 'time' is the base state"),
    INSTANT,
    {.name = NULL}};

const entry_field entry_analysis[] = {
    {"linear", ENTRY_MAP, .needed = 1, .group = 1, .below = linear,
     .summary = "linear statics; loads have factor 1", ENTRY_IN(scene_analysis, kind),
     .first = SCENE_LINEAR},
    {"static", ENTRY_MAP, .needed = 1, .group = 1, .below = path,
     .summary = "nonlinear statics along a load path", ENTRY_IN(scene_analysis, kind),
     .first = SCENE_STATIC},
    {"buckling", ENTRY_MAP, .needed = 1, .group = 1, .below = buckling, .summary = "critical loads",
     ENTRY_IN(scene_analysis, kind), .first = SCENE_BUCKLING},
    {"modal", ENTRY_MAP, .needed = 1, .group = 1, .below = modes,
     .summary = "natural frequencies; driven components are fixed", ENTRY_IN(scene_analysis, kind),
     .first = SCENE_MODAL},
    {"compliance", ENTRY_MAP, .needed = 1, .group = 1, .below = compliance,
     .summary = "6 x 6 compliance matrix of a node", ENTRY_IN(scene_analysis, kind),
     .first = SCENE_COMPLIANCE},
    {"continuation", ENTRY_MAP, .needed = 1, .group = 1, .below = continuation,
     .summary = "equilibrium path over a load factor", ENTRY_IN(scene_analysis, kind),
     .first = SCENE_CONTINUATION},
    {"rotation", ENTRY_MAP, .needed = 1, .group = 1, .below = rotation,
     .summary = "steady rotation", ENTRY_IN(scene_analysis, kind), .first = SCENE_ROTATION},
    {"motion", ENTRY_MAP, .needed = 1, .group = 1, .below = in_time,
     .summary = "transient analysis; requires masses", ENTRY_IN(scene_analysis, kind),
     .first = SCENE_MOTION},
    {"harmonic", ENTRY_MAP, .needed = 1, .group = 1, .below = harmonic,
     .summary = "steady-state harmonic response over frequency; requires masses",
     ENTRY_IN(scene_analysis, kind), .first = SCENE_HARMONIC},
    {.name = NULL}};
