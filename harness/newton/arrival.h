/* When Newton has arrived at a state: from the size of his corrections of motions and stresses, and
 * from how they contracted. */
#ifndef BEAMWORK_ARRIVAL_H
#define BEAMWORK_ARRIVAL_H

#include "harness/newton/advance.h"

/* Of one path. All but `stress` are dimensionless. */
typedef struct arrival {
    double criterion;          /* that was asked for; 0: that of rounding */
    double small;              /* largest of two corrections after another that ends a step */
    double correction, before; /* the last one; the one before it in the same step, or INFINITY */
    double stress;             /* largest one of the path so far [N] */
    double stress_change;      /* by the last correction, relative to it */
    double contraction;        /* size of a correction by the square of the one before it, as seen
                                  last; NAN: never */
    double remaining;          /* size of the next correction, predicted; NAN: not known */
} arrival;

/* differences 1: derivatives are differences, whose noise keeps corrections from contracting: the
 * first small one is the last. elements: rounding of the places of very many keeps corrections from
 * becoming smaller. */
void arrival_start(double criterion, int differences, int elements, arrival *);
/* A correction was made, with what it did to the stresses; `first` of its step. */
void arrival_take(double correction, const advance_stress *, int first, arrival *);
/* 1: another correction would change nothing. */
int arrival_reached(const arrival *);
/* 1: the state has moved so little since the last linearisation that its tangent is that of the
 * state, as far as rounding lets them be told apart. */
int arrival_tangent_stands(const arrival *);

#endif
