/* Formulation and number of elements where the command line gives none (study/preference.h). */
#ifndef BEAMWORK_DEFAULTS_H
#define BEAMWORK_DEFAULTS_H

#include "harness/cli/command.h"
#include "harness/experiments/solution.h"

enum { DEFAULTS_NOTE = 2 * FAULT_TEXT + 200 };

/* The one cell that is asked for: the first -f and -n, where there are any. */
solution_request defaults_request(const command_request *r, const case_type *type);
/* Fills what is missing of -f and -n for one cell of the case at the parameters of the request.
 * note: a line for each choice and why; "" where both were given. why: solution_choice_free in any
 * case; NULL: not wanted. REFUSED: no formulation offers what the case needs, or --error is none.
 */
status defaults_fill(command_request *r, const case_type *type, char note[DEFAULTS_NOTE],
                     solution_choice *why, fault *f);
/* The same of -f alone. */
status defaults_formulation(command_request *r, const case_type *type, char note[DEFAULTS_NOTE],
                            fault *f);

#endif
