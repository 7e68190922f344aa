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

/* Relative change of a value above which the model counts as another one. */
extern const double omission_most;
/* Safety factor. The bound is this factor times the difference between two coarse solutions, one
 * with and one without the physics, by a formulation that includes it. */
extern const double omission_safety;

/* Returns the largest relative change of a requested value on one mesh when the physics is
 * omitted. NAN: a value is missing, or no formulation supports all physics of the scene. */
double omission_on_mesh(const scene *, unsigned what, int elements);

/* Returns 1 if the condition is true. A term is a feature that the scene requires ("shear", "not
 * shear"), or compares a parameter of the case ("omega>0", "load=tip|mid", "tip_deflection!=0.015";
 * the operators <, <= and >= are also supported). A term with a parameter that the case does not
 * have is false. */
int rules_hold(const rule *, const rule_subject *);

/* Returns the features in the condition of the rule; 0: none. */
unsigned rules_features(const rule *);
/* Records that a verdict confirmed a derived limit that the rule names. */
void rules_foretell(rule *, const rule_subject *);
/* Finds the first term of the condition that is neither a feature nor a parameter of the rule's
 * cases, and copies it to `word`. cases: the cases, NULL-terminated. Returns 0 if there is no such
 * term. */
enum { RULES_WORD = 128 };
int rules_bad_condition(const rule *, const case_type *const cases[], char word[RULES_WORD]);
/* Copies the next word of a list. Returns the rest of the list; NULL: there is no further word. */
const char *rules_next_word(const char *list, char word[RULES_WORD]);
/* Returns 1 if a verdict has shown this deviation and verdicts have confirmed all its derived
 * limits. */
int rules_is_observed(const rule *);

/* FAULT: a column is damaged, or the condition of a rule is invalid; the message names it. */
status rules_read(const char *path, hid_t file, rule **out, int *count, fault *f);
void rules_free(rule *, int count);

/* Allocates memory, so rows do not move while `more` rows are added. FAULT: out of memory. */
status truths_reserve(truths *, int more, fault *f);

/* Returns 1 if the selection of the sweep includes the quantity. */
int sweep_selects(const sweep *s, const sweep_point *p, const formulation *chosen,
                  const char *quantity);

/* Verdicts for a limit that differs from the reference value. */
enum { VERDICT_DEFECTS = 4 };
extern const verdict_kind verdict_defects[VERDICT_DEFECTS];
/* Returns 1 if the rule explains one of these verdicts. */
int verdict_tells_defect(const rule *);
/* Returns the kind of analysis that determines the order of a quantity. */
element_analysis verdict_analysis(const scene *, const scene_quantity *);

/* Difference between the values of two meshes, with a scale for values that are zero except for
 * round-off: by symmetry, in hinges, or normal to a plane frame. */

typedef struct value_change {
    double largest;  /* INFINITY: unknown, or only one mesh has a value */
    int which;       /* quantity with the largest change; -1: none */
    int missing;     /* 1: some values are missing on both meshes; a finer mesh may have them */
    double *of_each; /* [quantities of the scene] change relative to the value, or to its scale
                        if that is larger; for a curve relative to its largest value; NAN:
                        unknown */
} value_change;

/* Computes the change from `before` to `now`; the caller has allocated out->of_each. Quantities
 * that measure the error of a solution (the energy-balance error) are skipped. */
void change_between(const scene *s, const cell_result *before, const cell_result *now,
                    value_change *out);

/* Prevents several processes from solving the same problem: the first process solves it, and the
 * others use its results. */

/* Allocates `count` claims, shared with all processes that are started later; NULL: out of memory.
 */
claims *claims_alloc(int count);
void claims_free(claims *);
/* Claims a problem for a task. Returns the first task that claimed the problem, which is `task`
 * itself if no other task did before. */
int claims_take(claims *, const identity *, int task);

/* Reads a column into out[rows] with the HDF5 memory type `type`. */
status columns_numbers(const table_columns *r, const char *column, hid_t type, void *out);
/* Reads fixed-length strings into out[rows], each allocated with malloc. */
status columns_strings(const table_columns *r, const char *column, char **out);

/* Tasks of a run: the cells, and tasks that arise during the run. The latter are repetitions of
 * finest meshes to measure scatter, and cells that waited for the results of another cell that
 * then failed. */

typedef struct workload_task {
    int series, mesh;
    int again; /* 0: the cell; k > 0: repetition number k - 1, which solves an equivalent scene */
} workload_task;

/* Data shared by all processes: the tasks to be taken, and the task of each worker. */
typedef struct board {
    atomic_int next;         /* next of the tasks known from the start */
    atomic_int later, taken; /* number of added tasks, and how many of them have been taken */
    atomic_int ended;        /* 1: no further tasks will be added */
    sem_t news;              /* wakes a waiting process when there are new tasks, and at the end */
    atomic_int at[WORKERS_MOST]; /* task of each worker; -1: none */
    /* [s] of a monotonic clock: when the task was taken */
    _Atomic double since[WORKERS_MOST];
    atomic_int came_up[]; /* added tasks; ~task: to be solved even if another cell has the same
                             results */
} board;

/* Remaining work of a series: cells, scatter, or none. */
enum series_state { SERIES_CELLS, SERIES_NOISE, SERIES_WHOLE };

typedef struct workload {
    sweep *s;
    const sweep_follower *follower; /* NULL: none */
    int time_limit;                 /* [s] of one cell; 0: none */
    int together;                   /* as in the request */
    int count, all; /* number of cells; number of all tasks, with two more for each series. Cells
                       are in the order of their cost */
    workload_task *tasks;
    char *done;         /* [all] 1: the task has a result */
    int due, finished;  /* number of tasks to be done; number of finished tasks */
    int *open;          /* [series] number of unfinished tasks */
    char *state;        /* [series] enum series_state */
    int told;           /* number of series passed to the observer */
    cell_result *again; /* [all - count] results of repetitions */
    claims *known;      /* problems that are solved only once; NULL: every cell is solved */
    int *waits, *after; /* [all] first task that waits for the results of this one; next task that
                           waits for the same results */
    int out_of_memory;
    size_t size; /* size of the board [bytes] */
    board *board;
} workload;

/* FAULT: out of memory. Call workload_end in either case. */
status workload_begin(const sweep_request *, sweep *, workload *, fault *);
void workload_end(workload *);

/* Call in the child. Waits for the next task of worker `self` and returns it; -1: no tasks
 * remain. *alone 1: the task must be solved even if another cell has the same results. */
int workload_take(const workload *, int self, int *alone);
/* Returns the edit of the point or, for a repetition, the edit that gives the equivalent scene. */
scene_edit workload_edit(const workload *, int task);

/* Returns the address for the result of a task. */
cell_result *workload_cell(const workload *, int task);
/* Records that a task is finished, with a result or a failure. */
void workload_done(workload *, int task);
/* Records that a task has the same results as another one. */
void workload_same(workload *, int task, int same);
/* Returns the completed fraction of the known work, weighted by the cost of the cells: 0 to 1. */
double workload_share(const workload *);

/* Returns 1 if the next series, in order, is complete and can be passed to the observer. */
int workload_can_tell(const workload *);
/* Passes the next series to the observer. */
status workload_tell(workload *, fault *);
/* Removes incomplete series. */
void workload_keep_whole(workload *);

/* Estimated cost of cells: cost coefficients for the steps of their analyses, fitted to counted
 * work (`make lab L=expense`, harness/study/expense.csv). The estimates determine the order of
 * work, batches and shards; they do not affect results. */

/* Cost items; each is multiplied by how often it occurs. */
typedef enum expense_kind {
    EXPENSE_cell, /* once per cell */
    EXPENSE_linear,
    EXPENSE_buckling,
    EXPENSE_loaded_buckling, /* about a loaded state, including the path to the critical point */
    EXPENSE_modal,
    EXPENSE_load_step,
    EXPENSE_compliance, /* at each station */
    EXPENSE_continuation,
    EXPENSE_rotation_step,
    EXPENSE_rotation_station,
    EXPENSE_alpha_step, /* transient analysis, by integrator */
    EXPENSE_conserving_step,
    EXPENSE_radau_step,
    EXPENSE_explicit_step,
    EXPENSE_KINDS
} expense_kind;

/* [s] on the reference machine: a fixed part and a part per element; or factors of these two */
typedef struct expense_price {
    double once, element;
} expense_price;

typedef struct expense_factor {
    const char *formulation; /* name without options; NULL: all formulations that have no row */
    expense_price factor;
} expense_factor;

/* Generated tables; the last factors are for formulations without a row. */
extern const expense_price expense_work[EXPENSE_KINDS];
extern const expense_factor expense_factors[];

/* Counts the items of a cell of the scene; steps: load steps between stations, 0: as in the scene.
 */
void expense_count(const scene *s, int steps, double times[EXPENSE_KINDS]);
/* Orders all cells of a sweep, tasks[sweep_cells]. Cells of expensive series come first, in
 * decreasing order of cost, so only small ones remain at the end. The others follow in the order of
 * the series, so series are completed one after the other. Within a series the finest mesh comes
 * first. A series is expensive if it needs more than a hundredth of the work of one process.
 * Returns 0, or -1 if out of memory. */
int expense_order(const sweep *s, int jobs, workload_task tasks[]);

/* Cross-formulation agreement, for structures without a reference value: the limit on which
 * formulations of different families agree. Types of one family share code or theory, so their
 * agreement proves little. All families may be wrong together; therefore an agreement is
 * informative and never affects the exit status. A formulation is excluded if it has a known
 * deviation for a feature of the scene (a rule with that feature in its condition), or is marked
 * `misprint`.
 *
 * Each formulation has a limit L with uncertainty U. Two limits agree if they belong to the same
 * shear theory in stability, where that matters, and if |L1 - L2| + U1 + U2 is within
 * FAMILIES_APART of their size. The centre is the limit with which most families agree; at least
 * two must agree. The reference is the mean, weighted by 1/U^2, of the limits whose distance
 * from the centre is within their U. Its uncertainty is that of the mean or the weighted spread,
 * whichever is larger. Other formulations that differ by more than their U are named. If no two
 * families agree so closely, the reference is the limit of the formulation that is nearest to a
 * limit of another family; its uncertainty is their distance plus U. If equally many families
 * agree on another limit, there is no reference. */

/* Largest relative distance of limits that agree: half of the one per cent that `converge` aims
 * at. */
#define FAMILIES_APART 5e-3
enum { FAMILIES_MOST = 8 };

typedef struct families_limit {
    int families;              /* number of agreeing families; below two: no reference */
    int disputed;              /* 1: equally many families agree on another limit */
    double value, uncertainty; /* [unit of the quantity] */
    int series[FAMILIES_MOST]; /* [families] series with the nearest limit of each family */
    int others; /* number of other limits nearby that differ by more than their uncertainty */
    int other[FAMILIES_MOST];
    unsigned theory; /* shear theory in stability, a bit of enum element_feature; 0: it does not
                        matter */
} families_limit;

/* Returns the agreement for one point and quantity. Also used by tests, which check disputes and
 * the number of families. */
families_limit families_limit_of(const sweep *s, int point_index, int quantity, const truths *);

/* Scatter of the values on the finest mesh. The same cell is solved again for an equivalent
 * scene, which differs only in rounding. */

/* Equivalent scenes for the finest mesh of a series: one with a unit of length that is not a
 * power of two, and one with the nodes of members in reverse order. If a formulation depends on
 * the order of nodes, two units of length are used instead. Stations that only curves need are
 * omitted. */
enum { NOISE_REPETITIONS = 2 };

/* Beyond the meshes of the scene the number of elements is doubled while values still change, up
 * to this number of elements or up to this counted work [s] for one mesh. */
#define PREFERENCE_FINEST 1024
#define PREFERENCE_COST   2.0

/* Returns the cost [s] on the reference machine, from all rows that apply to the formulation. */
double price_of(const price_row *rows, const formulation *chosen, const cell_result *cell);

/* Placeholder until the cause is found. */
#define PROPOSAL_CAUSE "to be found: why is this not a pass?"

/* Returns 1 if the verdict means that the formulation is wrong, or is not known to be right. */
int reach_is_defect(verdict_kind kind);

/* The reference value with which a quantity is compared. */

/* Returns 1 if a verdict may depend on the row; 0 for an agreement of formulations, and for a value
 * that cannot be reproduced. */
int truth_gates(const truth *row);
/* As truth_of, but only reference values for one of the shear theories (words separated by |) or
 * independent of them; NULL: any. */
const truth *truth_of_theory(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *model, const char *theories);
/* Returns the cross-formulation agreement (kind agreement), or NULL. It is informative and never
 * affects the exit status. */
const truth *truth_agreed(const truths *t, const case_type *type, const double value[],
                          const char *quantity);
/* Returns the derived limit of a formulation, which is given by its key, or by its name for any
 * options; NULL: none. */
const truth *truth_predicted(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *key);

/* Processes that run the cells of a sweep. No worker outlives the process that started it, and each
 * one enforces the time limit of a cell itself. */

typedef struct worker {
    pid_t process;
    int from;    /* read end of the pipe from the worker; -1: the worker is not running */
    int stopped; /* 1: stopped by the parent after the time limit */
    int damaged; /* 1: the worker has written invalid output */
    char *bytes; /* incomplete part of its output */
    size_t count, room;
} worker;

status worker_start(const workload *, int self, worker *, fault *);
/* Values that worker_receive returns instead of a task. WORKER_NO_MEMORY: this process has no
 * memory for the results; the worker continues. */
enum { WORKER_ENDED = -1, WORKER_NOTHING = -2, WORKER_NO_MEMORY = -3 };
/* Reads available results, or references to equal results, without waiting. Returns the last of
 * their tasks; WORKER_NOTHING: nothing is complete yet. A worker that writes anything else is
 * ended. */
int worker_receive(workload *, worker *);
/* Handles a worker that ended during a task: its cell failed. Returns 1 if the worker must be
 * replaced. */
int worker_bury(workload *, int self, worker *);
/* Ends a worker whose cell exceeds the time limit, in case it cannot end itself; its pipe
 * closes. */
void worker_stop_late(const workload *, int self, worker *);
/* Ends a worker in any state; results that it has written are still read. */
void worker_end(workload *, worker *);

/* Formulations whose verdicts affect the exit status (reference/accepted.csv), from the packed
 * file. */

/* Registers the accepted formulations of an open file of reference values (formulations_accept).
 * FAULT: the table is missing or damaged. */
status accepted_read(const char *path, hid_t file, fault *f);

/* Compares values of single meshes with stored discrete ones. */

/* Compares one series with the stored values of its meshes. */
status agreements_add(const sweep *s, const truths *t, int index, judgement *out, fault *f);

/* Coverage of limits: the check of their uncertainties. */

/* Adds the verdicts from number `first` on to the coverages of a judgement. */
status coverage_count(const sweep *s, int first, judgement *out, fault *f);

/* Mode shapes at one value of a parameter, matched with those at another value. */

typedef struct follow_shapes {
    int modes, rows;
    double *frequency; /* [modes] [rad/s] */
    double *match;     /* [modes] match with the previous sample */
    double *shape;     /* [modes x rows] normalised to unit mass */
} follow_shapes;

/* Matches the modes of `before` with those of a state. *least: the worst match; 0 if two modes
 * would be matched with the same mode. */
status follow_match_next(const follow_shapes *before, const state_matrices *, follow_shapes *out,
                         double *least, fault *);
void follow_match_free(follow_shapes *);

/* Internal declarations shared by the files of `follow`. */

static const double follow_sure = 0.9; /* Smallest match of two shapes that count as the same
                                          mode. */

typedef struct follow_walk {
    const follow_request *of;
    follow_curves *out;
    int analysis, room;
    follow_shapes *shapes; /* [samples] */
} follow_walk;

/* follow_match.c: computes the modes at a value, matched with those of `before` (NULL: first
 * value), and the worst match. */
status follow_solve(follow_walk *, double value, const follow_shapes *before, follow_shapes *out,
                    double *least, fault *);

/* follow_match.c: finds crossings in the last step. *least: the worst match found. If shapes are
 * exchanged within one step (veering), they do not match where the frequencies would meet. */
status follow_events_step(follow_walk *, double *least, fault *);
/* Adds crossings at samples, and veerings, all in the order of their parameter values. */
status follow_events_rest(follow_walk *, fault *);

/* Rules and reference values that a complete run should have shown or used but did not. */

/* Names in user tables. */

/* Finds a case by name among those of the run (NULL-terminated) and the built-in ones; NULL: none.
 */
const case_type *own_names_case(const case_type *const run[], const char *name);
/* Returns the scene's quantity of that name, or NULL. */
const scene_quantity *own_names_quantity(const scene *s, const char *name);
/* Write "; did you mean 'NEAR'?" for cases, formulations, or quantities of a scene; or a
 * different remedy if no name is near. */
const char *own_names_near_case(const case_type *const run[], const char *name,
                                char text[FAULT_TEXT]);
const char *own_names_near_formulation(const char *name, char text[FAULT_TEXT]);
const char *own_names_near_quantity(const scene *s, const char *name, char text[FAULT_TEXT]);

/* Richardson extrapolation: fits f + c n^-p to the values of three meshes with numbers of
 * elements n. */

/* Checks the consistency of the run record of a cell, without any reference value. An inconsistent
 * record is an error of the program. */

/* Returns 1 if counters, steps and corrections of a cell agree with each other and with the
 * properties of every solution. Otherwise returns 0, and `why` describes the contradiction. newton:
 * form of Newton's method. A cell without a solution is not checked. */
int sound_cell(const cell_result *cell, const scene *s, newton_form newton, char why[FAULT_TEXT]);

/* Index of rows by case and quantity, because each verdict requires thousands of look-ups. */

/* Indexes all existing rows; truths_read calls this function. Rows that are added later are
 * found by a slower search until it is called again. FAULT: out of memory; rows that are indexed
 * are still found. */
status truth_index_make(truths *t, fault *f);
void truth_index_free(truths *t);

/* Returns the first row for the quantity of the case, in the order of the rows; t->rows: none. */
int truth_index_first(const truths *t, const case_type *type, const char *quantity);
/* Returns the next row after i for the same quantity. */
int truth_index_next(const truths *t, int i);

/* Reads the rows of a table of reference values and checks each of them. */

/* Returns the name of the first column of a row whose value is invalid, or NULL. */
const char *truth_rows_wrong(const truth *row);
/* Fills row[table->rows], which is initially zero. FAULT: a column is invalid, or the defaults of
 * the case of a row have changed. truths_free releases the rows read, even after a failure. */
status truth_rows_read(const table_columns *table, const case_type *type, truth row[]);

#endif
