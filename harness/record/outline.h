/* What a section looks like, for pictures: straight walls in the principal axes about the centroid. */
#ifndef BEAMWORK_OUTLINE_H
#define BEAMWORK_OUTLINE_H

#include "elements/section/section.h"

typedef struct outline {
    int walls;
    int equivalent; /* 1: of a section given by its constants only: the rectangle of the same A and Iy : Iz */
    double corner[SECTION_MAX_WALLS][4][2]; /* (y, z) [m]: two at one end of the wall's mid-line, two at the other, going round */
} outline;

status outline_of(const section_spec *spec, outline *out, fault *f);

#endif
