/* What there is, as JSON: `beamwork list --format json`, and the same of the library. */
#ifndef BEAMWORK_LIST_JSON_H
#define BEAMWORK_LIST_JSON_H

#include <stdio.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

/* Of all cases, and of all formulations with the physics that they can offer: 1: wanted. */
status list_json_all(FILE *to, int cases, int formulations, fault *f);
/* Of a case at values of its parameters: these, its quantities there, and who runs it. */
status list_json_case(FILE *to, const case_type *type, const double value[], fault *f);
/* Of a formulation: what it declares, its options, the rules of the ledger that speak of it (rules
 * NULL: null), and the cases it runs on. */
status list_json_formulation(FILE *to, const formulation *chosen, const rule *rules, int count,
                             fault *f);

#endif
