/* Centre lines and sections of the states of a path. */
#ifndef BEAMWORK_STORE_SHAPES_H
#define BEAMWORK_STORE_SHAPES_H

#include "cases/scene/scene.h"
#include "harness/newton/newton.h"
#include "harness/records/record.h"

/* Group below `at`: centre lines, sections, bodies; the caller closes it with H5Gclose. */
hid_t store_shapes(record_file *r, hid_t at, const char *name, const scene *sc, const shapes *s);

#endif
