/* Whether a problem fits into this machine, asked before it is tried: a system that promises memory
 * it does not have would end the program, and others, without a word. And lists that grow. */
#ifndef BEAMWORK_MEMORY_H
#define BEAMWORK_MEMORY_H

#include <stddef.h>

#include "elements/shared/status.h"

/* REFUSED when `what` needs more than that. bytes: at least so many. */
status memory_check(double bytes, const char *what, const char *remedy, fault *f);
/* A copy of `entry`, of `size` bytes, at the end of *list (the address of its pointer), which is
 * freed with free(). FAULT: "out of memory for WHAT". */
status memory_append(void *list, int *count, const void *entry, size_t size, const char *what,
                     fault *f);

#endif
