/* What a formulation is, offers and lacks, and where it is known to fail. */
#ifndef BEAMWORK_LIST_FORMULATION_H
#define BEAMWORK_LIST_FORMULATION_H

#include "harness/formulations/formulation.h"
#include "harness/study/rules.h"

/* rules NULL: the ledger is not known. */
void list_formulation(const formulation *chosen, const rule *rules, int count);
/* A line "  NAME=CHOICES, default VALUE: what". */
void list_formulation_option(const parameter_type *o);

#endif
