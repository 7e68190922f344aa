/* Time of a cell that can be believed: the least of enough repetitions, taken in rounds that
 * alternate with the cells it is compared with, and the differences between rounds as its noise. */
#ifndef BEAMWORK_CLOCK_H
#define BEAMWORK_CLOCK_H

#include "harness/study/cell.h"

/* Two cells whose times come from the same distribution have all rounds of one below all rounds of
 * the other with a probability of 2 (5! 5!)/10! = 0.8 %: then, and only then, they are said to
 * differ. */
enum { CLOCK_ROUNDS = 5 };

typedef struct clock_reading {
    double setup, solve;        /* [s] of the fastest repetition */
    double round[CLOCK_ROUNDS]; /* [s] least set-up and solution together in each round */
    int rounds, repeats;
} clock_reading;

/* One more round: repeats until `floor` [s] of the processor's time are spent, at least once. A
 * cell that fails has a time too. */
void clock_round(const cell_request *request, double floor, clock_reading *out);
double clock_least(const clock_reading *); /* [s], INFINITY: never run */
double clock_most(const clock_reading *);  /* [s] of the slowest round */
/* -1: every round of a is faster than every one of b; 1: slower; 0: undecided. */
int clock_compare(const clock_reading *a, const clock_reading *b);

/* Binds this process to the processor it runs on, so that repetitions are comparable. */
void clock_pin(void);
/* Libraries that thread decide so when they are loaded: starts the program anew with one thread.
 * arguments: NULL-terminated. */
void clock_single_thread(char **arguments);

#endif
