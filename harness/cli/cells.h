/* Cells as bytes of a batch, and what of them must be the same when they are computed again. */
#ifndef BEAMWORK_SPREAD_CELLS_H
#define BEAMWORK_SPREAD_CELLS_H

#include <stdio.h>

#include "harness/records/records.h"
#include "harness/study/study.h"

/* 1: its cells are run here. */
int cells_runs(const sweep *s, int series);
/* What a series' cells cost, in evaluations of an element. */
double cells_expense(const sweep *s, int series);
/* Its cells, the noise of its finest mesh and its times, as far as they were measured. */
status cells_write(FILE *to, const sweep *s, int series, digest *content, fault *f);
status cells_read(FILE *from, sweep *s, int series, fault *f);
/* As they were planned: without results. */
void cells_forget(series *one);
/* Takes out the series that keep[seriess] has no 1 for; their cells are counted as unfinished. */
void cells_keep(sweep *s, const char keep[]);

#endif
