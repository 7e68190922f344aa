/* Frequencies in a rotating frame against LAPACK on the whole problem: weak and strong gyroscopic
 * terms, singular masses, equal frequencies, and stiffness that is not definite. */
#include <gsl/gsl_test.h>
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/algebra/gyroscopic.h"
#include "harness/algebra/gyroscopic_count.h"
#include "harness/algebra/test/matrices.h"

enum { WANTED = 8 };

/* Dense, row-major [n x n]; G skew. */
typedef struct problem {
    int n;
    double *K, *M, *G;
} problem;

static void alloc(int n, problem *p)
{
    p->n = n;
    p->K = calloc(3 * (size_t)n * (size_t)n, sizeof(double));
    p->M = p->K + n * n;
    p->G = p->M + n * n;
}

/* Positive definite K with eigenvalues of many sizes; M definite on all but the last `massless`
 * coordinates. */
static void fill(problem *p, double gyroscopic, int massless, double softening)
{
    const int n = p->n;
    uint64_t seed = (unsigned long long)n * 77 + 5;
    double *B = malloc((size_t)n * (size_t)n * sizeof *B);
    for (int i = 0; i < n * n; i++)
        B[i] = random_number(&seed);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            for (int k = 0; k < n; k++)
                p->K[i * n + j] += B[i * n + k] * B[j * n + k] * (1 + k * k);
            p->M[i * n + j] = i < n - massless && j < n - massless
                                  ? (i == j ? 1 + 0.3 * i / n : 0.2 / (1 + abs(i - j)))
                                  : 0;
            p->G[i * n + j] = i == j ? 0
                                     : gyroscopic * (i < j ? 1 : -1) *
                                           (0.3 + B[(i < j ? i : j) * n + (i < j ? j : i)]);
        }
    for (int i = 0; i < n; i++)
        p->K[i * n + i] += n - softening * n;
    free(B);
}

/* The upper triangle, zeros included. */
static sparse upper(int n, const double A[])
{
    sparse s = {n, 1, calloc((size_t)n + 1, sizeof(int)), NULL, NULL};
    s.row = malloc((size_t)n * (size_t)(n + 1) / 2 * sizeof *s.row);
    s.value = malloc((size_t)n * (size_t)(n + 1) / 2 * sizeof *s.value);
    for (int j = 0, at = 0; j < n; j++) {
        for (int i = 0; i <= j; i++) {
            s.row[at] = i;
            s.value[at++] = A[i * n + j];
        }
        s.column[j + 1] = at;
    }
    return s;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* All frequencies (lambda nearly imaginary), ascending, and the largest real part. Returns how
 * many. */
static int by_lapack(const problem *p, double frequency[], double *growth)
{
    const int n = p->n, m = 2 * n;
    double *A = calloc((size_t)m * (size_t)m, sizeof *A),
           *B = calloc((size_t)m * (size_t)m, sizeof *B);
    double *re = calloc(3 * (size_t)m, sizeof *re), *im = re + m, *beta = im + m;
    int count = 0;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n;
             j++) { /* nu = 1/lambda: nu [K, 0; 0, 1] z = [-G, -M; 1, 0] z, column-major */
            A[j * m + i] = -p->G[i * n + j];
            A[(n + j) * m + i] = -p->M[i * n + j];
            B[j * m + i] = p->K[i * n + j];
        }
        A[i * m + n + i] = B[(n + i) * m + n + i] = 1;
    }
    gsl_test(LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', 'N', m, A, m, B, m, re, im, beta, NULL, m, NULL,
                           m) != 0,
             "LAPACK");
    *growth = 0;
    for (int i = 0; i < m; i++) {
        const double size = hypot(re[i], im[i]);
        if (!(size > 1e-7 * fabs(beta[i])))
            continue;
        const double real = beta[i] * re[i] / (size * size),
                     imaginary = -beta[i] * im[i] / (size * size);
        *growth = fmax(*growth, real);
        if (imaginary > 0 && fabs(real) < 1e-6 * imaginary)
            frequency[count++] = imaginary;
    }
    qsort(frequency, (size_t)count, sizeof *frequency, ascending);
    free(A);
    free(B);
    free(re);
    return count;
}

static status solve(const problem *p, gyroscopic_result *r, fault *f)
{
    sparse K = upper(p->n, p->K), M = upper(p->n, p->M), G = upper(p->n, p->G);
    factor *factors = NULL;
    status outcome = factor_alloc(&K, &factors, f);
    if (outcome == STATUS_OK)
        outcome = factor_numeric(factors, &K, f);
    const gyroscopic_problem problem_ = {
        .K = &K, .M = &M, .G = &G, .K_factor = factors, .wanted = WANTED};
    if (outcome == STATUS_OK)
        outcome = gyroscopic_solve(&problem_, r, f);
    factor_free(factors);
    matrices_free(&K);
    matrices_free(&M);
    matrices_free(&G);
    return outcome;
}

static void compare(const problem *p, int definite_, const char *name)
{
    double *expected = calloc(2 * (size_t)p->n, sizeof *expected), growth, largest = 0;
    gyroscopic_result r = {0};
    fault f = {""};
    const int count = by_lapack(p, expected, &growth);
    gsl_test(solve(p, &r, &f) != STATUS_OK, "%s: solved (%s)", name, f.text);
    int at = 0;
    double worst = 0;
    for (int i = 0; i < r.count; i++) {
        largest = fmax(largest, r.growth[i]);
        if (r.growth[i] > 0)
            continue;
        worst = fmax(worst, at < count ? fabs(r.frequency[i] / expected[at] - 1) : INFINITY);
        at++;
    }
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
            alloc(size[i], &p);
            fill(&p, strength[g], size[i] / 3, 0);
            snprintf(name, sizeof name, "%d unknowns, gyroscopic terms %g", size[i], strength[g]);
            compare(&p, 1, name);
            free(p.K);
        }
}

/* Two copies that do not touch: every frequency twice. */
static void equal_frequencies(void)
{
    static const int size[] = {5, 50};
    for (int k = 0; k < 2; k++) {
        const int n = size[k];
        problem one, two;
        alloc(n, &one);
        alloc(2 * n, &two);
        fill(&one, 2, 0, 0);
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

/* Two unknowns: divergence without gyroscopic terms, stability with strong ones. Roots of lambda^4
 * + (k1 + k2 + g^2) lambda^2 + k1 k2. */
static void indefinite(void)
{
    static const double k1 = -1, k2 = -2, g[] = {0.5, 4};
    for (int i = 0; i < 2; i++) {
        problem p;
        alloc(2, &p);
        p.K[0] = k1, p.K[3] = k2, p.M[0] = p.M[3] = 1, p.G[1] = -g[i], p.G[2] = g[i];
        gyroscopic_result r = {0};
        fault f = {""};
        gsl_test(solve(&p, &r, &f) != STATUS_OK, "top with g = %g: solved (%s)", g[i], f.text);
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
    alloc(20, &p);
    fill(&p, 2, 0, 1.6);
    compare(&p, 0, "20 unknowns, softened");
    free(p.K);
}

/* The number of frequencies below one, beside LAPACK's: between all neighbours, below the first and
 * above the last. */
static void compare_counts(const problem *p, const char *name)
{
    double *frequency = calloc(2 * (size_t)p->n, sizeof *frequency), growth;
    const int count = by_lapack(p, frequency, &growth);
    sparse K = upper(p->n, p->K), M = upper(p->n, p->M), G = upper(p->n, p->G);
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
                alloc(size[i], &p);
                fill(&p, strength[g], massless * size[i] / 3, 0);
                snprintf(name, sizeof name, "%d unknowns, gyroscopic terms %g, %d massless",
                         size[i], strength[g], massless * size[i] / 3);
                compare_counts(&p, name);
                free(p.K);
            }
}

/* A string of `masses` oscillators at 1, 2, 3 ... rad/s that do not touch, and a top beside them.
 * Without gyroscopic terms the top is the stiffest part by far; with them its precession lies half
 * a rad/s above oscillator number `behind`: no start without them shows it, and no residual. */
static void hidden_precession(int masses, int behind, int wanted_outcome)
{
    const double slow = behind + 0.5, k = 1e6, g = (k / slow) - slow; /* root of w^2 + g w - k */
    problem p;
    gyroscopic_result r = {0};
    fault f = {""};
    alloc(masses + 2, &p);
    for (int i = 0; i < masses + 2; i++) {
        p.K[i * (p.n + 1)] = i < masses ? (i + 1.0) * (i + 1.0) : k;
        p.M[i * (p.n + 1)] = 1;
    }
    p.G[masses * p.n + masses + 1] = -g;
    p.G[(masses + 1) * p.n + masses] = g;
    const status outcome = solve(&p, &r, &f);
    gsl_test_int((int)outcome, wanted_outcome, "%d oscillators and a top at %g: %s", masses, slow,
                 f.text);
    if (wanted_outcome != STATUS_OK)
        gsl_test(strstr(f.text, "missing") == NULL, "what is missing is noticed: %s", f.text);
    if (outcome == STATUS_OK)
        gsl_test_int(r.count, WANTED, "%d oscillators and a top at %g: all found", masses, slow);
    for (int i = 0; i < r.count && outcome == STATUS_OK; i++)
        gsl_test_rel(r.frequency[i],
                     i < behind    ? i + 1
                     : i == behind ? slow
                                   : i,
                     1e-9, "%d oscillators and a top at %g: frequency %d", masses, slow, i);
    gyroscopic_free(&r);
    compare_counts(&p, "oscillators and a top");
    free(p.K);
}

/* `masses` oscillators at 1, 2, 3 ... rad/s, one that falls with 1.5/s, one that falls with `fast`,
 * and the top of hidden_precession: its slow precession is missed without a count. */
static void unstable_oscillators(int masses, double fast, int wanted_outcome, int unproven)
{
    const double slow = 2.5, k = 1e6, g = (k / slow) - slow;
    problem p;
    gyroscopic_result r = {0};
    fault f = {""};
    alloc(masses + 4, &p);
    for (int i = 0; i < masses + 4; i++) {
        p.K[i * (p.n + 1)] = i < masses ? (i + 1.0) * (i + 1.0) : k;
        p.M[i * (p.n + 1)] = 1;
    }
    p.K[(masses + 2) * (p.n + 1)] = -1.5 * 1.5;
    p.K[(masses + 3) * (p.n + 1)] = -fast * fast;
    p.G[masses * p.n + masses + 1] = -g;
    p.G[(masses + 1) * p.n + masses] = g;
    const status outcome = solve(&p, &r, &f);
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
        gsl_test(strstr(f.text, "missing") == NULL, "what is missing is noticed: %s", f.text);
    }
    gyroscopic_free(&r);
    free(p.K);
}

int main(void)
{
    unstable_oscillators(12, 1.7, STATUS_OK, 0);
    unstable_oscillators(12, 1e3, STATUS_OK, 1);
    unstable_oscillators(60, 1.7, STATUS_NOT_CONVERGED, 0);
    counts();
    for (int behind = 0; behind < WANTED; behind++)
        hidden_precession(12, behind, STATUS_OK);
    hidden_precession(60, 2, STATUS_NOT_CONVERGED);
    definite();
    equal_frequencies();
    indefinite();
    return gsl_test_summary();
}
