/* Small motions about states with an unsymmetric stiffness: columns under a load that follows their
 * tip, beside Beck's characteristic equation and LAPACK. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/analysis/analysis_impl.h"
#include "harness/numerics/test/matrices.h"

/* Clamped column of length 1, EI = 1, mass 1, with a mass at its tip, in `planes` planes that do
 * not touch, the stiffness of the second one `ratio` times that of the first; P follows the tip. */
typedef struct checked_column {
    sparse K, M, C;
} checked_column;

static void add_plane(int elements, int planes, int plane, double P, double stiffness, double tip,
                      double eta, checked_column *c)
{
    double k[16], g[16], m[16];
    const int n = 2 * elements;
    sparse *const all[] = {&c->K, &c->M, &c->C};
    matrices_beam(1.0 / elements, k, g, m);
    for (int e = 0; e < elements; e++)
        for (int a = 0; a < 4; a++)
            for (int b = 0; b < 4; b++) {
                const int i = 2 * e + a - 2, j = 2 * e + b - 2, at = 4 * a + b;
                const double value[] = {stiffness * k[at] - P * g[at], m[at],
                                        eta * stiffness * k[at]};
                for (int which = 0; i >= 0 && j >= 0 && which < 3; which++)
                    all[which]->value[(plane * n + j) * planes * n + plane * n + i] += value[which];
            }
    const int w = plane * n + n - 2, turn = w + 1;
    c->K.value[turn * planes * n + w] += P;
    c->M.value[w * planes * n + w] += tip;
}

static void column_init(int elements, int planes, double P, double ratio, double tip, double eta,
                        checked_column *c)
{
    const int n = 2 * elements * planes;
    double *full = calloc((size_t)n * (size_t)n, sizeof *full);
    for (int i = 0; i < n * n; i++)
        full[i] = 1;
    c->K = matrices_from_dense(n, 0, full);
    c->M = matrices_from_dense(n, 0, full);
    c->C = matrices_from_dense(n, 0, full);
    memset(c->K.value, 0, (size_t)(n * n) * sizeof(double));
    memset(c->M.value, 0, (size_t)(n * n) * sizeof(double));
    memset(c->C.value, 0, (size_t)(n * n) * sizeof(double));
    for (int plane = 0; plane < planes; plane++)
        add_plane(elements, planes, plane, P, plane == 0 ? 1 : ratio, tip, eta, c);
    free(full);
}

static void column_free(checked_column *c)
{
    matrices_free(&c->K);
    matrices_free(&c->M);
    matrices_free(&c->C);
}

static void solve(const checked_column *c, int damped, int wanted, unsymmetric_result *r)
{
    matrix_factor *fa = NULL;
    fault f = {""};
    factor_alloc(&c->K, &fa, &f);
    gsl_test_int((int)factor_numeric(fa, &c->K, &f), STATUS_OK, "%s", f.text);
    const unsymmetric_problem p = {&c->K, &c->M, damped ? &c->C : NULL, fa, wanted, 1};
    gsl_test_int((int)unsymmetric_solve(&p, r, &f), STATUS_OK, "%s", f.text);
    factor_free(fa);
}

/* Half the difference of the first two squares of frequencies, squared: negative where they meet.
 */
static double difference(double P, int elements, double tip)
{
    checked_column c;
    unsymmetric_result r;
    column_init(elements, 1, P, 1, tip, 0, &c);
    solve(&c, 0, 4, &r);
    const double a = r.frequency[0] * r.frequency[0], b = r.frequency[1] * r.frequency[1];
    const double imaginary = 2 * r.frequency[0] * r.growth[0];
    const double value = r.growth[0] != 0 ? -imaginary * imaginary : (b - a) * (b - a) / 4;
    unsymmetric_free(&r);
    column_free(&c);
    return value;
}

/* Where two frequencies meet: bisection, then a line on the unstable side. */
static double flutter_load(double low, double high, int elements, double tip)
{
    while (high - low > 1e-3 * high) {
        const double middle = (low + high) / 2;
        if (difference(middle, elements, tip) < 0)
            high = middle;
        else
            low = middle;
    }
    double a = high, b = high * 1.001, fa = difference(a, elements, tip),
           fb = difference(b, elements, tip);
    for (int i = 0; i < 3; i++) {
        const double at = a + 0.99 * (a - b) * fa / (fb - fa);
        b = a;
        fb = fa;
        a = at;
        fa = difference(a, elements, tip);
    }
    return a + (a - b) * fa / (fb - fa);
}

static void columns(void)
{
    gsl_test_rel(flutter_load(15, 25, 2, 0), 20.1924, 1e-5, "two elements");
    gsl_test_rel(flutter_load(15, 25, 8, 0), 20.0543, 1e-5, "eight elements");
    gsl_test_rel(flutter_load(15, 25, 32, 0), 20.0509536, 2e-6, "Beck");
    gsl_test_rel(flutter_load(12, 25, 16, 0.1), 17.59528, 2e-5, "Pflueger 0.1");
    gsl_test_rel(flutter_load(12, 25, 16, 1), 16.21213, 2e-5, "Pflueger 1");
}

/* Frequencies, sum and product of the two that meet, and no growth before. */
static void near_flutter(void)
{
    static const double load[] = {19, 20.05, 20.0509, 20.052, 20.1, 22};
    for (size_t i = 0; i < sizeof load / sizeof load[0]; i++)
        for (int planes = 1; planes <= 2; planes++) {
            static const double ratio[] = {1, 1 + 1e-9, 1 + 1e-4};
            for (int k = 0; k < 3; k++) {
                checked_column c;
                unsymmetric_result r;
                column_init(32, planes, load[i], ratio[k], 0, 0, &c);
                solve(&c, 0, 4 * planes, &r);
                int growing = 0;
                for (int j = 0; j < r.count; j++)
                    growing += r.growth[j] > 0;
                gsl_test_int(r.count, 4 * planes, "load %g: modes", load[i]);
                const int expected = load[i] > 20.051 ? planes : 0;
                if (planes == 1 || k < 2)
                    gsl_test_int(growing, expected,
                                 "load %g, ratio %.9g: growing modes of %d planes", load[i],
                                 ratio[k], planes);
                const double mean =
                    (r.frequency[0] * r.frequency[0] + r.frequency[planes] * r.frequency[planes] -
                     r.growth[0] * r.growth[0] - r.growth[planes] * r.growth[planes]) /
                    2;
                if (planes == 1 && fabs(load[i] - 20.051) < 2e-3)
                    gsl_test_rel(sqrt(mean), 11.01556, 5e-5, "mean of those that meet");
                gsl_test(!(r.error[0] > 0 && r.error[0] < 1e-2), "estimate %g", r.error[0]);
                unsymmetric_free(&r);
                column_free(&c);
            }
        }
}

/* Damping of the member: the load is another, 10.94 for little of it. */
static void damped(void)
{
    static const double load[] = {10.9, 10.97, 20};
    for (int i = 0; i < 3; i++) {
        checked_column c;
        unsymmetric_result r;
        double growth = -INFINITY;
        column_init(16, 1, load[i], 1, 0, 1e-3, &c);
        solve(&c, 1, 3, &r);
        for (int j = 0; j < r.count; j++)
            growth = fmax(growth, r.growth[j]);
        gsl_test((growth > 0) != (load[i] > 10.94), "load %g: growth %g with damping", load[i],
                 growth);
        unsymmetric_free(&r);
        column_free(&c);
    }
}

/* Without a load all is symmetric: frequencies of a clamped column, none of them growing. */
static void unloaded(void)
{
    static const double root[] = {1.8751040687, 4.6940911330, 7.8547574382, 10.995540735};
    checked_column c;
    unsymmetric_result r;
    column_init(32, 2, 0, 1, 0, 0, &c);
    solve(&c, 0, 8, &r);
    gsl_test_int(r.count, 8, "two planes");
    for (int i = 0; i < 8; i++) {
        gsl_test_rel(r.frequency[i], root[i / 2] * root[i / 2], 1e-5, "frequency %d", i);
        gsl_test(r.growth[i] != 0, "growth %d: %g", i, r.growth[i]);
    }
    unsymmetric_free(&r);
    column_free(&c);
}

int main(void)
{
    columns();
    near_flutter();
    damped();
    unloaded();
    return gsl_test_summary();
}
