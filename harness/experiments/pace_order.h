/* Orders in time of an integrator, from runs of halved steps. */
#ifndef BEAMWORK_PACE_ORDER_H
#define BEAMWORK_PACE_ORDER_H

#include "harness/experiments/pace.h"

typedef enum pace_order_kind {
    PACE_ORDER_PASS,
    PACE_ORDER_LOW,       /* surely below the nominal one */
    PACE_ORDER_UNDECIDED, /* fewer than three errors above the floor, or orders that differ */
    PACE_ORDER_KINDS
} pace_order_kind;

/* Fixed steps of one integrator in one group, the longest first. */
typedef struct pace_ladder {
    int group;
    const pace_method *method;
    int first, count;     /* of the list of runs */
    double order, before; /* of the last three errors above the floor: the last, the one before */
    double floor;         /* errors below it are the reference's or of rounding */
    pace_order_kind kind;
} pace_ladder;

/* The order is below the nominal one by less than this: as of meshes (harness/study). */
extern const double pace_order_slack;

/* 1: what its steps do not resolve stops the order of the reference. */
int pace_order_is_stopped(const pace_group *);

/* From run `first` on. */
pace_ladder pace_order_of(const pace *, int first);
/* 1: the error of a quantity [relative] does not fall with the step: a force that follows what the
 * steps do not resolve, say. */
int pace_order_stands(const pace *, const pace_ladder *, int quantity);
/* Orders of all runs against the one before, of a longer step. */
void pace_order_fill(pace *);
const char *pace_order_name(pace_order_kind);

#endif
