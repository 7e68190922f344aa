/* Internal declarations of study/. */
#ifndef BEAMWORK_STUDY_IMPL_H
#define BEAMWORK_STUDY_IMPL_H

#include <hdf5.h>

#include "cases/case.h"
#include "elements/element.h"
#include "elements/shared/status.h"
#include "harness/newton/newton.h"
#include "harness/study/study.h"

enum { LIMIT_MESHES = 32 };

/* Relative change of a value above which the model counts as another model. */
extern const double omission_most;
/* Safety factor. The bound is this factor times the difference between two coarse solutions, with
 * the physics and without it. Both solutions use a formulation that includes the physics. */
extern const double omission_safety;

/* Returns the largest relative change of a requested value on one mesh if the physics is omitted;
 * NAN: a value is missing, or no formulation supports all physics of the scene. */
double omission_on_mesh(const scene *, unsigned what, int elements);

/* Returns 1 if the condition is true. A term is a feature that the scene requires ("shear", "not
 * shear"), or compares a parameter of the case ("omega>0", "load=tip|mid", "tip_deflection!=0.015";
 * the operators <, <= and >= are also supported). If the case does not have the parameter, the term
 * is false. */
int rules_hold(const rule *, const rule_subject *);

/* Returns the features in the condition of the rule; 0: none. */
unsigned rules_features(const rule *);
/* Records that a verdict confirmed a derived limit that the rule names. */
void rules_confirm_limit(rule *, const rule_subject *);
/* Finds the first term of the condition that is neither a feature nor a parameter of the rule's
 * cases, and copies it to `word`. Returns 0 if there is no such term. cases: NULL-terminated. */
enum { RULES_WORD = 128 };
int rules_bad_condition(const rule *, const case_type *const cases[], char word[RULES_WORD]);
/* Copies the next word of a list. Returns the rest of the list; NULL: there are no more words. */
const char *rules_next_word(const char *list, char word[RULES_WORD]);
/* Returns 1 if a verdict has shown this deviation and verdicts have confirmed all derived limits of
 * the rule. */
int rules_is_observed(const rule *);

/* Reads the rules. FAULT: a column is damaged, or the condition of a rule is invalid; the message
 * names it. */
status rules_read(const char *path, hid_t file, rule **out, int *count, fault *f);
void rules_free(rule *, int count);

/* Allocates memory for `more` rows, so that no row moves when they are added. FAULT: out of memory.
 * */
status truths_reserve(truths *, int more, fault *f);

/* Returns 1 if the selection of the sweep includes the quantity. */
int sweep_selects(const sweep *s, const sweep_point *p, const formulation *chosen,
                  const char *quantity);

/* Verdicts on a limit that differs from the reference value. */
enum { VERDICT_DEFECTS = 4 };
extern const verdict_kind verdict_defects[VERDICT_DEFECTS];
/* Returns 1 if the rule explains one of these verdicts. */
int verdict_explains_defect(const rule *);
/* Returns the kind of analysis that determines the order of a quantity. */
element_analysis verdict_analysis(const scene *, const scene_quantity *);

/* Change of values between two meshes, with a scale for values that are zero apart from rounding.
 * Such values occur by symmetry, in hinges, or normal to a plane frame. */

typedef struct value_change {
    double largest; /* largest change; INFINITY: unknown, or only one mesh has a value */
    int which;      /* quantity with the largest change; -1: none */
    int missing;    /* 1: some values are missing on both meshes, but a finer mesh may have them */
    /* [quantities of the scene] change relative to the value, or to its scale if the scale is
     * larger; for a curve: relative to its largest value; NAN: unknown */
    double *of_each;
} value_change;

/* Computes the change from `before` to `now`. The caller has allocated out->of_each. Quantities
 * that measure the error of a solution (the energy-balance error) are skipped. */
void change_between(const scene *s, const cell_result *before, const cell_result *now,
                    value_change *out);

/* Prevents several processes from solving the same problem. The first process solves the problem,
 * and the others use its results. */

/* Allocates `count` locks, which all processes that are started later share; NULL: out of memory.
 * */
task_locks *task_locks_alloc(int count);
void task_locks_free(task_locks *);
/* Locks a problem for a task. Returns the task that locked the problem first, which is `task` if
 * no other task did. */
int task_locks_acquire(task_locks *, const identity *, int task);

/* Reads a column into out[rows] with the HDF5 memory type `type`. */
status columns_numbers(const table_columns *r, const char *column, hid_t type, void *out);
/* Reads fixed-length strings into out[rows], each allocated with malloc. */
status columns_strings(const table_columns *r, const char *column, char **out);

/* Tasks of a run: the cells, and tasks that arise during the run. Tasks of the second kind are
 * repetitions of finest meshes that measure scatter, and cells that waited for the results of
 * another cell that then failed. */

typedef struct workload_task {
    int series, mesh;
    int again; /* 0: the cell; k > 0: repetition number k - 1, which solves an equivalent scene */
} workload_task;

/* Data that all processes share: the tasks, and the task of each worker. */
typedef struct board {
    atomic_int next; /* next one of the tasks that were known at the start */
    /* number of added tasks, and number of added tasks that have been taken */
    atomic_int later, taken;
    atomic_int ended; /* 1: no more tasks will be added */
    sem_t changed;    /* wakes a waiting process if there are new tasks, and at the end */
    atomic_int at[WORKERS_MOST]; /* task of each worker; -1: none */
    /* [s] time of a monotonic clock at which the task was taken */
    _Atomic double since[WORKERS_MOST];
    /* added tasks; ~task: to be solved even if another cell has the same results */
    atomic_int added[];
} board;

/* Remaining work of a series: cells, scatter, or none. */
enum series_state { SERIES_CELLS, SERIES_NOISE, SERIES_WHOLE };

typedef struct workload {
    sweep *s;
    const sweep_follower *follower; /* NULL: none */
    int time_limit;                 /* [s] time limit of a cell; 0: none */
    int together;                   /* as in the request */
    /* number of cells, and number of all tasks, which includes two more for each series; cells are
     * in the order of their cost */
    int count, all;
    workload_task *tasks;
    char *done;         /* [all] 1: the task has a result */
    int due, finished;  /* numbers of required and of finished tasks */
    int *open;          /* [series] number of unfinished tasks */
    char *state;        /* [series] enum series_state */
    int passed;         /* number of series that have been passed to the observer */
    cell_result *again; /* [all - count] results of repetitions */
    task_locks *known;  /* problems that are solved only once; NULL: all cells are solved */
    /* [all] first task that waits for the results of this task; next task that waits for the same
     * results */
    int *waits, *after;
    int out_of_memory;
    size_t size; /* size of the board [bytes] */
    board *board;
} workload;

/* Allocates the tasks of a sweep. FAULT: out of memory. Call workload_end even after a failure. */
status workload_begin(const sweep_request *, sweep *, workload *, fault *);
void workload_end(workload *);

/* Waits for the next task of worker `self` and returns it; -1: no tasks remain. The child calls
 * this function. *alone 1: the task must be solved even if another cell has the same results. */
int workload_take(const workload *, int self, int *alone);
/* Returns the edit of the point. For a repetition, returns the edit that gives the equivalent
 * scene. */
scene_edit workload_edit(const workload *, int task);

/* Returns the address for the result of a task. */
cell_result *workload_cell(const workload *, int task);
/* Records that a task is finished, with a result or a failure. */
void workload_done(workload *, int task);
/* Records that a task has the same results as another task. */
void workload_same(workload *, int task, int same);
/* Returns the completed fraction of the known work, from 0 to 1, weighted by the cost of the cells.
 * */
double workload_share(const workload *);

/* Returns 1 if the next series, in order, is complete and can be passed to the observer. */
int workload_can_pass(const workload *);
/* Passes the next series to the observer. */
status workload_pass(workload *, fault *);
/* Removes incomplete series. */
void workload_keep_whole(workload *);

/* Estimated cost of cells: cost coefficients for the steps of their analyses, fitted to counted
 * work (`make lab L=run-cost`, harness/study/run_cost.csv). The estimates determine the order of
 * work, batches and shards. They do not affect results. */

/* Cost items. Each cost is multiplied by the number of occurrences of the item. */
typedef enum run_cost_kind {
    RUN_COST_cell, /* once per cell */
    RUN_COST_linear,
    RUN_COST_buckling,
    /* buckling about a loaded state, including the path to the critical point */
    RUN_COST_loaded_buckling,
    RUN_COST_modal,
    RUN_COST_load_step,
    RUN_COST_compliance, /* at each station */
    RUN_COST_continuation,
    RUN_COST_rotation_step,
    RUN_COST_rotation_station,
    RUN_COST_alpha_step, /* transient analysis, by integrator */
    RUN_COST_conserving_step,
    RUN_COST_radau_step,
    RUN_COST_explicit_step,
    RUN_COST_KINDS
} run_cost_kind;

/* [s] cost on the reference machine: a fixed part and a part per element; or factors of both parts
 * */
typedef struct run_cost_pair {
    double once, element;
} run_cost_pair;

typedef struct run_cost_factor {
    /* name of the formulation without options; NULL: all formulations that have no row */
    const char *formulation;
    run_cost_pair factor;
} run_cost_factor;

/* Generated tables. The last factors apply to formulations without a row. */
extern const run_cost_pair run_cost_work[RUN_COST_KINDS];
extern const run_cost_factor run_cost_factors[];

/* Counts the items of a cell of the scene. steps: number of load steps between stations; 0: as in
 * the scene. */
void run_cost_count(const scene *s, int steps, double times[RUN_COST_KINDS]);
/* Orders all cells of a sweep: tasks[sweep_cells]. Cells of expensive series come first, in
 * decreasing order of cost, so that only small cells remain at the end. The other cells follow in
 * the order of the series, so that series are completed one after the other. The finest mesh of a
 * series comes first. A series is expensive if it needs more than a hundredth of the work of one
 * process. Returns 0, or -1 if out of memory. */
int run_cost_order(const sweep *s, int jobs, workload_task tasks[]);

/* Cross-formulation agreement, for structures without a reference value: the limit on which
 * formulations of different families agree. Types of one family share code or theory, so their
 * agreement proves little. All families may be wrong together, so an agreement is for information
 * and never affects the exit status. A formulation is excluded if it has a known deviation for a
 * feature of the scene (a rule with this feature in its condition), or if it is marked `misprint`.
 *
 * Each formulation has a limit L with uncertainty U. Two limits agree if they belong to the same
 * shear theory in stability (where this matters) and if |L1 - L2| + U1 + U2 is within
 * FAMILIES_APART of their size. The centre is the limit with which most families agree; at least
 * two families must agree. The reference is the mean of the limits whose distance from the centre
 * is within their U, weighted by 1/U^2. Its uncertainty is the larger of the uncertainty of the
 * mean and the weighted spread. Other formulations that differ by more than their U are named. If
 * no two families agree so closely, the reference is the limit of the formulation that is nearest
 * to a limit of another family; its uncertainty is their distance plus U. If equally many families
 * agree on another limit, there is no reference. */

/* Largest relative distance of limits that agree: half of one per cent, the aim of `converge`. */
#define FAMILIES_APART 5e-3
enum { FAMILIES_MOST = 8 };

typedef struct families_limit {
    int families; /* number of agreeing families; if it is below two, there is no reference */
    int disputed; /* 1: equally many families agree on another limit */
    double value, uncertainty; /* [unit of the quantity] */
    /* [families] series with the limit of each family that is nearest to the centre */
    int series[FAMILIES_MOST];
    /* number of other limits in the neighbourhood that differ by more than their uncertainty */
    int others;
    int other[FAMILIES_MOST];
    /* shear theory in stability, a bit of enum element_feature; 0: the theory does not matter */
    unsigned theory;
} families_limit;

/* Returns the agreement for one point and quantity. Tests use this function to check disputes and
 * the number of families. */
families_limit families_limit_of(const sweep *s, int point_index, int quantity, const truths *);

/* Scatter of the values on the finest mesh. The cell is solved again for an equivalent scene, which
 * differs only by rounding. */

/* Equivalent scenes for the finest mesh of a series. One has a unit of length that is not a power
 * of two, the other has the nodes of members in reverse order. If a formulation depends on the
 * order of nodes, two units of length are used instead. Stations that only curves need are omitted.
 * */
enum { NOISE_REPETITIONS = 2 };

/* If values still change on the finest mesh of the scene, the number of elements is doubled
 * repeatedly, up to this number of elements or up to this counted work [s] for one mesh. */
#define DEFAULT_CHOICE_FINEST 1024
#define DEFAULT_CHOICE_COST   2.0

/* Returns the cost [s] on the reference machine, from all rows that apply to the formulation. */
double counted_cost_of(const cost_coefficient *rows, const formulation *chosen,
                       const cell_result *cell);

/* Cause in a proposed rule, which the user must replace. */
#define PROPOSAL_CAUSE "to be found: why is this not a pass?"

/* Returns 1 if the verdict means that the formulation is wrong, or that its correctness is unknown.
 * */
int reach_is_defect(verdict_kind kind);

/* The reference value with which a quantity is compared. */

/* Returns 1 if a verdict may depend on the row. Returns 0 for an agreement of formulations, and for
 * a value that cannot be reproduced. */
int truth_gates(const truth *row);
/* Like truth_of, but excludes reference values for other shear theories. theories: words separated
 * by '|'; NULL: any theory. */
const truth *truth_of_theory(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *model, const char *theories);
/* Returns the cross-formulation agreement (kind agreement); NULL: none. It is for information and
 * never affects the exit status. */
const truth *truth_agreed(const truths *t, const case_type *type, const double value[],
                          const char *quantity);
/* Returns the derived limit of a formulation; NULL: none. The formulation is given by its key, or
 * by its name for any options. */
const truth *truth_predicted(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *key);

/* Processes that run the cells of a sweep. No worker outlives the process that started it. Each
 * worker enforces the time limit of its cell. */

typedef struct worker {
    pid_t process;
    /* end of the pipe from which the output of the worker is read; -1: the worker is not running */
    int from;
    int stopped; /* 1: stopped by the parent after the time limit */
    int damaged; /* 1: the worker has written invalid output */
    char *bytes; /* incomplete part of the output */
    size_t count, room;
} worker;

status worker_start(const workload *, int self, worker *, fault *);
/* Values that worker_receive returns instead of a task. WORKER_NO_MEMORY: this process has no
 * memory for the results, and the worker continues. */
enum { WORKER_ENDED = -1, WORKER_NOTHING = -2, WORKER_NO_MEMORY = -3 };
/* Reads available results, or references to equal results, without waiting. Returns the task of the
 * last result; WORKER_NOTHING: no result is complete yet. A worker that writes other data is ended.
 */
int worker_receive(workload *, worker *);
/* Handles a worker that has ended. If the worker ended during a task, records that the cell of the
 * task has failed. Returns 1 if the worker must be replaced. */
int worker_handle_end(workload *, int self, worker *);
/* Ends a worker whose cell exceeds the time limit, in case the worker cannot end itself. The pipe
 * of the worker closes. */
void worker_stop_late(const workload *, int self, worker *);
/* Ends a worker in any state. Results that it has written are still read. */
void worker_end(workload *, worker *);

/* Registers the formulations whose verdicts affect the exit status (reference/accepted.csv), from
 * an open file of packed reference values. FAULT: the table is missing or damaged. */
status accepted_read(const char *path, hid_t file, fault *f);

/* Compares one series with the stored values of its meshes. */
status agreements_add(const sweep *s, const truths *t, int index, evaluation *out, fault *f);

/* Coverage: the share of limits that agree with exact reference values within their
 * uncertainties. */

/* Adds the verdicts from number `first` on to the coverages of an evaluation. */
status coverage_count(const sweep *s, int first, evaluation *out, fault *f);

/* Mode shapes at one value of a parameter, matched with the shapes at another value. */

typedef struct follow_shapes {
    int modes, rows;
    double *frequency; /* [modes] [rad/s] */
    double *match;     /* [modes] match with the previous sample */
    double *shape;     /* [modes x rows] normalised to unit mass */
} follow_shapes;

/* Matches the modes of `before` with the modes of a state. *least: worst match; 0 if two modes
 * would be matched with the same mode. */
status follow_match_next(const follow_shapes *before, const state_matrices *, follow_shapes *out,
                         double *least, fault *);
void follow_match_free(follow_shapes *);

/* Internal declarations shared by the files of `follow`. */

/* smallest match of two shapes that count as the same mode */
static const double follow_sure = 0.9;

typedef struct follow_state {
    const follow_request *of;
    follow_curves *out;
    int analysis, room;
    follow_shapes *shapes; /* [samples] */
} follow_state;

/* Computes the modes at a value, matched with the modes of `before` (NULL: first value), and the
 * worst match. See follow_match.c. */
status follow_solve(follow_state *, double value, const follow_shapes *before, follow_shapes *out,
                    double *least, fault *);

/* Adds the crossings in the last step. *least: worst match. If modes veer within the step, they
 * appear to cross. At the apparent crossing, however, their shapes do not match those of the
 * previous sample. *least then falls below follow_sure, and the step must be halved. */
status follow_events_step(follow_state *, double *least, fault *);
/* Adds crossings at samples, and veerings, in the order of their parameter values. */
status follow_events_rest(follow_state *, fault *);

/* Names in user tables. */

/* Finds a case by name among the cases of the run (NULL-terminated) and the built-in cases; NULL:
 * none. */
const case_type *user_names_case(const case_type *const run[], const char *name);
/* Returns the quantity of the scene with this name; NULL: none. */
const scene_quantity *user_names_quantity(const scene *s, const char *name);
/* Write "; did you mean 'NEAR'?" for cases, formulations, or quantities of a scene. If no name is
 * near, they write another remedy. */
const char *user_names_near_case(const case_type *const run[], const char *name,
                                 char text[FAULT_TEXT]);
const char *user_names_near_formulation(const char *name, char text[FAULT_TEXT]);
const char *user_names_near_quantity(const scene *s, const char *name, char text[FAULT_TEXT]);

/* Checks the consistency of the records of a run, without reference values. Inconsistent records
 * are an error of the program. */

/* Returns 1 if the counters, steps and corrections of a cell agree with each other and with the
 * properties of every solution. Otherwise returns 0, and `why` describes the contradiction. newton:
 * form of Newton's method. A cell without a solution is not checked. */
int record_is_consistent(const cell_result *cell, const scene *s, newton_form newton,
                         char why[FAULT_TEXT]);

/* Index of rows by case and quantity, because each verdict needs thousands of look-ups. */

/* Indexes all existing rows. truths_read calls this function. Rows that are added later are found
 * by a slower search until the function is called again. FAULT: out of memory; indexed rows are
 * still found. */
status truth_index_make(truths *t, fault *f);
void truth_index_free(truths *t);

/* Returns the first row for the quantity of the case, in the order of the rows; t->rows: none. */
int truth_index_first(const truths *t, const case_type *type, const char *quantity);
/* Returns the next row after i for the same quantity. */
int truth_index_next(const truths *t, int i);

/* Reads the rows of a table of reference values and checks each of them. */

/* Returns the name of the first column of a row whose value is invalid; NULL: all values are valid.
 * */
const char *truth_rows_wrong(const truth *row);
/* Fills row[table->rows], which must be zero. FAULT: a column is invalid, or the defaults of the
 * case of a row have changed. truths_free releases the rows that were read, even after a failure.
 * */
status truth_rows_read(const table_columns *table, const case_type *type, truth row[]);

#endif
