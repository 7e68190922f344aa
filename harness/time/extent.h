/* How far and how fast the motion has been so far. Tolerances of steps are relative to the largest
 * motion so far, and to no less than a guess of the largest one of all: at first 2 % of the size of
 * the structure. A motion that comes to less than half of its guess is integrated again. */
#ifndef BEAMWORK_EXTENT_H
#define BEAMWORK_EXTENT_H

#include "harness/time/scheme.h"

typedef struct extent {
    model_state *begin; /* where the motion began */
    double bent;        /* its distance from the undeformed state: what that is known to is noise */
    double scale;       /* the guess, in the measure of model.h: 1 is the size of the structure */
    double largest;     /* distance from the begin so far, of what has inertia */
    double rate;        /* [1/s] largest mean one of a step, likewise */
    double density;     /* error of a step by its size to the order of the scheme: extent_error */
    double worst;       /* largest error of a step that was taken, by its part of the motion */
} extent;

/* The guess to begin with. */
extern const double extent_guess;

void extent_begin(extent *, const model *);
/* With a step of h [s]. */
extent extent_with(const extent *, const model *, const motion_scheme *, const instant *from,
                   const instant *to, double h, double error);
/* Where the errors of steps add up to that of the motion, the error of a step of h [s] by what the
 * estimates were within the last ten radians of the motion: that of positions vanishes where rates
 * turn, and what rates are off by is largest there. */
double extent_error(const extent *, const motion_scheme *, double h, double error);
/* The error that a part of the motion may have by a tolerance of all: what coordinates are rounded
 * by is none. */
double extent_allows(const extent *, double part, double tolerance);
/* 1: the motion, which is over, was less than half of the guess, its steps too long for a tolerance
 * relative to that, and it is more than the noise of where it began. *scale: a better guess. */
int extent_is_less(const extent *, double tolerance, double *scale);

#endif
