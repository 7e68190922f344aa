/* What another program found of a case: read from a file (harness/exchange), never run here. */
#ifndef BEAMWORK_IMPORTED_H
#define BEAMWORK_IMPORTED_H

#include "harness/formulations/formulations.h"

enum { IMPORTED_UNIT = 48, IMPORTED_FILE = 256, IMPORTED_WORD = 48 };

/* A value, in the units of the case: value = factor * (what the file says). */
typedef struct imported_row {
    int line;               /* of the file */
    int elements, unknowns; /* unknowns: 0: not said */
    char quantity[SCENE_NAME];
    char unit[IMPORTED_UNIT]; /* of the file */
    double factor;
    double seconds;            /* of the solution, as the file says; NAN: not said */
    double x;                  /* [SI] abscissa of a curve; NAN: no curve */
    double value, uncertainty; /* [unit of the quantity]; uncertainty NAN: not said */
} imported_row;

typedef struct imported {
    char program[FORMULATION_KEY]; /* stands where a formulation's key stands */
    char file[IMPORTED_FILE];
    /* "beam": the model of the beams; else another one, whose difference is an error of the model
     */
    char model[IMPORTED_WORD];
    char convention[IMPORTED_WORD]; /* of moments; empty: not said */
    int gates;                      /* 1: its verdicts count */
    int rows;
    imported_row *row;
    element_type type; /* in the place of a formulation: it offers nothing */
} imported;

/* 1: its values are of the continuum model of the beams. */
int imported_same_model(const imported *);
void imported_free(imported *); /* may be NULL */

#endif
