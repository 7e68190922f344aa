/* Values along the path of a static analysis: on a line from station to station, before the first
 * and behind the last as there. */
#ifndef BEAMWORK_ALONG_PATH_H
#define BEAMWORK_ALONG_PATH_H

#include "cases/scene/scene.h"

/* What the load is times at a path parameter; without stations the parameter itself. */
double along_path_factor(const scene_load *, double path);
/* Derivative of that by the path parameter; at a station: of what follows. */
double along_path_rate(const scene_load *, double path);
/* Of a known driver [m or rad]. */
double along_path_value(const scene_driver *, double path);
/* For messages, and empty where loads change however far the path goes: "; nothing changes outside
 * path 0 to 1 ...". */
typedef struct along_path_words {
    char text[256];
} along_path_words;
along_path_words along_path_end(const scene *);
/* REFUSED: something does not change in proportion from path 0 to 1. */
status along_path_proportional(const scene *, fault *);

#endif
