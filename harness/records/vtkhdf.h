/* Centre lines and walls for ParaView and VTK: the group /VTKHDF of an HDF5 file (VTKHDF file
 * format, type UnstructuredGrid). One state: version 1.0; several: version 2.0, the states as time
 * steps. */
#ifndef BEAMWORK_VTKHDF_H
#define BEAMWORK_VTKHDF_H

#include "cases/scene/scene.h"
#include "harness/newton/newton.h"
#include "harness/records/record.h"

void vtkhdf_write(record_file *r, const scene *sc, const shapes *s);

#endif
