/* What a section looks like, for pictures: straight walls in the principal axes. */
#ifndef BEAMWORK_OUTLINE_H
#define BEAMWORK_OUTLINE_H

#include "elements/section/section.h"

typedef struct outline {
    int walls;
    /* 1: of a section given by its constants only: the rectangle of the same A and Iy : Iz; by its
     * matrices: of the same radii of inertia */
    int equivalent;
    /* (y, z) [m]: two at one end of the wall's mid-line, two at the other, going round */
    double corner[SECTION_MAX_WALLS][4][2];
} outline;

/* c: what the spec comes to. */
void outline_of(const section_spec *spec, const section *c, outline *out);
/* Of the far end of a member whose section changes along it, wall by wall and corner by corner as
 * that of its near end, `near`; between them corners are on straight lines. */
void outline_of_far_end(const section_spec *spec, const section *c, const section *near,
                        outline *out);
void outline_between(const outline *near, const outline *far, double x, outline *out);

#endif
