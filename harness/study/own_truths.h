/* Truths of one's own project beside the packed ones, with the columns of reference/tables. */
#ifndef BEAMWORK_OWN_TRUTHS_H
#define BEAMWORK_OWN_TRUTHS_H

#include "cases/format/mistakes.h"
#include "harness/study/truths.h"

/* Adds the rows of a file to those of t; run: the cases of the run, NULL behind the last. only: of
 * this case alone, the others are passed over; NULL: of all. What is wrong with the file goes to
 * `m`, and those rows are left out. FAULT: it cannot be read. */
status own_truths_read(const char *path, const case_type *const run[], const case_type *only,
                       truths *t, mistakes *m, fault *f);

#endif
