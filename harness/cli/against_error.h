/* bench --against FORMULATION: which is faster at equal error. */
#ifndef BEAMWORK_AGAINST_ERROR_H
#define BEAMWORK_AGAINST_ERROR_H

#include "harness/cli/command.h"

/* For each error the least number of elements of either from which on the error of every asked
 * quantity is within it (study/reach.h), then these two cells in alternation. Errors: --error, or
 * those of reach_level that both reach; quantities: -k, or all that both have a truth or an
 * agreement for. REFUSED: one does not run, nothing to measure errors by, none is reached. */
status against_error(command_request *r, const case_type *type, fault *f);

#endif
