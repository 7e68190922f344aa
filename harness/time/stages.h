/* The matrix of three stages of one step: blocks [n x n] of three by three, those beside the
 * diagonal of the masses only. */
#ifndef BEAMWORK_STAGES_H
#define BEAMWORK_STAGES_H

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/carried.h"

enum { STAGES = 3 };

typedef struct stages_matrix {
    sparse whole; /* 3 n; owns its pattern */
    int n;
    int *diagonal; /* [STAGES x n] where the column of the block on the diagonal begins */
} stages_matrix;

/* single: pattern of one block, whole. */
status stages_alloc(const equations *, const carried_masses *, const sparse *single,
                    stages_matrix *, fault *);
void stages_free(stages_matrix *);
/* The block of a stage on the diagonal becomes K; the others zero it first. */
void stages_put(stages_matrix *, int stage, const sparse *K);
void stages_zero(stages_matrix *);
/* Entries K[columns x columns] of an element of block (i, k) are added, of blocks that are all
 * whole (damping, masses that elements spread). pattern: of a single block. */
void stages_add_element(stages_matrix *, int i, int k, const mesh_pattern *pattern, int element,
                        const double K[]);
/* Entry (row, column) of block (i, k) += value; nothing where either is not free. */
void stages_add(stages_matrix *, int i, int k, int row, int column, double value);

#endif
