/* The machine a batch is computed on: its times belong to it, and its last digits may. */
#ifndef BEAMWORK_NODE_H
#define BEAMWORK_NODE_H

typedef struct machine {
    char host[128], processor[128];
    char blas[256]; /* library, and the kernels that it chose for this processor */
} machine;

machine node_here(void);
/* 1: the same kind: processor and BLAS; hosts may differ. */
int node_same_kind(const machine *, const machine *);

#endif
