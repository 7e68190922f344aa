/* Sections by their sizes: I, channel, Z, angle, box. */
#ifndef BEAMWORK_BUILD_SHAPES_H
#define BEAMWORK_BUILD_SHAPES_H

#include "cases/format/builder.h"

/* 1, and points and walls, where the section is one of them. */
int build_shapes_read(const fields *f, section_spec *spec);

#endif
