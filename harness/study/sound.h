/* What the cell says of its own work, judged without any truth: a record that contradicts itself
 * is a fault of the program. */
#ifndef BEAMWORK_SOUND_H
#define BEAMWORK_SOUND_H

#include "harness/study/cell.h"

/* 1: the counters, the steps and the corrections of a cell agree with each other and with what
 * every solution promises. 0: `why` says what does not. newton: how it was solved. A cell
 * without a solution is not asked. */
int sound_cell(const cell_result *cell, const scene *s, newton_form newton, char why[FAULT_TEXT]);

#endif
