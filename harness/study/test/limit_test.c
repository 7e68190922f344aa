/* The limit of a sequence against sequences worked out by hand, and what happens at the edges. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/study/study.h"

enum { LIMIT_MOST = 7, DOUBLED = 6 };
static const double limit_value = 3; /* the limit of all sequences of one term */
static const int mesh[LIMIT_MOST] = {1, 2, 4, 8, 16, 32, 64};

/* Values on 1, 2, 4, ... elements; round-off not measured, nominal order 2. */
static mesh_limit doubled(int count, const double v[])
{
    return limit_of(&(limit_sequence){count, mesh, v, NAN, 2, 4, 0});
}

static void is_kind(mesh_limit l, limit_kind kind, const char *what)
{
    gsl_test(l.kind != kind, "%s: %s", what, limit_kind_name(l.kind));
}

/* limit + size n^-order on meshes n. */
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

/* Sequences worked out by hand on meshes that double: with a ratio r of two changes the limit is
 * change/(r - 1) beyond the last value. */
static void worked(void)
{
    const double pure[] = {-16, -4, -1}, agreeing_by_accident[] = {-20, -4, -1, -0.25},
                 unsettled[] = {-16, -4, -1, -0.24};
    gsl_test_rel(of_changes(3, pure, 0).limit, -21 - 1.0 / 3, 1e-12, "changes of ratio 4");
    gsl_test_abs(of_changes(3, pure, 0).limit_uncertainty, 0, 1e-12, "are of one term");
    gsl_test_rel(of_changes(3, pure, NAN).limit_uncertainty, 1.25 * 0.02 / 3, 1e-6,
                 "2 % of a step is doubted without a measure of noise");
    /* Ratios 5, 4, 4: the limits are -24 - 4/4 = -25, then twice -25.3333: 1/3 of former change,
     * reduced by order 2 + 2. */
    gsl_test_rel(of_changes(4, agreeing_by_accident, 0).limit_uncertainty,
                 1.25 * (1.0 / 3 - 0) / 16, 1e-9,
                 "a change of the limit that is small by accident");
    /* Ratios 4, 4, 4.1667: the limits are twice -21.3333, then -21.24 - 0.24/3.1667 = -21.31579:
     * they do not settle. */
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

/* Two values say no order: first order is assumed, three times the change and four noises. Three
 * values never say two. */
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
         v); /* the last change is 0.3/16^8 = 7e-11 of 3, the one before 2e-8 */
    l = limit_of(&(limit_sequence){DOUBLED, mesh, v, NAN, 2, 8, 0});
    is_kind(l, LIMIT_SETTLED, "a high order that has reached the noise");
    gsl_test_rel(l.order, 8, 0.02, "shows its order above it");
}

/* C_uz_My of sheet_second (sheet_cantilever, tip_warping=1) [1e-7/N]: from 64 elements on the trace
 * of another term comes into sight, orders of 4.5 and 4.7 agree where four is the highest, and the
 * limits seem to settle. 1024 elements show the limit. */
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
    is_kind(doubled(DOUBLED, v), LIMIT_SETTLED, "alternating beyond interest");
}

/* Failed meshes, meshes too close, any order of them. */
static void gaps(void)
{
    const int n[] = {32, 1, 2, 4, 8, 16, 31, 3};
    double v[8];
    fill(8, n, 0.3, 2, v);
    v[6] = 99; /* 31 elements are too close to 32 */
    v[1] = INFINITY;
    v[2] = NAN;
    v[7] = NAN;
    mesh_limit l = limit_of(&(limit_sequence){8, n, v, NAN, 2, 4, 0});
    gsl_test_int(l.meshes, 4, "meshes without a value or too close are left out");
    gsl_test_rel(l.limit, limit_value, 1e-9, "the others have a limit");
    v[4] = NAN; /* 4, 16, 32 are left */
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

int main(void)
{
    orders();
    worked();
    few_meshes();
    settled();
    orders_beyond_the_highest();
    out_of_order();
    gaps();
    return gsl_test_summary();
}
