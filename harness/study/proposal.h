/* Rules that a new formulation would need in the ledger (reference/findings.csv). */
#ifndef BEAMWORK_PROPOSAL_H
#define BEAMWORK_PROPOSAL_H

#include <stdio.h>

#include "harness/study/judgement.h"

/* What stands as its cause until somebody has found it. */
#define PROPOSAL_CAUSE "to be found: why is this not a pass?"

/* CSV with the columns of the ledger, header included: one rule for each formulation, case and
 * verdict, with all its quantities, the largest error seen (a third added), and a cause that is
 * still to be found. Returns the number of rules. */
int proposal_write(FILE *to, const sweep *s, const judgement *j);

#endif
