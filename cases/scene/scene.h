#ifndef BEAMWORK_CASES_SCENE_SCENE_H
#define BEAMWORK_CASES_SCENE_SCENE_H

#include <stddef.h>
#include <stdio.h>

#include "elements/feature.h"
#include "elements/section/section.h"
#include "elements/shared/status.h"

/* Analyses. */

typedef struct scene scene;

enum { SCENE_NONE = -1, SCENE_NAME = 48, SCENE_UNIT = 16 }; /* sizes include the terminating zero */

typedef enum scene_analysis_kind {
    SCENE_LINEAR,   /* one linear solution with all load factors equal to 1 */
    SCENE_STATIC,   /* nonlinear equilibrium along the path */
    SCENE_BUCKLING, /* linear buckling about the undeformed state or about the last state of a path.
                       About the undeformed state, the loads at path parameter 0 are constant. Their
                       increase from 0 to 1 is multiplied by the factor */
    SCENE_MODAL, /* natural frequencies about the undeformed state or the state of another analysis
                  */
    SCENE_COMPLIANCE,   /* tangent compliance of the undeformed structure or at every station of a
                           static path */
    SCENE_CONTINUATION, /* path of a load factor, with arc-length control or control of one
                           coordinate */
    SCENE_ROTATION,     /* steady rotation: equilibrium and frequencies in the rotating frame */
    SCENE_MOTION,       /* transient analysis: the path parameter is the time [s] */
    SCENE_HARMONIC /* steady small vibration about a state; the path parameter is the frequency [Hz]
                    */
} scene_analysis_kind;

typedef enum scene_moments {
    SCENE_MOMENTS_SPATIAL,
    SCENE_MOMENTS_SEMITANGENTIAL,
    SCENE_MOMENTS_SYMMETRISED
} scene_moments;
#define SCENE_MOMENTS_CHOICES "spatial|semitangential|symmetrised"
const char *scene_moments_name(scene_moments);

/* Output points (stations) in ascending order of the path parameter. For a continuation, the
 * stations are values of the control coordinate [m] in the order in which the path reaches them. */
typedef struct scene_path {
    int stations;
    double *value; /* [stations] */
} scene_path;

/* Rotation of the axes of the scene. In a rotation analysis, the angular velocity is multiplied by
 * the path parameter. In other analyses, it is constant. Zero: no rotation. */
typedef struct scene_rotating_frame {
    double omega[3];  /* angular velocity [rad/s] */
    double centre[3]; /* a point on the rotation axis [m] */
} scene_rotating_frame;

/* Steps of a static analysis or a rotation analysis. */
typedef struct scene_walk {
    scene_path path;
    int steps_between; /* initial number of load steps between two stations, at least 1 */
    int modes; /* for a rotation analysis: initial number of modes, of all families together  */
    scene_rotating_frame frame;
} scene_walk;

typedef struct scene_compliance {
    int node;
    scene_moments moments;
    unsigned released; /* bit i: the prescribed component i of the node is released, and its
                          reaction acts as a dead load */
} scene_compliance;

/* Control of a continuation, the path of proportional loads. The control coordinate is a
 * translation of a node. With arc-length control, it is only the abscissa of curves. The arc length
 * is dimensionless: its square is the mean over all movable nodes of the mesh, where each rigid
 * body counts as one node, of (displacement/size of the scene)^2 + rotation^2. */
typedef struct scene_control {
    int node, component;
    int by_arc; /* 1 if steps measure arc length, 0 if they measure the control coordinate */
    double step, step_max; /* first and largest step: [m], or dimensionless for arc length */
    int constant_steps; /* 1 if all steps equal `step`, and a jump to another branch ends the path;
                           0 if the step size adapts */
} scene_control;

typedef struct scene_continuation {
    scene_path path;
    scene_rotating_frame frame;
    scene_control control;
} scene_continuation;

/* Integrators of motions. */
typedef enum scene_scheme {
    SCENE_ALPHA,      /* generalized-alpha method of order 2, which damps unresolved frequencies */
    SCENE_CONSERVING, /* method of order 2 that conserves energy and momenta */
    SCENE_RADAU,      /* Radau IIA method with three stages, of order 5 */
    SCENE_EXPLICIT,   /* explicit Runge-Kutta method of order 8, for reference values */
    SCENE_SCHEMES
} scene_scheme;

#define SCENE_SCHEME_CHOICES "alpha|conserving|radau|explicit"

typedef enum scene_mass {
    SCENE_MASS_USUAL, /* consistent if all integrators of the chain of motions and the formulation
                         support it and the scene does not request lumped mass; otherwise lumped */
    SCENE_LUMPED,     /* lumped at the nodes, for all formulations */
    SCENE_CONSISTENT  /* consistent; formulations that do not support it are rejected */
} scene_mass;

#define SCENE_MASS_CHOICES "lumped|consistent"

typedef struct scene_alpha {
    double mass, force; /* alpha_m, alpha_f */
} scene_alpha;

/* Initial velocities of a rigid-body motion: the velocity of a point `centre` and the angular
 * velocity. */
typedef struct scene_start {
    double velocity[3], spin[3], centre[3]; /* [m/s], [rad/s], [m] */
} scene_start;

/* A motion starts from rest or with the velocities `start`, in the undeformed state or in the last
 * state of the path that it follows. If it continues another motion, it starts at the end of that
 * motion, with its rates. */
typedef struct scene_motion {
    scene_path path; /* times of output [s] */
    scene_scheme scheme;
    scene_alpha alpha;
    double step;      /* first step [s], or every step if `tolerance` is 0 */
    double tolerance; /* allowed error of the motion or, for radau, of a step, relative to the
                         largest displacement so far; 0 for constant steps */
    scene_start start;
    scene_mass mass;
} scene_motion;

/* Damping of small vibrations. The damping matrix is `mass` times the mass matrix plus `stiffness`
 * times the stiffness of members and springs, without geometric stiffness. Damping ratios of the
 * undamped modes may be added. */
typedef struct scene_proportional {
    double mass, stiffness; /* [1/s], [s] */
    double ratio;           /* damping ratio of all modes beyond `ratios` */
    scene_path ratios;      /* damping ratios of the first modes */
} scene_proportional;

/* The load case or combination whose loads are active. If both are SCENE_NONE, scene_acting_of
 * determines the active loads. */
typedef struct scene_acting {
    int load_case, combination;
} scene_acting;

typedef enum scene_turning {
    SCENE_TURNING_OWN, /* axes of each node, which rotate with the node */
    SCENE_TURNING_NONE /* axes fixed in space */
} scene_turning;

typedef struct scene_analysis {
    scene_analysis_kind kind;
    int follows; /* analysis that provides the states about which this analysis is made, or
                    SCENE_NONE for the undeformed state */
    double time; /* time [s] of the motion about which the analysis is made, or NAN for the end of
                    the motion */
    scene_turning axes; /* axes of the small motions about the instant */
    int axes_of;        /* node with which the axes rotate instead, or SCENE_NONE */
    scene_acting acting;
    union {
        scene_walk walk;
        scene_compliance compliance;
        scene_continuation continuation;
        scene_motion motion;
        scene_path harmonic; /* frequencies [Hz] */
    } of;
    scene_proportional
        damping; /* damping of small vibrations, in addition to that of members and dashpots */
    int damped;
    int open_loops;        /* 1 if the feedback of loads is omitted */
    int by_modes;          /* 1 if a harmonic analysis is solved by superposition of modes */
    int modes;             /* number of modes, or 0 for all modes */
    char name[SCENE_NAME]; /* "" for no name */
} scene_analysis;

int scene_add_linear(scene *s);
int scene_add_static(scene *s, int stations, const double path[], int steps_between);
/* Add a buckling or modal analysis. The quantities determine the number of eigenvalues. */
int scene_add_buckling(scene *s, int follows);
int scene_add_modal(scene *s, int follows);
int scene_add_compliance(scene *s, int follows, scene_compliance what);
int scene_add_harmonic(scene *s, int follows, int frequencies, const double hertz[]);
int scene_add_continuation(scene *s, int stations, const double path[], scene_control control);
int scene_add_rotation(scene *s, int stations, const double path[], int steps_between, int modes,
                       scene_rotating_frame frame);
int scene_add_motion(scene *s, int follows, int stations, const double path[], scene_motion how);
/* Returns alpha_m = (2 rho - 1)/(rho + 1) and alpha_f = rho/(rho + 1) (Chung & Hulbert 1993). */
scene_alpha scene_alpha_of_radius(double rho);
void scene_set_rotating_frame(scene *s, int analysis, scene_rotating_frame frame);

/* Returns the time [s] of the motion about which a modal or harmonic analysis is made, or NAN for
 * every other analysis. */
double scene_instant_of(const scene *, int analysis);
/* Returns the time [s] at which a motion starts: 0, or the end of the motion that it continues. */
double scene_motion_begin(const scene *, int analysis);

/* Returns the key of an analysis in a scene file, such as "linear" or "static". */
const char *scene_analysis_name(scene_analysis_kind);

const scene_walk *scene_walk_of(const scene_analysis *a);
const scene_compliance *scene_compliance_of(const scene_analysis *a);
const scene_continuation *scene_continuation_of(const scene_analysis *a);
const scene_motion *scene_motion_of(const scene_analysis *a);
int scene_has_ratios(const scene_analysis *a);
/* Returns 1 for a motion for which the scene requests consistent mass. */
int scene_spreads(const scene_analysis *a);
/* Returns 1 for a motion whose elements use consistent mass if they support it. */
int scene_may_spread(const scene *s, int analysis);
/* Returns the path, or NULL if the kind of analysis has no path. */
const scene_path *scene_path_of(const scene_analysis *a);
scene_path *scene_editable_path(scene_analysis *a);
/* Returns the static path, continuation or rotation from whose state a chain of motions starts.
 * Returns SCENE_NONE for the undeformed state. */
int scene_origin_of(const scene *s, int analysis);
const scene_rotating_frame *scene_rotating_frame_of(const scene_analysis *a);
int scene_rotates(const scene_analysis *a);

/* Expressions in text form, for numbers and functions of time. They contain + - * / ^, parentheses,
 * functions and constants (expression_word), names and, in functions of time, the time t [s].
 *
 * The operator ^ has the highest precedence and is right-associative (-2^2 = -4, 2^3^2 = 512).
 * Signs follow, then * and /, then + and -. Values are in SI units and angles in radians
 * (30*deg*t). Parts without t must be finite. The arguments of functions that have discontinuities,
 * or whose derivatives are not implemented, must not contain t. Functions of time with
 * discontinuities are given in pieces (scene_piece), so that steps can end at the
 * discontinuities. */

typedef struct expression_mistake {
    int at;                /* position of the character in the text, from 0 */
    char what[FAULT_TEXT]; /* message with the remedy, or "" if the error was already reported */
} expression_mistake;

/* Callback that sets *out to the value of the name at text[*at] and moves *at past the name.
 * Returns 1, or 0 after an error. */
typedef int expression_name(const void *names, const char *text, int *at, double *out,
                            expression_mistake *);

/* Returns the length of the name at the start of the text, or 0 if the text does not start with a
 * name. A name consists of letters, digits and underscores and does not start with a digit. */
size_t expression_name_length(const char *text);
/* Returns the name of function or constant number i, or NULL after the last. */
const char *expression_word(int i);
/* Returns 1 for the name of a function or of a constant. */
int expression_is_word(const char *name, size_t length);

/* Evaluates text[from .. end - 1] as a number. `find` is NULL if no names are allowed. Returns
 * REFUSED with the reason if the expression is invalid. */
status expression_value(const char *text, int from, int end, expression_name *find,
                        const void *names, double *out, expression_mistake *);
/* Sets the error and its position and returns REFUSED. `of` is a printf format. */
status expression_wrong(expression_mistake *, int at, const char *of, ...)
    __attribute__((format(printf, 3, 4)));

typedef struct formula formula;

/* Parses a function. Returns REFUSED if the text is invalid, or FAULT if out of memory. */
status formula_parse(const char *text, formula **out, expression_mistake *);
/* Like formula_parse, but writes the error to f, with the text and the position, which starts at
 * 1. */
status formula_read(const char *text, formula **out, fault *f);
void formula_free(formula *);
/* Computes the value and the first two derivatives with respect to t. Undefined values are not
 * finite. */
void formula_at(const formula *, double t, double out[3]);

/* A function of time in pieces, each of which is a formula. Between pieces, the function may be
 * discontinuous. No time step crosses the end of a piece. */

typedef struct scene_piece {
    double until; /* end of the piece [s]; the last piece has no end */
    char *text;
    formula *is; /* NULL if the text is invalid, which function_check reports */
} scene_piece;

typedef struct scene_function {
    int pieces;
    scene_piece *piece; /* pieces in ascending order [pieces] */
    double scale;       /* factor of the value; 0 means 1 */
} scene_function;

/* Appends a piece and copies the text, which may be invalid (function_check). Returns -1 if out of
 * memory. */
int function_add(scene_function *, double until, const char *text);
/* Copies the pieces and the scale of another function to `to`, which must be empty. Returns -1 if
 * out of memory. */
int function_copy(scene_function *to, const scene_function *from);
void function_free(scene_function *);
/* Returns REFUSED with the error in f if a text is invalid or the ends of the pieces do not ascend,
 * or FAULT if out of memory. */
status function_check(const scene_function *, fault *);
/* Computes the value and the first two derivatives at t. At the boundary of two pieces, the values
 * are those of the second piece. */
void function_at(const scene_function *, double t, double out[3]);
/* Returns 1 if the function and this number of its derivatives (0 to 2) are finite from 0 to `end`.
 * Otherwise returns 0 and sets *time to a time at which a value is not finite. The values are
 * checked at both ends of every piece up to `end`, and at 63 times inside the piece. */
int function_finite(const scene_function *, double end, int derivatives, double *time);
/* Returns 1 if the value and its first derivative are continuous at every boundary of pieces
 * between 0 and `end`, to within 1e-9. Otherwise returns 0 and sets *time to the discontinuity, and
 * *derivative to 0 for the value or 1 for the derivative. */
int function_smooth(const scene_function *, double end, double *time, int *derivative);

/* Quantities of an analysis. For each kind, a function below returns its data; it aborts if the
 * quantity is of another kind. */

typedef enum scene_quantity_kind {
    SCENE_COORDINATE,       /* displacement component or rotation-vector component of a node */
    SCENE_REACTION,         /* reaction of a fixed or prescribed component of a node */
    SCENE_COMPLIANCE_ENTRY, /* entry of the 6 x 6 compliance matrix of the node of the analysis */
    SCENE_STIFFNESS_ENTRY,  /* reciprocal of the compliance entry (i, i); fixed coordinates remain
                               fixed */
    SCENE_CRITICAL_FACTOR,  /* load factor of linear buckling */
    SCENE_GROWTH,         /* largest growth rate of all modes [1/s], or 0 if the state is stable */
    SCENE_FREQUENCY,      /* [Hz] */
    SCENE_FACTOR_AT,      /* load factor of a continuation at a value of the control coordinate */
    SCENE_CRITICAL_POINT, /* critical point of a continuation */
    SCENE_DRIVER_VALUE,   /* value of an unknown driver */
    SCENE_INTERNAL,       /* resultant of the stresses on a cross-section of a member */
    SCENE_STRESS,         /* largest stress in a cross-section or in a member */
    SCENE_RATE,           /* velocity of a node, angular velocity in the axes of the node, or a time
                             derivative of either */
    SCENE_BALANCE,        /* energy or momentum of a motion */
    SCENE_RELATIVE,       /* displacement or rotation of a node in the axes of another node */
    SCENE_RESPONSE,       /* response in a harmonic analysis */
    SCENE_DAMPING_RATIO,  /* damping ratio of a damped mode, or its decay rate */
    SCENE_DEFLECTION,     /* displacement or rotation of a cross-section of a member */
    SCENE_ENVELOPE_OF,    /* largest or smallest of other quantities */
    SCENE_READING         /* value that depends only on nodes; the quantity type computes it */
} scene_quantity_kind;

typedef enum scene_critical { SCENE_LIMIT_POINT, SCENE_BIFURCATION } scene_critical;

typedef enum scene_family {
    SCENE_ANY,
    SCENE_NOT_AXIAL,
    SCENE_AXIAL,
    SCENE_BENDING_Y,
    SCENE_BENDING_Z,
    SCENE_TORSION
} scene_family;

typedef enum scene_reduction {
    SCENE_LAST,
    SCENE_MAX,
    SCENE_MIN,
    SCENE_AT,
    SCENE_CURVE,
    SCENE_MAX_TIME,   /* time of the largest value [s] */
    SCENE_MIN_TIME,   /* time of the smallest value [s] */
    SCENE_CROSSING,   /* time at which a level is crossed [s] */
    SCENE_PERIOD,     /* mean time between crossings in the same direction [s] */
    SCENE_PER_SECOND, /* reciprocal of the period [Hz] */
    SCENE_MEAN,       /* mean over time */
    SCENE_RMS,        /* root of the time mean of the square */
    SCENE_REDUCTIONS
} scene_reduction;

/* Returns 1 if the result is a time or a frequency, and 0 if it is a value of the quantity.
 * SCENE_MAX and SCENE_MIN refer to reported values, but SCENE_MAX_TIME and SCENE_MIN_TIME to
 * extracted values. */
static inline int scene_is_timed(scene_reduction how)
{
    return how > SCENE_CURVE && how < SCENE_MEAN;
}

/* Returns 1 for the largest or smallest value or its time. */
static inline int scene_is_extreme(scene_reduction how)
{
    return how == SCENE_MAX || how == SCENE_MIN || how == SCENE_MAX_TIME || how == SCENE_MIN_TIME;
}

typedef enum scene_direction { SCENE_RISING, SCENE_FALLING, SCENE_EITHER } scene_direction;
#define SCENE_DIRECTION_CHOICES "rising|falling|either"
/* The last two words also select curves. */
#define SCENE_TAKE_CHOICES                                                                         \
    "last|max|min|curve|max_time|min_time|crossing|period|per_second|mean|rms|spectrum|psd"

/* Transform of a curve of a motion over time to a curve over frequency. The values x[0 .. N] are at
 * stations with equal spacing d. x[N] starts the next period and is not used. X[k] = sum w[n] x[n]
 * exp(-2 pi i k n/N) at the frequency k/(N d). */
typedef enum scene_transform {
    SCENE_HISTORY,
    SCENE_SPECTRUM, /* amplitudes 2 |X|/sum w; half of it at the frequencies 0 and 1/(2 d)  */
    SCENE_PSD /* one-sided power spectral density 2 d |X|^2/sum w^2 [per Hz]; half of it at the
                 frequencies 0 and 1/(2 d) */
} scene_transform;
/* The weights w are 1 or sin^2(pi n/N). */
typedef enum scene_taper { SCENE_TAPER_NONE, SCENE_TAPER_HANN } scene_taper;
#define SCENE_TAPER_CHOICES "none|hann"

typedef struct scene_passing {
    double level; /* level of the extracted value, in SI units */
    scene_direction direction;
    int order;          /* index among the crossings in this direction, from 0 */
    double from, until; /* time window [s], where `until` is 0 for the end of the motion */
    scene_taper taper;  /* window function of a spectrum */
} scene_passing;

/* First, second or third time derivative. */
typedef enum scene_rate_of { SCENE_SPEED, SCENE_SPEEDING, SCENE_JERK } scene_rate_of;
#define SCENE_RATE_CHOICES "velocity|acceleration|jerk"

typedef struct scene_component {
    int node, component; /* SCENE_UX .. SCENE_RZ */
} scene_component;
typedef struct scene_rated {
    scene_component at;
    scene_rate_of rate;
} scene_rated;

/* Resultants: forces and moments that the part of a member towards end q exerts on the part towards
 * p, in the principal axes of the rotated cross-section, with moments about the centroid. The
 * torque about the shear centre, Mx - (ys Qz - zs Qy), has three parts: Saint-Venant torsion,
 * restrained warping, and the contribution of the stresses in twisted fibres. The torque due to
 * restrained warping is the rate at which the bimoment decreases along the member. */
typedef enum scene_resultant {
    SCENE_N,
    SCENE_QY,
    SCENE_QZ,
    SCENE_MX,
    SCENE_MY,
    SCENE_MZ,
    SCENE_BIMOMENT,
    SCENE_MX_SAINT_VENANT,
    SCENE_MX_WARPING,
    SCENE_MX_WAGNER,
    SCENE_RESULTANTS
} scene_resultant;

typedef enum scene_along {
    SCENE_ALONG_PLACE,  /* at a position */
    SCENE_ALONG_MAX,    /* at the cross-section with the largest value */
    SCENE_ALONG_MIN,    /* at the cross-section with the smallest value */
    SCENE_ALONG_LARGEST /* largest magnitude over all cross-sections */
} scene_along;

typedef struct scene_internal {
    int member;
    scene_resultant resultant;
    scene_along along;
    double place; /* for SCENE_ALONG_PLACE: position as a fraction of the initial length, 0 at p to
                     1 at q */
    int before;   /* side at a discontinuity: 1 on the side of p, 0 on that of q */
} scene_internal;

/* Displacement of the centroid or rotation of the cross-section, in global axes. */
typedef struct scene_deflection {
    int member, component;
    double place; /* position as a fraction of the initial length, 0 at p to 1 at q */
} scene_deflection;

typedef enum scene_stress_measure {
    SCENE_VON_MISES,
    SCENE_NORMAL_MAX, /* stress along the fibres; tension is positive */
    SCENE_NORMAL_MIN
} scene_stress_measure;

typedef struct scene_stress {
    int member;
    scene_stress_measure measure;
    int whole;
    double place; /* for a single cross-section: its position as a fraction of the initial length, 0
                     at p to 1 at q */
    int before;   /* side at a discontinuity: 1 on the side of p, 0 on that of q */
} scene_stress;

typedef enum scene_balance {
    SCENE_KINETIC,    /* [J] */
    SCENE_STRAIN,     /* energy stored in members and springs [J] */
    SCENE_ENERGY,     /* sum of both energies [J] */
    SCENE_WORK,       /* work of loads and prescribed coordinates since t = 0 */
    SCENE_DISSIPATED, /* energy dissipated by damping since t = 0 */
    SCENE_DRIFT,      /* energy-balance error: energy + dissipated energy - initial energy - work */
    SCENE_PX,         /* momentum [kg m/s] */
    SCENE_PY,
    SCENE_PZ,
    SCENE_LX, /* angular momentum about the origin [kg m^2/s] */
    SCENE_LY,
    SCENE_LZ,
    SCENE_BALANCES
} scene_balance;
#define SCENE_BALANCE_CHOICES "kinetic|strain|energy|work|dissipated|drift|px|py|pz|lx|ly|lz"

/* Motion of a node relative to the node `from`: the change of its position in the axes of `from`,
 * or its relative rotation. */
typedef struct scene_relative {
    int node, component, from;
} scene_relative;

typedef struct scene_reading {
    int node[4], component[4];
    double number[4];
} scene_reading;

/* Steady vibration of a node due to a harmonic force or a harmonic motion of a driver, with
 * amplitude 1. */
typedef enum scene_vibration {
    SCENE_DISPLACED,
    SCENE_VELOCITY,
    SCENE_ACCELERATION,
    SCENE_REACTING /* reaction force or moment of the driver that prescribes the component */
} scene_vibration;
typedef enum scene_vibration_part {
    SCENE_AMPLITUDE,
    SCENE_PHASE, /* phase lead relative to the input [rad], -pi to pi */
    SCENE_REAL,
    SCENE_IMAGINARY
} scene_vibration_part;
#define SCENE_VIBRATION_CHOICES "displacement|velocity|acceleration|reaction"
#define SCENE_VIBRATION_PARTS   "amplitude|phase|real|imaginary"
typedef struct scene_response {
    int node, component;
    int from; /* node whose response is subtracted, or SCENE_NONE */
    /* node and component of the exciting force or moment, if this is the input */
    int forced, forced_along;
    int driver;    /* driver that moves, if this is the input */
    int reference; /* load with feedback whose reference value is the input */
    /* node of the unbalance that is the input, and component SCENE_RX .. SCENE_RZ of its
     * rotation */
    int unbalanced, spinning;
    scene_vibration of;
    scene_vibration_part part;
} scene_response;

typedef struct scene_entry {
    int row, column; /* component of the response and component of the load, SCENE_UX .. SCENE_RZ */
} scene_entry;

typedef struct scene_critical_load {
    int sign;  /* 1 for positive factors, -1 for negative factors */
    int order; /* index among the factors of this sign in order of magnitude, from 0 */
} scene_critical_load;

typedef struct scene_mode {
    int order; /* index among the modes with this family and number of half-waves, from 0 */
    scene_family family;
    int half_waves;
    int decay; /* for SCENE_DAMPING_RATIO: 1 if the decay rate [1/s] is extracted instead */
} scene_mode;

typedef enum scene_ordinate { SCENE_LOAD_FACTOR, SCENE_CONTROL } scene_ordinate;

typedef struct scene_point {
    scene_critical kind;
    int order;               /* index among the points of this kind along the path, from 0 */
    scene_ordinate ordinate; /* which value is extracted: load factor or control coordinate [m] */
} scene_point;

/* The value that a quantity extracts. The functions below return it. */
typedef struct scene_extract {
    scene_quantity_kind kind;
    const struct quantity_type *type; /* quantity type (cases/quantities) */
    union {
        scene_component component; /* component of a coordinate, reaction or rate */
        scene_rated rated;
        scene_entry entry; /* for compliance and stiffness */
        scene_critical_load load;
        scene_mode mode;
        scene_point point;
        int driver;
        scene_internal internal;
        scene_stress stress;
        scene_deflection deflection;
        scene_balance balance;
        scene_relative relative;
        scene_response response;
        scene_reading reading;
        int envelope;
    } of;
} scene_extract;

scene_extract scene_coordinate(int node, int component);
scene_extract scene_reaction(int node, int component);
scene_extract scene_compliance_entry(int row, int column);
scene_extract scene_stiffness_entry(int component);
scene_extract scene_critical_factor(int sign, int order);
scene_extract scene_growth(void);
/* scene_frequency does not restrict the number of half-waves. */
scene_extract scene_frequency(int order, scene_family family);
scene_extract scene_factor_at(void);
scene_extract scene_critical_point(scene_critical kind, int order, scene_ordinate ordinate);
scene_extract scene_driver_value(int driver);
scene_extract scene_rate(int node, int component);
/* Extracts an entry of the rotation matrix; row and column are 0 .. 2. */
scene_extract scene_orientation_entry(int node, int row, int column);
scene_extract scene_balance_of(scene_balance what);
scene_extract scene_relative_to(int node, int component, int from);
scene_extract scene_response_to(scene_response what);
/* Returns the axis (0 to 2) along which an unbalance acts at the start (k 0), or a quarter of a
 * revolution later (k 1). */
int scene_unbalance_along(const scene_response *r, int k);
/* Extracts a resultant at `place`, from 0 at p to 1 at q. At a discontinuity, the value is on the
 * side of q. */
scene_extract scene_internal_at(int member, double place, scene_resultant resultant);
scene_extract scene_internal_along(int member, scene_along along, scene_resultant resultant);
/* Extracts the largest value of a stress measure over the cross-sections of a member; for
 * SCENE_NORMAL_MIN, the smallest. */
scene_extract scene_stress_along(int member, scene_stress_measure measure);
scene_extract scene_stress_at(int member, double place, scene_stress_measure measure);
/* Returns `what`, a resultant or a stress at a position, with this side of a discontinuity: 1 for
 * the side of p, 0 for that of q. */
scene_extract scene_beside(scene_extract what, int before);
/* Words of scene files. */
#define SCENE_STRESS_CHOICES    "von_mises|normal_max|normal_min"
#define SCENE_RESULTANT_CHOICES "N|Qy|Qz|Mx|My|Mz|bimoment|Mx_saint_venant|Mx_warping|Mx_wagner"

/* Abscissa of a curve. */
typedef struct scene_abscissa {
    char name[SCENE_NAME], unit[SCENE_UNIT];
    /* 1 if the abscissa is the curve of another quantity at the same stations, in the unit of that
     * quantity; 0 if it is `factor` times the path parameter or control coordinate, plus
     * `offset` */
    int is_quantity;
    double factor, offset; /* used if is_quantity is 0 */
} scene_abscissa;

/* Analytic estimate, which is shown next to the result and has no verdict. */
typedef struct scene_prediction {
    double value;       /* [unit of the quantity] */
    const char *source; /* NULL without a prediction */
} scene_prediction;

typedef enum scene_envelope {
    SCENE_ENVELOPE_NONE,
    SCENE_ENVELOPE_MAX,
    SCENE_ENVELOPE_MIN,
    SCENE_ENVELOPE_LARGEST /* the value with the largest magnitude, including its sign */
} scene_envelope;
#define SCENE_ENVELOPE_CHOICES "max|min|largest"

typedef struct scene_quantity {
    char name[SCENE_NAME], unit[SCENE_UNIT];
    int analysis;
    scene_acting acting; /* the load case or combination of the value, if a linear analysis solves
                            all of them */
    scene_envelope envelope;
    int overs;
    int *over; /* [overs] combinations of the envelope. overs 0: all combinations, or all load cases
                  if there are no combinations. For SCENE_ENVELOPE_OF: the quantities of the
                  envelope */
    scene_extract what;
    scene_reduction reduction;
    scene_transform transform;
    double at; /* path parameter or control coordinate, for SCENE_AT */
    scene_passing passing;
    scene_abscissa x;      /* abscissa of a curve */
    double factor, offset; /* reported value = factor * extracted value + offset */
    double near_zero;      /* reference magnitude of relative errors for values near zero, or 0 */
    double tolerance;      /* relative tolerance of the limit, SCENE_TOLERANCE by default */
    double least_order;    /* smallest expected order of convergence with the number of elements */
    scene_prediction prediction;
} scene_quantity;

/* Adds a quantity and returns it, never NULL. It is the value at the last station, with the factor
 * 1 and the tolerance SCENE_TOLERANCE. All other members are 0. */
scene_quantity *scene_add_quantity(scene *s, const char *name, const char *unit, int analysis,
                                   scene_extract what);
/* Makes the quantity a curve. Its abscissa is factor times the path parameter or control
 * coordinate, plus offset. */
void scene_set_curve(scene_quantity *q, const char *x_name, const char *x_unit, double factor,
                     double offset);
/* Makes the quantity a curve whose abscissa is the curve of another quantity at the same
 * stations. */
void scene_set_curve_over(scene_quantity *q, const char *quantity, const char *unit);
/* Returns the index of the quantity that is the abscissa of a curve, or SCENE_NONE if the abscissa
 * is the path. */
int scene_abscissa_of(const scene *s, const scene_quantity *q);
/* Sets the quantity to its value at one path parameter or control coordinate. */
void scene_set_at(scene_quantity *q, double at);
void scene_set_passing(scene_quantity *q, scene_reduction, scene_passing);
/* Sets *first to the index of the first station of a spectrum and *count to the number of its
 * stations. Only stations in the time window of the quantity count. Returns REFUSED if there are
 * fewer than three, or if they are not evenly spaced. */
status scene_spectrum_stations(const scene *, const scene_quantity *, int *first, int *count,
                               fault *);
/* Returns 1 if the quantity is evaluated between the stations of a motion. */
int scene_is_passed(const scene_quantity *q, scene_analysis_kind);
/* For an extreme: returns -1 if the smallest extracted value is reported, and 1 if the largest is.
 * A negative factor exchanges the two, except for the time of an extreme. */
int scene_extreme_sign(const scene_quantity *q);

const scene_component *scene_component_of(const scene_quantity *q);
const scene_entry *scene_entry_of(const scene_quantity *q);
const scene_critical_load *scene_critical_load_of(const scene_quantity *q);
const scene_mode *scene_mode_of(const scene_quantity *q);
const scene_point *scene_point_of(const scene_quantity *q);
int scene_driver_of(const scene_quantity *q);
const scene_relative *scene_relative_of(const scene_quantity *q);
const scene_internal *scene_internal_of(const scene_quantity *q);
const scene_stress *scene_stress_of(const scene_quantity *q);
/* Returns 1 if the quantity is of this kind and of this analysis. */
int scene_requests(const scene_quantity *q, int analysis, scene_quantity_kind kind);
/* Returns 1 if the quantity needs reactions, resultants, stresses or deflections. */
int scene_reads_forces(const scene_quantity *q);
/* Returns 1 if the analysis is used by a quantity, an imperfection or another analysis that is
 * used. Without quantities, all analyses are used. */
int scene_reads(const scene *s, int analysis);
void scene_keep_quantities(scene *s, const scene *of);
/* Returns the unit of the displacement or rotation per force or moment. Both arguments are SCENE_UX
 * to SCENE_RZ. */
const char *scene_compliance_unit(int row, int column);
/* Returns 1 if the quantity can be extracted from an analysis of this kind. */
int scene_gives(scene_analysis_kind analysis, const scene_quantity *q);

/* A scene: a structure, its supports and prescribed motions, its analyses and the requested
 * quantities. The functions of this header use no solver and no formulation.
 *
 * Every scene_* function that adds an entry returns the index of the entry in its list, or -1 if
 * out of memory (scene_validate reports this once, at the end). Only scene_add_quantity returns the
 * entry. */

enum { SCENE_MESHES = 24 };

/* Components of a node: three translations and three rotations about global axes. */
enum { SCENE_UX, SCENE_UY, SCENE_UZ, SCENE_RX, SCENE_RY, SCENE_RZ };

/* Warping coordinate at an end of a member. Ends with the same value >= 0 share one coordinate. */
enum { SCENE_WARP_FREE = -1, SCENE_WARP_FIXED = -2 };

/* Motion of one coordinate. A value >= 0 is the index of a driver. */
enum { SCENE_FREE = -1, SCENE_HELD = -2 };

typedef enum scene_plane {
    SCENE_SPACE,
    SCENE_PLANE_YZ,
    SCENE_PLANE_XZ,
    SCENE_PLANE_XY
} scene_plane;
#define SCENE_PLANE_CHOICES "yz|xz|xy"

typedef enum scene_rotation {
    SCENE_ROTATION_SPATIAL,  /* three increments about global axes, each free or fixed (all fixed:
                                clamped) */
    SCENE_ROTATION_SEQUENCE, /* R = exp(axis_1 t_1) exp(axis_2 t_2) exp(axis_3 t_3), each angle
                                free, fixed or prescribed */
    SCENE_ROTATION_VECTOR,   /* rotation vector prescribed by three drivers */
    SCENE_ROTATION_FORK /* no rotation about the axis of the cross-section, the other two rotations
                           free: see scene_fork */
} scene_rotation;

typedef struct scene_body {
    double mass;       /* [kg] */
    double centre[3];  /* centre of mass relative to the node in the undeformed state [m] */
    double inertia[6]; /* inertia tensor of the undeformed body about its centre of mass, for axes
                          along x, y, z: Ixx, Iyy, Izz = int (y^2 + z^2) dm ..., and Ixy, Iyz, Izx =
                          -int x y dm ... [kg m^2] */
} scene_body;

typedef struct scene_node {
    double position[3]; /* [m] */
    int attached; /* node to which this node is rigidly attached, or SCENE_NONE; the nodes that are
                     attached to each other form a rigid body */
    int translation[3]; /* SCENE_FREE, SCENE_HELD or a driver for each translation */
    scene_rotation rotation;
    int angle[3];      /* motion of the spatial components, the angles or the vector: SCENE_FREE,
                          SCENE_HELD or a driver */
    double axis[3][3]; /* rotation axes of the sequence, which ends at a zero axis; for a fork, the
                          axis of the cross-section and the direction of the web */
    double axes[2][3]; /* directions x and y of the translations, of any length; zero for the axes
                          of the scene */
    scene_body body;
    char name[SCENE_NAME]; /* "" for no name, as for every entry */
} scene_node;

/* Released components of a member end, which the end does not transmit to its node. Rotations are
 * in the order of their axes. The components are in the axes of the member at this end (y as in
 * scene_member). With the position r and the rotation R of the node and the offset o of the end,
 * the end is at r + R o + R_end s, where R_end = R exp(a_1 t_1) exp(a_2 t_2) rotates by the angles
 * t about the axes a, and s are the released translations. Three rotations are a ball joint. */
enum { SCENE_RELEASED = 5 };
typedef struct scene_release {
    int count; /* number of released components, or 0 if the end is rigidly joined */
    int component[SCENE_RELEASED]; /* SCENE_UX .. SCENE_RZ, each at most once */
} scene_release;

/* Members of the struct that are also keys of scene files are defined in keys_member.h. */
#define KEY(type, name, dimensions, ...) type name dimensions;
#define ROW(...)
typedef struct scene_member {
#include "cases/scene/keys_member.h"
    int section, section_q; /* sections at p and at q. The section constants change linearly between
                               them (elements/section/section.h), and each element has the section
                               at its middle */
    int warp_p, warp_q; /* SCENE_WARP_FREE, SCENE_WARP_FIXED or the number of a shared coordinate */
    double bow[2];  /* amplitudes of the stress-free initial shape bow sin(half_waves pi s/length)
                       along y and z, relative to the straight line [m] */
    int half_waves; /* >= 1 */
    scene_release release[2]; /* at p, q */
    double offset[2]
                 [3]; /* vectors from the nodes p, q to the ends of the member, which move rigidly
                         with the nodes, in global axes of the undeformed structure [m] */
    double
        foundation[6]; /* stiffness per length of springs between the ground and the cross-sections,
                          along and about the initial axes of the member [N/m^2, N] */
    char name[SCENE_NAME];
} scene_member;

/* A force as a function of a displacement, or a moment as a function of a rotation. The function is
 * linear between points and extrapolated linearly beyond both ends. */
typedef struct scene_table {
    scene_path at, value; /* displacements or rotations in ascending order [m, rad], and forces or
                             moments [N, N m], which do not decrease and are zero at zero */
} scene_table;

/* Spring between two nodes, or between a node and the ground, with the energy 1/2 d^T K d. d is the
 * motion of q relative to p since the undeformed state: displacement [m] and rotation vector [rad],
 * less than 3 rad. Its axes rotate with p and are initially the global axes. */
typedef struct scene_spring {
    int p, q;             /* nodes, where p is SCENE_NONE for the ground */
    double stiffness[36]; /* K, row-major [N/m, N, N m]. An unsymmetric K has no energy; its forces
                             are K d */
    double damping[36];   /* damping matrix: forces per rate of d [N s/m, N s, N m s] */
    double asymmetry; /* asymmetry of the given K relative to its diagonal if it is only rounding,
                         so that the symmetric part is used; otherwise 0 */
    double damping_asymmetry; /* asymmetry of the given damping matrix, as for K */
    scene_table table[6];     /* tables of the components of d, which act in addition to K */
    char name[SCENE_NAME];
} scene_spring;

/* Equal components of nodes, or components in a fixed ratio. The components of each node after the
 * first are `ratio` times those of the first, along the axes of the nodes. */
typedef struct scene_constraint {
    int nodes, *node;    /* [nodes] */
    unsigned components; /* bits 1 << SCENE_UX .. SCENE_RZ */
    double ratio;
    int master, normal; /* of a diaphragm: leading node, and normal axis 0 .. 2 */
    char name[SCENE_NAME];
} scene_constraint;

/* A part of the stress-free initial shape of the structure: a mode of the perfect structure, or
 * shifts of nodes. */
typedef struct scene_imperfection {
    int analysis,
        order; /* buckling or modal analysis, or SCENE_NONE for shifts, and index of its mode */
    double amplitude;    /* for a mode: largest displacement of a point of a member [m] */
    double direction[3]; /* direction of the largest displacement, which determines the sign of the
                            mode; zero: not given */
    int nodes, *node;    /* [nodes] */
    double (*shift)[3];  /* [nodes] [m] */
    double factor;       /* factor of the shifts */
    char name[SCENE_NAME];
} scene_imperfection;

/* A scalar that prescribes coordinates. The scalar is piecewise linear in the path parameter
 * between its stations. */
typedef struct scene_driver {
    char name[SCENE_NAME];
    int stations;
    double *path, *value;    /* path parameters of the stations, and values [m or rad]; NULL if the
                                driver is unknown */
    scene_function function; /* function of time, given instead of the stations; no pieces if
                                stations are given */
    /* for an unknown driver: the coordinate whose value is given */
    int condition_node, condition_component;
    /* for an unknown driver: the driver that gives this value; SCENE_NONE for a known driver */
    int condition_driver;
    int load_case; /* load case of the driver, or SCENE_NONE if the driver moves in all load cases
                    */
} scene_driver;

/* Returns 0 if the driver prescribes a translation of a node, otherwise 1. */
int scene_driver_turns(const scene *, int driver);

typedef enum scene_load_kind {
    SCENE_FORCE,              /* force at a node [N] */
    SCENE_MOMENT,             /* moment at a node [N m] */
    SCENE_DISTRIBUTED,        /* force per initial length along a member [N/m] */
    SCENE_DISTRIBUTED_MOMENT, /* moment per initial length along a member [N m/m] */
    SCENE_GRAVITY,            /* acceleration of the mass of a member [m/s^2] */
    SCENE_WEIGHT, /* acceleration of the mass of the body of a node, at its centre of mass [m/s^2]
                   */
    SCENE_MEMBER_FORCE,  /* force at a position inside a member [N] */
    SCENE_MEMBER_MOMENT, /* moment at a position inside a member [N m] */
    SCENE_TEMPERATURE    /* temperature change of a member, which expands [K] */
} scene_load_kind;

typedef enum scene_load_axes { SCENE_AXES_FIXED, SCENE_AXES_MEMBER } scene_load_axes;

/* Feedback: a load at a node that depends on a measured component. The factor of the load is
 * proportional e + derivative e' + integral (int e dt), limited to the magnitude `limit`. The error
 * e is the reference, which is the function of time of the load or 0, minus the measured
 * component. */
typedef struct scene_feedback {
    int node, component; /* node and measured component, or SCENE_NONE without feedback */
    int from;            /* node whose component is subtracted, or SCENE_NONE */
    double proportional, derivative,
        integral; /* [1/m, s/m, 1/(m s)], or with rad instead of m for a rotation */
    double limit; /* 0 for no limit */
} scene_feedback;

#define KEY(type, name, dimensions, ...) type name dimensions;
#define ROW(...)
typedef struct scene_load {
#include "cases/scene/keys_load.h"
    scene_load_kind kind;
    int where;        /* node or member (see scene_load_along) */
    double vector[3]; /* vector in `axes` of the undeformed structure; if the load varies, the value
                         at range[0] */
    double last[3];   /* value at range[1] if the load varies linearly */
    int varies;       /* 0 if the load is constant over the range */
    double range[2];  /* range on a member, as a fraction of the initial length from p. For a force
                         or a moment inside a member, both are its position. For loads at nodes, both
                         are 0 */
    int stations;     /* number of stations, or 0 if the factor equals the path parameter */
    double *path, *factor;
    scene_function function; /* factor as a function of time, given instead of the stations; no
                                pieces if stations are given */
    scene_feedback feedback;
    char name[SCENE_NAME];
} scene_load;

/* A load case. */
typedef struct scene_load_case {
    char name[SCENE_NAME];
} scene_load_case;

typedef struct scene_term {
    int load_case;
    double factor;
} scene_term;

typedef struct scene_combination {
    int terms;
    scene_term *term; /* [terms] */
    char name[SCENE_NAME];
} scene_combination;

typedef struct scene_computed {
    int known;
    section_spec of;
    section constants;
    char name[SCENE_NAME];
} scene_computed;

enum {
    SCENE_OMITTABLE = FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_MOMENTS |
                      FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA | FEATURE_WARPING
};

typedef enum scene_shear {
    SCENE_SHEAR_HARINGX,
    SCENE_SHEAR_ENGESSER,
    SCENE_SHEAR_OWN /* each formulation uses its own theory */
} scene_shear;
/* Shear theories in stability on which a reference value can depend. */
#define SCENE_SHEAR_THEORIES "engesser|haringx"

typedef struct scene_words {
    char text[SCENE_NAME + 16];
} scene_words;

struct scene {
    char name[SCENE_NAME];
    int sections, nodes, members, springs, drivers, loads, analyses, quantities, cases,
        combinations, constraints, imperfections;
    section_spec *section;
    int computeds;
    scene_computed *computed; /* [computeds] filled by scene_constants */
    scene_node *node;
    scene_member *member;
    scene_spring *spring;
    scene_driver *driver;
    scene_load *load;
    scene_load_case *load_case;
    scene_combination *combination;
    scene_constraint *constraint;
    scene_imperfection *imperfection;
    scene_analysis *analysis;
    scene_quantity *quantity;
    scene_plane plane; /* plane to which the scene is restricted, or SCENE_SPACE */
    unsigned omits;    /* bits of SCENE_OMITTABLE that the scene omits, set by scene_omit */
    unsigned demands;  /* FEATURE_* bits required in addition to those that the data require, set by
                          scene_demand */
    scene_shear shear_theory;
    int lumped; /* 1 if the mass of members is lumped at nodes, except in motions that specify their
                   mass */
    int meshes; /* default -n values of verify and converge */
    int mesh[SCENE_MESHES];
    int out_of_memory;
    /* Returned instead of an entry if out of memory, so that a case can write to it without a
     * check. */
    union {
        scene_node node;
        scene_member member;
        scene_load load;
        scene_quantity quantity;
    } scrap;
};

void scene_init(scene *s, const char *name);
void scene_free(scene *s);

int scene_add_section(scene *s, const section_spec *spec);
int scene_add_node(scene *s, double x, double y, double z);
int scene_add_attached(scene *s, int body, double x, double y,
                       double z); /* absolute undeformed position */
int scene_add_member(scene *s, int p, int q, int profile,
                     const double y_axis[3]); /* profile is the section at both ends */
/* Computes the stress-free elongation of a member of this length [m] from its pretension or its
 * unstressed length. Returns REFUSED if a pretension is given but an axial force causes other
 * strains than elongation or the section varies along the member, or if the unstressed length
 * differs from `length` by more than 1 % and no node is shifted by an imperfection. */
status scene_member_elongation(const scene *s, int member, double length, double *out, fault *f);
/* Returns 1 if the scene has a temperature load or a member with a stress-free elongation or
 * curvature. Writes the name of the load or member to `owner_name`, which may be NULL. */
int scene_is_free(const scene *s, scene_words *owner_name);
int scene_member_tapers(const scene_member *m);
int scene_tapers(const scene *s);
/* Compute the position of an end of a member (0 at p, 1 at q), and the vector from its start to its
 * end. */
void scene_end(const scene *s, int member, int end, double at[3]);
void scene_chord(const scene *s, int member, double chord[3]);
/* Returns 1 if this end of the member is offset from its node. */
int scene_is_beside(const scene_member *m, int end);
int scene_is_founded(const scene_member *m);
void scene_set_table(scene *s, int spring, int component, int points, const double at[],
                     const double value[]);
/* Returns the value of a table at x and sets *slope to the slope at x. At a point of the table, the
 * slope is that of the next segment, if there is one. A table without points gives 0. */
double scene_table_at(const scene_table *, double x, double *slope);
/* Returns the integral of the table from `from` to `to`. */
double scene_table_work(const scene_table *, double from, double to);
/* Releases a further component at an end of a member (0 at p, 1 at q). scene_validate rejects more
 * than SCENE_RELEASED components. */
void scene_release_end(scene *s, int member, int end, int component);
int scene_add_spring(scene *s, int p, int q, const double stiffness[36]);
/* Adds a constraint without nodes. The components of nodes that are added later depend on those of
 * the first node. */
int scene_add_constraint(scene *s, unsigned components, double ratio);
void scene_constrain(scene *s, int constraint, int node);
/* Adds a diaphragm, to which scene_constrain adds nodes. Spatial rotations of these nodes become a
 * sequence: about the normal, then about the two other axes unless both are fixed. */
int scene_add_diaphragm(scene *s, int master, int normal);

/* Adds an imperfection, whose mode or shifts the caller adds. */
int scene_add_imperfection(scene *s);
void scene_shift_node(scene *s, int imperfection, int node, const double shift[3]);
/* Returns 1 if the analysis uses the perfect structure, because its state is that about which the
 * mode of an imperfection is computed. */
int scene_is_perfect(const scene *s, int analysis);

/* Relation of a coordinate of a node (0 .. 5 as in translation and angle), which is `ratio` times
 * another coordinate. */
typedef struct scene_tie {
    int node, coordinate; /* the other coordinate, the coordinate itself if others depend on it, or
                             SCENE_NONE */
    double ratio;
} scene_tie;
/* Fills tie[6 nodes]. Returns REFUSED if constraints contradict each other or the supports. */
status scene_ties(const scene *, scene_tie tie[], fault *);
void scene_damp_spring(scene *s, int spring, const double damping[36]);
int scene_spring_damps(const scene_spring *);
/* Returns 1 if the stiffness of the spring is unsymmetric. */
int scene_spring_circulates(const scene_spring *);
int scene_spring_gyrates(const scene_spring *);
int scene_add_driver(scene *s, const char *name, int stations, const double path[],
                     const double value[]);
/* Adds a driver given by a function of time, whose pieces are added later. */
int scene_add_moving_driver(scene *s, const char *name);
/* Append a piece to the function of a driver, or of the factor of a load. `until` [s] is ignored
 * for the last piece. */
void scene_drive_piece(scene *s, int driver, double until, const char *text);
void scene_load_piece(scene *s, int load, double until, const char *text);
int scene_add_unknown_driver(scene *s, const char *name, int node, int component,
                             int condition_driver);
/* Returns a dead load. A distributed load acts along the whole member. */
scene_load scene_load_of(scene_load_kind kind, int where, double x, double y, double z);
int scene_add_load(scene *s, scene_load_kind kind, int where, double x, double y, double z);
/* Adds a force or a moment inside a member at a position from 0 (p) to 1 (q). */
int scene_add_load_within(scene *s, scene_load_kind kind, int member, double place, double x,
                          double y, double z);
/* Returns a load, which the caller may change, never NULL. */
scene_load *scene_load_at(scene *s, int index);
/* Returns 1 if the load acts on a member, either along it or at a position inside it. */
int scene_load_along(const scene_load *load);
/* Returns 1 if the load acts at a position inside a member. */
int scene_load_within(const scene_load *load);
/* Returns 1 if the vector of the load is a moment. */
int scene_load_turns(const scene_load *load);
const char *scene_heat_word(const scene_load *load);
int scene_has_feedback(const scene *s);
/* Returns 1 if the feedback of the load is included in this harmonic or modal analysis. */
int scene_closes_loop(const scene *s, int analysis, int load);
/* Returns 0 if the load is zero on its whole range, otherwise 1. */
int scene_load_acts(const scene_load *load);
/* Returns 1 if the load can make a tangent unsymmetric. */
int scene_load_unsymmetric(const scene_load *load);
void scene_set_factor(scene *s, int load, int stations, const double path[], const double factor[]);
int scene_add_case(scene *s, const char *name);
int scene_add_combination(scene *s, const char *name);
void scene_add_term(scene *s, int combination, int load_case, double factor);
/* Returns the number of the load case or combination that acts in the analysis or, if it follows
 * another, in the first analysis of the chain. Combinations are numbered from 1, then load cases.
 * Returns 0 if the scene has no load cases, if the analysis solves all load cases
 * (scene_solves_all), or if it is about the structure without loads. */
int scene_acting_of(const scene *s, int analysis);
/* Returns 1 for a linear analysis that solves every load case and combination. */
int scene_solves_all(const scene *s, int analysis);
/* Returns the number of the i-th load case or combination of a quantity, starting at 0. Returns 0
 * after the last, or if all loads act. */
int scene_acting_in(const scene *s, const scene_quantity *q, int i);
/* Returns the factor of a load case while the load case or combination with this number acts. The
 * factor is 1 for number 0 (all loads act) and for loads without a load case. */
double scene_acting_factor(const scene *s, int number, int load_case);
/* Returns text such as "combination ULS" or "case dead", or "" for 0. */
scene_words scene_acting_called(const scene *s, int number);
/* Return an entry of a list, which the caller may change, never NULL. */
scene_node *scene_node_at(scene *s, int index);
scene_member *scene_member_at(scene *s, int index);
void scene_hold(scene *s, int node, int first,
                int last); /* from first to last, SCENE_UX .. SCENE_RZ, inclusive */
void scene_hold_all(scene *s, int node);
void scene_drive(scene *s, int node, int component,
                 int driver); /* component: a translation or a spatial rotation component */
/* Computes the unit vectors along the support axes of the node, in columns. Returns 0 if the
 * support axes are those of the scene, otherwise 1. */
int scene_node_axes(const scene_node *n, double R[9]);
/* Returns the coordinate of a component. For a rotation sequence, this is the angle about the axis
 * of the component, if the sequence has this axis; otherwise the component itself. */
int scene_node_coordinate(const scene_node *n, int component);
/* Adds a fork support, whose guides on both sides of the web have the fixed normal n = web x axis.
 * The web remains between the guides: R web . n = 0, so R = exp(n t_1) exp(web t_2). For bending in
 * the plane of axis and web, the cross-section does not rotate about its current axis R axis, and
 * the moment of the fork is along this axis. (The moment of a fixed SCENE_RX is along the fixed x
 * axis.) `axis` and `web` are perpendicular directions of any length in the undeformed
 * cross-section. Translations are fixed separately. */
void scene_fork(scene *s, int node, const double axis[3], const double web[3]);
/* Adds a rigid body to the node. The centre of mass may be offset from the node. */
void scene_set_body(scene *s, int node, scene_body body);
int scene_has_body(const scene_node *n);
int scene_has_mass(const scene *s);
/* Finds rotations of a node that all its members release and that no other entry resists. They are
 * undefined and are therefore fixed. Returns 0 if there are no such rotations, SCENE_IDLE_AXIS for
 * the rotation about `axis`, which rotates with the node, or SCENE_IDLE_ALL for all rotations. */
enum { SCENE_IDLE_AXIS = 1, SCENE_IDLE_ALL };
int scene_idle_turn(const scene *s, int node, double axis[3]);
/* Returns the convention of moments on which a quantity depends, or NULL if the quantity does not
 * depend on it. */
const char *scene_convention(const scene *s, const scene_quantity *q);
/* Returns the normal of the plane to which the scene is restricted, 0 to 2, or SCENE_NONE. */
int scene_normal(const scene *s);
const char *scene_plane_name(const scene *s);
/* Omits physics (bits of SCENE_OMITTABLE). By default, a scene has all physics that its sections,
 * loads and analyses require. */
void scene_omit(scene *s, unsigned features);
/* Requires FEATURE_* bits that a formulation must support in addition to those that the data
 * require. */
void scene_demand(scene *s, unsigned features);
void scene_meshes(scene *s, int count, const int mesh[]);
/* Sets meshes of `first`, 2 `first`, 4 `first`, ... elements, up to `last`. */
void scene_meshes_doubled(scene *s, int first, int last);

/* Computes the constants of section i. They are stored until the description of the section
 * changes. REFUSED: section_compute rejects the section. Not thread-safe. */
status scene_constants(const scene *s, int i, section *out, fault *f);

void scene_join_instants(scene *s);
/* Checks the scene. Returns REFUSED with the cause. */
status scene_validate(const scene *s, fault *f);

/* Returns the factor of the load at a path parameter. The factor is linear between stations, and
 * constant before the first and after the last station. Without stations, the factor is the path
 * parameter. */
double along_path_factor(const scene_load *, double path);
/* Returns the derivative of the factor with respect to the path parameter. At a station, the
 * derivative is that of the following interval; outside the stations, it is 0. */
double along_path_rate(const scene_load *, double path);
/* Returns the value [m or rad] of a driver that is given by stations, constant before the first and
 * after the last. */
double along_path_value(const scene_driver *, double path);
/* Returns 1 if no load factor or prescribed value has a station between `from` and `to`. */
int along_path_is_straight(const scene *, double from, double to);
/* Text for messages: "; nothing changes outside path parameters 0 to 1 ...", "; no load changes
 * along the path ...", or "" if a load without stations or an unknown driver acts. `acting`: number
 * of the load case or combination (scene_acting_of). */
typedef struct along_path_words {
    char text[256];
} along_path_words;
along_path_words along_path_end(const scene *, int acting);
/* Returns REFUSED if an active load or driver varies nonlinearly between the path parameters 0 and
 * 1. */
status along_path_proportional(const scene *, int acting, fault *);

typedef enum scene_edit_kind {
    SCENE_EDIT_NONE,
    SCENE_EDIT_REVERSE, /* every member is reversed and runs from q to p */
    SCENE_EDIT_SPLIT, /* the first member is split in two at the fraction `amount` of its length */
    SCENE_EDIT_UNIT   /* all lengths are expressed in another unit, with `amount` units in 1 m;
                         quantities are still reported in metres */
} scene_edit_kind;

typedef struct scene_edit {
    scene_edit_kind kind;
    double amount; /* fraction of the length from 0 to 1, or number of units in 1 m */
} scene_edit;

/* Changes the scene. Returns REFUSED if the change is not possible. */
status scene_edit_apply(scene *s, const scene_edit *edit, fault *f);

typedef enum scene_list {
    SCENE_SECTIONS,
    SCENE_NODES,
    SCENE_MEMBERS,
    SCENE_SPRINGS,
    SCENE_DRIVERS,
    SCENE_LOADS,
    SCENE_ANALYSES,
    SCENE_QUANTITIES,
    SCENE_CASES,
    SCENE_COMBINATIONS,
    SCENE_CONSTRAINTS,
    SCENE_IMPERFECTIONS
} scene_list;
enum { SCENE_LISTS = SCENE_IMPERFECTIONS + 1 };

/* Return the number of entries of a list, and the singular of the name of the list, such as
 * "node". */
int scene_count(const scene *s, scene_list list);
const char *scene_list_word(scene_list list);
/* Sets the name of an entry. A name that is too long is truncated. Nothing happens if there is no
 * such entry. */
void scene_set_name(scene *s, scene_list list, int index, const char *name);
/* Returns the name given to the entry, or "" if the entry has no name or does not exist. */
const char *scene_own_name(const scene *s, scene_list list, int index);
scene_words scene_numbered(const scene *s, scene_list list, int index);
scene_words scene_name(const scene *s, scene_list list, int index);
/* Returns text for messages, such as "node tip", or "node 3" for an entry without a name. */
scene_words scene_called(const scene *s, scene_list list, int index);

/* Tables of the keys of entries of a scene. Files are read, checked and written by these tables. */

typedef enum entry_kind {
    ENTRY_TEXT,      /* any text */
    ENTRY_NAME,      /* name of another entry: int, its index or SCENE_NONE */
    ENTRY_WORD,      /* one of `words`, or a parameter with such choices: int */
    ENTRY_FLAG,      /* one of `words`; those with an odd index mean 1: int */
    ENTRY_WORDS,     /* one or several of `words`: unsigned, with one bit for each word */
    ENTRY_NUMBER,    /* an expression: double */
    ENTRY_WHOLE,     /* an integer: int */
    ENTRY_VECTOR,    /* a list of `count` expressions: double[] */
    ENTRY_DIRECTION, /* a direction, which rotates with the instance of a part */
    ENTRY_POSITION,  /* a position, which moves with the instance of a part */
    ENTRY_NUMBERS,   /* a list of any length, or a range: scene_path */
    ENTRY_FORMS,     /* several forms, which the summary describes */
    ENTRY_MAP,       /* a map with the keys `below`; its values are members of the same struct */
    ENTRY_ENTRIES,   /* named entries, each a map with the keys `below` */
    ENTRY_LIST,      /* a list of maps with the keys `below` */
    ENTRY_NAMES,     /* user-defined names; the first key of `below` describes their values  */
    ENTRY_LATER      /* rejected; the summary states the replacement and is NULL if the key is not
                        implemented */
} entry_kind;

/* How a component that a word names changes if the axes are rotated. */
typedef enum entry_turns {
    ENTRY_FIXED,
    ENTRY_COMPONENT, /* in the same way as a displacement or a rotation along the axes */
    ENTRY_AXIS,      /* in the same way as a direction */
    ENTRY_DIAGONAL   /* in the same way as a component, but without a change of sign */
} entry_turns;

enum { ENTRY_MOST_ORDER = 100000 };

struct quantity_type;

typedef struct entry_field {
    const char *name; /* NULL ends the table */
    entry_kind kind;
    int needed; /* 1 if required */
    int group;  /* keys with the same group > 0 exclude each other; if `needed` is set, one key of
                   the group is required */
    int count;
    const char *words; /* "a|b|c" */
    const struct entry_field *below;
    /* Unit. For numbers, it determines how they change with the units of length and force. */
    const char *unit, *summary;
    /* Default of an optional key: the value as written in a file, or a description. */
    const char *usual, *left_out;
    /* Position of the value in the struct of the entry (ENTRY_IN). If the size is 0, special
     * functions read and write the value. For a map in a group: position of the int that states
     * which map of the group is given. */
    size_t at, size;
    int first, falls; /* value of the first word or of the map; amount by which the values decrease
                         from word to word, or 0 if they increase by 1 */
    double
        otherwise; /* numeric default if `usual` does not state it, or NAN if there is no default */
    double least, most; /* range of a number; no limits if both are 0 */
    const char *range;  /* the range in words, or NULL if `least` and `most` describe it */
    scene_list of;      /* NAME: the list to which it refers */
    size_t zeros;       /* position of the unsigned whose bit `zero` records that zero was given
                           explicitly */
    unsigned zero;      /* bit of the key, or 0 if the key is not recorded */
    int always;         /* 1 if the key is written even if its value is the default */
    entry_turns turns;
    const struct quantity_type
        *type;           /* quantity type of a map, which contains its summary and keys */
    const char *mirrors; /* signs by which the numbers change if the ends of the member are
                            exchanged, such as "++-" */
} entry_field;

#define ENTRY_IN(type, member) .at = offsetof(type, member), .size = sizeof(((type *)0)->member)

#define ENTRY_COMPONENTS "ux|uy|uz|rx|ry|rz"

extern const entry_field entry_section[], entry_node[], entry_member[], entry_spring[],
    entry_driver[], entry_load[], entry_combination[], entry_constraint[], entry_imperfection[],
    entry_analysis[], entry_quantity[];

/* Returns the row of the key that contains the vector of a load of this kind, such as "force". */
const entry_field *entry_of_load(scene_load_kind);

/* Return the keys of a map, and the summary of a key. */
const entry_field *entry_below(const entry_field *);
const char *entry_summary(const entry_field *);
double entry_usual(const entry_field *);
/* entry_value returns the int of the word with this index. */
int entry_value(const entry_field *, int index);
int entry_index(const entry_field *, int value);
int entry_word(const entry_field *, const char *word);
int entry_is_usual(const entry_field *, const void *entry);
/* Returns the range in words, such as "at least 0". */
const char *entry_range(const entry_field *, char text[FAULT_TEXT]);
int entry_in_range(const entry_field *, double value);
/* Returns REFUSED if a value is not numeric or out of range ("damping = -1; give at least 0"), or
 * if a name or a word is unknown. */
status entry_check(const scene *s, const entry_field *table, const void *entry, fault *f);

typedef enum entry_base { ENTRY_LENGTH, ENTRY_FORCE } entry_base;
/* Returns the power of length or force in a unit: for "kg/m^3", -4 and 1. */
int entry_power(const char *unit, entry_base);
/* Scales all numbers with a unit for a change of unit: one former unit is `times` new units. */
void entry_scale(const entry_field *table, void *entry, entry_base, double times);
/* Changes the entry as if the ends of its member were exchanged. */
void entry_mirror(const entry_field *table, void *entry);
/* Returns 1 if the entries are equal bit for bit, except for values that special functions read and
 * write. */
int entry_same(const entry_field *table, const void *a, const void *b);

/* Columns of the table of inputs, which states which entries of a scene each kind of analysis uses
 * or rejects. */
typedef enum scene_column {
    SCENE_OF_LINEAR,
    SCENE_OF_STATIC,
    SCENE_OF_CONTINUATION,
    SCENE_OF_BUCKLING,
    SCENE_OF_BUCKLING_ABOUT,
    SCENE_OF_MODAL,
    SCENE_OF_MODAL_LINEAR,
    SCENE_OF_MODAL_ABOUT,
    SCENE_OF_MODAL_INSTANT,
    SCENE_OF_COMPLIANCE,
    SCENE_OF_COMPLIANCE_ABOUT,
    SCENE_OF_ROTATION,
    SCENE_OF_MOTION,
    SCENE_OF_HARMONIC,
    SCENE_OF_HARMONIC_LINEAR,
    SCENE_OF_HARMONIC_ABOUT,
    SCENE_OF_HARMONIC_INSTANT,
    SCENE_COLUMNS
} scene_column;

typedef enum scene_part {
    SCENE_PART_USED = 'u',
    SCENE_PART_STATE = 's', /* used, but rejected about a state with an unsymmetric tangent */
    /* Used if stability depends on inertia: in rotating axes, and about a path with an unsymmetric
     * tangent. Otherwise without effect. */
    SCENE_PART_INERTIA = 'i',
    SCENE_PART_NONE = '-',   /* without effect in this analysis */
    SCENE_PART_REFUSED = 'x' /* rejected for this analysis only; the message names the entry */
} scene_part;

typedef struct scene_input {
    const char *name;                   /* such as "loads that follow" */
    const char part[SCENE_COLUMNS + 1]; /* a scene_part for each column */
    const char
        *why; /* reason of the rejection and remedy, or NULL if the entry is never rejected */
    /* Returns 1 if the scene or this analysis has the entry, and sets `owner_name` to the name of
     * the entry, such as "load p". */
    int (*stands)(const scene *, int analysis, char *owner_name, int size);
} scene_input;

extern const scene_input scene_inputs[];
/* Names of the columns, such as "buckling about a path". */
extern const char *const scene_column_name[SCENE_COLUMNS];

scene_column scene_column_of(const scene *, int analysis);
/* Returns 1 if the analysis is about the state of another analysis whose tangent may be
 * unsymmetric, so that stability depends on the masses. */
int scene_inputs_flutter(const scene *, int analysis);
/* Returns REFUSED if the analysis rejects an entry of the scene. */
status scene_inputs_check(const scene *, int analysis, fault *);

/* Makes room for an entry of `list` (the address of its pointer) and sets the entry to zero.
 * Returns the index of the entry, or -1. */
int scene_grow(scene *s, void *list, int *count, size_t size);
/* Copies n numbers. Returns NULL if out of memory. */
double *scene_copy(scene *s, int n, const double from[]);

/* Writes the node with the given preposition, such as " of node_1 (0.1, 0, 0)". */
void meaning_node(FILE *to, const scene *s, const char *preposition, int node);
/* Writes the member, such as " of member_0 (node_0 to node_1)". */
void meaning_member(FILE *to, const scene *s, int member);
/* Writes the position, such as " at the end" or " at 0.5 of the length". `before` is the side at a
 * discontinuity. */
void meaning_place(FILE *to, double where, int before);
char meaning_axis(int component);
/* Returns "force along" or "moment about". */
const char *meaning_load(int component);
void meaning_ordinal(FILE *to, int order);
/* Writes text such as "displacement of node_1 (...) along x" or "rotation of node_1 (...),
 * component x of its rotation vector". */
void meaning_coordinate(FILE *to, const scene *s, int node, int component);

typedef struct scene_omission {
    unsigned feature; /* a bit of SCENE_OMITTABLE */
    const char *word;
} scene_omission;

/* All words, in the order in which they are written. A NULL word ends the table. */
extern const scene_omission scene_omissions[];

enum { SCENE_OMISSION_WORDS = 100 };
/* Writes the words of the omitted physics, such as "shear, trapeze", or "". */
void scene_omission_words(unsigned omits, char words[SCENE_OMISSION_WORDS]);

/* Returns the word of scene files, such as "haringx". */
const char *scene_shear_word(scene_shear theory);

/* Values of a state of a structure that quantities can read. The functions below `path` are only
 * for the kinds of quantities named there. NAN: unknown. */
typedef struct quantity_state {
    /* displacement [m] or component of the rotation vector [rad], or NAN if the direction of the
     * rotation is undefined */
    double (*component)(const struct quantity_state *, int node, int component);
    /* displacement or rotation relative to the node `from`, in the axes of that node */
    double (*relative)(const struct quantity_state *, int from, int node, int component);
    /* position [m], and rotation matrix, row-major */
    void (*frame)(const struct quantity_state *, int node, double place[3], double R[9]);
    /* in a motion: velocity [m/s], or angular velocity in the axes of the node [rad/s] */
    double (*rate)(const struct quantity_state *, int node, int component);
    /* in a motion: acceleration [m/s^2], or angular acceleration in the axes of the node
     * [rad/s^2] */
    double (*acceleration)(const struct quantity_state *, int node, int component);
    double (*driver)(const struct quantity_state *, int driver);
    /* rotation or displacement of an end of a member (0 at p, 1 at q) relative to its node, for a
     * released component */
    double (*released)(const struct quantity_state *, int member, int end, int component);
    double path; /* path parameter, load factor or time */
    /* for SCENE_REACTION, SCENE_INTERNAL, SCENE_STRESS and SCENE_DEFLECTION */
    double (*reaction)(const struct quantity_state *, int node, int component);
    double (*internal)(const struct quantity_state *, const scene_internal *);
    double (*stress)(const struct quantity_state *, const scene_stress *);
    double (*deflection)(const struct quantity_state *, const scene_deflection *);
    /* for SCENE_BALANCE */
    double (*balance)(const struct quantity_state *, scene_balance);
    /* for SCENE_COMPLIANCE_ENTRY and SCENE_STIFFNESS_ENTRY; only for the column of the entry */
    double (*compliance)(const struct quantity_state *, int row, int column);
} quantity_state;

/* Eigenvalue of a mode. */
typedef struct quantity_eigenvalue {
    double value; /* load factor for SCENE_CRITICAL_FACTOR, angular frequency [rad/s] for
                     SCENE_FREQUENCY and SCENE_DAMPING_RATIO */
    double decay; /* decay rate of a damped mode [1/s] */
} quantity_eigenvalue;

typedef struct quantity_type {
    const char *key, *summary;
    /* Kind of value. Several types may have the same kind; SCENE_READING depends only on nodes. */
    scene_quantity_kind kind;
    const entry_field *field; /* keys of the map below the key of the quantity */
    unsigned analyses;        /* bits 1 << kind of the analyses that support the quantity */
    int between; /* 1 if extremes, crossings and means of a motion include times between stations */
    /* Returns the default unit of the value, which determines its conversion to other units. */
    const char *(*unit)(const scene *, const scene_quantity *);
    /* Writes a description of the quantity. If names_analysis is 1, the description includes the
     * analysis. */
    void (*meaning)(FILE *, const scene *, const scene_quantity *);
    int names_analysis;
    /* Return the value, without factor and offset, of a state or of an eigenvalue. *part is the
     * part of the value to which the error of the quantity refers. */
    double (*read)(const scene_quantity *, const quantity_state *);
    double (*eigenvalue)(const scene_quantity *, const quantity_eigenvalue *, double *part);
    /* The following functions may be NULL. `turns` sets *out to the i-th rotation component that
     * the quantity needs and returns 1, or returns 0 if there are no more components. `complete`
     * completes the data read from a file, and returns an error message for *key, or NULL. `check`
     * returns REFUSED for errors that the key table cannot detect. */
    int (*turns)(const scene *, const scene_quantity *, int i, scene_component *out);
    const char *(*complete)(const scene *, scene_quantity *, const char **key);
    status (*check)(const scene *, const scene_quantity *, fault *);
} quantity_type;

const quantity_type *quantity_type_of(const scene_quantity *q);
void quantity_type_begin(const quantity_type *, scene_quantity *q);

#define QUANTITY_ANALYSIS                                                                          \
    {"analysis",                                                                                   \
     ENTRY_NAME,                                                                                   \
     .needed = 1,                                                                                  \
     .summary = "name of an analysis",                                                             \
     ENTRY_IN(scene_quantity, analysis),                                                           \
     .of = SCENE_ANALYSES}
#define QUANTITY_TAKEN                                                                             \
    {"at", ENTRY_NUMBER, .group = 1, .summary = "station", .left_out = "as given by take"},        \
        {"take",                                                                                   \
         ENTRY_WORD,                                                                               \
         .group = 1,                                                                               \
         .words = SCENE_TAKE_CHOICES,                                                              \
         .summary = "statistic over all stations, or over all times of a motion",                  \
         .usual = "last"}
#define QUANTITY_MODE                                                                              \
    {"which",                                                                                      \
     ENTRY_WHOLE,                                                                                  \
     .summary = "index in the family, counted from 0",                                             \
     .usual = "0",                                                                                 \
     ENTRY_IN(scene_quantity, what.of.mode.order),                                                 \
     .most = ENTRY_MOST_ORDER},                                                                    \
        {"family",                                                                                 \
         ENTRY_WORD,                                                                               \
         .words = "any|not_axial|axial|bending_y|bending_z|torsion",                               \
         .summary = "family of modes",                                                             \
         .usual = "any",                                                                           \
         ENTRY_IN(scene_quantity, what.of.mode.family),                                            \
         .always = 1},                                                                             \
    {                                                                                              \
        "half_waves", ENTRY_WHOLE, .summary = "half-waves of the mode; 0: any number",             \
            .usual = "0", ENTRY_IN(scene_quantity, what.of.mode.half_waves),                       \
            .most = ENTRY_MOST_ORDER                                                               \
    }
#define QUANTITY_NODE(member)                                                                      \
    {"node",                                                                                       \
     ENTRY_NAME,                                                                                   \
     .needed = 1,                                                                                  \
     .summary = "name of a node",                                                                  \
     ENTRY_IN(scene_quantity, what.of.member),                                                     \
     .of = SCENE_NODES}
#define QUANTITY_COMPONENT(text, member)                                                           \
    {"component",                                                                                  \
     ENTRY_WORD,                                                                                   \
     .needed = 1,                                                                                  \
     .words = ENTRY_COMPONENTS,                                                                    \
     .summary = (text),                                                                            \
     ENTRY_IN(scene_quantity, what.of.member),                                                     \
     .turns = ENTRY_COMPONENT}
#define QUANTITY_ACTING                                                                            \
    {"case",                                                                                       \
     ENTRY_NAME,                                                                                   \
     .group = 3,                                                                                   \
     .summary = "load case, if the linear analysis solves all load cases",                         \
     .left_out = "as given by the analysis",                                                       \
     ENTRY_IN(scene_quantity, acting.load_case),                                                   \
     .of = SCENE_CASES},                                                                           \
        {"combination",                                                                            \
         ENTRY_NAME,                                                                               \
         .group = 3,                                                                               \
         .summary = "combination of load cases, if the linear analysis solves all combinations",   \
         .left_out = "as given by the analysis",                                                   \
         ENTRY_IN(scene_quantity, acting.combination),                                             \
         .of = SCENE_COMBINATIONS},                                                                \
        {"envelope",                                                                               \
         ENTRY_WORD,                                                                               \
         .group = 3,                                                                               \
         .words = SCENE_ENVELOPE_CHOICES,                                                          \
         .summary =                                                                                \
             "over combinations: largest or smallest value, or value of the largest magnitude",    \
         .left_out = "of one",                                                                     \
         ENTRY_IN(scene_quantity, envelope),                                                       \
         .first = SCENE_ENVELOPE_MAX},                                                             \
        {"combinations", ENTRY_WORDS, .summary = "of the envelope",                                \
         .left_out = "all; all load cases if there are no combinations"}
#define QUANTITY_SIDE(member)                                                                      \
    {"side",                                                                                       \
     ENTRY_WORD,                                                                                   \
     .words = "from|to",                                                                           \
     .summary = "side of the position 'where', towards the end 'from' or 'to'; resultants jump "   \
                "where a load acts",                                                               \
     .usual = "to",                                                                                \
     ENTRY_IN(scene_quantity, what.of.member),                                                     \
     .first = 1,                                                                                   \
     .falls = 1}
#define QUANTITY_ALL_STATES                                                                        \
    (1u << SCENE_STATIC | 1u << SCENE_MOTION | 1u << SCENE_CONTINUATION | 1u << SCENE_ROTATION)

/* Converts all lengths to another unit, with x units in 1 m. Newtons and seconds do not change, so
 * masses are divided by x. Quantities are reported in their former units. Returns REFUSED if x is
 * not positive, or if a driver prescribes both lengths and angles. */
status scene_change_unit(scene *s, double x, fault *f);
/* Converts all forces to another unit, with y units in 1 N, and masses accordingly. Metres and
 * seconds do not change. Quantities are reported in their former units. */
void scene_change_force(scene *s, double y);
/* Returns 1 if the numbers suggest units other than SI, and writes these units and the reason.
 * Otherwise returns 0. Sections given by matrices are not checked. */
int scene_looks_foreign(const scene *s, char words[FAULT_TEXT]);

enum { SCENE_WARP_BY_SUPPORT = -3 };

/* Sets the warping condition of every end that has SCENE_WARP_BY_SUPPORT.
 *
 * Warping is restrained if all six components of the node are fixed or prescribed, if a member is
 * joined to the node with an offset, or if the node is part of a rigid body to which members or
 * springs are joined at other nodes.
 *
 * If exactly two members meet at any other node and continue in one line with the same section and
 * axes, both ends share the warping coordinate, unless one of them is released. All other ends are
 * free to warp. */
void scene_warping_by_supports(scene *s);

#endif
