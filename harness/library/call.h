/* What every function of the library begins and ends with. */
#ifndef BEAMWORK_CALL_H
#define BEAMWORK_CALL_H

#include <fenv.h>
#include <locale.h>

#include "elements/shared/status.h"
#include "harness/library/beamwork.h"

/* What the host has set, and where the reason of a failure goes. */
typedef struct call {
    fault fault;
    char *text; /* malloced: in the place of the fault's line; NULL: none */
    char **why;
    locale_t locale;
    fenv_t arithmetic;
} call;

/* Numbers are read, written and rounded as in a program of our own until call_end: C's locale,
 * rounding to nearest, no traps; errors of GSL are ours to look at. */
void call_begin(call *, char **why);
/* Gives back what the host has set, and *why. */
bw_status call_end(call *, status outcome);

#endif
