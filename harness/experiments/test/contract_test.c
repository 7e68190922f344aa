/* Every formulation keeps every claim that it makes; and it makes enough of them. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <string.h>

#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"

static void tell(const char *key, const checks_family *family, const claims *c)
{
    for (int i = 0; i < c->count; i++)
        gsl_test(c->claim[i].outcome == CLAIM_BROKEN, "%s, %s: %s (%.1e, allowed %.1e) %s", key,
                 family->name, c->claim[i].name, c->claim[i].worst, c->claim[i].allowed,
                 c->claim[i].sentence);
    gsl_test(c->count == 0, "%s, %s: %d comparisons", key, family->name, claims_compared(c));
}

int main(void)
{
    int compared = 0, by_matrices = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        formulation chosen;
        formulation_default(registry_formulations[i], &chosen);
        by_matrices += (chosen.type->offers & FEATURE_COUPLED) != 0;
        for (int k = 0; k < CHECKS_FAMILIES; k++) {
            static claims c;
            memset(&c, 0, sizeof c);
            checks_families[k].run(&chosen, &c);
            tell(chosen.key, &checks_families[k], &c);
            compared += claims_compared(&c);
        }
    }
    gsl_test(compared < 100000, "%d comparisons", compared);
    gsl_test(by_matrices < 1, "%d formulations carry sections by their matrices", by_matrices);
    return gsl_test_summary();
}
