/* A straight cantilever along x with given stiffnesses: what the cases of large displacement have
 * in common. */
#ifndef BEAMWORK_CASES_CANTILEVER_H
#define BEAMWORK_CASES_CANTILEVER_H

#include "cases/case.h"

/* Stiffnesses of a doubly symmetric section that does not warp; GA = 0: shear-rigid. [N, N, N m^2,
 * N m^2] With E = 1 Pa the area is EA, and the density [kg/m^3] belongs to that. */
typedef struct cantilever_stiffness {
    double EA, GA, GJ, EI, density;
} cantilever_stiffness;

/* Adds section, clamped root at the origin and free tip at (length, 0, 0), the physics and meshes 1
 * .. 32. */
void cantilever_build(double length, const cantilever_stiffness *k, scene *s, int *root, int *tip);

/* Adds a static path from 0 to 1 in one station; returns the analysis. */
int cantilever_path(scene *s);

/* Adds a quantity of the tip at the end of the path; row: SCENE_UX ..; reported = factor * value +
 * offset. */
void cantilever_quantity(scene *s, const char *name, const char *unit, int analysis, int tip,
                         int row, double factor, double offset);

/* Deflection, shortening and turn of a tip that is bent in the plane of x and y, all over L = 1 m:
 * the end of a path. */
void cantilever_bent(scene *s, int tip);

/* What a steady rotation does to a beam of L = 1 m, EI = 1 N m^2: the stretch of its end, the pull
 * on its root; from two elements on. */
void cantilever_turning(scene *s, int rotation, int root, int tip);

#endif
