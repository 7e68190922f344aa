/* Sections of straight thin walls: one of the ways to fill a section. */
#ifndef BEAMWORK_SECTION_WALLS_H
#define BEAMWORK_SECTION_WALLS_H

#include "elements/section/tree.h"

/* Mid-lines in principal axes about the centroid, values at the points. */
typedef struct walls_lines {
    section_tree tree;
    double y[SECTION_MAX_POINTS], z[SECTION_MAX_POINTS]; /* [m] */
    double omega[SECTION_MAX_POINTS]; /* about the shear centre, zero mean [m^2] */
    double flow[SECTION_MAX_WALLS]; /* from `from` to `to`, of Saint-Venant's torsion per G and unit
                                       twist: that of the cells [m^2] */
    double pole[2];                 /* the shear centre [m] */
} walls_lines;

/* A zeroed section's constants but for shear and the moments of higher order; REFUSED as
 * section_walls. */
status walls_lines_of(const section_spec *spec, walls_lines *lines, section *out, fault *f);

/* Adds geometry and the shear compliance F to a zeroed section; the material is not its concern.
 * REFUSED: closed cell, disconnected wall, unused point, sizes that are not positive, walls on one
 * line. */
status section_walls(const section_spec *spec, section *out, fault *f);

/* int omega r^2 dA in parts of the square root of int omega^2 dA int r^4 dA: by it a bimoment turns
 * the section on, and a twist to one side is not that to the other; no element has it. 0 of
 * symmetric sections, and of those that are no walls. */
double walls_one_sided(const section_spec *spec);

#endif
