/* Quadratic forms of the undeformed structure and of the stresses of a linear solution, from the
 * element strains: assembling the matrices loses digits of soft motions, this does not. */
#ifndef BEAMWORK_QUADRATIC_FORMS_H
#define BEAMWORK_QUADRATIC_FORMS_H

#include "harness/newton/run_state.h"

typedef struct quadratic_forms {
    const equations *eq;
    int free;
    double *load_x;    /* [free + driven] displacements by the loads, zero: no prestress ... */
    double *sigma;     /* ... and their stresses [elements x strains] */
    sparse loads;      /* what the loads add to K */
    double *x, *force; /* [free + driven] driven coordinates of x: zero */
    double *stress, *product; /* [elements x strains], [free] */
} quadratic_forms;

status quadratic_forms_alloc(const equations *eq, const sparse *pattern, quadratic_forms *p,
                             fault *f);
void quadratic_forms_free(quadratic_forms *p);
/* The loads at `path` and their stresses, once load_x is known; whole: with those of initial
 * strains. */
status quadratic_forms_load(const equations *, quadratic_forms *p, double path, int whole,
                            fault *f);

/* Of x[free]: x^T K x, x^T G x, and what rounding may change in them. */
double quadratic_forms_stiffness(quadratic_forms *p, const double x[]);
double quadratic_forms_geometric(quadratic_forms *p, const double x[]);
double quadratic_forms_stiffness_rounding(quadratic_forms *p, const double x[]);
double quadratic_forms_geometric_rounding(quadratic_forms *p, const double x[]);
/* y[free] = K x[free] */
void quadratic_forms_product(quadratic_forms *p, const double x[], double y[]);

#endif
