/* Quadratic parts of functions of the strains as lists of what is not zero. */
#ifndef BEAMWORK_BEAMW_QUADRATIC_H
#define BEAMWORK_BEAMW_QUADRATIC_H

/* d2(row)/dy_i dy_j = c, i <= j. */
typedef struct beamw_quadratic_term {
    double c;
    short row, i, j;
    short to, mirrored; /* where c y_j and c y_i belong in the rows' derivatives, row-major; behind
                           them: nowhere, since i = j */
    short entry;        /* of a matrix of second derivatives */
} beamw_quadratic_term;

/* Term of row `row` of `rows`, with n variables. */
static inline beamw_quadratic_term beamw_quadratic_of(double c, int rows, int n, int row, int i,
                                                      int j, int entry)
{
    return (beamw_quadratic_term){.c = c,
                                  .row = (short)row,
                                  .i = (short)i,
                                  .j = (short)j,
                                  .to = (short)(n * row + i),
                                  .mirrored = (short)(i == j ? n * rows : n * row + j),
                                  .entry = (short)entry};
}

#endif
