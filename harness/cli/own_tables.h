/* Tables of one's own project that a command line names: truths and findings. */
#ifndef BEAMWORK_OWN_TABLES_H
#define BEAMWORK_OWN_TABLES_H

#include "harness/cli/command.h"
#include "harness/study/truths.h"

/* Adds the truths of --truths FILE.csv, of one case where only is not NULL. run: the cases of the
 * run, NULL behind the last. REFUSED: the first mistake, as file:line:column, and how many there
 * are. */
status own_tables_truths(const command_request *, const case_type *const run[],
                         const case_type *only, truths *t, fault *f);
/* Adds the rules of --findings FILE.csv; where there is such a file, new formulations gate. */
status own_tables_findings(const command_request *, const case_type *const run[], truths *t,
                           fault *f);
/* No output of the command line replaces one of them. */
status own_tables_check(const command_request *, fault *f);

#endif
