/* The truth that a quantity is compared with. */
#ifndef BEAMWORK_TRUTH_H
#define BEAMWORK_TRUTH_H

#include "harness/study/truths.h"

int truth_holds(const truth *row, const case_type *type, const double value[]);
/* May a verdict rest on it?  Not on an agreement of formulations, nor on a figure that nobody can
 * compute again. */
int truth_gates(const truth *row);
/* Words of truth.kind: the first known one judges; truth_gates says which ones may.  "predicted":
 * the limit that a formulation must have. */
extern const char truth_kinds[];
/* The continuum's truth of that model (exact before published, no point of a curve), or NULL.  One
 * of the same model gates. */
const truth *truth_of(const truths *t, const case_type *type, const double value[],
                      const char *quantity, const char *model);
/* The same among truths that follow one of the theories of shear (words separated by |), or depend
 * on none; NULL: any. */
const truth *truth_of_theory(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *model, const char *theories);
/* What formulations agree on there (kind agreement), or NULL: it informs and never gates. */
const truth *truth_agreed(const truths *t, const case_type *type, const double value[],
                          const char *quantity);
/* The limit that a formulation (its key, or its name whatever the options) must have there, or
 * NULL. */
const truth *truth_predicted(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *key);

#endif
