/* The cross-section of a solid: a lattice of rectangles in the section's own y, z, some of which
 * are filled.
 *
 * A straight wall is a strip along its centre line. Where walls meet at right angles each goes on
 * by half the thickness of the other: an L has its whole corner, and the area is that of the walls.
 * Where a wall ends on the side of another (I, T), the walls count the half of its end that lies
 * inside the other twice; the solid has it once. */
#ifndef BEAMWORK_FACE_H
#define BEAMWORK_FACE_H

#include "elements/section/section.h"

enum {
    FACE_WALLS = 8, /* elements along the longer side of a section of walls, at least */
    FACE_MOST = 2 * SECTION_MAX_WALLS + FACE_WALLS
};

typedef struct face {
    int elements[2];                 /* along y, z */
    double corner[2][FACE_MOST + 1]; /* ascending, from the centroid of the beam [m] */
    unsigned char filled[FACE_MOST]
                        [FACE_MOST]; /* [elements along y][along z] 1: there is a brick */
} face;

/* Place of corner k of n elements on 0 to 1, dense at both ends. */
double face_graded(int k, int n);
/* section: what the spec comes to. REFUSED: tubes, constants, also given ones, walls that are
 * oblique to y and z. */
status face_of(const section_spec *spec, const section *constants, face *out, fault *f);
/* Of what is filled [m^2]. */
double face_area(const face *);

#endif
