/* Members that are stiff in elongation cost no iterations, whatever the formulation: a swing of the
 * pendulum with EA times 1, 1e3 and 1e6, in long steps, of which none is halved. */
#include "harness/analysis/analysis.h"
#include <math.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/time/test/moving.h"

extern const case_type case_pendulum;
extern const element_type element_collocation;

enum { ELEMENTS = 4 };

typedef struct swing {
    double iterations; /* of a step; NAN: the formulation is not for it */
    long steps;
} swing;

/* Steps of equal length. */
static swing take(const formulation *with, scene_scheme by, double stiffening, double step,
                  int steps, int elements)
{
    char parameters[64];
    solve_options options;
    solve_result result;
    scene s;
    model *m;
    swing out = {NAN, 0};
    fault f = {""};
    snprintf(parameters, sizeof parameters, "stiffening=%g", stiffening);
    moving_case(&case_pendulum, parameters, &s);
    moving_add(&s, by, step, steps * step);
    memset(&options, 0, sizeof options);
    memset(&result, 0, sizeof result);
    const model_request wanted = {
        .scene = &s, .type = with->type, .options = with->option, .elements = elements};
    if (model_alloc(&wanted, &m, &f) == STATUS_OK) {
        const status outcome = solve_scene(&s, m, &options, &result, &f);
        gsl_test(outcome != STATUS_OK, "%s, EA x %g: %s", with->type->name, stiffening, f.text);
        out.steps = result.counters.steps;
        out.iterations = (double)result.counters.iterations / (double)out.steps;
    }
    model_free(m);
    result_free(&result);
    scene_free(&s);
    return out;
}

static void compare(const element_type *type, scene_scheme by, double step, double more,
                    double times)
{
    formulation with;
    formulation_default(type, &with);
    const swing soft = take(&with, by, 1, step, MOVING_STATIONS, ELEMENTS);
    for (double stiffening = 1e3; isfinite(soft.iterations) && stiffening < 1e7;
         stiffening *= 1e3) {
        const swing stiff = take(&with, by, stiffening, step, MOVING_STATIONS, ELEMENTS);
        gsl_test(stiff.steps != soft.steps, "%s, EA x %g: %ld steps, soft %ld", type->name,
                 stiffening, stiff.steps, soft.steps);
        gsl_test(!(stiff.iterations < times * soft.iterations + more),
                 "%s, EA x %g: %.2f iterations a step, soft %.2f", type->name, stiffening,
                 stiff.iterations, soft.iterations);
    }
}

/* One element, whose forces have no more digits than eps EA leaves, while its moments do. */
static void one_element(void)
{
    const int steps = 60;
    formulation with;
    formulation_default(&element_collocation, &with);
    const swing stiff = take(&with, SCENE_CONSERVING, 1e6, 0.002, steps, 1);
    gsl_test(stiff.steps != steps, "one element, EA x 1e6: %ld steps", stiff.steps);
    gsl_test(!(stiff.iterations < 8), "one element, EA x 1e6: %g iterations a step",
             stiff.iterations);
}

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        compare(registry_formulations[i], SCENE_ALPHA, 0.005, 1, 1);
        compare(registry_formulations[i], SCENE_RADAU, 0.02, 1, 1);
        compare(registry_formulations[i], SCENE_CONSERVING, 0.005, 0, 1.5);
    }
    one_element();
    return gsl_test_summary();
}
