/* What an error costs: which integrator, with which step or tolerance, reaches it soonest. */
#ifndef BEAMWORK_PACE_REACH_H
#define BEAMWORK_PACE_REACH_H

#include "harness/experiments/pace.h"

enum { PACE_LEVELS = 3 };
extern const double pace_levels[PACE_LEVELS];

typedef struct pace_reach {
    const pace_run *run; /* that is within it, as are those of its integrator with smaller steps or
                            tolerances; NULL: none is */
    double cost;         /* [s] between that run and the one before, where the error is the level */
} pace_reach;

/* By one integrator in one group. */
pace_reach pace_reach_of(const pace *, int group, const char *method, double level);
/* Different integrators of all groups, by name; returns their number. */
enum { PACE_METHODS_MOST = 32 };
int pace_reach_methods(const pace *, const char *name[PACE_METHODS_MOST]);

#endif
