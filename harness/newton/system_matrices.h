/* Matrices of small motions about the states of a solution, for programs that go on with them:
 *   M q'' + G q' + K q = B u
 * with q the free coordinates in the order of the rows, u the changes of the loads' factors. */
#ifndef BEAMWORK_SYSTEM_MATRICES_H
#define BEAMWORK_SYSTEM_MATRICES_H

#include "harness/newton/rows.h"
#include "harness/numerics/numerics.h"

typedef struct state_matrices {
    int analysis; /* of the scene; SCENE_NONE: the undeformed structure at rest */
    int station;  /* of its path, from zero; SCENE_NONE: it has none */
    double path;  /* parameter of the loads and drivers */
    int turns;    /* 1: the axes turn, and there is G */
    triplets K, M, G;
    triplets inside; /* of the undeformed structure: what its mass does inside of elements, for
                        frequencies: q.K q = lambda q.M q + lambda^2 q.inside q */
    triplets B;      /* [rows x loads] generalised force of each load at factor 1 */
    int modes;       /* of a modal analysis: what it found, ascending; else 0 */
    double *frequency, *mode; /* [modes] [rad/s]; [modes x rows] */
} state_matrices;

typedef struct system_matrices {
    int rows;         /* free coordinates */
    row_label *label; /* [rows] */
    int states, room; /* 0: not asked for */
    state_matrices *state;
} system_matrices;

void system_matrices_free(system_matrices *);

#endif
