/* results.h5: everything a sweep found, for the reports. Below /cases/CASE a table for each kind of
 * record (schema.h), the points of curves and the shapes in arrays beside; `beamwork schema`
 * describes them. */
#ifndef BEAMWORK_STORE_H
#define BEAMWORK_STORE_H

#include "harness/formulations/formulations.h"
#include "harness/records/record.h"
#include "harness/study/study.h"

/* A file that is filled case by case, while others are still run. */
typedef struct store {
    record_file file;
    hid_t root, cases;
    const char *experiment; /* whose group is filled; NULL: the root */
    const sweep *sweep;
    const judgement *judged;
} store;

/* All live as long as the file is open. */
status store_open(const char *experiment, const sweep *s, const judgement *j, store *out, fault *f);
/* A case, all of whose series have been judged. */
void store_case(store *, const case_type *);
/* With the cases that are not there yet, and what is said of the run. Written beside and renamed:
 * FAULT leaves nothing behind. path NULL: nothing is written. */
status store_close(store *, const char *path, const environment *e, fault *f);

/* Written beside and renamed: FAULT leaves nothing behind. */
status store_write(const char *path, const char *experiment, const sweep *s, const judgement *j,
                   const environment *e, fault *f);
/* The first cell of a sweep in the same way, without verdicts, and its shapes for VTK too. */
status store_write_solution(const char *path, const sweep *s, const environment *e, fault *f);

/* The attributes by which a group says of which program, commit and time it is. */
void store_environment(record_file *r, hid_t at, const environment *e);

#endif
