#ifndef BEAMWORK_STUDY_H
#define BEAMWORK_STUDY_H

#include <hdf5.h>
#include <limits.h>
#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

#include "cases/case.h"
#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "elements/shared/status.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

/* Limit of a sequence of values on successively finer meshes, with the uncertainty of the limit.
 * Sources: Roache, Verification and Validation in Computational Science and Engineering (1998),
 * grid convergence index and its factors 1.25 and 3; Eca and Hoekstra, J. Comput. Phys. 262 (2014)
 * 104-130, range of the data, poor orders, noise; Phillips and Roy, J. Fluids Eng. 136 (2014)
 * 121401, uncertainty of extrapolated limits; Oberkampf and Roy, Verification and Validation in
 * Scientific Computing (2010), chapter 8. */

/* Kind of a sequence, for information. */
typedef enum limit_kind {
    LIMIT_NONE,            /* no value */
    LIMIT_NOISE_DOMINATED, /* the last two changes are within the scatter */
    /* the relative uncertainty is below 1e-4, or the last change is within the scatter */
    LIMIT_CONVERGED,
    LIMIT_ASYMPTOTIC,  /* two observed orders agree: value(n) = limit + c n^-order */
    LIMIT_OSCILLATING, /* the last two changes differ in sign */
    LIMIT_NOT_YET, /* the orders change from mesh to mesh or are not plausible, or there are fewer
                      than four meshes */
    LIMIT_KINDS
} limit_kind;

typedef struct limit_sequence {
    int count;           /* at most LIMIT_MESHES */
    const int *n;        /* [count] numbers of elements, in any order */
    const double *value; /* [count] values; values that are not finite are ignored */
    double noise;        /* relative scatter of the values; NAN: not measured */
    /* nominal and highest possible order for the formulation and quantity */
    double nominal_order, highest_order;
    /* [unit of value] scale of differences if the limit may be zero; 0: differences are relative to
     * the limit */
    double near_zero;
} limit_sequence;

typedef struct mesh_limit {
    limit_kind kind;
    double limit, limit_uncertainty; /* NAN, INFINITY: none */
    /* order (NAN: none was observed), and the difference between the last two orders */
    double order, order_uncertainty;
    double earlier_order; /* order of the three meshes up to the third finest; NAN: none */
    /* 1: the middle one of the last three orders is clearly the smallest or the largest */
    int order_turns;
    double noise;       /* [unit of value] scatter that was assumed for the limit */
    double last_change; /* |last value - previous value|; NAN: there is only one mesh */
    /* coarsest mesh that was used (0: none), and number of meshes after selection */
    int from, meshes;
} mesh_limit;

mesh_limit limit_of(const limit_sequence *s);
const char *limit_kind_name(limit_kind kind);

/* A cell is one run of a case: a parameter point, a formulation with its options, and a mesh. */

typedef struct cell_request {
    /* valid scene that all cells of a point share; NULL: the cell builds the scene from the next
     * three members */
    const scene *scene;
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    scene_edit edit;
    const element_type *formulation;
    double option[ELEMENT_MAX_OPTIONS];
    solve_options solve;
    int elements;
    int keep_all;
    unsigned omit; /* bits of the physics that the model omits (model_request) */
    int threads;   /* threads for the loop over elements; 0 or 1: one thread */
    /* Called when the model is complete. Returns 1 if the same problem has already been solved.
     * NULL: the problem is always solved. */
    int (*is_known)(void *context, const model *);
    void *context;
} cell_request;

typedef struct cell_result {
    scene scene; /* the scene, if the cell built it; otherwise empty */
    model_size size;
    double mass; /* mass of the members [kg] */
    counters counters;
    int left_out_lines;
    char **left_out;
    solve_result solve;
} cell_result;

void cell_formulation(cell_request *, const formulation *chosen);
/* Builds the valid scene of a case for given parameters, changed by the edit (NULL: unchanged).
 * REFUSED: case_build, scene_edit_apply or scene_validate rejects the case. The caller frees the
 * scene, even after a failure. */
status cell_scene(const case_type *type, const double parameter[], const scene_edit *edit,
                  scene *out, fault *f);
status cell_run(const cell_request *, cell_result *, fault *);
/* Returns the number of quantities that have a value. After a failed analysis, other quantities may
 * still have one. */
int cell_values(const cell_result *);
void cell_result_free(cell_result *);

enum { IMPORTED_UNIT = 48, IMPORTED_FILE = 256, IMPORTED_WORD = 48 };

/* A value of the file. `factor` converts it to the unit of the case. */
typedef struct imported_row {
    int line;               /* line of the file */
    int elements, unknowns; /* numbers of elements and of unknowns; 0: not given */
    char quantity[SCENE_NAME];
    char unit[IMPORTED_UNIT]; /* unit given in the file */
    double factor;
    double seconds;            /* time of the solution given in the file; NAN: not given */
    double x;                  /* [SI] abscissa of a curve; NAN: the quantity is not a curve */
    double value, uncertainty; /* [unit of the quantity] value and uncertainty (NAN: not given) */
} imported_row;

typedef struct imported {
    char program[FORMULATION_KEY]; /* name of the program, used like the key of a formulation */
    char file[IMPORTED_FILE];
    /* "beam": the model of the beams; any other word: another model, whose differences from the
     * beams are model errors */
    char model[IMPORTED_WORD];
    char convention[IMPORTED_WORD]; /* convention of moments; empty: not given */
    char version[IMPORTED_WORD];    /* version of the program; empty: not given */
    int gates;
    int rows;
    imported_row *row;
    element_type type; /* type without functions, in place of a formulation */
} imported;

/* Returns 1 if the values belong to the continuum model of the beams. */
int imported_same_model(const imported *);
void imported_free(imported *); /* may be NULL */

typedef struct omission {
    unsigned what;          /* FEATURE_* and OMIT_* bits (model.h); 0: nothing */
    char words[OMIT_WORDS]; /* the omitted physics as text, as stored in results */
    int other;              /* 1: the formulation solves another model */
    /* 1: no value changes, because these physics have no effect in the sections or in the
     * analyses */
    int exact;
    double change; /* upper bound of the relative change of values; NAN: unknown; INFINITY: a value
                      changes from zero, or the path of an analysis changes */
    char quantity[SCENE_NAME]; /* quantity with the largest change; empty: none */
    char why[FAULT_TEXT];      /* reason why the bound is unknown */
} omission;

/* Finds the physics of a scene that the type omits, and bounds the resulting change of values. The
 * type solves another model if the bound is large or unknown. */
void omission_of(const scene *, const element_type *, omission *out);
/* Writes "without shear; the omission changes no value by more than 2e-06", or "another model:
 * shear not modelled (changes frequency_1 by about 16 %)". */
enum { OMISSION_TEXT = OMIT_WORDS + SCENE_NAME + FAULT_TEXT + 80 };
void omission_words(const omission *, char text[OMISSION_TEXT]);

/* The list of known deviations (reference/findings.csv): expected verdicts other than pass. */

typedef struct rule {
    char *name;         /* one word */
    char *formulations; /* list of formulations, with options ("beamw:mass=lumped") or without */
    char *cases;        /* list */
    char *condition;    /* terms separated by ';', all of which must be true (rules_hold) */
    char *quantities;   /* list */
    char *verdicts;     /* "wrong limit|undecided" */
    char *predicted;    /* list of "case/quantity" with a derived limit; empty: none */
    char *cause, *proof;
    /* largest relative difference that the rule covers, between the limit and the derived limit or,
     * if no limit was derived, the reference value */
    double largest_error;
    /* "file:line" for a rule of a user table; NULL: the rule is in the list of known deviations */
    char *from;
    int missed;   /* set by the evaluation; 1: the run should have shown this deviation, but did not
                   */
    int observed; /* set by the evaluation: number of verdicts that the rule explains */
    unsigned
        confirmed; /* set by the evaluation: bits of the derived limits that verdicts confirmed */
} rule;

typedef struct rule_subject {
    const case_type *type;
    const double *parameter;
    unsigned features; /* bits of enum element_feature: features that the scene requires */
    const char *formulation, *quantity, *verdict;
} rule_subject;

/* Returns 1 if the list of formulations of the rule includes the formulation with this key. */
int rules_apply_to(const rule *, const char *formulation);

enum { TRUTHS_VERSION = 4 };

typedef struct truth {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    int any[CASE_MAX_PARAMETERS]; /* 1: the row is valid for any value of the parameter */
    char *formulation;
    /* 0: value of the continuum, or a derived limit (kind predicted); otherwise the number of
     * elements for which the value is valid */
    int elements;
    char *theory, *quantity, *unit, *kind, *model, *convention, *source;
    int on_curve; /* 1: the row is a point of a curve at abscissa `at` */
    double at;
    double value, uncertainty;
    int met, evaluated;
} truth;

typedef struct truths {
    int rows, rules, room; /* numbers of rows and rules, and capacity in rows */
    truth *row;
    /* index (study_impl.h): for each case and quantity, the first row; for each row, the next row
     * of the same quantity */
    int indexed, places;
    int *first, *next; /* [places], [indexed] */
    rule *rule;        /* known deviations */
    int unknown_cases; /* number of cases in the file that this program does not contain */
    char unknown_case[64];
} truths;

/* Reads all reference values. Registers the formulations that affect the exit status
 * (formulations_accept). FAULT: the file is missing, truncated or of another kind; or the defaults
 * of a case have changed, so that a row is stale. */
status truths_read(const char *path, truths *out, fault *f);
/* Like truths_read, for one case (NULL: all cases). */
status truths_read_case(const char *path, const case_type *type, truths *out, fault *f);
/* Like truths_read, but reads only the known deviations and the formulations that affect the exit
 * status. */
status truths_read_rules(const char *path, truths *out, fault *f);
status truths_read_extremes(const char *path, truths *out, fault *f);
/* Adds a row of zeros and returns it; NULL: out of memory. */
truth *truths_add(truths *, fault *f);
void truths_free(truths *t);

enum { SERIES_MAX_MESHES = SCENE_MESHES };

typedef struct sweep_point {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    char text[PARAMETERS_TEXT]; /* parameters that differ from the defaults */
    char name[16];              /* "default", or the first digits of the hash of the parameters */
    scene_edit edit;
    int steps;       /* number of load steps between stations; 0: number in the scene */
    int condition;   /* 1: the condition of the tangents is estimated */
    int shapes;      /* largest number of states whose centre lines are stored; 0: none */
    int whole_steps; /* 1: time steps are not halved on finer meshes */
    scene scene;     /* scene of all cells of the point, including its quantities */
    status status;   /* result of building the scene */
    char reason[FAULT_TEXT];
} sweep_point;

typedef struct series {
    int point;
    formulation formulation;
    /* required features that the formulation does not support; empty: the formulation runs */
    char missing[200];
    omission without; /* physics that the formulation omits, and its effect */
    int meshes, mesh[SERIES_MAX_MESHES];
    /* [meshes] cells; their scenes are empty, because the point owns the scene */
    cell_result *cell;
    /* [quantities] relative scatter of the values on the finest mesh; NULL: not measured */
    double *noise;
    struct cell_timing *timing; /* [meshes] times of a benchmark; NULL: none */
    /* results of another program, whose cells are not run; NULL: the series is that of a
     * formulation */
    imported *imported;
} series;

typedef struct sweep {
    const char *select;
    /* arrays of the request, not copied. cases NULL: the sweep was planned point by point. given
     * NULL: all formulations */
    const case_type *const *cases;
    const formulation *given;
    int givens;
    int named;        /* copied from the sweep_request */
    double tolerance; /* copied from the sweep_request */
    int shapes;       /* copied from the sweep_request */
    int whole_only;   /* 1: a formulation that does not support a required feature does not run */
    int values_only;  /* 1: values that only curves and matrices need are not computed */
    int doublings;    /* copied from the sweep_request */
    int threads;      /* threads for the loop over elements in every cell; 0 or 1: one thread */
    /* number of cells that an interrupted run did not complete; incomplete series were removed */
    int unfinished;
    int partial; /* 1: batches are missing, although the run was not interrupted */
    int points, seriess;
    sweep_point *point;
    series *series;
} sweep;

typedef struct sweep_follower {
    void *context;
    /* Returns 1 if the finest mesh of this complete series must be run again to measure the
     * scatter. NULL: no scatter is measured. */
    int (*needs_scatter)(void *context, const sweep *, int series_index);
    /* Called once for every series, in order. At the call, this series and all previous series are
     * complete and their scatter has been measured. A failure ends the run. NULL: no call. */
    status (*whole)(void *context, const sweep *, int series_index, fault *);
} sweep_follower;

typedef struct sweep_request {
    const char
        *select;    /* expression that selects among "case/point/formulation/quantity"; NULL: all */
    int jobs;       /* number of processes, >= 1 */
    int whole_only; /* see sweep */
    /* 1: problems with provably equal results are solved only once; their cells have the same
     * times */
    int share;
    /* [s] time limit of a cell, which its process and the parent process enforce; 0: none */
    int time_limit;
    /* 1: if a worker is killed (SIGKILL), this process also ends, so that its result is not used;
     * 0: the cell counts as crashed */
    int together;
    int interruptible; /* 1: Ctrl-C ends the run, and finished results remain */
    int stop;          /* file descriptor that becomes readable to stop the run; 0: none */
    const case_type *const *cases; /* NULL-terminated; NULL: all cases */
    /* number of additional meshes, each with twice as many elements as the previous mesh */
    int doublings;
    int formulations; /* number of formulations in the list; 0: all */
    const formulation *formulation;
    /* 1: the user named these formulations, so their verdicts affect the exit status even if they
     * are not in reference/accepted.csv */
    int named;
    /* relative tolerance that replaces the tolerances of the cases; 0: these are used */
    double tolerance;
    /* largest number of states of a path for which centre lines are stored, on the finest mesh of
     * default points; 0: none */
    int shapes;
    const sweep_follower *follower; /* NULL: none */
    FILE *progress;                 /* NULL: quiet */
    const char *things;             /* word for cells in messages; NULL: "cells" */
} sweep_request;

/* Text to which a selection is applied: case/parameters/formulation/quantity. */
enum { SWEEP_TEXT = PARAMETERS_TEXT + FORMULATION_KEY + 2 * FAULT_TEXT };
void sweep_text(const sweep_point *, const formulation *, const char *quantity,
                char text[SWEEP_TEXT]);

/* Returns 1 if the verdicts of a series affect the exit status: the formulation is accepted, named
 * or loaded, or the results are those of another program and the user requested this effect. */
int sweep_gates(const sweep *, const series *);
cell_request sweep_cell(const sweep *s, int series_index, int mesh);
int sweep_cells(const sweep *s); /* returns the number of cells that this sweep runs */
void sweep_series_free(series *);
void sweep_free(sweep *s);

/* Verdict on a quantity of a series, with respect to the reference value. */

typedef enum verdict_kind {
    VERDICT_PASS,
    VERDICT_BIASED, /* within the tolerance, but significantly different from the reference value */
    VERDICT_WRONG_LIMIT, /* significantly outside the tolerance */
    /* the preceding two kinds, if the limit agrees with the limit derived for the formulation */
    VERDICT_BIASED_AS_PREDICTED,
    VERDICT_WRONG_AS_PREDICTED,
    VERDICT_LOW_ORDER,
    VERDICT_UNDECIDED, /* the uncertainty of the limit is too large for another verdict */
    VERDICT_DIVERGED, /* there is no value on the finest mesh: not converged, singular or crashed */
    VERDICT_REFUSED,
    VERDICT_SKIP, /* the formulation does not support a required feature */
    /* there is no reference value, or none for the shear theory of the formulation */
    VERDICT_NO_TRUTH,
    /* the formulation omits physics of the scene that change the requested quantity */
    VERDICT_OTHER_MODEL,
    VERDICT_KINDS
} verdict_kind;

typedef struct verdict {
    int series, quantity; /* indices of the series in the sweep, and of the quantity in the scene */
    verdict_kind kind, expected;
    /* reference value of the same model and shear theory; NULL: none */
    const truth *truth;
    /* reference value of another model, or cross-formulation agreement, given for information if
     * `truth` is NULL; NULL: none */
    const truth *model_truth;
    /* reference value of another shear theory, given for information if `truth` is NULL; NULL:
     * none */
    const truth *theory_truth;
    const truth *predicted; /* limit derived for the formulation; NULL: none */
    /* published value that differs from the limit by more than the sum of both uncertainties; NULL:
     * none */
    const truth *contradicted;
    mesh_limit fit;
    double finest;
    /* (limit - truth)/max(|truth|, near_zero); NAN: none */
    double error;
    /* relative difference between the limit and the derived limit or, if no limit was derived, the
     * reference value */
    double departure;
    double model_error;
    /* absolute tolerance, which includes the uncertainty of the reference value and the effect of
     * omitted physics */
    double tolerance;
    double unmodelled;
    /* 1: the difference from the reference value is smaller than the uncertainty of the reference
     * value */
    int below_digits;
    int matches; /* 1: verdict as expected */
    /* 1: the formulation is new or named, the verdict is not a pass, and no known deviation
     * explains it */
    int needs_deviation;
    const rule *rule; /* rule that explains a verdict other than pass; NULL: none */
    char reason[FAULT_TEXT];
} verdict;

const char *verdict_name(verdict_kind kind);
/* verdict_meshes returns the number of meshes of a series. For results of another program, meshes
 * after the last one with a value of the quantity do not count. verdict_limit returns the limit
 * without the `left_out` finest meshes. */
int verdict_meshes(const series *, int quantity);
mesh_limit verdict_limit(const sweep *s, int series_index, int quantity, int left_out);
/* Returns the reference value for a formulation: of the same model, and of the shear theory of the
 * formulation; NULL: none. */
const truth *verdict_truth(const truths *t, const sweep_point *p, const formulation *chosen,
                           int quantity);
/* Like verdict_truth. If there is no such reference value, returns the cross-formulation agreement,
 * which is for information and never affects the exit status. */
const truth *verdict_reference(const truths *t, const sweep_point *p, const formulation *chosen,
                               int quantity);
/* Evaluates the quantity and the series of v. Sets the verdict, its limit and its errors. Sets
 * `matches` if the verdict is expected without a known deviation. */
void verdict_reach(const sweep *s, const truths *t, verdict *v);
/* Like verdict_reach, with the given relative scatter of the values (`noise`); NAN: not
 * measured. */
void verdict_reach_with(const sweep *s, const truths *t, double noise, verdict *v);
/* Returns (value - reference)/max(|reference|, near_zero), or the difference if both are zero. */
double verdict_error(const scene_quantity *q, double value, double truth_value);

/* A value on a mesh, compared with the discrete value stored for this mesh. */
typedef struct agreement {
    int series, mesh, quantity;
    const truth *truth;
    double value;
    int good;
} agreement;

typedef struct flaw {
    int series, mesh;
    char why[FAULT_TEXT];
} flaw;

/* A formulation that violates the interface requirements (elements/element.h). */
typedef struct breach {
    char formulation[FORMULATION_KEY];
    char why[FAULT_TEXT]; /* the first violated requirement */
} breach;

/* A mesh or a series whose results are worse than in a previous run. */
typedef struct regression {
    char of[FAULT_TEXT];
    char why[FAULT_TEXT];
} regression;

enum { COVERAGE_MESHES = 4 };

/* For each formulation and case: how often limits agree with an exact reference value to within
 * their uncertainty. The limits are computed without the k finest meshes. These counts check the
 * uncertainties. */
typedef struct coverage {
    const case_type *of;
    const element_type *type;
    int point; /* first point of the case in the sweep */
    int series[COVERAGE_MESHES], covered[COVERAGE_MESHES];
} coverage;

typedef struct evaluation {
    int verdicts, agreements, coverages, flaws;
    verdict *verdict;
    agreement *agreement;
    coverage *coverage;
    flaw *flaw; /* [flaws] */
    int breaches;
    breach *breach; /* [breaches] */
    int regressions;
    regression *regression; /* [regressions] */
    int by_kind[VERDICT_KINDS];
    int unexpected; /* number of verdicts that differ from the expected verdict */
    int is_new;   /* number of verdicts of new formulations, which do not affect the exit status */
    int proposed; /* number of verdicts of new formulations that need a known deviation */
    /* number of verdicts on imported values that do not affect the exit status, and of those among
     * them that are not as expected */
    int imported, imported_failed;
    int tolerated; /* number of verdicts that are as expected only because of the tolerance of the
                      request */
    int disagreements;
    int evaluated; /* number of verdicts that have a reference value */
    /* number of rules in the built-in list (complete runs only) and in user tables that no verdict
     * matched, or whose derived limits no verdict confirmed (study_impl.h) */
    int unobserved;
    int unmet; /* number of reference values whose case, point or quantity does not exist
                  (complete runs only) */
    /* number of reference values that every formulation skips, or whose formulation is not loaded
     * (complete runs only) */
    int waiting;
    /* number of reference values at times of a motion that the run does not evaluate (complete runs
     * only) */
    int unread;
} evaluation;

/* Returns 1 if verdicts on the series may depend on the scatter on its finest mesh, which must then
 * be measured. */
int evaluation_needs_scatter(const sweep *s, const truths *t, int series_index);
/* Starts an evaluation. evaluation_add then evaluates the planned series in order, after they have
 * run. FAULT: the unit of a reference value is not the unit of its quantity. */
status evaluation_begin(const sweep *s, truths *t, evaluation *out, fault *f);
status evaluation_add(const sweep *s, truths *t, int series_index, evaluation *out, fault *f);
void evaluation_end(const sweep *s, truths *t, int whole, evaluation *out);
/* Calls evaluation_begin, evaluation_add for every series, and evaluation_end. */
status evaluation_make(const sweep *s, truths *t, int whole, evaluation *out, fault *f);
void evaluation_free(evaluation *j);
enum { EVALUATION_AS_EXPECTED = 0, EVALUATION_DIFFERS = 1, EVALUATION_NOTHING = 3 };
/* Returns the exit status: 0 if all results are as expected; 1 if a verdict that affects the exit
 * status is not, or after another failure, such as a regression or an inconsistent record; 3 if
 * nothing was evaluated. */
int evaluation_exit(const evaluation *j);
/* Returns "pass", "fail" or "nothing was judged". */
const char *evaluation_outcome(const evaluation *j);

/* Returns the diagonal of the smallest box, along the axes, that contains all nodes [m]. */
double change_size(const scene *);
/* Returns the scale of a quantity [unit of the quantity]; smaller values may be rounding errors. */
double change_scale(const scene *s, int quantity, const solve_result *r);

/* Last line of a beamwork file, with the length and the checksum of the file. Truncated, damaged or
 * altered files are detected before the HDF5 library reads them, because this library does not
 * check the contents. */

enum { CHECKSUM_LENGTH = 40 }; /* "beamwork-seal %016zx %08x\n" */

void checksum_write(const void *data, size_t size, char out[CHECKSUM_LENGTH + 1]);
/* Computes the checksum line for a file that does not contain one. FAULT: the file cannot be
 * read. */
status checksum_of_file(const char *path, char out[CHECKSUM_LENGTH + 1], fault *f);
/* Reads the last line of a file without checking it. FAULT: the file cannot be read, or is
 * shorter. */
status checksum_read(const char *path, char out[CHECKSUM_LENGTH + 1], fault *f);
/* Checks the last line of a file. FAULT: the file is missing, is not a beamwork file, or has been
 * altered. */
status checksum_check(const char *path, fault *f);

/* Reports that pipe2 or fork has failed, with the reason from errno. Returns FAULT. */
status child_not_started(fault *f);
/* The child calls this function first. The child then ends with its parent, even if the parent is
 * killed or has already ended, and at an alarm. */
void child_begin(pid_t parent);
/* Sets the remaining time [s] of the child; 0: no limit. */
void child_alarm(int seconds);
/* Returns 1 if the child has ended. The child is not reaped. */
int child_has_ended(pid_t process);
/* Waits for the end of the child for at most two seconds, then kills it. Reaps the child and
 * returns the status from waitpid. */
int child_reap(pid_t process);
/* Describes how the child ended. how: status from waitpid. late 1: the child was killed after the
 * time limit. Returns 1 if the time limit was the reason. */
int child_ended(int how, int late, int seconds, char *words, size_t size);

typedef struct task_locks task_locks;

/* Reads a table that is stored as one HDF5 data set of a compound type. The size and type of every
 * column are checked. */

typedef enum column_kind { COLUMN_REAL, COLUMN_TEXT, COLUMN_INT, COLUMN_HASH } column_kind;

typedef struct columns_member {
    char name[24];
    column_kind kind;
    size_t offset, size; /* in bytes of a row */
} columns_member;

enum { COLUMNS_MOST = 24 };

typedef struct table_columns {
    const char *path; /* path of the file, for messages */
    char name[64];    /* name of the data set */
    int rows, members;
    columns_member member[COLUMNS_MOST];
    size_t row_size;
    char *data; /* [rows * row_size] */
    fault *f;
} table_columns;

typedef struct columns_field {
    const char *column;
    column_kind kind; /* double; char *, allocated with malloc; int; uint64_t */
    size_t offset;
} columns_field;

/* Reads the data set t->name of a file or group. FAULT: it is missing or damaged. The caller calls
 * columns_close, even after a failure. */
status columns_open(table_columns *t, hid_t at);
void columns_close(table_columns *t);

/* Returns FAULT, with the message that the column is missing or damaged. */
status columns_broken(const table_columns *r, const char *column);
/* Reads a column into a member of an array of structs base[rows]. After a failure, the array
 * contains the strings that have been read. */
status columns_read(const table_columns *r, const columns_field *field, void *base, size_t stride);

/* Returns the largest difference over the common points, relative to the largest magnitude of the
 * second curve. NAN: there are no common points, a curve does not reach the end, or the numbers of
 * points of paths with given stations differ. at: point with the largest difference (may be NULL).
 * Points of a path with given stations are matched by number, other points by abscissa. */
double curve_error_between(const scene *s, int quantity, const solve_result *one,
                           const solve_result *two, int *at);
/* Returns the index of the finest mesh of a series that has the whole curve; -1: none. */
int curve_error_finest(const series *, int quantity);
/* Among the curves of all series, finds the one that changed least when the last mesh was added.
 * Returns the index of this series, with which others are compared; -1: none. */
int curve_error_reference(const sweep *, int quantity);

/* Finds a data file or folder: next to the program or shared library, in the two folders above (a
 * clone), in share/beamwork of these two (an installation), or in share/beamwork of the prefix set
 * at build time. Returns 0 if it is in none of these. The path is then one next to the program. */
int data_place(const char *name, char path[PATH_MAX]);
/* Writes the path of the packed reference values, from the variable BEAMWORK_TRUTHS or from
 * data_place. */
void data_place_truths(char path[PATH_MAX]);
/* Makes beamwork_element.py available to Python processes that are started later, by appending its
 * folder to PYTHONPATH if the folder exists. */
void data_place_modules(void);

typedef struct derived_value {
    char quantity[SCENE_NAME], unit[16], convention[96], source[96];
    double value, uncertainty; /* [unit] */
} derived_value;

/* Returns a temporary file for the text of a scene, which the caller closes. NULL: the file cannot
 * be created, which is reported. */
FILE *derive_text_file(fault *f);
/* Writes the path of a program of reference/derive. The folder is BEAMWORK_REFERENCE or that of the
 * other data. FAULT: the path is too long. */
status derive_script(const char *name, char out[PATH_MAX], fault *f);
/* Runs `script CASE PARAMETERS`. *out: the values, allocated with malloc. REFUSED: no program
 * computes the case, or its parameters are not supported; the message is that of the program.
 * FAULT: the script cannot be run, or its output is invalid. */
status derive_values(const char *script, const char *case_name, const char *parameters,
                     derived_value **out, int *count, fault *f);
/* Like derive_values, with a scene in the format of write_scene on the standard input of `script`.
 * The script lists everything that it cannot compute on standard error, one item per line. */
status derive_scene(const char *script, FILE *scene_text, derived_value **out, int *count,
                    fault *f);

enum { WORKERS_MOST = 64 };

/* Returns the estimated cost [s]. elements: number of elements per member. */
double run_cost_of_scene(const scene *s, int steps, const element_type *type, int elements);
double run_cost_of_cell(const sweep *s, int index, int mesh);

/* Writes why there is no agreement, and which formulation could contribute to one. */
void families_why(FILE *to, const sweep *s, int point_index, int quantity, const truths *);
/* For every quantity without a reference value of its model, adds the cross-formulation agreement
 * as a reference value of the kind agreement. files_only 1: only for scene files, not for built-in
 * cases. */
status families_add_truths(const sweep *s, int files_only, truths *t, fault *f);
/* Like families_add_truths, for one point. Call when all series of the point are complete. */
status families_add_point(const sweep *s, int point_index, int files_only, truths *t, fault *f);
status families_reserve(const sweep *s, int files_only, truths *t, fault *f);

/* Follows modes over a parameter of a case.
 *
 * Modes at neighbouring parameter values are matched by the modal assurance criterion with the mass
 * matrix M at the new value, (v^T M w)^2/((v^T M v)(w^T M w)), which is 1 for equal shapes. If a
 * match is below 0.9, the step is halved. Frequencies of followed modes may cross. */

typedef struct follow_request {
    /* the case and its parameters; follow_run sets the analyses to be solved */
    cell_request cell;
    int parameter; /* index of the parameter that varies */
    double from, to;
    int parts; /* smallest number of equal intervals */
} follow_request;

typedef struct follow_sample {
    double value;
    int requested; /* 1: the value was requested; 0: it was added between two requested values */
    double *frequency; /* [modes] [Hz] */
    double *match;     /* [modes] match with the previous sample; 1 for the first sample */
} follow_sample;

typedef struct follow_event {
    int crossing; /* 1: crossing; 0: veering */
    int mode[2];
    double value;     /* value of the parameter */
    double frequency; /* [Hz] mean frequency of both modes */
    /* at a veering: smallest difference of the two frequencies, relative to their mean */
    double gap;
} follow_event;

typedef struct follow_curves {
    int modes, samples, events;
    follow_sample *sample; /* [samples] samples between `from` and `to` */
    follow_event *event;   /* [events] */
} follow_curves;

/* Follows as many modes as the first modal analysis has frequency quantities. The modes are the
 * lowest modes at `from`. REFUSED: the message gives the reason. NOT_CONVERGED: a mode cannot be
 * followed even with small steps. */
status follow_run(const follow_request *, follow_curves *, fault *);
void follow_free(follow_curves *);

typedef struct glossary_entry {
    char *term;
    char *also;    /* other names, separated by '|'; "": none */
    char *group;   /* heading; entries with the same heading are consecutive */
    char *meaning; /* one to four sentences */
    char *see;     /* terms for further reading, separated by '|'; "": none */
} glossary_entry;

typedef struct glossary {
    int entries;
    glossary_entry *entry;
} glossary;

enum { GLOSSARY_WORD = 128 };

/* Reads the glossary. FAULT: the packed reference values are missing or damaged, or contain no
 * glossary. */
status glossary_read(const char *path, glossary *out, fault *f);
void glossary_free(glossary *);
/* Finds the entry with this term or alternative name; NULL: none. Upper and lower case count as
 * equal, as do '_', '-' and blanks. */
const glossary_entry *glossary_find(const glossary *, const char *word);
int glossary_same(const char *a, const char *b);
/* Copies part number `index` of "a|b|c". Returns 0 if there are fewer parts. */
int glossary_part(const char *list, int index, char word[GLOSSARY_WORD]);

/* HDF5 handles. */

/* Closes open handles of any kind (data set, attribute, type, space) in the given order. */
static inline void handles_close(int count, const hid_t handle[])
{
    for (int i = 0; i < count; i++)
        if (handle[i] >= 0)
            H5Idec_ref(handle[i]);
}

typedef struct interrupt {
    int descriptor;  /* file descriptor that becomes readable when a request arrives; -1: none */
    sigset_t before; /* signal mask that interrupt_end restores */
} interrupt;

/* From this call on, requests are pending until they are read, in this process and in processes
 * that it starts. Ignored signals (nohup) remain ignored. */
void interrupt_begin(interrupt *);
/* Restores the signal mask. A further request then ends the process immediately. */
void interrupt_end(interrupt *);

/* Numbers of elements that two formulations need for equal errors: series 0 and 1 of a sweep with
 * one point. */
typedef struct equal_error {
    /* index of the coarsest mesh for which all quantities are within the error target on this mesh
     * and all finer meshes; -1: none */
    int mesh[2];
    double error[2]; /* largest relative error on this mesh; NAN: none */
} equal_error;

/* Returns 1 if the comparison includes the quantity: it is not a curve, and both series have a
 * reference value or an agreement. */
int equal_error_includes(const sweep *s, const truths *t, int quantity);
int equal_error_quantities(const sweep *s, const truths *t);
/* Compares all these quantities for the relative error target `level`. */
equal_error equal_error_at(const sweep *s, const truths *t, double level);
int equal_error_met(const equal_error *);

/* At the last point of a planned sweep, keeps the quantities and formulations that are part of a
 * selected combination (formulations/formulations.h). REFUSED: the selection is malformed, has a
 * word that matches no name, or selects nothing. */
status narrow_to(sweep *s, const char *select, fault *f);
/* Reports words of a selection that match nothing. REFUSED: there are such words. */
status narrow_check_words(const sweep_point *p, const char *select, const select_words *words,
                          fault *f);
/* Reports that formulation `key` does not support the physics `missing` of the case `name`. Returns
 * REFUSED. */
status sweep_unsupported(const char *key, const char *missing, const char *name, fault *f);
/* Reports that the selection contains no quantity of the case. Returns REFUSED. */
status narrow_to_nothing(const char *select, const case_type *, fault *f);
/* Like narrow_to, for a scene before planning. If no formulation has been chosen (type NULL), words
 * that may be names of formulations have no effect. */
status narrow_scene(scene *, const case_type *, const double parameter[], const formulation *,
                    const char *select, fault *);

int noise_cells(const sweep *s);

/* Marks in increasing order of severity. */
typedef enum overview_mark {
    /* nothing was evaluated: the case was skipped, or there is no reference value */
    OVERVIEW_NOTHING,
    OVERVIEW_OTHER_MODEL,
    OVERVIEW_PASS,
    OVERVIEW_LOW_ORDER,
    OVERVIEW_UNDECIDED,
    OVERVIEW_BIASED,
    OVERVIEW_WRONG,
    OVERVIEW_NO_VALUE, /* there is no value: no solution, or not applicable */
    OVERVIEW_FLAW, /* inconsistent records of a run, or a deviation from a stored discrete value */
    OVERVIEW_MARKS
} overview_mark;

typedef struct overview_cell {
    overview_mark mark;
    int unexpected; /* 1: unexpected; unexpected marks replace expected marks */
    int count;      /* number of quantities (for a flaw: cells) with this mark */
} overview_cell;

typedef struct overview {
    int rows, columns;
    /* 1: all options of a formulation share a column */
    int joined;
    int accepted; /* number of columns before those of new formulations, which do not affect the
                     exit status */
    const case_type **row;
    const char **column; /* [columns] names, valid as long as the sweep exists */
    overview_cell *cell; /* [rows*columns] */
} overview;

enum { OVERVIEW_TEXT = 24 };

/* FAULT: out of memory. */
status overview_make(const sweep *s, const evaluation *j, overview *out, fault *f);
void overview_free(overview *);
const overview_cell *overview_at(const overview *, int row, int column);
int overview_evaluated(const overview *, int row);
int overview_shown(const overview *, int row);
/* Writes the mark, for example "ok", "~3" or "!#2". It is readable without colours. utf8 1: uses
 * characters outside ASCII. */
void overview_text(const overview_cell *, int utf8, char text[OVERVIEW_TEXT]);
const char *overview_words(overview_mark mark);

/* Adds the rules of a file to the rules of t. run: cases of the run, NULL-terminated. FAULT: the
 * file cannot be read. */
status user_deviations_read(const char *path, const case_type *const run[], truths *t, mistakes *m,
                            fault *f);

/* A user table in CSV format with given columns and one record per line. All fields are checked. */

enum { USER_TABLE_COLUMNS = 16 };

typedef struct user_table_row {
    int line;
    char *text; /* text of the line, into which the fields point */
    char *field[USER_TABLE_COLUMNS];
} user_table_row;

typedef struct user_table {
    int rows;
    user_table_row *row;
} user_table;

/* Reads a user table. columns: names of the columns, in order and separated by commas; the first
 * line of the file must be equal to this text. Errors in lines are reported to `m`, and lines with
 * errors are skipped. FAULT: the file cannot be read. The caller frees *out, even after a
 * failure. */
status user_table_read(const char *path, const char *columns, user_table *out, mistakes *m,
                       fault *f);
void user_table_free(user_table *);

/* Adds the rows of a file to the rows of t. run: cases of the run, NULL-terminated. only: the only
 * case to read; NULL: all cases. Errors in the file are reported to `m`, and rows with errors are
 * skipped. FAULT: the file cannot be read. */
status user_truths_read(const char *path, const case_type *const run[], const case_type *only,
                        truths *t, mistakes *m, fault *f);

status plan_sweep(const sweep_request *request, const truths *t, sweep *out, fault *f);
status plan_one(const case_type *type, const double value[], const formulation those[], int count,
                const int mesh[], int meshes, sweep *out, fault *f);
/* Adds a point to a sweep. The edit changes the scene of the point; NULL: no change. */
status plan_add(sweep *s, const case_type *type, const double value[], const scene_edit *edit,
                const int mesh[], int meshes, fault *f);
status plan_extend(sweep *s, const formulation those[], int count, fault *f);

/* Chooses a formulation that supports all features that the scene requires or, if there is none,
 * one that solves another model. rules NULL: no list of known deviations. REFUSED: no formulation
 * can solve the scene. why: reason for the choice, in one line. */
status default_choice_formulation(const scene *, const rule_subject *where, const rule *rules,
                                  int count, formulation *out, char why[FAULT_TEXT], fault *f);

/* Default relative change between two meshes that counts as converged. */
#define DEFAULT_CHOICE_ERROR 1e-3

typedef struct default_choice {
    formulation chosen;
    int elements;
    int short_of; /* 1: on the finest mesh, values still change by more than the requested error */
    /* [quantities of the scene] relative change from the previous mesh to the chosen mesh; NAN:
     * unknown */
    double *change;
    char why_formulation[FAULT_TEXT], why_elements[FAULT_TEXT];
} default_choice;
void default_choice_free(default_choice *);

/* Finds the coarsest mesh on which all values differ by at most `requested` from those on the
 * previous mesh or, if there is none, the finest mesh that was tried. Solves all meshes up to this
 * one. request: the cell without the number of elements. */
status default_choice_elements(const cell_request *, const formulation *chosen, double requested,
                               default_choice *out, fault *f);

/* Chooses formulation and mesh together. Candidates are the formulations that rank equal with the
 * first in default_choice_formulation: at most five, and at most two per family. The first
 * candidate that converges is chosen; if none converges, the one whose values change least.
 * request: the cell without formulation and elements. */
status default_choice_both(const cell_request *, const rule_subject *where, const rule *rules,
                           int count, double requested, default_choice *out, fault *f);

/* Cost of a cell: sum of cost coefficients times counts of its work. The coefficients are
 * fitted to measured times (`make lab L=cost-coefficients`) and stored in
 * harness/study/cost_coefficients.csv, from which the build generates the table. */

/* Counted work. The names are those of the columns of the table `cells`. */
typedef enum counted_work {
    COUNTED_one, /* one per cell */
    COUNTED_elements_total,
    COUNTED_element_kinds,
    COUNTED_strain_evaluations,
    COUNTED_stress_evaluations,
    COUNTED_inertia_evaluations,
    COUNTED_geometric_evaluations,
    COUNTED_load_steps,
    COUNTED_solutions,
    COUNTED_solved_entries,
    COUNTED_factor_flops,
    COUNTED_dense_operations,
    COUNTED_KINDS
} counted_work;

typedef struct cost_coefficient {
    /* name of the formulation, with options if these affect the coefficient; "": all formulations;
     * "*": formulations without coefficients */
    const char *formulation;
    counted_work count;
    double seconds; /* [s] cost per count, on the reference machine */
} cost_coefficient;

extern const cost_coefficient
    cost_coefficients[]; /* generated table, whose last row has no formulation */
/* Smallest ratio of two costs that shows which formulation costs less. For smaller ratios, the cost
 * coefficients are not accurate enough. */
extern const double counted_cost_noise;

/* Items of the expected cost of a cell (harness/study/run_cost.csv). The cost of an item is
 * multiplied by the number of its occurrences. */
typedef enum run_cost_kind {
    RUN_COST_cell, /* once per cell */
    RUN_COST_linear,
    RUN_COST_buckling,
    /* buckling about a loaded state, including the path to the critical point */
    RUN_COST_loaded_buckling,
    RUN_COST_modal,
    RUN_COST_load_step,
    RUN_COST_compliance,
    RUN_COST_continuation,
    RUN_COST_rotation_step,
    RUN_COST_rotation_station,
    RUN_COST_alpha_step, /* transient analysis, by integrator */
    RUN_COST_conserving_step,
    RUN_COST_radau_step,
    RUN_COST_explicit_step,
    RUN_COST_KINDS
} run_cost_kind;

/* [s] cost on the reference machine: a fixed part, and a part per element; or factors of both
 * parts */
typedef struct run_cost_pair {
    double once, element;
} run_cost_pair;

typedef struct run_cost_factor {
    /* name of the formulation without options; NULL: all formulations without a row */
    const char *formulation;
    run_cost_pair factor;
} run_cost_factor;

/* Generated tables. The last factors apply to formulations without a row. */
extern const run_cost_pair run_cost_work[RUN_COST_KINDS];
extern const run_cost_factor run_cost_factors[];

/* Like counted_cost_of, with the committed coefficients. */
double counted_cost(const formulation *chosen, const cell_result *cell);
/* Returns 1 if the formulation has separate cost coefficients, 0 if the common coefficients
 * apply. */
int has_cost_coefficients(const cost_coefficient *rows, const formulation *chosen);

/* Progress of a long run, in one line of the terminal that is overwritten and finally removed. */

typedef struct progress {
    FILE *to;           /* NULL: no output */
    const char *things; /* "cells" */
    int count;          /* number of items in the run */
    double begun;       /* [s] start, by clock_wall_seconds */
    double last;        /* [s] last output */
    int width;
} progress;

/* Here and below, `now` is the current time [s] of clock_wall_seconds. */
progress progress_begin(FILE *to, const char *things, int count, double now);
int progress_is_due(const progress *, double now);
/* Prints "runs 12 of 40, 25 %, about 3 min left: WHAT". share: completed fraction of the work, 0
 * to 1. If `share` is large enough, the remaining time is estimated from it. */
void progress_show(progress *, double now, int done, double share, const char *what);
void progress_end(progress *);

/* Writes CSV with the columns of the list of known deviations, including the header. There is one
 * rule for each formulation, case and verdict, with all quantities. Returns the number of rules. */
int proposal_write(FILE *to, const sweep *s, const evaluation *j);

/* Determines which formulations meet an error target, and on which mesh. The target is met on the
 * coarsest mesh for which the errors on this mesh and on all finer meshes are within the target.
 * Formulations are ranked by the cost of their counted work on this mesh. */

enum { REACH_LEVELS = 4, REACH_EVERY = -1 };
extern const double reach_level[REACH_LEVELS];

/* A formulation that meets the target. */
typedef struct reached {
    int series, mesh;
    /* [s] cost of the counted work; INFINITY: the formulation is not ranked by its work
     * (reach_unranked), and is listed last among those with or without a defect */
    double cost;
    const verdict *defect; /* first verdict other than pass; NULL: all verdicts are pass */
} reached;

typedef struct reach_question {
    const sweep *s;
    /* [verdicts] verdicts on all series; a series without a reference value for a requested
     * quantity is not ranked */
    const verdict *verdict;
    int verdicts, point;
    /* index of a quantity; REACH_EVERY: all quantities of the point for which at least one
     * formulation has a reference value */
    int quantity;
    double level; /* relative error */
} reach_question;

/* Returns why a type is not ranked by its work: "by differences", "in another process" or
 * "implemented with its misprint"; "": it is ranked. */
const char *reach_unranked(const element_type *type);
/* Returns the index of the coarsest mesh for which the errors on this mesh and on all finer meshes
 * are within the target; -1: none. */
int reach_mesh(const sweep *s, const verdict *v, double level);
/* Returns a description of a formulation that meets the target, but with a verdict of this kind. */
const char *reach_defect_words(verdict_kind kind);
/* Ranks the formulations that meet the target, and returns their number. Formulations without a
 * defect come before the others; the order in both groups is that of cost, then of name. out must
 * have room for all series. Results of other programs are excluded, because their work is not
 * counted. */
int reach_ranking(const reach_question *q, reached out[]);
/* Returns the number of tied formulations at the start of the list: they have no defect, and their
 * costs differ by less than the uncertainty of the cost coefficients. 1: the first formulation has
 * the lowest cost. 0: no formulation has both a cost and no defect. */
int reach_ties(const reached list[], int count);
/* Returns 1 if every quantity of the question has a reference value for the series, and 0 if one
 * has none. Returns -1 if the series is of another point or another program, does not run, or
 * solves another model. */
int reach_has_references(const reach_question *q, int series_index);
/* Returns the verdicts on every series and quantity, except curves, of a sweep without an
 * evaluation. Quantities without a reference value use the cross-formulation agreement. The caller
 * frees the array; NULL: out of memory. */
verdict *reach_verdicts(const sweep *s, const truths *t, int *count);

enum { ROUNDING_TEXT = 32, ROUNDING_MOST = 11 /* largest number of digits */ };

/* Writes a number with the given number of digits, or "-" if the number is not finite. The exponent
 * is omitted if the result is short: "0.0031", but "3.1e-9". */
void rounding_digits(double value, int digits, char text[ROUNDING_TEXT]);
/* Writes a value up to the second digit of its uncertainty, which is in the same unit. uncertainty
 * 0: the value is exact. If the uncertainty is not finite, seven digits are written. */
void rounding_known(double value, double uncertainty, char text[ROUNDING_TEXT]);
/* Writes a relative error in percent, for example "-2.7801 %" or "+2.1e-9 %", with at most 11
 * characters. */
void rounding_percent(double error, char text[ROUNDING_TEXT]);

/* The times of two cells differ if all rounds of one are faster than all rounds of the other. For
 * equal distributions, the probability of this is 2 (5! 5!)/10! = 0.8 %. */
enum { ROUNDS_COUNT = 5 };

typedef struct rounds_reading {
    double setup, solve;        /* [s] times for set-up and solution in the fastest repetition */
    double round[ROUNDS_COUNT]; /* [s] shortest time for set-up and solution in each round */
    int rounds, repeats;
} rounds_reading;

double rounds_least(const rounds_reading *);
double rounds_most(const rounds_reading *);
/* Returns -1 if every round of a is faster than every round of b, 1 if every round of a is slower,
 * and 0 otherwise. */
int rounds_compare(const rounds_reading *a, const rounds_reading *b);

/* The published algorithm, for comparison: all coordinates, strains and stresses are unknowns of
 * one system of equations, which is solved by dense Gaussian elimination (newton=dense). */
typedef struct dense_reference {
    int unknowns;     /* number of unknowns of the dense system; 0: not measured */
    double iteration; /* [s] shortest time of an iteration */
    /* times of complete runs, if these are short enough; otherwise rounds = 0 */
    rounds_reading whole;
} dense_reference;

/* Returns the time [s] of a run: measured, or the time of an iteration times the given number of
 * iterations; INFINITY: not measured. */
double dense_reference_seconds(const dense_reference *b, long iterations);

/* Run times of a cell: in its usual form, and with all degrees of freedom kept (--all-dofs). */
typedef struct cell_timing {
    rounds_reading as_is, keep_all; /* rounds = 0: not measured */
    int free_keep_all;              /* number of unknowns if all degrees of freedom are kept */
    /* [s] times of the parts of the iterations, from an additional run */
    double phase[PHASES];
    dense_reference dense; /* measured on request */
} cell_timing;

/* Runs every cell of a sweep in several processes. A cell that fails or crashes counts as a
 * result. */
status run_sweep(const sweep_request *request, sweep *s, fault *f);

status scene_truths_add(const scene_file *, const double value[], truths *t, fault *f);
status scene_truths_add_all(const scene_file *, truths *t, fault *f);

/* Verdicts in words. */

/* Writes a verdict in words, for example "converges to a wrong limit: +0.115 %". */
void sentence_of_verdict(const verdict *v, double least_order, char *text, size_t size);
enum { SENTENCE_OF_RUN = 1000 };

/* Writes a summary of the run in one sentence, which starts with PASS, FAIL, INTERRUPTED (after an
 * interruption) or INCOMPLETE (if batches are missing). It lists the failures or, if there are
 * none, the expected verdicts other than pass. The text is empty if nothing was evaluated and
 * nothing failed. */
void sentence_of_run(const sweep *s, const evaluation *j, char *text, size_t size);

int serialise_write(FILE *to, const cell_result *cell); /* Returns 0, or -1. */
enum { SERIALISE_DAMAGED = -1, SERIALISE_NO_MEMORY = -2 };
/* Reads the result of a cell. Returns 0, SERIALISE_NO_MEMORY, or SERIALISE_DAMAGED if the stream
 * has ended or is damaged. */
int serialise_read(FILE *from, cell_result *cell);

int truth_holds(const truth *row, const case_type *type, const double value[]);
/* Values of truth.kind, in order of decreasing rank: a verdict uses the first kind that has a
 * value. "predicted" is a limit derived for a formulation. truth_gates returns 1 if verdicts may
 * depend on a row. */
extern const char truth_kinds[];
/* Returns the reference value of the continuum for a model; NULL: none. Exact values rank before
 * published values. Points of a curve are never returned. */
const truth *truth_of(const truths *t, const case_type *type, const double value[],
                      const char *quantity, const char *model);

#endif
