/* Imported values that `beamwork import` stored, read back as contestants of a run. */
#ifndef BEAMWORK_IMPORT_STORE_H
#define BEAMWORK_IMPORT_STORE_H

#include "harness/study/study.h"

/* What of a file the run has no point for. */
typedef struct import_left {
    int series, all; /* those left, and all that the file has */
    char first[256]; /* case/parameters/program of the first; empty: none */
} import_left;

/* Adds a series for every program at points that have series; gates: their verdicts count.
 * FAULT: missing, damaged, foreign; REFUSED: nothing imported is in it, or what is beside
 * the run already. */
status import_store_read(const char *path, int gates, sweep *s, import_left *left, fault *f);

#endif
