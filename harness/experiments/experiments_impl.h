/* Internal declarations of experiments/. */
#ifndef BEAMWORK_EXPERIMENTS_IMPL_H
#define BEAMWORK_EXPERIMENTS_IMPL_H

#include <stdatomic.h>
#include <stdio.h>

#include "cases/scene/scene.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

/* Evaluates given times [s] of `pairs` laps each; for tests, which supply the times. */
contest_clock against_judge(int pairs, const double a[], const double b[]);

/* Varied parameter: a parameter of a case, and its values. */

enum { AXIS_MOST_VALUES = 1000001 };

/* Reads "NAME=A..B/N" (N equal parts, ends included), "NAME=A..B/N:log" (equal ratios), "NAME=A..B"
 * or "NAME=A..B:log" (a design supplies the points), or "NAME=A,B,C" (numbers, or words of a
 * choice). REFUSED: names the invalid part and the remedy. All values are allowed values of the
 * parameter. */
status axis_read(const case_type *type, const char *text, sweep_axis *out, fault *f);
void axis_free(sweep_axis *);
/* Value i of `count`. */
double axis_value(const sweep_axis *, int i);
/* Value at a fraction of the axis, 0 <= share < 1; for a list, the value at this fraction of the
 * list. */
double axis_at(const sweep_axis *, double share);
/* "linear", "log", "list", "words". */
const char *axis_kind_name(axis_kind);
/* The value as text. */
void axis_text(const sweep_axis *, double value, char *text, int size);

machine node_here(void);

/* A batch file: a line of JSON with the label, the bytes of the results, and a line with length and
 * checksum. The file appears complete or not at all. */

/* "verify-0123456789ab": common beginning of the names of all batches of one work. */
void batch_stem(const shard_work *w, char out[BATCH_STEM]);
/* "verify-0123456789ab-000017.batch"; batch numbers in names start at 1. */
void batch_name(const char *stem, int batch, char out[BATCH_NAME]);
/* Index of the batch with this name; -1: not a batch of that stem. */
int batch_of_name(const char *name, const char *stem);
/* Returns 1 when the name has the ending of batch files. */
int batch_is_name(const char *name);

/* Writes folder/NAME under a temporary name, then renames it. FAULT: disk, memory. */
status batch_write(const char *folder, const batch_label *label, const void *bytes, size_t size,
                   fault *f);
/* Removes temporary files of a batch left by killed processes. gone 1: the writer is known to have
 * ended. */
void batch_clean(const char *folder, const char *name, int gone);
/* Reads the label. *from (may be NULL) is then at the first byte of the results, and *end after the
 * last. FAULT: truncated, damaged, or not a batch. */
status batch_open(const char *path, batch_label *out, FILE **from, long *end, fault *f);
/* REFUSED: the batch does not belong to the work; the message gives the difference and the path. */
status batch_belongs(const batch_label *, const shard_work *, const char *path, fault *f);

/* Appends an empty measure. */
element_measure *measures_add(measures *m, const char *name);
/* Number of quantities with a wrong limit. */
int measures_astray(const measures *m);

/* Returns the check of the given name; a new check passes until a deviation is found. */
claim *claims_open(claims *c, const char *name, double allowed);
/* Records that the type does not declare this property, and why. */
void claims_not_made(claims *c, const char *name, const char *why);
/* Adds a comparison; NaN is the largest deviation. */
void claims_departs(claim *one, double departure, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Adds a question; `sentence` describes the error if `holds` is 0. */
void claims_asks(claim *one, int holds, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Names the next check. */
void claims_doing(claims *c, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Relative difference of two numbers; 0 for equal numbers, and for two zeros. */
static inline double claims_share(double apart, double size)
{
    return apart == 0 ? 0 : apart / size;
}
/* Number of checks with this outcome, and number of comparisons in them. */
int claims_counted(const claims *c, claim_outcome outcome);
int claims_compared(const claims *c);

/* Lengths in units of `unit` metres, force in newtons, time in seconds for the same mass. */
status profiles_section(profiles_form form, double unit, section *out, fault *f);

/* Features for a straight element: all that the type supports, except `without`. */
unsigned specimen_features(const element_type *t, unsigned without);

/* Pseudo-random numbers in (-1/2, 1/2), determined by the seed. */
void specimen_numbers(int count, unsigned seed, double out[]);
/* Rotates the whole element about the origin by a rotation vector, then shifts it by the given
 * number of lengths. */
void specimen_carry(const specimen *s, const double turn[3], const node_state x[],
                    node_state out[]);

/* Point at which differences are taken. */
typedef struct specimen_place {
    const specimen *s;
    const node_state *x;
} specimen_place;

/* Coordinate i moved by si difference units, j by sj. */
void specimen_moved(const specimen_place *at, int i, double si, int j, double sj, node_state out[]);

/* Inner unknowns in the undeformed state [inner]. */
void specimen_rest(const specimen *s, double inner[]);
/* Stress after Newton's method has solved the element's equations for its inner unknowns. */
status specimen_settled(const specimen *s, const double e[], double inner[], stress_output *out);

/* "rotation about y of node 2". */
const char *specimen_coordinate(int c, char words[SPECIMEN_WORDS]);

/* Families of checks: the requirements of element.h. Each checks all elements that the formulation
 * supports and adds its results. */

checks_run checks_declared;    /* its declarations are consistent            */
checks_run checks_features;    /* supports the features it declares, alone, in subsets, and as
                                  required by cases */
checks_run checks_derivatives; /* J and H of the strains */
checks_run checks_energy; /* stress, stiffness and geometric stiffness derive from the energy */
checks_run
    checks_force; /* for types defined by forces: force and stiffness derive from the energy */
checks_run checks_motion;    /* invariance to rigid motion, order of the nodes, units */
checks_run checks_stateless; /* equal calls give equal results, independent of previous calls */
checks_run checks_many;      /* many elements in one call give the same as single calls */
checks_run checks_bounds;    /* outputs are filled completely, and no other memory is changed */
checks_run checks_unsound;   /* NaN and Inf are reported */
checks_run checks_mass;      /* the mass matrix is symmetric and positive definite, with the mass of
                                the beam */
checks_run checks_rotating;  /* effects of a rotating frame */
checks_run checks_along;     /* loads along one element */
checks_run checks_in_time;   /* inertia forces in transient analysis */

measured_run measured_states;  /* cantilever, compared with the exact solution */
measured_run measured_locking; /* over thickness/length */
measured_run measured_orders;  /* over the number of elements */

const char *certificate_part_name(int part);
/* Description of a part in one line. */
const char *certificate_part_words(int part);
/* Number of checks with that outcome, and number of comparisons, over all parts. */
int certificate_counted(const certificate *, claim_outcome);
int certificate_compared(const certificate *);
/* The first failed check; NULL: none. */
const claim *certificate_broken(const certificate *);

/* Cuts work into batches and assigns batches to shards. Both depend only on the costs. */

/* shard[batches]: assigns each batch to a shard 0..shards-1. The most expensive batch is assigned
 * first, each to the shard with the lowest cost so far. Returns 0, or -1 when out of memory. */
int deal_out(int batches, const double cost[], int shards, int shard[]);
/* order[batches]: the most expensive first; equal costs keep their order. */
void deal_order(int batches, const double cost[], int order[]);

/* Smallest stride; largest number of marks, a few kilobytes each. */
enum { DESIGN_STRIDE = 16384, DESIGN_MARKS = 1024, DESIGN_MOST_POINTS = 1000000000 };

/* points: ignored for grids. In a grid the last axis changes fastest. As in GSL, the first point of
 * Sobol's and Halton's sequences is the one after the origin. REFUSED: too many points; a grid with
 * an axis that is not divided; another design with an axis that is; more axes than the sequence
 * supports. */
status design_make(design_kind kind, int axes, const sweep_axis list[], long points,
                   unsigned long seed, design *out, fault *f);
void design_free(design *);
/* Values of the axes at `count` points from `first` on: out[count x axes]. FAULT: out of memory. */
status design_points(const design *, long first, long count, double out[], fault *f);
const char *design_name(design_kind);

int outcome_is_good(outcome_kind kind); /* Is the outcome accurate or under-resolved? */

/* Outcome of the same formulation and quantity at the x with which others are compared, or NULL. */
extreme_outcome *extreme_sweep_base(const extreme_sweep *s, const extreme_outcome *o);

/* Plans a point for every extreme and value, in order, with a series for every formulation and an
 * outcome for each of its quantities. */
status extreme_plan(const extreme_request *request, extreme_sweep *out, fault *f);

/* Outcomes of a sweep of extremes as text. */

void extreme_table(FILE *to, const void *found); /* extreme_sweep */

/* Lists of steps and tolerances on a command line. */

typedef struct pace_list {
    int count;
    double value[PACE_LIST_MOST];
} pace_list;

/* Reads "0.1,0.05" or "0.1..0.0125", which is divided by `ratio` repeatedly; positive numbers.
 * option: its name, for messages. */
status pace_list_read(const char *option, const char *text, double ratio, pace_list *out, fault *f);

#define PACE_METHODS                                                                               \
    "alpha, alpha:rho=R, hht, hht:alpha=A, trapezoidal, conserving, radau, explicit"

/* Default method. */
extern const char pace_method_all[];
/* Reads one of PACE_METHODS, with parameters R in [0, 1] and A in [0, 1/3]. REFUSED: names the
 * invalid part. */
status pace_method_read(const char *text, int length, pace_method *out, fault *f);
/* Appends the methods of "NAME,NAME,...", each of which may occur once. */
status pace_method_read_list(const char *text, int most, pace_method list[], int *count, fault *f);

/* Tolerances of the reference and of its checks, radau on the same mesh. */
enum { PACE_CHECKS = 2 };
extern const double pace_reference[1 + PACE_CHECKS];
/* Limits of E/E0 - 1, and of relative changes of energy and momenta. */
extern const double pace_growth, pace_energy, pace_momentum;

void pace_free(pace *);
const char *pace_fate_name(pace_fate);
const sweep_point *pace_point_of(const pace *, const pace_run *);
const cell_result *pace_cell_of(const pace *, int index);

/* Reads the table and plans its motions. REFUSED: the first error, with its line. */
status pace_verdict_plan(const char *path, pace *, pace_verdicts *, fault *);
/* After pace_judge. */
void pace_verdict_reach(const pace *, pace_verdicts *);
void pace_verdict_free(pace_verdicts *);

/* Status of a cell; smaller values are those of `status`. */
enum {
    ROWS_NOT_OFFERED = STATUS_NO_VALUE + 1,
    ROWS_NO_SCENE,
    ROWS_NOT_COMPUTED, /* its batch is missing */
    ROWS_STATUSES
};

/* Sets all columns to zero. FAULT: out of memory. */
status rows_alloc(const rows_shape *shape, int points, rows *out, fault *f);
void rows_free(rows *);
/* Writes the bytes in the format of this machine. Returns 0, or -1. */
int rows_write(FILE *to, const rows *);
int rows_read(FILE *from, rows *);
/* Indices into the columns. */
size_t rows_quantity(const rows *, int point, int quantity);
size_t rows_cell(const rows *, int point, int formulation, int mesh);
size_t rows_value(const rows *, int point, int formulation, int mesh, int quantity);
size_t rows_lacks(const rows *, int point, int formulation);
size_t rows_least(const rows *, int point, int formulation, int quantity);
/* Words used in the file. */
const char *rows_reference_name(int kind);
const char *rows_status_name(int status);

enum { SHARD_MOST_JOBS = 64, SHARD_MOST = 100000 };

/* Path of an existing batch. */
status stock_path(const stock *, int batch, char out[PATH_MAX], fault *f);

/* Adds points from `first` on; call once per point, in order. */
status tally_add(tally *, long first, const rows *, fault *f);
/* quantity: index, or the number of quantities for all together. */
const tally_series *tally_of(const tally *, int formulation, int quantity);
const tally_place *tally_at(const tally *, int formulation, int quantity, int line, int column);
/* Lower bound of a column (0) or a line (1) of the map, as a value of its axis. */
double tally_edge(const tally *, int axis_index, int place);

/* A sweep as a group of a results file, written batch by batch, so that at most one batch is in
 * memory. */

/* Adds points from `first` on. */
status ranges_file_add(ranges_file *, long first, const rows *, fault *f);

/* Measures run times of cells: rounds over the cells of a parameter point, for all cells of a
 * completed sweep. */

/* One more round: repeats until `floor` [s] of processor time are used, at least once. Cells that
 * fail are timed too. */
void rounds_run(const cell_request *request, double floor, rounds_reading *out);
/* One more round of the published algorithm for the cell with the result `cell`; does nothing for
 * linear or very large problems. */
void dense_reference_round(const cell_request *own, const cell_result *cell, double floor,
                           dense_reference *out);

/* A beam that is fixed at its start and loaded at its end, straight or bent to a quarter circle,
 * solved with one formulation. */

typedef enum beam_analysis { BEAM_LINEAR, BEAM_LARGE, BEAM_BUCKLING, BEAM_VIBRATION } beam_analysis;

/* The length is 1 m, along x, or along a quarter circle that starts along y with its centre at the
 * origin. */
typedef struct beam_request {
    const formulation *chosen;
    int elements;            /* per member, of equal length */
    const double *fraction;  /* [elements] fractions of the length; NULL: equal */
    double thickness, width; /* of a rectangle, along y (towards the centre) and z [m] */
    int profile;             /* 1: instead, an I-section with warping, fixed at the start */
    int quarter;             /* 1: bent */
    unsigned needs;          /* FEATURE_* bits */
    beam_analysis analysis;
    scene_load_kind load; /* force or moment at the end */
    double vector[3];     /* [N, N m] */
    int component; /* component read at the end; ignored for a frequency or critical factor */
} beam_request;

/* Constants of its section. */
status beam_section(const beam_request *, section *out);
/* Solves the beam and adds the error with respect to the exact value to the measure: NAN if there
 * is no value; `words` then gives the reason at the first such point. Returns 0 when further points
 * are useless: the formulation does not support the beam, or the first three points have no
 * value. */
int beam_point(const beam_request *, double at, double exact, element_measure *one);

/* Outcome of a family of checks. */
claim_outcome claims_outcome(const claims *);

/* Prints certificates as text, one screen each. */

#define CERTIFICATE_EXACT 1e-9 /* errors below it are `exact` */

/* verbose: every check with its numbers; quiet: only failed checks. */
void certificate_text(FILE *to, screen look, const certificate *all, int count, int verbose,
                      int quiet);
/* The tables that a paper prints: as LaTeX or Markdown. */
void certificate_paper(FILE *to, int latex, const certificate *all, int count);
/* One line for each check and each measured error. */
void certificate_csv(FILE *to, const certificate *all, int count);

/* Checks that results depend on each supported feature. */

/* Expected outcomes of a sweep of extremes (reference/extreme_findings.csv), and its counts. */

/* Sets finding and as_expected of every outcome, and the counts. whole: 1 when no selection was
 * made, so that an unobserved deviation is a failure. */
void extreme_expect(extreme_sweep *s, int whole);

/* Classifies the number of an outcome as accurate, under-resolved or wrong. */

/* Classifies from the first mesh alone: accurate, a failure, or wrong until other meshes are
 * known. */
status extreme_judge_first(const extreme_sweep *s, const truths *t, extreme_outcome *o, fault *f);
/* Decides whether the error decreases to the finest mesh with an order of at least 0.5, as a
 * discretisation error does. */
void extreme_judge_neighbours(const extreme_sweep *s, const truths *t, extreme_outcome *o);

/* Records of extremes, of outcomes and of the counts of a formulation. */

extern const record_type record_extremes_all, record_extreme, record_outcome, record_extreme_count;
extern const record_type *const extreme_records[]; /* all except the first; NULL-terminated */
void extreme_gather(const void *found, const record_type *type, subjects *out);

/* Reference values of one point of a sweep. */

typedef struct known_truths {
    truths stored, derived;
    int borrowed; /* 1: the rows of stored belong to the request */
} known_truths;

/* Stored reference values of the point, or if there are none and --compute-references was given,
 * those computed by a program of reference/derive. A program that fails gives none. FAULT: out of
 * memory. */
status known_at(const parameter_ranges *r, const sweep_point *p, known_truths *out, fault *f);
void known_free(known_truths *);

/* A process that computes batches, one after the other, and reports the result of each. */

/* Shared by all processes. */
typedef struct labour_shelf {
    atomic_int next;                /* of the list */
    atomic_int at[SHARD_MOST_JOBS]; /* batch that a process is computing, or -1 */
} labour_shelf;

typedef struct labour {
    const shard_work *w;
    const shard_request *request;
    int count; /* number of batches to do */
    int *list; /* [count] in the order of their start */
    labour_shelf *shelf;
    machine here;
} labour;

/* Message about one batch, small enough to be written to a pipe in one piece. */
typedef struct labour_notice {
    int batch;
    status status;
    double seconds;
    char text[FAULT_TEXT];
} labour_notice;

/* Computes batches until none is left or one fails; to: a pipe. */
_Noreturn void labour_work(const labour *, int self, int to);

/* Time after which no load acts on a structure, so that its energy and momenta are constant. */

/* Distance between two motions on the same mesh. */

/* Largest distance of two positions, relative to the size of the structure, and largest angle
 * between two sections [rad], over all stations, nodes and centre lines. NAN: a station is
 * missing. */
double pace_distance(const cell_result *, const cell_result *other, int analysis);
/* Distance in a quantity of the scene, relative to the other value or near_zero; NAN: a value is
 * missing. */
double pace_distance_of(const scene_quantity *, const quantity_result *,
                        const quantity_result *other);

/* Evaluates energy and momenta of a motion. */

/* Computes energy-balance errors, E/E0 and the classification of a completed run. */
void pace_drift(const pace *, pace_run *);

/* Runs all motions and measures them. */

/* Call after pace_plan. A motion that fails counts as a result. */
status pace_judge(pace *, const sweep_request *, fault *);

/* Observed time orders of an integrator, from runs with halved steps. */

typedef enum pace_order_kind {
    PACE_ORDER_PASS,
    PACE_ORDER_LOW,       /* significantly below the nominal order */
    PACE_ORDER_UNDECIDED, /* fewer than three errors above the floor, or orders that differ */
    PACE_ORDER_KINDS
} pace_order_kind;

/* Runs of one integrator in one group with fixed steps, starting with the largest. */
typedef struct pace_ladder {
    int group;
    const pace_method *method;
    int first, count; /* range in the list of runs */
    double order,
        before;   /* from the last three errors above the floor: last order, previous order */
    double floor; /* smaller errors are due to the reference or to rounding */
    pace_order_kind kind;
} pace_ladder;

/* Allowed difference below the nominal order, as for meshes (harness/study). */
extern const double pace_order_slack;

/* Returns 1 when unresolved frequencies limit the order of the reference. */
int pace_order_is_stopped(const pace_group *);

/* Starts with run `first`. */
pace_ladder pace_order_of(const pace *, int first);
/* Returns 1 when the error of a quantity [relative] does not decrease with the step, as for a force
 * that depends on unresolved frequencies. */
int pace_order_stands(const pace *, const pace_ladder *, int quantity);
/* Sets the order of each run, from the previous run with a larger step. */
void pace_order_fill(pace *);
const char *pace_order_name(pace_order_kind);

/* Plans which motions are run. */

/* Runs of one structure. */
typedef struct pace_plan_request {
    const case_type *type;
    const double *parameter;
    formulation formulation;
    int elements; /* 0: the second mesh of the case */
    int methods;
    const pace_method *method;
    pace_list steps, tolerances; /* count 0: none */
    int errors;                  /* 1: errors are computed, with a reference */
    int whole;                   /* 1: a step without a solution ends the motion; 0: it is halved */
} pace_plan_request;

/* Sets default steps or tolerances if none are given, from the step of the scene. */
status pace_plan_usual(pace_plan_request *, fault *);
/* Appends a group. REFUSED: no motion, or nothing to run. */
status pace_plan_add(pace *, const pace_plan_request *, fault *);

/* Cost at equal error: the integrator, with its step or tolerance, that reaches a given error at
 * the lowest cost. */

enum { PACE_LEVELS = 3 };
extern const double pace_levels[PACE_LEVELS];

typedef struct pace_reach {
    const pace_run *run; /* a run within the error, as are all runs of its integrator with smaller
                            steps or tolerances; NULL: none */
    double cost; /* [s] interpolated at the error level between this run and the previous one */
} pace_reach;

/* Finds the run for one integrator in one group. */
pace_reach pace_reach_of(const pace *, int group, const char *method, double level);
/* Lists the different integrators of all groups, by name; returns their number. */
enum { PACE_METHODS_MOST = 32 };
int pace_reach_methods(const pace *, const char *name[PACE_METHODS_MOST]);

/* Records of motions and their evaluation. */

extern const record_type record_pace_all, record_pace_run;
extern const record_type *const pace_records[]; /* all except the first; NULL-terminated */

/* Motions and their evaluation as text. */

/* runs 1: also a line for each motion, in addition to verdicts. */
void pace_table(FILE *to, const pace *, const pace_verdicts *, int runs);

/* A sweep as CSV: one row for each point, formulation, mesh and quantity. */

/* Data that the group of a sweep stores once. */

/* Writes the request, before any point. */
void ranges_file_request(record_file *, hid_t at, const parameter_ranges *, const char *plan);
/* Writes the worst points, after all points. */
void ranges_file_worst(record_file *, hid_t at, const parameter_ranges *, const tally *);

/* Parameters of a point of a sweep. */

/* Values of all parameters, given the values on the axes. */
void ranges_points_values(const parameter_ranges *, const double at[],
                          double value[CASE_MAX_PARAMETERS]);
/* "NAME=VALUE, NAME=VALUE" for the axes, with as many digits as necessary. */
void ranges_points_text(const parameter_ranges *, const double at[], char *text, int size);

/* Solves and measures the cells of some points of a sweep. */

/* Internals of the table of a sweep. */

enum { RANGES_TABLE_NAME = 24, RANGES_TABLE_COLUMN = 7, RANGES_TABLE_LINE = 1024 };

/* Name of a quantity; "all" for `index` equal to their number. */
static inline const char *ranges_table_name(const parameter_ranges *r, int q)
{
    return q < r->quantities ? r->quantity[q].name : "all quantities";
}

/* ranges_request.c: writes the references of errors, and the points without a scene. */
void ranges_table_known(FILE *to, const tally *t);
/* ranges_request.c: writes the smallest number of elements over one or two axes; every: also for
 * each quantity. */
void ranges_table_map(FILE *to, const tally *t, int every);

/* Reference of the values at one point: a stored reference value, a reference value computed by a
 * program of reference/derive, or the limit of the meshes of all formulations with the same
 * physics.
 *
 * Of the limits, the one with the smallest uncertainty U is used. Its uncertainty is U or, if
 * larger, its difference from another limit beyond the uncertainty of that limit. An uncertainty
 * above half of the tolerance is too large: such a reference value is ignored; such limits count as
 * disputed or, if U itself is too large, as unknown. */

typedef struct point_reference {
    rows_reference kind;
    double value, doubt; /* value and its relative uncertainty */
} point_reference;

/* Reference of a quantity for a series of the sweep; stored, derived: reference values of this
 * point. NULL: none. */
point_reference reference_of(const sweep *s, int series_index, int quantity, const truths *stored,
                             const truths *derived, double tolerance);

/* The part of a scene that a continued motion depends on: all except its stations and
 * quantities. */

/* Elements of a formulation under test: with everything that it supports, with each section and
 * each choice of each option, straight and curved. */

typedef void specimens_check(const specimen *s, claims *c);
/* Calls check for every test element. An element that the formulation rejects with a reason is
 * skipped, except the default element, which must be accepted (check "prepare"). */
void specimens_each(const formulation *chosen, claims *c, specimens_check *check);

/* Preview of a sweep before the solution, at some of its points: quantities, meshes, formulations
 * that run, and the cost of a point. */

/* Sets formulations, meshes, quantities, left_out and point_cost from the scenes of the first, the
 * last and some intermediate points. REFUSED: no scene can be built at any of them, no formulation
 * runs, or the selection has an unknown word or selects nothing. */
status survey(parameter_ranges *r, fault *f);

/* The worst points of a sweep kept as scene files. */

/* FAULT: out of memory. ranges_work_free frees it. */
status ranges_work_make(const parameter_ranges *r, ranges_work *out, fault *f);
void ranges_work_free(ranges_work *);
/* The caller sets the identity of the sweep. */
shard_work ranges_work_of(ranges_work *);

/* File of a sweep. */

/* Opens the file; the path must outlive it. plan: digits that identify the sweep. */
status ranges_file_open(const char *path, const parameter_ranges *r, const char *plan,
                        ranges_file *out, fault *f);
/* Finishes the file: worst points with the names of their scenes, and content: digits of all values
 * that do not depend on how they were computed. written: status so far; if not OK, the file is
 * removed. */
status ranges_file_close(ranges_file *, const tally *, const char *content, status written,
                         fault *f);
/* Writes the scenes of the worst points to a new folder as "point_12.yaml", each point once, and
 * stores the names in the tally. A scene that a file cannot express is omitted. FAULT: disk or
 * memory; no file remains. */
status worst_write(const char *folder, tally *t, fault *f);
/* Writes within PARAGRAPH_WIDTH: the references of errors; the percentage of points within the
 * tolerance for each mesh, quantity and formulation; for one or two axes the smallest number of
 * elements over them, for all quantities together (every: also for each); the worst points with
 * their values and a command that shows one. folder: with their scenes; "": none were stored. */
void ranges_table(FILE *to, const tally *t, int every, const char *folder, fault *f);

#endif
