/* What a sweep comes to, counted while its points pass by: in how many a formulation is within the
 * tolerance, with how many elements, where not, and its worst points. */
#ifndef BEAMWORK_TALLY_H
#define BEAMWORK_TALLY_H

#include "harness/experiments/ranges.h"

enum { TALLY_WORST = 3, TALLY_COLUMNS = 10, TALLY_ROWS = 12, TALLY_SCENE = 64 };

/* A point that a formulation is worst at, with the finest mesh. */
typedef struct tally_worst {
    long point;
    int quantity;            /* -1: the cell has no solution */
    int status;              /* of the cell */
    double error;            /* relative; NAN: there is no value */
    char scene[TALLY_SCENE]; /* name of its scene file; empty: not kept */
} tally_worst;

/* Of a formulation and a quantity, or of all quantities together: a point where one of them is open
 * is asked only where another is never within; else nobody knows. */
typedef struct tally_series {
    long asked;                     /* points with a reference */
    long proven;                    /* of them measured by a truth */
    long open;                      /* points with a value and nothing to measure it by */
    long within[SERIES_MAX_MESHES]; /* of them, with each mesh */
    long never;                     /* of them, not with all meshes from some on */
    int everywhere;                 /* elements from which on all others are within */
} tally_series;

/* A place of the map. */
typedef struct tally_place {
    long points, other, asked, never; /* other: of another model */
    long proven; /* of those asked: measured by a truth, not by limits of meshes alone */
    int least;   /* elements from which on all points here are within */
} tally_place;

typedef struct tally {
    const parameter_ranges *of;
    long points, without_scene, first_without; /* index of the first such point */
    long kind[RANGES_QUANTITIES][ROWS_REFERENCES];
    double doubt[RANGES_QUANTITIES];  /* the largest */
    int columns, lines;               /* of the map; 0: more than two axes */
    tally_series *series;             /* [formulations x (quantities + 1)], the last of all */
    tally_place *map;                 /* [formulations x (quantities + 1) x lines x columns] */
    long *failed;                     /* [formulations x meshes] cells without a solution */
    double *cost, *seconds;           /* [formulations x meshes] s: of all cells that ran */
    long *ran;                        /* [formulations x meshes] */
    long others[RANGES_FORMULATIONS]; /* points where it solves another model: they count nowhere */
    unsigned lacks[RANGES_FORMULATIONS]; /* what it leaves out there: bits of model.h */
    int worsts[RANGES_FORMULATIONS];
    tally_worst worst[RANGES_FORMULATIONS][TALLY_WORST]; /* the worst first */
} tally;

/* FAULT: out of memory. tally_free frees it, also after a failure. */
status tally_alloc(const parameter_ranges *r, tally *out, fault *f);
void tally_free(tally *);
/* Points from `first` on, each once, in their order. */
status tally_add(tally *, long first, const rows *, fault *f);
/* quantity: index, or the number of quantities: all together. */
const tally_series *tally_of(const tally *, int formulation, int quantity);
const tally_place *tally_at(const tally *, int formulation, int quantity, int line, int column);
/* Where a column (0) or a line (1) of the map begins: value of its axis. */
double tally_edge(const tally *, int axis_index, int place);

#endif
