/* What quantities read of a motion at an instant without its forces. */
#ifndef BEAMWORK_READING_H
#define BEAMWORK_READING_H

#include "harness/model/model.h"

/* Is it read from places and rates alone? */
int reading_is_kinematic(const scene_quantity *);
/* As extracted, without factor and offset; kinematic kinds only. rate[free + driven] */
double reading_of(const model *, const scene_quantity *, const model_state *, const double rate[]);

#endif
