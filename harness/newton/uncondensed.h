/* All unknowns at once. */
#ifndef BEAMWORK_MODEL_UNCONDENSED_H
#define BEAMWORK_MODEL_UNCONDENSED_H

#include "harness/newton/loads.h"
#include "harness/newton/run_state.h"

/* The uncondensed dense system (column-major A[n x n], b[n] with n = uncondensed_size +
 * conditions), unknowns in the order free coordinates, strains, stresses, drivers of conditions;
 * load[free + driven] is work space. */
int uncondensed_size(const model *);
status uncondensed_system(const equations *, const model_state *, double path, const double drive[],
                          int conditions, const model_condition condition[], double A[], double b[],
                          double load[], fault *);

#endif
