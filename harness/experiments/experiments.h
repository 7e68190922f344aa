/* experiments/: verification, sweeps, extremes, comparison of integrators, certificates of
 * elements, shards.
 *
 * Sections, in this order: against (two in alternation); batches; measures; experiment;
 * bench; checks of elements and certificates; convergence; design; extremes; integrators
 * (pace); sweeps (ranges); shard; list; stock; merge; meshes; tally; sweep files and tables;
 * regressions; solution; restart; runs_on; timing; verification. */
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

/* Compares two formulations or programs that run in alternation. The outcome is that one of them
 * is slower, or that the scatter is too large to decide. A drift of the machine affects both
 * equally. */

typedef enum against_outcome { AGAINST_UNDECIDED, AGAINST_FASTER, AGAINST_SLOWER } against_outcome;

typedef struct contest_clock {
    int pairs;
    double a, b; /* [s] shortest lap of each */
    /* median of b/a over the pairs, and its distribution-free 99.9 % confidence interval */
    double ratio, low, high;
    /* result for b relative to a; ratios within 2 % of 1 are undecided, because a different code
     * layout can cause differences of this size */
    against_outcome outcome;
} contest_clock;

const char *against_name(against_outcome);

/* Runs one lap of one of the two programs or formulations; *seconds: its time. */
typedef status against_lap(void *contestant, double *seconds, fault *f);
/* Runs as many pairs of laps as fit into `budget` [s], but at least 51. Their number is fixed
 * before the first counted pair. */
status against_run(against_lap *lap, void *a, void *b, double budget, contest_clock *out, fault *f);

typedef enum axis_kind { AXIS_LINEAR, AXIS_LOG, AXIS_LIST, AXIS_WORDS } axis_kind;

typedef struct sweep_axis {
    const parameter_type *of;
    int index; /* index of the parameter in the case */
    axis_kind kind;
    double from, to; /* ends of the range, for AXIS_LINEAR and AXIS_LOG */
    int count;       /* number of values; 0: a range that is not divided into parts */
    double *value;   /* [count] for AXIS_LIST and AXIS_WORDS; owned */
} sweep_axis;

/* The machine that computes a batch: times depend on it, and the last digits of results may too. */

typedef struct machine {
    char host[128], processor[128];
    char blas[256]; /* BLAS library, and its kernels for this processor */
} machine;

/* Work that can be cut into batches. A verb supplies these functions; a batch need not consist
 * of cells. */

/* The batches depend only on the request and the build, so independent processes make the same
 * batches. */
typedef struct shard_work {
    const char *verb;
    /* One line each: the program, the request, and everything that the results depend on.
     * Batches belong to the same work if all three lines are equal. */
    const char *build, *request, *plan;
    const char *origin; /* JSON object with the data that merge needs to repeat the request; it is
                           not compared */
    int batches;
    const double *cost; /* [batches] estimated time [s] */
    void *context;
    /* Computes a batch and writes its results as bytes that another process of this build can
     * read. *content: digest of all values that must be equal when the batch is computed again;
     * times and names of machines are excluded. Runs in its own process and frees its memory. */
    status (*run)(void *context, int batch, FILE *to, digest *content, fault *f);
    /* Reads the results of a batch. Called in canonical order, once per batch. FAULT: the batch
     * cannot be read. */
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

/* Reads only the label and does not check the results. */
status batch_read_label(const char *path, batch_label *out, fault *f);
void batch_label_free(batch_label *);

/* Measured properties of a formulation, independent of what it declares: errors over meshes and
 * over thicknesses, and orders. Plain data of fixed size, for memory that processes share. */

enum { MEASURE_POINTS = 12, MEASURES_MOST = 16, MEASURE_NAME = 64, MEASURE_WORDS = 200 };

typedef struct element_measure {
    char name[MEASURE_NAME];
    int points;
    double at[MEASURE_POINTS];    /* numbers of elements, or thickness/length */
    double error[MEASURE_POINTS]; /* relative to the exact value; NAN: none */
    double order;       /* observed order of the errors; NAN: not requested, or none observed */
    int least, highest; /* orders that the type declares; 0: not requested */
    int locks;          /* 1: shear or membrane locking: the errors increase as the element becomes
                           thinner */
    int astray; /* 1: wrong limit: in a linear state, the error on every mesh is the same as with
                   one element */
    char words[MEASURE_WORDS]; /* reason why there are no values, or a conclusion */
} element_measure;

typedef struct measures {
    int count;
    element_measure measure[MEASURES_MOST];
    char words[MEASURE_WORDS]; /* text that applies to all measures; "": none */
} measures;

/* An experiment has three steps: it is planned, run and evaluated. One function then writes the
 * results of any experiment in the requested form. The results are either tables of records,
 * from which the group in the results file, JSON and CSV are written, or the cells of a sweep
 * with their verdicts. */

typedef struct experiment_cells {
    const sweep *sweep;
    const judgement *judged;
    const environment *made;
} experiment_cells;

typedef struct experiment_type {
    const char *name; /* name of the group in the results file */
    /* Steps of the experiment, called one after the other; NULL: no such step. asked: the
     * request; found: the results, passed from one function to the next. */
    status (*plan)(const void *asked, void *found, fault *f);
    status (*run)(const void *asked, void *found, fault *f);
    status (*judge)(const void *asked, void *found, fault *f);
    /* Tables of results, NULL-terminated. NULL: the results are cells. */
    const record_type *const *records;
    const record_type *about; /* one record for the whole run; NULL: none */
    const record_type *rows;  /* record type that CSV shows; NULL: no CSV */
    /* Adds the records of that type, taken from the results. */
    void (*gather)(const void *found, const record_type *type, subjects *out);
    void (*print)(FILE *to, const void *found); /* prints the results as text */
    /* For experiments with cells: access to the cells, and all output forms. */
    experiment_cells (*cells)(const void *found);
    status (*write)(FILE *to, const char *format, const void *found, fault *f);
} experiment_type;

typedef struct experiment_output {
    const char *results; /* file that receives the group; groups of other experiments in the file
                            are kept; NULL: none */
    const char *text, *format; /* path of the output, NULL: standard output; its format: "text",
                                  "csv" or "json" */
    const char *json;          /* additional JSON file; NULL: none */
} experiment_output;

/* Returns the output for the values of -o, --format and --json. A path that ends in .h5 or .hdf5
 * is a results file. */
experiment_output experiment_output_of(const char *path, const char *format, const char *json);

status experiment_plan(const experiment_type *, const void *asked, void *found, fault *f);
/* Runs an experiment that has been planned. */
status experiment_run(const experiment_type *, const void *asked, const experiment_output *,
                      void *found, fault *f);
/* Plans and runs the experiment. */
status experiment_do(const experiment_type *, const void *asked, const experiment_output *,
                     void *found, fault *f);

/* Error against run time: every formulation and mesh of the cases, timed in rounds on one
 * processor. */

typedef struct bench_request {
    const char *const *cases; /* [count] names of the cases; 0: all cases that have a reference
                                 value */
    const case_type *scene;   /* scene file that replaces the cases; NULL: none */
    int count;
    const char *const *assignment; /* [assignments] "NAME=VALUE", applied to each case */
    int assignments, meshes;       /* number of meshes; 0: those of the case */
    const int *mesh;
    sweep_request cells;
    int threads, dense; /* dense 1: the published algorithm is timed as well */
} bench_request;

typedef struct bench {
    truths truths; /* read before planning */
    sweep sweep;
    judgement judgement;
    environment made;
    int named; /* 1: cases were named, so more is shown for each case */
} bench;

extern const experiment_type experiment_bench;
void bench_free(bench *);

/* A check of a formulation: its deviation from a requirement, and how to correct it. Plain data
 * of fixed size, for memory that processes share. */

enum { CLAIM_NAME = 64, CLAIM_SENTENCE = 400, CLAIMS_MOST = 48 };

typedef enum claim_outcome {
    CLAIM_HOLDS,
    CLAIM_BROKEN,
    CLAIM_NOT_CLAIMED, /* the type does not declare the property, or leaves it to other
                          functions; `sentence` gives the reason */
    CLAIM_OUTCOMES
} claim_outcome;

typedef struct claim {
    char name[CLAIM_NAME];
    claim_outcome outcome;
    int compared;          /* number of comparisons or yes/no questions */
    double worst, allowed; /* largest deviation, dimensionless (INFINITY: the answer to a question
                              is no), and allowed deviation */
    char sentence[CLAIM_SENTENCE]; /* describes the worst deviation that is not allowed */
} claim;

/* Checks of one family. */
typedef struct claims {
    int count;
    claim claim[CLAIMS_MOST];
    char doing[CLAIM_SENTENCE]; /* description of the present call, for reports of crashes and
                                   time limits */
    int complete;               /* 1: all checks have been made */
} claims;

/* Sections of the elements under test. */

typedef enum profiles_form {
    PROFILES_RECTANGLE,   /* supported by every formulation */
    PROFILES_UNSYMMETRIC, /* an open section of three walls with eccentric shear centre */
    PROFILES_MATRICES     /* matrices in which every entry matters */
} profiles_form;

/* One element under test: its section, options and features, states of its nodes, and calls of
 * its functions. */

enum {
    SPECIMEN_STRAINS = ELEMENT_MAX_STRAINS,
    SPECIMEN_COORDINATES = ELEMENT_MAX_COORDINATES,
    SPECIMEN_INNER = 1 << 10,  /* largest number of inner unknowns that is checked */
    SPECIMEN_MEMORY = 1 << 13, /* number of doubles that stress passes to update */
    SPECIMEN_WORDS = 160
};

/* Lengths in units of `unit` metres; force in newtons. */
typedef struct specimen_request {
    const element_type *given;
    const double *options;
    unsigned features;
    profiles_form form;
    double unit;
    double curvature[3]; /* [1/length] */
    double length;       /* 0: default length */
} specimen_request;

typedef struct specimen {
    element_type type; /* type completed by the adapters */
    specimen_request made;
    double options[FORMULATION_OPTIONS];
    section section;
    element_request request;
    element_data *data;
    size_t size; /* size of `data` [bytes] */
    int nodes, strains, coordinates, inner, memory;
    char words[SPECIMEN_WORDS]; /* "" or ", with option=value, section", for messages */
} specimen;

/* Returns the status that the type returns, for example STATUS_REFUSED. Call specimen_free in
 * any case. */
status specimen_make(const specimen_request *, specimen *out, fault *f);
void specimen_free(specimen *s);

/* Computes the nodes of the undeformed element, displaced by random numbers times `size` (in
 * units of length, radians and 1/length). */
void specimen_state(const specimen *s, double size, unsigned seed, node_state x[]);

typedef void checks_run(const formulation *chosen, claims *out);

typedef struct checks_family {
    const char *name, *what; /* name: one word; what: one line with the requirement */
    checks_run *run;
} checks_family;

enum { CHECKS_FAMILIES = 14 };
extern const checks_family checks_families[CHECKS_FAMILIES];

/* Measurements made for every formulation, in groups. */

typedef void measured_run(const formulation *chosen, claims *, measures *out);

typedef struct measured_group {
    const char *name, *what; /* name: one word; what: one line that explains the numbers */
    measured_run *run;
} measured_group;

enum { MEASURED_GROUPS = 3 };
extern const measured_group measured_groups[MEASURED_GROUPS];

/* Certificate of a formulation: whether it satisfies the interface requirements, and its
 * measured properties. Each part runs in its own process. If a part crashes, hangs or corrupts
 * its memory, this is reported as its result, and the other parts continue. */

enum { CERTIFICATE_PARTS = CHECKS_FAMILIES + MEASURED_GROUPS };

/* One part: its checks and, for a part with measurements, the measures. */
typedef struct certificate_part {
    claims claims;
    measures measures;
} certificate_part;

typedef struct certificate {
    formulation chosen;
    certificate_part part[CERTIFICATE_PARTS];
    const char
        *late; /* first part that exceeded the time limit; NULL: none. Later parts are not run */
    char hash[DIGEST_TEXT]; /* SHA-256 of the formulation's file; "": not requested */
} certificate;

typedef struct certificate_request {
    const formulation *chosen;   /* [count] */
    int count, jobs, time_limit; /* time_limit [s]: limit for one part; 0: none */
    int contract_only;           /* 1: no measurements */
    void (*hash)(const element_type *, char out[DIGEST_TEXT]); /* computes the hash; NULL: no
                                                                  hash */
} certificate_request;

/* Call certificates_free in any case. */
status certificate_find(const certificate_request *, certificate **out, fault *f);
void certificate_free(certificate *all, int count);

/* Returns 1 when no check of the certificate has failed. */
int certificate_holds(const certificate *);

/* Records of certificates. */

/* Result of experiment_element_test. */
typedef struct certificates {
    certificate *all;          /* [count] */
    int count, verbose, quiet; /* verbose, quiet: see certificate_text */
} certificates;

/* Request: a certificate_request; result: certificates, to be freed by certificates_free. */
extern const experiment_type experiment_element_test;

/* One case with several formulations on several meshes: errors, orders, limits. */

typedef struct convergence_request {
    const case_type *type;
    const double *parameter;
    const int *mesh; /* [meshes] numbers of elements; meshes 0: those of the case */
    int meshes;
    double level; /* requested error */
    int verbose;  /* 1: each formulation is printed separately, with values and times */
    sweep_request cells;
} convergence_request;

typedef struct convergence {
    truths truths; /* read before planning */
    sweep sweep;
    judgement judgement;
    environment made;
    double level;
    int verbose;
} convergence;

extern const experiment_type experiment_converge;
void convergence_free(convergence *);

/* Groups consecutive items into batches with a total cost of at most `most` each. A more
 * expensive item forms its own batch. first[items + 1]: first item of each batch, followed by
 * `items`. Returns the number of batches. */
int deal_cut(int items, const double cost[], double most, int first[]);

/* Choice of parameter points: a grid over all axes, or points that fill the box of the axes. */

typedef enum design_kind { DESIGN_GRID, DESIGN_SOBOL, DESIGN_HALTON, DESIGN_RANDOM } design_kind;
/* Words of --design, in the order of design_kind. */
#define DESIGN_CHOICES "grid|sobol|halton|random"

/* State of a sequence of points after a given number of points. */
typedef struct design_mark {
    gsl_qrng *quasi;
    gsl_rng *random; /* generator of the sequence; one of the two is NULL */
} design_mark;

typedef struct design {
    design_kind kind;
    int axes;
    const sweep_axis *axis; /* [axes]; not owned */
    long points;            /* number of all points */
    unsigned long seed;     /* for DESIGN_RANDOM: mt19937 of GSL */
    long marks, stride;
    design_mark *mark; /* [marks] states after every `stride` points, from which any point is found
                          quickly */
} design;

/* Outcome of a formulation at an extreme, and expected outcomes that are not accurate. */

enum { OUTCOME_NEIGHBOURS = 2 };

typedef enum outcome_kind {
    OUTCOME_VALUE,  /* accurate: within the extreme's tolerance */
    OUTCOME_COARSE, /* under-resolved: outside the tolerance, but the error decreases with more
                       elements, as a discretisation error does */
    OUTCOME_WRONG,  /* a number that is neither accurate nor under-resolved */
    OUTCOME_NOT_CONVERGED,
    OUTCOME_SINGULAR,
    OUTCOME_REFUSED,
    OUTCOME_NO_VALUE, /* the mesh does not have the requested mode, load or state */
    OUTCOME_FAULT,    /* crash, or out of memory */
    OUTCOME_SKIP,     /* the formulation does not support a required feature */
    OUTCOME_KINDS
} outcome_kind;

/* Expected outcomes that are neither accurate nor under-resolved (reference/extreme_findings.csv).
 */
typedef struct extreme_finding {
    char *extreme, *formulation, *quantity, *outcome,
        *proof;      /* texts; the first three may contain * and ? */
    double from, to; /* range of x, including both ends */
    int observed;
} extreme_finding;

typedef struct extreme_outcome {
    /* Indices: extreme, its value, formulation, quantity. */
    int extreme, value, formulation, quantity;
    int point, series, neighbours; /* in the sweeps: the point and series, and the series of the
                                      other meshes; -1: none */
    outcome_kind kind;
    double x, result, reference, error; /* NAN: none; the error is relative */
    /* Errors on the other meshes; NAN: not needed, or there is no value. */
    double neighbour_error[OUTCOME_NEIGHBOURS];
    const extreme_finding *finding;
    int as_expected;
    const char *reason;
} extreme_outcome;

const char *outcome_name(outcome_kind kind);

/* Every formulation at every extreme: cells, outcomes and counts. */

/* Counts for one formulation. A cell is an extreme at one value of x, and counts as its worst
 * quantity. */
typedef struct extreme_count {
    const char *formulation; /* key of the formulation */
    int tried, survived, coarse, named, wrong, faults;
} extreme_count;

typedef struct extreme_sweep {
    int formulations, outcomes, findings, unexpected, unobserved;
    int is_new; /* number of outcomes of new formulations that would need a known deviation; they do
                   not affect the exit status */
    formulation *formulation;
    truths truths; /* exact values */
    sweep first, neighbours;
    extreme_outcome *outcome;
    extreme_finding *finding;
    extreme_count *count; /* [formulations] */
} extreme_sweep;

/* Returns the exit status: 0 if all outcomes are as expected, 1 if an outcome differs, 3 if
 * nothing was run. */
int extreme_sweep_exit(const extreme_sweep *s);
void extreme_sweep_free(extreme_sweep *s);

/* Request for a sweep of extremes. */

typedef struct extreme_request {
    const char *truths; /* path of the packed reference values */
    const char *select; /* expression over "name/group/case/formulation", or NULL */
    int jobs, formulations;
    const formulation *formulation; /* [formulations] only these formulations; formulations 0:
                                       all */
    int named; /* 1: the user named the formulations, so their outcomes affect the exit status */
    FILE *progress;
} extreme_request;

/* At every extreme each formulation must give a value with its error, or a rejection or failure
 * with a reason, but never a wrong number without notice. */

/* Request: an extreme_request; result: an extreme_sweep, to be freed by extreme_sweep_free. */
extern const experiment_type experiment_stress;

enum { PACE_LIST_MOST = 16 };

/* Names of integrators on a command line. */

enum { PACE_METHOD_NAME = 32, PACE_REFERENCE_ORDER = 5 }; /* the reference is computed by radau */

typedef struct pace_method {
    char name[PACE_METHOD_NAME]; /* as given on the command line */
    scene_scheme scheme;
    scene_alpha alpha;
    int order;    /* order in time, for motions whose frequencies are resolved */
    int estimate; /* 1: the integrator estimates the error of a step */
} pace_method;

/* Comparison of integrators for transient analysis: cost of each step, and accuracy of the results.
 *
 * Errors are due to time integration only: the reference uses the same mesh. */

/* Classification of a motion. Without loads its energy and momenta must be conserved. */
typedef enum pace_fate {
    PACE_UNJUDGED, /* loads act on it; it is not classified */
    PACE_GROWS,    /* the energy grows by more than pace_growth */
    PACE_STOPS,    /* a step of this size has no solution */
    PACE_BOUNDED,
    PACE_EXACT, /* energy and momenta are conserved within pace_energy and pace_momentum */
    PACE_FATES
} pace_fate;

/* One motion, computed by an integrator with a step size or a tolerance. */
typedef struct pace_run {
    int group, series; /* indices in the sweep: a separate series and point with one mesh */
    pace_method method;
    double step,
        tolerance; /* [s] size of the first step, or of all fixed steps; tolerance 0: fixed steps */
    /* outcome of the motion; if the motion failed, the values below are NAN */
    status status;
    const char *reason; /* owned by the sweep */
    double error;       /* largest error over all stations: positions relative to the size of the
                           structure, rotations [rad] */
    double *values;     /* [quantities] relative errors; owned by this structure */
    double order;       /* observed order, from this run and the previous one, which has twice
                           the step size */
    double cost, seconds, iterations; /* [s] cost of the counted work, and measured time;
                                         iterations per step */
    long steps, rejected;
    double energy, momentum; /* largest relative energy-balance and momentum error */
    double largest, last;    /* largest and last value of E/E0, with energy E and initial energy
                                E0 */
    double stopped;          /* [s] time at which the motion ended early */
    pace_fate fate;
} pace_run;

/* All motions of one structure with one mesh and formulation. */
typedef struct pace_group {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    formulation formulation;
    int elements;
    int analysis;     /* index of the motion in the scene */
    double step, end; /* step size and end time in the scene [s] */
    double from;      /* [s] time after which no load acts; INFINITY: loads act until the end */
    int first, runs;  /* first index, and number, in the list of all runs */
    int reference;    /* series of the reference, followed by those of its checks; -1: no errors are
                         requested */
    double uncertainty; /* uncertainty of the reference; NAN: none */
    double order;       /* observed order of the reference, from the steps and errors of its checks;
                           NAN: none */
    char reason[FAULT_TEXT]; /* reason why there is no reference */
} pace_group;

typedef struct pace {
    sweep sweep;
    int groups, runs;
    pace_group *group;
    pace_run *run;
} pace;

/* Verdicts on integrators, compared with a table of expected ones (expected.csv):
 *
 *   order      pass, low order or undecided, from errors at halved steps (experiments_impl.h)
 *   energy     conserved, or "order P" of its drift at halved steps, or drifts
 *   momentum   the same
 *   tolerance  for each tolerance the decimal logarithm of error/tolerance; the verdict allows
 *              a factor of two
 *   fate       of each step: grows, stops, bounded or exact (pace_fate) */

enum { PACE_FOUND = 128 };

typedef enum pace_judged {
    PACE_ORDER,
    PACE_ENERGY_KEPT,
    PACE_MOMENTUM_KEPT,
    PACE_TOLERANCE,
    PACE_FATE,
    PACE_JUDGED
} pace_judged;

/* A row of the table, which owns its strings. */
typedef struct pace_verdict {
    pace_judged kind;
    const char *judged, *case_name, *parameters, *formulation, *integrator, *steps, *expected, *why;
    int elements;
    int group, first, count; /* indices of the runs to which the verdict applies */
    char found[PACE_FOUND];
    int as_expected;
} pace_verdict;

typedef struct pace_verdicts {
    own_table table;
    int count, unexpected;
    pace_verdict *verdict;
} pace_verdicts;

/* Comparison of integrators for transient analysis: request and result. */

typedef struct motion_request {
    const char
        *expected; /* table of expected verdicts; replaces the description of motions below */
    const case_type *type; /* the case */
    const double *parameter;
    const char *vary; /* "NAME=A..B/N" or "NAME=A,B,C" for a parameter that varies; NULL: none */
    const formulation *formulation;
    int formulations, elements;                   /* elements 0: the number in the case */
    const char *integrators, *steps, *tolerances; /* lists as given on the command line; NULL:
                                                     default */
    int conservation_only;                        /* 1: without a reference */
    int each; /* 1: text output has a line for each motion, in addition to verdicts */
    sweep_request cells;
} motion_request;

typedef struct motions {
    pace pace;
    pace_verdicts verdicts;
    int each, methods;
    pace_method method[PACE_LIST_MOST]; /* methods of all rows of the table */
} motions;

extern const experiment_type experiment_motion;
void motions_free(motions *);

/* Columns of the results at points of a sweep, in the form in which a batch is transferred and
 * stored. */

/* Kind of reference from which an error is computed. */
typedef enum rows_reference {
    ROWS_STORED,   /* a stored reference value at exactly that point */
    ROWS_DERIVED,  /* a reference value computed for the point by a program of reference/derive */
    ROWS_LIMIT,    /* the limit of the meshes of all formulations */
    ROWS_NONE,     /* no limit is known accurately enough */
    ROWS_DISPUTED, /* none: limits of formulations differ by more than their uncertainties */
    ROWS_REFERENCES
} rows_reference;

/* Sizes of the columns, which are equal at every point. */
typedef struct rows_shape {
    int formulations, meshes, quantities;
} rows_shape;

/* Columns of `points` points, in one memory block. The last index varies fastest. */
typedef struct rows {
    rows_shape shape;
    int points;
    size_t size;               /* size of the block [bytes] */
    double *first;             /* the block; owned */
    double *reference, *doubt; /* [points, quantities] value and relative uncertainty; NAN: none */
    double *value,
        *error; /* [points, formulations, meshes, quantities]; error relative; NAN: none */
    double *cost, *seconds; /* [points, formulations, meshes] [s] cost of the counted work, and
                               measured time */
    int32_t *lacks;         /* [points, formulations] bits of the omitted physics (model.h) if the
                               formulation solves another model, which is not counted; 0: the model of
                               the scene */
    int32_t *least;         /* [points, formulations, quantities] number of elements of the coarsest
                               mesh such that it and all finer meshes are within the tolerance; 0: none */
    uint8_t *kind;          /* [points, quantities] values of rows_reference */
    uint8_t *status;        /* [points, formulations, meshes] */
} rows;

/* A sweep over parameters: its points, formulations, meshes and quantities, and its batches. All of
 * this depends only on the request and the build. */

enum { RANGES_FORMULATIONS = 64, RANGES_QUANTITIES = 64 };

/* Request of a parameter study. */
typedef struct ranges_request {
    const case_type *type;
    const scene_file *file; /* file of the case; NULL: a built-in case */
    const double *base;     /* values of all parameters; those that vary are ignored */
    int varies;
    const char *const *vary; /* [varies] arguments of --vary */
    design_kind design;
    long points; /* number of points for designs other than grids */
    unsigned long seed;
    int formulations;
    const formulation *formulation; /* [formulations]; formulations 0: all that run */
    int meshes;
    const int *mesh; /* [meshes]; meshes 0: those of the scene */
    const char *select;
    double tolerance;   /* relative tolerance of the errors */
    int time_limit;     /* [s] limit of a cell; 0: none */
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
    char left_out[FAULT_TEXT]; /* describes the formulations that run at none of the examined points
                                */
    char omitted[SCENE_OMISSION_WORDS]; /* physics that the scene omits, at the first examined
                                           point */
    char assumed[RANGES_ASSUMED]; /* assumptions on the sections (harness/records/records.h), at
                                     the same point */
    long points_in_batch;         /* in all batches except the last */
    int batches;
    double point_cost; /* [s] estimated cost of all cells of a point */
} parameter_ranges;

/* Plans the sweep without solving anything. REFUSED: the message names the invalid part and the
 * remedy. Call ranges_free even after a failure. The request must outlive the result. */
status ranges_make(const ranges_request *request, parameter_ranges *out, fault *f);
void ranges_free(parameter_ranges *);
rows_shape ranges_shape(const parameter_ranges *);

/* One shard of a work. Each of its batches is computed by a process and written to a file as
 * soon as it is finished. */

typedef struct shard_request {
    int index, count; /* index of the shard, starting at 0, and number of shards */
    const char *into; /* folder of the batches; created if necessary */
    int jobs;         /* number of processes, >= 1 */
    int stop; /* descriptor that becomes readable to stop the run; 0: SIGINT, SIGTERM, SIGHUP stop
                 it */
    FILE *progress; /* NULL: quiet */
    FILE *tell;     /* receives messages about damaged or lost batches; NULL: none */
} shard_request;

typedef struct shard_outcome {
    int mine;        /* number of batches of the shard */
    int before;      /* number of its batches that existed before */
    int done;        /* number of batches computed in this run */
    int lost;        /* number of batches whose process ended early */
    int interrupted; /* 1: the run was interrupted */
    double seconds;  /* [s] sum of the run times of the batches computed in this run */
} shard_outcome;

/* Reads "2/4" as index 1 and count 4. REFUSED: any other format. */
status shard_parse(const char *text, int *index, int *count, fault *f);
/* Computes the missing batches, the most expensive first. If a process ends without a result,
 * only its batch is lost; it is computed when the shard is started again. REFUSED: the folder
 * contains batches of another work. FAULT: an error of the disk, the memory or a batch. The run
 * then ends, and completed batches are kept. */
status shard_run(const shard_work *w, const shard_request *request, shard_outcome *out, fault *f);

/* Lists in JSON, for `beamwork list --format json` and for the library. */

/* Lists all cases if `cases` is 1, and all formulations with the physics that they support if
 * `formulations` is 1. */
status list_json_all(FILE *to, int cases, int formulations, fault *f);
/* Lists a case at values of its parameters: the values, the quantities, and the formulations that
 * run it. */
status list_json_case(FILE *to, const case_type *type, const double value[], fault *f);
/* Lists a formulation: its declarations, its options, the known deviations that apply to it
 * (rules NULL: null), and the cases that it runs. */
status list_json_formulation(FILE *to, const formulation *chosen, const rule *rules, int count,
                             fault *f);

/* Subject of a list: everything, all cases, all formulations, or one of them. */

typedef struct list_subject {
    int cases, formulations; /* 1: all of them */
    const case_type *type;   /* one case */
    formulation chosen;      /* one formulation, possibly with options; type NULL: none */
} list_subject;

/* Finds the subject of a list. name: NULL (everything), "cases", "formulations", or the name of
 * a case or formulation. REFUSED: the name is unknown; the message gives the nearest one. */
status list_subject_find(const char *name, list_subject *out, fault *f);

/* Existing batches of a work, in one or several folders. */

typedef struct stock_kind {
    machine node; /* machine: the first one of its kind */
    int batches;
} stock_kind;

typedef struct stock {
    int batches;
    const char *const *folder; /* owned by the caller */
    int folders;
    char stem[BATCH_STEM];
    int *where; /* [batches] index of the folder that contains the batch, or -1 */
    int there, damaged, twice;
    int shards; /* number of shards of the existing batches; 0: different numbers */
    double seconds;
    int kinds; /* number of kinds of machines */
    stock_kind *kind;
} stock;

/* Reads and checks every byte of the requested batches (wanted NULL: all). If a batch is in two
 * folders, the first one is used. Writes one line about each damaged batch, which counts as
 * missing, to the stream (may be NULL). REFUSED: a batch belongs to another build, request or plan;
 * a file has the name of a batch but is none; or two versions of a batch differ. FAULT: a folder
 * cannot be read. Call stock_free even after a failure. */
status stock_take(const shard_work *w, const char *const folder[], int folders, const char *wanted,
                  FILE *tell, stock *out, fault *f);
void stock_free(stock *);
/* Writes "3 of 149 batches are missing: 3, 7-12 (shards 2/4, 3/4)", or an empty text if none is
 * missing. */
void stock_missing(const stock *, const shard_work *, char *out, size_t size);
/* Writes a line for each kind of machine if there are several. */
void stock_tell_kinds(const stock *, FILE *to);
/* Reads the label of the first readable batch of a folder, in the order of names; merge repeats
 * the request of this batch. REFUSED: the folder has no readable batch. */
status stock_first(const char *folder, batch_label *out, fault *f);

/* Reads the batches of one or several folders in canonical order, with only one batch in memory
 * at a time. */

/* Reads every existing batch. s: from stock_take. FAULT: a batch can no longer be read. */
status merge_take(const shard_work *w, const stock *s, fault *f);

/* Numbers of elements from the option -n. */

enum { MESHES_FINEST = 10000000 };

/* Appends the numbers of a list such as "1,2,4" to mesh[most]; *count: how many it contains,
 * updated. REFUSED: an item is not an integer from 1 to MESHES_FINEST, or there are too many. */
status meshes_parse(const char *list, int most, int mesh[], int *count, fault *f);

/* Summary of a sweep, accumulated point by point. It shows at how many points a formulation is
 * within the tolerance, and with how many elements; where it is not; and its worst points. */

enum { TALLY_WORST = 3, TALLY_COLUMNS = 10, TALLY_ROWS = 12, TALLY_SCENE = 64 };

/* A point where the error of a formulation on its finest mesh is one of the largest. */
typedef struct tally_worst {
    long point;
    int quantity;            /* -1: the cell has no solution */
    int status;              /* status of the cell */
    double error;            /* relative error; NAN: no value */
    char scene[TALLY_SCENE]; /* name of the point's scene file; empty: not stored */
} tally_worst;

/* Counts of a formulation for one quantity, or for all quantities together. With all quantities,
 * a point with an undecided quantity is counted in `asked` only if another quantity is never
 * within the tolerance. Otherwise the result of the point is unknown. */
typedef struct tally_series {
    long asked;                     /* number of points with a reference */
    long proven;                    /* number of those points with a reference value */
    long open;                      /* number of points with a value but without a reference */
    long within[SERIES_MAX_MESHES]; /* of `asked`: number of points within the tolerance, for
                                       each mesh */
    long never;     /* of `asked`: number of points where no mesh and all finer ones are within
                       the tolerance */
    int everywhere; /* smallest number of elements for which all points of `asked` are within the
                       tolerance, also on all finer meshes */
} tally_series;

/* One field of the map, which covers a range of each axis. */
typedef struct tally_place {
    long points, other, asked, never; /* other: number of points with another model */
    long proven; /* of `asked`: number of points whose reference is a reference value, not a
                    limit of meshes */
    int least;   /* smallest number of elements for which all points of the field are within the
                    tolerance, also on all finer meshes */
} tally_place;

typedef struct tally {
    const parameter_ranges *of;
    long points, without_scene,
        first_without; /* first_without: index of the first point without a scene */
    long kind[RANGES_QUANTITIES][ROWS_REFERENCES];
    double doubt[RANGES_QUANTITIES]; /* largest relative uncertainty of a reference */
    int columns, lines;              /* numbers of columns and lines of the map; 0: more than two
                                        axes */
    tally_series *series;   /* [formulations x (quantities + 1)]; the last one is for all quantities
                               together */
    tally_place *map;       /* [formulations x (quantities + 1) x lines x columns] */
    long *failed;           /* [formulations x meshes] number of cells without a solution */
    double *cost, *seconds; /* [formulations x meshes] [s], sums over all cells that ran */
    long *ran;              /* [formulations x meshes] number of cells that ran */
    long others[RANGES_FORMULATIONS];    /* number of points where the formulation solves another
                                            model; these are not counted elsewhere */
    unsigned lacks[RANGES_FORMULATIONS]; /* bits of the physics omitted at those points: model.h */
    int worsts[RANGES_FORMULATIONS];
    tally_worst worst[RANGES_FORMULATIONS][TALLY_WORST]; /* in decreasing order of error */
} tally;

/* FAULT: out of memory. Call tally_free even after a failure. */
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

/* A sweep as work that can be cut into batches. */

typedef struct ranges_work {
    const parameter_ranges *of;
    double *cost;      /* [batches] */
    tally *tally;      /* counts of the batches that have been read ... */
    ranges_file *file; /* ... and the file to which they are written; NULL: none */
    FILE *csv;         /* CSV output; NULL: none */
    int csv_begun;     /* 1: the header has been written */
    digest content;    /* digest of all values read, except times */
} ranges_work;

/* Computes the batches of a sweep or reads those of shards, and writes the summary, the file and
 * the worst points. */

typedef struct range_sweep_request {
    ranges_request of;
    const char *output; /* path of the HDF5 file; NULL: none */
    int partial;        /* 1: batches may be missing, and the name of the output says so */
    int jobs, verbose, quiet;
    FILE *progress, *csv; /* NULL: none */
    /* Reads the batches; NULL: they are computed by this process. NO_VALUE: there is nothing to
     * evaluate. */
    status (*take)(void *context, const shard_work *, fault *f);
    void *context;
} range_sweep_request;

typedef struct range_sweep {
    const range_sweep_request *asked;
    truths truths; /* read before planning */
    parameter_ranges ranges;
    ranges_work work;
    shard_work all; /* its identity is set after planning */
    const char *output;
    char partial[PATH_MAX]; /* name of the output if batches are missing */
    char worst[PATH_MAX];   /* folder for the scenes of the worst points; empty: none */
    char batches[PATH_MAX]; /* folder of the batches */
    int lost;               /* number of missing batches, if they are computed by this process */
    int evaluated;          /* 1: all batches have been read */
    tally tally;
    ranges_file file;
} range_sweep;

extern const experiment_type experiment_sweep;
void range_sweep_free(range_sweep *);

/* Data that all batches of one sweep must have in common, in addition to the command line. */

/* Adds the points, formulations, meshes, quantities and the division into batches to the digest. */
void ranges_identity_add(const parameter_ranges *r, digest *plan);

/* Text output of a sweep. */

/* Writes the header of the table: number of points and cells, and the axes. */
void ranges_table_head(FILE *to, const parameter_ranges *r);

/* Results of a verification that are worse than in a previous run. */

/* Adds three kinds of findings to the judgement. First, every mesh whose error is larger than in
 * the previous run (by more than 2 % and RESULTS_FLOOR), or whose value or solution is now
 * missing. Second, series of the previous run that are missing although this run should have
 * them. Third, limits of default points that changed by more than a relative 1e-5, unless an
 * exact reference value checks them as closely. If only the short table of the previous run is
 * known, errors are compared by series. Work is not compared. REFUSED: the two runs have nothing
 * in common. */
status regressions_find(const stored_results *former, const char *name, const sweep *, judgement *,
                        fault *);

/* One cell of a case: it is requested, completed by default choices, and solved. Used by the
 * command line and by the library. */

typedef struct solution_request {
    const case_type *type;
    const double *parameter; /* parameters of the case */
    const char *select;      /* selected quantities, as in harness/study/study.h; NULL: all */
    formulation formulation; /* type NULL: to be chosen by default */
    int elements;            /* number of elements per member; 0: to be chosen by default */
    int keep_all, steps, shapes, threads;
    int keep_ends; /* 1: the final states of motions are stored */
    int restarts;
    const outcome_end *restart; /* [restarts] states from which motions continue; NULL: none */
    int systems;                /* as in solve_options */
    const char *reduce;
    double error; /* relative change of values between two meshes that counts as converged; 0:
                     default */
} solution_request;

/* Choices with their reasons, one line each; "" if the value was given. */
typedef struct solution_choice {
    char formulation[FAULT_TEXT], elements[FAULT_TEXT];
    double *change; /* [quantities] relative change from the previous mesh; NULL: the number of
                       elements was given */
    int short_of;   /* 1: the requested error was not reached */
} solution_choice;
void solution_choice_free(solution_choice *);

/* Chooses the formulation (harness/study/study.h) and, if elements is 1, the number of elements.
 * rules NULL: no list of known deviations. REFUSED: no formulation supports everything the case
 * requires. Call solution_choice_free in any case. */
status solution_choose(solution_request *, const rule *rules, int count, int elements,
                       solution_choice *why, fault *f);
/* Plans one point, series and mesh with the selected quantities, without running it. Call
 * sweep_free even after a failure. */
status solution_plan(const solution_request *, sweep *, fault *);
/* Solves the cell in this process. A cell without a solution counts as a result, except after
 * REFUSED and FAULT. Returns NOT_CONVERGED even if the chosen mesh does not reach the requested
 * error. */
status solution_run(const solution_request *, const solution_choice *, sweep *, fault *);

/* Final states of motions in a file. Another run continues from them. Its results are
 * bit-for-bit identical to those of a single run if its steps are unchanged. */

typedef struct restart {
    char formulation[FORMULATION_KEY]; /* formulation with its options */
    int elements, keep_all;
    char *scene; /* text of a scene file, without the parts that may differ */
    int ends;
    outcome_end *end;
} restart;

/* REFUSED: the scene has no motion whose final state can be stored. Call before the solution. */
status restart_possible(const scene *, fault *);
/* Writes the final states of the solved motions to a file, with their scene, formulation and
 * mesh. The file has a temporary name until it is complete. */
status restart_write(const char *path, const solution_request *, const sweep *, fault *);
/* FAULT: the file is missing, damaged or foreign. Call restart_free even after a failure. */
status restart_read(const char *path, restart *, fault *);
void restart_free(restart *);
/* Prepares the scene for continuation: only the stations after the stored state remain. REFUSED:
 * the scene (apart from stations and quantities), the formulation or the mesh differs, or
 * there is no later station. */
status restart_begin(const restart *, solution_request *, scene *, fault *);

/* Formulations that run a case, or cases that a formulation runs, and the reasons why others do
 * not. */

enum { RUNS_ON_WORDS = 200 };

typedef struct runs_on {
    const char *name; /* name of the case or the formulation */
    int runs;
    int other;                 /* 1: as another model (harness/study/study.h) */
    char words[RUNS_ON_WORDS]; /* missing features; if the formulation runs, the physics that it
                                  omits */
} runs_on;

void runs_on_scene(const scene *s, const element_type *type, runs_on *out);
/* Lists built-in cases at their default parameters, at most `room`, and returns their number.
 * `other` is 0, because other models are not examined. */
int runs_on_cases(const element_type *type, runs_on out[], int room);

/* Binds this process to the processor on which it runs, so the times of repetitions are comparable.
 * */
void rounds_pin(void);
/* Restarts the program with one thread, because libraries set their number of threads when they are
 * loaded. arguments: NULL-terminated. */
void rounds_single_thread(char **arguments);

/* Runs every formulation on every case and parameter point with a reference value, and evaluates
 * the results as they arrive. */

/* Observer of results that are evaluated during the run. */
typedef struct verification_reader {
    void *context;
    /* Called once per case, after its last series has been evaluated. In an interrupted run it
     * is called only for the cases before the interruption. */
    void (*judged)(void *context, const case_type *);
} verification_reader;

/* Checks the interface requirements for named or loaded formulations. Then runs a planned sweep
 * (study.h) and evaluates its series in order, as soon as all series of their point are complete.
 * Finest meshes are run again if verdicts may depend on their scatter. Agreements of formulations
 * become reference values of scene files. whole 1: no selection was made; it has no effect in an
 * interrupted run. reader NULL: none. Call judgement_free even after a failure. */
status verification_run(const sweep_request *, int whole, const verification_reader *reader,
                        truths *, sweep *, judgement *out, fault *);

/* Runs the cells of a planned sweep, or of some of its series, and measures scatter, without
 * evaluation. */
status verification_cells(const sweep_request *, truths *, sweep *, fault *);

/* Output files of a verification: HDF5, JSON, JUnit, Markdown, and proposed known deviations. The
 * content of a case is prepared as soon as the case is evaluated. */

typedef struct verification_files {
    const char *output, *json, *junit, *markdown, *propose; /* paths, set by the caller; NULL:
                                                               none */
    const sweep *sweep;
    const judgement *judged;
    store store;    /* results file, open if requested */
    json_part part; /* part of the JSON so far, if requested */
    int open;
} verification_files;

typedef struct verification_request {
    sweep_request cells;
    int whole;                   /* 1: no selection was made */
    int taken;                   /* 1: the cells have been read from batches and are not run */
    const char *const *imported; /* [importeds] paths of stored imports: other programs to
                                    compare */
    int importeds;
    int imported_must_pass; /* 1: verdicts on imported values affect the exit status */
    const char *former;     /* name of the file `verification.former` in messages; NULL: none */
    const char *processor;  /* processor that computed the batches; "": this one */
    int exit_zero, verbose, quiet;
} verification_request;

typedef struct verification {
    const verification_request *asked;
    truths truths;             /* read before planning */
    stored_results former;     /* previous results; the results of this run must not be worse */
    verification_files *files; /* owned by the caller */
    double begun;              /* [s] clock_wall_seconds at the start */
    sweep sweep;
    judgement judgement;
    overview overview;
} verification;

/* Output files of an interrupted run have names that say so. */
extern const experiment_type experiment_verify;
void verification_free(verification *);

#endif
