/* Names that a command line may have, offered with what they are. */
#ifndef BEAMWORK_COMPLETION_NAMES_H
#define BEAMWORK_COMPLETION_NAMES_H

#include "cases/case.h"
#include "harness/cli/offer.h"

void names_cases(const offer *o);
void names_formulations(const offer *o);
/* NAME[:KEY=VALUE,...], or "all". */
void names_formulation_options(const offer *o);
/* NAME=VALUE of its parameters; NULL: nothing. */
void names_parameters(const offer *o, const case_type *type);
/* NAME= only: of those that are numbers. */
void names_numbers(const offer *o, const case_type *type);
/* What `beamwork explain` knows. said: the words before, one behind the other, which a term of
 * several words begins with. */
void names_words(const offer *o, const char *said);

#endif
