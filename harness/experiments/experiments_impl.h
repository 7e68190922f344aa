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
    int component; /* component that is read at the end; ignored for a frequency or critical factor
                    */
} beam_request;

/* Constants of its section. */
status beam_section(const beam_request *, section *out);
/* Solves the beam and adds the error against the exact value to the measure; NAN if there is no
 * value, and `words` of the first gives the reason. Returns 0 when further points are useless: the
 * formulation does not support it, or the first three have no value. */
int beam_point(const beam_request *, double at, double exact, element_measure *one);

/* Certificates as text, one screen each. */

/* verbose: every check with its numbers; quiet: only failed checks. */
void certificate_text(FILE *to, screen look, const certificate *all, int count, int verbose,
                      int quiet);

/* Checks that results depend on each supported feature. */

/* Each declared feature of the section must change some result of the element, compared with the
 * element without it; warping must change the amplitudes. */
void effects_check(const formulation *chosen, claims *c);

/* Expected outcomes of a sweep of extremes (reference/extreme_findings.csv), and its counts. */

/* Reads the known deviations from the packed reference values at `path`. */
status extreme_expect_read(const char *path, extreme_sweep *out, fault *f);
/* Sets finding and as_expected of every outcome, and the counts. whole: 1 when no selection was
 * made, so that an unobserved deviation is a failure. */
void extreme_expect(extreme_sweep *s, int whole);

/* Classifies the number of an outcome as accurate, under-resolved or wrong. */

/* From the first mesh alone: accurate, a failure, or wrong until other meshes are known. */
status extreme_judge_first(const extreme_sweep *s, const truths *t, extreme_outcome *o, fault *f);
/* Does the error decrease to the finest mesh with an order of at least 0.5, as a discretisation
 * error does? */
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

/* [s] INFINITY: it is fixed, driven, or always loaded. */
double pace_alone_from(const scene *s);

/* Distance between two motions on the same mesh. */

/* Largest value, over stations, nodes and centre lines, of the distance of two positions relative
 * to the size of the structure, and of the angle between two sections [rad]. NAN: a station is
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
    PACE_ORDER_LOW,       /* significantly below the nominal one */
    PACE_ORDER_UNDECIDED, /* fewer than three errors above the floor, or orders that differ */
    PACE_ORDER_KINDS
} pace_order_kind;

/* Runs of one integrator in one group with fixed steps, the largest step first. */
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

/* Cost at equal error: the integrator, with its step or tolerance, that reaches an error at the
 * lowest cost. */

enum { PACE_LEVELS = 3 };
extern const double pace_levels[PACE_LEVELS];

typedef struct pace_reach {
    const pace_run *run; /* run within the error, as are all runs of its integrator with smaller
                            steps or tolerances; NULL: none */
    double cost; /* [s] interpolated between this run and the previous one at the error level */
} pace_reach;

/* For one integrator in one group. */
pace_reach pace_reach_of(const pace *, int group, const char *method, double level);
/* Different integrators of all groups, by name; returns their number. */
enum { PACE_METHODS_MOST = 32 };
int pace_reach_methods(const pace *, const char *name[PACE_METHODS_MOST]);

/* Records of motions and their evaluation. */

extern const record_type record_pace_all, record_pace_run;
extern const record_type *const pace_records[]; /* all except the first; NULL-terminated */

/* Motions and their evaluation as text. */

/* runs 1: also a line for each motion, in addition to verdicts. */
void pace_table(FILE *to, const pace *, const pace_verdicts *, int runs);

/* A sweep as CSV: one row for each point, formulation, mesh and quantity. */

/* Columns: the varied parameters, then formulation, elements, quantity, unit, value, reference,
 * reference_kind, error, status, cost, seconds. Missing values are empty. */
void ranges_csv_head(FILE *to, const parameter_ranges *r);
/* Adds points from `first` on. FAULT: out of memory. */
status ranges_csv_add(FILE *to, const parameter_ranges *r, long first, const rows *, fault *f);

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

/* Inside of the table of a sweep. */

enum { RANGES_TABLE_NAME = 24, RANGES_TABLE_COLUMN = 7, RANGES_TABLE_LINE = 1024 };

/* Name of a quantity, or of all together for `index` equal to their number. */
static inline const char *ranges_table_name(const parameter_ranges *r, int q)
{
    return q < r->quantities ? r->quantity[q].name : "all quantities";
}

/* ranges_request.c: writes the references of errors, and the points without a scene. */
void ranges_table_known(FILE *to, const tally *t);
/* ranges_request.c: writes the least number of elements over one or two axes; every: also for each
 * quantity. */
void ranges_table_map(FILE *to, const tally *t, int every);

/* Reference of the values at one point: a stored reference value, one computed by a deriving
 * program, or the limit of the meshes of all formulations with the same physics.
 *
 * Of the limits, the one with the smallest uncertainty U is used. Its uncertainty is U or, if
 * larger, its difference from another limit beyond the uncertainty of that limit. An uncertainty
 * above half of the tolerance is too large: such a reference value is ignored, such limits are
 * disputed or, if U itself is too large, unknown. */

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

/* As text of a scene file, which the caller frees. REFUSED: a file cannot express it. */
status restart_text(const scene *, char **out, fault *);
/* REFUSED: it differs from the previous text; the message gives the first different line. */
status restart_text_check(const char *former, const scene *, fault *);

/* Elements of a formulation under test: with everything that it supports, with each section, each
 * choice of each option, straight and curved. */

typedef void specimens_check(const specimen *s, claims *c);
/* Calls check for every test element. An element that is refused with a reason is skipped, except
 * the default one, which must be possible (check "prepare"). */
void specimens_each(const formulation *chosen, claims *c, specimens_check *check);

/* Preview of points of a sweep before the solution: quantities, meshes, formulations that run, and
 * the cost of a point. */

/* Sets formulations, meshes, quantities, left_out and point_cost from the scenes of the first, the
 * last and some intermediate points. REFUSED: no scene can be built at any of them, no formulation
 * runs, or the selection has an unknown word or selects nothing. */
status survey(parameter_ranges *r, fault *f);

/* The worst points of a sweep kept as scene files. */

/* Writes them to a new folder as "point_12.yaml", each point once, and stores the names in the
 * tally. A scene that a file cannot express is omitted. FAULT: disk or memory; no file remains. */
status worst_write(const char *folder, tally *t, fault *f);

#endif
