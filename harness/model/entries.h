/* Where the entries of elements go in the matrices and vectors of a model. */
#ifndef BEAMWORK_MODEL_ENTRIES_H
#define BEAMWORK_MODEL_ENTRIES_H

#include "harness/model/assemble.h"
#include "harness/model/mesh.h"

/* An entry of an element's matrix that a pattern stores. */
typedef struct mesh_entry {
    short local;  /* row * columns + column of the element's matrix */
    short column; /* of the element's matrix */
    int offset;   /* in the pattern: from the begin of its column */
} mesh_entry;

/* What elements share whose entries stand alike in the columns of a pattern. */
typedef struct mesh_layout {
    int entries;
    mesh_entry *entry; /* [entries] */
} mesh_layout;

/* Pattern with the places of every element's entries in it. */
typedef struct mesh_pattern {
    int made;
    sparse matrix;
    int layouts;
    mesh_layout *layout;
    int *layout_of;              /* [elements] */
    const mesh_element *element; /* of the model */
} mesh_pattern;

/* That on which a matrix was made. */
const mesh_pattern *assemble_of(const assemble_patterns *, const sparse *a);
void assemble_matrix(const mesh_pattern *p, int element, const double K[], sparse *out);
/* The same of a discrete element, whose places are looked for. */
void assemble_discrete(const mesh_element *el, const double K[], sparse *out);
void assemble_vector(const mesh_element *el, const double local[], double out[]);
/* Nothing where it is not stored. */
void assemble_subtract(sparse *a, int row, int column, double value);

#endif
