/* Measures how often the known limit of a sequence is within the computed uncertainty, for families
 * of random sequences with and without scatter. The seeds are fixed. */
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/study/study.h"

enum { FEWEST = 4, MOST = 7, DRAWS = 500, GRIDS = 5 };

static const double value = 3;

static const int grid[GRIDS][MOST] = {{1, 2, 4, 8, 16, 32, 64},
                                      {2, 4, 8, 16, 32, 64, 128},
                                      {5, 10, 20, 40, 80, 160, 320},
                                      {1, 2, 3, 4, 8, 16, 32},
                                      {2, 4, 8, 16, 30, 32, 64}};

typedef struct draw {
    double order, order_2, order_3;
    double ratio, ratio_3; /* signed ratios of the second and third terms to the first term on the
                              coarsest mesh */
    double bend;           /* number of elements at which the behaviour changes */
    double phase;
    int first, last; /* first and last number of elements */
} draw;

static double between(gsl_rng *r, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(r);
}

static double between_log(gsl_rng *r, double low, double high)
{
    return exp(between(r, log(low), log(high)));
}

static double sign(gsl_rng *r)
{
    return gsl_rng_uniform(r) < 0.5 ? -1 : 1;
}

/* Returns the error on mesh i with n elements, relative to the error on the first mesh. */
static double power(const draw *d, int i, double n)
{
    (void)i;
    return pow(n / d->first, -d->order);
}

static double terms(const draw *d, int i, double n)
{
    const double x = n / d->first;
    return power(d, i, n) + d->ratio * pow(x, -d->order_2) + d->ratio_3 * pow(x, -d->order_3);
}

static double logarithm(const draw *d, int i, double n)
{
    return power(d, i, n) * log(2 * n);
}

static double exponential(const draw *d, int i, double n)
{
    (void)i;
    return exp(-n / d->bend);
}

static double alternating(const draw *d, int i, double n)
{
    return power(d, i, n) * (1 + d->ratio * (i % 2 == 0 ? 1 : -1));
}

static double sine(const draw *d, int i, double n)
{
    return power(d, i, n) * (1 + d->ratio * sin(d->phase + n));
}

/* The error is constant until the mesh resolves a length of 1/bend. */
static double plateau(const draw *d, int i, double n)
{
    (void)i;
    return 1 / (1 + pow(n / d->bend, d->order));
}

/* The order rises from zero on coarse meshes to two on meshes that resolve a length of 1/bend, more
 * gradually than for `plateau`. */
static double layer(const draw *d, int i, double n)
{
    (void)i;
    const double x = d->bend / n;
    return 1 - tanh(x) / x;
}

typedef double error_function(const draw *, int i, double n);

typedef enum mixture {
    ONE_TERM,
    SAME_SIGN,
    OPPOSITE,
    CANCELLING,
    THREE_TERMS,
    WEAK_LEAD,
    WAVE,
    COARSE_BEND,
    FINE_BEND,
    SLOW
} mixture;

typedef struct coverage_family {
    const char *name;
    error_function *error;
    mixture mixture;
    double order;   /* 0: an order that is randomly 1, 1.5, 2, 3 or 4 */
    double covered; /* smallest fraction of the limits that must be within their uncertainty */
} coverage_family;

static const coverage_family families[] = {
    {"n^-1", power, ONE_TERM, 1, 0.98},
    {"n^-1.5", power, ONE_TERM, 1.5, 0.98},
    {"n^-2", power, ONE_TERM, 2, 0.98},
    {"n^-3", power, ONE_TERM, 3, 0.98},
    {"n^-4", power, ONE_TERM, 4, 0.98},
    {"n^-6", power, ONE_TERM, 6, 0.98},
    {"n^-10", power, ONE_TERM, 10, 0.98},
    {"two terms of one sign", terms, SAME_SIGN, 0, 0.98},
    {"two terms of opposite signs", terms, OPPOSITE, 0, 0.98},
    {"two terms of one sign, first order", terms, SAME_SIGN, 1, 0.98},
    {"two terms of opposite signs, second order", terms, OPPOSITE, 2, 0.98},
    {"two terms that cancel on some mesh", terms, CANCELLING, 0, 0.98},
    {"three terms", terms, THREE_TERMS, 0, 0.97},
    {"a weak leading term", terms, WEAK_LEAD, 0, 0.98},
    {"n^-2 log n", logarithm, ONE_TERM, 2, 0.98},
    {"exponential", exponential, SLOW, 1, 0.98},
    {"alternating", alternating, WAVE, 0, 0.90},
    {"sine", sine, WAVE, 0, 0.90},
    {"a plateau on coarse meshes", plateau, COARSE_BEND, 2, 0.98},
    {"a plateau on most meshes", plateau, FINE_BEND, 2, 0.98},
    {"a layer that fine meshes resolve", layer, COARSE_BEND, 2, 0.98},
    {"a layer that hardly one resolves", layer, FINE_BEND, 2, 0.98},
};

static draw draw_from(gsl_rng *r, const coverage_family *f, const int n[], int meshes)
{
    static const double orders[] = {1, 1.5, 2, 3, 4};
    draw d = {.first = n[0], .last = n[meshes - 1], .phase = between(r, 0, 6.28)};
    d.order = f->order > 0 ? f->order : orders[gsl_rng_uniform_int(r, 5)];
    d.order_2 = d.order + 1 + (double)gsl_rng_uniform_int(r, 2);
    d.order_3 = d.order_2 + 1;
    const double size = between_log(r, 0.1, 10), weak = between_log(r, 10, 100), finest = d.last;
    const double crossing = pow((double)n[gsl_rng_uniform_int(r, (unsigned long)meshes)] / d.first,
                                d.order_2 - d.order);
    switch (f->mixture) {
    case ONE_TERM:
        break;
    case SAME_SIGN:
        d.ratio = size;
        break;
    case OPPOSITE:
        d.ratio = -size;
        break;
    case CANCELLING:
        d.ratio = -crossing * between_log(r, 0.8, 1.25);
        break;
    case THREE_TERMS:
        d.ratio = sign(r) * size;
        d.ratio_3 = sign(r) * between_log(r, 0.1, 10);
        break;
    case WEAK_LEAD:
        d.ratio = sign(r) * weak;
        break;
    case WAVE:
        d.ratio = f->error == sine ? between(r, 0, 1) : between(r, 0, 3);
        break;
    case COARSE_BEND:
        d.bend = between_log(r, 0.5, finest / 4);
        break;
    case FINE_BEND:
        d.bend = between_log(r, finest / 4, finest);
        break;
    case SLOW:
        d.bend = between_log(r, finest / 40, finest / 4);
        break;
    }
    return d;
}

static mesh_limit shown(gsl_rng *r, const coverage_family *f, int meshes)
{
    const int *n = grid[gsl_rng_uniform_int(r, GRIDS)];
    const draw d = draw_from(r, f, n, meshes);
    const double round_off = 1e-14,
                 first = sign(r) * between_log(r, 1e-3, 0.3) * value / f->error(&d, 0, n[0]);
    const double usual = fmin(first, 0.3 * value / fabs(f->error(&d, 1, n[1])));
    double v[MOST];
    for (int i = 0; i < meshes; i++)
        v[i] = value + usual * f->error(&d, i, n[i]) + value * gsl_ran_gaussian(r, round_off);
    const limit_sequence s = {meshes, n, v, NAN, fmax(1, floor(fmin(d.order, 2))), 8, 0};
    return limit_of(&s);
}

static int is_covered(gsl_rng *r, const coverage_family *f, int meshes)
{
    const mesh_limit l = shown(r, f, meshes);
    return fabs(l.limit - value) <= l.limit_uncertainty;
}

static void coverage_of_families(void)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t k = 0; k < sizeof families / sizeof families[0]; k++)
        for (int meshes = FEWEST; meshes <= MOST; meshes++) {
            int covered = 0;
            gsl_rng_set(r, 20260 + 10 * k + (unsigned long)meshes);
            for (int i = 0; i < DRAWS; i++)
                covered += is_covered(r, &families[k], meshes);
            gsl_test(covered < families[k].covered * DRAWS,
                     "%s, %d meshes: %d of %d limits within their uncertainty", families[k].name,
                     meshes, covered, DRAWS);
        }
    gsl_rng_free(r);
}

static void coverage_under_noise(void)
{
    static const coverage_family noisy[] = {{"n^-2", power, ONE_TERM, 2, 0.95},
                                            {"n^-4", power, ONE_TERM, 4, 0.95},
                                            {"two terms of one sign", terms, SAME_SIGN, 0, 0.95}};
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(r, 4711);
    for (size_t k = 0; k < sizeof noisy / sizeof noisy[0]; k++)
        for (double size = 1e-14; size < 2e-7; size *= 10)
            for (int meshes = 4; meshes <= 6; meshes += 2) {
                int covered = 0;
                for (int i = 0; i < DRAWS; i++) {
                    double v[MOST];
                    const draw d = draw_from(r, &noisy[k], grid[0], meshes);
                    const double first =
                        sign(r) * between_log(r, 1e-3, 0.3) * value / noisy[k].error(&d, 0, 1);
                    for (int j = 0; j < meshes; j++)
                        v[j] = value * (1 + gsl_ran_gaussian(r, size)) +
                               first * noisy[k].error(&d, j, grid[0][j]);
                    const limit_sequence s = {meshes, grid[0], v, size * between_log(r, 1.0 / 3, 3),
                                              1,      8,       0};
                    const mesh_limit l = limit_of(&s);
                    covered += fabs(l.limit - value) <= l.limit_uncertainty;
                }
                gsl_test(covered < noisy[k].covered * DRAWS, "%s, %d meshes, noise %.0e: %d of %d",
                         noisy[k].name, meshes, size, covered, DRAWS);
            }
    gsl_rng_free(r);
}

static void low_orders(void)
{
    static const coverage_family low[] = {
        {"n^-1", power, ONE_TERM, 1, 1},
        {"n^-1.5", power, ONE_TERM, 1.5, 1},
        {"n^-1 and more of one sign", terms, SAME_SIGN, 1, 0.99},
        {"n^-1 and more of opposite signs", terms, OPPOSITE, 1, 0.80}};
    const double least = 1.7, nominal = 2;
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(r, 1789);
    for (size_t k = 0; k < sizeof low / sizeof low[0]; k++) {
        int two = 0, three = 0;
        for (int i = 0; i < 4 * DRAWS; i++) {
            const mesh_limit l = shown(r, &low[k], MOST - i % 3);
            const int agree =
                l.meshes > 4 && l.kind == LIMIT_ASYMPTOTIC && l.order + l.order_uncertainty < least;
            two += agree;
            three += agree && l.earlier_order < nominal && !l.order_turns;
        }
        gsl_test(two < DRAWS, "%s: %d low orders", low[k].name, two);
        gsl_test(three < low[k].covered * two, "%s: low by two orders %d times, by three %d",
                 low[k].name, two, three);
    }
    gsl_rng_free(r);
}

static void limit_coverage_tests(void)
{
    low_orders();
    coverage_of_families();
    coverage_under_noise();
}

enum { LIMIT_MOST = 7, DOUBLED = 6 };
static const double limit_value = 3; /* the exact limit of all sequences with one error term */
static const int mesh[LIMIT_MOST] = {1, 2, 4, 8, 16, 32, 64};

/* Returns the limit of values on 1, 2, 4, ... elements. The scatter is unknown, and the nominal
 * order is 2. */
static mesh_limit doubled(int count, const double v[])
{
    return limit_of(&(limit_sequence){count, mesh, v, NAN, 2, 4, 0});
}

static void is_kind(mesh_limit l, limit_kind kind, const char *what)
{
    gsl_test(l.kind != kind, "%s: %s", what, limit_kind_name(l.kind));
}

/* Sets v[i] = limit + size n[i]^-order. */
static void fill(int count, const int n[], double size, double order, double v[])
{
    for (int i = 0; i < count; i++)
        v[i] = limit_value + size * pow(n[i], -order);
}

static void orders(void)
{
    double v[LIMIT_MOST];
    for (double order = 1; order <= 4; order += 0.5) {
        fill(DOUBLED, mesh, 0.3, order, v);
        const mesh_limit l = doubled(DOUBLED, v);
        is_kind(l, LIMIT_ASYMPTOTIC, "one term");
        gsl_test_rel(l.order, order, 1e-6, "its order");
        gsl_test_abs(l.order_uncertainty, 0, 1e-5, "without doubt");
        gsl_test_rel(l.limit, limit_value, 1e-9, "its limit");
        gsl_test_int(l.from, 4, "four meshes say so");
    }
    const int uneven[] = {3, 5, 9, 30};
    fill(4, uneven, 2, 3, v);
    const mesh_limit l = limit_of(&(limit_sequence){4, uneven, v, NAN, 2, 4, 0});
    gsl_test_rel(l.order, 3, 1e-6, "order on uneven meshes");
    gsl_test_rel(l.limit, limit_value, 1e-9, "limit on uneven meshes");
}

static mesh_limit of_changes(int changes, const double change[], double noise)
{
    double v[LIMIT_MOST] = {0};
    for (int i = 0; i < changes; i++)
        v[i + 1] = v[i] + change[i];
    return limit_of(&(limit_sequence){changes + 1, mesh, v, noise, 2, 4, 0});
}

/* On meshes that double, the limit must be the last value plus change/(r - 1), where `change` is
 * the last change and r the ratio of the last two changes. */
static void worked(void)
{
    const double pure[] = {-16, -4, -1}, agreeing_by_accident[] = {-20, -4, -1, -0.25},
                 unsettled[] = {-16, -4, -1, -0.24};
    gsl_test_rel(of_changes(3, pure, 0).limit, -21 - 1.0 / 3, 1e-12, "changes of ratio 4");
    gsl_test_abs(of_changes(3, pure, 0).limit_uncertainty, 0, 1e-12, "are of one term");
    gsl_test_rel(of_changes(3, pure, NAN).limit_uncertainty, 1.25 * 0.02 / 3, 1e-6,
                 "2 % of a step is doubted without a measure of noise");
    /* the ratios of the changes are 5, 4, 4, and the limits are -24 - 4/4 = -25, then twice
     * -25.3333; the uncertainty follows from the former change of the limit, 1/3, reduced by the
     * order 2 + 2 */
    gsl_test_rel(of_changes(4, agreeing_by_accident, 0).limit_uncertainty,
                 1.25 * (1.0 / 3 - 0) / 16, 1e-9,
                 "a change of the limit that is small by accident");
    /* the ratios are 4, 4, 4.1667, and the limits are twice -21.3333, then -21.24 - 0.24/3.1667 =
     * -21.31579, so the limits do not converge */
    const double change = 4.0 / 3 - 1 - 0.24 * (1 + 6.0 / 19);
    gsl_test_rel(of_changes(4, unsettled, 0).limit_uncertainty, 1.25 * change, 1e-9,
                 "the change of the limit");
    gsl_test_rel(of_changes(4, unsettled, NAN).limit_uncertainty, 3 * change, 1e-6,
                 "which noise may have made, where it is not known");
    double v[LIMIT_MOST];
    fill(DOUBLED, mesh, 0.3, 0.3, v);
    const mesh_limit slow = doubled(DOUBLED, v);
    is_kind(slow, LIMIT_NOT_YET, "an order of 0.3");
    gsl_test(isfinite(slow.order), "is not believed");
}

static void few_meshes(void)
{
    const double v[] = {1, 1.5, 1.75};
    mesh_limit l = doubled(0, v);
    is_kind(l, LIMIT_NONE, "no mesh");
    gsl_test(!isnan(l.limit) || !isinf(l.limit_uncertainty), "no mesh, no number");
    l = doubled(1, v);
    gsl_test(l.limit != 1 || !isinf(l.limit_uncertainty), "one mesh says nothing of a limit");
    l = doubled(2, v);
    is_kind(l, LIMIT_NOT_YET, "two meshes");
    gsl_test_rel(l.limit_uncertainty, 3 * 0.5 + 4 * 3e-11 * 1.5, 1e-12, "two meshes");
    l = doubled(3, v);
    is_kind(l, LIMIT_NOT_YET, "three meshes");
    gsl_test_rel(l.order, 1, 1e-9, "three meshes of first order");
    gsl_test(isfinite(l.order_uncertainty), "whose doubt is not known");
    gsl_test_rel(l.limit, 2, 1e-9, "are extrapolated");
    gsl_test_rel(l.limit_uncertainty, 3 * 0.25, 1e-6, "and doubted by three times their change");
}

static void settled(void)
{
    const double equal[] = {2, 2, 2, 2}, zero[] = {0, 0, 0, 0}, last_two[] = {2, 2.3, 2.5, 2.5};
    mesh_limit l = doubled(4, equal);
    is_kind(l, LIMIT_NOISE_DOMINATED, "equal values");
    gsl_test_rel(l.limit_uncertainty, 4 * 3e-11 * 2, 1e-12,
                 "are known to the noise that is assumed");
    l = limit_of(&(limit_sequence){4, mesh, equal, 0, 2, 4, 0});
    gsl_test_rel(l.limit_uncertainty, 4 * 2.3e-16 * 2, 1e-12,
                 "or to round-off, where it was measured");
    l = doubled(4, zero);
    gsl_test(l.limit != 0 || l.limit_uncertainty != 0, "nothing but zeros is zero");
    l = limit_of(&(limit_sequence){4, mesh, zero, NAN, 2, 4, 5});
    gsl_test_rel(l.limit_uncertainty, 4 * 3e-11 * 5, 1e-12,
                 "zeros of a quantity of size 5 are known to its noise");
    l = doubled(4, last_two);
    gsl_test(!(l.limit_uncertainty >= 3 * 0.2 / 4),
             "the last two are equal by accident: the change before counts (%g)",
             l.limit_uncertainty);
    double v[DOUBLED];
    fill(DOUBLED, mesh, 0.3, 8,
         v); /* the limit is 3, the last change 0.3/16^8 = 7e-11, the previous one 2e-8 */
    l = limit_of(&(limit_sequence){DOUBLED, mesh, v, NAN, 2, 8, 0});
    is_kind(l, LIMIT_CONVERGED, "a high order that has reached the noise");
    gsl_test_rel(l.order, 8, 0.02, "shows its order above it");
}

static void orders_beyond_the_highest(void)
{
    static const double v[] = {-7.541557376815, -7.572498677944, -7.749537235739, -7.764447957971,
                               -7.765605623215, -7.765686750034, -7.765690327019, -7.765690466550};
    static const int n[] = {1, 2, 4, 8, 16, 32, 64, 128};
    const double seen = -7.765691732;
    limit_sequence s = {8, n, v, 1e-12, 2, 4, 0};
    const mesh_limit l = limit_of(&s);
    is_kind(l, LIMIT_ASYMPTOTIC, "orders that agree");
    gsl_test_abs(l.order, 4.68, 0.01, "on what there is not");
    gsl_test(!(fabs(l.limit - seen) < 2 * l.limit_uncertainty), "its limit is %.1e off, not %.1e",
             fabs(l.limit - seen), l.limit_uncertainty);
    s.highest_order = 8;
    gsl_test(!(limit_of(&s).limit_uncertainty < 0.05 * l.limit_uncertainty),
             "an order that there may be is believed");
}

static void out_of_order(void)
{
    double v[LIMIT_MOST];
    for (int i = 0; i < DOUBLED; i++)
        v[i] = limit_value + (i % 2 ? 0.1 : -0.1) / mesh[i];
    mesh_limit l = doubled(DOUBLED, v);
    is_kind(l, LIMIT_OSCILLATING, "values that alternate");
    gsl_test(isfinite(l.order), "show no order");
    gsl_test_rel(l.limit, v[DOUBLED - 1], 1e-15, "their limit is the last value");
    const double growing[] = {1, 1.1, 1.3, 1.7};
    l = doubled(4, growing);
    is_kind(l, LIMIT_NOT_YET, "changes that grow");
    gsl_test_rel(l.limit_uncertainty, 3 * 0.4 * 2, 1e-6, "count more, as they grow");
    for (int i = 0; i < DOUBLED; i++)
        v[i] = limit_value + 1e-6 * (i % 2 ? 1 : -1) / mesh[i];
    is_kind(doubled(DOUBLED, v), LIMIT_CONVERGED, "alternating beyond interest");
}

static void gaps(void)
{
    const int n[] = {32, 1, 2, 4, 8, 16, 31, 3};
    double v[8];
    fill(8, n, 0.3, 2, v);
    v[6] = 99;
    v[1] = INFINITY;
    v[2] = NAN;
    v[7] = NAN;
    mesh_limit l = limit_of(&(limit_sequence){8, n, v, NAN, 2, 4, 0});
    gsl_test_int(l.meshes, 4, "meshes without a value or too close are left out");
    gsl_test_rel(l.limit, limit_value, 1e-9, "the others have a limit");
    v[4] = NAN;
    l = limit_of(&(limit_sequence){8, n, v, NAN, 2, 4, 0});
    gsl_test_rel(l.order, 2, 1e-6, "a gap in the middle changes the ratio only");
    const int close[] = {1, 2, 3, 4};
    l = limit_of(&(limit_sequence){4, close, v, NAN, 2, 4, 0});
    gsl_test(l.meshes > 3, "3 and 4 elements are too close, 2 and 4 are not");
    const int dense[] = {10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20};
    double w[11];
    fill(11, dense, 0.3, 2, w);
    l = limit_of(&(limit_sequence){11, dense, w, NAN, 2, 4, 0});
    gsl_test_int(l.meshes, 3, "20, 14 and 10 elements are the meshes of a series of every number");
}

static void limit_tests(void)
{
    orders();
    worked();
    few_meshes();
    settled();
    orders_beyond_the_highest();
    out_of_order();
    gaps();
}

int main(void)
{
    limit_coverage_tests();
    limit_tests();
    return gsl_test_summary();
}
