/* Internal declarations of study/. */
#ifndef BEAMWORK_STUDY_IMPL_H
#define BEAMWORK_STUDY_IMPL_H

#include <hdf5.h>

#include "cases/case.h"
#include "elements/element.h"
#include "elements/shared/status.h"
#include "harness/newton/newton.h"
#include "harness/study/study.h"

/* Formulations whose verdicts affect the exit status (reference/accepted.csv), as packed. */

/* Registers those of an open file of reference values (formulations_accept). FAULT: the table is
 * missing or damaged. */
status accepted_read(const char *path, hid_t file, fault *f);

/* Compares values of single meshes with stored discrete ones. */

/* Compares one series with the stored values of its meshes. */
status agreements_add(const sweep *s, const truths *t, int index, judgement *out, fault *f);

/* Coverage of limits: the check of their uncertainties. */

/* Adds the verdicts from the given one on to the coverages of a judgement. */
status coverage_count(const sweep *s, int first, judgement *out, fault *f);

/* Mode shapes at one value of a parameter, matched with those at another value. */

typedef struct follow_shapes {
    int modes, rows;
    double *frequency; /* [modes] [rad/s] */
    double *match;     /* [modes] match with the previous sample */
    double *shape;     /* [modes x rows] normalised to unit mass */
} follow_shapes;

/* Matches the modes of `before` with those of a state. *least: the worst match; 0 if two would be
 * matched with the same mode. */
status follow_match_next(const follow_shapes *before, const state_matrices *, follow_shapes *out,
                         double *least, fault *);
void follow_match_free(follow_shapes *);

/* Internals of study.h that its files share. */

static const double follow_sure = 0.9; /* Least match of two shapes that count as the same mode. */

typedef struct follow_walk {
    const follow_request *of;
    follow_curves *out;
    int analysis, room;
    follow_shapes *shapes; /* [samples] */
} follow_walk;

/* follow_match.c: modes at a value, matched with those of `before` (NULL: the first ones), and the
 * worst match. */
status follow_solve(follow_walk *, double value, const follow_shapes *before, follow_shapes *out,
                    double *least, fault *);

/* follow_match.c: finds crossings in the last step; *least: the worst match on the way. Shapes that
 * are exchanged within one step (veering) do not match where the frequencies would meet. */
status follow_events_step(follow_walk *, double *least, fault *);
/* Adds crossings at samples, and veerings, all in the order of their parameter values. */
status follow_events_rest(follow_walk *, fault *);

/* Rules and reference values that a run should have shown or used, but did not. */

/* Marks them (rule.missed) and counts them. whole 1: no selection was made, and every rule should
 * have been shown. Otherwise only rules of user tables (rule.from) are counted whose formulations
 * and cases were run completely, with all points and quantities; a selection (-k) includes a case
 * completely if it matches the case name. */
int missed_rules(const sweep *s, truths *t, int whole);

/* Counts the reference values that a complete run did not use: unmet, waiting and unread. An unread
 * value counts as met (truth.met) but is not evaluated: a run evaluates a motion at a few instants
 * and structures only, `make lab L=motions` at all. */
void missed_truths(const sweep *s, truths *t, judgement *out);

/* Names in user tables. */

/* Finds a case by name among those of the run (NULL-terminated) and the built-in ones; NULL: none.
 */
const case_type *own_names_case(const case_type *const run[], const char *name);
/* Number i of the cases of the run, followed by the other built-in ones; NULL after the last. */
const case_type *own_names_case_at(const case_type *const run[], int i);
/* The scene's quantity of that name, or NULL. */
const scene_quantity *own_names_quantity(const scene *s, const char *name);
/* "; did you mean 'NEAR'?" for cases, formulations, or quantities of a scene; or another remedy. */
const char *own_names_near_case(const case_type *const run[], const char *name,
                                char text[FAULT_TEXT]);
const char *own_names_near_formulation(const char *name, char text[FAULT_TEXT]);
const char *own_names_near_quantity(const scene *s, const char *name, char text[FAULT_TEXT]);

/* Richardson extrapolation: fits f + c n^-p to the values of three meshes with n elements. */

/* Order from three values by bisection, at most bisected_order; NAN if no order fits the changes.
 */
double richardson_order(const double n[3], const double f[3]);
/* Richardson's limit from the last two of three values. */
double richardson_limit(const double n[3], const double f[3], double p);
/* Amplification of errors: change of the extrapolated limit per change of the values, root of the
 * sum of squares. */
double richardson_amplification(const double n[3], const double f[3], double p);

/* Checks the consistency of the run record of a cell, without any reference value. An inconsistent
 * record is an error of the program. */

/* Returns 1 when counters, steps and corrections of a cell agree with each other and with the
 * properties of every solution. Otherwise 0, and `why` gives the contradiction. newton: form of the
 * solution. A cell without a solution is not checked. */
int sound_cell(const cell_result *cell, const scene *s, newton_form newton, char why[FAULT_TEXT]);

/* Index of rows by case and quantity, for thousands of look-ups per verdict. */

/* Indexes all existing rows; truths_read calls it. Rows added later are found by a slower search
 * until it is called again. FAULT: out of memory; indexed rows are still found. */
status truth_index_make(truths *t, fault *f);
void truth_index_free(truths *t);

/* First row for the quantity of the case, in the order of the rows; t->rows: none. */
int truth_index_first(const truths *t, const case_type *type, const char *quantity);
/* Next row after i for the same quantity. */
int truth_index_next(const truths *t, int i);

/* Reads rows of a table of reference values and checks each. */

/* Name of the first column of a row with an invalid value, or NULL. */
const char *truth_rows_wrong(const truth *row);
/* Fills row[table->rows], initially zero. FAULT: a column is invalid, or the defaults of the case
 * of a row have changed; truths_free releases what was read. */
status truth_rows_read(const table_columns *table, const case_type *type, truth row[]);

/* The packed file: undamaged, written by beamwork, and of this version. */

/* FAULT: damaged, or not a beamwork file; *file below 0: nothing is open. */
status truths_file_open(const char *path, hid_t *file, fault *f);

#endif
