/* What an analysis hands over of eigenvalues: all of it, and why there are no more. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/solver/outcome.h"

static void handed_over(status outcome, int rounding, const char *reason, const char *said)
{
    double *mu = malloc(sizeof *mu), *mode = malloc(sizeof *mode), *error = malloc(sizeof *error);
    eigen_side from = {.count = 1,
                       .mu = mu,
                       .mode = mode,
                       .error = error,
                       .status = outcome,
                       .rounding = rounding};
    analysis_outcome o = {.kind = SCENE_BUCKLING};
    outcome_side *side = &o.of.spectrum.positive;
    snprintf(from.reason, sizeof from.reason, "%s", reason);
    outcome_take(&from, side);
    gsl_test(side->count != 1 || side->value != mu || side->mode != mode || side->error != error ||
                 side->status != outcome,
             "'%s': what was found", reason);
    gsl_test(from.mu != NULL || from.mode != NULL || from.error != NULL,
             "'%s': it is not freed twice", reason);
    gsl_test(said == NULL ? side->reason[0] != '\0' : strstr(side->reason, said) == NULL,
             "'%s', %d lost: says '%s'", reason, rounding, side->reason);
    outcome_free(&o);
}

int main(void)
{
    handed_over(STATUS_OK, 0, "", NULL);
    handed_over(STATUS_OK, 1, "", "round-off");
    handed_over(STATUS_OK, 3, "", "round-off");
    handed_over(STATUS_NOT_CONVERGED, 0, "2 are missing", "2 are missing");
    handed_over(STATUS_NOT_CONVERGED, 1, "2 are missing", "2 are missing");
    return gsl_test_summary();
}
