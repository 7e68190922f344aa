/* Formulations side by side. */
#ifndef BEAMWORK_FORMULATION_LIST_H
#define BEAMWORK_FORMULATION_LIST_H

#include "harness/formulations/formulation.h"

/* One more, as -f says it, or "all"; each once. REFUSED: unknown, given twice, or beyond the room
 * of `most`. */
status formulation_list_add(const char *text, int most, formulation list[], int *count, fault *f);

#endif
