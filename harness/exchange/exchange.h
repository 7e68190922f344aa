/* exchange/: results of other programs, decks for them. */
#ifndef BEAMWORK_EXCHANGE_H
#define BEAMWORK_EXCHANGE_H

#include <stdio.h>

#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "harness/study/study.h"

/* Axes of another program relative to beamwork's: a signed permutation. */

typedef struct axes {
    int ours[3]; /* 0..2: which axis of beamwork is its x, y, z */
    int sign[3]; /* 1 or -1 */
} axes;

extern const axes axes_same;

/* "x=x y=-z z=y"; 0: it is no such permutation. */
int axes_parse(const char *text, axes *out);
/* The quantity of the scene that their quantity `q` is in our axes, and the sign it takes; NULL:
 * the scene has none. */
const scene_quantity *axes_quantity(const axes *a, const scene *s, const scene_quantity *q,
                                    int *sign);

/* A scene as an input deck of CalculiX 2.20: members as solids, ends as rigid faces. */

enum { DECK_MOST_ELEMENTS = 400 }; /* along a member */

typedef struct deck_request {
    const scene *scene; /* valid */
    const char *of;     /* for an import: "case; parameters" */
    int elements;       /* along each member that does not say its own */
} deck_request;

/* REFUSED: what the deck cannot carry, before anything is written. */
status deck_check(const deck_request *, fault *f);
status deck_write(const deck_request *, FILE *to, fault *f);

/* Import: series of values, each of a program, a case and a parameter point. */

enum { IMPORT_SCENES = 32, IMPORT_ROWS = 200000, IMPORT_TEXT = 512 };

/* Points and series of all files, and the scene files that they name. */
typedef struct import_set {
    sweep sweep;
    int scenes;
    scene_file *scene[IMPORT_SCENES];
    char *scene_path[IMPORT_SCENES];
} import_set;

void import_block_free_set(import_set *);

/* A header as it was said, with the lines it was said at; 0: not said. */
typedef struct import_header {
    char program[IMPORT_TEXT], of[IMPORT_TEXT], model[IMPORT_TEXT], convention[IMPORT_TEXT],
        version[IMPORT_TEXT];
    int program_line, of_line, model_line, convention_line, version_line;
    axes axes;
} import_header;

/* One series while it is read. */
typedef struct import_block {
    import_set *set;
    const char *path; /* of the file */
    mistakes *m;
    axes axes;
    int at;    /* line of m's file that asks for the value; 0: it is the value's own file */
    int point; /* index in the sweep; -1: its case is not known */
    imported *found;
} import_block;

/* Opens a series: case, parameters and words of the header are checked. found NULL: out of memory.
 */
import_block import_block_open(import_set *set, const import_header *h, const char *path,
                               mistakes *m);
/* One value as the file specifies it. */
void import_block_add(import_block *b, const imported_row *row);
/* Sorts the values into cells and adds the series to the sweep, unless there are mistakes. */
status import_block_close(import_block *b, fault *f);

/* Results of another program as tidy CSV with a declared header, into a sweep as one more
 * compared program:
 *
 *   # beamwork-import: 1
 *   # program: MBDyn, 3-node              # name in legends, the same in every version
 *   # version: 1.7.3                      # of the program: stored with the values
 *   # case: sheet_cantilever; warping=0   # case or scene file next to this one; parameters
 *   # model: beam                         # or solid, plate, ...: then its error is of the model
 *   # convention: spatial                 # of moments, where a quantity depends on it
 *   # axes: x=x y=y z=z                   # program = beamwork: a signed permutation
 *   quantity, unit, elements, unknowns, seconds, x, value, uncertainty
 *   C_xx, mm/N, 4, 48, 3.3e-3, , 3.9706e-4,
 *
 * Columns stand in any order; quantity, unit, elements and value are needed, x [SI] for a curve.
 * Header lines after rows begin another series; keys that are not repeated remain valid. */

/* All mistakes of the file go to m, by line; what it says to `into`. FAULT: it cannot be read. */
status import_file_read(const char *path, import_set *into, mistakes *m, fault *f);

/* Columns without a header, by a map in YAML: which column of which rows is which quantity.
 *
 *   beamwork_map: 1
 *   program: MBDyn, 3-node                 # as in the header of a CSV: version, case, model,
 * convention case: sheet_cantilever elements: 4                            # unknowns, seconds
 *   columns: {label: 1, x: 2, y: 3}        # names of columns, counted from 1
 *   values:
 *     u_x: {file: .mov, where: {label: 9}, column: x, minus: 0.1, times: 1, unit: m, rows: last}
 *
 * file: how the file's name ends; under: how the last line begins that is no row of numbers; where:
 * columns with these numbers; rows: first, last, or a number counted from 1 (default last), or all:
 * a curve over `abscissa`, a column too. Value = times * (column - minus), in `unit`. */

/* The files together are one series. Mistakes are the map's. */
status import_map_read(const char *map, const char *const file[], int files, import_set *into,
                       mistakes *m, fault *f);

/* Imported values that `beamwork import` stored, read back as compared programs of a run. */

/* Series of a file for which the run has no point. */
typedef struct import_left {
    int series, all; /* those left, and all that the file has */
    char first[256]; /* case/parameters/program of the first; empty: none */
} import_left;

/* Adds a series for every program at points that have series. A nonzero flag lets their verdicts
 * affect the exit status. FAULT: missing, damaged, foreign; REFUSED: it has no imported values, or
 * they are in the run already. */
status import_store_read(const char *path, int gates, sweep *s, import_left *left, fault *f);

#endif
