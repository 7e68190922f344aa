/* study/: cells and their run, truths, verdicts, cost coefficients, times.
 *
 * Sections, in this order: limit; cell; imported values; omission; rules (known deviations);
 * truths; sweep; verdict; judgement; change (differences of meshes); checksum; child process;
 * claims; columns; curve error; data files; derive; workload; expense; families; follow;
 * glossary; handles; interrupt; meeting (equal error); narrow; noise; overview; user-defined
 * findings, tables and truths; plan; preference; cost of a cell; progress; proposal; reach;
 * rounding; rounds (times); run; scene truths; sentence; serialise; truth; worker. */
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

/* Limit of a sequence of values on finer and finer meshes, and how well it is known.
 *
 * The limit is Richardson's with an order of its own, from the last three meshes.  Its uncertainty
 * is the change of that limit when the last mesh was added, times 1.25, where two orders agree;
 * else the worst of the last changes, times 3.  No step takes the smaller of two estimates.
 * Sources: Roache, Verification and Validation in Computational Science and Engineering (1998),
 * grid convergence index and its factors 1.25 and 3; Eca and Hoekstra, J. Comput. Phys. 262 (2014)
 * 104-130, range of the data, poor orders, noise; Phillips and Roy, J. Fluids Eng. 136 (2014)
 * 121401, limits of extrapolated limits; Oberkampf and Roy, Verification and Validation in
 * Scientific Computing (2010), chapter 8. */

enum { LIMIT_MESHES = 32 };

/* Kind of a sequence, for the reader; a verdict rests on the value and its uncertainty alone. */
typedef enum limit_kind {
    LIMIT_NONE,            /* no value at all */
    LIMIT_NOISE_DOMINATED, /* the last two changes are noise */
    LIMIT_SETTLED,         /* known to 1e-4 of its size, or its last change is noise */
    LIMIT_ASYMPTOTIC,      /* two orders agree: value(n) = limit + c n^-order */
    LIMIT_OSCILLATING,     /* the last two changes differ in sign */
    LIMIT_NOT_YET,         /* drifting orders, or fewer than three meshes */
    LIMIT_KINDS
} limit_kind;

typedef struct limit_sequence {
    int count;           /* at most LIMIT_MESHES */
    const int *n;        /* [count] numbers of elements, in any order */
    const double *value; /* [count] non-finite values are omitted */
    double noise;        /* relative, measured; NAN: not measured */
    /* the least and the highest that formulation and quantity can show */
    double nominal_order, highest_order;
    /* [unit of value] size of the quantity where the limit may vanish; 0: its own size */
    double near_zero;
} limit_sequence;

typedef struct mesh_limit {
    limit_kind kind;
    double limit, limit_uncertainty; /* NAN, INFINITY: none */
    /* NAN where none is seen; uncertainty: difference of the last two orders */
    double order, order_uncertainty;
    double earlier_order; /* of the three meshes before those two orders; NAN: none */
    int order_turns; /* 1: of these three orders the middle one is clearly the least or the greatest
                      */
    double noise;    /* [unit of value] that was reckoned with */
    double last_change; /* |last value - the one before|; NAN: one mesh */
    /* coarsest mesh that was used, 0: none; number of meshes left after thinning */
    int from, meshes;
} mesh_limit;

mesh_limit limit_of(const limit_sequence *s);
const char *limit_kind_name(limit_kind kind);

/* One cell: case x parameter point x formulation with options x mesh. */

typedef struct cell_request {
    const scene *scene; /* valid, and shared by all cells of a point; NULL: to be built from ... */
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    scene_edit edit; /* ... these three */
    const element_type *formulation;
    double option[ELEMENT_MAX_OPTIONS];
    solve_options solve;
    int elements;
    int keep_all;
    unsigned omit; /* physics that the model leaves out: model_request */
    int threads;   /* of the loop over elements; 0, 1: one */
    /* 1: the same thing is solved already. Called once the model is made; may be NULL. */
    int (*is_known)(void *context, const model *);
    void *context;
} cell_request;

typedef struct cell_result {
    scene scene; /* owned: that the cell built itself, else empty */
    model_size size;
    counters counters;
    int left_out_lines;
    char **left_out;
    solve_result solve;
} cell_result;

/* Formulation, its options and its form of Newton's method. */
void cell_formulation(cell_request *, const formulation *chosen);
/* The scene of a case at its parameters, changed by the edit (NULL: as it is), and valid. The
 * caller frees it, also after a failure. */
status cell_scene(const case_type *type, const double parameter[], const scene_edit *edit,
                  scene *out, fault *f);
status cell_run(const cell_request *, cell_result *, fault *);
/* Quantities that have a value, of an analysis that failed too: what cannot be had takes nothing
 * with it. */
int cell_values(const cell_result *);
void cell_result_free(cell_result *);

/* Results of another program for a case: read from a file (harness/exchange), never run here. */

enum { IMPORTED_UNIT = 48, IMPORTED_FILE = 256, IMPORTED_WORD = 48 };

/* A value, in the units of the case: value = factor * (what the file specifies). */
typedef struct imported_row {
    int line;               /* of the file */
    int elements, unknowns; /* unknowns: 0: not said */
    char quantity[SCENE_NAME];
    char unit[IMPORTED_UNIT]; /* of the file */
    double factor;
    double seconds;            /* of the solution, as the file specifies; NAN: not said */
    double x;                  /* [SI] abscissa of a curve; NAN: no curve */
    double value, uncertainty; /* [unit of the quantity]; uncertainty NAN: not said */
} imported_row;

typedef struct imported {
    char program[FORMULATION_KEY]; /* stands where a formulation's key stands */
    char file[IMPORTED_FILE];
    /* "beam": the model of the beams; else another one, whose difference is an error of the model
     */
    char model[IMPORTED_WORD];
    char convention[IMPORTED_WORD]; /* of moments; empty: not said */
    int gates;                      /* 1: its verdicts count */
    int rows;
    imported_row *row;
    element_type type; /* in the place of a formulation: it offers nothing */
} imported;

/* 1: its values are of the continuum model of the beams. */
int imported_same_model(const imported *);
void imported_free(imported *); /* may be NULL */

/* Physics of a scene that a formulation omits, and the change due to that: none in the requested
 * quantities, or it solves another model. */

typedef struct omission {
    unsigned what;          /* FEATURE_* and OMIT_* bits (model.h); 0: nothing */
    char words[OMIT_WORDS]; /* the same, as results have it */
    int other;              /* 1: another model */
    int exact;              /* 1: there is none of it in the sections, or the analyses see none */
    double change;          /* bound, relative, of what it changes in asked values; NAN: unknown */
    char quantity[SCENE_NAME]; /* the one that it changes most; empty: none */
    char why[FAULT_TEXT];      /* the bound is unknown */
} omission;

/* Above this part of a value it is another model. */
extern const double omission_most;
/* that many times what two coarse solutions of a formulation that has the physics differ by, with
 * it and without it, bounds what it changes. */
extern const double omission_safety;

/* Fills the physics of a scene that the type omits. Where no formulation of the program has all of
 * it, or the one that has finds no values, the bound is unknown, and the model another one. */
void omission_of(const scene *, const element_type *, omission *out);
/* Change due to the omission on one mesh, of the requested value that it changes most; NAN: not all
 * have a value there, or no formulation has all of the scene. */
double omission_on_mesh(const scene *, unsigned what, int elements);
/* "without shear: changes no asked value by more than 2e-06", "another model: shear is not modelled
 * (changes frequency_1 by about 16 %)". */
enum { OMISSION_TEXT = OMIT_WORDS + SCENE_NAME + FAULT_TEXT + 80 };
void omission_words(const omission *, char text[OMISSION_TEXT]);

/* The list of known deviations (reference/findings.csv): verdicts that are expected although they
 * are not a pass, one rule for each cause. */

/* Lists are words separated by blanks, with * and ? for anything; one of them must fit. */
typedef struct rule {
    char *name;         /* one word */
    char *formulations; /* list: name with options ("beamw:mass=lumped"), or the bare name */
    char *cases;        /* list */
    char *condition;    /* terms joined by ';', all of which must hold; see rules_hold */
    char *quantities;   /* list */
    char *verdicts;     /* "wrong limit|undecided" */
    char *predicted;    /* list of "case/quantity" whose limit is predicted; empty: none */
    char *cause, *proof;
    /* relative, of the limit from the derived one, or from the reference value where none was
     * derived; beyond it the rule does not explain */
    double largest_error;
    char *from;        /* of a user's table: "file:line"; NULL: of the list of known deviations */
    int missed;        /* by the judge: 1: the run should have shown it and did not */
    int observed;      /* by the judge: verdicts it explains */
    unsigned foretold; /* by the judge: bits of the predictions that were met */
} rule;

/* Attributes that a rule applies to. */
typedef struct rule_subject {
    const case_type *type;
    const double *parameter;
    unsigned features; /* enum element_feature: what the scene needs */
    const char *formulation, *quantity, *verdict;
} rule_subject;

/* A term of the condition is a feature that the scene needs ("shear", "not shear") or compares a
 * parameter of the case ("omega>0", "load=tip|mid", "tip_deflection!=0.015", also < <= >=); one
 * that the case does not have does not hold. */
int rules_hold(const rule *, const rule_subject *);

/* Is the formulation (its key) among those of the rule? */
int rules_speak_of(const rule *, const char *formulation);

/* Features of a scene that it asks for, in its condition; 0: none. */
unsigned rules_features(const rule *);
/* Notes that a verdict met a prediction which the rule names. */
void rules_foretell(rule *, const rule_subject *);
/* The first term of the condition that is neither a feature nor compares a parameter of its cases,
 * into word; cases ends with NULL. 0: there is none. */
enum { RULES_WORD = 128 };
int rules_bad_condition(const rule *, const case_type *const cases[], char word[RULES_WORD]);
/* Next word of a list into word; where the rest begins, NULL at the end. */
const char *rules_next_word(const char *list, char word[RULES_WORD]);
/* Has a verdict shown it, and verdicts all its predictions? */
int rules_is_observed(const rule *);

/* FAULT names a column that is damaged, or a rule whose condition means nothing. */
status rules_read(const char *path, hid_t file, rule **out, int *count, fault *f);
void rules_free(rule *, int count);

/* The packed reference values and findings (reference/pack.py). */

enum { TRUTHS_VERSION = 3 };

typedef struct truth {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    int any[CASE_MAX_PARAMETERS]; /* 1: holds for any value */
    char *formulation;            /* "": the continuum */
    int elements;                 /* 0: the continuum, or a limit (kind predicted) */
    char *theory, *quantity, *unit, *kind, *model, *convention, *source;
    int on_curve; /* 1: a point of a curve, at its abscissa `at` */
    double at;
    double value, uncertainty;
    /* set by the judge: its quantity exists; not every formulation skips it */
    int met, judged;
} truth;

typedef struct truths {
    int rows, rules, room; /* room: rows that there is memory for */
    truth *row;
    /* of study_impl.h: the first row of each case and quantity, the next one of the same */
    int indexed, places; /* rows that it knows: the first ones */
    int *first, *next;   /* [places], [indexed] */
    rule *rule;          /* known deviations */
    int strangers;       /* cases of the file that the program does not have */
    char stranger[64];
} truths;

/* FAULT for a missing, truncated or foreign file and for a stale row (its case's defaults have
 * changed since). Formulations that affect the exit status are made known (formulations_accept). */
status truths_read(const char *path, truths *out, fault *f);
/* The same of one case (NULL: of all). */
status truths_read_case(const char *path, const case_type *type, truths *out, fault *f);
/* The known deviations and the formulations that affect the exit status, alone. */
status truths_read_rules(const char *path, truths *out, fault *f);
/* Adds the exact values at the extremes, which no verification runs. On failure the reference
 * values read before stay. */
status truths_read_extremes(const char *path, truths *out, fault *f);
/* Rows stay where they are until that many more are added. FAULT: out of memory. */
status truths_reserve(truths *, int more, fault *f);
/* One more row, all zero; NULL: out of memory. */
truth *truths_add(truths *, fault *f);
void truths_free(truths *t);

/* All cells of a verification: series of meshes for every case, parameter point and formulation,
 * run by several processes. */

enum { SERIES_MAX_MESHES = SCENE_MESHES };

typedef struct sweep_point {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    char text[PARAMETERS_TEXT]; /* differences from the defaults */
    char name[16];              /* "default" or the first digits of the hash */
    scene_edit edit;            /* that was made to the scene */
    int steps;                  /* load steps between stations; 0: the scene's */
    int condition;              /* 1: estimate the condition of the tangents */
    int shapes;      /* most states whose centre lines are kept of all its cells; 0: none */
    int whole_steps; /* 1: steps in time are not halved */
    scene scene;     /* of all its cells, with their quantities */
    status status;   /* of building the scene */
    char reason[FAULT_TEXT];
} sweep_point;

typedef struct series {
    int point;
    formulation formulation;
    /* what it cannot do without and the formulation does not support; empty: it runs, ... */
    char missing[200];
    omission without; /* ... without this, as another model where that matters */
    int meshes, mesh[SERIES_MAX_MESHES];
    cell_result *cell; /* [meshes]; their scenes are empty: the point has it */
    /* [quantities] relative, of the finest mesh; NULL: not measured */
    double *noise;
    struct cell_timing *timing; /* [meshes] of a benchmark (harness/study); else NULL */
    imported *imported;         /* another program's: its cells were not run here; else NULL */
} series;

typedef struct sweep {
    /* of the request: unselected quantities are not evaluated either; NULL: all are selected */
    const char *select;
    /* of the request, as they live there: its cases (NULL: it was planned by hand), and its
     * formulations where it is restricted to some */
    const case_type *const *cases;
    const formulation *given;
    int givens;
    int named;        /* of the request */
    double tolerance; /* of the request */
    int shapes;       /* of the request */
    int whole_only;   /* 1: what a formulation does not support keeps it from running */
    int values_only;  /* 1: what only curves and matrices show is not computed */
    int doublings;    /* of the request */
    int threads;      /* of the loop over elements in every cell; 0, 1: one */
    int unfinished;   /* cells that an interrupted run left; series that need them are gone */
    int partial;      /* 1: they belong to batches that are not there; no interruption */
    int points, seriess;
    sweep_point *point;
    series *series;
} sweep;

/* Follows a run while it continues: both functions are called in the process that runs it, between
 * two results. */
typedef struct sweep_follower {
    void *context;
    /* 1: the finest mesh of this series, whose cells are all done, is run again for its noise.
     * NULL: none is. */
    int (*doubts)(void *context, const sweep *, int series_index);
    /* Called once for every series, in their order, when it and all before it are complete and
     * their scatter is measured; a failure of it ends the run. An interrupted run removes the
     * series that are not complete: their places are those of the next ones. May be NULL. */
    status (*whole)(void *context, const sweep *, int series_index, fault *);
} sweep_follower;

typedef struct sweep_request {
    const char *select; /* expression over "case/point/formulation/quantity", or NULL */
    int jobs;           /* processes, >= 1 */
    int whole_only;     /* of the sweep */
    int share;      /* 1: cells that are known to have the same answers are solved once: they have
              the same times, too */
    int time_limit; /* [s] of one cell, measured by its process and from outside; 0: none */
    int together;   /* 1: a worker killed from outside (SIGKILL) ends this process too: its
                       results must not be taken for an answer. 0: its cell has crashed */
    int interruptible; /* 1: who asks to end (Ctrl-C) ends the run, and what is finished is kept */
    int stop;          /* likewise once this descriptor can be read; 0: none */
    const case_type *const *cases; /* NULL-terminated; NULL: all that there are */
    int doublings;    /* that many meshes beyond the scene's finest, each of twice the elements */
    int formulations; /* restrict to these, or 0: all */
    const formulation *formulation;
    int named; /* 1: these were requested by name: they affect the exit status, also where the
                  project has not accepted them yet */
    /* relative tolerance in place of those of the cases: an error within it passes; 0: those of the
     * cases */
    double tolerance;
    /* most states of a path whose centre lines are kept, of the finest mesh at the defaults; 0:
     * none */
    int shapes;
    const sweep_follower *follower; /* NULL: none */
    FILE *progress;                 /* NULL: quiet */
    const char *things;             /* what the cells are called there; NULL: cells */
} sweep_request;

/* Text that a selection matches: case/parameters/formulation/quantity. */
enum { SWEEP_TEXT = PARAMETERS_TEXT + FORMULATION_KEY + 2 * FAULT_TEXT };
void sweep_text(const sweep_point *, const formulation *, const char *quantity,
                char text[SWEEP_TEXT]);
/* Does the sweep's selection hold for a quantity? */
int sweep_selects(const sweep *s, const sweep_point *p, const formulation *chosen,
                  const char *quantity);

/* 1: the verdicts of a series affect the exit status. They do for accepted formulations, for those
 * that were named or loaded, and on request for other programs. */
int sweep_gates(const sweep *, const series *);
/* Request that runs one mesh of a series. */
cell_request sweep_cell(const sweep *s, int series_index, int mesh);
int sweep_cells(const sweep *s); /* that are run here */
void sweep_series_free(series *);
void sweep_free(sweep *s);

/* Result of a quantity of a series against its reference value. */

typedef enum verdict_kind {
    VERDICT_PASS,
    VERDICT_BIASED,      /* within the tolerance, but a significantly different limit */
    VERDICT_WRONG_LIMIT, /* a limit significantly beyond the tolerance */
    /* the same two where the limit is the one derived for the formulation */
    VERDICT_BIASED_AS_PREDICTED,
    VERDICT_WRONG_AS_PREDICTED,
    VERDICT_LOW_ORDER,
    VERDICT_UNDECIDED, /* the limit is not known well enough for any of the others */
    VERDICT_DIVERGED,  /* the finest mesh has no value: not converged, singular, crashed */
    VERDICT_REFUSED,
    VERDICT_SKIP,        /* needs what the formulation does not support */
    VERDICT_NO_TRUTH,    /* none of its own theory of shear, at least */
    VERDICT_OTHER_MODEL, /* without physics of the scene that change the requested quantity */
    VERDICT_KINDS
} verdict_kind;

typedef struct verdict {
    int series, quantity; /* into the sweep, into the scene's quantities */
    verdict_kind kind, expected;
    /* to judge by: of the same model and the formulation's theory of shear; NULL: none */
    const truth *truth;
    /* of another model, or of another theory or an agreement of formulations where there is none to
     * judge by; NULL: none */
    const truth *model_truth;
    const truth *predicted; /* the limit that was derived for the formulation; NULL: none */
    /* a published value that the limit differs from by more than both are uncertain; NULL: none */
    const truth *contradicted;
    mesh_limit fit;
    double finest; /* value on the finest mesh, NAN: none */
    /* (limit - truth)/truth, relative to near_zero where the reference value is near zero; NAN */
    double error;
    double departure;   /* the same of the limit from the derived one; from the reference value
                           without one */
    double model_error; /* against the reference value of another model */
    /* absolute, uncertainty of the reference value and what is not modelled included */
    double tolerance;
    double unmodelled; /* absolute: bound of the change due to omitted physics */
    /* 1: the limit differs from the reference value by less than the reference value is uncertain
     */
    int below_digits;
    int matches;       /* 1: verdict as expected */
    int needs_finding; /* 1: of a formulation that is new or was named: not a pass, and without a
                          known deviation */
    const rule *rule;  /* the one that explains what is not a pass; NULL: none */
    char reason[FAULT_TEXT];
} verdict;

const char *verdict_name(verdict_kind kind);
/* Verdicts on a limit that is another one than the truth. */
enum { VERDICT_DEFECTS = 4 };
extern const verdict_kind verdict_defects[VERDICT_DEFECTS];
/* Does the rule explain one of them? */
int verdict_tells_defect(const rule *);
/* Analysis that the order of a quantity depends on. */
element_analysis verdict_analysis(const scene *, const scene_quantity *);
/* Limit of a quantity of a series, without its `left_out` finest meshes. */
mesh_limit verdict_limit(const sweep *s, int series_index, int quantity, int left_out);
/* The truth that a formulation is evaluated by: of the same model and of its own theory of shear;
 * or NULL. */
const truth *verdict_truth(const truths *t, const sweep_point *p, const formulation *chosen,
                           int quantity);
/* The same, or where there is none the agreement of the formulations, which is informative only and
 * never affects the exit status. */
const truth *verdict_reference(const truths *t, const sweep_point *p, const formulation *chosen,
                               int quantity);
/* Evaluates the series for the quantity, both given in v: kind, fit, errors, and as_expected where
 * that holds without the known deviations. */
void verdict_reach(const sweep *s, const truths *t, verdict *v);
/* Relative error of a value of a quantity against a truth. */
double verdict_error(const scene_quantity *q, double value, double truth_value);

/* The judge: case x point x formulation x quantity against reference values and expected verdicts.
 */

/* A value of one mesh against its own stored discrete value. */
typedef struct agreement {
    int series, mesh, quantity;
    const truth *truth;
    double value;
    int good;
} agreement;

/* A cell with an inconsistent run record (study_impl.h). */
typedef struct flaw {
    int series, mesh;
    char why[FAULT_TEXT];
} flaw;

/* A formulation that does not keep the contract of the interface (elements/element.h). */
typedef struct breach {
    char formulation[FORMULATION_KEY];
    char why[FAULT_TEXT]; /* the first claim that is broken */
} breach;

/* A mesh, or a series, that is worse than in a former run. */
typedef struct regression {
    char of[FAULT_TEXT]; /* case/parameters/formulation, and the mesh */
    char why[FAULT_TEXT];
} regression;

enum { COVERAGE_MESHES = 4 };

/* How often the limits of a formulation on a case lie within their uncertainty of an exact
 * reference value, without the k finest meshes: the check of the uncertainties themselves. A
 * formulation with biased limits covers less: that is no fault of the uncertainties. */
typedef struct coverage {
    const case_type *of;
    const element_type *type;
    int point; /* the first of the case in the sweep */
    /* [k]; series with three meshes or more left */
    int series[COVERAGE_MESHES], covered[COVERAGE_MESHES];
} coverage;

typedef struct judgement {
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
    int unexpected; /* verdicts that differ from the expected one */
    int is_new;     /* verdicts of new formulations, which do not affect the exit status ... */
    int proposed;   /* ... and those among them that would need a finding */
    int disagreements;
    int judged; /* verdicts that compare with a reference value */
    /* rules that no verdict showed, or predictions of theirs: of the known deviations (whole runs
     * only), of the user's tables (study_impl.h) */
    int unobserved;
    int unmet; /* reference values that match no case, point or quantity (whole runs only) */
    /* truths that every formulation skips, or of one that is not here (whole runs only) */
    int waiting;
    int unread; /* truths of motions at instants that the run does not read (whole runs only) */
} judgement;

/* 1: verdicts of the series may turn on the noise of its finest mesh, which is then worth
 * measuring. */
int judgement_doubts(const sweep *s, const truths *t, int series_index);
/* Begins with the planned series, which are then judged one by one, in their order, when they have
 * been run. FAULT when a reference value has another unit than its quantity. */
status judgement_begin(const sweep *s, truths *t, judgement *out, fault *f);
status judgement_add(const sweep *s, truths *t, int series_index, judgement *out, fault *f);
/* whole: 1 when nothing was selected away, so that a rule that was not observed and a reference
 * value that matches nothing are failures. */
void judgement_end(const sweep *s, truths *t, int whole, judgement *out);
/* All three. */
status judgement_make(const sweep *s, truths *t, int whole, judgement *out, fault *f);
void judgement_free(judgement *j);
enum { JUDGED_AS_EXPECTED = 0, JUDGED_DIFFERS = 1, JUDGED_NOTHING = 3 };
/* Exit code: 0 as expected, 1 a verdict that counts is not as expected, 3 nothing was evaluated. It
 * is the only place that determines how a run ended. */
int judgement_exit(const judgement *j);
/* "pass", "fail", "nothing was evaluated". */
const char *judgement_outcome(const judgement *j);

/* How far the values of two meshes are apart, with a scale for those that are zero but for
 * round-off: by symmetry, in hinges, beside the plane of a plane frame. */

typedef struct value_change {
    double largest;  /* INFINITY: not known, or one mesh alone has a value */
    int which;       /* its quantity, -1: none */
    int missing;     /* 1: there are values that neither mesh has; a finer one may */
    double *of_each; /* [quantities of the scene] by the value, or by its scale where that is
                        larger; of a curve, by its largest value; NAN: not known */
} value_change;

/* Change of `now` from `before`, into out, whose of_each the caller has allocated. Measures of the
 * error of a solution (the energy-balance error) are omitted. */
void change_between(const scene *s, const cell_result *before, const cell_result *now,
                    value_change *out);
/* Size [unit of the quantity] of which round-off is a small part: strains of 1e-14, turns and parts
 * of the structure's size of 1e-12, parts of 1e-9 of other values in the same unit. */
double change_scale(const scene *s, int quantity, const solve_result *r);

/* The last line of a beamwork file: its length and checksum. A file that is cut short, damaged or
 * altered is detected before the HDF5 library reads it, which trusts its contents (version 1.10
 * reads beyond its buffers in damaged files). */

enum { CHECKSUM_LENGTH = 40 }; /* "beamwork-seal %016zx %08x\n" */

void checksum_write(const void *data, size_t size, char out[CHECKSUM_LENGTH + 1]);
/* The same of a whole file that has no such line yet. FAULT: it cannot be read. */
status checksum_of_file(const char *path, char out[CHECKSUM_LENGTH + 1], fault *f);
/* FAULT: missing, foreign, or not what was written. */
status checksum_check(const char *path, fault *f);

/* A process that works for the one that started it: it ends with that one, and keeps a time limit
 * by itself. */

/* In the child, before all else: ends with its parent, even one that is killed or was already gone;
 * an alarm ends it. */
void child_begin(pid_t parent);
/* In the child: from now on that many seconds are left; 0: no limit. */
void child_alarm(int seconds);
/* In the parent: has it ended? It is not reaped. */
int child_is_gone(pid_t process);
/* In the parent, which waits two seconds at most: reaps one that ends, or kills one that does not.
 * Returns how it ended (of waitpid). */
int child_reap(pid_t process);
/* In the parent: how it ended (of waitpid), in words; late: it was ended for being late. Returns 1
 * when the time was over. */
int child_ended(int how, int late, int seconds, char *words, size_t size);

/* Duplicate solutions among several processes: the first one solves it, the others take its
 * answer. */

typedef struct claims claims;

/* Room for that many things, shared with all processes that are started from now on; NULL: no
 * memory.
 */
claims *claims_alloc(int count);
void claims_free(claims *);
/* The task that was the first to claim this; `task` itself where it is the first. */
int claims_take(claims *, const identity *, int task);

/* Reading a table that is stored as one HDF5 data set per column. Every size and type is
 * checked. */

typedef struct table_columns {
    const char *path; /* of the file, for messages */
    hid_t group;
    char name[64]; /* of the group, for messages */
    int rows;
    fault *f;
} table_columns;

typedef struct columns_field {
    const char *column;
    int is_text; /* 1: char *, malloced; 0: double */
    size_t offset;
} columns_field;

/* FAULT: the column is missing or damaged. */
status columns_broken(const table_columns *r, const char *column);
/* Number of rows of a column, or -1. */
int columns_length(hid_t group, const char *column);
/* out[rows], of the memory type `type`. */
status columns_numbers(const table_columns *r, const char *column, hid_t type, void *out);
/* Fixed-length strings; out[rows], each malloced. */
status columns_strings(const table_columns *r, const char *column, char **out);
/* One column into a field of an array of structs base[rows]. On failure the strings read so far are
 * in it. */
status columns_read(const table_columns *r, const columns_field *field, void *base, size_t stride);

/* How far curves of one quantity are apart: of the meshes of a formulation, of two formulations. */

/* Largest difference over the points that both have, by the largest value of the second; at (may be
 * NULL): the point of it. Points of a path with given stations are compared by their number, others
 * where they have the same abscissa. NAN: there are none, or `one` does not reach the end. */
double curve_error_between(const scene *s, int quantity, const solve_result *one,
                           const solve_result *two, int *at);
/* The finest mesh of a series that has all of the curve; -1: none. */
int curve_error_finest(const series *, int quantity);
/* The series that others are compared with: whose curve changed least when its last mesh was added;
 * -1: none. */
int curve_error_reference(const sweep *, int quantity);

/* Location of the data that the program reads: reference values, programs that derive them. */

/* Beside the program or the shared library, or in the folder above (a clone), or in share/beamwork
 * of the folder that it is installed below, or of the prefix that it was built for; the first of
 * these that is there. 0: none is, and the path is that beside the program. */
int data_place(const char *name, char path[PATH_MAX]);
/* The packed truths: BEAMWORK_TRUTHS, or data_place. */
void data_place_truths(char path[PATH_MAX]);
/* Processes that are started from now on find beamwork_element.py after all that PYTHONPATH names:
 * its folder, where there is one, is appended to it, and Python leaves no compiled files. */
void data_place_modules(void);

/* Truths at new parameter points, on demand: the deriving programs of reference/derive, which share
 * nothing with this one, solve for them. */

typedef struct derived_value {
    char quantity[SCENE_NAME], unit[16], convention[96], source[96];
    double value, uncertainty; /* [unit] */
} derived_value;

/* Location of a program of reference/derive: in BEAMWORK_REFERENCE, or where data are. FAULT: too
 * long a path. */
status derive_script(const char *name, char out[PATH_MAX], fault *f);
/* Runs `script CASE PARAMETERS`. REFUSED with its line when no program derives the case or the
 * parameters; FAULT when it could not be run or said something else. *out: malloced. */
status derive_values(const char *script, const char *case_name, const char *parameters,
                     derived_value **out, int *count, fault *f);
/* The same of `script` with a scene, as write_scene writes it, on its standard input; what of it no
 * program derives is said on standard error, a line each. */
status derive_scene(const char *script, FILE *scene_text, derived_value **out, int *count,
                    fault *f);

/* Tasks of a run: cells, and those that arise while they are run. These are finest meshes again,
 * for their scatter, and cells that wait for the answers of another which then has none. */

enum { WORKERS_MOST = 64 };

typedef struct workload_task {
    int series, mesh;
    int again; /* 0: the cell; k > 0: the same in other words, number k - 1 */
} workload_task;

/* Shared by all processes: what there is to take, and what each worker is at. */
typedef struct board {
    atomic_int next;             /* of the tasks that were known from the beginning */
    atomic_int later, taken;     /* tasks that came up; those of them that were taken */
    atomic_int ended;            /* 1: no more come up */
    sem_t news;                  /* wakes the waiting process for news and at the end */
    atomic_int at[WORKERS_MOST]; /* -1: nothing */
    /* [s] of a clock that only goes forward: when it was taken */
    _Atomic double since[WORKERS_MOST];
    atomic_int came_up[]; /* task, ~task: to be solved whoever has the same answers */
} board;

/* Open work of a series: some of its cells, its scatter, nothing. */
enum series_state { SERIES_CELLS, SERIES_NOISE, SERIES_WHOLE };

typedef struct workload {
    sweep *s;
    const sweep_follower *follower; /* NULL: none */
    int time_limit;                 /* [s] of one cell; 0: none */
    int together;                   /* of the request */
    int count, all;       /* tasks: the cells in their order of cost, then two for each series */
    workload_task *tasks; /* [all] */
    char *done;           /* [all] 1: it has its result */
    int due, finished;    /* of those that are to be done */
    int *open;            /* [seriess] tasks of it that are to be done */
    char *state;          /* [seriess] enum series_state */
    int told;             /* series that were passed to the follower */
    cell_result *again;   /* [all - count] */
    claims *known;        /* of what is solved once; NULL: every cell is solved */
    int *waits, *after; /* [all] first task that waits for the answers of this one; the next such */
    int out_of_memory;
    size_t size; /* [bytes] of the board */
    board *board;
} workload;

/* FAULT: out of memory. workload_end frees it, also then. */
status workload_begin(const sweep_request *, sweep *, workload *, fault *);
void workload_end(workload *);

/* Child: the next task of worker `self`, which waits until there is one; -1: none any more.
 * *alone: 1: solved whoever has the same answers. */
int workload_take(const workload *, int self, int *alone);
/* In what other words, where it is for the noise; the point's own edit else. */
scene_edit workload_edit(const workload *, int task);

/* Destination of the result of a task. */
cell_result *workload_cell(const workload *, int task);
/* The result is there, or the failure. */
void workload_done(workload *, int task);
/* The task has the answers of another one. */
void workload_same(workload *, int task, int same);
/* A share of the whole work that is known, by what cells cost: 0 to 1. */
double workload_share(const workload *);

/* 1: the next series, in their order, can be passed to the follower. */
int workload_can_tell(const workload *);
/* Passes that series to the follower. */
status workload_tell(workload *, fault *);
/* Series that are not whole are taken out: they show nothing. */
void workload_keep_whole(workload *);

/* Cost of cells before they are solved: cost coefficients of the steps of their analyses, fitted to
 * counted work (`make lab L=expense`, harness/study/expense.csv). The order of work, batches and
 * shards rest on it, no answer does. */

/* Cost items, each as often as it is due. */
typedef enum expense_kind {
    EXPENSE_cell, /* once */
    EXPENSE_linear,
    EXPENSE_buckling,
    EXPENSE_loaded_buckling, /* about a loaded state: with the path to the critical point */
    EXPENSE_modal,
    EXPENSE_load_step,
    EXPENSE_compliance, /* of a station */
    EXPENSE_continuation,
    EXPENSE_rotation_step,
    EXPENSE_rotation_station,
    EXPENSE_alpha_step, /* of a motion in time, by its integrator */
    EXPENSE_conserving_step,
    EXPENSE_radau_step,
    EXPENSE_explicit_step,
    EXPENSE_KINDS
} expense_kind;

/* [s] on the reference machine: once, and for each element of all members; or factors of these. */
typedef struct expense_price {
    double once, element;
} expense_price;

typedef struct expense_factor {
    const char *formulation; /* without options; NULL: those without a row */
    expense_price factor;
} expense_factor;

/* Generated; the factors end with those of any other formulation. */
extern const expense_price expense_work[EXPENSE_KINDS];
extern const expense_factor expense_factors[];

/* How often each kind is due in a cell of the scene; steps: load steps between stations, 0: the
 * scene's. */
void expense_count(const scene *s, int steps, double times[EXPENSE_KINDS]);
/* [s], about; elements: of each member. */
double expense_of_scene(const scene *s, int steps, const element_type *type, int elements);
double expense_of_cell(const sweep *s, int index, int mesh);
/* All cells of a sweep, tasks[sweep_cells]: those of expensive series first, the most expensive at
 * the beginning, so that only small ones remain at the end; then the others in the order of the
 * series, so that series become complete one after the other during the run. Of a series the finest
 * mesh first. Expensive: more than a hundredth of the work of one process. 0: done; -1: out of
 * memory. */
int expense_order(const sweep *s, int jobs, workload_task tasks[]);

/* Agreement for structures without a reference value: the limit on which formulations of different
 * families agree.  Types of one family share code or theory: that they agree proves little;
 * families that agree can all be wrong together, so that an agreement is informative only and never
 * affects the exit status. A formulation with a known deviation for a feature of the scene (a rule
 * with that feature in its condition) does not vote, nor does one with `misprint`.
 *
 * Each formulation has a limit L and its uncertainty U.  Two agree when they have the
 * same theory of shear in stability, where that matters, and |L1 - L2| + U1 + U2 is within
 * FAMILIES_APART of their size.  Around the limit that most families agree with, at least two, the
 * reference is the mean by 1/U^2 of those that are within their U of it; its uncertainty is that of
 * the mean or their spread by the same weights, whichever is larger.  Others that are off by more
 * than their U are named.  Where no two families are that near, it is the limit of the one with the
 * nearest of another family, uncertain by their distance and U.  Where as many families agree on
 * another limit, there is no reference. */

/* Relative: half of the one per cent that `converge` answers for. */
#define FAMILIES_APART 5e-3
enum { FAMILIES_MOST = 8 };

typedef struct families_limit {
    int families;              /* that agree; below two: no reference */
    int disputed;              /* 1: as many agree on another limit */
    double value, uncertainty; /* [unit of the quantity] */
    int series[FAMILIES_MOST]; /* the nearest of each family, `families` of them */
    int others;                /* that are near, and off by more than their uncertainty */
    int other[FAMILIES_MOST];
    unsigned theory; /* of shear in stability, enum element_feature; 0: it does not matter */
} families_limit;

/* Limit for one point and quantity; for tests too, which see a dispute and how many agree. */
families_limit families_limit_of(const sweep *s, int point_index, int quantity, const truths *);
/* Adds a reference value of kind agreement for every quantity of a point that has none of its
 * model. files_only: 1: of scene files, not of built-in cases. */
status families_add_truths(const sweep *s, int files_only, truths *t, fault *f);
/* The same of one point, all of whose series are done. */
status families_add_point(const sweep *s, int point_index, int files_only, truths *t, fault *f);
/* Room for all that can be added, before the first verdict refers to a truth. */
status families_reserve(const sweep *s, int files_only, truths *t, fault *f);

/* Modes followed over a parameter of a case.
 *
 * Those of neighbouring values are matched by the modal assurance criterion of the mass matrix M at
 * the new one, (v^T M w)^2/((v^T M v)(w^T M w)), which is 1 of the same shape.  Where a match is
 * below 0.9 the step is halved.  Equal frequencies have no shapes of their own: the shape of before
 * is projected into their space.  Frequencies of followed modes then cross, or avoid each other
 * (veer) while their shapes change places. */

typedef struct follow_request {
    cell_request cell; /* with the type and its parameters; what of it is solved is set here */
    int parameter;     /* index of the one that varies */
    double from, to;
    int parts; /* equal ones at least */
} follow_request;

typedef struct follow_sample {
    double value;      /* of the parameter */
    int asked;         /* 0: between two values that were requested */
    double *frequency; /* [modes] [Hz] */
    double *match;     /* [modes] with the sample before; of the first: 1 */
} follow_sample;

typedef struct follow_event {
    int crossing; /* 0: a veering */
    int mode[2];
    double value;     /* of the parameter */
    double frequency; /* [Hz] mean of both */
    double gap;       /* of a veering: least distance of the two, relative to it */
} follow_event;

typedef struct follow_curves {
    int modes, samples, events;
    follow_sample *sample; /* [samples] from `from` to `to` */
    follow_event *event;   /* [events] */
} follow_curves;

/* As many modes as the first modal analysis has frequencies as quantities, the lowest at `from`.
 * REFUSED: no modal analysis, or coordinates that change with the parameter; NOT_CONVERGED: a mode
 * is lost however small the step. */
status follow_run(const follow_request *, follow_curves *, fault *);
void follow_free(follow_curves *);

/* Words of the program and the report, explained (reference/glossary.csv), as they are packed. */

typedef struct glossary_entry {
    char *term;
    char *also;    /* other names, separated by '|'; "": none */
    char *group;   /* heading; entries of one group stand together */
    char *meaning; /* one to four sentences */
    char *see;     /* terms for further reading, separated by '|'; "": none */
} glossary_entry;

typedef struct glossary {
    int entries;
    glossary_entry *entry;
} glossary;

enum { GLOSSARY_WORD = 128 };

/* FAULT: the packed reference values are missing, damaged, or have none. */
status glossary_read(const char *path, glossary *out, fault *f);
void glossary_free(glossary *);
/* The entry that has the word as its term or another name, whatever its letters' case, '_' and '-'
 * as blanks; NULL: none. */
const glossary_entry *glossary_find(const glossary *, const char *word);
/* Are two words the same to glossary_find? */
int glossary_same(const char *a, const char *b);
/* Part `index` of "a|b|c" into word; 0: there are fewer. */
int glossary_part(const char *list, int index, char word[GLOSSARY_WORD]);

/* Handles of HDF5. */

/* Closes those that are open, in this order, whatever they are of: a data set, an attribute, a
 * type, a space. */
static inline void handles_close(int count, const hid_t handle[])
{
    for (int i = 0; i < count; i++)
        if (handle[i] >= 0)
            H5Idec_ref(handle[i]);
}

/* Being asked to end (Ctrl-C, SIGTERM, SIGHUP) as something that can be waited for beside the
 * workers. */

typedef struct interrupt {
    int descriptor;  /* can be read once a request arrives; -1: none */
    sigset_t before; /* the mask that interrupt_end restores */
} interrupt;

/* From here on the request is kept until it is searched for, in this process and in those it
 * starts. Signals that are ignored (nohup) stay ignored. */
void interrupt_begin(interrupt *);
/* As before: asked again, the process ends at once. */
void interrupt_end(interrupt *);

/* Two formulations at equal error: with how many elements each is within it. */

/* Meeting of series 0 and 1 of a sweep of one point. */
typedef struct meeting {
    int mesh[2];     /* index of the least mesh from which on all are within the error; -1: none */
    double error[2]; /* relative, the largest on that mesh; NAN */
} meeting;

/* Has each of the two a reference value or an agreement for the quantity, and is it no curve? */
int meeting_asks(const sweep *s, const truths *t, int quantity);
/* How many quantities are asked. */
int meeting_asked(const sweep *s, const truths *t);
/* Every asked quantity within the level, which is relative. */
meeting meeting_at(const sweep *s, const truths *t, double level);
/* Do both reach it? */
int meeting_holds(const meeting *);

/* A planned sweep of one point, reduced to its selection. */

/* Before the run: keeps the quantities that the selection (formulations/formulations.h; NULL: all)
 * holds for with some formulation, and the formulations it holds for with some quantity. REFUSED:
 * it is malformed, has a word that names nothing, or holds for nothing. */
status narrow_to(sweep *s, const char *select, fault *f);
/* The same of a scene by itself, before it is planned. Its formulation may still be open (type
 * NULL): words that could name one then leave the scene as it is. */
status narrow_scene(scene *, const case_type *, const double parameter[], const formulation *,
                    const char *select, fault *);

/* Noise of the values of the finest mesh: the same cell again in words that change nothing but the
 * rounding of its numbers. */

/* Repetitions of the finest mesh of a series: in a unit of length that is not a power of two, and
 * with the nodes of members in reverse order; in two units where a formulation depends on the order
 * of nodes. Stations that only curves show are omitted. */
enum { NOISE_REPETITIONS = 2 };

/* In what other words. */
scene_edit noise_words(const formulation *, int repetition);
/* Fills series.noise: twice the larger of the two differences, relative to the value or near_zero,
 * or what differences leave where a formulation needs them; NAN where a value or a repetition is
 * missing. -1: out of memory. */
int noise_take(const sweep_point *, const cell_result again[NOISE_REPETITIONS], series *);
int noise_cells(const sweep *s); /* that were run for it */

/* A run in one look: of each case and formulation the worst verdict and how many quantities have
 * it, over all parameter points. */

/* From calm to bad. */
typedef enum overview_mark {
    OVERVIEW_NOTHING, /* skipped, or no truth */
    OVERVIEW_OTHER_MODEL,
    OVERVIEW_PASS,
    OVERVIEW_LOW_ORDER,
    OVERVIEW_UNDECIDED,
    OVERVIEW_BIASED,
    OVERVIEW_WRONG,
    OVERVIEW_NO_VALUE, /* diverged or refused */
    OVERVIEW_FLAW,     /* an inconsistent run record, or its stored value */
    OVERVIEW_MARKS
} overview_mark;

typedef struct overview_cell {
    overview_mark mark;
    int unexpected; /* 1: comes before whatever is expected */
    int count;      /* quantities (of a flaw: cells) with that mark */
} overview_cell;

typedef struct overview {
    int rows, columns;
    int joined;   /* 1: a column has a formulation with all its options */
    int accepted; /* columns before those of new formulations, which do not affect the exit
                     status */
    const case_type **row;
    const char **column; /* names, which live as long as the sweep */
    overview_cell *cell; /* [rows*columns] */
} overview;

enum { OVERVIEW_TEXT = 24 };

overview_mark overview_mark_of(verdict_kind kind);
/* FAULT: out of memory. */
status overview_make(const sweep *s, const judgement *j, overview *out, fault *f);
void overview_free(overview *);
const overview_cell *overview_at(const overview *, int row, int column);
/* 1: nothing but passes in that row, and what is not evaluated. */
int overview_passes(const overview *, int row);
/* 1: something in that row is evaluated. */
int overview_judged(const overview *, int row);
/* Has a row a line of its own? All have where they are few; else those that pass share lines, so
 * that the rest is one screen. */
int overview_shown(const overview *, int row);
/* "ok", "~3", "!#2": distinguished without colour. utf8: 1: with signs beyond ASCII. */
void overview_text(const overview_cell *, int utf8, char text[OVERVIEW_TEXT]);
/* Meaning of the mark, in words. */
const char *overview_words(overview_mark mark);

/* Known deviations of your own project: rules in addition to the built-in list, with its
 * columns. */

/* Adds the rules of a file to those of t; run: the cases of the run, NULL after the last. Mistakes
 * of the file go to `m`, and those rows are omitted. FAULT: it cannot be read. */
status own_findings_read(const char *path, const case_type *const run[], truths *t, mistakes *m,
                         fault *f);

/* A user's table: CSV with declared columns, a record in each line. Everything in it is checked. */

enum { OWN_TABLE_COLUMNS = 16 };

typedef struct own_table_row {
    int line;                       /* counted from 1 */
    char *text;                     /* that the fields are pieces of */
    char *field[OWN_TABLE_COLUMNS]; /* trimmed, without quotes */
} own_table_row;

typedef struct own_table {
    int rows;
    own_table_row *row;
} own_table;

/* columns: their names in their order, between commas, as the first line must have them. Mistakes
 * in lines go to `m`, and these are omitted; FAULT: the file cannot be read. The caller frees *out
 * in any case. */
status own_table_read(const char *path, const char *columns, own_table *out, mistakes *m, fault *f);
void own_table_free(own_table *);

/* Reference values of your own project in addition to the packed ones, with the columns of
 * reference/tables. */

/* Adds the rows of a file to those of t; run: the cases of the run, NULL after the last. only: of
 * this case alone, the others are passed over; NULL: of all. Mistakes of the file go to `m`, and
 * those rows are omitted. FAULT: it cannot be read. */
status own_truths_read(const char *path, const case_type *const run[], const case_type *only,
                       truths *t, mistakes *m, fault *f);

/* Which cells a verification consists of. */

/* Points: the defaults and every parameter point of a truth. */
status plan_sweep(const sweep_request *request, const truths *t, sweep *out, fault *f);
/* One point, the given formulations and meshes. */
status plan_one(const case_type *type, const double value[], const formulation those[], int count,
                const int mesh[], int meshes, sweep *out, fault *f);
/* A further point of a sweep that is planned by hand, its scene changed by the edit (NULL: not);
 * its steps and condition may be set before the run. */
status plan_add(sweep *s, const case_type *type, const double value[], const scene_edit *edit,
                const int mesh[], int meshes, fault *f);
/* Series of the last point, on its scene's meshes. */
status plan_extend(sweep *s, const formulation those[], int count, fault *f);
/* Finds again what the series of a point leave out, when its quantities have changed. */
void plan_omissions(sweep *s, int point_index);

/* Default formulation and mesh: a formulation that is right for a scene as far as is known without
 * solving it, and a number of elements at which its answers have converged. */

/* Formulation that supports all that the scene needs: without a rule that its limit of a quantity
 * here is wrong or biased; of the scene's theory of shear; with the fewest such rules elsewhere; of
 * the highest order in the requested quantities; the first by name. rules NULL: no list of known
 * deviations. REFUSED: none supports what the scene needs. why: one line on the choice. */
status preference_formulation(const scene *, const rule_subject *where, const rule *rules,
                              int count, formulation *out, char why[FAULT_TEXT], fault *f);

/* Default relative change from one mesh to the next that counts as none. */
#define PREFERENCE_ERROR 1e-3
/* Behind the scene's meshes, where values change still, the elements are doubled until that many,
 * or until a mesh may cost so much counted work [s]. */
#define PREFERENCE_FINEST 1024
#define PREFERENCE_COST   2.0

typedef struct preference {
    formulation chosen;
    int elements;
    int short_of;   /* 1: values of the finest mesh still change by more than asked */
    double *change; /* [quantities of the scene], from the mesh before, by the value; NAN: not known
                     */
    char why_formulation[FAULT_TEXT], why_elements[FAULT_TEXT];
} preference;
void preference_free(preference *);

/* The coarsest mesh whose values all differ from those of the mesh before it by less than `asked`,
 * or the finest that was tried. Solves the meshes until then; request: the cell but for its
 * elements. */
status preference_elements(const cell_request *, const formulation *chosen, double asked,
                           preference *out, fault *f);

/* Both at once: of the formulations that preference_formulation ranks equal to the first one, at
 * most five and two of a family, the first that converges where the next mesh with the lowest cost
 * is always solved before more expensive ones, by counted work. request: the cell
 * without formulation and elements. */
status preference_both(const cell_request *, const rule_subject *where, const rule *rules,
                       int count, double asked, preference *out, fault *f);

/* Cost of a cell: its counted work, each count with a cost coefficient. Counts are the same in
 * every run and on every machine, and so is the cost: formulations are ranked by it, not by
 * measured times with their scatter.
 *
 * The coefficients are fitted once to measured times (`make lab L=prices`) and stored in
 * harness/study/prices.csv, of which the build makes the table. Where a formulation has no
 * coefficients, those hold that all formulations have in common ("*"), by the number of its
 * strains. */

/* Counted work; the names are those of the columns of the table `cells`. */
typedef enum price_count {
    PRICE_one, /* a cell */
    PRICE_elements_total,
    PRICE_element_kinds,
    PRICE_strains, /* of an element, with its inner unknowns */
    PRICE_free,
    PRICE_strain_evaluations,
    PRICE_stress_evaluations,
    PRICE_inertia_evaluations,
    PRICE_geometric_evaluations,
    PRICE_iterations,
    PRICE_load_steps,
    PRICE_factorisations,
    PRICE_solutions,
    PRICE_factor_entries,
    PRICE_factor_flops,
    PRICE_dense_operations,
    PRICE_COUNTS
} price_count;

typedef struct price_row {
    /* "": of all; "*": of those without coefficients; a name, with options where they matter */
    const char *formulation;
    price_count first, second; /* what is paid for is their product */
    double seconds;            /* on the reference machine */
} price_row;

extern const price_row price_rows[]; /* generated; ends with a row without formulation */
/* Costs whose ratio is below this one do not show which is faster: the cost coefficients are no
 * more accurate. */
extern const double price_noise;

/* [s] on the reference machine, of all rows that hold for the formulation. */
double price_of(const price_row *rows, const formulation *chosen, const cell_result *cell);
/* The same by the committed coefficients. */
double price_cost(const formulation *chosen, const cell_result *cell);
/* 1: it has cost coefficients; 0: those of any formulation hold. */
int price_own(const price_row *rows, const formulation *chosen);

/* How far a long run is, in one line of a terminal that is written over and taken away at the end.
 */

typedef struct progress {
    FILE *to;           /* NULL: nothing is said */
    const char *things; /* "cells" */
    int count;          /* of them */
    double begun;       /* [s] of clock_wall_seconds */
    double last;        /* [s] when something was said */
    int width;          /* columns of what is there now */
} progress;

/* now: [s] of clock_wall_seconds, here and below. */
progress progress_begin(FILE *to, const char *things, int count, double now);
/* Is it time to say something again? */
int progress_is_due(const progress *, double now);
/* "cells 12 of 40, 25 %, about 3 min left: WHAT". share: of the whole work that is done, 0 to 1;
 * the time left is reckoned from it once it means something. */
void progress_show(progress *, double now, int done, double share, const char *what);
/* The line is as empty as before. */
void progress_end(progress *);

/* Known deviations that a new formulation would need (reference/findings.csv). */

/* Placeholder of the cause, until it is found. */
#define PROPOSAL_CAUSE "to be found: why is this not a pass?"

/* CSV with the columns of the list of known deviations, header included: one rule for each
 * formulation, case and verdict, with all its quantities, the largest error seen (a third added),
 * and a cause that is still to be found. Returns the number of rules. */
int proposal_write(FILE *to, const sweep *s, const judgement *j);

/* Which mesh, and which formulation, reaches an error. One rule, without clocks: a formulation is
 * within a level from the coarsest mesh on whose error, and that of every finer one, is;
 * formulations are ordered by their counted work on that mesh, with the committed cost
 * coefficients. One that is known to be wrong in the requested quantity follows all others. */

enum { REACH_LEVELS = 4, REACH_EVERY = -1 };
extern const double reach_level[REACH_LEVELS]; /* 10 %, 1 %, 0.1 %, 0.01 % */

/* A formulation within a level. */
typedef struct reached {
    int series, mesh; /* index of that mesh */
    double cost;      /* [s] of its counted work; INFINITY: it leaves derivatives to differences or
                         is computed by another process, and ranks after those that do not */
    const verdict *defect; /* the first verdict that is not a pass; NULL: all are */
} reached;

typedef struct reach_question {
    const sweep *s;
    const verdict *verdict; /* [verdicts] of all its series; what has no truth is not asked */
    int verdicts, point;
    int quantity; /* or REACH_EVERY: all of the point that any formulation has a reference value for
                   */
    double level; /* relative error */
} reach_question;

/* Why the work of a type ranks nothing: "by differences", "in another process"; "": it does. */
const char *reach_unranked(const element_type *type);
/* Index of the coarsest mesh from which on the error of every mesh is within the level, or -1. */
int reach_mesh(const sweep *s, const verdict *v, double level);
/* Is the formulation known to be wrong, or not known to be right, by such a verdict? */
int reach_is_defect(verdict_kind kind);
/* Description of a formulation with such a defect that is within a level all the same. */
const char *reach_defect_words(verdict_kind kind);
/* Formulations that are within the level: those without a defect first, each by cost, then by name.
 * Returns how many; out: room for all series. Other programs, which count no work, are omitted. */
int reach_ranking(const reach_question *q, reached out[]);
/* How many of the first ones, none with a defect, are tied: they differ in cost by less than the
 * uncertainty of the cost coefficients. 0 where there is none that ranks without a defect, 1 where
 * the first one has the lowest cost. */
int reach_ties(const reached list[], int count);
/* Returns how the question includes the series of the point: 1: every quantity has a reference
 * value of its theory; 0: some have none; -1: the series does not run. */
int reach_asks(const reach_question *q, int series_index);
/* Verdicts of every series and quantity of a sweep that was not evaluated, with what formulations
 * agree on where there is no reference value; NULL: out of memory. The caller frees it. */
verdict *reach_verdicts(const sweep *s, const truths *t, int *count);

/* Numbers with as many digits as are known of them, for people. */

enum { ROUNDING_TEXT = 32, ROUNDING_MOST = 11 /* digits */ };

/* Rounds to that many digits, "-" where it is not finite; without an exponent where that is short:
 * "0.0031", "3.1e-9". */
void rounding_digits(double value, int digits, char text[ROUNDING_TEXT]);
/* A value to the second digit of its uncertainty (same unit; 0: exact; not finite: seven digits).
 */
void rounding_known(double value, double uncertainty, char text[ROUNDING_TEXT]);
/* A relative error in percent: "-2.7801 %", "+2.1e-9 %". At most 11 characters. */
void rounding_percent(double error, char text[ROUNDING_TEXT]);

/* Time of a cell: the least of enough repetitions, taken in rounds that alternate with the cells it
 * is compared with, and the differences between rounds as its scatter. */

/* Two cells whose times come from the same distribution have all rounds of one below all rounds of
 * the other with a probability of 2 (5! 5!)/10! = 0.8 %: then, and only then, they are said to
 * differ. */
enum { ROUNDS_COUNT = 5 };

typedef struct rounds_reading {
    double setup, solve;        /* [s] of the fastest repetition */
    double round[ROUNDS_COUNT]; /* [s] least set-up and solution together in each round */
    int rounds, repeats;
} rounds_reading;

double rounds_least(const rounds_reading *); /* [s], INFINITY: never run */
double rounds_most(const rounds_reading *);  /* [s] of the slowest round */
/* -1: every round of a is faster than every one of b; 1: slower; 0: undecided. */
int rounds_compare(const rounds_reading *a, const rounds_reading *b);

/* The published algorithm next to beamwork's: all coordinates, strains and stresses at once, dense
 * Gaussian elimination (newton=dense). */
typedef struct dense_reference {
    int unknowns;         /* of the dense system; 0: not measured */
    double iteration;     /* [s] least time of one iteration */
    rounds_reading whole; /* of whole runs, where these are short enough; else rounds = 0 */
} dense_reference;

/* [s] of a run: measured, or the time of one iteration times their number (the iterations are the
 * same); INFINITY: not measured. */
double dense_reference_seconds(const dense_reference *b, long iterations);

/* Repeated runs of a cell, as it is and with all degrees of freedom kept (--all-dofs). */
typedef struct cell_timing {
    rounds_reading as_is, keep_all; /* rounds = 0: not measured */
    int free_keep_all;              /* unknowns when all are kept */
    /* [s] of the solution in one run more, in which the clock is read between the parts of the
     * iterations */
    double phase[PHASES];
    dense_reference dense; /* when requested */
} cell_timing;

/* All cells of a sweep, run by several processes. */

/* Runs every cell; a cell that fails or crashes is a result. Order of results does not depend on
 * jobs. */
status run_sweep(const sweep_request *request, sweep *s, fault *f);

/* Truths of a scene file, among those of the run. */

/* Adds the file's truths that hold at a point of its parameters, and their values there. */
status scene_truths_add(const scene_file *, const double value[], truths *t, fault *f);
/* The same at the defaults and at every point that a reference value names. */
status scene_truths_add_all(const scene_file *, truths *t, fault *f);

/* Verdicts in words. */

/* The verdict in words: "converges to a wrong limit: +0.115 %". */
void sentence_of_verdict(const verdict *v, double least_order, char *text, size_t size);
enum { SENTENCE_OF_RUN = 1000 };

/* The whole run in one sentence, which begins with PASS or FAIL (INTERRUPTED where it was,
 * INCOMPLETE where batches are missing) and says what of it was expected although it is not a pass;
 * empty where nothing was evaluated. */
void sentence_of_run(const sweep *s, const judgement *j, char *text, size_t size);

/* A cell's result as bytes, so that a process can hand it to its parent. */

int serialise_write(FILE *to, const cell_result *cell); /* 0, or -1 */
enum { SERIALISE_DAMAGED = -1, SERIALISE_NO_MEMORY = -2 };
/* 0, or SERIALISE_DAMAGED: the stream ended or is damaged; then the cell is empty. */
int serialise_read(FILE *from, cell_result *cell);

/* The truth that a quantity is compared with. */

int truth_holds(const truth *row, const case_type *type, const double value[]);
/* 1: a verdict may rest on it. 0: an agreement of formulations, or a value that cannot be computed
 * again. */
int truth_gates(const truth *row);
/* Words of truth.kind: the first known one judges; truth_gates says which ones may.  "predicted":
 * the limit that a formulation must have. */
extern const char truth_kinds[];
/* The continuum's reference value of that model (exact before published, no point of a curve), or
 * NULL. Verdicts against one of the same model affect the exit status. */
const truth *truth_of(const truths *t, const case_type *type, const double value[],
                      const char *quantity, const char *model);
/* The same among truths that follow one of the theories of shear (words separated by |), or depend
 * on none; NULL: any. */
const truth *truth_of_theory(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *model, const char *theories);
/* The agreement of the formulations there (kind agreement), or NULL: it is informative only and
 * never affects the exit status. */
const truth *truth_agreed(const truths *t, const case_type *type, const double value[],
                          const char *quantity);
/* The limit that a formulation (its key, or its name whatever the options) must have there, or
 * NULL. */
const truth *truth_predicted(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *key);

/* Processes that run the cells of a sweep. None outlives the process that started it, and each
 * keeps the time limit of a cell by itself. */

typedef struct worker {
    pid_t process;
    int from;    /* its pipe; -1: it does not run */
    int stopped; /* by the clock of the parent */
    int damaged; /* by the parent: what it wrote is no result */
    char *bytes; /* of what it said and is not whole */
    size_t count, room;
} worker;

status worker_start(const workload *, int self, worker *, fault *);
/* Values that worker_receive returns in place of a task. WORKER_NO_MEMORY: this process has none
 * for the results; the worker lives. */
enum { WORKER_ENDED = -1, WORKER_NOTHING = -2, WORKER_NO_MEMORY = -3 };
/* Takes what there is, and does not wait: results, or whose they are. The last of their tasks, or
 * WORKER_NOTHING: nothing is whole yet. A worker that writes no results is ended. */
int worker_receive(workload *, worker *);
/* A worker that ended while it had a task: that cell failed. Returns 1 when it must be replaced. */
int worker_bury(workload *, int self, worker *);
/* Ends it when it has been at one cell for too long and cannot do so itself; its pipe closes. */
void worker_stop_late(const workload *, int self, worker *);
/* Ends it whatever it does; results that it has written are still taken. */
void worker_end(workload *, worker *);

#endif
