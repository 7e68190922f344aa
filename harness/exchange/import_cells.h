/* Values of another program as a series of a sweep: cells that were not run here. */
#ifndef BEAMWORK_IMPORT_CELLS_H
#define BEAMWORK_IMPORT_CELLS_H

#include "harness/study/study.h"

/* Sorts the values by elements, quantity, abscissa. */
void import_cells_order(imported *found);
/* A series of the point, behind those that the point has; it owns what was found, also after a
 * failure. REFUSED: more meshes than a series has room for. */
status import_cells_add(sweep *s, int point_index, imported *found, fault *f);

#endif
