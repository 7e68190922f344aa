/* scene/: a scene: the structure, its loads and prescribed coordinates, its analyses and
 * quantities.
 *
 * Sections, in this order: analysis; expression, formula and function of time; quantity; scene;
 * values along a path; edit; names; entry (keys of scene files); inputs of analyses; lists; words
 * of quantities and omission; quantity type; unit of length; warping of ends. */
#ifndef BEAMWORK_CASES_SCENE_SCENE_H
#define BEAMWORK_CASES_SCENE_SCENE_H

#include <stddef.h>
#include <stdio.h>

#include "elements/feature.h"
#include "elements/section/section.h"
#include "elements/shared/status.h"

/* Analyses: a kind, and the data that this kind alone needs.  Every scene_add_* returns the index
 * of the new analysis, or -1 when memory ran out.  What a kind has is read through its function
 * below, which ends the program when the analysis is of another kind: nothing else names the union.
 */

typedef struct scene scene;

enum { SCENE_NONE = -1, SCENE_NAME = 48, SCENE_UNIT = 16 }; /* sizes with the final zero */

typedef enum scene_analysis_kind {
    SCENE_LINEAR,     /* one linear solution with the loads at factor 1 */
    SCENE_STATIC,     /* nonlinear equilibrium along the path */
    SCENE_BUCKLING,   /* linear prestress about the undeformed state: what the loads have at path 0
                         stays, what they gain by path 1 is times the factor; or about the last
                         of a path */
    SCENE_MODAL,      /* natural frequencies about the present state */
    SCENE_COMPLIANCE, /* at every station of the static path before it */
    SCENE_CONTINUATION, /* path of a load factor, by arc length or by one coordinate */
    SCENE_ROTATION,     /* stationary: equilibrium and frequencies in the rotating frame */
    SCENE_MOTION,       /* in time: the path parameter is the time [s] */
    SCENE_HARMONIC /* steady small vibration about a state: path parameter is a frequency [Hz] */
} scene_analysis_kind;

/* Behaviour of a reaction's moment while its node turns (harness/newton/newton.h). */
typedef enum scene_moments {
    SCENE_MOMENTS_SPATIAL,
    SCENE_MOMENTS_SEMITANGENTIAL,
    SCENE_MOMENTS_SYMMETRISED
} scene_moments;
#define SCENE_MOMENTS_CHOICES "spatial|semitangential|symmetrised"
const char *scene_moments_name(scene_moments);

/* Output points: path parameters, ascending; of a continuation values of its control coordinate
 * [m], in the order in which they are met. */
typedef struct scene_path {
    int stations;
    double *value; /* [stations] */
} scene_path;

/* The scene's axes turn.  Along a static path or a continuation this is constant, in a stationary
 * rotation it is times the path parameter.  Zero: at rest. */
typedef struct scene_rotating_frame {
    double omega[3];  /* angular velocity [rad/s] */
    double centre[3]; /* a point on its axis [m] */
} scene_rotating_frame;

/* Static, rotation. */
typedef struct scene_walk {
    scene_path path;
    int steps_between; /* load steps from one station to the next, to begin with; >= 1 */
    int modes;         /* rotation: how many to look for at first, of all families together */
    scene_rotating_frame frame;
} scene_walk;

typedef struct scene_compliance {
    int node;
    scene_moments moments;
    unsigned released; /* bit i: component i at the node, though prescribed, is free and its
                          reaction is a dead load */
} scene_compliance;

/* How the path of proportional loads is followed, whose factor is unknown.  The control coordinate
 * is a translation of any node, also of an attached one; by arc length it is what curves are drawn
 * over.  The arc is the root of the mean, over all nodes, of (displacement/size of the scene)^2 +
 * rotation^2, dimensionless. */
typedef struct scene_control {
    int node, component;
    int by_arc;            /* 1: steps are lengths of arc, 0: steps of the control coordinate */
    double step, step_max; /* first and largest step [m, or 1 by arc length] */
    int constant_steps; /* 1: all steps are `step`, and a branch jump ends the path; 0: steps adapt,
                           and a jump is walked around */
} scene_control;

typedef struct scene_continuation {
    scene_path path;
    scene_rotating_frame frame;
    scene_control control;
} scene_continuation;

/* How a motion is integrated. */
typedef enum scene_scheme {
    SCENE_ALPHA,      /* generalized-alpha: order 2, damps what is not resolved */
    SCENE_CONSERVING, /* order 2, keeps energy and momenta */
    SCENE_RADAU,      /* Radau IIA of three stages: order 5 */
    SCENE_EXPLICIT,   /* Runge-Kutta of order 8: for truths */
    SCENE_SCHEMES
} scene_scheme;

#define SCENE_SCHEME_CHOICES "alpha|conserving|radau|explicit"

/* How the mass of members lies. */
typedef enum scene_mass {
    SCENE_MASS_USUAL, /* consistent where the formulation and all integrators of the chain of
                         motions support it, and the scene does not lump it */
    SCENE_LUMPED,     /* at the nodes, with all formulations alike */
    SCENE_CONSISTENT  /* along the elements, as a formulation has it that offers that */
} scene_mass;

#define SCENE_MASS_CHOICES "lumped|consistent"

/* Parameters of generalized-alpha: alpha_m, alpha_f from rho, the spectral radius at infinite
 * frequency; or as given. */
typedef struct scene_alpha {
    double mass, force; /* alpha_m, alpha_f */
} scene_alpha;

/* Initial velocities: those of a rigid body that turns about a point. */
typedef struct scene_start {
    double velocity[3], spin[3], centre[3]; /* [m/s], [rad/s], [m] */
} scene_start;

/* In time, from rest or with `start`; about the last state of the path it follows, of a motion with
 * its rates and at its time. */
typedef struct scene_motion {
    scene_path path; /* instants at which quantities are read [s] */
    scene_scheme scheme;
    scene_alpha alpha;
    double step;      /* [s] first one; without a tolerance all */
    double tolerance; /* of the error of a step, relative to the size; 0: steps stay */
    scene_start start;
    scene_mass mass;
} scene_motion;

/* Damping of small vibrations: mass x M + stiffness x the stiffness of members and springs, without
 * that of stresses; and ratios of the modes without damping. */
typedef struct scene_proportional {
    double mass, stiffness; /* [1/s], [s] */
    double ratio;           /* of the modes behind ... */
    scene_path ratios;      /* ... the first ones, which have these */
} scene_proportional;

typedef struct scene_analysis {
    scene_analysis_kind kind;
    int follows; /* analysis whose state(s) this one is about, or SCENE_NONE: undeformed */
    union {
        scene_walk walk;
        scene_compliance compliance;
        scene_continuation continuation;
        scene_motion motion;
        scene_path harmonic; /* frequencies [Hz] */
    } of;
    scene_proportional damping; /* of small vibrations, beside members' and dashpots */
    int damped;                 /* 1: modes are those with damping */
    int by_modes;               /* 1: a harmonic analysis is solved by its modes */
    int modes;                  /* how many it has, and has ratios of; 0: all */
    char name[SCENE_NAME];      /* "": none */
} scene_analysis;

int scene_add_linear(scene *s);
int scene_add_static(scene *s, int stations, const double path[], int steps_between);
/* As many eigenvalues as the quantities ask for. */
int scene_add_buckling(scene *s, int follows);
int scene_add_modal(scene *s, int follows);
int scene_add_compliance(scene *s, int follows, scene_compliance what);
int scene_add_continuation(scene *s, int stations, const double path[], scene_control control);
int scene_add_rotation(scene *s, int stations, const double path[], int steps_between, int modes,
                       scene_rotating_frame frame);
int scene_add_motion(scene *s, int follows, int stations, const double path[], scene_motion how);
/* alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1) (Chung & Hulbert 1993). */
scene_alpha scene_alpha_of_radius(double rho);
/* Turns the axes of a static path or a continuation. */
void scene_set_rotating_frame(scene *s, int analysis, scene_rotating_frame frame);

/* "linear", "static", ...: as a scene file specifies it. */
const char *scene_analysis_name(scene_analysis_kind);

const scene_walk *scene_walk_of(const scene_analysis *a);
const scene_compliance *scene_compliance_of(const scene_analysis *a);
const scene_continuation *scene_continuation_of(const scene_analysis *a);
const scene_motion *scene_motion_of(const scene_analysis *a);
/* 1: modes of a harmonic analysis have damping ratios. */
int scene_has_ratios(const scene_analysis *a);
/* 1: a motion for which the scene requests consistent mass. */
int scene_spreads(const scene_analysis *a);
/* Is it a motion whose elements are to do that where they can? */
int scene_may_spread(const scene *s, int analysis);
/* NULL: the kind has none. */
const scene_path *scene_path_of(const scene_analysis *a);
/* The state that a motion starts from, before the motions that it continues: a static path, a
 * continuation, a rotation; SCENE_NONE: the undeformed state. */
int scene_origin_of(const scene *s, int analysis);
const scene_rotating_frame *scene_rotating_frame_of(const scene_analysis *a);
/* Do the axes turn? */
int scene_rotates(const scene_analysis *a);

/* Expressions as text, one language for numbers and functions of time: + - * / ^, parentheses,
 * functions and constants (expression_word), names; in functions of time also the time t [s].
 *
 * ^ binds strongest and to the right (-2^2 = -4, 2^3^2 = 512), then signs, then * and /, then + and
 * -. Values are SI, angles in radians (30*deg*t); what no t is in must be finite. A function that
 * has kinks or no derivatives here is of numbers only: what has kinks in time is given in pieces
 * (scene_piece), so that steps can end there. */

typedef struct expression_mistake {
    int at;                /* character of the text, from 0 */
    char what[FAULT_TEXT]; /* and what to do; "": reported already */
} expression_mistake;

/* The number of the name that text[*at] begins, and *at after it; 0: a mistake. */
typedef int expression_name(const void *names, const char *text, int *at, double *out,
                            expression_mistake *);

/* Length of the name that the text begins with: letters, digits, _, not a digit first; 0: none. */
size_t expression_name_length(const char *text);
/* The i-th function or constant, or NULL after the last. */
const char *expression_word(int i);
/* Is it one of them? */
int expression_is_word(const char *name, size_t length);

/* text[from .. end - 1] as a number; find NULL: there are no names. REFUSED: why. */
status expression_value(const char *text, int from, int end, expression_name *find,
                        const void *names, double *out, expression_mistake *);
/* REFUSED: what is wrong, and where; `of`: printf's format. */
status expression_wrong(expression_mistake *, int at, const char *of, ...)
    __attribute__((format(printf, 3, 4)));

/* A function of time: an expression without names. */

typedef struct formula formula;

/* REFUSED, FAULT out of memory: why. */
status formula_parse(const char *text, formula **out, expression_mistake *);
/* REFUSED: what is wrong, and at which character (from 1). */
status formula_read(const char *text, formula **out, fault *f);
void formula_free(formula *);
/* Its value and its first two derivatives by t; not finite where it has none. */
void formula_at(const formula *, double t, double out[3]);

/* A function of time in pieces, each a formula: between them it may have kinks and jumps, where no
 * step goes across. */

typedef struct scene_piece {
    double until; /* [s]; of the last: for ever */
    char *text;
    formula *is; /* NULL: text is wrong, see function_check */
} scene_piece;

typedef struct scene_function {
    int pieces;
    scene_piece *piece; /* [pieces] ascending */
    double scale;       /* of its value; 0: 1 */
} scene_function;

/* A further piece, after those that there are; text is copied. -1: out of memory. */
int function_add(scene_function *, double until, const char *text);
/* The pieces of another one, and its scale; `to` has none yet. -1: out of memory. */
int function_copy(scene_function *to, const scene_function *from);
void function_free(scene_function *);
/* REFUSED: what is wrong with it. */
status function_check(const scene_function *, fault *);
/* Value and first two derivatives at t; at the end of a piece: of the next one. */
void function_at(const scene_function *, double t, double out[3]);
/* Is it finite from 0 to `end`, with that many of its derivatives (0 to 2), at both ends of all
 * pieces and at 63 instants between? 0: not at *time. */
int function_finite(const scene_function *, double end, int derivatives, double *time);
/* 1: value and velocity are continuous from piece to piece before `end`. 0: at *time the value
 * (*derivative 0) or the velocity (1) is not. */
int function_smooth(const scene_function *, double end, double *time, int *derivative);

/* Quantities of an analysis: a name, how it is evaluated, and what is extracted, one struct for
 * each kind. What a kind has is read through its function below, which ends the program when the
 * quantity is of another kind: nothing else names the union. */

typedef enum scene_quantity_kind {
    SCENE_COORDINATE,       /* displacement or rotation-vector component of a node */
    SCENE_REACTION,         /* of a prescribed component at a node */
    SCENE_COMPLIANCE_ENTRY, /* of the 6 x 6 matrix of the analysis' node */
    SCENE_STIFFNESS_ENTRY,  /* 1 / compliance entry (i, i), only the non-fixed coordinates free */
    SCENE_CRITICAL_FACTOR,  /* load factor of linear buckling */
    SCENE_GROWTH,           /* largest rate of growth of a small motion [1/s]; 0: stable */
    SCENE_FREQUENCY,        /* [Hz] */
    SCENE_FACTOR_AT,        /* load factor of a continuation where the control coordinate is ... */
    SCENE_CRITICAL_POINT,   /* of a continuation */
    SCENE_DRIVER_VALUE,     /* of an unknown driver */
    SCENE_INTERNAL,         /* resultant of the stresses on a section of a member */
    SCENE_STRESS,           /* largest of a section or a member */
    SCENE_RATE,     /* velocity of a node, its angular velocity in its own axes, or what follows */
    SCENE_BALANCE,  /* energy or momentum of a motion */
    SCENE_RELATIVE, /* displacement or rotation of a node in the axes of another */
    SCENE_RESPONSE, /* of a harmonic analysis */
    SCENE_DAMPING_RATIO, /* of a damped mode, or its rate of decay */
    SCENE_READING        /* of nodes, of which nothing outside its file knows more */
} scene_quantity_kind;

/* A point of a path at which the tangent stiffness is singular. */
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
    /* of a motion, wherever its stations lie: positions and rates only */
    SCENE_MAX_TIME,   /* when the largest value is met [s] */
    SCENE_MIN_TIME,   /* when the least one is [s] */
    SCENE_CROSSING,   /* when a level is passed [s] */
    SCENE_PERIOD,     /* from one crossing to the next of its direction, mean of all [s] */
    SCENE_PER_SECOND, /* one by that [Hz] */
    SCENE_MEAN,       /* over time */
    SCENE_RMS,        /* root of the mean of its square over time */
    SCENE_REDUCTIONS
} scene_reduction;

/* Is it a time, or one by that, and no value of what is read? */
static inline int scene_is_timed(scene_reduction how)
{
    return how > SCENE_CURVE && how < SCENE_MEAN;
}

/* Which way a level is passed. */
typedef enum scene_direction { SCENE_RISING, SCENE_FALLING, SCENE_EITHER } scene_direction;
#define SCENE_DIRECTION_CHOICES "rising|falling|either"
/* The last two are curves, too. */
#define SCENE_TAKE_CHOICES                                                                         \
    "last|max|min|curve|max_time|min_time|crossing|period|per_second|mean|rms|spectrum|psd"

/* A curve of a motion over time, or over frequency: of its stations x[0 .. N], which are evenly
 * spaced by d and of which x[N] begins the next period. X[k] = sum w[n] x[n] exp(-2 pi i k n/N) at
 * k/(N d). */
typedef enum scene_transform {
    SCENE_HISTORY,
    SCENE_SPECTRUM, /* amplitudes 2 |X|/sum w, half of that at 0 and (2 d)^-1 */
    SCENE_PSD       /* power density of one side 2 d |X|^2/sum w^2 [by Hz], half likewise */
} scene_transform;
/* The weights w: 1, or sin^2(pi n/N). */
typedef enum scene_taper { SCENE_TAPER_NONE, SCENE_TAPER_HANN } scene_taper;
#define SCENE_TAPER_CHOICES "none|hann"

/* Feature of a motion from which a value is taken. */
typedef struct scene_passing {
    double level; /* as extracted, in SI units */
    scene_direction direction;
    int order;          /* among the crossings of that direction, from 0 */
    double from, until; /* [s] window; until 0: to the end */
    scene_taper taper;  /* of a spectrum */
} scene_passing;

/* Of a rate: by time once, twice, three times. */
typedef enum scene_rate_of { SCENE_SPEED, SCENE_SPEEDING, SCENE_JERK } scene_rate_of;
#define SCENE_RATE_CHOICES "velocity|acceleration|jerk"

typedef struct scene_component {
    int node, component; /* SCENE_UX .. SCENE_RZ */
} scene_component;
typedef struct scene_rated {
    scene_component at;
    scene_rate_of rate;
} scene_rated;

/* Resultants of the stresses of what lies towards the end q of a member on what lies towards p, in
 * the principal axes of the turned section, moments about its centroid. The parts of the torque add
 * up to that about the shear centre, Mx - (ys Qz - zs Qy): of Saint-Venant's torsion, of the
 * restrained warping (the bimoment falls by it along the member), and of what stresses along the
 * fibres, which the twist turns, add. */
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

/* Which section of a member. */
typedef enum scene_along {
    SCENE_ALONG_PLACE,  /* at a place of it */
    SCENE_ALONG_MAX,    /* where the value is largest */
    SCENE_ALONG_MIN,    /* where it is least */
    SCENE_ALONG_LARGEST /* where its magnitude is largest: that magnitude */
} scene_along;

typedef struct scene_internal {
    int member;
    scene_resultant resultant;
    scene_along along;
    double place; /* of SCENE_ALONG_PLACE: 0 at p .. 1 at q, of the initial length */
    int before;   /* of what jumps there: 1 on the side of p, 0 on that of q */
} scene_internal;

/* Measures over all points of a section (elements/section/stress.h) [Pa]. */
typedef enum scene_stress_measure {
    SCENE_VON_MISES,
    SCENE_NORMAL_MAX, /* along the fibres, tension positive */
    SCENE_NORMAL_MIN
} scene_stress_measure;

typedef struct scene_stress {
    int member;
    scene_stress_measure measure;
    int whole;    /* 1: of all sections of the member; 0: of the one at ... */
    double place; /* 0 at p .. 1 at q, of the initial length */
    int before;   /* as of scene_internal */
} scene_stress;

/* Quantities of a whole motion. */
typedef enum scene_balance {
    SCENE_KINETIC,    /* [J] */
    SCENE_STRAIN,     /* stored in members and springs [J] */
    SCENE_ENERGY,     /* both */
    SCENE_WORK,       /* of loads and prescribed coordinates, since t = 0 */
    SCENE_DISSIPATED, /* by damping, since t = 0 */
    SCENE_DRIFT,      /* energy-balance error: energy + dissipated - initial energy - work */
    SCENE_PX,         /* momentum [kg m/s] */
    SCENE_PY,
    SCENE_PZ,
    SCENE_LX, /* angular momentum about the origin [kg m^2/s] */
    SCENE_LY,
    SCENE_LZ,
    SCENE_BALANCES
} scene_balance;
#define SCENE_BALANCE_CHOICES "kinetic|strain|energy|work|dissipated|drift|px|py|pz|lx|ly|lz"

/* Displacement of a node relative to another that carries it along: change of its position in the
 * axes of that node, and its rotation against it. */
typedef struct scene_relative {
    int node, component, from;
} scene_relative;

/* Members that the reader of a kind without a struct of its own reads: its table of keys lists
 * them. */
typedef struct scene_reading {
    int node[4], component[4];
    double number[4];
} scene_reading;

/* Steady vibration of a node for a harmonic force, or a harmonic motion of a driver, of size 1. */
typedef enum scene_vibration {
    SCENE_DISPLACED,
    SCENE_VELOCITY,
    SCENE_ACCELERATION
} scene_vibration;
typedef enum scene_vibration_part {
    SCENE_AMPLITUDE,
    SCENE_PHASE, /* [rad] by which it is ahead of the input, -pi to pi */
    SCENE_REAL,
    SCENE_IMAGINARY
} scene_vibration_part;
#define SCENE_VIBRATION_CHOICES "displacement|velocity|acceleration"
#define SCENE_VIBRATION_PARTS   "amplitude|phase|real|imaginary"
typedef struct scene_response {
    int node, component;
    int from;                 /* less the same of this node; SCENE_NONE: of none */
    int forced, forced_along; /* node and component of a force or moment, or ... */
    int driver;               /* ... what moves; SCENE_NONE: a force */
    scene_vibration of;
    scene_vibration_part part;
} scene_response;

typedef struct scene_entry {
    int row, column; /* response, load: SCENE_UX .. SCENE_RZ */
} scene_entry;

typedef struct scene_critical_load {
    int sign;  /* 1: of positive factors, -1: of negative ones */
    int order; /* among those of the sign by size, from 0 */
} scene_critical_load;

typedef struct scene_mode {
    int order; /* among the modes of the family and half-waves, from 0 */
    scene_family family;
    int half_waves; /* 0: any */
    int decay;      /* of a damping ratio: 1: the rate of decay in its place [1/s] */
} scene_mode;

typedef enum scene_ordinate { SCENE_LOAD_FACTOR, SCENE_CONTROL } scene_ordinate;

typedef struct scene_point {
    scene_critical kind;
    int order;               /* among the points of the kind along the path, from 0 */
    scene_ordinate ordinate; /* what of it: load factor, or control coordinate [m] */
} scene_point;

/* The extracted value; made by the functions of the kinds. */
typedef struct scene_extract {
    scene_quantity_kind kind;         /* that of the type: what an analysis is asked for */
    const struct quantity_type *type; /* all else: its file in cases/quantities */
    union {
        scene_component component; /* coordinate, reaction; where a rate is */
        scene_rated rated;
        scene_entry entry; /* of compliance and stiffness */
        scene_critical_load load;
        scene_mode mode;
        scene_point point;
        int driver;
        scene_internal internal;
        scene_stress stress;
        scene_balance balance;
        scene_relative relative;
        scene_response response;
        scene_reading reading;
    } of;
} scene_extract;

scene_extract scene_coordinate(int node, int component);
scene_extract scene_reaction(int node, int component);
scene_extract scene_compliance_entry(int row, int column);
scene_extract scene_stiffness_entry(int component);
scene_extract scene_critical_factor(int sign, int order);
scene_extract scene_growth(void);
/* scene_frequency: any number of half-waves. */
scene_extract scene_frequency(int order, scene_family family);
scene_extract scene_frequency_of(int order, scene_family family, int half_waves);
scene_extract scene_factor_at(void);
scene_extract scene_critical_point(scene_critical kind, int order, scene_ordinate ordinate);
scene_extract scene_driver_value(int driver);
scene_extract scene_rate(int node, int component);
/* Entry of the rotation matrix: row and column 0 .. 2. */
scene_extract scene_orientation_entry(int node, int row, int column);
scene_extract scene_balance_of(scene_balance what);
scene_extract scene_relative_to(int node, int component, int from);
/* place: 0 at p .. 1 at q, on the side of q */
scene_extract scene_internal_at(int member, double place, scene_resultant resultant);
scene_extract scene_internal_along(int member, scene_along along, scene_resultant resultant);
/* Over a member: of its sections the one that has most, of SCENE_NORMAL_MIN least. */
scene_extract scene_stress_along(int member, scene_stress_measure measure);
scene_extract scene_stress_at(int member, double place, scene_stress_measure measure);
/* A resultant or a stress at a place, on the side of p of what jumps there (before) or of q. */
scene_extract scene_beside(scene_extract what, int before);
/* Words of scene files. */
#define SCENE_STRESS_CHOICES    "von_mises|normal_max|normal_min"
#define SCENE_RESULTANT_CHOICES "N|Qy|Qz|Mx|My|Mz|bimoment|Mx_saint_venant|Mx_warping|Mx_wagner"

/* Abscissa of a curve. */
typedef struct scene_abscissa {
    char name[SCENE_NAME], unit[SCENE_UNIT];
    int is_quantity; /* 1: the curve of the quantity that is called so, station by station, in its
                        unit; else: */
    double factor, offset; /* the path parameter, or the control coordinate, times factor plus
                              offset */
} scene_abscissa;

/* Value of an analytic model with an error of its own: shown, never judged. */
typedef struct scene_prediction {
    double value;       /* [unit of the quantity] */
    const char *source; /* NULL: there is none */
} scene_prediction;

typedef struct scene_quantity {
    char name[SCENE_NAME], unit[SCENE_UNIT];
    int analysis;
    scene_extract what;
    scene_reduction reduction; /* of the stations of a path */
    scene_transform transform; /* of a curve */
    double at;                 /* path parameter or control coordinate, of SCENE_AT */
    scene_passing passing;     /* of a motion */
    scene_abscissa x;          /* of a curve */
    double factor, offset;     /* reported value = factor * extracted value + offset */
    double near_zero;   /* absolute scale for relative errors of values near zero; 0: |value| */
    double tolerance;   /* relative, of the limit against the truth: SCENE_TOLERANCE unless a case
                           specifies why not */
    double least_order; /* of convergence in the number of elements */
    scene_prediction prediction;
} scene_quantity;

/* The new quantity, to be filled further, never NULL: of the last station, factor 1, tolerance
 * SCENE_TOLERANCE, the rest 0. */
scene_quantity *scene_add_quantity(scene *s, const char *name, const char *unit, int analysis,
                                   scene_extract what);
/* All along the path, over its parameter or the control coordinate times factor plus offset. */
void scene_set_curve(scene_quantity *q, const char *x_name, const char *x_unit, double factor,
                     double offset);
/* All along the path, over another quantity whose curve is of the same stations. */
void scene_set_curve_over(scene_quantity *q, const char *quantity, const char *unit);
/* Index of the quantity that a curve is over; SCENE_NONE: it is over its path. */
int scene_abscissa_of(const scene *s, const scene_quantity *q);
/* At one value of the path parameter or the control coordinate. */
void scene_set_at(scene_quantity *q, double at);
/* Statistic over the whole time of a motion: SCENE_MAX_TIME to SCENE_RMS, SCENE_MAX, SCENE_MIN. */
void scene_set_passing(scene_quantity *q, scene_reduction, scene_passing);
/* Stations of a spectrum, the last one with them: *count of them from *first. REFUSED: they are not
 * evenly spaced. */
status scene_spectrum_stations(const scene *, const scene_quantity *, int *first, int *count,
                               fault *);
/* Is it read between the stations of a motion? */
int scene_is_passed(const scene_quantity *q, scene_analysis_kind);

const scene_component *scene_component_of(const scene_quantity *q);
const scene_entry *scene_entry_of(const scene_quantity *q);
const scene_critical_load *scene_critical_load_of(const scene_quantity *q);
const scene_mode *scene_mode_of(const scene_quantity *q);
const scene_point *scene_point_of(const scene_quantity *q);
int scene_driver_of(const scene_quantity *q);
const scene_relative *scene_relative_of(const scene_quantity *q);
scene_balance scene_balance_in(const scene_quantity *q);
const scene_internal *scene_internal_of(const scene_quantity *q);
const scene_stress *scene_stress_of(const scene_quantity *q);
/* Is it of this kind and this analysis? */
int scene_asks(const scene_quantity *q, int analysis, scene_quantity_kind kind);
/* Does it read reactions, resultants or stresses? */
int scene_reads_forces(const scene_quantity *q);
/* Is the analysis read: by a quantity, or by an analysis that follows it and is read itself? Where
 * there are no quantities, all of them are. */
int scene_reads(const scene *s, int analysis);
/* Takes away the quantities whose names the other scene does not have. */
void scene_keep_quantities(scene *s, const scene *of);
/* Unit of a response to a force or a moment, SCENE_UX to SCENE_RZ both. */
const char *scene_compliance_unit(int row, int column);
/* Can it be extracted from an analysis of this kind? */
int scene_gives(scene_analysis_kind analysis, const scene_quantity *q);

/* A scene: pure data that says what a structure is, how it is fixed and prescribed,
 * what is analysed and which quantities are wanted.  No solver is called here
 * and no formulation is known: a file could hold the same data.
 *
 * Every scene_* function that adds something returns its index in its list, or
 * -1 when memory ran out (scene_valid then says so once, at the end). */

/* Relative tolerance of a limit: what engineers require of a model. A different limit within it is
 * still detected, by its uncertainty. */
#define SCENE_TOLERANCE 1e-3

/* Most numbers of elements that a scene or a command gives. */
enum { SCENE_MESHES = 24 };

/* Components of a node: three translations, three rotations (fixed axes). */
enum { SCENE_UX, SCENE_UY, SCENE_UZ, SCENE_RX, SCENE_RY, SCENE_RZ };

/* Warping coordinate at an end of a member. A value >= 0 is a name: ends with the same value share
 * it. */
enum { SCENE_WARP_FREE = -1, SCENE_WARP_FIXED = -2 };

/* How one coordinate moves. A value >= 0 is a driver's index. */
enum { SCENE_FREE = -1, SCENE_HELD = -2 };

/* Held in a plane: nothing leaves it, neither the nodes nor what lies between them; warping is
 * fixed.
 */
typedef enum scene_plane {
    SCENE_SPACE,
    SCENE_PLANE_YZ,
    SCENE_PLANE_XZ,
    SCENE_PLANE_XY
} scene_plane;
#define SCENE_PLANE_CHOICES "yz|xz|xy"

typedef enum scene_rotation {
    SCENE_ROTATION_SPATIAL,  /* three increments about fixed axes, each free or held (all held:
                                clamped) */
    SCENE_ROTATION_SEQUENCE, /* R = exp(axis_1 t_1) exp(axis_2 t_2) exp(axis_3 t_3); each angle
                                free, fixed or prescribed */
    SCENE_ROTATION_VECTOR, /* rotation vector = its three drivers' values: prescribed entirely, any
                              path */
    SCENE_ROTATION_FORK /* no turn about the section's own axis, the other two free: see scene_fork
                         */
} scene_rotation;

/* A rigid body that moves with a node. */
typedef struct scene_body {
    double mass;       /* [kg] */
    double centre[3];  /* of mass, from the node, undeformed [m] */
    double inertia[6]; /* of the undeformed body about its centre, about axes through it along x, y,
                          z: Ixx, Iyy, Izz = int (y^2 + z^2) dm ..., and the tensor's Ixy, Iyz, Izx
                          = -int x y dm ... [kg m^2] */
} scene_body;

typedef struct scene_node {
    double position[3]; /* [m] */
    int attached;       /* node this one is rigidly attached to (a rigid body is a node others are
                           attached to), or SCENE_NONE */
    int translation[3]; /* SCENE_FREE, SCENE_HELD or a driver */
    scene_rotation rotation;
    int angle[3]; /* SCENE_FREE, SCENE_HELD or a driver: of the spatial components, the angles or
                     the vector */
    double axis[3][3]; /* of the sequence; a zero axis ends it. Of a fork: the section's own axis,
                          and the web's direction */
    scene_body body;
    char name[SCENE_NAME]; /* "": none, as of every entry */
} scene_node;

/* Releases of an end of a member: components that are not transmitted to its node, in the member's
 * axes there (y as in scene_member): rotations, in their order, and translations.  The end is at r
 * + R_end s, R_end = R exp(a_1 t_1) exp(a_2 t_2) with the node's r, R: of two rotations the axis of
 * the first stays with the node, that of the second with the member (a universal joint),
 * translations are along the rotated end. Three rotations are those of a ball joint. */
enum { SCENE_RELEASED = 5 };
typedef struct scene_release {
    int count;                     /* 0: joined */
    int component[SCENE_RELEASED]; /* SCENE_UX .. SCENE_RZ, each once */
} scene_release;

typedef struct scene_member {
    int p, q;
    int section, section_q; /* at p and at q; between them it changes linearly in its numbers
                               (elements/section/section.h), each element has that of its middle */
    double y_axis[3]; /* direction of the y axis in which the section is described (its part across
                         the member) */
    int warp_p, warp_q;  /* SCENE_WARP_FREE, SCENE_WARP_FIXED or a shared name */
    double curvature[3]; /* initial torsion, curvatures about local y and z [1/m]; position of
                            interior nodes follows the arc */
    double bow[2];     /* amplitude of its initial shape beside its line, along y and z [m], free of
                          stress: bow sin(half_waves pi s/length) */
    int half_waves;    /* >= 1 */
    double strain[3];  /* initial elongation and shear strains that would leave no stress: heat, a
                          misfit */
    double pretension; /* axial force of the member as it is drawn [N], in place of strain */
    double unstressed_length; /* of it when it was made [m], in place of both; 0: as drawn */
    double free_curvature[2]; /* that would leave no stress, about y and z, beyond `curvature`
                                 [1/m] */
    scene_release release[2]; /* at p, q */
    double offset[2][3];      /* from the nodes p, q to its ends, which move with them rigidly;
                                 undeformed, in fixed axes [m] */
    double foundation[6]; /* springs to the ground along it, on the displacements and rotations of
                             its sections since the undeformed state, along its axes there, y
                             as above: they stay in space [N/m^2, N] */
    int divisions;        /* 0: the mesh's -n; else this many elements always */
    double damping;       /* of motions: stresses gain damping x stiffness at rest x rates of the
                             strains [s] */
    char name[SCENE_NAME];
} scene_member;

/* A force over a displacement, or a moment over a rotation: lines between points, the first and the
 * last one drawn on. */
typedef struct scene_table {
    scene_path at,
        value; /* ascending [m, rad], not falling, zero at zero [N, N m]; none: no table */
} scene_table;

/* Between two nodes, or a node and the ground: energy 1/2 d^T K d with d of the six components of
 * q's frame against p's since the undeformed state, in axes that rotate with p and were the fixed
 * ones: how far apart, from the initial distance [m], and the rotation vector [rad], of less than 3
 * rad. */
typedef struct scene_spring {
    int p, q;             /* p: SCENE_NONE: the ground */
    double stiffness[36]; /* K, symmetric, row-major [N/m, N, N m] */
    double asymmetry;     /* of K as it was given, relative to its diagonal: the mean is taken */
    double damping[36];   /* of motions: forces gain damping x rates of d; symmetric [N s/m, N s,
                             N m s] */
    double damping_asymmetry; /* likewise */
    scene_table table[6];     /* of its components, beside K */
    char name[SCENE_NAME];
} scene_spring;

/* One scalar that moves coordinates; piecewise linear in the path parameter between its stations.
 */
typedef struct scene_driver {
    char name[SCENE_NAME];
    int stations;
    double *path, *value; /* [stations]; value in m or rad; NULL: unknown, fixed by the condition */
    scene_function function; /* of time in place of them; no pieces: none */
    int condition_node,
        condition_component; /* unknown driver: this coordinate is prescribed instead, by ... */
    int condition_driver;    /* ... the value of this driver; SCENE_NONE for a known driver */
} scene_driver;

typedef enum scene_load_kind {
    SCENE_FORCE,              /* [N] at a node */
    SCENE_MOMENT,             /* [N m] at a node */
    SCENE_DISTRIBUTED,        /* [N/m] along a member, per initial length */
    SCENE_DISTRIBUTED_MOMENT, /* [N m/m] along a member */
    SCENE_GRAVITY,            /* [m/s^2] on the mass of a member */
    SCENE_WEIGHT,             /* [m/s^2] on the mass of the body of a node, at its centre */
    SCENE_MEMBER_FORCE,       /* [N] at a place within a member */
    SCENE_MEMBER_MOMENT,      /* [N m] at a place within a member */
    SCENE_TEMPERATURE         /* [K] of a member, by which it would expand */
} scene_load_kind;

/* Axes of a load: fixed, or those of its member before it is deformed, y as in scene_member. */
typedef enum scene_load_axes { SCENE_AXES_FIXED, SCENE_AXES_MEMBER } scene_load_axes;

typedef struct scene_load {
    scene_load_kind kind;
    int where;        /* node, or member: scene_load_along */
    double vector[3]; /* in `axes`, of the undeformed structure; at range[0] where it varies */
    double last[3];   /* where it varies: at range[1], linear between */
    int varies;       /* 0: the vector is the same all over the range */
    double range[2]; /* of a member, relative to its initial length from p: where a distributed load
                        begins and ends (0 and 1: all of it, as of gravity); of a force or a moment
                        at a place both are that place. 0 and 0 of loads at nodes */
    int lumped;      /* of loads along a member: 0: it does its work on the displacements within the
                        elements; 1: an element's share goes to its nodes, halves to both, of order
                        two */
    double at[3];    /* of forces, in `axes`: where they act, from the node or the centroids, with
                            which it turns [m] */
    double temperature, gradient[2]; /* of SCENE_TEMPERATURE, whose vector is 0: change at the
                                        centroids [K]; of it along y and z of the section as it is
                                        described [K/m] */
    scene_load_axes axes;            /* of both */
    int follower; /* 0: its direction stays (dead); 1: it turns with the node or the sections */
    int stations; /* 0: proportional to the path parameter (factor = path) */
    double *path, *factor;
    scene_function function; /* the factor over time in place of them; no pieces: none */
    char name[SCENE_NAME];
} scene_load;

/* Name and computed constants of a section, and the description that they were computed from. */
typedef struct scene_computed {
    int known;
    section_spec of;
    section constants;
    char name[SCENE_NAME];
} scene_computed;

/* Physics that a scene may leave out: FEATURE_* bits. */
enum {
    SCENE_OMITTABLE = FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_MOMENTS |
                      FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA | FEATURE_WARPING
};

/* Theory of shear in stability that a scene asks for. */
typedef enum scene_shear {
    SCENE_SHEAR_HARINGX,
    SCENE_SHEAR_ENGESSER,
    SCENE_SHEAR_OWN /* of each formulation the one that it has */
} scene_shear;
/* Theories of shear in stability on which a reference value can depend. */
#define SCENE_SHEAR_THEORIES "engesser|haringx"

/* The name of an entry, in a message. */
typedef struct scene_words {
    char text[SCENE_NAME + 16];
} scene_words;

struct scene {
    char name[SCENE_NAME];
    int sections, nodes, members, springs, drivers, loads, analyses, quantities;
    section_spec *section;
    int computeds;
    scene_computed *computed; /* [computeds] kept by scene_constants */
    scene_node *node;
    scene_member *member;
    scene_spring *spring;
    scene_driver *driver;
    scene_load *load;
    scene_analysis *analysis;
    scene_quantity *quantity;
    scene_plane plane; /* that all is fixed in; SCENE_SPACE: none */
    unsigned omits;    /* of SCENE_OMITTABLE what the scene leaves out: scene_omit sets them */
    unsigned demands;  /* FEATURE_* bits beyond what its data call for: scene_demand sets them */
    scene_shear shear_theory;
    int lumped; /* 1: the mass of members is at nodes, but in motions that say otherwise */
    int meshes; /* default -n values of verify and converge */
    int mesh[SCENE_MESHES];
    int out_of_memory;
    /* Target of pointers after memory ran out, so that a case can write without checks. */
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
                     const double y_axis[3]); /* profile: a section of the scene, at both ends */
/* Elongation that a member of that length [m] would have without stress, by its pretension or its
 * unstressed length. REFUSED: a pretension that its section does not give an elongation. */
status scene_member_elongation(const scene *s, int member, double length, double *out, fault *f);
/* Has it one, or a curvature that it would have without stress? */
int scene_member_is_free(const scene_member *m);
/* Is there such a member, or a temperature?  who: it; NULL: not wanted. */
int scene_is_free(const scene *s, scene_words *who);
/* Does its section change along it?  Does that of any member? */
int scene_member_tapers(const scene_member *m);
int scene_tapers(const scene *s);
/* Where the end of a member (0 at p, 1 at q) is, and from its start to its end. */
void scene_end(const scene *s, int member, int end, double at[3]);
void scene_chord(const scene *s, int member, double chord[3]);
/* Is an end of it beside its node? */
int scene_is_beside(const scene_member *m, int end);
int scene_is_founded(const scene_member *m);
/* A table of one of its components. */
void scene_set_table(scene *s, int spring, int component, int points, const double at[],
                     const double value[]);
/* What a table of a spring gives at x; *slope: of its line there, at a point of the next one. */
double scene_table_at(const scene_table *, double x, double *slope);
/* Its integral from one place to another. */
double scene_table_work(const scene_table *, double from, double to);
/* The component whose table has a kink at zero, so that it has no stiffness at rest; SCENE_NONE. */
int scene_spring_kink(const scene_spring *);
/* The end of a member (0 at p, 1 at q) does not transmit this component. It is added to those of
 * earlier calls; more than SCENE_RELEASED are refused by scene_validate. */
void scene_release_end(scene *s, int member, int end, int component);
int scene_add_spring(scene *s, int p, int q, const double stiffness[36]);
/* Makes it a dashpot too. */
void scene_damp_spring(scene *s, int spring, const double damping[36]);
int scene_spring_damps(const scene_spring *);
int scene_add_driver(scene *s, const char *name, int stations, const double path[],
                     const double value[]);
/* A driver by a function of time, to be given in pieces. */
int scene_add_moving_driver(scene *s, const char *name);
/* A piece of the function of a driver or of the factor of a load, after those that it has; until
 * [s]: of the last one for ever. */
void scene_drive_piece(scene *s, int driver, double until, const char *text);
void scene_load_piece(scene *s, int load, double until, const char *text);
int scene_add_unknown_driver(scene *s, const char *name, int node, int component,
                             int condition_driver);
/* A load that stays, all along its member where it is distributed. */
scene_load scene_load_of(scene_load_kind kind, int where, double x, double y, double z);
int scene_add_load(scene *s, scene_load_kind kind, int where, double x, double y, double z);
/* A force or a moment within a member: place: 0 at p .. 1 at q, of the initial length. */
int scene_add_load_within(scene *s, scene_load_kind kind, int member, double place, double x,
                          double y, double z);
/* Entry of the list, to say more of it; never NULL. */
scene_load *scene_load_at(scene *s, int index);
/* Is it of a member: along it, or at a place within it? */
int scene_load_along(const scene_load *load);
/* At a place within a member? */
int scene_load_within(const scene_load *load);
/* Is its vector a moment, not a force? */
int scene_load_turns(const scene_load *load);
/* Is it not zero all over its range? */
int scene_load_acts(const scene_load *load);
/* May its stiffness make a tangent unsymmetric? Not that of a load of zero. */
int scene_load_unsymmetric(const scene_load *load);
/* The load is its vector times a factor, piecewise linear over the path parameter. */
void scene_set_factor(scene *s, int load, int stations, const double path[], const double factor[]);
/* Entry of a list, to be filled further; never NULL. */
scene_node *scene_node_at(scene *s, int index);
scene_member *scene_member_at(scene *s, int index);
void scene_hold(scene *s, int node, int first,
                int last); /* components SCENE_UX .. SCENE_RZ, inclusive */
void scene_hold_all(scene *s, int node);
void scene_drive(scene *s, int node, int component,
                 int driver); /* a translation, or a spatial rotation component */
/* A fork: its guides are on both sides of the web, and their normal n = web x axis is fixed.  The
 * web stays between them, R web . n = 0, whichever way the section is bent: R = exp(n t_1) exp(web
 * t_2).  While the bending is in the plane of axis and web, the section does not turn about its own
 * present axis, R axis, and the fork's moment is along it.  (A held SCENE_RX is a moment along the
 * fixed x axis.) axis, web: of the undeformed section, at right angles, of any length. Translations
 * are fixed by themselves. */
void scene_fork(scene *s, int node, const double axis[3], const double web[3]);
/* A body of its own, at the node itself or beside it, rigidly joined to it. */
void scene_set_body(scene *s, int node, scene_body body);
/* Has the node a mass or an inertia? */
int scene_has_body(const scene_node *n);
/* Has anything? */
int scene_has_mass(const scene *s);
/* Turns of a node that all its members release and nothing else meets, so that it has no angle of
 * its own there and is fixed: 0: none; SCENE_IDLE_AXIS: about `axis`, which turns with it. */
enum { SCENE_IDLE_AXIS = 1, SCENE_IDLE_ALL };
int scene_idle_turn(const scene *s, int node, double axis[3]);
/* Convention of moments that a quantity depends on, or NULL. */
const char *scene_convention(const scene *s, const scene_quantity *q);
/* The axis across the plane that the scene is fixed in, 0 to 2, or SCENE_NONE. */
int scene_normal(const scene *s);
/* "xy"; "" in space. */
const char *scene_plane_name(const scene *s);
/* Leaves physics (bits of SCENE_OMITTABLE) out. A scene has all that its sections, loads and
 * analyses call for, but for this. */
void scene_omit(scene *s, unsigned features);
/* FEATURE_* bits that a formulation must offer beyond what the data call for. */
void scene_demand(scene *s, unsigned features);
void scene_meshes(scene *s, int count, const int mesh[]);
/* first, twice that, and so on up to last. */
void scene_meshes_doubled(scene *s, int first, int last);

/* Constants of section i; computed once, and again when its description has changed. Not
 * thread-safe. */
status scene_constants(const scene *s, int i, section *out, fault *f);

/* Indices in range, members of positive length, supports that do not contradict, drivers that are
 * used, curves and names unique: refused with the culprit. */
status scene_validate(const scene *s, fault *f);

/* Values along the path of a static analysis: on a line from station to station, before the first
 * and after the last as there. */

/* Factor of the load at a path parameter; without stations the parameter itself. */
double along_path_factor(const scene_load *, double path);
/* Derivative of that by the path parameter; at a station: of what follows. */
double along_path_rate(const scene_load *, double path);
/* Value of a known driver [m or rad]. */
double along_path_value(const scene_driver *, double path);
/* For messages, and empty where loads change however far the path goes: "; nothing changes outside
 * path 0 to 1 ...". */
typedef struct along_path_words {
    char text[256];
} along_path_words;
along_path_words along_path_end(const scene *);
/* REFUSED: something does not change in proportion from path 0 to 1. */
status along_path_proportional(const scene *, fault *);

/* Changes of a scene that must not change its answer: for checks that need no truth. */

typedef enum scene_edit_kind {
    SCENE_EDIT_NONE,
    SCENE_EDIT_REVERSE, /* every member runs from its q to its p */
    SCENE_EDIT_SPLIT,   /* the first member becomes two, that meet at `amount` of its length */
    SCENE_EDIT_UNIT /* all lengths in another unit, `amount` of them to the metre; quantities are
                       still reported in metres */
} scene_edit_kind;

typedef struct scene_edit {
    scene_edit_kind kind;
    double amount; /* fraction of the length, 0 .. 1; or units in 1 m */
} scene_edit;

/* REFUSED: a member that the change is not defined for. */
status scene_edit_apply(scene *s, const scene_edit *edit, fault *f);

/* Names of entries of a scene: as the user named them, or by their number. */

typedef enum scene_list {
    SCENE_SECTIONS,
    SCENE_NODES,
    SCENE_MEMBERS,
    SCENE_SPRINGS,
    SCENE_DRIVERS,
    SCENE_LOADS,
    SCENE_ANALYSES,
    SCENE_QUANTITIES
} scene_list;
enum { SCENE_LISTS = SCENE_QUANTITIES + 1 };

/* How many entries the list has; "node". */
int scene_count(const scene *s, scene_list list);
const char *scene_list_word(scene_list list);
/* A longer name is cut off; where there is no such entry nothing is done. */
void scene_set_name(scene *s, scene_list list, int index, const char *name);
/* "" where it has none, or is no entry. */
const char *scene_own_name(const scene *s, scene_list list, int index);
/* "node_3", which no other entry of the list is called. */
scene_words scene_numbered(const scene *s, scene_list list, int index);
/* "tip"; without a name by its number. */
scene_words scene_name(const scene *s, scene_list list, int index);
/* For messages: "node tip", without a name "node 3". */
scene_words scene_called(const scene *s, scene_list list, int index);

/* Tables of the keys of entries of a scene: a line for each key, with what a file calls it, where
 * its value is, its unit and its range.  From these lines a file is read, checked, described and
 * written, other units are taken, members are reversed, and scenes are compared. */

typedef enum entry_kind {
    ENTRY_TEXT,      /* any text */
    ENTRY_NAME,      /* of another entry: int, its index, or SCENE_NONE */
    ENTRY_WORD,      /* one of `words`, or a parameter with such choices: int; double: left as it is
                        where the key is not there */
    ENTRY_FLAG,      /* one of `words`, those with an odd index mean 1: int */
    ENTRY_WORDS,     /* one or a list of them: unsigned, a bit for each */
    ENTRY_NUMBER,    /* an expression: double */
    ENTRY_WHOLE,     /* one without a fraction: int */
    ENTRY_VECTOR,    /* a list of `count` expressions: double[] */
    ENTRY_DIRECTION, /* one of three, which turns with the part it is in */
    ENTRY_POSITION,  /* one of three, which is placed with the part it is in */
    ENTRY_NUMBERS,   /* a list of any length, or a range: scene_path */
    ENTRY_FORMS,     /* several forms, as the summary says */
    ENTRY_MAP,       /* a map with the keys `below`, whose values are in the same struct */
    ENTRY_ENTRIES,   /* names, each with such a map */
    ENTRY_LIST,      /* a list of such maps */
    ENTRY_NAMES,     /* user-defined names, each with one value as described by `below` (its
                        first key) */
    ENTRY_LATER      /* has a meaning, but is not carried yet */
} entry_kind;

/* How a word turns with the axes. */
typedef enum entry_turns {
    ENTRY_STAYS,
    ENTRY_COMPONENT, /* as a displacement or a rotation along them */
    ENTRY_AXIS,      /* as a direction */
    ENTRY_DIAGONAL   /* as a component; what it is of keeps its sign */
} entry_turns;

enum { ENTRY_MOST_ORDER = 100000 }; /* of an eigenvalue, a point, a crossing */

struct quantity_type;

typedef struct entry_field {
    const char *name; /* NULL ends a table */
    entry_kind kind;
    int needed; /* 1: must be there */
    int group; /* keys of one group > 0 exclude each other; with `needed`, one of them must be there
                */
    int count;
    const char *words; /* "a|b|c" */
    const struct entry_field *below;
    /* of a number: gives the power of length and of force by which it is scaled; others: for the
     * reader */
    const char *unit, *summary;
    /* Default of every optional key: the value in the words of the file, or what happens without
     * the key. */
    const char *usual, *left_out;
    /* Where its value is in the struct of the entry: ENTRY_IN. size 0: none; special functions read
     * and write it. For a map: place of the int that chooses the member of a group. */
    size_t at, size;
    int first, falls;   /* value of the first word, or of the map; by how much the next is lower */
    double otherwise;   /* numeric default, where `usual` does not give it; NAN: none */
    double least, most; /* range of a number; both 0: any */
    const char *range;  /* in words; NULL: by these two */
    scene_list of;      /* NAME: in which list */
    size_t zeros;       /* of the unsigned in which the bit `zero` says that a zero is given */
    unsigned zero;      /* 0: there is no such bit */
    int always;         /* 1: written also where it is the default */
    entry_turns turns;
    const struct quantity_type *type; /* of a map: what says its summary, keys and value */
    const char *mirrors; /* "++-": signs of its numbers when the ends of its member are exchanged */
} entry_field;

#define ENTRY_IN(type, member) .at = offsetof(type, member), .size = sizeof(((type *)0)->member)

#define ENTRY_COMPONENTS "ux|uy|uz|rx|ry|rz"

extern const entry_field entry_section[], entry_node[], entry_member[], entry_spring[],
    entry_driver[], entry_load[], entry_analysis[], entry_quantity[];

/* The key of the vector of a load: "force", with its unit. */
const entry_field *entry_of_load(scene_load_kind);

/* Keys of a map; summary of any key. */
const entry_field *entry_below(const entry_field *);
const char *entry_summary(const entry_field *);
/* Default of a numeric key. */
double entry_usual(const entry_field *);
/* For a word: the int of that index, its index, and the int that it stands for. */
int entry_value(const entry_field *, int index);
int entry_index(const entry_field *, int value);
int entry_word(const entry_field *, const char *word);
/* 1: the value is the default. */
int entry_is_usual(const entry_field *, const void *entry);
/* For a map in a group: 1: it is the one that is given. For others: 1. */
int entry_stands(const entry_field *, const void *entry);
/* "at least 0" */
const char *entry_range(const entry_field *, char text[FAULT_TEXT]);
int entry_in_range(const entry_field *, double value);
/* REFUSED: a value is not numeric or out of its range ("damping = -1; give at least 0"), a name is
 * that of no entry, a word is none of its words. */
status entry_check(const scene *s, const entry_field *table, const void *entry, fault *f);

typedef enum entry_base { ENTRY_LENGTH, ENTRY_FORCE } entry_base;
/* Power of length or force in a unit, seconds and angles kept: of "kg/m^3" -4 and 1. */
int entry_power(const char *unit, entry_base);
/* All numbers that have a unit, when there are `times` of one base unit in its place. */
void entry_scale(const entry_field *table, void *entry, entry_base, double times);
/* Its member's ends are exchanged. */
void entry_mirror(const entry_field *table, void *entry);
/* Bit for bit, but for what functions of its own read and write. */
int entry_same(const entry_field *table, const void *a, const void *b);

/* Which entries of a scene affect which analysis: the only place that determines it, by which
 * analyses are refused, `beamwork explain inputs` is printed, and a test walks all cells. */

/* As which an analysis counts: eigenvalues and compliances about a loaded state are others than
 * those about the undeformed one. */
typedef enum scene_column {
    SCENE_OF_LINEAR,
    SCENE_OF_STATIC,
    SCENE_OF_CONTINUATION,
    SCENE_OF_BUCKLING,
    SCENE_OF_BUCKLING_ABOUT,
    SCENE_OF_MODAL,
    SCENE_OF_MODAL_LINEAR,
    SCENE_OF_MODAL_ABOUT,
    SCENE_OF_COMPLIANCE,
    SCENE_OF_COMPLIANCE_ABOUT,
    SCENE_OF_ROTATION,
    SCENE_OF_MOTION,
    SCENE_COLUMNS
} scene_column;

typedef enum scene_part {
    SCENE_PART_USED = 'u',
    SCENE_PART_STATE = 's', /* used; refused in a state where the tangent is not symmetric */
    /* used in rotating axes, and about a path where the tangent is not symmetric, so that what is
     * in motion decides about stability; else it has no part */
    SCENE_PART_INERTIA = 'i',
    SCENE_PART_NONE = '-',   /* by what the analysis is: the answer is the same without */
    SCENE_PART_REFUSED = 'x' /* by name, that analysis alone */
} scene_part;

typedef struct scene_input {
    const char *name;                   /* "loads that follow" */
    const char part[SCENE_COLUMNS + 1]; /* scene_part */
    const char *why;                    /* it is refused, and what helps; NULL: it is nowhere */
    /* 1: the scene, or that analysis, has it; who: "load p". */
    int (*stands)(const scene *, int analysis, char *who, int size);
} scene_input;

/* The table; one without a name ends it. */
extern const scene_input scene_inputs[];
/* "buckling about a path" */
extern const char *const scene_column_name[SCENE_COLUMNS];

scene_column scene_column_of(const scene *, int analysis);
/* 1: it is about a state, and the scene has something that makes the tangent of some states not
 * symmetric: then masses decide about stability. */
int scene_inputs_flutter(const scene *, int analysis);
/* REFUSED: the analysis cannot have something that the scene has; the others may. */
status scene_inputs_check(const scene *, int analysis, fault *);

/* Lists of a scene, for the files that add to them. */

/* Room for one more entry of `list` (the address of its pointer), zeroed: its index, or -1. */
int scene_grow(scene *s, void *list, int *count, size_t size);
/* A copy [n] of numbers; NULL: memory ran out. */
double *scene_copy(scene *s, int n, const double from[]);

/* Parts of the words of a quantity: nodes, members, coordinates and ordinals. */

/* " of node_1 (0.1, 0, 0)" after the preposition. */
void meaning_node(FILE *to, const scene *s, const char *preposition, int node);
/* " of member_0 (node_0 to node_1)" */
void meaning_member(FILE *to, const scene *s, int member);
/* " at the end", " at 0.5 of the length": before: of what jumps there. */
void meaning_place(FILE *to, double where, int before);
/* "x" of SCENE_UX and SCENE_RX. */
char meaning_axis(int component);
/* "force along", "moment about". */
const char *meaning_load(int component);
/* "first", "second", ... of 0, 1, ... */
void meaning_ordinal(FILE *to, int order);
/* "displacement of node_1 (...) along x", "rotation of ... about x". */
void meaning_coordinate(FILE *to, const scene *s, int node, int component);

/* Words of the physics that a scene may leave out, as scene files have them. */

typedef struct scene_omission {
    unsigned feature; /* a bit of SCENE_OMITTABLE */
    const char *word;
} scene_omission;

/* All of them, in the order in which they are written, up to a word of NULL. */
extern const scene_omission scene_omissions[];

enum { SCENE_OMISSION_WORDS = 100 };
/* "shear, trapeze"; empty where there are none. */
void scene_omission_words(unsigned omits, char words[SCENE_OMISSION_WORDS]);

/* "haringx" */
const char *scene_shear_word(scene_shear theory);

/* A kind of quantity: all that is to be said of it. One file each in cases/quantities: the build
 * finds it. */

/* Values that a kind reads: of one state of a structure. Those below `path` are of the kinds that
 * ask for them (scene_quantity_kind); NAN: not known, which whoever asks for the quantity says. */
typedef struct quantity_state {
    /* displacement [m] or rotation-vector component [rad]; NAN: it has lost its direction */
    double (*component)(const struct quantity_state *, int node, int component);
    /* the same in the axes of another node */
    double (*relative)(const struct quantity_state *, int from, int node, int component);
    /* place [m], and rotation matrix by rows */
    void (*frame)(const struct quantity_state *, int node, double place[3], double R[9]);
    /* of a motion in time: velocity [m/s], or angular velocity in the node's own axes [rad/s] */
    double (*rate)(const struct quantity_state *, int node, int component);
    /* its derivative: acceleration [m/s^2], or angular one in the node's own axes [rad/s^2] */
    double (*acceleration)(const struct quantity_state *, int node, int component);
    double (*driver)(const struct quantity_state *, int driver);
    double path; /* parameter, load factor or time */
    /* SCENE_REACTION, SCENE_INTERNAL, SCENE_STRESS: any of these */
    double (*reaction)(const struct quantity_state *, int node, int component);
    double (*internal)(const struct quantity_state *, const scene_internal *);
    double (*stress)(const struct quantity_state *, const scene_stress *);
    /* SCENE_BALANCE */
    double (*balance)(const struct quantity_state *, scene_balance);
    /* SCENE_COMPLIANCE_ENTRY, SCENE_STIFFNESS_ENTRY: in the column of its entry */
    double (*compliance)(const struct quantity_state *, int row, int column);
} quantity_state;

/* Eigenvalue of the mode that is asked for. */
typedef struct quantity_eigenvalue {
    double value; /* SCENE_CRITICAL_FACTOR: load factor; SCENE_FREQUENCY, SCENE_DAMPING_RATIO:
                     angular frequency [rad/s] */
    double decay; /* of a damped mode: its rate [1/s] */
} quantity_eigenvalue;

/* Events that are evaluated between the stations of a motion. */
typedef enum quantity_passing {
    QUANTITY_AT_STATIONS,
    QUANTITY_EXTREMES, /* the largest and the least value */
    QUANTITY_CROSSINGS /* these, and when a level is passed */
} quantity_passing;

typedef struct quantity_type {
    const char *key, *summary;
    /* SCENE_READING, of nodes alone; or one of the others: its struct, and what an analysis is
     * asked for; several files may have the same */
    scene_quantity_kind kind;
    const entry_field *field; /* of the map below the key */
    unsigned analyses;        /* 1 << kind of analysis: those that have it */
    quantity_passing passing;
    /* of the value where nothing else is said; gives its powers of length and force */
    const char *(*unit)(const scene *, const scene_quantity *);
    /* In words; names_analysis: also of which analysis. */
    void (*meaning)(FILE *, const scene *, const scene_quantity *);
    int names_analysis;
    /* As extracted, without factor and offset: from a state, or from an eigenvalue, where *part is
     * what of it the error of the quantity is of. */
    double (*read)(const scene_quantity *, const quantity_state *);
    double (*eigenvalue)(const scene_quantity *, const quantity_eigenvalue *, double *part);
    /* NULL of most: the components of turns that it needs, where nodes may turn by themselves: 1:
     * *out is the one of index i, 0: there are no more; what follows from what is read of a file:
     * what is wrong with the key, or NULL; REFUSED: what the table does not say. */
    int (*turns)(const scene *, const scene_quantity *, int i, scene_component *out);
    const char *(*settle)(const scene *, scene_quantity *, const char **key);
    status (*check)(const scene *, const scene_quantity *, fault *);
} quantity_type;

const quantity_type *quantity_type_of(const scene_quantity *q);
/* Makes it one, to be filled. */
void quantity_type_begin(const quantity_type *, scene_quantity *q);

/* Keys of most kinds: first, and last. */
#define QUANTITY_ANALYSIS                                                                          \
    {"analysis",                                                                                   \
     ENTRY_NAME,                                                                                   \
     .needed = 1,                                                                                  \
     .summary = "analysis",                                                                        \
     ENTRY_IN(scene_quantity, analysis),                                                           \
     .of = SCENE_ANALYSES}
#define QUANTITY_TAKEN                                                                             \
    {"at", ENTRY_NUMBER, .group = 1, .summary = "station", .left_out = "as take says"},            \
        {"take",                                                                                   \
         ENTRY_WORD,                                                                               \
         .group = 1,                                                                               \
         .words = SCENE_TAKE_CHOICES,                                                              \
         .summary = "of all stations",                                                             \
         .usual = "last"}
#define QUANTITY_MODE                                                                              \
    {"which",                                                                                      \
     ENTRY_WHOLE,                                                                                  \
     .summary = "counted from 0, of the family",                                                   \
     .usual = "0",                                                                                 \
     ENTRY_IN(scene_quantity, what.of.mode.order),                                                 \
     .most = ENTRY_MOST_ORDER},                                                                    \
        {"family",                                                                                 \
         ENTRY_WORD,                                                                               \
         .words = "any|not_axial|axial|bending_y|bending_z|torsion",                               \
         .summary = "of modes",                                                                    \
         .usual = "any",                                                                           \
         ENTRY_IN(scene_quantity, what.of.mode.family),                                            \
         .always = 1},                                                                             \
    {                                                                                              \
        "half_waves", ENTRY_WHOLE, .summary = "of the mode; 0: any", .usual = "0",                 \
            ENTRY_IN(scene_quantity, what.of.mode.half_waves), .most = ENTRY_MOST_ORDER            \
    }
#define QUANTITY_NODE(member)                                                                      \
    {"node",                                                                                       \
     ENTRY_NAME,                                                                                   \
     .needed = 1,                                                                                  \
     .summary = "node",                                                                            \
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
/* A place of a member, and its side. */
#define QUANTITY_SIDE(member)                                                                      \
    {"side",                                                                                       \
     ENTRY_WORD,                                                                                   \
     .words = "from|to",                                                                           \
     .summary = "of 'where', towards that node: resultants jump where a "                          \
                "load acts",                                                                       \
     .usual = "to",                                                                                \
     ENTRY_IN(scene_quantity, what.of.member),                                                     \
     .first = 1,                                                                                   \
     .falls = 1}
#define QUANTITY_ALL_STATES                                                                        \
    (1u << SCENE_STATIC | 1u << SCENE_MOTION | 1u << SCENE_CONTINUATION | 1u << SCENE_ROTATION)

/* A scene in another unit of length. */

/* All lengths in a unit of which there are x in 1 m, x > 0; newtons and seconds stay, so that
 * masses are divided by x. Quantities are reported as before. REFUSED: x is no such
 * number, or a driver moves lengths and angles at once. */
status scene_change_unit(scene *s, double x, fault *f);
/* All forces in a unit of which there are y in 1 N, masses alike; metres and seconds stay.
 * Quantities are reported as before. */
void scene_change_force(scene *s, double y);
/* Do the numbers look like those of another system than SI?  Says which, and why; 0: no. Of scenes
 * without dimensions nothing is said. */
int scene_looks_foreign(const scene *s, char words[FAULT_TEXT]);

/* Warping at an end of a member, where the scene does not specify it. */

/* Warping of an end of a member that has not been specified yet. */
enum { SCENE_WARP_BY_SUPPORT = -3 };

/* Sets the warping of every end that is SCENE_WARP_BY_SUPPORT. Fixed: all six components of its
 * node are fixed or prescribed, or the node is part of a rigid body, or one that members or springs
 * are joined to at other nodes too. Free: a rotation is released there, or the node is a fork, is
 * free or has only a mass. Where exactly two members meet at such a node and continue in one line
 * with one section in the same axes, without releases and without specified warping, they share it:
 * a node does not cut a beam. */
void scene_warping_by_supports(scene *s);

#endif
