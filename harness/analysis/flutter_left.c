#include "harness/analysis/flutter_left.h"

#include <math.h>
#include <string.h>

#include "harness/analysis/arnoldi.h"

enum {
    FEWEST = 6,
    MOST = 48,
    SPARE = 3
}; /* eigenvalues that are looked at; beyond the last on the left */
/* Of an eigenvalue beside those looked at: its sign may be. */
static const double rounding = 1e-6;

typedef struct metric_inverse {
    matrix_factor *K;
    int n;
    const double *weight;
} metric_inverse;

/* y = D^1/2 K^-1 D^1/2 x */
static void apply(void *context, const double x[], double y[])
{
    const metric_inverse *of = context;
    for (int k = 0; k < of->n; k++)
        y[k] = sqrt(of->weight[k]) * x[k];
    factor_solve(of->K, y);
    for (int k = 0; k < of->n; k++)
        y[k] *= sqrt(of->weight[k]);
}

/* How many lie on the left; 0 for *sure: others may, beyond those that were looked at. */
static int count_of(const arnoldi_result *r, int wanted, int determinant, int *sure)
{
    int left = 0;
    for (int i = 0; i < r->count; i++)
        left += creal(r->theta[i]) < 0;
    const double least = cabs(r->theta[0]), last = cabs(r->theta[r->count - 1]);
    const int parity = left % 2 == 0 ? 1 : -1;
    *sure = (left <= wanted - SPARE || r->count < wanted) &&
            (parity == determinant || last < rounding * least);
    return left;
}

static void take(const arnoldi_result *r, left_of_axis *out)
{
    out->nearest = r->count < LEFT_NEAREST ? r->count : LEFT_NEAREST;
    for (int i = 0; i < out->nearest; i++)
        out->mu[i] = 1 / r->theta[i];
}

status left_count(matrix_factor *K, int n, const double weight[], left_of_axis *out, fault *f)
{
    metric_inverse of = {K, n, weight};
    memset(out, 0, sizeof *out);
    for (int wanted = FEWEST;; wanted *= 2) {
        arnoldi_result r = {0};
        const arnoldi_problem p = {n, wanted < n ? wanted : n, apply, &of};
        fault why = {""};
        int sure = 0;
        const status outcome = arnoldi_solve(&p, &r, &why);
        out->solutions += r.applied;
        out->nearest = 0;
        if (outcome == STATUS_OK && r.count > 0) {
            out->count = count_of(&r, p.wanted, factor_count(K).determinant, &sure);
            take(&r, out);
        }
        arnoldi_free(&r);
        if (outcome == STATUS_FAULT)
            return fault_set(f, outcome, "%s", why.text);
        if (sure)
            return STATUS_OK;
        if (outcome != STATUS_OK || wanted >= n || wanted >= MOST) {
            out->count = -1;
            return STATUS_OK;
        }
    }
}
