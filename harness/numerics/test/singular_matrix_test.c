/* Singular matrices of every kind, and beams that are not held. */
#include <gsl/gsl_test.h>

#include "harness/numerics/test/matrices.h"

static status outcome_of(const sparse *s, fault *f)
{
    matrix_factor *fa;
    status outcome = factor_alloc(s, &fa, f);
    if (outcome == STATUS_OK)
        outcome = factor_numeric(fa, s, f);
    factor_free(fa);
    return outcome;
}

static void small_singular_matrices(void)
{
    static const struct {
        const char *name;
        double A[9];
        status expected;
    } sample[] = {
        {"a zero row", {1, 0, 0.3, 0, 0, 0, 0.3, 0, 2}, STATUS_SINGULAR},
        {"two equal rows", {1, 0.7, 0.7, 0.7, 3, 3, 0.7, 3, 3}, STATUS_SINGULAR},
        {"a number that is not one", {1, 0, 0, 0, NAN, 0.1, 0, 0.1, 2}, STATUS_SINGULAR},
        {"an infinite number", {1, 0, 0, 0, INFINITY, 0.1, 0, 0.1, 2}, STATUS_SINGULAR},
        {"the zero matrix", {0, 0, 0, 0, 0, 0, 0, 0, 0}, STATUS_SINGULAR},
        {"tiny numbers", {1e-200, 0, 3e-201, 0, 1e-200, 0, 3e-201, 0, 2e-200}, STATUS_OK},
        {"huge numbers", {1e200, 0, 3e199, 0, 1e200, 0, 3e199, 0, 2e200}, STATUS_OK},
        {"digits to spare", {1, 1, 0, 1, 1 + 1e-12, 0, 0, 0, 1}, STATUS_OK},
        {"no digits left", {1, 1, 0, 1, 1 + 4e-16, 0, 0, 0, 1}, STATUS_SINGULAR},
    };
    for (size_t i = 0; i < sizeof sample / sizeof sample[0]; i++)
        for (int symmetric = 0; symmetric < 2; symmetric++) {
            fault f = {""};
            sparse s = matrices_from_dense(3, symmetric, sample[i].A);
            gsl_test_int((int)outcome_of(&s, &f), (int)sample[i].expected, "%s (%s): %s",
                         sample[i].name, symmetric ? "symmetric" : "unsymmetric", f.text);
            matrices_free(&s);
        }
    const double growth[4] = {1e-17, 1, 1, 0};
    sparse s = matrices_from_dense(2, 1, growth);
    gsl_test_int((int)outcome_of(&s, NULL), STATUS_SINGULAR,
                 "a pivot that is small beside its column destroys the digits");
    matrices_free(&s);
    s = matrices_from_dense(2, 0, growth);
    gsl_test_int((int)outcome_of(&s, NULL), STATUS_OK, "and does no harm with row exchanges");
    matrices_free(&s);
}

/* A beam of n elements with so many unknowns of its first node held. */
static status beam_outcome(int n, int held, int unsymmetric)
{
    double k[16], g[16], m[16];
    matrices_beam(1.0 / n, k, g, m);
    sparse s = matrices_chain(n + 1, 2);
    matrices_add_elements(&s, n, 2, 0, k);
    for (int i = 0; i < held; i++)
        matrices_add(&s, i, i, k[5 * i] * n);
    if (unsymmetric) {
        sparse full = matrices_both_triangles(&s);
        matrices_free(&s);
        s = full;
    }
    const status outcome = outcome_of(&s, NULL);
    matrices_free(&s);
    return outcome;
}

static void beams_that_are_not_held(void)
{
    for (int n = 1; n <= 2048; n *= 2)
        for (int unsymmetric = 0; unsymmetric < 2; unsymmetric++) {
            const char *kind_name = unsymmetric ? "LU" : "LDL";
            gsl_test_int((int)beam_outcome(n, 0, unsymmetric), STATUS_SINGULAR,
                         "%s: free beam of %d elements", kind_name, n);
            gsl_test_int((int)beam_outcome(n, 1, unsymmetric), STATUS_SINGULAR,
                         "%s: beam of %d elements that can turn", kind_name, n);
            gsl_test_int((int)beam_outcome(n, 2, unsymmetric), STATUS_OK,
                         "%s: cantilever of %d elements", kind_name, n);
        }
}

int main(void)
{
    small_singular_matrices();
    beams_that_are_not_held();
    return gsl_test_summary();
}
