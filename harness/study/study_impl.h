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
/* Safety factor: the bound is this factor times the difference between two coarse solutions, with
 * and without the physics. Both solutions use a formulation that includes the physics. */
extern const double omission_safety;

/* Returns the largest relative change of a requested value on one mesh if the physics `what` are
 * omitted. NAN: a value is missing, or no formulation supports all physics of the scene. */
double omission_on_mesh(const scene *, unsigned what, int elements);

/* Results of a scene with all physics on several meshes, which all omissions of the scene share. */
enum { WHOLE_RESULTS = 6 };
typedef struct whole_results {
    int count, elements[WHOLE_RESULTS];
    cell_result cell[WHOLE_RESULTS];
} whole_results;

/* Like omission_of; solves with all physics only on meshes that are not in `known`. */
void omission_beside(const scene *, const element_type *, whole_results *known, omission *out);
void whole_results_free(whole_results *);

/* Returns 1 if the lists of the rule match the subject and the condition is true. A term of the
 * condition is a feature that the scene requires ("shear", "not shear"), or compares a parameter of
 * the case ("omega>0", "load=tip|mid", "tip_deflection!=0.015"; also <, <= and >=); it is false if
 * the case does not have the parameter. */
int rules_hold(const rule *, const rule_subject *);

/* Returns the features that the condition of the rule contains without "not"; 0: none. */
unsigned rules_features(const rule *);
/* Records that a verdict confirmed a derived limit that is listed in the rule. */
void rules_confirm_limit(rule *, const rule_subject *);
/* Finds the first term of the condition that is neither a feature nor a valid comparison with a
 * parameter of the cases of the rule, and copies it to `word`. Returns 0 if there is none. cases:
 * NULL-terminated. */
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

/* Allocates memory for `more` rows, so that no row moves when they are added. FAULT: out of
 * memory. */
status truths_reserve(truths *, int more, fault *f);

int sweep_selects(const sweep *s, const sweep_point *p, const formulation *chosen,
                  const char *quantity);

enum { VERDICT_DEFECTS = 4 };
extern const verdict_kind verdict_defects[VERDICT_DEFECTS];
/* Returns 1 if the rule explains one of these verdicts. */
int verdict_explains_defect(const rule *);
/* Returns the kind of analysis that determines the order of a quantity. */
element_analysis verdict_analysis(const scene *, const scene_quantity *);

/* Change of values between two meshes. Values that are zero apart from rounding, by symmetry, in
 * hinges, or normal to a plane frame, are compared with a scale. */

typedef struct value_change {
    double
        largest; /* largest change; INFINITY: unknown, or a quantity has a value on only one mesh */
    int which;   /* quantity with the largest change; -1: none */
    int missing; /* 1: values are missing on both meshes, but a finer mesh may have them */
    /* [quantities of the scene] change relative to the value or, if larger, to its scale; for a
     * curve, relative to its largest value; NAN: unknown */
    double *of_each;
} value_change;

/* Computes the change from `before` to `now`. The caller has allocated out->of_each. Energy-balance
 * errors are skipped, because they measure the error of a solution. */
void change_between(const scene *s, const cell_result *before, const cell_result *now,
                    value_change *out);

/* Allocates `count` locks that this process shares with all processes that it starts later; NULL:
 * out of memory. */
task_locks *task_locks_alloc(int count);
void task_locks_free(task_locks *);
/* Locks a problem for a task, unless it is locked. Returns the task that holds the lock. */
int task_locks_acquire(task_locks *, const identity *, int task);

typedef struct workload_task {
    int series, mesh;
    int again; /* 0: the cell; k > 0: repetition number k - 1, which solves an equivalent scene */
} workload_task;

typedef struct board {
    atomic_int next; /* next of the tasks that were known at the start */
    /* number of added tasks, and number of those that have been taken */
    atomic_int later, taken;
    atomic_int ended;            /* 1: no more tasks will be added */
    sem_t changed;               /* posted if there are new tasks, and at the end */
    atomic_int at[WORKERS_MOST]; /* task of each worker; -1: none */
    /* [s] time of a monotonic clock at which the task was taken */
    _Atomic double since[WORKERS_MOST];
    atomic_int added[];
} board;

enum series_state { SERIES_CELLS, SERIES_NOISE, SERIES_WHOLE };

typedef struct workload {
    sweep *s;
    const sweep_follower *follower; /* NULL: none */
    int time_limit;                 /* [s] time limit of a cell; 0: none */
    int together;                   /* copied from the sweep_request */
    /* count: number of cells, which come first, in the order of run_cost_order; all: number of all
     * tasks, which are the cells and two repetitions for each series */
    int count, all;
    workload_task *tasks;
    char *done;         /* [all] 1: the task has a result */
    int due, finished;  /* numbers of required and of finished tasks */
    int *open;          /* [series] number of unfinished tasks */
    char *state;        /* [series] enum series_state */
    int passed;         /* number of series that have been passed to the follower */
    cell_result *again; /* [all - count] results of repetitions */
    task_locks *known; /* locks of problems that are solved only once; NULL: all cells are solved */
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

/* For the child: waits for the next task of worker `self` and returns it; -1: no tasks remain.
 * *alone 1: the task must be solved even if another cell has the same results. */
int workload_take(const workload *, int self, int *alone);
/* Returns the edit of the point or, for a repetition, the edit that gives the equivalent scene. */
scene_edit workload_edit(const workload *, int task);

cell_result *workload_cell(const workload *, int task);
void workload_done(workload *, int task);
void workload_same(workload *, int task, int same);
double workload_share(const workload *);

/* Returns 1 if the next series is complete, so that it can be passed to the follower. */
int workload_can_pass(const workload *);
status workload_pass(workload *, fault *);
/* Removes incomplete series. */
void workload_keep_whole(workload *);

/* Estimated cost of cells. Coefficients for the steps of the analyses are fitted to counted work
 * (`make lab L=run-cost`, harness/study/run_cost.csv). */

/* Counts the items of cost of a cell of the scene. steps: number of load steps between stations; 0:
 * as in the scene. */
void run_cost_count(const scene *s, int steps, double times[RUN_COST_KINDS]);
/* Orders all cells of a sweep: tasks[sweep_cells]. Expensive series come first, by decreasing cost,
 * and in each series the finest mesh. Returns 0, or -1 if out of memory. */
int run_cost_order(const sweep *s, int jobs, workload_task tasks[]);

/* Cross-formulation agreement, for structures without a reference value: the limit on which
 * formulations of different families agree.
 *
 * Each formulation has a limit L with uncertainty U. Two limits agree if |L1 - L2| + U1 + U2 is
 * within FAMILIES_APART of their size and, for stability, if they belong to the same shear theory
 * (where this matters). The centre is the limit that agrees with limits of the largest number of
 * families, at least two. The reference is the mean, weighted by 1/U^2, of limits that agree with
 * the centre. */

/* Largest relative distance between limits that agree: half of one per cent. */
#define FAMILIES_APART 5e-3
enum { FAMILIES_MOST = 8 };

typedef struct families_limit {
    int families;              /* number of agreeing families; below two, there is no reference */
    int disputed;              /* 1: equally many families agree on another limit */
    double value, uncertainty; /* [unit of the quantity] */
    /* [families] series with the limit that represents the family in the agreement */
    int series[FAMILIES_MOST];
    /* number of limits that agree with the centre, but were excluded from the mean */
    int others;
    int other[FAMILIES_MOST];
    /* shear theory in stability, a bit of enum element_feature; 0: the theory does not matter */
    unsigned theory;
} families_limit;

/* Returns the agreement for one point and quantity. */
families_limit families_limit_of(const sweep *s, int point_index, int quantity, const truths *);

/* Scatter of the values on the finest mesh: the cell is solved again for two equivalent scenes,
 * which differ only by rounding. */
enum { NOISE_REPETITIONS = 2 };

/* If values still change on the finest mesh of the scene, the number of elements is doubled
 * repeatedly, up to this number of elements or this counted work [s] for one mesh. */
#define DEFAULT_CHOICE_FINEST 1024
#define DEFAULT_CHOICE_COST   2.0

/* Returns the cost [s] on the reference machine from the rows that apply to the formulation. */
double counted_cost_of(const cost_coefficient *rows, const formulation *chosen,
                       const cell_result *cell);

/* Cause in a proposed rule, which the user must replace. */
#define PROPOSAL_CAUSE "to be found: why is this not a pass?"

/* Returns 1 if the verdict means that the formulation is wrong, or that it is not known whether it
 * is correct. */
int reach_is_defect(verdict_kind kind);

/* Returns 1 if verdicts may depend on the row. Returns 0 for an agreement of formulations, and for
 * a value that cannot be reproduced. */
int truth_gates(const truth *row);
/* Like truth_of, but only for the given shear theories. theories: words separated by '|'; NULL: any
 * theory. */
const truth *truth_of_theory(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *model, const char *theories);
/* Returns the cross-formulation agreement (kind agreement); NULL: none. It is for information and
 * never affects the exit status. */
const truth *truth_agreed(const truths *t, const case_type *type, const double value[],
                          const char *quantity);
/* Returns the derived limit of a formulation; NULL: none. The formulation is given by its key or,
 * for any options, by its name. */
const truth *truth_predicted(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *key);

typedef struct worker {
    pid_t process;
    /* end of the pipe from which the output of the worker is read; -1: the worker is not running */
    int from;
    int stopped; /* 1: stopped by the parent after the time limit */
    int damaged; /* 1: the worker has written invalid output */
    char *bytes;
    size_t count, room;
} worker;

status worker_start(const workload *, int self, worker *, fault *);
/* Values that worker_receive returns instead of a task. WORKER_NO_MEMORY: this process has no
 * memory for the results; the worker continues. */
enum { WORKER_ENDED = -1, WORKER_NOTHING = -2, WORKER_NO_MEMORY = -3 };
/* Reads available results, or references to equal results, without waiting. Returns the task of the
 * last result; WORKER_NOTHING: no result is complete yet. */
int worker_receive(workload *, worker *);
/* Handles a worker that has ended. If this happened during a task, records that its cell has
 * failed. Returns 1 if the worker must be replaced. */
int worker_handle_end(workload *, int self, worker *);
/* Kills a worker whose cell exceeds the time limit, because the worker may be unable to end
 * itself. */
void worker_stop_late(const workload *, int self, worker *);
/* Ends a worker in any state. Results that it has written are still read. */
void worker_end(workload *, worker *);

/* From an open file of packed reference values, registers the formulations whose verdicts affect
 * the exit status (reference/accepted.csv). FAULT: the table is missing or damaged. */
status accepted_read(const char *path, hid_t file, fault *f);

status agreements_add(const sweep *s, const truths *t, int index, evaluation *out, fault *f);

/* Adds the verdicts from number `first` on, if they have an exact reference value, to the coverages
 * of an evaluation. */
status coverage_count(const sweep *s, int first, evaluation *out, fault *f);

/* Mode shapes at one value of a parameter, matched with those at another value. */

typedef struct follow_shapes {
    int modes, rows;
    double *frequency; /* [modes] [rad/s] */
    double *match;     /* [modes] match with the previous sample */
    double *shape;     /* [modes x rows] mode shapes, normalised to unit modal mass */
} follow_shapes;

/* Matches the modes of `before` with the modes of a state. *least: worst match; 0 if two modes
 * match the same mode. REFUSED: the numbers of coordinates differ. */
status follow_match_next(const follow_shapes *before, const state_matrices *, follow_shapes *out,
                         double *least, fault *);
void follow_match_free(follow_shapes *);

/* smallest match of two shapes that are considered the same mode */
static const double follow_sure = 0.9;

typedef struct follow_state {
    const follow_request *of;
    follow_curves *out;
    int analysis, room;
    follow_shapes *shapes; /* [samples] */
} follow_state;

/* Computes the modes at a value, matched with the modes of `before` (NULL: first value). *least:
 * worst match. */
status follow_solve(follow_state *, double value, const follow_shapes *before, follow_shapes *out,
                    double *least, fault *);

/* Adds the crossings in the last step. *least: worst match; below follow_sure, the caller must
 * halve the step. */
status follow_events_step(follow_state *, double *least, fault *);
/* Adds crossings at samples, and veerings, in the order of the parameter values. */
status follow_events_rest(follow_state *, fault *);

/* Among the cases of the run (NULL-terminated) and the built-in cases, finds a case by name; NULL:
 * none. */
const case_type *user_names_case(const case_type *const run[], const char *name);
const scene_quantity *user_names_quantity(const scene *s, const char *name);
/* Write "; did you mean 'NEAR'?" with a case, formulation or quantity of a scene; if no name is
 * near, another remedy. */
const char *user_names_near_case(const case_type *const run[], const char *name,
                                 char text[FAULT_TEXT]);
const char *user_names_near_formulation(const char *name, char text[FAULT_TEXT]);
const char *user_names_near_quantity(const scene *s, const char *name, char text[FAULT_TEXT]);

/* Returns 1 if the counts, steps and corrections of a cell are consistent with each other and with
 * properties of every solution. Otherwise returns 0, and `why` describes the contradiction. newton:
 * form of Newton's method. A cell without a solution is not checked. */
int record_is_consistent(const cell_result *cell, const scene *s, newton_form newton,
                         char why[FAULT_TEXT]);

/* Returns the CRC-32 of IEEE 802.3. sum: 0 for the first block, otherwise the result for the
 * previous blocks. */
uint32_t crc_add(uint32_t sum, const unsigned char *data, size_t size);

/* Indexes all existing rows by case and quantity. FAULT: out of memory; rows are still found. */
status truth_index_make(truths *t, fault *f);
void truth_index_free(truths *t);

/* Returns the first row for the quantity of the case, in the order of the rows; t->rows: there is
 * none. */
int truth_index_first(const truths *t, const case_type *type, const char *quantity);
/* Returns the next row after i for the same quantity. */
int truth_index_next(const truths *t, int i);

/* Returns the name of the first column of a row whose value is invalid; NULL: all values are
 * valid. */
const char *truth_rows_wrong(const truth *row);
/* Returns the words that the column may contain, in the form "a|b"; NULL: a column of numbers. */
const char *truth_words(const char *column);
/* Reads row[table->rows], which the caller has set to zero. FAULT: a column is invalid, or the
 * defaults of the case of a row have changed. truths_free releases the rows that were read, even
 * after a failure. */
status truth_rows_read(const table_columns *table, const case_type *type, truth row[]);

#endif
