/* What cases of motion in time have in common. */
#ifndef BEAMWORK_CASES_TIMED_H
#define BEAMWORK_CASES_TIMED_H

#include "cases/case.h"

/* The first parameters of every such case, in this order. */
enum { TIMED_TIME, TIMED_INTEGRATOR, TIMED_STEP, TIMED_TOLERANCE, TIMED_PARAMETERS };
#define TIMED_INTEGRATORS "alpha|conserving|radau|explicit"
/* Defaults for judging meshes: error-controlled steps whose error of time is far below that of the
 * meshes; what it is stands with each case. */
#define TIMED_HOW(step, rule, tolerance)                                                           \
    [TIMED_INTEGRATOR] = {"integrator",          "", SCENE_RADAU, 0, 0, TIMED_INTEGRATORS,         \
                          "how it is integrated"},                                                 \
    [TIMED_STEP] = {"step", "s", step, 1e-9, 1e3, NULL, "of the integration: " rule},              \
    [TIMED_TOLERANCE] = {                                                                          \
        "tolerance",                                                                               \
        "1",                                                                                       \
        tolerance,                                                                                 \
        0,                                                                                         \
        0.1,                                                                                       \
        NULL,                                                                                      \
        "of the error of time, relative to the largest motion; 0: all steps are alike"}

/* A motion that ends when it is looked at; follows: SCENE_NONE, or a static path; start: velocities
 * at its begin. */
int timed_add(scene *s, const double value[], int follows, scene_start start);
/* Where a node is: those of its coordinates x, y, z that have a name. size: what their errors are
 * measured by where they are smaller [m]. */
void timed_places(scene *s, int motion, int node, double size, const char *const name[3]);

/* A driver that goes from 0 to `end` [m or rad] in that time [s] and stays: 10 s^3 - 15 s^4 + 6
 * s^5, which begins and ends without acceleration. */
int timed_driver(scene *s, double end, double duration);

#endif
