/* Strains and stresses of all elements evaluated ahead of the loop that wants them, for types that
 * evaluate all elements at once (element_type.strain_many, stress_many, without lanes). For others,
 * and where there is no memory for it, nothing is done ahead and every element is evaluated in the
 * loop; those with lanes a few at a time, where chunk.h is used. */
#ifndef BEAMWORK_MODEL_AHEAD_H
#define BEAMWORK_MODEL_AHEAD_H

#include "harness/model/model.h"
#include "harness/newton/run_state.h"

/* Strains and stresses evaluated for all elements at once. */
typedef struct run_ahead {
    int what, stresses; /* what of the strains, and whether the stresses, are valid */
    const element_data **data;
    const double **at, **inner;
    node_state *x;
    strain_output *strain;
    stress_output *stress;
    status *outcome;
    double *e, *sigma, *J, *H, *C, *memory;
} run_ahead;

enum { AHEAD_E = 1, AHEAD_J = 2, AHEAD_H = 4 }; /* what of the strains */

/* Of the nodes of s; sigma[elements x strains] for H. Until ahead_end. */
void ahead_strains(const equations *eq, const model_state *s, int what, const double sigma[]);
/* At e[elements x strains], or NULL: at the strains evaluated ahead; sigma and C. */
void ahead_stresses(const equations *eq, const double e[], const double inner[]);
void ahead_end(const equations *eq);

void ahead_copy_strain(const equations *eq, int i, const strain_output *out);
status ahead_copy_stress(const equations *eq, int i, const stress_output *out);

/* Those of element i at x or e, for loops between ahead_strains or ahead_stresses and ahead_end:
 * what was evaluated ahead, or the type's own functions. */
static inline void ahead_strain(const equations *eq, int i, const node_state x[],
                                strain_output *out)
{
    if (eq->run->ahead != NULL && eq->run->ahead->what != 0)
        ahead_copy_strain(eq, i, out);
    else
        model_type(eq->m)->strain(model_kind_of(eq->m, i)->data, x, out);
}

static inline status ahead_stress(const equations *eq, int i, const double e[],
                                  const double inner[], stress_output *out)
{
    if (eq->run->ahead != NULL && eq->run->ahead->stresses)
        return ahead_copy_stress(eq, i, out);
    return model_type(eq->m)->stress(model_kind_of(eq->m, i)->data, e, inner, out);
}

#endif
