/* Matrices of small motions about the states of a solution, for programs that go on with them:
 *   M q'' + G q' + K q = B u
 * with q the free coordinates in the order of the rows, u the changes of the loads' factors. */
#ifndef BEAMWORK_SYSTEM_MATRICES_H
#define BEAMWORK_SYSTEM_MATRICES_H

#include "harness/algebra/sparse.h"
#include "harness/equations/rows.h"

typedef enum matrix_kind { MATRIX_GENERAL, MATRIX_SYMMETRIC, MATRIX_SKEW } matrix_kind;

/* Entries that are not zero; where the kind is not general those on and below the diagonal only. */
typedef struct triplets {
    matrix_kind kind;
    int rows, columns, entries;
    int *row, *column; /* [entries] from zero, column by column */
    double *value;     /* [entries] */
} triplets;

typedef struct state_matrices {
    int analysis; /* of the scene; SCENE_NONE: the undeformed structure at rest */
    int station;  /* of its path, from zero; SCENE_NONE: it has none */
    double path;  /* parameter of the loads and drivers */
    int turns;    /* 1: the axes turn, and there is G */
    triplets K, M, G;
    triplets B; /* [rows x loads] generalised force of each load at factor 1 */
} state_matrices;

typedef struct system_matrices {
    int rows;         /* free coordinates */
    row_label *label; /* [rows] */
    int states, room; /* 0: not asked for */
    state_matrices *state;
} system_matrices;

/* Entries of a; skew: of a symmetric pattern the upper triangle of a skew matrix is stored. */
status system_matrices_triplets(const sparse *a, int skew, triplets *out, fault *);
/* From columns [columns x rows], one after the other. */
status system_matrices_triplets_of_columns(int rows, int columns, const double value[],
                                           triplets *out, fault *);
void system_matrices_free(system_matrices *);

#endif
