/* A run on one screen: a matrix of cases and formulations, a mark each, and what the marks say. */
#ifndef BEAMWORK_TABLE_OVERVIEW_H
#define BEAMWORK_TABLE_OVERVIEW_H

#include <stdio.h>

#include "harness/study/study.h"
#include "harness/terminal/screen.h"

/* In lines of at most PARAGRAPH_WIDTH. Where there are many cases, those that pass share lines. */
void table_overview(FILE *to, screen, const overview *);

#endif
