/* Candidates for eigenvalues: sorted, counted by the inertia, and completed by what they leave. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>

#include "elements/math/pi.h"
#include "harness/numerics/numerics_impl.h"
#include "harness/numerics/test/eigen_problems.h"

/* What happens when the iteration has found one copy of a repeated eigenvalue: the inertia says so,
 * and the others come out of what that copy leaves. */
static void test_missed_copies(void)
{
    enum { COPIES = 3, MASSES = 40, N = COPIES * MASSES };
    strings s;
    eigen_result work = {0};
    candidates p;
    double x[N] = {0}, mu[2], all[COPIES * N] = {0}, *more;
    int missing = -1, above = -1, found = 0;
    strings_init(&s, COPIES, MASSES, 0);
    eigen_problem e = {.K = &s.K,
                       .A = &s.M,
                       .sign = 1,
                       .largest = COPIES,
                       .K_energy = strings_energy,
                       .context = &s};
    gsl_test(factor_alloc(e.K, &e.K_factor, NULL) != STATUS_OK ||
                 factor_numeric(e.K_factor, e.K, NULL) != STATUS_OK ||
                 candidates_alloc(&p, &e, 1, NULL) != STATUS_OK,
             "strings are factorised");
    for (int c = 0; c < COPIES; c++)
        for (int i = 0; i < MASSES; i++)
            all[c * N + i * COPIES + c] = 1e5 * sin((i + 1) * PI / (MASSES + 1));
    for (int i = 0; i < MASSES; i++) /* the second mode of one string */
        x[i * COPIES] = sin(2 * (i + 1) * PI / (MASSES + 1));
    const double first = strings_exact(&s, 0), second = strings_exact(&s, COPIES),
                 scale = candidates_scale(&p, &work.solutions);
    gsl_test(!(scale > 0.3 * first && scale < first * (1 + 1e-9)),
             "the largest eigenvalue is estimated from below (%g of it)", scale / first);
    candidates_count_above(&p, sqrt(first * second), &above, &work, NULL);
    gsl_test_int(above, COPIES, "the inertia counts all copies");
    gsl_test(candidates_add(&p, 1, x, 0, NULL) != STATUS_OK ||
                 candidates_add(&p, 1, all, 0, NULL) != STATUS_OK,
             "candidates are taken in");
    gsl_test_rel(p.mu[0], first, 1e-14, "and sorted");
    gsl_test_rel(p.mu[1], second, 1e-14, "by size");
    gsl_test(candidates_count_missing(&p, 1, &missing, &work, NULL) != STATUS_OK || missing != 0,
             "the largest value is right with one copy");
    gsl_test_int((int)candidates_count_missing(&p, 2, &missing, &work, NULL), STATUS_OK,
                 "values that lie above the second one are counted");
    gsl_test_int(missing, COPIES - 1, "and two are missing");
    double *products = candidates_products(&p);
    const lanczos_problem rest = {e.K, e.A, e.K_factor, 1, p.count, p.x, products};
    gsl_test(lanczos_largest(&rest, 2, &found, mu, &more, &work.solutions, NULL) != STATUS_OK ||
                 found != 2,
             "Lanczos goes on where the candidates leave off");
    gsl_test_rel(mu[0], first, 1e-12, "second copy");
    gsl_test_rel(mu[1], first, 1e-12, "third copy");
    gsl_test(candidates_take(&p, 2, more, 0, NULL) != STATUS_OK, "both are taken in");
    free(products);
    gsl_test(candidates_count_missing(&p, COPIES + 1, &missing, &work, NULL) != STATUS_OK ||
                 missing != 0,
             "now nothing is missing");
    const double apart = eigen_problems_departure(&s.K, p.count, p.x);
    gsl_test(!(apart < 1e-12), "candidates are orthonormal within %.1e", apart);
    gsl_test(candidates_add(&p, 1, all, 0, NULL) != STATUS_OK, "the same vector again");
    gsl_test_int((int)candidates_count_missing(&p, COPIES + 2, &missing, &work, NULL),
                 STATUS_NOT_CONVERGED, "counts too many");
    candidates_free(&p);
    factor_free(e.K_factor);
    strings_free(&s);
}

int main(void)
{
    test_missed_copies();
    return gsl_test_summary();
}
