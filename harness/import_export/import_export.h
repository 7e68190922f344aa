#ifndef BEAMWORK_IMPORT_EXPORT_H
#define BEAMWORK_IMPORT_EXPORT_H

#include <stdio.h>

#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "harness/study/study.h"

/* Axes of another program relative to beamwork's: a signed permutation. */

typedef struct axes {
    int own_axis[3]; /* indices 0..2 of the axes of beamwork that are x, y, z of the other program
                      */
    int sign[3];     /* 1: same direction, -1: opposite direction */
} axes;

extern const axes axes_same;

/* Reads a text such as "x=x y=-z z=y". Returns 0 if the text is not a signed permutation. */
int axes_parse(const char *text, axes *out);
/* Returns the quantity of the scene that corresponds to quantity `q` of the other program after
 * conversion to the axes of beamwork, and the sign of its values; NULL: none. */
const scene_quantity *axes_quantity(const axes *a, const scene *s, const scene_quantity *q,
                                    int *sign);

typedef struct scene_data_request {
    const scene *scene;
    const write_head *head;
    const char *of; /* name for an import: "case; parameters" */
} scene_data_request;

/* Writes JSON: the scene file that write_scene writes, the required physics, the axes of the
 * members, the constants of the sections, and the meanings of the quantities. All values are in SI
 * units. REFUSED: write_scene, scene_constants or member_arc_of rejects the scene. FAULT: out of
 * memory, or `to` cannot be written. */
status scene_data_write(const scene_data_request *, FILE *to, fault *f);

/* A scene as an input deck of CalculiX 2.20. Members are solids whose end faces are rigid. */

enum { DECK_MOST_ELEMENTS = 400 };

typedef struct deck_request {
    const scene *scene;
    const char *of; /* name for an import: "case; parameters" */
    int elements;   /* number of elements along each member that does not specify a number */
} deck_request;

/* Checks that a deck can express the scene, before anything is written. REFUSED: `elements` is not
 * between 1 and DECK_MOST_ELEMENTS, or a deck cannot express a part of the scene, which the message
 * names. */
status deck_check(const deck_request *, fault *f);
status deck_write(const deck_request *, FILE *to, fault *f);

/* The values of one program, case and parameter point form a series. */

enum { IMPORT_SCENES = 32, IMPORT_ROWS = 200000, IMPORT_TEXT = 512 };

typedef struct import_set {
    sweep sweep;
    int scenes;
    scene_file *scene[IMPORT_SCENES];
    char *scene_path[IMPORT_SCENES];
} import_set;

void import_block_free_set(import_set *);

typedef struct import_header {
    char program[IMPORT_TEXT], of[IMPORT_TEXT], model[IMPORT_TEXT], convention[IMPORT_TEXT],
        version[IMPORT_TEXT];
    int program_line, of_line, model_line, convention_line, version_line;
    axes axes;
} import_header;

/* A series that is being read. */
typedef struct import_block {
    import_set *set;
    const char *path;
    mistakes *m;
    axes axes;
    int at;    /* line of the map that requests the value; 0: line of the value */
    int point; /* index of the point in the sweep; -1: the case or one of its parameters is unknown
                */
    imported *found;
} import_block;

/* Starts a series: checks the case, the parameters and the other entries of the header, and adds
 * errors to m. found is NULL if out of memory. */
import_block import_block_open(import_set *set, const import_header *h, const char *path,
                               mistakes *m);
/* Converts a value from the unit and the axes of the file and adds it to the series. Errors are
 * added to b->m. */
void import_block_add(import_block *b, const imported_row *row);
/* Checks that no value is given twice. If there are no errors, moves the values, if any, to the
 * sweep (import_cells_add); otherwise frees them. */
status import_block_close(import_block *b, fault *f);

/* Imports results of another program from tidy CSV with a header. The results become series of a
 * sweep:
 *
 *   # beamwork-import: 1
 *   # program: MBDyn, 3-node              # name in legends, the same in every version
 *   # version: 1.7.3                      # of the program: stored with the values
 *   # case: sheet_cantilever; warping=0   # case or scene file next to this one; parameters
 *   # model: beam                         # or solid, plate, ...: its error is a model error
 *   # convention: spatial                 # of moments, if a quantity depends on it
 *   # axes: x=x y=y z=z                   # program = beamwork: a signed permutation
 *   quantity, unit, elements, unknowns, seconds, x, value, uncertainty
 *   C_xx, mm/N, 4, 48, 3.3e-3, , 3.9706e-4,
 *
 * Columns may be in any order. quantity, unit, elements and value are required; a curve also needs
 * x [SI]. Header lines after rows start another series; keys that are not repeated remain valid. */

/* Reads a file into `into`. Adds all errors of the file with their lines to m. REFUSED: there are
 * errors. FAULT: the file cannot be read, or out of memory. */
status import_file_read(const char *path, import_set *into, mistakes *m, fault *f);

/* Imports columns without a header. A map in YAML assigns columns and rows to quantities.
 *
 *   beamwork_map: 1
 *   program: MBDyn, 3-node           # as in a CSV header: also version, model, convention
 *   case: sheet_cantilever
 *   elements: 4                      # also unknowns, seconds
 *   columns: {label: 1, x: 2, y: 3}  # names of columns, starting at 1
 *   values:
 *     u_x: {file: .mov, where: {label: 9}, column: x, minus: 0.1, times: 1, unit: m, rows: last}
 *
 * file: ending of the file's name; under: beginning of the last line before the rows of numbers;
 * where: values of columns that select rows; rows: first, last (default), a number starting at 1,
 * or all: a curve over the column `abscissa`. Value = times * (column - minus), in `unit`. */

/* Imports the files as one series. Errors are added to m and refer to lines of the map. REFUSED:
 * there are errors. FAULT: a file cannot be read, or out of memory. */
status import_map_read(const char *map, const char *const file[], int files, import_set *into,
                       mistakes *m, fault *f);

/* Series of a file for which the run has no point. */
typedef struct import_left {
    int series, all; /* number of series without a point, and number of all series in the file */
    char first[256]; /* case/parameters/program of the first series without a point; "" if there is
                      * none */
} import_left;

/* Adds the series of a file of imported values to the points of the run with the same case and
 * parameters. A nonzero flag means that verdicts on these series affect the exit status. FAULT: the
 * file is missing, damaged or not a results file, or out of memory. REFUSED: the file has no
 * imported values, or the run already has them. */
status import_store_read(const char *path, int gates, sweep *s, import_left *left, fault *f);

#endif
