/* Findings of one's own project: rules beside the ledger, with its columns. */
#ifndef BEAMWORK_OWN_FINDINGS_H
#define BEAMWORK_OWN_FINDINGS_H

#include "cases/format/mistakes.h"
#include "harness/study/truths.h"

/* Adds the rules of a file to those of t; run: the cases of the run, NULL behind the last. What is
 * wrong with the file goes to `m`, and those rows are left out. FAULT: it cannot be read. */
status own_findings_read(const char *path, const case_type *const run[], truths *t, mistakes *m,
                         fault *f);

#endif
