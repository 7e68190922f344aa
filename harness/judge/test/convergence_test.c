/* Made-up sequences with a known limit and order: what is found, how well its uncertainty covers the error, noise, floors, and meshes that are too coarse. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/judge/convergence.h"

enum { MESHES = 6 };
static const int doubled[MESHES] = {2, 4, 8, 16, 32, 64}, uneven[MESHES] = {3, 4, 7, 9, 20, 31};

/* A number in -1 .. 1 that looks random. */
static double noise(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / (1 << 23) - 1;
}

/* limit + c n^-p + d n^-q */
static void sequence(const int n[MESHES], double limit, double c, double p, double d, double q, double v[MESHES])
{
    for (int i = 0; i < MESHES; i++)
        v[i] = limit + c * pow(n[i], -p) + d * pow(n[i], -q);
}

static void pure_orders(void)
{
    static const int *const mesh[] = {doubled, uneven};
    double v[MESHES];
    for (int m = 0; m < 2; m++)
        for (double p = 0.5; p <= 4; p += 0.5) {
            sequence(mesh[m], 2.385, -0.7, p, 0, 0, v);
            const convergence c = convergence_of(MESHES, mesh[m], v, 2.385);
            gsl_test_int((int)c.kind, CONVERGENCE_ORDERLY, "order %g: orderly", p);
            gsl_test_rel(c.order, p, 1e-6, "order %g is found", p);
            gsl_test_rel(c.limit, 2.385, 1e-11, "order %g: so is the limit", p);
            gsl_test_int(c.from, mesh[m][0], "order %g: every mesh shows it", p);
        }
}

/* Two terms: the last three meshes show the leading one, and the uncertainties cover what they miss. */
static void approach(void)
{
    double v[MESHES];
    sequence(doubled, 1, 0.3, 2, 40, 4, v);
    convergence c = convergence_of(MESHES, doubled, v, 1);
    gsl_test_int((int)c.kind, CONVERGENCE_ORDERLY, "a second term: orderly");
    gsl_test(!(fabs(c.order - 2) <= 1.5 * c.order_uncertainty), "order %g +- %g covers 2", c.order, c.order_uncertainty);
    gsl_test(!(fabs(c.limit - 1) <= 1.5 * c.limit_uncertainty), "limit 1 %+g +- %g", c.limit - 1, c.limit_uncertainty);
    gsl_test(!(c.from >= 8 && c.from <= 16), "the coarse meshes are not in the asymptotic range: it begins at %d", c.from);
    sequence(doubled, 1, 0.3, 2, 40, 4, v);
    c = convergence_of(3, doubled, v, 1);
    gsl_test(c.from > 2 || isfinite(c.order_uncertainty), "three meshes show no uncertainty of their order");
    c = convergence_of(2, doubled, v, 1);
    gsl_test_int((int)c.kind, CONVERGENCE_NONE, "two meshes show no limit");
    gsl_test_int(c.from, 0, "nor a range");
}

/* Noise of any size: a limit, where one is claimed, is as good as its uncertainty says; where noise rules, no order is claimed. */
static void noisy(void)
{
    unsigned seed = 20261;
    int outside = 0, all = 0, claimed = 0, drowned = 0;
    for (double size = 1e-14; size < 1; size *= 10)
        for (int repeat = 0; repeat < 200; repeat++) {
            double v[MESHES];
            sequence(doubled, 3, 0.5, repeat % 2 == 0 ? 2 : 4, 0, 0, v);
            for (int i = 0; i < MESHES; i++)
                v[i] += 3 * size * noise(&seed);
            const convergence c = convergence_of(MESHES, doubled, v, 3);
            all++;
            outside += !(fabs(c.limit - 3) <= 3 * c.limit_uncertainty + 6 * size);
            drowned += size > 0.2;
            claimed += size > 0.2 && c.kind == CONVERGENCE_ORDERLY && c.order_uncertainty < 0.3;
        }
    gsl_test(outside > all / 100, "%d of %d noisy limits are further off than three uncertainties", outside, all);
    gsl_test(claimed > drowned / 20, "%d of %d sequences of nothing but noise show a settled order", claimed, drowned);
}

static void floors(void)
{
    double v[MESHES];
    unsigned seed = 7;
    sequence(doubled, 3, 40, 8, 0, 0, v); /* the last meshes agree to 1e-13 */
    for (int i = 0; i < MESHES; i++)
        v[i] += 3e-14 * noise(&seed);
    convergence c = convergence_of(MESHES, doubled, v, 3);
    gsl_test_int((int)c.kind, CONVERGENCE_FLOOR, "the round-off floor is recognised");
    gsl_test_rel(c.order, 8, 0.02, "the order is taken from meshes above it");
    gsl_test_rel(c.limit, 3, 1e-12, "the limit is the last value");
    gsl_test_int(c.from, 2, "with its range");
    for (int i = 0; i < MESHES; i++)
        v[i] = 3 + 3e-13 * noise(&seed);
    c = convergence_of(MESHES, doubled, v, 3);
    gsl_test_int((int)c.kind, CONVERGENCE_FLOOR, "nothing but round-off");
    gsl_test(isfinite(c.order), "has no order (%g)", c.order);
    for (int i = 0; i < MESHES; i++)
        v[i] = 1e-14 * noise(&seed); /* a value that is zero, of a quantity of size 3 */
    c = convergence_of(MESHES, doubled, v, 3);
    gsl_test_int((int)c.kind, CONVERGENCE_FLOOR, "a zero among numbers of size 3");
}

static void disorder(void)
{
    double v[MESHES];
    for (int i = 0; i < MESHES; i++)
        v[i] = 3 + (i % 2 ? 0.1 : -0.1) / doubled[i];
    convergence c = convergence_of(MESHES, doubled, v, 3);
    gsl_test_int((int)c.kind, CONVERGENCE_NONE, "values that alternate");
    gsl_test_rel(c.limit_uncertainty, fabs(v[5] - v[4]), 1e-12, "are known to their last difference");
    for (int i = 0; i < MESHES; i++)
        v[i] = pow(doubled[i], 0.5);
    c = convergence_of(MESHES, doubled, v, 3);
    gsl_test_int((int)c.kind, CONVERGENCE_NONE, "values that grow");
    for (int i = 0; i < MESHES; i++)
        v[i] = 3 + log(doubled[i]);
    c = convergence_of(MESHES, doubled, v, 3);
    gsl_test_int((int)c.kind, CONVERGENCE_NONE, "differences that do not shrink");
}

int main(void)
{
    pure_orders();
    approach();
    noisy();
    floors();
    disorder();
    return gsl_test_summary();
}
