/* A load that is no number for a moment ends a motion where it is so: no step is one whose state is
 * none. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/tools/kit/scenes.h"

#define FINITE_SWUNG "harness/time/test/swung.yaml"

/* Steps of 1/512 s end inside. */
static void stop(int scheme)
{
    cell_result r;
    fault f = {""};
    cell_request request = cells_of(scenes_case(FINITE_SWUNG), "collocation", 1);
    scenes_at(request.type, request.parameter, "load=gap;integrator=%s;step=%.17g",
              scenes_integrator[scheme], 1 / 512.0);
    const status outcome = cell_run(&request, &r, &f);
    gsl_test(outcome != STATUS_NOT_CONVERGED, "scheme %d: status %d", scheme, outcome);
    gsl_test(r.solve.motions < 100, "scheme %d: %d records", scheme, r.solve.motions);
    for (int i = 0; i < r.solve.motions; i++) {
        const outcome_step *one = &r.solve.motion[i].at;
        gsl_test(!(one->time <= 0.509), "scheme %d: there is a state at %g s", scheme, one->time);
        for (int k = 0; k < SCENE_BALANCES; k++)
            gsl_test(!isfinite(one->balance[k]), "scheme %d: at %g s balance %d is %g", scheme,
                     one->time, k, one->balance[k]);
    }
    cell_result_free(&r);
}

int main(void)
{
    stop(SCENE_ALPHA);
    stop(SCENE_CONSERVING);
    stop(SCENE_RADAU);
    stop(SCENE_EXPLICIT);
    return gsl_test_summary();
}
