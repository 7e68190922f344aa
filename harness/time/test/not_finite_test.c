/* A load that is no number for a moment ends a motion where it is so: no step is one whose state is
 * none. */
#include <math.h>

#include "harness/time/test/swung.h"

enum { INTEGRATOR, STEP, PARAMETERS };

/* No number from 0.507 to 0.509 s, between the instants at which a scene is looked at. */
static status build(const double value[], scene *s, fault *f)
{
    static const double end[] = {1};
    (void)f;
    const swung of = swung_build(s);
    const int push = scene_add_load(s, SCENE_FORCE, of.base, 0, 0, 1);
    scene_load_piece(s, push, 0, "sqrt((t - 0.508)^2 - 1e-6)");
    const scene_motion how = swung_motion((scene_scheme)value[INTEGRATOR], value[STEP]);
    const int motion = scene_add_motion(s, SCENE_NONE, 1, end, how);
    scene_add_quantity(s, "x", "m", motion, scene_coordinate(of.tip, SCENE_UX));
    return STATUS_OK;
}

static const parameter_type table[] = {
    [INTEGRATOR] = {"integrator", "1", 0, 0, 3, TIMED_INTEGRATORS, "scheme"},
    [STEP] = {"step", "s", 0.1, 1e-6, 1, NULL, "of it"},
    {0}};
static const case_type gap = {.name = "gap", .parameters = {table}, .build = build};

/* Steps of 1/512 s end inside. */
static void stop(int scheme)
{
    cell_result r;
    fault f = {""};
    const status outcome = swung_try(&gap, (const double[]){scheme, 1 / 512.0}, PARAMETERS, &r, &f);
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
