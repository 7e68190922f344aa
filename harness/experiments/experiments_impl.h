/* The inside of experiments/. */
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

/* A beam that is fixed at its beginning and loaded at its end, straight or bent into a quarter of a
 * circle, solved with one formulation. */

typedef enum beam_analysis { BEAM_LINEAR, BEAM_LARGE, BEAM_BUCKLING, BEAM_VIBRATION } beam_analysis;

/* The length is 1 m: along x, or along a quarter of a circle that begins along y and has its centre
 * at the origin. */
typedef struct beam_request {
    const formulation *chosen;
    int elements;            /* of equal length */
    const double *fraction;  /* [elements] of the length; NULL: equal */
    double thickness, width; /* of a rectangle, along y (towards the centre) and z [m] */
    int profile;             /* 1: an I that warps and is fixed at the beginning, in its place */
    int quarter;             /* 1: bent */
    unsigned needs;          /* FEATURE_* bits */
    beam_analysis analysis;
    scene_load_kind load; /* at the end: force or moment */
    double vector[3];     /* [N, N m] */
    int component;        /* of the end that is read; of a frequency or critical factor: any */
} beam_request;

/* Constants of its section. */
status beam_section(const beam_request *, section *out);
/* Solves it; one more point of the measure, the error of what is read against the exact value; NAN
 * where there is none, and the words of the first say why. 0: no more need be
 * asked: the formulation does not support it, or the first three have no value. */
int beam_point(const beam_request *, double at, double exact, element_measure *one);

/* Certificates for people, a screen each. */

/* verbose: every claim with its numbers; quiet: only what is broken. */
void certificate_text(FILE *to, screen look, const certificate *all, int count, int verbose,
                      int quiet);

/* Checks that results depend on each supported feature. */

/* Each feature of the section that it offers changes what some element of it says, against the
 * same element without that feature; with warping, the amplitudes do. */
void effects_check(const formulation *chosen, claims *c);

/* Expected outcomes of a sweep of extremes (reference/extreme_findings.csv), and its counts. */

/* The findings of the packed reference values at `path`. */
status extreme_expect_read(const char *path, extreme_sweep *out, fault *f);
/* Sets finding and as_expected of every outcome, and the counts. whole: 1 when nothing was selected
 * away, so that a known deviation that was not observed is a failure. */
void extreme_expect(extreme_sweep *s, int whole);

/* Is the number of an outcome a value, coarse, or wrong? */

/* From the first mesh alone: a value, a failure, or wrong until other meshes are seen. */
status extreme_judge_first(const extreme_sweep *s, const truths *t, extreme_outcome *o, fault *f);
/* Does the error fall as a discretisation error does: to the finest mesh, by order 0.5 at least? */
void extreme_judge_neighbours(const extreme_sweep *s, const truths *t, extreme_outcome *o);

/* Records of extremes, of outcomes and of the counts of a formulation. */

extern const record_type record_extremes_all, record_extreme, record_outcome, record_extreme_count;
extern const record_type *const extreme_records[]; /* all but the first; ends with NULL */
void extreme_gather(const void *found, const record_type *type, subjects *out);

/* Truths of one point of a sweep. */

typedef struct known_truths {
    truths stored, derived;
    int borrowed; /* 1: the rows of stored belong to the request */
} known_truths;

/* Reference values stored for the point; where none is stored and --compute-references was given,
 * those that a program of reference/derive computes. A program that fails gives none. FAULT: out of
 * memory. */
status known_at(const parameter_ranges *r, const sweep_point *p, known_truths *out, fault *f);
void known_free(known_truths *);

/* A process that computes batches, one after the other, and says what became of each. */

/* Shared by all processes. */
typedef struct labour_shelf {
    atomic_int next;                /* of the list */
    atomic_int at[SHARD_MOST_JOBS]; /* batch that a process is at, or -1 */
} labour_shelf;

typedef struct labour {
    const shard_work *w;
    const shard_request *request;
    int count; /* batches to do */
    int *list; /* [count] in the order in which they are begun */
    labour_shelf *shelf;
    machine here;
} labour;

/* Message about one batch, in one piece that fits into a pipe. */
typedef struct labour_notice {
    int batch;
    status status;
    double seconds;
    char text[FAULT_TEXT];
} labour_notice;

/* Takes batches until none is left, or one cannot be done; to: a pipe. */
_Noreturn void labour_work(const labour *, int self, int to);

/* From when on nothing acts on a structure: its energy and its momenta stay. */

/* [s] INFINITY: it is fixed, driven, or loaded for ever. */
double pace_alone_from(const scene *s);

/* How far a motion is from another one of the same mesh. */

/* Largest over the stations of the analysis and over nodes and centre lines: of the distance of two
 * places relative to the size of the structure, and of the angle between two sections [rad]. NAN: a
 * station is missing. */
double pace_distance(const cell_result *, const cell_result *other, int analysis);
/* Distance for a quantity of the scene, relative to the other value or near_zero; NAN: one is
 * missing. */
double pace_distance_of(const scene_quantity *, const quantity_result *,
                        const quantity_result *other);

/* Evaluates energy and momenta of a motion. */

/* Drifts, E/E0 and the fate of a run that is done. */
void pace_drift(const pace *, pace_run *);

/* Runs all motions and measures them. */

/* After pace_plan. A motion that fails is a result. */
status pace_judge(pace *, const sweep_request *, fault *);

/* Orders in time of an integrator, from runs of halved steps. */

typedef enum pace_order_kind {
    PACE_ORDER_PASS,
    PACE_ORDER_LOW,       /* significantly below the nominal one */
    PACE_ORDER_UNDECIDED, /* fewer than three errors above the floor, or orders that differ */
    PACE_ORDER_KINDS
} pace_order_kind;

/* Fixed steps of one integrator in one group, the longest first. */
typedef struct pace_ladder {
    int group;
    const pace_method *method;
    int first, count;     /* of the list of runs */
    double order, before; /* of the last three errors above the floor: the last, the one before */
    double floor;         /* errors below it are the reference's or of rounding */
    pace_order_kind kind;
} pace_ladder;

/* The order is below the nominal one by less than this: as of meshes (harness/study). */
extern const double pace_order_slack;

/* 1: what its steps do not resolve stops the order of the reference. */
int pace_order_is_stopped(const pace_group *);

/* From run `first` on. */
pace_ladder pace_order_of(const pace *, int first);
/* 1: the error of a quantity [relative] does not fall with the step: a force that follows what the
 * steps do not resolve, say. */
int pace_order_stands(const pace *, const pace_ladder *, int quantity);
/* Orders of all runs against the one before, of a longer step. */
void pace_order_fill(pace *);
const char *pace_order_name(pace_order_kind);

/* Which motions are run. */

/* Runs of one structure. */
typedef struct pace_plan_request {
    const case_type *type;
    const double *parameter;
    formulation formulation;
    int elements; /* 0: the second of its meshes */
    int methods;
    const pace_method *method;
    pace_list steps, tolerances; /* counts 0: none */
    int errors;                  /* 1: against a reference */
    int whole; /* 1: a step that finds no solution ends a motion, instead of being halved */
} pace_plan_request;

/* Steps or tolerances of the request, where none are given: from that of the scene. */
status pace_plan_usual(pace_plan_request *, fault *);
/* A group after those that there are. REFUSED: no motion, or nothing to run. */
status pace_plan_add(pace *, const pace_plan_request *, fault *);

/* Cost of an error: which integrator, with which step or tolerance, reaches it at the lowest
 * cost. */

enum { PACE_LEVELS = 3 };
extern const double pace_levels[PACE_LEVELS];

typedef struct pace_reach {
    const pace_run *run; /* that is within it, as are those of its integrator with smaller steps or
                            tolerances; NULL: none is */
    double cost;         /* [s] between that run and the one before, where the error is the level */
} pace_reach;

/* By one integrator in one group. */
pace_reach pace_reach_of(const pace *, int group, const char *method, double level);
/* Different integrators of all groups, by name; returns their number. */
enum { PACE_METHODS_MOST = 32 };
int pace_reach_methods(const pace *, const char *name[PACE_METHODS_MOST]);

/* Records of motions, and what is said of them. */

extern const record_type record_pace_all, record_pace_run;
extern const record_type *const pace_records[]; /* all but the first; ends with NULL */
/* found: motions. */
void pace_gather(const void *found, const record_type *type, subjects *out);

/* Motions and what is said of them, for people. */

/* runs: 1: a line for each of them too, not only verdicts. */
void pace_table(FILE *to, const pace *, const pace_verdicts *, int runs);

/* A sweep as CSV: a row for each point, formulation, mesh and quantity. */

/* The parameters that vary, then formulation, elements, quantity, unit, value, reference,
 * reference_kind, error, status, cost, seconds. What does not exist is empty. */
void ranges_csv_head(FILE *to, const parameter_ranges *r);
/* Points from `first` on. FAULT: out of memory. */
status ranges_csv_add(FILE *to, const parameter_ranges *r, long first, const rows *, fault *f);

/* Data that a sweep's group stores once. */

/* The request, before any point. */
void ranges_file_request(record_file *, hid_t at, const parameter_ranges *, const char *plan);
/* The worst points, after all of them. */
void ranges_file_worst(record_file *, hid_t at, const parameter_ranges *, const tally *);

/* The parameters of a point of a sweep. */

/* Values of all parameters at a point whose axes have these. */
void ranges_points_values(const parameter_ranges *, const double at[],
                          double value[CASE_MAX_PARAMETERS]);
/* "NAME=VALUE, NAME=VALUE": of the axes, with as many digits as they need. */
void ranges_points_text(const parameter_ranges *, const double at[], char *text, int size);

/* The cells of some points of a sweep, solved and measured. */

/* All points of a batch into rows that the caller frees, also after a failure. What a point, a cell
 * or a reference value fails with is a result; FAULT: memory or processes. */
status ranges_solve(const parameter_ranges *r, int batch, rows *out, fault *f);

/* Inside of the table of a sweep. */

enum { RANGES_TABLE_NAME = 24, RANGES_TABLE_COLUMN = 7, RANGES_TABLE_LINE = 1024 };

/* Name of a quantity, or of all together: index, or their number. */
static inline const char *ranges_table_name(const parameter_ranges *r, int q)
{
    return q < r->quantities ? r->quantity[q].name : "all quantities";
}

/* ranges_request.c: what errors are against, and points without a scene. */
void ranges_table_known(FILE *to, const tally *t);
/* ranges_request.c: the least elements over one or two axes; every: of each quantity, too. */
void ranges_table_map(FILE *to, const tally *t, int every);

/* Reference of the values at one point: a stored reference value, one that a deriving program
 * solves for, or the limit of the meshes of all formulations of the same physics.
 *
 * Of limits the one with the least uncertainty U counts; its uncertainty is U, or the difference
 * from another limit beyond that one's uncertainty if that is larger. An uncertainty of more than
 * half of the tolerance is too large to judge by: a reference value is passed over, limits are
 * disputed, or, where U alone is larger, not known. */

typedef struct point_reference {
    rows_reference kind;
    double value, doubt; /* value and its relative uncertainty */
} point_reference;

/* Reference of a series of the sweep and a quantity of its scene; stored, derived: reference values
 * of this point. NULL: none. */
point_reference reference_of(const sweep *s, int series_index, int quantity, const truths *stored,
                             const truths *derived, double tolerance);

/* The part of a scene that a continued motion depends on: all except its stations and
 * quantities. */

/* As text of a scene file, which the caller frees. REFUSED: no file can say it. */
status restart_text(const scene *, char **out, fault *);
/* REFUSED: it differs from the former text, with the first line that does. */
status restart_text_check(const char *former, const scene *, fault *);

/* The elements of a formulation that are examined: with everything that it offers, of each section
 * that it takes, each choice of each option, straight and curved. */

typedef void specimens_check(const specimen *s, claims *c);
/* Calls check for every test element; one that is refused with a reason is passed over, except the
 * usual one: that it can be made is a claim ("prepare"). */
void specimens_each(const formulation *chosen, claims *c, specimens_check *check);

/* Preview of points of a sweep, before anything is solved: quantities, meshes, formulations that
 * run, and the cost of a point. */

/* Fills formulations, meshes, quantities, left_out and point_cost from the scenes of the first, the
 * last and some points between. REFUSED: no scene can be built at any of them, no formulation runs,
 * the selection names nothing or holds for nothing. */
status survey(parameter_ranges *r, fault *f);

/* The worst points of a sweep kept as scene files. */

/* Writes them into a new folder, "point_12.yaml", each point once, and notes the names in the
 * tally; a scene that a file cannot express is omitted. FAULT: disk or memory; no file remains. */
status worst_write(const char *folder, tally *t, fault *f);

#endif
