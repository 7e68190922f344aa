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

/* One more round: repeats until `floor` [s] of the processor's time are spent, at least once. A
 * cell that fails has a time too. */
void rounds_run(const cell_request *request, double floor, rounds_reading *out);
double rounds_least(const rounds_reading *); /* [s], INFINITY: never run */
double rounds_most(const rounds_reading *);  /* [s] of the slowest round */
/* -1: every round of a is faster than every one of b; 1: slower; 0: undecided. */
int rounds_compare(const rounds_reading *a, const rounds_reading *b);

/* Binds this process to the processor it runs on, so that repetitions are comparable. */
void rounds_pin(void);
/* Libraries that thread decide so when they are loaded: starts the program anew with one thread.
 * arguments: NULL-terminated. */
void rounds_single_thread(char **arguments);

#endif
