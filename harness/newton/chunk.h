/* A few elements evaluated in one go: of one kind where the type has lanes (element_type.lanes),
 * else one after the other. */
#ifndef BEAMWORK_MODEL_CHUNK_H
#define BEAMWORK_MODEL_CHUNK_H

#include "harness/newton/distributed.h"
#include "harness/newton/equations_impl.h"
#include "harness/newton/linearise.h"

enum {
    CHUNK_MOST = 8,   /* elements in one go */
    CHUNK_WINDOW = 32 /* elements among which those of one kind are looked for */
};

/* Elements in one go; 1 where they are evaluated one after the other. */
int chunk_size(const model *m);
/* The next of [first, end) to be evaluated in one go, end - first <= CHUNK_WINDOW: index[];
 * returns their number, 0: none is left. done[end - first] is zero before the first call. */
int chunk_next(const model *m, int first, int end, unsigned char done[], int index[CHUNK_MOST]);

/* One element's evaluation. */
typedef struct chunk_element {
    int index;     /* of the element: given */
    double *force; /* [7 nodes]: given */
    double *K;     /* [7 nodes x 7 nodes] sum sigma_i H_i; NULL: not wanted: given */
    node_state x[ELEMENT_MAX_NODES];
    distributed_taken along; /* loads that are in its stresses */
    status outcome;
    int complete; /* 1: force is J^T sigma of the slot, and K has J^T C J too ... */
    double present[ELEMENT_MAX_COORDINATES]; /* ... and this is J^T sigma of the state */
} chunk_element;

/* Strains and stresses of count elements in the state, into their slots (linearise_slot), and what
 * chunk_element says. */
void chunk_evaluate(const equations *eq, const linear_memory *memory, const model_state *s,
                    double path, int count, chunk_element element[]);

#endif
