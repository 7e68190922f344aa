/* Frequencies in a rotating frame must agree with those of LAPACK for the full problem within 1e-9:
 * weak and strong gyroscopic terms, singular masses, equal frequencies, and indefinite stiffness.
 * The numbers of frequencies below a limit must be exact. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/numerics/numerics_impl.h"
#include "harness/numerics/test/gyroscopic_problem.h"

static void compare(const problem *p, int definite_, const char *name)
{
    double *expected = calloc(2 * (size_t)p->n, sizeof *expected), growth, largest = 0;
    gyroscopic_result r = {0};
    fault f = {""};
    const int count = gyroscopic_problem_by_lapack(p, expected, &growth);
    gsl_test(gyroscopic_problem_solve(p, &r, &f) != STATUS_OK, "%s: solved (%s)", name, f.text);
    int at = 0;
    double worst = 0, uncertain = 0;
    for (int i = 0; i < r.count; i++) {
        largest = fmax(largest, r.growth[i]);
        if (r.growth[i] > 0)
            continue;
        worst = fmax(worst, at < count ? fabs(r.frequency[i] / expected[at] - 1) : INFINITY);
        uncertain = fmax(uncertain, r.error[i]);
        at++;
    }
    gsl_test(!(uncertain < 1e-9), "%s: estimates of errors, largest %.1e", name, uncertain);
    gsl_test_int(r.count, count < WANTED && r.negative == 0 ? count : WANTED, "%s: number of modes",
                 name);
    gsl_test(!(worst < 1e-9), "%s: frequencies are those of LAPACK (%.1e)", name, worst);
    gsl_test((r.negative == 0) != definite_, "%s: %d negative eigenvalues of the stiffness", name,
             r.negative);
    if (r.negative == 0)
        gsl_test(largest != 0, "%s: nothing grows where the stiffness is definite", name);
    else
        gsl_test_rel(largest, growth, 1e-7, "%s: rate of growth", name);
    gyroscopic_free(&r);
    free(expected);
}

static void definite(void)
{
    static const int size[] = {3, 6, 30, 120};
    static const double strength[] = {0, 0.1, 3, 100};
    for (size_t i = 0; i < sizeof size / sizeof size[0]; i++)
        for (size_t g = 0; g < sizeof strength / sizeof strength[0]; g++) {
            char name[64];
            problem p;
            gyroscopic_problem_alloc(size[i], &p);
            gyroscopic_problem_fill(&p, strength[g], size[i] / 3, 0);
            snprintf(name, sizeof name, "%d unknowns, gyroscopic terms %g", size[i], strength[g]);
            compare(&p, 1, name);
            free(p.K);
        }
}

static void equal_frequencies(void)
{
    static const int size[] = {5, 50};
    for (int k = 0; k < 2; k++) {
        const int n = size[k];
        problem one, two;
        gyroscopic_problem_alloc(n, &one);
        gyroscopic_problem_alloc(2 * n, &two);
        gyroscopic_problem_fill(&one, 2, 0, 0);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                for (int copy = 0; copy < 2; copy++) {
                    const int to = (copy * n + i) * 2 * n + copy * n + j, from = i * n + j;
                    two.K[to] = one.K[from];
                    two.M[to] = one.M[from];
                    two.G[to] = one.G[from];
                }
        compare(&two, 1, n == 5 ? "two copies of 5 unknowns" : "two copies of 50 unknowns");
        free(one.K);
        free(two.K);
    }
}

/* Unit masses with the negative stiffnesses k1 and k2 and the gyroscopic term g: the motion must
 * grow for weak g and must not grow for strong g. The eigenvalues lambda are the roots of lambda^4
 * + (k1 + k2 + g^2) lambda^2 + k1 k2. */
static void indefinite(void)
{
    static const double k1 = -1, k2 = -2, g[] = {0.5, 4};
    for (int i = 0; i < 2; i++) {
        problem p;
        gyroscopic_problem_alloc(2, &p);
        p.K[0] = k1, p.K[3] = k2, p.M[0] = p.M[3] = 1, p.G[1] = -g[i], p.G[2] = g[i];
        gyroscopic_result r = {0};
        fault f = {""};
        gsl_test(gyroscopic_problem_solve(&p, &r, &f) != STATUS_OK, "top with g = %g: solved (%s)",
                 g[i], f.text);
        gsl_test_int(r.negative, 2, "top: two negative eigenvalues of the stiffness");
        gsl_test_int(r.unproven, 0, "top with g = %g: its modes account for both", g[i]);
        double largest = 0;
        for (int k = 0; k < r.count; k++)
            largest = fmax(largest, r.growth[k]);
        if (i == 0) {
            gsl_test(!(largest > 0.5), "top that turns slowly: it falls");
        } else {
            const double b = k1 + k2 + g[i] * g[i], root = sqrt(b * b / 4 - k1 * k2);
            gsl_test(largest != 0, "top that turns fast: it stands");
            gsl_test_rel(r.frequency[0], sqrt(b / 2 - root), 1e-12, "slow precession");
            gsl_test_rel(r.frequency[1], sqrt(b / 2 + root), 1e-12, "nutation");
        }
        gyroscopic_free(&r);
        free(p.K);
    }
    problem p;
    gyroscopic_problem_alloc(20, &p);
    gyroscopic_problem_fill(&p, 2, 0, 1.6);
    compare(&p, 0, "20 unknowns, softened");
    free(p.K);
}

static void held_from(void)
{
    static const double g[] = {2.999, 3.001};
    for (int i = 0; i < 2; i++) {
        problem p;
        gyroscopic_result r = {0};
        fault f = {""};
        gyroscopic_problem_alloc(2, &p);
        p.K[0] = -1, p.K[3] = -4, p.M[0] = p.M[3] = 1, p.G[1] = -g[i], p.G[2] = g[i];
        gsl_test(gyroscopic_problem_solve(&p, &r, &f) != STATUS_OK, "g = %g: solved (%s)", g[i],
                 f.text);
        gsl_test_int(r.unproven, 0, "g = %g: modes account for both", g[i]);
        double largest = 0;
        for (int k = 0; k < r.count; k++)
            largest = fmax(largest, r.growth[k]);
        gsl_test((largest > 0) != (i == 0), "g = %g: grows with %g", g[i], largest);
        gyroscopic_free(&r);
        free(p.K);
    }
}

static void light_and_massless(void)
{
    for (int decade = 0; decade <= 16; decade += 2)
        for (int negative = 0; negative < 2; negative++) {
            const double light = pow(10, -decade), sign = negative ? -1 : 1, g = 5;
            problem p;
            gyroscopic_result r = {0};
            fault f = {""};
            gyroscopic_problem_alloc(9, &p);
            for (int i = 0; i < 9; i++) {
                p.K[i * 10] = (i < 2 ? sign : 10) * (1 + 0.1 * i);
                p.M[i * 10] = i < 3 ? 1 : i < 6 ? light : 0;
            }
            p.G[1] = -g, p.G[9] = g;
            p.K[2 * 9 + 7] = p.K[7 * 9 + 2] = 1;
            gsl_test(gyroscopic_problem_solve(&p, &r, &f) != STATUS_OK, "light %g: solved (%s)",
                     light, f.text);
            const double b = sign * 2.1 + g * g, root = sqrt(b * b / 4 - 1.1),
                         slow = sqrt(b / 2 - root), fast = sqrt(b / 2 + root),
                         third = sqrt(12 - 1 / 17.0);
            gsl_test(r.count < 3 || r.count > 6, "light %g: %d frequencies", light, r.count);
            gsl_test(decade < 8 && r.count != 6, "light %g: all %d frequencies", light, r.count);
            gsl_test_rel(r.frequency[0], slow, 1e-10, "light %g, %g: slow", light, sign);
            gsl_test_rel(r.frequency[1], third, 1e-10, "light %g, %g: third", light, sign);
            for (int i = 3; i < r.count && decade > 0; i++)
                gsl_test_rel(r.frequency[i], sqrt((10 + i) / light), 1e-6, "light %g: frequency %d",
                             light, i);
            if (decade > 0)
                gsl_test_rel(r.frequency[2], fast, 1e-10, "light %g, %g: fast", light, sign);
            gyroscopic_free(&r);
            free(p.K);
        }
}

static void corrupted_matrix(void)
{
    static const double noise[] = {1e-8, 1e-5, 1e-3};
    static const int size[] = {12, 30, 120};
    for (int softened = 0; softened < 2; softened++)
        for (size_t k = 0; k < sizeof noise / sizeof noise[0]; k++)
            for (size_t s = 0; s < sizeof size / sizeof size[0]; s++) {
                const int n = size[s];
                problem p;
                gyroscopic_result r = {0};
                fault f = {""};
                uint64_t seed = 11;
                double *K = malloc((size_t)n * (size_t)n * sizeof *K),
                       *expected = calloc(2 * (size_t)n, sizeof *expected), growth, worst = 0,
                       uncertain = 0;
                gyroscopic_problem_alloc(n, &p);
                gyroscopic_problem_fill(&p, 3, n / 4, softened ? 1.2 : 0);
                for (int i = 0; i < n; i++)
                    for (int j = i; j < n; j++)
                        K[i * n + j] = K[j * n + i] =
                            p.K[i * n + j] * (1 + noise[k] * random_number(&seed));
                const int count = gyroscopic_problem_by_lapack(&p, expected, &growth);
                gsl_test(gyroscopic_problem_solve_by(&p, K, gyroscopic_problem_product, NULL, &r,
                                                     &f) != STATUS_OK,
                         "matrix of %d unknowns spoilt by %g: solved (%s)", n, noise[k], f.text);
                gsl_test(r.count < WANTED, "matrix of %d unknowns spoilt by %g: %d modes", n,
                         noise[k], r.count);
                for (int i = 0, at = 0; i < r.count; i++) {
                    if (r.growth[i] > 0)
                        continue;
                    worst = fmax(worst, at < count ? fabs(r.frequency[i] / expected[at] - 1) : 1);
                    uncertain = fmax(uncertain, r.error[i]);
                    at++;
                }
                gsl_test(!(worst < 1e-9), "matrix of %d unknowns spoilt by %g: off by %.1e", n,
                         noise[k], worst);
                gsl_test(!(uncertain < 1e-9), "matrix of %d unknowns spoilt by %g: estimate %.1e",
                         n, noise[k], uncertain);
                gyroscopic_free(&r);
                free(K);
                free(expected);
                free(p.K);
            }
}

static const double part_of_rounding = 1e-4;

static double large_rounding(void *context, const double x[])
{
    const problem *p = context;
    double sum = 0;
    for (int i = 0; i < p->n; i++)
        for (int j = 0; j < p->n; j++)
            sum += x[i] * p->K[i * p->n + j] * x[j];
    return part_of_rounding * sum;
}

static void rounding_is_reported(void)
{
    static const double strength[] = {0, 2};
    for (int i = 0; i < 2; i++) {
        problem p;
        gyroscopic_result r = {0};
        fault f = {""};
        gyroscopic_problem_alloc(30, &p);
        gyroscopic_problem_fill(&p, strength[i], 0, 0);
        gsl_test(gyroscopic_problem_solve_by(&p, p.K, gyroscopic_problem_product, large_rounding,
                                             &r, &f) != STATUS_OK,
                 "rounding of K: solved (%s)", f.text);
        for (int k = 0; k < r.count && i == 0; k++)
            gsl_test(r.error[k] < part_of_rounding / 2 || r.error[k] > 5 * part_of_rounding,
                     "rounding of K: error %.2e", r.error[k]);
        for (int k = 0; k < r.count && i == 1; k++) {
            problem other = p;
            gyroscopic_result moved = {0};
            double *K = malloc(900 * sizeof *K);
            for (int j = 0; j < 900; j++)
                K[j] = p.K[j] * (1 + part_of_rounding);
            other.K = K;
            gsl_test(gyroscopic_problem_solve(&other, &moved, &f) != STATUS_OK,
                     "a stiffer structure: solved (%s)", f.text);
            const double change = fabs(moved.frequency[k] / r.frequency[k] - 1);
            gsl_test(r.error[k] < change || r.error[k] > 10 * change,
                     "frequency %d: error %.2e, and a change of the stiffness changes it by %.2e",
                     k, r.error[k], change);
            gyroscopic_free(&moved);
            free(K);
        }
        gyroscopic_free(&r);
        free(p.K);
    }
}

static void gyroscopic_tests(void)
{
    corrupted_matrix();
    rounding_is_reported();
    held_from();
    light_and_massless();
    definite();
    equal_frequencies();
    indefinite();
}

static void compare_counts(const problem *p, const char *name)
{
    double *frequency = calloc(2 * (size_t)p->n, sizeof *frequency), growth;
    const int count = gyroscopic_problem_by_lapack(p, frequency, &growth);
    sparse K = gyroscopic_problem_upper(p->n, p->K), M = gyroscopic_problem_upper(p->n, p->M),
           G = gyroscopic_problem_upper(p->n, p->G);
    for (int k = 0; k <= count; k++) {
        const double low = k > 0 ? frequency[k - 1] : frequency[0] / 2,
                     high = k < count ? frequency[k] : 2 * frequency[count - 1];
        int below = -1;
        fault f = {""};
        if (k > 0 && k < count && high - low < 1e-6 * high)
            continue;
        gsl_test_int((int)gyroscopic_count(&K, &M, &G, k > 0 ? sqrt(low * high) : low, &below, &f),
                     STATUS_OK, "%s: %s", name, f.text);
        gsl_test_int(below, k, "%s: frequencies below the one of rank %d", name, k);
    }
    matrices_free(&K);
    matrices_free(&M);
    matrices_free(&G);
    free(frequency);
}

static void counts(void)
{
    static const double strength[] = {0, 0.1, 3, 100};
    static const int size[] = {2, 3, 7, 24};
    for (size_t i = 0; i < sizeof size / sizeof size[0]; i++)
        for (size_t g = 0; g < sizeof strength / sizeof strength[0]; g++)
            for (int massless = 0; massless < 2; massless++) {
                char name[64];
                problem p;
                gyroscopic_problem_alloc(size[i], &p);
                gyroscopic_problem_fill(&p, strength[g], massless * size[i] / 3, 0);
                snprintf(name, sizeof name, "%d unknowns, gyroscopic terms %g, %d massless",
                         size[i], strength[g], massless * size[i] / 3);
                compare_counts(&p, name);
                free(p.K);
            }
}

/* Makes `masses` uncoupled oscillators of unit mass with the frequencies 1, 2, 3 ... rad/s,
 * followed by `behind` unknowns with the stiffness 1e6. The first two of these form a top, whose
 * slow precession is `slow` [rad/s]. */
static void oscillators_and_top(int masses, int behind, double slow, problem *p)
{
    const double k = 1e6, g = (k / slow) - slow; /* such that `slow` is a root of w^2 + g w - k */
    gyroscopic_problem_alloc(masses + behind, p);
    for (int i = 0; i < p->n; i++) {
        p->K[i * (p->n + 1)] = i < masses ? (i + 1.0) * (i + 1.0) : k;
        p->M[i * (p->n + 1)] = 1;
    }
    p->G[masses * p->n + masses + 1] = -g;
    p->G[(masses + 1) * p->n + masses] = g;
}

static void hidden_precession(int masses, int behind, int wanted_outcome)
{
    const double slow = behind + 0.5;
    problem p;
    gyroscopic_result r = {0};
    fault f = {""};
    oscillators_and_top(masses, 2, slow, &p);
    const status outcome = gyroscopic_problem_solve(&p, &r, &f);
    gsl_test_int((int)outcome, wanted_outcome, "%d oscillators and a top at %g: %s", masses, slow,
                 f.text);
    if (wanted_outcome != STATUS_OK)
        gsl_test(strstr(f.text, "not found") == NULL, "what is missing is noticed: %s", f.text);
    if (outcome == STATUS_OK) {
        gsl_test_int(r.count, WANTED, "%d oscillators and a top at %g: all found", masses, slow);
        for (int i = 0; i < r.count; i++) {
            const double oscillator = i < behind ? i + 1 : i;
            gsl_test_rel(r.frequency[i], i == behind ? slow : oscillator, 1e-9,
                         "%d oscillators and a top at %g: frequency %d", masses, slow, i);
        }
    }
    gyroscopic_free(&r);
    compare_counts(&p, "oscillators and a top");
    free(p.K);
}

static void unstable_oscillators(int masses, double fast, int wanted_outcome, int unproven)
{
    const double slow = 2.5;
    problem p;
    gyroscopic_result r = {0};
    fault f = {""};
    oscillators_and_top(masses, 4, slow, &p);
    p.K[(masses + 2) * (p.n + 1)] = -1.5 * 1.5;
    p.K[(masses + 3) * (p.n + 1)] = -fast * fast;
    const status outcome = gyroscopic_problem_solve(&p, &r, &f);
    gsl_test_int((int)outcome, wanted_outcome, "%d oscillators that fall and a top: %s", masses,
                 f.text);
    gsl_test_int(r.negative, 2, "two negative eigenvalues of the stiffness");
    if (outcome == STATUS_OK) {
        gsl_test_int(r.unproven, unproven, "%d oscillators, falls with %g: what is not found",
                     masses, fast);
        int slow_found = 0;
        for (int i = 0; i < r.count; i++)
            slow_found += r.growth[i] == 0 && fabs(r.frequency[i] - slow) < 1e-6;
        gsl_test_int(slow_found, 1, "%d oscillators that fall: the slow precession", masses);
    } else {
        gsl_test(strstr(f.text, "not found") == NULL, "what is missing is noticed: %s", f.text);
    }
    gyroscopic_free(&r);
    free(p.K);
}

static void gyroscopic_count_tests(void)
{
    unstable_oscillators(12, 1.7, STATUS_OK, 0);
    unstable_oscillators(12, 1e3, STATUS_OK, 1);
    unstable_oscillators(60, 1.7, STATUS_NOT_CONVERGED, 0);
    counts();
    for (int behind = 0; behind < WANTED; behind++)
        hidden_precession(12, behind, STATUS_OK);
    hidden_precession(60, 2, STATUS_NOT_CONVERGED);
}

int main(void)
{
    gyroscopic_tests();
    gyroscopic_count_tests();
    return gsl_test_summary();
}
