/* results.h5: everything a sweep found, for the reports. Layout: harness/README.md. */
#ifndef BEAMWORK_STORE_H
#define BEAMWORK_STORE_H

#include "harness/catalogue/environment.h"
#include "harness/judge/verdict.h"
#include "harness/record/record.h"

enum { STORE_VERSION = 1 };

/* One row of a mesh's quantities. */
typedef struct store_row {
    char name[SCENE_NAME], unit[16], moments[16], status[16], reason[128];
    double value, error, model_error, x, near_zero,
        prediction; /* near_zero: [unit] a value below it counts as zero; prediction: or NAN */
} store_row;
hid_t store_row_type(void); /* in memory and in the file */

/* Group n<elements> below `at`; of[quantities]: the verdict on each, NULL where there is none. */
void store_cell(record *r, hid_t at, const point *p, int elements, const cell_result *cell, const verdict *const of[]);
/* Group `shapes` below `at`: centre lines, sections, bodies. */
void store_shapes(record *r, hid_t at, const scene *sc, const shapes *s);
/* Written beside and renamed: FAULT leaves nothing behind. */
status store_write(const char *path, const sweep *s, const judgement *j, const environment *e, fault *f);
/* The first cell of a sweep in the same tree, without verdicts, and its shapes for VTK too. */
status store_write_solution(const char *path, const sweep *s, const environment *e, fault *f);

#endif
