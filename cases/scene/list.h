/* Lists of a scene, for the files that add to them. */
#ifndef BEAMWORK_SCENE_LIST_H
#define BEAMWORK_SCENE_LIST_H

#include <stddef.h>

#include "cases/scene/scene.h"

/* Room for one more entry of `list` (the address of its pointer), zeroed: its index, or -1. */
int scene_grow(scene *s, void *list, int *count, size_t size);
/* A copy [n] of numbers; NULL: memory ran out. */
double *scene_copy(scene *s, int n, const double from[]);

#endif
