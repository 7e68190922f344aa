/* Two formulations at equal error: with how many elements each is within it. */
#ifndef BEAMWORK_MEETING_H
#define BEAMWORK_MEETING_H

#include "harness/study/verdict.h"

/* Of series 0 and 1 of a sweep of one point. */
typedef struct meeting {
    int mesh[2];     /* index of the least mesh from which on all are within the error; -1: none */
    double error[2]; /* relative, the largest on that mesh; NAN */
} meeting;

/* Has each of the two a truth or an agreement for the quantity, and is it no curve? */
int meeting_asks(const sweep *s, const truths *t, int quantity);
/* How many quantities are asked. */
int meeting_asked(const sweep *s, const truths *t);
/* Every asked quantity within the level, which is relative. */
meeting meeting_at(const sweep *s, const truths *t, double level);
/* Do both reach it? */
int meeting_holds(const meeting *);

#endif
