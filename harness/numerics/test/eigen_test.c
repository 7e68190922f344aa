/* Eigenpairs against closed forms and against LAPACK: both signs, repeated and nearly equal values,
 * singular and indefinite matrices. */
#include <gsl/gsl_test.h>
#include <stdio.h>

#include "harness/numerics/test/eigen_problems.h"

static void test_strings(int copies, int masses, double spread, int wanted, int iterate,
                         double allowed)
{
    strings s;
    eigen_result r = {0};
    fault f = {""};
    char name[80];
    snprintf(name, sizeof name, "%d strings of %d, springs %g apart, %d wanted, %s", copies, masses,
             spread, wanted, iterate ? "sparse" : "as it comes");
    strings_init(&s, copies, masses, spread);
    eigen_problem p = {.K = &s.K, .A = &s.M, .sign = 1, .largest = wanted, .iterate = iterate};
    p.K_energy = strings_energy;
    p.context = &s;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "%s: %s", name, f.text);
    gsl_test_int(r.positive.count, wanted, "%s: all found", name);
    double worst = 0, residual = 0, error = 0;
    for (int i = 0; i < r.positive.count; i++) {
        worst = fmax(worst, fabs(r.positive.mu[i] / strings_exact(&s, i) - 1));
        residual = fmax(residual, r.positive.residual[i]);
        error = fmax(error, r.positive.error[i]);
    }
    gsl_test(!(worst < allowed), "%s: within %.1e", name, worst);
    gsl_test(!(residual < 1e-8), "%s: residuals below %.1e", name, residual);
    gsl_test(!(error < 1e-15), "%s: estimated errors below %.1e", name, error);
    const double apart = eigen_problems_departure(&s.K, r.positive.count, r.positive.mode);
    gsl_test(!(apart < 1e-9), "%s: modes orthonormal within %.1e", name, apart);
    eigen_free(&r);
    strings_free(&s);
}

/* The first values of both signs, where all of them were found. */
static void compare_sides(const eigen_result *sparse_way, const eigen_result *dense_way, int wanted,
                          double tolerance, const char *what)
{
    const int found = sparse_way->positive.count >= wanted && sparse_way->negative.count >= wanted;
    gsl_test(!found, "%s: all are found", what);
    if (!found)
        return;
    for (int i = 0; i < wanted; i++) {
        gsl_test_rel(sparse_way->positive.mu[i], dense_way->positive.mu[i], tolerance,
                     "%s: positive value %d", what, i);
        gsl_test_rel(sparse_way->negative.mu[i], dense_way->negative.mu[i], tolerance,
                     "%s: negative value %d", what, i);
    }
}

/* Indefinite A: the sparse way against the dense one. */
static void test_both_signs(void)
{
    enum { NODES = 60, SIZE = 3, WANTED = 7 };
    uint64_t seed = 77;
    sparse K = matrices_chain(NODES, SIZE), A = matrices_chain(NODES, SIZE);
    for (int j = 0; j < K.n; j++)
        for (int k = K.column[j]; k < K.column[j + 1]; k++) {
            A.value[k] = random_number(&seed);
            K.value[k] = K.row[k] == j ? 7 : random_number(&seed);
        }
    eigen_result sparse_way = {0}, again = {0}, dense_way = {0};
    fault f = {""};
    for (int sign = -1; sign <= 1; sign += 2) {
        eigen_problem p = {
            .K = &K, .A = &A, .sign = sign, .largest = WANTED, .smallest = WANTED, .iterate = 1};
        gsl_test_int((int)eigen_problems_solve(&p, &sparse_way, &f), STATUS_OK,
                     "indefinite, sparse: %s", f.text);
        gsl_test_int((int)eigen_problems_solve(&p, &again, &f), STATUS_OK, "indefinite, again: %s",
                     f.text);
        gsl_test(memcmp(again.positive.mode, sparse_way.positive.mode,
                        (size_t)K.n * WANTED * sizeof(double)) != 0,
                 "the same problem gives the same digits");
        p.largest = p.smallest = K.n;
        gsl_test_int((int)eigen_problems_solve(&p, &dense_way, &f), STATUS_OK,
                     "indefinite, dense: %s", f.text);
        gsl_test_int(dense_way.positive.count + dense_way.negative.count, K.n,
                     "all eigenvalues have a sign");
        compare_sides(&sparse_way, &dense_way, WANTED, 1e-13, "indefinite");
        eigen_free(&sparse_way);
        eigen_free(&again);
        eigen_free(&dense_way);
    }
    matrices_free(&K);
    matrices_free(&A);
}

/* Two strings that only A couples, one with the slope of the other: every value is double and comes
 * with both signs. */
static void test_coupled_strings(int masses)
{
    enum { WANTED = 3 };
    strings s;
    eigen_result sparse_way = {0}, dense_way = {0};
    fault f = {""};
    strings_init(&s, 2, masses, 0);
    sparse_zero(&s.M);
    for (int i = 1; i < masses; i++) {
        matrices_add(&s.M, 2 * (i - 1), 2 * i + 1, 1);
        matrices_add(&s.M, 2 * i, 2 * (i - 1) + 1, -1);
    }
    eigen_problem p = {
        .K = &s.K, .A = &s.M, .sign = 1, .largest = WANTED, .smallest = WANTED, .iterate = 1};
    gsl_test_int((int)eigen_problems_solve(&p, &sparse_way, &f), STATUS_OK,
                 "coupled strings of %d, sparse: %s", masses, f.text);
    p.largest = p.smallest = s.K.n;
    gsl_test_int((int)eigen_problems_solve(&p, &dense_way, &f), STATUS_OK,
                 "coupled strings of %d, dense: %s", masses, f.text);
    compare_sides(&sparse_way, &dense_way, WANTED, 1e-12, "coupled strings");
    eigen_free(&sparse_way);
    eigen_free(&dense_way);
    strings_free(&s);
}

/* A of rank 3 (two positive, one negative value): what does not exist is not found. */
static void test_rank(int iterate)
{
    enum { MASSES = 150 };
    strings s;
    eigen_result r = {0};
    fault f = {""};
    strings_init(&s, 1, MASSES, 0);
    sparse_zero(&s.M);
    matrices_add(&s.M, 20, 20, 3);
    matrices_add(&s.M, 70, 70, 5);
    matrices_add(&s.M, 120, 120, -2);
    eigen_problem p = {
        .K = &s.K, .A = &s.M, .sign = 1, .largest = 4, .smallest = 4, .iterate = iterate};
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "rank 3: %s", f.text);
    gsl_test_int(r.positive.count, 2, "rank 3: two positive values exist");
    gsl_test_int(r.negative.count, 1, "rank 3: one negative value exists");
    eigen_free(&r);
    sparse_zero(&s.M);
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "rank 0: %s", f.text);
    gsl_test_int(r.positive.count + r.negative.count, 0, "rank 0: no value exists");
    eigen_free(&r);
    matrices_add(&s.K, 75, 75, -3);
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_REFUSED,
                 "an indefinite stiffness is refused: %s", f.text);
    eigen_free(&r);
    strings_free(&s);
}

int main(void)
{
    static const double spreads[] = {0, 1e-12, 1e-9, 1e-7, 1e-4, 0.01};
    for (size_t i = 0; i < sizeof spreads / sizeof spreads[0]; i++)
        for (int copies = 1; copies <= 6; copies += copies == 1 ? 1 : 2)
            for (int wanted = 1; wanted <= 13; wanted += 4)
                test_strings(copies, 60, spreads[i], wanted, 1,
                             spreads[i] < 1e-9 ? 1e-13 + copies * spreads[i] : 1e-13);
    test_strings(6, 12, 0, 13, 0, 1e-13);
    test_strings(1, 3000, 0, 12, 0, 1e-11);
    test_strings(3, 1000, 0, 12, 0, 1e-11);
    test_both_signs();
    test_coupled_strings(60);
    test_coupled_strings(61);
    test_rank(0);
    test_rank(1);
    return gsl_test_summary();
}
