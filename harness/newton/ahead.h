/* Strains and stresses of all elements evaluated ahead of the loop that wants them, for types that
 * evaluate all elements at once (element_type.strain_many, stress_many, without lanes). For others,
 * and where there is no memory for it, nothing is done ahead and every element is evaluated in the
 * loop; those with lanes a few at a time, where chunk.h is used. */
#ifndef BEAMWORK_MODEL_AHEAD_H
#define BEAMWORK_MODEL_AHEAD_H

#include "harness/model/model_impl.h"

enum { AHEAD_E = 1, AHEAD_J = 2, AHEAD_H = 4 }; /* what of the strains */

/* Of the nodes of s; sigma[elements x strains] for H. Until ahead_end. */
void ahead_strains(model *m, const model_state *s, int what, const double sigma[]);
/* At e[elements x strains], or NULL: at the strains evaluated ahead; sigma and C. */
void ahead_stresses(model *m, const double e[], const double inner[]);
void ahead_end(model *m);

void ahead_copy_strain(const model *m, int i, const strain_output *out);
status ahead_copy_stress(const model *m, int i, const stress_output *out);

/* Those of element i at x or e, for loops between ahead_strains or ahead_stresses and ahead_end:
 * what was evaluated ahead, or m->type's own functions. */
static inline void ahead_strain(const model *m, int i, const node_state x[], strain_output *out)
{
    if (m->ahead != NULL && m->ahead->what != 0)
        ahead_copy_strain(m, i, out);
    else
        m->type->strain(m->kind[m->element[i].kind].data, x, out);
}

static inline status ahead_stress(const model *m, int i, const double e[], const double inner[],
                                  stress_output *out)
{
    if (m->ahead != NULL && m->ahead->stresses)
        return ahead_copy_stress(m, i, out);
    return m->type->stress(m->kind[m->element[i].kind].data, e, inner, out);
}

#endif
