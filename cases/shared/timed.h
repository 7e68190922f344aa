/* What cases of motion in time have in common. */
#ifndef BEAMWORK_CASES_TIMED_H
#define BEAMWORK_CASES_TIMED_H

#include "cases/case.h"

/* The first parameters of every such case, in this order. */
enum { TIMED_TIME, TIMED_INTEGRATOR, TIMED_STEP, TIMED_TOLERANCE, TIMED_PARAMETERS };
#define TIMED_INTEGRATORS "alpha|conserving|radau|explicit"
#define TIMED_HOW(step, rule)                                                                      \
    [TIMED_INTEGRATOR] = {"integrator", "", 0, 0, 0, TIMED_INTEGRATORS, "how it is integrated"},   \
    [TIMED_STEP] = {"step", "s", step, 1e-9, 1e3, NULL, "of the integration: " rule},              \
    [TIMED_TOLERANCE] = {                                                                          \
        "tolerance",                                                                               \
        "1",                                                                                       \
        0,                                                                                         \
        0,                                                                                         \
        0.1,                                                                                       \
        NULL,                                                                                      \
        "of the error of a step, relative to the size of the structure; 0: all steps are alike"}

/* A straight section by its products [N, N, N m^2, N m^2] and [kg/m, kg m]. */
typedef struct timed_section {
    double EA, GA, GJ, EI, mass, polar, rotary;
} timed_section;
section_spec timed_profile(const timed_section *);

/* A motion that ends when it is looked at; follows: SCENE_NONE, or a static path. */
int timed_add(scene *s, const double value[], int follows);
/* Displacement of a node, or its turn. */
void timed_wanted(scene *s, const char *name, int motion, int node, int component);

#endif
