/* Which rows of L are made together, and which columns they take together. */
#ifndef BEAMWORK_TRIANGULAR_GROUPS_H
#define BEAMWORK_TRIANGULAR_GROUPS_H

#include "harness/numerics/triangular_rows.h"

/* A symmetric matrix and its factor, in the order of elimination. */
typedef struct triangular_pattern {
    int n;
    const int *column, *row; /* upper triangle of the matrix: [n + 1], [column[n]] */
    const int *parent;       /* [n] elimination tree, -1: a root */
    const int *begin;        /* [n + 1] of L */
    int *mark, *path;        /* [n] work space */
} triangular_pattern;

typedef struct triangular_groups {
    int groups;
    int *first_of_group, *run_of_group; /* [groups + 1] */
    triangular_run *run;                /* [run_of_group[groups]] */
    int columns;                        /* runs of all columns ... */
    triangular_run *of_columns;         /* ... [columns] */
} triangular_groups;

/* Fills L_row[begin[n]] too. 0: out of memory; triangular_groups_free in either case. */
int triangular_groups_find(const triangular_pattern *, int L_row[], triangular_groups *out);
/* Rows of the matrix [column[n]] into where triangular_rows adds its entries; column: [n + 1]. */
void triangular_groups_place(const triangular_groups *, const int column[], int row[]);
void triangular_groups_free(triangular_groups *);

#endif
