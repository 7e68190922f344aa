/* J^T S J in registers has the bits of plain loops, in every size and for either set of
 * instructions. */
#include <gsl/gsl_test.h>
#include <string.h>

#include "elements/math/congruence.h"
#include "elements/math/real.h"
#include "elements/test/random.h"

enum { W = CONGRUENCE_WIDEST };

typedef void add_function(int m, int n, const double *J, const double *S, double *K);

/* Sums in the order of their terms, from what K has. */
static void plain_loops(int m, int n, const double *J, const double *S, double *K)
{
    double SJ[W * W];
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++) {
            SJ[i * n + j] = 0;
            for (int l = 0; l < m; l++)
                SJ[i * n + j] += S[i * m + l] * J[l * n + j];
        }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            for (int l = 0; l < m; l++)
                K[i * n + j] += J[l * n + i] * SJ[l * n + j];
}

static void fill(uint64_t *seed, int count, double v[])
{
    for (int i = 0; i < count; i++)
        v[i] = random_number(seed);
}

static void compare(const char *name, add_function *add)
{
    uint64_t seed = 5;
    int different = 0;
    for (int m = 1; m <= W; m++)
        for (int n = 1; n <= W; n++) {
            double J[W * W], S[W * W], K[W * W + 1], expected[W * W + 1];
            fill(&seed, m * n, J);
            fill(&seed, m * m, S);
            fill(&seed, n * n + 1, K);
            memcpy(expected, K, sizeof K[0] * (size_t)(n * n + 1));
            plain_loops(m, n, J, S, expected);
            add(m, n, J, S, K);
            different += memcmp(expected, K, sizeof K[0] * (size_t)(n * n + 1)) != 0;
        }
    gsl_test_int(different, 0, "sizes whose bits are not those of plain loops: %s", name);
}

int main(void)
{
    compare("without AVX2", congruence_add_plain);
    compare("chosen for this processor", REAL_CHOSEN(congruence_add));
    return gsl_test_summary();
}
