/* The worst points of a sweep kept as scene files. */
#ifndef BEAMWORK_WORST_H
#define BEAMWORK_WORST_H

#include "harness/experiments/tally.h"

/* Writes them into a new folder, "point_12.yaml", each point once, and notes the names in the
 * tally; a scene that no file can say is left out. FAULT: disk or memory; nothing is left. */
status worst_write(const char *folder, tally *t, fault *f);

#endif
