/* Injects faults into correct formulations. */
#ifndef BEAMWORK_TEST_PLANTED_H
#define BEAMWORK_TEST_PLANTED_H

#include <gsl/gsl_test.h>
#include <string.h>

#include "harness/experiments/experiments.h"

static const element_type *base;

/* Checks a type with a fault, which the family of checks `family` must detect. The message must
 * contain `first` and `second`. */
static inline void planted(const char *family, const element_type *fault_type, const char *first,
                           const char *second)
{
    static check_results c;
    formulation chosen;
    int noticed = 0;
    formulation_default(base, &chosen);
    chosen.type = fault_type;
    for (int k = 0; k < CHECKS_FAMILIES; k++) {
        if (strcmp(checks_families[k].name, family) != 0)
            continue;
        memset(&c, 0, sizeof c);
        checks_families[k].run(&chosen, &c);
        for (int i = 0; i < c.count; i++)
            noticed += c.check_result[i].outcome == CHECK_FAILED &&
                       strstr(c.check_result[i].sentence, first) != NULL &&
                       strstr(c.check_result[i].sentence, second) != NULL;
    }
    gsl_test(noticed == 0, "%s notices: %s ... %s", family, first, second);
    for (int i = 0; i < c.count && noticed == 0; i++)
        gsl_test(c.check_result[i].outcome == CHECK_FAILED, "it said: %s",
                 c.check_result[i].sentence);
}

static inline element_type changed(const char *name)
{
    formulation chosen;
    gsl_test(formulation_parse(name, &chosen, NULL) != STATUS_OK, "%s", name);
    base = chosen.type;
    element_type out = *base;
    out.options[0] = NULL;
    return out;
}

#define PLANT(member, value, family, first, second)                                                \
    do {                                                                                           \
        element_type t = changed("beamw_consistent");                                              \
        t.member = value;                                                                          \
        planted(family, &t, first, second);                                                        \
    } while (0)

#endif
