/* Processes that run the cells of a sweep. None outlives the process that started it, and each
 * keeps the time limit of a cell by itself. */
#ifndef BEAMWORK_WORKER_H
#define BEAMWORK_WORKER_H

#include <sys/types.h>

#include "harness/study/workload.h"

typedef struct worker {
    pid_t process;
    int from;    /* its pipe; -1: it does not run */
    int stopped; /* by the clock of the parent */
    int damaged; /* by the parent: what it wrote is no result */
    char *bytes; /* of what it said and is not whole */
    size_t count, room;
} worker;

status worker_start(const workload *, int self, worker *, fault *);
/* What worker_receive returns in place of a task. WORKER_NO_MEMORY: this process has none for the
 * results; the worker lives. */
enum { WORKER_ENDED = -1, WORKER_NOTHING = -2, WORKER_NO_MEMORY = -3 };
/* Takes what there is, and does not wait: results, or whose they are. The last of their tasks, or
 * WORKER_NOTHING: nothing is whole yet. A worker that writes no results is ended. */
int worker_receive(workload *, worker *);
/* A worker that ended while it had a task: that cell failed. Returns 1 when it must be replaced. */
int worker_bury(workload *, int self, worker *);
/* Ends it when it has been at one cell for too long and cannot do so itself; its pipe closes. */
void worker_stop_late(const workload *, int self, worker *);
/* Ends it whatever it does; results that it has written are still taken. */
void worker_end(workload *, worker *);

#endif
