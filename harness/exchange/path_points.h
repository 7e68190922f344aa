/* Where a deck stops on a static path: its stations, what quantities ask for, and the corners of
 * drivers and load factors, so that each step is straight. */
#ifndef BEAMWORK_PATH_POINTS_H
#define BEAMWORK_PATH_POINTS_H

#include "cases/scene/scene.h"

typedef struct path_points {
    int count;
    double *value; /* [count] ascending */
} path_points;

status path_points_of(const scene *s, int analysis, path_points *out, fault *f);
void path_points_free(path_points *);
/* Does the quantity, of the path or of what follows it, ask for its value at the point? */
int path_points_asked(const scene *s, int analysis, const scene_quantity *q, double point);

#endif
