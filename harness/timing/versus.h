/* Two contestants in alternation: is one slower, or does the noise not allow an answer? Drifts of the machine meet both. */
#ifndef BEAMWORK_VERSUS_H
#define BEAMWORK_VERSUS_H

#include "elements/math/status.h"

typedef enum versus_outcome { VERSUS_UNDECIDED, VERSUS_FASTER, VERSUS_SLOWER } versus_outcome;

typedef struct versus {
    int pairs;
    double a, b;             /* [s] least of one lap */
    double ratio, low, high; /* median of b/a over the pairs; where it lies with 99.9 % confidence, whatever the distribution */
    versus_outcome outcome;  /* of b against a; ratios within 2 % of 1 are left undecided: code laid out otherwise does as much */
} versus;

const char *versus_name(versus_outcome);
versus versus_judge(int pairs, const double a[], const double b[]);

/* One lap of a contestant takes *seconds. */
typedef status versus_lap(void *contestant, double *seconds, fault *f);
/* As many pairs as fit into `budget` [s], at least 51: their number is fixed before the first one counts. */
status versus_run(versus_lap *lap, void *a, void *b, double budget, versus *out, fault *f);

#endif
