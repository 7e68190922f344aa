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

/* Compares the times [s] of `pairs` pairs of laps. */
against_times against_evaluate(int pairs, const double a[], const double b[]);

enum { AXIS_MOST_VALUES = 1000001 };

/* Reads a varied parameter. Formats: "NAME=A..B/N" (N equal parts, ends included),
 * "NAME=A..B/N:log" (logarithmic intervals), "NAME=A..B" or "NAME=A..B:log" (a design supplies the
 * points), or "NAME=A,B,C" (numbers, or words of a choice). The parameter must allow all these
 * values. REFUSED: the message names the invalid part and the remedy. */
status axis_read(const case_type *type, const char *text, sweep_axis *out, fault *f);
void axis_free(sweep_axis *);
/* Returns value number i, counted from 0. */
double axis_value(const sweep_axis *, int i);
/* Returns the value at a fraction of the axis, 0 <= share < 1. For a list, returns the entry at
 * this fraction of the length of the list. */
double axis_at(const sweep_axis *, double share);
/* Returns "linear", "log", "list" or "words". */
const char *axis_kind_name(axis_kind);
void axis_text(const sweep_axis *, double value, char *text, int size);

machine node_here(void);

/* Batch files. A file contains a line of JSON with the label, the bytes of the results, and a line
 * with a checksum. The complete file appears under its name, or no file does. */

/* Writes the common start of the names of all batches of one work: "verify-0123456789ab". */
void batch_stem(const shard_work *w, char out[BATCH_STEM]);
/* Writes the name of a batch: "verify-0123456789ab-000017.batch". Batch numbers in names start
 * at 1. */
void batch_name(const char *stem, int batch, char out[BATCH_NAME]);
/* Returns the index of the batch with this name, or -1 if the stem or the format of the name
 * differs. */
int batch_of_name(const char *name, const char *stem);
int batch_is_name(const char *name);

/* Writes folder/NAME under a temporary name, then renames the file. FAULT: a disk error, or out of
 * memory. */
status batch_write(const char *folder, const batch_label *label, const void *bytes, size_t size,
                   fault *f);
/* Removes temporary files of a batch that were left by killed processes. ended 1: the writer has
 * certainly ended. */
void batch_clean(const char *folder, const char *name, int ended);
/* Reads the label. *from (may be NULL) is then at the first byte of the results, and *end is the
 * position after the last byte of the results. FAULT: the file is truncated, damaged, or not a
 * batch. */
status batch_open(const char *path, batch_label *out, FILE **from, long *end, fault *f);
/* Checks that the batch belongs to the work. REFUSED: it does not; the message gives the difference
 * and the path. */
status batch_belongs(const batch_label *, const shard_work *, const char *path, fault *f);

element_measure *measures_add(measures *m, const char *name);
void measures_point(element_measure *one, double at, double error);
int measures_wrong_limits(const measures *m);

/* Returns the check with the given name, and adds it if necessary. allowed: largest allowed
 * deviation. */
check_result *checks_open(check_results *c, const char *name, double allowed);
void checks_not_made(check_results *c, const char *name, const char *why);
/* Adds a comparison with its deviation; NaN counts as the largest deviation. */
void checks_deviation(check_result *one, double departure, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Adds a yes/no question and its answer. holds 0: the answer is no; `format` then describes the
 * error. */
void checks_require(check_result *one, int holds, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void checks_current(check_results *c, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Returns the difference relative to `size`; 0 if the difference is 0, even if `size` is 0. */
static inline double checks_relative(double apart, double size)
{
    return apart == 0 ? 0 : apart / size;
}
/* Return the number of checks with this outcome, and the number of comparisons in all checks. */
int checks_counted(const check_results *c, check_outcome outcome);
int checks_compared(const check_results *c);

status profiles_section(profiles_form form, double unit, section *out, fault *f);

/* Returns all features that the type supports, except curvature, coupled stiffness and
 * `without`. */
unsigned test_element_features(const element_type *t, unsigned without);

/* Computes pseudo-random numbers in [-1/2, 1/2) that are determined by the seed. */
void test_element_numbers(int count, unsigned seed, double out[]);
/* Rotates the whole element about the origin by the rotation vector `turn`, then shifts it by a
 * fixed multiple of its length. */
void test_element_rigid_motion(const test_element *s, const double turn[3], const node_state x[],
                               node_state out[]);

typedef struct test_element_stencil {
    const test_element *s;
    const node_state *x;
} test_element_stencil;

/* Computes the node states after changes of coordinate i by si difference steps and of coordinate j
 * by sj difference steps. */
void test_element_moved(const test_element_stencil *at, int i, double si, int j, double sj,
                        node_state out[]);

/* Computes the inner unknowns [inner] of the undeformed state. */
void test_element_rest(const test_element *s, double inner[]);
/* Computes the stress with converged inner unknowns. */
status test_element_converged(const test_element *s, const double e[], double inner[],
                              stress_output *out);

/* Checks that the damping matrix is symmetric and dissipates energy. */
void own_damping_check(const test_element *s, const double C[], check_results *c);
/* Checks the function `line`: the motion of the sections, and the equilibrium between nodal forces
 * and loads along the element. */
void own_line_check(const test_element *s, check_results *c);

/* Returns a description such as "rotation about y of node 2". */
const char *test_element_coordinate(const test_element *s, int c, char words[TEST_ELEMENT_WORDS]);

checks_run checks_declared;
checks_run checks_features;
checks_run checks_derivatives; /* J and H are the derivatives of the strains */
checks_run checks_energy; /* stress, stiffness and geometric stiffness derive from the energy */
checks_run checks_force;  /* force and stiffness derive from the energy (types defined by forces) */
/* results are independent of rigid motions, of the order of the nodes, and of the unit of length */
checks_run checks_motion;
checks_run checks_stateless; /* equal calls give equal results, independent of earlier calls */
checks_run checks_many;      /* one call for many elements gives the same results as single calls */
checks_run checks_bounds;
checks_run checks_nonfinite; /* NaN and Inf in the input are reported */
checks_run checks_mass; /* the mass matrix is symmetric and positive definite, and gives the mass of
                           the beam */
checks_run checks_rotating; /* effects of a rotating frame */
checks_run checks_along;    /* loads along one element */
checks_run checks_in_time;  /* inertia forces during motions */
checks_run checks_history;  /* the history after a commit gives the same strains */

measured_run measured_states;  /* errors of a cantilever with respect to the exact solution */
measured_run measured_locking; /* errors over thickness/length */
measured_run measured_orders;  /* errors over the number of elements */
measured_run measured_paths;   /* superposed rotations, and closed cycles */

const char *certificate_part_name(int part);
const char *certificate_part_words(int part);
/* Return the number of checks with this outcome, and the number of comparisons in all parts. */
int certificate_counted(const certificate *, check_outcome);
int certificate_compared(const certificate *);
/* Writes the parts with failed checks, for example "3 in 'states', 4 in 'orders'". */
enum { CERTIFICATE_PARTS_TEXT = 400 };
void certificate_violated_parts(const certificate *, char *text, int size);
/* Returns the first failed check; NULL: none. */
const check_result *certificate_broken(const certificate *);

/* Assigns each batch to a shard: shard[batches] contains numbers from 0 to shards - 1. In
 * decreasing order of cost, each batch goes to the shard with the lowest cost so far. Returns 0, or
 * -1 if out of memory. */
int batches_assign(int batches, const double cost[], int shards, int shard[]);
/* Sorts the batches in decreasing order of cost into order[batches]. Batches with equal costs keep
 * their order. */
void batches_order(int batches, const double cost[], int order[]);

enum { DESIGN_STRIDE = 16384, DESIGN_MARKS = 1024, DESIGN_MOST_POINTS = 1000000000 };

/* Makes a design. points: ignored for grids. In a grid, the last axis varies fastest. As in GSL,
 * the Sobol and Halton sequences start with the point after the origin. REFUSED: the message gives
 * the reason. */
status design_make(design_kind kind, int axes, const sweep_axis list[], long points,
                   unsigned long seed, design *out, fault *f);
void design_free(design *);
/* Computes the values of the axes at `count` points, starting with point `first`: out[count x
 * axes]. FAULT: out of memory. */
status design_points(const design *, long first, long count, double out[], fault *f);
const char *design_name(design_kind);

int outcome_is_good(outcome_kind kind); /* returns 1 if the outcome is accurate or under-resolved */

/* Returns the outcome with which `o` is compared: that of the same formulation and quantity at the
 * base value of x. NULL: none. */
extreme_outcome *extreme_sweep_base(const extreme_sweep *s, const extreme_outcome *o);

/* Plans the points: for every extreme, one point for each value of x. A point has a series for
 * every formulation, and a series has an outcome for each quantity. */
status extreme_plan(const extreme_request *request, extreme_sweep *out, fault *f);

void extreme_table(FILE *to, const void *found); /* found: an extreme_sweep */

typedef struct integrators_list {
    int count;
    double value[INTEGRATORS_LIST_MOST];
} integrators_list;

status integrators_list_read(const char *option, const char *text, double ratio,
                             integrators_list *out, fault *f);

#define INTEGRATORS_METHODS                                                                        \
    "alpha, alpha:rho=R, hht, hht:alpha=A, trapezoidal, conserving, radau, explicit"

extern const char integrators_method_all[];
/* Reads one of INTEGRATORS_METHODS, with a parameter R in [0, 1] or A in [0, 1/3]. REFUSED: the
 * message names the invalid part. */
status integrators_method_read(const char *text, int length, integrators_method *out, fault *f);
/* Appends the methods of a list "NAME,NAME,..." to list[most]. REFUSED: integrators_method_read
 * rejects a name, a method occurs twice, or there are more than `most`. */
status integrators_method_read_list(const char *text, int most, integrators_method list[],
                                    int *count, fault *f);

/* Tolerances of the reference and of its checks, which radau computes on the same mesh. */
enum { INTEGRATORS_CHECKS = 2 };
extern const double integrators_reference[1 + INTEGRATORS_CHECKS];
/* Limit of E/E0 - 1, limit of the relative change of energy, and limit of the relative change of
 * momenta. */
extern const double integrators_growth, integrators_energy, integrators_momentum;

void integrators_free(integrators *);
const char *integrators_class_name(integrators_class);
const sweep_point *integrators_point_of(const integrators *, const integrators_run *);
const cell_result *integrators_cell_of(const integrators *, int index);

/* Reads the table and plans its motions. REFUSED: the table is invalid; the message gives the first
 * error with its line. */
status integrators_verdict_plan(const char *path, integrators *, integrators_verdicts *, fault *);
/* Determines the observed verdicts and compares them with the table. Call after
 * integrators_evaluate. */
void integrators_verdict_reach(const integrators *, integrators_verdicts *);
void integrators_verdict_free(integrators_verdicts *);

enum {
    ROWS_NOT_OFFERED = STATUS_NO_VALUE + 1,
    ROWS_NO_SCENE,
    ROWS_NOT_COMPUTED, /* the batch of the cell is missing */
    ROWS_STATUSES
};

/* Allocates the columns and sets them to zero. FAULT: out of memory. */
status rows_alloc(const rows_shape *shape, int points, rows *out, fault *f);
void rows_free(rows *);
/* Writes the columns as bytes in the format of this machine. Returns 0, or -1 after a failure. */
int rows_write(FILE *to, const rows *);
int rows_read(FILE *from, rows *);
/* Return the index of an entry in the columns. */
size_t rows_quantity(const rows *, int point, int quantity);
size_t rows_cell(const rows *, int point, int formulation, int mesh);
size_t rows_value(const rows *, int point, int formulation, int mesh, int quantity);
size_t rows_lacks(const rows *, int point, int formulation);
size_t rows_least(const rows *, int point, int formulation, int quantity);
/* Return the word for a kind of reference or for the status of a cell. */
const char *rows_reference_name(int kind);
const char *rows_status_name(int status);

enum { SHARD_MOST_JOBS = 64, SHARD_MOST = 100000 };

status batch_store_path(const batch_store *, int batch, char out[PATH_MAX], fault *f);

/* Adds the results of the points from number `first` on. */
status tally_add(tally *, long first, const rows *, fault *f);
/* Returns the counts of a quantity. quantity: its index, or the number of quantities for the counts
 * of all quantities together. */
const tally_series *tally_of(const tally *, int formulation, int quantity);
const tally_place *tally_at(const tally *, int formulation, int quantity, int line, int column);
/* Returns the lower bound of a column (axis_index 0) or a line (1) of the map, as a value of its
 * axis. */
double tally_edge(const tally *, int axis_index, int place);

/* Adds the results of the points from number `first` on. */
status ranges_file_add(ranges_file *, long first, const rows *, fault *f);

/* Runs one round: runs the cell at least once, and again until `floor` [s] of processor time are
 * used. */
void rounds_run(const cell_request *request, double floor, rounds_reading *out);
/* Runs one round of the published algorithm for the cell with the result `cell`. */
void dense_reference_round(const cell_request *own, const cell_result *cell, double floor,
                           dense_reference *out);

typedef enum beam_analysis { BEAM_LINEAR, BEAM_LARGE, BEAM_BUCKLING, BEAM_VIBRATION } beam_analysis;

/* The beam has a length of 1 m. A straight beam lies along x. A curved beam is a quarter circle
 * that starts in the direction y and has its centre at the origin. */
typedef struct beam_request {
    const formulation *chosen;
    int elements; /* number of elements of equal length */
    /* [elements] lengths of the elements as fractions of the length of the beam; NULL: equal
     * lengths */
    const double *fraction;
    /* dimensions of a rectangular section [m]: thickness along y (towards the centre) and width
     * along z */
    double thickness, width;
    int profile;
    int quarter;    /* 1: the beam is curved to a quarter circle */
    unsigned needs; /* FEATURE_* bits */
    beam_analysis analysis;
    scene_load_kind load; /* force or moment at the end of the beam */
    double vector[3];     /* [N, N m] */
    /* component of the end that is evaluated; ignored for a frequency or a critical load factor */
    int component;
} beam_request;

status beam_section(const beam_request *, section *out);
/* Solves the beam and adds the error with respect to `exact` to the measure. The error is NAN if
 * there is no value; `words` then gives the reason at the first such point. Returns 0 if further
 * points are useless, because the formulation does not support the beam or none of the first three
 * points has a value. */
int beam_point(const beam_request *, double at, double exact, element_measure *one);

/* Returns CHECK_FAILED if one of the checks has found a violated requirement, CHECK_PASSED if a
 * requirement other than "prepare" is satisfied, and CHECK_NOT_MADE in all other cases. */
check_outcome checks_outcome(const check_results *);

/* Text output of certificates. */

#define CERTIFICATE_EXACT 1e-9

/* verbose: every check with its numbers. quiet: only the failed checks. */
void certificate_text(FILE *to, screen look, const certificate *all, int count, int verbose,
                      int quiet);
void certificate_paper(FILE *to, int latex, const certificate *all, int count);
void certificate_csv(FILE *to, const certificate *all, int count);

/* Sets `deviation` and `as_expected` of every outcome, and the counts. whole 1: no selection was
 * made; a known deviation that is not observed is then a failure. */
void extreme_expect(extreme_sweep *s, int whole);

/* Classifies an outcome on the first mesh: accurate, a failure, or wrong. */
status extreme_evaluate_first(const extreme_sweep *s, const truths *t, extreme_outcome *o,
                              fault *f);
void extreme_evaluate_neighbours(const extreme_sweep *s, const truths *t, extreme_outcome *o);

extern const record_type record_extremes_all, record_extreme, record_outcome, record_extreme_count;
extern const record_type *const extreme_records[];
void extreme_gather(const void *found, const record_type *type, subjects *out);

typedef struct known_truths {
    truths stored, derived;
    int borrowed;
} known_truths;

/* Finds the stored reference values of the point. If some are missing and the request has a program
 * for this, also computes reference values. FAULT: out of memory. */
status known_at(const parameter_ranges *r, const sweep_point *p, known_truths *out, fault *f);
void known_free(known_truths *);

typedef struct batch_queue {
    atomic_int next;                /* next entry of `list` to be computed */
    atomic_int at[SHARD_MOST_JOBS]; /* batch that a process is computing, or -1 */
} batch_queue;

typedef struct batch_worker {
    const shard_work *w;
    const shard_request *request;
    int count; /* number of batches to be computed */
    int *list; /* [count] batches in the order in which they are started */
    batch_queue *queue;
    machine here;
} batch_worker;

/* Message about a batch. */
typedef struct batch_report {
    int batch;
    status status;
    double seconds;
    char text[FAULT_TEXT];
} batch_report;

/* Computes batches until none is left or a batch fails. to: pipe for the messages. */
_Noreturn void batch_worker_run(const batch_worker *, int self, int to);

/* Returns the largest distance between two motions over all stations, nodes and centre lines. NAN:
 * a motion failed, or a station is missing. */
double integrators_distance(const cell_result *, const cell_result *other, int analysis);
/* Returns the difference between two values of a quantity, relative to the value of `other` or to
 * near_zero. NAN: a value is missing. */
double integrators_distance_of(const scene_quantity *, const quantity_result *,
                               const quantity_result *other);

/* Computes the energy-balance error, the largest change of momentum, E/E0 and the classification of
 * a run. E: energy; E0: energy after the loads have ended. NAN: there is no such value, for example
 * because loads act until the end. */
void integrators_drift(const integrators *, integrators_run *);

status integrators_evaluate(integrators *, const sweep_request *, fault *);

/* Observed orders of an integrator, from runs with decreasing steps. */

typedef enum integrators_order_kind {
    INTEGRATORS_ORDER_PASS,
    INTEGRATORS_ORDER_LOW, /* both orders are below the nominal order by more than
                              integrators_order_slack */
    /* fewer than three errors are above the floor, or only one of two orders is low */
    INTEGRATORS_ORDER_UNDECIDED,
    INTEGRATORS_ORDER_KINDS
} integrators_order_kind;

/* Runs of an integrator in a group, with fixed steps in decreasing order. */
typedef struct integrators_ladder {
    int group;
    const integrators_method *method;
    int first, count; /* range in the list of runs */
    /* orders from the last three errors above the floor: the order of the last pair, and of the
     * pair before */
    double order, before;
    double floor; /* errors below this value are due to the reference or to rounding */
    integrators_order_kind kind;
} integrators_ladder;

/* Allowed difference between the observed order and the nominal order, as for meshes
 * (harness/study). */
extern const double integrators_order_slack;

/* Returns 1 if the observed order of the reference is below the order of radau minus 1, as it is if
 * frequencies are unresolved. */
int integrators_order_is_stopped(const integrators_group *);

/* Returns the runs of the integrator whose first run has number `first`. */
integrators_ladder integrators_order_of(const integrators *, int first);
/* Returns 1 if the relative error of a quantity remains above 1e-3 and the floor, and is not halved
 * although the smallest step is a quarter of the largest. */
int integrators_order_stagnates(const integrators *, const integrators_ladder *, int quantity);
/* Sets the order of each run that has a previous run with a larger step, from the errors of these
 * two runs. */
void integrators_order_fill(integrators *);
const char *integrators_order_name(integrators_order_kind);

typedef struct integrators_plan_request {
    const case_type *type;
    const double *parameter;
    formulation formulation;
    /* number per member; 0: that of the second mesh of the case, or 4 if the case has fewer
     * meshes */
    int elements;
    int methods;
    const integrators_method *method;
    integrators_list steps, tolerances;
    int errors; /* 1: errors are computed, which requires a reference */
    int whole;  /* 1: a step without a solution ends the motion; 0: such a step is halved */
} integrators_plan_request;

/* Sets a missing number of elements. If neither steps nor tolerances are given, sets steps from the
 * step size of the scene, and default tolerances. REFUSED: the scene has no motion. */
status integrators_plan_default(integrators_plan_request *, fault *);
/* Appends a group of runs. REFUSED: the scene has no motion, or there is nothing to run. */
status integrators_plan_add(integrators *, const integrators_plan_request *, fault *);

/* Cost at equal error: the step size or tolerance for which an integrator achieves a given error at
 * the lowest cost. */

enum { INTEGRATORS_LEVELS = 3 };
extern const double integrators_levels[INTEGRATORS_LEVELS];

typedef struct integrators_reach {
    /* a run within the error, if all runs with smaller steps or tolerances are also within the
     * error; NULL: none */
    const integrators_run *run;
    /* [s] cost at the error level, interpolated between this run and the previous run */
    double cost;
} integrators_reach;

integrators_reach integrators_reach_of(const integrators *, int group, const char *method,
                                       double level);
enum { INTEGRATORS_METHODS_MOST = 32 };
int integrators_reach_methods(const integrators *, const char *name[INTEGRATORS_METHODS_MOST]);

extern const record_type record_integrators_all, record_integrators_run;
extern const record_type *const integrators_records[];

/* Prints the verdicts on motions. runs 1: also prints a line for each motion. */
void integrators_table(FILE *to, const integrators *, const integrators_verdicts *, int runs);

/* Writes the request. */
void ranges_file_request(record_file *, hid_t at, const parameter_ranges *, const char *plan);
/* Writes the worst points. */
void ranges_file_worst(record_file *, hid_t at, const parameter_ranges *, const tally *);

void ranges_points_values(const parameter_ranges *, const double at[],
                          double value[CASE_MAX_PARAMETERS]);
/* Writes "NAME=VALUE, NAME=VALUE" for the axes. The numbers have as many digits as are necessary to
 * reproduce the values. */
void ranges_points_text(const parameter_ranges *, const double at[], char *text, int size);

enum { RANGES_TABLE_NAME = 24, RANGES_TABLE_COLUMN = 7, RANGES_TABLE_LINE = 1024 };

static inline const char *ranges_table_name(const parameter_ranges *r, int q)
{
    return q < r->quantities ? r->quantity[q].name : "all quantities";
}

void ranges_table_known(FILE *to, const tally *t);
/* Writes the smallest number of elements as a map over one or two axes (ranges_request.c). every 1:
 * writes another map for each quantity. */
void ranges_table_map(FILE *to, const tally *t, int every);

/* Reference of a quantity at a point: the first that is known to within half the tolerance of a
 * stored reference value, a reference value computed by a program of reference/derive, and a limit
 * of the meshes of a formulation with the same physics. Of these limits, the one with the smallest
 * uncertainty is used. */

typedef struct point_reference {
    rows_reference kind;
    double value, uncertainty; /* value and its relative uncertainty */
} point_reference;

/* Returns the reference of a quantity for a series of the sweep. stored, derived: reference values
 * of this point; NULL: none. */
point_reference reference_of(const sweep *s, int series_index, int quantity, const truths *stored,
                             const truths *derived, double tolerance);

typedef void test_elements_check(const test_element *s, check_results *c);
void test_elements_each(const formulation *chosen, check_results *c, test_elements_check *check);

/* Sets `formulations`, `meshes`, `quantities`, `left_out`, `omitted`, `assumed` and `point_cost`
 * from the scenes of the first point, the last point and some points between. REFUSED: the message
 * gives the reason. */
status survey(parameter_ranges *r, fault *f);

/* Allocates the data for the batches of a sweep. FAULT: out of memory. ranges_work_free frees the
 * result. */
status ranges_work_make(const parameter_ranges *r, ranges_work *out, fault *f);
void ranges_work_free(ranges_work *);
/* Returns the shard work of the sweep. The caller sets its identity. */
shard_work ranges_work_of(ranges_work *);

/* File of a sweep. */

/* Opens the file; the path must outlive it. plan: digits that identify the sweep. Returns the
 * failures of record_open_beside, and FAULT after a write error. */
status ranges_file_open(const char *path, const parameter_ranges *r, const char *plan,
                        ranges_file *out, fault *f);
/* Finishes the file: writes the worst points with the names of their scenes, and `content`, the
 * digits of all values except times. written: status so far; if it is not OK, the file is
 * removed. */
status ranges_file_close(ranges_file *, const tally *, const char *content, status written,
                         fault *f);
/* Writes the scenes of the worst points to a new folder as "point_12.yaml", each point once, and
 * stores their names in the tally. REFUSED: the path exists and is not an empty folder. FAULT: a
 * disk error, or out of memory; no file remains. */
status worst_write(const char *folder, tally *t, fault *f);
/* Writes the table within PARAGRAPH_WIDTH. */
void ranges_table(FILE *to, const tally *t, int every, const char *folder, fault *f);

#endif
