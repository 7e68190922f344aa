/* newton/: equations of a model, Newton's method, tangents, condensation, outcomes.
 *
 * Sections, in this order: equations of a model; advance (a state after a correction); applied
 * loads; arrival (convergence); modes; outcomes of analyses; shapes; rows; system matrices;
 * solve_options and solve_result; the context of an analysis; tangent of a node; loads along a
 * path; linearise; convention of moments; extrapolate; history; identity; internal (section
 * resultants, stresses); linear solutions; predictor; newton; quadratic forms; quantity results;
 * refinement; rotating frame; singular; tangent in parts; uncondensed. */
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

/* Equations of a model under a loading, and the data of a run that do not belong to a state. The
 * model and the loading do not change during a run. The data are freed at the end of a solution. */

/* Work done so far. */
typedef struct counters {
    long strain_evaluations, stress_evaluations, inertia_evaluations;
    long geometric_evaluations; /* evaluations of the stiffness due to a prestress */
    long iterations, steps, rejected_steps, factorisations, solutions;
    long factor_entries;
    double factor_flops;
    double dense_operations; /* n^3 of every eigenvalue problem solved densely */
    long negative_pivots;    /* largest number of negative pivots of a symmetric tangent at an
                                accepted state */
    double condition; /* largest condition estimate of the solved systems (factor_condition), if
                         requested; else 0 */
} counters;

/* Stored derivatives of elements in the undeformed state (undeformed_of in newton_impl.h). */
typedef struct run_undeformed {
    int *of;         /* [elements] index of the values of an element, or NONE; NULL: no values
                        yet */
    int count, room; /* number of stored elements; capacity */
    int last;        /* element to which the last values belong */
    double *value;   /* [room x (J, C, initial stresses)] */
} run_undeformed;

/* Data of all elements, passed from linearise_state to advance_state. */
typedef struct linear_memory {
    double *slot; /* [elements x model.work_size]: J, C, P' + C (D - e), D - e, memory of the last
                     linearisation */
} linear_memory;

/* Meaning of the path parameter, loads, and rotation of the axes of one analysis. */
typedef struct loading {
    int in_time; /* the path parameter is the time, and loads and drivers are functions of it */
    double held_path; /* path parameter for loads and drivers that are not functions of time */
    int unloaded;     /* 1: no loads, and all drivers are zero */
    int acting;       /* number of the load case or combination (scene_acting_number) */
    int lumps;        /* LUMPS_* bits */
    element_rotating_frame frame; /* for a path of rotation, the angular velocity is multiplied by
                                     the path parameter */
    int rotates, rotation_follows_path;
} loading;

/* Damping in a motion: the stresses of members gain eta S0 e' (with eta of the member), and
 * those of dashpots gain C e'. See harness/time/time.h. */
typedef struct run_damping {
    double *stiffness; /* [kinds x strains^2] S0 */
    double *none;      /* [model_stresses] zeros */
    double *begin;     /* [model_stresses] strains of the state from which rates are computed */
    double g;          /* e' = known + g (e - from) */
    const double *known, *from; /* [model_stresses] */
    spring_rates springs;       /* strain rates of springs */
} run_damping;

struct run_ahead;
struct run_free;
struct element_part;

typedef struct run_state {
    assemble_patterns *patterns; /* patterns of the model's matrices, created on request */
    counters counters;
    phases phases;
    thread_team *team; /* threads of the loop over elements; NULL: one thread */
    struct element_part
        *part; /* equations of a few elements, before they are added in order; NULL: none yet */
    struct run_ahead
        *ahead; /* in one memory block (newton_impl.h); NULL: no batch has been evaluated */
    run_undeformed undeformed;
    struct run_free *free_strain; /* free_strain.c; NULL: the type does not modify its data */
    run_damping *damping;         /* damping of a motion; NULL: none */
    double *feedback; /* [loads] factors of the loads with feedback in the evaluated state, set by
                         feedback_take (harness/time); NULL: no motion yet */
    linear_memory memory; /* memory for callers that linearise one state at a time */
} run_state;

typedef struct equations {
    const model *m;
    loading loading;
    run_state *run;
} equations;

status linear_memory_alloc(const model *, linear_memory *, fault *);
void linear_memory_free(linear_memory *);

/* Starts a run of a model. threads: number of threads for the loop over elements; 0 or 1: one
 * thread. Sums keep their order, so results do not depend on the number of threads. */
status run_state_begin(run_state *, const model *, int threads, fault *);
void run_state_end(run_state *);

/* Update of a state by the solution of the linearised equations. */

/* Largest stresses of all elements [N]. */
typedef struct advance_stress {
    double largest, change; /* largest stress after the update; its change due to the update */
} advance_stress;

/* Call after linearise_state with the same memory and after solving K dx = residual. Adds the
 * increments to strains, stresses and inner unknowns of every element, then to the frames. dx[free
 * + driven]. Returns the largest correction, dimensionless: translations relative to the size of
 * the scene, rotations in rad, warping relative to the element length, inner unknowns as the
 * element defines. stress: may be NULL. */
double advance_state(const equations *, const linear_memory *, model_state *, const double dx[],
                     double path, advance_stress *);
/* Marks the state as an equilibrium: later increments start from this state with the last tangent,
 * and gaps of the last linearisation are not closed again. */
void advance_settle(const model *, const linear_memory *, const model_state *);

typedef struct applied {
    int vertex;
    int follower;  /* 1: F rotates with the vertex */
    int offset;    /* 1: arm is not zero */
    double F[6];   /* force and spatial moment [N, N m] */
    double arm[3]; /* from the vertex to the point of application; it rotates with the vertex [m] */
} applied;

/* Returns the factor of the load at `path` (a path parameter or a time, see loading_of),
 * including the factor of its load case. applied_rate returns the derivative of this factor. */
double applied_factor(const equations *, const scene_load *load, double path);
double applied_rate(const equations *, const scene_load *load, double path);
/* Calls `take` with each nodal force of the load times `scale`. Loads along members are lumped at
 * the nodes of elements with linear shape functions (quadratic ones if there is a middle node); a
 * uniform load has the weights 1/2, 1/2, or Simpson's. */
void applied_each(const model *, const model_state *, const scene_load *, double scale,
                  void (*take)(void *context, const applied *), void *context);

/* Convergence test of Newton's method: size of the last corrections of motions and stresses, and
 * their rate of decrease. */

/* Convergence history along one path. All members except `stress` are dimensionless. */
typedef struct arrival {
    double criterion;          /* requested value; 0: the limit set by rounding */
    double small;              /* two successive corrections below this end a step */
    double correction, before; /* last correction; previous correction in the same step, or
                                  INFINITY */
    double stress;             /* largest stress on the path so far [N] */
    double stress_change;      /* relative change by the last correction */
    double
        contraction;  /* last ratio of a correction to the square of the previous one; NAN: none */
    double remaining; /* predicted size of the next correction; NAN: unknown */
} arrival;

/* differences 1: derivatives are computed by differences, whose noise prevents quadratic
 * convergence, so the iteration ends at the first small correction. elements: with many elements
 * rounding of the positions limits the size of corrections. */
void arrival_start(double criterion, int differences, int elements, arrival *);
/* Returns 1 if the last change of the state was so small that the tangent of the last linearisation
 * is still exact up to rounding. */
int arrival_tangent_stands(const arrival *);

typedef struct condensation condensation;

/* Shape of a vibration mode or buckling mode. */

typedef struct mode_shape {
    scene_family family;
    int half_waves;
} mode_shape;
status modes_identify(const model *, const scene *, const double mode[], mode_shape *, fault *);
int modes_in_family(const scene_mode *,
                    /* Returns 1 if the mode belongs to the family that the quantity requests. */
                    const mode_shape *);
const char *modes_family_name(scene_family);
/* Sets *kind to flexural, torsional or flexural-torsional: it depends on whether shear centres
 * move across their members and whether sections twist. */
status modes_kind(const model *, const scene *, const double mode[], const char **kind, fault *);
/* Separates modes with equal value[count], which may be arbitrary mixtures, into modes that move
 * along the z axes of members and modes that do not. They are stored one after the other, each [n =
 * free + driven]. */
status modes_separate(const model *, const scene *, int count, const double value[], size_t n,
                      double *mode, fault *);

/* Results of an analysis, for quantities and for later analyses. */

/* Critical loads of one sign, or frequencies [rad/s], in ascending order of magnitude, with
 * their modes. */
typedef struct outcome_side {
    int count;
    double *value, *mode; /* [count] NAN: the value was lost in round-off; [count x free] */
    double *error; /* [count] estimated relative error due to iteration and round-off; NULL: none */
    double *growth; /* [count] growth rates of damped modes [1/s]; NULL: undamped. error then refers
                       to growth + i value */
    status status;  /* NOT_CONVERGED: some values are missing or lost ... */
    char reason[FAULT_TEXT]; /* ... and the reason for it */
} outcome_side;
/* Small motions about one state of a stationary rotation. */
typedef struct rotation_modes {
    int count;
    double *frequency, *growth; /* [count] frequencies [rad/s]; growth rates [1/s] */
    double *error;     /* [count] estimated relative error of lambda = growth + i frequency due to
                          iteration and round-off */
    mode_shape *shape; /* [count] */
    int negative;      /* number of negative eigenvalues of the stiffness, and ... */
    int unproven;      /* ... the number of them that the modes do not account for */
} rotation_modes;
void outcome_modes_free(rotation_modes *);

enum { OUTCOME_MEANING = 128 };
/* Results of buckling and modal analyses; values found before a failure remain. */
typedef struct outcome_spectrum {
    outcome_side positive, negative; /* frequencies are in `positive` */
    char meaning[OUTCOME_MEANING];   /* with or without the damping of members, or the kind of
                                        instability; "": no damping, and loads have a potential */
    double growth; /* [1/s] largest growth rate about a state whose loads have no potential; 0:
                      the state is stable */
    const char *growth_meaning; /* as `meaning`, for the growth rate; NULL: the same as `meaning` */
    double *strained; /* [free + driven] displacements due to initial strains alone, about which
                         modes without loads are computed; NULL: none */
} outcome_spectrum;

/* Stations of a path: results of a static analysis, and the first member of the three structures
 * below. */
typedef struct outcome_path {
    int stations, reached; /* number of stations; the first `reached` have been computed */
    double *value;         /* [stations] path parameter or control coordinate */
    model_state **state;   /* [stations]; NULL: for a compliance */
} outcome_path;

/* Compliance C and stiffness K of a node at one station. */
typedef struct station_matrices {
    int known;
    double C[36], K[36];
} station_matrices;

typedef struct outcome_compliance {
    outcome_path path;
    /* compliance for the six components of the node at every station [stations x 36]; rows of fixed
     * components are zero, columns that are not requested NaN; owned by the result */
    const double *matrix;
    station_matrices *taken; /* [stations] matrices computed during the solution of the path;
                                NULL: none */
} outcome_compliance;

typedef struct outcome_rotation {
    outcome_path path;
    rotation_modes *modes; /* [stations]; NULL if no quantity requires them */
} outcome_rotation;

/* State of a motion at one instant, with its energies and momenta (balance, see scene_balance). */
typedef struct outcome_instant {
    double *rate,
        *acceleration; /* [free + driven], as in harness/time/time_impl.h; in one memory block */
    double balance[SCENE_BALANCES];
} outcome_instant;

/* Extremum or crossing of one quantity during a motion, including times between stations. */
enum { PASSING_LOST = 2 }; /* a rotation vector has lost its direction (harness/model/model.h) */
typedef struct outcome_passing {
    int known;    /* 1: known, 0: no value, or PASSING_LOST */
    double value; /* value before factor and offset, or a time [s], or a number of crossings per
                     second */
    double time;  /* [s] time of a maximum or minimum */
    double error; /* estimated error due to interpolation between the ends of steps */
} outcome_passing;

/* End of an accepted step of a motion; the first record is the initial state. */
typedef struct outcome_step {
    double time, step; /* [s] end of the step, and its size; size 0 for the initial state */
    double error; /* estimated error of positions due to the step, in the measure of model.h; 0: not
                     requested */
    int iterations, rejected; /* rejected: number of longer steps that failed before this one */
    double balance[SCENE_BALANCES];
} outcome_step;

/* End of a motion, with all data needed for its continuation. */
typedef struct outcome_end {
    int analysis;                        /* index in the scene */
    double time, step;                   /* [s] time of the end, and next step size */
    double path;                         /* path parameter of the state */
    double work, dissipated;             /* [J] work and dissipated energy since t = 0 */
    double largest, origin;              /* [J] largest energy so far; energy at t = 0 */
    double turned;                       /* [J] sum of the absolute work of all steps */
    double scale, extent, rate, density; /* see time_impl.h */
    double stress, contraction;          /* convergence history of Newton's method */
    int quiet; /* number of steps since the last discontinuity of the loads */
    size_t states, coordinates, strains, released, between;
    double *value; /* [2 states + 3 coordinates + 2 strains + released + 5 between]; NULL: none. The
                      state; the initial state; rates, their derivatives, and the accelerations that
                      generalized-alpha averages; rates of damped strains and their derivatives;
                      rates of released ends in conserving steps; relative rotations of nodes
                      (model.h) */
} outcome_end;
/* Returns the number of entries of `value`. */
size_t outcome_end_values(const outcome_end *);
void outcome_end_free(outcome_end *);

/* Small motions about an instant of a motion that other analyses refer to, with the coefficients
 * of that instant: M x'' + (C + G) x' + K x, where x contains the increments of the coordinates,
 * rotations in fixed axes. All matrices have free + driven rows and columns and are stored
 * whole. */
typedef struct outcome_about {
    double time; /* [s] */
    model_state *state;
    double *rate, *acceleration; /* [free + driven]; one memory block */
    sparse K, M, C, G;           /* K includes the derivatives of the inertia and damping forces; C:
                                    damping; G: all other forces that depend on rates */
} outcome_about;

typedef struct outcome_motion {
    outcome_path path;
    outcome_instant *instant; /* [stations] */
    int steps;                /* number of records, including the initial state */
    outcome_step *step;       /* [steps] */
    outcome_passing *passing; /* [quantities of the scene] */
    unsigned char *undefined; /* [quantities of the scene] 1: the quantity reads an acceleration
                                 of a coordinate without inertia */
    double *slope;            /* [quantities of the scene x stations] values of quantities that
                                 are slopes inside steps; NULL: none */
    outcome_path frames;      /* states for pictures, at equal intervals */
    int abouts;               /* instants that other analyses refer to, ascending */
    outcome_about *about;     /* [abouts] those that were reached have a state */
    double origin;            /* [J] energy at t = 0 of the first motion in a chain */
    outcome_end end;
} outcome_motion;

/* Extreme of a response between two frequencies of the analysis. */
typedef struct outcome_peak {
    int known;     /* 0: the extreme is at a frequency of the analysis */
    int unbounded; /* 1: the resonance at `hertz` is undamped */
    double hertz, value, bound;
} outcome_peak;

typedef struct outcome_harmonic {
    outcome_path path;  /* path of frequencies [Hz]; without states */
    double *response;   /* [quantities of the scene x stations] values before factor and offset */
    double *bound;      /* [quantities of the scene x stations] upper bound of the error due to
                           omitted modes */
    outcome_peak *peak; /* [quantities of the scene] for quantities that request the largest or the
                           smallest value */
} outcome_harmonic;

/* Displacements under each load case and combination that the quantities refer to. */
typedef struct outcome_linear {
    int solutions, *acting; /* number of solutions; [solutions] numbers of their load cases or
                               combinations */
    size_t coordinates;
    double *x; /* [solutions x coordinates] of all coordinates; NULL: none */
} outcome_linear;

typedef struct outcome_continuation {
    outcome_path path;
    int points;               /* number of points of the path; the first one is the state without
                                 load */
    double *factor, *control; /* [points] load factor and control value [m] */
    int undecided; /* 1: the number of critical points between these load factors is unknown; only
                      earlier events are listed */
    int decided_events;
    double undecided_from, undecided_to;
    model_state *
        *state; /* [points] states of nodes; NULL unless a curve of coordinates is requested */
} outcome_continuation;

typedef struct analysis_outcome {
    scene_analysis_kind kind;
    status status;
    char reason[FAULT_TEXT];
    union { /* written by the analysis; use the functions below to read it */
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

/* Return the results of an analysis of the given kind; any other kind ends the program. */
const outcome_linear *outcome_linear_of(const analysis_outcome *);
/* Returns the displacements of a linear solution under that load case or combination; NULL: not
 * solved. */
const double *outcome_displacements(const analysis_outcome *, int acting);
const outcome_spectrum *outcome_spectrum_of(const analysis_outcome *);
/* Returns the path of any analysis along a path. */
const outcome_path *outcome_path_of(const analysis_outcome *);
const outcome_compliance *outcome_compliance_of(const analysis_outcome *);
const outcome_rotation *outcome_rotation_of(const analysis_outcome *);
const outcome_motion *outcome_motion_of(const analysis_outcome *);
/* Returns the instant of a motion at that time; NULL: it was not reached. */
const outcome_about *outcome_about_at(const analysis_outcome *, double time);
/* Returns the outcome of a motion, to be filled in. */
outcome_motion *outcome_motion_in(analysis_outcome *);
const outcome_continuation *outcome_continuation_of(const analysis_outcome *);
/* Returns a static path, or the path of a stationary rotation, to be filled in. */
outcome_path *outcome_walk(analysis_outcome *);
int outcome_has_path(const analysis_outcome *);
int outcome_has_spectrum(const analysis_outcome *);
void outcome_free(analysis_outcome *);
/* Moves the values and modes of a side from `from` to the outcome. */
void outcome_take(eigen_side *from, outcome_side *to);
/* Allocates the states of that many stations. */
status outcome_stations(outcome_path *, int stations, fault *);
/* Copies the state to the next station. whole 0: copies only the states of its nodes
 * (kinematics_nodes_alloc). */
status outcome_keep(outcome_path *, const model *, const model_state *, int whole, double path,
                    fault *);

/* Shapes of a structure in selected states; stored if the options request them. */

typedef enum shape_kind {
    SHAPE_UNDEFORMED,
    SHAPE_PATH,
    SHAPE_LINEAR,
    SHAPE_BUCKLING,
    SHAPE_MODE,
    SHAPE_MOTION /* a frame of a motion */
} shape_kind;

typedef struct shape_state {
    shape_kind kind;
    int analysis; /* index in the scene; -1: none */
    double value; /* path parameter [1], load factor [1], frequency [Hz] or time [s] */
    double scale; /* factor by which the eigenvector is multiplied; 1 for other kinds */
} shape_state;

typedef struct shapes {
    int states, members, points, nodes; /* states 0: shapes were not requested */
    int *first;                         /* [members + 1] index of the first point of each member */
    shape_state *state;                 /* [states] */
    centreline_point *point;            /* [states x points] */
    double *node;                       /* [states x nodes x 3] [m] */
} shapes;

enum { SHAPES_ALL = 1 << 30, SHAPES_MODES = 6, SHAPES_FRAMES = 60, SHAPES_FEW = 5 };

/* Allocates empty arrays with the sizes given in the structure. FAULT: out of memory. */
status shapes_alloc(shapes *, fault *);
void shapes_free(shapes *);
const char *shapes_kind_name(shape_kind);
/* Returns the number of frames of a motion if at most `most` states of a path are stored:
 * `most`, or SHAPES_FRAMES if `most` requests all states or only a few. */
int shapes_frames(int most);

/* Degree of freedom that belongs to a row of a model's matrices. */

typedef struct row_label {
    int node;     /* index in the scene; SCENE_NONE: inside a member, or a released end */
    int member;   /* SCENE_NONE: the row belongs to the node alone */
    double along; /* position on the member relative to its length; NAN: row of a node alone */
    double position[3];    /* undeformed position [m] */
    const char *component; /* "ux", ..., "rz"; "angle 1" of a sequence of angles; "turn 1" and
                              "shift 1" of a released end; "warping" */
    const char *unit;      /* unit of the coordinate: "m", "rad", "rad/m" */
} row_label;

/* out[free]; a coordinate shared by several nodes is labelled with the first of them. */
void rows_label(const model *, row_label out[]);

/* Matrices of small motions about the states of a solution, for other programs:
 *   M q'' + (C + G) q' + K q = B u,
 * with the free coordinates q in the order of the rows and the changes u of the load factors. */

/* A linear model: its second-order and state-space forms as triplets. */
typedef struct linear_model {
    triplets K, C, M, B, L[3], D;
    struct {
        triplets A, B, C, D;
    } state;
    int eliminated; /* number of eliminated coordinates, which have neither mass nor damping */
    int loops;      /* number of feedback loops; they are closed in `state` and open in
                       `second_order` */
    double apart;   /* harmonic analysis: largest relative difference from its responses ... */
    int farthest;   /* ... and the quantity with this difference */
} linear_model;

/* A reduced linear model with q = T x, and its comparison with the full model. */
typedef struct reduced_model {
    linear_model of;
    triplets T;
    int modes;               /* natural frequencies [Hz]: ... */
    double *whole, *reduced; /* ... [modes] */
    double *apart, *at;      /* [outputs x inputs] largest difference of transfer functions at the
                                frequencies of a harmonic analysis, relative to the largest value,
                                and its frequency [Hz]; NULL: no harmonic analysis */
} reduced_model;

/* An input of a linear model: a load with factor 1, a rate of 1 of the reference value of a
 * feedback load, a force or moment of 1 at a node, or an acceleration of 1 of a driver. */
typedef struct system_input {
    int load, driver, node, component; /* SCENE_NONE: the input is not of this kind */
    int reference;                     /* 1: the input is the reference value of the load */
} system_input;

typedef struct system_output {
    int quantity; /* first quantity that refers to this input */
    scene_response as;
} system_output;

typedef struct state_matrices {
    int analysis;             /* index in the scene; SCENE_NONE: the undeformed structure at rest */
    int station;              /* station of its path, from zero; SCENE_NONE: the analysis has no
                                 path */
    double path;              /* path parameter of the loads and drivers */
    int turns;                /* 1: the axes rotate, and G exists */
    triplets K, M, G, C;      /* C has entries only if something is damped */
    triplets inside;          /* matrix of the undeformed structure for the effect of the mass
                                 inside elements on frequencies: q.K q = lambda q.M q + lambda^2
                                 q.inside q */
    triplets B;               /* [rows x loads] generalised force of each load at factor 1 */
    int modes;                /* number of modes of a modal analysis, ascending; else 0 */
    double *frequency, *mode; /* [modes] [rad/s]; [modes x rows] */
    linear_model model;       /* if requested */
    reduced_model reduced;    /* if requested */
} state_matrices;

typedef struct system_matrices {
    int rows;         /* number of free coordinates */
    row_label *label; /* [rows] */
    int states, room; /* number of states, 0: not requested; capacity */
    state_matrices *state;
    int inputs, outputs; /* numbers of inputs and outputs of linear models */
    system_input *input;
    system_output *output;
} system_matrices;

void system_matrices_free(system_matrices *);

/* Options and results of a solution: quantities, steps, iterations, events, matrices, shapes. */

typedef struct solve_options {
    int threads; /* threads of the loop over elements; 0, 1: one */
    newton_form newton;
    double criterion;   /* relative size of the last corrections; 0: default */
    int max_iterations; /* per step; 0: default */
    int steps_between;  /* number of load steps between stations, instead of that in the scene;
                           0: as in the scene */
    int condition;      /* 1: estimate the condition of the tangents (on a static path only at its
                           stations) */
    int condensed; /* number of elements at and above which a member is condensed to its ends; 0:
                      default
                    */
    int phases;    /* 1: measure the time of each part of an iteration */
    int sample;    /* N > 0: only N iterations of each static path, to measure their time, without
                      results */
    int shapes;    /* largest number of path states with stored centre lines; 0: no shapes */
    int systems; /* 1: store the matrices of small motions about all states; 2: also state space */
    const char *reduce; /* number of modes and interface nodes of reduced models, as "MODES" or
                           "MODES:NODE,NODE"; NULL: none */
    int whole_steps;    /* 1: a time step that fails ends the motion; 0: it is halved */
    int keep_ends;      /* 1: store the ends of motions, from which another run can continue them */
    int restarts;
    const outcome_end *restart; /* [restarts] ends of motions of another run, from which motions of
                                   this run continue */
    int all_analyses;           /* 1: also run analyses that no quantity reads */
    int looks; /* 1: check the stability of static paths where pivots are not conclusive, and within
                  their steps */
    int values_only; /* 1: do not compute values needed only for curves and matrices */
} solve_options;

typedef struct curve {
    int points;
    double *x, *value;
} curve;

typedef struct quantity_result {
    status status;   /* OK: the value is finite */
    double value;    /* NAN if there is no value */
    double x;        /* abscissa where a maximum or minimum was found */
    double rounding; /* estimated |error| relative to the value (for a curve, to its largest
                        value): for critical loads and frequencies due to round-off, for motions
                        due to interpolation between steps, for responses by modes an upper bound
                        for the omitted modes; otherwise 0 */
    double change;   /* change from the previously solved mesh, relative to the value (for a curve:
                        to its largest value); NAN: unknown */
    curve curve;     /* curve of a SCENE_CURVE; 0 points for other quantities */
    char reason[FAULT_TEXT];       /* reason why there is no value */
    char meaning[OUTCOME_MEANING]; /* see outcome_spectrum */
} quantity_result;

/* All values are dimensionless. With quadratic convergence each correction is about the square of
 * the previous one. */
typedef struct iteration_record {
    double residual;   /* sqrt(r . K^-1 r) of the unbalanced forces r before the iteration, relative
                          to the first of the step; NAN: newton=dense */
    double correction; /* size of the correction: advance_state */
    double incompatibility; /* max |D(x) - e|/l before the iteration */
} iteration_record;

/* Stability of a state under small disturbances, with fixed and prescribed coordinates unchanged.
 */
typedef enum step_stability {
    STEP_OPEN,          /* the signs of the pivots are not conclusive, because the tangent is not
                           symmetric or the axes rotate */
    STEP_NO_DIVERGENCE, /* the tangent is not symmetric and there is no mass: no eigenvalue has
                           crossed zero */
    STEP_STABLE,
    STEP_UNSTABLE,
    STEP_GROWS, /* in rotating axes, or with a tangent that is not symmetric: a small motion grows,
                   shown by an odd number of negative eigenvalues (det K < 0) or by a mode */
    STEP_HELD,  /* in rotating axes: stable only by gyroscopic forces; without damping no motion
                   grows, but damping that rotates with the structure can make a motion grow */
    STEP_STABILITIES
} step_stability;
const char *result_stability_name(step_stability);
int result_is_unstable(step_stability);

typedef struct step_record {
    int analysis;             /* index in the scene */
    step_stability stability; /* stability at the end of the step */
    double path, increment;
    int iterations, rejected,
        negative_pivots;   /* rejected: number of longer steps that failed before this one */
    int by_eigenvalues;    /* 1: the tangent is not symmetric, and its eigenvalues were followed;
                              the two members below are then set */
    int passed;            /* number of eigenvalues that have crossed zero */
    step_stability judged; /* stability found from the frequencies of small motions; STEP_OPEN:
                              not computed or unknown */
    double residual, correction, incompatibility; /* values of the last iteration */
    double remaining; /* predicted size of the next correction; NAN: unknown */
    int first;        /* index of the first iteration of the step in solve_result.iteration */
    double energy;    /* r . K^-1 r in the first iteration [J] */
} step_record;

/* Compliance and stiffness of a node at stations of a path: [6 x 6] matrices in SI units, with
 * rows and columns ux uy uz thx thy thz for the displacements and Fx Fy Fz Mx My Mz for the
 * forces. */
typedef struct nodal_matrices {
    int node;
    scene_moments moments; /* convention for moments */
    int stations;
    double *path; /* [stations] */
    double *compliance,
        *stiffness; /* [stations x 36]; fixed components: zero; not requested: NAN */
} nodal_matrices;
/* Event on a continued path. */
typedef enum event_kind {
    EVENT_LIMIT_POINT, /* the load has an extremum */
    EVENT_BIFURCATION, /* other branches start at this point; the analysis stays on its branch */
    EVENT_BRANCH_JUMP, /* a step converged to another branch, which was detected and rejected */
    EVENT_KINDS
} event_kind;

typedef struct path_event {
    event_kind kind;
    int analysis, negative_before,
        negative_after; /* number of negative pivots of the tangent stiffness after the event; -1:
                           not symmetric */
    double factor, control; /* at the point; for a branch jump: where both branches have this
                               value of the control coordinate [m] */
    double other_factor;    /* for a branch jump: factor on the rejected branch; else NAN */
    double measure; /* for a critical point: |phi . f|/(|phi| |f|) with null vector phi and load
                       f; for a branch jump: distance between the branches */
} path_event;

/* One row of a transient analysis: the initial state, or the end of a step. */
typedef struct motion_record {
    int analysis; /* index in the scene */
    double path;  /* path parameter of the state from which the motion starts; NAN: it starts
                     from no path */
    outcome_step at;
} motion_record;

typedef struct solve_result {
    status status;
    char reason[FAULT_TEXT];
    int quantities;
    quantity_result *quantity; /* [quantities of the scene] in the order of the scene */
    int steps;
    step_record *step;
    int iterations; /* number of iterations in all accepted steps */
    iteration_record *iteration;
    int matrix_sets;
    nodal_matrices *matrices;
    int events;
    path_event *event;
    int motions;
    motion_record *motion; /* [motions] records, grouped by motion */
    int ends;
    outcome_end *end; /* [ends] ends of motions that no other motion of the scene continues */
    double seconds_setup, seconds_solve; /* [s] time for the scene, the sections, quadrature, the
                                            mesh and the analysis of the pattern; time for
                                            everything else */
    counters counters;                   /* counted work, excluding the work for shapes and
                                            matrices */
    double phase[PHASES];                /* [s] times of the parts of seconds_solve, if requested */
    shapes shapes;
    system_matrices systems;
} solve_result;

const char *result_event_name(event_kind); /* Returns "limit point", ... */
/* Returns how many eigenvalues of the tangent cross zero together at the event. */
int result_event_multiplicity(const path_event *);
void result_free(solve_result *);

/* Context of an analysis. */

/* Data that one analysis of a solution leaves for later ones. */
typedef struct context_work {
    double setup;        /* [s] spent on patterns and symbolic factorisation */
    int singular;        /* 1: the last factorisation failed */
    matrix_factor *left; /* factor for the pattern of the free coordinates that an earlier analysis
                            left for reuse; NULL: none */
} context_work;

typedef struct analysis_context {
    const scene *scene;
    const model *model;
    run_state *run; /* run of the model */
    equations eq;   /* equations of the model under the loading of the analysis: see context_of */
    const solve_options *options;
    solve_result *result;       /* receives the step records */
    analysis_outcome *outcomes; /* [analyses] outcomes; those before the present analysis are
                                   complete */
    context_work *work;
    /* With imperfections: contexts of the imperfect and of the perfect structure (see
     * context_of); otherwise NULL. */
    const struct analysis_context *const *sides;
} analysis_context;

/* Returns 1 if the analysis is required by quantities, by other analyses or by the options. */
int context_runs(const analysis_context *, int analysis);
/* Returns the context of an analysis, with its loading. In a motion, loads without a function of
 * time keep the value that they have in the initial state. */
analysis_context context_of(const analysis_context *, int analysis);
/* As context_of, with only the loads of a load case or a combination. */
analysis_context context_under(const analysis_context *, int acting);
/* As context_of, with no loads and all drivers at zero: only the initial strains of members
 * remain. */
analysis_context context_unloaded(const analysis_context *);
/* Factors K numerically, and records whether the factors exist. */
status context_factor(analysis_context *, matrix_factor *, const sparse *K, fault *);
/* Returns REFUSED if the factored matrix is not symmetric; `what` names the result that requires
 * symmetry, for the message. */
status context_symmetric(const matrix_factor *, const char *what, fault *f);
/* If requested, updates the counters with the condition estimate of a matrix that has just been
 * factored. */
void context_count_condition(const analysis_context *, matrix_factor *, const sparse *K);
/* Adds the work of a solution with a factor to the counters. fresh 0: the numeric factors are
 * those of an earlier solution. *counted: number of factorisations of this factor that are
 * already counted; updated. */
void context_count_solution(const analysis_context *, const matrix_factor *, int fresh,
                            long *counted);
/* Adds the work of an eigenvalue problem to the counters. */
void context_count_eigen(const analysis_context *, const eigen_result *);

/* Tangent of the free coordinates, bordered by released coordinates of a node with prescribed
 * motion. */

enum { TANGENT_COMPONENTS = 6, TANGENT_BORDER = 12 };

/* Released coordinates: prescribed coordinates that are treated as free. */
typedef struct border {
    int count;
    int coordinate[TANGENT_BORDER];
    double *U, *V; /* [count x free]: K_fr; K_rf */
    double W[TANGENT_BORDER * TANGENT_BORDER];
} border;

/* Tangent of a deformed structure about one node. Some prescribed components of the node are
 * released, and their reactions act as loads. */

typedef struct node_tangent {
    condensation *condensed; /* NULL: no member is condensed. Otherwise K is not assembled, and
                                released coordinates are unknowns */
    sparse K;                /* on all coordinates if a component is released, else on the free
                                coordinates */
    sparse inside;           /* matrix of the free coordinates [free x free] */
    sparse geometric;        /* part of K on the same pattern, for refined solutions: see
                                stiffness_parts_geometric */
    int refined;             /* 1: solutions need refinement because of the condition number */
    /* condition of `inside` as last estimated (0: not estimated yet), and the ratio of its
     * pivots at that time */
    double condition, apart;
    matrix_factor *own;    /* factor that this structure owns; NULL: not needed so far */
    matrix_factor *factor; /* factor of `inside`: `own`, or the factor of the Newton iteration */
    border border;
    int free, all;
    double *residual;
    const model_state *state;                   /* state to which K belongs */
    int index[TANGENT_COMPONENTS], coordinates; /* indices of the node's coordinates; their
                                                   number */
    double T[TANGENT_COMPONENTS * TANGENT_COMPONENTS];
} node_tangent;

/* Allocates the tangent. members: a condensation of an iteration, whose condensed members are
 * reused; NULL: none. */
status tangent_alloc(analysis_context *c, const scene_compliance *a, const condensation *members,
                     node_tangent *t, fault *f);
void tangent_free(node_tangent *t);
/* Computes the tangent in a state. reaction[6]: force and moment on the node due to its
 * prescribed motion [N, N m]. */
status tangent_at(analysis_context *c, const scene_compliance *a, const model_state *s,
                  const double reaction[6], node_tangent *t, fault *f);
/* As tangent_at, but takes K and its factors from an iteration that ended at the state. The
 * pattern of K contains all coordinates if a component is released, else the free coordinates. */
status tangent_take(analysis_context *c, const scene_compliance *a, const model_state *s,
                    const double reaction[6], const sparse *K, const sparse *inside,
                    matrix_factor *, node_tangent *t, fault *f);
/* As tangent_at, but takes the condensed members of an iteration. */
status tangent_take_condensed(analysis_context *c, const scene_compliance *a, const model_state *s,
                              const double reaction[6], const condensation *members,
                              node_tangent *t, fault *f);
/* For a node that rotates by a sequence of angles, reduces the moment to the part that belongs
 * to prescribed angles, which counts as a load. The guides of fixed angles, and the constraints
 * of angles that others follow, exert the rest and rotate with the node. Other nodes: the moment
 * does not change. */
status tangent_driven_moment(analysis_context *c, const model_state *s, int node, node_tangent *t,
                             double moment[3], fault *f);
/* Removes from the reaction the moment about axes of free rotation, since no support exerts it. */
void tangent_prescribed(const node_tangent *t, double moment[3]);
/* Finds the components in which the node can move. */
void tangent_movable(const model *m, const node_tangent *t, movable *out);
/* Computes the compliance C[6 x 6] of the node, with the reaction moment in the given
 * convention. Columns outside `wanted`, and rows and columns of components that cannot move, are
 * zero. */
status tangent_compliance(analysis_context *c, node_tangent *t, unsigned wanted,
                          unsigned components, double C[36], fault *f);

/* Equations of one element in the coordinates of the model. */
typedef struct element_part {
    status outcome;
    fault why;
    double incompatibility; /* |D(x) - e|/l */
    double force[MODEL_MAX_COORDINATES], K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
} element_part;

/* Loads and drivers along a path. */

/* Returns the loading of an analysis. In a motion the path parameter is the time, and loads and
 * drivers are functions of it; a load without such a function acts in full. The axes rotate as in
 * the analysis or its base analysis. */
loading loading_of(const model *, int analysis);
/* Returns the value of a known driver [m or rad]. */
double loads_driver_value(const equations *, const scene_driver *d, double path);
/* In a motion, computes the value and its first two derivatives; at the end of a piece, those of
 * the next piece. A driver without a function of time keeps its last value. */
void loads_driver_rates(const equations *, const scene_driver *d, double path, double out[3]);
/* out[free + driven] += forces of the load times `scale` in a state. */
void loads_add_one(const equations *, const model_state *, const scene_load *, double scale,
                   double out[]);
/* out[free + driven] += forces that a temperature load times `scale` exerts on nodes that are
 * fixed in the positions of a state. */
void loads_add_temperature(const equations *, const model_state *, const scene_load *, double scale,
                           double out[]);
/* out[free + driven]: derivative of the loads with respect to the path parameter in a state. */
void loads_rate(const equations *, const model_state *, double path, double out[]);
/* Returns 1 if a load or a known driver is not zero at path parameter 0. */
int loads_begin(const equations *);

/* Unknown driver: the prescribed coordinate `unknown` moves so that the free coordinate
 * `coordinate` moves by `increment`. No reaction acts on `coordinate`; the solution gives the
 * force on the driver. */
enum { MODEL_MAX_CONDITIONS = 4 };
typedef struct model_condition {
    int unknown, coordinate;
    double increment;
} model_condition;
int loads_conditions(const equations *, const model_state *, double path,
                     model_condition out[MODEL_MAX_CONDITIONS]);

/* Force and spatial moment of the loads at path parameter `path` on the frame of a node: F[6]
 * [N, N m]. */
void loads_at_node(const equations *, const model_state *, double path, int node, double F[6]);
/* Returns the reaction force or moment on a component of a node, in the axes of its supports.
 * elements, loads: forces that the elements and the loads exert on the node. */
double loads_reaction(const model *, int node, int component, const double elements[6],
                      const double loads[6]);

/* Newton's equations of a state. */

/* In equilibrium, internal minus external forces are zero on the free coordinates. The
 * linearisation is mixed: coordinates, strains and stresses are unknowns at the same time (N
 * section 4). Strains and stresses are condensed per element:
 *     K dx = f(path) - J^T [P'(e) + P''(e) (D(x) - e)],  K = J^T P'' J + sum sigma_i H_i
 * The prescribed part of dx is known; its contribution is moved to the right-hand side here. */
typedef struct model_linearisation {
    double path;
    int displacement; /* 1: displacement-only Newton: e and sigma are first set from D(x) */
    const double
        *drive;     /* [free + driven] increments; only the prescribed part is used; NULL: none */
    int conditions; /* number of unknown drivers ... */
    const model_condition *condition;
    double *column;   /* ... and the columns of K that belong to them [conditions x (free +
                         driven)] */
    sparse *K;        /* matrix on a pattern of assemble_pattern; NULL: not requested */
    double *residual; /* [free + driven] right-hand side; for prescribed coordinates, minus their
                         reactions */
    double incompatibility; /* output: max |D(x) - e|/l over all elements */
} model_linearisation;
/* Data of one element in a linear_memory between linearise_state and advance_state. */
typedef struct model_slot {
    double *J, *C, *sigma, *incompatibility, *along, /* SLOT_* */
        *memory; /* sigma = P'(e) + C incompatibility, incompatibility = D(x) - e */
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

/* Fills the memory for advance_state. */
status linearise_state(const equations *, const linear_memory *, const model_state *,
                       model_linearisation *, fault *);
/* Replaces the independent strains by e = D(x), and the independent stresses by sigma = P'(e). */
status linearise_make_compatible(const equations *, model_state *, fault *);
/* External force and spatial moment (loads and reactions) on the frame of a node in the state: F[6]
 * [N, N m]. sigma: as for internal_state. */
void linearise_node_force(const equations *, const model_state *, const double sigma[], int node,
                          double F[6]);
/* out[free + driven] += forces in equilibrium with the stresses of the listed elements and of
 * all springs. */
void linearise_add_internal(const equations *, const model_state *, int elements,
                            const int element[], double out[]);

enum {
    CHUNK_MOST = 8,   /* largest number of elements in a batch */
    CHUNK_WINDOW = 32 /* number of elements among which elements of the same kind are searched
                         for */
};

/* Returns the number of elements in a batch; 1 if elements are evaluated one at a time. */
int chunk_size(const model *m);
/* Writes the indices of the next batch from [first, end) to index[], where end - first <=
 * CHUNK_WINDOW, and returns its size; 0: no elements are left. done[end - first] must be zero
 * before the first call. */
int chunk_next(const model *m, int first, int end, unsigned char done[], int index[CHUNK_MOST]);

/* Stiffness of a moment m on a node that rotates, by convention. K: the stiffness of the
 * exponential chart R = exp(theta~) R0, in which the generalized moment of theta is constant.
 * Semitangential: K; the moment follows half of the rotation, m + theta x m/2, and has a potential
 * (Argyris et al. 1979). Spatial: K - m~/2 on the rotations; the moment has fixed axes, and the
 * matrix is not symmetric. Symmetrised: the symmetric part of the spatial stiffness; K itself if
 * all other loads have a potential. A tangent uses one of the first two conventions: the spatial
 * one at a node that is fixed about one axis only, whose moment keeps its direction
 * (coordinates_held_turn), else the semitangential one. */

/* Returns 1 if the convention changes the stiffness given by the tangent. One column of the
 * compliance then depends on all others. */
int convention_changes(scene_moments of_tangent, scene_moments convention, const double m[3]);

/* Converts C[6 x 6] of the tangent, complete in the components that can move, to the convention,
 * and computes its inverse K[6 x 6] on the possible motions. If nothing changes, C keeps its full
 * accuracy. m[3]: moment on the node [N m]. Rows and columns of fixed components are zero.
 * SINGULAR: C is singular to working precision. */
status convention_apply(scene_moments of_tangent, scene_moments convention, const movable *motions,
                        const double m[3], double C[36], double K[36], fault *f);

/* Initial guess for the next state of a path. */

/* Extrapolates the state at `path` from the last `count` states, oldest first, by a polynomial
 * (a line through two states, a parabola through three, ...). Returns 0 and leaves `out`
 * unchanged when prescribed motions are nonlinear or the step is too long. */
enum { MODEL_EXTRAPOLATED = 12 };
int extrapolate_state(const equations *, int count, const model_state *const at[], double path,
                      model_state *out);

/* Record of Newton's method: the iterations of all accepted load steps. */

/* Removes the iterations of a rejected step. */
void history_drop_step(solve_result *r, const step_record *step);

/* Sets the analysis of the steps from index `first` on, and the stability of their final states. */
void history_judge_steps(solve_result *, const scene *, int analysis, int first);
/* Sets the stability that the modes show at a station where pivots are not conclusive. */
void history_judge_station(solve_result *, int analysis, double path, step_stability);
/* Returns the stability at the end of the step that ended at that path parameter; STEP_OPEN:
 * there is no such step. */
step_stability history_stability_at(const solve_result *, int analysis, double path);
status history_add_step(solve_result *, const step_record *, fault *);
/* Adds all steps of a motion to the record. */
/* path: path parameter of the initial state; NAN: none. */
status history_add_motion(solve_result *, int analysis, double path, const outcome_motion *,
                          fault *);
/* Position in the record; history_go_back removes all later entries. */
typedef struct history_mark {
    int steps, iterations, ends;
} history_mark;
history_mark history_here(const solve_result *);
void history_go_back(solve_result *, const history_mark *);
status history_add_event(solve_result *, const path_event *, fault *);

/* Identifies models with equal results. For example, formulations that differ only in physics
 * that the scene does not contain give equal results. */

/* Hash of all data that were added, in order. */
typedef struct identity {
    uint64_t part[2];
} identity;

identity identity_begin(void);
void identity_add(identity *, const void *bytes, size_t size);
/* Adds the functions of a model's elements, their data and the eliminated coordinates. If two
 * models of one scene have the same identity, their results are bit-for-bit equal. Returns 0 if the
 * identity is unknown, because a formulation in another process may fail. */
int identity_add_model(identity *, const model *);

/* Resultants of the stresses on the sections of a member.
 *
 * At the ends of an element, the resultants are its nodal forces J^T sigma minus the loads along it
 * that are lumped at its nodes. They are in equilibrium with the rest of the structure, whatever a
 * formulation assumes inside. Between the ends harness/section_forces/section_forces.h computes
 * them in the same way for all formulations. */

/* State whose resultants are computed. */
typedef struct internal_state {
    const model_state *s;
    const double *sigma; /* [elements x strains] stresses; NULL: stresses of the state */
    const double *x;     /* displacements [free + driven] of a linear solution about the undeformed
                            state s; NULL: s is in equilibrium */
    double path;         /* path parameter of the loads */
    /* inertia forces of a motion; NULL: no motion */
    const struct internal_inertia *moving;
} internal_state;

/* Inertia forces of one element in a motion. */
typedef struct internal_inertia {
    /* ends[2][7] += inertia forces of the masses of the element lumped at its first and its last
     * node */
    void (*ends)(const void *context, int element, double ends[2][7]);
    /* inertia force per initial length, in global axes, of evenly distributed mass that moves as
     * each node does: density[nodes][force, moment about the node's frame] */
    void (*along)(const void *context, int element, double density[ELEMENT_MAX_NODES][6]);
    const void *context;
} internal_inertia;

/* Resultants at an end: action of the part towards `to` on the part towards `from`, in the
 * principal axes of the rotated section, moments about its centroid: N, Qy, Qz [N], Mx, My, Mz [N
 * m], bimoment [N m^2] (conjugate to the rate of the warping amplitude). end: 0 from, 1 to. */
void internal_at_end(const equations *, const internal_state *, int member, int end, double out[7]);

/* A position on a member, from 0 (start node) to 1 (end node) of its initial length. before 1:
 * where a value jumps, the value on the side of the start node is used. */
typedef struct internal_place {
    int member;
    double place;
    int before;
} internal_place;

/* Resultants at a position of a member, and the other values of section_forces.h: out[SPAN_VALUES].
 * NOT_CONVERGED: as span_recover. In a motion the mass is distributed evenly along an element, with
 * accelerations interpolated between its nodes. For a linear acceleration the forces are in
 * equilibrium with the rest of the structure, so values are continuous between elements (order 2).
 * Warping inertia acts at nodes. */
status internal_at(const equations *, const internal_state *, const internal_place *, double out[],
                   fault *);

/* Displacement of the centroid, and rotation vector of the section, from the undeformed state to
 * the present state at a position: out[6], in fixed axes, along the line of section_forces.h.
 * NO_VALUE: the rotation exceeds 3 rad; other statuses as internal_at. */
status internal_moved(const equations *, const internal_state *, int member, double place,
                      double out[6], fault *);

/* Largest value of the function `of` over a member; `of` computes it for the section at x in [0, 1]
 * of an element, numbered along the member, from its resultants [SPAN_VALUES]. */
typedef double (*internal_measure)(void *context, int element, double x, const double resultants[]);
status internal_largest(const equations *, const internal_state *, int member, internal_measure of,
                        void *context, double *out, fault *);

/* Stresses at the points of a section of a member, from the resultants there. */

/* Stress at a position of a member, from 0 (start node) to 1 (end node) [Pa]. REFUSED: the
 * section is given by constants and therefore has no points; other statuses as internal_at. */
status internal_stress_at(const equations *, const internal_state *, const internal_place *,
                          stress_measure, double *out, fault *);
/* Largest stress over all sections of the member. */
status internal_stress_largest(const equations *, const internal_state *, int member,
                               stress_measure, double *out, fault *);

/* Subtracts the free strains from e[strains], the strains due to the node positions. */
void free_strain_subtract(const equations *, int element, double path, double e[]);
/* Returns the data for the stresses of an element: those of its kind, or those that its type has
 * modified. Valid until the next call for the element. */
const element_data *free_strain_data(const equations *, int element, double path);
/* Energy supplied by temperatures that change with time: the power at an instant [W], and the
 * energy between two states [J]. */
double free_strain_power(const equations *, const model_state *, double time);
double free_strain_work(const equations *, const model_state *from, double begin,
                        const model_state *to, double end);

/* Linear analyses about the undeformed state. */
status linear_stiffness(const equations *, sparse *K, fault *); /* J^T S J at e = 0 */
/* Returns the largest size of the initial strains of a member, with curvatures multiplied by the
 * length of the model; 0: there are none. */
double linear_initial(const model *);
/* Stresses of the whole structure, including those due to initial strains and to temperatures at
 * `path`. Not for motions. */
status linear_whole_stresses(const equations *, const double x[], double path, double sigma[],
                             fault *);
status linear_geometric_stiffness(const equations *, const double sigma[], double path, sparse *G,
                                  fault *); /* sum sigma H + J^T G(sigma) J; offsets included */

/* Linear solutions about the undeformed state. */

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

/* The last states of a path, oldest first, for extrapolation. */

typedef struct predictor {
    int count, iterations; /* iterations: number in the last step */
    int most;              /* largest number of states used for an extrapolation */
    model_state *at[MODEL_EXTRAPOLATED + 1]; /* NULL: not allocated yet */
    /* [m] error that an extrapolation of the last state from k states would have had; k = 1: the
     * previous state unchanged */
    double error[MODEL_EXTRAPOLATED + 1];
} predictor;

status predictor_alloc(const model *, predictor *, fault *); /* contains the undeformed state */
void predictor_free(predictor *);
status predictor_add(const equations *, const model_state *, int iterations, predictor *, fault *);
void predictor_forget(predictor *);
/* Moves the last state s to an extrapolation for `path`; leaves s unchanged if there is none. */
void predictor_guess(const equations *, const predictor *, double path, model_state *s);

/* Newton's method in coordinates, strains and stresses together (N section 4), used by every
 * nonlinear analysis. */

typedef struct newton_run {
    analysis_context *c;
    model_state *state, *backup;
    predictor *predictor;    /* NULL: every step starts from the last state */
    condensation *condensed; /* NULL: no member is condensed; else K is not assembled */
    sparse K;
    sparse whole; /* matrix including the prescribed coordinates; without values: not requested */
    matrix_factor *factor;
    double *residual, *dx;   /* [free + driven] */
    double *dense, *unknown; /* for the uncondensed system, allocated on request */
    int *pivot;
    double *column; /* [conditions x (free + driven)], after dx */
    double
        *weight; /* [free + driven] weights of metric_of, which scale displacements and rotations */
    double energy; /* |r . K^-1 r| of the last residual r [J]; NAN: unknown */
    double path;   /* target of newton_to */
    arrival arrival;
    int max_iterations, free, all;
    long counted; /* number of factorisations already in the model's counters */
} newton_run;

/* condense 1: members with many elements are condensed. */
status newton_alloc(analysis_context *, int condense, newton_run *, fault *);
void newton_free(newton_run *);
/* After this call K also contains the prescribed coordinates. */
status newton_keep_driven(newton_run *, fault *);

/* One correction of a Newton iteration. */
typedef struct newton_correction {
    double at;     /* target path parameter or, in a motion, instant [s] */
    double size;   /* dimensionless size of the change: advance_state */
    double energy; /* |r . K^-1 r| of the residual r before the correction [J]; NAN: unknown */
    advance_stress stress;
} newton_correction;

/* Computes K, its factors and dx = K^-1 residual in the present state for the loads and drivers at
 * `path`; dx includes the drivers. */
status newton_direction(newton_run *, double path, step_record *, fault *);
/* Updates the state by dx; `path` is the new path parameter. */
void newton_advance(newton_run *, double path, newton_correction *);
/* Returns NOT_CONVERGED if the initial rise of a curved element exceeds the range of the
 * formulation. */
status newton_judge_rest(const model *m, fault *f);
/* Checks an accepted state against the previous one. NOT_CONVERGED names an element that rotates
 * beyond the range of its formulation, a spring whose rotation vector has lost its direction, or
 * a prescribed coordinate that moves too far in one step. If the rotation vector of a node loses
 * its direction, it is NaN from then on. */
status newton_accept(const model *, const model_state *from, model_state *, fault *);

/* Parts of Newton's method that depend on the analysis. */
typedef struct newton_use {
    void *of;
    newton_run *on;  /* for a path: newton_accept checks the states, and a state far from its first
                        correction, possibly another equilibrium, does not count as converged; NULL:
                        for a motion */
    int least, most; /* smallest and largest number of iterations */
    /* Solves the equations of the present state and applies the correction. */
    status (*correct)(void *of, int iteration, newton_correction *, step_record *, fault *);
    void (*prepare)(void *of, int iteration,
                    double correction);  /* called before another iteration; may be NULL */
    status (*accept)(void *of, fault *); /* called after convergence; NULL: every state is
                                            accepted */
} newton_use;

/* Newton's method for the states of a path. */
newton_use newton_on_path(newton_run *, void *of,
                          status (*correct)(void *of, int iteration, newton_correction *,
                                            step_record *, fault *));
/* Newton's method for time steps. */
newton_use newton_in_time(const analysis_context *, void *of,
                          status (*correct)(void *of, int iteration, newton_correction *,
                                            step_record *, fault *),
                          void (*prepare)(void *of, int iteration, double correction));

/* Newton's method for every nonlinear step, with common limits. Returns OK, or NOT_CONVERGED
 * with the reason. Each correction is added to the counters, to the records and to `arrival`. */
status newton_iterate(analysis_context *, const newton_use *, arrival *, step_record *, fault *);

/* Moves the state to `path` by Newton's method. Returns OK, or NOT_CONVERGED with the reason. */
status newton_to(newton_run *, double path, step_record *, fault *);

/* Quadratic forms of the undeformed structure and of the stresses of a linear solution. They are
 * computed from the element strains. Unlike products with assembled matrices, they do not lose
 * the digits of soft motions. */

typedef struct quadratic_forms {
    const equations *eq;
    int free;
    double *load_x;    /* [free + driven] displacements due to the loads; all zero: there is no
                          prestress ... */
    double *sigma;     /* ... and their stresses [elements x strains] */
    sparse loads;      /* contribution of the loads to K */
    double *x, *force; /* [free + driven] x has zeros for the prescribed coordinates */
    double *stress, *product; /* [elements x strains], [free] */
} quadratic_forms;

status quadratic_forms_alloc(const equations *eq, const sparse *pattern, quadratic_forms *p,
                             fault *f);
void quadratic_forms_free(quadratic_forms *p);
/* Sets the loads at `path` and their stresses, after load_x has been set. whole 1: includes the
 * stresses due to initial strains. */
status quadratic_forms_load(const equations *, quadratic_forms *p, double path, int whole,
                            fault *f);

/* Return x^T K x and x^T G x for x[free], and bounds of their rounding errors. */
double quadratic_forms_stiffness(quadratic_forms *p, const double x[]);
double quadratic_forms_geometric(quadratic_forms *p, const double x[]);
double quadratic_forms_stiffness_rounding(quadratic_forms *p, const double x[]);
double quadratic_forms_geometric_rounding(quadratic_forms *p, const double x[]);
/* y[free] = K x[free] */
void quadratic_forms_product(quadratic_forms *p, const double x[], double y[]);

/* A quantity that has been extracted from an outcome. */

/* Marks the quantity as having no value. An outcome with STATUS_OK that lacks the value gives
 * STATUS_NO_VALUE; any other status is kept. */
void quantity_no_value(quantity_result *, status, const char *reason);
/* Returns the value times the factor of the quantity, plus its offset. */
double quantity_scaled(const scene_quantity *, double value);

/* As quantity_scaled, for the abscissa of its curve. */
double quantity_abscissa(const scene_quantity *, double x);
/* Allocates a curve with the given number of points. Returns 0 if out of memory, and records this
 * in the result. */
int quantity_curve(quantity_result *, int points);

/* Stopping criterion of iterative refinement of a linear solution, and the resulting accuracy.
 *
 * Residuals come from element strains. If the factors have a relative error q (about eps times the
 * condition of K), every correction is q times the previous one, until the rounding of the forces
 * limits them (N.J. Higham, Accuracy and Stability of Numerical Algorithms (2002), section 12.1): x
 * is then the solution for loads rounded in their last digit, and the correction is its error. This
 * level depends on the problem, not on the mesh or on K. Example: a bar of length L is pushed along
 * an oblique axis, so the components of the force are rounded; the transverse displacement eps
 * P L^3/(3 EI) is eps (L/r)^2/3 relative to P L/(EA). Measured with square bars of side L/10 to
 * L/1e5, 1 to 256 elements, three oblique axes and every formulation: at most 2.5 eps (L/side)^2
 * where this exceeds the rounding due to the mesh (170 times that for the geometrically exact
 * element, whose factors are the worst). The accuracy does not depend on the condition, which
 * ranges from 1 to 2e16; q ranges from 0 to 0.08 (0.8 for the geometrically exact element). */

typedef enum refinement_state {
    REFINEMENT_GOES_ON,
    REFINEMENT_ENDS,
    REFINEMENT_LOST
} refinement_state;

/* Initialise the structure with {0}. */
typedef struct solution_refinement {
    int corrections; /* number of corrections; the first one is the solution itself */
    double last;     /* last correction, relative to the solution */
} solution_refinement;

/* Decides from the size of a correction relative to the solution whether to continue: at least two
 * corrections follow the first, and more as long as they halve and the accuracy is insufficient. */
refinement_state refinement_next(solution_refinement *, double correction);

/* A frame that rotates at a constant rate. */

/* Mass matrix on the pattern of M about a state (NULL: undeformed). G: gyroscopic matrix of a
 * rotating frame (a symmetric pattern stores its upper triangle), or NULL. */
status rotating_frame_inertia(const equations *, const model_state *, double path, sparse *M,
                              sparse *G, fault *);

/* Returns x^T B x of the undeformed structure for x[free + driven]: the effect of the mass
 * inside elements on a mode, k = lambda m + lambda^2 b (elements/field/field.h). */
double rotating_frame_inner(const model *, const double x[]);
/* Computes B on the pattern of a symmetric K. Returns 0 if B is zero because no element has such a
 * matrix. */
int rotating_frame_inner_matrix(const equations *, sparse *out);

/* Explains why a stiffness matrix cannot be factored. */

/* Returns SINGULAR and describes the motion in f when released ends make the undeformed structure a
 * mechanism; otherwise returns `otherwise` and leaves f unchanged. */
status singular_mechanism(const analysis_context *c, status otherwise, fault *f);

/* Call after a factorisation has failed. Sets the fault with the cause: a part without supports;
 * digits lost in round-off because of many elements or very different stiffnesses; otherwise a
 * critical point. The work of this search is not counted. */
void singular_explain(analysis_context *c, fault *f);

/* The tangent of a state as a sum of two parts. */

/* Products of K of the last linearisation with x, in two parts. The stiff part is computed from the
 * element strains, y += sum J^T P'' (J x); an assembled matrix would lose all digits of the soft
 * motions. x, y: [free + driven]. The other part is a matrix on the pattern of G: sum sigma_i H_i
 * with the second derivatives of offsets and sequences, minus the stiffness of loads and
 * rotation. */
void stiffness_parts_material_product(const model *, const linear_memory *, const model_state *,
                                      const double x[], double y[]);
/* Returns a bound of the rounding error of x^T K x for the material part. */
double stiffness_parts_material_rounding(const model *, const linear_memory *, const model_state *,
                                         const double x[]);
status stiffness_parts_geometric(const equations *, const linear_memory *, const model_state *,
                                 sparse *G, fault *);

/* All unknowns in one system. */

/* The uncondensed dense system (column-major A[n x n], b[n] with n = uncondensed_size +
 * conditions), with unknowns in the order free coordinates, strains, stresses, drivers of
 * conditions; load[free + driven] is work space. */
int uncondensed_size(const model *);
status uncondensed_system(const equations *, const model_state *, double path, const double drive[],
                          int conditions, const model_condition condition[], double A[], double b[],
                          double load[], fault *);

#endif
