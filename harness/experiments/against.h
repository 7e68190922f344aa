/* Two contestants in alternation: is one slower, or does the noise not allow an answer? Drifts of
 * the machine meet both. */
#ifndef BEAMWORK_AGAINST_H
#define BEAMWORK_AGAINST_H

#include "elements/shared/status.h"

typedef enum against_outcome { AGAINST_UNDECIDED, AGAINST_FASTER, AGAINST_SLOWER } against_outcome;

typedef struct contest_clock {
    int pairs;
    double a, b; /* [s] least of one lap */
    /* median of b/a over the pairs; where it lies with 99.9 % confidence, however distributed */
    double ratio, low, high;
    /* of b against a; ratios within 2 % of 1 are left undecided: code laid out otherwise does as
     * much */
    against_outcome outcome;
} contest_clock;

const char *against_name(against_outcome);
/* Of given seconds of `pairs` laps each: tests give them, no clock is asked. */
contest_clock against_judge(int pairs, const double a[], const double b[]);

/* One lap of a contestant takes *seconds. */
typedef status against_lap(void *contestant, double *seconds, fault *f);
/* As many pairs as fit into `budget` [s], at least 51: their number is fixed before the first one
 * counts. */
status against_run(against_lap *lap, void *a, void *b, double budget, contest_clock *out, fault *f);

#endif
