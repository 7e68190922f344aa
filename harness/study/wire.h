/* A cell's result as bytes, so that a process can hand it to its parent. */
#ifndef BEAMWORK_WIRE_H
#define BEAMWORK_WIRE_H

#include <stdio.h>

#include "harness/study/cell.h"

int wire_write(FILE *to, const cell_result *cell); /* 0, or -1 */
int wire_read(FILE *from, cell_result *cell);      /* 0, or -1: the stream ended or is damaged */

#endif
