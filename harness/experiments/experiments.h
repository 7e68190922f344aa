#ifndef BEAMWORK_EXPERIMENTS_H
#define BEAMWORK_EXPERIMENTS_H

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_rng.h>
#include <jansson.h>
#include <limits.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "cases/case.h"
#include "cases/extremes/extreme.h"
#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "elements/element.h"
#include "elements/section/section.h"
#include "elements/shared/status.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

/* Comparison of two formulations or programs that run alternately, so that a drift of the machine's
 * speed affects both equally. */

typedef enum against_outcome { AGAINST_UNDECIDED, AGAINST_FASTER, AGAINST_SLOWER } against_outcome;

typedef struct against_times {
    int pairs;
    double a, b; /* [s] shortest laps of a and of b */
    /* median of b/a over the pairs, and its distribution-free 99.9 % confidence interval */
    double ratio, low, high;
    /* result for b relative to a; undecided if the interval contains a ratio within 2 % of 1,
     * because differences in code layout can have this effect */
    against_outcome outcome;
} against_times;

const char *against_name(against_outcome);

/* Runs one lap of a program or formulation and writes its time [s] to *seconds. */
typedef status against_lap(void *compared_run, double *seconds, fault *f);
/* Runs as many pairs of laps as fit into `budget` [s], but at least 51 and at most 1001. */
status against_run(against_lap *lap, void *a, void *b, double budget, against_times *out, fault *f);

typedef enum axis_kind { AXIS_LINEAR, AXIS_LOG, AXIS_LIST, AXIS_WORDS } axis_kind;

typedef struct sweep_axis {
    const parameter_type *of;
    int index;
    axis_kind kind;
    double from, to; /* ends of the range, for AXIS_LINEAR and AXIS_LOG */
    int count;       /* number of values; 0: the range is not divided */
    double *value;   /* [count] for AXIS_LIST and AXIS_WORDS; owned */
} sweep_axis;

/* The machine that computes a batch: run times, and sometimes the last digits of results, depend on
 * it. */

typedef struct machine {
    char host[128], processor[128];
    char blas[256]; /* BLAS library, and its kernels for this processor */
} machine;

/* Work that can be divided into batches; a verb supplies the functions. */
typedef struct shard_work {
    const char *verb;
    /* The program, the request, and all other data that affect the results, in one line each. */
    const char *build, *request, *plan;
    const char *origin; /* JSON object with the data that merge needs to repeat the request; it is
                           not compared */
    int batches;
    const double *cost; /* [batches] estimated time [s] */
    void *context;
    /* Computes a batch and writes its results as bytes that another process of this build can read.
     * *content: digest of all values that are the same in every computation; times and names of
     * machines are excluded. The function runs in a separate process, which frees its memory. */
    status (*run)(void *context, int batch, FILE *to, digest *content, fault *f);
    /* Reads the results of a batch. The function is called once per batch, in canonical order.
     * FAULT: the results cannot be read. */
    status (*take)(void *context, int batch, FILE *from, fault *f);
} shard_work;

#define BATCH_ENDING ".batch"
enum { BATCH_STEM = 48, BATCH_NAME = BATCH_STEM + 24 };

typedef struct batch_label {
    char build[512], request[2048], plan[DIGEST_TEXT], verb[32];
    int batch, batches; /* index, starting at 0 */
    int shard, shards;  /* shard that computed the batch, starting at 0 */
    char content[DIGEST_TEXT];
    double seconds;           /* run time [s] */
    double processor_seconds; /* processor time [s] of all processes of the batch */
    machine node;
    json_t *origin; /* batch_label_free releases this object */
} batch_label;

status batch_read_label(const char *path, batch_label *out, fault *f);
void batch_label_free(batch_label *);

/* Measured properties of a formulation: errors over meshes and over thicknesses, and orders of
 * convergence. Contains no pointers, because it is stored in memory that processes share. */

enum { MEASURE_POINTS = 12, MEASURES_MOST = 16, MEASURE_NAME = 64, MEASURE_WORDS = 200 };

typedef struct element_measure {
    char name[MEASURE_NAME];
    int points;
    double at[MEASURE_POINTS];    /* numbers of elements, thickness/length, or numbers of turns */
    double error[MEASURE_POINTS]; /* errors relative to the exact value; NAN: no value */
    double order;       /* observed order of convergence; NAN: not requested, or not observed */
    int least, highest; /* lowest and highest order that the type declares; 0: not requested */
    /* 1: shear or membrane locking (the error of the thinnest element exceeds 0.01 plus ten times
     * that of the thickest) */
    int locks;
    /* 1: wrong limit (in a linear state, the error of four elements exceeds 1e-6 and half of that
     * of one) */
    int wrong_limit;
    char words[MEASURE_WORDS]; /* reason why there are no values, or a conclusion */
} element_measure;

typedef struct measures {
    int count;
    element_measure measure[MEASURES_MOST];
    char words[MEASURE_WORDS]; /* text that applies to all measures; "": none */
} measures;

typedef struct experiment_cells {
    const sweep *sweep;
    const evaluation *evaluated;
    const environment *made;
} experiment_cells;

typedef struct experiment_type {
    const char *name; /* name of the group in the results file */
    /* Steps of the experiment, called in this order; NULL: no such step. requested: the request;
     * found: the results, which each step changes. */
    status (*plan)(const void *requested, void *found, fault *f);
    status (*run)(const void *requested, void *found, fault *f);
    status (*evaluate)(const void *requested, void *found, fault *f);
    /* Tables of results, NULL-terminated. NULL: the results are cells. */
    const record_type *const *records;
    const record_type *about; /* one record for the whole run; NULL: none */
    const record_type *rows;  /* record type that CSV shows; NULL: no CSV */
    /* Appends the records of this type in the results to `out`. */
    void (*gather)(const void *found, const record_type *type, subjects *out);
    void (*print)(FILE *to, const void *found);
    /* For experiments with cells: returns the cells, from which all forms of output are written. */
    experiment_cells (*cells)(const void *found);
    status (*write)(FILE *to, const char *format, const void *found, fault *f);
} experiment_type;

typedef struct experiment_output {
    const char *results; /* file that receives the group; groups of other experiments in the file
                            are kept; NULL: none */
    /* path of the output (NULL: standard output), and its format: "text", "csv" or "json" */
    const char *text, *format;
    const char *json; /* additional JSON file; NULL: none */
} experiment_output;

/* Returns the output for the values of the options -o, --format and --json. A path that ends in .h5
 * or .hdf5 is a results file. */
experiment_output experiment_output_of(const char *path, const char *format, const char *json);

status experiment_plan(const experiment_type *, const void *requested, void *found, fault *f);
status experiment_run(const experiment_type *, const void *requested, const experiment_output *,
                      void *found, fault *f);
status experiment_do(const experiment_type *, const void *requested, const experiment_output *,
                     void *found, fault *f);

/* Error against run time for each formulation and mesh of the cases. The runs are timed in rounds
 * on one processor. */

typedef struct bench_request {
    const char *const *cases; /* [count] names of the cases; 0: all cases that have a reference
                                 value */
    const case_type *scene;   /* scene file that replaces the cases; NULL: none */
    int count;
    const char *const *assignment; /* [assignments] "NAME=VALUE", applied to each case */
    int assignments, meshes;       /* meshes: their number; 0: those of the case */
    const int *mesh;
    sweep_request cells;
    int threads, dense; /* dense 1: the published algorithm is timed as well */
} bench_request;

typedef struct bench {
    truths truths; /* read before planning */
    sweep sweep;
    evaluation evaluation;
    environment made;
    int named; /* 1: the user named the cases, so the output is more detailed */
} bench;

extern const experiment_type experiment_bench;
void bench_free(bench *);

/* A check of a formulation: the deviation from a requirement. Contains no pointers, because it is
 * stored in memory that processes share. */

enum { CHECK_NAME = 64, CHECK_TEXT = 400, CHECKS_MOST = 48 };

typedef enum check_outcome {
    CHECK_PASSED,
    CHECK_FAILED,
    /* the type does not declare the property, or leaves the calculation to the program; `sentence`
     * gives the reason */
    CHECK_NOT_MADE,
    CHECK_OUTCOMES
} check_outcome;

typedef struct check_result {
    char name[CHECK_NAME];
    check_outcome outcome;
    int compared; /* number of comparisons or yes/no questions */
    /* largest deviation (dimensionless; INFINITY: the answer to a question is no), and allowed
     * deviation */
    double worst, allowed;
    char sentence[CHECK_TEXT]; /* describes the largest deviation above the allowed one */
} check_result;

/* Checks of one family. */
typedef struct check_results {
    int count;
    check_result check_result[CHECKS_MOST];
    /* description of the current call, for reports of crashes and exceeded time limits */
    char doing[CHECK_TEXT];
    int complete; /* 1: all checks have been made */
} check_results;

typedef enum profiles_form {
    PROFILES_RECTANGLE,   /* supported by every formulation */
    PROFILES_UNSYMMETRIC, /* an open section with three walls and an eccentric shear centre */
    PROFILES_MATRICES     /* matrices without zero entries */
} profiles_form;

enum {
    TEST_ELEMENT_STRAINS = ELEMENT_MAX_STRAINS,
    TEST_ELEMENT_COORDINATES = ELEMENT_MAX_COORDINATES,
    TEST_ELEMENT_INNER =
        1 << 10, /* largest number of inner unknowns of an element that is checked */
    TEST_ELEMENT_MEMORY = 1 << 13, /* number of doubles that stress passes to update */
    TEST_ELEMENT_WORDS = 160
};

/* Lengths in units of `unit` metres, and forces in newtons. */
typedef struct test_element_request {
    const element_type *given;
    const double *options;
    unsigned features;
    profiles_form form;
    double unit;
    double curvature[3]; /* [1/length] */
    double length;       /* 0: default length */
} test_element_request;

typedef struct test_element {
    element_type type; /* type completed by the adapters */
    test_element_request made;
    double options[FORMULATION_OPTIONS];
    section section;
    element_request request;
    element_data *data;
    size_t size;     /* size of `data` [bytes] */
    double *history; /* [values] of the undeformed state; NULL: none */
    int values;
    int nodes, scalars, strains, coordinates, inner, memory;
    double place[ELEMENT_MAX_NODES]; /* positions of the nodes, from 0 to 1 */
    char words[TEST_ELEMENT_WORDS];  /* text for messages: "" or " [option=value, section]" */
} test_element;

/* Makes an element of the type. REFUSED: the type rejects the section, the features or the options.
 * FAULT: a function of the type failed, the type declares more than the limits above, or out of
 * memory. Call test_element_free after a failure as well. */
status test_element_make(const test_element_request *, test_element *out, fault *f);
void test_element_free(test_element *s);
/* Returns 1 if the type computes forces with a history, which need not derive from an energy. */
int test_element_lacks_energy(const test_element *s);

void test_element_state(const test_element *s, double size, unsigned seed, node_state x[]);
/* Returns the unit of coordinate c (chart_unit). */
double test_element_unit(const test_element *s, int c);

typedef void checks_run(const formulation *chosen, check_results *out);

typedef struct checks_family {
    const char *name, *what;
    checks_run *run;
} checks_family;

enum { CHECKS_FAMILIES = 15 };
extern const checks_family checks_families[CHECKS_FAMILIES];

typedef void measured_run(const formulation *chosen, check_results *, measures *out);

typedef struct measured_group {
    const char *name, *what;
    measured_run *run;
} measured_group;

enum { MEASURED_GROUPS = 4 };
extern const measured_group measured_groups[MEASURED_GROUPS];

enum { CERTIFICATE_PARTS = CHECKS_FAMILIES + MEASURED_GROUPS };

typedef struct certificate_part {
    check_results check_results;
    measures measures;
} certificate_part;

typedef struct certificate {
    formulation chosen;
    certificate_part part[CERTIFICATE_PARTS];
    const char *late; /* first part that exceeded the time limit, after which no further part is
                         run; NULL: none */
    char hash[DIGEST_TEXT]; /* SHA-256 of the formulation's file; "": not requested */
} certificate;

typedef struct certificate_request {
    const formulation *chosen;   /* [count] */
    int count, jobs, time_limit; /* time_limit [s]: limit for a part; 0: none */
    int checks_only;             /* 1: no measurements */
    /* computes the hash; NULL: no hash */
    void (*hash)(const element_type *, char out[DIGEST_TEXT]);
} certificate_request;

/* Call certificate_free after a failure as well. */
status certificate_find(const certificate_request *, certificate **out, fault *f);
void certificate_free(certificate *all, int count);

/* Returns 1 if no check of the certificate has failed. */
int certificate_holds(const certificate *);

/* Records of certificates. */

/* Result of experiment_element_test. */
typedef struct certificates {
    certificate *all;          /* [count] */
    int count, verbose, quiet; /* verbose, quiet: see certificate_text */
} certificates;

/* The request is a certificate_request. The result is a `certificates`, whose list certificate_free
 * frees. */
extern const experiment_type experiment_element_test;

typedef struct convergence_request {
    const case_type *type;
    const double *parameter;
    const int *mesh; /* [meshes] numbers of elements */
    int meshes;
    double level; /* requested error */
    int verbose;  /* 1: every formulation is printed separately, with values and times */
    const char *const *imported; /* [importeds] stored results of other programs */
    int importeds;
    sweep_request cells;
} convergence_request;

typedef struct convergence {
    truths truths; /* read before planning */
    sweep sweep;
    evaluation evaluation;
    environment made;
    double level;
    int verbose;
} convergence;

extern const experiment_type experiment_converge;
void convergence_free(convergence *);

/* Groups consecutive items into batches with a total cost of at most `most`. An item with a higher
 * cost forms a batch alone. first[items + 1]: first item of each batch, followed by `items`.
 * Returns the number of batches. */
int batches_cut(int items, const double cost[], double most, int first[]);

/* Choice of parameter points: a grid over all axes, or points that fill the ranges of the axes. */

typedef enum design_kind { DESIGN_GRID, DESIGN_SOBOL, DESIGN_HALTON, DESIGN_RANDOM } design_kind;
#define DESIGN_CHOICES "grid|sobol|halton|random"

typedef struct design_mark {
    gsl_qrng *quasi;
    gsl_rng *random; /* generator of the sequence; one of the two members is NULL */
} design_mark;

typedef struct design {
    design_kind kind;
    int axes;
    const sweep_axis *axis; /* [axes]; not owned */
    long points;
    unsigned long seed; /* seed of GSL's generator mt19937, for DESIGN_RANDOM */
    long marks, stride;
    /* [marks] states at every `stride` points, from which any point can be computed in few steps */
    design_mark *mark;
} design;

/* Outcome of a formulation at an extreme. */

enum { OUTCOME_NEIGHBOURS = 2 };

typedef enum outcome_kind {
    OUTCOME_VALUE, /* accurate: the error is within the tolerance of the extreme */
    /* under-resolved: the error exceeds the tolerance, but decreases with more elements as a
     * discretisation error does */
    OUTCOME_COARSE,
    OUTCOME_WRONG, /* a number that is neither accurate nor under-resolved */
    OUTCOME_NOT_CONVERGED,
    OUTCOME_SINGULAR,
    OUTCOME_REFUSED,
    OUTCOME_NO_VALUE, /* the mesh does not have the requested mode, load or state */
    OUTCOME_FAULT,    /* a crash, or out of memory */
    OUTCOME_SKIP,     /* the formulation does not support a required feature */
    OUTCOME_KINDS
} outcome_kind;

typedef struct extreme_deviation {
    char *extreme, *formulation, *quantity, *outcome,
        *proof;      /* texts; the first three may contain the wildcards * and ? */
    double from, to; /* range of x, including both ends */
    int observed;
} extreme_deviation;

typedef struct extreme_outcome {
    int extreme, value, formulation, quantity;
    /* indices in the sweeps of the point, of the series, and of the series of the neighbouring
     * meshes; -1: none */
    int point, series, neighbours;
    outcome_kind kind;
    double x, result, reference, error; /* `error` is relative; NAN: there is no error */
    double neighbour_error[OUTCOME_NEIGHBOURS];
    const extreme_deviation *deviation;
    int as_expected;
    const char *reason;
} extreme_outcome;

const char *outcome_name(outcome_kind kind);

/* Counts for one formulation. A cell is an extreme at one value of x. The outcome of a cell is that
 * of its worst quantity. */
typedef struct extreme_count {
    const char *formulation; /* key of the formulation */
    int tried, survived, coarse, named, wrong, faults;
} extreme_count;

typedef struct extreme_sweep {
    int formulations, outcomes, deviations, unexpected, unobserved;
    /* number of unexpected outcomes of new formulations, which do not affect the exit status */
    int is_new;
    formulation *formulation;
    truths truths; /* exact values */
    sweep first, neighbours;
    extreme_outcome *outcome;
    extreme_deviation *deviation;
    extreme_count *count; /* [formulations] */
} extreme_sweep;

/* Returns the exit status: 0 if all outcomes are as expected, 1 if an outcome differs or a known
 * deviation is not observed, 3 if nothing was run. */
int extreme_sweep_exit(const extreme_sweep *s);
void extreme_sweep_free(extreme_sweep *s);

typedef struct extreme_request {
    const char *truths; /* path of the packed reference values */
    const char *select; /* expression that selects among "name/group/case/formulation"; NULL: all */
    int jobs, formulations;
    const formulation *formulation; /* [formulations] formulations to run; formulations 0: all */
    int named; /* 1: the user named the formulations, so their outcomes affect the exit status */
    FILE *progress;
} extreme_request;

/* For each extreme, a formulation must give a value with its error, or a rejection or failure with
 * a reason. */

/* The request is an extreme_request. The result is an extreme_sweep, which extreme_sweep_free
 * frees. */
extern const experiment_type experiment_stress;

enum { INTEGRATORS_LIST_MOST = 16 };

/* order of radau, which computes the reference */
enum { INTEGRATORS_METHOD_NAME = 32, INTEGRATORS_REFERENCE_ORDER = 5 };

typedef struct integrators_method {
    char name[INTEGRATORS_METHOD_NAME]; /* name of the method as given on the command line */
    scene_scheme scheme;
    scene_alpha alpha;
    int order;    /* order of accuracy in the time step, if all frequencies are resolved */
    int estimate; /* 1: the integrator estimates the error of every step */
} integrators_method;

/* Classification of a motion. */
typedef enum integrators_class {
    /* the motion is not classified, because loads or supports act until the end */
    INTEGRATORS_UNCLASSIFIED,
    INTEGRATORS_GROWS, /* the energy grows by more than integrators_growth */
    INTEGRATORS_STOPS, /* the equations of a step of this size have no solution */
    INTEGRATORS_BOUNDED,
    INTEGRATORS_EXACT, /* energy and momenta are conserved within integrators_energy and
                          integrators_momentum */
    INTEGRATORS_CLASSES
} integrators_class;

typedef struct integrators_run {
    int group, series; /* indices of the group, and of the series in the sweep */
    integrators_method method;
    double step, tolerance; /* [s] size of the first step, or of all steps if tolerance is 0 */
    /* status of the motion; after a failure, the values below are NAN */
    status status;
    const char *reason; /* owned by the sweep */
    /* largest error over all stations: positions relative to the size of the structure, or
     * rotations in rad */
    double error;
    double *values; /* [quantities] relative errors; owned by this structure */
    double order; /* observed order, from the errors of this run and of the previous run, whose step
                     is larger; NAN: none */
    double cost, seconds, iterations; /* [s] cost of the counted work, and measured time;
                                         iterations: number per step */
    long steps, rejected;
    double energy, momentum; /* largest relative errors of the energy balance and of the momenta */
    /* largest and last value of E/E0, where E0 is the energy E after the loads have ended */
    double largest, last;
    double stopped; /* [s] time at which the motion ended early */
    integrators_class motion_class;
} integrators_run;

typedef struct integrators_group {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    formulation formulation;
    int elements;
    int analysis;     /* index of the motion in the scene */
    double step, end; /* step size and end time in the scene [s] */
    double from; /* [s] time from which no load acts; INFINITY: there are supports, or a load acts
                    until the end */
    int first, runs; /* index of the first run, and number of runs, in the list of all runs */
    /* index of the series of the reference, after which its checks follow; -1: errors are not
     * requested */
    int reference;
    double uncertainty; /* uncertainty of the reference; NAN: none */
    double order; /* observed order of the reference, from the errors of its checks; NAN: none */
    char reason[FAULT_TEXT]; /* reason why there is no reference */
} integrators_group;

typedef struct integrators {
    sweep sweep;
    int groups, runs;
    integrators_group *group;
    integrators_run *run;
} integrators;

/* Verdicts on integrators, compared with a table of expected verdicts (expected.csv):
 *
 *   order pass, low order or undecided, from errors at decreasing steps (experiments_impl.h)
 *   energy conserved, "order P" of the energy-balance error at halved steps, or drifts
 *   momentum conserved, "order P" of the momentum error at halved steps, or drifts
 *   tolerance decimal logarithm of error/tolerance for each tolerance, compared within
 *              a factor of two
 *   fate outcome for each step size: grows, stops, bounded or exact (integrators_class) */

enum { INTEGRATORS_FOUND = 128 };

typedef enum integrators_criterion {
    INTEGRATORS_ORDER,
    INTEGRATORS_ENERGY_CONSERVED,
    INTEGRATORS_MOMENTUM_CONSERVED,
    INTEGRATORS_TOLERANCE,
    INTEGRATORS_CLASS,
    INTEGRATORS_CRITERIA
} integrators_criterion;

/* A row of the table, which owns its strings. */
typedef struct integrators_verdict {
    integrators_criterion kind;
    const char *criterion, *case_name, *parameters, *formulation, *integrator, *steps, *expected,
        *why;
    int elements;
    int group, first, count; /* indices of the runs to which the verdict applies */
    char found[INTEGRATORS_FOUND];
    int as_expected;
} integrators_verdict;

typedef struct integrators_verdicts {
    user_table table;
    int count, unexpected;
    integrators_verdict *verdict;
} integrators_verdicts;

typedef struct motion_request {
    const char *expected; /* table of expected verdicts, which replaces the members below */
    const case_type *type;
    const double *parameter;
    const char *vary; /* varied parameter, "NAME=A..B/N" or "NAME=A,B,C"; NULL: none */
    const formulation *formulation;
    int formulations, elements; /* elements: number per member; 0: number in the case */
    /* lists as given on the command line; NULL: default lists */
    const char *integrators, *steps, *tolerances;
    int conservation_only; /* 1: no reference is computed */
    int each;              /* 1: the text has a line for each motion as well as the verdicts */
    sweep_request cells;
} motion_request;

typedef struct motions {
    integrators integrators;
    integrators_verdicts verdicts;
    int each, methods;
    integrators_method method[INTEGRATORS_LIST_MOST]; /* methods of all rows of the table */
} motions;

extern const experiment_type experiment_motion;
void motions_free(motions *);

/* Kind of reference from which an error is computed. */
typedef enum rows_reference {
    ROWS_STORED,  /* a reference value stored for exactly this point */
    ROWS_DERIVED, /* a reference value computed for the point by a program of reference/derive */
    ROWS_LIMIT,   /* the limit of the meshes of a formulation with the same physics */
    ROWS_NONE,    /* there is no reference, because no limit is known accurately enough */
    /* there is no reference, because the limits of formulations differ by more than their
     * uncertainties */
    ROWS_DISPUTED,
    ROWS_REFERENCES
} rows_reference;

typedef struct rows_shape {
    int formulations, meshes, quantities;
} rows_shape;

/* Columns of `points` points, in one memory block. */
typedef struct rows {
    rows_shape shape;
    int points;
    size_t size;   /* size of the block [bytes] */
    double *first; /* the block; owned */
    /* [points, quantities] reference value and its relative uncertainty; NAN: none */
    double *reference, *uncertainty;
    double *value,
        *error; /* [points, formulations, meshes, quantities] relative error; NAN: none */
    /* [points, formulations, meshes] cost of the counted work, and measured time [s] */
    double *cost, *seconds;
    /* [points, formulations] bits of the omitted physics (model.h); 0: the formulation solves the
     * model of the scene. A formulation that solves another model is not counted. */
    int32_t *lacks;
    /* [points, formulations, quantities] smallest number of elements for which this mesh and all
     * finer meshes are within the tolerance; 0: none */
    int32_t *least;
    uint8_t *kind;   /* [points, quantities] values of rows_reference */
    uint8_t *status; /* [points, formulations, meshes] */
} rows;

/* A sweep over parameters. */

enum { RANGES_FORMULATIONS = 64, RANGES_QUANTITIES = 64 };

typedef struct ranges_request {
    const case_type *type;
    const scene_file *file; /* file of the case; NULL: a built-in case */
    const double *base;     /* values of all parameters; those that vary are ignored */
    int varies;
    const char *const *vary; /* [varies] arguments of --vary */
    design_kind design;
    long points; /* number of points, for all designs except grids */
    unsigned long seed;
    int formulations;
    const formulation *formulation; /* [formulations]; formulations 0: all that run the case */
    int meshes;
    const int *mesh;
    const char *select;
    double tolerance;   /* relative tolerance of the errors */
    int time_limit;     /* [s] time limit of a cell; 0: none */
    const char *derive; /* program of reference/derive that computes reference values; NULL: none */
    const truths *truths; /* stored reference values of a built-in case; NULL: none */
} ranges_request;

typedef struct ranges_quantity {
    char name[SCENE_NAME], unit[SCENE_UNIT];
} ranges_quantity;

enum { RANGES_ASSUMED = 2048 };
typedef struct parameter_ranges {
    ranges_request request;
    double base[CASE_MAX_PARAMETERS];
    sweep_axis axis[CASE_MAX_PARAMETERS];
    design design;
    int formulations, meshes, quantities;
    formulation formulation[RANGES_FORMULATIONS];
    int mesh[SERIES_MAX_MESHES]; /* ascending */
    ranges_quantity quantity[RANGES_QUANTITIES];
    char left_out[FAULT_TEXT];
    char omitted[SCENE_OMISSION_WORDS];
    /* assumptions on the sections (harness/records/records.h), at the first point that was
     * examined */
    char assumed[RANGES_ASSUMED];
    long points_in_batch; /* number of points in each batch except the last */
    int batches;
    double point_cost; /* [s] estimated cost of all cells of a point */
} parameter_ranges;

/* Plans the sweep without solving anything. REFUSED: the message names the invalid part and the
 * remedy. Call ranges_free after a failure as well. The request must outlive the result. */
status ranges_make(const ranges_request *request, parameter_ranges *out, fault *f);
void ranges_free(parameter_ranges *);
rows_shape ranges_shape(const parameter_ranges *);

typedef struct shard_request {
    int index, count; /* index of the shard, starting at 0, and number of shards */
    const char *into; /* folder of the batches; created if necessary */
    int jobs;         /* number of processes, >= 1 */
    int stop;       /* file descriptor that becomes readable to stop the run; 0: the signals SIGINT,
                       SIGTERM and SIGHUP stop the run */
    FILE *progress; /* NULL: quiet */
    FILE *messages; /* receives messages about damaged or lost batches; NULL: none */
} shard_request;

typedef struct shard_outcome {
    int mine;        /* number of batches of the shard */
    int before;      /* number of batches of the shard that existed before the run */
    int done;        /* number of batches computed in this run */
    int lost;        /* number of batches whose process ended early */
    int interrupted; /* 1: the run was interrupted */
    double seconds;  /* [s] sum of the run times of the batches computed in this run */
} shard_outcome;

/* Reads "2/4" as index 1 and count 4. REFUSED: any other format. */
status shard_parse(const char *text, int *index, int *count, fault *f);
/* Computes the missing batches in decreasing order of cost. REFUSED: the folder contains batches of
 * another work. FAULT: a disk error, a failed batch, or out of memory. */
status shard_run(const shard_work *w, const shard_request *request, shard_outcome *out, fault *f);

/* Lists all cases if `cases` is 1, and all formulations with the features that they support if
 * `formulations` is 1. */
status list_json_all(FILE *to, int cases, int formulations, fault *f);
/* Lists a case at given values of its parameters: these values, the quantities, and the
 * formulations that run the case. */
status list_json_case(FILE *to, const case_type *type, const double value[], fault *f);
status list_json_formulation(FILE *to, const formulation *chosen, const rule *rules, int count,
                             fault *f);

typedef struct list_subject {
    int cases, formulations; /* 1: all of them */
    const case_type *type;   /* one case */
    formulation chosen;      /* a formulation, possibly with options; type NULL: none */
} list_subject;

/* Finds the subject of a list. name: "cases", "formulations", or the name of a case or formulation;
 * NULL: everything. REFUSED: the name is unknown; the message suggests the most similar name. */
status list_subject_find(const char *name, list_subject *out, fault *f);

typedef struct batch_store_kind {
    machine node; /* the first machine of this kind */
    int batches;
} batch_store_kind;

typedef struct batch_store {
    int batches;
    const char *const *folder; /* owned by the caller */
    int folders;
    char stem[BATCH_STEM];
    int *where; /* [batches] index of the folder that contains the batch, or -1 */
    int there, damaged, twice;
    /* number of shards, if it is the same for all existing batches; otherwise 0 */
    int shards;
    double seconds;
    int kinds; /* number of kinds of machines */
    batch_store_kind *kind;
} batch_store;

/* Reads and checks every byte of the requested batches (wanted NULL: all). If two folders contain
 * the same batch, the first folder is used. A damaged batch counts as missing and is reported to
 * the stream (may be NULL) in one line. REFUSED: the message gives the reason, for example that two
 * versions of a batch differ. FAULT: a folder cannot be read. Call batch_store_free after a failure
 * as well. */
status batch_store_read(const shard_work *w, const char *const folder[], int folders,
                        const char *wanted, FILE *messages, batch_store *out, fault *f);
void batch_store_free(batch_store *);
/* Writes "3 of 149 batches are missing: 3, 7-12 (shards 2/4, 3/4)", or an empty text if none is
 * missing. */
void batch_store_missing(const batch_store *, const shard_work *, char *out, size_t size);
/* Writes a line for each kind of machine if there are several. */
void batch_store_print_kinds(const batch_store *, FILE *to);
/* Reads the label of the first readable batch of a folder, in the order of names. The verb `merge`
 * repeats the request of this batch. REFUSED: the folder has no readable batch. */
status batch_store_first(const char *folder, batch_label *out, fault *f);

/* Reads every existing batch. s: result of batch_store_read. FAULT: a batch can no longer be read.
 */
status merge_read(const shard_work *w, const batch_store *s, fault *f);

enum { MESHES_FINEST = 10000000 };

/* Appends the numbers of a list such as "1,2,4" to mesh[most] and updates their number *count.
 * REFUSED: the list is invalid or too long. Items are integers from 1 to MESHES_FINEST. */
status meshes_parse(const char *list, int most, int mesh[], int *count, fault *f);

enum { TALLY_WORST = 3, TALLY_COLUMNS = 10, TALLY_ROWS = 12, TALLY_SCENE = 64 };

typedef struct tally_worst {
    long point;
    int quantity;            /* index of the quantity; -1: the cell has no solution */
    int status;              /* status of the cell */
    double error;            /* relative error; NAN: no value */
    char scene[TALLY_SCENE]; /* name of the scene file of the point; empty: not stored */
} tally_worst;

/* Counts of a formulation for one quantity, or for all quantities together. */
typedef struct tally_series {
    long requested; /* number of points with a reference */
    long proven;    /* number of points whose reference is a reference value */
    long open;      /* number of points with a value but without a reference */
    /* for each mesh: number of points of `requested` that are within the tolerance */
    long within[SERIES_MAX_MESHES];
    /* number of points of `requested` where even the finest mesh is not within the tolerance */
    long never;
    /* smallest number of elements such that this mesh and all finer meshes are within the tolerance
     * at all points of `requested` */
    int everywhere;
} tally_series;

/* A field of the map: it covers a range of each axis. */
typedef struct tally_place {
    /* numbers of points in the field: all points; `other`: points where the formulation solves
     * another model; `requested`: points with a reference; `never`: points of `requested` where
     * even the finest mesh is not within the tolerance */
    long points, other, requested, never;
    long proven; /* number of points of `requested` whose reference is a reference value */
    /* smallest number of elements such that this mesh and all finer meshes are within the tolerance
     * at all points of the field */
    int least;
} tally_place;

typedef struct tally {
    const parameter_ranges *of;
    long points, without_scene,
        first_without; /* first_without: index of the first point without a scene */
    long kind[RANGES_QUANTITIES][ROWS_REFERENCES];
    double uncertainty[RANGES_QUANTITIES]; /* largest relative uncertainty of a reference */
    /* numbers of columns and lines of the map; 0: there are more than two axes */
    int columns, lines;
    /* [formulations x (quantities + 1)]; the last entry of a formulation is for all quantities
     * together */
    tally_series *series;
    tally_place *map;       /* [formulations x (quantities + 1) x lines x columns] */
    long *failed;           /* [formulations x meshes] number of cells without a solution */
    double *cost, *seconds; /* [formulations x meshes] sums over all cells that ran [s] */
    long *ran;              /* [formulations x meshes] number of cells that ran */
    /* number of points where the formulation solves another model; no other count includes these
     * points */
    long others[RANGES_FORMULATIONS];
    unsigned lacks[RANGES_FORMULATIONS]; /* bits (model.h) of the physics omitted at these points */
    int worsts[RANGES_FORMULATIONS];
    /* the worst points in decreasing order of error */
    tally_worst worst[RANGES_FORMULATIONS][TALLY_WORST];
} tally;

/* Allocates and clears the counts. FAULT: out of memory. Call tally_free after a failure as
 * well. */
status tally_alloc(const parameter_ranges *r, tally *out, fault *f);
void tally_free(tally *);

enum { RANGES_FILE_VERSION = 1, RANGES_FILE_COLUMNS = 11 };

typedef struct ranges_file {
    const parameter_ranges *of;
    const char *path;
    record_file record;
    hid_t at; /* group of the sweep */
    hid_t column[RANGES_FILE_COLUMNS];
} ranges_file;

typedef struct ranges_work {
    const parameter_ranges *of;
    double *cost;      /* [batches] */
    tally *tally;      /* counts of the batches that have been read */
    ranges_file *file; /* file to which the batches are written; NULL: none */
    FILE *csv;         /* CSV output; NULL: none */
    int csv_begun;     /* 1: the header has been written */
    digest content;    /* digest of all values read, except times */
} ranges_work;

typedef struct range_sweep_request {
    ranges_request of;
    const char *output; /* path of the HDF5 file; NULL: none */
    int partial;
    int jobs, verbose, quiet;
    FILE *progress, *csv; /* NULL: none */
    /* Reads the batches; NULL: this process computes them. NO_VALUE: there is nothing to
     * evaluate. */
    status (*take)(void *context, const shard_work *, fault *f);
    void *context;
} range_sweep_request;

typedef struct range_sweep {
    const range_sweep_request *requested;
    truths truths; /* read before planning */
    parameter_ranges ranges;
    ranges_work work;
    shard_work all;
    const char *output;
    char partial[PATH_MAX]; /* name of the output, used if batches are missing */
    char worst[PATH_MAX];   /* folder for the scenes of the worst points; empty: none */
    char batches[PATH_MAX]; /* folder of the batches */
    int lost;               /* number of missing batches if this process computes them */
    int evaluated;          /* 1: all batches have been read */
    tally tally;
    ranges_file file;
} range_sweep;

extern const experiment_type experiment_sweep;
void range_sweep_free(range_sweep *);

/* Adds the points, formulations, meshes, quantities and the division into batches to the digest. */
void ranges_identity_add(const parameter_ranges *r, digest *plan);

/* Writes the header of the table: the numbers of points and cells, and the axes. */
void ranges_table_head(FILE *to, const parameter_ranges *r);

/* Adds three kinds of deviations to the evaluation: meshes whose error is larger than in the
 * previous run (by more than 2 % and RESULTS_FLOOR), or whose value or solution is now missing;
 * series of the previous run that are missing although this run should contain them; and limits at
 * default points with a relative change above 1e-5, unless an exact reference value checks them as
 * closely. If only the short table of the previous run is known, errors are compared by series.
 * REFUSED: the two runs have nothing in common. */
status regressions_find(const stored_results *former, const char *name, const sweep *, evaluation *,
                        fault *);

typedef struct solution_request {
    const case_type *type;
    const double *parameter; /* parameters of the case */
    const char *select;      /* selected quantities, as in harness/study/study.h; NULL: all */
    formulation formulation; /* formulation; type NULL: a default is chosen */
    int elements;            /* number of elements per member; 0: a default is chosen */
    int keep_all, steps, shapes, threads;
    int skips_stability; /* 1: flutter is not sought along static paths */
    int keep_ends;       /* 1: the final states of motions are stored */
    int restarts;
    const outcome_end *restart; /* [restarts] states from which motions continue; NULL: none */
    int systems;                /* meaning: see solve_options */
    const char *reduce;
    /* largest relative change of a value between two meshes that counts as converged; 0: default */
    double error;
} solution_request;

/* Reasons for the chosen values, in one line each; "": the request contains the value. */
typedef struct solution_choice {
    char formulation[FAULT_TEXT], elements[FAULT_TEXT];
    /* [quantities] relative change from the previous mesh; NULL: the request gave the number of
     * elements */
    double *change;
    int short_of; /* 1: the requested error was not reached */
} solution_choice;
void solution_choice_free(solution_choice *);

/* Chooses the formulation (harness/study/study.h) and, if `elements` is 1, the number of elements.
 * rules NULL: no list of known deviations. REFUSED: no formulation supports all features that the
 * case requires. Call solution_choice_free after a failure as well. */
status solution_choose(solution_request *, const rule *rules, int count, int elements,
                       solution_choice *why, fault *f);
/* Plans one point, series and mesh with the selected quantities, without solving anything. REFUSED:
 * the parameters are rejected, or the selection is malformed, contains an unknown name, or selects
 * no quantity. Call sweep_free after a failure as well. */
status solution_plan(const solution_request *, sweep *, fault *);
/* Solves the cell in this process. REFUSED and FAULT are returned; any other cell without a
 * solution counts as a result. NOT_CONVERGED: the chosen mesh does not reach the requested
 * error. */
status solution_run(const solution_request *, const solution_choice *, sweep *, fault *);

/* Final states of motions in a file, from which another run continues. */

typedef struct restart {
    char formulation[FORMULATION_KEY]; /* formulation with its options */
    int elements, keep_all;
    char *scene; /* text of the scene file, without the parts that may differ */
    int ends;
    outcome_end *end;
} restart;

/* Checks before the solution that final states can be stored. REFUSED: the scene has no motion, or
 * a load has integral feedback, whose integral is not stored. */
status restart_possible(const scene *, fault *);
/* Writes the final states of the solved motions to a file, with their scene, formulation and mesh.
 * REFUSED: the scene cannot be written as a scene file. The file has a temporary name until it is
 * complete. */
status restart_write(const char *path, const solution_request *, const sweep *, fault *);
/* Reads a file of final states. FAULT: the file is missing, damaged or of another kind. Call
 * restart_free after a failure as well. */
status restart_read(const char *path, restart *, fault *);
void restart_free(restart *);
/* Prepares the scene for continuation: removes the stations before the stored state. REFUSED: the
 * stored state does not belong to this request, or there is no later station. */
status restart_begin(restart *, solution_request *, scene *, fault *);

enum { RUNS_ON_WORDS = 200 };

typedef struct runs_on {
    const char *name; /* name of the case or the formulation */
    int runs;
    int other;                 /* 1: the formulation solves another model (harness/study/study.h) */
    char words[RUNS_ON_WORDS]; /* if the formulation runs: the physics that it omits; otherwise: the
                                  missing features */
} runs_on;

void runs_on_scene(const scene *s, const element_type *type, runs_on *out);
/* Lists at most `room` built-in cases at their default parameters, and returns their number.
 * `other` is always 0. */
int runs_on_cases(const element_type *type, runs_on out[], int room);

/* Binds this process to the processor on which it runs, so that the times of repetitions are
 * comparable. */
void rounds_pin(void);
/* Restarts the program with one thread, because libraries set their number of threads when they are
 * loaded. arguments: NULL-terminated. */
void rounds_single_thread(char **arguments);

typedef struct verification_reader {
    void *context;
    /* Called once per case, after its last series has been evaluated. In an interrupted run, only
     * called for the cases before the interruption. */
    void (*evaluated)(void *context, const case_type *);
} verification_reader;

/* First checks that formulations named or loaded by the user satisfy the interface requirements.
 * Then runs a planned sweep (study.h), and evaluates the series in order, as soon as all series of
 * their point are complete. Call evaluation_free after a failure as well. */
status verification_run(const sweep_request *, int whole, const verification_reader *reader,
                        truths *, sweep *, evaluation *out, fault *);

/* Runs all cells of a planned sweep, or of some series, and measures the scatter. */
status verification_cells(const sweep_request *, truths *, sweep *, fault *);

typedef struct verification_files {
    const char *output, *json, *junit, *markdown, *propose; /* paths, set by the caller; NULL:
                                                               none */
    const sweep *sweep;
    const evaluation *evaluated;
    store store;    /* results file, open if it was requested */
    json_part part; /* JSON written so far, if it was requested */
    int open;
} verification_files;

typedef struct verification_request {
    sweep_request cells;
    int whole; /* 1: no selection was made */
    int taken; /* 1: the cells were read from batches, and none is run */
    /* [importeds] paths of stored results of other programs, to be compared */
    const char *const *imported;
    int importeds;
    int imported_must_pass;
    const char *former;    /* name of the file `verification.former` in messages; NULL: none */
    const char *processor; /* processor that computed the batches; "": this processor */
    int exit_zero, verbose, quiet;
} verification_request;

typedef struct verification {
    const verification_request *requested;
    truths truths; /* read before planning */
    /* results of the previous run, with which this run is compared */
    stored_results former;
    verification_files *files; /* owned by the caller */
    double begun;              /* [s] clock_wall_seconds at the start */
    sweep sweep;
    evaluation evaluation;
    overview overview;
} verification;

extern const experiment_type experiment_verify;
void verification_free(verification *);

#endif
