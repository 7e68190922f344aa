/* A cell's result as bytes, so that a process can hand it to its parent. */
#ifndef BEAMWORK_SERIALISE_H
#define BEAMWORK_SERIALISE_H

#include <stdio.h>

#include "harness/study/cell.h"

int serialise_write(FILE *to, const cell_result *cell); /* 0, or -1 */
enum { SERIALISE_DAMAGED = -1, SERIALISE_NO_MEMORY = -2 };
/* 0, or SERIALISE_DAMAGED: the stream ended or is damaged; then the cell is empty. */
int serialise_read(FILE *from, cell_result *cell);

#endif
