/* Axes of another program: theirs = ours, a signed permutation. */
#ifndef BEAMWORK_AXES_H
#define BEAMWORK_AXES_H

#include "cases/scene/scene.h"

typedef struct axes {
    int ours[3]; /* 0..2: which of ours is their x, y, z */
    int sign[3]; /* 1 or -1 */
} axes;

extern const axes axes_same;

/* "x=x y=-z z=y"; 0: it is no such permutation. */
int axes_parse(const char *text, axes *out);
/* The quantity of the scene that their quantity `q` is in our axes, and the sign it takes; NULL:
 * the scene has none. */
const scene_quantity *axes_quantity(const axes *a, const scene *s, const scene_quantity *q,
                                    int *sign);

#endif
