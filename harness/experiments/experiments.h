/* experiments/: verification, sweeps, extremes, integrators compared, certificates of elements,
 * shards.
 *
 * Sections, in this order: against (two in alternation); axis; batches; measures; experiment;
 * bench; checks of elements and certificates; convergence; deal; design; extremes; integrators
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

/* Two formulations or programs in alternation: is one slower, or does the scatter not allow an
 * answer? A drift of the machine affects both alike. */

typedef enum against_outcome { AGAINST_UNDECIDED, AGAINST_FASTER, AGAINST_SLOWER } against_outcome;

typedef struct contest_clock {
    int pairs;
    double a, b; /* [s] least of one lap */
    /* median of b/a over the pairs; where it lies with 99.9 % confidence, however distributed */
    double ratio, low, high;
    /* of b against a; ratios within 2 % of 1 are left undecided: code laid out otherwise does as
     * much */
    against_outcome outcome;
} contest_clock;

const char *against_name(against_outcome);
/* Compares given seconds of `pairs` laps each: tests supply them, no clock is used. */
contest_clock against_judge(int pairs, const double a[], const double b[]);

/* One lap of one of the two takes *seconds. */
typedef status against_lap(void *contestant, double *seconds, fault *f);
/* As many pairs as fit into `budget` [s], at least 51: their number is fixed before the first one
 * counts. */
status against_run(against_lap *lap, void *a, void *b, double budget, contest_clock *out, fault *f);

/* Varied parameter: a parameter of a case, and its values. */

typedef enum axis_kind { AXIS_LINEAR, AXIS_LOG, AXIS_LIST, AXIS_WORDS } axis_kind;

enum { AXIS_MOST_VALUES = 1000001 };

typedef struct sweep_axis {
    const parameter_type *of;
    int index; /* among the parameters of the case */
    axis_kind kind;
    double from, to; /* of AXIS_LINEAR, AXIS_LOG */
    int count;       /* values; 0: a range that says no number of parts */
    double *value;   /* [count] of AXIS_LIST and AXIS_WORDS; owned */
} sweep_axis;

/* "NAME=A..B/N" (N equal parts, ends included), "NAME=A..B/N:log" (equal ratios), "NAME=A..B"
 * and "NAME=A..B:log" (no values of its own: the points are a design's), "NAME=A,B,C" (numbers, or
 * words of a choice). REFUSED: the culprit and the remedy; every value is one that the parameter
 * may have. */
status axis_read(const case_type *type, const char *text, sweep_axis *out, fault *f);
void axis_free(sweep_axis *);
/* Value i of `count`. */
double axis_value(const sweep_axis *, int i);
/* Value at a share of the axis, 0 <= share < 1: of a list the value that the share falls on. */
double axis_at(const sweep_axis *, double share);
/* "linear", "log", "list", "words". */
const char *axis_kind_name(axis_kind);
/* The value as it is written. */
void axis_text(const sweep_axis *, double value, char *text, int size);

/* The machine a batch is computed on: its times belong to it, and its last digits may. */

typedef struct machine {
    char host[128], processor[128];
    char blas[256]; /* library, and the kernels that it chose for this processor */
} machine;

machine node_here(void);
/* 1: the same kind: processor and BLAS; hosts may differ. */
int node_same_kind(const machine *, const machine *);

/* Work that can be cut into batches: what a verb gives to this folder, which does not depend on
 * cells. */

/* The batches depend on the request and the build alone, so that independent processes make the
 * same ones. */
typedef struct shard_work {
    const char *verb;
    /* one line each: the program, what it was asked, and all that its answers depend on; batches
     * belong together where all three are equal */
    const char *build, *request, *plan;
    const char *origin; /* JSON object: what merge needs to ask again; it is not compared */
    int batches;
    const double *cost; /* [batches] about [s] */
    void *context;
    /* Answers as bytes, which another process of this build can take. *content gathers what must be
     * equal when the batch is computed again: no times, no names of machines. It runs in a process
     * of its own and frees what it took. */
    status (*run)(void *context, int batch, FILE *to, digest *content, fault *f);
    /* In canonical order, each batch once. FAULT: it cannot be read. */
    status (*take)(void *context, int batch, FILE *from, fault *f);
} shard_work;

/* One batch as a file: a line of JSON that says what it is, its bytes, a line with length and
 * checksum. It appears complete or not at all. */

#define BATCH_ENDING ".batch"
enum { BATCH_STEM = 48, BATCH_NAME = BATCH_STEM + 24 };

typedef struct batch_label {
    char build[512], request[2048], plan[DIGEST_TEXT], verb[32];
    int batch, batches; /* counted from 0 */
    int shard, shards;  /* who computed it, counted from 0 */
    char content[DIGEST_TEXT];
    double seconds;           /* that it took */
    double processor_seconds; /* of these, those of the processor, of all its processes */
    machine node;
    json_t *origin; /* batch_label_free releases it */
} batch_label;

/* "verify-0123456789ab": what the names of all batches of one work begin with. */
void batch_stem(const shard_work *w, char out[BATCH_STEM]);
/* "verify-0123456789ab-000017.batch"; batches are counted from 1 there. */
void batch_name(const char *stem, int batch, char out[BATCH_NAME]);
/* The batch of a name, or -1: it is none of that stem. */
int batch_of_name(const char *name, const char *stem);
/* 1: it ends as names of batches do. */
int batch_is_name(const char *name);

/* Writes folder/NAME beside its place, then renames it. FAULT: disk, memory. */
status batch_write(const char *folder, const batch_label *label, const void *bytes, size_t size,
                   fault *f);
/* Takes away what processes that were killed left of a batch; gone: 1, its writer is known to be.
 */
void batch_clean(const char *folder, const char *name, int gone);
/* The label; *from (may be NULL) is at the first of the bytes, and *end after the last.
 * FAULT: cut short, damaged, or no batch. */
status batch_open(const char *path, batch_label *out, FILE **from, long *end, fault *f);
/* The label alone: nothing is said of the bytes. */
status batch_read_label(const char *path, batch_label *out, fault *f);
void batch_label_free(batch_label *);
/* Does it belong to the work? REFUSED: no; what differs, with its path. */
status batch_belongs(const batch_label *, const shard_work *, const char *path, fault *f);

/* Measurements of a formulation, independent of its claims: errors over meshes and thicknesses,
 * orders. Plain data of one size: it can lie in memory that processes share. */

enum { MEASURE_POINTS = 12, MEASURES_MOST = 16, MEASURE_NAME = 64, MEASURE_WORDS = 200 };

typedef struct element_measure {
    char name[MEASURE_NAME];
    int points;
    double at[MEASURE_POINTS];    /* numbers of elements, or thickness by length */
    double error[MEASURE_POINTS]; /* relative to the exact value; NAN: none */
    double order;                 /* of the errors; NAN: not requested, or none is seen */
    int least, highest;           /* orders that the type declares; 0: not requested */
    int locks;                    /* 1: the errors grow where it becomes thin */
    int astray; /* 1: the error of a linear state is that of one element with every mesh */
    char words[MEASURE_WORDS]; /* why there is nothing, or what it comes to */
} element_measure;

typedef struct measures {
    int count;
    element_measure measure[MEASURES_MOST];
    char words[MEASURE_WORDS]; /* what all of them have in common; "": nothing */
} measures;

/* The next one, empty. */
element_measure *measures_add(measures *m, const char *name);
/* One more point of it. */
void measures_point(element_measure *one, double at, double error);
/* Quantities whose limit is wrong. */
int measures_astray(const measures *m);
/* 1: three points or more, and none has a value. */
int measures_hopeless(const element_measure *one);

/* An experiment: planned, run, judged, and what is found written as asked, by one function for all.
 * What it leaves are tables of records, from whose fields its group of a file of results, JSON and
 * CSV are written; or the cells of a sweep with their verdicts. */

typedef struct experiment_cells {
    const sweep *sweep;
    const judgement *judged;
    const environment *made;
} experiment_cells;

typedef struct experiment_type {
    const char *name; /* of its group */
    /* One after the other; NULL: nothing. asked: its own request; found: what the next one takes.
     */
    status (*plan)(const void *asked, void *found, fault *f);
    status (*run)(const void *asked, void *found, fault *f);
    status (*judge)(const void *asked, void *found, fault *f);
    /* Its tables; ends with NULL. NULL: it leaves cells. */
    const record_type *const *records;
    const record_type *about; /* one record of the whole run; NULL: none */
    const record_type *rows;  /* that of the records which CSV shows; NULL: there is no CSV */
    /* Adds the records of that type of what was found. */
    void (*gather)(const void *found, const record_type *type, subjects *out);
    void (*print)(FILE *to, const void *found); /* for people */
    /* Experiments with cells: the cells, and all output forms. */
    experiment_cells (*cells)(const void *found);
    status (*write)(FILE *to, const char *format, const void *found, fault *f);
} experiment_type;

typedef struct experiment_output {
    const char *results; /* file that its group goes into, where those of others stay; NULL: none */
    const char *text, *format; /* NULL: standard output; "text", "csv", "json" */
    const char *json;          /* a file besides; NULL: none */
} experiment_output;

/* As -o, --format and --json ask: a name that ends in .h5 or .hdf5 is a file of results. */
experiment_output experiment_output_of(const char *path, const char *format, const char *json);

status experiment_plan(const experiment_type *, const void *asked, void *found, fault *f);
/* After the plan: all the rest. */
status experiment_run(const experiment_type *, const void *asked, const experiment_output *,
                      void *found, fault *f);
/* Both. */
status experiment_do(const experiment_type *, const void *asked, const experiment_output *,
                     void *found, fault *f);

/* Error against run time: every formulation and mesh of cases, timed in rounds on one processor. */

typedef struct bench_request {
    const char *const *cases; /* [count] their names; 0: all that have a reference value */
    const case_type *scene;   /* in their place; NULL: none */
    int count;
    const char *const *assignment; /* [assignments] "NAME=VALUE", of each of them */
    int assignments, meshes;       /* meshes 0: those of the case */
    const int *mesh;
    sweep_request cells;
    int threads, dense; /* dense: 1: the published algorithm is timed too */
} bench_request;

typedef struct bench {
    truths truths; /* read before it is planned */
    sweep sweep;
    judgement judgement;
    environment made;
    int named; /* 1: cases were named, which shows more of them */
} bench;

extern const experiment_type experiment_bench;
void bench_free(bench *);

/* A claim about a formulation: how far it departs from what must hold, and what to correct. Plain
 * data of one size: it can lie in memory that processes share. */

enum { CLAIM_NAME = 64, CLAIM_SENTENCE = 400, CLAIMS_MOST = 48 };

typedef enum claim_outcome {
    CLAIM_HOLDS,
    CLAIM_BROKEN,
    CLAIM_NOT_CLAIMED, /* the type does not say so, or leaves it to others: sentence says why */
    CLAIM_OUTCOMES
} claim_outcome;

typedef struct claim {
    char name[CLAIM_NAME];
    claim_outcome outcome;
    int compared;                  /* numbers, or questions of yes and no */
    double worst, allowed;         /* largest departure, dimensionless; INFINITY: a question's no */
    char sentence[CLAIM_SENTENCE]; /* of the worst departure that is not allowed */
} claim;

/* Claims of one family of checks. */
typedef struct claims {
    int count;
    claim claim[CLAIMS_MOST];
    char doing[CLAIM_SENTENCE]; /* what is called now: for what does not come back */
    int complete;               /* 1: all was examined */
} claims;

/* The claim of that name; a new one holds until something departs. */
claim *claims_open(claims *c, const char *name, double allowed);
/* The type makes no such claim, and why. */
void claims_not_made(claims *c, const char *name, const char *why);
/* One more comparison; what is not a number departs most. */
void claims_departs(claim *one, double departure, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* One more question: the sentence says what is wrong where it does not hold. */
void claims_asks(claim *one, int holds, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Names the next check. */
void claims_doing(claims *c, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* How far apart two numbers are of their size; two that are equal are not, also where both are 0.
 */
static inline double claims_share(double apart, double size)
{
    return apart == 0 ? 0 : apart / size;
}
/* How many of them came out so, and how many comparisons they stand on. */
int claims_counted(const claims *c, claim_outcome outcome);
int claims_compared(const claims *c);

/* Sections of the elements that are checked. */

typedef enum profiles_form {
    PROFILES_RECTANGLE,   /* what every formulation can do */
    PROFILES_UNSYMMETRIC, /* an open section of three walls, its shear centre off the centroid */
    PROFILES_MATRICES     /* every entry of its matrices of a size that matters */
} profiles_form;

/* Lengths in units of `unit` metres, force in newtons, time in seconds of the same mass. */
status profiles_section(profiles_form form, double unit, section *out, fault *f);
section_spec profiles_matrices(double unit);

/* One element of a formulation, as its checks look at it: sections, options and features that it
 * takes, states of its nodes, its calls. */

enum {
    SPECIMEN_STRAINS = ELEMENT_MAX_STRAINS,
    SPECIMEN_COORDINATES = ELEMENT_MAX_COORDINATES,
    SPECIMEN_INNER = 1 << 10,  /* most unknowns of its own that are checked */
    SPECIMEN_MEMORY = 1 << 13, /* and doubles between stress and update */
    SPECIMEN_WORDS = 160
};

/* Lengths in units of `unit` metres, force in newtons. */
typedef struct specimen_request {
    const element_type *given;
    const double *options;
    unsigned features;
    profiles_form form;
    double unit;
    double curvature[3]; /* [1/length] */
    double length;       /* 0: the usual */
} specimen_request;

typedef struct specimen {
    element_type type; /* completed by the adapters */
    specimen_request made;
    double options[FORMULATION_OPTIONS];
    section section;
    element_request request;
    element_data *data;
    size_t size; /* of data */
    int nodes, strains, coordinates, inner, memory;
    char words[SPECIMEN_WORDS]; /* "" or ", with option=value, section", for sentences */
} specimen;

/* STATUS_REFUSED, ...: the type's own word. specimen_free in any case. */
status specimen_make(const specimen_request *, specimen *out, fault *f);
void specimen_free(specimen *s);

/* Features for a straight element: all, and without those. */
unsigned specimen_features(const element_type *t, unsigned without);

/* Numbers of high entropy in (-1/2, 1/2), the same for the same seed. */
void specimen_numbers(int count, unsigned seed, double out[]);
/* The undeformed element moved by such numbers times `size` lengths, radians, 1/lengths. */
void specimen_state(const specimen *s, double size, unsigned seed, node_state x[]);
/* The whole turned about the origin by a rotation vector, then shifted by some lengths. */
void specimen_carry(const specimen *s, const double turn[3], const node_state x[],
                    node_state out[]);

/* Point at which differences are taken. */
typedef struct specimen_place {
    const specimen *s;
    const node_state *x;
} specimen_place;

/* Coordinate i moved by si units of differences, j by sj. */
void specimen_moved(const specimen_place *at, int i, double si, int j, double sj, node_state out[]);

/* Inner unknowns at rest [inner]. */
void specimen_rest(const specimen *s, double inner[]);
/* Stress with the inner unknowns solved for: Newton on the element's own equations. */
status specimen_settled(const specimen *s, const double e[], double inner[], stress_output *out);

/* "rotation about y of node 2". */
const char *specimen_coordinate(int c, char words[SPECIMEN_WORDS]);

/* The families of checks: what element.h asks of every type. Each checks
 * all elements that the formulation supports, and adds its results. */

typedef void checks_run(const formulation *chosen, claims *out);

checks_run checks_declared; /* its declarations are consistent            */
checks_run checks_features; /* what it offers it can do, alone, in subsets, as cases ask for it */
checks_run checks_derivatives; /* J and H of the strains */
checks_run checks_energy;      /* stress, stiffness and geometric stiffness come from the energy */
checks_run checks_force;       /* of types by force: force and stiffness come from the energy */
checks_run checks_motion;      /* rigid motion, order of the nodes, units */
checks_run checks_stateless;   /* the same call gives the same, independent of former calls */
checks_run checks_many;        /* many at once give what each gives alone */
checks_run checks_bounds;      /* outputs are filled, and no memory outside them is changed */
checks_run checks_unsound;     /* NaN and Inf are reported, not passed over */
checks_run checks_mass;        /* mass matrix: symmetric, positive, of the beam's mass */
checks_run checks_rotating;    /* what a rotating frame does */
checks_run checks_along;       /* loads along one element */
checks_run checks_in_time;     /* forces of inertia in time */

typedef struct checks_family {
    const char *name, *what; /* one word; what holds, in a line */
    checks_run *run;
} checks_family;

enum { CHECKS_FAMILIES = 14 };
extern const checks_family checks_families[CHECKS_FAMILIES];

/* Measurements of every formulation, in groups. */

typedef void measured_run(const formulation *chosen, claims *, measures *out);

typedef struct measured_group {
    const char *name, *what; /* one word; what the numbers are, in a line */
    measured_run *run;
} measured_group;

enum { MEASURED_GROUPS = 3 };
extern const measured_group measured_groups[MEASURED_GROUPS];

measured_run measured_states;  /* of a cantilever, whose exact solution is known */
measured_run measured_locking; /* over thickness by length */
measured_run measured_orders;  /* over the number of elements */

/* The certificate of a formulation: the interface requirements that it must satisfy, and its
 * measurements. Each part is found in a process of its own, so that one that crashes, does not
 * return or corrupts its memory is a named result, and the others continue. */

enum { CERTIFICATE_PARTS = CHECKS_FAMILIES + MEASURED_GROUPS };

/* One part: claims, and, of what is measured, the numbers. */
typedef struct certificate_part {
    claims claims;
    measures measures;
} certificate_part;

typedef struct certificate {
    formulation chosen;
    certificate_part part[CERTIFICATE_PARTS];
    const char
        *late; /* the part that hit the time limit; NULL: none. What follows is not checked */
} certificate;

typedef struct certificate_request {
    const formulation *chosen;   /* [count] */
    int count, jobs, time_limit; /* time_limit: [s] of one part; 0: none */
    int contract_only;           /* 1: nothing is measured */
} certificate_request;

/* certificates_free in any case. */
status certificate_find(const certificate_request *, certificate **out, fault *f);
void certificate_free(certificate *all, int count);

const char *certificate_part_name(int part);
/* Statement of a part, in a line. */
const char *certificate_part_words(int part);
/* Claims of that outcome, and numbers that were compared, of all parts. */
int certificate_counted(const certificate *, claim_outcome);
int certificate_compared(const certificate *);
/* 1: no claim is broken. */
int certificate_holds(const certificate *);
/* The first claim that is broken; NULL: none. */
const claim *certificate_broken(const certificate *);

/* Records of certificates. */

/* Result of experiment_element_test. */
typedef struct certificates {
    certificate *all;          /* [count] */
    int count, verbose, quiet; /* as certificate_text */
} certificates;

/* Asked by a certificate_request; certificate_free frees what is found. */
extern const experiment_type experiment_element_test;

/* One case with several formulations on several meshes: errors, orders, limits. */

typedef struct convergence_request {
    const case_type *type;
    const double *parameter;
    const int *mesh; /* [meshes] 0: those of the case */
    int meshes;
    double level; /* error that is requested */
    int verbose;  /* 1: each formulation by itself, with values and times */
    sweep_request cells;
} convergence_request;

typedef struct convergence {
    truths truths; /* read before it is planned */
    sweep sweep;
    judgement judgement;
    environment made;
    double level;
    int verbose;
} convergence;

extern const experiment_type experiment_converge;
void convergence_free(convergence *);

/* Work cut into batches, and the assignment of batches to shards. Both depend on the costs
 * alone. */

/* Consecutive items of at most `most` together; one that is more expensive stands alone.
 * first[items + 1]: of each batch, and after the last one `items`. Returns the number of
 * batches. */
int deal_cut(int items, const double cost[], double most, int first[]);
/* shard[batches]: the shard 0..shards-1 of each batch. The most expensive batch is assigned first,
 * each to the shard with the least so far. 0, or -1: out of memory. */
int deal_out(int batches, const double cost[], int shards, int shard[]);
/* order[batches]: the most expensive first; of two that cost the same, the first. */
void deal_order(int batches, const double cost[], int order[]);

/* Which points of the parameters: a grid over all axes, or points that fill their box. */

typedef enum design_kind { DESIGN_GRID, DESIGN_SOBOL, DESIGN_HALTON, DESIGN_RANDOM } design_kind;
/* Words of --design, in that order. */
#define DESIGN_CHOICES "grid|sobol|halton|random"

/* State of a sequence after that many of its points. */
typedef struct design_mark {
    gsl_qrng *quasi;
    gsl_rng *random; /* the other one is NULL */
} design_mark;

typedef struct design {
    design_kind kind;
    int axes;
    const sweep_axis *axis; /* [axes]; not owned */
    long points;            /* all */
    unsigned long seed;     /* of DESIGN_RANDOM: GSL's mt19937 */
    long marks, stride;
    design_mark *mark; /* [marks] at every `stride` points: any of them is soon found */
} design;

/* Least stride; most marks, of some kilobytes each. */
enum { DESIGN_STRIDE = 16384, DESIGN_MARKS = 1024, DESIGN_MOST_POINTS = 1000000000 };

/* points: for designs other than grids. Grids: the last axis changes first. The first point of
 * Sobol's and Halton's sequences is the one after the origin, as in GSL. REFUSED: too many points,
 * a grid with an axis without parts, another design with an axis with parts, more axes than the
 * sequence has. */
status design_make(design_kind kind, int axes, const sweep_axis list[], long points,
                   unsigned long seed, design *out, fault *f);
void design_free(design *);
/* Values of the axes at `count` points from `first` on, into out[count x axes]. FAULT: no memory.
 */
status design_points(const design *, long first, long count, double out[], fault *f);
const char *design_name(design_kind);

/* Outcome of a formulation at an extreme, and the outcomes that are expected although they are not
 * accurate. */

enum { OUTCOME_NEIGHBOURS = 2 };

typedef enum outcome_kind {
    OUTCOME_VALUE,  /* within the extreme's tolerance */
    OUTCOME_COARSE, /* outside it, but the error falls with more elements: a discretisation error */
    OUTCOME_WRONG,  /* a number that is neither */
    OUTCOME_NOT_CONVERGED,
    OUTCOME_SINGULAR,
    OUTCOME_REFUSED,
    OUTCOME_NO_VALUE, /* the mesh has no such mode, load or state */
    OUTCOME_FAULT,    /* crashed, or out of memory */
    OUTCOME_SKIP,     /* needs what the formulation does not support */
    OUTCOME_KINDS
} outcome_kind;

/* Expected outcomes that are neither accurate nor under-resolved
 * (reference/extreme_findings.csv). */
typedef struct extreme_finding {
    char *extreme, *formulation, *quantity, *outcome, *proof; /* the first three may hold * and ? */
    double from, to;                                          /* of x, inclusive */
    int observed;
} extreme_finding;

typedef struct extreme_outcome {
    /* Indices: in the table, of its values, in the list of formulations, of its quantities. */
    int extreme, value, formulation, quantity;
    int point, series, neighbours; /* of the sweeps; series of the other meshes: -1: none */
    outcome_kind kind;
    double x, result, reference, error; /* NAN: none; error relative */
    /* On the other meshes; NAN: not needed, or no value. */
    double neighbour_error[OUTCOME_NEIGHBOURS];
    const extreme_finding *finding;
    int as_expected;
    const char *reason;
} extreme_outcome;

const char *outcome_name(outcome_kind kind);
int outcome_is_good(outcome_kind kind); /* a value, or coarse */

/* Every formulation at every extreme: the cells, what came of them, and the counts. */

/* Counts of one formulation; a cell is an extreme at one value of x, and as bad as its worst
 * quantity. */
typedef struct extreme_count {
    const char *formulation; /* its key */
    int tried, survived, coarse, named, wrong, faults;
} extreme_count;

typedef struct extreme_sweep {
    int formulations, outcomes, findings, unexpected, unobserved;
    int is_new; /* outcomes of new formulations that would need a known deviation: they do not
                   affect the exit status */
    formulation *formulation;
    truths truths; /* exact values */
    sweep first, neighbours;
    extreme_outcome *outcome;
    extreme_finding *finding;
    extreme_count *count; /* [formulations] */
} extreme_sweep;

/* The cell of an outcome; its quantity in the scene; its value on the first mesh (refinement 0) or
 * on a neighbouring one (NAN: there is none). */
const cell_result *extreme_sweep_cell(const extreme_sweep *s, const extreme_outcome *o);
const scene_quantity *extreme_sweep_quantity(const extreme_sweep *s, const extreme_outcome *o);
const quantity_result *extreme_sweep_result(const extreme_sweep *s, const extreme_outcome *o,
                                            const cell_result *cell);
double extreme_sweep_value(const extreme_sweep *s, const extreme_outcome *o, int refinement);
/* The same formulation and quantity at the x that others are compared with, or NULL. */
extreme_outcome *extreme_sweep_base(const extreme_sweep *s, const extreme_outcome *o);
/* Exit code: 0 as expected, 1 an outcome differs, 3 nothing was run. */
int extreme_sweep_exit(const extreme_sweep *s);
void extreme_sweep_free(extreme_sweep *s);

/* Which cells a sweep of extremes consists of. */

typedef struct extreme_request {
    const char *truths; /* path of the packed ones */
    const char *select; /* expression over "name/group/case/formulation", or NULL */
    int jobs, formulations;
    const formulation *formulation; /* restrict to these; 0: all */
    int named; /* 1: these were requested by name: they affect the exit status */
    FILE *progress;
} extreme_request;

/* A point for every extreme and value, in order, with a series for every formulation; an outcome
 * for each of its quantities. */
status extreme_plan(const extreme_request *request, extreme_sweep *out, fault *f);

/* Every formulation at every extreme: a value with its error, or a named refusal or failure, and
 * never a silent wrong number. */

/* Asked by an extreme_request, finds an extreme_sweep: extreme_sweep_free. */
extern const experiment_type experiment_stress;

/* Outcomes of a sweep of extremes for people. */

void extreme_table(FILE *to, const void *found); /* extreme_sweep */

/* Steps and tolerances as a command line lists them. */

enum { PACE_LIST_MOST = 16 };

typedef struct pace_list {
    int count;
    double value[PACE_LIST_MOST];
} pace_list;

/* "0.1,0.05" or "0.1..0.0125", which is divided by `ratio` from the first to the last; positive
 * numbers. option: its name, for messages. */
status pace_list_read(const char *option, const char *text, double ratio, pace_list *out, fault *f);
/* first, divided by ratio again and again. */
pace_list pace_list_divided(double first, double ratio, int count);

/* Integrators as a command line names them. */

enum { PACE_METHOD_NAME = 32, PACE_REFERENCE_ORDER = 5 }; /* the reference is radau */

typedef struct pace_method {
    char name[PACE_METHOD_NAME]; /* as it was given */
    scene_scheme scheme;
    scene_alpha alpha;
    int order;    /* in time, of what is resolved */
    int estimate; /* 1: it estimates the error of a step */
} pace_method;

#define PACE_METHODS                                                                               \
    "alpha, alpha:rho=R, hht, hht:alpha=A, trapezoidal, conserving, radau, explicit"

/* Default method. */
extern const char pace_method_all[];
/* One of PACE_METHODS, R in [0, 1], A in [0, 1/3]. REFUSED: the culprit. */
status pace_method_read(const char *text, int length, pace_method *out, fault *f);
/* "NAME,NAME,...", each once, after those that there are. */
status pace_method_read_list(const char *text, int most, pace_method list[], int *count, fault *f);

/* Integrators side by side on motions in time: what each step costs, and what comes of it.
 *
 * Errors are of time alone: against a reference on the same mesh. */

/* Classification of a motion without loads, whose energy and momenta must be conserved. */
typedef enum pace_fate {
    PACE_UNJUDGED, /* something acts on it */
    PACE_GROWS,    /* its energy, by more than pace_growth */
    PACE_STOPS,    /* a step of this length finds no solution */
    PACE_BOUNDED,
    PACE_EXACT, /* energy and momenta within pace_energy and pace_momentum */
    PACE_FATES
} pace_fate;

/* Tolerances of the reference and of its checks, radau on the same mesh. */
enum { PACE_CHECKS = 2 };
extern const double pace_reference[1 + PACE_CHECKS];
/* Limits of E/E0 - 1, and of energy and momenta relative to their size. */
extern const double pace_growth, pace_energy, pace_momentum;

/* One motion: an integrator with a step or a tolerance. */
typedef struct pace_run {
    int group, series; /* of the sweep: a series and a point each, of one mesh */
    pace_method method;
    double step, tolerance; /* [s] the first one, of fixed steps all; 0: fixed */
    /* result; NAN: none */
    status status;
    const char *reason;               /* lives in the sweep */
    double error;                     /* largest over stations: places over size, turns [rad] */
    double *values;                   /* [quantities] errors, relative; owned */
    double order;                     /* against the run before, of twice the step */
    double cost, seconds, iterations; /* [s] counted, measured; of a step */
    long steps, rejected;
    double energy, momentum; /* largest drift, relative */
    double largest, last;    /* of E/E0 */
    double stopped;          /* [s] when it ended too early */
    pace_fate fate;
} pace_run;

/* Motions of one structure, mesh and formulation. */
typedef struct pace_group {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    formulation formulation;
    int elements;
    int analysis;       /* the motion */
    double step, end;   /* of the scene [s] */
    double from;        /* [s] from here on nothing acts; INFINITY: never */
    int first, runs;    /* in the list of all */
    int reference;      /* series, and after it those of its checks; -1: no errors are wanted */
    double uncertainty; /* of the reference; NAN: there is none */
    double order;       /* of the reference, by the steps and errors of its checks; NAN */
    char reason[FAULT_TEXT]; /* why not */
} pace_group;

typedef struct pace {
    sweep sweep;
    int groups, runs;
    pace_group *group;
    pace_run *run;
} pace;

void pace_free(pace *);
const char *pace_fate_name(pace_fate);
const sweep_point *pace_point_of(const pace *, const pace_run *);
const cell_result *pace_cell_of(const pace *, int index);

/* Verdicts on integrators, against a table of what is expected (expected.csv):
 *
 *   order      pass, low order or undecided, from errors at halved steps (experiments_impl.h)
 *   energy     conserved, or "order P" of its drift at halved steps, or drifts
 *   momentum   the same
 *   tolerance  for each of them the decimal logarithm of how many times it the error is; twice as
 *              much or as little is as expected
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

/* A row of the table; texts live there. */
typedef struct pace_verdict {
    pace_judged kind;
    const char *judged, *case_name, *parameters, *formulation, *integrator, *steps, *expected, *why;
    int elements;
    int group, first, count; /* runs */
    char found[PACE_FOUND];
    int as_expected;
} pace_verdict;

typedef struct pace_verdicts {
    own_table table;
    int count, unexpected;
    pace_verdict *verdict;
} pace_verdicts;

/* Is it what the table specifies? */
int pace_verdict_is_expected(const pace_verdict *);
/* Reads the table and plans its motions. REFUSED: its first mistake, with its line. */
status pace_verdict_plan(const char *path, pace *, pace_verdicts *, fault *);
/* After pace_judge. */
void pace_verdict_reach(const pace *, pace_verdicts *);
void pace_verdict_free(pace_verdicts *);

/* Integrators side by side on transient analyses: request and result. */

typedef struct motion_request {
    const char *expected;  /* table of verdicts, in the place of all that describes motions */
    const case_type *type; /* at the parameters */
    const double *parameter;
    const char *vary; /* NAME=A..B/N or NAME=A,B,C: of a parameter; NULL: none */
    const formulation *formulation;
    int formulations, elements;                   /* elements 0: those of the case */
    const char *integrators, *steps, *tolerances; /* lists; NULL: the usual ones */
    int conservation_only;                        /* 1: without a reference */
    int each; /* 1: a line for each of them in what is for people, not only verdicts */
    sweep_request cells;
} motion_request;

typedef struct motions {
    pace pace;
    pace_verdicts verdicts;
    int each, methods;
    pace_method method[PACE_LIST_MOST]; /* of all of them */
} motions;

extern const experiment_type experiment_motion;
void motions_free(motions *);

/* Columns of the results at points of a sweep: the form in which a batch is passed on and
 * stored. */

/* Kind of reference of an error. */
typedef enum rows_reference {
    ROWS_STORED,   /* a stored reference value at that very point */
    ROWS_DERIVED,  /* a reference value that a deriving program solved for there */
    ROWS_LIMIT,    /* the limit that the meshes of all formulations go to */
    ROWS_NONE,     /* no limit is known well enough */
    ROWS_DISPUTED, /* none: limits of formulations differ by more than they are uncertain */
    ROWS_REFERENCES
} rows_reference;

/* Status of a cell; smaller values are the words of `status`. */
enum {
    ROWS_NOT_OFFERED = STATUS_NO_VALUE + 1,
    ROWS_NO_SCENE,
    ROWS_NOT_COMPUTED, /* its batch is missing */
    ROWS_STATUSES
};

/* How many there are of each; they are the same at every point. */
typedef struct rows_shape {
    int formulations, meshes, quantities;
} rows_shape;

/* Columns of `points` points, in one piece of memory. The last index changes first. */
typedef struct rows {
    rows_shape shape;
    int points;
    size_t size;               /* [bytes] of all */
    double *first;             /* the piece: owned */
    double *reference, *doubt; /* [points, quantities] value and relative uncertainty; NAN */
    double *value, *error;     /* [points, formulations, meshes, quantities]; error relative; NAN */
    double *cost, *seconds;    /* [points, formulations, meshes] s: counted work, measured */
    int32_t *lacks;  /* [points, formulations] bits of model.h: of another model, which counts
                        nowhere; 0: of the scene's own */
    int32_t *least;  /* [points, formulations, quantities] elements from which on every mesh is
                        within  the tolerance; 0: none */
    uint8_t *kind;   /* [points, quantities] of rows_reference */
    uint8_t *status; /* [points, formulations, meshes] */
} rows;

/* All zero. FAULT: out of memory. */
status rows_alloc(const rows_shape *shape, int points, rows *out, fault *f);
void rows_free(rows *);
/* Bytes of this machine. 0, or -1 */
int rows_write(FILE *to, const rows *);
int rows_read(FILE *from, rows *);
/* Indices into the columns. */
size_t rows_quantity(const rows *, int point, int quantity);
size_t rows_cell(const rows *, int point, int formulation, int mesh);
size_t rows_value(const rows *, int point, int formulation, int mesh, int quantity);
size_t rows_lacks(const rows *, int point, int formulation);
size_t rows_least(const rows *, int point, int formulation, int quantity);
/* Words of the file. */
const char *rows_reference_name(int kind);
const char *rows_status_name(int status);

/* A sweep over parameters: which points, formulations, meshes and quantities, and how it is cut
 * into batches. It depends on the request and the build only. */

enum { RANGES_FORMULATIONS = 64, RANGES_QUANTITIES = 64 };

/* Request of a parameter study. */
typedef struct ranges_request {
    const case_type *type;
    const scene_file *file; /* that the case is read from; NULL: a built-in one */
    const double *base;     /* values of its parameters where they do not vary */
    int varies;
    const char *const *vary; /* [varies] as --vary says them */
    design_kind design;
    long points; /* of designs other than grids */
    unsigned long seed;
    int formulations;
    const formulation *formulation; /* 0: every one that runs */
    int meshes;
    const int *mesh; /* 0: those of the scene */
    const char *select;
    double tolerance;   /* relative error */
    int time_limit;     /* [s] of a cell; 0: none */
    const char *derive; /* program of reference/derive that computes reference values; NULL: none */
    const truths *truths; /* stored, of a built-in case; NULL: none */
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
    char left_out[FAULT_TEXT]; /* formulations that run at no point that was examined, in words */
    char
        omitted[SCENE_OMISSION_WORDS]; /* physics that the scene leaves out, at the first of them */
    char assumed[RANGES_ASSUMED];      /* of its sections (harness/records/records.h), there */
    long points_in_batch;              /* but for the last one */
    int batches;
    double point_cost; /* [s] about, of all cells of a point */
} parameter_ranges;

/* Nothing is solved. REFUSED: the culprit and the remedy. ranges_free frees it, also after a
 * failure. The request must outlive it. */
status ranges_make(const ranges_request *request, parameter_ranges *out, fault *f);
void ranges_free(parameter_ranges *);
rows_shape ranges_shape(const parameter_ranges *);
/* Points of a batch: *first, and how many. */
int ranges_batch(const parameter_ranges *, int batch, long *first);

/* One shard of a work: its batches, each computed by a process, each a file once it is done. */

enum { SHARD_MOST_JOBS = 64, SHARD_MOST = 100000 };

typedef struct shard_request {
    int index, count; /* 0-based: of that many shards the one */
    const char *into; /* folder; it is made where it is not there */
    int jobs;         /* processes, >= 1 */
    int stop;         /* ends once this descriptor can be read; 0: SIGINT, SIGTERM, SIGHUP end it */
    FILE *progress;   /* NULL: quiet */
    FILE *tell;       /* lines about what is damaged or was lost; NULL: none */
} shard_request;

typedef struct shard_outcome {
    int mine;        /* batches of the shard */
    int before;      /* that were there */
    int done;        /* that were computed now */
    int lost;        /* whose process ended before they were done */
    int interrupted; /* 1: the run was interrupted */
    double seconds;  /* that those computed now took, each in its process */
} shard_outcome;

/* "2/4" -> 1, 4. REFUSED: anything else. */
status shard_parse(const char *text, int *index, int *count, fault *f);
/* Computes the batches that are missing, the most expensive first. A batch whose process ends
 * without an answer is lost alone: it is computed when the shard is started again. REFUSED: the
 * folder has batches of another work. FAULT: disk, memory, or the batch itself: all ends, completed
 * batches are kept. */
status shard_run(const shard_work *w, const shard_request *request, shard_outcome *out, fault *f);

/* Lists as JSON: `beamwork list --format json`, and the same of the library. */

/* Lists all cases, and all formulations with the physics that they can support: 1: requested. */
status list_json_all(FILE *to, int cases, int formulations, fault *f);
/* Lists a case at values of its parameters: these, its quantities there, and the formulations that
 * run it. */
status list_json_case(FILE *to, const case_type *type, const double value[], fault *f);
/* Lists a formulation: what it declares, its options, the known deviations that apply to it (rules
 * NULL: null), and the cases it runs on. */
status list_json_formulation(FILE *to, const formulation *chosen, const rule *rules, int count,
                             fault *f);

/* Subjects of a list: everything, all cases, all formulations, or one of them. */

typedef struct list_subject {
    int cases, formulations; /* 1: all of them */
    const case_type *type;   /* one case */
    formulation chosen;      /* one formulation, perhaps with options; type NULL: none */
} list_subject;

/* name NULL: everything; else "cases", "formulations", a case or a formulation. REFUSED: nothing
 * there is, with the nearest name. */
status list_subject_find(const char *name, list_subject *out, fault *f);

/* Which batches of a work are there, in one or several folders. */

typedef struct stock_kind {
    machine node; /* the first of the kind */
    int batches;
} stock_kind;

typedef struct stock {
    int batches;
    const char *const *folder; /* of the caller */
    int folders;
    char stem[BATCH_STEM];
    int *where; /* [batches] index of the folder that has it, or -1 */
    int there, damaged, twice;
    int shards; /* of the batches that are there; 0: of different numbers */
    double seconds;
    int kinds; /* of machines */
    stock_kind *kind;
} stock;

/* Reads and checks the requested batches (wanted NULL: all), every byte; of one that is in two
 * folders the first is taken. damaged: each is reported in one line, if a stream is given, and
 * counts as missing. REFUSED: a batch of another build, request or plan, a file that is only named
 * like one, two batches that differ. FAULT: a folder that cannot be read. stock_free frees it, also
 * after a failure. */
status stock_take(const shard_work *w, const char *const folder[], int folders, const char *wanted,
                  FILE *tell, stock *out, fault *f);
void stock_free(stock *);
/* Path of a batch that is there. */
status stock_path(const stock *, int batch, char out[PATH_MAX], fault *f);
/* "3 of 149 batches are missing: 3, 7-12 (shards 2/4, 3/4)"; nothing where none is. */
void stock_missing(const stock *, const shard_work *, char *out, size_t size);
/* A line for each kind of machine where there are several. */
void stock_tell_kinds(const stock *, FILE *to);
/* The first batch of a folder that can be read, by its name: what merge asks again. REFUSED: there
 * is not one. */
status stock_first(const char *folder, batch_label *out, fault *f);

/* The batches of one or several folders, taken in canonical order, one at a time in memory. */

/* Takes every batch that is there. s: of stock_take. FAULT: one cannot be read (any more). */
status merge_take(const shard_work *w, const stock *s, fault *f);

/* Numbers of elements, as -n gives them. */

enum { MESHES_FINEST = 10000000 };

/* Adds "1,2,4" to mesh[most], of which *count are there. REFUSED: what is no whole number from 1 to
 * MESHES_FINEST, or too many. */
status meshes_parse(const char *list, int most, int mesh[], int *count, fault *f);

/* Summary of a sweep, counted while its points pass by: in how many a formulation is within the
 * tolerance, with how many elements, where not, and its worst points. */

enum { TALLY_WORST = 3, TALLY_COLUMNS = 10, TALLY_ROWS = 12, TALLY_SCENE = 64 };

/* A point that a formulation is worst at, with the finest mesh. */
typedef struct tally_worst {
    long point;
    int quantity;            /* -1: the cell has no solution */
    int status;              /* of the cell */
    double error;            /* relative; NAN: there is no value */
    char scene[TALLY_SCENE]; /* name of its scene file; empty: not kept */
} tally_worst;

/* Counts of a formulation for one quantity, or for all quantities together. For all together, a
 * point where one quantity is open is counted in `asked` only where another is never within; else
 * its result is not known. */
typedef struct tally_series {
    long asked;                     /* points with a reference */
    long proven;                    /* of them measured by a reference value */
    long open;                      /* points with a value and nothing to measure it by */
    long within[SERIES_MAX_MESHES]; /* of them, with each mesh */
    long never;                     /* of them, not with all meshes from some on */
    int everywhere;                 /* elements from which on all others are within */
} tally_series;

/* A place of the map. */
typedef struct tally_place {
    long points, other, asked, never; /* other: of another model */
    long proven; /* of those asked: measured by a reference value, not by limits of meshes alone */
    int least;   /* elements from which on all points here are within */
} tally_place;

typedef struct tally {
    const parameter_ranges *of;
    long points, without_scene, first_without; /* index of the first such point */
    long kind[RANGES_QUANTITIES][ROWS_REFERENCES];
    double doubt[RANGES_QUANTITIES];  /* the largest */
    int columns, lines;               /* of the map; 0: more than two axes */
    tally_series *series;             /* [formulations x (quantities + 1)], the last of all */
    tally_place *map;                 /* [formulations x (quantities + 1) x lines x columns] */
    long *failed;                     /* [formulations x meshes] cells without a solution */
    double *cost, *seconds;           /* [formulations x meshes] s: of all cells that ran */
    long *ran;                        /* [formulations x meshes] */
    long others[RANGES_FORMULATIONS]; /* points where it solves another model: they count nowhere */
    unsigned lacks[RANGES_FORMULATIONS]; /* what it leaves out there: bits of model.h */
    int worsts[RANGES_FORMULATIONS];
    tally_worst worst[RANGES_FORMULATIONS][TALLY_WORST]; /* the worst first */
} tally;

/* FAULT: out of memory. tally_free frees it, also after a failure. */
status tally_alloc(const parameter_ranges *r, tally *out, fault *f);
void tally_free(tally *);
/* Points from `first` on, each once, in their order. */
status tally_add(tally *, long first, const rows *, fault *f);
/* quantity: index, or the number of quantities: all together. */
const tally_series *tally_of(const tally *, int formulation, int quantity);
const tally_place *tally_at(const tally *, int formulation, int quantity, int line, int column);
/* Lower bound of a column (0) or a line (1) of the map: value of its axis. */
double tally_edge(const tally *, int axis_index, int place);

/* A sweep as a group of a file of results, written batch by batch: never more than a batch of it is
 * in memory. */

enum { RANGES_FILE_VERSION = 1, RANGES_FILE_COLUMNS = 11 };

typedef struct ranges_file {
    const parameter_ranges *of;
    const char *path;
    record_file record;
    hid_t at; /* its group */
    hid_t column[RANGES_FILE_COLUMNS];
} ranges_file;

/* The path outlives it. plan: digits that say which sweep it is. */
status ranges_file_open(const char *path, const parameter_ranges *r, const char *plan,
                        ranges_file *out, fault *f);
/* Points from `first` on. */
status ranges_file_add(ranges_file *, long first, const rows *, fault *f);
/* The last: worst points with the names of their scenes, and content:
 * digits of all values that are equal however they were computed. written: of what came before; not
 * OK: nothing is left. */
status ranges_file_close(ranges_file *, const tally *, const char *content, status written,
                         fault *f);

/* A sweep as work that can be cut into batches. */

typedef struct ranges_work {
    const parameter_ranges *of;
    double *cost;      /* [batches] */
    tally *tally;      /* where batches that are taken are counted ... */
    ranges_file *file; /* ... and stored; NULL: nowhere */
    FILE *csv;         /* where they are written as text; NULL: nowhere */
    int csv_begun;     /* 1: its head is there */
    digest content;    /* of all values that were taken, without times */
} ranges_work;

/* FAULT: memory. ranges_work_free frees it. */
status ranges_work_make(const parameter_ranges *r, ranges_work *out, fault *f);
void ranges_work_free(ranges_work *);
/* Which sweep it is, its identity, is the caller's to say. */
shard_work ranges_work_of(ranges_work *);

/* The batches of a sweep put together: what it comes to, its file, its worst points. */

typedef struct ranges_output {
    const char *path;      /* HDF5; NULL: none */
    const char *plan;      /* digits that say which sweep it is */
    char folder[PATH_MAX]; /* of the worst points' scenes; empty: none */
} ranges_output;

/* "sweep.worst" of "sweep.h5", and so on. REFUSED: the name is too long. */
status ranges_collect_beside(const char *path, const char *ending, char out[PATH_MAX], fault *f);
/* Is there room for the scenes? REFUSED: something else is there. */
status ranges_collect_check(const ranges_output *, fault *f);
/* A sweep whose batches are being taken. */
typedef struct ranges_collect {
    ranges_work *work;
    const ranges_output *output;
    tally tally;
    ranges_file file;
} ranges_collect;

/* From now on what the work takes, one batch in memory at a time, goes into the tally and the file.
 * The output must outlive it. */
status ranges_collect_begin(ranges_work *, const ranges_output *, ranges_collect *out, fault *f);
/* After the last one: the scenes of the worst points, the file. taken: how that went; not OK:
 * nothing is left. The caller frees the tally. */
status ranges_collect_end(ranges_collect *, status taken, fault *f);
/* Once all is written: takes the batches of a stock of one folder away, and the folder where
 * nothing else is in it. */
status ranges_collect_remove(const stock *, const char *folder, fault *f);

/* Properties that batches of one sweep share in addition to the command line. */

/* Points, formulations, meshes, quantities, and how it is cut. */
void ranges_identity_add(const parameter_ranges *r, digest *plan);

/* A sweep on a terminal. */

/* Head of the table: swept points, cells, and the axes. */
void ranges_table_head(FILE *to, const parameter_ranges *r);
/* Within PARAGRAPH_WIDTH: what errors are against; the share of points within the tolerance with
 * each mesh, for each quantity and formulation; where there are one or two axes the least elements
 * over them, of all quantities together (every: of each too); the worst points with their values
 * and a command that shows one. folder: of their scenes; "": none were kept. */
void ranges_table(FILE *to, const tally *t, int every, const char *folder, fault *f);

/* Results of a verification that are worse than in a former run. */

/* Adds to the judgement every mesh whose error is larger than in the former run (by more than 2 %
 * and RESULTS_FLOOR), that has no value or no success any more, what the former run has and this
 * one should, and limits of default points that moved by more than 1e-5 of themselves where no
 * exact reference value judges them as closely. Of a former run that is known by its short table,
 * errors series by series. Work is not compared. REFUSED: the two have nothing in common. */
status regressions_find(const stored_results *former, const char *name, const sweep *, judgement *,
                        fault *);

/* One cell of a case: requested, chosen by default, and solved. Command line and library both use
 * it. */

typedef struct solution_request {
    const case_type *type;
    const double *parameter; /* of the case */
    const char *select;      /* quantities that are requested, as of harness/study/study.h; NULL:
                                all */
    formulation formulation; /* type NULL: to be chosen */
    int elements;            /* of each member; 0: to be chosen */
    int keep_all, steps, shapes, threads;
    int keep_ends; /* 1: of motions */
    int restarts;
    const outcome_end *restart; /* [restarts] states that motions continue from; none without
                                   such motions */
    int systems;                /* 1: the matrices of small motions about all states are kept */
    double error; /* change of values from mesh to mesh that counts as none, relative; 0: default */
} solution_request;

/* Choices and their reasons: one line each; "" where it was given. */
typedef struct solution_choice {
    char formulation[FAULT_TEXT], elements[FAULT_TEXT];
    double *change; /* of each quantity, from the mesh before; NULL: elements were given */
    int short_of;   /* 1: of the error that was requested */
} solution_choice;
void solution_choice_free(solution_choice *);

/* Fills the formulation (harness/study/study.h), and the elements if requested; rules NULL: no list
 * of known deviations. REFUSED: no formulation supports what the case needs. solution_choice_free
 * in any case. */
status solution_choose(solution_request *, const rule *rules, int count, int elements,
                       solution_choice *why, fault *f);
/* One point, series and mesh, not yet run, with the quantities that are selected; sweep_free frees
 * them, also after a failure. */
status solution_plan(const solution_request *, sweep *, fault *);
/* Solves the one cell in this process. A cell that is not solved is a result all the same: not
 * after REFUSED and FAULT. NOT_CONVERGED also where the choice is short of the error that was
 * requested. */
status solution_run(const solution_request *, const solution_choice *, sweep *, fault *);

/* Final states of motions in a file: another run continues from there, bit-for-bit identical where
 * its steps are unchanged. */

typedef struct restart {
    char formulation[FORMULATION_KEY]; /* with its options */
    int elements, keep_all;
    char *scene; /* text of a scene file, without what may differ */
    int ends;
    outcome_end *end;
} restart;

/* Refused where no motion of the scene could be kept, before anything is solved. */
status restart_possible(const scene *, fault *);
/* The ends of the motions that were solved, with what they are of. Written beside and renamed. */
status restart_write(const char *path, const solution_request *, const sweep *, fault *);
/* FAULT: missing, damaged or foreign. restart_free frees it, also after a failure. */
status restart_read(const char *path, restart *, fault *);
void restart_free(restart *);
/* Prepares the scene to continue from there: its stations are those after it. REFUSED: another
 * scene, except for stations and quantities; another formulation or mesh; no station after it. */
status restart_begin(const restart *, solution_request *, scene *, fault *);

/* Which formulations run which cases, and what stands against it. */

enum { RUNS_ON_WORDS = 200 };

typedef struct runs_on {
    const char *name; /* of the case, or of the formulation */
    int runs;
    int other;                 /* 1: as another model (harness/study/study.h) */
    char words[RUNS_ON_WORDS]; /* missing features; where it runs: physics that it omits */
} runs_on;

void runs_on_scene(const scene *s, const element_type *type, runs_on *out);
/* The built-in cases at their defaults, at most `room`; their number. Whether as another model is
 * not examined: `other` is 0. */
int runs_on_cases(const element_type *type, runs_on out[], int room);

/* How long runs of cells take: rounds over the cells of a parameter point, for all cells of a sweep
 * that has been run. */

/* One more round: repeats until `floor` [s] of the processor's time are spent, at least once. A
 * cell that fails has a time too. */
void rounds_run(const cell_request *request, double floor, rounds_reading *out);
/* One more round beside those of the cell itself, which was solved with the result `cell`; nothing
 * for linear or very large ones. */
void dense_reference_round(const cell_request *own, const cell_result *cell, double floor,
                           dense_reference *out);

/* floor: least [s] a round spends on a cell. With several points the defaults are measured in full:
 * also the parts of an iteration and, on the middle mesh of each formulation, the run without
 * elimination; elsewhere rounds are short and long cells keep the time of their one run. Cells that
 * crashed are not run again. dense: the published algorithm is timed too. to: of the progress, or
 * NULL. */
status timing_run(sweep *s, double floor, int dense, FILE *to, fault *f);

/* Binds this process to the processor it runs on, so that repetitions are comparable. */
void rounds_pin(void);
/* Libraries that thread decide so when they are loaded: starts the program anew with one thread.
 * arguments: NULL-terminated. */
void rounds_single_thread(char **arguments);

/* Every formulation on every case and parameter point that has a truth: run, and judged as it
 * comes.
 */

/* Receiver of results that are evaluated while the rest is run. */
typedef struct verification_reader {
    void *context;
    /* A case, once, when all its series have been evaluated, in the order of the last of them; of
     * an interrupted run only what came before. */
    void (*judged)(void *context, const case_type *);
} verification_reader;

/* Holds the formulations that are named or loaded against the contract of the interface; then runs
 * a planned sweep (study.h) and judges its series in their order, each when all of its point
 * are done; the finest meshes are run again where verdicts may turn on their noise. Formulations
 * that agree become truths of scene files. whole: 1: nothing was selected away, unless the run is
 * interrupted. reader: NULL: none. judgement_free frees *out, also after a failure. */
status verification_run(const sweep_request *, int whole, const verification_reader *reader,
                        truths *, sweep *, judgement *out, fault *);

/* The cells of a planned sweep, or of some of its series, and their noise: not evaluated. */
status verification_cells(const sweep_request *, truths *, sweep *, fault *);
/* Judges a sweep whose cells have been run for the request. */
status verification_judge(const sweep_request *, int whole, truths *, const sweep *, judgement *out,
                          fault *);

/* The files that a verification leaves: HDF5, JSON, JUnit, Markdown, and the findings that it would
 * need. What they say of a case is put together as soon as the case is evaluated. */

typedef struct verification_files {
    const char *output, *json, *junit, *markdown, *propose; /* NULL: none */
    const sweep *sweep;
    const judgement *judged;
    store store;    /* open where there is an output */
    json_part part; /* likewise of JSON */
    int open;
} verification_files;

/* The paths are given; sweep and judgement live until the files are closed. */
status verification_files_open(verification_files *, const sweep *, const judgement *, fault *f);
/* A case, all of whose series have been evaluated: for a verification, with the files as context.
 */
void verification_files_case(void *files, const case_type *);
/* Writes all, with what it was computed on; of an interrupted run under names that say so. */
status verification_files_close(verification_files *, const overview *, const environment *e,
                                fault *f);
/* Without writing; nothing where they are closed. */
void verification_files_drop(verification_files *);

#endif
