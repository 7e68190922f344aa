/* A sweep as CSV: a row for each point, formulation, mesh and quantity. */
#ifndef BEAMWORK_RANGES_CSV_H
#define BEAMWORK_RANGES_CSV_H

#include "harness/experiments/ranges.h"

/* The parameters that vary, then formulation, elements, quantity, unit, value, reference,
 * reference_kind, error, status, cost, seconds. What does not exist is empty. */
void ranges_csv_head(FILE *to, const parameter_ranges *r);
/* Points from `first` on. FAULT: out of memory. */
status ranges_csv_add(FILE *to, const parameter_ranges *r, long first, const rows *, fault *f);

#endif
