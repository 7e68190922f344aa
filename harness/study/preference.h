/* What is taken where nobody chose: a formulation that is right for a scene as far as is known
 * without solving it, and a number of elements at which its answers have settled. */
#ifndef BEAMWORK_PREFERENCE_H
#define BEAMWORK_PREFERENCE_H

#include "harness/study/verdict.h"

/* Of those that offer all that the scene needs: with no rule of the ledger that says of a quantity
 * here that its limit is wrong or biased; of the scene's theory of shear; of the fewest such rules
 * elsewhere; of the highest order in what is asked; the first by name. rules NULL: the ledger is
 * not known. REFUSED: none offers what the scene needs. why: one line on the choice. */
status preference_formulation(const scene *, const rule_subject *where, const rule *rules,
                              int count, formulation *out, char why[FAULT_TEXT], fault *f);

/* Change from one mesh to the next that counts as none where nobody says, relative. */
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

/* Both at once: of the formulations that preference_formulation holds to be as sound as the first
 * one, at most five and two of a family, the first that settles where the cheapest next mesh is
 * always solved before dearer ones, by counted work (study/price.h). request: the cell but for
 * formulation and elements. */
status preference_both(const cell_request *, const rule_subject *where, const rule *rules,
                       int count, double asked, preference *out, fault *f);

#endif
