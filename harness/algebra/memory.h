/* Whether a problem fits into this machine, asked before it is tried: a system that promises memory
 * it does not have would end the program, and others, without a word. */
#ifndef BEAMWORK_MEMORY_H
#define BEAMWORK_MEMORY_H

#include "elements/shared/status.h"

/* REFUSED when `what` needs more than that. bytes: at least so many. */
status memory_check(double bytes, const char *what, const char *remedy, fault *f);

#endif
