/* The variables of a collocation element in the order of stages.h: its unknowns F and x of the
 * inner nodes, then the strains v, 2 X, a_p, a_q. */
#ifndef BEAMWORK_EXACT_VARIABLES_H
#define BEAMWORK_EXACT_VARIABLES_H

#include "elements/collocation/blocks.h"
#include "elements/collocation/stages.h"

enum { EXACT_VARIABLES_BLOCKS = EXACT_BLOCKS_MAX * (EXACT_BLOCKS_MAX + 1) / 2 };

/* Place in the blocks of sums.h of variable i, or of 1, which follows the last, and of the three
 * parameters of a load, which follow 1: its block, and in it `component`. */
static inline int exact_variables_block(int stages, int i, int *component)
{
    const int outer = i - 3 * stages;
    *component = i % 3;
    if (outer < 0)
        return i < 3 ? stages - 1 : i / 3 - 1;
    *component = outer % 3;
    if (outer < 6)
        return outer < 3 ? stages + 1 : stages;
    return stages + outer / 3;
}

/* The symmetric matrix A of the blocks [n x n], n variables. */
void exact_variables_matrix(int stages, double A[][9], int n, double matrix[]);

/* The elimination of the unknowns with exchange of rows, where that of blocks.h would lose digits:
 * blocks of the strains, of 1 and what follows (columns together) in S, X [unknowns/3][9] of each
 * of their block columns; 0, or the failing pivot. */
int exact_variables_eliminate(int stages, int columns, double A[][9], double S[][9],
                              double X[][EXACT_STAGES_MAX][9]);

/* Change of x and x' at point i that goes with a change of all variables. */
void exact_variables_change(const exact_stages *s, int i, const double change[], double x[3],
                            double slope[3]);

#endif
