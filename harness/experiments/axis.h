/* What varies: a parameter of a case, and its values. */
#ifndef BEAMWORK_AXIS_H
#define BEAMWORK_AXIS_H

#include "cases/case.h"

typedef enum axis_kind { AXIS_LINEAR, AXIS_LOG, AXIS_LIST, AXIS_WORDS } axis_kind;

enum { AXIS_MOST_VALUES = 1000001 };

typedef struct sweep_axis {
    const parameter_type *of;
    int index; /* among the parameters of the case */
    axis_kind kind;
    double from, to; /* of AXIS_LINEAR, AXIS_LOG */
    int count;       /* values; 0: a range that says no number of parts */
    double *value;   /* [count] of AXIS_LIST and AXIS_WORDS; owned */
} sweep_axis;

/* "NAME=A..B/N" (N equal parts, ends included), "NAME=A..B/N:log" (equal ratios), "NAME=A..B"
 * and "NAME=A..B:log" (no values of its own: the points are a design's), "NAME=A,B,C" (numbers, or
 * words of a choice). REFUSED: the culprit and the remedy; every value is one that the parameter
 * may have. */
status axis_read(const case_type *type, const char *text, sweep_axis *out, fault *f);
void axis_free(sweep_axis *);
/* Value i of `count`. */
double axis_value(const sweep_axis *, int i);
/* Where a share of the way is, 0 <= share < 1: of a list the value that the share falls on. */
double axis_at(const sweep_axis *, double share);
/* "linear", "log", "list", "words". */
const char *axis_kind_name(axis_kind);
/* The value as it is written. */
void axis_text(const sweep_axis *, double value, char *text, int size);

#endif
