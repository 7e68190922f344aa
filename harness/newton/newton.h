/* newton/: equations of a model, Newton's method, tangents, condensation, outcomes.
 *
 * Sections, in this order: equations of a model; advance (a state after a correction); applied
 * loads; arrival (convergence); condensation of members; modes; outcomes of analyses; shapes;
 * rows; system matrices; solve_options and solve_result; the context of an analysis; bordered
 * tangent; tangent of a node; distributed loads; equations of elements; loads along a path;
 * linearise; chunk (elements in one go); convention of moments; extrapolate; history; identity;
 * internal (section resultants, stresses); undeformed state; linear solutions; predictor;
 * newton; quadratic forms; quantity results; refinement; rotating frame; singular; tangent in
 * parts; uncondensed. */
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

/* The equations of a model under a loading, and data that a run changes in addition to its states.
 * The model and the loading do not change. Nothing of it outlives a solution. */

/* Work done so far. */
typedef struct counters {
    long strain_evaluations, stress_evaluations, inertia_evaluations;
    long geometric_evaluations; /* of the stiffness of a prestress */
    long iterations, steps, rejected_steps, factorisations, solutions;
    long factor_entries;
    double factor_flops;
    double dense_operations; /* n^3 of every eigenvalue problem solved densely */
    long negative_pivots;    /* most of a symmetric tangent at a state that was reached */
    double condition; /* largest estimate of the solved systems (factor_condition), where it was
                         requested; else 0 */
} counters;

/* Derivatives of elements at rest: harness/newton/newton_impl.h. */
typedef struct run_undeformed {
    int *of;         /* [elements] index of its values, or NONE; NULL: nothing is known */
    int count, room; /* of values */
    int last;        /* element that the last of them are of */
    double *value;   /* [room x (J, C, initial stresses)] */
} run_undeformed;

/* Data of all elements, from linearise_state for advance_state. */
typedef struct linear_memory {
    double *slot; /* [elements x model.work_size]: J, C, P' + C (D - e), D - e, memory of the last
                     linearisation */
} linear_memory;

/* Loads along members that are lumped at the ends of elements. */
enum { LUMPS_NOTHING, LUMPS_WEIGHTS, LUMPS_LOADS };

/* Meaning of the path parameter, loads, and rotation of the axes of one analysis. */
typedef struct loading {
    int in_time;      /* the path parameter is the time: loads and drivers are functions of that */
    double held_path; /* path parameter of loads and drivers that are no function of time */
    int unloaded;     /* neither loads nor drivers act */
    int lumps;        /* LUMPS_* */
    element_rotating_frame frame; /* its velocity times the path if that is followed */
    int rotates, rotation_follows_path;
} loading;

/* Stresses of a motion gain eta S0 e', eta of the member, and those of dashpots C e': see
 * harness/time/time.h. */
typedef struct run_damping {
    double *stiffness;          /* [kinds x strains^2] S0 */
    double *none;               /* [model_stresses] zero */
    double *begin;              /* [model_stresses] strains of the state that rates are from */
    double g;                   /* e' = known + g (e - from) */
    const double *known, *from; /* [model_stresses] */
    spring_rates springs;       /* the same of the springs */
} run_damping;

/* NULL: nothing moves, or none is a dashpot. */
static inline const spring_rates *damping_of_springs(const run_damping *d)
{
    return d != NULL ? &d->springs : NULL;
}

struct run_ahead;
struct run_free;
struct element_part;

typedef struct run_state {
    assemble_patterns *patterns; /* of the matrices of the model, made when they are requested */
    counters counters;
    phases phases;
    thread_team *team;         /* of the loop over elements; NULL: one thread */
    struct element_part *part; /* of a few elements, before they are added up in order; NULL: none
                                  yet */
    struct run_ahead *ahead; /* one block; NULL: nothing has been evaluated ahead: newton_impl.h */
    run_undeformed undeformed;
    struct run_free *free_strain; /* free_strain.c; NULL: no type alters its data */
    run_damping *damping;         /* of a motion; NULL: none */
    linear_memory memory;         /* of callers that linearise one state at a time */
} run_state;

typedef struct equations {
    const model *m;
    loading loading;
    run_state *run;
} equations;

status linear_memory_alloc(const model *, linear_memory *, fault *);
void linear_memory_free(linear_memory *);

/* For a model, nothing done yet. threads share the loop over elements; 0, 1: one. Sums keep their
 * order: results do not depend on it. */
status run_state_begin(run_state *, const model *, int threads, fault *);
void run_state_end(run_state *);
/* Rotation of the frame at that path parameter. */
element_rotating_frame loading_frame(const loading *, double path);

/* Update of a state by the solution of the linearised equations. */

/* Largest stresses of all elements [N]. */
typedef struct advance_stress {
    double largest, change; /* after it; by it */
} advance_stress;

/* After linearise_state with that memory and K dx = residual: strains, stresses, inner unknowns of
 * every element and then the frames take their increments. dx[free + driven]. Returns the largest
 * correction, dimensionless: translations by the size of the scene, rotations in rad, warping by
 * the element length, inner unknowns as the element defines. stress: NULL: not needed. */
double advance_state(const equations *, const linear_memory *, model_state *, const double dx[],
                     double path, advance_stress *);
/* The state is in equilibrium: the next increments start from it with the tangent of the last
 * linearisation, and nothing that this had left open is closed again. */
void advance_settle(const model *, const linear_memory *, const model_state *);

/* Forces of a load on the vertices of a mesh, in a state. */

typedef struct applied {
    int vertex;
    int follower;  /* 1: F turns with the vertex */
    int offset;    /* 1: arm is not zero */
    double F[6];   /* force and spatial moment [N, N m] */
    double arm[3]; /* from the vertex to where the force acts, with which it turns [m] */
} applied;

/* Factor of the load at `path`, or in time (loading_of). */
double applied_factor(const equations *, const scene_load *load, double path);
/* Along the whole of a member, where it goes to nodes with a motion's mass by the shares of that;
 * not by the load's own wish. */
int applied_with_mass(const scene_load *);
/* The load times `scale`.  Along members it is lumped at the nodes of elements, by linear shares,
 * or quadratic ones with a middle node: of a uniform load 1/2, 1/2, or Simpson's weights. */
void applied_each(const model *, const model_state *, const scene_load *, double scale,
                  void (*take)(void *context, const applied *), void *context);
/* The same of a load along the member of this element, and of this element alone. */
void applied_element(const model *, const model_state *, const scene_load *, double scale,
                     int element, void (*take)(void *context, const applied *), void *context);
/* The part [from, to] of an element that a load along its member acts on; of a point load
 * both are its position, in the element after it. 0: the load acts elsewhere. */
int applied_part(const model *, int element, const scene_load *, double part[2]);
/* 1: x is inside the element, not at an end. */
int applied_inside(double x);
/* Vector of a load along the member at x in [0, 1] of an element, as the scene gives it. */
void applied_vector(const model *, int element, const scene_load *, double x, double vector[3]);
/* The undeformed member's axes, y as the scene gives it, from the triad of a place of it, whose y
 * and z are the principal ones of the section. */
void applied_member_axes(const double triad[9], const section *, double axes[9]);

/* Adds the load times `scale` to K, entry by entry; some are zero, some at the same position. */
typedef void (*loads_entry)(void *context, int row, int column, double value);
void applied_stiffness(const model *, const model_state *, const scene_load *, double scale,
                       loads_entry take, void *context);

/* Convergence test of Newton's method: size of the last corrections of motions and stresses, and
 * their rate of decrease. */

/* Convergence history along one path. All members except `stress` are dimensionless. */
typedef struct arrival {
    double criterion;          /* requested; 0: that of rounding */
    double small;              /* largest of two corrections after another that ends a step */
    double correction, before; /* the last one; the one before it in the same step, or INFINITY */
    double stress;             /* largest one of the path so far [N] */
    double stress_change;      /* by the last correction, relative to it */
    double contraction;        /* last ratio of a correction to the square of the one before it;
                                  NAN: none */
    double remaining;          /* size of the next correction, predicted; NAN: not known */
} arrival;

/* differences 1: derivatives are differences, whose noise keeps corrections from contracting: the
 * first small one is the last. elements: rounding of the positions of very many keeps corrections
 * from becoming smaller. */
void arrival_start(double criterion, int differences, int elements, arrival *);
/* A correction was made, with what it did to the stresses; `first` of its step. */
void arrival_take(double correction, const advance_stress *, int first, arrival *);
/* 1: another correction would change nothing. */
int arrival_reached(const arrival *);
/* 1: the state has moved so little since the last linearisation that its tangent is that of the
 * state, up to rounding. */
int arrival_tangent_stands(const arrival *);

/* Members condensed to their ends before the tangent is solved, and back.
 *
 * Where members have many elements the assembled tangent loses digits with the fourth power of
 * their number, which flexibilities of members (newton_impl.h) do not; and the remaining system is
 * as small as with one element per member. */

typedef struct condensation condensation;

/* Least number of elements of a member: with fewer, the assembled tangent costs less and has enough
 * digits. */
enum { CONDENSATION_ELEMENTS = 1000 };

/* *out NULL: members have fewer elements than `from`, or something acts between their ends that has
 * a stiffness, or frames turn. released[count]: prescribed coordinates that are unknown too. */
status condensation_alloc(const equations *, int from, int count, const int released[],
                          condensation **out, fault *);
/* The members of `of`, which must outlive it, with other released coordinates: condensation_take.
 */
status condensation_alloc_like(const condensation *of, int count, const int released[],
                               condensation **out, fault *);
void condensation_free(condensation *);

/* The tangent of the last linearise_state with these arguments, in parts: members are condensed. */
status condensation_at(condensation *, const model_state *, double path, fault *);
/* The tangent that `of`, whose members these are, has in the state. */
void condensation_take(condensation *, const condensation *of, const model_state *);
/* On all coordinates, to be altered before it is factored; entries between ends only. */
sparse *condensation_ends(condensation *);
/* SINGULAR as factor_numeric, or where a member has a critical state of its own. */
status condensation_factor(condensation *, fault *);
/* x[free + driven] := K^-1 x on the unknowns; transposed: K^-T. */
void condensation_solve(condensation *, int transposed, double x[]);
factor_counts condensation_count(const condensation *);
/* A factor that solves by it and owns it. */
status condensation_as_factor(condensation *, matrix_factor **, fault *);

/* Shape of a mode of vibration or buckling. */

typedef struct mode_shape {
    scene_family family;
    int half_waves;
} mode_shape;
status modes_identify(const model *, const scene *, const double mode[], mode_shape *, fault *);
int modes_in_family(const scene_mode *, const mode_shape *); /* 1: the quantity asks for it */
const char *modes_family_name(scene_family);
/* Modes of equal value[count], one after the other (each [n = free + driven]), may be mixed in any
 * way: they become those that move along the members' z axes and those that do not. */
status modes_separate(const model *, const scene *, int count, const double value[], size_t n,
                      double *mode, fault *);

/* Results of an analysis, for quantities and for analyses that follow it. */

/* Critical loads of one sign, ascending in size, or frequencies [rad/s], ascending; with their
 * modes. */
typedef struct outcome_side {
    int count;
    double *value, *mode; /* [count] NAN: lost in round-off; [count x free] */
    double *error;  /* [count] estimated relative error by iteration and round-off; NULL: there is
                       none */
    double *growth; /* [count] of damped modes [1/s], behind value; NULL: of others. Their error is
                       that of growth + i value */
    status status;  /* NOT_CONVERGED: ... */
    char reason[FAULT_TEXT]; /* ... why there are no more, or some are lost */
} outcome_side;
/* Small motions about one state of a stationary rotation. */
typedef struct rotation_modes {
    int count;
    double *frequency, *growth; /* [count] [rad/s], [1/s] */
    double *error; /* [count] estimated relative error of lambda = growth + i frequency by iteration
                      and round-off */
    mode_shape *shape; /* [count] */
    int negative;      /* eigenvalues of the stiffness, and ... */
    int unproven;      /* ... those of them that the modes do not account for */
} rotation_modes;
void outcome_modes_free(rotation_modes *);

enum { OUTCOME_MEANING = 128 };
/* Buckling, modal; what was found stays where the analysis failed. */
typedef struct outcome_spectrum {
    outcome_side positive, negative; /* frequencies are positive */
    char meaning[OUTCOME_MEANING];   /* with or without the damping of members, or how stability is
                                        lost; "": nothing is damped, and loads have a potential */
    double growth;    /* [1/s] of modes about a state without potential, the largest; 0: stable */
    double *strained; /* [free + driven] displacements by initial strains alone, about which modes
                         of the structure without loads are; NULL: there are none */
} outcome_spectrum;

/* Stations of a path: static, and the first member of the three below. */
typedef struct outcome_path {
    int stations, reached; /* the first `reached` of them */
    double *value;         /* [stations] of the path parameter or the control coordinate */
    model_state **state;   /* [stations]; NULL: of a compliance */
} outcome_path;

/* Compliance C and stiffness K of a node at one station. */
typedef struct station_matrices {
    int known;
    double C[36], K[36];
} station_matrices;

typedef struct outcome_compliance {
    outcome_path path;
    /* of the six components at the node, at every station [stations x 36]; rows of fixed components
     * are zero, columns that are not requested NaN; belongs to the result */
    const double *matrix;
    station_matrices *taken; /* [stations] on the way along the path; NULL: none */
} outcome_compliance;

typedef struct outcome_rotation {
    outcome_path path;
    rotation_modes *modes; /* [stations]; NULL where no quantity asks for them */
} outcome_rotation;

/* State of a motion at one instant, from scene_balance. */
typedef struct outcome_instant {
    double *rate, *acceleration; /* [free + driven]: see harness/time/time_impl.h; one block */
    double balance[SCENE_BALANCES];
} outcome_instant;

/* Extreme or crossing of one quantity during a motion, not only at its stations. */
enum { PASSING_LOST = 2 }; /* a turn has lost its direction (harness/model/model.h) */
typedef struct outcome_passing {
    int known;    /* 1, 0: not, or PASSING_LOST */
    double value; /* as extracted, or a time [s], or how often in a second */
    double time;  /* [s] of a largest or least value */
    double error; /* estimate of what reading it between the ends of steps adds to the value */
} outcome_passing;

/* End of an accepted step of a motion; the first one is the initial state. */
typedef struct outcome_step {
    double time, step;        /* [s] its end and length; 0 of the initial state */
    double error;             /* estimate of what it adds to positions, in the measure of model.h;
                                 0: not requested */
    int iterations, rejected; /* rejected: longer ones that were tried before it */
    double balance[SCENE_BALANCES];
} outcome_step;

/* End of a motion: all that another one needs to continue it. */
typedef struct outcome_end {
    int analysis;            /* of the scene */
    double time, step;       /* [s] step: the next one */
    double path;             /* of the state */
    double work, dissipated; /* [J] since t = 0 */
    double largest, origin;  /* [J] largest energy so far; that at t = 0 */
    double turned;           /* [J] sum of the work of all steps, whatever their signs */
    double scale, extent, rate, density; /* of time_impl.h */
    double stress, contraction;          /* of Newton's convergence */
    int quiet;                           /* steps since the last discontinuity of the loads */
    size_t states, coordinates, strains, released, between;
    double *value; /* [2 states + 3 coordinates + 2 strains + released + 5 between]; NULL: none. The
                      state; the initial one; rates, their derivatives, and those that
                      generalized-alpha averages; rates of damped strains and their derivatives;
                      rates of released ends as conserving steps have them; turns of nodes against
                      others (model.h) */
} outcome_end;
/* How many numbers `value` has. */
size_t outcome_end_values(const outcome_end *);
void outcome_end_free(outcome_end *);

typedef struct outcome_motion {
    outcome_path path;
    outcome_instant *instant; /* [stations] */
    int steps;                /* with the initial state */
    outcome_step *step;       /* [steps] */
    outcome_passing *passing; /* [quantities of the scene] */
    double *slope;            /* [quantities of the scene x stations] of those whose values are
                                 slopes inside steps; NULL: there is none */
    outcome_path frames;      /* for pictures, evenly over the time */
    double origin;            /* [J] energy at t = 0 of the first motion of a chain */
    outcome_end end;
} outcome_motion;

typedef struct outcome_harmonic {
    outcome_path path; /* frequencies [Hz]; no states */
    double *response;  /* [quantities of the scene x stations] as extracted */
    double *bound;     /* the same: error by omitted modes, at most */
} outcome_harmonic;

typedef struct outcome_continuation {
    outcome_path path;
    int points;               /* of the path, the first without load */
    double *factor, *control; /* [points] load factor and control value [m] */
    int undecided;            /* 1: the number of critical points between these load factors is not
                                 known: only the events before are */
    int decided_events;
    double undecided_from, undecided_to;
    model_state **state; /* [points] of nodes; NULL unless a curve of coordinates is wanted */
} outcome_continuation;

typedef struct analysis_outcome {
    scene_analysis_kind kind;
    status status;
    char reason[FAULT_TEXT];
    union {        /* written by the analysis, read through the functions below */
        double *x; /* linear: displacements of all coordinates */
        outcome_spectrum spectrum;
        outcome_path path; /* static */
        outcome_compliance compliance;
        outcome_rotation rotation;
        outcome_continuation continuation;
        outcome_motion motion;
        outcome_harmonic harmonic;
    } left;
} analysis_outcome;

/* Return the results of an analysis of that kind; another kind ends the program. */
const double *outcome_displacements(const analysis_outcome *);
const outcome_spectrum *outcome_spectrum_of(const analysis_outcome *);
/* Returns the path of any analysis along a path. */
const outcome_path *outcome_path_of(const analysis_outcome *);
const outcome_compliance *outcome_compliance_of(const analysis_outcome *);
const outcome_rotation *outcome_rotation_of(const analysis_outcome *);
const outcome_motion *outcome_motion_of(const analysis_outcome *);
/* Returns the outcome of a motion, to be filled. */
outcome_motion *outcome_motion_in(analysis_outcome *);
const outcome_continuation *outcome_continuation_of(const analysis_outcome *);
/* A static path, or that of a stationary rotation, to be filled. */
outcome_path *outcome_walk(analysis_outcome *);
int outcome_has_path(const analysis_outcome *);
int outcome_has_spectrum(const analysis_outcome *);
void outcome_free(analysis_outcome *);
/* The values and modes of a side; they are taken from `from`. */
void outcome_take(eigen_side *from, outcome_side *to);
/* Room for the states of that many stations. */
status outcome_stations(outcome_path *, int stations, fault *);
/* A copy of the state becomes that of the next station; whole 0: of its nodes
 * (kinematics_nodes_alloc). */
status outcome_keep(outcome_path *, const model *, const model_state *, int whole, double path,
                    fault *);

/* Shapes of a structure in chosen states; kept where a solution requests them. */

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
    int analysis; /* of the scene; -1: none */
    double value; /* path parameter [1], load factor [1], frequency [Hz] or time [s] */
    double scale; /* the displacements are this many times those of the eigenvector; 1 elsewhere */
} shape_state;

typedef struct shapes {
    int states, members, points, nodes; /* states 0: not requested */
    int *first;                         /* [members + 1] point where each member begins */
    shape_state *state;                 /* [states] */
    centreline_point *point;            /* [states x points] */
    double *node;                       /* [states x nodes x 3] [m] */
} shapes;

enum { SHAPES_ALL = 1 << 30, SHAPES_MODES = 6, SHAPES_FRAMES = 60, SHAPES_FEW = 5 };

/* Empty arrays for that many of each; FAULT: out of memory. */
status shapes_alloc(shapes *, fault *);
void shapes_free(shapes *);
const char *shapes_kind_name(shape_kind);
/* Frames of a motion, evenly over its time, where at most that many states of a path are kept: as
 * many, and SHAPES_FRAMES where these are all or few. */
int shapes_frames(int most);

/* Degrees of freedom of the rows of a model's matrices. */

typedef struct row_label {
    int node;   /* of the scene; SCENE_NONE: inside a member, or an end that keeps motions to itself
                 */
    int member; /* SCENE_NONE: of the node alone */
    double along; /* from the member's beginning, relative to its length; NAN: of a node alone */
    double position[3];    /* undeformed [m] */
    const char *component; /* "ux", ..., "rz", "angle 1" of a sequence, "turn 1" and "shift 1" of a
                              released end, "warping" */
    const char *unit;      /* of the coordinate: "m", "rad", "rad/m" */
} row_label;

/* out[free]; a coordinate that several nodes share is the first one's. */
void rows_label(const model *, row_label out[]);

/* Matrices of small motions about the states of a solution, for other programs:
 *   M q'' + (C + G) q' + K q = B u
 * with q the free coordinates in the order of the rows, u the changes of the loads' factors. */

typedef struct state_matrices {
    int analysis;        /* of the scene; SCENE_NONE: the undeformed structure at rest */
    int station;         /* of its path, from zero; SCENE_NONE: it has none */
    double path;         /* parameter of the loads and drivers */
    int turns;           /* 1: the axes turn, and there is G */
    triplets K, M, G, C; /* C: damping, where something is damped */
    triplets inside;     /* of the undeformed structure: what its mass does inside of elements, for
                            frequencies: q.K q = lambda q.M q + lambda^2 q.inside q */
    triplets B;          /* [rows x loads] generalised force of each load at factor 1 */
    int modes;           /* of a modal analysis: what it found, ascending; else 0 */
    double *frequency, *mode; /* [modes] [rad/s]; [modes x rows] */
} state_matrices;

typedef struct system_matrices {
    int rows;         /* free coordinates */
    row_label *label; /* [rows] */
    int states, room; /* 0: not requested */
    state_matrices *state;
} system_matrices;

void system_matrices_free(system_matrices *);

/* Options and results of a solution: quantities, steps, iterations, events, matrices, shapes. */

typedef struct solve_options {
    int threads; /* of the loop over elements; 0, 1: one */
    newton_form newton;
    double criterion;   /* relative size of the corrections; 0: default */
    int max_iterations; /* per step; 0: default */
    int steps_between;  /* overrides the scene's; 0: the scene's */
    int condition; /* 1: estimate the condition of the tangents (of a static path: at its stations)
                    */
    int condensed; /* elements of a member from which on it is condensed to its ends; 0: default */
    int phases;    /* 1: read the clock between the parts of an iteration */
    int sample;    /* > 0: only N iterations of each static path, to measure their time: there are
                     no values */
    int shapes;    /* most states of every path whose centre lines are kept; 0: no shapes */
    int systems;   /* 1: the matrices of small motions about all states are kept */
    int whole_steps; /* 1: a step in time that fails ends the motion, instead of being halved */
    int keep_ends;   /* 1: the ends of motions are kept, for another run that resumes there */
    int restarts;
    const outcome_end *restart; /* [restarts] ends in another run that motions resume from */
    int all_analyses;           /* 1: those that no quantity reads run, too */
    int looks;       /* 1: static paths are evaluated where pivots do not, and within their steps */
    int values_only; /* 1: what only curves and matrices show at a station is not computed */
} solve_options;

typedef struct curve {
    int points;
    double *x, *value;
} curve;

typedef struct quantity_result {
    status status;   /* OK: value is a number */
    double value;    /* NAN where it does not exist */
    double x;        /* abscissa where a maximum or minimum was found */
    double rounding; /* critical loads, frequencies: estimate of |error| by round-off; of a motion
                        what reading it between its steps adds; of a response by modes the most that
                        omitted ones add; relative to the value, of a curve to its largest; else 0
                      */
    double change;   /* from the mesh that was solved before, by the value; of a curve, by its
                        largest; NAN: not known */
    curve curve;     /* of SCENE_CURVE, else 0 points */
    char reason[FAULT_TEXT];       /* why there is no value */
    char meaning[OUTCOME_MEANING]; /* see outcome_spectrum */
} quantity_result;

/* All dimensionless.  Quadratic convergence: each correction is about the square of the one
 * before. */
typedef struct iteration_record {
    double residual; /* sqrt(r . K^-1 r) of the unbalanced forces r before it, by that of the step's
                        first; NAN: newton=dense */
    double correction;      /* what the iteration changed: advance_state */
    double incompatibility; /* max |D(x) - e|/l before it */
} iteration_record;

/* Stability of a state under small disturbances with fixed and prescribed coordinates unchanged. */
typedef enum step_stability {
    STEP_OPEN, /* not decided by the signs of pivots: no symmetric tangent, or axes that turn */
    STEP_NO_DIVERGENCE, /* no symmetric tangent and no mass: no eigenvalue has passed zero */
    STEP_STABLE,
    STEP_UNSTABLE,
    STEP_GROWS, /* in rotating axes, or without a symmetric tangent: a small motion grows, by an
                   odd number of negative eigenvalues (det K < 0) or by a mode that was found */
    STEP_HELD,  /* in rotating axes: held by gyroscopic forces alone, no motion grows without
                   damping; one that turns with the structure makes it grow */
    STEP_STABILITIES
} step_stability;
const char *result_stability_name(step_stability);
int result_is_unstable(step_stability);

typedef struct step_record {
    int analysis;             /* of the scene */
    step_stability stability; /* where it ended */
    double path, increment;
    int iterations, rejected,
        negative_pivots;   /* rejected: tries of longer steps that failed before this one */
    int by_eigenvalues;    /* 1: its tangent is not symmetric; its eigenvalues were followed: */
    int passed;            /* that many have passed zero */
    step_stability judged; /* by the frequencies of small motions; STEP_OPEN: not asked or known */
    double residual, correction, incompatibility; /* of the last iteration */
    double remaining; /* what the next one would have changed, as the contraction so far predicts;
                         NAN: not known */
    int first;        /* of its iterations in solve_result.iteration */
    double energy;    /* r . K^-1 r of the first one [J] */
} step_record;

/* Compliance and stiffness [6 x 6] (ux uy uz thx thy thz by Fx Fy Fz Mx My Mz; SI) of a node at
 * stations of a path. */
typedef struct nodal_matrices {
    int node;
    scene_moments moments; /* convention */
    int stations;
    double *path;                   /* [stations] */
    double *compliance, *stiffness; /* [stations x 36]; fixed components: zero; not computed because
                                       nothing asked: NAN */
} nodal_matrices;
/* Event on a continued path. */
typedef enum event_kind {
    EVENT_LIMIT_POINT, /* the load has an extremum */
    EVENT_BIFURCATION, /* other branches start here; this one is followed */
    EVENT_BRANCH_JUMP, /* a step converged to another branch: it was noticed and not followed */
    EVENT_KINDS
} event_kind;

typedef struct path_event {
    event_kind kind;
    int analysis, negative_before,
        negative_after;     /* negative pivots of the tangent stiffness; -1: not symmetric */
    double factor, control; /* of the point; of a jump: where both branches have this value of the
                               control coordinate [m] */
    double other_factor;    /* of a jump: on the branch that was not followed; else NAN */
    double measure; /* of a point: |phi . f|/(|phi| |f|), null vector phi, load f; of a jump:
                       distance of the branches */
} path_event;

/* One row of a transient analysis: the initial state, or the end of a step. */
typedef struct motion_record {
    int analysis; /* of the scene */
    double path;  /* parameter of the state that the motion starts from; NAN: it has none */
    outcome_step at;
} motion_record;

typedef struct solve_result {
    status status;
    char reason[FAULT_TEXT];
    int quantities;
    quantity_result *quantity; /* [scene quantities], same order */
    int steps;
    step_record *step;
    int iterations; /* of all the steps that were kept */
    iteration_record *iteration;
    int matrix_sets;
    nodal_matrices *matrices;
    int events;
    path_event *event;
    int motions;
    motion_record *motion; /* [motions] one motion after the other */
    int ends;
    outcome_end *end; /* [ends] of motions that no other motion of the scene continues */
    double seconds_setup,
        seconds_solve; /* scene, sections, quadrature, mesh, analysis of the pattern | the rest */
    counters counters; /* its work; of shapes and matrices none */
    double phase[PHASES]; /* [s] of seconds_solve, when requested */
    shapes shapes;
    system_matrices systems;
} solve_result;

const char *result_event_name(event_kind); /* "limit point", ... */
/* How many eigenvalues of the tangent pass zero there: one load each. */
int result_event_multiplicity(const path_event *);
void result_free(solve_result *);

/* Context of an analysis. */

/* Data that one analysis of a solution leaves for the next ones. */
typedef struct context_work {
    double setup;        /* [s] spent on patterns and symbolic factorisation */
    int singular;        /* 1: the last factorisation failed */
    matrix_factor *left; /* of the pattern of the free coordinates, no longer in use; NULL: none
                          */
} context_work;

typedef struct analysis_context {
    const scene *scene;
    const model *model;
    run_state *run; /* of that model */
    equations eq;   /* of that model, under the loading of the analysis: context_of */
    const solve_options *options;
    solve_result *result;       /* step records go here */
    analysis_outcome *outcomes; /* [analyses], those before the present one are complete */
    context_work *work;
} analysis_context;

/* Is the analysis requested, by what is read from it or by the options? */
int context_runs(const analysis_context *, int analysis);
/* Returns the context of an analysis, with its loading. In a motion, loads without a function of
 * time keep the value of the state that it starts from. */
analysis_context context_of(const analysis_context *, int analysis);
/* The same with no load acting and no driver moving: only initial strains of members remain. */
analysis_context context_unloaded(const analysis_context *);
/* Factors K numerically and records in the context whether the factors exist. */
status context_factor(analysis_context *, matrix_factor *, const sparse *K, fault *);
/* Condenses members of many elements. *out NULL: there are none, or the condition of the tangent of
 * all coordinates was requested. See condensation_alloc. */
status context_condensation(const analysis_context *, int count, const int released[],
                            condensation **out, fault *);
/* The same of a tangent whose members are condensed. */
status context_factor_condensed(analysis_context *, condensation *, fault *);
/* REFUSED where what was factored is not symmetric: `what` (critical loads) need that of the state.
 */
status context_symmetric(const matrix_factor *, const char *what, fault *f);
/* A symmetric factor of the pattern of the free coordinates is not needed any more: it is kept
 * where a compliance may ask for one, so that order and pattern need not be found again. */
void context_leave_factor(analysis_context *, matrix_factor *);
/* NULL: none was left. */
matrix_factor *context_take_factor(analysis_context *);
/* When it was requested: the condition of a matrix just factored, into the counters. */
void context_count_condition(const analysis_context *, matrix_factor *, const sparse *K);
/* The work of a solution with a factor, into the counters; fresh 0: its numbers are those of a
 * solution before. *counted: factorisations of it that are there already, and then are all. */
void context_count_solution(const analysis_context *, const matrix_factor *, int fresh,
                            long *counted);
/* The work of an eigenvalue problem, into the counters. */
void context_count_eigen(const analysis_context *, const eigen_result *);

/* Tangent of the free coordinates, bordered by the released coordinates of a node whose motion is
 * prescribed. */

enum { TANGENT_COMPONENTS = 6, TANGENT_BORDER = 12 };

/* Released coordinates: prescribed ones that are free now. */
typedef struct border {
    int count;
    int coordinate[TANGENT_BORDER];
    double *U, *V; /* [count x free]: K_fr; K_rf */
    double W[TANGENT_BORDER * TANGENT_BORDER];
} border;

/* Index of a released coordinate, or -1. */
int border_place(const border *, int coordinate);
/* Released coordinates of the analysis' node; matrices are allocated without values. */
status border_alloc(const analysis_context *, const scene_compliance *, border *, fault *);
void border_free(border *);
/* From K of all coordinates. */
void border_fill(border *, int free_count, const sparse *K);

/* Tangent of a structure in a deformed state about one node, where some of the node's prescribed
 * motion is released: its reaction has become a load. */

typedef struct node_tangent {
    condensation *condensed; /* NULL: no member is condensed; else K is not assembled, and what is
                                released is unknown with the rest */
    sparse K;         /* of all coordinates when something is released, else of the free ones */
    sparse inside;    /* free x free */
    sparse geometric; /* like K, where solutions are refined: see stiffness_parts_geometric */
    int refined;      /* 1: the condition asks for it */
    /* of `inside`, as last estimated (0: never), and the ratio of its pivots then. */
    double condition, apart;
    matrix_factor *own;    /* NULL: not needed so far */
    matrix_factor *factor; /* of `inside`: own, or that of the iteration that it was taken from */
    border border;
    int free, all;
    double *residual;
    const model_state *state;                   /* of K */
    int index[TANGENT_COMPONENTS], coordinates; /* the node's */
    double T[TANGENT_COMPONENTS * TANGENT_COMPONENTS];
} node_tangent;

/* members: whose chains it shares, to be taken from an iteration; NULL: none. */
status tangent_alloc(analysis_context *c, const scene_compliance *a, const condensation *members,
                     node_tangent *t, fault *f);
void tangent_free(node_tangent *t);
/* reaction[6]: force and moment of the prescription on the node [N, N m]. */
status tangent_at(analysis_context *c, const scene_compliance *a, const model_state *s,
                  const double reaction[6], node_tangent *t, fault *f);
/* The same from K [the pattern of all coordinates when something is released, else of the free
 * ones] of an iteration that ended at the state, and its factors. */
status tangent_take(analysis_context *c, const scene_compliance *a, const model_state *s,
                    const double reaction[6], const sparse *K, const sparse *inside,
                    matrix_factor *, node_tangent *t, fault *f);
/* The same from the condensed members of the iteration. */
status tangent_take_condensed(analysis_context *c, const scene_compliance *a, const model_state *s,
                              const double reaction[6], const condensation *members,
                              node_tangent *t, fault *f);
/* Takes out of the reaction's moment what acts along free turns: there is no prescription that
 * exerts it. */
void tangent_prescribed(const node_tangent *t, double moment[3]);
/* Motions that the node can make at all. */
void tangent_movable(const model *m, const node_tangent *t, movable *out);
/* C[6 x 6] of the node with the reaction's moment by the convention; columns outside `wanted`,
 * and rows and columns of what is not among the `components` that can move, stay zero. */
status tangent_compliance(analysis_context *c, node_tangent *t, unsigned wanted,
                          unsigned components, double C[36], fault *f);

/* Loads along members as they act between vertices: their work on the displacements within elements
 * (elements/field), or what an element makes of them in its own equilibrium, and what goes through
 * sections. */

/* Loads along one element, at a path parameter. */
typedef struct distributed_loads {
    const equations *eq;
    const model *m;
    int element;
    double path;
} distributed_loads;

/* Does the load do its work within elements? Else halves of it go to their ends. */
int distributed_spreads(const equations *, const scene_load *);

/* Does the element take it into its own equilibrium (element_type.along)? Dead forces on the whole
 * of it, along its line, in scenes without a motion. */
int distributed_takes(const equations *, int element, const scene_load *);
/* Sum of the loads that an element takes into its own equilibrium. */
typedef struct distributed_taken {
    int acts;
    double force[3 * ELEMENT_ALONG_POINTS], mixed[3 * ELEMENT_MAX_STRAINS],
        H[ELEMENT_ALONG_COORDINATES * ELEMENT_ALONG_COORDINATES];
    along_output out; /* into the arrays above; its stresses into those of a slot */
} distributed_taken;
/* Fills *out with the loads at `path`; out->acts 0: none. */
void distributed_take(const equations *, int element, double path, distributed_taken *out);
/* forces[14] += what J^T sigma has not got in it, K[14 x 14] -= its derivative, as `out` has it.
 * gap[strains]: D(x) - e. */
void distributed_add_taken(const model *, const along_output *out, const double J[],
                           const double gap[], double forces[], double K[]);

/* forces[7 nodes] += what a load along a member times `scale` does on an element, K[7 nodes x 7
 * nodes] -= its derivative (NULL: not needed); 0: nothing. Of one that the element takes: the
 * derivative of its forces by the load's size in the state, K untouched. */
int distributed_add_one(const equations *, const model_state *, const node_state x[], int element,
                        const scene_load *, double scale, double forces[], double K[]);
/* The same of all of them at `path`: of those that the element takes what J^T sigma has not got in
 * it, in a linear solution about `rest` all. `field`: without those that the element takes. */
int distributed_add(const equations *, const model_state *, const node_state x[], int element,
                    double path, double forces[], double K[]);
/* And of those that it takes alone. */
int distributed_add_own(const equations *, const model_state *, const node_state x[], int element,
                        double path, double forces[], double K[]);
/* Stresses of a state under what acts at `path` (sigma, C of stress_output); 0: it takes nothing.
 */
int distributed_stress(const equations *, const model_state *, const node_state x[], int element,
                       double path, const stress_output *, status *outcome);
int distributed_add_field(const equations *, const node_state x[], int element, double path,
                          double forces[], double K[]);

/* Does anything act along it? */
int distributed_acts(const distributed_loads *);
/* A load that begins, ends or acts between its ends, or SCENE_NONE. */
int distributed_jumps(const distributed_loads *);
/* Load per initial length at x in [0, 1] of the element, on a section with this frame: loads of its
 * member and inertia of a rotating frame (with rotary inertia where that is active). context: a
 * distributed_loads. */
void distributed_at(void *context, double x, const span_frame *, span_load *out);

/* Functions shared by the files of harness/newton. */

/* One element's equations in model coordinates. */
typedef struct element_part {
    status outcome;
    fault why;
    double incompatibility; /* |D(x) - e|/l */
    double force[MODEL_MAX_COORDINATES], K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
} element_part;

/* rotating_frame.c: force -= centrifugal force, K += its stiffness (NULL: not needed), in element
 * coordinates; nothing where no frame turns. */
status rotating_frame_add(const equations *eq, const node_state x[], int element, double path,
                          double force[], double K[], fault *f);

/* loads.c: out[free + driven] += all of them, or those on vertices alone, not along elements. */
void loads_add(const equations *eq, const model_state *s, double path, double out[]);
void loads_add_at_vertices(const equations *eq, const model_state *s, double path, double out[]);
/* Stiffness of the loads on vertices, entry by entry. */
void loads_stiffness_at_vertices(const equations *eq, const model_state *s, double path,
                                 loads_entry, void *context);
void loads_subtract_at_vertices(const equations *eq, const model_state *s, double path, sparse *K);
/* And all of them, on a pattern of model.h. */
void loads_subtract_stiffness(const equations *eq, const model_state *s, double path, sparse *K);
/* REFUSED: a moment whose stiffness is not symmetric, which a symmetric matrix cannot hold. */
status loads_have_potential(const equations *eq, const model_state *s, double path, fault *f);

/* linearise.c: the moment [N m] about its axis that a node held about one axis alone takes
 * from its support in a state (sigma: as internal_state has it); 0: rounding. */
double linearise_held_moment(const equations *eq, const model_state *s, const double sigma[],
                             double path, int node, int axis);
/* Elements and loads give the derivatives of work in the exponential chart of a node's turn. Where
 * a node is fixed about one axis, equilibrium is that of the moments about the two others, which
 * that moment R about the axis h makes differ: K_ij += R/2, K_ji -= R/2 with h, i, j in cyclic
 * order. */
void linearise_add_held_moments(const equations *eq, const model_state *s, double path, sparse *K);
/* REFUSED: such a moment, which has no potential either. */
status linearise_held_have_potential(const equations *eq, const double sigma[], double path,
                                     fault *f);

/* Loads and drivers along a path. */

/* Returns the loading of an analysis. In a motion the path parameter is the time, of which loads
 * and drivers are functions; others act in full. Axes rotate as those of the analysis, or of the
 * analysis whose states it is about. */
loading loading_of(const model *, int analysis);
/* Value of a known driver [m or rad]. */
double loads_driver_value(const equations *, const scene_driver *d, double path);
/* In time, also its first two derivatives; at the end of a piece: of the next one. What has no
 * function of time stays at its last value; of a load it is whole. */
void loads_driver_rates(const equations *, const scene_driver *d, double path, double out[3]);
/* out[free + driven] += the load times `scale` in a state. */
void loads_add_one(const equations *, const model_state *, const scene_load *, double scale,
                   double out[]);
/* out[free + driven] += forces by which a temperature, changed by `scale`, acts on nodes that are
 * kept where they are in a state. */
void loads_add_temperature(const equations *, const model_state *, const scene_load *, double scale,
                           double out[]);
/* Derivative of the loads by the path parameter in a state, out[free + driven]. */
void loads_rate(const equations *, const model_state *, double path, double out[]);
/* Loads of the undeformed state at `path`, f[free + driven]. */
void loads_reference(const equations *, double path, double f[]);
/* Is there a load, or a coordinate moved, at path 0? */
int loads_begin(const equations *);

/* Increments of the prescribed coordinates (dx[free .. free+driven)) that take the state to `path`;
 * the rest of dx untouched. */
void loads_drive(const equations *, const model_state *, double path, double dx[]);

/* An unknown driver: the prescribed coordinate `unknown` moves by what makes the free one
 * `coordinate` move by `increment`. The force on that coordinate stays free of reactions, the one
 * on the driver is whatever it takes. */
enum { MODEL_MAX_CONDITIONS = 4 };
typedef struct model_condition {
    int unknown, coordinate;
    double increment;
} model_condition;
int loads_conditions(const equations *, const model_state *, double path,
                     model_condition out[MODEL_MAX_CONDITIONS]);

/* K of a node turned by a sequence of angles, when the moment M that the angles' prescription
 * exerts becomes a load that is conservative in the exponential chart: the angles' own second
 * derivatives no longer belong to it. */
void loads_release_moment(const model *, const model_state *, int node, const double M[3],
                          sparse *K);
/* Force and spatial moment of the loads at `path` on a node's frame: F[6] [N, N m]. */
void loads_at_node(const equations *, const model_state *, double path, int node, double F[6]);

/* Newton's equations of a state. */

/* Internal less external force of every coordinate is what equilibrium makes zero on the free ones.
 * Mixed linearisation (simultaneous in coordinates, strains and stresses; N section 4), condensed
 * per element:
 *   K dx = f(path) - J^T [P'(e) + P''(e) (D(x) - e)],  K = J^T P'' J + sum sigma_i H_i
 * The driven part of dx is known: its share is taken to the right-hand side here. */
typedef struct model_linearisation {
    double path;
    int displacement;    /* 1: displacement-only Newton: e and sigma are taken from D(x) first */
    const double *drive; /* [free + driven] increments; only the driven part is read; NULL: none */
    int conditions;      /* columns of K wanted for the unknowns of conditions ... */
    const model_condition *condition;
    double *column;   /* ... [conditions x (free + driven)] */
    sparse *K;        /* on a pattern of assemble_pattern; NULL: not needed */
    double *residual; /* [free + driven] right-hand side; of prescribed coordinates: less their
                         reaction */
    double incompatibility; /* out: max |D(x) - e|/l over elements */
} model_linearisation;
/* One element's part of a linear_memory between linearise_state and advance_state. */
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

/* Into the memory goes what advance_state takes up. */
status linearise_state(const equations *, const linear_memory *, const model_state *,
                       model_linearisation *, fault *);
/* Forgets the independent strains and stresses: e = D(x), sigma = P'(e). */
status linearise_make_compatible(const equations *, model_state *, fault *);
/* Force and spatial moment that act from outside on a node's frame (loads and reactions) in the
 * state: F[6] [N, N m]. sigma: as internal_state has it. */
void linearise_node_force(const equations *, const model_state *, const double sigma[], int node,
                          double F[6]);
/* out[free + driven] += forces that the stresses of these elements take, and all springs. */
void linearise_add_internal(const equations *, const model_state *, int elements,
                            const int element[], double out[]);

/* A few elements evaluated in one go: of one kind where the type has lanes (element_type.lanes),
 * else one after the other. */

enum {
    CHUNK_MOST = 8,   /* elements in one go */
    CHUNK_WINDOW = 32 /* elements among which those of one kind are searched for */
};

/* Elements in one go; 1 where they are evaluated one after the other. */
int chunk_size(const model *m);
/* The next of [first, end) to be evaluated in one go, end - first <= CHUNK_WINDOW: index[];
 * returns their number, 0: none is left. done[end - first] is zero before the first call. */
int chunk_next(const model *m, int first, int end, unsigned char done[], int index[CHUNK_MOST]);

/* One element's evaluation. */
typedef struct chunk_element {
    int index;     /* of the element: given */
    double *force; /* [7 nodes]: given */
    double *K;     /* [7 nodes x 7 nodes] sum sigma_i H_i; NULL: not needed: given */
    node_state x[ELEMENT_MAX_NODES];
    distributed_taken along; /* loads that are in its stresses */
    status outcome;
    int complete; /* 1: force is J^T sigma of the slot, and K has J^T C J too ... */
    double present[ELEMENT_MAX_COORDINATES]; /* ... and this is J^T sigma of the state */
} chunk_element;

/* Strains and stresses of count elements in the state, into their slots (linearise_slot), and what
 * chunk_element says. */
void chunk_evaluate(const equations *eq, const linear_memory *memory, const model_state *s,
                    double path, int count, chunk_element element[]);

/* Stiffness of a moment m on a node that rotates, by convention. K: the stiffness of the
 * exponential chart R = exp(theta~) R0, in which the generalized moment of theta is constant.
 * Semitangential: K; the moment follows half of the rotation, m + theta x m/2, and has a potential
 * (Argyris et al. 1979). Spatial: K - m~/2 on the rotations; the moment is dead about fixed axes,
 * and the matrix is not symmetric. Symmetrised: the symmetric part of the spatial stiffness; K
 * itself where everything else has a potential. A tangent has one of the first two: the spatial one
 * at a node that is fixed about one axis alone, whose moment keeps its direction
 * (coordinates_held_turn), else the semitangential one. */

/* Does the convention change the stiffness of the tangent's?  Then one column of the compliance
 * depends on all the others. */
int convention_changes(scene_moments of_tangent, scene_moments convention, const double m[3]);

/* C[6 x 6] of the tangent, complete in the components that can move, becomes that of the
 * convention, and K[6 x 6] is its inverse on the motions the node can make; where nothing changes C
 * keeps all its digits.  m[3]: moment on the node [N m]. Rows and columns of fixed components:
 * zero. SINGULAR: C has no inverse there, up to its round-off. */
status convention_apply(scene_moments of_tangent, scene_moments convention, const movable *motions,
                        const double m[3], double C[36], double K[36], fault *f);

/* Where the next state of a path is searched for. */

/* First guess of the state at `path` from the last `count` ones (two: a line, three: a parabola,
 * ...), oldest first. 0: there is none, because what is prescribed bends, or the step is too long;
 * `out` is untouched then. */
enum { MODEL_EXTRAPOLATED = 12 };
int extrapolate_state(const equations *, int count, const model_state *const at[], double path,
                      model_state *out);
/* error[k], k = 1 ... most: how far a guess of at[most] from the k states before it would have been
 * off: the largest error of a displacement or strain [m]; of one: had it been taken as it is.
 * INFINITY: there would have been none. */
void extrapolate_errors(const equations *, int most, const model_state *const at[], double error[]);

/* Record of Newton's method: the iterations of every accepted load step. */

/* One more iteration of the step that is being tried. energy = |r . K^-1 r| of its residual r [J];
 * NAN: not known. */
status history_add_iteration(solve_result *r, step_record *step, const iteration_record *one,
                             double energy, fault *f);
/* Removes the iterations of a rejected step. */
void history_drop_step(solve_result *r, const step_record *step);

/* Enters into the steps from `first` on their analysis, and whether the states at their ends are
 * stable. */
void history_judge_steps(solve_result *, const scene *, int analysis, int first);
/* Enters the stability that the modes at a station show, where pivots do not decide it. */
void history_judge_station(solve_result *, int analysis, double path, step_stability);
/* Where a step of the analysis ended at that path parameter; STEP_OPEN: nowhere. */
step_stability history_stability_at(const solve_result *, int analysis, double path);
status history_add_step(solve_result *, const step_record *, fault *);
/* All steps of a motion. */
/* path: parameter of the state that it starts from; NAN: it has none. */
status history_add_motion(solve_result *, int analysis, double path, const outcome_motion *,
                          fault *);
/* Position in the record; history_go_back removes what was added later. */
typedef struct history_mark {
    int steps, iterations, ends;
} history_mark;
history_mark history_here(const solve_result *);
void history_go_back(solve_result *, const history_mark *);
status history_add_event(solve_result *, const path_event *, fault *);

/* Which models have the same answers: formulations that differ in what a scene does not have are
 * the same one there. */

/* Identity of all data that were added, in that order. */
typedef struct identity {
    uint64_t part[2];
} identity;

identity identity_begin(void);
void identity_add(identity *, const void *bytes, size_t size);
/* Adds the functions of a model's elements, their data and the eliminated coordinates: two models
 * of one scene with the same identity have bit-for-bit the same results. 0: not known, since a
 * formulation that runs outside may fail. */
int identity_add_model(identity *, const model *);

/* Resultants of the stresses on the sections of a member.
 *
 * At the ends of an element they are what its nodal forces J^T sigma leave when the loads along it
 * that its nodes take are taken off: in equilibrium with everything beyond, whatever a formulation
 * assumes inside.  Between them harness/section_forces/section_forces.h carries them on, the same
 * way for all formulations. */

/* Which state. */
typedef struct internal_state {
    const model_state *s;
    const double *sigma; /* [elements x strains] stresses; NULL: those of the state */
    const double *x; /* of a linear solution about s, which is undeformed: its displacements [free +
                        driven]; NULL: s is in equilibrium */
    double path;     /* parameter of the loads */
    /* of a motion, else NULL */
    const struct internal_inertia *moving;
} internal_state;

/* Forces of inertia of one element of a motion. */
typedef struct internal_inertia {
    /* ends[2][7] += those of its lumped masses at its first and its last node */
    void (*ends)(const void *context, int element, double ends[2][7]);
    /* of a mass that lies evenly along it and moves as each node does, per initial length, in fixed
     * axes: density[nodes][force, moment about the node's frame] */
    void (*along)(const void *context, int element, double density[ELEMENT_MAX_NODES][6]);
    const void *context;
} internal_inertia;

/* Resultants at an end: action of the part towards `to` on the part towards `from`, in the
 * principal axes of the rotated section, moments about its centroid: N, Qy, Qz [N], Mx, My, Mz [N
 * m], bimoment [N m^2] (conjugate to the rate of the warping amplitude). end: 0 from, 1 to. */
void internal_at_end(const equations *, const internal_state *, int member, int end, double out[7]);

/* A place of a member, 0 from .. 1 to of its initial length; before: on the side of `from` of what
 * jumps there. */
typedef struct internal_place {
    int member;
    double place;
    int before;
} internal_place;

/* The same at a place of a member, and what else section_forces.h has: out[SPAN_VALUES].
 * NOT_CONVERGED: as span_recover. Of a motion the mass lies evenly along an element again, with
 * accelerations that are interpolated between its nodes: of a linear acceleration the forces are
 * those of what lies beyond, so that values go through from element to element (order 2). Warping
 * inertia acts at nodes. */
status internal_at(const equations *, const internal_state *, const internal_place *, double out[],
                   fault *);

/* Largest value of `of` over a member, that of the section at x in [0, 1] of an element, counted
 * along the member, from its resultants [SPAN_VALUES]. */
typedef double (*internal_measure)(void *context, int element, double x, const double resultants[]);
status internal_largest(const equations *, const internal_state *, int member, internal_measure of,
                        void *context, double *out, fault *);

/* Stresses in members: of the points of a section, from its resultants. */

/* At a place of a member, 0 from .. 1 to [Pa].  REFUSED: given constants, which have no points;
 * else as internal_at. */
status internal_stress_at(const equations *, const internal_state *, const internal_place *,
                          stress_measure, double *out, fault *);
/* Largest stress over all sections of the member. */
status internal_stress_largest(const equations *, const internal_state *, int member,
                               stress_measure, double *out, fault *);

/* Strains that elements have without stress beyond those of the undeformed state: of temperatures,
 * which are loads, and of members that are drawn strained. Strains of a state are counted from
 * them, or stresses are those of data that know them: both are mechanical. */

/* e[strains] of positions of nodes, less them. */
void free_strain_subtract(const equations *, int element, double path, double e[]);
/* Data for the stresses of an element: those of its kind, or as its type alters them, until the
 * next call for the element. */
const element_data *free_strain_data(const equations *, int element, double path);
/* Adds the elongation and the curvatures about principal axes. */
void free_strain_amounts(const equations *, int element, double path, double strain[3],
                         double curvature[3]);
/* To first order about the undeformed state, out[strains]: of temperatures at `path`; of members
 * by themselves. */
void free_strain_linear(const equations *, int element, double path, double out[]);
void free_strain_own(const model *, int element, double out[]);
/* Of temperatures the largest one, of curvatures times the length of the model. */
double free_strain_size(const equations *, double path);
/* out[strains] in a state, by a temperature that changes by `scale`; 0: none. */
int free_strain_by_load(const equations *, const model_state *, int element, const scene_load *,
                        double scale, double out[]);
/* What temperatures that change in time add to the energy: in an instant [W], and from a state to
 * the next [J]. */
double free_strain_power(const equations *, const model_state *, double time);
double free_strain_work(const equations *, const model_state *from, double begin,
                        const model_state *to, double end);

/* About the undeformed state. */

/* Linear analyses about the undeformed state. */
status linear_stiffness(const equations *, sparse *K, fault *); /* J^T S J at e = 0 */
status linear_stresses(const equations *, const double x[], double sigma[],
                       fault *); /* sigma = S J x, [model_stresses] */
/* Largest strain of a member that would leave no stress; 0: there is none. */
double linear_initial(const model *);
/* The same with what these strains and temperatures at `path` add: of the structure as it is, not
 * of a motion. */
status linear_whole_stresses(const equations *, const double x[], double path, double sigma[],
                             fault *);
/* Of what grows from path 0 to `path`: x from there, temperatures too. */
status linear_growing_stresses(const equations *, const double x[], double path, double sigma[],
                               fault *);
void linear_forces(const equations *, const double sigma[],
                   double f[]); /* f[free + driven] = sum J^T sigma */
status linear_geometric_stiffness(const equations *, const double sigma[], double path, sparse *G,
                                  fault *); /* sum sigma H + J^T G(sigma) J; offsets included */
/* Quadratic forms from the element strains, free of the cancellation of x^T (K x): error eps n^2
 * instead of eps n^4. */
double linear_strain_energy2(const equations *, const double x[]); /* x^T K x = sum (Jx)^T S (Jx) */
double linear_strain_rounding(const equations *,
                              const double x[]); /* what rounding may change in it */
double linear_geometric_energy2(const equations *, const double sigma[], const double x[]);
/* Size of what rounding changes in it, with sigma the stresses of the displacements load_x[free +
 * driven]. */
double linear_geometric_rounding(const equations *, const double load_x[], const double sigma[],
                                 const double x[]);

/* Linear solutions about the undeformed state. */

/* A linear solution about the undeformed state: x[free + driven] of K x = f, with the factors of K
 * kept for the caller. */
typedef struct linear_system {
    sparse K;
    matrix_factor *factor;
} linear_system;
status linear_system_alloc(analysis_context *, linear_system *, fault *);
void linear_system_free(linear_system *);
/* Loads and drivers at `path`. */
status linear_system_solve(analysis_context *, linear_system *, double path, double x[], fault *);

/* The last states of a path, oldest first: where the next one is searched for. */

typedef struct predictor {
    int count, iterations;                   /* of the last step */
    int most;                                /* states that a guess is made from */
    model_state *at[MODEL_EXTRAPOLATED + 1]; /* NULL: not needed so far */
    /* [m] of a guess of the last state from k states before it; k = 1: that it stays as it was */
    double error[MODEL_EXTRAPOLATED + 1];
} predictor;

status predictor_alloc(const model *, predictor *, fault *); /* holds the undeformed state */
void predictor_free(predictor *);
status predictor_add(const equations *, const model_state *, int iterations, predictor *, fault *);
void predictor_forget(predictor *);
/* Moves s, the last state, to a guess of the one at `path`, or leaves it as it is. */
void predictor_guess(const equations *, const predictor *, double path, model_state *s);

/* Newton in coordinates, strains and stresses at once (N section 4): what every nonlinear analysis
 * iterates with. */

typedef struct newton_run {
    analysis_context *c;
    model_state *state, *backup;
    predictor *predictor;    /* NULL: every step begins at the last state */
    condensation *condensed; /* NULL: no member is condensed; else K is not assembled */
    sparse K;
    sparse whole; /* with the prescribed coordinates; no values: not requested */
    matrix_factor *factor;
    double *residual, *dx;   /* [free + driven] */
    double *dense, *unknown; /* of the uncondensed system, allocated when it is requested */
    int *pivot;
    double *column; /* [conditions x (free + driven)], after dx */
    double
        *weight;   /* [free + driven] of metric_of: what makes displacements and turns comparable */
    double energy; /* |r . K^-1 r| of the last residual r [J]; NAN: not known */
    double path;   /* that newton_to goes to */
    arrival arrival;
    int max_iterations, free, all;
    long counted; /* factorisations that are in the model's counters */
} newton_run;

/* condense 1: members of many elements are condensed to their ends. */
status newton_alloc(analysis_context *, int condense, newton_run *, fault *);
void newton_free(newton_run *);
/* From here on K is known of the prescribed coordinates too. */
status newton_keep_driven(newton_run *, fault *);

/* One correction of an iteration. */
typedef struct newton_correction {
    double at;     /* path parameter or, of motions, instant [s] that it goes to */
    double size;   /* dimensionless, of what changed: advance_state */
    double energy; /* |r . K^-1 r| of the residual r before it [J]; NAN: not known */
    advance_stress stress;
} newton_correction;

/* K, its factors and dx = K^-1 residual in the present state for the loads and drivers at `path`;
 * drivers are in dx. */
status newton_direction(newton_run *, double path, step_record *, fault *);
/* The state takes dx, at that path parameter. */
void newton_advance(newton_run *, double path, newton_correction *);
/* NOT_CONVERGED: the arc of an element at rest rises by more than the formulation can follow. */
status newton_judge_rest(const model *m, fault *f);
/* Checks every state that an analysis accepts against the one before it. NOT_CONVERGED names an
 * element that is turned by more than its formulation can follow, a spring whose rotation vector
 * has lost its direction, or a prescribed coordinate that moves too far in one step. A node's
 * rotation vector that has lost its direction is NaN from there on. */
status newton_accept(const model *, const model_state *from, model_state *, fault *);

/* Parts of Newton's iteration that depend on the analysis. */
typedef struct newton_use {
    void *of;
    newton_run *on;  /* of a path: newton_accept checks its states, and a state far from its first
                    correction, which may be another equilibrium, is not converged; NULL: of
                    a motion */
    int least, most; /* iterations */
    /* The equations of the present state are solved, and the state takes the correction. */
    status (*correct)(void *of, int iteration, newton_correction *, step_record *, fault *);
    void (*prepare)(void *of, int iteration, double correction); /* another one; NULL: nothing */
    status (*accept)(void *of, fault *); /* called when it has converged; NULL: always accepted */
} newton_use;

/* Returns Newton's iteration for states on a path. */
newton_use newton_on_path(newton_run *, void *of,
                          status (*correct)(void *of, int iteration, newton_correction *,
                                            step_record *, fault *));
/* Returns Newton's iteration for steps in time. */
newton_use newton_in_time(const analysis_context *, void *of,
                          status (*correct)(void *of, int iteration, newton_correction *,
                                            step_record *, fault *),
                          void (*prepare)(void *of, int iteration, double correction));

/* Newton's iteration of every nonlinear step, with one table of limits: converged, or NOT_CONVERGED
 * with the reason. Counters, records and the arrival take each correction. */
status newton_iterate(analysis_context *, const newton_use *, arrival *, step_record *, fault *);

/* Newton to `path`: converged, or NOT_CONVERGED with the reason. */
status newton_to(newton_run *, double path, step_record *, fault *);

/* Quadratic forms of the undeformed structure and of the stresses of a linear solution, from the
 * element strains: assembling the matrices loses digits of soft motions, this does not. */

typedef struct quadratic_forms {
    const equations *eq;
    int free;
    double *load_x;    /* [free + driven] displacements by the loads, zero: no prestress ... */
    double *sigma;     /* ... and their stresses [elements x strains] */
    sparse loads;      /* what the loads add to K */
    double *x, *force; /* [free + driven] prescribed coordinates of x: zero */
    double *stress, *product; /* [elements x strains], [free] */
} quadratic_forms;

status quadratic_forms_alloc(const equations *eq, const sparse *pattern, quadratic_forms *p,
                             fault *f);
void quadratic_forms_free(quadratic_forms *p);
/* The loads at `path` and their stresses, once load_x is known; whole: with those of initial
 * strains. */
status quadratic_forms_load(const equations *, quadratic_forms *p, double path, int whole,
                            fault *f);

/* Return x^T K x and x^T G x of x[free], and bounds of what rounding may change in them. */
double quadratic_forms_stiffness(quadratic_forms *p, const double x[]);
double quadratic_forms_geometric(quadratic_forms *p, const double x[]);
double quadratic_forms_stiffness_rounding(quadratic_forms *p, const double x[]);
double quadratic_forms_geometric_rounding(quadratic_forms *p, const double x[]);
/* y[free] = K x[free] */
void quadratic_forms_product(quadratic_forms *p, const double x[], double y[]);

/* A quantity that has been read from an outcome. */

/* STATUS_OK of an outcome that lacks the value becomes STATUS_NO_VALUE. */
void quantity_no_value(quantity_result *, status, const char *reason);
/* In the units of the quantity: times its factor, plus its offset. */
double quantity_scaled(const scene_quantity *, double value);

/* The same for the abscissa of its curve. */
double quantity_abscissa(const scene_quantity *, double x);
/* Room for a curve of that many points; 0: there is none, which the result says. */
int quantity_curve(quantity_result *, int points);

/* When iterative refinement of a linear solution ends, and how many digits it has then.
 *
 * Residuals come from element strains.  With factors off by part q of the solution (about eps times
 * the condition of K) every correction is q times the last one, until they settle where the
 * rounding of the forces keeps them (N.J. Higham, Accuracy and Stability of Numerical Algorithms
 * (2002), section 12.1): x is then the solution for loads rounded in their last digit, and the
 * correction is its error.  That level is a property of the problem, neither of the mesh nor of K:
 * a bar of length L pushed along an oblique axis has forces whose components are rounded; across
 * the bar eps P L^3/(3 EI) stands beside P L/(EA), eps (L/r)^2/3.  Square bars of side L/10 to
 * L/1e5, 1 to 256 elements, three oblique axes, every formulation: eps (L/side)^2 times 2.5 at most
 * where that is above what the mesh rounds (170 times for the geometrically exact element, whose
 * factors are the worst), whatever the condition, which goes from 1 to 2e16, and q from 0 to 0.08
 * (0.8 for that element). */

typedef enum refinement_state {
    REFINEMENT_GOES_ON,
    REFINEMENT_ENDS,
    REFINEMENT_LOST
} refinement_state;

/* Begins as {0}. */
typedef struct solution_refinement {
    int corrections; /* the first is the solution itself */
    double last;     /* relative to the solution */
} solution_refinement;

/* Decides from the size of a correction, relative to the solution: at least two corrections after
 * the first, and more while they halve and digits are missing. */
refinement_state refinement_next(solution_refinement *, double correction);
/* Are the digits enough that a last correction, or another measure of the error, leaves? */
refinement_state refinement_judge(solution_refinement *, double correction);
/* SINGULAR, with the digits that are left of `what` and what helps. */
status refinement_refuse(const solution_refinement *, const char *what, fault *);
/* |change|/|x| in a metric of n weights, |x| of at least `least`; 0: no change. */
double refinement_part(int n, const double weight[], const double change[], const double x[],
                       double least);

/* A frame that turns steadily. */

/* Mass matrix on the pattern of M about a state (NULL: undeformed); G: gyroscopic matrix of a
 * rotating frame, of which a symmetric pattern stores the upper triangle, or NULL: not needed. */
status rotating_frame_inertia(const equations *, const model_state *, double path, sparse *M,
                              sparse *G, fault *);

/* 1: mass is at nodes, as the scene specifies or a motion that starts there has it. */
int rotating_frame_lumps(const equations *);

/* x^T B x of the undeformed structure, x[free + driven]: what the mass inside of elements adds to a
 * mode, k = lambda m + lambda^2 b (field/field.h). */
double rotating_frame_inner(const model *, const double x[]);
/* B itself, with the pattern of a symmetric K. 0: no element has it, and it is zero. */
int rotating_frame_inner_matrix(const equations *, sparse *out);

/* Stiffness of loads on offsets and of moments. */
void rotating_frame_load_stiffness(const equations *, const model_state *, double path,
                                   sparse *out);

/* Why a stiffness matrix cannot be factored. */

/* SINGULAR with the motion where released ends make the undeformed structure a mechanism; else
 * `otherwise`, f as it is. */
status singular_mechanism(const analysis_context *c, status otherwise, fault *f);

/* After the last factorisation failed: the fault with its cause.  A part that the supports leave
 * loose; digits lost in round-off, because of many elements or of stiffnesses far apart; else a
 * critical point.  Work done for it is not counted. */
void singular_explain(analysis_context *c, fault *f);

/* The tangent of a state in two parts. */

/* K x of the last linearisation in two parts. The stiff one goes through the element strains, y +=
 * sum J^T P'' (J x): as a sum of matrices it would lose all digits of the soft motions. x, y: [free
 * + driven]. The other is a matrix on the pattern of G: sum sigma_i H_i with the second derivatives
 * of offsets and sequences, less the loads' and the rotation's stiffness. */
void stiffness_parts_material_product(const model *, const linear_memory *, const model_state *,
                                      const double x[], double y[]);
/* Bound of what rounding may change in x^T K x of the material part. */
double stiffness_parts_material_rounding(const model *, const linear_memory *, const model_state *,
                                         const double x[]);
status stiffness_parts_geometric(const equations *, const linear_memory *, const model_state *,
                                 sparse *G, fault *);

/* All unknowns at once. */

/* The uncondensed dense system (column-major A[n x n], b[n] with n = uncondensed_size +
 * conditions), unknowns in the order free coordinates, strains, stresses, drivers of conditions;
 * load[free + driven] is work space. */
int uncondensed_size(const model *);
status uncondensed_system(const equations *, const model_state *, double path, const double drive[],
                          int conditions, const model_condition condition[], double A[], double b[],
                          double load[], fault *);

#endif
