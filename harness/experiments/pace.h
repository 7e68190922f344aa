/* Integrators side by side on motions in time: what each step costs, and what comes of it.
 *
 * Errors are of time alone: against a reference on the same mesh. */
#ifndef BEAMWORK_PACE_H
#define BEAMWORK_PACE_H

#include "harness/experiments/pace_list.h"
#include "harness/experiments/pace_method.h"
#include "harness/study/study.h"

/* What becomes of a motion on which nothing acts, whose energy and momenta stay. */
typedef enum pace_fate {
    PACE_UNJUDGED, /* something acts on it */
    PACE_GROWS,    /* its energy, by more than pace_growth */
    PACE_STOPS,    /* a step of this length finds no solution */
    PACE_BOUNDED,
    PACE_EXACT, /* energy and momenta within pace_energy and pace_momentum */
    PACE_FATES
} pace_fate;

/* Tolerances of the reference and of its checks, radau on the same mesh. */
enum { PACE_CHECKS = 2 };
extern const double pace_reference[1 + PACE_CHECKS];
/* Of E/E0 - 1; of energy and momenta in parts of their size. */
extern const double pace_growth, pace_energy, pace_momentum;

/* One motion: an integrator with a step or a tolerance. */
typedef struct pace_run {
    int group, series; /* of the sweep: a series and a point each, of one mesh */
    pace_method method;
    double step, tolerance; /* [s] the first one, of fixed steps all; 0: fixed */
    /* What came of it; NAN: none */
    status status;
    const char *reason;               /* lives in the sweep */
    double error;                     /* largest over stations: places over size, turns [rad] */
    double *values;                   /* [quantities] errors, relative; owned */
    double order;                     /* against the run before, of twice the step */
    double cost, seconds, iterations; /* [s] counted, measured; of a step */
    long steps, rejected;
    double energy, momentum; /* largest drift, relative */
    double largest, last;    /* of E/E0 */
    double stopped;          /* [s] when it ended too early */
    pace_fate fate;
} pace_run;

/* Motions of one structure, mesh and formulation. */
typedef struct pace_group {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    formulation formulation;
    int elements;
    int analysis;       /* the motion */
    double step, end;   /* of the scene [s] */
    double from;        /* [s] from here on nothing acts; INFINITY: never */
    int first, runs;    /* in the list of all */
    int reference;      /* series, and behind it those of its checks; -1: no errors are wanted */
    double uncertainty; /* of the reference; NAN: there is none */
    double order;       /* of the reference, by the steps and errors of its checks; NAN */
    char reason[FAULT_TEXT]; /* why not */
} pace_group;

typedef struct pace {
    sweep sweep;
    int groups, runs;
    pace_group *group;
    pace_run *run;
} pace;

void pace_free(pace *);
const char *pace_fate_name(pace_fate);
const sweep_point *pace_point_of(const pace *, const pace_run *);
const cell_result *pace_cell_of(const pace *, int index);

#endif
