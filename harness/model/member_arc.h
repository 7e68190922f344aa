/* The undeformed axis of a member. */
#ifndef BEAMWORK_MEMBER_ARC_H
#define BEAMWORK_MEMBER_ARC_H

#include "cases/scene/scene.h"

/* An arc of constant torsion and curvature between two points (straight when these are zero). */
typedef struct member_arc {
    double length;         /* along the arc [m] */
    double start[3], R[9]; /* position and triad at p */
    double k[3];           /* [1/m] */
} member_arc;

/* axes_angle [rad]: of its section. REFUSED: no arc of its curvature joins its ends. */
status member_arc_of(const scene *s, int member, double axes_angle, member_arc *out, fault *f);
/* Position and triad at the abscissa s [m]. */
void member_arc_at(const member_arc *a, double s, double position[3], double R[9]);

#endif
