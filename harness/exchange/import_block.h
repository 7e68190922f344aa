/* What is being imported: series of values, each of a program, a case and a parameter point. */
#ifndef BEAMWORK_IMPORT_BLOCK_H
#define BEAMWORK_IMPORT_BLOCK_H

#include "cases/format/mistakes.h"
#include "cases/format/scene_file.h"
#include "harness/exchange/axes.h"
#include "harness/study/study.h"

enum { IMPORT_SCENES = 32, IMPORT_ROWS = 200000, IMPORT_TEXT = 512 };

/* Points and series of all files, and the scene files that they speak of. */
typedef struct import_set {
    sweep sweep;
    int scenes;
    scene_file *scene[IMPORT_SCENES];
    char *scene_path[IMPORT_SCENES];
} import_set;

void import_block_free_set(import_set *);

/* A header as it was said, with the lines it was said at; 0: not said. */
typedef struct import_header {
    char program[IMPORT_TEXT], of[IMPORT_TEXT], model[IMPORT_TEXT], convention[IMPORT_TEXT];
    int program_line, of_line, model_line, convention_line;
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
/* One value as the file says it. */
void import_block_add(import_block *b, const imported_row *row);
/* Sorts the values into cells and adds the series to the sweep, unless there are mistakes. */
status import_block_close(import_block *b, fault *f);

#endif
