/* The inside of study/. */
#ifndef BEAMWORK_STUDY_IMPL_H
#define BEAMWORK_STUDY_IMPL_H

#include <hdf5.h>

#include "cases/case.h"
#include "elements/element.h"
#include "elements/shared/status.h"
#include "harness/newton/newton.h"
#include "harness/study/study.h"

/* Formulations whose verdicts affect the exit status (reference/accepted.csv), as they are
 * packed. */

/* Makes those of an open file of truths known (formulations_accept). FAULT: the table is missing or
 * damaged. */
status accepted_read(const char *path, hid_t file, fault *f);

/* Values of single meshes against stored discrete ones. */

/* One series against the stored values of its own meshes. */
status agreements_add(const sweep *s, const truths *t, int index, judgement *out, fault *f);

/* How often limits hold: the check of their uncertainties. */

/* Adds to the coverages of a judgement what its verdicts show, from the given one on. */
status coverage_count(const sweep *s, int first, judgement *out, fault *f);

/* Shapes of modes at one value of a parameter, and which of them are those of another. */

typedef struct follow_shapes {
    int modes, rows;
    double *frequency; /* [modes] [rad/s] */
    double *match;     /* [modes] with those of before */
    double *shape;     /* [modes x rows] of unit mass */
} follow_shapes;

/* The first `modes` of a state. */
status follow_match_first(const state_matrices *, int modes, follow_shapes *out, fault *);
/* Matches the modes of `before` with those of a state. *least: the worst match; 0 where two would
 * be matched with the same mode. */
status follow_match_next(const follow_shapes *before, const state_matrices *, follow_shapes *out,
                         double *least, fault *);
void follow_match_free(follow_shapes *);

/* Inside of study.h: what its files share. */

static const double follow_sure = 0.9; /* match of two shapes that are one mode */

typedef struct follow_walk {
    const follow_request *of;
    follow_curves *out;
    int analysis, room;
    follow_shapes *shapes; /* [samples] */
} follow_walk;

/* follow_match.c: the modes at a value, matched with those of before (NULL: the first ones), and
 * the worst match. */
status follow_solve(follow_walk *, double value, const follow_shapes *before, follow_shapes *out,
                    double *least, fault *);

/* follow_match.c: crossings within the last step; *least: the worst match on the way there. Shapes
 * that change places within one step (a veering) do not match where the frequencies would meet. */
status follow_events_step(follow_walk *, double *least, fault *);
/* Crossings at samples, and veerings; all in the order of their values. */
status follow_events_rest(follow_walk *, fault *);

/* Rules and truths that a run should have shown and met and did not. */

/* Marks them (rule.missed) and counts them. whole: 1: nothing was selected away, and every rule
 * should have been shown; else only those of the user's tables (rule.from) whose formulations and
 * cases were all run, with all points and quantities: a selection (-k) covers a case where it
 * matches the name of the case alone. */
int missed_rules(const sweep *s, truths *t, int whole);

/* Counts the reference values that a whole run has not evaluated by: unmet, waiting and unread.
 * What is unread counts as met (truth.met) and is not evaluated: a run takes a motion at few of the
 * instants and structures that its quantities are known at, `make lab L=motions` at all. */
void missed_truths(const sweep *s, truths *t, judgement *out);

/* Names in the tables of a project. */

/* The case of this name: among those of the run (ends with NULL), or built in; NULL: none. */
const case_type *own_names_case(const case_type *const run[], const char *name);
/* Number i of the run's cases and the built-in ones that are not among them; NULL after the
 * last. */
const case_type *own_names_case_at(const case_type *const run[], int i);
/* The scene's quantity of that name, or NULL. */
const scene_quantity *own_names_quantity(const scene *s, const char *name);
/* "; did you mean 'NEAR'?" of cases, formulations, or a scene's quantities, or the remedy. */
const char *own_names_near_case(const case_type *const run[], const char *name,
                                char text[FAULT_TEXT]);
const char *own_names_near_formulation(const char *name, char text[FAULT_TEXT]);
const char *own_names_near_quantity(const scene *s, const char *name, char text[FAULT_TEXT]);

/* Richardson extrapolation: what the values f of three meshes of n elements say of f + c n^-p. */

/* Order from three values by bisection, at most bisected_order; NAN where the changes fit none. */
double richardson_order(const double n[3], const double f[3]);
/* Richardson's limit from the last two of three values. */
double richardson_limit(const double n[3], const double f[3], double p);
/* Change of the extrapolated limit per change of the values: root of the sum of squares. */
double richardson_amplification(const double n[3], const double f[3], double p);

/* Consistency of a cell's run record, checked without any reference value: an inconsistent record
 * is a fault of the program. */

/* 1: the counters, the steps and the corrections of a cell agree with each other and with what
 * every solution promises. 0: `why` says what does not. newton: how it was solved. A cell
 * without a solution is not asked. */
int sound_cell(const cell_result *cell, const scene *s, newton_form newton, char why[FAULT_TEXT]);

/* Rows of truths by their case and quantity: thousands are asked about for every verdict. */

/* Index of all rows that there are; truths_read makes it. Rows added later are found too, and more
 * slowly until it is made again. FAULT: out of memory; earlier entries are still found. */
status truth_index_make(truths *t, fault *f);
void truth_index_free(truths *t);

/* The first row for the quantity of the case, in the order of the rows; t->rows: none. */
int truth_index_first(const truths *t, const case_type *type, const char *quantity);
/* The next one after row i for the same quantity. */
int truth_index_next(const truths *t, int i);

/* Rows of a table of truths, each checked. */

/* The first column of a row that makes no sense, or NULL. */
const char *truth_rows_wrong(const truth *row);
/* row[table->rows], zero before. FAULT: a column that makes no sense, or a row whose case has other
 * defaults by now; what was read stays for truths_free. */
status truth_rows_read(const table_columns *table, const case_type *type, truth row[]);

/* The packed file itself: undamaged, written by beamwork, and of this version. */

/* FAULT when it is damaged or not a beamwork file; *file below 0: nothing is open. */
status truths_file_open(const char *path, hid_t *file, fault *f);

#endif
