/* Time of a cell that can be believed: the least of enough repetitions, taken in rounds that
 * alternate with the cells it is compared with, and the differences between rounds as its noise. */
#ifndef BEAMWORK_TIMING_ROUNDS_H
#define BEAMWORK_TIMING_ROUNDS_H

#include "harness/study/cell.h"

/* Two cells whose times come from the same distribution have all rounds of one below all rounds of
 * the other with a probability of 2 (5! 5!)/10! = 0.8 %: then, and only then, they are said to
 * differ. */
enum { ROUNDS_COUNT = 5 };

typedef struct rounds_reading {
    double setup, solve;        /* [s] of the fastest repetition */
    double round[ROUNDS_COUNT]; /* [s] least set-up and solution together in each round */
    int rounds, repeats;
} rounds_reading;

double rounds_least(const rounds_reading *); /* [s], INFINITY: never run */
double rounds_most(const rounds_reading *);  /* [s] of the slowest round */
/* -1: every round of a is faster than every one of b; 1: slower; 0: undecided. */
int rounds_compare(const rounds_reading *a, const rounds_reading *b);

/* The published algorithm beside ours: all coordinates, strains and stresses at once, dense
 * Gaussian elimination (newton=dense). */
typedef struct dense_reference {
    int unknowns;         /* of the dense system; 0: not measured */
    double iteration;     /* [s] least time of one iteration */
    rounds_reading whole; /* of whole runs, where these are short enough; else rounds = 0 */
} dense_reference;

/* [s] of a run: measured, or the time of one iteration times their number (the iterations are the
 * same); INFINITY: not measured. */
double dense_reference_seconds(const dense_reference *b, long iterations);

/* Repeated runs of a cell, as it is and with nothing left out (--keep-all). */
typedef struct cell_timing {
    rounds_reading as_is, keep_all; /* rounds = 0: not measured */
    int free_keep_all;              /* unknowns when nothing is left out */
    /* [s] of the solution in one run more, in which the clock is read between the parts of the
     * iterations */
    double phase[PHASES];
    dense_reference dense; /* when asked for */
} cell_timing;

#endif
