/* Numbers of elements, as -n gives them. */
#ifndef BEAMWORK_MESHES_H
#define BEAMWORK_MESHES_H

#include "elements/shared/status.h"

enum { MESHES_FINEST = 10000000 };

/* Adds "1,2,4" to mesh[most], of which *count are there. REFUSED: what is no whole number from 1 to
 * MESHES_FINEST, or too many. */
status meshes_parse(const char *list, int most, int mesh[], int *count, fault *f);

#endif
