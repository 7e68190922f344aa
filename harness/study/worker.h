/* Processes that run the cells of a sweep. None outlives the process that started it, and each
 * keeps the time limit of a cell by itself. */
#ifndef BEAMWORK_WORKER_H
#define BEAMWORK_WORKER_H

#include <stdatomic.h>
#include <stdio.h>
#include <sys/types.h>

#include "harness/study/claims.h"
#include "harness/study/sweep.h"

enum { WORKERS_MOST = 64 };

typedef struct task {
    int series, mesh;
} task;

/* Shared by all processes: the next task, and what each worker is at. */
typedef struct board {
    atomic_int next;
    atomic_int at[WORKERS_MOST]; /* -1: nothing */
    /* [s] of a clock that only goes forward: when it was taken */
    _Atomic double since[WORKERS_MOST];
} board;

/* What there is to do, and where its results go. */
typedef struct workload {
    sweep *s;
    int time_limit; /* [s] of one cell; 0: none */
    int together;   /* of the request */
    int count;
    task *tasks;   /* [count] */
    char *done;    /* [count] 1: the cell has its result */
    int finished;  /* of them */
    claims *known; /* of what is solved once; NULL: every cell is solved */
    int *same;     /* [count] task with the same answers, or -1 */
    board *board;
} workload;

typedef struct worker {
    pid_t process;
    FILE *from;  /* NULL: it does not run */
    int stopped; /* by the clock of the parent */
} worker;

status worker_start(const workload *, int self, worker *, fault *);
/* Takes one result, or whose it is: the index of its task; -1: the worker has ended. */
int worker_receive(workload *, worker *);
/* Copies the results of those that are solved once. What was solved without success is left: each
 * has its own words for it. */
void worker_settle(workload *);
/* A worker that ended while it had a task: that cell failed. Returns 1 when it must be replaced. */
int worker_bury(workload *, int self, worker *);
/* Ends it when it has been at one cell for too long and cannot do so itself; its pipe closes. */
void worker_stop_late(const workload *, int self, worker *);
/* Ends it whatever it does; results that it has written are still taken. */
void worker_end(workload *, worker *);

#endif
