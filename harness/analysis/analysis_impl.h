/* Internal interfaces of analysis/. */
#ifndef BEAMWORK_ANALYSIS_IMPL_H
#define BEAMWORK_ANALYSIS_IMPL_H

#include <complex.h>

#include "elements/shared/status.h"
#include "harness/analysis/analysis.h"
#include "harness/newton/newton.h"
#include "harness/numerics/numerics.h"

/* Collects the shapes of the undeformed structure, of at most `most` states of every path, of the
 * frames of motions, of linear solutions and of modes. */
status collect_shapes(const analysis_context *, int most, shapes *, fault *);

/* Collects the matrices about the undeformed structure, about every computed station of static
 * paths, continuations and rotations, and about the states of modal analyses. If linear models are
 * requested, also collects those of harmonic analyses. */
status collect_systems(const analysis_context *, system_matrices *, fault *);

/* Returns the number of modes that an analysis must find for the imperfections that use it,
 * including two more modes that reveal repeated eigenvalues; 0: no imperfection uses the analysis.
 * Only buckling modes with positive critical factors are counted. */
int imperfection_modes(const scene *, int analysis);
/* Sets x[free + driven] to the sum of the imperfections, each of which is a mode times its
 * amplitude. REFUSED: a mode does not exist, belongs to a repeated eigenvalue without a direction
 * that selects one mode, shifts no member, or is perpendicular to its direction. If the analysis
 * that computes a mode failed, returns its status. */
status imperfection_of_modes(const analysis_context *, double x[], fault *);

/* Compliance and stiffness of a node in a deformed state. */

status compliance_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

/* Compliances that are computed while a path is followed. If Newton's last correction changes the
 * tangent by less than its rounding error, the last tangent is used for the station. */

typedef struct compliance_walk compliance_walk;

/* Computes compliances when Newton's method has converged at a station. FAULT: out of memory. */
status compliance_walk_take(compliance_walk *w, const newton_run *, int station, fault *);
void compliance_walk_end(compliance_walk *);

/* Equilibrium paths under proportional loads, including limit points. */

status continuation_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

/* Evaluates curves and critical points. Returns 0 for any other quantity. */
int continuation_extract(const analysis_context *, const scene_quantity *, const analysis_outcome *,
                         quantity_result *);

/* Small motions x exp(s t) about a state whose stiffness is not symmetric: (s^2 M + s C + K) x = 0.
 * M is symmetric and positive semidefinite. C is the damping matrix or NULL. The smallest s follow
 * from the largest eigenvalues: 1/s^2 of -K^-1 M or, if C is given, 1/s of the companion matrix,
 * whose unknowns are the coordinates and the rates of coordinates with mass. Massless coordinates
 * cause zero eigenvalues, which are not modes. */

typedef struct unsymmetric_problem {
    const sparse *K, *M, *C; /* matrices with the same pattern; C NULL: there is no damping */
    matrix_factor *K_factor; /* after factor_numeric */
    int wanted;              /* number of requested modes, which have the smallest |s| */
    int estimate;            /* 1: estimates the errors, which doubles the work */
    int values_only;         /* 1: the modes are not requested */
    int rough;               /* 1: only the stability is requested; see arnoldi_problem */
    int decaying;    /* 1: if C is given, modes that decay without oscillation are included */
    const sparse *B; /* mass matrix of the motions inside elements, if C is given; NULL: none */
    /* coefficients of the proportional damping in C: mass [1/s], stiffness [s] */
    double mass, stiffness;
    /* [1/s] shift a, if C is given: K contains a C + a^2 M, and C contains 2 a M; 0: no shift */
    double shift;
} unsymmetric_problem;

/* Modes with s = growth + i frequency, in ascending order of magnitude. If there is no damping, the
 * result contains both modes of a flutter (same frequency, opposite growth rates) and the growing
 * mode of a divergence. If there is damping, the result contains every oscillating mode, every
 * growing mode and, if `decaying` is 1, the modes that decay without oscillation. */
typedef struct unsymmetric_result {
    int n, count;
    double *frequency, *growth; /* [count] frequencies [rad/s] and growth rates [1/s]; growth 0:
                                   below the rounding error of a double eigenvalue */
    double *split;              /* [count] imaginary part of s^2 relative to |s^2|; 1: divergence */
    double *error;              /* [count] estimated rounding error relative to |s| */
    double *mode;               /* [count x n] real; zero if they are not requested */
    /* number of slow poles of feedback integrals that are unknown, with an error of INFINITY */
    int lost;
} unsymmetric_result;

/* Smallest relative imaginary part of s^2 that is not a rounding error of a double eigenvalue. */
static const double unsymmetric_same = 1e-6;

status unsymmetric_solve(const unsymmetric_problem *, unsymmetric_result *, fault *);
void unsymmetric_free(unsymmetric_result *);
/* Improves a pole *s of K, M and C (of[3], with the same pattern) and its real mode[n]. Sets *error
 * to the error relative to |s|, or to INFINITY if the iteration does not converge or there are too
 * many coordinates. */
status refine_pole(const sparse of[], double complex *s, double mode[], double *error, fault *);

/* Small motions and stability about states with an unsymmetric tangent (follower loads, moments
 * about fixed axes). */

typedef enum flutter_kind { FLUTTER_NONE, FLUTTER_DIVERGES, FLUTTER_OSCILLATES } flutter_kind;

/* Matrices of small motions about the current state of Newton's method; K is factored. */
typedef struct flutter_system {
    sparse M, C;
    int damped; /* 1: C contains the damping of members and dashpots; 0: the motions are undamped */
    /* 1: the structure has no mass, and M is the isotropic metric, for which double eigenvalues
     * remain real; only divergence is meaningful */
    int massless;
} flutter_system;

status flutter_system_alloc(const newton_run *, flutter_system *, fault *);
void flutter_system_free(flutter_system *);
/* What is computed of the motions: frequencies and growth rates, either with six digits, which
 * decide the stability, and their errors, or accurately with modes and errors. */
typedef enum flutter_detail {
    FLUTTER_VALUES,
    FLUTTER_VALUE_ERRORS,
    FLUTTER_MODES,
    FLUTTER_ERRORS
} flutter_detail;

/* Computes the `wanted` modes with the smallest |s| about the state. */
status flutter_motions(const newton_run *, flutter_system *, int wanted, flutter_detail,
                       unsymmetric_result *, fault *);
/* Moves the frequencies, modes and errors to an outcome. Values without significant digits become
 * NaN, and the status becomes NOT_CONVERGED. */
void flutter_take(unsymmetric_result *from, outcome_side *to);
/* Returns "" if nothing is damped, "undamped" if `damped` is 0, and "with damping" otherwise. */
const char *flutter_damping(const model *, int damped);
/* Returns the kind of instability of the mode with the largest growth rate, and sets *mode to its
 * index. */
flutter_kind flutter_of(const flutter_system *, const unsymmetric_result *, int *mode);
/* Computes the squares of the first `most` frequencies, in ascending order, which are negative for
 * divergence. Without mass, or with damping, computes |s|^2 instead. Returns the number of
 * values. */
int flutter_squares(const flutter_system *, const unsymmetric_result *, int most, double square[]);
/* Returns the kind in words, such as "flutter, undamped", "divergence" or "flutter, growth with
 * damping". */
const char *flutter_name(const flutter_system *, flutter_kind);

/* Smallest path parameter, counted from path 0, at which stability is lost. The caller frees
 * mode[free]. */
typedef struct flutter_point {
    double path, error, frequency; /* error: relative to the path parameter; frequency: in rad/s */
    const char *what;
    int massless;
    double *mode;
} flutter_point;
/* Function that advances from the current path parameter to `target`, like static_walk. */
typedef status flutter_walk(newton_run *, double target, double *increment, fault *);
status flutter_search(newton_run *, double size, flutter_walk *, flutter_point *, fault *);

/* Stability of states with an unsymmetric tangent. If there is mass, the frequencies of small
 * motions decide, otherwise the number of eigenvalues of the tangent that have passed zero. */

enum { FLUTTER_MOTIONS = 8 }; /* number of examined modes, which have the smallest |s| */

typedef struct flutter_state {
    double path;  /* NAN: no state */
    int unstable; /* number of negative eigenvalues, or 1 if a mode grows; -1: unknown */
    int by_modes; /* 1: the tangent is unsymmetric, so the modes decide */
    int modes;    /* number of known values; 0: unknown */
    /* [modes] squares of frequencies as in flutter_squares, or the lowest eigenvalues of the
     * tangent
     */
    double square[FLUTTER_MOTIONS];
} flutter_state;

/* Lowest eigenvalues of symmetric tangents K along a path, in the metric D. The eigenvectors of the
 * last tangent are the first approximation. */

enum { LOWEST_VALUES = 4 };

typedef struct lowest_values {
    int n, measured; /* measured 1: D is known */
    int known;       /* 1: `value` belongs to the last tangent */
    double value[LOWEST_VALUES];
    double *work; /* [n] D, [LOWEST_VALUES x n] vectors, [LOWEST_VALUES x n] work space */
} lowest_values;

status lowest_values_alloc(int n, lowest_values *, fault *);
void lowest_values_free(lowest_values *);
/* Stores the lowest eigenvalues of the factored K, with a relative accuracy of 1e-2, in ascending
 * order. Returns their number; 0: unknown. The first K sets D. */
int lowest_values_find(lowest_values *, const sparse *K, matrix_factor *,
                       double value[LOWEST_VALUES]);

/* Work space of an analysis. All members are initially zero. */
typedef struct flutter_check {
    int begun;
    /* run whose tangent has all coordinates, which the tangent of the path may not have */
    newton_run n;
    flutter_system of;
    flutter_state first, last, here; /* ends of the step, and the state that was examined last */
    lowest_values lowest;
} flutter_check;

/* Stores the stability of the state in the record of the step that ended in the state; STEP_OPEN:
 * unknown. */
status flutter_check_state(flutter_check *, analysis_context *, const model_state *, step_record *,
                           fault *);
status flutter_check_begin(flutter_check *, analysis_context *, fault *);
void flutter_check_free(flutter_check *);

/* Replaces the number of negative pivots for an unsymmetric tangent K: computes the eigenvalues of
 * D^-1 K nearest to zero, where D is the metric, and counts those to the left of the imaginary
 * axis. This number changes at a critical point, where an eigenvalue passes zero. It also changes
 * where a pair crosses the imaginary axis away from zero, which is not a critical point. If K is
 * symmetric, the number equals the number of negative pivots. */

enum { LEFT_NEAREST = 6 };

typedef struct left_of_axis {
    int count; /* number of eigenvalues to the left of the imaginary axis; -1: unknown */
    int nearest;
    /* [nearest] eigenvalues nearest to zero, in ascending order of magnitude */
    double complex mu[LEFT_NEAREST];
} left_of_axis;

/* Counts the eigenvalues. K: factored matrix. weight[n]: diagonal of the metric D. */
status left_count(matrix_factor *K, int n, const double weight[], left_of_axis *, fault *);

/* Continuation of equilibrium paths under proportional loads: internal declarations.
 *
 * The load factor is an additional unknown, and either a coordinate or the arc length is
 * prescribed: K dx = r + f' dl, g . dx = c. Here r is the residual, l is the load factor, f' is the
 * derivative of the loads, and g and c are the gradient and the right-hand side of the constraint.
 * This gives dx = K^-1 r + dl K^-1 f', dl = (c - g . K^-1 r)/(g . K^-1 f'). */

typedef struct path_point {
    double factor, control; /* load factor, and value of the control coordinate */
    double rate;            /* dfactor/ds, where s is the arc length in the metric of the model */
    double *tangent;        /* [free + driven] dx/ds */
    int symmetric;
    /* number of negative pivots of K, or the replacement from left_count; -1: unknown */
    int negative;
    int determinant; /* sign of det K */
    int lost;        /* 1: K is singular to working precision, so its determinant has no sign */
    /* eigenvalue of K nearest to zero, or its real part if K is not symmetric; NAN: not needed */
    double least;
    int nearest;
    /* [nearest] eigenvalues nearest to zero, in ascending order of magnitude, if K is not
     * symmetric */
    double complex mu[LEFT_NEAREST];
} path_point;

/* Goal of a step: a value of the control coordinate, or an arc length. */
typedef struct path_goal {
    int by_arc;
    double value;
} path_goal;

typedef struct continuation {
    analysis_context *c;
    const scene_control *by;
    const scene_path *path;
    outcome_continuation *o;
    int analysis, room; /* room: number of points for which the outcome has memory */
    int needs_critical; /* 1: a quantity requests critical points */
    int keeps_states;   /* 1: the outcome stores the state of every point */
    newton_run n;       /* Newton's method; n.backup is the state at the start of the step */
    flutter_check flutter;
    model_state
        *end; /* state at the end of the step, while a critical point inside the step is sought */
    double *weight;   /* [free + driven] weights of the metric */
    double *load;     /* [free + driven] f' */
    double *response; /* [free + driven] K^-1 f' */
    double *moved;    /* [free + driven] sum of the increments of the step */
    double *mode;     /* [free + driven] null vector of K */
    path_goal goal;   /* goal of the current step */
    path_point here, next, trial;
    int first;        /* number of negative pivots at the start of the path */
    int narrow;       /* 1: a change of stability has been located as closely as possible */
    int is_uncertain; /* 1: the step may have unknown critical points */
    int looked;       /* 1: n.dx, response and the factors belong to the current state */
} continuation;

status continuation_step_alloc(analysis_context *, int analysis, outcome_continuation *,
                               continuation *, fault *);
void continuation_step_free(continuation *);

/* Returns the scalar product in the metric. */
double continuation_step_dot(const continuation *, const double a[], const double b[]);
/* Applies Newton's method from n.backup, which is the state of `here`, until the goal is reached.
 * Returns the failures of newton_iterate. */
status continuation_step_correct(continuation *, path_goal, step_record *, fault *);
/* Like continuation_step_correct, but starts from the current state, the result of the previous
 * iteration. */
status continuation_step_go_on(continuation *, path_goal, step_record *, fault *);
/* Returns SINGULAR if K is singular to working precision at the point. */
status continuation_step_check(const path_point *, fault *f);
/* Factors K in the current state and fills the point. The tangent points in the direction of
 * along[free + driven]; NULL: towards larger loads. */
status continuation_step_look(continuation *, const double along[], path_point *, step_record *,
                              fault *);
/* Fills the point after a converged correction. Uses the last factors, which belong to the state
 * before this correction, and makes no further correction. SINGULAR: the loads cause no
 * displacement, or K is singular to working precision. */
status continuation_step_end(continuation *, path_point *, const step_record *, fault *);
/* Restores the state of `here`. */
void continuation_step_go_back(continuation *);

typedef struct other_branch {
    model_state *state; /* NULL: none */
    double factor;
} other_branch;

/* Stores the critical points between `here` and `next` as events (continuation_critical.c). goal:
 * goal with which the step was found. Sets *jump to 1 if the step led to another branch, so that
 * the number of negative pivots changes without a critical point. */
status continuation_critical(continuation *, path_goal, int *jump, fault *);
/* If critical points are requested, sets *hidden to 1 if an indicator of a critical point (the sign
 * of the rate, or the number of negative pivots) changes and changes back within the step. */
status continuation_critical_within(continuation *, path_goal, int *hidden, fault *);

void extract_quantity(const analysis_context *, const scene_quantity *, quantity_result *);

/* Evaluates a quantity of a path. There is no value if the path ends before the stations that the
 * quantity needs. */
void extract_path(const analysis_context *, const scene_quantity *, const analysis_outcome *,
                  quantity_result *);

/* Returns 1 and stores the reason in r if the quantity needs a part of a motion that only an
 * earlier run has computed. */
int extract_continued(const analysis_context *, const scene_quantity *, quantity_result *r);

/* Sets the spectrum of the quantity from `count` values in the unit of the quantity, at equal time
 * steps [s]. */
void spectrum_take(const scene_quantity *, int count, double step, const double value[],
                   quantity_result *);

/* Returns 1 if a quantity that is not a curve is evaluated at this station of path[stations]. */
int extract_path_has(const analysis_context *, int analysis, int stations, const double path[],
                     int station);
/* Like extract_path_has, but returns 1 for every station unless only values are requested
 * (solve_options.values_only). */
int extract_path_needs(const analysis_context *, int analysis, int stations, const double path[],
                       int station);
/* Returns 1 if the station needs more than the motion of nodes: resultants, reactions, shapes,
 * matrices, or the initial state of a following analysis. Compliances that were already computed
 * are not counted. */
int extract_path_whole(const analysis_context *, int analysis, int station);

/* Checks whether stability is lost and regained within a step of a static path. The state is
 * examined after every sixth of the step, so a loss over a fifth of the step is noticed. */

/* Examines the step from n->backup to n->state. Sets *found to a path parameter within the step at
 * which stability differs from that at both ends, or to INFINITY if none was found. If the pivots
 * do not decide the stability at the end of the step, stores it in the record. The work is not
 * counted. */
status within_step(flutter_check *, const newton_run *n, step_record *, double *found, fault *);

/* Small motions and stability about a loaded, deformed state: the last state of the static path
 * that the analysis follows. */

/* Computes the natural frequencies of M x = (1/omega^2) K x, where K is the tangent and M is the
 * mass matrix of the deformed state. If K is not symmetric, or the growth rate of an unstable state
 * is requested, computes the modes of unsymmetric_solve. */
status loaded_modal(analysis_context *c, int analysis, analysis_outcome *o, fault *f);
/* Finds the values of the path parameter at which the tangent of the nonlinear path becomes
 * singular (bifurcations): beyond the end of the static path or, if the state there is unstable,
 * from path 0 on. Loads and drivers continue beyond the end in the same way as along the path. For
 * loads without a potential, finds the first value at which stability is lost. */
status loaded_buckling(analysis_context *c, int analysis, analysis_outcome *o, fault *f);

/* Natural frequencies about the undeformed state. */

status modal_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
status linear_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
status buckling_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* Returns the number of modes that the quantities and imperfections of an analysis need, plus some
 * spare modes. */
int modal_wanted(const analysis_context *, int analysis);

/* Steady-state vibration as a function of frequency: D(w) x = f with the dynamic stiffness D
 * (harmonic_matrices.c). */

typedef struct harmonic_modes harmonic_modes;

/* A load with feedback (loops.c). */
typedef struct control_loop {
    int load;
    const scene_feedback *gains;
    /* [free + driven] loads for a factor of 1, and coefficients of the measured quantity */
    double *push, *measured;
    int integrates;
} control_loop;

typedef struct vibration {
    analysis_context *c;
    int analysis, free, all;
    const model_state *state;
    const outcome_about *about; /* state during a motion; NULL: a state at rest */
    sparse K, M, C, B;          /* matrices of all coordinates */
    int damped, inside;
    int rotates; /* 1: small motions in rotating axes; C contains Coriolis forces */
    /* 1: the mass inside elements is neglected, and the extremes between frequencies are omitted */
    int plain;
    sparse D; /* [2 (free + border + loops)] dynamic stiffness in real form */
    /* source, row: index in K and row of each entry of the free block, column by column; first:
     * [free + 1] index of the first entry of each column */
    int *source, *first;
    int *row, *rows;
    double complex *column; /* [free + border + loops] rows and values of a column of D */
    matrix_factor *factor;
    double *x; /* [2 (free + border + loops)] right-hand side, then solution, in real form */
    double complex *found,
        *left; /* [quantities x (all + loops)] solutions; [quantities x free] residuals */
    double complex *output,
        *dual;             /* [all + loops] linear form of an output, and its dual solution */
    double *room;          /* [model_stresses + all] */
    harmonic_modes *modes; /* modes; NULL: direct solution without modal damping */
    int loops;             /* number of closed loops, whose factors follow all coordinates */
    control_loop *loop;    /* [loops] */
    double *signals;       /* [2 loops x (free + driven)] memory of `push` and `measured` */
} vibration;

/* Finds the feedback loops that the analysis closes, linearised about v->state. */
status loops_find(vibration *, fault *);
void loops_free(vibration *);
/* Returns the number of coordinates and loop factors. */
size_t loops_whole(const vibration *);
const control_loop *loops_of(const vibration *, int load);
/* Computes the coefficients of a loop: own u + gain S^T x = gain r at s = i w, with the factor u,
 * the reference r and the measured form S. Returns `gain` and sets *own. If there is an integral
 * gain, both are multiplied by s. */
double complex loops_gain(const control_loop *, double w, double complex *own);
/* Computes K, M, C and B with all loops closed, on one pattern. The rows are the free coordinates,
 * followed by the integrals of the errors. The caller frees to[4], even after a failure. */
status loops_close(const vibration *, const sparse *const from[], sparse to[], fault *);
void loops_release(sparse closed[]);

/* Returns entry k of the dynamic stiffness D at the circular frequency w. */
double complex harmonic_dynamic(const vibration *, double w, int k);
/* Computes K, M, C and B; if `whole` is 1, including the prescribed coordinates. REFUSED: the
 * analysis is about the undeformed structure but members have initial strains, or about a state
 * that was not reached or is unstable. If the base analysis failed, its status is returned
 * instead. */
status harmonic_matrices(vibration *, int whole, fault *);
status harmonic_pattern(vibration *, fault *);
status harmonic_matrix(vibration *, fault *);
/* Factors the matrix of a direct solution at the circular frequency w. Returns the failures of
 * factor_numeric. */
status harmonic_factor(vibration *, double w, fault *);
/* Returns the number of additional unknowns for modes with a damping ratio in a direct solution.
 * Each such mode has one unknown, y = i w U^T (x - r), with D x + U y = f. */
int harmonic_border(const vibration *);

/* Inputs and outputs (harmonic_inputs.c). */

enum { HARMONIC_SHAPES_OF_MOTION = 4, HARMONIC_SHAPES = 2 * HARMONIC_SHAPES_OF_MOTION };

/* Sets the right-hand side x[all + loops] for an input. The coordinate of a prescribed motion
 * becomes 1. REFUSED: the force has no effect because its component is fixed or prescribed, or the
 * motion is a component of a rotation vector. */
status harmonic_input(const vibration *, const scene_response *, double w, double complex x[],
                      fault *);
/* Sets y[border] of the direct solution to U^T r of the driven coordinate of the input. Returns 0
 * if the input is not a prescribed motion. */
int harmonic_carried(const vibration *, const scene_response *, double y[]);
/* Computes the linear form o[all + loops] of a quantity in the displacements: the quantity is o^T
 * x. */
void harmonic_output(vibration *, const scene_response *, double w, double complex o[]);
/* Returns the part of the input that acts directly on the prescribed motion whose reaction is
 * read. */
double complex harmonic_force_at(const vibration *, const scene_response *, double w);
/* Sets the forces of a quantity's input, without their frequency dependence, and the output of the
 * quantity in the form of forces. Each force has n entries of out. Returns the number of forces, at
 * most HARMONIC_SHAPES. */
int harmonic_shapes(vibration *, const scene_response *, double out[]);

/* Extremes of amplitudes, real parts and imaginary parts between the frequencies of the analysis
 * (harmonic_extremes.c). Phases are excluded, because they are periodic. */

/* Function that computes a quantity at a frequency. The search maximises sign * value. */
typedef status harmonic_value(vibration *, int quantity, double sign, double hertz, outcome_peak *,
                              fault *);
status harmonic_extremes_refine(vibration *, harmonic_value *, outcome_harmonic *, fault *);

/* Undamped modes of the free coordinates (harmonic_modes.c), and the modal solution
 * (harmonic_reduced.c). */

struct harmonic_modes {
    /* n: number of free coordinates; kept: number of modes; count: number of columns of V */
    int n, kept, count;
    int complete;      /* 1: V is complete */
    int damped;        /* number of modes with a damping ratio */
    sparse K, M, C, B; /* free blocks; K is shifted */
    matrix_factor *factor;
    double shift, least,
        inner;      /* shift [1/s^2]; least: shifted square of the next frequency; inner: bound b */
    double *square; /* [kept] shifted squares of circular frequencies */
    double *V;      /* [count x n] K-orthonormal */
    double *U, *carried;       /* [damped x n] U, and [damped] ratio of U^T r to V^T K r */
    int *of;                   /* [damped] index of the mode with the damping ratio */
    double *Kp, *Mp, *Cp, *Bp; /* [count x count] V^T K V, V^T M V, V^T C V, V^T B V */
    double *coupling[3]; /* [kept x kept] X^T (K^-1 - V V^T) Y for the modes V, where X, Y are C V,
                            C V; C V, B V; and B V, B V (couple) */
    double complex *D,
        *entry; /* [count x count] scaled and factored D; entries of D in the order of v->first */
    double *scale; /* [count] */
    int *pivot;
    double complex *y, *inverse, *half;
    double *work;       /* [2 n] */
    double w, positive; /* w: circular frequency; positive: lower bound of the real part of D beyond
                           the modes */
    /* loops of feedback: [(count + loops)^2] factored matrix; work space */
    double complex *closed, *closing;
    int *closed_pivot;
    double *loop_parts; /* [loops x 2 x count] V^T P and V^T S */
    double *balance;    /* [loops x 2] scales of rows and columns */
    double *feedback_size, *lag,
        damps; /* [loops] |P| and q; 1 minus the sum of |P| q (harmonic_closed.c) */
};

/* Extracts the free blocks of K, M, C and B. */
status harmonic_modes_blocks(vibration *, harmonic_modes *, fault *);
/* Computes the first `wanted` modes, or all modes if `wanted` is 0. */
status harmonic_modes_lowest(vibration *, harmonic_modes *, int wanted, fault *);
/* Computes the modes of the analysis. REFUSED: a solution by modes is requested, but the damping of
 * a spring is unsymmetric. Also returns the failures of harmonic_modes_lowest. */
status harmonic_modes_find(vibration *, fault *);
void harmonic_modes_free(harmonic_modes *);
/* Computes the natural frequencies [Hz] in ascending order, at least those below the given
 * frequency. The caller frees *hertz. The modes are damped if springs or dashpots are not
 * symmetric, loops are closed, the axes rotate, or the state belongs to a motion; otherwise they
 * are undamped. *count is 0 if loads make the stiffness unsymmetric or if there would be too many
 * frequencies. */
status harmonic_natural(vibration *, double below, int *count, double **hertz, fault *);
/* Checks the growth of modes. REFUSED: a mode grows because of feedback loops, of springs without a
 * potential, or of damping in rotating axes. NOT_CONVERGED: it is not known whether a mode grows.
 * About a state during a motion, growth is only noted in the result. */
status harmonic_check_growth(vibration *, double below, fault *f);
/* Returns the number of modes with damping ratios, and sets U[count x free]. The damping matrix is
 * C + U U^T. */
int harmonic_modes_damped(const harmonic_modes *, const double **U);
/* Sets out[count] to U^T r, where r are the static displacements due to a unit displacement of the
 * driven coordinate. */
void harmonic_modes_carried(const vibration *, int driven, double out[]);
/* Adds the static shapes due to the forces f[count x free] of inputs and outputs, and computes the
 * projected matrices. */
status harmonic_modes_project(vibration *, int count, const double f[], fault *);
/* Factors D at a circular frequency. SINGULAR: the frequency is at an undamped resonance.
 * NOT_CONVERGED: there are too few modes for an error bound. */
status harmonic_modes_factor(vibration *, double w, fault *);
/* Solves for x[free], which contains the forces on entry and the solution on return. Sets f to the
 * residual of the forces, unless all modes are used. */
void harmonic_modes_solve(vibration *, double complex f[], double complex x[]);
/* Returns a bound of |o^T (x - D^-1 f)| from the residuals of the solutions for f and o; 0: all
 * modes are used. */
double harmonic_modes_bound(vibration *, const double complex left_of_f[],
                            const double complex left_of_o[]);
/* Returns the norm of a residual r[free], sqrt(r^H K^-1 r). */
double harmonic_modes_left(vibration *, const double complex r[]);
/* Returns NOT_CONVERGED with the message that a bound requires more modes. */
status harmonic_modes_few(const vibration *, fault *);

/* Call this function after harmonic_modes_project. */
status harmonic_closed_alloc(vibration *, fault *);
/* Factors the matrix of the modes and loops. Call this function after harmonic_modes_factor.
 * SINGULAR: the frequency is at an undamped resonance. NOT_CONVERGED: there is no error bound. */
status harmonic_closed_factor(vibration *, fault *);
/* Solves for the forces f[free]. x[all + loops] contains the right-hand sides b of the loops on
 * entry; it contains the solution and the factors of the loops on return. */
void harmonic_closed_solve(vibration *, const double complex f[], double complex x[]);
/* Like harmonic_modes_bound, for closed loops with the factors u[loops]. output[all + loops]:
 * residual of the output, and coefficients of u in the output. dual[free]: dual solution of the
 * output without loops. */
double harmonic_closed_bound(vibration *, const double complex left_of_f[],
                             const double complex u[], const double complex output[],
                             const double complex dual[]);

status harmonic_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* Computes the matrices about the state in all coordinates, and finds the closed loops. */
status harmonic_begin(vibration *, fault *);
/* Computes K, M, C and the modes with damping ratios of a harmonic analysis. The caller frees *out,
 * even after a failure. */
status harmonic_system(analysis_context *, int analysis, vibration *out, fault *);
void harmonic_release(vibration *);
/* Repeats the analysis without the mass inside elements. Sets *error, which must be 0 on entry, to
 * the largest difference of the responses relative to the largest value of each curve, and
 * *quantity to the index of the quantity with this difference. */
status harmonic_inside(analysis_context *, int analysis, double *error, int *quantity, fault *);
/* Checks the prescribed motion of an input. REFUSED: the motion is a component of a rotation
 * vector. */
status harmonic_check_motion(const vibration *, int driver, fault *);
/* Checks the velocity or acceleration that the quantity reads. REFUSED: the body rotates at this
 * time of the motion, so the quantity is not only the rate of a displacement. */
status harmonic_check_rates(const vibration *, const scene_response *, fault *);
/* Sets *out to the driven coordinate whose reaction a quantity reads. REFUSED: no motion drives
 * this component alone, or the motion drives other components. */
status harmonic_reacting(const vibration *, const scene_response *, int *out, fault *);

/* Second-order models with the inputs and outputs of the scene (second_order.c). */

status second_order_list(const scene *, system_matrices *, fault *);
/* Stores the matrices. v contains the matrices of all coordinates, the state, and the modes with
 * damping ratios. G: gyroscopic matrix, or NULL. REFUSED: there are too many coordinates, a
 * prescribed motion is a component of a rotation vector, or the state space or its reduction is
 * rejected. */
status second_order_keep(const vibration *v, const sparse *G, const system_matrices *,
                         state_matrices *, fault *);
/* Stores the reduced model and its errors (second_order_reduced.c). */
status second_order_keep_reduced(const vibration *, const system_matrices *,
                                 const second_order *whole, reduced_model *, fault *);
/* Lists the nonzero entries column by column. */
status second_order_triplets(int rows, int columns, const double value[], triplets *, fault *);
/* Stores the model with its first `outputs` outputs. */
status second_order_take(const second_order *, int outputs, linear_model *, fault *);
/* Stores the state-space form. reduced: 1 if the model is a reduced one, which messages state. */
status second_order_state_space(const vibration *, const system_matrices *, const second_order *,
                                int reduced, linear_model *, fault *);

/* Returns the number of integral gains of the closed loops. */
int poles_integrals(const vibration *);
/* Finds the modes of the matrices with closed loops. If a slow pole hides other modes, the matrices
 * are shifted for this purpose. */
status poles_solve(vibration *, unsymmetric_problem *, sparse closed[], unsymmetric_result *,
                   fault *);

status damped_modal(analysis_context *, int analysis, analysis_outcome *, fault *);

/* Stationary rotation and small motions about it. */

status rotation_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
void rotation_evaluate_stations(analysis_context *, int analysis, const analysis_outcome *);

/* Nonlinear equilibrium along a path. */

status static_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* Advances from the current path parameter to `target`. Steps are halved if Newton's method fails,
 * and doubled if it converges easily. *increment is the size of the first step on entry, and that
 * of the next step on return. */
status static_walk(newton_run *, double target, double *increment, fault *);

#endif
