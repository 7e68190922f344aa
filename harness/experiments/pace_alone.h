/* From when on nothing acts on a structure: its energy and its momenta stay. */
#ifndef BEAMWORK_PACE_ALONE_H
#define BEAMWORK_PACE_ALONE_H

#include "cases/scene/scene.h"

/* [s] INFINITY: it is held, driven, or loaded for ever. */
double pace_alone_from(const scene *s);

#endif
