/* Columns without a header, by a map in YAML: which column of which rows is which quantity.
 *
 *   beamwork_map: 1
 *   program: MBDyn 1.7.3, 3-node           # as in the header of a CSV: case, model, convention too
 *   case: sheet_cantilever
 *   elements: 4                            # unknowns, seconds
 *   columns: {label: 1, x: 2, y: 3}        # names of columns, counted from 1
 *   values:
 *     u_x: {file: .mov, where: {label: 9}, column: x, minus: 0.1, times: 1, unit: m, rows: last}
 *
 * file: how the file's name ends; under: how the last line begins that is no row of numbers; where:
 * columns with these numbers; rows: first, last, or a number counted from 1 (default last), or all:
 * a curve over `abscissa`, a column too. Value = times * (column - minus), in `unit`. */
#ifndef BEAMWORK_IMPORT_MAP_H
#define BEAMWORK_IMPORT_MAP_H

#include "harness/exchange/import_block.h"

/* The files together are one series. Mistakes are the map's. */
status import_map_read(const char *map, const char *const file[], int files, import_set *into,
                       mistakes *m, fault *f);

#endif
