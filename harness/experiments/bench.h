/* Error against run time: every formulation and mesh of cases, timed in rounds on one processor. */
#ifndef BEAMWORK_BENCH_H
#define BEAMWORK_BENCH_H

#include "harness/experiments/experiment.h"

typedef struct bench_request {
    const char *const *cases; /* [count] their names; 0: all that have a truth */
    const case_type *scene;   /* in their place; NULL: none */
    int count;
    const char *const *assignment; /* [assignments] "NAME=VALUE", of each of them */
    int assignments, meshes;       /* meshes 0: those of the case */
    const int *mesh;
    sweep_request cells;
    int threads, dense; /* dense: 1: the published algorithm is timed too */
} bench_request;

typedef struct bench {
    truths truths; /* read before it is planned */
    sweep sweep;
    judgement judgement;
    environment made;
    int named; /* 1: cases were named, which shows more of them */
} bench;

extern const experiment_type experiment_bench;
void bench_free(bench *);

#endif
