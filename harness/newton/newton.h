#ifndef BEAMWORK_NEWTON_H
#define BEAMWORK_NEWTON_H

#include <math.h>
#include <stdint.h>

#include "cases/scene/scene.h"
#include "elements/section/stress.h"
#include "elements/shared/status.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/numerics/numerics.h"
#include "harness/section_forces/section_forces.h"

/* Equations of a model under a loading, and the data of a run that do not belong to a state. */

typedef struct counters {
    long strain_evaluations, stress_evaluations, inertia_evaluations;
    long geometric_evaluations; /* evaluations of geometric stiffness */
    long iterations, steps, rejected_steps, factorisations;
    numerics_work numerics;
    long negative_pivots; /* largest number of negative pivots of a symmetric tangent at an
                             accepted state */
    /* largest condition estimate of the solved systems (factor_condition); 0: not requested */
    double condition;
} counters;

typedef struct run_undeformed {
    /* [elements] index of the values of an element, or NONE; NULL: no values are stored */
    int *of;
    int count, room; /* number of stored elements, and capacity */
    int last;        /* element of the last values */
    double *value;   /* [room x (J, C, initial stresses)] */
} run_undeformed;

/* Data of all elements that linearise_state passes to advance_state. */
typedef struct linear_memory {
    /* [elements x model.work_size] J, C, P' + C (D - e), D - e, the memory of the type, and the
     * numbers of the enumeration with SLOT_TAKES (model.h), all of the last linearisation */
    double *slot;
} linear_memory;

typedef struct loading {
    /* 1: the path parameter is the time, and loads and drivers are functions of time */
    int in_time;
    double held_path; /* path parameter of loads and drivers that are not functions of time */
    int unloaded;     /* 1: there are no loads, and all drivers are zero */
    int acting;       /* active loads, numbered as by scene_acting_of */
    int lumps;
    /* rotating axes; for a path of rotation, the angular velocity is multiplied by the path
     * parameter */
    element_rotating_frame frame;
    int rotates, rotation_follows_path;
} loading;

/* During a motion, damping adds V e' to the stresses of elements and C e' to those of dashpots. V
 * is eta S0 (eta: damping of the member, S0: stiffness of the undeformed element) plus the matrix
 * of the formulation (element_type.damping). See harness/time/time.h. */
typedef struct run_damping {
    int *which;      /* [elements] index of the matrix V of the element; NONE: not damped */
    double *matrix;  /* [matrices x strains^2] V */
    double *slowest; /* [matrices] [s] largest V_kk/S0_kk, a relaxation time */
    double *none;    /* [model_stresses] zeros */
    double *begin;   /* [model_stresses] strains of the state from which rates are computed */
    double g;        /* e' = known + g (e - from) */
    const double *known, *from; /* [model_stresses] */
    spring_rates springs;       /* strain rates of springs */
} run_damping;

struct run_ahead;
struct run_free;
struct element_part;

typedef struct run_state {
    assemble_patterns *patterns; /* patterns of the matrices of the model, created on request */
    counters counters;
    phases phases;
    thread_pool *pool;         /* threads for the loop over elements; NULL: one thread */
    struct element_part *part; /* equations of a batch of elements, before they are added in order;
                                  NULL: not allocated */
    struct run_ahead *ahead;   /* batch of elements in one memory block (newton_impl.h); NULL: no
                                  batch has been evaluated */
    run_undeformed undeformed;
    /* data for free strains (free_strain.c); NULL: the type does not modify its data */
    struct run_free *free_strain;
    run_damping *damping; /* damping of a motion; NULL: none */
    /* [loads] factors of loads with feedback in the evaluated state, set by feedback_take
     * (harness/time); NULL: no motion has started */
    double *feedback;
    linear_memory memory;
} run_state;

typedef struct equations {
    const model *m;
    loading loading;
    run_state *run;
} equations;

/* Returns the damping matrix V [strains x strains] of an element; NULL: the element is not damped.
 */
static inline const double *run_damping_of(const run_damping *d, const model *m, int element)
{
    const size_t n = (size_t)model_strains(m);
    return d == NULL || d->which[element] == NONE ? NULL
                                                  : d->matrix + (size_t)d->which[element] * n * n;
}

status linear_memory_alloc(const model *, linear_memory *, fault *);
void linear_memory_free(linear_memory *);

/* Starts a run of a model. threads: number of threads for the loop over elements; 0 or 1: one
 * thread. Results do not depend on the number of threads, because sums have a fixed order. */
status run_state_begin(run_state *, const model *, int threads, fault *);
void run_state_end(run_state *);

typedef struct advance_stress {
    double largest, change; /* largest stress after the update, and largest change of a stress */
} advance_stress;

/* Adds the increments to the strains, stresses and inner unknowns of every element, then to the
 * frames. Returns the largest correction (dimensionless: translations relative to model_length,
 * rotations in rad, warping amplitudes times model_length, inner unknowns as the element
 * defines). */
double advance_state(const equations *, const linear_memory *, model_state *, const double dx[],
                     double path, advance_stress *);
/* Returns 1 if no constraint acts on the translations of a vertex. */
int advance_is_free(const model *, int vertex);
/* Returns 1 if increments move free vertices along arcs of screw motions, not along straight lines.
 * Conditions: a static state with prescribed motions, a free body with rigid arms, and no hinges.
 * The ends of arms move along arcs; if the next vertex moved along a line, the strain of the
 * element between them would be inversely proportional to its length. At a hinge, both sides move
 * along different arcs. Under loads, increments of rotations may be far too large, and lines need
 * fewer iterations. */
int advance_on_arcs(const equations *);
void advance_settle(const model *, const linear_memory *, const model_state *);

typedef struct applied {
    int vertex;
    int follower; /* 1: F rotates with the vertex */
    int offset;   /* 1: arm is not zero */
    double F[6];  /* force and spatial moment [N, N m] */
    /* [m] vector from the vertex to the point of application; the vector rotates with the vertex */
    double arm[3];
} applied;

/* Returns the factor of the load at `path` (a path parameter or a time, see loading_of), including
 * the factor of the load case. applied_rate returns the derivative of this factor. */
double applied_factor(const equations *, const scene_load *load, double path);
double applied_rate(const equations *, const scene_load *load, double path);
/* Calls `take` with each nodal force of the load times `scale`. Loads along members are lumped at
 * the nodes of elements by the polynomials through these nodes; the loads of applied_with_mass are
 * instead divided like the mass. */
void applied_each(const model *, const model_state *, const scene_load *, double scale,
                  void (*take)(void *context, const applied *), void *context);

/* All members except `stress` are dimensionless. */
typedef struct newton_convergence {
    double criterion; /* requested limit of the correction; 0: determined by rounding */
    double small;     /* a step ends after two successive corrections below this limit */
    /* last correction, and previous correction in the same step (INFINITY: none) */
    double correction, before;
    double stress; /* [N] largest stress on the path so far */
    double
        stress_change; /* largest change of a stress in the last correction, relative to `stress` */
    /* last ratio of the larger of a correction and its relative change of stresses to the square of
     * the previous correction; NAN: none */
    double contraction;
    double remaining; /* predicted size of the next correction; NAN: unknown */
} newton_convergence;

/* Starts the history. differences 1: derivatives are computed by finite differences, whose noise
 * prevents quadratic convergence. elements: number of elements. */
void newton_convergence_start(double criterion, int differences, int elements,
                              newton_convergence *);
/* Returns 1 if the last change of the state was negligible, so that the last tangent is accurate to
 * rounding error. */
int newton_convergence_tangent_stands(const newton_convergence *);

typedef struct condensation condensation;

typedef struct mode_shape {
    scene_family family;
    int half_waves;
} mode_shape;
status modes_identify(const model *, const scene *, const double mode[], mode_shape *, fault *);
int modes_in_family(const scene_mode *, const mode_shape *);
const char *modes_family_name(scene_family);
/* Sets *kind to flexural, torsional or flexural-torsional, according to the motion of shear centres
 * across members and the twist of sections. */
status modes_kind(const model *, const scene *, const double mode[], const char **kind, fault *);
/* Separates modes with equal value[count], which may be arbitrary mixtures, into modes with the
 * largest and with the smallest motion along the z axes of members. The modes are stored one after
 * the other, each with n = free + driven entries. */
status modes_separate(const model *, const scene *, int count, const double value[], size_t n,
                      double *mode, fault *);

/* Critical loads of one sign, or circular frequencies [rad/s], with their modes, in ascending order
 * of magnitude. */
typedef struct outcome_side {
    int count;
    /* [count] values (NAN: rounding errors leave no correct digit); [count x free] modes */
    double *value, *mode;
    double *error; /* [count] estimated relative errors due to iteration and rounding; NULL: none */
    /* [count] kinds of the first `identified` modes, which quantities request; NULL: of none */
    mode_shape *shape;
    int identified;
    /* [count] growth rates of damped modes [1/s] (`error` then refers to growth + i value); NULL:
     * undamped */
    double *growth;
    status status;           /* NOT_CONVERGED: some values are missing or have no correct digit */
    char reason[FAULT_TEXT]; /* reason for NOT_CONVERGED */
} outcome_side;
typedef struct rotation_modes {
    int count;
    double *frequency, *growth; /* [count] circular frequencies [rad/s] and growth rates [1/s] */
    /* [count] estimated relative error of lambda = growth + i frequency due to iteration and
     * rounding */
    double *error;
    mode_shape *shape; /* [count] */
    int negative;      /* number of negative eigenvalues of the stiffness */
    int unproven;      /* number of negative eigenvalues for which no mode was found */
} rotation_modes;
void outcome_modes_free(rotation_modes *);

enum { OUTCOME_MEANING = 128 };
/* Results of buckling and modal analyses. Values found before a failure remain. */
typedef struct outcome_spectrum {
    outcome_side positive, negative; /* frequencies are in `positive` */
    /* meaning of the values, for example whether they include damping of members, or the kind of
     * instability; "": not needed */
    char meaning[OUTCOME_MEANING];
    /* [1/s] largest growth rate about a state under loads without a potential; 0: the state is
     * stable */
    double growth;
    const char *growth_meaning; /* meaning of the growth rate; NULL: `meaning` states it */
    /* [free + driven] displacements due to initial strains only, the base state of modes without
     * loads; NULL: none */
    double *strained;
} outcome_spectrum;

typedef struct outcome_path {
    int stations, reached; /* number of stations, and number of computed stations */
    double *value; /* [stations] path parameter, control coordinate, time [s] or frequency [Hz] */
    model_state **state; /* [stations]; NULL for a compliance */
} outcome_path;

/* Compliance C and stiffness K of a node at one station. known 1: both are set. */
typedef struct station_matrices {
    int known;
    double C[36], K[36];
} station_matrices;

typedef struct outcome_compliance {
    outcome_path path;
    /* [stations x 36] compliance of the six components of a node at each station; rows of fixed
     * components are zero, columns that are not requested are NaN; owned by the result */
    const double *matrix;
    station_matrices *taken; /* [stations] matrices computed during the solution of the path;
                                NULL: none */
} outcome_compliance;

typedef struct outcome_rotation {
    outcome_path path;
    rotation_modes *modes; /* [stations] small motions; NULL: no quantity requires them */
} outcome_rotation;

typedef struct outcome_instant {
    /* [free + driven] rates of the coordinates (harness/time/time_impl.h) and their derivatives, in
     * one memory block */
    double *rate, *acceleration;
    double balance[SCENE_BALANCES];
} outcome_instant;

enum {
    PASSING_LOST = 2, /* the rotation vector has no direction (harness/model/model.h) */
    PASSING_UNSOLVED  /* no solution was found at an instant inside a step */
};
typedef struct outcome_passing {
    int known;    /* 1: the value is known; 0: there is no value; otherwise PASSING_LOST or
                     PASSING_UNSOLVED */
    double value; /* value before factor and offset, time [s], or rate of crossings [1/s] */
    double time;  /* [s] time of a maximum or minimum */
    double error; /* estimated error due to interpolation between the ends of steps */
} outcome_passing;

/* End of an accepted step of a motion. */
typedef struct outcome_step {
    double time, step; /* [s] end of the step, and step size (0 for the initial state) */
    /* estimated error of positions in the step, in the norm of model.h; 0: not requested */
    double error;
    int iterations,
        rejected; /* rejected: number of longer steps that were tried first and failed */
    double balance[SCENE_BALANCES];
} outcome_step;

typedef struct outcome_end {
    int analysis;                        /* index in the scene */
    double time, step;                   /* [s] end time, and size of the next step */
    double path;                         /* path parameter of the state */
    double work, dissipated;             /* [J] work and dissipated energy since t = 0 */
    double largest, origin;              /* [J] largest energy in the motion, and energy at t = 0 */
    double turned;                       /* [J] sum of the absolute work of all steps */
    double scale, extent, rate, density; /* see time_impl.h */
    double stress, contraction;          /* convergence history of Newton's method */
    int quiet; /* number of steps since the last discontinuity of the loads */
    /* stations of the scene before `time`, which a continuation omits: their number, and the last
     * of them [s] */
    int omits;
    double omitted;
    size_t states, coordinates, strains, released, between;
    /* [2 states + 3 coordinates + 2 strains + released + 5 between] NULL: none. The order is: the
     * state; the initial state; rates, their derivatives, and the accelerations that
     * generalized-alpha averages; rates of damped strains, and their derivatives; rates of released
     * ends in conserving steps; relative rotations of nodes (model.h). */
    double *value;
} outcome_end;
/* Returns the number of entries of `value`. */
size_t outcome_end_values(const outcome_end *);
void outcome_end_free(outcome_end *);

/* Small motions about a state during a motion, for other analyses: M x'' + (C + G) x' + K x = 0. x
 * contains the increments of the coordinates, with rotations about fixed axes. All matrices have
 * free + driven rows and columns and are stored completely. */
typedef struct outcome_about {
    double time; /* [s] */
    model_state *state;
    double *rate, *acceleration; /* [free + driven] rates and accelerations, in one memory block */
    /* K includes the derivatives of inertia and damping forces; C: damping; G: derivative of all
     * other forces with respect to rates */
    sparse K, M, C, G;
} outcome_about;

typedef struct outcome_motion {
    outcome_path path;
    outcome_instant *at_station; /* [stations] */
    int steps;                   /* number of records, including the initial state */
    outcome_step *step;          /* [steps] */
    outcome_passing *passing;    /* [quantities of the scene] */
    /* [quantities of the scene] 1: the quantity depends on an undefined acceleration, that of a
     * coordinate without inertia */
    unsigned char *undefined;
    /* [quantities of the scene x stations] values of quantities that are derivatives of polynomials
     * inside steps; NULL: none */
    double *slope;
    outcome_path frames; /* states for animations, at equal intervals */
    int abouts;          /* number of times at which other analyses need the state */
    outcome_about
        *about; /* [abouts] small motions, in ascending order of time; `state` NULL: not reached */
    double origin; /* [J] energy at t = 0 of the first motion in a chain of motions */
    outcome_end end;
} outcome_motion;

typedef struct outcome_peak {
    int known;     /* 1: the extremum lies between two requested frequencies */
    int unbounded; /* 1: there is an undamped resonance at `hertz` */
    double hertz, value, bound;
} outcome_peak;

typedef struct outcome_harmonic {
    outcome_path path; /* requested frequencies [Hz], without states */
    double *response;  /* [quantities of the scene x stations] values before factor and offset */
    double *bound;     /* [quantities of the scene x stations] upper bound of the error due to
                          omitted modes */
    /* [quantities of the scene] extremum of each quantity that requests a largest or smallest
     * value */
    outcome_peak *peak;
} outcome_harmonic;

typedef struct outcome_linear {
    /* number of solutions, and [solutions] numbers of their load cases or combinations */
    int solutions, *acting;
    size_t coordinates;
    double *x; /* [solutions x coordinates] displacements; NULL: none */
} outcome_linear;

typedef struct outcome_continuation {
    outcome_path path;
    int points;               /* number of points; the first point is the unloaded state */
    double *factor, *control; /* [points] load factors, and values of the control coordinate [m] */
    /* 1: the number of critical points between these load factors is unknown; only earlier events
     * are listed */
    int undecided;
    int decided_events;
    double undecided_from, undecided_to;
    model_state **state; /* [points] states of nodes; NULL: no curve of coordinates is requested */
} outcome_continuation;

typedef struct analysis_outcome {
    scene_analysis_kind kind;
    status status;
    char reason[FAULT_TEXT];
    union { /* set by the analysis, read by the functions below */
        outcome_linear linear;
        outcome_spectrum spectrum;
        outcome_path path; /* static */
        outcome_compliance compliance;
        outcome_rotation rotation;
        outcome_continuation continuation;
        outcome_motion motion;
        outcome_harmonic harmonic;
    } left;
} analysis_outcome;

/* Return the results of an analysis of the given kind. The program ends if the analysis is of
 * another kind. */
const outcome_linear *outcome_linear_of(const analysis_outcome *);
/* Returns the displacements of a linear solution under a load case or combination; NULL: not
 * solved. */
const double *outcome_displacements(const analysis_outcome *, int acting);
const outcome_spectrum *outcome_spectrum_of(const analysis_outcome *);
/* Returns the path of an analysis of any kind for which outcome_has_path is 1. */
const outcome_path *outcome_path_of(const analysis_outcome *);
const outcome_compliance *outcome_compliance_of(const analysis_outcome *);
const outcome_rotation *outcome_rotation_of(const analysis_outcome *);
const outcome_motion *outcome_motion_of(const analysis_outcome *);
/* Returns the small motions about the state at this time of a motion; NULL: the time was not
 * reached. */
const outcome_about *outcome_about_at(const analysis_outcome *, double time);
/* Returns the outcome of a motion. The caller fills it in. */
outcome_motion *outcome_motion_in(analysis_outcome *);
const outcome_continuation *outcome_continuation_of(const analysis_outcome *);
/* Returns the outcome of a static path or of a steady rotation. The caller fills it in. */
outcome_path *outcome_walk(analysis_outcome *);
int outcome_has_path(const analysis_outcome *);
int outcome_has_spectrum(const analysis_outcome *);
void outcome_free(analysis_outcome *);
void outcome_take(eigen_side *from, outcome_side *to);
status outcome_stations(outcome_path *, int stations, fault *);
/* Copies the state to the next station. whole 0: copies only the states of the nodes
 * (kinematics_nodes_alloc). */
status outcome_keep(outcome_path *, const model *, const model_state *, int whole, double path,
                    fault *);

typedef enum shape_kind {
    SHAPE_UNDEFORMED,
    SHAPE_PATH,
    SHAPE_LINEAR,
    SHAPE_BUCKLING,
    SHAPE_MODE,
    SHAPE_MOTION /* a state of a motion at one of equally spaced times */
} shape_kind;

typedef struct shape_state {
    shape_kind kind;
    int analysis; /* index of the analysis in the scene; -1: none */
    double value; /* path parameter [1], load factor [1], frequency [Hz] or time [s] */
    double scale; /* factor by which the eigenvector is multiplied; 1 for shapes of other kinds */
} shape_state;

typedef struct shapes {
    int states, members, points, nodes; /* 0: no shapes were requested */
    int *first;                         /* [members + 1] index of the first point of each member */
    shape_state *state;                 /* [states] */
    centreline_point *point;            /* [states x points] */
    double *node;                       /* [states x nodes x 3] positions [m] */
} shapes;

enum { SHAPES_ALL = 1 << 30, SHAPES_MODES = 6, SHAPES_FRAMES = 60, SHAPES_FEW = 5 };

/* Allocates the arrays, filled with zeros, for the numbers given in the structure. FAULT: out of
 * memory. */
status shapes_alloc(shapes *, fault *);
void shapes_free(shapes *);
const char *shapes_kind_name(shape_kind);
/* Returns the number of frames of a motion when at most `most` states of a path are stored. 0 if
 * `most` is 0; otherwise `most`, or SHAPES_FRAMES if `most` is at most SHAPES_FEW or at least
 * SHAPES_ALL. */
int shapes_frames(int most);

/* Degree of freedom that a row of a model's matrices represents. */

typedef struct row_label {
    int node;   /* index in the scene; SCENE_NONE: node inside a member, or released end */
    int member; /* index of the member; SCENE_NONE: displacement or rotation of a node */
    /* position on the member relative to its length; NAN: `member` is SCENE_NONE */
    double along;
    double position[3]; /* undeformed position [m] */
    /* "ux", ..., "rz"; "angle 1" for a sequence of angles; "turn 1" or "shift 1" for a released
     * end; "warping"; "scalar 1" for an additional unknown */
    const char *component;
    const char *unit; /* unit of the coordinate: "m", "rad", "rad/m", "1" */
} row_label;

void rows_label(const model *, row_label out[]);

/* Matrices of small motions about the states of a solution, for other programs: M q'' + (C + G) q'
 * + K q = B u. q: free coordinates in the order of the rows. u: changes of the load factors. */

/* A linear model. Its second-order and state-space forms are stored as triplets. */
typedef struct linear_model {
    triplets K, C, M, B, L[3], D;
    struct {
        triplets A, B, C, D;
    } state;
    int eliminated; /* number of eliminated coordinates, which have neither mass nor damping */
    /* number of feedback loops, which are closed in `state` and open in the other matrices */
    int loops;
    double apart; /* largest relative difference from the responses of a harmonic analysis */
    int farthest; /* quantity with this largest difference */
} linear_model;

typedef struct reduced_model {
    linear_model of;
    triplets T;
    int requested; /* number of requested modes */
    /* number of modes in T; larger than `requested` if equal frequencies would be separated */
    int taken;
    int modes; /* number of natural frequencies */
    /* [modes] natural frequencies [Hz] of the full and of the reduced model */
    double *whole, *reduced;
    /* [outputs x inputs] largest difference of the transfer functions at the frequencies of a
     * harmonic analysis: `difference` in SI units, and `apart` relative to the largest value of the
     * full model's function (NAN: this function is zero up to rounding). `at`: frequency [Hz] of
     * this difference. NULL: there is no harmonic analysis. */
    double *difference, *apart, *at;
} reduced_model;

/* An input of a linear model: a load with factor 1, a unit rate of the reference value of a
 * feedback load, a unit force or moment on a node, or a unit acceleration of a driver. */
typedef struct system_input {
    /* indices of the load, driver or node, and the component; SCENE_NONE: not used by this kind of
     * input */
    int load, driver, node, component;
    int reference; /* 1: the input is the rate of the reference value of the load */
} system_input;

typedef struct system_output {
    int quantity; /* index of the first quantity with this output */
    scene_response as;
} system_output;

typedef struct state_matrices {
    int analysis;        /* index in the scene; SCENE_NONE: the undeformed structure at rest */
    int station;         /* station of the path, from zero; SCENE_NONE: the analysis has no path */
    double path;         /* path parameter of the loads and drivers */
    int turns;           /* 1: the axes rotate, and G has entries */
    triplets K, M, G, C; /* C has entries only with damping */
    /* matrix B of the undeformed structure: the effect of the mass inside elements on frequencies
     * in q.K q = lambda q.M q + lambda^2 q.B q */
    triplets inside;
    triplets B; /* [rows x loads] generalised force of each load at factor 1 */
    /* number of modes of a modal analysis, in ascending order of frequency; 0 for other analyses */
    int modes;
    double *frequency, *mode; /* [modes] frequencies [rad/s]; [modes x rows] modes */
    linear_model model;       /* set if requested */
    reduced_model reduced;    /* set if requested */
} state_matrices;

typedef struct system_matrices {
    int rows;         /* number of free coordinates */
    row_label *label; /* [rows] */
    int states, room; /* number of states (0: not requested), and capacity */
    state_matrices *state;
    int inputs, outputs; /* numbers of inputs and of outputs of linear models */
    system_input *input;
    system_output *output;
} system_matrices;

void system_matrices_free(system_matrices *);

typedef struct solve_options {
    int threads; /* threads for the loop over elements; 0 or 1: one thread */
    newton_form newton;
    double criterion;   /* limit of the relative corrections; 0: default */
    int max_iterations; /* maximum per step; 0: default */
    /* number of load steps between stations; 0: the number that the scene gives */
    int steps_between;
    int condition; /* 1: estimate the condition of the tangents (on a static path only at its
                      stations) */
    /* members are condensed to their ends if the longest member has at least this number of
     * elements; 0: if rounding would spoil an assembled tangent */
    int condensed;
    int phases; /* 1: measure the times of the parts of an iteration */
    /* N > 0: each static path has N measured iterations and no results; 0: off */
    int sample;
    int shapes; /* largest number of stored shapes of a path; 0: no shapes */
    /* 1: store matrices of small motions about all states; 2: also state-space forms */
    int systems;
    /* number of modes and interface nodes of reduced models, in the form "MODES" or
     * "MODES:NODE,NODE"; NULL: none */
    const char *reduce;
    int whole_steps; /* 1: a failed time step ends the motion; 0: it is halved */
    int keep_ends;   /* 1: store the ends of motions, for continuation by another run */
    int restarts;
    const outcome_end *
        restart; /* [restarts] ends of motions of another run, which motions of this run continue */
    int all_analyses; /* 1: run all analyses, even if no quantity needs them */
    /* 1: check the stability of static paths also within steps, and where pivots are not
     * conclusive */
    int checks_flutter;
    int values_only; /* 1: omit results that only curves and matrices need */
} solve_options;

typedef struct curve {
    int points;
    double *x, *value;
} curve;

typedef struct quantity_result {
    status status; /* OK: the value is finite */
    double value;  /* value; NAN: there is no value */
    double x;      /* abscissa of the maximum or minimum */
    /* estimated error relative to the value, or to the largest value of a curve. Critical loads and
     * frequencies: error due to rounding. Motions: error due to interpolation within steps.
     * Responses from modes: upper bound of the error due to omitted modes. Other quantities: 0. */
    double rounding;
    /* change from the previously solved mesh, relative to the value (for a curve: to its largest
     * value); NAN: unknown */
    double change;
    curve curve;                   /* curve of a SCENE_CURVE; other quantities have 0 points */
    char reason[FAULT_TEXT];       /* reason why there is no value */
    char meaning[OUTCOME_MEANING]; /* see outcome_spectrum */
} quantity_result;

/* Values of one iteration, all dimensionless. */
typedef struct iteration_record {
    /* sqrt(r . K^-1 r) of the unbalanced forces r before the iteration, relative to that of the
     * first iteration of the step; NAN for newton=dense */
    double residual;
    double correction;      /* size of the correction, as returned by advance_state */
    double incompatibility; /* max |D(x) - e|/l before the iteration */
} iteration_record;

typedef enum step_stability {
    STEP_OPEN, /* the signs of the pivots do not decide, because the tangent is unsymmetric or the
                  axes rotate */
    /* the tangent is unsymmetric, there is no mass, and no eigenvalue has crossed zero */
    STEP_NO_DIVERGENCE,
    STEP_STABLE,
    STEP_UNSTABLE,
    /* the tangent is unsymmetric or the axes rotate, and a small motion grows: det K < 0, or a mode
     * grows */
    STEP_GROWS,
    /* the axes rotate, and gyroscopic forces stabilise the state; damping that rotates with the
     * structure can make a motion grow */
    STEP_HELD,
    STEP_STABILITIES
} step_stability;
const char *result_stability_name(step_stability);
int result_is_unstable(step_stability);

typedef struct step_record {
    int analysis; /* index in the scene */
    step_stability stability;
    double path, increment;
    int iterations, rejected,
        negative_pivots; /* rejected: number of longer steps that were tried first and failed */
    /* 1: the tangent is unsymmetric, and its eigenvalues were followed; `passed` and `judged` are
     * set only in this case */
    int by_eigenvalues;
    int passed; /* number of eigenvalues that have crossed zero */
    /* stability according to the frequencies of small motions; STEP_OPEN: not computed, or
     * undecided */
    step_stability judged;
    double residual, correction, incompatibility; /* values of the last iteration */
    double remaining; /* predicted size of the next correction; NAN: unknown */
    int first;        /* index of the first iteration of the step in solve_result.iteration */
    double energy;    /* |r . K^-1 r| in the first iteration [J] */
} step_record;

/* Compliance and stiffness of a node at stations of a path: [6 x 6] matrices in SI units. Rows and
 * columns are in the order ux uy uz thx thy thz for displacements and Fx Fy Fz Mx My Mz for
 * forces. */
typedef struct nodal_matrices {
    int node;
    scene_moments moments; /* convention for moments */
    int stations;
    double *path;                   /* [stations] */
    double *compliance, *stiffness; /* [stations x 36] entries of fixed components are zero, and
                                       entries that are not requested are NAN */
} nodal_matrices;
typedef enum event_kind {
    EVENT_LIMIT_POINT, /* the load factor has an extremum */
    /* other branches start at this point; the analysis continues on the current branch */
    EVENT_BIFURCATION,
    EVENT_BRANCH_JUMP, /* a step converged to another branch and was rejected */
    EVENT_KINDS
} event_kind;

typedef struct path_event {
    event_kind kind;
    /* numbers of negative pivots of the tangent before and after the event (of its eigenvalues as
     * in left_count, if it is unsymmetric); -1: unknown */
    int analysis, negative_before, negative_after;
    /* load factor and control value [m] at the point; for a branch jump, at a control value that
     * both branches contain */
    double factor, control;
    /* bounds of the rounding errors of `factor` and `control` at a critical point; otherwise 0 */
    double factor_error, control_error;
    double other_factor; /* branch jump: load factor on the rejected branch; otherwise NAN */
    /* critical point: |phi . f|/(|phi| |f|), where phi is the null vector and f the load; branch
     * jump: distance between the branches */
    double measure;
} path_event;

typedef struct motion_record {
    int analysis; /* index in the scene */
    /* path parameter of the static state from which the motion starts; NAN: none */
    double path;
    outcome_step at;
} motion_record;

typedef struct solve_result {
    status status;
    char reason[FAULT_TEXT];
    int quantities;
    quantity_result *quantity; /* [quantities of the scene] in the order of the scene */
    int steps;
    step_record *step;
    int iterations; /* number of iterations in accepted steps */
    iteration_record *iteration;
    int matrix_sets;
    nodal_matrices *matrices;
    int events;
    path_event *event;
    int motions;
    motion_record *motion; /* [motions] records, grouped by motion */
    int ends;
    /* [ends] ends of motions that no other motion of the scene continues */
    outcome_end *end;
    /* [s] setup: scene, sections, quadrature, mesh and pattern analysis; solve: all other work */
    double seconds_setup, seconds_solve;
    counters counters;    /* counted work, without that for shapes and matrices */
    double phase[PHASES]; /* [s] times of the parts of seconds_solve, if requested */
    shapes shapes;
    system_matrices systems;
} solve_result;

const char *result_event_name(event_kind); /* Returns "limit point", ... */
int result_event_multiplicity(const path_event *);
void result_free(solve_result *);

/* Context of an analysis. */

typedef struct context_work {
    double setup; /* [s] time for patterns and symbolic factorisation */
    int singular; /* 1: the matrix of the last factorisation was singular */
} context_work;

typedef struct analysis_context {
    const scene *scene;
    const model *model;
    run_state *run; /* data that all analyses of the solution share */
    equations eq;   /* equations of the model under the loading of the analysis: see context_of */
    const solve_options *options;
    solve_result *result;       /* receives the step records */
    analysis_outcome *outcomes; /* [analyses] outcomes; those of earlier analyses are complete */
    context_work *work;
    /* contexts of the imperfect and of the perfect structure (see context_of); NULL: there are no
     * imperfections */
    const struct analysis_context *const *sides;
} analysis_context;

/* Returns 1 if quantities, other analyses or the options require the analysis. */
int context_runs(const analysis_context *, int analysis);
/* Returns the context of an analysis, with its loading. During a motion, a load without a function
 * of time keeps its value in the state from which the motion starts. */
analysis_context context_of(const analysis_context *, int analysis);
/* Like context_of, but with only the loads of a load case or a combination. */
analysis_context context_under(const analysis_context *, int acting);
/* Like context_of, but without loads and with all drivers at zero. Initial strains of members
 * remain. */
analysis_context context_unloaded(const analysis_context *);
/* Factors K numerically, and records a failure. */
status context_factor(analysis_context *, matrix_factor *, const sparse *K, fault *);
/* Returns REFUSED if the factored matrix is not symmetric. The message says that the result `what`
 * requires symmetry. */
status context_symmetric(const matrix_factor *, const char *what, fault *f);
void context_count_condition(const analysis_context *, matrix_factor *, const sparse *K);
/* Adds the factorisations of a factor to the counters. *counted: number of factorisations of this
 * factor that the counters include; updated by the function. */
void context_count_factorisations(const analysis_context *, const matrix_factor *, long *counted);
void context_count_eigen(const analysis_context *, const eigen_result *);

enum { TANGENT_COMPONENTS = 6, TANGENT_BORDER = 12 };

typedef struct border {
    int count;
    int coordinate[TANGENT_BORDER];
    double *U, *V; /* [count x free]: K_fr; K_rf */
    double W[TANGENT_BORDER * TANGENT_BORDER];
} border;

/* Tangent of a deformed structure, for the compliance of one node. Some prescribed components of
 * the node are released; their reactions act as loads. */

typedef struct node_tangent {
    /* condensed members; K is then not assembled, and released coordinates are unknowns; NULL: no
     * member is condensed */
    condensation *condensed;
    /* matrix of all coordinates if a component is released, otherwise of the free coordinates */
    sparse K;
    sparse inside; /* matrix of the free coordinates [free x free] */
    /* geometric part of K on the same pattern, for refined solutions (see
     * stiffness_parts_geometric) */
    sparse geometric;
    int refined; /* 1: solutions are refined because of the condition number */
    /* last condition estimate of `inside` (0: none), and the ratio of the largest to the smallest
     * pivot at that estimate */
    double condition, apart;
    matrix_factor *own;    /* factor owned by this structure; NULL: none */
    matrix_factor *factor; /* factor of `inside`: `own`, or the factor of the Newton iteration */
    border border;
    int free, all;
    double *residual;
    const model_state *state; /* state to which K belongs */
    /* indices of the coordinates of the node, and their number */
    int index[TANGENT_COMPONENTS], coordinates;
    double T[TANGENT_COMPONENTS * TANGENT_COMPONENTS];
} node_tangent;

/* Allocates the tangent. members: a condensation whose condensed members are used; NULL: none. */
status tangent_alloc(analysis_context *c, const scene_compliance *a, const condensation *members,
                     node_tangent *t, fault *f);
void tangent_free(node_tangent *t);
/* Computes the tangent in a state. reaction[6]: force [N] and moment [N m] on the node due to its
 * prescribed motion. */
status tangent_at(analysis_context *c, const scene_compliance *a, const model_state *s,
                  const double reaction[6], node_tangent *t, fault *f);
/* Like tangent_at, with K and its factors from an iteration that ended at the state. K must contain
 * all coordinates if a component is released, otherwise the free coordinates. */
status tangent_take(analysis_context *c, const scene_compliance *a, const model_state *s,
                    const double reaction[6], const sparse *K, const sparse *inside,
                    matrix_factor *, node_tangent *t, fault *f);
/* Like tangent_at, with the condensed members of an iteration. */
status tangent_take_condensed(analysis_context *c, const scene_compliance *a, const model_state *s,
                              const double reaction[6], const condensation *members,
                              node_tangent *t, fault *f);
/* For a node that rotates by a sequence of angles, replaces the moment by its part due to
 * prescribed angles, which counts as a load. */
status tangent_driven_moment(analysis_context *c, const model_state *s, int node, node_tangent *t,
                             double moment[3], fault *f);
/* Removes the components of the moment about axes of free rotation, about which no reaction acts.
 */
void tangent_prescribed(const node_tangent *t, double moment[3]);
/* Determines the components in which the node can move. */
void tangent_movable(const model *m, const node_tangent *t, movable *out);
/* Computes the compliance C[6 x 6] of the node. wanted: bits of the requested columns. components:
 * bits of the components that can move. Other columns, and rows of other components, are zero. */
status tangent_compliance(analysis_context *c, node_tangent *t, unsigned wanted,
                          unsigned components, double C[36], fault *f);

typedef struct element_part {
    status outcome;
    fault why;
    int matrix;             /* 1: K is known */
    double incompatibility; /* |D(x) - e|/l */
    double force[MODEL_MAX_COORDINATES], K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
} element_part;

/* Returns the loading of an analysis. In a motion, the path parameter is the time, and loads and
 * drivers are functions of time. Those without such a function have their values at the path
 * parameter held_path, which is 1 here (see context_of). The rotation of the axes is that of the
 * analysis or of its base analysis. */
loading loading_of(const model *, int analysis);
/* Returns the value [m or rad] of a driver whose motion is given. */
double loads_driver_value(const equations *, const scene_driver *d, double path);
/* Computes the value of a driver and its first two time derivatives during a motion. At a
 * discontinuity of the function, computes the values after the discontinuity. A driver without a
 * function of time keeps its value in the state from which the motion starts. */
void loads_driver_rates(const equations *, const scene_driver *d, double path, double out[3]);
/* Adds to out[free + driven] the forces of the load in a state, multiplied by `scale`. */
void loads_add_one(const equations *, const model_state *, const scene_load *, double scale,
                   double out[]);
/* Adds to out[free + driven] the forces due to a temperature load on the nodes of a state, at fixed
 * positions, multiplied by `scale`. */
void loads_add_temperature(const equations *, const model_state *, const scene_load *, double scale,
                           double out[]);
/* Computes the derivative of the loads with respect to the path parameter in a state: out[free +
 * driven]. */
void loads_rate(const equations *, const model_state *, double path, double out[]);
/* Returns 1 if a load or a known driver is not zero at path parameter 0. */
int loads_begin(const equations *);

/* Unknown driver: the prescribed coordinate `unknown` moves so that the free coordinate
 * `coordinate` moves by `increment`. No reaction acts on `coordinate`; the solution contains the
 * force on the driver. */
enum { MODEL_MAX_CONDITIONS = 4 };
typedef struct model_condition {
    int unknown, coordinate;
    double increment;
} model_condition;
int loads_conditions(const equations *, const model_state *, double path,
                     model_condition out[MODEL_MAX_CONDITIONS]);

/* Computes the force and the spatial moment of the loads at path parameter `path` on the frame of a
 * node: F[6] [N, N m]. */
void loads_at_node(const equations *, const model_state *, double path, int node, double F[6]);
/* Returns the reaction force or moment on a component of a node, in the axes of its supports.
 * elements, loads: forces of the elements and of the loads on the node. */
double loads_reaction(const model *, int node, int component, const double elements[6],
                      const double loads[6]);

/* In equilibrium, internal minus external forces are zero on the free coordinates. Coordinates,
 * strains and stresses are simultaneous unknowns of the linearisation (N section 4), and strains
 * and stresses are condensed per element:
 *     K dx = f(path) - J^T [P'(e) + P''(e) (D(x) - e)],  K = J^T P'' J + sum sigma_i H_i
 *
 * The prescribed part of dx is known; its contribution is moved to the right-hand side here. */
typedef struct model_linearisation {
    double path;
    /* 1: Newton's method for displacements only; e and sigma are first computed from D(x) */
    int displacement;
    const double *drive; /* [free + driven] increments, of which only the prescribed part is used;
                            NULL: none */
    int conditions;
    const model_condition *condition;
    double *column; /* [conditions x (free + driven)] columns of K for the unknown drivers */
    sparse *K;      /* matrix on a pattern of assemble_pattern; NULL: not requested */
    /* [free + driven] right-hand side; prescribed coordinates: minus their reactions */
    double *residual;
    double incompatibility; /* output: max |D(x) - e|/l over all elements */
} model_linearisation;
typedef struct model_slot {
    double *J, *C, *sigma, *incompatibility, *along,
        *memory; /* values of an element: J, C, sigma = P'(e) + C (D(x) - e), D(x) - e, the numbers
                    from SLOT_TAKES on, and the memory of its type */
} model_slot;
static inline model_slot linearise_slot(const model *m, const linear_memory *memory, int element)
{
    model_slot w;
    const int n = model_strains(m);
    w.J = memory->slot + (size_t)element * (size_t)model_work_size(m);
    w.C = w.J + n * model_own_coordinates(m);
    w.sigma = w.C + n * n;
    w.incompatibility = w.sigma + n;
    w.memory = w.incompatibility + n;
    w.along = w.memory + model_memory(m);
    return w;
}

status linearise_state(const equations *, const linear_memory *, const model_state *,
                       model_linearisation *, fault *);
/* Replaces the independent strains by e = D(x), and the independent stresses by sigma = P'(e). */
status linearise_make_compatible(const equations *, model_state *, fault *);
/* Computes the external force and spatial moment (loads and reactions) on the frame of a node in
 * the state: F[6] [N, N m]. sigma[elements x strains]: stresses; NULL: the stresses of the state.
 */
void linearise_node_force(const equations *, const model_state *, const double sigma[], int node,
                          double F[6]);
/* Adds to out[free + driven] the forces in equilibrium with the stresses of the listed elements and
 * of all springs. */
void linearise_add_internal(const equations *, const model_state *, int elements,
                            const int element[], double out[]);

enum {
    CHUNK_MOST = 8, /* largest number of elements in a batch */
    CHUNK_WINDOW =
        32 /* number of elements among which elements of the same kind are searched for */
};

/* Returns the number of elements in a batch, or 1 if elements are evaluated one at a time. */
int chunk_size(const model *m);
/* Writes the indices of the next batch from [first, end) to index[] and returns the size of the
 * batch; 0: no elements are left. end - first <= CHUNK_WINDOW. done[end - first] must be zero
 * before the first call. */
int chunk_next(const model *m, int first, int end, unsigned char done[], int index[CHUNK_MOST]);

/* Conventions for the stiffness of a moment m on a node that rotates. K: the stiffness of the
 * exponential chart R = exp(theta~) R0, in which the generalized moment of theta is constant.
 * Semitangential: K. The moment follows half of the rotation, m + theta x m/2, and has a potential
 * (Argyris et al. 1979). Spatial: K - m~/2 on the rotations. The moment has fixed axes, and the
 * matrix is not symmetric. Symmetrised: the symmetric part of the spatial stiffness; K itself if
 * all other loads have a potential. A tangent uses the spatial convention at a node that is fixed
 * about one axis only, whose moment keeps its direction (coordinates_held_turn). It uses the
 * semitangential convention at all other nodes. */

/* Returns 1 if the convention changes the stiffness given by the tangent. Each column of the
 * converted compliance then depends on all columns of the compliance given by the tangent. */
int convention_changes(scene_moments of_tangent, scene_moments convention, const double m[3]);

/* Converts the compliance C[6 x 6] of the tangent to the convention, and computes the stiffness
 * K[6 x 6], its inverse for the possible motions. C must be complete in the components that can
 * move. If the convention does not change the stiffness, C is not modified. m[3]: moment on the
 * node [N m]. Rows and columns of fixed components are zero. SINGULAR: C or the converted stiffness
 * is singular to working precision. */
status convention_apply(scene_moments of_tangent, scene_moments convention, const movable *motions,
                        const double m[3], double C[36], double K[36], fault *f);

/* Extrapolates the state at `path` from the last `count` states, oldest first, with a polynomial (a
 * line through two states, a parabola through three, ...). Returns 0, without changing `out`, if
 * there are fewer than two states, prescribed motions or load factors deviate from the polynomial,
 * or the step is too long. */
enum { MODEL_EXTRAPOLATED = 12 };
int extrapolate_state(const equations *, int count, const model_state *const at[], double path,
                      model_state *out);
/* Interpolates the state in the middle between two states. Sets *moved to the largest motion of a
 * node between the two states: the larger of its rotation [rad] and its displacement relative to
 * the size of the structure. Returns 0, without changing `middle`, if prescribed motions or load
 * factors deviate from a line between the states. */
int extrapolate_between(const equations *, const model_state *from, const model_state *to,
                        model_state *middle, double *moved);

/* Removes the iterations of a rejected step. */
void history_drop_step(solve_result *r, const step_record *step);

/* Sets the analysis of the steps from index `first` on, and the stability of the states at their
 * ends. */
void history_evaluate_steps(solve_result *, const scene *, int analysis, int first);
/* Sets the stability at a station where it is undecided, as found from the modes. */
void history_evaluate_station(solve_result *, int analysis, double path, step_stability);
step_stability history_stability_at(const solve_result *, int analysis, double path);
status history_add_step(solve_result *, const step_record *, fault *);
/* Adds the records of a motion. path: path parameter of the static state from which the motion
 * starts; NAN: none. */
status history_add_motion(solve_result *, int analysis, double path, const outcome_motion *,
                          fault *);
typedef struct history_mark {
    int steps, iterations, ends;
} history_mark;
history_mark history_here(const solve_result *);
void history_go_back(solve_result *, const history_mark *);
status history_add_event(solve_result *, const path_event *, fault *);

/* Hash of all data in the order in which they were added. */
typedef struct identity {
    uint64_t part[2];
} identity;

identity identity_begin(void);
void identity_add(identity *, const void *bytes, size_t size);
/* Adds the functions of a model's elements, their data and the eliminated coordinates. If two
 * models of one scene have the same identity, their results are bit-for-bit equal. Returns 0 if the
 * type has `trouble`: its process may fail, so the identity is unknown. */
int identity_add_model(identity *, const model *);

/* Stress resultants on the sections of a member. At the ends of an element, they are the nodal
 * forces J^T sigma of the element minus the loads along the element that are lumped at its nodes.
 * They are in equilibrium with the rest of the structure. Between the ends, section_forces.h
 * computes them by a method that does not depend on the formulation. */

typedef struct internal_state {
    const model_state *s;
    const double *sigma; /* [elements x strains] stresses; NULL: the stresses of the state */
    /* [free + driven] displacements of a linear solution about the undeformed state s; NULL: s is
     * in equilibrium */
    const double *x;
    double path;
    /* inertia forces of a motion; NULL: there is no motion */
    const struct internal_inertia *moving;
} internal_state;

typedef struct internal_inertia {
    /* adds to ends[2][7] the inertia forces of the masses that are lumped at the first and at the
     * last node of the element */
    void (*ends)(const void *context, int element, double ends[2][7]);
    /* density[nodes][6]: inertia force, and inertia moment about the origin of the node's frame,
     * per unit initial length in global axes, as if the mass of the element were evenly distributed
     * and moved with the node */
    void (*along)(const void *context, int element, double density[ELEMENT_MAX_NODES][6]);
    const void *context;
} internal_inertia;

/* Computes the resultants at an end: the action of the part towards `to` on the part towards
 * `from`. They are in the principal axes of the rotated section, with moments about the centroid:
 * N, Qy, Qz [N], Mx, My, Mz [N m], bimoment [N m^2] (conjugate to the rate of the warping
 * amplitude). end: 0 from, 1 to. */
void internal_at_end(const equations *, const internal_state *, int member, int end, double out[7]);

/* A position on a member, from 0 (start node) to 1 (end node) of its initial length. before 1: at a
 * jump, the value on the side of the start node is used. */
typedef struct internal_place {
    int member;
    double place;
    int before;
} internal_place;

/* Computes the resultants at a position on a member, and the other values of section_forces.h:
 * out[SPAN_VALUES]. REFUSED: inside the element, a distributed load begins or ends, or a
 * concentrated load acts (distributed_jumps). Other failures are those of span_recover. In a
 * motion, the mass is distributed evenly along an element, and accelerations are interpolated
 * between its nodes. */
status internal_at(const equations *, const internal_state *, const internal_place *, double out[],
                   fault *);

/* Computes the displacement of the centroid and the rotation vector of the section from the
 * undeformed to the given state at a position on a member: out[6], in fixed axes. The displacement
 * follows the line of section_forces.h. NO_VALUE: the rotation exceeds 3 rad. Other statuses are
 * those of internal_at. */
status internal_moved(const equations *, const internal_state *, int member, double place,
                      double out[6], fault *);

/* Function whose largest value over a member is sought. The function uses the resultants
 * [SPAN_VALUES] of the section at x in [0, 1] of an element. */
typedef double (*internal_measure)(void *context, int element, double x, const double resultants[]);
/* Computes the largest value of a function over a member. REFUSED: the axes of the sections rotate
 * along the member. */
status internal_largest(const equations *, const internal_state *, int member, internal_measure of,
                        void *context, double *out, fault *);

/* Computes the stress [Pa] at a position on a member, from 0 (start node) to 1 (end node). REFUSED:
 * the section has no stress points (elements/section/stress.h). Other statuses are those of
 * internal_at. */
status internal_stress_at(const equations *, const internal_state *, const internal_place *,
                          stress_measure, double *out, fault *);
/* Computes the largest stress (STRESS_NORMAL_MIN: the smallest) over all sections of the member.
 * REFUSED: the section has no stress points, or the axes of the sections rotate along the member.
 */
status internal_stress_largest(const equations *, const internal_state *, int member,
                               stress_measure, double *out, fault *);

/* Subtracts the free strains from e[strains], which contains the strains due to the positions of
 * the nodes. */
void free_strain_subtract(const equations *, int element, double path, double e[]);
/* Returns the data for the stresses of an element: the data of its kind, or the data that its type
 * has modified. They are valid until the next call for this element. */
const element_data *free_strain_data(const equations *, int element, double path);
/* Return the energy supplied by temperatures that change with time: the power at one time [W], and
 * the energy between two states [J]. */
double free_strain_power(const equations *, const model_state *, double time);
double free_strain_work(const equations *, const model_state *from, double begin,
                        const model_state *to, double end);

status linear_stiffness(const equations *, sparse *K, fault *); /* computes J^T S J at e = 0 */
/* Returns the largest initial strain of a member, where curvatures are multiplied by the length of
 * the model; 0: there are no initial strains. */
double linear_initial(const model *);
/* Computes the stresses of the whole structure, including those due to initial strains and to
 * temperatures at `path`. The function does not apply to motions. */
status linear_whole_stresses(const equations *, const double x[], double path, double sigma[],
                             fault *);
/* Computes G = sum sigma H + J^T G(sigma) J, including offsets and springs, minus the stiffness of
 * the loads. REFUSED: the formulation has a history, or the pattern is symmetric and a moment has
 * no potential. */
status linear_geometric_stiffness(const equations *, const double sigma[], double path, sparse *G,
                                  fault *);

/* A linear solution about the undeformed state: x[free + driven] with K x = f. The caller may
 * reuse the factors of K. */
typedef struct linear_system {
    sparse K;
    matrix_factor *factor;
} linear_system;
status linear_system_alloc(analysis_context *, linear_system *, fault *);
void linear_system_free(linear_system *);
/* Solves for the loads and drivers at `path`. */
status linear_system_solve(analysis_context *, linear_system *, double path, double x[], fault *);

typedef struct predictor {
    int count, iterations; /* iterations: number of iterations in the last step */
    int most;              /* largest number of states that an extrapolation uses */
    model_state *at[MODEL_EXTRAPOLATED + 1]; /* NULL: not allocated yet */
    /* [m] error when the last state is extrapolated from k states; k = 1: error of the previous
     * state itself */
    double error[MODEL_EXTRAPOLATED + 1];
} predictor;

status predictor_alloc(const model *, predictor *, fault *); /* contains the undeformed state */
void predictor_free(predictor *);
status predictor_add(const equations *, const model_state *, int iterations, predictor *, fault *);
void predictor_reset(predictor *);
/* Replaces the last state s by an extrapolation for `path`. If none is possible, s is not
 * changed. */
void predictor_guess(const equations *, const predictor *, double path, model_state *s);

typedef struct newton_run {
    analysis_context *c;
    model_state *state, *backup;
    predictor *predictor; /* extrapolation; NULL: every step starts from the last state */
    /* condensed members; K is then not assembled; NULL: no member is condensed */
    condensation *condensed;
    sparse K;
    /* matrix including the prescribed coordinates; not requested if it has no values */
    sparse whole;
    matrix_factor *factor;
    double *residual, *dx;   /* [free + driven] */
    double *dense, *unknown; /* memory for the uncondensed system, allocated on request */
    int *pivot;
    /* [conditions x (free + driven)] solutions for the unknown drivers, stored after dx */
    double *column;
    double
        *weight; /* [free + driven] weights of metric_of, which scale displacements and rotations */
    double energy; /* [J] |r . K^-1 r| of the last residual r; NAN: unknown */
    double path;   /* target of newton_to */
    newton_convergence newton_convergence;
    int max_iterations, free, all;
    /* 1: a tangent that is singular to working precision is not a failure, because a constraint is
     * added to the system of equations */
    int constrained;
    long counted; /* number of factorisations that the counters of the model already include */
} newton_run;

status newton_alloc(analysis_context *, int condense, newton_run *, fault *);
void newton_free(newton_run *);
/* Allocates `whole`, so that K is also assembled for the prescribed coordinates. */
status newton_keep_driven(newton_run *, fault *);

typedef struct newton_correction {
    double at;     /* target path parameter, or time [s] in a motion */
    double size;   /* dimensionless size of the change, as returned by advance_state */
    double energy; /* [J] |r . K^-1 r| of the residual r before the correction; NAN: unknown */
    advance_stress stress;
} newton_correction;

/* Computes K, its factors and dx = K^-1 residual in the current state for the loads and drivers at
 * `path`. dx includes the increments of the drivers. */
status newton_direction(newton_run *, double path, step_record *, fault *);
/* Updates the state by dx. `path`: new path parameter. */
void newton_advance(newton_run *, double path, newton_correction *);
/* Returns NOT_CONVERGED if the initial rise of a curved element exceeds the range of the
 * formulation. */
status newton_check_rest(const model *m, fault *f);
/* Compares an accepted state with the previous state. NOT_CONVERGED: the message gives the reason.
 * If the rotation vector of a node loses its direction, it is NaN from then on. */
status newton_accept(const model *, const model_state *from, model_state *, fault *);

typedef struct newton_use {
    void *of;
    /* run on a path: newton_accept checks its states, and a state far from its first correction is
     * rejected, because it may be another equilibrium; NULL: a motion */
    newton_run *on;
    int least, most; /* smallest and largest number of iterations */
    /* solves the equations of the current state and applies the correction */
    status (*correct)(void *of, int iteration, newton_correction *, step_record *, fault *);
    void (*prepare)(void *of, int iteration,
                    double correction);  /* called before another iteration; NULL: none */
    status (*accept)(void *of, fault *); /* called after convergence; NULL: every state is
                                            accepted */
} newton_use;

/* Returns the functions with which Newton's method computes the states of a path. */
newton_use newton_on_path(newton_run *, void *of,
                          status (*correct)(void *of, int iteration, newton_correction *,
                                            step_record *, fault *));
/* Returns the functions with which Newton's method computes time steps. */
newton_use newton_in_time(const analysis_context *, void *of,
                          status (*correct)(void *of, int iteration, newton_correction *,
                                            step_record *, fault *),
                          void (*prepare)(void *of, int iteration, double correction));

/* Runs Newton's method for one step. NOT_CONVERGED: f contains the reason. Failures of `correct`
 * and `accept` are returned unchanged. Each correction is added to the counters, to the records and
 * to `newton_convergence`. */
status newton_iterate(analysis_context *, const newton_use *, newton_convergence *, step_record *,
                      fault *);

/* Moves the state to `path` by Newton's method. Returns the failures of newton_iterate. */
status newton_to(newton_run *, double path, step_record *, fault *);

/* Quadratic forms of the undeformed structure and of the stresses of a linear solution. */

typedef struct quadratic_forms {
    const equations *eq;
    int free;
    /* [free + driven] displacements due to the loads; all zero: there is no prestress */
    double *load_x;
    double *sigma;            /* [elements x strains] stresses due to the loads */
    sparse loads;             /* part of K due to the loads */
    double *x, *force;        /* [free + driven] x is zero for the prescribed coordinates */
    double *stress, *product; /* [elements x strains], [free] */
} quadratic_forms;

status quadratic_forms_alloc(const equations *eq, const sparse *pattern, quadratic_forms *p,
                             fault *f);
void quadratic_forms_free(quadratic_forms *p);
/* Sets the loads at `path` and their stresses. The caller has set load_x. whole 1: includes the
 * stresses due to initial strains. */
status quadratic_forms_load(const equations *, quadratic_forms *p, double path, int whole,
                            fault *f);

/* Return x^T K x and x^T G x for x[free], and bounds of the rounding errors of these values. */
double quadratic_forms_stiffness(quadratic_forms *p, const double x[]);
double quadratic_forms_geometric(quadratic_forms *p, const double x[]);
double quadratic_forms_stiffness_rounding(quadratic_forms *p, const double x[]);
double quadratic_forms_geometric_rounding(quadratic_forms *p, const double x[]);
/* y[free] = K x[free] */
void quadratic_forms_product(quadratic_forms *p, const double x[], double y[]);

/* Marks the quantity as having no value. The status becomes STATUS_NO_VALUE if the analysis has
 * STATUS_OK; otherwise the analysis' status is used. */
void quantity_no_value(quantity_result *, status, const char *reason);
/* Returns the value times the factor of the quantity, plus the offset of the quantity. */
double quantity_scaled(const scene_quantity *, double value);
/* Returns 1 if a value governs an envelope instead of the governing value `best`. */
int quantity_governs(scene_envelope, double value, double best);

/* Like quantity_scaled, for the abscissa of a curve. */
double quantity_abscissa(const scene_quantity *, double x);
/* Allocates a curve with the given number of points. Returns 0 if out of memory, and records this
 * in the result. */
int quantity_curve(quantity_result *, int points);

/* Stopping criterion of iterative refinement of a linear solution, whose residuals come from
 * element strains (N.J. Higham, Accuracy and Stability of Numerical Algorithms (2002), section
 * 12.1). */

typedef enum refinement_state {
    REFINEMENT_GOES_ON,
    REFINEMENT_ENDS,
    REFINEMENT_LOST
} refinement_state;

typedef struct solution_refinement {
    int corrections; /* number of corrections, including the first solution */
    double last;     /* last correction, relative to the solution */
} solution_refinement;

/* Returns, from the relative size of a correction, whether refinement continues. It continues for
 * at least two corrections after the first one. Afterwards it continues as long as each correction
 * is at most half of the previous one and the accuracy is insufficient. */
refinement_state refinement_next(solution_refinement *, double correction);

/* Computes the mass matrix about a state (NULL: undeformed) on the pattern of M. G: gyroscopic
 * matrix of a rotating frame, or NULL. A symmetric pattern stores the upper triangle of G. */
status rotating_frame_inertia(const equations *, const model_state *, double path, sparse *M,
                              sparse *G, fault *);

/* Returns x^T B x of the undeformed structure for x[free + driven]. This is the effect of the mass
 * inside elements on a mode: k = lambda m + lambda^2 b (elements/field/field.h). */
double rotating_frame_inner(const model *, const double x[]);
/* Computes B on the pattern of a symmetric K. Returns 0 if B is zero because no element has such a
 * matrix. */
int rotating_frame_inner_matrix(const equations *, sparse *out);

/* If released ends or constraints make the undeformed structure a mechanism, describes the motion
 * in f and returns SINGULAR. Otherwise returns `otherwise` and does not change f. */
status singular_mechanism(const analysis_context *c, status otherwise, fault *f);

/* Finds the cause of a failed factorisation, and sets the fault. */
void singular_explain(analysis_context *c, fault *f);

/* Products of K of the last linearisation with x[columns], in two parts, for columns [free +
 * driven]. The stiff part is computed from the element strains, y += sum J^T P'' (J x), because an
 * assembled matrix would lose all digits of soft motions. The soft part is a matrix on the pattern
 * of G: sum sigma_i H_i with the second derivatives of offsets and of sequences of angles, minus
 * the stiffness of loads and of rotating axes. */
void stiffness_parts_material_products(const model *, const linear_memory *, const model_state *,
                                       int columns, const double *const x[], double *const y[]);
/* Returns a bound of the rounding error of x^T K x for the stiff part. */
double stiffness_parts_material_rounding(const model *, const linear_memory *, const model_state *,
                                         const double x[]);
/* Like stiffness_parts_material_rounding, for the assembled matrix and its factors, whose entries
 * are much larger than the stiffness of soft motions. */
double stiffness_parts_assembled_rounding(const model *, const linear_memory *, const model_state *,
                                          const double x[]);
status stiffness_parts_geometric(const equations *, const linear_memory *, const model_state *,
                                 sparse *G, fault *);

/* The uncondensed dense system: A[n x n], column-major, and b[n] with n = uncondensed_size +
 * conditions. The unknowns are free coordinates, strains, stresses and unknown drivers, in this
 * order. load[free + driven] is work space. */
int uncondensed_size(const model *);
status uncondensed_system(const equations *, const model_state *, double path, const double drive[],
                          int conditions, const model_condition condition[], double A[], double b[],
                          double load[], fault *);

#endif
