/* What points of a sweep came to, as columns: the form in which a batch is handed on and stored. */
#ifndef BEAMWORK_ROWS_H
#define BEAMWORK_ROWS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "elements/shared/status.h"

/* What an error is against. */
typedef enum rows_reference {
    ROWS_STORED,   /* a stored truth at that very point */
    ROWS_DERIVED,  /* a truth that a deriving program solved for there */
    ROWS_LIMIT,    /* the limit that the meshes of all formulations go to */
    ROWS_NONE,     /* no limit is known well enough */
    ROWS_DISPUTED, /* none: limits of formulations differ by more than they are uncertain */
    ROWS_REFERENCES
} rows_reference;

/* Of a cell; before them the words of `status`. */
enum {
    ROWS_NOT_OFFERED = STATUS_NO_VALUE + 1,
    ROWS_NO_SCENE,
    ROWS_NOT_COMPUTED, /* its batch is missing */
    ROWS_STATUSES
};

/* How many there are of each; they are the same at every point. */
typedef struct rows_shape {
    int formulations, meshes, quantities;
} rows_shape;

/* Columns of `points` points, in one piece of memory. The last index changes first. */
typedef struct rows {
    rows_shape shape;
    int points;
    size_t size;               /* [bytes] of all */
    double *first;             /* the piece: owned */
    double *reference, *doubt; /* [points, quantities] value and relative uncertainty; NAN */
    double *value, *error;     /* [points, formulations, meshes, quantities]; error relative; NAN */
    double *cost, *seconds;    /* [points, formulations, meshes] s: counted work, measured */
    int32_t *lacks;  /* [points, formulations] bits of model.h: of another model, which counts
                        nowhere; 0: of the scene's own */
    int32_t *least;  /* [points, formulations, quantities] elements from which on every mesh is
                        within  the tolerance; 0: none */
    uint8_t *kind;   /* [points, quantities] of rows_reference */
    uint8_t *status; /* [points, formulations, meshes] */
} rows;

/* All zero. FAULT: out of memory. */
status rows_alloc(const rows_shape *shape, int points, rows *out, fault *f);
void rows_free(rows *);
/* Bytes of this machine. 0, or -1 */
int rows_write(FILE *to, const rows *);
int rows_read(FILE *from, rows *);
/* Indices into the columns. */
size_t rows_quantity(const rows *, int point, int quantity);
size_t rows_cell(const rows *, int point, int formulation, int mesh);
size_t rows_value(const rows *, int point, int formulation, int mesh, int quantity);
size_t rows_lacks(const rows *, int point, int formulation);
size_t rows_least(const rows *, int point, int formulation, int quantity);
/* Words of the file. */
const char *rows_reference_name(int kind);
const char *rows_status_name(int status);

#endif
