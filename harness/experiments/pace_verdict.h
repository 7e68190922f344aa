/* Verdicts on integrators, against a table of what is expected (expected.csv):
 *
 *   order      pass, low order or undecided, from errors at halved steps (pace_order.h)
 *   energy     conserved, or "order P" of its drift at halved steps, or drifts
 *   momentum   the same
 *   tolerance  for each of them the decimal logarithm of how many times it the error is; twice as
 *              much or as little is as expected
 *   fate       of each step: grows, stops, bounded or exact (pace.h) */
#ifndef BEAMWORK_PACE_VERDICT_H
#define BEAMWORK_PACE_VERDICT_H

#include "harness/experiments/pace.h"
#include "harness/study/study.h"

enum { PACE_FOUND = 128 };

typedef enum pace_judged {
    PACE_ORDER,
    PACE_ENERGY_KEPT,
    PACE_MOMENTUM_KEPT,
    PACE_TOLERANCE,
    PACE_FATE,
    PACE_JUDGED
} pace_judged;

/* A row of the table; texts live there. */
typedef struct pace_verdict {
    pace_judged kind;
    const char *judged, *case_name, *parameters, *formulation, *integrator, *steps, *expected, *why;
    int elements;
    int group, first, count; /* runs */
    char found[PACE_FOUND];
    int as_expected;
} pace_verdict;

typedef struct pace_verdicts {
    own_table table;
    int count, unexpected;
    pace_verdict *verdict;
} pace_verdicts;

/* Is it what the table says? */
int pace_verdict_is_expected(const pace_verdict *);
/* Reads the table and plans its motions. REFUSED: its first mistake, with its line. */
status pace_verdict_plan(const char *path, pace *, pace_verdicts *, fault *);
/* After pace_judge. */
void pace_verdict_reach(const pace *, pace_verdicts *);
void pace_verdict_free(pace_verdicts *);

#endif
