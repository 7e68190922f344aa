/* Time of a cell that can be believed: the least of enough repetitions, with their spread. */
#ifndef BEAMWORK_CLOCK_H
#define BEAMWORK_CLOCK_H

#include "harness/run/cell.h"

typedef struct clock_reading {
    double setup, solve; /* least seconds */
    double spread;       /* (median - least)/least of set-up and solution together */
    int repeats;
} clock_reading;

/* Repeats until `floor` seconds are spent, at least 3 and at most 200 times; *last is the result of one of them. */
status clock_cell(const cell_request *request, double floor, clock_reading *out, cell_result *last, fault *f);
/* Binds this process to the processor it runs on, so that repetitions are comparable. */
void clock_pin(void);

#endif
