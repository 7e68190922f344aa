/* Eigenvalues that are lost: of one side only, behind a missing one, in rounding. */
#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "harness/numerics/test/eigen_problems.h"

/* x^T A x, not to be had of one sign between two sizes. */
typedef struct broken {
    const sparse *A;
    double sign, least, most;
} broken;

static double broken_energy(void *context, const double x[])
{
    const broken *b = context;
    const double energy = matrices_energy(b->A, x), size = -b->sign * energy;
    return size > b->least && size < b->most ? NAN : energy;
}

/* Values of both signs, of which those of one sign are lost as soon as they are found: the other
 * side is found all the same, as if it alone had been asked for, and the side that is not says
 * so. */
static void test_sides_apart(void)
{
    enum { N = 800, WANTED = 4 };
    strings s;
    strings_init(&s, 1, N, 0);
    for (int i = N / 2; i < N; i++)
        matrices_add(&s.M, i, i, -2.5);
    for (int sign = -1; sign <= 1; sign += 2) {
        broken b = {&s.M, sign, 0, INFINITY};
        eigen_result alone = {0}, r = {0};
        fault f = {""};
        eigen_problem p = {.K = &s.K, .A = &s.M, .sign = sign, .largest = WANTED};
        gsl_test_int((int)eigen_problems_solve(&p, &alone, &f), STATUS_OK, "one side alone: %s",
                     f.text);
        p.smallest = WANTED;
        p.A_energy = broken_energy;
        p.context = &b;
        gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_NOT_CONVERGED,
                     "the whole is no success");
        gsl_test_int((int)r.positive.status, STATUS_OK, "the side that can be found is found: %s",
                     r.positive.reason);
        gsl_test_int(r.positive.count, WANTED, "all of it");
        for (int i = 0; i < r.positive.count && i < alone.positive.count; i++)
            gsl_test_rel(r.positive.mu[i], alone.positive.mu[i], 1e-14,
                         "value %d is that of one side alone", i);
        gsl_test_int((int)r.negative.status, STATUS_NOT_CONVERGED, "the other one is not: %s",
                     r.negative.reason);
        gsl_test(r.negative.reason[0] == '\0' || strcmp(r.negative.reason, f.text) != 0,
                 "and says so: %s", f.text);
        gsl_test_int(r.negative.count, 0, "and gives none");
        eigen_free(&r);
        eigen_free(&alone);
    }
    strings_free(&s);
}

/* One value of a side is lost: those before it are given, and none behind it, for it is missing
 * among them. */
static void test_side_in_part(int lost)
{
    enum { N = 800, WANTED = 4 };
    strings s;
    strings_init(&s, 1, N, 0);
    for (int i = N / 2; i < N; i++)
        matrices_add(&s.M, i, i, -2.5);
    eigen_result all = {0}, r = {0};
    fault f = {""};
    eigen_problem p = {.K = &s.K, .A = &s.M, .sign = 1, .largest = WANTED, .smallest = WANTED};
    gsl_test_int((int)eigen_problems_solve(&p, &all, &f), STATUS_OK, "both sides: %s", f.text);
    const double size = -all.negative.mu[lost];
    broken b = {&s.M, 1, size * (1 - 1e-3), size * (1 + 1e-3)};
    p.A_energy = broken_energy;
    p.context = &b;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_NOT_CONVERGED,
                 "without value %d: no success", lost);
    gsl_test_int((int)r.negative.status, STATUS_NOT_CONVERGED, "without value %d: its side", lost);
    gsl_test_int(r.negative.count, lost, "without value %d: those before it", lost);
    for (int i = 0; i < r.negative.count; i++)
        gsl_test_rel(r.negative.mu[i], all.negative.mu[i], 1e-12, "without value %d: value %d",
                     lost, i);
    gsl_test_int(r.positive.count, WANTED, "without value %d: the other side", lost);
    eigen_free(&r);
    eigen_free(&all);
    strings_free(&s);
}

static double much(void *context, const double x[])
{
    (void)x;
    return *(const double *)context;
}

/* What the caller says of rounding decides what is a value, and how many digits it has. */
static void test_rounding(int masses)
{
    enum { WANTED = 3 };
    strings s;
    strings_init(&s, 1, masses, 0);
    for (int all = 0; all < 2; all++) {
        double size = all ? 1e9 : 1e-9;
        eigen_result r = {0};
        fault f = {""};
        eigen_problem p = {.K = &s.K, .A = &s.M, .sign = 1, .largest = WANTED, .smallest = WANTED};
        p.A_rounding = much;
        p.context = &size;
        gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "rounding of %g: %s", size,
                     f.text);
        gsl_test_int(r.positive.count, all ? 0 : WANTED, "rounding of %g: values that are more",
                     size);
        gsl_test(all != (r.positive.rounding > 0), "rounding of %g: the others are counted", size);
        gsl_test(all && r.factorisations > 0, "rounding of %g: nothing is looked for in it", size);
        eigen_free(&r);
    }
    strings_free(&s);
}

int main(void)
{
    test_sides_apart();
    for (int lost = 0; lost < 4; lost++)
        test_side_in_part(lost);
    test_rounding(40);
    test_rounding(120);
    return gsl_test_summary();
}
