/* Which mesh, and which formulation, reaches an error. One rule, without clocks: a formulation is
 * within a level from the coarsest mesh on whose error, and that of every finer one, is;
 * formulations stand in the order of their counted work on that mesh, at committed prices
 * (study/price.h). One that is known to be wrong in what is asked stands behind all others. */
#ifndef BEAMWORK_REACH_H
#define BEAMWORK_REACH_H

#include "harness/study/verdict.h"

enum { REACH_LEVELS = 4, REACH_EVERY = -1 };
extern const double reach_level[REACH_LEVELS]; /* 10 %, 1 %, 0.1 %, 0.01 % */

/* A formulation within a level. */
typedef struct reached {
    int series, mesh; /* index of that mesh */
    double cost;      /* [s] of its counted work; INFINITY: it leaves derivatives to differences or
                         is computed by another process, and ranks behind those that do not */
    const verdict *defect; /* the first verdict that is not a pass; NULL: all are */
} reached;

typedef struct reach_question {
    const sweep *s;
    const verdict *verdict; /* [verdicts] of all its series; what has no truth is not asked */
    int verdicts, point;
    int quantity; /* or REACH_EVERY: all of the point that any formulation has a truth for */
    double level; /* relative error */
} reach_question;

/* Why the work of a type ranks nothing: "by differences", "in another process"; "": it does. */
const char *reach_unranked(const element_type *type);
/* Index of the coarsest mesh from which on the error of every mesh is within the level, or -1. */
int reach_mesh(const sweep *s, const verdict *v, double level);
/* Is the formulation known to be wrong, or not known to be right, by such a verdict? */
int reach_is_defect(verdict_kind kind);
/* What is known of a formulation with such a defect that is within a level all the same. */
const char *reach_defect_words(verdict_kind kind);
/* Formulations that are within the level: those without a defect first, each by cost, then by name.
 * Returns how many; out: room for all series. Other programs, which count nothing, are left out. */
int reach_ranking(const reach_question *q, reached out[]);
/* How many of the first ones, none with a defect, differ in cost by less than prices are known: 0
 * where there is none that ranks without a defect, 1 where the first one is the cheapest. */
int reach_ties(const reached list[], int count);
/* Series of the point that the question speaks of, and how: 1 every quantity has a truth of its
 * theory, 0 some have none, -1 it does not run. */
int reach_asks(const reach_question *q, int series_index);
/* Verdicts of every series and quantity of a sweep that was not judged, with what formulations
 * agree on where there is no truth; NULL: out of memory. The caller frees it. */
verdict *reach_verdicts(const sweep *s, const truths *t, int *count);

#endif
