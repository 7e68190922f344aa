/* The flexure hexapod of N section 4.3: six legs, each of a crank, a rod and two spherical joints,
 * carry a platform.  The published sizes are not in the paper: synthetic. */
#ifndef BEAMWORK_CASES_HEXAPOD_H
#define BEAMWORK_CASES_HEXAPOD_H

#include "cases/shared/joint.h"

enum { HEXAPOD_LEGS = 6 };

/* Parameters of every case with such a hexapod, behind those of its joints. */
enum {
    HEXAPOD_BASE_RADIUS = JOINT_PARAMETERS,
    HEXAPOD_CRANK_LENGTH,
    HEXAPOD_CRANK_AZIMUTH,
    HEXAPOD_PLATFORM_RADIUS,
    HEXAPOD_PLATFORM_AZIMUTH,
    HEXAPOD_HEIGHT,
    HEXAPOD_PARAMETERS
};
extern const parameter_type hexapod_parameters[];

/* Nodes of what floats: the rod, at its lower end, and the bodies inside the joints, at their
 * centres, the lower one first. */
typedef struct hexapod_leg {
    int rod, joint[2];
} hexapod_leg;

/* The platform's node at the centre of its joints; it is left free. */
int hexapod_platform(const double value[], scene *s);
/* All legs, cranks turned by the driver `angle` [rad] about horizontal tangents, positive upwards.
 * Refuses cranks that reach beyond the centre. */
status hexapod_add(const double value[], scene *s, int angle, int platform, int *profile,
                   hexapod_leg legs[HEXAPOD_LEGS], fault *f);

#endif
