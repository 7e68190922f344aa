/* What a section looks like, for pictures: straight walls in the principal axes. */
#ifndef BEAMWORK_OUTLINE_H
#define BEAMWORK_OUTLINE_H

#include "elements/section/section.h"

typedef struct outline {
    int walls;
    /* 1: of a section given by its constants only: the rectangle of the same A and Iy : Iz */
    int equivalent;
    /* (y, z) [m]: two at one end of the wall's mid-line, two at the other, going round */
    double corner[SECTION_MAX_WALLS][4][2];
} outline;

/* c: what the spec comes to. */
void outline_of(const section_spec *spec, const section *c, outline *out);

#endif
