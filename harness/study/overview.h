/* A run in one look: of each case and formulation the worst verdict and how many quantities have
 * it, over all parameter points. */
#ifndef BEAMWORK_OVERVIEW_H
#define BEAMWORK_OVERVIEW_H

#include <stddef.h>

#include "harness/study/judgement.h"

/* From calm to bad. */
typedef enum overview_mark {
    OVERVIEW_NOTHING, /* skipped, or no truth */
    OVERVIEW_OTHER_MODEL,
    OVERVIEW_PASS,
    OVERVIEW_LOW_ORDER,
    OVERVIEW_UNDECIDED,
    OVERVIEW_BIASED,
    OVERVIEW_WRONG,
    OVERVIEW_NO_VALUE, /* diverged or refused */
    OVERVIEW_FLAW,     /* an inconsistent run record, or its stored value */
    OVERVIEW_MARKS
} overview_mark;

typedef struct overview_cell {
    overview_mark mark;
    int unexpected; /* 1: comes before whatever is expected */
    int count;      /* quantities (of a flaw: cells) with that mark */
} overview_cell;

typedef struct overview {
    int rows, columns;
    int joined;   /* 1: a column has a formulation with all its options */
    int accepted; /* columns before those of new formulations, which do not gate */
    const case_type **row;
    const char **column; /* names, which live as long as the sweep */
    overview_cell *cell; /* [rows*columns] */
} overview;

enum { OVERVIEW_TEXT = 24 };

overview_mark overview_mark_of(verdict_kind kind);
/* FAULT: out of memory. */
status overview_make(const sweep *s, const judgement *j, overview *out, fault *f);
void overview_free(overview *);
const overview_cell *overview_at(const overview *, int row, int column);
/* 1: nothing but passes in that row, and what is not judged. */
int overview_passes(const overview *, int row);
/* 1: something in that row is judged. */
int overview_judged(const overview *, int row);
/* Has a row a line of its own? All have where they are few; else those that pass share lines, so
 * that the rest is one screen. */
int overview_shown(const overview *, int row);
/* "ok", "~3", "!#2": told apart without colour. utf8: 1: with signs beyond ASCII. */
void overview_text(const overview_cell *, int utf8, char text[OVERVIEW_TEXT]);
/* What the mark says, in words. */
const char *overview_words(overview_mark mark);

#endif
