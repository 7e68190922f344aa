/* What cells cost, compared with each other, before they are solved: elements times how often their
 * equations are due. A guess: nothing but the order of work rests on it. */
#ifndef BEAMWORK_EXPENSE_H
#define BEAMWORK_EXPENSE_H

#include "harness/study/worker.h"

/* In evaluations of an element. */
double expense_of_cell(const sweep *s, int index, int mesh);
/* All tasks of a sweep, tasks[sweep_cells], those of the dearest series first and of one series the
 * finest mesh first: at the end only small ones are left to wait for, and series are whole early
 * when a run is interrupted. 0: done; -1: out of memory. */
int expense_order(const sweep *s, task tasks[]);

#endif
