/* Scenes of tests: files as users write them, and structures that several tests load in their own
 * ways. */
#ifndef BEAMWORK_TEST_SCENES_H
#define BEAMWORK_TEST_SCENES_H

#include "cases/scene/scene.h"
#include "harness/tools/kit/ask.h"
#include "harness/tools/kit/cells.h"

/* A scene file by its path from the root of the sources, as long as the test runs. The reader's
 * message ends a test whose file it refuses. */
const case_type *scenes_case(const char *path);
/* values: "name=value;...", printf style, of its parameters. */
void scenes_at(const case_type *, double value[], const char *values, ...)
    __attribute__((format(printf, 3, 4)));
/* Its scene there, which the caller frees. */
void scenes_read(scene *s, const char *path, const char *values, ...)
    __attribute__((format(printf, 3, 4)));
/* Solves the scene with the default options and fills the answer. */
void scenes_ask(const char *path, const element_type *, int elements, answer *, const char *values,
                ...) __attribute__((format(printf, 5, 6)));
/* Its cell; one that is not solved fails the test. formulation: "name:key=value,...". */
void scenes_solve(const char *path, const char *formulation, int elements, cell_result *,
                  const char *values, ...) __attribute__((format(printf, 5, 6)));
/* Index of what the file calls so. */
int scenes_find(const scene *, scene_list, const char *name);
/* "alpha", ...: as files have it. */
extern const char *const scenes_integrator[SCENE_SCHEMES];

/* A straight section by its products [N, N, N m^2, N m^2] and [kg/m, kg m]. */
typedef struct timed_section {
    double EA, GA, GJ, EI, mass, polar, rotary;
} timed_section;
section_spec timed_profile(const timed_section *);

/* A bar of 1 m along x, clamped at the origin; its section's y axis is that of the scene. Returns
 * its free tip; the root is the node before it. */
int scenes_cantilever(scene *, const section_spec *);
/* Quantities NAME_0, NAME_1, ...: the first frequencies [Hz] of an analysis. */
void scenes_ask_frequencies(scene *, const char *name, int analysis, int count);
/* NAME_0 to NAME_2: displacements [m] of a node at the end of an analysis. */
void scenes_ask_motion(scene *, const char *name, int analysis, int node);

#endif
