/* The packed truths and findings (reference/pack.py). */
#ifndef BEAMWORK_TRUTHS_H
#define BEAMWORK_TRUTHS_H

#include <stdint.h>

#include "cases/case.h"
#include "harness/formulations/formulations.h"
#include "harness/study/rules.h"

enum { TRUTHS_VERSION = 3 };

typedef struct truth {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    int any[CASE_MAX_PARAMETERS]; /* 1: holds for any value */
    char *formulation;            /* "": the continuum */
    int elements;                 /* 0: the continuum, or a limit (kind predicted) */
    char *theory, *quantity, *unit, *kind, *model, *convention, *source;
    int on_curve; /* 1: a point of a curve, at its abscissa `at` */
    double at;
    double value, uncertainty;
    /* by the judge: a quantity it speaks of exists; not every formulation skips it */
    int met, judged;
} truth;

typedef struct truths {
    int rows, rules, room; /* room: rows that there is memory for */
    truth *row;
    /* of truth_index.h: the first row of each case and quantity, the next one of the same */
    int indexed, places; /* rows that it knows: the first ones */
    int *first, *next;   /* [places], [indexed] */
    rule *rule;          /* the ledger */
    int strangers;       /* cases of the file that the program does not have */
    char stranger[64];
} truths;

/* FAULT for a missing, truncated or foreign file and for a stale row (its case's defaults have
 * changed since). Formulations that gate are made known (formulations_accept). */
status truths_read(const char *path, truths *out, fault *f);
/* The same of one case (NULL: of all). */
status truths_read_case(const char *path, const case_type *type, truths *out, fault *f);
/* The ledger and the formulations that gate, alone. */
status truths_read_rules(const char *path, truths *out, fault *f);
/* Adds the exact values at the extremes, which no verification runs. On failure the truths read
 * before stay. */
status truths_read_extremes(const char *path, truths *out, fault *f);
/* Rows stay where they are until so many more are added. FAULT: out of memory. */
status truths_reserve(truths *, int more, fault *f);
/* One more row, all zero; NULL: out of memory. */
truth *truths_add(truths *, fault *f);
void truths_free(truths *t);

#endif
