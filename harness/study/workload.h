/* What a run has to do: cells, and what comes up while they are run. That is finest meshes again,
 * for their noise, and cells that wait for the answers of another which then has none. */
#ifndef BEAMWORK_WORKLOAD_H
#define BEAMWORK_WORKLOAD_H

#include <semaphore.h>
#include <stdatomic.h>

#include "harness/study/claims.h"
#include "harness/study/sweep.h"

enum { WORKERS_MOST = 64 };

typedef struct workload_task {
    int series, mesh;
    int again; /* 0: the cell; k > 0: the same in other words, k - 1 of noise.h */
} workload_task;

/* Shared by all processes: what there is to take, and what each worker is at. */
typedef struct board {
    atomic_int next;             /* of the tasks that were known from the beginning */
    atomic_int later, taken;     /* tasks that came up; those of them that were taken */
    atomic_int ended;            /* 1: no more come up */
    sem_t news;                  /* whoever waits is told of what comes up, and of the end */
    atomic_int at[WORKERS_MOST]; /* -1: nothing */
    /* [s] of a clock that only goes forward: when it was taken */
    _Atomic double since[WORKERS_MOST];
    atomic_int came_up[]; /* task, ~task: to be solved whoever has the same answers */
} board;

/* What of a series is not done: some of its cells, its noise, nothing. */
enum series_state { SERIES_CELLS, SERIES_NOISE, SERIES_WHOLE };

typedef struct workload {
    sweep *s;
    const sweep_follower *follower; /* NULL: none */
    int time_limit;                 /* [s] of one cell; 0: none */
    int together;                   /* of the request */
    int count, all;       /* tasks: the cells in the order of expense.h, then two for each series */
    workload_task *tasks; /* [all] */
    char *done;           /* [all] 1: it has its result */
    int due, finished;    /* of those that are to be done */
    int *open;            /* [seriess] tasks of it that are to be done */
    char *state;          /* [seriess] enum series_state */
    int told;             /* series that the follower was told of */
    cell_result *again;   /* [all - count] */
    claims *known;        /* of what is solved once; NULL: every cell is solved */
    int *waits, *after; /* [all] first task that waits for the answers of this one; the next such */
    int out_of_memory;
    size_t size; /* [bytes] of the board */
    board *board;
} workload;

/* FAULT: out of memory. workload_end frees it, also then. */
status workload_begin(const sweep_request *, sweep *, workload *, fault *);
void workload_end(workload *);

/* Child: the next task of worker `self`, which waits until there is one; -1: none any more.
 * *alone: 1: solved whoever has the same answers. */
int workload_take(const workload *, int self, int *alone);
/* In what other words, where it is for the noise; the point's own edit else. */
scene_edit workload_edit(const workload *, int task);

/* Where the result of a task goes. */
cell_result *workload_cell(const workload *, int task);
/* The result is there, or the failure. */
void workload_done(workload *, int task);
/* The task has the answers of another one. */
void workload_same(workload *, int task, int same);
/* A share of the whole work that is known, by what cells cost: 0 to 1. */
double workload_share(const workload *);

/* Is there a series that the follower can be told of, in their order? */
int workload_can_tell(const workload *);
/* Tells of that one. */
status workload_tell(workload *, fault *);
/* Series that are not whole are taken out: they show nothing. */
void workload_keep_whole(workload *);

#endif
