/* What is taken where nobody chose: a formulation that is right for a scene as far as is known
 * without solving it, and a number of elements at which its answers have settled. */
#ifndef BEAMWORK_PREFERENCE_H
#define BEAMWORK_PREFERENCE_H

#include "harness/judge/verdict.h"

/* Of those that offer all that the scene needs: with no rule of the ledger that says of a quantity
 * here that its limit is wrong or biased; of the scene's theory of shear; of the fewest such rules
 * elsewhere; of the highest order in statics; the first by name. rules NULL: the ledger is not
 * known. REFUSED: none offers what the scene needs. why: one line on the choice. */
status preference_formulation(const scene *, const rule_subject *where, const rule *rules,
                              int count, formulation *out, char why[FAULT_TEXT], fault *f);

/* Change from one of the scene's meshes to the next that counts as none, relative. */
#define PREFERENCE_SETTLED 1e-3

/* The coarsest of the scene's meshes whose values all differ from those of the mesh before it by
 * less than PREFERENCE_SETTLED, or the finest. Solves the meshes until then; request: the cell but
 * for its elements. */
int preference_elements(const cell_request *, char why[FAULT_TEXT]);

#endif
