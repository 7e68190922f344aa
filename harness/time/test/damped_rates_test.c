/* Rates of strains of a beam that has turned far: those that its strains have in time, also as
 * generalized-alpha carries them along; and what a step loses is their power. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/model/model.h"
#include "harness/time/test/flying.h"
#include "harness/tools/kit/scenes.h"

#define RATES_SWUNG "harness/time/test/swung.yaml"

static double *strains_in(flying *f, double h)
{
    const size_t n = (size_t)(model_elements(f->m) * model_strains(f->m));
    double *out = malloc(n * sizeof *out);
    gsl_test(flying_try(f, h) != STATUS_OK, "a step of %g s: %s", h, f->why.text);
    memcpy(out, kinematics_strains(f->next.state), n * sizeof *out);
    return out;
}

/* The largest difference of a and b by the largest of b. */
static double apart(int n, const double a[], const double b[])
{
    double most = 0, size = 0;
    for (int i = 0; i < n; i++) {
        most = fmax(most, fabs(a[i] - b[i]));
        size = fmax(size, fabs(b[i]));
    }
    return most / size;
}

int main(void)
{
    const double d = 1e-3, h = 0.002;
    scene s;
    flying f;
    scenes_read(&s, RATES_SWUNG, "damping=0.02;rho=0.5;step=0.01");
    gsl_test(flying_begin(&s, formulation_find("collocation"), 2, &f) != STATUS_OK, "begins: %s",
             f.why.text);
    for (int i = 0; i < 300; i++)
        gsl_test(flying_step(&f, h) != STATUS_OK, "step %d: %s", i, f.why.text);
    const int n = model_elements(f.m) * model_strains(f.m);
    double *rate = calloc((size_t)n, sizeof *rate), *later = strains_in(&f, d),
           *before = strains_in(&f, -d);
    damping_rates(f.m, f.now.state, f.now.v, rate, &f.why);
    for (int i = 0; i < n; i++)
        later[i] = (later[i] - before[i]) / (2 * d);
    const double wrong = apart(n, rate, later), followed = apart(n, f.now.strain, later);
    gsl_test(!(wrong < 1e-4), "rates of strains by differences: %g apart", wrong);
    gsl_test(!(followed < 1e-4), "carried along: %g apart", followed);
    const double lost = f.now.dissipated, power = damping_power(&f.c.eq, rate);
    flying_step(&f, d);
    damping_rates(f.m, f.now.state, f.now.v, rate, &f.why);
    const double mean = (power + damping_power(&f.c.eq, rate)) / 2;
    gsl_test(!(fabs((f.now.dissipated - lost) / (d * mean) - 1) < 1e-3),
             "a step loses %g J, its power is %g W", f.now.dissipated - lost, mean);
    free(rate);
    free(later);
    free(before);
    flying_end(&f);
    scene_free(&s);
    return gsl_test_summary();
}
