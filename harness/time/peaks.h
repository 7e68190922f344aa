/* Largest and least values of what a motion has where its steps end: reactions, resultants,
 * stresses, energies and momenta. There they are those of the scheme. Between, a cubic through four
 * ends that follow each other says where a value may pass them (order 4), and a step of its own
 * leads there: the cubic's value counts where both agree to less than it adds, so that what steps
 * do not resolve is not believed. */
#ifndef BEAMWORK_PEAKS_H
#define BEAMWORK_PEAKS_H

#include "harness/time/scheme.h"

enum { PEAKS_ENDS = 4 }; /* of steps that follow each other */

/* One quantity. */
typedef struct peak {
    const scene_quantity *q;
    outcome_passing *out;
    double sign, from, until; /* 1: largest, -1: least; window [s] */
    double value[PEAKS_ENDS]; /* the last ones */
} peak;

typedef struct peaks {
    analysis_context *c;
    int analysis;
    motion_scheme *scheme;
    const carried_masses *masses;
    outcome_motion *out;
    int count, ends; /* quantities; ends since what acts was last smooth no longer, or begun */
    peak *one;       /* [count] */
    instant last[PEAKS_ENDS], at;
} peaks;

/* c, analysis, scheme, masses and out are given. Nothing is allotted or done where no quantity asks
 * for it. */
status peaks_alloc(peaks *, fault *);
void peaks_free(peaks *);
/* The motion is here, with these energies; last 1: nothing smooth follows, as before a jump of what
 * acts and at the end. */
status peaks_here(peaks *, const instant *, const double balance[SCENE_BALANCES], int last,
                  fault *);
/* From here on what is there otherwise. */
void peaks_jump(peaks *);
/* The motion is over. */
void peaks_end(peaks *);

#endif
