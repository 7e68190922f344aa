/* A process with its standard input and output as channels; its standard error is that of this
 * process. It ends with the thread that starts it. */
#ifndef BEAMWORK_CHILD_H
#define BEAMWORK_CHILD_H

#include <stddef.h>
#include <sys/types.h>

#include "elements/shared/status.h"

typedef struct child {
    pid_t process; /* 0: there is none */
    pid_t owner;   /* the process that started it and may speak to it */
    int to, from;
} child;

typedef enum child_event {
    CHILD_DONE,
    CHILD_ENDED, /* it has closed its output or died */
    CHILD_LATE,  /* nothing came within the limit */
    CHILD_SPOKE  /* it wrote before all of a request was there for it to read */
} child_event;

/* REFUSED: no such command, named; FAULT: no pipe, no process. */
status child_start(char *const words[], child *out, fault *f);
/* Does it still run? */
int child_runs(const child *);
/* Of this process: ends it, now or when it has had a moment to end by itself, and returns how it
 * ended, as waitpid says; -1: it was ended here. Of another process: its channels are closed. */
int child_end(child *, int now);

/* limit: seconds from now, 0: none. */
child_event child_write(const child *, const void *bytes, size_t count, int limit);
/* Reads until `least` bytes are there, at most `most`; *count: how many came, also when it ended.
 */
child_event child_read(const child *, void *bytes, size_t least, size_t most, size_t *count,
                       int limit);

#endif
