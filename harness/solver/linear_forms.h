/* Quadratic forms of the undeformed structure and of the stresses of a linear solution, from the
 * element strains: assembling the matrices loses digits of soft motions, this does not. */
#ifndef BEAMWORK_LINEAR_FORMS_H
#define BEAMWORK_LINEAR_FORMS_H

#include "harness/model/model.h"

typedef struct linear_forms {
    model *m;
    int free;
    double *load_x;    /* [free + driven] displacements by the loads, zero: no prestress ... */
    double *sigma;     /* ... and their stresses [elements x strains] */
    sparse loads;      /* what the loads add to K */
    double *x, *force; /* [free + driven] driven coordinates of x: zero */
    double *stress, *product; /* [elements x strains], [free] */
} linear_forms;

status linear_forms_alloc(model *m, const sparse *pattern, linear_forms *p, fault *f);
void linear_forms_free(linear_forms *p);
/* The loads at `path` and their stresses, once load_x is known. */
status linear_forms_load(linear_forms *p, double path, fault *f);

/* Of x[free]: x^T K x, x^T G x, and what rounding may change in them. */
double linear_forms_stiffness(linear_forms *p, const double x[]);
double linear_forms_geometric(linear_forms *p, const double x[]);
double linear_forms_stiffness_rounding(linear_forms *p, const double x[]);
double linear_forms_geometric_rounding(linear_forms *p, const double x[]);
/* y[free] = K x[free] */
void linear_forms_product(linear_forms *p, const double x[], double y[]);

#endif
