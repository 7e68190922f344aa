/* Elimination inside a collocation element: without exchange of rows where the matrix allows it,
 * and right where it does not. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/collocation/collocated.h"
#include "elements/test/random.h"
#include "elements/test/sections.h"
#include "elements/test/worst.h"

extern const element_type element_collocation;

enum { OUTER = EXACT_STAGES_OUTER, UNKNOWNS = EXACT_STAGES_UNKNOWNS, MOST = EXACT_STAGES_MAX };

static exact_stages strip(int stages, unsigned features)
{
    section_spec spec = section_spec_rectangle(200e9, 80e9, 0.05, 0.002);
    const section c = sections_computed(&spec);
    exact_stages s;
    fault f;
    const element_request request = {
        .section = &c, .length = 0.1, .features = features, .type = &element_collocation};
    gsl_test(exact_stages_prepare(&request, stages, &s, &f), "an element of %d stages", stages);
    return s;
}

/* Largest departure of C, relative to what belongs to the same strains on the diagonal. */
static double departure(const double a[], const double b[])
{
    double worst = 0;
    for (int i = 0; i < OUTER; i++)
        for (int j = 0; j < OUTER; j++) {
            const double scale = sqrt(fabs(b[i * (OUTER + 1)] * b[j * (OUTER + 1)])),
                         apart = fabs(a[i * OUTER + j] - b[i * OUTER + j]);
            if (apart != 0)
                worst = worst_of(worst, apart / scale);
        }
    return worst;
}

static status stress(const exact_stages *s, const double e[], const double inner[],
                     stress_output *out)
{
    status outcome;
    exact_collocated_stress(s, 1, &e, &inner, out, &outcome);
    return outcome;
}

/* Both eliminations of the same equations. */
static void both(int stages, unsigned features)
{
    const exact_stages s = strip(stages, features);
    uint64_t seed = 7;
    double e[OUTER], inner[UNKNOWNS], worst = 0, following = 0;
    int definite = 1;
    for (int round = 0; round < 20; round++) {
        static exact_collocated plain, exchanged;
        for (int i = 0; i < OUTER; i++)
            e[i] = 0.003 * random_number(&seed);
        for (int i = 0; i < s.unknowns; i++)
            inner[i] = (i < 3 ? 3 : 0.0005) * random_number(&seed);
        exact_collocated_evaluate(stages, &s, e, inner, NULL, plain.A);
        exact_blocks_eliminate(stages, stages + 3, stages + 1, plain.A, plain.V, plain.d);
        definite &= exact_blocks_definite(stages, plain.A, plain.d, 0);
        memcpy(exchanged.A, plain.A, sizeof plain.A);
        gsl_test(exact_collocated_exchange(stages, OUTER + 1, 0, &exchanged),
                 "with exchange of rows");
        double C[2][OUTER * OUTER];
        for (int i = 0; i < OUTER; i++)
            for (int j = 0; j < OUTER; j++) {
                C[0][i * OUTER + j] = exact_collocated_entry(stages, &plain, i, j, 0);
                C[1][i * OUTER + j] = exact_collocated_entry(stages, &exchanged, i, j, 0);
            }
        worst = worst_of(worst, departure(C[0], C[1]));
        for (int J = 0; J < 3; J++) {
            exact_blocks_solve(stages, stages + 1, stages + J, plain.V, plain.X[J]);
            double apart = 0, scale = 0;
            for (int i = 0; i < stages; i++)
                for (int j = 0; j < 9; j++) {
                    scale = fmax(scale, fabs(exchanged.X[J][i][j]));
                    apart = worst_of(apart, fabs(plain.X[J][i][j] - exchanged.X[J][i][j]));
                }
            following = worst_of(following, apart / scale);
        }
    }
    gsl_test(!definite, "%d stages: nothing to exchange in moderate states", stages);
    gsl_test(!(worst < 1e-11), "%d stages: C with and without exchange (%.1e)", stages, worst);
    gsl_test(!(following < 1e-7), "%d stages: unknowns follow alike (%.1e)", stages, following);
}

/* A straight element under more compression than its inner nodes bear between held ends: the first
 * pivot that is not positive is as small as can be. */
static void compressed(int stages)
{
    const exact_stages s = strip(stages, FEATURE_SHEAR | FEATURE_LARGE);
    const double e[OUTER] = {0};
    double inner[UNKNOWNS] = {0}, low = 0, high = 100, C[4][OUTER * OUTER];
    static exact_collocated w;
    int lost = 0;
    while (high - low > 4e-16 * high && high - low > 0) {
        const double middle = (low + high) / 2;
        if (!(middle > low) || !(middle < high))
            break;
        inner[0] = -middle;
        exact_collocated_evaluate(stages, &s, e, inner, NULL, w.A);
        exact_blocks_eliminate(stages, stages + 3, stages + 1, w.A, w.V, w.d);
        lost = !exact_blocks_definite(stages, w.A, w.d, 0);
        *(lost ? &high : &low) = middle;
    }
    gsl_test(!(fabs(high / (M_PI * M_PI) - 1) < 0.02), "%d stages: held ends buckle at %.6f EI/l^2",
             stages, high);
    const double at[4] = {low, high, high * (1 - 1e-8), high * (1 + 1e-8)};
    for (int i = 0; i < 4; i++) {
        inner[0] = -at[i];
        gsl_test(stress(&s, e, inner, &(stress_output){.C = C[i]}), "%d stages: stress", stages);
    }
    for (int i = 0; i < OUTER * OUTER; i++)
        C[2][i] = (C[2][i] + C[3][i]) / 2;
    for (int i = 0; i < 2; i++) {
        const double worst = departure(C[i], C[2]);
        gsl_test(!(worst < 1e-4), "%d stages: C where a pivot %s (%.1e)", stages,
                 i == 0 ? "is almost lost" : "vanishes", worst);
    }
}

int main(void)
{
    for (int stages = 3; stages <= MOST; stages++) {
        both(stages, FEATURE_SHEAR | FEATURE_WARPING | FEATURE_TRAPEZE | FEATURE_LARGE);
        both(stages, FEATURE_LARGE);
        compressed(stages);
    }
    return gsl_test_summary();
}
