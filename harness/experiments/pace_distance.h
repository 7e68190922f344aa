/* How far a motion is from another one of the same mesh. */
#ifndef BEAMWORK_PACE_DISTANCE_H
#define BEAMWORK_PACE_DISTANCE_H

#include "harness/experiments/pace.h"

/* Largest over the stations of the analysis and over nodes and centre lines: of the distance of two
 * places in parts of the size of the structure, and of the angle between two sections [rad]. NAN: a
 * station is missing. */
double pace_distance(const cell_result *, const cell_result *other, int analysis);
/* Of a quantity of the scene, relative to the other value or near_zero; NAN: one is missing. */
double pace_distance_of(const scene_quantity *, const quantity_result *,
                        const quantity_result *other);

#endif
