/* Eigenproblems with closed forms, for the tests of eigenvalues. */
#ifndef BEAMWORK_TEST_EIGEN_PROBLEMS_H
#define BEAMWORK_TEST_EIGEN_PROBLEMS_H

#include "elements/math/scalar.h"
#include "harness/numerics/numerics.h"
#include "harness/numerics/test/matrices.h"

/* Several uncoupled strings of unit masses on springs of stiffness `spring[copy]`, fixed at both
 * ends. */
typedef struct strings {
    int copies, masses;
    double spring[8];
    sparse K, M;
} strings;

static inline void strings_init(strings *s, int copies, int masses, double spread)
{
    s->copies = copies;
    s->masses = masses;
    s->K = matrices_chain(masses, copies);
    s->M = matrices_chain(masses, copies);
    for (int c = 0; c < copies; c++) {
        s->spring[c] = 1 + spread * c;
        for (int i = 0; i < masses; i++) {
            matrices_add(&s->K, i * copies + c, i * copies + c, 2 * s->spring[c]);
            matrices_add(&s->M, i * copies + c, i * copies + c, 1);
            if (i > 0)
                matrices_add(&s->K, i * copies + c, (i - 1) * copies + c, -s->spring[c]);
        }
    }
}

static inline void strings_free(strings *s)
{
    matrices_free(&s->K);
    matrices_free(&s->M);
}

static inline double strings_energy(void *context, const double x[])
{
    const strings *s = context;
    double sum = 0;
    for (int c = 0; c < s->copies; c++)
        for (int i = 0; i <= s->masses; i++) {
            const double left = i > 0 ? x[(i - 1) * s->copies + c] : 0,
                         right = i < s->masses ? x[i * s->copies + c] : 0;
            sum += s->spring[c] * (right - left) * (right - left);
        }
    return sum;
}

static inline double strings_exact(const strings *s, int k)
{
    double all[8 * 64];
    int count = 0;
    for (int c = 0; c < s->copies; c++)
        for (int i = 1; i <= 64 && i <= s->masses; i++) {
            const double root = 2 * sin(i * PI / (2 * (s->masses + 1)));
            int at = count++;
            for (const double mu = 1 / (s->spring[c] * root * root);; at--) {
                all[at] = mu;
                if (at == 0 || all[at - 1] >= mu)
                    break;
                all[at] = all[at - 1];
            }
        }
    return all[k];
}

static inline status eigen_problems_solve(eigen_problem *p, eigen_result *r, fault *f)
{
    status outcome = factor_alloc(p->K, &p->K_factor, f);
    if (outcome == STATUS_OK)
        outcome = factor_numeric(p->K_factor, p->K, f);
    if (outcome == STATUS_OK)
        outcome = eigen_solve(p, r, f);
    factor_free(p->K_factor);
    p->K_factor = NULL;
    return outcome;
}

/* Returns the largest deviation of X^T K X from the identity matrix. */
static inline double eigen_problems_departure(const sparse *K, int count, const double *x)
{
    double worst = 0, *product = malloc((size_t)K->n * sizeof *product);
    for (int i = 0; i < count; i++) {
        sparse_mul(K, x + i * K->n, product);
        for (int j = 0; j < count; j++) {
            double sum = i == j ? -1 : 0;
            for (int k = 0; k < K->n; k++)
                sum += x[j * K->n + k] * product[k];
            worst = fmax(worst, fabs(sum));
        }
    }
    free(product);
    return worst;
}

#endif
