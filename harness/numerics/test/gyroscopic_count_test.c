/* Frequencies in a rotating frame are counted: what the count says beside LAPACK, and what is
 * missing is found or noticed. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/numerics/numerics_impl.h"
#include "harness/numerics/test/gyroscopic_problem.h"

/* The number of frequencies below one, beside LAPACK's: between all neighbours, below the first and
 * above the last. */
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

/* `masses` oscillators at 1, 2, 3 ... rad/s that do not touch, others of stiffness 1e6 behind them;
 * the first two of these are a top whose slow precession is `slow` [rad/s]. */
static void oscillators_and_top(int masses, int behind, double slow, problem *p)
{
    const double k = 1e6, g = (k / slow) - slow; /* root of w^2 + g w - k */
    gyroscopic_problem_alloc(masses + behind, p);
    for (int i = 0; i < p->n; i++) {
        p->K[i * (p->n + 1)] = i < masses ? (i + 1.0) * (i + 1.0) : k;
        p->M[i * (p->n + 1)] = 1;
    }
    p->G[masses * p->n + masses + 1] = -g;
    p->G[(masses + 1) * p->n + masses] = g;
}

/* A string of `masses` oscillators at 1, 2, 3 ... rad/s that do not touch, and a top beside them.
 * Without gyroscopic terms the top is the stiffest part by far; with them its precession lies half
 * a rad/s above oscillator number `behind`: no start without them shows it, and no residual. */
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
        gsl_test(strstr(f.text, "missing") == NULL, "what is missing is noticed: %s", f.text);
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

/* `masses` oscillators at 1, 2, 3 ... rad/s, one that falls with 1.5/s, one that falls with `fast`,
 * and the top of hidden_precession: its slow precession is missed without a count. */
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
    return gsl_test_summary();
}
