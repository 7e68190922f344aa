#include "harness/experiments/against.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

#include "harness/numerics/numerics.h"

enum { LEAST_PAIRS = 51, MOST_PAIRS = 1001, WARM_UP = 3 };
static const double tail = 0.0005, least_difference = 0.02;

const char *against_name(against_outcome o)
{
    switch (o) {
    case AGAINST_FASTER:
        return "faster";
    case AGAINST_SLOWER:
        return "slower";
    case AGAINST_UNDECIDED:
        break;
    }
    return "undecided";
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median of n draws lies between the k-th smallest and the k-th largest but with probability 2
 * P(Binomial(n, 1/2) < k). */
static int rank_of_interval(int pairs)
{
    int k = 0;
    while (k < pairs / 2 && gsl_cdf_binomial_P((unsigned)k, 0.5, (unsigned)pairs) <= tail)
        k++;
    return k;
}

contest_clock against_judge(int pairs, const double a[], const double b[])
{
    contest_clock out = {
        .pairs = pairs, .a = INFINITY, .b = INFINITY, .ratio = NAN, .low = 0, .high = INFINITY};
    double *ratio = malloc(((size_t)pairs + 1) * sizeof *ratio);
    for (int i = 0; i < pairs; i++) {
        out.a = fmin(out.a, a[i]);
        out.b = fmin(out.b, b[i]);
        if (ratio != NULL)
            ratio[i] = b[i] / a[i];
    }
    if (ratio == NULL || pairs < 1) {
        free(ratio);
        return out; /* undecided */
    }
    qsort(ratio, (size_t)pairs, sizeof *ratio, ascending);
    const int k = rank_of_interval(pairs);
    out.ratio = (ratio[(pairs - 1) / 2] + ratio[pairs / 2]) / 2;
    if (k > 0) {
        out.low = ratio[k - 1];
        out.high = ratio[pairs - k];
    }
    if (out.low > 1 + least_difference)
        out.outcome = AGAINST_SLOWER;
    else if (out.high < 1 / (1 + least_difference))
        out.outcome = AGAINST_FASTER;
    free(ratio);
    return out;
}

static status lap_pair(against_lap *lap, void *a, void *b, int b_first, double *seconds_a,
                       double *seconds_b, fault *f)
{
    TRY(b_first ? lap(b, seconds_b, f) : lap(a, seconds_a, f));
    return b_first ? lap(a, seconds_a, f) : lap(b, seconds_b, f);
}

status against_run(against_lap *lap, void *a, void *b, double budget, contest_clock *out, fault *f)
{
    double seconds_a[MOST_PAIRS], seconds_b[MOST_PAIRS], least = INFINITY;
    for (int i = 0; i < WARM_UP; i++) {
        const double start = clock_wall_seconds();
        TRY(lap_pair(lap, a, b, i % 2, &seconds_a[0], &seconds_b[0], f));
        least = fmin(least, clock_wall_seconds() - start);
    }
    const int pairs = (int)fmax(LEAST_PAIRS, fmin(MOST_PAIRS, budget / least));
    for (int i = 0; i < pairs; i++)
        TRY(lap_pair(lap, a, b, i % 2, &seconds_a[i], &seconds_b[i], f));
    *out = against_judge(pairs, seconds_a, seconds_b);
    return STATUS_OK;
}
