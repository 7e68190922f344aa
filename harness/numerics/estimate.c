#include "harness/numerics/estimate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/numerics/gyroscopic_index.h"

/* K, M and G times the real and the imaginary part of a vector; its residual. */
enum { K_RE, K_IM, M_RE, M_IM, G_RE, G_IM, R_RE, R_IM, WORK, PARTS };

status estimate_alloc(int n, motion_estimate *e, fault *f)
{
    memset(e, 0, sizeof *e);
    e->work = calloc((size_t)PARTS * (size_t)n + 1, sizeof *e->work);
    return e->work != NULL ? STATUS_OK
                           : fault_set(f, STATUS_FAULT, "out of memory for %d coordinates", n);
}

void estimate_free(motion_estimate *e)
{
    free(e->work);
}

static double *part(const motion_estimate *e, int which)
{
    return e->work + (size_t)which * (size_t)e->basis->n;
}

void estimate_stiffness(const gyroscopic_problem *p, const double x[], double y[])
{
    if (p->K_product != NULL)
        p->K_product(p->context, x, y);
    else
        sparse_mul(p->K, x, y);
}

/* x^H K x, x^H M x and i x^H G x. */
typedef struct forms {
    double k, m, g;
} forms;

static forms forms_of(const motion_estimate *e, const double re[], const double im[])
{
    const int n = e->basis->n;
    estimate_stiffness(e->p, re, part(e, K_RE));
    estimate_stiffness(e->p, im, part(e, K_IM));
    sparse_mul(e->p->M, re, part(e, M_RE));
    sparse_mul(e->p->M, im, part(e, M_IM));
    subspace_skew_mul(e->p->G, re, part(e, G_RE));
    subspace_skew_mul(e->p->G, im, part(e, G_IM));
    return (forms){dense_dot(n, re, part(e, K_RE)) + dense_dot(n, im, part(e, K_IM)),
                   dense_dot(n, re, part(e, M_RE)) + dense_dot(n, im, part(e, M_IM)),
                   -2 * dense_dot(n, re, part(e, G_IM))};
}

/* The root of k - omega^2 m + omega g = 0 that is nearer to a frequency. */
static double quotient(const forms *of, double frequency)
{
    const double root = sqrt(of->g * of->g + 4 * of->k * of->m),
                 sum = of->g >= 0 ? of->g + root : of->g - root, large = sum / (2 * of->m),
                 small = -2 * of->k / sum;
    if (!isfinite(large) || !isfinite(small))
        return frequency;
    return fabs(large - frequency) < fabs(small - frequency) ? large : small;
}

/* r = (K + lambda^2 M + lambda G) x into its parts. */
static void residual(const motion_estimate *e, double complex lambda)
{
    const double complex square = lambda * lambda;
    for (int k = 0; k < e->basis->n; k++) {
        const double complex r = part(e, K_RE)[k] + I * part(e, K_IM)[k] +
                                 square * (part(e, M_RE)[k] + I * part(e, M_IM)[k]) +
                                 lambda * (part(e, G_RE)[k] + I * part(e, G_IM)[k]);
        part(e, R_RE)[k] = creal(r);
        part(e, R_IM)[k] = cimag(r);
    }
}

/* half^T S^-1 half */
static double size_of(motion_estimate *e, const double half[])
{
    double *x = part(e, WORK);
    memcpy(x, half, (size_t)e->basis->n * sizeof *x);
    factor_solve(e->S_factor, x);
    e->solutions++;
    return fmax(0, dense_dot(e->basis->n, half, x));
}

/* w^H (lambda^2 M - K) x and w^H w = x^H x = x^H S x = 1. */
static double energy(const motion_estimate *e, int i, double complex lambda, int grows)
{
    const subspace *b = e->basis;
    const size_t at = (size_t)i * (size_t)b->room;
    const double complex *x = e->pairs->c + at, *w = grows ? e->pairs->left + at : x,
                         times = lambda * lambda + e->shift;
    double complex sum = 0;
    for (int j = 0; j < e->pairs->size; j++) {
        double complex Mx = 0;
        for (int k = 0; k < e->pairs->size; k++)
            Mx += b->Mp[j * b->room + k] * x[k];
        sum += conj(w[j]) * (times * Mx - x[j]);
    }
    return cabs(sum);
}

/* x_k^H r of another pair, squared. */
static double share(const motion_estimate *e, int k)
{
    const subspace *b = e->basis;
    const double complex *c = e->pairs->c + (size_t)k * (size_t)b->room;
    double complex sum = 0;
    for (int j = 0; j < e->pairs->size; j++) {
        const double *v = b->V + (size_t)j * (size_t)b->n;
        sum += conj(c[j]) *
               (dense_dot(b->n, v, part(e, R_RE)) + I * dense_dot(b->n, v, part(e, R_IM)));
    }
    return creal(sum * conj(sum));
}

/* Twice what the vector misses, in parts of the eigenvalue: of other motions that were found, and
 * of those that were not, of which the first is known. */
static double missed(motion_estimate *e, int i, double complex lambda, double own)
{
    const double size = cabs(lambda);
    double sum = 0, rest = size_of(e, part(e, R_RE)) + size_of(e, part(e, R_IM));
    for (int k = 0; k < e->found; k++) {
        if (k == i)
            continue;
        const double complex other = e->pairs->lambda[k];
        const double both = own * energy(e, k, other,
                                         gyroscopic_index_grows(e->pairs, e->basis, e->shift, k)),
                     apart = cabs(other - lambda) / size, square = share(e, k) / both;
        sum += square >= apart * apart ? apart : square / apart;
    }
    rest /= own;
    const double next = e->found < e->pairs->count ? cabs(e->pairs->lambda[e->found]) : INFINITY,
                 apart = fmin(1, fabs(next - size) / size);
    sum += rest >= apart * apart ? sqrt(rest) : rest / apart;
    return 2 * sum;
}

/* What rounding may change in x^H (K + lambda^2 M + lambda G) x. The entries themselves pass
 * through a few operations. */
static double rounding(const motion_estimate *e, double size, const double re[], const double im[])
{
    const double operations = 4;
    const gyroscopic_problem *p = e->p;
    const double k = p->K_rounding != NULL
                         ? p->K_rounding(p->context, re) + p->K_rounding(p->context, im)
                         : sparse_rounding(p->K, re, re) + sparse_rounding(p->K, im, im);
    const double m = sparse_rounding(p->M, re, re) + sparse_rounding(p->M, im, im),
                 g = 2 * sparse_rounding(p->G, re, im);
    return operations * (k + size * size * m + size * g);
}

void estimate_pair(motion_estimate *e, int i, const double re[], const double im[], int grows,
                   double complex *lambda, double *error)
{
    const forms of = forms_of(e, re, im);
    if (!grows)
        *lambda = I * quotient(&of, cimag(*lambda));
    const double size = cabs(*lambda), own = energy(e, i, *lambda, grows),
                 change = rounding(e, size, re, im);
    residual(e, *lambda);
    *error = missed(e, i, *lambda, own) + fmin(change / own, sqrt(change / of.m) / size);
}
