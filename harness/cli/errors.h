/* Errors on a command line: "1%,0.1%" or "0.01". */
#ifndef BEAMWORK_ERRORS_H
#define BEAMWORK_ERRORS_H

#include "elements/shared/status.h"

/* Relative, between 0 and 1, into level[most]; *count: how many. */
status errors_parse(const char *text, int most, double level[], int *count, fault *f);

#endif
