/* Results of another program as tidy CSV with a declared header, into a sweep as one more
 * contestant:
 *
 *   # beamwork-import: 1
 *   # program: MBDyn 1.7.3, 3-node                # as legends show it
 *   # case: sheet_cantilever; warping=0           # case, or scene file beside this one; parameters
 *   # model: beam                                 # or solid, plate, ...: then an error of the
 * model # convention: spatial                         # of moments, where a quantity depends on it
 *   # axes: x=x y=y z=z                           # theirs = ours: a signed permutation
 *   quantity, unit, elements, unknowns, seconds, x, value, uncertainty
 *   C_xx, mm/N, 4, 48, 3.3e-3, , 3.9706e-4,
 *
 * Columns stand in any order; quantity, unit, elements and value are needed, x [SI] for a curve.
 * Further header lines behind rows begin another series and keep what they do not say. */
#ifndef BEAMWORK_IMPORT_FILE_H
#define BEAMWORK_IMPORT_FILE_H

#include "cases/format/mistakes.h"
#include "harness/exchange/import_block.h"

/* All mistakes of the file go to m, by line; what it says to `into`. FAULT: it cannot be read. */
status import_file_read(const char *path, import_set *into, mistakes *m, fault *f);

#endif
