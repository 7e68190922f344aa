#ifndef BEAMWORK_TEST_SCENES_H
#define BEAMWORK_TEST_SCENES_H

#include "cases/scene/scene.h"
#include "harness/tools/kit/ask.h"
#include "harness/tools/kit/cells.h"

/* Reads a scene file, whose path is relative to the root of the sources. The result is valid until
 * the test ends. An error in the file ends the test with its message. */
const case_type *scenes_case(const char *path);
/* Sets parameter values. values: "name=value;...", a printf format. */
void scenes_at(const case_type *, double value[], const char *values, ...)
    __attribute__((format(printf, 3, 4)));
/* Reads the scene at these values. The caller frees it. */
void scenes_read(scene *s, const char *path, const char *values, ...)
    __attribute__((format(printf, 3, 4)));
/* Solves the scene with the default options and fills the answer. */
void scenes_ask(const char *path, const element_type *, int elements, answer *, const char *values,
                ...) __attribute__((format(printf, 5, 6)));
/* Solves a run, which must succeed. formulation: "name:key=value,...". */
void scenes_solve(const char *path, const char *formulation, int elements, cell_result *,
                  const char *values, ...) __attribute__((format(printf, 5, 6)));
/* Returns the index of the entry with this name in the file. */
int scenes_find(const scene *, scene_list, const char *name);
extern const char *const scenes_integrator[SCENE_SCHEMES];

/* A straight section given by its stiffnesses [N, N, N m^2, N m^2] and masses [kg/m, kg m]. */
typedef struct timed_section {
    double EA, GA, GJ, EI, mass, polar, rotary;
} timed_section;
section_spec timed_profile(const timed_section *);

/* Adds a bar of 1 m along x, clamped at the origin. The y axis of its section is that of the scene.
 * Returns its free tip. The root is the previous node. */
int scenes_cantilever(scene *, const section_spec *);
/* Adds quantities NAME_0, NAME_1, ... for the first frequencies [Hz] of an analysis. */
void scenes_ask_frequencies(scene *, const char *name, int analysis, int count);
/* Adds quantities NAME_0 to NAME_2 for the displacements [m] of a node at the end of an
 * analysis. */
void scenes_ask_motion(scene *, const char *name, int analysis, int node);

#endif
