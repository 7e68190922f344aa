/* Internal interfaces of analysis/. */
#ifndef BEAMWORK_ANALYSIS_IMPL_H
#define BEAMWORK_ANALYSIS_IMPL_H

#include <complex.h>

#include "elements/shared/status.h"
#include "harness/analysis/analysis.h"
#include "harness/newton/newton.h"
#include "harness/numerics/numerics.h"

/* Eigenpairs of largest size of a real operator without symmetry: the operator projected on a
 * growing orthonormal basis (Arnoldi).  No inertia counts them: when the wanted ones
 * have converged, start vectors are added until one brings no value that is as large. */

typedef struct arnoldi_problem {
    int n, wanted;
    void (*apply)(void *context, const double x[], double y[]); /* y = T x */
    void *context;
} arnoldi_problem;

typedef struct arnoldi_result {
    int count; /* fewer than wanted when no more are larger than rounding; one more where
                  the last one is the first of a conjugate pair */
    double complex *theta; /* [count] largest size first, conjugates one after the other */
    double complex *mode;  /* [count x n] of length 1 */
    double *residual;      /* [count] |T x - theta x|/|theta| */
    long applied;
} arnoldi_result;

status arnoldi_solve(const arnoldi_problem *, arnoldi_result *, fault *);
void arnoldi_free(arnoldi_result *);

/* Linear buckling about the undeformed state. */

status buckling_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

/* Centre lines of all solutions, for pictures. */

/* Collects shapes of the undeformed structure, of at most `most` states of every path, of linear
 * solutions and of modes. */
status collect_shapes(const analysis_context *, int most, shapes *, fault *);

/* Matrices of small motions about all solutions. */

/* Matrices about the undeformed structure, every station that was reached of every path, and the
 * loaded states of modal analyses. */
status collect_systems(const analysis_context *, system_matrices *, fault *);

/* Compliance and stiffness of a node in a deformed state. */

status compliance_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

/* Compliances along a path, taken while it is walked: where Newton's last correction changes the
 * tangent by less than its rounding, the last tangent is that of the station, and no other one is
 * made; one is made at once where members are condensed. */

typedef struct compliance_walk compliance_walk;

/* Begins the compliances of all analyses about states of `path`; *out NULL: no analysis follows it.
 */
status compliance_walk_begin(newton_run *, int path, compliance_walk **out, fault *);
/* Newton's method has reached the station. The analysis itself computes what is not available now.
 * w NULL: no analysis follows. FAULT: out of memory. */
status compliance_walk_take(compliance_walk *w, const newton_run *, int station, fault *);
void compliance_walk_end(compliance_walk *);

/* Equilibrium paths under proportional loads, through limit points. */

status continuation_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

/* Quantities of a continued path. */

/* Curves and critical points; 0: the quantity is something else. */
int continuation_extract(const analysis_context *, const scene_quantity *, const analysis_outcome *,
                         quantity_result *);
/* A curve of coordinates is wanted: the states of all points are kept for it. */
int continuation_extract_keeps_states(const scene *, int analysis);

/* Small motions x exp(s t) about a state whose stiffness is not symmetric: (s^2 M + s C + K) x = 0,
 * M symmetric and positive semidefinite, C of damping or absent.
 *
 * The least s are the largest 1/s^2 of -K^-1 M, or with C the largest 1/s of its companion with the
 * rates of coordinates with mass.  Massless coordinates are zeros of these and no motion. */

typedef struct unsymmetric_problem {
    const sparse *K, *M, *C; /* same pattern; C NULL: nothing is damped */
    matrix_factor *K_factor; /* factor_numeric done */
    int wanted;              /* least motions */
    int estimate;            /* 1: errors are wanted: twice the work */
    int decaying;            /* 1: with C also motions that decay without oscillation */
    const sparse *B;         /* of what moves inside the elements, with C; NULL: nothing does */
    double mass, stiffness;  /* proportional damping of C, which that has too [1/s], [s] */
} unsymmetric_problem;

/* s = growth + i frequency, ascending in size.  Without damping both motions of a flutter are
 * there, which have one frequency and opposite rates; of a divergence the growing one.  With
 * damping every motion that oscillates, and those that grow without. */
typedef struct unsymmetric_result {
    int n, count;
    double *frequency, *growth; /* [count] [rad/s], [1/s]; growth 0: below what rounding makes of a
                                   double value */
    double *split; /* [count] imaginary part of s^2 relative to its size; 1: divergence */
    double *error; /* [count] estimate of the rounding error, relative to |s| */
    double *mode;  /* [count x n] real */
    long solutions;
} unsymmetric_result;

/* A smaller imaginary part of s^2, relative to it, is rounding of a double value. */
static const double unsymmetric_same = 1e-6;

status unsymmetric_solve(const unsymmetric_problem *, unsymmetric_result *, fault *);
void unsymmetric_free(unsymmetric_result *);

/* Small motions and stability about states whose tangent is not symmetric: loads that follow, and
 * moments about fixed axes.  There stability is lost by divergence, where the tangent is singular,
 * or by flutter, where two frequencies meet; with damping of members where a motion grows. */

typedef enum flutter_kind { FLUTTER_NONE, FLUTTER_DIVERGES, FLUTTER_OSCILLATES } flutter_kind;

/* Matrices of small motions about Newton's present state, whose K is factored. */
typedef struct flutter_system {
    sparse M, C;
    int damped;   /* 1: C is that of members; else motions are those without damping */
    int massless; /* 1: the structure has no mass; M is the metric, which knows no direction, so
                     that double values stay real: only what diverges has a meaning */
} flutter_system;

status flutter_system_alloc(const newton_run *, flutter_system *, fault *);
void flutter_system_free(flutter_system *);
/* The least `wanted` motions about the state. */
status flutter_motions(const newton_run *, flutter_system *, int wanted, int estimate,
                       unsymmetric_result *, fault *);
/* Moves frequencies, modes and errors to an outcome; values without digits become NaN. */
void flutter_take(unsymmetric_result *from, outcome_side *to);
/* Damping of the motions: "", "undamped" where members are damped and damped is 0, or "with the
 * members' damping". */
const char *flutter_damping(const scene *, int damped);
/* Kind of the fastest growing motion, number *mode. */
flutter_kind flutter_of(const flutter_system *, const unsymmetric_result *, int *mode);
/* "flutter, undamped", "divergence", "flutter, growth with the members' damping" */
const char *flutter_name(const flutter_system *, flutter_kind);

/* The path parameter at which stability is first lost, from path 0. The state is on the path. *mode
 * [free], which the caller frees. */
typedef struct flutter_point {
    double path, error, frequency; /* error: relative to the path; [rad/s] */
    const char *what;              /* flutter_name */
    int massless;
    double *mode;
} flutter_point;
/* From the present path to `target`: static_walk. */
typedef status flutter_walk(newton_run *, double target, double *increment, fault *);
status flutter_search(newton_run *, double size, flutter_walk *, flutter_point *, fault *);

/* Stability of states whose tangent is not symmetric: with mass by the frequencies of small motions
 * about them, without mass by the number of eigenvalues of the tangent that have passed zero. */

/* Workspace of one analysis; all members are zero at first. */
typedef struct flutter_judge {
    int begun;
    newton_run n; /* with a tangent of all coordinates, which that of a path need not have */
    flutter_system of;
} flutter_judge;

/* Writes the stability into the record of the step that ended at the state; unknown: STEP_OPEN. The
 * work is not counted. */
status flutter_judge_state(flutter_judge *, analysis_context *, const model_state *, step_record *,
                           fault *);
/* The same of the state that j->n has; negative_pivots of the record become those of the state, -1:
 * not symmetric, or singular. */
status flutter_judge_begin(flutter_judge *, analysis_context *, fault *);
void flutter_judge_free(flutter_judge *);

/* Replacement of the count of negative pivots where a tangent K is not symmetric: the eigenvalues
 * next to zero of D^-1 K, D the metric, and the number of those left of the imaginary axis. That
 * number changes where one passes zero, which is a critical point, and where a pair crosses the
 * imaginary axis away from zero, which is not one. Pairs that meet on the real axis do not change
 * it, nor does rounding that turns a double value into a pair. A symmetric K has as many of them as
 * negative pivots. */

enum { LEFT_NEAREST = 6 };

typedef struct left_of_axis {
    int count; /* -1: not known */
    int nearest;
    double complex mu[LEFT_NEAREST]; /* [nearest] next to zero, least size first */
    long solutions;
} left_of_axis;

/* K factored, [n]; weight [n] of the metric. */
status left_count(matrix_factor *K, int n, const double weight[], left_of_axis *, fault *);

/* Continuation of equilibrium paths under proportional loads, inside of its files.
 *
 * The load factor is one more unknown and one coordinate, or the arc, is given instead:
 *   K dx = r + f' dl,  g . dx = c,  hence dx = K^-1 r + dl K^-1 f',
 *   dl = (c - g . K^-1 r)/(g . K^-1 f').
 * K as it was factored last on the way to a point gives the tangent of the path there, the first
 * direction of the next step and, where K is symmetric, the number of its negative eigenvalues: the
 * last correction is at most the criterion, and so is, but for a factor, what K has changed by. */

/* A point of the path. */
typedef struct path_point {
    double factor, control; /* [1], [m] */
    double rate;            /* dfactor/ds with s in the model's metric */
    double *tangent;        /* [free + driven] dx/ds */
    int symmetric;
    int negative; /* negative pivots of K, or what left_count counts in their place; -1: not known
                   */
    int determinant; /* sign of det K */
    double least;    /* eigenvalue of K of least size, its real part where K is not
                        symmetric; NAN: not needed */
    int nearest;
    double complex mu[LEFT_NEAREST]; /* [nearest] eigenvalues next to zero, least size first, where
                                        K is not symmetric */
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
    int analysis, room; /* room: for points in the outcome */
    int asks_critical;  /* 1: a quantity asks for critical points */
    int keeps_states;   /* 1: the outcome keeps the state of every point */
    newton_run n;       /* n.backup: state at the start of the step */
    flutter_judge judge;
    model_state *end; /* of the step, while a critical point inside it is sought */
    double *weight;   /* [free + driven] the metric */
    double *load;     /* [free + driven] f' */
    double *response; /* [free + driven] K^-1 f' */
    double *moved;    /* [free + driven] sum of the increments of the step */
    double *mode;     /* [free + driven] null vector */
    path_goal goal;   /* of the step that is iterated */
    path_point here, next, trial;
    int first;    /* negative pivots at the start */
    int narrow;   /* 1: a change of stability was located as closely as possible */
    int doubtful; /* 1: not known whether the step has critical points */
    int looked;   /* 1: n.dx, response and the factors belong to the present state */
} continuation;

status continuation_step_alloc(analysis_context *, int analysis, outcome_continuation *,
                               continuation *, fault *);
void continuation_step_free(continuation *);

double continuation_step_dot(const continuation *, const double a[],
                             const double b[]); /* in the metric */
/* Newton's method to the goal from n.backup = the state of `here`; the arc is measured along its
 * tangent. */
status continuation_step_correct(continuation *, path_goal, step_record *, fault *);
/* The same from the present state, to which the last one led. */
status continuation_step_go_on(continuation *, path_goal, step_record *, fault *);
/* Factors K in the present state and fills the point; its tangent goes the way of along[free +
 * driven] (NULL: to a larger load). */
status continuation_step_look(continuation *, const double along[], path_point *, step_record *,
                              fault *);
/* After a correction that has converged: the point from the last factors, which belong to a state
 * that is away by the last correction; nothing is left to correct. */
status continuation_step_end(continuation *, path_point *, const step_record *, fault *);
/* Restores the state of `here`. */
void continuation_step_go_back(continuation *);

/* continuation.c: why the step from `here` to `next` is too long or led to another branch;
 * NULL: sound. *swing: how much it turns relative to what is allowed. last_resort: several critical
 * points may lie in one step, as it cannot be shorter. */
const char *continuation_sound_doubt(const continuation *, int last_resort, double *swing);

/* End of a step that may lie on another branch. */
typedef struct rival {
    model_state *state; /* NULL: none */
    double factor;
} rival;

/* Reports a jump: the step from the control coordinate `from` had led to the rival, but the path
 * leads to `here`. With constant steps the path ends. */
status continuation_sound_report_jump(continuation *, const rival *, double from, fault *);

/* continuation_critical.c: the critical points between `here` and `next`, if any, become events.
 * The step was found with the goal. *jump: 1 when the tangent stiffness changes its inertia without
 * a critical point, which is another branch. */
status continuation_critical(continuation *, path_goal, int *jump, fault *);
/* Where critical points are requested: *hidden 1 when something changes within the step and back,
 * as far as that lasts a fifth of it. */
status continuation_critical_within(continuation *, path_goal, int *hidden, fault *);

/* Quantities of a scene from the outcomes of its analyses. */

void extract_quantity(const analysis_context *, const scene_quantity *, quantity_result *);

/* Quantities of a path: at a station, the largest or least of all, or as a curve. */

/* No value: the path ends before the stations that the quantity needs. */
void extract_path(const analysis_context *, const scene_quantity *, const analysis_outcome *,
                  quantity_result *);

/* The spectrum that the quantity is, of count values a step apart [s] in its units. */
void spectrum_take(const scene_quantity *, int count, double step, const double value[],
                   quantity_result *);

/* Is a station of the path[stations] of an analysis one that some quantity other than a curve is
 * taken at? */
int extract_path_asks(const analysis_context *, int analysis, int stations, const double path[],
                      int station);
/* The same, or are all stations wanted? */
int extract_path_wants(const analysis_context *, int analysis, int stations, const double path[],
                       int station);
/* Is more of the state at a station read than the motion of nodes: resultants, reactions, shapes,
 * matrices, or what an analysis that follows begins with? Compliances that were taken on the way
 * ask for nothing more. */
int extract_path_whole(const analysis_context *, int analysis, int station);

/* Quantities of eigenvalues: critical loads and frequencies. */

/* Critical load factor of the wanted sign and order. */
void extract_spectrum_buckling(const scene_quantity *, const analysis_outcome *, quantity_result *);
/* Frequency [Hz] of the wanted kind and order of mode. */
void extract_spectrum_modal(const analysis_context *, const scene_quantity *,
                            const analysis_outcome *, quantity_result *);

/* Checks whether stability is lost and regained within a step of a static path: the state is
 * examined after every sixth of the step, so that an interval of a fifth of it is noticed. */

/* The step led from one state to the other. *found: path of a part of it whose stability is not
 * between those of the ends; INFINITY: there is none that could be reached. It is not counted as
 * work. */
status within_step(flutter_judge *, analysis_context *, const model_state *from,
                   const model_state *to, double *found, fault *);

/* Linear statics about the undeformed state. */

status linear_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

/* Small motions and stability about a loaded, deformed state: the last one of the static path that
 * an analysis follows. */

/* Natural frequencies: M x = (1/omega^2) K x with tangent K and mass M of the deformed state. */
status loaded_modal(analysis_context *c, int analysis, analysis_outcome *o, fault *f);
/* The value of the path parameter, beyond the end of the static path, at which the tangent of the
 * nonlinear path first becomes singular (a bifurcation; loads and drivers continue as along the
 * path). */
status loaded_buckling(analysis_context *c, int analysis, analysis_outcome *o, fault *f);

/* Natural frequencies about the undeformed state. */

status modal_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* How many modes the quantities of an analysis ask for. */
int modal_wanted(const analysis_context *, int analysis);

/* Steady vibration by frequency: D(w) x = f with the dynamic stiffness D (harmonic.c). */

typedef struct harmonic_modes harmonic_modes;

typedef struct vibration {
    analysis_context *c;
    int analysis, free, all;
    const model_state *state;
    sparse K, M, C, B; /* on all coordinates */
    int damped, inside;
    sparse D; /* [2 (free + border)] real form */
    int *source,
        *first; /* entry of K behind each entry of the free block, by columns; [free + 1] */
    int *row, *rows;
    double complex *column; /* [free + border], as rows: of one column of D */
    matrix_factor *factor;
    double *x;                     /* [2 (free + border)] */
    double complex *found, *left;  /* [quantities x all], [quantities x free] */
    double complex *output, *dual; /* [all] */
    double *room;                  /* [model_stresses + all] */
    harmonic_modes *modes; /* NULL: the solution is direct, and no mode has a damping ratio */
} vibration;

/* Entry k of K, M, ... in D. */
double complex harmonic_dynamic(const vibration *, double w, int k);

/* Modes without damping, of the free coordinates, and the solution by them (harmonic_modes.c). */

status harmonic_modes_find(vibration *, fault *);
void harmonic_modes_free(harmonic_modes *);
/* Modes that damping ratios damp: C + U U^T with U [count x free]. */
int harmonic_modes_damped(const harmonic_modes *, const double **U);
/* U^T of the displacements that a unit motion of the driven coordinate makes at rest, [count]. */
void harmonic_modes_carried(const vibration *, int driven, double out[]);
/* The static shapes of inputs and outputs, and the projected matrices. f: [count x free] forces. */
status harmonic_modes_project(vibration *, int count, const double f[], fault *);
/* Factors D at a frequency; SINGULAR as a direct solution. */
status harmonic_modes_factor(vibration *, double w, fault *);
/* x [free] for the forces there; x becomes the solution, f what it leaves of the forces. */
void harmonic_modes_solve(vibration *, double complex f[], double complex x[]);
/* Bound of |o^T (x - D^-1 f)|, from what the solutions for f and o leave; INFINITY: none. */
double harmonic_modes_bound(vibration *, const double complex left_of_f[],
                            const double complex left_of_o[]);

status harmonic_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* Modes with damping. */
status damped_modal(analysis_context *, int analysis, analysis_outcome *, fault *);

/* Stationary rotation and small motions about it. */

status rotation_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* Enters the stability of the stations, as the modes found show it, after the steps have been
 * evaluated. */
void rotation_judge_stations(analysis_context *, int analysis, const analysis_outcome *);

/* Nonlinear equilibrium along a path. */

status static_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* From the present path to `target` in steps that halve when Newton fails and double when it is
 * easy; *increment: the first one, then the next. */
status static_walk(newton_run *, double target, double *increment, fault *);

#endif
