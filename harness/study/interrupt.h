/* Being asked to end (Ctrl-C, SIGTERM, SIGHUP) as something that can be waited for beside the
 * workers. */
#ifndef BEAMWORK_INTERRUPT_H
#define BEAMWORK_INTERRUPT_H

#include <signal.h>

typedef struct interrupt {
    int descriptor;  /* can be read once somebody asks; -1: none */
    sigset_t before; /* the mask that interrupt_end restores */
} interrupt;

/* From here on the request is kept until it is looked for, in this process and in those it starts.
 * Signals that are ignored (nohup) stay ignored. */
void interrupt_begin(interrupt *);
/* As before: asked again, the process ends at once. */
void interrupt_end(interrupt *);

#endif
